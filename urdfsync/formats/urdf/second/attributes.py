"""Attributes that no record has: how elements hang together, what Run drives, how sensors measure.

The first reading has them in a `Robot`, the second one in elements. If one has misread an attribute, the words differ.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from urdfsync.formats.urdf.drives import wanted_joints
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import Robot, effective
from urdfsync.formats.urdf.second.reading import SecondElement

Attributes: TypeAlias = Mapping[str, str]
"""Attributes of an element by their names, as words; an empty word stands for a missing attribute."""


def first_attributes(robot: Robot, options: Options) -> Iterator[tuple[tuple[str, str], Attributes]]:
    """Yield the attributes of each joint, loop and sensor of the first reading, by kind and name."""
    wanted = wanted_joints(robot.joints, options)
    for joint in map(effective, robot.joints):
        named = joint.actuated or joint.name in options.commands
        if options.driven is not None:
            named = joint.name in options.driven
        attributes = {
            "parent": joint.parent,
            "child": joint.child,
            "leader": joint.mimic.joint if joint.mimic else "",
            "command": (joint.command or "position") if joint.name in wanted else "",
            "drive": "stated" if named else "",
            "start": _number(joint.start),
            "otherJoint": (joint.transmission.joint if joint.transmission else None) or "",
        }
        yield ("joint", joint.name), attributes
    for loop in robot.loops:
        directions = {"axis": _direction(loop.axis), "childAxis": _direction(loop.child_axis)}
        yield ("loop", loop.name), {"parent": loop.parent, "child": loop.child, "kind": loop.kind, **directions}
    for sensor in robot.sensors:
        axes = _axes(in_parent=sensor.in_parent, on_child=sensor.on_child)
        yield ("sensor", sensor.name), {"at": sensor.at, "kind": sensor.kind, "axes": axes}


def second_attributes(kind: str, element: SecondElement) -> Attributes:
    """Return the attributes of an element of the second reading."""
    match kind:
        case "joint":
            attributes = {
                "parent": element.parent,
                "child": element.child,
                "leader": element.leader,
                "command": element.command,
                "drive": "stated" if element.is_named else "",
                "otherJoint": element.shares,
            }
            if element.in_loop:  # the record of starts has a position that closes the loop instead
                attributes["start"] = _number(element.number("start") if "start" in element.values else None)
            return attributes
        case "loop":
            attributes = {"parent": element.parent, "child": element.child, "kind": element.type}
            count = {"revolute": 1, "universal": 2}.get(element.type, 0)  # other kinds have no axis
            directions = zip(("axis", "childAxis"), element.axes[:count], strict=False)
            return attributes | {name: _direction(axis) for name, axis in directions if axis is not None}
        case "sensor":
            in_parent, on_child = element.axes
            axes = _axes(in_parent=in_parent, on_child=on_child)
            return {"at": element.parent, "kind": element.type, "axes": axes}
    return {}


def _number(number: float | None) -> str:
    return "" if number is None else repr(number + 0.0)  # 1 is 1.0, and -0.0 is 0.0


def _direction(axis: Sequence[float]) -> str:
    return " ".join(f"{round(part, 6) + 0.0:.6f}" for part in axis)


def _axes(*, in_parent: bool, on_child: bool) -> str:
    ends = ("parent", "child") if on_child else ("child", "parent")
    return f"{'parent' if in_parent else 'child'}, from {ends[0]} to {ends[1]}"
