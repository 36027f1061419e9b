"""Names of connectors: which links and joints have them, and that they never take another's name."""

from __future__ import annotations

from typing import Literal

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from msgspec.structs import replace
from support.robots import assembly, robots, tree

from urdfsync.formats.urdf.assembly import connector_options
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import Joint, Link, Mimic, Robot, Transmission

HAND = tree(
    Joint("j2", "fixed", "palm", "thumb"),
    Joint("j1", "fixed", "palm", "index"),
    Joint("j3", "fixed", "index", "index tip"),
)


@pytest.mark.parametrize(("frames", "names"), [
    ("leaves", ["index tip", "thumb"]),
    ("all", ["palm", "index", "index tip", "thumb"]),
    ((), ["index tip", "thumb"]),
    (("palm",), ["palm", "index tip", "thumb"]),
    (("thumb", "index", "index", "gone", "j1"), ["index", "index tip", "thumb"]),
])  # fmt: skip
def test_frames_are_those_of_leaves_and_what_is_asked_for_in_canonical_order(
    frames: Literal["leaves", "all"] | tuple[str, ...], names: list[str]
) -> None:
    assert [*assembly(HAND, frames=frames).connectors.frames] == names


def test_a_connector_gives_way_to_an_element_which_keeps_its_file() -> None:
    robot = tree(
        Joint("elbow", "revolute", "elbowAxis", "hand"),
        Joint("wrist", "revolute", "hand", "handFrame"),
        Joint("follow", "revolute", "handFrame", "followMimic", mimic=Mimic("elbow")),
        Joint("elbowAxis_2", "fixed", "handFrame", "elbowSupport"),
        Joint("rotational", "continuous", "handFrame", "wheel"),
    )
    assert (robot.joint("elbow").type, robot.link("elbowAxis").type) == ("Elbow", "ElbowAxis")
    names = assembly(robot, frames=("hand", "handFrame")).connectors
    assert {name: drive.axis for name, drive in names.drives.items()} == {
        "elbow": "elbowAxis_3",
        "wrist": "wristAxis",
        "rotational": "rotationalAxis_2",
    }
    assert names.drives["elbow"].support == "elbowSupport_2"
    assert names.frames["hand"] == "handFrame_2"
    assert names.couplings == {"follow": "followMimic_2"}


def test_a_motor_has_a_flange_where_a_joint_that_can_be_driven_has_a_gear() -> None:
    gear = Transmission(50.0)
    robot = tree(
        Joint("elbow", "revolute", "base", "elbowMotor", transmission=gear),
        Joint("wrist", "revolute", "elbowMotor", "hand"),
        Joint("follow", "revolute", "hand", "tip", mimic=Mimic("elbow"), transmission=gear),
        Joint("bolt", "fixed", "hand", "plate", transmission=gear),
    )
    motors = {name: drive.motor for name, drive in assembly(robot, drives="motor").connectors.drives.items()}
    assert motors == {"elbow": "elbowMotor_2", "wrist": None}
    assert {drive.motor for drive in assembly(robot).connectors.drives.values()} == {None}
    assert connector_options(assembly(robot))["elbowMotor_2"] == 'drives = "motor"'


def test_a_motor_of_two_joints_has_a_gear_in_the_robot_if_it_has_a_flange_or_a_rotor() -> None:
    robot = tree(
        Joint("flex", "revolute", "base", "hand", transmission=Transmission(60.0, joint="roll")),
        Joint("roll", "revolute", "hand", "rollGear", transmission=Transmission(60.0, 0.0, 1e-4, "flex", 50.0)),
    )
    gears = {
        drives: [(drive.gear, drive.other) for drive in assembly(robot, drives=drives).connectors.drives.values()]
        for drives in ("joint", "motor")
    }
    assert gears == {
        "joint": [(None, None), ("rollGear_2", "flex")],
        "motor": [("flexGear", "roll"), ("rollGear_2", "flex")],
    }


@pytest.mark.slow
@given(robots())
def test_no_two_components_have_one_name(robot: Robot) -> None:
    skeleton = KinematicTree.of(robot)
    names = assembly(skeleton, frames="all").connectors
    assert len(names.frames) == len(robot.links)
    connectors = [*names.frames.values(), *names.couplings.values()]
    connectors += [name for drive in names.drives.values() for name in (drive.axis, drive.support)]
    every = [name.lower() for name in (*connectors, *(identifier.component for identifier in skeleton.names.values()))]
    assert len(every) == len(set(every))


@pytest.mark.slow
@given(robots(), st.sampled_from(["arm", "Arm", "wheel", "leg 1", "armFrame", "wheelAxis"]))
def test_a_new_leaf_makes_no_connector_mean_another_element(robot: Robot, name: str) -> None:
    assume(name not in {link.name for link in robot.links} | {joint.name for joint in robot.joints})
    joint = Joint("zz", "revolute", robot.links[0].name, name)
    grown = replace(robot, links=(*robot.links, Link(name)), joints=(*robot.joints, joint))
    before, after = (assembly(each, frames="all").connectors for each in (robot, grown))
    owners = {frame: link for link, frame in before.frames.items()}
    assert all(owners.get(frame, link) == link for link, frame in after.frames.items())
    axes = {drive.axis: joint for joint, drive in before.drives.items()}
    assert all(axes.get(drive.axis, joint) == joint for joint, drive in after.drives.items())
    assert axes.keys().isdisjoint(after.frames.values())
