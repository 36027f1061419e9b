"""The law of an actuator: its effort from the robot's numbers is MuJoCo's, at any position, speed and command."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import mujoco
import numpy as np
import pytest
from support import packages
from support.mjcfs import document, joint, left_out, noted, read, urdf, world

from urdfsync.formats.mjcf.comparison import compare
from urdfsync.formats.urdf.robot import Servo

PAIR = world(
    '<body name="b"><joint name="a" axis="0 1 0"{}/><geom size="0.1"/>'
    '<body name="c" pos="0 0 1"><joint name="d" axis="1 0 0" ref="0.2"{}/><geom size="0.1"/></body></body>',
    '<compiler angle="radian"/>',
)
COUPLED = '<equality><joint joint1="d" joint2="a" polycoef="0.1 2 0 0 0"/></equality>'
TENDON = '<tendon><fixed name="t"><joint joint="a" coef="0.5"/><joint joint="d" coef="-1.5"/></fixed></tendon>'
OWN, LEADING = {"d": (1.0, 0.0)}, {"a": (1.0, 0.0), "d": (2.0, 0.1)}
"""Joints that move together: their positions by that of the first."""
CASES: Mapping[str, tuple[str, Callable[[float], float]]] = {
    "motor": ('<motor joint="d" ctrlrange="-2 3" gear="10"/>', lambda u: 10 * u),
    "motor with a gear that turns around": ('<motor joint="d" forcerange="-2 1" gear="-10"/>', lambda u: -10 * u),
    "motor with a gain and a bias": (
        '<general joint="d" gear="3" gainprm="4" biastype="affine" biasprm="2 0 0" ctrlrange="-1 1"/>',
        lambda u: 3 * (4 * u + 2),
    ),
    "position": ('<position joint="d" kp="50" kv="3" ctrlrange="-0.5 1"/>', lambda u: u - 0.2),
    "position with a damping ratio": ('<position joint="d" kp="50" dampratio="0.7"/>', lambda u: u - 0.2),
    "position with a gear": (
        '<position joint="d" kp="50" kv="3" gear="-4" ctrlrange="-3 1" forcerange="-9 40"/>',
        lambda u: -u / 4 - 0.2,
    ),
    "velocity": ('<velocity joint="d" kv="5" gear="2" forcerange="-4 3" ctrlrange="-1 2"/>', lambda u: u / 2),
    "integrated velocity": (
        '<intvelocity joint="d" kp="30" kv="2" gear="3" actrange="-1 0.5" ctrlrange="-2 3"/>',
        lambda u: u / 3 - 0.2,
    ),
    "general, with ctrl from 0 to 255": (
        '<general joint="d" gainprm="0.3" biastype="affine" biasprm="1.5 -100 -10" ctrlrange="0 255"/>',
        lambda u: (0.3 * u + 1.5) / 100 - 0.2,
    ),
    "general, as a spring": (
        '<general joint="d" gainprm="0" biastype="affine" biasprm="1 -5 0"/>',
        lambda _: 0.2 - 0.2,
    ),
    "position of joints that move together": (
        '<position tendon="t" kp="20" kv="2" gear="3" forcerange="-8 5" ctrlrange="-2 2"/>',
        # length = 3·(0.5·a - 1.5·(2·a + 0.3)): d has `ref`
        lambda u: (u + 1.35) / -7.5,
    ),
    "motor of a joint that follows": ('<motor name="follow" joint="d" gear="5" ctrlrange="-1 2"/>', lambda u: 10 * u),
}
"""Actuators of joint `d`, each with the command at the joint that is the same as ctrl, by hand."""


def model_of(actuator: str, limits: tuple[str, str] = ("", "")) -> tuple[str, Mapping[str, tuple[float, float]]]:
    """An MJCF with an actuator, and the joints that it moves."""
    is_coupled = "tendon" in actuator or "follow" in actuator
    parts = f"{COUPLED}{TENDON if 'tendon' in actuator else ''}" if is_coupled else ""
    text = PAIR.format(*limits).replace("</mujoco>", f"{parts}<actuator>{actuator}</actuator></mujoco>")
    return text, LEADING if is_coupled else OWN


def by_law(servo: Servo, command: str, given: float, position: float, speed: float) -> float:
    """The effort as docs/urdf.md says; `given` is the integral if the command is integrated."""

    def within(value: float, least: float | None, most: float | None) -> float:
        return float(np.clip(value, -np.inf if least is None else least, np.inf if most is None else most))

    gain, damping = servo.position_gain or 0.0, servo.velocity_gain or 0.0
    if command == "effort":
        effort = given
    elif gain:
        effort = gain * (within(given, servo.min_position, servo.max_position) - position) - damping * speed
    else:
        effort = damping * (within(given, servo.min_velocity, servo.max_velocity) - speed)
    return within(effort, servo.min_effort, servo.max_effort)


def by_mujoco(text: str, moved: Mapping[str, tuple[float, float]], state: Any) -> float:
    """The effort at the first of the joints that move together."""
    model = mujoco.MjModel.from_xml_string(text)
    data, (position, speed, ctrl) = mujoco.MjData(model), state
    for name, (factor, offset) in moved.items():
        number = model.joint(name).id
        data.qpos[number] = model.qpos0[number] + factor * position + offset
        data.qvel[number] = factor * speed
    data.ctrl[:] = ctrl
    if model.na:
        data.act[:] = np.clip(ctrl, *model.actuator_actrange[0])
    mujoco.mj_forward(model, data)
    return float(sum(factor * data.qfrc_actuator[model.joint(name).id] for name, (factor, _) in moved.items()))


@pytest.mark.parametrize("name", CASES)
def test_the_effort_of_a_law_is_that_of_mujoco(name: str) -> None:
    """To 1e-9 of the greatest effort. Some commands and speeds are beyond the limits."""
    actuator, command_of = CASES[name]
    text, moved = model_of(actuator)
    found, states = joint(read(text), next(iter(moved))), np.random.default_rng(0).uniform(-1, 1, (40, 3))
    servo = found.servo or Servo()
    states[20:] *= (1, 20, 20)
    expected = [by_mujoco(text, moved, state) for state in states]
    ours = [by_law(servo, found.command or "position", command_of(u), q, w) for q, w, u in states]
    assert np.ptp(expected) > 0.1
    assert ours == pytest.approx(expected, rel=0, abs=1e-9 * max(map(abs, expected)))
    compared, differences = compare(document(text), urdf(text))
    assert differences == ()
    assert compared > 200


@pytest.mark.parametrize("name", CASES)
def test_a_wrong_number_of_a_law_is_told(name: str) -> None:
    """Each number of the law, one after the other."""
    text, _ = model_of(CASES[name][0])
    written = urdf(text)
    lines = [line for line in written.split("\n") if "<param" in line]
    assert lines
    for line in lines:
        number = line.partition(">")[2].partition("<")[0]
        wrong = written.replace(line, line.replace(number, repr(float(number) * 1.001 + 0.001)))
        (told,) = {each.partition(" differs")[0] for each in compare(document(text), wrong)[1]}
        assert told == f"effort of the law of joint {'a' if 'tendon' in text or 'follow' in text else 'd'}"


def test_a_joint_limits_the_effort_of_a_law() -> None:
    text, _ = model_of('<position joint="d" kp="50" forcerange="-9 1"/>', ("", ' actuatorfrcrange="-4 6"'))
    servo = joint(read(text), "d").servo
    assert servo is not None
    assert (servo.min_effort, servo.max_effort) == (-4, 1)
    assert compare(document(text), urdf(text))[1] == ()


def test_two_joints_of_a_tendon_that_limit_their_efforts_have_no_law() -> None:
    """Each cuts its own share of the force."""
    limits = ' actuatorfrcrange="-4 6"'
    text, _ = model_of('<position tendon="t" kp="50"/>', (limits, limits))
    assert joint(read(text), "a").servo is None
    assert noted(text) == "not modelled: 1 <feedback>"


def test_an_actuator_that_is_switched_off_has_no_law() -> None:
    """The next one commands the joint."""
    motors = '<position joint="d" kp="50" group="2"/><velocity joint="d" kv="5"/>'
    text, _ = model_of(motors)
    text = text.replace("</mujoco>", '<option actuatorgroupdisable="2"/></mujoco>')
    assert (joint(read(text), "d").command, joint(read(text), "d").servo) == ("velocity", Servo(velocity_gain=5.0))
    assert noted(text) == "not modelled: 1 <inactive>"
    assert compare(document(text), urdf(text))[1] == ()


@pytest.mark.parametrize(
    "other",
    [
        '<pid name="p" joint="a" kp="50" kv="1" ki="2"/>',
        '<pid name="p" joint="a" kp="50" input="pos"/>',
        '<orientation name="p" joint="q" kp="50"/>',
        '<damper name="p" joint="a" kv="2" ctrlrange="0 1"/>',
        '<dcmotor name="p" joint="a" motorconst="0.5" resistance="2" input="none"/>',
    ],
)
def test_actuators_with_several_controls_or_none_take_nothing_from_the_next(other: str) -> None:
    """Since MuJoCo 4, controls and actuators are not one to one."""
    law = '<position joint="d" kp="50" kv="3" gear="2" ctrlrange="-0.5 1"/>'
    ball = '<body><joint name="q" type="ball"/><geom size="0.1"/></body></body></body></worldbody>'
    text = model_of(law)[0].replace("</body></body></worldbody>", ball)
    with_other = text.replace("<actuator>", f"<actuator>{other}")
    if "damper" not in other and "pid" not in mujoco.mj_printSchema(flg_html=False, flg_pad=False):
        pytest.skip("of MuJoCo 4")
    assert joint(read(with_other), "d").servo == joint(read(text), "d").servo
    assert left_out(with_other) == ["actuator p"]
    assert compare(document(with_other), urdf(with_other))[1] == ()


def test_a_delay_is_noted() -> None:
    """The law acts at once, and `check` compares the law alone."""
    text, _ = model_of('<position joint="d" kp="50" nsample="3" delay="0.004"/>')
    if "delay" not in mujoco.mj_printSchema(flg_html=False, flg_pad=False):
        pytest.skip("of a newer MuJoCo")
    assert noted(text) == "not modelled: 1 <delay>"
    assert compare(document(text), urdf(text))[1] == ()


@pytest.mark.parametrize(("limits", "is_told"), [("-90 60", True), ("-1.5708 1.0472", False), ("-90 90", False)])
def test_a_command_in_degrees_is_told(limits: str, is_told: bool) -> None:
    """MuJoCo reads ranges of joints in degrees, and those of commands in rad."""
    text = model_of(f'\n<position joint="d" kp="50" ctrlrange="{limits}"/>', ("", ' range="-90 60"'))[0]
    text = text.replace('angle="radian"', 'angle="degree"').replace('ref="0.2"', "")
    found = [each for each in packages.read(urdf(text).encode()).diagnostics if each.code == "angle-unit"]
    assert len(found) == is_told
    if is_told:
        assert found[0].message == "joint d: -90 and 60 rad, the drive's limits, may be in degrees"


def test_the_range_of_a_delayed_activation_limits_the_effort() -> None:
    text, _ = model_of(
        '<general joint="d" dyntype="filter" dynprm="0.1" gainprm="2" actlimited="true" actrange="-1 3"/>'
    )
    assert joint(read(text), "d").servo == Servo(min_effort=-2.0, max_effort=6.0)
    assert compare(document(text), urdf(text))[1] == ()


def test_a_switch_leaves_out_the_range_of_ctrl() -> None:
    text, _ = model_of('<position joint="d" kp="50" ctrlrange="-1 1"/>')
    free = text.replace("</mujoco>", '<option><flag clampctrl="disable"/></option></mujoco>')
    assert joint(read(free), "d").servo == Servo(position_gain=50.0)
    assert compare(document(free), urdf(free))[1] == ()
