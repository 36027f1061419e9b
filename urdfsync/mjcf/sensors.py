"""Makes sensors of a robot from those of MuJoCo; sensors of other kinds are only noted.

A force and a torque at one site become a force-torque sensor in the joint above the site's body: both measure what the
parent exerts on the body, in the axes of the site. Its torque is about the joint, so it needs a site there.
"""

from __future__ import annotations

from collections.abc import Mapping

import mujoco
import numpy as np

from urdfsync.mjcf.robot import Links
from urdfsync.mjcf.turns import rpy
from urdfsync.translation.writer import UrdfElement

_KINDS = {mujoco.mjtSensor.mjSENS_ACCELEROMETER: "accelerometer", mujoco.mjtSensor.mjSENS_GYRO: "gyroscope"}
_LOADS = {mujoco.mjtSensor.mjSENS_FORCE: "force", mujoco.mjtSensor.mjSENS_TORQUE: "torque"}
READ = {*_KINDS, *_LOADS}
"""Kinds of sensors that models have."""


def _add_load(robot: UrdfElement, links: Links, number: int, joints: Mapping[str, str]) -> bool:
    """Add a sensor of force and torque for a sensor of MuJoCo; return whether the package has such a sensor."""
    scene, model = links.scene, links.scene.model
    site = int(model.sensor_objid[number])
    body, kind = int(model.site_bodyid[site]), mujoco.mjtSensor(model.sensor_type[number])
    joint = joints.get(scene.links[body])
    is_at_joint = not np.any(links.place(body, model.site_pos[site]))
    # a torque counts about the origin of the joint
    kinds = _LOADS if is_at_joint else (mujoco.mjtSensor.mjSENS_FORCE,)
    if joint is None or kind not in kinds:
        return False
    twins = [n for n in range(model.nsensor) if int(model.sensor_type[n]) in kinds and model.sensor_objid[n] == site]
    if number == twins[0]:
        at = robot.add("gazebo", scene.line("sensor", number), reference=joint)
        sensor = at.add("sensor", name=scene.name("sensor", number) or f"{joint}_load", type="force_torque")
        angles = " ".join(map(repr, rpy(model.site_quat[site])))
        sensor.add("pose", text=f"0 0 0 {angles}")
        axes = sensor.add("force_torque")
        axes.add("frame", text="sensor")
        axes.add("measure_direction", text="parent_to_child")
    return True


def add_sensors(robot: UrdfElement, links: Links) -> None:
    """Add the sensors of the robot; a note names the others."""
    scene, model = links.scene, links.scene.model
    joints = {
        str(child.attributes["link"]): str(joint.attributes["name"])
        for joint in robot.children
        for child in joint.children
        if joint.tag == "joint" and child.tag == "child"
    }
    for number in range(model.nsensor):
        line, name = scene.line("sensor", number), scene.name("sensor", number)
        kind, site = mujoco.mjtSensor(model.sensor_type[number]), int(model.sensor_objid[number])
        if kind in _LOADS and int(model.site_bodyid[site]) in links.offsets and _add_load(robot, links, number, joints):
            continue
        if kind not in _KINDS or int(model.site_bodyid[site]) not in links.offsets:
            word = kind.name.removeprefix("mjSENS_").lower()
            robot.add(f"sensor-{word}", line, name=name or None)
            continue
        body = int(model.site_bodyid[site])
        sensor = robot.add("sensor", line, name=name or f"{scene.links[body]}_{_KINDS[kind]}", type=_KINDS[kind])
        sensor.add("parent", link=scene.links[body])
        sensor.add("origin", xyz=links.place(body, model.site_pos[site]), rpy=rpy(model.site_quat[site]))
