"""The library's examples: controllers follow, and generated packages are what their robots are.

That each kind of link and joint compiles, tests/formats/urdf/test_artifacts.py shows with one of everything.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from support import physics
from support.modelica import GRAVITY, URDFSYNC, Array, Run, Series, compile_task, simulate

from urdfsync.modelica.names import class_name

pytestmark = pytest.mark.slow
LONG = pytest.mark.large
"""Of what another example shows as well, with a smaller robot or one that is read from a record."""

ANGLES = ["shoulder.revolute.phi", "shoulder.revolute.w", "elbow.revolute.phi", "elbow.revolute.w"]
SWING = "robot.boom_swing.revolute.phi"


@LONG
@pytest.mark.parametrize(("name", "base"), [("wheeled_robot", "floating"), ("six_axis_arm", "fixed")])
def test_generated_examples_move_as_pinocchio_says(
    name: str, base: str, modelica_library: Path, tmp_path: Path
) -> None:
    source = URDFSYNC / "Resources" / "robots" / name / f"{name}.urdf"
    case = physics.prepare(source.read_bytes(), class_name(name), base=base)
    (deviations,) = physics.compare(modelica_library, tmp_path, [case])
    assert physics.fault(deviations) is None
    assert case.experiment.notes == ()


def test_examples_made_by_hand(modelica_library: Path) -> None:
    """A double pendulum loses energy by friction alone, and a bench holds the axis that it names."""
    tasks = [
        compile_task("UrdfSync.Examples.DoublePendulum", runs=[Run(2, 0.05)], values=ANGLES),
        compile_task("UrdfSync.Examples.HoldingTorque", runs=[Run(0.5, 0.1)], values=[SWING]),
    ]
    pendulum, bench = simulate(modelica_library, [], tasks)
    energy = pendulum_energy(*(pendulum.values[name] for name in ANGLES))
    assert (np.diff(energy) < 1e-6).all()
    assert energy[-1] < energy[0] - 0.1
    assert np.abs(bench.values[SWING]).max() < 1e-6


def pendulum_energy(phi: Array, w: Array, psi: Array, v: Array) -> Array:
    """Kinetic and potential energy of the example, from its masses, lengths and inertias; both axes lie along y."""
    heights = [-0.25 * np.cos(phi), -0.5 * np.cos(phi) - 0.3 * np.cos(phi + psi)]
    along = 0.5 * w * np.cos(phi) + 0.3 * (w + v) * np.cos(phi + psi)
    across = 0.5 * w * np.sin(phi) + 0.3 * (w + v) * np.sin(phi + psi)
    kinetic = 0.5 * (1.2 * (0.25 * w) ** 2 + 0.025 * w**2 + 0.6 * (along**2 + across**2) + 0.0006 * (w + v) ** 2)
    return np.asarray(kinetic + GRAVITY * (1.2 * heights[0] + 0.6 * heights[1]))


WAY = {"phi[1]": 0.8, "phi[2]": 0.7, "phi[3]": 0.2, "phi[6]": -0.6}
"""Where some axes of the arm are to be after the motion."""


def example(library: Path, model: str, stop: float, values: list[str]) -> Series:
    """An example as it stands but for what is drawn, with results every 10 ms."""
    runs = [Run(stop, 0.01, tolerance=1e-6)]
    task = compile_task(f"UrdfSync.Examples.{model}(world(enableAnimation = false))", runs=runs, values=values)
    (series,) = simulate(library, [], [task])
    return series


@LONG
@pytest.mark.parametrize("model", ["ComputedTorque", "ComputedTorquePackage"])
def test_computed_torque_follows_the_motion(modelica_library: Path, model: str) -> None:
    """Gravity, inertia and friction of the arm are all met: the error is a thousandth of the way."""
    errors = [f"controller.error[{i}]" for i in range(1, 7)]
    series = example(modelica_library, model, 0.62, [*errors, *WAY, "controller.tau[2]"])
    assert 0 < max(np.abs(series.values[name]).max() for name in errors) < 1e-4
    assert series.end(*WAY) == pytest.approx(list(WAY.values()), abs=1e-4)
    assert np.ptp(series.values["controller.tau[2]"]) > 10, "it takes torque"


@LONG
@pytest.mark.parametrize("model", ["ToolPath", pytest.param("ToolPathPackage", marks=LONG)])
def test_the_tool_follows_the_circle(modelica_library: Path, model: str) -> None:
    """The first part of it, nearly a radius to the side; it keeps its attitude, and no axis swings."""
    tool = [f"r_tool[{i}]" for i in (1, 2, 3)]
    errors = [f"controller.error[{i}]" for i in (1, 2, 3)]
    attitude = [f"R_tool[{i},{j}]" for i in (1, 2, 3) for j in (1, 2, 3)]
    speeds = [f"w[{i}]" for i in range(1, 7)]
    series = example(modelica_library, model, 0.6, [*errors, *tool, *attitude, *speeds, "controller.angle"])
    assert max(np.ptp(series.values[name]) for name in attitude) < 0.08
    assert max(np.abs(series.values[name]).max() for name in speeds) < 2
    assert 0 < np.abs([series.values[name] for name in errors]).max() < 0.004
    way = np.array([series.values[name] - series.values[name][0] for name in tool])
    angle = series.values["controller.angle"]
    assert way[1][-1] > 0.07
    expected = 0.1 * np.array([0 * angle, np.sin(angle), 1 - np.cos(angle)])
    assert np.abs(way - expected).max() < 0.004
