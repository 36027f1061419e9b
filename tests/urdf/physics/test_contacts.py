"""How a robot stands, against figures that follow by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from support.urdfs import parsed, robot

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.physics.contacts import Stand, stand

WEIGHT = 300.0
DEPTH = 3e-4
"""Of one point that carries the weight alone, on the library's ground."""


def standing(*shapes: str, contact: str = "") -> Stand | None:
    """A link with these collisions, each a shape and its place."""
    collisions = "".join(
        f'<collision><origin xyz="{xyz}"/><geometry><{shape}/></geometry></collision>'
        for shape, _, xyz in (each.partition(" at ") for each in shapes)
    )
    words = f'<gazebo reference="base">{contact}</gazebo>' if contact else ""
    tree = KinematicTree.of(parsed(robot(f'<link name="base">{collisions}</link>', words)))
    return stand(tree, {}, WEIGHT)


@pytest.mark.parametrize(
    ("shape", "lowest", "points"),
    [
        ('box size="0.6 0.4 0.2"', -0.1, 4),
        ('sphere radius="0.1"', -0.1, 1),
        ('cylinder radius="0.1" length="0.4"', -0.2, 5),
        ('capsule radius="0.1" length="0.4"', -0.3, 1),
        ('ellipsoid radii="0.3 0.2 0.1"', -0.1, 1),
    ],
)
def test_points_share_the_weight(shape: str, lowest: float, points: int) -> None:
    feet = standing(f"{shape} at 0 0 0")
    assert feet is not None
    assert (feet.lowest, feet.depth) == pytest.approx((lowest, DEPTH / points))
    assert feet.wrench() == pytest.approx([0, 0, WEIGHT, 0, 0, 0])


def test_a_lying_capsule_stands_on_both_ends() -> None:
    feet = standing(f'capsule radius="0.1" length="0.4" at 0 0 0" rpy="0 {math.pi / 2} 0')
    assert feet is not None
    assert (feet.lowest, feet.depth) == pytest.approx((-0.1, DEPTH / 2))
    assert feet.wrench() == pytest.approx([0, 0, WEIGHT, 0, 0, 0], abs=1e-9)


def test_a_tilted_ellipsoid_stands_beside_its_centre() -> None:
    """In the plane of x and z its surface is (x / 0.3)² + (z / 0.1)² = 1, where a line of slope 3/4 touches it."""
    feet = standing(f'ellipsoid radii="0.3 0.2 0.1" at 0 0 0" rpy="0 {-math.atan2(3, 4)} 0')
    assert feet is not None
    along, across = 0.3**2 * 0.6, 0.1**2 * 0.8
    depth = math.sqrt(0.6 * along + 0.8 * across)
    assert feet.lowest == pytest.approx(-depth)
    beside = (0.6 * across - 0.8 * along) / depth
    assert feet.wrench() == pytest.approx([0, 0, WEIGHT, 0, -beside * WEIGHT, 0])


def test_a_flat_ellipsoid_has_no_lowest_point_but_a_height() -> None:
    feet = standing('ellipsoid radii="0.3 0.2 0" at 0 0 0')
    assert feet is not None
    assert feet.lowest == 0


@pytest.mark.parametrize(("sine", "weight"), [(0.2, 0.0), (0.075, 0.75)])
def test_a_tilted_cylinder_moves_from_its_end_to_its_rim(sine: float, weight: float) -> None:
    """The lowest point of the rim counts once for the rim, and with this weight for the end."""
    feet = standing(f'cylinder radius="0.1" length="0.4" at 0 0 0" rpy="0 {math.asin(sine)} 0')
    assert feet is not None
    assert feet.depth == pytest.approx(DEPTH / (1 + weight), rel=1e-2)


def test_a_higher_point_carries_less() -> None:
    """Depths p and p - 0.1 mm on springs of 1 N/µm: p is 0.2 mm."""
    feet = standing('sphere radius="0.1" at 0 0 0', 'sphere radius="0.1" at 1 0 0.0001', contact="<kp>1e6</kp>")
    assert feet is not None
    assert feet.depth == pytest.approx(2e-4)


def test_the_ground_brakes_resists_and_never_pulls() -> None:
    feet = standing('sphere radius="0.1" at 0 0 0', contact="<mu1>0.5</mu1>")
    assert feet is not None
    assert feet.wrench(slide=(30, 40)) == pytest.approx([-90, -120, WEIGHT, -12, 9, 0])
    assert feet.wrench(rise=-0.01)[2] > 1.3 * WEIGHT
    assert feet.wrench(rise=1) == pytest.approx([0] * 6)


def test_a_tilted_box_stands_on_an_edge() -> None:
    feet = standing('box size="0.6 0.4 0.2" at 0 0 0')
    assert feet is not None
    tilted = np.array([[0.96, 0, 0.28], [0, 1, 0], [-0.28, 0, 0.96]])
    wrench = feet.wrench(axes=tilted)
    depth = DEPTH / 4 - 0.1 + 0.3 * 0.28 + 0.1 * 0.96
    assert tilted @ wrench[:3] == pytest.approx([0, 0, 2 * WEIGHT * depth / DEPTH], abs=1e-9)
    assert wrench[3:] == pytest.approx(np.cross([0.3, 0, -0.1], wrench[:3]))


def test_a_force_beside_the_origin_turns_the_robot() -> None:
    """Its lever ends at the shape, however deep that may be without a force."""
    feet = standing('sphere radius="0.1" at 0.2 0.3 0', contact="<mu1>0.5</mu1><minDepth>0.01</minDepth>")
    assert feet is not None
    assert feet.wrench(slide=(30, 40))[3:] == pytest.approx([78, -51, 3])


def test_a_robot_that_touches_nothing_does_not_stand() -> None:
    assert standing() is None
