"""The diagnostics about a URDF by their codes, and the checks of a robot.

A finding is an error if urdfsync can't make a right model, otherwise a warning. The page docs/findings.md explains the
codes.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple, TypeVar

import msgspec

from urdfsync.common import spelling
from urdfsync.common.diagnostics import Detail, Diagnostic, Severity
from urdfsync.engine.sources import file_kinds
from urdfsync.formats.urdf.robot import (
    JOINT_KINDS,
    SHAPES,
    Box,
    Capsule,
    Cylinder,
    Dynamics,
    Ellipsoid,
    Geometry,
    Joint,
    Limit,
    Link,
    Loop,
    Mesh,
    Robot,
    Sphere,
    Vector,
    effective,
    unit_of,
)

_EXACT = 1e-12
# The greatest error of an axis's length, if the axis is written with five digits or more.
_ROUNDING = 1e-5
_COMPARED = 500
# In rad: a greater range of a continuous joint stands for no limits.
_ENDLESS = 1000
_MAGNITUDES = {
    **{
        block: [name for name in struct.__struct_fields__ if not unit_of(struct, name).is_signed]
        for block, struct in (("limit", Limit), ("dynamics", Dynamics))
    },
    "transmission": ["rotor_inertia"],
}
"""Numbers that must not be negative, by field of the joint."""
_INERTIAS = ("armature", "rotor_inertia")

_Element = TypeVar("_Element", Link, Joint)


_WAIT = "wait until the export is complete"

_ERRORS = {
    # the file
    "file-empty": f"export the robot again, or {_WAIT}",
    "file-encoding": "save the file as UTF-8, or name its encoding in the XML declaration",
    **file_kinds.HINTS,
    "xml-syntax": f"correct the XML (`&` is written `&amp;`, and `<` in quotes `&lt;`), or {_WAIT}",
    "xml-entity": "remove the <!DOCTYPE …>, and replace entities by their text",
    "not-urdf": "export URDF, and name that file",
    "xacro-source": "rename the file to FILE.xacro, or set `arguments`: then urdfsync expands the file",
    # elements and attributes
    "missing-element": "add it",
    "missing-attribute": "add it",
    "empty-attribute": "fill it in",
    "bad-number": "write decimal numbers such as -0.5 or 1e-3",
    "bad-version": 'write version="1.2", or no version for 1.0',
    "two-orientations": "remove one orientation",
    "unknown-joint-type": "use one of fixed, continuous, revolute, prismatic, planar, floating, ball",
    # loops
    "duplicate-loop": "rename or remove one loop",
    "loop-of-no-link": "correct the name of the link",
    "loop-one-link": "name two links",
    "loop-axis": "give each axis a direction; the axes of a universal joint are at right angles",
    "loop-twice": "remove one of the two loops",
    "loop-free-joint": "use joints with one axis in a loop",
    "loop-rigid": "remove the loop, or give it joints that move",
    "loop-open": "correct the frames of the loop, or the start and limits of its joints",
    "loop-redundant": "remove one of the loops",
    "loop-limit": "remove loops, and close them by hand: a robot may have up to 200 loops with 1,000 joints",
    "loop-singular": "let the loop's joints start elsewhere, by `start` in the configuration",
    # the tree
    "duplicate-link": "rename or remove one link",
    "duplicate-joint": "rename or remove one joint",
    "no-link": "check that the export is complete, or name the xacro file that uses the macros of this file",
    "several-roots": "connect these links by joints, or remove links of other robots",
    "unknown-parent": "add the link, or correct its name",
    "unknown-child": "add the link, or correct its name",
    "two-parents": "remove one of the joints: a link has one parent",
    "cycle": "remove a joint of the cycle: a URDF is a tree",
    "loop-joint": 'write a ball, revolute, universal or fixed joint, or leave the loop out by `allow = ["loop-joint"]`',
    "part-left-out": 'leave the part out by `allow = ["part-left-out"]`, or remove it from the source',
    "stray-inertial": 'move the element into a link, or leave the element out by `allow = ["stray-inertial"]`',
    # numbers and relations
    "bad-servo": "write a decimal number",
    "negative-mass": "correct the mass; a massless link has no mass, or 0",
    "negative-inertia": "correct its sign",
    "zero-axis": 'write for example xyz="0 0 1"',
    "limit-order": "exchange or correct the limits",
    "unknown-mimic": "add the joint, or correct its name",
    "mimic-cycle": "let one joint of the cycle move by itself",
    "mimic-type": "remove the mimic, or make both joints revolute, continuous or prismatic",
}
_WARNINGS = {
    # the file
    "xml-declaration": 'begin the file with <?xml version="1.0" encoding="UTF-8"?>',
    "xacro-leftover": "expand this file with xacro, unless xacro wrote it",
    # elements and attributes
    "missing-name": 'write <robot name="…">',
    "duplicate-element": "remove the others",
    "sdf-spelling": "use the spelling of URDF: other programs ignore this text",
    "missing-value": "add a value, or remove the element: ROS's parser refuses the empty element",
    "newer-version": "remove all elements that are newer than URDF 1.2: urdfsync ignores them",
    "newer-attribute": "name the version of URDF that has the attribute",
    "unknown-attribute": "correct the name, or remove the attribute",
    "unknown-element": "correct the name, or remove the element",
    "missing-limit": "add <limit>, or make a revolute joint continuous",
    "missing-limit-value": "add the missing limits; if the joint turns freely, make it continuous",
    "missing-mass": "add the mass",
    "missing-inertia": "add all six components of the inertia",
    "missing-gain": "add k_velocity=…",
    "bad-contact": "write a decimal number",
    "bad-spring": "write a decimal number",
    "unknown-geometry": f"use one of {', '.join(SHAPES)}",
    "unknown-material": "define the material in the robot or in a visual",
    "material-redefined": "give each material a name of its own",
    "bad-color": 'write for example rgba="1 0.5 0 1"',
    "color-range": "divide 0 to 255 by 255",
    # numbers and relations
    "axis-not-unit": "write a unit vector",
    "negative-limit": "write the limit without a sign: only limits of position have signs",
    "negative-dynamics": "correct its sign",
    "dynamics-without-effect": "remove these numbers, or change the type of the joint",
    "limit-without-effect": "remove the <limit>; a contact or a spring in a model of your own can hold the joint",
    "mimic-without-effect": "remove the mimic, or change the type",
    "mimic-of-fixed": "make the joint fixed, or let it mimic a joint that moves",
    "unknown-actuated-joint": "correct the name of the joint, or remove the element",
    "unknown-sensor-place": "correct the name of the link or joint",
    "unknown-reference": "correct the name, or remove the element, which has no effect",
    "bad-sensor": "correct the value",
    "bad-transmission": "write another number; until then a reduction is taken as 1, an offset as 0",
    "drive-contradiction": "correct one of the two elements",
    "unknown-interface": "correct the name, or remove the interface",
    "bad-mimic": "write a decimal number; until then a multiplier is taken as 1, an offset as 0",
    "ball-not-driven": "drive the ball in a model of your own, or write three continuous joints in one point",
    "bad-start": "correct the position, or set another one by `start` in the configuration",
    "coupled-transmission": "model the coupling by hand, or write a transmission for each joint",
    "gravity-off": "replace the link in a model of your own, or accept that the joints carry its weight",
    "free-root": 'set `base = "floating"` in the configuration',
    "force-left-out": "add the force in a model of your own, or expect another motion",
    "inertia-not-positive": "export the inertia again; until then, a simulation may not be physical",
    "inertia-triangle": "export the inertia again; until then, a simulation may not be physical",
    "shape-size": "correct the size, or remove the shape",
    "loop-contradiction": "correct one of the two loops",
    "loop-one-end": "correct the name of the other link, or state the loop as `loops` in the configuration",
    "loop-excess": "take joints out of `driven`, or model their drives as efforts by hand",
    # valid, but probably a mistake
    "no-inertia": "give the links an <inertial>",
    "mass-unit": "write masses in kg",
    "mass-jump": "if the new one is wrong, check the unit and the material in the exporter",
    "unit-jump": "if the new one is wrong, check the unit in the exporter",
    "inertial-lost": "check the material and the mass in the exporter",
    "mesh-size": "export it in m",
    "density": "correct the mass or the shapes",
    "weak-effort": 'correct the effort or the masses; if a spring carries the weight, write `ignore = ["weak-effort"]`',
    "limits-exchanged": "exchange effort and velocity",
    "stuck": "correct damping, friction or effort",
    "unbalanced": "correct the centre of mass",
    "center-of-mass": "write it in m, in the frame of the link",
    "collision-beside": "correct one of the two origins",
    "inertia-shape": "export the inertia about the centre of mass, in the axes of <inertial>",
    "odd-one-out": "correct the number, or make all parts of the row different",
    "zero-effort": 'state the effort of the drive; if no drive moves the joint, write `ignore = ["zero-effort"]`',
    "mimic-limits": "correct the limits, or the multiplier and offset",
    "soft-limits": "write soft limits inside of the limits",
    "not-mirrored": 'correct one side; if the robot is not symmetric, write `ignore = ["not-mirrored"]`',
    "inertia-size": "export the inertia of the body in kg·m²",
    "length-unit": "write lengths in m",
    "angle-unit": "write angles in rad",
    "zero-limits": "state the limits of the drive, or make the joint fixed",
    "shape-far": "correct the origin; write it in m",
    # robots that no simulation can move
    "passive-moves-no-mass": "give a link behind the joint an <inertial>, drive the joint (`driven`), or make it fixed",
    "moves-no-mass": "give the child link of the joint an <inertial>, or make the joint fixed",
    "loops-not-in-record": "generate a package for the robot",
    "shared-rotor-not-in-record": "generate a package for the robot",
    "planar-not-generic": "write two prismatic joints and a continuous one, or use the package approach",
    "ball-not-generic": "write three continuous joints, or use the package approach",
    "floating-not-generic": "write three prismatic joints and three continuous ones, or use the package "
    'approach; if the root link has no other joint, remove both and set `base = "floating"` in a project',
}
_NOTES = {
    "loop-by-name": "if the joint is of another kind, state the loop in `loops` of the configuration",
    "loop-drives": "to drive other joints, list all driven joints in `driven`",
    "start-moved": "to choose the joints that stay, name no other joints in `start`",
    "loop-closed": "nothing to do: the models begin in a pose that closes the loop",
    "loop-ball": "nothing to do, unless the second of the three joints comes near a right angle",
    "loop-weaker": "nothing to do: the motion is the same",
    "not-in-record": 'to get these parts, add "package" to `approach`',
    "not-modelled": "--verbose lists all of these with their lines",
}

ADVICE: Mapping[str, tuple[Severity, str]] = {
    code: (severity, advice)
    for severity, table in ((Severity.ERROR, _ERRORS), (Severity.WARNING, _WARNINGS), (Severity.NOTE, _NOTES))
    for code, advice in table.items()
}


class Finding(NamedTuple):
    """A finding about an element.

    `path` names the element as a diff does: `link wheel`, `joint elbow / limit`. A second link `wheel` is `link wheel
    #2`.
    """

    code: str
    path: str
    message: str
    hint: str = ""
    """A hint that replaces the one in `ADVICE`."""


def diagnostic(
    code: str,
    message: str,
    line: int,
    hint: str = "",
    column: int = 0,
    details: tuple[Detail, ...] = (),
    element: str = "",
) -> Diagnostic:
    """Return a diagnostic with the severity and the advice of its code; the caller adds the file."""
    severity, advice = ADVICE[code]
    return Diagnostic(severity, code, message, "", line, column, hint or advice, details, element)


def check(robot: Robot, *, complete: bool = True) -> Iterator[Finding]:
    """Check a robot whose axes are not normalised yet.

    If faulty joints or links were left out, `complete` is false, and several roots are no fault.
    """
    links, joints = _with_paths("link", robot.links), _with_paths("joint", robot.joints)
    yield from _check_names("link", links)
    yield from _check_names("joint", joints)
    yield from _check_tree(robot, joints, complete)
    for path, link in links:
        yield from _check_link(path, link)
    for path, joint in joints:
        yield from _check_joint(path, joint)
    yield from _check_mimics(joints)


def _check_names(kind: str, elements: Iterable[tuple[str, Link | Joint]]) -> Iterator[Finding]:
    """Check that no two links, or no two joints, have one name."""
    seen = set[str]()
    for path, element in elements:
        if element.name in seen:
            yield Finding(f"duplicate-{kind}", path, f"{kind} {element.name!r} is defined above, too")
        seen.add(element.name)


def check_loops(loops: Sequence[Loop], links: Collection[str]) -> Iterator[Finding]:
    """Check names, links and axes of loops. A loop gets one finding at most."""
    seen: dict[Loop, str] = {}
    for path, loop in zip(element_paths("loop", (loop.name for loop in loops)), loops, strict=True):
        same = msgspec.structs.replace(loop, name="")
        unknown = [link for link in (loop.parent, loop.child) if link not in links]
        turns, tilts = loop.kind in ("revolute", "universal"), loop.kind == "universal"
        if path != f"loop {loop.name}":
            yield Finding("duplicate-loop", path, f"loop {loop.name!r} is defined above, too")
        elif unknown:
            message = f"loop {loop.name!r} has a frame on link {unknown[0]!r}, which does not exist"
            yield Finding("loop-of-no-link", path, message, perhaps(unknown[0], links))
        elif loop.parent == loop.child:
            yield Finding("loop-one-link", path, f"loop {loop.name!r} has both frames on link {loop.parent!r}")
        elif (turns and not any(loop.axis)) or (tilts and not any(loop.child_axis)):
            yield Finding("loop-axis", path, f"loop {loop.name!r}: an axis has no direction")
        elif same in seen:
            yield Finding("loop-twice", path, f"loop {loop.name!r} equals loop {seen[same]!r}")
        seen.setdefault(same, loop.name)


def perhaps(name: str, names: Collection[str], likeness: float = 0.7) -> str:
    """Return a hint with the most similar of `names`; empty if no name is similar.

    More than 500 names are not compared: the comparison would take longer than reading the file.
    """
    meant = spelling.nearest(name, names, likeness) if len(names) <= _COMPARED else ""
    return f"perhaps {meant!r} is meant" if meant else ""


def element_paths(kind: str, names: Iterable[str]) -> list[str]:
    """Return the path of each element: `joint elbow`, and `joint elbow #2` for a second joint `elbow`."""
    seen, paths = dict[str, int](), list[str]()
    for number, name in enumerate(names, start=1):
        count = seen[name] = seen.get(name, 0) + 1
        path = f"{kind} {name}" if name.strip() else f"{kind} number {number}"
        paths.append(path if count == 1 else f"{path} #{count}")
    return paths


def _with_paths(kind: str, elements: Sequence[_Element]) -> list[tuple[str, _Element]]:
    return list(zip(element_paths(kind, (element.name for element in elements)), elements, strict=True))


def unit_vector(axis: Vector) -> Vector:
    """Return the unit vector along `axis`: x for a zero vector, `axis` itself if its length is 1 (up to 1e-12)."""
    largest = max(map(abs, axis))
    if largest == 0:
        return (1.0, 0.0, 0.0)
    if abs(math.hypot(*axis) - 1) < _EXACT:
        return axis
    scaled = [value / largest for value in axis]  # without this, the square of a large number overflows
    length = math.hypot(*scaled)
    # Adding 0.0 makes 0.0 of -0.0: equal robots give equal texts.
    return (scaled[0] / length + 0.0, scaled[1] / length + 0.0, scaled[2] / length + 0.0)


def _check_tree(robot: Robot, joints: Iterable[tuple[str, Joint]], complete: bool) -> Iterator[Finding]:
    """Check that the joints connect all links to one tree."""
    links = {link.name for link in robot.links}
    if not links:
        if complete:
            yield Finding("no-link", "robot", "the robot has no link")
        return
    parents: dict[str, Joint] = {}
    for path, joint in joints:
        for end, name in (("parent", joint.parent), ("child", joint.child)):
            if name not in links:
                complete = False
                message = f"the {end} of joint {joint.name!r} is link {name!r}, which does not exist"
                yield Finding(f"unknown-{end}", f"{path} / {end}", message, perhaps(name, links))
        first = parents.setdefault(joint.child, joint)
        if first.name != joint.name:
            message = f"link {joint.child!r} is the child of joint {joint.name!r} and of joint {first.name!r}"
            hint = _as_loop(joint) if joint.parent != joint.child and first.parent != first.child else ""
            yield Finding("two-parents", path, message, hint)
    above = {child: joint.parent for child, joint in parents.items()}
    for cycle in _cycles((link.name for link in robot.links), above):
        message = f"links form a cycle: {' → '.join(map(repr, [*reversed(cycle), cycle[-1]]))}"
        yield Finding("cycle", f"joint {parents[cycle[0]].name}", message)
    roots = list(dict.fromkeys(link.name for link in robot.links if link.name not in parents))
    if len(roots) > 1 and complete:
        message = f"{len(roots)} links have no parent: {', '.join(map(repr, roots))}"
        yield Finding("several-roots", f"link {roots[1]}", message)


def _as_loop(joint: Joint) -> str:
    """Return a hint to write a joint as a loop; empty if no loop has the type of the joint."""
    if joint.type not in ("revolute", "continuous", "fixed"):
        return ""
    vectors = joint.origin.xyz, joint.origin.rpy, joint.axis
    xyz, rpy, axis = (" ".join(f"{number:.12g}" for number in vector) for vector in vectors)
    ends = f'<link1 link="{joint.parent}" xyz="{xyz}" rpy="{rpy}"/><link2 link="{joint.child}"/>'
    turns = f'<axis xyz="{axis}"/>' * (joint.type != "fixed")
    element = f'<loop_joint name="{joint.name}" type="{joint.type}">{ends}{turns}</loop_joint>'
    return f"if the joint closes a loop, write {element}, or use `loops` in the configuration; else remove the joint"


def _cycles(names: Iterable[str], successor: Mapping[str, str]) -> Iterator[list[str]]:
    """Yield each cycle of the mapping `successor` once, in linear time."""
    finished: set[str] = set()
    for start in names:
        walked: dict[str, None] = {}
        name: str | None = start
        while name is not None and name not in finished and name not in walked:
            walked[name] = None
            name = successor.get(name)
        if name is not None and name in walked:
            way = list(walked)
            yield way[way.index(name) :]
        finished |= walked.keys()


def _check_link(path: str, link: Link) -> Iterator[Finding]:
    """Check that the mass is not negative, and that no shape is empty."""
    if link.inertial is not None:
        mass, place = link.inertial.mass, f"{path} / inertial"
        if mass < 0:
            yield Finding("negative-mass", f"{place} / mass", f"{place}: the mass {mass:g} kg is negative")
    shapes = {f"visual {number}": visual.geometry for number, visual in enumerate(link.visuals, start=1)}
    shapes |= {f"collision {number}": shape.geometry for number, shape in enumerate(link.collisions, start=1)}
    for name, geometry in shapes.items():
        if _is_empty(geometry):
            place = f"{path} / {name} / {geometry.__struct_config__.tag}"
            yield Finding("shape-size", place, f"{place}: a size is zero or negative: the shape is empty")


def _is_empty(geometry: Geometry) -> bool:
    """Return whether a shape is empty. A sphere may be a contact point; a negative scale mirrors a mesh."""
    match geometry:
        case Box(size=sizes) | Ellipsoid(radii=sizes):
            return min(sizes) <= 0
        case Cylinder(radius=radius, length=length):
            return radius <= 0 or length <= 0
        case Capsule(radius=radius, length=length):
            return radius <= 0 or length < 0
        case Sphere(radius=radius):
            return radius < 0
        case Mesh(scale=scale):
            return 0 in scale


def _check_joint(path: str, joint: Joint) -> Iterator[Finding]:
    """Check the axis of a joint, its limits and its losses."""
    kind, length = JOINT_KINDS[joint.type], math.hypot(*joint.axis)
    if kind.has_axis and length == 0:
        yield Finding("zero-axis", f"{path} / axis", f"{path}: the axis has no direction")
    elif kind.has_axis and abs(length - 1) > _ROUNDING:
        shown = " ".join(f"{value:g}" for value in joint.axis)
        message = f"{path}: the axis {shown} has length {length:g}, and is normalised"
        yield Finding("axis-not-unit", f"{path} / axis", message)
    limit = joint.limit
    if limit and kind.has_limits and limit.lower > limit.upper:
        message = f"{path}: the lower limit {limit.lower:g} is above the upper limit {limit.upper:g}"
        yield Finding("limit-order", f"{path} / limit", message)
    effect = effective(joint)
    for block, names in _MAGNITUDES.items():
        for name in names:
            value = getattr(getattr(effect, block), name, None)
            if value is not None and value < 0:
                code = "negative-inertia" if name in _INERTIAS else f"negative-{block}"
                yield Finding(code, f"{path} / {block}", f"{path}: the {name.replace('_', ' ')} {value:g} is negative")
    if limit and joint.type == "ball":
        yield Finding("limit-without-effect", f"{path} / limit", f"{path} is a ball: its <limit> has no effect")
    if limit and joint.type == "continuous" and limit.lower < limit.upper <= limit.lower + _ENDLESS:
        message = f"{path} is continuous: its limits {limit.lower:g} to {limit.upper:g} have no effect"
        yield Finding(
            "limit-without-effect", f"{path} / limit", message, "make the joint revolute, or remove the limits"
        )
    given, acting = joint.dynamics or Dynamics(), effect.dynamics or Dynamics()
    idle = [name for name in Dynamics.__struct_fields__ if getattr(given, name) != getattr(acting, name)]
    if idle:
        message = f"{path}: {' and '.join(idle).replace('_', ' ')} of <dynamics> can't act on a {joint.type} joint"
        yield Finding("dynamics-without-effect", f"{path} / dynamics", message)
    if acting.spring_reference and not acting.spring_stiffness:
        message = f"{path}: the spring reference {acting.spring_reference:g} has no effect without a stiffness"
        yield Finding("dynamics-without-effect", f"{path} / dynamics", message, "state a stiffness, or remove it")


def _check_mimics(numbered: Sequence[tuple[str, Joint]]) -> Iterator[Finding]:
    """Check that each mimic joint and its leader have one degree of freedom. Chains are legal, cycles are not."""
    joints: dict[str, Joint] = {}
    leaders: dict[str, str] = {}
    for _, joint in numbered:
        joints.setdefault(joint.name, joint)
    for path, joint in numbered:
        if joint.mimic is None or not joint.mimic.joint:  # the reader reports a missing name
            continue
        target, place = joint.mimic.joint, f"{path} / mimic"
        leaders.setdefault(joint.name, target)
        leader, mimics = joints.get(target), f"joint {joint.name!r} mimics joint {target!r}"
        if joint.type == "fixed":
            message = f"joint {joint.name!r} is fixed: its mimic has no effect"
            yield Finding("mimic-without-effect", place, message)
        elif not JOINT_KINDS[joint.type].motion:
            message = f"joint {joint.name!r} is {joint.type}, and can't mimic a single position"
            yield Finding("mimic-type", place, message)
        elif leader is None:
            yield Finding("unknown-mimic", place, f"{mimics}, which does not exist", perhaps(target, joints))
        elif leader.type == "fixed":
            yield Finding("mimic-of-fixed", place, f"{mimics}, which is fixed: the offset gives the position")
        elif not JOINT_KINDS[leader.type].motion:
            yield Finding("mimic-type", place, f"{mimics}, which is {leader.type} and has no single position")
    for cycle in _cycles(leaders, leaders):
        message = f"joints mimic each other in a cycle: {' → '.join(map(repr, [*cycle, cycle[0]]))}"
        yield Finding("mimic-cycle", f"joint {cycle[0]} / mimic", message)
