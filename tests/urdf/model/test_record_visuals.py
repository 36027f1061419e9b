"""The visuals in the record of a whole robot: their records, and the tables of the shapes that are drawn."""

from __future__ import annotations

import re
from collections.abc import Mapping

import pytest
from support.packages import RENDERER
from support.records import record_components, record_tables, record_text
from support.skeletons import skeleton

from urdfsync.domain import Artifact, Import, Target
from urdfsync.urdf.artifacts import artifacts
from urdfsync.urdf.meshes.lookup import key
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import (
    Box,
    Capsule,
    Cylinder,
    Geometry,
    Joint,
    Link,
    Material,
    Mesh,
    Origin,
    Robot,
    Sphere,
    Visual,
)

MESH = Mesh("a.stl")
IMPORT = Import("Resources/a_1.stl", "", "", 1, {"bounds": [[0, 0, 0], [1, 1, 1]], "hull": []})
FIELD = re.compile(r"(\w+) = (\{.*?\})(?=, \w+ =|\))")


def shown(name: str, *shapes: Geometry) -> Link:
    return Link(name, visuals=tuple(map(Visual, shapes)))


def table(robot: Robot) -> Mapping[str, str]:
    """The fields of `visuals`, each on one line."""
    (found,) = [text for text in record_tables(robot) if text.startswith("visuals(")]
    return dict(FIELD.findall(" ".join(found.split())))


def text_of(robot: Robot, imports: Mapping[str, Import]) -> str:
    files = artifacts(robot, imports, Target("Plant.Arm", "Arm"), Options(approach=("record",)))
    (found,) = (file for file in files if isinstance(file, Artifact) and file.path == "ArmParameters.mo")
    return RENDERER.render(found.template, found.data)


JOINT = Joint("j", "revolute", "a", "b")


def test_each_kind_of_shape_is_drawn_as_the_standard_library_does() -> None:
    links = (shown("a", Box((1, 2, 3)), Sphere(0.5)), shown("b", Cylinder(0.1, 2)))
    robot = Robot("r", links, (JOINT,))
    assert record_components(robot)["aVisual1"][0] == "Box"
    assert record_components(robot)["bVisual1"][0] == "Cylinder"
    assert "drawnShapes = 3" in record_tables(robot)
    assert table(robot) == {
        "links": "{1, 1, 2}",
        "kinds": '{ "box", "sphere", "cylinder"}',
        "lengthAxes": "{1, 3, 3}",
        "positions": "{ aVisual1.origin.xyz, aVisual2.origin.xyz, bVisual1.origin.xyz}",
        "angles": "{ aVisual1.origin.rpy, aVisual2.origin.rpy, bVisual1.origin.rpy}",
        "starts": "{ -0.5*aVisual1.size[1], -aVisual2.radius, -0.5*bVisual1.length}",
        "sizes": "{ {aVisual1.size[1], aVisual1.size[2], aVisual1.size[3]}, "
        "{2*aVisual2.radius, 2*aVisual2.radius, 2*aVisual2.radius}, "
        "{bVisual1.length, 2*bVisual1.radius, 2*bVisual1.radius}}",
        "colors": "{ aVisual1.color, aVisual2.color, bVisual1.color}",
    }


def test_a_capsule_is_drawn_as_a_cylinder_and_two_spheres() -> None:
    found = table(Robot("r", (shown("a", Capsule(0.1, 2)),)))
    assert found["links"] == "{1, 1, 1}"
    assert found["kinds"] == '{ "cylinder", "sphere", "sphere"}'
    assert found["starts"] == (
        "{ -0.5*aVisual1.length, -0.5*aVisual1.length - aVisual1.radius, 0.5*aVisual1.length - aVisual1.radius}"
    )


def test_place_colour_and_opacity_stand_in_the_record_of_the_visual() -> None:
    visual = Visual(Sphere(0.5), Origin((1, 2, 3), (0.1, 0.2, 0.3)), "ball", Material("red", (1, 0, 0, 0.25)))
    text = record_text(Robot("r", (Link("a", visuals=(visual,)),)))
    expected = "origin( xyz = {1, 2, 3}, rpy = {0.1, 0.2, 0.3}), radius = 0.5, color = {255, 0, 0}, opacity = 0.25)"
    assert expected in " ".join(text.split())
    assert '"Visual 1: \\"ball\\" of link \\"a\\""' in text


def test_a_mesh_is_addressed_in_the_package_and_one_that_was_never_found_is_left_out() -> None:
    robot = Robot("r", (shown("a", Mesh("lost.stl"), MESH, Sphere(1)),))
    text = text_of(robot, {key(MESH): IMPORT})
    assert 'uri = "modelica://Plant.Arm/Resources/a_1.stl"' in text
    assert "aVisual2.uri" in text
    assert "aVisual1" not in text
    assert "UrdfSync.Records.Sphere aVisual3(" in text
    assert "drawnShapes = 2," in text


def test_a_record_without_a_package_has_no_meshes() -> None:
    assert "aVisual" not in record_text(Robot("r", (shown("a", MESH),)))


def test_a_robot_without_visuals_has_no_table_of_them() -> None:
    assert not [text for text in record_tables(skeleton(JOINT)) if text.startswith(("visuals", "drawnShapes"))]


def test_where_the_generic_robot_can_not_read_the_record_the_visuals_are_there_without_tables() -> None:
    robot = Robot("r", (shown("a", Sphere(1)), Link("b")), (Joint("j", "floating", "a", "b"),))
    text = record_text(robot)
    assert "UrdfSync.Records.Sphere aVisual1(" in text
    assert "drawnShapes" not in text


@pytest.mark.parametrize("other", ["aVisual1", "AVISUAL1"])
def test_a_visual_gives_way_to_an_element_of_its_name(other: str) -> None:
    robot = Robot("r", (shown("a", Sphere(1)), Link(other)), (Joint("j", "fixed", "a", other),))
    text = record_text(robot)
    assert "UrdfSync.Records.Sphere aVisual1_2(" in text
    assert "aVisual1_2.color" in text


def test_the_text_grows_with_the_number_of_visuals() -> None:
    def length(count: int) -> int:
        return len(record_text(Robot("r", (shown("a", *[Box((1, 1, 1))] * count),))))

    small, middle, large = (length(count) for count in (200, 400, 800))
    assert large - middle == pytest.approx(2 * (middle - small), rel=0.01)
