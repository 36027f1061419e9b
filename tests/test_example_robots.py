"""The example robots: other readers take them without a word, and their numbers are physically right."""

from __future__ import annotations

import itertools
import math
import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
import pytest
import trimesh
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


def mesh_file(source: Path, filename: str) -> Path:
    if filename.startswith("package://"):
        return ROBOTS / filename.removeprefix("package://")
    return source.parent / filename


def load_mesh(path: Path) -> trimesh.Trimesh:
    scene = trimesh.load_scene(path)
    mesh = scene.to_mesh()
    assert isinstance(mesh, trimesh.Trimesh)
    return mesh


def read(source: Path, *, load_meshes: bool = False) -> Any:
    def find(fname: str) -> str:
        return str(mesh_file(source, fname))

    return yourdfpy.URDF.load(str(source), load_meshes=load_meshes, filename_handler=find)


def robot(name: str) -> Any:
    return read(ROBOTS / name / f"{name}.urdf")


def model_of(name: str) -> pin.Model:
    return pin.buildModelFromUrdf(str(ROBOTS / name / f"{name}.urdf"))


def pose(origin: Array | None) -> Array:
    return np.eye(4) if origin is None else np.asarray(origin, dtype=float)


def solid(source: Path, geometry: Any) -> tuple[float, Array, Array]:
    """Volume, centre and inertia tensor (density 1, about the centre) of a shape."""
    if geometry.box is not None:
        x, y, z = geometry.box.size
        volume = x * y * z
        return volume, np.zeros(3), volume / 12 * np.diag([y * y + z * z, x * x + z * z, x * x + y * y])
    if geometry.cylinder is not None:
        r, h = geometry.cylinder.radius, geometry.cylinder.length
        volume = math.pi * r * r * h
        across = (3 * r * r + h * h) / 12
        return volume, np.zeros(3), volume * np.diag([across, across, r * r / 2])
    if geometry.sphere is not None:
        r = geometry.sphere.radius
        volume = 4 / 3 * math.pi * r**3
        return volume, np.zeros(3), volume * 0.4 * r * r * np.eye(3)
    mesh = load_mesh(mesh_file(source, geometry.mesh.filename))
    mesh.apply_scale(1 if geometry.mesh.scale is None else geometry.mesh.scale)
    return float(mesh.volume), mesh.center_mass, mesh.moment_inertia


def spread_evenly(source: Path, link: Any) -> tuple[float, Array, Array]:
    """Volume, centre and inertia per mass of a link whose mass fills its visual shapes evenly; overlaps count twice."""
    parts = []
    for visual in link.visuals:
        volume, centre, inertia = solid(source, visual.geometry)
        rotation, shift = pose(visual.origin)[:3, :3], pose(visual.origin)[:3, 3]
        parts.append((volume, rotation @ centre + shift, rotation @ inertia @ rotation.T))
    total = sum(volume for volume, _, _ in parts)
    centre = sum((volume * place for volume, place, _ in parts), np.zeros(3)) / total
    tensor = np.zeros((3, 3))
    for volume, place, inertia in parts:
        d = place - centre
        tensor += inertia + volume * (d @ d * np.eye(3) - np.outer(d, d))
    return total, centre, tensor / total


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
    types = {joint.type for source in SOURCES for joint in read(source).robot.joints}
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


@every_robot
def test_inertials_are_those_of_the_visual_shapes(source: Path) -> None:
    for link in read(source).robot.links:
        if link.inertial is None:
            continue
        volume, centre, tensor = spread_evenly(source, link)
        frame = pose(link.inertial.origin)
        inertia = frame[:3, :3] @ link.inertial.inertia @ frame[:3, :3].T
        expected = tensor * link.inertial.mass
        assert frame[:3, 3] == pytest.approx(centre, abs=0.6e-4), link.name
        assert np.abs(inertia - expected).max() < 1e-3 * np.abs(expected).max(), link.name
        assert 300 < link.inertial.mass / volume < 7900, link.name


@every_robot
def test_inertias_belong_to_real_bodies(source: Path) -> None:
    for link in read(source).robot.links:
        if link.inertial is None:
            continue
        small, middle, large = np.linalg.eigvalsh(link.inertial.inertia)
        assert small > 0, link.name
        assert small + middle >= large, link.name


@every_robot
def test_moving_axes_lose_energy_and_keep_their_soft_limits_inside(source: Path) -> None:
    for joint in read(source).robot.joints:
        if joint.type in ("revolute", "continuous", "prismatic"):
            assert float(joint.dynamics.damping) > 0, joint.name
            assert float(joint.dynamics.friction) > 0, joint.name
        if joint.safety_controller is not None:
            soft, hard = joint.safety_controller, joint.limit
            assert hard.lower < soft.soft_lower_limit < soft.soft_upper_limit < hard.upper, joint.name


@pytest.mark.parametrize("path", MESHES, ids=lambda path: path.name)
def test_meshes_are_small_closed_solids(path: Path) -> None:
    mesh = load_mesh(path)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume > 0
    assert path.stat().st_size < 100_000


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


@pytest.mark.parametrize("stroke", [0.0, 0.02, 0.035])
def test_the_fingers_open_symmetrically_and_the_pinion_rolls_on_their_racks(stroke: float) -> None:
    urdf = robot("six_axis_arm")
    joint = urdf.joint_map["pinion_coupling"]
    urdf.update_cfg({"gripper_stroke": stroke})
    pads = []
    for side in ("finger_left", "finger_right"):
        pad = next(visual for visual in urdf.link_map[side].visuals if visual.name == "pad")
        inner = np.array([-pad.geometry.box.size[0] / 2, 0, 0, 1])
        pads.append((urdf.get_transform(side, "gripper_body") @ pad.origin @ inner)[:3])
    assert pads[0] == pytest.approx(pads[1] * [-1, 1, 1], abs=1e-8)
    assert pads[0][0] == pytest.approx(stroke, abs=1e-8)
    assert joint.mimic.multiplier * 0.0125 == 1
    assert joint.mimic.multiplier * stroke <= joint.limit.upper


@pytest.mark.parametrize("swivel", [0.0, 1.0, -2.5])
def test_at_its_nominal_height_the_wheeled_robot_stands_on_its_wheels_and_on_nothing_else(swivel: float) -> None:
    urdf = robot("wheeled_robot")
    urdf.update_cfg({"caster_swivel": swivel, "head_tilt": 0.5})
    for link in urdf.robot.links:
        for collision in link.collisions:
            placed = urdf.get_transform(link.name, "base_link") @ pose(collision.origin)
            height = NOMINAL_HEIGHT + lowest_point(placed, collision.geometry)
            if "wheel" in link.name:
                assert height == pytest.approx(0, abs=1e-8), link.name
            else:
                assert height > 0.04, link.name


@pytest.mark.parametrize("swivel", np.linspace(-math.pi, math.pi, 5).tolist())
@pytest.mark.parametrize("lift", [0.0, 0.35])
def test_the_wheeled_robot_rests_stably(swivel: float, lift: float) -> None:
    model = model_of("wheeled_robot")
    data = model.createData()
    q = pin.neutral(model)
    q[model.joints[model.getJointId("lift")].idx_q] = lift
    joint = model.joints[model.getJointId("caster_swivel")]
    q[joint.idx_q : joint.idx_q + 2] = math.cos(swivel), math.sin(swivel)
    x, y, _ = pin.centerOfMass(model, data, q)
    pin.framesForwardKinematics(model, data, q)
    contacts = [
        data.oMf[model.getFrameId(name)].translation[:2] for name in ("wheel_left", "caster_wheel", "wheel_right")
    ]
    for a, b in itertools.pairwise([*contacts, contacts[0]]):
        edge = b - a
        inside = (edge[0] * (y - a[1]) - edge[1] * (x - a[0])) / math.hypot(*edge)
        assert inside > 0.04
