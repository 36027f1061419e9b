"""Classifies the differences between two robots, and names them in the words of URDF.

To classify a difference, only its value is exchanged in the data of templates. A difference that changes the data of
models is structural. A difference that changes only the data of records is a parameter. Any other difference is
unmodelled.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import msgspec

from urdfsync.domain import ChangeClass, ChangeKind, ElementKey, Import, Version, belongs_to
from urdfsync.domain.changes import Change
from urdfsync.domain.comparison import Difference, find_differences
from urdfsync.formats.urdf import robot
from urdfsync.formats.urdf.diff.renames import comparable, renamed
from urdfsync.formats.urdf.drives import can_be_driven, wanted_joints
from urdfsync.formats.urdf.meshes import lookup
from urdfsync.formats.urdf.model.joint import joint_model
from urdfsync.formats.urdf.model.shapes import link_model, link_shapes, touching
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.parse.catalogue import NUMBERS
from urdfsync.formats.urdf.robot import (
    MOTION_KINDS,
    Collision,
    Joint,
    Link,
    Mesh,
    UnitName,
    Visual,
    by_number,
    effective,
    shape_numbers,
    structure,
)

_Fields: TypeAlias = Sequence[str | int]

_SHAPES = ("visuals", "collisions")
_STRUCTURE = ("kind", "at", "in_parent", "on_child", "parent", "child")
"""Fields of sensors and loops that models depend on."""
_POINT = ((0.0, 0.0, 0.0),)
"""Stands for an unknown hull: a single point, so that the mesh counts as touching the ground."""
_UNSCALED = lookup.key(Mesh(""))
"""End of the key of a mesh without a scale."""


class _RobotVersion(NamedTuple):
    """One version of the robot, with names of the new version."""

    links: Mapping[str, Link]
    joints: Mapping[str, Joint]
    imports: Mapping[str, Import] | None


def describe(old: Version, new: Version, renames: Mapping[ElementKey, str], options: Options) -> Iterator[Change]:
    """Yield the changes of a robot, except consequences of other changes."""
    sides = [
        _RobotVersion({link.name: link for link in robot.links}, {joint.name: joint for joint in robot.joints}, imports)
        for robot, imports in (
            (renamed(old.snapshot, renames), _with_hulls(old.imports, new.imports, options)),
            (new.snapshot, _with_hulls(new.imports, old.imports, options)),
        )
    ]
    for difference in find_differences(old, new, *comparable(old.snapshot, new.snapshot, renames)):
        if change := _describe(difference, sides[0], sides[1], options):
            yield change


def _with_hulls(
    imports: Mapping[str, Import] | None, others: Mapping[str, Import] | None, options: Options
) -> Mapping[str, Import] | None:
    """Return imports with a hull each: their own, else that of another version's file, else a point.

    A mesh has a hull where it collides in a floating robot. But values of both versions are mixed here, and the last
    build may have had another `base`. A fixed robot needs no hulls.
    """
    if imports is None or options.base != "floating":
        return imports
    complete = dict(imports)
    for key, file in imports.items():
        if lookup.HULL not in file.facts:
            other = (others or {}).get(key, file)
            hull = other.facts.get(lookup.HULL, _POINT)
            complete[key] = msgspec.structs.replace(file, facts={**file.facts, lookup.HULL: hull})
    return complete


def _describe(difference: Difference, old: _RobotVersion, new: _RobotVersion, options: Options) -> Change | None:
    match difference.path:
        case ("imports", str(key)):
            return _of_import(difference, key, old, new, options)
        case ("links" | "joints" as part, str(name)):
            return difference.change((f"{part[:-1]} {name}",), ChangeClass.STRUCTURAL)
        case ("links", str(name), *fields):
            words = [f"link {name}", *fields]
            if fields[0] in _SHAPES and len(fields) > 1:
                words[1:3] = [f"{str(fields[0])[:-1]} {fields[1]}"]
            return difference.change(
                _path(words), _reach(old.links[name], new.links[name], difference, old, new, options), _unit(fields)
            )
        case ("joints", str(name), "drive"):
            # A changed type or mimic may add or remove a drive: that change is reported instead. With the option
            # `driven`, the source does not decide on drives.
            by_source = options.driven is None and "package" in options.approach
            is_change = by_source and difference.kind is ChangeKind.CHANGED
            return difference.change((f"joint {name}", "drive"), ChangeClass.STRUCTURAL) if is_change else None
        case ("joints", str(name), "command"):
            driven = (name in wanted_joints(side.joints.values(), options) for side in (old, new))
            reach = ChangeClass.STRUCTURAL if any(driven) else ChangeClass.UNMODELLED
            return difference.change((f"joint {name}", "command"), reach)
        case ("joints", str(name), "servo", *fields) if _changes_law(difference, new.joints[name], options):
            return difference.change(_path([f"joint {name}", "servo", *fields]), ChangeClass.STRUCTURAL, _unit(fields))
        case ("joints", _, "motor", *_):
            return None  # the change of the option and of each number is reported instead
        case ("joints", str(name), *fields):
            units = [
                _joint_unit(name, side.joints, fields)
                for side, value in ((old, difference.old), (new, difference.new))
                if value is not None
            ]
            reach = _reach(old.joints[name], new.joints[name], difference, old, new, options)
            motor, number = new.joints[name].motor, NUMBERS.get(tuple(fields))
            words = [f"motor {motor.row}", number] if motor and number in motor.numbers else fields
            return difference.change(
                _path([f"joint {name}", *words]), reach, " → ".join(dict.fromkeys(filter(None, units)))
            )
        case ("sensors" | "loops" as part, str(name), *fields):
            is_structural = not fields or fields[0] in _STRUCTURE
            reach = ChangeClass.STRUCTURAL if is_structural else ChangeClass.PARAMETER
            if part == "sensors" and "package" not in options.approach:
                reach = ChangeClass.UNMODELLED
            return difference.change(_path([f"{part[:-1]} {name}", *fields]), reach, _unit(fields))
        case ("extensions", str(owner), *fields):
            return difference.change(_path([owner or "robot", *(fields or ["extensions"])]), ChangeClass.UNMODELLED)
    return difference.change(_path(["robot", *difference.path]), ChangeClass.PARAMETER)


def _changes_law(difference: Difference, joint: Joint, options: Options) -> bool:
    """Return whether a drive gets or loses its law, or integrates its command no more: Run has another drive then.

    Another number of a law stands in the record, as do laws of joints that Run does not drive.
    """
    is_other = len(difference.path) == 3 or (joint.command == "velocity" and difference.path[3] == "position_gain")
    is_driven = "package" in options.approach and (options.driven is None or joint.name in options.driven)
    return is_other and is_driven and difference.kind is not ChangeKind.CHANGED


def _path(words: _Fields) -> tuple[str, ...]:
    """Return a path to show, with each index behind its list."""
    path: list[str] = []
    for word in words:
        if isinstance(word, int):
            path[-1] += f"[{word}]"
        else:
            path.append(word)
    return tuple(path)


@functools.cache
def _unit_of(field: str) -> UnitName | None:
    """Return the unit of a field. Fields of one name have the same unit in all structs."""
    structs = (one for one in vars(robot).values() if isinstance(one, type) and issubclass(one, msgspec.Struct))
    # the types of all structs would take 4 of 220 ms of a build
    asked = (
        one for struct in structs if field in struct.__struct_encode_fields__ for one in msgspec.structs.fields(struct)
    )
    return next(
        (unit for one in asked if one.encode_name == field for unit in getattr(one.type, "__metadata__", ())), None
    )


def _unit(fields: _Fields, motion: str | None = None) -> str:
    """Return the unit of a number; `motion` is the joint's kind of motion."""
    unit = next((_unit_of(field) for field in reversed(fields) if isinstance(field, str)), None)
    if unit is None or (unit.sliding is not None and motion is None):
        return ""
    return unit.sliding if unit.sliding is not None and motion == "translational" else unit.name


def _joint_unit(name: str, joints: Mapping[str, Joint], fields: _Fields) -> str:
    """Return the unit of a number of a joint.

    `joints` has all joints of its version, since a multiplier needs the leader. Losses of a planar joint have no unit:
    one number stands for sliding and turning.
    """
    motion, mimic = MOTION_KINDS.get(joints[name].type), joints[name].mimic
    if mimic is None or fields[-1] != "multiplier":
        return _unit(fields, motion)
    leader = MOTION_KINDS.get(joints[mimic.joint].type)
    if motion is None or leader is None or motion == leader:
        return ""
    return "m/rad" if motion == "translational" else "rad/m"


def _reach(
    before: Link | Joint,
    after: Link | Joint,
    difference: Difference,
    old: _RobotVersion,
    new: _RobotVersion,
    options: Options,
) -> ChangeClass:
    """Return the class of a change inside of a link or joint, by exchanging only the changed value."""
    fields = list(difference.path[2:])
    if fields[0] == "contact":  # the whole contact, since its keys differ from the fields of `Contact`
        fields = ["contact"]
    reaches = []
    for element, other, version, others in ((before, after, old, new), (after, before, new, old)):
        imports = None
        if isinstance(element, Link) and version.imports is not None and others.imports is not None:
            imports = {**others.imports, **version.imports}  # the element's own facts, such as its meshes' colours
        model, record = _data(element, imports, options)
        other_model, other_record = _data(_exchanged(element, other, fields), imports, options)
        same = ChangeClass.UNMODELLED if record == other_record else ChangeClass.PARAMETER
        reaches.append(same if model == other_model else ChangeClass.STRUCTURAL)
    return max(reaches, key=lambda reach: reach.rank)


def _exchanged(value: Any, other: Any, fields: _Fields) -> Any:
    """Return `value` with one part from `other`: the smallest part at the path `fields` that both values have."""
    if not fields or type(value) is not type(other):
        return other
    field, *inside = fields
    if field in _SHAPES and inside:
        number, *parts = inside
        shapes, others = getattr(value, field), by_number(getattr(other, field))
        if number in others and number in shape_numbers(shapes):
            other_shape = msgspec.structs.replace(others[number], number=number)
            numbered = zip(shape_numbers(shapes), shapes, strict=True)
            new = tuple(_exchanged(shape, other_shape, parts) if n == number else shape for n, shape in numbered)
            return msgspec.structs.replace(value, **{field: new})
        inside = []
    if isinstance(field, str):
        part = _exchanged(getattr(value, field), getattr(other, field), inside)
        return msgspec.structs.replace(value, **{field: part})
    if field >= min(len(value), len(other)):
        return other
    return (*value[:field], _exchanged(value[field], other[field], inside), *value[field + 1 :])


def _data(element: Link | Joint, imports: Mapping[str, Import] | None, options: Options) -> tuple[Any, Any]:
    """Return the data of an element's model and of its record. Without `imports`, all meshes count as found."""
    if isinstance(element, Joint):
        joint = effective(element)
        return (structure(joint), joint_model(joint, options, can_be_driven(joint))), joint
    if imports is None:
        facts = {lookup.BOUNDS: (), lookup.HULL: _POINT}
        keys = _mesh_keys(element) if options.meshes == "import" else ()
        imports = {key: Import(key, "", "", facts) for key in keys}
    visuals, collisions = link_shapes(element, imports, "", options)
    height = list(touching(element, imports)) if options.base == "floating" else []
    model = link_model(visuals, collisions, element.contact)
    return model, (visuals, collisions, height, element.inertial, element.contact)


def _mesh_keys(link: Link) -> set[str]:
    """Return the keys of a link's meshes among the imports."""
    shapes: Sequence[Visual | Collision] = (*link.visuals, *link.collisions)
    return {lookup.key(shape.geometry) for shape in shapes if isinstance(shape.geometry, Mesh)}


def _of_import(
    difference: Difference, key: str, old: _RobotVersion, new: _RobotVersion, options: Options
) -> Change | None:
    """Return the change of a mesh's content; None if no link has the mesh in both versions.

    A change of a mesh's further files counts as a change of its first file.
    """
    imports = {name: file for name, file in (old.imports or {}).items() if not belongs_to(name, key)}
    imports |= {name: file for name, file in (new.imports or {}).items() if belongs_to(name, key)}
    models = []
    for name in old.links.keys() & new.links.keys():
        link, new_link = old.links[name], new.links[name]
        if key in _mesh_keys(link) & _mesh_keys(new_link):
            models.append((_data(link, old.imports, options)[0], _data(link, imports, options)[0]))
    if not models:
        return None
    is_structural = any(model != new_model for model, new_model in models)
    words = f"mesh {key.removesuffix(_UNSCALED)}", "content"
    return difference.change(words, ChangeClass.STRUCTURAL if is_structural else ChangeClass.PARAMETER)
