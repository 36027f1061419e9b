"""Accelerometers, gyroscopes, forces and torques become sensors; others are noted."""

from __future__ import annotations

import math

import mujoco
import pytest
from support.mjcfs import body, document, noted, read, urdf
from support.numbers import differences

from urdfsync.formats.mjcf.scene import read_scene
from urdfsync.formats.urdf.robot import Origin, Sensor

TEXT = body('<joint name="j" pos="0 0 0.5"/><site name="s" pos="1 0 0"/>').replace(
    "</mujoco>",
    '<sensor><accelerometer name="acc" site="s"/><gyro site="s"/><jointpos name="p" joint="j"/></sensor></mujoco>',
)


def test_a_sensor_is_at_its_site() -> None:
    place = Origin((1, 0, -0.5))
    assert read(TEXT).sensors == (
        Sensor("acc", "accelerometer", "part", place),
        Sensor("part_gyroscope", "gyroscope", "part", place),
    )


def test_another_sensor_is_noted() -> None:
    assert noted(TEXT) == "not modelled: 1 <sensor-jointpos>"


LOADS = body(
    '<joint name="j" pos="0 0 0.5"/><site name="s" pos="0 0 0.5" euler="0 90 0"/><site name="far" pos="1 0 0"/>'
).replace(
    "</mujoco>",
    '<sensor><force name="f" site="s"/><torque name="t" site="s"/><force site="far"/><torque site="far"/></sensor>'
    "</mujoco>",
)


def test_a_force_and_a_torque_at_a_joint_are_one_sensor() -> None:
    """MuJoCo measures what the parent exerts: it carries the weight, along -x of the turned site."""
    first, second = read(LOADS).sensors
    turned = Origin((0, 0, 0), (0, pytest.approx(math.pi / 2), 0))  # type: ignore[arg-type]
    assert first == Sensor("f", "force_torque", "j", turned, on_child=True)
    assert second == Sensor("j_load", "force_torque", "j", on_child=True)
    model = read_scene(document(LOADS)).model
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.sensordata[:3] == pytest.approx([-2 * 9.81, 0, 0])


def test_a_force_is_measured_after_a_torque_that_is_noted() -> None:
    sensors = '<sensor><torque name="t" site="s"/><force name="f" site="s"/></sensor></mujoco>'
    text = body('<joint/><site name="s" pos="1 0 0"/>').replace("</mujoco>", sensors)
    assert [(each.name, each.kind) for each in read(text).sensors] == [("f", "force_torque")]
    assert noted(text) == "not modelled: 1 <sensor-torque>"


def test_a_torque_beside_the_joint_is_noted() -> None:
    assert noted(LOADS) == "not modelled: 1 <sensor-torque>"


def test_both_readers_agree_about_sensors() -> None:
    assert differences(urdf(LOADS).encode()) == []
