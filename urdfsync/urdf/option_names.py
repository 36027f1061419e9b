"""Names in the options of a robot, held against the robot: each has to be what the option asks for.

A joint in `driven` or a link in `frames` that is not there leaves the robot without a drive or a connector that the
user counts on. No package is right then, so these are errors. A name that stands there twice is a warning: the second
one may have been meant to be another.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.spelling import nearest
from urdfsync.urdf.drives import can_be_driven, passive_joints
from urdfsync.urdf.names import natural_key
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Joint

_SHOWN = 5
"""So many names of passive joints are listed; of more, the others are counted."""


def check_options(
    links: Collection[str], joints: Sequence[Joint], options: Options
) -> Iterator[tuple[str, Diagnostic]]:
    """What there is to say of a robot's options, each with the option that it is about; without file and line.

    `links` are the names of all links. The record approach has no use for these options.
    """
    if "package" not in options.approach:
        return
    by_name = {joint.name: joint for joint in joints}
    if isinstance(options.frames, tuple):
        yield from _repeated("frames", options.frames)
        for name in dict.fromkeys(options.frames):
            if name not in links:
                yield "frames", _no_link(name, links, by_name)
    if options.driven is None:
        if passive := passive_joints(joints):
            yield "driven", _passive(passive)
        return
    yield from _repeated("driven", options.driven)
    for name in dict.fromkeys(options.driven):
        if name not in by_name or not can_be_driven(by_name[name]):
            yield "driven", _no_drive(name, links, by_name)


def _repeated(option: str, names: Sequence[str]) -> Iterator[tuple[str, Diagnostic]]:
    for name, count in Counter(names).items():
        if count > 1:
            times = "twice" if count == 2 else f"{count} times"
            message, hint = f"`{option}` names `{name}` {times}", "take one out, or correct its name"
            yield option, Diagnostic(Severity.WARNING, "name-repeated", message, hint=hint)


def _no_link(name: str, links: Collection[str], joints: Mapping[str, Joint]) -> Diagnostic:
    if name in joints:
        message = f"`frames` names `{name}`, which is a joint and no link"
        return _error("frame-of-no-link", message, f"name the link behind it, `{joints[name].child}`, or its parent")
    return _error("frame-of-no-link", f"`frames` names `{name}`, but the robot has no such link", _meant(name, links))


def _no_drive(name: str, links: Collection[str], joints: Mapping[str, Joint]) -> Diagnostic:
    joint, can = joints.get(name), [other.name for other in joints.values() if can_be_driven(other)]
    if joint is not None:
        message = f"`driven` names `{name}`, which {_hindrance(joint)}"
        leader = joint.mimic.joint if joint.mimic and joint.type != "fixed" else ""
        hint = f"name `{leader}`, or take it out" if leader in can else "take it out"
    elif name in links:
        above = next((joint.name for joint in joints.values() if joint.child == name), "")
        message = f"`driven` names `{name}`, which is a link and no joint"
        hint = f"name the joint that moves it, `{above}`" if above in can else "name a joint"
    else:
        message = f"`driven` names `{name}`, but the robot has no such joint"
        hint = _meant(name, can)
    return _error("drive-of-no-joint", message, hint)


def _hindrance(joint: Joint) -> str:
    """Why a joint can't be driven."""
    if joint.type == "fixed":
        return "is fixed"
    return f"follows joint `{joint.mimic.joint}`" if joint.mimic else f"is {joint.type} and has no single axis"


def _meant(name: str, known: Collection[str]) -> str:
    near = nearest(name, known)
    return f"did you mean `{near}`?" if near else "correct its name, or take it out"


def _passive(names: Collection[str]) -> Diagnostic:
    """The note that some joints are not driven, and how to change that."""
    ordered = sorted(names, key=natural_key)
    shown = ", ".join(f"`{name}`" for name in ordered[:_SHOWN])
    more = f" and {len(ordered) - _SHOWN} more" if len(ordered) > _SHOWN else ""
    message = (
        f"Run and Test do not drive {shown}{more}: others have a transmission or ros2_control, these not even a limit"
    )
    hint = "if that is wrong, list all joints to drive in `driven`"
    return Diagnostic(Severity.NOTE, "passive-joints", message, hint=hint)


def _error(code: str, message: str, hint: str) -> Diagnostic:
    return Diagnostic(Severity.ERROR, code, message, hint=hint)
