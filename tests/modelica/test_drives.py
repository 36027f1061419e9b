"""Run of a robot that has a joint with each kind of drive: what the source says of it decides how it moves."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest
from support.modelica import DRIVES, GRAVITY, Array, Run, Task, bench, simulate
from support.packages import Package, generate
from support.urdfs import joint, limit, link, links, robot

from urdfsync.domain import Target

pytestmark = pytest.mark.slow


def interface(joint: str, name: str) -> str:
    """A transmission of ROS 1."""
    inside = f"<hardwareInterface>hardware_interface/{name}</hardwareInterface>"
    return f'<transmission name="{joint}"><joint name="{joint}">{inside}</joint></transmission>'


ROBOT = robot(
    *links(base=None, tyre=2.0, mast=1.0, finger=0.5),
    link("fork", 2.0, center="0.1 0 0", rpy="0 0 0"),
    link("arm", 1.5, center="0 0.2 0", rpy="0 0 0"),
    joint("caster", "revolute", "base", "fork", axis="0 1 0", rpy="0 0 0", inside=[limit(-9, 9, 99, 99)]),
    joint("wheel", "continuous", "base", "tyre", axis="0 1 0"),
    joint("elbow", "revolute", "base", "arm", axis="1 0 0", rpy="0 0 0", inside=[limit(-9, 9, 99, 99)]),
    joint("lift", "prismatic", "base", "mast", axis="0 0 1", inside=[limit(-1, 1, 99, 999)]),
    joint("grip", "prismatic", "mast", "finger", axis="0 1 0", inside=[limit(-1, 1, 99, 999)]),
    interface("caster", "JointStateInterface"),
    interface("wheel", "VelocityJointInterface"),
    """<ros2_control name="c" type="system"><joint name="elbow"><command_interface name="effort"/>
       <state_interface name="position"><param name="initial_value">0.5</param></state_interface></joint>
       <joint name="grip"><param name="mimic">lift</param><param name="multiplier">-2</param></joint></ros2_control>""",
)


def simulate_run(
    package: Package, signals: Sequence[str], equations: str, stop: float, library: Path, folder: Path
) -> list[Array]:
    """The series of `signals` of the robot in its Run, whose inputs are as the equations say."""
    # as `simulate` does: rumoca refuses an extension that binds inputs
    texts = {path: text.replace("Blocks.Interfaces.RealInput", "Blocks.Interfaces.RealOutput")
             for path, text in package.texts.items()}  # fmt: skip
    imports = "import Modelica; import UrdfSync; import Bot;"
    source = f"model Probe\n  {imports}\n  extends Bot.BotRun;\nequation\n  {equations}\nend Probe;\n"
    values = [f"robot.{signal}" for signal in signals]
    task = Task(source, "Probe", [Run(stop, 0.01, tolerance=1e-8)], values)
    (series,) = simulate(library, [dataclasses.replace(package, texts=texts).write(folder)], [task])
    return [series.values[value] for value in values]


def test_joints_move_as_the_source_says(modelica_library: Path, tmp_path: Path) -> None:
    """A caster that is only measured swings as a pendulum does, a wheel has the speed that is given."""
    package = generate(ROBOT.encode(), Target("Bot", "Bot"), start={"lift": 0.25})
    signals = ("caster.revolute.phi", "caster.revolute.w", "casterAxis.tau", "wheel.revolute.w", "elbow.revolute.phi",
             "elbow.revolute.a", "lift.prismatic.s", "grip.prismatic.s")  # fmt: skip
    series = simulate_run(
        package, signals, "wheel_w = 2; elbow_tau = 1; lift_s = 0.25;", 1.0, modelica_library, tmp_path
    )
    phi, w, tau, speed, elbow, gain, lift, grip = series
    inertia = {"caster": 2.0 * (0.018 + 0.1**2), "elbow": 1.5 * (0.021 + 0.2**2)}
    # nobody pushes the caster, and nothing brakes it
    assert max(phi) > 0.99 * math.pi
    assert 0.5 * inertia["caster"] * w**2 == pytest.approx(2.0 * GRAVITY * 0.1 * np.sin(phi), abs=1e-5)
    assert not tau.any()
    assert speed[-1] == pytest.approx(2.0, abs=1e-6)
    assert elbow[0] == 0.5
    assert gain[0] == pytest.approx((1 - 1.5 * GRAVITY * 0.2 * math.cos(0.5)) / inertia["elbow"])
    assert lift == pytest.approx(0.25)
    assert grip == pytest.approx(-0.5)


BALL = '<inertial><mass value="2"/><inertia ixx="{0}" ixy="0" ixz="0" iyy="{0}" iyz="0" izz="{0}"/></inertial>'


def gimbal(first: str, second: str) -> list[str]:
    """Two joints about crossing axes in the centre of balls of 0.3 and 0.2 kg·m²: no motion loads the other axis."""
    at = {"xyz": "0 0 0", "rpy": "0 0 0"}
    balls = [f'<link name="{n}">{BALL.format(i)}</link>' for n, i in ((f"{first} ball", 0.3), (f"{second} ball", 0.2))]
    return [
        *balls,
        joint(first, "revolute", "base", f"{first} ball", axis="0 1 0", **at),
        joint(second, "continuous", f"{first} ball", f"{second} ball", axis="1 0 0", **at),
    ]


COUPLED = robot(
    link("base"),
    *gimbal("flex", "roll"),
    """<transmission name="wrist" type="pr2_mechanism_model/WristTransmission">
         <rightActuator name="r" mechanicalReduction="60.17"/><leftActuator name="l" mechanicalReduction="50"/>
         <flexJoint name="flex" mechanicalReduction="-1"/><rollJoint name="roll" mechanicalReduction="2" offset="0.3"/>
       </transmission>""",
    *gimbal("pitch", "tilt"),
    """<transmission name="ankle"><type>transmission_interface/DifferentialTransmission</type>
         <actuator name="m2"><role>actuator2</role><mechanicalReduction>-80</mechanicalReduction></actuator>
         <actuator name="m1"><role>actuator1</role><mechanicalReduction>100</mechanicalReduction>
           <drake:rotor_inertia value="2e-4"/></actuator>
         <joint name="pitch"><role>joint1</role><offset>0.1</offset></joint>
         <joint name="tilt"><role>joint2</role><mechanicalReduction>1.5</mechanicalReduction></joint>
       </transmission>""",
    *gimbal("hip", "knee"),
    """<ros2_control name="c" type="system"><transmission name="bars">
         <plugin>transmission_interface/FourBarLinkageTransmission</plugin>
         <actuator name="h" role="actuator1"><mechanical_reduction>50</mechanical_reduction></actuator>
         <actuator name="k" role="actuator2"><mechanical_reduction>-40</mechanical_reduction></actuator>
         <joint name="hip" role="joint1"><mechanical_reduction>2</mechanical_reduction></joint>
         <joint name="knee" role="joint2"><mechanical_reduction>3</mechanical_reduction></joint>
       </transmission></ros2_control>""",
)


Law: TypeAlias = Callable[[float, float], tuple[float, float]]
LAWS: Mapping[tuple[str, str], tuple[Law, Law]] = {
    ("flex", "roll"): (
        lambda a, b: ((a / 60.17 - b / 50) / (2 * -1), (-a / 60.17 - b / 50) / (2 * 2)),
        lambda f, r: ((f / -1 - r / 2) / (2 * 60.17), (-f / -1 - r / 2) / (2 * 50)),
    ),
    ("pitch", "tilt"): (
        lambda a, b: ((a / 100 + b / -80) / 2, (a / 100 - b / -80) / (2 * 1.5)),
        lambda p, t: ((p + t / 1.5) / (2 * 100), (p - t / 1.5) / (2 * -80)),
    ),
    ("hip", "knee"): (
        lambda a, b: (a / (2 * 50), (b / -40 - a / (2 * 50)) / 3),
        lambda h, k: ((h - k / 3) / (2 * 50), k / (3 * -40)),
    ),
}
"""By hand: two joints' positions beside their offsets from those of the motors, torques of the motors from theirs."""


def test_motors_and_joints_of_a_differential_move_and_push_each_other(modelica_library: Path, tmp_path: Path) -> None:
    """The PR2's wrist, an ankle as of TALOS with a rotor, a four-bar linkage: speeds and torques of both sides.

    The motors are moved. Speeds and torques are as ros_control and pr2_mechanism document them, but for the torques of
    the four-bar linkage: those of ros_control do not balance the power of its speeds.
    """
    package = generate(COUPLED.encode(), Target("Bot", "Bot"), drives="motor")
    names = [name for pair in LAWS for name in pair]
    ways = {name: (1.0 + k, 50.0 - 7 * k, 60.0 + 9 * k) for k, name in enumerate(names)}
    body = "Bot.Bot robot(fixedStart = false);\n"
    body += "".join(
        f"RotationalDrive {name}(a0 = {a!r}, a1 = {b!r}, a2 = {c!r});\n" for name, (a, b, c) in ways.items()
    )
    body += "equation\nconnect(world.frame_b, robot.frame_a);\n"
    body += "".join(f"connect({name}.flange, robot.{name}Motor);\n" for name in names)
    endings = (".revolute.phi", ".revolute.w", ".revolute.tau", "Motor.tau")
    values = [f"robot.{name}{ending}" for name in names for ending in endings]
    task = bench(body, [Run(1e-3, 1e-3)], values, classes=DRIVES)
    (series,) = simulate(modelica_library, [package.write(tmp_path)], [task])
    offsets, rotors = {"roll": 0.3, "pitch": 0.1}, {"pitch": 2e-4}
    for pair, (motion, effort) in LAWS.items():
        places, speeds, gains = (motion(*numbers) for numbers in zip(*(ways[name] for name in pair), strict=True))
        loads = 0.5 * gains[0], 0.2 * gains[1]
        for k, name in enumerate(pair):
            torque = effort(*loads)[k] + rotors.get(name, 0.0) * ways[name][2]
            expected = [places[k] + offsets.get(name, 0.0), speeds[k], loads[k], torque]
            found = [series.values[f"robot.{name}{ending}"][0] for ending in endings]
            assert found == pytest.approx(expected, rel=1e-9), name
