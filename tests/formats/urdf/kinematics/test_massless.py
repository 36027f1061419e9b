"""Joints that move no mass make the mass matrix singular, which Pinocchio computes in its own way."""

from __future__ import annotations

import numpy as np
import pinocchio
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from support import urdfs

from urdfsync.formats.urdf.kinematics.massless import find_massless_joints
from urdfsync.formats.urdf.kinematics.tree import KinematicTree


def found(urdf: str, free: set[str] | None = None) -> list[str]:
    return list(find_massless_joints(KinematicTree.of(urdfs.parsed(urdf)), free))


def is_singular(urdf: str) -> bool:
    """By Pinocchio, all joints at zero."""
    model = pinocchio.buildModelFromXML(urdf)
    upper = np.triu(pinocchio.crba(model, model.createData(), pinocchio.neutral(model)))
    matrix: NDArray[np.float64] = upper + np.triu(upper, 1).T
    sizes = np.sqrt(np.where(matrix.diagonal() > 0, matrix.diagonal(), 1))
    return bool((np.linalg.eigvalsh(matrix / np.outer(sizes, sizes)) < 1e-10).any())


# What two joints in series, with a ring of some mass between them, are and where the second is.
PAIRS = {
    "coaxial": ("continuous", "0 0 1", "0 0 0.4", "continuous", "0 0 1", None, ["first"]),
    "opposed": ("continuous", "0 0 1", "0 0 0.4", "continuous", "0 0 -1", None, ["first"]),
    "along": ("prismatic", "0 0 1", "0.3 0 0.4", "prismatic", "0 0 1", None, ["first"]),
    "off the axis": ("continuous", "0 0 1", "0.3 0 0.4", "continuous", "0 0 1", None, []),
    "across": ("continuous", "0 0 1", "0 0 0.4", "continuous", "0 1 0", None, []),
    "other kind": ("continuous", "0 0 1", "0 0 0.4", "prismatic", "0 0 1", None, []),
    "a mass between": ("continuous", "0 0 1", "0 0 0.4", "continuous", "0 0 1", 1e-3, []),
}


@pytest.mark.parametrize(("first", "second", "expected"), [
    ("", "", ["first"]), ("0.1", "", []), ("", "0.1", []), ("0", "0", ["first"]),
])  # fmt: skip
def test_a_drive_with_inertia_is_a_mass(first: str, second: str, expected: list[str]) -> None:
    """Two joints on one axis with nothing between them."""
    inside = [[f'<dynamics damping="0" armature="{value}"/>'] if value else [] for value in (first, second)]
    urdf = urdfs.robot(
        *urdfs.links(base=5.0, ring=None, tool=1.0),
        urdfs.joint("first", "continuous", "base", "ring", axis="0 0 1", inside=inside[0]),
        urdfs.joint(
            "second", "continuous", "ring", "tool", axis="0 0 1", xyz="0 0 0.4", rpy="0 0 0.7", inside=inside[1]
        ),
    )
    assert found(urdf) == expected


@pytest.mark.parametrize(
    ("kind", "axis", "xyz", "next_kind", "next_axis", "mass", "expected"), PAIRS.values(), ids=PAIRS
)
def test_joints_on_one_axis(
    kind: str, axis: str, xyz: str, next_kind: str, next_axis: str, mass: float | None, expected: list[str]
) -> None:
    """Somewhere on a moving arm, and followed by a third joint that has a mass of its own."""
    urdf = urdfs.robot(
        *(urdfs.link(name, one) for name, one in {"base": 5, "arm": 2, "ring": mass, "tool": 1, "tip": 0.5}.items()),
        urdfs.joint("lift", "continuous", "base", "arm", axis="0.6 0 0.8"),
        urdfs.joint("first", kind, "arm", "ring", axis=axis),
        urdfs.joint("second", next_kind, "ring", "tool", axis=next_axis, xyz=xyz, rpy="0 0 0.7"),
        urdfs.joint("third", "revolute", "tool", "tip", axis="0 1 0"),
    )
    assert found(urdf) == expected
    assert is_singular(urdf) == bool(expected)
    assert found(urdf, free={"first", "second", "other"}) == expected
    assert found(urdf, free={"first"}) == found(urdf, free={"second"}) == []


def test_a_joint_that_others_follow_moves_their_masses() -> None:
    urdf = urdfs.robot(
        *(urdfs.link(name, mass) for name, mass in {"base": 5, "ring": None, "tool": 1, "other": 1}.items()),
        urdfs.joint("first", "continuous", "base", "ring", axis="0 0 1"),
        urdfs.joint("second", "continuous", "ring", "tool", axis="0 0 1", xyz="0 0 0.4", rpy="0 0 0"),
        urdfs.joint("third", "continuous", "base", "other", axis="0 0 1", inside=[urdfs.mimic("first")]),
    )
    assert found(urdf) == []
    assert found(urdf.replace(urdfs.mimic("first"), urdfs.mimic("first", 0.0))) == []
    assert found(urdf.replace(urdfs.mimic("first"), "")) == ["first"]


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
def test_whoever_is_named_makes_the_mass_matrix_singular(
    joints: list[tuple[str, str, str, str, float | None, bool]],
) -> None:
    links, moving = [urdfs.link("link 0", 1)], []
    for i, (kind, axis, xyz, rpy, mass, branch) in enumerate(joints, 1):
        parent = f"link {max(0, i - 1 - branch)}"
        links.append(urdfs.link(f"link {i}", mass))
        moving.append(urdfs.joint(f"joint {i}", kind, parent, f"link {i}", axis=axis, xyz=xyz, rpy=rpy))
    urdf = urdfs.robot(*links, *moving)
    assert is_singular(urdf) or not found(urdf)
