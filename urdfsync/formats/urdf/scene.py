"""A robot as a picture: shapes, frames, masses and axes."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.domain import Import, Target
from urdfsync.domain import scene as scenes
from urdfsync.domain.scene import Body, End, Hinge, PagePose, Scene, Shape
from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.kinematics import poses
from urdfsync.formats.urdf.kinematics.loops import ClosedLoops, Closure
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.meshes import lookup
from urdfsync.formats.urdf.meshes.convert import stated_triangles as stated_triangles
from urdfsync.formats.urdf.meshes.convert import triangles as triangles
from urdfsync.formats.urdf.model.shapes import GREY, DrawnShape, link_shapes, standing_height
from urdfsync.formats.urdf.named_poses import named_poses as named_poses
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import (
    JOINT_KINDS,
    MOTION_KINDS,
    Collision,
    Joint,
    Link,
    Loop,
    Material,
    Mesh,
    Robot,
    UnitName,
    Visual,
)

_NO_FACTS = {"bounds": (), "hull": ()}
"""Stands for the missing facts of a mesh that is too large for the package. The picture needs no facts."""


def scene(
    robot: Robot, imports: Mapping[str, Import], target: Target, options: Options
) -> tuple[Scene, Mapping[str, str]]:
    """Return the picture of a robot, and the names of its mesh files. A shape whose mesh is not imported is missing."""
    imports = {
        key: file if file.facts else msgspec.structs.replace(file, facts=_NO_FACTS) for key, file in imports.items()
    }
    shown = msgspec.structs.replace(options, collisions=True)
    closed = Assembly(robot, options, target).closed
    tree = closed.tree
    starts = poses.start_positions(tree)
    names = {key: _mesh_name(key, file, imports) for key, file in imports.items()}
    meshes = {f"modelica://{target.package}/{file.target}": names[key] for key, file in imports.items()}
    bodies = tuple(_body(tree, link, link_shapes(link, imports, target.package, shown), meshes) for link in tree.links)
    hinges = tuple(_hinge(closed, joint, starts[joint.name]) for joint in tree.leaders_first())
    loops = tuple(_loop(tree, loop, closed.closures[loop.name]) for loop in tree.loops)
    height = standing_height(tree, imports) if options.base == "floating" else None
    return Scene(bodies, hinges, tuple(_missing(tree, imports)), loops, height), names


def with_numbers(
    robot: Robot, numbers: Mapping[tuple[str, str], Sequence[float]]
) -> tuple[Robot, Collection[tuple[str, str]]]:
    """Return a robot with other numbers, by element and path in its record, and the places that it lacks."""
    kinds: dict[str, Sequence[Any]] = {"link": robot.links, "joint": robot.joints, "loop": robot.loops}
    parts: dict[str, Any] = {f"{kind} {part.name}": part for kind, own in kinds.items() for part in own}
    lacking = set[tuple[str, str]]()
    for (element, path), values in numbers.items():
        changed = _changed(parts.get(element), path.split("."), values)
        if changed is None:
            lacking.add((element, path))
        else:
            parts[element] = changed
    changes = {f"{kind}s": tuple(parts[f"{kind} {part.name}"] for part in own) for kind, own in kinds.items()}
    return msgspec.structs.replace(robot, **changes), lacking


def _changed(part: Any, path: Sequence[str], values: Sequence[float]) -> Any:
    """Return a part of a robot with other values at a path of its record; None if it has no such place."""
    (name, *rest), new = path, None
    if isinstance(part, Visual) and name in ("color", "opacity"):
        *color, opacity = (part.material and part.material.rgba) or (*(tone / 255 for tone in GREY), 1.0)
        rgba = (*(tone / 255 for tone in values), opacity) if name == "color" else (*color, *values)
        return msgspec.structs.replace(part, material=Material(rgba=rgba)) if len(rgba) == 4 else None
    if isinstance(part, Visual | Collision) and name != "origin":
        return (new := _changed(part.geometry, path, values)) and msgspec.structs.replace(part, geometry=new)
    shape = re.fullmatch(r"(visual|collision)(\d+)", name)
    field = f"{shape[1]}s" if shape else "limit" if name == "limits" else re.sub("(?=[A-Z])", "_", name).lower()
    old: Any = getattr(part, field, None)
    if shape and rest and old and 0 < (number := int(shape[2])) <= len(old):
        changed = _changed(old[number - 1], rest, values)
        new = (*old[: number - 1], changed, *old[number:]) if changed is not None else None
    elif rest:
        new = _changed(old, rest, values)
    elif isinstance(old, tuple) and len(old) == len(values):
        length = math.hypot(*values) if field == "axis" else 1.0
        new = tuple(value / length for value in values) if length else None
    elif isinstance(old, float) and len(values) == 1:
        (new,) = values
    return None if new is None else msgspec.structs.replace(part, **{field: new})


def _mesh_name(key: str, file: Import, imports: Mapping[str, Import]) -> str:
    """Return a name for a mesh file, from the hash of its source and the part of the source that it has."""
    whole = lookup.key(lookup.mesh(key))
    is_split = whole in imports and lookup.PARTS in imports[whole].facts
    return f"{file.source_hash}{key.removeprefix(whole)}{' part' if is_split else ''}"


def _loop(tree: KinematicTree, loop: Loop, closure: Closure) -> scenes.LoopConstraint:
    ends = (loop.parent, loop.origin), (loop.child, loop.child_origin)
    parent, child = (End(f"link {link}", _matrix(poses.pose(origin))) for link, origin in ends)
    return scenes.LoopConstraint(
        element=f"loop {loop.name}",
        component=tree.loop(loop.name).component,
        facts=tuple(_facts(loop)),
        ends=(parent, child),
        translations=closure.translations,
        rotations=closure.rotations,
    )


def _body(tree: KinematicTree, link: Link, drawn: Iterable[Sequence[DrawnShape]], meshes: Mapping[str, str]) -> Body:
    shapes = [_shape(shape, meshes) for of_kind in drawn for shape in of_kind]
    body = Body(f"link {link.name}", tree.link(link.name).component, tuple(_facts(link)), tuple(shapes))
    inertial = link.inertial
    if inertial is None or not inertial.mass > 0:
        return body
    center, inertia = _matrix(poses.pose(inertial.origin)), msgspec.structs.astuple(inertial.inertia)
    return msgspec.structs.replace(body, mass=inertial.mass, center=center, inertia=inertia)


def _shape(drawn: DrawnShape, meshes: Mapping[str, str]) -> Shape:
    geometry, pose, size = drawn.geometry, _matrix(poses.pose(drawn.origin)), ()
    if isinstance(geometry, Mesh):
        scale = (*geometry.scale, 1.0)
        pose = tuple(number * scale[place // 4] for place, number in enumerate(pose))
    else:
        numbers = msgspec.structs.astuple(geometry)
        size = numbers[0] if isinstance(numbers[0], tuple) else numbers
    return Shape(
        "collision" if drawn.model.is_collision else "visual",
        drawn.model.type.lower(),
        size,
        pose,
        (*(part / 255 for part in drawn.color), drawn.opacity),
        meshes.get(drawn.uri, ""),
    )


def _missing(tree: KinematicTree, imports: Mapping[str, Import]) -> Iterator[str]:
    for link in tree.links:
        geometries = {"visual": [shape.geometry for shape in link.visuals]}
        geometries["collision"] = [shape.geometry for shape in link.collisions]
        for kind, of_kind in geometries.items():
            for number, geometry in enumerate(of_kind, 1):
                if isinstance(geometry, Mesh) and lookup.key(geometry) not in imports:
                    yield f"link {link.name}, {kind} {number}: mesh `{geometry.filename}` is not in the package"


def _hinge(closed: ClosedLoops, joint: Joint, start: float) -> Hinge:
    limits, moves = poses.own_range(joint), MOTION_KINDS.get(joint.type)
    lower, upper = (limit if math.isfinite(limit) else None for limit in limits)
    way = 0.0
    if moves and joint.name in closed.driven:
        way = poses.sweep_way(joint, start, closed.reach.get(joint.name, poses.SWEEP[moves]), limits)
    return Hinge(
        element=f"joint {joint.name}",
        component=closed.tree.joint(joint.name).component,
        facts=tuple(_facts(joint, joint)),
        parent=f"link {joint.parent}",
        child=f"link {joint.child}",
        pose=_matrix(poses.pose(joint.origin)),
        axis=joint.axis,
        motion=moves or ("" if joint.type == "fixed" else joint.type),
        start=start,
        way=way,
        lower=lower if moves else None,
        upper=upper if moves else None,
        leader=f"joint {joint.mimic.joint}" if joint.mimic else "",
        multiplier=joint.mimic.multiplier if joint.mimic else 1.0,
        offset=joint.mimic.offset if joint.mimic else 0.0,
        is_dependent=joint.name in closed.dependent,
    )


def _matrix(pose: poses.Pose) -> PagePose:
    """Return a pose as a homogeneous matrix, column after column."""
    rotation, translation = pose
    columns = [(*(row[column] for row in rotation), 0.0) for column in range(3)]
    return (*columns[0], *columns[1], *columns[2], *translation, 1.0)


def _facts(values: msgspec.Struct, joint: Joint | None = None, label: str = "") -> Iterator[tuple[str, str]]:
    """Yield the properties of a link or joint with their units; of shapes, only the count."""
    for field in msgspec.structs.fields(values):
        value, name = getattr(values, field.name), f"{label}{field.name.replace('_', ' ')}"
        if isinstance(value, msgspec.Struct):
            yield from _facts(value, joint, f"{name} ")
            continue
        is_end = name in ("limit lower", "limit upper")
        if value is None or value is False or value == () or name == "name":
            continue
        if is_end and joint and not JOINT_KINDS[joint.type].has_limits:
            continue
        units = [each for each in getattr(field.type, "__metadata__", ()) if isinstance(each, UnitName)]
        slides = joint is not None and MOTION_KINDS.get(joint.type) == "translational"
        unit = "".join(each.sliding if slides and each.sliding else each.name for each in units)
        if isinstance(value, tuple):
            is_vector = isinstance(value[0], float)
            text = f"({', '.join(f'{number:.6g}' for number in value)})" if is_vector else str(len(value))
        else:
            text = f"{value:.6g}" if isinstance(value, float) else str(value)
        degrees = f" ({math.degrees(value):.4g}°)" if is_end and unit == "rad" else ""
        yield name, f"{text} {unit}".rstrip() + degrees
