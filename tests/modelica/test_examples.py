"""The library's examples: those made by hand simulate, those made by urdfsync compile."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from support import modelica
from support.modelica import Run, Task

pytestmark = pytest.mark.slow

GENERATED = ("SixAxisArm", "WheeledRobot", "PlanarPlatform", "FloatingBuoy")


@pytest.mark.parametrize("name", GENERATED)
def test_the_quick_check_of_a_generated_example_compiles(modelica_library: Path, name: str) -> None:
    probe = modelica.compile_task(f"UrdfSync.Examples.{name}.{name}Test")
    (outcome,) = modelica.execute(modelica_library, [], [probe])
    assert not outcome.error


def test_a_double_pendulum_loses_energy_by_friction_alone(modelica_library: Path) -> None:
    probe = modelica.compile_task("UrdfSync.Examples.DoublePendulum")
    angles = ["shoulder.revolute.phi", "shoulder.revolute.w", "elbow.revolute.phi", "elbow.revolute.w"]
    task = Task(probe.source, probe.model, [Run(2, 0.05)], angles)
    (outcome,) = modelica.execute(modelica_library, [], [task])
    assert not outcome.error
    (series,) = outcome.runs
    assert not series.error
    energy = pendulum_energy(*(series.values[name] for name in angles))
    assert (np.diff(energy) < 1e-6).all()
    assert energy[-1] < energy[0] - 0.1


def pendulum_energy(phi: modelica.Array, w: modelica.Array, psi: modelica.Array, v: modelica.Array) -> modelica.Array:
    """Kinetic and potential energy of the example, from its masses, lengths and inertias; both axes lie along y."""
    heights = [-0.25 * np.cos(phi), -0.5 * np.cos(phi) - 0.3 * np.cos(phi + psi)]
    along = 0.5 * w * np.cos(phi) + 0.3 * (w + v) * np.cos(phi + psi)
    across = 0.5 * w * np.sin(phi) + 0.3 * (w + v) * np.sin(phi + psi)
    kinetic = 0.5 * (1.2 * (0.25 * w) ** 2 + 0.025 * w**2 + 0.6 * (along**2 + across**2) + 0.0006 * (w + v) ** 2)
    potential = 9.80665 * (1.2 * heights[0] + 0.6 * heights[1])
    return np.asarray(kinetic + potential)


def test_a_bench_by_hand_holds_the_axis_that_it_names(modelica_library: Path) -> None:
    probe = modelica.compile_task("UrdfSync.Examples.HoldingTorque")
    task = Task(probe.source, probe.model, [Run(0.5, 0.1)], ["robot.boom_swing.revolute.phi"])
    (outcome,) = modelica.execute(modelica_library, [], [task])
    assert not outcome.error
    (series,) = outcome.runs
    assert not series.error
    assert np.abs(series.values["robot.boom_swing.revolute.phi"]).max() < 1e-6
