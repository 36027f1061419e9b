"""Facts of the source that no record has: how elements hang together, what Run drives, how sensors measure.

The first reading has them as a `Robot`, the second one as elements. Both give the same words, or one has misread them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeAlias

from urdfsync.urdf.drives import wanted_joints
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Robot, effective
from urdfsync.urdf.second.reading import Element

Facts: TypeAlias = Mapping[str, str]
"""Facts of an element by their names; an empty fact is absent."""


def first_facts(robot: Robot, options: Options) -> Iterator[tuple[tuple[str, str], Facts]]:
    """Yield the facts of each joint, loop and sensor of the first reading, by kind and name."""
    wanted = wanted_joints(robot.joints, options)
    for joint in map(effective, robot.joints):
        named = joint.actuated or joint.name in options.commands
        if options.driven is not None:
            named = joint.name in options.driven
        yield (
            ("joint", joint.name),
            {
                "parent": joint.parent,
                "child": joint.child,
                "leader": joint.mimic.joint if joint.mimic else "",
                "command": (joint.command or "position") if joint.name in wanted else "",
                "drive": "stated" if named else "",
                "start": "" if joint.start is None else repr(joint.start),
                "otherJoint": (joint.transmission.joint if joint.transmission else None) or "",
            },
        )
    for loop in robot.loops:
        yield ("loop", loop.name), {"parent": loop.parent, "child": loop.child, "kind": loop.kind}
    for sensor in robot.sensors:
        axes = _axes(in_parent=sensor.in_parent, on_child=sensor.on_child)
        yield ("sensor", sensor.name), {"at": sensor.at, "kind": sensor.kind, "axes": axes}


def second_facts(kind: str, element: Element) -> Facts:
    """Return the facts of an element of the second reading."""
    match kind:
        case "joint":
            facts = {
                "parent": element.parent,
                "child": element.child,
                "leader": element.leader,
                "command": element.command,
                "drive": "stated" if element.is_named else "",
                "otherJoint": element.shares,
            }
            # elsewhere the record of starts has this number; in a loop, it has a position that closes the loop
            start = element.number("start") if element.in_loop and "start" in element.values else None
            return facts | {"start": "" if start is None else repr(start)} if element.in_loop else facts
        case "loop":
            return {"parent": element.parent, "child": element.child, "kind": element.type}
        case "sensor":
            in_parent, on_child = element.axes
            axes = _axes(in_parent=in_parent, on_child=on_child)
            return {"at": element.parent, "kind": element.type, "axes": axes}
    return {}


def _axes(*, in_parent: bool, on_child: bool) -> str:
    ends = ("parent", "child") if on_child else ("child", "parent")
    return f"{'parent' if in_parent else 'child'}, from {ends[0]} to {ends[1]}"
