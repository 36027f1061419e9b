"""Motors, gears, couplings and starts of an MJCF."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.mjcfs import joint, left_out, noted, read, urdf, world

from urdfsync.formats.urdf.drives import passive_joints
from urdfsync.formats.urdf.named_poses import named_poses
from urdfsync.formats.urdf.robot import Mimic, Transmission

PAIR = world(
    '<body name="b"><joint name="a" axis="0 1 0"/><geom size="0.1"/>'
    '<body name="c" pos="0 0 1"><joint name="d" axis="1 0 0" ref="0.2"/><geom size="0.1"/></body></body>',
    '<compiler angle="radian"/>',
)


def with_parts(parts: str) -> str:
    """Two hinges, `a` and `d`, with other elements of the model."""
    return PAIR.replace("</mujoco>", f"{parts}</mujoco>")


def with_motor(motor: str) -> str:
    return with_parts(f"<actuator>{motor}</actuator>")


@pytest.mark.parametrize(
    ("motor", "command", "effort"),
    [
        ('<motor joint="a"/>', "effort", None),
        ('<motor joint="a" ctrlrange="-2 3" gear="10"/>', "effort", 30),
        ('<motor joint="a" ctrlrange="-9 9" forcerange="-2 2" gear="-10"/>', "effort", 20),
        ('<position joint="a" kp="50" ctrlrange="-1 1"/>', None, None),
        ('<position joint="a" kp="50" forcerange="-4 4"/>', None, 4),
        ('<velocity joint="a" kv="5" forcerange="-4 4"/>', "velocity", 4),
        ('<intvelocity joint="a" kp="5" actrange="-1 1"/>', "velocity", None),
        ('<general joint="a" gainprm="40" biasprm="0 -40 -2" biastype="affine" forcerange="-7 7"/>', None, 7),
        ('<general joint="a" gainprm="5" ctrlrange="-2 2"/>', "effort", 10),
        ('<damper joint="a" kv="1" ctrlrange="0 1"/>', None, None),
    ],
)
def test_an_actuator_gives_a_command_and_a_limit(motor: str, command: str | None, effort: float | None) -> None:
    """A position is the usual command. A damper is no motor."""
    found = joint(read(with_motor(motor)), "a")
    assert found.command == command
    assert (found.limit.effort if found.limit else None) == effort
    assert found.actuated == (None if "damper" in motor else True)


@pytest.mark.parametrize(
    ("motor", "words"),
    [
        ('<motor joint="a" gear="3" ctrlrange="-1 1"/>', ""),
        ('<position joint="a" kp="50"/>', ""),
        ('<general joint="a" biastype="affine" biasprm="2 0 0"/>', ""),
        ('<general joint="a" biastype="affine" biasprm="2 3 0" forcerange="-4 4"/>', "1 <feedback>"),
        ('<general joint="a" biastype="affine" biasprm="0 -3 1" forcerange="-4 3"/>', "1 <feedback>, 1 <forcerange>"),
        ('<position joint="a" kp="50" timeconst="0.1"/>', "1 <activation>"),
        ('<general joint="a" dyntype="filter" dynprm="0.1"/>', "1 <activation>"),
    ],
)
def test_what_a_law_lacks_is_noted(motor: str, words: str) -> None:
    """A force that grows with position or speed, the integral of a force, and delays: the joint moves exactly."""
    assert noted(with_motor(motor)) == (f"not modelled: {words}" if words else "")


def test_a_joint_limits_the_effort_of_its_motors() -> None:
    text = with_motor('<motor joint="a" ctrlrange="-9 9"/>').replace('name="a"', 'name="a" actuatorfrcrange="-3 4"')
    limit = joint(read(text), "a").limit
    assert limit is not None
    assert limit.effort == 4


def test_the_first_motor_of_a_joint_commands_it_and_all_limit_its_effort() -> None:
    text = with_motor('<position joint="a" forcerange="-3 3"/><velocity name="v" joint="a" forcerange="-4 4"/>')
    found = joint(read(text), "a")
    assert found.limit is not None
    assert (found.command, found.limit.effort) == (None, 7)
    assert noted(text) == "not modelled: 1 <motor>"


def test_a_gear_is_a_reduction() -> None:
    assert joint(read(with_motor('<motor joint="a" gear="50"/>')), "a").transmission == Transmission(50.0)


def test_with_a_motor_other_joints_are_passive() -> None:
    assert passive_joints(read(with_motor('<motor joint="a"/>')).joints) == {"d"}
    assert passive_joints(read(PAIR).joints) == set()  # exporters leave actuators out


def test_the_key_home_gives_the_starts() -> None:
    keys = '<keyframe><key name="other" qpos="9 9"/><key name="home" qpos="0.5 0.7"/></keyframe>'
    robot = read(with_parts(keys))
    assert (joint(robot, "a").start, joint(robot, "d").start) == (0.5, 0.5)


def test_other_keys_are_named_poses() -> None:
    """Their positions count from the pose as written."""
    keys = '<keyframe><key name="up" qpos="0.5 0.7"/><key qpos="1 1.2"/><key name="home" qpos="0 0.2"/></keyframe>'
    poses, faults = named_poses(Path("/nowhere/arm.xml"), read(with_parts(keys)))
    assert poses == {"up": {"joint a": 0.5, "joint d": 0.5}, "key 2": {"joint a": 1.0, "joint d": 1.0}}
    assert faults == []


def test_a_spring_counts_from_the_pose_as_written() -> None:
    spring = 'name="d" stiffness="3" springref="0.5"'
    dynamics = joint(read(PAIR.replace('name="d"', spring)), "d").dynamics
    assert dynamics is not None
    assert dynamics.spring_stiffness == 3.0
    assert dynamics.spring_reference == pytest.approx(0.3)


def test_a_linear_equality_is_a_coupling() -> None:
    """Both positions count from the pose as written, so `ref` has no effect."""
    equality = '<equality><joint joint1="d" joint2="a" polycoef="0.1 2 0 0 0"/></equality>'
    assert joint(read(with_parts(equality)), "d").mimic == Mimic("a", 2.0, 0.1)


@pytest.mark.parametrize(
    ("equality", "what"),
    [
        ('<joint joint1="d" joint2="a" polycoef="0 1 1 0 0"/>', ["equality of joints d and a"]),
        ('<joint joint1="d" polycoef="0.1 0 0 0 0"/>', ["equality of joints d"]),
        ('<joint joint1="d" joint2="a"/><joint joint1="a" joint2="d"/>', ["equality of joints a and d"]),
        ('<joint joint1="d" joint2="a" active="false" polycoef="0 1 1 0 0"/>', []),
    ],
)
def test_an_equality_that_is_no_coupling_is_left_out(equality: str, what: list[str]) -> None:
    assert left_out(with_parts(f"<equality>{equality}</equality>")) == what


def tendon(motor: str, equality: str = "") -> str:
    joints = '<joint joint="a" coef="0.5"/><joint joint="d" coef="0.5"/>'
    return with_parts(f'{equality}<tendon><fixed name="t">{joints}</fixed></tendon><actuator>{motor}</actuator>')


def test_a_motor_of_a_tendon_drives_joints_that_move_together() -> None:
    """Half of the force acts at each joint, and the joint `d` moves twice as far."""
    equality = '<equality><joint joint1="d" joint2="a" polycoef="0 2 0 0 0"/></equality>'
    found = joint(read(tendon('<motor tendon="t" forcerange="-4 4"/>', equality)), "a")
    assert found.limit is not None
    assert found.limit.effort == pytest.approx(4 * (0.5 + 0.5 * 2))
    assert found.actuated


def test_a_motor_of_joints_that_move_by_themselves_is_left_out() -> None:
    assert left_out(tendon('<motor name="m" tendon="t"/>')) == ["actuator m"]


@pytest.mark.parametrize(
    "motor",
    [
        '<muscle name="m" joint="a" lengthrange="0 1"/>',
        '<adhesion name="m" body="b" ctrlrange="0 1"/>',
        '<damper name="m" joint="a" kv="1" ctrlrange="0 1"/>',
        '<general name="m" joint="a" dyntype="integrator" gainprm="5"/>',
    ],
)
def test_an_actuator_that_is_no_motor_is_left_out(motor: str) -> None:
    assert left_out(with_motor(motor)) == ["actuator m"]


def test_a_motor_of_another_robot_is_none_of_this_one() -> None:
    other = '<body name="o"><freejoint/><geom size="0.1"/><site name="s"/></body><body name="b">'
    text = with_motor('<motor site="s" gear="0 0 1 0 0 0"/>').replace('<body name="b">', other)
    assert "left_out" not in urdf(text, robot="b")
    assert "left_out" in urdf(text, robot="o")


def test_a_sliding_joint_without_a_range_loses_its_effort_with_a_note() -> None:
    text = with_motor('<motor joint="a" ctrlrange="-3 3"/>').replace('name="a"', 'name="a" type="slide"')
    assert joint(read(text), "a").limit is None
    assert noted(text) == "not modelled: 1 <effort>"
