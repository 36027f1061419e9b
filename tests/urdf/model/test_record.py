"""The record of a whole robot: its structure, its joints with every group that they have, its visuals."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import pytest
from hypothesis import given
from support.packages import RENDERER
from support.records import record_components, record_tables, record_text
from support.skeletons import skeleton
from support.trees import robots

from urdfsync.domain import Import, Target
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.meshes.lookup import key
from urdfsync.urdf.model.record import record_data
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import (
    JOINT_KINDS,
    Box,
    Calibration,
    Capsule,
    Cylinder,
    Dynamics,
    Geometry,
    Joint,
    JointType,
    Limit,
    Link,
    Mesh,
    Mimic,
    Origin,
    Robot,
    SafetyController,
    Sphere,
    Visual,
)

MESH = Mesh("a.stl")
IMPORT = Import("Resources/a_1.stl", "", "", 1, {"bounds": [[0, 0, 0], [1, 1, 1]], "hull": []})
FIELD = re.compile(r"(\w+) = (\{.*?\})(?=, \w+ =|\))")
JOINT = Joint("j", "revolute", "a", "b")


def data(tree: KinematicTree, imports: Mapping[str, Import] | None = None, **options: Any) -> dict[str, Any]:
    return record_data("the robot", tree, imports or {}, Target("Plant.Arm", "Arm"), Options(**options))


@given(robots())
def test_the_matrices_say_what_the_tree_is(robot: Robot) -> None:
    found = data(KinematicTree.of(robot))
    names = [link["name"] for link in found["links"]]
    matrix = found["structure"]["connection_matrix"]
    assert {(names[parent - 1], names[child - 1]) for parent, child in matrix} == {
        (joint.parent, joint.child) for joint in robot.joints
    }
    moving = {found["joints"][number - 1]["joint"].name for number, _ in found["structure"]["moveable_joints"]}
    assert moving == {joint.name for joint in robot.joints if joint.type != "fixed"}


# Joints

EVERYTHING: dict[str, Any] = {
    "limit": Limit(-1, 2, 30, None),
    "dynamics": Dynamics(0.5, 0),
    "mimic": Mimic("leader", -2, 0.1),
    "calibration": Calibration(rising=0.25),
    "safety_controller": SafetyController(10, 20, -0.5, 1.5),
}
LOSSES = "damping = 0.5, friction = 0"
GROUPS = {
    "limits": "lower = -1, upper = 2, velocity = Modelica.Constants.inf, effort = 30",
    "dynamics": LOSSES,
    "mimic": "multiplier = -2, offset = 0.1",
    "calibration": "rising = 0.25, falling = Modelica.Constants.inf",
    "safetyController": "k_velocity = 10, k_position = 20, soft_lower_limit = -0.5, soft_upper_limit = 1.5",
}
UNLIMITED = ", ".join(
    f"{name} = {sign}Modelica.Constants.inf"
    for name, sign in (("lower", "-"), ("upper", ""), ("velocity", ""), ("effort", ""))
)


@pytest.mark.parametrize(
    ("kind", "full", "bare"),
    [
        ("revolute", GROUPS, {"limits": UNLIMITED}),
        ("prismatic", GROUPS, {"limits": UNLIMITED}),
        ("continuous", GROUPS | {"limits": UNLIMITED.rpartition("= ")[0] + "= 30"}, {"limits": UNLIMITED}),
        ("planar", {"translation": LOSSES, "rotation": LOSSES}, {}),
        ("fixed", {}, {}),
        ("floating", {}, {}),
    ],
)
def test_a_joint_has_the_groups_of_its_type(kind: JointType, full: dict[str, str], bare: dict[str, str]) -> None:
    leader = Joint("leader", "revolute", "a", "l")
    for parts, groups in ((EVERYTHING, full), ({}, bare)):
        joint = Joint('a "b"', kind, "a", "b", Origin((1, 2, 3)), axis=(0, 0, 1), **parts)
        record, text = record_components(skeleton(leader, joint))["a__b_"]
        assert record == f"{kind.capitalize()}Joint"
        start = 'name = "a \\"b\\"", origin( xyz = {1, 2, 3}, rpy = {0, 0, 0})'
        assert text.startswith(f"{start}, axis = {{0, 0, 1}}" if JOINT_KINDS[kind].has_axis else start)
        found = re.findall(r"(\w+)\( ?([^()]*)\)", text)
        assert {name: numbers for name, numbers in found if name != "origin"} == groups


# Visuals


def shown(name: str, *shapes: Geometry) -> Link:
    return Link(name, visuals=tuple(map(Visual, shapes)))


def table(robot: Robot) -> Mapping[str, str]:
    """The fields of `visuals`, each on one line."""
    (found,) = [text for text in record_tables(robot) if text.startswith("visuals(")]
    return dict(FIELD.findall(" ".join(found.split())))


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
    assert (found["links"], found["kinds"]) == ("{1, 1, 1}", '{ "cylinder", "sphere", "sphere"}')
    assert found["starts"] == (
        "{ -0.5*aVisual1.length, -0.5*aVisual1.length - aVisual1.radius, 0.5*aVisual1.length - aVisual1.radius}"
    )


def test_a_mesh_is_addressed_in_the_package_and_one_that_was_never_found_is_left_out() -> None:
    tree = skeleton(links=(shown("a", Mesh("lost.stl"), MESH, Sphere(1)),))
    text = RENDERER.render("robot/record.mo.jinja", data(tree, {key(MESH): IMPORT}))
    assert 'uri = "modelica://Plant.Arm/Resources/a_1.stl"' in text
    assert "aVisual2.uri" in text
    assert "aVisual1" not in text
    assert "UrdfSync.Records.Sphere aVisual3(" in text
    assert "drawnShapes = 2," in text
    assert "aVisual" not in record_text(Robot("r", (shown("a", MESH),))), "without a package there are no meshes"


@pytest.mark.parametrize("other", ["aVisual1", "AVISUAL1"])
def test_a_visual_gives_way_to_an_element_of_its_name(other: str) -> None:
    text = record_text(Robot("r", (shown("a", Sphere(1)), Link(other)), (Joint("j", "fixed", "a", other),)))
    assert "UrdfSync.Records.Sphere aVisual1_2(" in text
    assert "aVisual1_2.color" in text
