"""Classify the differences of two robots, and say them in the words of URDF.

The classes follow from what the templates print: models hold structure and names, records hold numbers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from urdfsync.domain import ChangeClass, ChangeKind, Difference, Import, Meaning, Version
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import JOINT_KINDS, MOTION_KINDS, JointType, Mesh, Motion

_Fields: TypeAlias = Sequence[str | int]
_Shapes: TypeAlias = Sequence[tuple[str, Mapping[str, Any]]]
"""Shapes, each with its group: `visuals` or `collisions`."""

_STRUCTURE = frozenset({("type",), ("parent",), ("child",), ("dynamics",), ("mimic",), ("mimic", "joint")})
"""Parts of a joint that its model says, as far as they are modelled; records have the rest."""
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
_POSITION: Mapping[Motion, str] = {"rotational": "rad", "translational": "m"}
_LOADS: Mapping[Motion, str] = {"rotational": "N·m", "translational": "N"}
_LOSSES: Mapping[Motion, str] = {"rotational": "N·m·s/rad", "translational": "N·s/m"}
_POSITIONS = ("lower", "upper", "offset", "rising", "falling", "soft_lower_limit", "soft_upper_limit")
_JOINT_UNITS: Mapping[str, Mapping[Motion, str]] = {
    **dict.fromkeys(_POSITIONS, _POSITION),
    **dict.fromkeys(("effort", "friction"), _LOADS),
    **dict.fromkeys(("damping", "k_velocity"), _LOSSES),
    "velocity": {"rotational": "rad/s", "translational": "m/s"},
    "k_position": {"rotational": "1/s", "translational": "1/s"},
}
"""Units that depend on the motion of the joint."""


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
                found.append(_of_import(key, shared[key], versions, options) if key in shared else None)
            case ("links", str(name), *fields):
                found.append(_of_link(name, fields, versions, options))
            case ("joints", str(name), "drive"):
                # A drive that comes or goes follows from type or mimic, one that is replaced may follow from an option.
                by_source = options.driven is None and "package" in options.approach
                is_change = by_source and difference.kind is ChangeKind.CHANGED
                found.append(Meaning((f"joint {name}", "drive"), ChangeClass.STRUCTURAL) if is_change else None)
            case ("joints", str(name), *fields):
                found.append(_of_joint(name, fields, versions))
            case ("extensions", str(owner), *fields):
                found.append(Meaning(_words(owner or "robot", fields or ["extensions"]), ChangeClass.UNMODELLED))
            case (*fields,):
                found.append(Meaning(_words("robot", fields), ChangeClass.PARAMETER))
    return found


def _words(element: str, fields: _Fields) -> tuple[str, ...]:
    """Return a path as people read it: an index goes with its list."""
    words = [element]
    for field in fields:
        if isinstance(field, int):
            words[-1] += f"[{field}]"
        else:
            words.append(field)
    return tuple(words)


# --- links --------------------------------------------------------------------------------------------------------


def _of_link(name: str, fields: _Fields, versions: Sequence[Version], options: Options) -> Meaning:
    element = f"link {name}"
    unit = next((_UNITS.get(field, "") for field in reversed(fields) if isinstance(field, str)), "")
    match fields:
        case []:
            return Meaning((element,), ChangeClass.STRUCTURAL)
        case ["visuals" | "collisions" as group, int(index), *inside]:
            words = element, *_words(f"{group[:-1]} {index + 1}", inside)
            shapes = [version.snapshot["links"][name][group][index : index + 1] for version in versions]
            return Meaning(words, _shape_class(group, shapes, inside, versions, options), unit)
        case _:
            return Meaning(_words(element, fields), ChangeClass.PARAMETER, unit)


def _shape_class(
    group: str,
    shapes: Sequence[Sequence[Mapping[str, Any]]],
    inside: _Fields,
    versions: Sequence[Version],
    options: Options,
) -> ChangeClass:
    """Return how far a change inside of a shape reaches; `shapes` has the shape of each version, if it has one."""
    old, new = (
        _in_model(group, found[0], version.imports, options) if found else None
        for found, version in zip(shapes, versions, strict=True)
    )
    if old is None and new is None:
        # The standing height in the record follows from collisions, even if no model shows them.
        has_height = group == "collisions" and options.base == "floating" and not options.collisions
        return ChangeClass.PARAMETER if has_height and inside[:1] != ["name"] else ChangeClass.UNMODELLED
    match inside:
        case [] | ["geometry", *_] if old != new:
            return ChangeClass.STRUCTURAL
        case ["material", "name" | "texture"]:
            return ChangeClass.UNMODELLED
        case ["material"] if not any("rgba" in shape.get("material", {}) for found in shapes for shape in found):
            return ChangeClass.UNMODELLED
        case _:
            return ChangeClass.PARAMETER


def _in_model(
    group: str, shape: Mapping[str, Any], imports: Mapping[str, Import] | None, options: Options
) -> tuple[str, bool] | None:
    """Return the kind of a shape, and whether it touches the ground; None if models leave it out.

    Shapes without their mesh are left out. `imports` are None if nobody looked for the meshes.
    """
    key, touches = _mesh_key(shape), group == "collisions" and options.base == "floating"
    if group == "collisions" and not options.collisions:
        return None
    if key is not None and options.meshes != "import":
        return None
    if key is not None and imports is not None:
        if key not in imports:
            return None
        touches = touches and bool(imports[key].facts["hull"])
    return shape["geometry"]["kind"], touches


def _mesh_key(shape: Mapping[str, Any]) -> str | None:
    """Return the key of a shape's mesh among the imports; None for other shapes."""
    geometry = shape["geometry"]
    return lookup.key(Mesh(geometry["filename"], tuple(geometry["scale"]))) if geometry["kind"] == "mesh" else None


def _shared_meshes(old: Version, new: Version) -> Mapping[str, _Shapes]:
    """Return per mesh the shapes that have it in both versions."""
    shapes: dict[str, list[tuple[str, Mapping[str, Any]]]] = {}
    for name in old.snapshot["links"].keys() & new.snapshot["links"].keys():
        for group in ("visuals", "collisions"):
            before, after = (version.snapshot["links"][name][group] for version in (old, new))
            for one, two in zip(before, after, strict=False):
                if (key := _mesh_key(two)) and _mesh_key(one) == key:
                    shapes.setdefault(key, []).append((group, two))
    return shapes


def _of_import(key: str, shapes: _Shapes, versions: Sequence[Version], options: Options) -> Meaning:
    """Return the meaning of another content of a mesh; `shapes` have it in both versions."""
    old, new = ([_in_model(*shape, version.imports, options) for shape in shapes] for version in versions)
    words = (f"mesh {key.removesuffix(_UNSCALED)}", "content")
    return Meaning(words, ChangeClass.PARAMETER if old == new else ChangeClass.STRUCTURAL)


# --- joints -------------------------------------------------------------------------------------------------------


def _of_joint(name: str, fields: _Fields, versions: Sequence[Version]) -> Meaning:
    words = _words(f"joint {name}", fields)
    if not fields:
        return Meaning(words, ChangeClass.STRUCTURAL)
    place = tuple(field for field in fields if isinstance(field, str))
    reaches = ChangeClass.STRUCTURAL if place in _STRUCTURE else ChangeClass.PARAMETER
    classes, units = [], []
    for joints in (version.snapshot["joints"] for version in versions):
        value = joint = joints[name]
        classes.append(reaches if _is_modelled(joint["type"], place) else ChangeClass.UNMODELLED)
        for field in place:
            value = value.get(field) if isinstance(value, Mapping) else None
        if value is not None:
            units.append(_joint_unit(joint, joints, place[-1]))
    unit = " → ".join(dict.fromkeys(filter(None, units)))
    return Meaning(words, max(classes, key=lambda c: c.rank), unit)


def _is_modelled(joint_type: JointType, place: tuple[str, ...]) -> bool:
    """Return whether something in Modelica depends on a part of a joint of this type."""
    kind = JOINT_KINDS[joint_type]
    match place:
        case ("axis" | "dynamics", *_):
            return kind.has_axis
        case ("limit", "lower" | "upper"):
            return kind.has_limits
        case ("limit" | "mimic" | "calibration" | "safety_controller", *_):
            return kind.motion is not None
        case _:
            return True


def _joint_unit(joint: Mapping[str, Any], joints: Mapping[str, Any], field: str) -> str:
    """Return the unit of a number of a joint; `joints` are all of the version: a multiplier depends on its leader.

    Losses of a planar joint have none: one number stands for sliding and turning.
    """
    motion = MOTION_KINDS.get(joint["type"])
    if field != "multiplier":
        return _UNITS.get(field, "") or (_JOINT_UNITS.get(field, {}).get(motion, "") if motion else "")
    leader = MOTION_KINDS.get(joints[joint["mimic"]["joint"]]["type"])
    if motion is None or leader is None or motion == leader:
        return ""
    return f"{_POSITION[motion]}/{_POSITION[leader]}"
