"""What resists the motion of joints is the diagonal of the mass matrix, which Pinocchio finds in another way."""

from __future__ import annotations

import numpy as np
import pinocchio
import pytest
from support import urdfs

from urdfsync.urdf.kinematics import start_positions
from urdfsync.urdf.resistance import resistances
from urdfsync.urdf.skeleton import Skeleton
from urdfsync.urdf.source import read_robot

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


def skeleton(urdf: str) -> Skeleton:
    robot = read_robot(urdf.encode(), "own.urdf", cross_check=False).robot
    assert robot is not None
    return Skeleton.of(robot)


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
