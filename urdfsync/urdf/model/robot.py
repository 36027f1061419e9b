"""Template data of `<Robot>.mo`, `<Robot>Run.mo` and `<Robot>Test.mo`: parts, connections, and places in the diagrams.

The data depend only on the robot's structure, not on numbers of the URDF.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import Any

import msgspec

from urdfsync.urdf.assembly import Assembly
from urdfsync.urdf.connectors import Connectors, input_vector
from urdfsync.urdf.diagram.layout import find_rows, layout
from urdfsync.urdf.drives import by_effort, is_chosen
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.joint import joint_title
from urdfsync.urdf.model.loop import loop_reaches, loop_title
from urdfsync.urdf.model.sensors import sensor_models, sensor_outputs
from urdfsync.urdf.robot import MOTION_KINDS

_ROW = 20  # Height of a row of connectors on the icon: an axis, and the support 10 below.
_PICTURE = 100  # The upper end of the picture on the icon; the rows begin there.
_FRAME_Y = -50  # Y of the frame in the library's benches that connects to the robot.


@lru_cache(maxsize=1)
def robot_data(tree: KinematicTree, names: Connectors, dependent: frozenset[str]) -> Mapping[str, Any]:
    """Return the data of the robot model. `tree` has no numbers; loops determine the positions of `dependent` joints.

    The last result is cached: a build needs the data of the last build and of this one, mostly for equal trees. Serves
    the rows "one mass changed in the daemon" of docs/speed.md: 8 % with 1,000 links.
    """
    motions = {joint.name: MOTION_KINDS.get(joint.type) for joint in tree.joints}
    couplings: dict[str, dict[str, Any]] = {
        joint.name: {
            "component": names.couplings[joint.name],
            "follower": tree.joint(joint.name).component,
            "follower_motion": motions[joint.name],
            "name": joint.name,
            # a fixed leader holds its follower: in the model the follower has no leader
            "leader": tree.joint(mimic.joint).component if motions[mimic.joint] else None,
            "leader_motion": motions[mimic.joint],
            "leader_name": mimic.joint,
        }
        for joint, mimic in tree.followers()
    }
    followers = defaultdict[str | None, list[str]](list)
    for coupling in couplings.values():
        followers[coupling["leader"]].append(coupling["component"])
    gears = defaultdict[str | None, list[dict[str, Any]]](list)  # gears in the robot model, by moved joint
    for name, drive in names.drives.items():
        if drive.gear:
            gear = {"component": tree.joint(name).component, "motor": drive.motor}
            gears[name].append(gear | {"factor": "reduction"})
            gears[drive.other].append(gear | {"factor": "otherReduction"})
    with_motor = {name for name, drive in names.drives.items() if drive.motor and not drive.gear}
    diagram, axes = layout(tree, names), _heights(drive.axis for drive in names.drives.values())
    frames = _heights((*names.frames.values(), *names.sensor_frames.values()))
    heights = [*axes.values(), *frames.values()]
    return {
        "frames": [
            {"connector": connector, "link": tree.link(name).component, "name": name, "y": frames[connector]}
            for name, connector in names.frames.items()
        ],
        "drives": [
            {"joint": tree.joint(name).component, "name": name, "y": axes[drive.axis], **msgspec.structs.asdict(drive)}
            for name, drive in names.drives.items()
        ],
        "links": [
            {"component": tree.link(link.name).component, "type": tree.link(link.name).type, "name": link.name}
            for link in tree.links
        ],
        "joints": [
            {
                "component": tree.joint(joint.name).component,
                "type": tree.joint(joint.name).type,
                "kind": joint.type,
                "title": joint_title(joint),
                "start": joint.start is not None,
                "axis": names.drives[joint.name].axis if joint.name in names.drives else None,
                "motor": joint.name in with_motor,
                "follows": couplings.get(joint.name),
                "followers": followers[tree.joint(joint.name).component],
                "gears": gears[joint.name],
                "dependent": joint.name in dependent,
            }
            for joint in tree.joints
        ],
        "loops": [
            {
                "component": tree.loop(loop.name).component,
                "type": tree.loop(loop.name).type,
                "title": loop_title(loop),
            }
            for loop in tree.loops
        ],
        "couplings": list(couplings.values()),
        "starts": bool(tree.starts()),
        "sensors": sensor_models(tree, names),
        "sensor_frames": [
            {"connector": connector, "name": name, "y": frames[connector]}
            for name, connector in names.sensor_frames.items()
        ],
        "top": max(heights) + 10 if heights else _PICTURE,
        "extent": _extent(diagram.extent),
        "diagram": {name: _extent(box) for name, box in diagram.placements.items()},
        "lines": [
            {"start": start, "end": end, "kind": kind, "points": ", ".join([f"{{{x}, {y}}}" for x, y in points])}
            for (start, end), (kind, points) in diagram.lines.items()
        ],
    }


def bench_data(assembly: Assembly, robot: Mapping[str, Any]) -> dict[str, Any]:
    """Return the data of Run and Test; `robot` is that of the robot model.

    The diagram of a bench enlarges the robot's icon by one half. So the icon's rows are 30 apart, and a drive of height
    20 fits beside each row.
    """
    tree, names, options, closed = assembly.tree, assembly.connectors, assembly.options, assembly.closed
    reaches, sensors, top, rows = loop_reaches(closed), sensor_outputs(tree, names), robot["top"], robot["drives"]
    saturated = {joint.name for joint in tree.joints if is_chosen(joint, options.saturated)}
    moved = {joint.name for joint in tree.joints if not by_effort(joint)} & closed.driven
    servos = {joint.name: joint.servo for joint in tree.joints if joint.servo}
    by_speed = {joint.name for joint in tree.joints if joint.command == "velocity"}
    integrating = {name for name in by_speed & servos.keys() if servos[name].position_gain is not None}
    drives = [row | {"y": _FRAME_Y + row["y"] * 3 // 2, "icon_y": row["y"]} for row in rows if row["command"]]
    return {
        "drives": [
            row
            | {
                "input": row[row["command"]],
                "saturated": row["name"] in saturated,
                "servo": row["name"] in servos,
                "integrates": row["name"] in integrating,
                "reach": reaches.get(row["name"]),
            }
            for row in drives
        ],
        "starts": [tree.joint(joint.name).component for joint in tree.starts()],
        "free": [row["joint"] for row in rows if row["name"] not in moved | closed.dependent],
        "has_loops": bool(tree.loops),
        "inputs": options.inputs,
        "vector": input_vector(names),
        "sensors": sensors,
        "lowest": min([_FRAME_Y - 230, *(sensor["y"] - 20 for sensor in sensors)]),
        "bottom": _FRAME_Y - 150,
        "top": _FRAME_Y + top * 3 // 2,
        "icon_top": top,
    }


def _heights(connectors: Iterable[str]) -> Mapping[str, int]:
    """Return the heights of the connectors at one side of the icon, above the picture.

    A new connector displaces few connectors.
    """
    rows = find_rows(dict.fromkeys(connectors, (0, range(1))), set())
    return {connector: _PICTURE + _ROW * (row + 1) for connector, row in rows.items()}


def _extent(box: tuple[int, int, int, int]) -> str:
    x1, y1, x2, y2 = box
    return f"{{{{{x1}, {y1}}}, {{{x2}, {y2}}}}}"
