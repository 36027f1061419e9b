"""Checks that each name in a robot's options belongs to a suitable link or joint.

An unknown name is an error: the robot would lack a drive or a connector. A repeated name is a warning: the user may
have meant another name.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence, Set

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.spelling import nearest
from urdfsync.formats.urdf import validate
from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.drives import by_effort, can_be_driven, chosen_law, is_chosen, passive_joints, wanted_joints
from urdfsync.formats.urdf.kinematics.poses import own_range
from urdfsync.formats.urdf.names import natural_key
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.parse.loops import configured_loops
from urdfsync.formats.urdf.robot import Joint, reflected_inertia

_DRIVABLE = "revolute, continuous or prismatic joint without <mimic>"
_NO_RECORD = 'take "record" out of `approach`'
_DRIVEN = f"{_DRIVABLE} that Run and Test drive"


def check_options(assembly: Assembly) -> Iterator[tuple[str, Diagnostic]]:
    """Yield diagnostics about a robot's options, with the name of the option, without file and line.

    The record approach ignores most options.
    """
    tree, options = assembly.tree, assembly.options
    links, joints = [link.name for link in tree.links], tree.joints
    ranges = {joint.name: own_range(joint) for joint in joints if can_be_driven(joint)}
    drivable, driven = list(ranges), wanted_joints(joints, options)
    checks: list[tuple[str, Sequence[str], Collection[str], str, str]] = [
        (f"{option}.{name}", (name,), drivable, _DRIVABLE, code)
        for option, names, code in (
            ("start", options.start, "start-of-no-joint"),
            ("motors", options.motors, "drive-of-no-joint"),
        )
        for name in names
    ]
    for name, start in options.start.items():
        lower, upper = ranges.get(name, (start, start))
        if not (lower <= start <= upper and math.isfinite(start)):
            message = f"`start` puts `{name}` at {start:g}, outside of its limits {lower:g} to {upper:g}"
            yield f"start.{name}", Diagnostic(Severity.ERROR, "start-outside", message, hint="correct the position")
    if "package" in options.approach:
        for name in [name for name in options.commands if name in ranges and name not in driven]:
            message = f"`commands` names `{name}`, which `driven` leaves out"
            yield f"commands.{name}", Diagnostic(Severity.ERROR, "drive-of-no-joint", message, hint="add it there")
        checks += (
            ("frames", _listed(options.frames), links, "link", "frame-of-no-link"),
            ("driven", options.driven or (), drivable, _DRIVABLE, "drive-of-no-joint"),
            *((f"commands.{name}", (name,), drivable, _DRIVABLE, "drive-of-no-joint") for name in options.commands),
            ("elastic", _listed(options.elastic), driven, _DRIVEN, "drive-of-no-joint"),
            ("saturated", _listed(options.saturated), driven, _DRIVEN, "drive-of-no-joint"),
            *(
                (f"friction.{name}", (name,), drivable, _DRIVABLE, "law-of-no-joint")
                for name in _named(options.friction)
            ),
        )
    for option, given, possible, kind, code in checks:
        for name, count in Counter(given).items():
            if count > 1:
                message, hint = f"`{option}` names `{name}` more than once", "remove one, or correct the name"
                yield option, Diagnostic(Severity.WARNING, "name-repeated", message, hint=hint)
            if name not in possible:
                near = nearest(name, possible)
                hint = f"did you mean `{near}`?" if near else "correct the name, or remove it from the option"
                message = f"`{option.partition('.')[0]}` names `{name}`, but the robot has no such {kind}"
                yield option, Diagnostic(Severity.ERROR, code, message, hint=hint)
    if "package" in options.approach:
        yield from _check_laws(joints, options)
    if "package" in options.approach and options.driven is None:
        yield from _find_passive(joints, passive_joints(joints) - driven - assembly.closed.dependent)
    if "record" in options.approach and tree.loops:
        message = "the record approach has no loops: the generic robot would be open"
        yield "approach", Diagnostic(Severity.ERROR, "loops-not-in-record", message, hint=_NO_RECORD)
    for joint in (joint for joint in joints if joint.name in options.motors and joint.motor is None):
        message = f"the catalogue has no row `{options.motors[joint.name]}`, which `motors` names"
        hint = f"add the row to {options.catalogue}, or correct its name" if options.catalogue else "set `catalogue`"
        yield f"motors.{joint.name}", Diagnostic(Severity.ERROR, "no-row", message, hint=hint)
    for finding in validate.check_loops(configured_loops(options.loops), links):
        name = finding.path.removeprefix("loop ").partition(" #")[0]
        yield f"loops.{name}", validate.diagnostic(finding.code, finding.message, 0, finding.hint)


def _find_passive(joints: Sequence[Joint], passive: Set[str]) -> Iterator[tuple[str, Diagnostic]]:
    """Yield a note on passive joints for each reason."""
    measured = {joint.name for joint in joints if joint.measured}
    for names, reason in (
        (passive - measured, "no transmission, no ros2_control and no limit"),
        (passive & measured, "the source has no motor for these joints"),
    ):
        if names:
            listed = ", ".join(f"`{name}`" for name in sorted(names, key=natural_key))
            message = f"Run and Test do not drive {listed}: {reason}"
            hint = "to drive other joints, list all driven joints in `driven`"
            yield "driven", Diagnostic(Severity.NOTE, "passive-joints", message, hint=hint)


def _listed(names: str | tuple[str, ...]) -> tuple[str, ...]:
    return () if isinstance(names, str) else names


def _named(friction: str | Mapping[str, str]) -> Iterable[str]:
    return () if isinstance(friction, str) else friction


def _check_laws(joints: Sequence[Joint], options: Options) -> Iterator[tuple[str, Diagnostic]]:
    """Yield an error for each joint whose friction law and drive exclude each other."""
    driven, named = wanted_joints(joints, options), _named(options.friction)
    for joint in filter(can_be_driven, joints):
        law, is_dry = chosen_law(joint, options), joint.dynamics is not None and joint.dynamics.friction > 0
        is_driven, gives_effort = joint.name in driven, by_effort(joint)
        is_elastic = is_driven and is_chosen(joint, options.elastic)
        faults = []
        if law != "smooth" and not is_dry and (joint.dynamics or joint.name in named):
            hint = "give the joint's <dynamics> a friction, or choose laws by joints"
            faults.append(("friction", "has no dry friction", hint))
        elif law == "stiction" and is_driven and not is_elastic:
            faults.append(
                ("friction", "sticks while Test prescribes its motion", 'add the joint to `elastic`, or take "lugre"')
            )
        if is_elastic and gives_effort and not reflected_inertia(joint):
            hint = "give the joint an armature or a rotor, or take the joint out of `elastic`"
            faults.append(("elastic", "is driven by an effort, but has no inertia before the spring", hint))
        if is_driven and is_chosen(joint, options.saturated) and not is_elastic and not gives_effort:
            hint = "name the joint in `elastic`, or give it the command `effort`"
            faults.append(("saturated", "has a drive that prescribes its motion at any effort", hint))
        for option, reason, hint in faults:
            place = f"friction.{joint.name}" if option == "friction" and joint.name in named else option
            message = f"`{option}` means `{joint.name}`, which {reason}"
            yield place, Diagnostic(Severity.ERROR, f"{option}-impossible", message, hint=hint)
