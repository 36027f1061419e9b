"""Makes sensors of a robot from those of MuJoCo; sensors of other kinds are only noted."""

from __future__ import annotations

import mujoco

from urdfsync.mjcf.robot import Links
from urdfsync.mjcf.turns import rpy
from urdfsync.translation.writer import Node

_KINDS = {mujoco.mjtSensor.mjSENS_ACCELEROMETER: "accelerometer", mujoco.mjtSensor.mjSENS_GYRO: "gyroscope"}


def add_sensors(robot: Node, links: Links) -> None:
    """Add the sensors of the robot; a note names the others."""
    scene, model = links.scene, links.scene.model
    for number in range(model.nsensor):
        line, name = scene.line("sensor", number), scene.name("sensor", number)
        kind, site = mujoco.mjtSensor(model.sensor_type[number]), int(model.sensor_objid[number])
        if kind not in _KINDS or int(model.site_bodyid[site]) not in links.offsets:
            word = kind.name.removeprefix("mjSENS_").lower()
            robot.add(f"sensor-{word}", line, name=name or None)
            continue
        body = int(model.site_bodyid[site])
        sensor = robot.add("sensor", line, name=name or f"{scene.links[body]}_{_KINDS[kind]}", type=_KINDS[kind])
        sensor.add("parent", link=scene.links[body])
        sensor.add("origin", xyz=links.place(body, model.site_pos[site]), rpy=rpy(model.site_quat[site]))
