"""What must hold in a robot, whatever it was read from. Pure: a Robot in, findings out.

A finding is an error where no right model exists, and a warning where one does. Its `path` names the element as a diff
does: `link wheel`, `joint elbow / limit`; the second element of a name is `link wheel #2`.
"""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple, TypeVar

import msgspec

from urdfsync import spelling
from urdfsync.diagnostics import Severity
from urdfsync.urdf.robot import (
    JOINT_KINDS,
    Box,
    Capsule,
    Cylinder,
    Geometry,
    Inertia,
    Joint,
    Link,
    Mesh,
    Robot,
    Sphere,
    Vector,
)

_ERROR, _WARNING = Severity.ERROR, Severity.WARNING
_EXACT = 1e-12
_ROUNDING = 1e-6
_INERTIA_TOLERANCE = 1e-6
# Radius of gyration, in m, below which a body is a point: its inertia is rounding then.
_POINT = 1e-6
_SWEEPS = 12
_COMPARED = 500

_Element = TypeVar("_Element", Link, Joint)


class Finding(NamedTuple):
    """One finding about the element at `path`; the other fields are those of a Diagnostic."""

    severity: Severity
    code: str
    path: str
    message: str
    hint: str


def check(robot: Robot, *, complete: bool = True) -> Iterator[Finding]:
    """Check a robot whose axes still are as written.

    `complete` is false if faulty joints or links had to be left out: the number of roots means nothing then.
    """
    yield from _check_names("link", (link.name for link in robot.links))
    yield from _check_names("joint", (joint.name for joint in robot.joints))
    yield from _check_tree(robot, complete)
    for path, link in _numbered("link", robot.links):
        yield from _check_link(path, link)
    for path, joint in _numbered("joint", robot.joints):
        yield from _check_joint(path, joint)
    yield from _check_mimics(robot)


def check_actuated(actuated: Iterable[tuple[str, str]], joints: Collection[str]) -> Iterator[Finding]:
    """Warn about each actuated joint that does not exist: the joint that is meant would count as passive.

    `actuated` has the paths that name joints, and these names.
    """
    for path, name in actuated:
        if name not in joints:
            meant = nearest(name, joints)
            hint = f"perhaps {meant!r} is meant" if meant else "correct its name, or take it out"
            message = f"{path.partition(' / ')[0]} drives joint {name!r}, which does not exist"
            yield Finding(_WARNING, "unknown-actuated-joint", path, message, hint)


def nearest(name: str, names: Collection[str], likeness: float = 0.7) -> str:
    """Return the name most like `name`; an empty string if none is like it, or if there are too many to compare."""
    return spelling.nearest(name, names, likeness) if len(names) <= _COMPARED else ""


def element_paths(kind: str, names: Iterable[str]) -> list[str]:
    """Return the path of each element: `joint elbow`, `joint elbow #2` for the second of that name."""
    seen: Counter[str] = Counter()
    paths = []
    for number, name in enumerate(names, start=1):
        seen[name] += 1
        path = f"{kind} {name}" if name.strip() else f"{kind} number {number}"
        paths.append(path if seen[name] == 1 else f"{path} #{seen[name]}")
    return paths


def _numbered(kind: str, elements: Sequence[_Element]) -> Iterator[tuple[str, _Element]]:
    return zip(element_paths(kind, (element.name for element in elements)), elements, strict=True)


def normalise_axes(robot: Robot) -> Robot:
    """Return the robot with unit vectors as axes; where an axis has no meaning, a zero becomes the default.

    An axis whose length is 1 but for 1e-12 stays as it is, bit by bit.
    """
    joints = [msgspec.structs.replace(joint, axis=_unit_vector(joint.axis)) for joint in robot.joints]
    return msgspec.structs.replace(robot, joints=tuple(joints))


def _unit_vector(axis: Vector) -> Vector:
    """Return the unit vector along `axis`; x for a zero vector."""
    largest = max(map(abs, axis))
    if largest == 0:
        return (1.0, 0.0, 0.0)
    if abs(math.hypot(*axis) - 1) < _EXACT:
        return axis
    scaled = [value / largest for value in axis]  # else the square of a large number overflows
    length = math.hypot(*scaled)
    # Adding 0.0 makes a zero of -0.0, which a tiny negative number becomes; equal robots then give the same text.
    return (scaled[0] / length + 0.0, scaled[1] / length + 0.0, scaled[2] / length + 0.0)


def _check_names(kind: str, names: Iterable[str]) -> Iterator[Finding]:
    """Names are unique among the links and among the joints; a link and a joint may share one."""
    for name, count in Counter(names).items():
        for number in range(2, count + 1):
            message = f"there is another {kind} {name!r} above"
            yield Finding(
                _ERROR, f"duplicate-{kind}", f"{kind} {name} #{number}", message, f"rename or remove one {kind}"
            )


def _check_tree(robot: Robot, complete: bool) -> Iterator[Finding]:
    """The joints connect all links to one tree."""
    links = {link.name for link in robot.links}
    if not links:
        if complete:
            yield Finding(_ERROR, "no-link", "robot", "the robot has no link", "check that the export is complete")
        return
    parents: dict[str, Joint] = {}
    for path, joint in _numbered("joint", robot.joints):
        for end, name in (("parent", joint.parent), ("child", joint.child)):
            if name not in links:
                complete = False
                meant = nearest(name, links)
                hint = f"perhaps {meant!r} is meant" if meant else "add the link, or correct its name"
                message = f"the {end} of joint {joint.name!r} is link {name!r}, which does not exist"
                yield Finding(_ERROR, f"unknown-{end}", f"{path} / {end}", message, hint)
        first = parents.setdefault(joint.child, joint)
        if first.name != joint.name:
            message = f"link {joint.child!r} is the child of joint {joint.name!r} and of joint {first.name!r}"
            yield Finding(_ERROR, "two-parents", path, message, "a link has one parent: remove one joint")
    above = {child: joint.parent for child, joint in parents.items()}
    for cycle in _cycles((link.name for link in robot.links), above):
        message = f"links form a cycle: {' → '.join(map(repr, [*reversed(cycle), cycle[-1]]))}"
        path = f"joint {parents[cycle[0]].name}"
        yield Finding(_ERROR, "cycle", path, message, "a URDF is a tree: remove a joint of the cycle")
    roots = list(dict.fromkeys(link.name for link in robot.links if link.name not in parents))
    if len(roots) > 1 and complete:
        names = ", ".join(map(repr, roots))
        hint = "connect them by joints, or remove what does not belong to the robot"
        yield Finding(_ERROR, "several-roots", f"link {roots[1]}", f"{len(roots)} links have no parent: {names}", hint)


def _cycles(names: Iterable[str], successor: Mapping[str, str]) -> Iterator[list[str]]:
    """Yield each cycle of the function `successor` once; linear in the number of names."""
    finished: set[str] = set()
    for start in names:
        walked: dict[str, None] = {}
        name: str | None = start
        while name is not None and name not in finished and name not in walked:
            walked[name] = None
            name = successor.get(name)
        if name is not None and name in walked:
            yield list(itertools.dropwhile(lambda link, first=name: link != first, walked))  # type: ignore[misc]
        finished |= walked.keys()


def _check_link(path: str, link: Link) -> Iterator[Finding]:
    """Some body has the mass properties of the link, and its shapes are not empty."""
    if link.inertial is not None:
        mass, place = link.inertial.mass, f"{path} / inertial"
        if mass < 0:
            hint = "correct the mass; a massless link has none, or 0"
            message = f"{place}: the mass {mass:g} kg is negative"
            yield Finding(_ERROR, "negative-mass", f"{place} / mass", message, hint)
        low, middle, high = principal_moments(link.inertial.inertia)
        tolerance = _INERTIA_TOLERANCE * max(abs(low), abs(high)) + max(mass, 0) * _POINT**2
        moments = f"{low:.6g}, {middle:.6g} and {high:.6g} kg·m²"
        hint = "export the inertia again; simulation may not be physical"
        if low < -tolerance:
            message = f"{place}: the inertia is not positive semi-definite: its principal moments are {moments}"
            yield Finding(_WARNING, "inertia-not-positive", f"{place} / inertia", message, hint)
        elif low + middle < high - tolerance:
            message = (
                f"{place}: no body has this inertia: of its principal moments {moments} one exceeds the others' sum"
            )
            yield Finding(_WARNING, "inertia-triangle", f"{place} / inertia", message, hint)
    shapes = {f"visual {number}": visual.geometry for number, visual in enumerate(link.visuals, start=1)}
    shapes |= {f"collision {number}": shape.geometry for number, shape in enumerate(link.collisions, start=1)}
    for name, geometry in shapes.items():
        if _is_empty(geometry):
            place = f"{path} / {name} / {geometry.__struct_config__.tag}"
            message = f"{place}: a size is zero or negative, so that the shape is empty"
            yield Finding(_WARNING, "shape-size", place, message, "correct the size, or remove the shape")


def principal_moments(inertia: Inertia) -> Vector:
    """Return the eigenvalues of the inertia tensor in ascending order, in kg·m².

    Cyclic Jacobi rotations (Golub and Van Loan, Matrix Computations, section 8.5), accurate to rounding. Loading numpy
    for it would take longer than a whole build of a small robot.
    """
    a = [
        [inertia.ixx, inertia.ixy, inertia.ixz],
        [inertia.ixy, inertia.iyy, inertia.iyz],
        [inertia.ixz, inertia.iyz, inertia.izz],
    ]
    for _ in range(_SWEEPS):
        if not (a[0][1] or a[0][2] or a[1][2]):
            break
        for p, q in ((0, 1), (0, 2), (1, 2)):
            if a[p][q] == 0:
                continue
            ratio = (a[q][q] - a[p][p]) / 2 / a[p][q]
            tangent = math.copysign(1 / (abs(ratio) + math.hypot(1, ratio)), ratio)
            cosine = 1 / math.hypot(1, tangent)
            sine = tangent * cosine
            a[p][p], a[q][q] = a[p][p] - tangent * a[p][q], a[q][q] + tangent * a[p][q]
            a[p][q] = a[q][p] = 0.0
            r = 3 - p - q
            a[r][p], a[r][q] = cosine * a[r][p] - sine * a[r][q], sine * a[r][p] + cosine * a[r][q]
            a[p][r], a[q][r] = a[r][p], a[r][q]
    low, middle, high = sorted(a[i][i] for i in range(3))
    return low, middle, high


def _is_empty(geometry: Geometry) -> bool:
    """Return whether a size is not positive; but spheres may be points of contact, and a mesh may be mirrored."""
    match geometry:
        case Box(size=size):
            return min(size) <= 0
        case Cylinder(radius=radius, length=length):
            return radius <= 0 or length <= 0
        case Capsule(radius=radius, length=length):
            return radius <= 0 or length < 0
        case Sphere(radius=radius):
            return radius < 0
        case Mesh(scale=scale):
            return 0 in scale


def _check_joint(path: str, joint: Joint) -> Iterator[Finding]:
    """The axis has a direction, the limits are a range and magnitudes, and the joint loses energy if it has losses."""
    kind = JOINT_KINDS[joint.type]
    length = math.hypot(*joint.axis)
    if kind.has_axis and length == 0:
        message = f"{path}: the axis has no direction"
        yield Finding(_ERROR, "zero-axis", f"{path} / axis", message, 'write for example xyz="0 0 1"')
    elif kind.has_axis and abs(length - 1) > _ROUNDING:
        shown = " ".join(f"{value:g}" for value in joint.axis)
        message = f"{path}: the axis {shown} has length {length:g}, and is normalised"
        yield Finding(_WARNING, "axis-not-unit", f"{path} / axis", message, "write a unit vector")
    if limit := joint.limit:
        place = f"{path} / limit"
        if kind.has_limits and limit.lower > limit.upper:
            message = f"{path}: the lower limit {limit.lower:g} is above the upper limit {limit.upper:g}"
            yield Finding(_ERROR, "limit-order", place, message, "exchange or correct the limits")
        for name, value in (("effort", limit.effort), ("velocity", limit.velocity)):
            if value is not None and value < 0:
                message = f"{path}: the {name} limit {value:g} is negative, so that it is always exceeded"
                hint = "limits of effort and velocity are magnitudes"
                yield Finding(_WARNING, "negative-limit", place, message, hint)
    if dynamics := joint.dynamics:
        place, losses = f"{path} / dynamics", (("damping", dynamics.damping), ("friction", dynamics.friction))
        if not kind.has_axis and any(value for _, value in losses):
            message = f"{path}: damping and friction have no effect on a {joint.type} joint"
            yield Finding(_WARNING, "dynamics-without-effect", place, message, "remove them, or change the type")
        for name, value in losses if kind.has_axis else ():
            if value < 0:
                message = f"{path}: the {name} {value:g} is negative, so that the joint gains energy"
                yield Finding(_WARNING, "negative-dynamics", place, message, "correct its sign")


def _check_mimics(robot: Robot) -> Iterator[Finding]:
    """Mimic relations are between joints of one degree of freedom; chains are legal, cycles are not."""
    joints: dict[str, Joint] = {}
    leaders: dict[str, str] = {}
    for joint in robot.joints:
        joints.setdefault(joint.name, joint)
    for path, joint in _numbered("joint", robot.joints):
        if joint.mimic is not None and joint.mimic.joint:  # else the reader has told that it has no name
            leaders.setdefault(joint.name, joint.mimic.joint)
            yield from _check_mimic(f"{path} / mimic", joint, joint.mimic.joint, joints)
    for cycle in _cycles(leaders, leaders):
        message = f"joints mimic each other in a cycle: {' → '.join(map(repr, [*cycle, cycle[0]]))}"
        yield Finding(
            _ERROR, "mimic-cycle", f"joint {cycle[0]} / mimic", message, "one joint of the cycle must move by itself"
        )


def _check_mimic(path: str, joint: Joint, target: str, joints: Mapping[str, Joint]) -> Iterator[Finding]:
    """Check one mimic relation; `target` is the name of the joint that `joint` mimics."""
    leader = joints.get(target)
    if joint.type == "fixed":
        message = f"joint {joint.name!r} is fixed, so that its mimic has no effect"
        yield Finding(_WARNING, "mimic-without-effect", path, message, "remove the mimic, or change the type")
    elif not JOINT_KINDS[joint.type].motion:
        message = f"joint {joint.name!r} is {joint.type}, and can't mimic a single position"
        yield Finding(_ERROR, "mimic-type", path, message, "remove the mimic, or change the type")
    elif leader is None:
        # A target without the prefix of its side means the joint of the same side, else the one most alike.
        same_end = [name for name in joints if name.endswith(target) and name != joint.name]
        meant = nearest(joint.name, same_end, 0) or nearest(target, joints)
        hint = f"perhaps {meant!r} is meant" if meant else "add the joint, or correct its name"
        yield Finding(
            _ERROR, "unknown-mimic", path, f"joint {joint.name!r} mimics joint {target!r}, which does not exist", hint
        )
    elif leader.type == "fixed":
        message = f"joint {joint.name!r} mimics the fixed joint {target!r}, and is held at its offset"
        yield Finding(_WARNING, "mimic-of-fixed", path, message, "make it fixed, or let it mimic a joint that moves")
    elif not JOINT_KINDS[leader.type].motion:
        message = f"joint {joint.name!r} mimics joint {target!r}, which is {leader.type} and has no single position"
        yield Finding(_ERROR, "mimic-type", path, message, "let it mimic a revolute, continuous or prismatic joint")
