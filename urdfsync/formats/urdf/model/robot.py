"""Template data of `<Robot>.mo`, `<Robot>Run.mo` and `<Robot>Test.mo`: parts, connections, and places in the diagrams.

The data depend only on the robot's structure, not on numbers of the URDF.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from typing import Any

from msgspec.structs import asdict

from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.connectors import Connectors, input_vector
from urdfsync.formats.urdf.diagram.layout import find_rows, layout
from urdfsync.formats.urdf.drives import by_effort, is_chosen
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.model.joint import joint_title
from urdfsync.formats.urdf.model.loop import loop_reaches, loop_title
from urdfsync.formats.urdf.names import Identifier
from urdfsync.formats.urdf.robot import MOTION_KINDS, SENSOR_KINDS

_ROW = 20  # Height of a row of connectors on the icon: an axis, and the support 10 below; of an output of a sensor.
_PICTURE = 100  # The upper end of the picture on the icon; the rows begin there.
_OUTPUT_TOP, _OUTPUT_ICON_TOP = 80, 90  # Y of the first output of a sensor in Run, below the outputs of the drives.
_FRAME_Y = -50  # Y of the frame in the library's benches that connects to the robot.


@lru_cache(maxsize=1)
def robot_data(tree: KinematicTree, names: Connectors, dependent: frozenset[str]) -> Mapping[str, Any]:
    """Return the data of the robot model. `tree` has no numbers; loops determine the positions of `dependent` joints.

    The last result is cached: a build needs the data of the last build and of this one, mostly for equal trees. Serves
    the rows "one mass changed in the daemon" of docs/speed.md: 8 % with 1,000 links.
    """
    diagram, frames, drives = layout(tree, names), list(_frames(tree, names)), list(_drives(tree, names))
    return {
        "frames": frames,
        "drives": drives,
        "links": [{"name": link.name, **_names(tree.link(link.name))} for link in tree.links],
        "joints": list(_joints(tree, names, dependent)),
        "loops": [{"title": loop_title(loop), **_names(tree.loop(loop.name))} for loop in tree.loops],
        "starts": bool(tree.starts()),
        "sensors": sensor_rows(tree, names),
        "top": max([_PICTURE, *(row["y"] + 10 for row in (*frames, *drives))]),
        "extent": _extent(diagram.extent),
        "diagram": {name: _extent(box) for name, box in diagram.placements.items()},
        "lines": [
            {"start": start, "end": end, "kind": kind, "points": ", ".join([f"{{{x}, {y}}}" for x, y in points])}
            for (start, end), (kind, points) in diagram.lines.items()
        ],
    }


def _frames(tree: KinematicTree, names: Connectors) -> Iterator[dict[str, Any]]:
    """Yield the frames at the right side of the icon, those of links first."""
    frames = [(f'link "{link}"', tree.link(link).component, frame) for link, frame in names.frames.items()]
    frames += [(f'sensor "{sensor}"', sensor, frame) for sensor, frame in names.sensor_frames.items()]
    heights = _heights(connector for *_, connector in frames)
    for owner, label, connector in frames:
        yield {"connector": connector, "owner": owner, "label": label, "y": heights[connector]}


def _drives(tree: KinematicTree, names: Connectors) -> Iterator[dict[str, Any]]:
    """Yield the joints that can be driven, with their flanges at the left side of the icon."""
    heights = _heights(drive.axis for drive in names.drives.values())
    for name, drive in names.drives.items():
        yield {"joint": tree.joint(name).component, "name": name, "y": heights[drive.axis], **asdict(drive)}


def _joints(tree: KinematicTree, names: Connectors, dependent: frozenset[str]) -> Iterator[dict[str, Any]]:
    """Yield the joints with their drives, the couplings and gears that move them, and those of their followers."""
    motions = {joint.name: MOTION_KINDS.get(joint.type) for joint in tree.joints}
    # a fixed leader holds its follower: in the model the follower has no leader
    leaders = {joint.name: mimic.joint for joint, mimic in tree.followers() if motions[mimic.joint]}
    followers = defaultdict[str, list[str]](list)
    for name, leader in leaders.items():
        followers[leader].append(names.couplings[name])
    gears = defaultdict[str | None, list[dict[str, Any]]](list)  # gears in the robot model, by moved joint
    for name, drive in names.drives.items():
        if drive.gear:
            gear = {"component": tree.joint(name).component, "motor": drive.motor}
            gears[name].append(gear | {"factor": "reduction"})
            gears[drive.other].append(gear | {"factor": "otherReduction"})
    for joint in tree.joints:
        own, leads = names.drives.get(joint.name), leaders.get(joint.name)
        yield {
            **_names(tree.joint(joint.name)),
            "source": joint,
            "title": joint_title(joint),
            "motion": motions[joint.name],
            "axis": own and own.axis,
            "motor": bool(own and own.motor and not own.gear),
            "coupling": names.couplings.get(joint.name),
            "leader": leads and tree.joint(leads).component,
            "leader_motion": leads and motions[leads],
            "followers": followers[joint.name],
            "gears": gears[joint.name],
            "dependent": joint.name in dependent,
        }


def sensor_rows(tree: KinematicTree, names: Connectors) -> list[dict[str, Any]]:
    """Return each sensor with its model and its component; `tree` may have no numbers."""
    return [
        {
            "component": names.sensors[sensor.name],
            "model": SENSOR_KINDS[sensor.kind],
            "joint": tree.joint(sensor.at).component if sensor.is_in_joint else None,
            "source": sensor,
        }
        for sensor in tree.sensors
    ]


def _sensor_outputs(tree: KinematicTree, names: Connectors) -> list[dict[str, Any]]:
    """Return Run's outputs of sensors with their places: a column at the right, below the outputs of the drives."""
    outputs = [(sensor.name, output) for sensor in tree.sensors for output in SENSOR_KINDS[sensor.kind].outputs]
    return [
        {
            "component": names.sensors[name],
            "name": name,
            "output": output,
            "y": _OUTPUT_TOP - _ROW * number,
            "icon_y": _OUTPUT_ICON_TOP - _ROW // 2 * number,
        }
        for number, (name, output) in enumerate(outputs)
    ]


def bench_data(assembly: Assembly, robot: Mapping[str, Any]) -> dict[str, Any]:
    """Return the data of Run and Test; `robot` is that of the robot model.

    The diagram of a bench enlarges the robot's icon by one half. So the icon's rows are 30 apart, and a drive of height
    20 fits beside each row.
    """
    tree, names, options, closed = assembly.tree, assembly.connectors, assembly.options, assembly.closed
    reaches, sensors, top, rows = loop_reaches(closed), _sensor_outputs(tree, names), robot["top"], robot["drives"]
    joints = {joint.name: joint for joint in tree.joints}
    moved = {joint.name for joint in tree.joints if not by_effort(joint)} & closed.driven
    driven = [(row, joints[row["name"]], joints[row["name"]].servo) for row in rows if row["command"]]
    return {
        "drives": [
            row
            | {
                "y": _FRAME_Y + row["y"] * 3 // 2,
                "icon_y": row["y"],
                "input": row[row["command"]],
                "saturated": is_chosen(joint, options.saturated),
                "servo": servo is not None,
                "integrates": joint.command == "velocity" and servo is not None and servo.position_gain is not None,
                "reach": reaches.get(joint.name),
            }
            for row, joint, servo in driven
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


def _names(identifier: Identifier) -> dict[str, str]:
    return {"component": identifier.component, "type": identifier.type}


def _heights(connectors: Iterable[str]) -> dict[str, int]:
    """Return the heights of the connectors at one side of the icon, above the picture.

    A new connector displaces few connectors.
    """
    rows = find_rows(dict.fromkeys(connectors, (0, range(1))), set())
    return {connector: _PICTURE + _ROW * (row + 1) for connector, row in rows.items()}


def _extent(box: tuple[int, int, int, int]) -> str:
    x1, y1, x2, y2 = box
    return f"{{{{{x1}, {y1}}}, {{{x2}, {y2}}}}}"
