"""What resists the motion of joints is the diagonal of the mass matrix, which Pinocchio finds in another way."""

from __future__ import annotations

import numpy as np
import pinocchio
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from support import urdfs

from urdfsync.urdf.kinematics.poses import start_positions
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.resistance import resistances, yielding

ARM = urdfs.robot(
    *(urdfs.link(name, mass) for name, mass in (("base", 5), ("upper", 3), ("lower", 2), ("hand", 0.5), ("rail", 1))),
    urdfs.link("flange"),
    urdfs.joint("lift", "revolute", "base", "upper", axis="0.6 0 0.8", inside=[urdfs.limit(0.5, 2)]),
    urdfs.joint("bend", "revolute", "upper", "lower", axis="0 1 0", inside=[urdfs.limit(-2, -0.3)]),
    urdfs.joint("fasten", "fixed", "lower", "flange"),
    urdfs.joint("reach", "prismatic", "flange", "hand", axis="1 0 0", inside=[urdfs.limit(0.1, 0.4)]),
    urdfs.joint("slide", "prismatic", "base", "rail", axis="0 0 1", inside=[urdfs.limit()]),
)
"""No joint but the last can be at zero."""


def skeleton(urdf: str) -> KinematicTree:
    robot = read_robot(urdf.encode(), "own.urdf", cross_check=False).robot
    assert robot is not None
    return KinematicTree.of(robot)


def mass_matrix(urdf: str) -> NDArray[np.float64]:
    """By Pinocchio, all joints at zero."""
    model = pinocchio.buildModelFromXML(urdf)
    upper = np.triu(pinocchio.crba(model, model.createData(), pinocchio.neutral(model)))
    return np.asarray(upper + np.triu(upper, 1).T)


def test_they_are_the_diagonal_of_the_mass_matrix_at_the_start() -> None:
    of, model = skeleton(ARM), pinocchio.buildModelFromXML(ARM)
    start, names = start_positions(of), list(model.names)[1:]
    matrix = pinocchio.crba(model, model.createData(), np.array([start[name] for name in names]))
    found = resistances(of)
    assert set(found) == set(names)
    assert [found[name] for name in names] == pytest.approx(np.diag(matrix), rel=1e-12)


def test_a_leader_moves_its_followers_with_their_ratios() -> None:
    plain = resistances(skeleton(ARM))
    led = ARM.replace("</robot>", "").splitlines()
    mimic = [
        line.replace("</joint>", f"{urdfs.mimic('lift', -3)}</joint>") if '"slide"' in line else line for line in led
    ]
    found = resistances(skeleton("\n".join([*mimic, "</robot>"])))
    assert found["lift"] == pytest.approx(plain["lift"] + 9 * plain["slide"], rel=1e-12)


def test_what_is_on_the_axis_is_no_inertia_even_far_from_the_root() -> None:
    """Where terms of 1e4 cancel each other."""
    rod = '<inertial><origin xyz="0 0 0.2"/><mass value="2"/><inertia ixx="1" iyy="1" izz="0" ixy="0" ixz="0" iyz="0"/>'
    urdf = urdfs.robot(
        urdfs.link("base", 1),
        f'<link name="rod">{rod}</inertial></link>',
        urdfs.joint("spin", "continuous", "base", "rod", axis="0 0 1", xyz="70 -30 20"),
    )
    assert resistances(skeleton(urdf)) == {"spin": 0.0}


CASES = {
    "coaxial": ("continuous", "0 0 1", "0 0 0.4", "continuous", "0 0 1", None, {"first"}),
    "opposed": ("continuous", "0 0 1", "0 0 0.4", "continuous", "0 0 -1", None, {"first"}),
    "along": ("prismatic", "0 0 1", "0.3 0 0.4", "prismatic", "0 0 1", None, {"first"}),
    "off the axis": ("continuous", "0 0 1", "0.3 0 0.4", "continuous", "0 0 1", None, set()),
    "across": ("continuous", "0 0 1", "0 0 0.4", "continuous", "0 1 0", None, set()),
    "other kind": ("continuous", "0 0 1", "0 0 0.4", "prismatic", "0 0 1", None, set()),
    "a mass between": ("continuous", "0 0 1", "0 0 0.4", "continuous", "0 0 1", 1e-3, set()),
}


@pytest.mark.parametrize(
    ("kind", "axis", "xyz", "next_kind", "next_axis", "mass", "expected"), CASES.values(), ids=CASES
)
def test_what_gives_way_makes_the_mass_matrix_singular(
    kind: str, axis: str, xyz: str, next_kind: str, next_axis: str, mass: float | None, expected: set[str]
) -> None:
    """Of two joints in series, somewhere on a moving arm and followed by a third one that has a mass of its own."""
    inside = [urdfs.limit()]
    urdf = urdfs.robot(
        *(urdfs.link(name, one) for name, one in {"base": 5, "arm": 2, "ring": mass, "tool": 1, "tip": 0.5}.items()),
        urdfs.joint("lift", "continuous", "base", "arm", axis="0.6 0 0.8", inside=inside),
        urdfs.joint("first", kind, "arm", "ring", axis=axis, inside=inside),
        urdfs.joint("second", next_kind, "ring", "tool", axis=next_axis, xyz=xyz, rpy="0 0 0.7", inside=inside),
        urdfs.joint("third", "revolute", "tool", "tip", axis="0 1 0", inside=inside),
    )
    assert yielding(skeleton(urdf)) == expected
    singular = np.linalg.cond(mass_matrix(urdf)) > 1e12
    assert singular == bool(expected)


def test_a_joint_that_others_follow_counts_as_fixed() -> None:
    """What follows moves a mass elsewhere, so the first joint does not move for nothing."""
    urdf = urdfs.robot(
        *(urdfs.link(name, mass) for name, mass in {"base": 5, "ring": None, "tool": 1, "other": 1}.items()),
        urdfs.joint("first", "continuous", "base", "ring", axis="0 0 1"),
        urdfs.joint("second", "continuous", "ring", "tool", axis="0 0 1", xyz="0 0 0.4", rpy="0 0 0"),
        urdfs.joint("third", "continuous", "base", "other", axis="0 0 1", inside=[urdfs.mimic("first")]),
    )
    assert yielding(skeleton(urdf)) == set()
    alone = urdf.replace(urdfs.mimic("first"), "")
    assert yielding(skeleton(alone)) == {"first"}


JOINTS = st.tuples(
    st.sampled_from(["revolute", "prismatic", "fixed"]),
    st.sampled_from(["1 0 0", "0 1 0", "0 0 1", "0.6 0 0.8"]),
    st.sampled_from(["0 0 0", "0 0 0.4", "0.3 0 0.4", "5 -3 2"]),
    st.sampled_from(["0 0 0", "0.5 -0.6 0.7"]),
    st.sampled_from([None, 0.01, 20]),
    st.booleans(),
)
"""Kind, axis, place and attitude of a joint, the mass that it moves, and whether it begins a branch."""


@given(st.lists(JOINTS, min_size=1, max_size=7))
def test_as_many_joints_give_way_as_the_mass_matrix_has_null_vectors(
    joints: list[tuple[str, str, str, str, float | None, bool]],
) -> None:
    links, moving = [urdfs.link("link 0", 1)], []
    for i, (kind, axis, xyz, rpy, mass, branch) in enumerate(joints, 1):
        parent, limits = f"link {max(0, i - 1 - branch)}", [urdfs.limit()]
        links.append(urdfs.link(f"link {i}", mass))
        moving.append(urdfs.joint(f"joint {i}", kind, parent, f"link {i}", axis=axis, xyz=xyz, rpy=rpy, inside=limits))
    urdf = urdfs.robot(*links, *moving)
    matrix = mass_matrix(urdf)
    sizes = np.sqrt(np.where(matrix.diagonal() > 0, matrix.diagonal(), 1))
    null = np.linalg.eigvalsh(matrix / np.outer(sizes, sizes)) < 1e-10
    assert len(yielding(skeleton(urdf))) == null.sum()
