"""The record of a whole robot: its structure, and its joints with every group that they have."""

from __future__ import annotations

import re
from typing import Any

import pytest
from hypothesis import given
from support.packages import record_components, record_text
from support.robots import robots, tree

from urdfsync.urdf.connectors import connector_names
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.record import record_data
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import (
    JOINT_KINDS,
    Calibration,
    Dynamics,
    Joint,
    JointType,
    Limit,
    Link,
    Mimic,
    Origin,
    Robot,
    SafetyController,
    Sphere,
    Visual,
)


@given(robots())
def test_the_matrices_say_what_the_tree_is(robot: Robot) -> None:
    skeleton, options = KinematicTree.of(robot), Options()
    connectors = connector_names(skeleton, options)
    found = record_data("", skeleton, connectors, {}, "Arm", options)
    names = [link["name"] for link in found["links"]]
    matrix = found["structure"]["connection_matrix"]
    assert {(names[parent - 1], names[child - 1]) for parent, child in matrix} == {
        (joint.parent, joint.child) for joint in robot.joints
    }
    moving = {found["joints"][number - 1]["joint"].name for number, _ in found["structure"]["moveable_joints"]}
    assert moving == {joint.name for joint in robot.joints if joint.type != "fixed"}


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


@pytest.mark.parametrize(("kind", "full", "bare"), [
    ("revolute", GROUPS, {"limits": UNLIMITED}),
    ("prismatic", GROUPS, {"limits": UNLIMITED}),
    ("continuous", GROUPS | {"limits": UNLIMITED.rpartition("= ")[0] + "= 30"}, {"limits": UNLIMITED}),
    ("planar", {"translation": LOSSES, "rotation": LOSSES}, {}),
    ("fixed", {}, {}),
    ("floating", {}, {}),
])  # fmt: skip
def test_a_joint_has_the_groups_of_its_type(kind: JointType, full: dict[str, str], bare: dict[str, str]) -> None:
    leader = Joint("leader", "revolute", "a", "l")
    for parts, groups in ((EVERYTHING, full), ({}, bare)):
        joint = Joint('a "b"', kind, "a", "b", Origin((1, 2, 3)), axis=(0, 0, 1), **parts)
        record, text = record_components(tree(leader, joint))["a__b_"]
        assert record == f"{kind.capitalize()}Joint"
        start = 'name = "a \\"b\\"", origin( xyz = {1, 2, 3}, rpy = {0, 0, 0})'
        assert text.startswith(f"{start}, axis = {{0, 0, 1}}" if JOINT_KINDS[kind].has_axis else start)
        found = re.findall(r"(\w+)\( ?([^()]*)\)", text)
        assert {name: numbers for name, numbers in found if name != "origin"} == groups


@pytest.mark.parametrize("other", ["aVisual1", "AVISUAL1"])
def test_a_visual_gives_way_to_an_element_of_its_name(other: str) -> None:
    text = record_text(
        Robot("r", (Link("a", visuals=(Visual(Sphere(1)),)), Link(other)), (Joint("j", "fixed", "a", other),))
    )
    assert "UrdfSync.Records.Sphere aVisual1_2(" in text
    assert "aVisual1_2.color" in text
