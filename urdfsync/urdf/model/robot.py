"""Template data of `<Robot>.mo`, `<Robot>Run.mo` and `<Robot>Test.mo`: their parts, connections, and places.

They depend on the structure of the robot alone, on no number of the URDF.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from urdfsync.domain import Target
from urdfsync.urdf.connectors import Connectors
from urdfsync.urdf.diagram.layout import layout
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import MOTION_KINDS, Joint

_ROW = 20  # height of a row of connectors on the icon: an axis, and its support 10 below
_PICTURE = 100  # where the picture on the icon ends, and the rows begin
_FRAME_Y = -50  # where the benches of the library have the frame that the robot is connected to


def joint_title(joint: Joint) -> str:
    """Return what a joint is, in words."""
    return f'{joint.type} joint "{joint.name}" from link "{joint.parent}" to link "{joint.child}"'


def robot_data(tree: KinematicTree, names: Connectors, target: Target, options: Options) -> Mapping[str, Any]:
    """Return the data of the robot model; `tree` has no numbers."""
    top = _icon_top(names)
    motions = {joint.name: MOTION_KINDS.get(joint.type) for joint in tree.joints}
    followers = tree.followers_by_leader()
    joints, couplings = [], []
    for joint in tree.joints:
        identifier, follows = tree.joint(joint.name), None
        drive = names.drives.get(joint.name)
        if joint.mimic is not None:
            # A leader that does not move holds its follower, which then has none in the model.
            motion = motions[joint.mimic.joint]
            leader = tree.joint(joint.mimic.joint).component if motion else None
            follows = {"leader": leader, "leader_motion": motion}
            coupling = {
                "component": names.couplings[joint.name],
                "follower": identifier.component,
                "follower_motion": motions[joint.name],
                "name": joint.name,
                "leader_name": joint.mimic.joint,
            }
            couplings.append(follows | coupling)
        part = {
            "component": identifier.component,
            "type": identifier.type,
            "kind": joint.type,
            "title": joint_title(joint),
            "axis": drive.axis if drive else None,
            "follows": follows,
            "followers": [
                names.couplings[follower.name]
                for follower, _ in followers.get(joint.name, ())
                if motions[joint.name] is not None
            ],
        }
        joints.append(part)
    diagram = layout(tree, names)
    return {
        "within": target.package,
        "type": target.name,
        "title": f"robot {target.name}",
        "base": options.base,
        "frames": [
            {"connector": connector, "link": tree.link(name).component, "name": name, "y": top - 10 - _ROW * row}
            for row, (name, connector) in enumerate(names.frames.items())
        ],
        "drives": _drives(tree, names),
        "links": [
            {"component": tree.link(link.name).component, "type": tree.link(link.name).type, "name": link.name}
            for link in tree.links
        ],
        "joints": joints,
        "couplings": couplings,
        "top": top,
        "extent": _extent(diagram.extent),
        "diagram": {name: _extent((box.x1, box.y1, box.x2, box.y2)) for name, box in diagram.placements.items()},
        "lines": [
            {"start": start, "end": end, "kind": kind, "points": ", ".join([f"{{{x}, {y}}}" for x, y in points])}
            for (start, end), (kind, points) in diagram.lines.items()
        ],
    }


def bench_data(tree: KinematicTree, names: Connectors, target: Target, options: Options) -> dict[str, Any]:
    """Return the data of Run and Test.

    The robot's icon has one and a half times its size in the diagram, so that its rows are 30 apart, and a drive of
    20 has its place beside each.
    """
    top = _icon_top(names)
    drives = []
    for row, drive in zip(_drives(tree, names), names.drives.values(), strict=True):
        if drive.effort:
            variables = {"position": drive.position, "effort": drive.effort}
            drives.append(row | variables | {"y": _FRAME_Y + row["y"] * 3 // 2, "icon_y": row["y"]})
    return {
        "within": target.package,
        "type": target.name,
        "title": f"robot {target.name}",
        "base": options.base,
        "visualizer": options.visualizer,
        "drives": drives,
        "passive": [tree.joint(name).component for name, drive in names.drives.items() if not drive.effort],
        "inputs": options.inputs,
        "bottom": _FRAME_Y - 150,
        "top": _FRAME_Y + top * 3 // 2,
        "icon_top": top,
    }


def _drives(tree: KinematicTree, names: Connectors) -> list[dict[str, Any]]:
    """Return the joints that can be driven, from top to bottom of the icon; `y` is the height of the axis there."""
    top = _icon_top(names)
    return [
        {
            "joint": tree.joint(name).component,
            "name": name,
            "motion": drive.motion,
            "axis": drive.axis,
            "support": drive.support,
            "y": top - 10 - _ROW * row,
        }
        for row, (name, drive) in enumerate(names.drives.items())
    ]


def _icon_top(names: Connectors) -> int:
    """Return where the icon ends above: over the picture there is a row for each connector at one side."""
    rows = max(len(names.frames), len(names.drives))
    return _PICTURE + _ROW * rows + 10 if rows else _PICTURE


def _extent(box: tuple[int, int, int, int]) -> str:
    x1, y1, x2, y2 = box
    return f"{{{{{x1}, {y1}}}, {{{x2}, {y2}}}}}"
