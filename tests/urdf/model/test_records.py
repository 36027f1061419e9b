"""Template data of the record of a whole robot, and the height that a mobile one stands at."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import pytest
from hypothesis import given
from support.skeletons import GRIPPER, skeleton
from support.trees import robots

from urdfsync.domain import Artifact, Import, Target
from urdfsync.urdf.artifacts import artifacts
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.meshes.lookup import key
from urdfsync.urdf.model.records import record_axes
from urdfsync.urdf.model.stance import standing_height
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import (
    Box,
    Collision,
    Cylinder,
    Geometry,
    Inertial,
    Joint,
    Limit,
    Link,
    Mesh,
    Origin,
    Robot,
    Sphere,
)

TARGET = Target("Plant.Arm", "Arm")


def body(name: str, *shapes: Geometry) -> Link:
    return Link(name, Inertial(1.0), collisions=tuple(map(Collision, shapes)))


def record(robot: KinematicTree, **options: Any) -> Mapping[str, Any]:
    chosen = Options(approach=("record",), **options)
    files = artifacts(Robot("the robot", robot.links, robot.joints), {}, TARGET, chosen)
    (found,) = (file for file in files if isinstance(file, Artifact) and file.path == "ArmParameters.mo")
    return {**found.data["structure"], **found.data}


def test_tables_count_from_one_in_canonical_order() -> None:
    found = record(GRIPPER)
    assert [link.name for link in found["links"]] == ["base", "palm", "camera", "lens", "right", "left", "gear"]
    assert [joint.joint.name for joint in found["joints"]] == ["turn", "mount", "lock", "other", "slide", "pinion"]
    assert found["connection_matrix"] == [(1, 2), (2, 3), (3, 4), (2, 5), (2, 6), (6, 7)]
    assert found["moveable_joints"] == [(1, 1), (3, 1), (4, 1), (5, 1), (6, 1)]
    assert found["name"] == "the robot"


@given(robots())
def test_the_tables_say_what_the_tree_is(robot: Robot) -> None:
    found = record(KinematicTree.of(robot))
    names = [link.name for link in found["links"]]
    ends = {(names[parent - 1], names[child - 1]) for parent, child in found["connection_matrix"]}
    assert ends == {(joint.parent, joint.child) for joint in robot.joints}
    moving = {found["joints"][number - 1].joint.name for number, _ in found["moveable_joints"]}
    assert moving == {joint.name for joint in robot.joints if joint.type != "fixed"}
    assert all(child == row + 1 for row, (_, child) in enumerate(found["connection_matrix"], start=1))


def test_only_joints_that_follow_nothing_have_an_axis_in_the_record() -> None:
    axes = [(axis.constant, axis.vector, axis.number) for axis in record_axes(GRIPPER)]
    assert axes == [("turnAxis", "rotationalAxis", 1), ("slideAxis", "translationalAxis", 1)]
    assert record_axes(skeleton(Joint("j", "fixed", "a", "b"))) == []


@pytest.mark.parametrize(("shape", "height"), [(Sphere(0.3), 0.3), (Box((1, 1, 0.5)), 0.25), (Cylinder(0.2, 0.6), 0.3)])
def test_a_body_stands_on_its_lowest_shape(shape: Geometry, height: float) -> None:
    assert standing_height(skeleton(links=(body("a", Sphere(0.1), shape),)), {}) == pytest.approx(height, abs=1e-12)


def test_all_joints_are_at_their_start() -> None:
    leg = Joint("leg", "prismatic", "a", "b", Origin((0, 0, -1)), axis=(0, 0, -1), limit=Limit(0.5, 2))
    robot = skeleton(leg, links=(body("a", Sphere(0.1)), body("b", Sphere(0.25))))
    assert standing_height(robot, {}) == 1.75
    wheel = Joint("wheel", "continuous", "a", "b", Origin((0, 0, -1), (math.pi / 2, 0, 0)), axis=(0, 0, 1))
    robot = skeleton(wheel, links=(Link("a"), body("b", Cylinder(0.25, 0.05))))
    assert standing_height(robot, {}) == 1.25


def test_a_mesh_stands_on_its_hull_if_it_has_one() -> None:
    mesh = Mesh("a.stl")
    robot = skeleton(links=(body("a", mesh),))
    found = Import("Resources/a.stl", "", "", 1, {"bounds": [], "hull": [[0, 0, -0.75], [0, 0, 1]]})
    assert standing_height(robot, {key(mesh): found}) == 0.75
    assert standing_height(robot, {}) is None


def test_there_is_no_height_without_a_shape_or_beyond_all_numbers() -> None:
    assert standing_height(skeleton(links=(Link("a"),)), {}) is None
    ends = (("a", "b"), ("b", "c"))
    joints = [Joint(child, "fixed", parent, child, Origin((0, 0, 1.7e308))) for parent, child in ends]
    assert standing_height(skeleton(*joints, links=(body("c", Sphere(1)),)), {}) is None


def test_only_a_mobile_robot_has_a_height() -> None:
    robot = skeleton(links=(body("a", Sphere(0.5)),))
    assert record(robot, base="fixed")["standing_height"] is None
    assert record(robot, base="floating")["standing_height"] == 0.5
