"""Which sensors are read, in all forms that are in use."""

from __future__ import annotations

import math

import pytest
from support import urdfs
from support.numbers import differences

from urdfsync.formats.urdf.parse.source import RobotReading, read_robot
from urdfsync.formats.urdf.robot import SENSOR_KINDS, Camera, Lidar, Origin, Sensor

BASE = (
    *map(urdfs.link, ("base", "arm", "hand")),
    urdfs.joint("elbow", "revolute", "base", "arm"),
    urdfs.joint("wrist", "fixed", "arm", "hand"),
)


def read(*elements: str) -> RobotReading:
    return read_robot(urdfs.robot(*BASE, *elements).encode(), "own.urdf")


def sensors(reading: RobotReading) -> list[Sensor]:
    assert reading.robot is not None
    return list(reading.robot.sensors)


def gazebo(at: str, name: str, kind: str, inside: str = "") -> str:
    return f'<gazebo reference="{at}"><sensor name="{name}" type="{kind}">{inside}</sensor></gazebo>'


def control(name: str, state: str, inside: str = "") -> str:
    sensor = f'<sensor name="{name}"><state_interface name="{state}"/>{inside}</sensor>'
    return f'<ros2_control name="c" type="sensor">{sensor}</ros2_control>'


def wrench(frame: str, direction: str = "") -> str:
    way = f"<measure_direction>{direction}</measure_direction>" if direction else ""
    return f"<force_torque><frame>{frame}</frame>{way}</force_torque>"


POSE = "<pose>1 2 3 0.1 0.2 0.3</pose>"
PLACE = Origin((1.0, 2.0, 3.0), (0.1, 0.2, 0.3))
FORMS = {
    "an IMU": (
        gazebo("arm", "imu", "imu", f"{POSE}<update_rate> 100 </update_rate>"),
        [Sensor("imu", "imu", "arm", PLACE, 100.0)],
    ),
    "a camera of gazebo": (
        gazebo("arm", "eye", "depth_camera", """<camera name="x"><horizontal_fov>1.2</horizontal_fov>
            <image><width>640</width><height>480</height></image><clip><near>0.1</near><far>9</far></clip></camera>"""),
        [Sensor("eye", "camera", "arm", camera=Camera(640.0, 480.0, 1.2, 0.1, 9.0))],
    ),
    "a camera of URDF": (
        """<sensor name="eye" update_rate="20"><parent link="hand"/><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>
            <camera><image width="640" height="480" hfov="1.2" near="0.1" far="9"/></camera></sensor>""",
        [Sensor("eye", "camera", "hand", PLACE, 20.0, camera=Camera(640.0, 480.0, 1.2, 0.1, 9.0))],
    ),
    "a scanner of gazebo": (
        gazebo("arm", "scan", "gpu_lidar", """<lidar><scan><horizontal><samples>720</samples><min_angle>-1</min_angle>
            <max_angle>2</max_angle></horizontal></scan><range><min>0.1</min><max>30</max></range></lidar>"""),
        [Sensor("scan", "lidar", "arm", lidar=Lidar(720.0, -1.0, 2.0, min_range=0.1, max_range=30.0))],
    ),
    "a scanner of URDF in a link": (
        '<link name="x"><sensor name="scan"><ray><horizontal samples="9" min_angle="-1"/></ray></sensor></link>'
        + urdfs.joint("weld", "fixed", "hand", "x"),
        [Sensor("scan", "lidar", "x", lidar=Lidar(9.0, -1.0))],
    ),
    "force and torque in a joint": (
        gazebo("elbow", "ft", "force_torque", POSE), [Sensor("ft", "force_torque", "elbow")],
    ),
    "force and torque at a link, which is the joint before it": (
        gazebo("hand", "ft", "force_torque", wrench("sensor") + POSE),
        [Sensor("ft", "force_torque", "wrist", PLACE)],
    ),
    "the other way round": (
        gazebo("elbow", "ft", "force_torque", wrench("parent", "parent_to_child")),
        [Sensor("ft", "force_torque", "elbow", in_parent=True, on_child=True)],
    ),
    "of iDynTree": (
        """<sensor name="a" type="accelerometer"><parent link="arm"/><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/></sensor>
            <sensor name="f" type="force_torque"><parent joint="wrist"/><origin xyz="0 0 0" rpy="0 0 0"/></sensor>
            <sensor name="g" type="gyroscope"><parent link="hand"/></sensor>""",
        [Sensor("a", "accelerometer", "arm", PLACE), Sensor("f", "force_torque", "wrist"),
         Sensor("g", "gyroscope", "hand")],
    ),
    "of ros2_control": (
        control("ft", "force.x", '<param name="frame_id">hand</param>')
        + control("imu", "linear_acceleration.x", '<param name="frame_id">base</param>'),
        [Sensor("ft", "force_torque", "wrist"), Sensor("imu", "imu", "base")],
    ),
    "of ros2_control, without a frame": (control("imu", "angular_velocity.z"), []),
    "one that gazebo and ros2_control name": (
        gazebo("arm", "imu", "imu", POSE)
        + control("imu", "linear_acceleration.x", '<param name="frame_id">arm</param>'),
        [Sensor("imu", "imu", "arm", PLACE)],
    ),
    "two of one name": (
        gazebo("arm", "imu", "imu") + gazebo("hand", "imu", "imu"),
        [Sensor("arm/imu", "imu", "arm"), Sensor("hand/imu", "imu", "hand")],
    ),
    "other kinds": (gazebo("arm", "bump", "contact") + gazebo("arm", "gps", "gps"), []),
}  # fmt: skip


@pytest.mark.parametrize(("element", "expected"), FORMS.values(), ids=FORMS)
def test_forms(element: str, expected: list[Sensor]) -> None:
    reading = read(element)
    assert sorted(sensors(reading), key=lambda sensor: sensor.name) == expected
    assert not reading.diagnostics
    assert not expected or not reading.unmodelled, "a sensor that is modelled is in no note"
    assert differences(urdfs.robot(*BASE, element).encode()) == [], "the second reading"


NAMES = [(kind, name) for kind, model in SENSOR_KINDS.items() for name in (kind, *model.types, *model.states)]


@pytest.mark.parametrize(("kind", "name"), NAMES)
def test_each_name_of_each_kind(kind: str, name: str) -> None:
    """The second reading has its own list of names."""
    model, at = SENSOR_KINDS[kind], "elbow" if SENSOR_KINDS[kind].at == "joint" else "arm"  # type: ignore[index]
    frame = f'<param name="frame_id">{at}</param>'
    element = control("own", f"{name}.x", frame) if name in model.states else gazebo(at, "own", name)
    assert [(sensor.kind, sensor.at) for sensor in sensors(read(element))] == [(kind, at)]
    assert differences(urdfs.robot(*BASE, element).encode()) == []


@pytest.mark.parametrize(("element", "message"), [
    (gazebo("gone", "imu", "imu"), "sensor imu is at link 'gone', which does not exist: the sensor is left out"),
    (gazebo("base", "ft", "force_torque"), "sensor ft is at joint 'base', which does not exist: the sensor is left "
     "out"),
])  # fmt: skip
def test_a_sensor_at_nothing_is_left_out_with_a_warning(element: str, message: str) -> None:
    reading = read(element)
    assert sensors(reading) == []
    assert [(one.code, one.message, one.line) for one in reading.diagnostics] == [("unknown-sensor-place", message, 8)]


def test_of_two_sensors_of_one_name_and_place_the_first_counts() -> None:
    reading = read(gazebo("arm", "top", "imu") + gazebo("arm", "top", "camera"))
    assert [one.code for one in reading.diagnostics] == ["duplicate-element"]
    assert sensors(reading) == [Sensor("top", "imu", "arm")]


def test_a_pose_may_be_in_degrees() -> None:
    pose = '<pose degrees="true">1 2 3 0 0 90</pose>'
    (sensor,) = sensors(read(gazebo("arm", "imu", "imu", pose)))
    assert sensor.origin == Origin((1.0, 2.0, 3.0), (0.0, 0.0, math.pi / 2))


@pytest.mark.parametrize("element", [
    gazebo("arm", "imu", "imu", '<pose relative_to="hand">0 0 0 0 0 0</pose>'),
    gazebo("arm", "eye", "camera", "<camera><image><width>640.5</width></image></camera>"),
    gazebo("arm", "scan", "ray", "<ray><scan><horizontal><samples>3e9</samples></horizontal></scan></ray>"),
    gazebo("arm", "eye", "camera", "<camera><image><height>-3</height></image></camera>"),
    gazebo("elbow", "load", "force_torque", wrench("sideways")),
    gazebo("elbow", "load", "force_torque", wrench("child", "up")),
])  # fmt: skip
def test_what_means_nothing_is_a_warning_and_the_default_counts(element: str) -> None:
    reading = read(element)
    assert [one.code for one in reading.diagnostics] == ["bad-sensor"]
    (sensor,) = sensors(reading)
    assert (sensor.origin, sensor.camera or Camera(), sensor.lidar or Lidar()) == (Origin(), Camera(), Lidar())
    assert (sensor.in_parent, sensor.on_child) == (False, False)


def test_a_faulty_number_is_a_warning() -> None:
    reading = read(gazebo("arm", "imu", "imu", "<pose>1 2 3</pose><update_rate>fast</update_rate>"))
    assert [one.code for one in reading.diagnostics] == ["bad-sensor", "bad-sensor"]
    assert sensors(reading) == [Sensor("imu", "imu", "arm")]
