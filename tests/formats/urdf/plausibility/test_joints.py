"""A drive that is too weak for the weight behind its joint."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.packages import read
from support.urdfs import joint, limit, link, robot, version

from urdfsync.formats.urdf.kinematics.loads import find_extremes
from urdfsync.formats.urdf.kinematics.poses import link_poses
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.plausibility.joints import find_impossible_joints
from urdfsync.formats.urdf.plausibility.shapes import find_bodies

BASE = link("base", 4.0)


def told(*elements: str) -> list[str]:
    return [one.message for one in read(robot(BASE, *elements).encode()).diagnostics if one.code == "weak-effort"]


def arm(kind: str, lower: float, upper: float, effort: float, rpy: str = "0 0 0") -> list[str]:
    """A link of 2 kg, whose centre of mass is 0.5 m from the joint along x; the joint's axis is y."""
    body = '<link name="arm"><inertial><origin xyz="0.5 0 0"/><mass value="2"/><inertia ixx="0.1" iyy="0.1" izz="0.1"'
    inside = [limit(lower, upper, effort=effort)]
    return [f'{body} ixy="0" ixz="0" iyz="0"/></inertial></link>',
            joint("j", kind, "base", "arm", axis="0 1 0", rpy=rpy, inside=inside)]  # fmt: skip


@pytest.mark.parametrize(("parts", "words"), [
    (arm("revolute", -0.1, 0.1, 9), "9: the weight behind the joint takes 9.758 N·m or more in each of its positions"),
    (arm("revolute", -0.1, 0.1, 9.8), ""),
    (arm("revolute", -0.1, 1.6, 1), ""),  # it hangs down at a quarter of a turn
    (arm("prismatic", 0, 1, 5, f"{math.pi / 2} 0 0"), "5: the weight behind the joint takes 19.61 N or more in"),
    (arm("prismatic", 0, 1, 5), ""),  # across gravity
    (arm("continuous", 0, 0, 1), ""),
])  # fmt: skip
def test_an_effort_below_the_weight_in_each_position_is_told(parts: list[str], words: str) -> None:
    assert [words in message for message in told(*parts)] == [True] * bool(words)


@given(st.floats(-3, 3), st.floats(0.01, 3), st.tuples(*[st.floats(-1, 1)] * 3), st.tuples(*[st.floats(-3, 3)] * 3))
def test_the_least_weight_never_exceeds_the_greatest(
    lower: float, width: float, center: tuple[float, ...], angles: tuple[float, ...]
) -> None:
    """The greatest load over a grid of positions is found by other code."""
    xyz, rpy = " ".join(map(str, center)), " ".join(map(str, angles))
    body = f'<link name="arm"><inertial><origin xyz="{xyz}"/><mass value="2"/></inertial></link>'
    turn = joint("j", "revolute", "base", "arm", axis="0.6 0 0.8", rpy=rpy,
                 inside=[limit(lower, lower + width, effort=1e-6)])  # fmt: skip
    tree = KinematicTree.of(version(BASE, body, turn).snapshot)
    findings = find_impossible_joints(tree, find_bodies(tree, {}, 1.0), 1.0, link_poses(tree, {}))
    greatest = find_extremes(tree)[1]["j"]
    for finding in findings:
        if finding.code == "weak-effort":
            least = float(finding.message.partition("takes ")[2].partition(" ")[0])
            assert least <= greatest * (1 + 1e-3)


@pytest.mark.parametrize(("center", "codes"), [
    ("0 0 0.001", []), ("0.01 0 0", ["unbalanced"]), ("1e200 0 0", ["center-of-mass", "unbalanced"]),
])  # fmt: skip
def test_a_wheel_is_balanced(center: str, codes: list[str]) -> None:
    inertia = '<inertia ixx="0.005" iyy="0.005" izz="0.008" ixy="0" ixz="0" iyz="0"/>'
    shape = '<visual><geometry><cylinder radius="0.1" length="0.05"/></geometry></visual>'
    body = f'<inertial><origin xyz="{center}"/><mass value="1.6"/>{inertia}</inertial>'
    turn = joint("j", "continuous", "base", "wheel", axis="0 0 1")
    found = read(robot(BASE, f'<link name="wheel">{body}{shape}</link>', turn).encode()).diagnostics
    assert sorted(one.code for one in found) == codes
