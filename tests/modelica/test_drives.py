"""Run of a robot that has a joint with each kind of drive: what the source says of it decides how it moves."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from support.modelica import GRAVITY, Array, Run, Task, simulate
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
