"""Makes sensors of a robot from those of MuJoCo; sensors of other kinds are only noted.

A force and a torque at one site become a force-torque sensor in the joint above the site's body: both measure what the
parent exerts on the body, in the axes of the site. Its torque is about the joint, so it needs a site there.
"""

from __future__ import annotations

import mujoco
import numpy as np

from urdfsync.formats.mjcf.robot import Links
from urdfsync.formats.mjcf.turns import rpy
from urdfsync.formats.translation.writer import UrdfElement

_KINDS = {mujoco.mjtSensor.mjSENS_ACCELEROMETER: "accelerometer", mujoco.mjtSensor.mjSENS_GYRO: "gyroscope"}
_LOADS: tuple[int, ...] = (mujoco.mjtSensor.mjSENS_FORCE, mujoco.mjtSensor.mjSENS_TORQUE)
READ = {*_KINDS, *_LOADS}
"""Kinds of sensors that models have."""


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
        body = int(model.site_bodyid[site]) if kind in READ else -1
        joint = joints.get(scene.links[body])
        # a torque counts about the origin of the joint
        loads: tuple[int, ...] = (mujoco.mjtSensor.mjSENS_FORCE,)
        if body in links.offsets and not np.any(links.place(body, model.site_pos[site])):
            loads = _LOADS
        if body not in links.offsets or (kind in _LOADS and (joint is None or kind not in loads)):
            robot.add(f"sensor-{kind.name.removeprefix('mjSENS_').lower()}", line, name=name or None)
        elif kind in _KINDS:
            sensor = robot.add("sensor", line, name=name or f"{scene.links[body]}_{_KINDS[kind]}", type=_KINDS[kind])
            sensor.add("parent", link=scene.links[body])
            sensor.add("origin", xyz=links.place(body, model.site_pos[site]), rpy=rpy(model.site_quat[site]))
        # one sensor for the force and the torque at a site
        elif not any(int(model.sensor_type[n]) in loads and model.sensor_objid[n] == site for n in range(number)):
            at = robot.add("gazebo", line, reference=joint)
            sensor = at.add("sensor", name=name or f"{joint}_load", type="force_torque")
            angles = " ".join(map(repr, rpy(model.site_quat[site])))
            sensor.add("pose", text=f"0 0 0 {angles}")
            axes = sensor.add("force_torque")
            axes.add("frame", text="sensor")
            axes.add("measure_direction", text="parent_to_child")
