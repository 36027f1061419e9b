"""What is built around a robot: controllers, in both approaches, and forces at the tool frame of a record's robot."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from support import generic
from support.modelica import Array, Run, Series, Task, compile_task, simulate
from test_generic import GRIPPER

pytestmark = pytest.mark.slow

FORCE = (3.0, -4.0, 5.0)
PULLED = """
package Pulled_
  import Modelica;
  import UrdfSync;
  import Bot;
  model Pulled
    inner Modelica.Mechanics.MultiBody.World world(n = {{0, 0, -1}}, g = 9.81, enableAnimation = false);
    UrdfSync.Robots.{form} robot(redeclare parameter Bot.BotParameters data, tool = {tool}, checkLimits = false);
    Modelica.Mechanics.MultiBody.Forces.WorldForce pull(animation = false);
  equation
    connect(world.frame_b, robot.frame_a);
    connect(robot.frame_b, pull.frame_b);
    pull.force = {{3, -4, 5}};
  end Pulled;
end Pulled_;
"""
"""A force of the world acts on a link."""
WAY = {"phi[1]": 0.8, "phi[2]": 0.7, "phi[3]": 0.2, "phi[6]": -0.6}
"""Where some axes of the arm are to be after the motion."""


@pytest.mark.parametrize("link", ["wheel", "sensor", "plate"])
def test_a_force_at_the_tool_frame_accelerates_the_robot_as_pinocchio_says(
    modelica_library: Path, tmp_path: Path, link: str
) -> None:
    """A link behind a moving joint, one behind a fixed joint of another body, and one that does not move."""
    own = generic.prepare(GRIPPER.encode())
    tool = [each.name for each in own.skeleton.links].index(link) + 1
    values = ["robot.a_phi[1]", "robot.a_phi[2]", "robot.a_s[1]"]
    tasks = [
        Task(PULLED.format(form=form, tool=tool), "Pulled_.Pulled", [Run(1e-6, 1e-6)], values) for form in generic.FORMS
    ]
    expected = accelerations(own, link)
    for series in simulate(modelica_library, [own.package.write(tmp_path)], tasks):
        assert [series.values[value][0] for value in values] == pytest.approx(expected, abs=1e-8)
    assert (np.abs(expected - accelerations(own, "base")).max() > 0.1) == (link != "plate")


def accelerations(own: generic.Robot, link: str) -> Array:
    """Of the axes at rest at their start, with the Jacobian of the link."""
    reference = own.reference
    pin, model = reference.pin, reference.model
    state = generic.at_rest(own, np.zeros(len(reference.axes)), np.zeros(len(reference.axes)))
    data = model.createData()
    bias = pin.nonLinearEffects(model, data, state.q, np.zeros(model.nv))
    frame = model.getFrameId(link, pin.BODY)
    jacobian = pin.computeFrameJacobian(model, data, state.q, frame, pin.LOCAL_WORLD_ALIGNED)[:3]
    return generic.forward(reference, state, bias - jacobian.T @ np.array(FORCE))


def example(library: Path, model: str, stop: float, values: list[str]) -> Series:
    """An example as it stands, with results every 10 ms."""
    task = compile_task(f"UrdfSync.Examples.{model}")
    (series,) = simulate(library, [], [Task(task.source, task.model, [Run(stop, 0.01, tolerance=1e-6)], values)])
    return series


@pytest.mark.parametrize("model", ["ComputedTorque", "ComputedTorquePackage"])
def test_computed_torque_follows_the_motion(modelica_library: Path, model: str) -> None:
    """Gravity, inertia and friction of the arm are all met: the error is a thousandth of the way."""
    errors = [f"controller.error[{i}]" for i in range(1, 7)]
    series = example(modelica_library, model, 0.62, [*errors, *WAY, "controller.tau[2]"])
    worst = max(np.abs(series.values[name]).max() for name in errors)
    assert 0 < worst < 1e-4
    for name, position in WAY.items():
        assert series.values[name][-1] == pytest.approx(position, abs=1e-4)
    assert np.ptp(series.values["controller.tau[2]"]) > 10, "it takes torque"


@pytest.mark.parametrize("model", ["ToolPath", "ToolPathPackage"])
def test_the_tool_follows_the_circle(modelica_library: Path, model: str) -> None:
    """The first part of it, nearly a radius to the side."""
    tool = [f"r_tool[{i}]" for i in (1, 2, 3)]
    errors = [f"controller.error[{i}]" for i in (1, 2, 3)]
    series = example(modelica_library, model, 0.6, [*errors, *tool, "controller.angle"])
    assert 0 < np.abs([series.values[name] for name in errors]).max() < 0.004
    way = np.array([series.values[name] - series.values[name][0] for name in tool])
    angle = series.values["controller.angle"]
    assert way[1][-1] > 0.07
    expected = 0.1 * np.array([0 * angle, np.sin(angle), 1 - np.cos(angle)])
    assert np.abs(way - expected).max() < 0.004
