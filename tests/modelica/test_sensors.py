"""Sensors in simulation against Pinocchio, with the signs and axes of ROS."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from support import physics
from support.modelica import Array, Run, Task, bench, simulate
from support.packages import generate
from support.urdfs import joint, links, robot

from urdfsync.domain import Target
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.parse.source import read_robot
from urdfsync.formats.urdf.physics import motion
from urdfsync.formats.urdf.physics.reference import Reference, read

pytestmark = pytest.mark.slow


def gazebo(at: str, name: str, kind: str, inside: str = "") -> str:
    return f'<gazebo reference="{at}"><sensor name="{name}" type="{kind}">{inside}</sensor></gazebo>'


WRENCH = "<force_torque><frame>{}</frame><measure_direction>{}</measure_direction></force_torque>"
ARM = robot(
    *links(base=4.0, upper=2.5, fore=1.5, hand=0.7),
    joint("shoulder", "revolute", "base", "upper", axis="0 1 0"),
    joint("elbow", "continuous", "upper", "fore", axis="0.3 -0.4 1.2"),
    joint("wrist", "fixed", "fore", "hand"),
    gazebo("hand", "imu", "imu", "<pose>0.1 0.2 -0.3 0.4 -0.5 0.6</pose>"),
    gazebo("hand", "accelerometer", "accelerometer", "<pose>0.1 0.2 -0.3 0.4 -0.5 0.6</pose>"),
    gazebo("hand", "gyroscope", "gyroscope", "<pose>0.1 0.2 -0.3 0.4 -0.5 0.6</pose>"),
    gazebo("elbow", "load", "force_torque"),
    gazebo("wrist", "grip", "force_torque", WRENCH.format("parent", "parent_to_child")),
    gazebo(
        "shoulder",
        "cell",
        "force_torque",
        "<pose>0 0 0 0.3 0.2 0.1</pose>" + WRENCH.format("sensor", "child_to_parent"),
    ),
)
LOOKING = robot(
    *links(base=4.0, upper=2.5),
    joint("shoulder", "revolute", "base", "upper", axis="0 1 0"),
    gazebo("base", "camera", "camera", "<camera><horizontal_fov>1.2</horizontal_fov></camera>"),
    '<sensor name="scan"><parent link="upper"/><origin xyz="1 2 3" rpy="0.1 0 0"/><ray/></sensor>',
)
JOINTS = {"load": "elbow", "grip": "wrist", "cell": "shoulder"}
VALUES = [
    *(f"robot.{part}[{i}]" for part in ("imu.a", "imu.w", "accelerometer.a", "gyroscope.w") for i in (1, 2, 3)),
    *(f"robot.{sensor}.{part}[{i}]" for sensor in JOINTS for part in "ft" for i in (1, 2, 3)),
]


def expected(instant: motion.Instant) -> Array:
    """What Pinocchio says of the `VALUES`; to it the wrist is a joint that does not move, since it joins fixed ones."""
    content = ARM.replace('name="wrist" type="fixed"', 'name="wrist" type="continuous"').encode()
    tree = KinematicTree.of(read_robot(ARM.encode(), "arm.urdf").robot)  # type: ignore[arg-type]
    axes = motion.driven_axes(tree)
    reference = Reference(read(content, "arm.urdf"), [each.name for each in axes])
    courses = [motion.axis_courses(each, 0.0)[instant] for each in axes]
    model = reference.multibody.model
    state = reference.state(courses, [each[instant] for each in motion.base_courses()])
    hand = model.frames[model.getFrameId("hand", pin.BODY)]
    place = pin.SE3(pin.rpy.rpyToMatrix(0.4, -0.5, 0.6), np.array([0.1, 0.2, -0.3]))
    imu = model.addFrame(pin.Frame("imu", hand.parentJoint, hand.placement * place, pin.OP_FRAME))
    data = model.createData()
    pin.rnea(model, data, state.q, state.v, state.a)
    forces = {name: data.f[model.getJointId(at)].vector.copy() for name, at in JOINTS.items()}
    pin.forwardKinematics(model, data, state.q, state.v, state.a)
    pin.updateFramePlacements(model, data)
    gravity = data.oMf[imu].rotation.T @ np.array([0, 0, -motion.GRAVITY])
    acceleration = pin.getFrameClassicalAcceleration(model, data, imu, pin.LOCAL).linear - gravity
    velocity = pin.getFrameVelocity(model, data, imu, pin.LOCAL).angular
    turned = {
        "load": -np.eye(3),
        "grip": data.oMi[model.getJointId("elbow")].rotation.T @ data.oMi[model.getJointId("wrist")].rotation,
        "cell": -pin.rpy.rpyToMatrix(0.3, 0.2, 0.1).T,
    }
    wrenches = [turned[name] @ part for name, f in forces.items() for part in (f[:3], f[3:])]
    return np.concatenate([acceleration, velocity, acceleration, velocity, *wrenches])


def test_sensors_show_what_pinocchio_says_in_motion(modelica_library: Path, tmp_path: Path) -> None:
    """The base and all joints move; Pinocchio's wrenches are those of the parent on the child, in the child's axes."""
    case = physics.prepare(ARM.encode(), "Arm").only("motion")
    probe = case.experiment.trials[0].probe
    assert set(VALUES) <= set(probe.values), "the check looks at them, too"
    task = Task(probe.source, probe.model, [Run(probe.stop, probe.step)], VALUES)
    (series,) = simulate(modelica_library, [case.package.write(tmp_path)], [task])
    for instant in (motion.Instant.START, motion.Instant.FAST):
        found, wanted = np.array([series.values[value][instant] for value in VALUES]), expected(instant)
        assert found == pytest.approx(wanted, rel=1e-9, abs=1e-9 * np.abs(wanted).max())


PHONE = robot(
    *links(table=1.0, phone=2.0),
    joint("glue", "fixed", "table", "phone", rpy="0 0 0"),
    gazebo("phone", "flat", "imu"),
    gazebo("phone", "upright", "imu", "<pose>0 0 0 1.5707963267948966 0 0</pose>"),
    gazebo("glue", "scale", "force_torque"),
)


def test_at_rest_an_imu_shows_gravity_upwards_and_a_joint_the_weight_on_its_parent(
    modelica_library: Path, tmp_path: Path
) -> None:
    """An IMU that was rolled by a quarter has the vertical on y."""
    package = generate(PHONE.encode(), Target("Phone", "Phone"))
    body = "extends Phone.PhoneRun(world(g = 9.81));\n  equation"
    values = [f"{name}[{i}]" for name in ("flat_a", "upright_a", "flat_w", "scale_f") for i in (1, 2, 3)]
    source = f"model Rest\n  import Modelica;\n  import UrdfSync;\n  import Phone;\n  {body}\nend Rest;\n"
    (series,) = simulate(modelica_library, [package.write(tmp_path)], [Task(source, "Rest", [Run(0.1, 0.1)], values)])
    wanted = [0, 0, 9.81, 0, 9.81, 0, 0, 0, 0, 0, 0, -19.62]
    assert series.end(*values) == pytest.approx(wanted, abs=1e-9)


def test_frames_of_cameras_and_scanners_are_where_the_source_places_them(
    modelica_library: Path, tmp_path: Path
) -> None:
    """All joints at zero; the numbers are those of the record."""
    package = generate(LOOKING.encode(), Target("Arm", "Arm"))
    body = """Arm.Arm robot;
    Real angle = robot.camera.parameters.horizontalAngle + 0*time;
  equation
    connect(world.frame_b, robot.frame_a);"""
    values = [f"robot.scanFrame.r_0[{i}]" for i in (1, 2, 3)] + ["angle"]
    task = bench(body, [Run(1e-6, 1e-6)], values, packages=["Arm"])
    (series,) = simulate(modelica_library, [package.write(tmp_path)], [task])
    shoulder = pin.SE3(pin.rpy.rpyToMatrix(0.5, -0.6, 0.7), np.array([0.1, -0.2, 0.3]))
    place = shoulder.act(np.array([1.0, 2.0, 3.0]))
    assert [series.values[value][0] for value in values] == pytest.approx([*place, 1.2], abs=1e-9)
