"""The example that extends the six-axis arm: its parts by themselves; the package on the page compiles.

What an extension with such parts does to a whole robot is in test_custom_histories and test_customized.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from support.corpus import REPOSITORY
from support.modelica import GRAVITY, Run, Series, bench, compile_task, execute, simulate

pytestmark = pytest.mark.slow

PAGE = REPOSITORY / "docs/extending.md"

STIFFNESS, MASS, LEVER = 2e4, 3.0, 0.4
HELD = f"""UrdfSync.Examples.CustomArm.ElasticElbow elbow(c = {STIFFNESS}, fixedStart = false);
  Modelica.Mechanics.MultiBody.Parts.Body load(m = {MASS}, r_CM = {{{LEVER}, 0, 0}});
  Modelica.Mechanics.Rotational.Components.Fixed brake;
equation
  connect(world.frame_b, elbow.frame_a);
  connect(elbow.frame_b, load.frame_a);
  connect(brake.flange, elbow.axis);
"""
"""The elbow with its motor held, and a load on the arm."""

RATIO, ROTOR, INERTIA, ACCELERATION = 80.0, 3e-4, 0.7, 2.0
DAMPING, FRICTION = 12.0, 9.0
"""Of joint turret in the URDF."""
PLACE = 0.5
SPUN = f"""UrdfSync.Examples.CustomArm.GearedTurret turret(ratio = {RATIO}, J_rotor = {ROTOR}, fixedStart = false);
  UrdfSync.Examples.CustomArm.Imu imu(r = {{{PLACE}, 0, 0}});
  Modelica.Mechanics.MultiBody.Parts.Body load(m = 1, r_CM = {{0, 0, 0}}, I_33 = {INERTIA});
  Modelica.Mechanics.Rotational.Sources.Accelerate drive(phi(start = 0, fixed = true), w(start = 0, fixed = true));
  Modelica.Blocks.Sources.Constant acceleration(k = {ACCELERATION});
equation
  connect(world.frame_b, turret.frame_a);
  connect(turret.frame_b, load.frame_a);
  connect(turret.frame_b, imu.frame_a);
  connect(acceleration.y, drive.a_ref);
  connect(drive.flange, turret.axis);
"""
"""The turret speeds up evenly, with the sensor beside its axis."""

IMU = [f"imu.{signal}[{k}]" for signal in ("f", "w") for k in (1, 2, 3)]
"""The signals of the sensor."""


@pytest.fixture(scope="module")
def found(modelica_library: Path) -> Mapping[str, Series]:
    """What the elbow does, and the turret with the sensor."""
    tasks = [
        bench(HELD, [Run(2, 0.5)], ["elbow.axis.tau", "elbow.phi_elastic", "elbow.joint.revolute.w"], packages=()),
        bench(SPUN, [Run(1, 0.25)], ["turret.axis.tau", "turret.tau_motor", "turret.rotor.w", *IMU], packages=()),
    ]
    return dict(zip(("Held", "Spun"), simulate(modelica_library, [], tasks), strict=True))


def test_the_elastic_elbow_sags_until_its_spring_carries_the_load(found: Mapping[str, Series]) -> None:
    values = found["Held"].values
    torque = -MASS * GRAVITY * LEVER
    assert values["elbow.phi_elastic"][0] == 0
    assert abs(values["elbow.joint.revolute.w"][-1]) < 1e-6
    assert values["elbow.axis.tau"][-1] == pytest.approx(torque, rel=1e-5)
    assert values["elbow.phi_elastic"][-1] == pytest.approx(-torque / STIFFNESS, rel=1e-5)


def test_the_geared_turret_feels_its_rotor(found: Mapping[str, Series]) -> None:
    series = found["Spun"]
    speed = ACCELERATION * series.times
    losses = DAMPING * speed + FRICTION * np.tanh(50 * speed)
    torque = (INERTIA + ROTOR * RATIO**2) * ACCELERATION + losses
    assert series.values["turret.rotor.w"] == pytest.approx(RATIO * speed, rel=1e-6)
    assert series.values["turret.axis.tau"] == pytest.approx(torque, rel=1e-6)
    assert series.values["turret.tau_motor"] == pytest.approx(torque / RATIO, rel=1e-6)


def test_the_sensor_shows_what_it_feels_on_a_circle(found: Mapping[str, Series]) -> None:
    """Along the radius inwards, along the circle what speeds it up, and upwards what holds it against gravity."""
    series = found["Spun"]
    speed = ACCELERATION * series.times
    still = np.zeros_like(speed)
    expected = [-(speed**2) * PLACE, still + ACCELERATION * PLACE, still + GRAVITY, still, still, speed]
    assert np.array([series.values[name] for name in IMU]) == pytest.approx(np.array(expected), rel=1e-6, abs=1e-6)


@pytest.mark.large  # the models of the page move in the other tests of this file
def test_the_models_on_the_page_compile(modelica_library: Path, tmp_path: Path) -> None:
    """The page's first block is a package; its elbow has a brake, which the test model of the arm takes along."""
    (package, *_) = re.findall(r"```modelica\n(.*?)```", PAGE.read_text("utf-8"), re.DOTALL)
    (tmp_path / "MyArm.mo").write_text(package, encoding="utf-8")
    (outcome,) = execute(modelica_library, [tmp_path / "MyArm.mo"], [compile_task("MyArm.Test")])
    assert outcome.error == ""
