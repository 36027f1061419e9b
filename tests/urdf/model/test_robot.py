"""Template data of the robot model: connectors by name, parts, couplings, and a place for each of them."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from support.skeletons import GRIPPER, skeleton
from support.trees import robots

from urdfsync.domain import Target
from urdfsync.urdf.kinematics.tree import MOTION_KINDS, KinematicTree
from urdfsync.urdf.model.connectors import connectors
from urdfsync.urdf.model.robot import connector_names, couplings, robot_data, tree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Inertial, Joint, JointType, Limit, Link, Mimic, Origin, Robot

TARGET = Target("Plant.Arm", "Arm")


def data(robot: KinematicTree) -> dict[str, Any]:
    return robot_data(robot, TARGET, Options())


def test_only_joints_that_follow_nothing_can_be_driven() -> None:
    drives = [(drive.axis, drive.support, drive.motion) for drive in data(GRIPPER)["drives"]]
    assert drives == [("turnAxis", "turnSupport", "rotational"), ("slideAxis", "slideSupport", "translational")]
    assert data(skeleton(Joint("j", "fixed", "a", "b")))["drives"] == []


def test_each_leaf_has_a_frame_of_its_own() -> None:
    assert [(frame.connector, frame.name) for frame in data(GRIPPER)["frames"]] == [
        ("lensFrame", "lens"),
        ("rightFrame", "right"),
        ("gearFrame", "gear"),
    ]


def test_a_connector_gives_way_to_an_element_and_keeps_its_file() -> None:
    robot = skeleton(
        Joint("elbow", "revolute", "elbowAxis", "hand"),
        Joint("wrist", "revolute", "hand", "handFrame"),
        Joint("follow", "revolute", "handFrame", "followMimic", mimic=Mimic("elbow")),
        Joint("elbowAxis_2", "fixed", "handFrame", "elbowSupport"),
    )
    assert robot.joint("elbow").type == "Elbow"
    assert robot.link("elbowAxis").type == "ElbowAxis"
    names = connectors(robot, ["hand", "handFrame"])
    assert names.axes == {"elbow": "elbowAxis_3", "wrist": "wristAxis"}
    assert names.supports == {"elbow": "elbowSupport_2", "wrist": "wristSupport"}
    assert names.frames == {"hand": "handFrame_2", "handFrame": "handFrameFrame"}
    assert names.couplings == {"follow": "followMimic_2"}


def test_a_connector_never_has_a_name_that_all_robots_have() -> None:
    robot = skeleton(Joint("rotational", "continuous", "a", "b"))
    assert connectors(robot, []).axes == {"rotational": "rotationalAxis_2"}


@given(robots())
def test_no_two_components_have_one_name(robot: Robot) -> None:
    found = KinematicTree.of(robot)
    names = connectors(found, [link.name for link in found.links])
    beside = [*names.frames.values(), *names.axes.values(), *names.supports.values(), *names.couplings.values()]
    every = [name.lower() for name in (*beside, *(identifier.component for identifier in found.names.values()))]
    assert len(every) == len(set(every))


def test_every_pairing_has_its_coupling() -> None:
    names = connector_names(GRIPPER, Options())
    found = {
        entry.follower: (entry.component, entry.leader_motion, entry.follower_motion, entry.leader)
        for entry in couplings(GRIPPER, names)
    }
    assert found == {
        "other": ("otherMimic", "translational", "translational", "slide"),
        "pinion": ("pinionMimic", "translational", "rotational", "other"),
        "lock": ("lockMimic", None, "rotational", None),
    }


def test_joints_know_what_they_follow_and_what_follows_them() -> None:
    joints = {joint.component: joint for joint in data(GRIPPER)["joints"]}
    assert joints["slide"].followers == ("otherMimic",)
    assert joints["slide"].follows is None
    assert joints["other"].followers == ("pinionMimic",)
    follows = {name: joint.follows for name, joint in joints.items() if joint.follows}
    assert {name: (entry.leader, entry.leader_motion) for name, entry in follows.items()} == {
        "other": ("slide", "translational"),
        "pinion": ("other", "translational"),
        "lock": (None, None),
    }


@pytest.mark.parametrize("kind", ["fixed", "planar", "floating"])
def test_joints_without_an_axis_have_no_flanges(kind: JointType) -> None:
    found = data(skeleton(Joint("j", kind, "a", "b")))
    assert found["joints"][0].axis is None
    assert found["drives"] == []


@given(robots())
def test_the_robot_model_has_every_element_once_and_a_place_for_each(robot: Robot) -> None:
    found = data(KinematicTree.of(robot))
    names = [entry.component for kind in ("links", "joints", "couplings") for entry in found[kind]]
    assert len(set(names)) == len(robot.links) + len(robot.joints) + sum(
        joint.mimic is not None and joint.type in MOTION_KINDS for joint in robot.joints
    )
    flanges = [name for drive in found["drives"] for name in (drive.axis, drive.support)]
    frames = [frame.connector for frame in found["frames"]]
    assert sorted(found["diagram"]) == sorted([*names, *flanges, *frames, "frame_a"])
    assert len(frames) == len(robot.links) - len({joint.parent for joint in robot.joints})


@given(robots())
def test_rows_on_the_icon_stand_over_the_picture_and_below_its_top(robot: Robot) -> None:
    found = data(KinematicTree.of(robot))
    for row in (*found["drives"], *found["frames"]):
        assert 100 < row.y - 10 < row.y < found["top"]


def test_a_link_may_be_named_as_what_templates_say_of_diagrams() -> None:
    found = data(skeleton(Joint("items", "fixed", "extent", "keys")))
    assert found["extent"] != found["diagram"]["extent"]
    assert {"extent", "items", "keys"} < found["diagram"].keys()


def test_no_number_of_the_urdf_is_in_the_robot_model() -> None:
    numbers = Joint(
        "j", "revolute", "a", "b", Origin((0.123456, 0.123456, 0.123456)), limit=Limit(-0.123456, 0.123456, 0.123456)
    )
    robot = skeleton(numbers, links=(Link("a", Inertial(0.123456)), Link("b", Inertial(0.123456))))
    assert "123456" not in repr(data(robot))


def test_the_tree_of_the_diagram_is_that_of_the_robot() -> None:
    shown = tree(GRIPPER, connector_names(GRIPPER, Options()))
    assert shown.root == "base"
    assert [joint.name for joint in shown.children["palm"]] == ["mount", "other", "slide"]
    assert [joint.axis for joint in shown.children["palm"]] == [None, None, "slideAxis"]
    assert shown.frames == {"lens": "lensFrame", "right": "rightFrame", "gear": "gearFrame"}
