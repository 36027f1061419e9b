"""The example robots: other readers take them without a word, and they are what their comments say."""

from __future__ import annotations

import math
import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
import pytest
import yourdfpy
from numpy.typing import NDArray

from urdfsync.urdf.parse.source import read_robot

Array = NDArray[np.float64]

ROOT = Path(__file__).resolve().parents[1]
ROBOTS = ROOT / "modelica" / "UrdfSync" / "Resources" / "robots"
SOURCES = sorted(ROBOTS.glob("*/*.urdf"))
MESHES = sorted(ROBOTS.glob("*/meshes/*"))
TOTAL_MASS = {"floating_buoy": 63.3, "planar_platform": 11.9, "six_axis_arm": 52.345, "wheeled_robot": 36.1}
NOMINAL_HEIGHT = 0.1

every_robot = pytest.mark.parametrize("source", SOURCES, ids=lambda path: path.stem)


def model_of(name: str) -> pin.Model:
    return pin.buildModelFromUrdf(str(ROBOTS / name / f"{name}.urdf"))


def lowest_point(transform: Array, geometry: Any) -> float:
    """Height of the lowest point of a collision shape placed at `transform`."""
    z = transform[2, :3]
    if geometry.box is not None:
        reach = np.abs(z) @ np.asarray(geometry.box.size) / 2
    else:
        r, h = geometry.cylinder.radius, geometry.cylinder.length
        reach = abs(z[2]) * h / 2 + r * math.hypot(z[0], z[1])
    return float(transform[2, 3] - reach)


def test_there_are_examples_for_every_joint_type_and_mesh_format() -> None:
    read = [read_robot(source.read_bytes(), source.name).robot for source in SOURCES]
    types = {joint.type for robot in read if robot for joint in robot.joints}
    assert types == {"fixed", "continuous", "revolute", "prismatic", "planar", "floating"}
    assert {path.suffix for path in MESHES} == {".stl", ".obj", ".dae"}


@every_robot
def test_urdfsync_has_nothing_to_say_about_it(source: Path) -> None:
    reading = read_robot(source.read_bytes(), source.name)
    assert reading.diagnostics == ()
    assert reading.robot is not None


@every_robot
def test_pinocchio_reads_it_without_a_word(source: Path, capfd: pytest.CaptureFixture[str]) -> None:
    model = pin.buildModelFromUrdf(str(source), pin.JointModelFreeFlyer())
    assert pin.computeTotalMass(model) == pytest.approx(TOTAL_MASS[source.stem], rel=1e-12)
    assert capfd.readouterr() == ("", "")


def test_meshes_are_what_their_script_writes() -> None:
    written = runpy.run_path(str(ROOT / "tools" / "make_example_meshes.py"))["meshes"]()
    assert written == {path.relative_to(ROBOTS): path.read_bytes() for path in MESHES}


def test_the_arm_reaches_its_wrist_centre_to_0_89_m() -> None:
    model = model_of("six_axis_arm")
    data = model.createData()
    q = pin.neutral(model)
    q[model.joints[model.getJointId("shoulder")].idx_q] = math.pi / 2
    q[model.joints[model.getJointId("elbow")].idx_q] = math.atan2(0.04, 0.42) - math.pi / 2
    pin.framesForwardKinematics(model, data, q)
    wrist = data.oMf[model.getFrameId("wrist")].translation
    assert math.hypot(wrist[0], wrist[1]) == pytest.approx(0.03 + 0.44 + math.hypot(0.42, 0.04), abs=1e-9)


@pytest.mark.parametrize("shoulder", [0.0, 0.8, math.pi / 2])
@pytest.mark.parametrize("elbow", [0.0, -0.8, -math.pi / 2])
@pytest.mark.parametrize("pitch", [0.0, math.pi / 2])
def test_the_arm_holds_7_kg_with_two_thirds_of_its_torque(shoulder: float, elbow: float, pitch: float) -> None:
    model = model_of("six_axis_arm")
    mount = model.getFrameId("grasp_point")
    payload = pin.Inertia(7.0, np.array([0.0, 0.0, -0.06]), 7 * 0.005 * np.eye(3))
    model.appendBodyToJoint(model.frames[mount].parentJoint, payload, model.frames[mount].placement)
    q = pin.neutral(model)
    for name, value in (("shoulder", shoulder), ("elbow", elbow), ("wrist_pitch", pitch)):
        q[model.joints[model.getJointId(name)].idx_q] = value
    torque = pin.computeGeneralizedGravity(model, model.createData(), q)
    arm = slice(0, 6)
    assert np.all(np.abs(torque[arm]) <= 2 / 3 * model.upperEffortLimit[arm])


@pytest.mark.parametrize("swivel", [0.0, 1.0, -2.5])
def test_at_its_nominal_height_the_wheeled_robot_stands_on_its_wheels_and_on_nothing_else(swivel: float) -> None:
    urdf: Any = yourdfpy.URDF.load(str(ROBOTS / "wheeled_robot/wheeled_robot.urdf"), load_meshes=False)
    urdf.update_cfg({"caster_swivel": swivel, "head_tilt": 0.5})
    for link in urdf.robot.links:
        for collision in link.collisions:
            placed = urdf.get_transform(link.name, "base_link") @ (
                np.eye(4) if collision.origin is None else collision.origin
            )
            height = NOMINAL_HEIGHT + lowest_point(placed, collision.geometry)
            if "wheel" in link.name:
                assert height == pytest.approx(0, abs=1e-8), link.name
            else:
                assert height > 0.04, link.name
