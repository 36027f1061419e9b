"""The model checks, on robots made by hand: which finding, about which element."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from pathlib import Path

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.urdf.robot import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Dynamics,
    Geometry,
    Inertia,
    Inertial,
    Joint,
    JointType,
    Limit,
    Link,
    Mesh,
    Mimic,
    Robot,
    Sphere,
    Visual,
)
from urdfsync.urdf.validate import ADVICE, check, diagnostic, normalise_axes, principal_moments


def links(names: str) -> tuple[Link, ...]:
    return tuple(map(Link, names))


def joint(name: str, ends: str, kind: JointType = "continuous", mimic: Mimic | None = None) -> Joint:
    """A joint from the link of the first letter to that of the second."""
    return Joint(name, kind, ends[0], ends[1], mimic=mimic)


def found(robot: Robot) -> list[tuple[str, str, str]]:
    return [(str(diagnostic(one.code, "", 1).severity), one.code, one.path) for one in check(robot)]


def about(joints: Iterable[Joint], names: str = "abc") -> list[tuple[str, str, str]]:
    return found(Robot("r", links(names), tuple(joints)))


def about_joint(**fields: object) -> list[tuple[str, str, str]]:
    plain = Joint("j", "revolute", "a", "b", limit=Limit(-1.0, 1.0, 1.0, 1.0))
    return about([msgspec.structs.replace(plain, **fields)], "ab")


def about_inertial(inertial: Inertial) -> list[tuple[str, str, str]]:
    return found(Robot("r", (Link("a", inertial),)))


def test_a_link_and_a_joint_may_share_a_name() -> None:
    assert about([joint("a", "ab")], "ab") == []


def test_duplicate_names() -> None:
    twice = about([joint("j", "ab"), joint("j", "ac")], "aabc")
    assert twice == [("error", "duplicate-link", "link a #2"), ("error", "duplicate-joint", "joint j #2")]


def test_ends_that_do_not_exist_hide_the_question_of_roots() -> None:
    assert about([joint("j", "ax"), joint("k", "yb")]) == [
        ("error", "unknown-child", "joint j / child"),
        ("error", "unknown-parent", "joint k / parent"),
    ]


def test_two_parents() -> None:
    assert about([joint("j", "ac"), joint("k", "ab"), joint("l", "bc")]) == [("error", "two-parents", "joint l")]


def test_several_roots_are_named() -> None:
    (finding,) = check(Robot("r", links("abc"), (joint("j", "ab"),)))
    assert (finding.code, finding.path) == ("several-roots", "link c")
    assert "'a', 'c'" in finding.message


@pytest.mark.parametrize(
    ("ends", "names", "told"),
    [
        (["aa"], "a", "'a' → 'a'"),
        (["ab", "ba"], "ab", "'a' → 'b' → 'a'"),
        (["bc", "cd", "db"], "abcd", "'b' → 'c' → 'd' → 'b'"),
    ],
)
def test_a_cycle_is_named_along_its_joints(ends: list[str], names: str, told: str) -> None:
    (finding,) = check(Robot("r", links(names), tuple(joint(end, end) for end in ends)))
    assert finding.code == "cycle"
    written = finding.message.partition(": ")[2].split(" → ")
    expected = told.split(" → ")
    turn = expected[:-1].index(written[0])
    assert written == [*expected[turn:-1], *expected[:turn], written[0]]


def test_each_cycle_is_told_once() -> None:
    codes = [code for _, code, _ in about([joint(end, end) for end in ("ab", "ba", "cd", "dc", "ae")], "abcde")]
    assert codes == ["cycle", "cycle"]


AXIS, ORDER = ("warning", "axis-not-unit", "joint j / axis"), ("error", "limit-order", "joint j / limit")
NEGATIVE, IDLE = (("warning", code, "joint j / dynamics") for code in ("negative-dynamics", "dynamics-without-effect"))
SMALL = ("warning", "negative-limit", "joint j / limit")


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ({"axis": (0.0, 0.0, 1.0000005)}, []),
        ({"axis": (0.57735, 0.57735, 0.57735)}, []),
        ({"axis": (0.5773, 0.5773, 0.5773)}, [AXIS]),
        ({"axis": (1.0, 1.0, 0.0)}, [AXIS]),
        ({"axis": (1e-200, 0.0, 0.0)}, [AXIS]),
        ({"axis": (1e200, 1e200, 1e200)}, [AXIS]),
        ({"limit": Limit(1.0, -1.0)}, [ORDER]),
        ({"type": "prismatic", "limit": Limit(1.0, -1.0)}, [ORDER]),
        ({"type": "continuous", "limit": Limit(1.0, -1.0)}, []),
        ({"limit": Limit(1.0, 1.0)}, []),
        ({"limit": Limit(0.0, 1.0, -1.0)}, [SMALL]),
        ({"limit": Limit(0.0, 1.0, 1.0, -1.0)}, [SMALL]),
        ({"limit": Limit(0.0, 1.0, 0.0, 0.0)}, []),
        ({"dynamics": Dynamics(1.0, 1.0)}, []),
        ({"dynamics": Dynamics(-1.0, -1.0)}, [NEGATIVE, NEGATIVE]),
        ({"type": "planar", "dynamics": Dynamics(1.0, 0.0)}, []),
        ({"type": "fixed", "dynamics": Dynamics(0.0, 0.0)}, []),
        ({"type": "fixed", "dynamics": Dynamics(-1.0, 0.0)}, [IDLE]),
        ({"type": "floating", "dynamics": Dynamics(0.0, 1.0)}, [IDLE]),
    ],
)
def test_numbers_of_a_joint(fields: dict[str, object], expected: list[tuple[str, str, str]]) -> None:
    assert about_joint(**fields) == expected


FINITE = st.floats(allow_nan=False, allow_infinity=False)


@given(st.tuples(FINITE, FINITE, FINITE))
def test_normalising_gives_unit_vectors_and_once_is_enough(axis: tuple[float, float, float]) -> None:
    robot = normalise_axes(Robot("r", links("ab"), (Joint("j", "continuous", "a", "b", axis=axis),)))
    unit = robot.joints[0].axis
    assert abs(math.hypot(*unit) - 1) < 1e-12
    assert normalise_axes(robot) == robot
    if any(axis):
        assert all(ours * theirs >= 0 for ours, theirs in zip(unit, axis, strict=True))


@pytest.mark.parametrize(
    ("leader", "follower", "expected"),
    [
        ("revolute", "prismatic", []),
        ("continuous", "fixed", [("warning", "mimic-without-effect", "joint k / mimic")]),
        ("continuous", "planar", [("error", "mimic-type", "joint k / mimic")]),
        ("continuous", "floating", [("error", "mimic-type", "joint k / mimic")]),
        ("fixed", "continuous", [("warning", "mimic-of-fixed", "joint k / mimic")]),
        ("planar", "continuous", [("error", "mimic-type", "joint k / mimic")]),
        ("floating", "continuous", [("error", "mimic-type", "joint k / mimic")]),
    ],
)
def test_mimic_by_types(leader: JointType, follower: JointType, expected: list[tuple[str, str, str]]) -> None:
    assert about([joint("j", "ab", leader), joint("k", "ac", follower, Mimic("j"))]) == expected


def test_mimic_chains_are_legal_and_cycles_are_not() -> None:
    chain = [joint("j", "ab"), joint("k", "ac", mimic=Mimic("j")), joint("l", "ad", mimic=Mimic("k"))]
    assert about(chain, "abcd") == []
    chain[0] = joint("j", "ab", mimic=Mimic("l"))
    assert about(chain, "abcd") == [("error", "mimic-cycle", "joint j / mimic")]
    assert about([joint("j", "ab", mimic=Mimic("j"))], "ab") == [("error", "mimic-cycle", "joint j / mimic")]


def test_the_side_that_a_mimic_has_lost_is_that_of_its_own_joint() -> None:
    names = ("left_thumb_base", "left_thumb_tip", "right_thumb_base", "right_thumb_tip")
    fingers = [joint(name, f"a{end}") for name, end in zip(names, "bcde", strict=True)]
    fingers[1] = msgspec.structs.replace(fingers[1], mimic=Mimic("thumb_base"))
    fingers[3] = msgspec.structs.replace(fingers[3], mimic=Mimic("thumb_base"))
    hints = [finding.hint for finding in check(Robot("hands", links("abcde"), tuple(fingers)))]
    assert hints == ["perhaps 'left_thumb_base' is meant", "perhaps 'right_thumb_base' is meant"]


@pytest.mark.parametrize(
    ("inertial", "expected"),
    [
        (Inertial(1.0), []),
        (Inertial(0.0), []),
        (Inertial(-1.0), [("error", "negative-mass", "link a / inertial / mass")]),
        (Inertial(1.0, inertia=Inertia(1.0, 0.0, 0.0, 1.0, 0.0, 2.0)), []),
        (Inertial(1.0, inertia=Inertia(1.0, 0.0, 0.0, 1.0, 0.0, 2.000001)), []),
        (Inertial(1.0, inertia=Inertia(1.0, 0.0, 0.0, 1.0, 0.0, 2.1)),
         [("warning", "inertia-triangle", "link a / inertial / inertia")]),
        (Inertial(1.0, inertia=Inertia(1e-9, 0.0, 0.0, 1e-9, 0.0, 2.1e-9)),
         [("warning", "inertia-triangle", "link a / inertial / inertia")]),
        (Inertial(1.0, inertia=Inertia(1.0, 2.0, 0.0, 1.0, 0.0, 1.0)),
         [("warning", "inertia-not-positive", "link a / inertial / inertia")]),
        (Inertial(1.0, inertia=Inertia(-1.0, 0.0, 0.0, -1.0, 0.0, -1.0)),
         [("warning", "inertia-not-positive", "link a / inertial / inertia")]),
        (Inertial(1.0, inertia=Inertia(1.0, 0.0, 0.0, 1.0, 0.0, 0.0)), []),
        (Inertial(1.0, inertia=Inertia(0.0, 2e-20, 0.0, 0.0, 0.0, 1e-18)), []),  # a point mass, but for rounding
        (Inertial(0.0, inertia=Inertia(0.0, 2e-20, 0.0, 0.0, 0.0, 1e-18)),
         [("warning", "inertia-not-positive", "link a / inertial / inertia")]),
    ],
)  # fmt: skip
def test_mass_properties(inertial: Inertial, expected: list[tuple[str, str, str]]) -> None:
    assert about_inertial(inertial) == expected


MOMENT = st.floats(-1e3, 1e3)


@given(st.builds(Inertia, MOMENT, MOMENT, MOMENT, MOMENT, MOMENT, MOMENT))
def test_principal_moments_are_the_eigenvalues(i: Inertia) -> None:
    tensor = np.array([[i.ixx, i.ixy, i.ixz], [i.ixy, i.iyy, i.iyz], [i.ixz, i.iyz, i.izz]])
    expected = np.linalg.eigvalsh(tensor)
    assert np.allclose(principal_moments(i), expected, rtol=0, atol=1e-7 * np.abs(tensor).max() + 1e-300)


@pytest.mark.parametrize(
    ("geometry", "told"),
    [
        (Box((1.0, 1.0, 1.0)), False),
        (Box((1.0, 0.0, 1.0)), True),
        (Box((1.0, -1.0, 1.0)), True),
        (Cylinder(1.0, 1.0), False),
        (Cylinder(0.0, 1.0), True),
        (Cylinder(1.0, 0.0), True),
        (Capsule(1.0, 0.0), False),
        (Capsule(0.0, 1.0), True),
        (Sphere(0.0), False),
        (Sphere(-1.0), True),
        (Mesh("a.stl", (-1.0, 1.0, 1.0)), False),
        (Mesh("a.stl", (1.0, 0.0, 1.0)), True),
    ],
)
def test_sizes_of_shapes(geometry: Geometry, told: bool) -> None:
    link = Link("a", None, (Visual(Sphere(1.0)), Visual(geometry)), (Collision(geometry),))
    kind = type(geometry).__name__.lower()
    expected = [("warning", "shape-size", f"link a / {place} / {kind}") for place in ("visual 2", "collision 1")]
    assert found(Robot("r", (link,))) == expected * told


def test_every_code_is_explained() -> None:
    page = (Path(__file__).parents[2] / "docs" / "urdf.md").read_text(encoding="utf-8")
    explained = set(re.findall(r"`([a-z-]+)`", page.partition("## Findings")[2]))
    assert explained >= ADVICE.keys()
