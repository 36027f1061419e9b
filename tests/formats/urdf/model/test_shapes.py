"""Visuals and collisions as template data: numbered as in the URDF, in colours that tools take, meshes if found."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from support.robots import any_number, origin, tree

from urdfsync.domain import Import
from urdfsync.formats.urdf.kinematics.poses import pose
from urdfsync.formats.urdf.meshes.lookup import key
from urdfsync.formats.urdf.model.shapes import GREY, DrawnShape, link_model, link_shapes, standing_height
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Ellipsoid,
    Geometry,
    Joint,
    Limit,
    Link,
    Material,
    Mesh,
    Origin,
    Primitive,
    Sphere,
    Visual,
)

Array = NDArray[np.float64]

SIZES = st.floats(0.01, 3)
ORIGINS = st.randoms(use_true_random=False).map(lambda random: origin(random, any_number))
MESH = Mesh("meshes/a.stl")
POINTS = [[0.0, 0.0, -1.0], [1.0, 0.0, 0.0]]


def imported(points: list[list[float]]) -> Mapping[str, Import]:
    facts = {"bounds": [[0.0, 0.0, -1.0], [1.0, 0.5, 0.0]], "hull": points}
    return {key(MESH): Import("Resources/a_12345678.stl", "", "", facts)}


def shapes_of(
    *geometries: Geometry, imports: Mapping[str, Import] | None = None, **options: Any
) -> tuple[list[DrawnShape], list[DrawnShape]]:
    link = Link("l", visuals=tuple(map(Visual, geometries)), collisions=tuple(map(Collision, geometries)))
    return link_shapes(link, imports or {}, "Plant.Arm", Options(**options))


@pytest.mark.parametrize(("material", "color", "opacity"), [
    (None, GREY, 1),
    (Material("textured"), GREY, 1),
    (Material(rgba=(1, 0.5, 0, 0.25)), (255, 128, 0), 0.25),
    (Material(rgba=(1.5, -0.25, 1e300, 7)), (255, 0, 255), 1),
])  # fmt: skip
def test_colours_are_integers_that_tools_take(
    material: Material | None, color: tuple[int, ...], opacity: float
) -> None:
    link = Link("l", visuals=(Visual(Sphere(1), name='a "b"', material=material),))
    ((visual,), _) = link_shapes(link, {}, "Arm", Options())
    assert (visual.color, visual.opacity, visual.title) == (color, opacity, 'Visual 1: "a "b""')


@pytest.mark.parametrize(("base", "points", "names"), [
    ("floating", POINTS, ["contact1 Box", "contact2 Points", "contact3 Sphere"]),
    ("floating", [], ["contact1 Box", "contact3 Sphere"]),
    ("fixed", POINTS, []),
])  # fmt: skip
def test_every_collision_touches_the_ground_but_a_mesh_without_points(
    base: str, points: list[list[float]], names: list[str]
) -> None:
    visuals, collisions = shapes_of(Box((1, 1, 1)), MESH, Sphere(1), imports=imported(points), base=base)
    contacts = link_model(visuals, collisions)["contacts"]
    assert [f"{contact['component']} {contact['type']}" for contact in contacts] == names


def body(name: str, *shapes: Geometry) -> Link:
    return Link(name, collisions=tuple(map(Collision, shapes)))


def circle(radius: float, height: float) -> Array:
    angles = np.linspace(0, 2 * math.pi, 241)
    return np.stack([radius * np.cos(angles), radius * np.sin(angles), np.full_like(angles, height)], axis=1)


def ball(radius: float, height: float) -> Array:
    elevations = np.linspace(-math.pi / 2, math.pi / 2, 121)
    rings = [circle(radius * math.cos(e), radius * math.sin(e) + height) for e in elevations]
    return np.concatenate(rings)


def surface(shape: Primitive) -> Array:
    """Points of a shape, dense where it may touch a plane."""
    match shape:
        case Box(size=size):
            return np.array(np.meshgrid(*([-edge / 2, edge / 2] for edge in size))).reshape(3, -1).T
        case Sphere(radius=radius):
            return ball(radius, 0)
        case Ellipsoid(radii=radii):
            return ball(1, 0) * radii
        case Cylinder(radius=radius, length=length):
            return np.concatenate([circle(radius, end * length / 2) for end in (-1, 1)])
        case Capsule(radius=radius, length=length):
            return np.concatenate([ball(radius, end * length / 2) for end in (-1, 1)])


SHAPES = st.one_of(
    st.builds(Box, st.tuples(SIZES, SIZES, SIZES)),
    st.builds(Sphere, SIZES),
    st.builds(Cylinder, SIZES, SIZES),
    st.builds(Capsule, SIZES, SIZES),
    st.builds(Ellipsoid, st.tuples(SIZES, SIZES, SIZES)),
)


@pytest.mark.slow
@settings(deadline=None, max_examples=50)
@given(SHAPES, ORIGINS)
@example(Cylinder(0.3, 0.1), Origin((0, 0, 1), (math.pi / 2, 0, 0)))
def test_the_lowest_point_is_that_of_the_surface(shape: Primitive, origin: Origin) -> None:
    rotation, place = map(np.array, pose(origin))
    lowest = (surface(shape) @ rotation.T + place)[:, 2].min()
    height = standing_height(tree(links=(Link("a", collisions=(Collision(shape, origin),)),)), {})
    assert height is not None
    assert -height <= lowest + 1e-11
    assert -height >= lowest - 1e-3 * (1 + np.abs(surface(shape)).max())


def test_joints_are_at_their_start_and_shapes_turn_with_them() -> None:
    leg = Joint("leg", "prismatic", "a", "b", Origin((0, 0, -1)), axis=(0, 0, -1), limit=Limit(0.5, 2))
    assert standing_height(tree(leg, links=(body("a", Sphere(0.1)), body("b", Sphere(0.25)))), {}) == 1.75
    wheel = Joint("wheel", "continuous", "a", "b", Origin((0, 0, -1), (math.pi / 2, 0, 0)), axis=(0, 0, 1))
    assert standing_height(tree(wheel, links=(Link("a"), body("b", Cylinder(0.25, 0.05)))), {}) == 1.25


def test_there_is_no_height_without_a_shape_or_beyond_all_numbers() -> None:
    assert standing_height(tree(links=(body("a", MESH),)), {}) is None
    joints = [Joint(b, "fixed", a, b, Origin((0, 0, 1.7e308))) for a, b in ("ab", "bc")]
    assert standing_height(tree(*joints, links=(body("c", Sphere(1)),)), {}) is None
