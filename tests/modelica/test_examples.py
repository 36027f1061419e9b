"""The library's examples: those made by hand simulate, those made by urdfsync compile."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from support import modelica
from support.modelica import Run, Series, Task

pytestmark = pytest.mark.slow

GENERATED = ("WheeledRobot", "PlanarPlatform", "FloatingBuoy")
"""Without the six-axis arm: what extends it is compiled with the page on models of your own."""


def test_the_quick_checks_of_generated_examples_compile(modelica_library: Path) -> None:
    probes = [modelica.compile_task(f"UrdfSync.Examples.{name}.{name}Test") for name in GENERATED]
    outcomes = modelica.execute(modelica_library, [], probes)
    assert dict(zip(GENERATED, [outcome.error for outcome in outcomes], strict=True)) == dict.fromkeys(GENERATED, "")


ANGLES = ["shoulder.revolute.phi", "shoulder.revolute.w", "elbow.revolute.phi", "elbow.revolute.w"]
SWING = "robot.boom_swing.revolute.phi"


@pytest.fixture(scope="module")
def by_hand(modelica_library: Path) -> list[Series]:
    """The pendulum, and the bench that holds an axis."""
    pendulum, bench = (
        modelica.compile_task(f"UrdfSync.Examples.{name}") for name in ("DoublePendulum", "HoldingTorque")
    )
    tasks = [
        Task(pendulum.source, pendulum.model, [Run(2, 0.05)], ANGLES),
        Task(bench.source, bench.model, [Run(0.5, 0.1)], [SWING]),
    ]
    return modelica.simulate(modelica_library, [], tasks)


def test_a_double_pendulum_loses_energy_by_friction_alone(by_hand: list[Series]) -> None:
    series, _ = by_hand
    energy = pendulum_energy(*(series.values[name] for name in ANGLES))
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


def test_a_bench_by_hand_holds_the_axis_that_it_names(by_hand: list[Series]) -> None:
    _, series = by_hand
    assert np.abs(series.values[SWING]).max() < 1e-6
