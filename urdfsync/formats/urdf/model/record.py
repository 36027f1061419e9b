"""Template data of the record of a whole robot, `<Robot>Parameters.mo`, and the integer tables of its structure.

Links that fixed joints connect move as one *body*. Body 1 has the root link. A *moving joint* is revolute, continuous
or prismatic; moving joint `i` moves body `i + 1`. Moving joints are counted in canonical order, so the body that
carries a joint has a smaller number than the moved body. The tables assign links to bodies. Modelica adds up the masses
of a body's links, so no number is written twice. All counts start at 1.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import msgspec

from urdfsync.domain import Import
from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.connectors import free_name, taken_names
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.model.numbers import (
    RecordPart,
    camel,
    joint_numbers,
    joint_record,
    link_numbers,
    shape_numbers,
)
from urdfsync.formats.urdf.model.shapes import link_shapes, standing_height
from urdfsync.formats.urdf.options import USES
from urdfsync.formats.urdf.robot import (
    MOTION_KINDS,
    MOTIONS,
    Dynamics,
    Joint,
    Motion,
    limits_acceleration,
    reflected_inertia,
)
from urdfsync.modelica.literals import INFINITY, Expression, matrix, vector

_TURNS: Mapping[Motion, int] = {"rotational": 1, "translational": 2}
_LINE = 10
"""The greatest number of integers in one line of a table."""


def record_data(assembly: Assembly, imports: Mapping[str, Import]) -> dict[str, Any]:
    """Return the data of the record of a whole robot.

    A record outside of a package states the used libraries.
    """
    tree, options, package = assembly.tree, assembly.options, assembly.target.package
    is_generic, taken = not obstacles(tree.joints), taken_names(tree)
    parts, drawn = list[list[RecordPart]](), list[_Drawn]()
    for number, link in enumerate(tree.links, 1):
        identifier, (visuals, _) = tree.link(link.name), link_shapes(link, imports, package, options)
        numbers, title = link_numbers(link.name, link.inertial), f'Link {number}: "{link.name}"'
        parts.append([RecordPart("Link", identifier.component, title, numbers)])
        for visual in visuals:
            component = free_name(identifier, visual.model.component.capitalize(), taken)
            whole_title = f'{visual.title} of link "{link.name}"'
            parts[-1].append(RecordPart(visual.model.type, component, whole_title, shape_numbers(visual)))
            drawn += _drawn(number, component, visual.model.type)
    for number, joint in enumerate(tree.joints, 1):
        component, title = tree.joint(joint.name).component, f'Joint {number}: "{joint.name}"'
        parts.append([RecordPart(joint_record(joint), component, title, joint_numbers(joint))])
    axes = [  # drivable joints, turning joints first; the record has a constant with the number of each flange
        {"constant": drive.axis, "name": joint.name, "vector": f"{motion}Axis", "number": number}
        for motion in MOTIONS
        for number, joint in enumerate(tree.axes(motion), 1)
        if (drive := assembly.connectors.drives[joint.name])
    ]
    return {
        "is_generic": is_generic,
        "uses": () if package else USES,
        "name": assembly.robot.name,
        "standing_height": standing_height(tree, imports) if options.base == "floating" else None,
        "structure": {"tables": _structure(tree, drawn), "axes": axes if is_generic else []},
        "parts": parts,
    }


class _Drawn(NamedTuple):
    """A shape that the generic robot draws; its numbers are expressions in those of the record."""

    link: int
    visual: str
    """The component with the numbers."""
    kind: str
    length_axis: int
    """In the shape frame: 1 is x, 3 is z."""
    start: str
    size: str


def _drawn(link: int, visual: str, kind: str) -> Iterator[_Drawn]:
    """Yield the drawn shapes of a visual. Modelica has no capsule shape: it is drawn as a cylinder and two spheres."""
    radius, length, size, radii = (f"{visual}.{name}" for name in ("radius", "length", "size", "radii"))
    round_size, long_size = f"{{2*{radius}, 2*{radius}, 2*{radius}}}", f"{{{length}, 2*{radius}, 2*{radius}}}"
    match kind:
        case "Box":
            yield _Drawn(link, visual, '"box"', 1, f"-0.5*{size}[1]", f"{{{size}[1], {size}[2], {size}[3]}}")
        case "Sphere":
            yield _Drawn(link, visual, '"sphere"', 3, f"-{radius}", round_size)
        case "Ellipsoid":  # the sphere of the Modelica Standard Library may have three diameters
            diameters = f"{{2*{radii}[1], 2*{radii}[2], 2*{radii}[3]}}"
            yield _Drawn(link, visual, '"sphere"', 1, f"-{radii}[1]", diameters)
        case "Cylinder" | "Capsule":
            yield _Drawn(link, visual, '"cylinder"', 3, f"-0.5*{length}", long_size)
        case _:
            yield _Drawn(link, visual, f"{visual}.uri", 1, "0", "{1, 1, 1}")
    if kind == "Capsule":
        yield _Drawn(link, visual, '"sphere"', 3, f"-0.5*{length} - {radius}", round_size)
        yield _Drawn(link, visual, '"sphere"', 3, f"0.5*{length} - {radius}", round_size)


def _structure(tree: KinematicTree, drawn: Sequence[_Drawn]) -> dict[str, Any]:
    """Return how links and joints hang together, as modifiers; a robot with `obstacles` has only two matrices."""
    numbers = {link.name: number for number, link in enumerate(tree.links, 1)}
    connections = [(numbers[joint.parent], numbers[joint.child]) for joint in tree.joints]
    moveable = [(number, 1) for number, joint in enumerate(tree.joints, 1) if joint.type != "fixed"]
    found: dict[str, Any] = {
        "connectionMatrix": Expression(matrix(connections, 2)),
        "moveableJoints": Expression(matrix(moveable, 2)),
    }
    return found if obstacles(tree.joints) else found | _generic_tables(tree, drawn)


def _generic_tables(tree: KinematicTree, drawn: Sequence[_Drawn]) -> dict[str, Any]:
    """Return the tables of the generic robot; those that repeat numbers of links and joints name these."""
    whole, links = tables(tree), [tree.link(link.name).component for link in tree.links]
    joints = [_RecordJoint(tree.joint(joint.name).component, joint) for joint in tree.joints]
    moving = [named for named in joints if named.joint.type in MOTION_KINDS]
    turning, sliding = ([each for each in moving if MOTION_KINDS[each.joint.type] == motion] for motion in MOTIONS)
    followers = [
        _RecordJoint(tree.joint(one.name).component, one) for one in tree.leaders_first() if one.mimic is not None
    ]
    has_accelerations = any(limits_acceleration(joint) for joint in tree.joints)
    found: dict[str, Any] = {
        "movingJoints": len(moving),
        "turningJoints": len(turning),
        "slidingJoints": len(sliding),
        "rotationalAxes": len(whole.axes["rotational"]),
        "translationalAxes": len(whole.axes["translational"]),
        "jointTree": _rows(map(vector, whole.joint_tree)),
        "firstJoints": _rows(map(str, whole.first_joints)),
        "nextJoints": _rows(map(str, whole.next_joints)),
        "linkBodies": _rows(map(str, whole.link_bodies)),
        "turning": _rows(map(str, whole.moving["rotational"])),
        "sliding": _rows(map(str, whole.moving["translational"])),
        "rotationalJoints": _rows(map(str, whole.axes["rotational"])),
        "translationalJoints": _rows(map(str, whole.axes["translational"])),
        "followers": _rows(map(vector, whole.followers)),
        "jointAxes": _column(moving, "axis"),
        "jointPositions": _column(joints, "origin.xyz"),
        "jointAngles": _column(joints, "origin.rpy"),
        "followerMultipliers": _column(followers, "mimic.multiplier"),
        "followerAngles": _array("0" if f.joint.type == "prismatic" else f"{f.name}.mimic.offset" for f in followers),
        "followerLengths": _array(f"{f.name}.mimic.offset" if f.joint.type == "prismatic" else "0" for f in followers),
        "linkMasses": _array(f"{link}.inertial.mass" for link in links),
        "linkCenters": _array(f"{link}.inertial.origin.xyz" for link in links),
        "inertialAngles": _array(f"{link}.inertial.origin.rpy" for link in links),
        "linkInertias": _array(map(_inertia, links)),
        "jointNames": {"name": _column(moving, "name", 8)} if moving else {},
        "turningLimits": _limits(turning, has_accelerations),
        "turningLosses": _losses(turning),
        "slidingLimits": _limits(sliding, has_accelerations),
        "slidingLosses": _losses(sliding),
        "turningInertias": _inertias(turning),
        "slidingMasses": _inertias(sliding),
        "drawnShapes": len(drawn),
        "visuals": _visuals(drawn),
    }
    return {name: value for name, value in found.items() if value}


class _RecordJoint(NamedTuple):
    """A joint, and the component with its numbers."""

    name: str
    joint: Joint


def _limits(joints: Sequence[_RecordJoint], has_accelerations: bool) -> dict[str, Any]:
    if not joints:
        return {}
    ends = {"lower": f"-{INFINITY}", "upper": INFINITY}
    found = {
        end: _array((far if one.joint.type == "continuous" else f"{one.name}.limits.{end}" for one in joints), 8)
        for end, far in ends.items()
    }
    others = ("velocity", "effort", *(("acceleration", "deceleration") if has_accelerations else ()))
    return found | {name: _column(joints, f"limits.{name}", 8) for name in others}


def _losses(joints: Sequence[_RecordJoint]) -> dict[str, Any]:
    """Return the columns of the losses of joints: those of the laws, and those that a source gives."""
    columns = (name for name in Dynamics.__struct_fields__ if name != "armature")  # `_inertias` has the armatures
    given = [name for name in columns if any(getattr(one.joint.dynamics, name, None) is not None for one in joints)]
    names = dict.fromkeys(("damping", "friction", "steepness", *map(camel, given))) if joints else ()
    return {name: _column(joints, f"dynamics.{name}", 8) for name in names}


def _inertias(joints: Sequence[_RecordJoint]) -> Expression | None:
    """Return what the drives add to the inertias of joints; None if none adds anything."""
    if all(reflected_inertia(one.joint) is None for one in joints):
        return None
    return _array(
        f"{one.name}.dynamics.armature + {one.name}.transmission.rotorInertia*{one.name}.transmission.reduction^2"
        for one in joints
    )


def _inertia(link: str) -> str:
    """Return the six numbers of a link's tensor in the order of the tables, in two lines."""
    first, second = (
        ", ".join(f"{link}.inertial.inertia.{axes}" for axes in row)
        for row in (("ixx", "iyy", "izz"), ("ixy", "ixz", "iyz"))
    )
    return f"{{{first},\n       {second}}}"


def _visuals(drawn: Sequence[_Drawn]) -> dict[str, Any]:
    if not drawn:
        return {}
    return {
        "links": _rows((str(shape.link) for shape in drawn), 8),
        "kinds": _array((shape.kind for shape in drawn), 8),
        "lengthAxes": _rows((str(shape.length_axis) for shape in drawn), 8),
        "positions": _array((f"{shape.visual}.origin.xyz" for shape in drawn), 8),
        "angles": _array((f"{shape.visual}.origin.rpy" for shape in drawn), 8),
        "starts": _array((shape.start for shape in drawn), 8),
        "sizes": _array((shape.size for shape in drawn), 8),
        "colors": _array((f"{shape.visual}.color" for shape in drawn), 8),
    }


def _column(joints: Iterable[_RecordJoint], path: str, indent: int = 6) -> Expression | None:
    """Return one number of each joint, as an array of expressions."""
    return _array((f"{one.name}.{path}" for one in joints), indent)


def _array(items: Iterable[str], indent: int = 6) -> Expression | None:
    """Return an array with one item to a line; None for no item."""
    lines = [f"\n{' ' * indent}{item}" for item in items]
    return Expression(f"{{{','.join(lines)}}}") if lines else None


def _rows(items: Iterable[str], indent: int = 6) -> Expression | None:
    """Return an array with ten items to a line, if there are more; None for no item."""
    items = list(items)
    if len(items) > _LINE:
        return _array((", ".join(items[k : k + _LINE]) for k in range(0, len(items), _LINE)), indent)
    return Expression(f"{{{', '.join(items)}}}") if items else None


class Tables(msgspec.Struct, frozen=True):
    """The integer tables, as `UrdfSync.Records.Robot` describes them."""

    link_bodies: list[int]
    """The body of each link."""
    joint_tree: list[tuple[int, int]]
    """For each moving joint: the body that carries the joint; 1 for a turning joint, 2 for a sliding joint."""
    first_joints: list[int]
    """For each body: the first joint on the body; without a joint, the number of joints + 1."""
    next_joints: list[int]
    """For each moving joint: the next joint on the same body; without a next joint, the number of joints + 1."""
    moving: Mapping[Motion, list[int]]
    """The moving joints of each kind."""
    axes: Mapping[Motion, list[int]]
    """For each kind, the moving joint of each driven axis."""
    followers: list[tuple[int, int]]
    """The numbers of each follower and its leader, leaders first; 0 stands for a fixed leader."""


def obstacles(joints: Iterable[Joint]) -> list[Joint]:
    """Return the planar, floating and ball joints: a record with such joints has no tables."""
    return [joint for joint in joints if joint.type not in MOTION_KINDS and joint.type != "fixed"]


def tables(tree: KinematicTree) -> Tables:
    """Return the integer tables of a robot without `obstacles`."""
    moving = [joint for joint in tree.joints if joint.type in MOTION_KINDS]
    numbers = {joint.name: number for number, joint in enumerate(moving, 1)}
    bodies = {tree.links[0].name: 1}
    for joint in tree.joints:
        bodies[joint.child] = numbers[joint.name] + 1 if joint.name in numbers else bodies[joint.parent]
    none = len(moving) + 1
    first, following = [none] * none, [none] * len(moving)
    for joint in reversed(moving):
        number, body = numbers[joint.name], bodies[joint.parent]
        following[number - 1], first[body - 1] = first[body - 1], number
    return Tables(
        link_bodies=[bodies[link.name] for link in tree.links],
        joint_tree=[(bodies[joint.parent], _TURNS[MOTION_KINDS[joint.type]]) for joint in moving],
        first_joints=first,
        next_joints=following,
        moving={kind: [numbers[j.name] for j in moving if MOTION_KINDS[j.type] == kind] for kind in _TURNS},
        axes={kind: [numbers[joint.name] for joint in tree.axes(kind)] for kind in _TURNS},
        followers=[
            (numbers[joint.name], numbers.get(joint.mimic.joint, 0))
            for joint in tree.leaders_first()
            if joint.mimic is not None
        ],
    )
