"""The numbers of links, joints and loops, as modifiers of the library's records.

A value that the URDF leaves out is no modifier, unless the record has no default for it: then it is infinite.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.formats.urdf.kinematics.loops import Closure
from urdfsync.formats.urdf.model.shapes import DrawnShape
from urdfsync.formats.urdf.robot import Inertial, Joint, Loop, Mesh
from urdfsync.modelica.literals import INFINITY, Expression, matrix


class RecordPart(msgspec.Struct, frozen=True):
    """A record of numbers as a component of another record."""

    base: str
    """The class in the library's `Records`."""
    component: str
    title: str
    numbers: Mapping[str, Any]
    hull: Sequence[Sequence[float]] = ()
    """The outermost points of a mesh, which the record of a link has beside those of the mesh."""


_ABSENT = Expression(INFINITY)
_NO_LIMITS = {"lower": Expression(f"-{INFINITY}"), "upper": _ABSENT, "velocity": _ABSENT, "effort": _ABSENT}


def link_numbers(name: str, inertial: Inertial | None) -> dict[str, Any]:
    """Return the numbers of a link's mass."""
    if inertial is None:
        return {"name": name, "hasInertial": False}
    inertia = {axes: getattr(inertial.inertia, axes) for axes in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")}
    return {"name": name, "inertial": {"origin": _given(inertial.origin), "mass": inertial.mass, "inertia": inertia}}


def shape_numbers(shape: DrawnShape) -> dict[str, Any]:
    """Return the numbers of a visual or a collision."""
    if isinstance(shape.geometry, Mesh):
        lower, upper = shape.bounds
        size = {"uri": shape.uri, "lower": lower, "upper": upper}
    else:
        size = msgspec.structs.asdict(shape.geometry)
    return {"origin": _given(shape.origin), **size, "color": shape.color, "opacity": shape.opacity}


def joint_record(joint: Joint) -> str:
    """Return the class of a joint's record in the library's `Records`."""
    return f"{joint.type.capitalize()}Joint"


def joint_numbers(joint: Joint) -> dict[str, Any]:
    """Return the numbers of an effective joint."""
    numbers, dynamics = {"name": joint.name, "origin": _given(joint.origin)}, _given(joint.dynamics)
    match joint.type:
        case "fixed" | "floating":
            return numbers
        case "ball":
            return numbers | {name: dynamics[name] for name in dynamics if name == "damping"}
        case "planar":
            losses = dict.fromkeys(("translation", "rotation") if dynamics else (), dynamics)
            return numbers | {"axis": joint.axis} | losses
    transmission = _given(joint.transmission)
    if joint.transmission and transmission.pop("joint", None):
        transmission["otherReduction"] = transmission.pop("jointReduction", _ABSENT)
    mimic = joint.mimic and {"multiplier": joint.mimic.multiplier, "offset": joint.mimic.offset}
    calibration = joint.calibration and {"rising": _ABSENT, "falling": _ABSENT} | _given(joint.calibration)
    safety = joint.safety_controller and msgspec.structs.asdict(joint.safety_controller)  # Modelica has URDF's names
    parts = {
        "dynamics": dynamics,
        "transmission": transmission,
        "servo": _given(joint.servo),
        "mimic": mimic,
        "calibration": calibration,
        "safetyController": safety,
    }
    given = {name: part for name, part in parts.items() if part}
    return numbers | {"axis": joint.axis, "limits": _limits(joint)} | given


def shape_part(shape: DrawnShape) -> RecordPart:
    """Return the record of a visual or a collision as a component of the record of its link."""
    return RecordPart(shape.model.type, shape.model.component, shape.title, shape_numbers(shape), shape.hull)


def loop_numbers(loop: Loop, closure: Closure) -> dict[str, Any]:
    """Return the numbers of a joint that closes a loop."""
    turned = [u for u, _ in closure.rotations], [v for _, v in closure.rotations]
    rows = zip(("translations", "rotations", "childRotations"), (closure.translations, *turned), strict=True)
    return {
        "name": loop.name,
        "origin": _given(loop.origin),
        "childOrigin": _given(loop.child_origin),
        **{name: Expression(matrix(values, 3)) for name, values in rows},
    }


def _limits(joint: Joint) -> dict[str, Any]:
    given = _given(joint.limit)
    if joint.type == "continuous":
        given = {name: value for name, value in given.items() if name not in ("lower", "upper")}
    return _NO_LIMITS | given


def camel(name: str) -> str:
    """Return the name of a field as records have it."""
    first, *rest = name.split("_")
    return first + "".join(map(str.capitalize, rest))


def _given(part: msgspec.Struct | None) -> dict[str, Any]:
    """Return the values of a part that are given, by names in camel case."""
    values = msgspec.structs.asdict(part) if part else {}
    return {camel(name): value for name, value in values.items() if value is not None}
