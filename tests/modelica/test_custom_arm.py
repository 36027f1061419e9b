"""The example that extends the six-axis arm: its parts by themselves, and the robot with all of them in balance."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from support.corpus import REPOSITORY
from support.modelica import GRAVITY, Run, Series, bench, compile_task, execute, simulate

pytestmark = pytest.mark.slow

URDF = REPOSITORY / "modelica/UrdfSync/Resources/robots/six_axis_arm/six_axis_arm.urdf"
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

STIFF = {"robot.elbow.c": 1e6, "robot.elbow.d": 1e4}
"""The arm sags by 0.03 mrad, and rests after some hundredths of a second."""
JOINTS = ("turret", "shoulder", "elbow", "forearm_roll", "wrist_pitch", "flange_roll")
BRAKES = "".join(f"  Modelica.Mechanics.Rotational.Components.Fixed {name}Brake;\n" for name in JOINTS)
BRAKED = "".join(f"  connect({name}Brake.flange, robot.{name}Axis);\n" for name in JOINTS)
OUTSTRETCHED = f"""UrdfSync.Examples.CustomArm.CustomArm robot(fixedStart = false);
{BRAKES}
  Modelica.Mechanics.Translational.Components.Fixed gripperBrake(s0 = robot.gripper_stroke.s_start);
equation
  connect(world.frame_b, robot.frame_a);
{BRAKED}
  connect(gripperBrake.flange, robot.gripper_strokeAxis);
"""
"""The whole robot, each motor held where it starts; the elbow alone can move, by its spring."""
PAYLOAD, PAYLOAD_LEVER = 1.5, 0.15 + 0.08
"""Mass of the valve block, and how far before the elbow's axis it is: origin of joint forearm_roll and centre."""


def static_torque() -> float:
    """What the elbow of the plain robot needs to hold the outstretched arm: Pinocchio reads the URDF."""
    model = pin.buildModelFromXML(URDF.read_text("utf-8"))
    model.gravity.linear = np.array([0, 0, -GRAVITY])
    torques = pin.computeGeneralizedGravity(model, model.createData(), pin.neutral(model))
    return float(torques[model.joints[model.getJointId("elbow")].idx_v])


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


@pytest.mark.large
def test_the_whole_arm_holds_itself_and_its_payload(modelica_library: Path) -> None:
    """The torque is that of the plain robot, as Pinocchio has it, and that of the payload, by hand."""
    runs, values = [Run(0.08, 0.04, STIFF)], ["robot.elbowAxis.tau", "robot.imu.f[3]"]
    (series,) = simulate(modelica_library, [], [bench(OUTSTRETCHED, runs, values, packages=())])
    expected = static_torque() - PAYLOAD * GRAVITY * PAYLOAD_LEVER
    assert series.values["robot.elbowAxis.tau"][0] == 0, "the spring is relaxed at the beginning"
    torque, force = series.end(*values)
    assert torque == pytest.approx(expected, rel=1e-4)
    assert force == pytest.approx(GRAVITY, rel=1e-3)


def test_the_example_and_the_models_on_the_page_compile(modelica_library: Path, tmp_path: Path) -> None:
    """The page's first block is a package; its elbow has a brake, which the test model of the arm takes along."""
    (package, *_) = re.findall(r"```modelica\n(.*?)```", PAGE.read_text("utf-8"), re.DOTALL)
    (tmp_path / "MyArm.mo").write_text(package, encoding="utf-8")
    tasks = [compile_task(model) for model in ("MyArm.Test", "UrdfSync.Examples.CustomArm.CustomArmTest")]
    assert [one.error for one in execute(modelica_library, [tmp_path / "MyArm.mo"], tasks)] == ["", ""]
