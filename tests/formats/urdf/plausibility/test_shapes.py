"""The sizes of shapes, and shapes in another unit than the robot."""

from __future__ import annotations

import math

import msgspec
import pytest
from support.robots import tree

from urdfsync.domain import Import, Version
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.meshes.lookup import key
from urdfsync.formats.urdf.plausibility.shapes import find_bodies
from urdfsync.formats.urdf.robot import (
    Box,
    Capsule,
    Cylinder,
    Ellipsoid,
    Joint,
    Link,
    Mesh,
    Origin,
    Primitive,
    Robot,
    Sphere,
    Vector,
    Visual,
)


@pytest.mark.parametrize(("shape", "reach", "volume"), [
    (Box((2, 4, 4)), 3, 32),
    (Cylinder(3, 8), 5, 72 * math.pi),
    (Capsule(3, 8), 7, 108 * math.pi),
    (Sphere(3), 3, 36 * math.pi),
    (Ellipsoid((1, 9, 3)), 9, 36 * math.pi),
])  # fmt: skip
def test_a_shape_has_a_reach_and_a_volume(shape: Primitive, reach: float, volume: float) -> None:
    ((extent,),) = (
        body.visuals for body in find_bodies(tree(links=(Link("a", visuals=(Visual(shape),)),)), {}, 0).values()
    )
    assert (extent.center, extent.reach) == ((0, 0, 0), reach)
    assert extent.volume == pytest.approx(volume)


@pytest.mark.parametrize(("size", "scale", "hint"), [
    (300.0, (1.0, 1.0, 1.0), 'write scale="0.001 0.001 0.001", or export it in m'),
    (300.0, (-1.0, 1.0, 1.0), 'write scale="-0.001 0.001 0.001", or export it in m'),
    (1e9, (1.0, 1.0, 1.0), "export it in m"),
    (1.5, (1.0, 1.0, 1.0), ""),
])  # fmt: skip
def test_a_mesh_that_is_far_larger_than_the_robot_is_told(size: float, scale: Vector, hint: str) -> None:
    """The robot is 0.05 m long: two joints, one after the other."""
    arm = Robot("r", tuple(map(Link, "abc")), tuple(
        Joint(name, "fixed", name[0], name[1], Origin((0.015, 0.02, 0.0))) for name in ("ab", "bc")
    ))  # fmt: skip
    mesh = Mesh("a.stl", scale)
    shaped = msgspec.structs.replace(arm, links=(Link("a", visuals=(Visual(mesh),)), *arm.links[1:]))
    imports = {key(mesh): Import("a.stl", "", "", {"bounds": [[0, 0, 0], [size, 0, 0]]})}
    found = DOMAIN.judgements.judge(Version(shaped, imports))
    expected = [("mesh-size", hint, "link a / visual 1 / geometry")] if hint else []
    assert [(finding.code, finding.hint, finding.element) for finding in found] == expected
    alone = Robot("r", (Link("a", visuals=(Visual(mesh),)),))
    assert not list(DOMAIN.judgements.judge(Version(alone, imports))), "a robot of one link has no length"
