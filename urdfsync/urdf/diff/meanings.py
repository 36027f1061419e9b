"""Classify the differences of two robots, and say them in the words of URDF.

The classes follow from what the templates print: models hold structure and names, records hold numbers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal, NamedTuple, TypeAlias

from urdfsync.domain import ChangeClass, ChangeKind, Difference, Import, Meaning, Version
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import MOTION_KINDS, Mesh, Motion

_ABSENT = object()
_Group: TypeAlias = Literal["visuals", "collisions"]

_SCALAR = frozenset(MOTION_KINDS)
_MODELLED = {
    "axis": _SCALAR | {"planar"},
    "limit": _SCALAR,
    "dynamics": _SCALAR | {"planar"},
    "mimic": _SCALAR,
    "calibration": _SCALAR,
    "safety_controller": _SCALAR,
}
"""Per part of a joint, the types of joints that have it in Modelica; all others are in every joint."""
_STRUCTURE = frozenset({("type",), ("parent",), ("child",), ("dynamics",), ("mimic",), ("mimic", "joint")})
"""Parts of a joint that its model says, as far as they are modelled; records have the rest."""
_UNLIMITED = frozenset({("limit", "lower"), ("limit", "upper")})
"""Limits that a continuous joint does not have."""
_UNSCALED = lookup.key(Mesh(""))
"""End of the key of a mesh without a scale."""

_UNITS = {
    "xyz": "m",
    "rpy": "rad",
    "size": "m",
    "radius": "m",
    "length": "m",
    "mass": "kg",
    **dict.fromkeys(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), "kg·m²"),
}
_POSITIONS = ("lower", "upper", "offset", "rising", "falling", "soft_lower_limit", "soft_upper_limit")
_JOINT_UNITS: Mapping[Motion, Mapping[str, str]] = {
    "rotational": {
        **dict.fromkeys(_POSITIONS, "rad"),
        "velocity": "rad/s",
        "effort": "N·m",
        "damping": "N·m·s/rad",
        "friction": "N·m",
        "k_velocity": "N·m·s/rad",
        "k_position": "1/s",
    },
    "translational": {
        **dict.fromkeys(_POSITIONS, "m"),
        "velocity": "m/s",
        "effort": "N",
        "damping": "N·s/m",
        "friction": "N",
        "k_velocity": "N·s/m",
        "k_position": "1/s",
    },
}


def describe(
    differences: Sequence[Difference], old: Version, new: Version, options: Options
) -> Sequence[Meaning | None]:
    """Return the meaning of each difference of two comparable versions; None for one that others explain."""
    versions = old, new
    shared = _shared_meshes(old, new) if any(one.path[0] == "imports" for one in differences) else {}
    found: list[Meaning | None] = []
    for difference in differences:
        match difference.path:
            case ("imports", str(key)):
                found.append(_of_import(key, shared.get(key, ()), versions, options))
            case ("links", str(name), *fields):
                found.append(_of_link(name, fields, versions, options))
            case ("joints", str(name), "drive"):
                found.append(_of_drive(name, difference.kind, options))
            case ("joints", str(name), *fields):
                found.append(_of_joint(name, fields, versions))
            case ("extensions", str(owner), *fields):
                found.append(Meaning(_words(owner or "robot", fields or ["extensions"]), ChangeClass.UNMODELLED))
            case (*fields,):
                found.append(Meaning(_words("robot", fields), ChangeClass.PARAMETER))
    return found


# --- links --------------------------------------------------------------------------------------------------------


class _Appearance(NamedTuple):
    """What a model says of a shape."""

    kind: str
    has_contact: bool
    """Whether it touches the ground."""


def _of_link(name: str, fields: Sequence[str | int], versions: Sequence[Version], options: Options) -> Meaning:
    words = _words(f"link {name}", fields)
    unit = _UNITS.get(_innermost(fields), "")
    match fields:
        case []:
            return Meaning(words, ChangeClass.STRUCTURAL)
        case ["visuals" | "collisions" as group, int(index), *inside]:
            words = (words[0], f"{group[:-1]} {index + 1}", *_words("", inside)[1:])
            return Meaning(words, _shape_class(name, group, index, inside, versions, options), unit)
        case _:
            return Meaning(words, ChangeClass.PARAMETER, unit)


def _shape_class(
    link: str,
    group: _Group,
    index: int,
    inside: Sequence[str | int],
    versions: Sequence[Version],
    options: Options,
) -> ChangeClass:
    """Return how far a change inside of a shape reaches."""
    found = [version.snapshot["links"][link][group][index : index + 1] for version in versions]
    old, new = (
        _appearance(shapes[0], group, version.imports, options) if shapes else None
        for shapes, version in zip(found, versions, strict=True)
    )
    if old is None and new is None:
        # the standing height in the record follows from collisions, even if no model shows them
        stands = options.base == "floating" and not options.collisions
        is_used = group == "collisions" and stands and inside[:1] != ["name"]
        return ChangeClass.PARAMETER if is_used else ChangeClass.UNMODELLED
    match inside:
        case [] | ["geometry", *_] if old != new:
            return ChangeClass.STRUCTURAL
        case ["material", "name" | "texture"]:
            return ChangeClass.UNMODELLED
        case ["material"] if not any("rgba" in shape.get("material", {}) for shapes in found for shape in shapes):
            return ChangeClass.UNMODELLED
        case _:
            return ChangeClass.PARAMETER


def _appearance(
    shape: Mapping[str, Any], group: _Group, imports: Mapping[str, Import] | None, options: Options
) -> _Appearance | None:
    """Return what a model says of a shape; None if it is left out, as shapes without their mesh are.

    `imports` are None if nobody looked for the meshes.
    """
    if group == "collisions" and not options.collisions:
        return None
    has_contact = options.base == "floating" and group == "collisions"
    kind, key = shape["geometry"]["kind"], _mesh_key(shape)
    if key is None:
        return _Appearance(kind, has_contact)
    if options.meshes != "import":
        return None
    if imports is None:
        return _Appearance(kind, has_contact)
    found = imports.get(key)
    return None if found is None else _Appearance(kind, has_contact and bool(found.facts["hull"]))


def _mesh_key(shape: Mapping[str, Any]) -> str | None:
    """Return the key of a shape's mesh among the imports; None for other shapes."""
    geometry = shape["geometry"]
    return lookup.key(Mesh(geometry["filename"], tuple(geometry["scale"]))) if geometry["kind"] == "mesh" else None


_Shapes: TypeAlias = Sequence[tuple[Mapping[str, Any], _Group]]


def _shared_meshes(old: Version, new: Version) -> Mapping[str, _Shapes]:
    """Return per mesh the shapes that have it in both versions, each with its group."""
    result: dict[str, list[tuple[Mapping[str, Any], _Group]]] = {}
    groups: tuple[_Group, ...] = ("visuals", "collisions")
    for name, link in new.snapshot["links"].items():
        before = old.snapshot["links"].get(name)
        for group in groups if before is not None else ():
            for one, two in zip(before[group], link[group], strict=False):
                key = _mesh_key(two)
                if key is not None and _mesh_key(one) == key:
                    result.setdefault(key, []).append((two, group))
    return result


def _of_import(key: str, shapes: _Shapes, versions: Sequence[Version], options: Options) -> Meaning | None:
    """Return the meaning of another content of a mesh; None if no shape shows it in both versions."""
    if not shapes:
        return None
    old, new = ([_appearance(*shape, version.imports, options) for shape in shapes] for version in versions)
    words = (f"mesh {key.removesuffix(_UNSCALED)}", "content")
    return Meaning(words, ChangeClass.PARAMETER if old == new else ChangeClass.STRUCTURAL)


# --- joints -------------------------------------------------------------------------------------------------------


def _of_joint(name: str, fields: Sequence[str | int], versions: Sequence[Version]) -> Meaning:
    words = _words(f"joint {name}", fields)
    if not fields:
        return Meaning(words, ChangeClass.STRUCTURAL)
    place = tuple(field for field in fields if isinstance(field, str))
    classes, units = [], []
    for joints in (version.snapshot["joints"] for version in versions):
        kind, value = joints[name]["type"], joints[name]
        if kind not in _MODELLED.get(place[0], (kind,)) or (kind == "continuous" and place in _UNLIMITED):
            classes.append(ChangeClass.UNMODELLED)
        else:
            classes.append(ChangeClass.STRUCTURAL if place in _STRUCTURE else ChangeClass.PARAMETER)
        for field in place:
            value = value[field] if isinstance(value, Mapping) and field in value else _ABSENT
        if value is not _ABSENT:
            units.append(_joint_unit(joints[name], joints, place[-1]))
    unit = " → ".join(dict.fromkeys(filter(None, units)))
    return Meaning(words, max(classes, key=lambda c: c.rank), unit)


def _joint_unit(joint: Mapping[str, Any], joints: Mapping[str, Any], field: str) -> str:
    """Return the unit of a number of a joint; `joints` are all of the version: a multiplier depends on its leader.

    Losses of a planar joint have none: one number stands for sliding and turning.
    """
    motion = MOTION_KINDS.get(joint["type"])
    if field != "multiplier":
        return _UNITS.get(field, "") or (_JOINT_UNITS[motion].get(field, "") if motion else "")
    leader = MOTION_KINDS.get(joints[joint["mimic"]["joint"]]["type"])
    if motion is None or leader is None or motion == leader:
        return ""
    return f"{_JOINT_UNITS[motion]['lower']}/{_JOINT_UNITS[leader]['lower']}"


def _of_drive(name: str, kind: ChangeKind, options: Options) -> Meaning | None:
    """Return the meaning of a drive that comes or goes; None if type, mimic or an option of the joint decide on it."""
    if kind is not ChangeKind.CHANGED or options.driven is not None or "package" not in options.approach:
        return None
    return Meaning((f"joint {name}", "drive"), ChangeClass.STRUCTURAL)


# --- paths --------------------------------------------------------------------------------------------------------


def _words(element: str, fields: Sequence[str | int]) -> tuple[str, ...]:
    """Return a path as people read it: an index goes with its list."""
    words = [element]
    for field in fields:
        if isinstance(field, int):
            words[-1] += f"[{field}]"
        else:
            words.append(field)
    return tuple(words)


def _innermost(fields: Sequence[str | int]) -> str:
    """Return the innermost name."""
    return next((field for field in reversed(fields) if isinstance(field, str)), "")
