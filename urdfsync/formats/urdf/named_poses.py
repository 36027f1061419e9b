"""Reads named poses: those of the source itself, and those in SRDF files of MoveIt beside it.

A translator writes the keys of an MJCF as SRDF would have them, into the URDF.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from pathlib import Path
from xml.etree.ElementTree import Element

from urdfsync.common.dependencies.reads import read_file
from urdfsync.common.files import shown
from urdfsync.common.spelling import counted
from urdfsync.formats.urdf.drives import can_be_driven
from urdfsync.formats.urdf.parse.xml import ParseError, parse
from urdfsync.formats.urdf.robot import Robot

_MOST_FILES, _LARGEST = 20, 1_000_000
"""The most SRDF files beside a source, and the most bytes of one file."""


def named_poses(source: Path, robot: Robot) -> tuple[dict[str, dict[str, float]], list[str]]:
    """Return the poses of a robot by name, and a line for each faulty file.

    The poses of files come first. Only files with the name of the source or of the robot count.
    """
    poses, faults = dict[str, dict[str, float]](), list[str]()
    is_free = {joint.name: can_be_driven(joint) for joint in robot.joints}
    stem = source.name.partition(".")[0]
    for file in sorted(source.parent.glob("*.srdf"))[:_MOST_FILES]:
        try:
            root = parse(read_file(file)[:_LARGEST]).root
        except (OSError, ParseError) as error:
            line = f":{error.diagnostic.line}" if isinstance(error, ParseError) else ""
            faults.append(f"{shown(file)}{line}: its poses can't be read: {error}")
            continue
        if robot.name != root.get("name") and stem != file.name.partition(".")[0]:
            continue
        others = dict[str, None]()
        for state in root.iterfind("group_state"):
            name, values = state.get("name", ""), dict(_values(state.iterfind("joint")))
            others |= dict.fromkeys(joint for joint in values if joint not in is_free)
            if own := {f"joint {joint}": value for joint, value in values.items() if is_free.get(joint)}:
                poses[f"{name} ({state.get('group', '')})" if name in poses else name] = own
        if others:
            number, first = counted(len(others), "joint"), next(iter(others))
            faults.append(f"{shown(file)}: its poses name {number} that this robot lacks, such as {first}")
    for text in robot.extensions.get("", {}).get("group_state", ()):
        state = parse(text.encode()).root
        values = dict(_values(state.iterfind("joint")))
        if own := {f"joint {joint}": value for joint, value in values.items() if is_free.get(joint)}:
            poses.setdefault(state.get("name", ""), own)
    return poses, faults


def _values(joints: Iterable[Element]) -> Iterator[tuple[str, float]]:
    """Yield the joints of a pose with one finite position."""
    for joint in joints:
        try:
            name, value = joint.get("name", ""), float(joint.get("value", ""))
        except ValueError:  # a joint of several axes has several numbers
            continue
        if math.isfinite(value):
            yield name, value
