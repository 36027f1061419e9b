"""Accelerometers and gyroscopes become sensors; others are noted."""

from __future__ import annotations

from support.mjcfs import body, noted, read

from urdfsync.urdf.robot import Origin, Sensor

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
