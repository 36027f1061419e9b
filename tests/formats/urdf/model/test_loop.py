"""The package of a robot with a loop: which joints are driven and have states, and which files a change concerns."""

from __future__ import annotations

import re
from collections.abc import Mapping

from msgspec.structs import replace
from support.loops import FIVE_BAR, FOUR_BAR, SPATIAL
from support.packages import generate_robot

from urdfsync.domain import Target
from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.option_names import check_options
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import Joint, Link, Origin, Robot


def texts(robot: Robot) -> Mapping[str, str]:
    return generate_robot(robot, Target("Own", "Own")).texts


def changed(before: Robot, after: Robot) -> set[str]:
    old, new = texts(before), texts(after)
    assert old.keys() == new.keys()
    return {path for path, text in new.items() if old[path] != text}


def test_joints_that_follow_through_the_loop_begin_where_a_guess_puts_them() -> None:
    modifiers = dict(re.findall(r"replaceable Joints\.\w+ (\w+)\((.*?)\)\n", texts(FIVE_BAR)["Own.mo"], re.DOTALL))
    guessed = {joint for joint, text in modifiers.items() if "fixedStart = false" in text}
    free = {joint for joint, text in modifiers.items() if "fixedStart = fixedStart" in text}
    assert (guessed, free) == ({"left_pin", "right_pin"}, {"left_pivot", "right_pivot"})
    assert all(f"phi_start = startPositions.{joint}," in text for joint, text in modifiers.items())


def test_run_and_test_drive_what_the_loop_leaves_free() -> None:
    undriven = replace(FIVE_BAR, joints=tuple(replace(joint, actuated=False) for joint in FIVE_BAR.joints))
    one = [replace(joint, actuated=joint.name == "left_pivot", limit=None) for joint in FIVE_BAR.joints]
    for robot, driven, free in (
        (FIVE_BAR, ["left_pivot", "right_pivot"], []),
        (undriven, ["left_pivot", "left_pin"], []),
        (replace(FIVE_BAR, joints=tuple(one)), ["left_pivot"], ["right_pivot"]),
    ):
        made = texts(robot)
        assert re.findall(r"RealInput (\w+)_phi", made["OwnRun.mo"]) == driven
        assert re.findall(r"(\w+)\(fixedStart = true\)", made["OwnRun.mo"]) == free
        assert re.findall(r"reach = robot\.startPositions\.(\w+)Reach", made["OwnTest.mo"]) == driven
        assert re.findall(r"Angle (\w+)Reach = ", made["OwnStart.mo"]) == driven


def test_the_start_of_the_source_gives_way_to_the_closed_one() -> None:
    start = texts(FOUR_BAR)["OwnStart.mo"]
    assert "Angle crank_pivot = 1.2\n" in start
    assert "Angle crank_pin = -0.882420799338\n" in start


def test_a_parameter_gives_way_to_a_joint_of_its_name() -> None:
    other = Joint("crank_pivotReach", "continuous", "ground", "flag", start=0.25)
    made = texts(replace(FOUR_BAR, links=(*FOUR_BAR.links, Link("flag")), joints=(*FOUR_BAR.joints, other)))
    assert "Angle crank_pivotReach = 0.25\n" in made["OwnStart.mo"]
    assert "reach = robot.startPositions.crank_pivotReach_2)" in made["OwnTest.mo"]


def test_numbers_of_a_loop_are_in_records_and_its_equations_in_its_model() -> None:
    (pin,) = FOUR_BAR.loops
    moved = replace(FOUR_BAR, loops=(replace(pin, origin=Origin((0.601, 0.0, 0.0))),))
    assert changed(FOUR_BAR, moved) == {"Joints/Rocker_pinParameters.mo", "OwnStart.mo"}
    ball = replace(FOUR_BAR, loops=(replace(pin, kind="ball"),))
    assert {"Own.mo", "Joints/Rocker_pin.mo", "Joints/Rocker_pinParameters.mo"} >= changed(FOUR_BAR, ball)
    assert "The loop is planar: two equations" in texts(FOUR_BAR)["Joints/Rocker_pin.mo"]
    assert "planar" not in texts(SPATIAL)["Joints/Ball.mo"]
    assert (
        "translations = [1, 0, 0; 0, 1, 0; 0, 0, 1],\n    rotations = fill(0, 0, 3),"
        in texts(SPATIAL)["Joints/BallParameters.mo"]
    )


def test_a_loop_has_files_a_component_and_two_connections() -> None:
    made = texts(SPATIAL)
    assert made["Joints/package.order"].endswith("\nBall\nBallParameters\n")
    assert "replaceable Joints.Ball ball constrainedby UrdfSync.Interfaces.PartialLoop\n" in made["Own.mo"]
    connections = re.findall(r"connect\(([^()]*\bball\.[^()]*)\)", made["Own.mo"])
    assert connections == ["coupler.frame_a, ball.frame_a", "ball.frame_b, rocker.frame_a"]


def test_joints_that_follow_through_a_loop_are_not_told_to_be_passive() -> None:
    flag = Joint("pole", "continuous", "ground", "flag")
    robot = replace(FOUR_BAR, links=(*FOUR_BAR.links, Link("flag")), joints=(*FOUR_BAR.joints, flag))
    told = [said.message for _, said in check_options(Assembly(robot, Options()))]
    assert told == ["Run and Test do not drive `pole`: no transmission, no ros2_control and no limit"]
