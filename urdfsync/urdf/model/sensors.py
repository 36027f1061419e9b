"""Template data of sensors: components of the robot model, outputs of Run, and the record of their numbers."""

from __future__ import annotations

from typing import Any

from urdfsync.urdf.connectors import Connectors
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import SENSOR_KINDS

_ROW = 20  # Height of an output in the diagram of Run.
_TOP = 80  # Y of the first output, below the outputs of the drives.
_ICON_ROW, _ICON_TOP = 10, 90


def sensor_models(tree: KinematicTree, names: Connectors) -> list[dict[str, Any]]:
    """Return the structure of each sensor; `tree` may have no numbers."""
    return [
        {
            "component": names.sensors[sensor.name],
            "model": SENSOR_KINDS[sensor.kind].name,
            "record": SENSOR_KINDS[sensor.kind].record,
            "title": f'sensor "{sensor.name}" of {SENSOR_KINDS[sensor.kind].at} "{sensor.at}"',
            "joint": tree.joint(sensor.at).component if sensor.is_in_joint else None,
            "in_parent": sensor.in_parent,
            "sign": "-" if sensor.on_child else "",
            "frame": names.sensor_frames.get(sensor.name),
        }
        for sensor in tree.sensors
    ]


def sensor_outputs(tree: KinematicTree, names: Connectors) -> list[dict[str, Any]]:
    """Return Run's outputs of sensors with their places: a column at the right, below the outputs of the drives."""
    outputs = [
        {
            "component": names.sensors[sensor.name],
            "output": output.name,
            "unit": output.unit,
            "is_vector": output.is_vector,
            "text": f'{output.quantity} that sensor "{sensor.name}" shows',
        }
        for sensor in tree.sensors
        for output in SENSOR_KINDS[sensor.kind].outputs
    ]
    return [row | {"y": _TOP - _ROW * k, "icon_y": _ICON_TOP - _ICON_ROW * k} for k, row in enumerate(outputs)]
