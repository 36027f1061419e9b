"""Ball joints in their spellings, and Drake's other joints; chains of hinges stand for balls that loops hold."""

from __future__ import annotations

import pytest
from support.loops import FOUR_BAR, to_options, to_urdf
from support.numbers import differences
from support.urdfs import dynamics, joint, limit, links, parsed, robot

from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.parse.source import read_robot
from urdfsync.formats.urdf.physics.completion import completed_for_reference
from urdfsync.formats.urdf.robot import Dynamics, Joint, Robot

LOSSES = '<dynamics damping="0.5"/>'


def drake(kind: str, *inside: str) -> str:
    """A robot with one of Drake's joints."""
    plain = joint("j", kind, "base", "arm", inside=inside)
    return robot(*links(base=1.0, arm=2.0), plain.replace("<joint", "<drake:joint").replace("</joint", "</drake:joint"))


def plain(found: Robot) -> list[Joint]:
    return sorted(found.joints, key=lambda each: each.name)


PLAIN = robot(*links(base=1.0, arm=2.0), joint("j", "ball", "base", "arm", inside=[LOSSES]))


@pytest.mark.parametrize("text", [PLAIN, PLAIN.replace('"ball"', '"spherical"'), drake("ball", LOSSES)])
def test_a_ball_is_read_in_each_spelling(text: str) -> None:
    (found,) = parsed(text).joints
    assert (found.type, found.dynamics, parsed(PLAIN).joints) == ("ball", Dynamics(0.5), (found,))
    assert differences(text.encode()) == []
    assert parsed(completed_for_reference(text.encode()).content.decode()).joints == (found,)


def test_a_universal_joint_of_drake_turns_about_x_of_the_parent_then_about_y() -> None:
    text = drake("universal", LOSSES)
    first, second = plain(parsed(text))
    assert [(each.name, each.axis, each.dynamics) for each in (first, second)] == [
        ("j_x", (1.0, 0.0, 0.0), Dynamics(0.5)),
        ("j_y", (0.0, 1.0, 0.0), Dynamics(0.5)),
    ]
    assert (first.parent, first.child, second.parent, second.child) == ("base", "j_x", "j_x", "arm")
    assert differences(text.encode()) == []
    assert plain(parsed(completed_for_reference(text.encode()).content.decode())) == [first, second]


def test_a_planar_joint_of_drake_is_that_of_urdf_and_others_are_refused() -> None:
    assert parsed(drake("planar")).joints[0].type == "planar"
    assert differences(drake("planar").encode()) == []
    errors = read_robot(drake("screw").encode(), "a.urdf").diagnostics
    assert ("unknown-joint-type", 5) in [(error.code, error.line) for error in errors]


HELD = robot(
    *links(base=1.0, arm=2.0, rod=1.0, free=1.0),
    joint("turn", "revolute", "base", "arm", axis="0 1 0"),
    joint("foot", "spherical", "base", "rod", inside=[limit(), dynamics(0.5, 0.1)]),
    joint("tail", "ball", "rod", "free"),
    '<loop_joint name="head" type="ball"><link1 link="rod" xyz="0 0 1"/><link2 link="arm" xyz="0 0 1"/></loop_joint>',
)


def test_a_ball_that_a_loop_holds_is_three_hinges_and_another_one_is_not() -> None:
    reading = read_robot(HELD.encode(), "a.urdf")
    assert reading.robot is not None
    hinges, tail, _ = plain(reading.robot)[:3], *plain(reading.robot)[3:]
    assert [(each.name, each.type, each.dynamics, each.measured) for each in hinges] == [
        (f"foot_{axis}", "continuous", Dynamics(0.5), True) for axis in "xyz"
    ]
    assert tail.type == "ball"
    assert [(each.line, each.code) for each in reading.diagnostics] == [
        (8, code) for code in ("limit-without-effect", "dynamics-without-effect", "loop-ball")
    ]
    assert differences(HELD.encode()) == []
    names = {each.name for each in reading.robot.joints}
    again = parsed(completed_for_reference(HELD.encode(), names).content.decode())
    assert plain(again) == plain(reading.robot)


def test_a_loop_may_name_the_ball_that_it_holds() -> None:
    text = HELD.replace('<link1 link="rod"', '<link1 link="foot"')
    assert parsed(text).loops == parsed(HELD).loops
    assert differences(text.encode()) == []
    names = {each.name for each in parsed(text).joints}
    assert parsed(completed_for_reference(text.encode(), names).content.decode()).loops == parsed(HELD).loops


def test_a_drive_of_a_ball_in_a_loop_is_told_as_that_of_any_ball() -> None:
    drive = '<transmission name="t"><joint name="foot"/></transmission></robot>'
    found = read_robot(HELD.replace("</robot>", drive).encode(), "a.urdf")
    assert found.robot is not None
    codes = {each.code for each in found.diagnostics}
    assert ("ball-not-driven" in codes, "unknown-actuated-joint" in codes) == (True, False)
    assert not any(joint.actuated for joint in found.robot.joints)


@pytest.mark.parametrize(
    "drive",
    [
        '<transmission name="t"><joint name="foot_x"/><actuator name="m"><mechanicalReduction>20</mechanicalReduction>'
        "</actuator></transmission>",
        '<ros2_control name="c" type="system"><joint name="foot_x"><command_interface name="position"/></joint>'
        "</ros2_control>",
    ],
    ids=["transmission", "ros2_control"],
)
def test_a_hinge_of_a_ball_in_a_loop_may_have_a_drive(drive: str) -> None:
    text = HELD.replace("</robot>", f"{drive}</robot>").encode()
    found = read_robot(text, "a.urdf")
    assert found.robot is not None
    (hinge,) = (joint for joint in found.robot.joints if joint.name == "foot_x")
    assert hinge.actuated
    assert (hinge.transmission is not None and hinge.transmission.reduction == 20) is ("20" in drive)
    assert "unknown-actuated-joint" not in {each.code for each in found.diagnostics}
    assert differences(text) == []


def test_a_loop_of_the_configuration_holds_balls_too() -> None:
    text = to_urdf(FOUR_BAR).replace('"continuous"', '"ball"', 1)
    assert "ball" in text
    found = [read_robot(text.encode(), "a.urdf", Options(**options)).robot for options in ({}, to_options(FOUR_BAR))]
    assert [each and {"ball"} & {joint.type for joint in each.joints} for each in found] == [{"ball"}, set()]
