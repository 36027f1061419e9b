"""Visuals and collisions as template data: numbered as in the URDF, in colours that tools take, meshes if found."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from urdfsync.domain import Import
from urdfsync.urdf.meshes.lookup import key
from urdfsync.urdf.model.shapes import GREY, PINK, Numbers, contacts, hull, looks, meshes, numbers
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import (
    Box,
    Collision,
    Geometry,
    Link,
    Material,
    Mesh,
    Origin,
    Sphere,
    Visual,
)

PACKAGE = "Plant.Arm"
MESH = Mesh("meshes/a.stl")
POINTS = [[0.0, 0.0, -1.0], [1.0, 0.0, 0.0]]


def imported(points: list[list[float]]) -> Mapping[str, Import]:
    facts = {"bounds": [[0.0, 0.0, -1.0], [1.0, 0.5, 0.0]], "hull": points}
    return {key(MESH): Import("Resources/a_12345678.stl", "", "", 1, facts)}


def visual_of(
    geometry: Geometry, material: Material | None = None, imports: Mapping[str, Import] | None = None
) -> Numbers:
    link = Link("l", visuals=(Visual(geometry, material=material),))
    visuals, _ = numbers(link, imports or {}, PACKAGE, Options())
    return visuals[0]


def test_a_mesh_has_a_modelica_uri_and_its_bounds() -> None:
    visual = visual_of(MESH, imports=imported(POINTS))
    assert visual.uri == "modelica://Plant.Arm/Resources/a_12345678.stl"
    assert [list(corner) for corner in visual.bounds] == [[0, 0, -1], [1, 0.5, 0]]


@pytest.mark.parametrize(
    ("material", "color", "opacity"),
    [
        (None, GREY, 1),
        (Material("textured", texture="t.png"), GREY, 1),
        (Material(rgba=(1, 0.5, 0, 0.25)), (255, 128, 0), 0.25),
        (Material(rgba=(1.5, -0.25, 1e300, 7)), (255, 0, 255), 1),
        (Material(rgba=(-1e300, 0, 0, -1)), (0, 0, 0), 0),
    ],
)
def test_colours_are_integers_that_tools_take(
    material: Material | None, color: tuple[int, ...], opacity: float
) -> None:
    visual = visual_of(Sphere(1), material)
    assert (visual.color, visual.opacity) == (color, opacity)


def test_shapes_keep_their_numbers_when_a_mesh_is_not_found() -> None:
    shapes: tuple[Geometry, ...] = (Sphere(1), MESH, Sphere(2))
    link = Link("l", visuals=tuple(map(Visual, shapes)), collisions=tuple(map(Collision, shapes)))
    for visuals, collisions in (looks(link, {}, Options()), numbers(link, {}, PACKAGE, Options())):
        assert [shape.component for shape in visuals] == ["visual1", "visual3"]
        assert [shape.component for shape in collisions] == ["collision1", "collision3"]
    visible, tangible = looks(link, {}, Options())
    assert [shape.y for shape in visible + tangible] == [30, 60, -30, -60]


def test_titles_tell_the_name_if_there_is_one() -> None:
    link = Link("l", visuals=(Visual(Sphere(1)), Visual(Sphere(1), name='a "b"')), collisions=(Collision(Sphere(1)),))
    visuals, collisions = numbers(link, {}, PACKAGE, Options())
    assert [shape.title for shape in visuals + collisions] == ["Visual 1", 'Visual 2: "a "b""', "Collision 1"]
    assert collisions[0].color == PINK


def test_collisions_can_be_left_out() -> None:
    link = Link("l", visuals=(Visual(Sphere(1)),), collisions=(Collision(Sphere(1)),))
    hidden = Options(collisions=False)
    for visuals, collisions in (looks(link, {}, hidden), numbers(link, {}, PACKAGE, hidden)):
        assert (len(visuals), len(collisions)) == (1, 0)


@pytest.mark.parametrize(("base", "points"), [("fixed", ()), ("floating", POINTS)])
def test_only_what_stands_on_the_ground_needs_a_hull(base: str, points: object) -> None:
    link = Link("l", visuals=(Visual(MESH),), collisions=(Collision(MESH),))
    visuals, collisions = numbers(link, imported(POINTS), PACKAGE, Options(base=base))  # type: ignore[arg-type]
    assert visuals[0].hull == ()
    assert collisions[0].hull == points


def test_every_collision_touches_the_ground_but_a_mesh_without_points() -> None:
    shapes = tuple(Collision(shape, Origin()) for shape in (Box((1, 1, 1)), MESH, Sphere(1)))
    options = Options(base="floating")

    def touching(points: list[list[float]]) -> list[tuple[str, str, int]]:
        _, collisions = looks(Link("l", collisions=shapes), imported(points), options)
        return [(contact.component, contact.type, contact.y) for contact in contacts(collisions)]

    assert touching(POINTS) == [("contact1", "Box", -30), ("contact2", "Points", -60), ("contact3", "Sphere", -90)]
    assert touching([]) == [("contact1", "Box", -30), ("contact3", "Sphere", -90)]


def test_without_a_ground_nothing_touches_it() -> None:
    _, collisions = looks(Link("l", collisions=(Collision(Sphere(1)),)), {}, Options())
    assert contacts(collisions) == []


def test_the_imports_of_shapes_are_those_that_they_show() -> None:
    found, others = imported(POINTS), {"b.stl": imported([])[key(MESH)]}
    assert meshes([Visual(MESH), Visual(Sphere(1)), Visual(Mesh("c.stl"))], {**found, **others}) == found
    assert meshes([Visual(MESH)], {}) == {}


def test_the_hull_is_that_of_the_import() -> None:
    assert hull(MESH, imported(POINTS)) == POINTS
    assert hull(MESH, {}) == hull(Sphere(1), imported(POINTS)) == ()
