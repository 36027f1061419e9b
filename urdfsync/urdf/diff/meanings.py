"""Classify the differences of two robots, and say them in the words of URDF.

The class of a difference follows from the data of templates: it is structural if data of models would differ with this
value alone exchanged, a parameter if only data of records would, and else unmodelled.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeAlias

import msgspec

from urdfsync.domain import ChangeClass, ChangeKind, Difference, Import, Meaning, Version
from urdfsync.urdf.drives import driven_joints
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.model.robot import joint_model
from urdfsync.urdf.model.shapes import link_model, link_shapes, touching
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import MOTION_KINDS, Collision, Joint, Link, Mesh, Motion, Visual, effective, structure
from urdfsync.urdf.snapshot import joints_of

_Fields: TypeAlias = Sequence[str | int]
_Shapes: TypeAlias = tuple[Visual | Collision, ...]
"""One shape, or none."""
_Mentions: TypeAlias = Sequence[tuple[str, tuple[_Shapes, _Shapes]]]
"""Shapes of both versions, each with its group: `visuals` or `collisions`."""

_GROUPS: Mapping[str, Any] = {"visuals": tuple[Visual, ...], "collisions": tuple[Collision, ...]}
_UNSCALED = lookup.key(Mesh(""))
"""End of the key of a mesh without a scale."""

_UNITS = {
    "xyz": "m",
    "rpy": "rad",
    "size": "m",
    "radius": "m",
    "length": "m",
    **dict.fromkeys(("near", "far", "min_range", "max_range"), "m"),
    **dict.fromkeys(("horizontal_angle", "min_angle", "max_angle", "vertical_min_angle", "vertical_max_angle"), "rad"),
    "update_rate": "Hz",
    "mass": "kg",
    **dict.fromkeys(("ixx", "ixy", "ixz", "iyy", "iyz", "izz", "rotor_inertia"), "kg·m²"),
    "kp": "N/m",
    "kd": "N·s/m",
    "minDepth": "m",
    "maxVel": "m/s",
}
_POSITION: Mapping[Motion, str] = {"rotational": "rad", "translational": "m"}
_LOADS: Mapping[Motion, str] = {"rotational": "N·m", "translational": "N"}
_LOSSES: Mapping[Motion, str] = {"rotational": "N·m·s/rad", "translational": "N·s/m"}
_ACCELERATIONS: Mapping[Motion, str] = {"rotational": "rad/s²", "translational": "m/s²"}
_POSITIONS = ("lower", "upper", "offset", "rising", "falling", "soft_lower_limit", "soft_upper_limit")
_JOINT_UNITS: Mapping[str, Mapping[Motion, str]] = {
    **dict.fromkeys(_POSITIONS, _POSITION),
    **dict.fromkeys(("effort", "friction"), _LOADS),
    **dict.fromkeys(("damping", "k_velocity"), _LOSSES),
    "reduction": {"rotational": "", "translational": "rad/m"},
    "armature": {"rotational": "kg·m²", "translational": "kg"},
    "velocity": {"rotational": "rad/s", "translational": "m/s"},
    **dict.fromkeys(("acceleration", "deceleration"), _ACCELERATIONS),
    "jerk": {"rotational": "rad/s³", "translational": "m/s³"},
    "k_position": {"rotational": "1/s", "translational": "1/s"},
}
"""Units that depend on the motion of the joint."""


def describe(
    differences: Sequence[Difference], old: Version, new: Version, options: Options
) -> Sequence[Meaning | None]:
    """Return the meaning of each difference of two comparable versions; None for one that others explain."""
    versions = old, new
    mentions = _mentions(versions) if any(one.path[0] == "imports" for one in differences) else {}
    found: list[Meaning | None] = []
    for difference in differences:
        match difference.path:
            case ("imports", str(key)):
                # a further file of a mesh goes with its first one
                found.append(_of_import(key, mentions[key], versions, options) if key in mentions else None)
            case ("links" | "joints" as part, str(name)):
                found.append(Meaning((f"{part[:-1]} {name}",), ChangeClass.STRUCTURAL))
            case ("links", str(name), "visuals" | "collisions" as group, int(index), *inside):
                found.append(_of_shape(name, group, index, inside, versions, options))
            case ("links", str(name), "contact", *fields):
                # the model of a link that touches the ground says which numbers there are
                is_other = difference.kind is not ChangeKind.CHANGED and options.base == "floating"
                reach = ChangeClass.STRUCTURAL if is_other else ChangeClass.PARAMETER
                found.append(Meaning(_words(f"link {name}", ["contact", *fields]), reach, _unit(fields)))
            case ("links", str(name), *fields):
                found.append(Meaning(_words(f"link {name}", fields), ChangeClass.PARAMETER, _unit(fields)))
            case ("joints", str(name), "drive"):
                # A drive that comes or goes follows from type or mimic, one that is replaced may follow from an option.
                by_source = options.driven is None and "package" in options.approach
                is_change = by_source and difference.kind is ChangeKind.CHANGED
                found.append(Meaning((f"joint {name}", "drive"), ChangeClass.STRUCTURAL) if is_change else None)
            case ("joints", str(name), *fields):
                found.append(_of_joint(name, fields, difference, versions, options))
            case ("sensors", str(name), *fields):
                structural = not fields or fields[0] in ("kind", "at", "in_parent", "on_child")
                reach = ChangeClass.STRUCTURAL if structural else ChangeClass.PARAMETER
                has_models = "package" in options.approach
                found.append(
                    Meaning(
                        _words(f"sensor {name}", fields),
                        reach if has_models else ChangeClass.UNMODELLED,
                        _unit(fields),
                    )
                )
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


def _unit(fields: _Fields) -> str:
    return next((_UNITS.get(field, "") for field in reversed(fields) if isinstance(field, str)), "")


def _class(models: Iterator[bool], records: Iterator[bool]) -> ChangeClass:
    """Return how far a change reaches, of which it is known whether data of models and of records differ."""
    if any(models):
        return ChangeClass.STRUCTURAL
    return ChangeClass.PARAMETER if any(records) else ChangeClass.UNMODELLED


def _exchanged(one: Any, other: Any, fields: _Fields) -> Any:
    """Return `one` with a part of `other`: the smallest part around the place `fields` that both have."""
    if not fields or type(one) is not type(other):
        return other
    field, *inside = fields
    if isinstance(field, str):
        part = _exchanged(getattr(one, field), getattr(other, field), inside)
        return msgspec.structs.replace(one, **{field: part})
    if field >= min(len(one), len(other)):
        return other
    return (*one[:field], _exchanged(one[field], other[field], inside), *one[field + 1 :])


# --- shapes -------------------------------------------------------------------------------------------------------


def _of_shape(
    name: str, group: str, index: int, inside: _Fields, versions: Sequence[Version], options: Options
) -> Meaning:
    (before, after), (old, new) = [_shapes(one.snapshot["links"][name], group, index) for one in versions], versions
    data = []
    for one, other, own, others in (
        (before, after, old.imports, new.imports),
        (after, before, new.imports, old.imports),
    ):
        changed = _exchanged(one, other, (0, *inside))
        imports = own if _mesh_key(changed) == _mesh_key(one) else others
        data.append((_data(group, one, own, options), _data(group, changed, imports, options)))
    reach = _class((one[0] != other[0] for one, other in data), (one[1] != other[1] for one, other in data))
    words = f"link {name}", *_words(f"{group[:-1]} {index + 1}", inside)
    return Meaning(words, reach, _unit(inside))


def _of_import(key: str, mentions: _Mentions, versions: Sequence[Version], options: Options) -> Meaning:
    """Return the meaning of another content of a mesh; `mentions` are the shapes that have it in both versions."""
    models = (
        [_data(group, one, version.imports, options)[0] for one, version in zip(shapes, versions, strict=True)]
        for group, shapes in mentions
    )
    is_structural = any(one != other for one, other in models)
    words = f"mesh {key.removesuffix(_UNSCALED)}", "content"
    return Meaning(words, ChangeClass.STRUCTURAL if is_structural else ChangeClass.PARAMETER)


def _mentions(versions: Sequence[Version]) -> Mapping[str, _Mentions]:
    """Return per mesh the shapes that have it in both versions."""
    found: dict[str, list[tuple[str, tuple[_Shapes, _Shapes]]]] = {}
    before, after = (version.snapshot["links"] for version in versions)
    for name in before.keys() & after.keys():
        for group in _GROUPS:
            for index in range(min(len(before[name][group]), len(after[name][group]))):
                shapes = _shapes(before[name], group, index), _shapes(after[name], group, index)
                key = _mesh_key(shapes[0])
                if key and key == _mesh_key(shapes[1]):
                    found.setdefault(key, []).append((group, shapes))
    return found


def _shapes(link: Mapping[str, Any], group: str, index: int) -> _Shapes:
    shapes: _Shapes = msgspec.convert(link[group][index : index + 1], _GROUPS[group])
    return shapes


def _mesh_key(shapes: _Shapes) -> str | None:
    """Return the key of a shape's mesh among the imports; None for other shapes."""
    return next((lookup.key(shape.geometry) for shape in shapes if isinstance(shape.geometry, Mesh)), None)


def _data(
    group: str, shapes: _Shapes, imports: Mapping[str, Import] | None, options: Options
) -> tuple[Mapping[str, Any], Any]:
    """Return what models and what records say of a shape. If nobody looked for its mesh, it counts as found."""
    if imports is None:
        key = _mesh_key(shapes) if options.meshes == "import" else None
        imports = {key: Import(key, "", "", None, {"bounds": (), "hull": ((0.0, 0.0, 0.0),)})} if key else {}
    parts: dict[str, Any] = {group: shapes}
    link = Link("", **parts)
    visuals, collisions = link_shapes(link, imports, "", options)
    height = list(touching(link, imports)) if options.base == "floating" else []
    return link_model(visuals, collisions, options), (visuals, collisions, height)


# --- joints -------------------------------------------------------------------------------------------------------


def _of_joint(
    name: str, fields: _Fields, difference: Difference, versions: Sequence[Version], options: Options
) -> Meaning:
    old, new = (msgspec.convert({"name": name, **version.snapshot["joints"][name]}, Joint) for version in versions)
    changed = (old, _exchanged(old, new, fields)), (new, _exchanged(new, old, fields))
    data = [(effective(one), effective(other)) for one, other in changed]
    models = [[(structure(one), joint_model(one, options)) for one in pair] for pair in data]
    reach = _class((one != other for one, other in models), (one != other for one, other in data))
    if fields == ["command"]:
        driven = (name in driven_joints(joints_of(version.snapshot["joints"]), options) for version in versions)
        reach = ChangeClass.STRUCTURAL if any(driven) else ChangeClass.UNMODELLED
    units = [
        _joint_unit(name, version.snapshot["joints"], fields)
        for version, value in zip(versions, (difference.old, difference.new), strict=True)
        if value is not None
    ]
    return Meaning(_words(f"joint {name}", fields), reach, " → ".join(dict.fromkeys(filter(None, units))))


def _joint_unit(name: str, joints: Mapping[str, Any], fields: _Fields) -> str:
    """Return the unit of a number of a joint; `joints` are all of the version: a multiplier depends on its leader.

    Losses of a planar joint have none: one number stands for sliding and turning.
    """
    motion, field = MOTION_KINDS.get(joints[name]["type"]), str(fields[-1])
    if field != "multiplier":
        return _unit(fields) or (_JOINT_UNITS.get(field, {}).get(motion, "") if motion else "")
    leader = MOTION_KINDS.get(joints[joints[name]["mimic"]["joint"]]["type"])
    if motion is None or leader is None or motion == leader:
        return ""
    return f"{_POSITION[motion]}/{_POSITION[leader]}"
