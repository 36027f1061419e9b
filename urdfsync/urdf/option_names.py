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

_SHOWN = 5  # names of passive joints that are listed; of more, the others are counted


def check_options(
    links: Collection[str], joints: Sequence[Joint], options: Options
) -> Iterator[tuple[str, Diagnostic]]:
    """Yield what there is to say of a robot's options, each with the option that it is about; without file and line.

    `links` are the names of all links. The record approach has no use for these options.
    """
    if "package" not in options.approach:
        return
    by_name = {joint.name: joint for joint in joints}
    for option, given in (("frames", options.frames), ("driven", options.driven)):
        if not isinstance(given, tuple):
            continue
        for name, count in Counter(given).items():
            if count > 1:
                times = "twice" if count == 2 else f"{count} times"
                message, hint = f"`{option}` names `{name}` {times}", "take one out, or correct its name"
                yield option, Diagnostic(Severity.WARNING, "name-repeated", message, hint=hint)
        for name in dict.fromkeys(given):
            if option == "frames" and name not in links:
                yield option, _no_link(name, links, by_name)
            elif option == "driven" and (name not in by_name or not can_be_driven(by_name[name])):
                yield option, _no_drive(name, links, by_name)
    passive = sorted(passive_joints(joints), key=natural_key) if options.driven is None else []
    if passive:
        shown = ", ".join(f"`{name}`" for name in passive[:_SHOWN])
        more = f" and {len(passive) - _SHOWN} more" if len(passive) > _SHOWN else ""
        message = f"Run and Test do not drive {shown}{more}: "
        message += "others have a transmission or ros2_control, these not even a limit"
        hint = "if that is wrong, list all joints to drive in `driven`"
        yield "driven", Diagnostic(Severity.NOTE, "passive-joints", message, hint=hint)


def _no_link(name: str, links: Collection[str], joints: Mapping[str, Joint]) -> Diagnostic:
    if name in joints:
        message = f"`frames` names `{name}`, which is a joint and no link"
        hint = f"name the link behind it, `{joints[name].child}`, or its parent"
    else:
        message, hint = f"`frames` names `{name}`, but the robot has no such link", _meant(name, links)
    return Diagnostic(Severity.ERROR, "frame-of-no-link", message, hint=hint)


def _no_drive(name: str, links: Collection[str], joints: Mapping[str, Joint]) -> Diagnostic:
    can = [other.name for other in joints.values() if can_be_driven(other)]
    if joint := joints.get(name):
        leader = joint.mimic.joint if joint.mimic else ""
        what = f"which follows joint `{leader}`" if leader else f"which is {joint.type} and has no single axis"
        hint = f"name `{leader}`, or take it out" if leader in can else "take it out"
        if joint.type == "fixed":
            what, hint = "which is fixed", "take it out"
    elif name in links:
        above = next((joint.name for joint in joints.values() if joint.child == name), "")
        what = "which is a link and no joint"
        hint = f"name the joint that moves it, `{above}`" if above in can else "name a joint"
    else:
        what, hint = "but the robot has no such joint", _meant(name, can)
    return Diagnostic(Severity.ERROR, "drive-of-no-joint", f"`driven` names `{name}`, {what}", hint=hint)


def _meant(name: str, known: Collection[str]) -> str:
    near = nearest(name, known)
    return f"did you mean `{near}`?" if near else "correct its name, or take it out"
