"""Template data of `<Robot>Run.mo` and `<Robot>Test.mo`."""

from __future__ import annotations

from typing import Any

import msgspec

from urdfsync.domain import Target
from urdfsync.urdf.drives import driven_joints
from urdfsync.urdf.kinematics.tree import KinematicTree, Motion
from urdfsync.urdf.model import notes
from urdfsync.urdf.model.robot import connector_names, drive_rows, icon_top
from urdfsync.urdf.options import Options

_FRAME_Y = -50  # where the benches of the library have the frame that the robot is connected to


class BenchDrive(msgspec.Struct, frozen=True):
    """A drive of a joint; `y` is its height in the bench's diagram, `icon_y` on its icon."""

    joint: str
    name: str
    motion: Motion
    axis: str
    support: str
    y: int
    icon_y: int


def bench_data(skeleton: KinematicTree, target: Target, options: Options) -> dict[str, Any]:
    """Data of Run and Test. They depend on the structure of the robot alone, on no number of the URDF.

    The robot's icon has one and a half times its size in the diagram, so that its rows are 30 apart, and a drive of
    20 has its place beside each.
    """
    names = connector_names(skeleton, options)
    rows = drive_rows(skeleton, names)
    top = icon_top(names)
    driven = driven_joints(skeleton.joints, options)
    drives = [
        BenchDrive(row.joint, row.name, row.motion, row.axis, row.support, _FRAME_Y + row.y * 3 // 2, row.y)
        for row in rows
        if row.name in driven
    ]
    return {
        "within": target.package,
        "type": target.name,
        "title": f"robot {target.name}",
        "base": options.base,
        "visualizer": options.visualizer,
        "drives": drives,
        "passive": [row.joint for row in rows if row.name not in driven],
        "inputs": options.inputs,
        "bottom": _FRAME_Y - 150,
        "top": _FRAME_Y + top * 3 // 2,
        "icon_top": top,
        "run_note": notes.run_note(target.name),
        "test_note": notes.test_note(target.name),
    }
