"""What is read of a source once more, since the reader is under test."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pinocchio as pin
import pytest
from support.modelica import URDFSYNC
from support.numbers import BOT, compare, of_package
from support.packages import generate
from support.urdfs import dynamics, joint, limit, link, links, robot

from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.parse.source import read_robot
from urdfsync.formats.urdf.physics.motion import GRAVITY, Course
from urdfsync.formats.urdf.physics.reference import Reference, read
from urdfsync.formats.urdf.robot import SENSOR_KINDS, Output, SensorKind
from urdfsync.formats.urdf.second.reading import read_again

SOURCE = """\
<robot name="bot">
  <link name="base"/><link name="arm"><inertial><mass value="1"/></inertial></link>
  <joint name="elbow" type="continuous"><parent link="base"/><child link="arm"/></joint>
  {}
</robot>
"""


def test_both_readers_find_the_same_place_of_a_sensor() -> None:
    poses = (
        "<pose>1 2 3 0.4 0.5 0.6</pose>",
        "<pose degrees='true'>1 2 3 30 40 50</pose>",
        "",
        "<pose>1 2 3 4 5 x</pose>",
    )
    sensors = "".join(f'<sensor name="s{k}" type="imu">{pose}</sensor>' for k, pose in enumerate(poses))
    sensors += f'<sensor name="a/b" type="imu">{poses[1]}</sensor><sensor type="imu">{poses[0]}</sensor>'
    own = '<sensor name="s4"><parent link="arm"/><origin xyz="1 2 3" rpy="0.4 0.5 0.6"/><imu/></sensor>'
    twin = "<gazebo reference='base'><sensor name='s0' type='imu'><pose>7 8 9 0 0 0</pose></sensor></gazebo>"
    text = SOURCE.format(f'{twin}<gazebo reference="arm">{sensors}</gazebo>{own}').encode()
    robot = read_robot(text, "bot.urdf").robot
    assert robot
    assert len(robot.sensors) == 8
    again = read_again(text, Options()).sensors
    for sensor in robot.sensors:
        place, turn = (again[sensor.name].values[f"origin.{part}"].value for part in ("xyz", "rpy"))
        assert [*place, *turn] == pytest.approx([*sensor.origin.xyz, *sensor.origin.rpy], abs=1e-15)


def test_a_ball_of_pinocchio_has_the_freedoms_and_the_damping_of_the_joint_and_others_keep_theirs() -> None:
    joints = [joint("a", "spherical", "base", "b", inside=[dynamics(3, 1), limit()]), joint("b", "revolute", "b", "c")]
    text = robot(
        *links(base=1, b=2, c=3, d=4), *joints, joint("c", "prismatic", "b", "d", inside=[dynamics(5, 6), limit()])
    )
    plain, ball = (
        read(each.encode(), "a.urdf").multibody.model for each in (text.replace("spherical", "continuous"), text)
    )
    kinds = {name: joint.shortname() for name, joint in zip(ball.names, ball.joints, strict=True)}
    assert kinds["a"] == "JointModelSpherical"
    columns = {name: joint.idx_v for name, joint in zip(ball.names, ball.joints, strict=True)}
    start = columns["a"]
    assert ball.damping[start : start + 3].tolist() == [3, 3, 3]
    assert ball.friction[start : start + 3].tolist() == [0, 0, 0]
    assert (ball.damping[columns["c"]], ball.friction[columns["c"]]) == (5, 6)
    poses = []
    for model in (plain, ball):
        data = model.createData()
        pin.framesForwardKinematics(model, data, pin.neutral(model))
        poses.append({frame.name: at for frame, at in zip(model.frames, data.oMf, strict=True)})
    assert poses[0].keys() == poses[1].keys()
    assert all(poses[0][name].isApprox(poses[1][name], 1e-14) for name in poses[0])
    assert pin.computeTotalMass(ball) == pytest.approx(10)


def turned(roll: float, pitch: float, yaw: float) -> Any:
    """The rotation of a URDF: about x, then y, then z of the parent."""
    (a, b, c), (s, t, u) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    x, y = np.array([[1, 0, 0], [0, a, -s], [0, s, a]]), np.array([[b, 0, t], [0, 1, 0], [-t, 0, b]])
    return np.array([[c, -u, 0], [u, c, 0], [0, 0, 1]]) @ y @ x


@pytest.mark.parametrize("kind", ["fixed", "revolute", "continuous", "prismatic"])
@pytest.mark.parametrize("frame", ["child", "parent", "sensor"])
@pytest.mark.parametrize("is_deeper", [False, True])
def test_a_sensor_at_rest_shows_the_weight_behind_it_in_its_frame(kind: str, frame: str, is_deeper: bool) -> None:
    """A moving joint stands at 0.8 rad or m, along z; the deeper sensor is in the joint behind it."""
    angles, centre = (0.5, -0.6, 0.7), (0.02, -0.05, 0.1)
    at, joints = (
        "wrist" if is_deeper else "elbow",
        [joint("elbow", kind, "base", "arm", axis="0 0 1", inside=[limit()])],
    )
    joints += [joint("wrist", "fixed", "arm", "hand")] if is_deeper else []
    pose = "<pose>1 2 3 0.3 0.2 -0.1</pose>"
    load = f'<sensor name="load" type="force_torque">{pose}<force_torque><frame>{frame}</frame></force_torque></sensor>'
    imu = f'<sensor name="imu" type="imu">{pose}</sensor>'
    last, bodies = ("hand", link("hand", 2.0)) if is_deeper else ("arm", "")
    text = robot(
        *(link("base", 1.0), link("arm", None if is_deeper else 2.0), bodies, *joints),
        *(f'<gazebo reference="{at}">{load}</gazebo>', f'<gazebo reference="{last}">{imu}</gazebo>'),
    ).encode()
    moving = [] if kind == "fixed" else ["elbow"]
    reference = Reference(read(text, "bot.urdf", {at}), moving)
    rest = Course(0.0, 0.0, 0.0)
    state = reference.state([Course(0.8, 0.0, 0.0)] * len(moving), [rest] * 4)
    base = np.eye(3)
    arm = turned(*angles) @ (turned(0, 0, 0.8) if kind in ("revolute", "continuous") else base)
    parent, child = (arm, arm @ turned(*angles)) if is_deeper else (base, arm)
    weight = np.array([0, 0, -2 * GRAVITY])
    axes = {"child": child, "parent": parent, "sensor": child @ turned(0.3, 0.2, -0.1)}
    sensors = read_again(text, Options()).sensors
    force, torque = reference.wrench(state, sensors["load"], *(("arm", "hand") if is_deeper else ("base", "arm")))
    assert force == pytest.approx(axes[frame].T @ weight)
    assert torque == pytest.approx(axes[frame].T @ np.cross(child @ centre, weight))
    gain, spin = reference.acceleration(state, sensors["imu"])
    assert gain == pytest.approx(axes["sensor"].T @ [0, 0, GRAVITY])
    assert spin == pytest.approx([0, 0, 0])


ARM = [*links(base=1.0, hand=2.0), joint("elbow", "continuous", "base", "hand", axis="0 0 1")]
BARE = robot(*ARM).encode()


def with_sensor(kind: SensorKind) -> bytes:
    at = "elbow" if SENSOR_KINDS[kind].at == "joint" else "hand"
    return robot(*ARM, f'<gazebo reference="{at}"><sensor name="own" type="{kind}"/></gazebo>').encode()


@pytest.mark.parametrize("kind", SENSOR_KINDS)
def test_a_sensor_of_each_kind_is_read_again_and_computed(kind: SensorKind) -> None:
    sensor = read_again(with_sensor(kind), Options()).sensors["own"]
    assert sensor.type == kind
    reference = Reference(read(with_sensor(kind), "bot.urdf"), ["elbow"])
    measured = reference.measured(reference.state([Course(0.1, 0.2, 0.3)]), sensor, ("base", "hand"))
    for output in SENSOR_KINDS[kind].outputs:
        assert np.size(measured[output.name]) == (3 if output.is_vector else 1)


@pytest.mark.parametrize("name", sorted({model.name for model in SENSOR_KINDS.values()}))
def test_a_class_of_sensors_has_the_outputs_of_its_kinds(name: str) -> None:
    text = (URDFSYNC / "Sensors" / f"{name}.mo").read_text("utf-8").partition("\nprotected")[0]
    declared = re.findall(r'RealOutput (\w+)(\[3\])?\((?:each )?unit = "(.*?)"', text)
    outputs: set[Output] = {each for model in SENSOR_KINDS.values() if model.name == name for each in model.outputs}
    assert sorted(declared) == sorted((each.name, "[3]" * each.is_vector, each.unit) for each in outputs)


@pytest.mark.parametrize("kind", SENSOR_KINDS)
def test_a_sensor_that_the_source_lacks_is_a_difference(kind: SensorKind) -> None:
    sound = compare(with_sensor(kind), approach=("package",))
    assert (sound.differences, sound.uncompared) == ((), ())
    package = generate(with_sensor(kind), BOT)
    (difference,) = of_package(package, BARE, package.texts).differences
    assert (difference.element, difference.expected, difference.given) == ("sensor own", "nothing", "own")
