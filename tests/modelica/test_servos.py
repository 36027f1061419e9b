"""Laws of drives in Run move robots as MuJoCo does with the same actuators."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from support.mjcfs import urdf
from support.modelica import GRAVITY, Run, Task, simulate
from support.packages import generate

from urdfsync.domain import Target

pytestmark = pytest.mark.slow

ACTUATORS = """
    <position joint="shoulder" kp="60" kv="6" ctrlrange="-1 0.7" forcerange="-9 20"/>
    <general joint="elbow" gear="-2" gainprm="9" biasprm="0.5 -10 -1" biastype="affine"/>
    <intvelocity joint="rail" kp="300" kv="20" actrange="-0.3 0.1" ctrlrange="-1 1"/>
    <velocity joint="wheel" kv="0.4" gear="3"/>
    <motor joint="fan" gear="2" ctrlrange="-1 0.25"/>"""
ARM = f"""
<mujoco model="arm">
  <compiler angle="radian"/>
  <option gravity="0 0 -{GRAVITY}" timestep="2e-5" integrator="RK4"/>
  <worldbody>
    <body name="stand">
      <body name="upper">
        <joint name="shoulder" axis="0 1 0" damping="0.2"/>
        <inertial pos="0.1 0 0.2" mass="1.5" diaginertia="0.02 0.02 0.01"/>
        <body name="fore" pos="0 0 0.4">
          <joint name="elbow" axis="1 0 0" ref="0.1" armature="0.05"/>
          <inertial pos="0 0.05 0.2" mass="0.8" diaginertia="0.01 0.01 0.004"/>
        </body>
      </body>
      <body name="cart" pos="0 2 0">
        <joint name="rail" type="slide" axis="1 0 0"/>
        <inertial pos="0 0 0" mass="2" diaginertia="0.1 0.1 0.1"/>
        <body name="disc">
          <joint name="wheel" axis="0 1 0"/>
          <inertial pos="0.1 0 0" mass="0.3" diaginertia="0.02 0.02 0.02"/>
        </body>
        <body name="blades">
          <joint name="fan" axis="1 0 0"/>
          <inertial pos="0 0 0" mass="0.3" diaginertia="0.02 0.02 0.02"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>{ACTUATORS}
  </actuator>
</mujoco>
"""
CONTROLS = {"shoulder": 0.9, "elbow": 0.4, "rail": 0.5, "wheel": -2.0, "fan": 0.6}
"""Values of `ctrl`: those of shoulder and fan are beyond their ranges.

The rail's integral reaches its end at 0.2 s. There, MuJoCo is wrong by half a step of the integral, since stages of its
integrator pass the end: hence the short step.
"""
COMMANDS = {
    "shoulder_phi": CONTROLS["shoulder"],
    # at this position, the actuator's force 9·ctrl + 0.5 - 10·length is zero; length = -2·(position + ref)
    "elbow_phi": -(9 * CONTROLS["elbow"] + 0.5) / 20 - 0.1,
    "rail_v": CONTROLS["rail"],
    "wheel_w": CONTROLS["wheel"] / 3,
    "fan_tau": 2 * CONTROLS["fan"],
}
"""What these values are at the joints."""
POSITIONS = {name: f"robot.{name}.{'prismatic.s' if name == 'rail' else 'revolute.phi'}" for name in CONTROLS}


def mujoco_positions(times: Any) -> Any:
    """The positions of the joints in MuJoCo, as URDF counts them, in rows by time."""
    model = mujoco.MjModel.from_xml_string(ARM)
    data, rows = mujoco.MjData(model), []
    data.ctrl[:] = list(CONTROLS.values())
    for time in times:
        while data.time < time - model.opt.timestep / 2:
            mujoco.mj_step(model, data)
        rows.append(data.qpos - model.qpos0)
    return np.array(rows)


def test_run_moves_an_arm_as_mujoco_does(modelica_library: Path, tmp_path: Path) -> None:
    """One second, to 1e-5 rad, with each law: with a force range, a gear, a range of the command, and `ref`."""
    package = generate(urdf(ARM).encode(), Target("Arm", "Arm"))
    # as `simulate` does: rumoca refuses an extension that binds inputs
    texts = {path: part.replace("Blocks.Interfaces.RealInput", "Blocks.Interfaces.RealOutput")
             for path, part in package.texts.items()}  # fmt: skip
    text = "model Go\n  import Modelica;\n  import UrdfSync;\n  import Arm;\n  extends Arm.ArmRun;\nequation\n"
    text += "".join(f"  {name} = {value!r};\n" for name, value in COMMANDS.items()) + "end Go;\n"
    task = Task(text, "Go", [Run(1.0, 0.05, tolerance=1e-9)], list(POSITIONS.values()))
    (series,) = simulate(modelica_library, [dataclasses.replace(package, texts=texts).write(tmp_path)], [task])
    ours = np.array([series.values[variable] for variable in POSITIONS.values()]).T
    expected = mujoco_positions(series.times)
    assert np.abs(expected).max(axis=0).min() > 0.05
    assert np.abs(ours - expected).max(axis=0) == pytest.approx(0, abs=1e-5)
