"""Template data of the robot model: parts and couplings, a place for each of them, and no number of the URDF."""

from __future__ import annotations

from typing import Any

from hypothesis import given
from support.skeletons import GRIPPER, skeleton
from support.trees import robots

from urdfsync.domain import Target
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.robot import robot_data
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import MOTION_KINDS, Inertial, Joint, Limit, Link, Origin, Robot


def data(robot: KinematicTree) -> dict[str, Any]:
    return robot_data(robot, Target("Plant.Arm", "Arm"), Options())


def test_joints_and_couplings_know_what_follows_what() -> None:
    found = data(GRIPPER)
    couplings = [
        (entry["component"], entry["leader"], entry["leader_motion"], entry["follower"], entry["follower_motion"])
        for entry in found["couplings"]
    ]
    assert couplings == [
        ("lockMimic", None, None, "lock", "rotational"),
        ("otherMimic", "slide", "translational", "other", "translational"),
        ("pinionMimic", "other", "translational", "pinion", "rotational"),
    ]
    joints = {joint["component"]: joint for joint in found["joints"]}
    followers = {name: joint["followers"] for name, joint in joints.items() if joint["followers"]}
    assert followers == {"slide": ["otherMimic"], "other": ["pinionMimic"]}
    leaders = {name: joint["follows"]["leader"] for name, joint in joints.items() if joint["follows"]}
    assert leaders == {"lock": None, "other": "slide", "pinion": "other"}


@given(robots())
def test_every_element_stands_there_once_with_a_place_and_a_row_for_each_connector(robot: Robot) -> None:
    found = data(KinematicTree.of(robot))
    names = [entry["component"] for kind in ("links", "joints", "couplings") for entry in found[kind]]
    assert len(set(names)) == len(robot.links) + len(robot.joints) + sum(
        joint.mimic is not None and joint.type in MOTION_KINDS for joint in robot.joints
    )
    flanges = [name for drive in found["drives"] for name in (drive["axis"], drive["support"])]
    frames = [frame["connector"] for frame in found["frames"]]
    assert sorted(found["diagram"]) == sorted([*names, *flanges, *frames, "frame_a"])
    for row in (*found["drives"], *found["frames"]):
        assert 100 < row["y"] - 10 < row["y"] < found["top"]


def test_a_link_may_be_named_as_what_templates_say_of_diagrams() -> None:
    found = data(skeleton(Joint("items", "fixed", "extent", "keys")))
    assert found["extent"] != found["diagram"]["extent"]
    assert {"extent", "items", "keys"} < found["diagram"].keys()


def test_no_number_of_the_urdf_is_in_the_robot_model() -> None:
    n = 0.123456
    joint = Joint("j", "revolute", "a", "b", Origin((n, n, n)), limit=Limit(-n, n, n))
    robot = skeleton(joint, links=(Link("a", Inertial(n)), Link("b", Inertial(n))))
    assert "123456" not in repr(data(robot))
