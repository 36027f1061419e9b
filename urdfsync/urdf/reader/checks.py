"""What must hold in a robot, whatever it was read from. Pure: a Robot in, findings out.

A finding is an error where no right model exists, and a warning where one does. Its `path` names the
element as a diff does: `link wheel`, `joint elbow / limit`; the second element of a name is `link wheel #2`.
"""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import NamedTuple, TypeVar

import msgspec

from urdfsync import spelling
from urdfsync.diagnostics import Severity
from urdfsync.urdf.robot import (
    Box,
    Capsule,
    Cylinder,
    Geometry,
    Inertia,
    Inertial,
    Joint,
    Limit,
    Link,
    Mesh,
    Robot,
    Sphere,
    Vector,
)

MOVING = ("continuous", "revolute", "prismatic", "planar")
"""Joint types that have an axis; that of a planar joint is the normal of its plane."""
SCALAR = ("continuous", "revolute", "prismatic")
"""Joint types with one degree of freedom: these alone can mimic and be mimicked."""
LIMITED = ("revolute", "prismatic")
"""Joint types whose position has limits."""

_EXACT = 1e-12
_ROUNDING = 1e-6
_INERTIA_TOLERANCE = 1e-6
_POINT = 1e-6
"""Radius of gyration, in m, below which a body is a point: what its inertia says then is rounding."""
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


def check(robot: Robot, *, complete: bool = True, of_elements: Iterable[Finding] | None = None) -> Iterator[Finding]:
    """All findings about a robot whose axes are still as they were read.

    `complete` is false if faulty joints or links had to be left out: how many roots there are then says nothing.
    `of_elements` are the findings of `check_elements`, if they are known already.
    """
    yield from _check_names("link", (link.name for link in robot.links))
    yield from _check_names("joint", (joint.name for joint in robot.joints))
    yield from check_tree(robot, complete=complete)
    yield from check_elements(robot) if of_elements is None else of_elements
    yield from check_mimics(robot)


def check_elements(robot: Robot) -> Iterator[Finding]:
    """The findings about each link, and then about each joint, that no other element has to do with."""
    for path, link in numbered("link", robot.links):
        yield from check_link(path, link)
    for path, joint in numbered("joint", robot.joints):
        yield from check_joint(path, joint)


def nearest(name: str, names: Collection[str], likeness: float = 0.7) -> str:
    """The name most like `name`; an empty string if none is like it, or if there are too many to look at."""
    return spelling.nearest(name, names, likeness) if len(names) <= _COMPARED else ""


def numbered(kind: str, elements: Iterable[_Element]) -> Iterator[tuple[str, _Element]]:
    """Each element with its path: `joint elbow`, and `joint elbow #2` for the second of that name."""
    seen: Counter[str] = Counter()
    for element in elements:
        seen[element.name] += 1
        count = seen[element.name]
        yield f"{kind} {element.name}" + (f" #{count}" if count > 1 else ""), element


def _error(code: str, path: str, message: str, hint: str) -> Finding:
    return Finding(Severity.ERROR, code, path, message, hint)


def _warning(code: str, path: str, message: str, hint: str) -> Finding:
    return Finding(Severity.WARNING, code, path, message, hint)


def _check_names(kind: str, names: Iterable[str]) -> Iterator[Finding]:
    """Names are unique among the links and among the joints; a link and a joint may share one."""
    for name, count in Counter(names).items():
        for number in range(2, count + 1):
            message = f"there is another {kind} {name!r} above"
            yield _error(f"duplicate-{kind}", f"{kind} {name} #{number}", message, f"rename or remove one {kind}")


def check_tree(robot: Robot, *, complete: bool = True) -> Iterator[Finding]:
    """The joints connect all links to one tree."""
    links = {link.name for link in robot.links}
    if not links:
        if complete:
            yield _error("no-link", "robot", "the robot has no link", "check that the export is complete")
        return
    parents: dict[str, Joint] = {}
    for path, joint in numbered("joint", robot.joints):
        if joint.parent not in links or joint.child not in links:
            complete = False
            yield from _check_ends(path, joint, links)
        first = parents.setdefault(joint.child, joint)
        if first.name != joint.name:
            message = f"link {joint.child!r} is the child of joint {joint.name!r} and of joint {first.name!r}"
            yield _error("two-parents", path, message, "a link has one parent: remove one joint")
    roots = list(dict.fromkeys(link.name for link in robot.links if link.name not in parents))
    yield from _check_cycles(robot, parents)
    if len(roots) > 1 and complete:
        names = ", ".join(map(repr, roots))
        hint = "connect them by joints, or remove what does not belong to the robot"
        yield _error("several-roots", f"link {roots[1]}", f"{len(roots)} links have no parent: {names}", hint)


def _first_of_each_name(joints: Iterable[Joint]) -> dict[str, Joint]:
    """The joints by name; of several with one name the first."""
    first: dict[str, Joint] = {}
    for joint in joints:
        first.setdefault(joint.name, joint)
    return first


def _check_ends(path: str, joint: Joint, links: Collection[str]) -> Iterator[Finding]:
    """Parent and child of a joint exist."""
    for end, name in (("parent", joint.parent), ("child", joint.child)):
        if name not in links:
            meant = nearest(name, links)
            hint = f"perhaps {meant!r} is meant" if meant else "add the link, or correct its name"
            message = f"the {end} of joint {joint.name!r} is link {name!r}, which does not exist"
            yield _error(f"unknown-{end}", f"{path} / {end}", message, hint)


def _check_cycles(robot: Robot, parents: Mapping[str, Joint]) -> Iterator[Finding]:
    """No link is its own ancestor."""
    above = {child: joint.parent for child, joint in parents.items()}
    for cycle in _cycles((link.name for link in robot.links), above):
        joint = parents[cycle[0]]
        message = f"links form a cycle: {' → '.join(map(repr, [*reversed(cycle), cycle[-1]]))}"
        yield _error("cycle", f"joint {joint.name}", message, "a URDF is a tree: remove a joint of the cycle")


def _cycles(names: Iterable[str], successor: Mapping[str, str]) -> Iterator[list[str]]:
    """All cycles of the function `successor`, each once; linear in the number of names."""
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


def check_link(path: str, link: Link) -> Iterator[Finding]:
    """Mass properties and shapes of a link that bodies can have."""
    if link.inertial is not None:
        yield from _check_inertial(f"{path} / inertial", link.inertial)
    for number, visual in enumerate(link.visuals, start=1):
        if _is_empty(visual.geometry):
            yield _empty(f"{path} / visual {number}", visual.geometry)
    for number, collision in enumerate(link.collisions, start=1):
        if _is_empty(collision.geometry):
            yield _empty(f"{path} / collision {number}", collision.geometry)


def _check_inertial(path: str, inertial: Inertial) -> Iterator[Finding]:
    """A body has mass of one sign, and principal moments of inertia that some distribution of mass has."""
    if inertial.mass < 0:
        hint = "correct the mass; a massless link has none, or 0"
        yield _error("negative-mass", f"{path} / mass", f"{path}: the mass {inertial.mass:g} kg is negative", hint)
    low, middle, high = principal_moments(inertial.inertia)
    tolerance = _INERTIA_TOLERANCE * max(abs(low), abs(high)) + max(inertial.mass, 0) * _POINT**2
    if not (low < -tolerance or low + middle < high - tolerance):
        return
    moments = f"{low:.6g}, {middle:.6g} and {high:.6g} kg·m²"
    place, hint = f"{path} / inertia", "export the inertia again; simulation may not be physical"
    if low < -tolerance:
        message = f"{path}: the inertia is not positive semi-definite: its principal moments are {moments}"
        yield _warning("inertia-not-positive", place, message, hint)
    else:
        message = f"{path}: no body has this inertia: of its principal moments {moments} one exceeds the others' sum"
        yield _warning("inertia-triangle", place, message, hint)


def principal_moments(inertia: Inertia) -> Vector:
    """Eigenvalues of the inertia tensor in ascending order, in kg·m².

    Cyclic Jacobi rotations (Golub and Van Loan, Matrix Computations, section 8.5), accurate to rounding.
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
    """Whether a size is not positive; but spheres may be points of contact, and a mesh may be mirrored."""
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


def _empty(shape: str, geometry: Geometry) -> Finding:
    path = f"{shape} / {geometry.__struct_config__.tag}"
    message = f"{path}: a size is zero or negative, so that the shape is empty"
    return _warning("shape-size", path, message, "correct the size, or remove the shape")


def check_joint(path: str, joint: Joint) -> Iterator[Finding]:
    """Axis, limits and losses of a joint."""
    if joint.type in MOVING:
        yield from _check_axis(path, joint.axis)
    if joint.limit is not None:
        yield from _check_limit(path, joint, joint.limit)
    if joint.dynamics is None:
        return
    losses = {"damping": joint.dynamics.damping, "friction": joint.dynamics.friction}
    if joint.type in ("fixed", "floating"):
        if any(losses.values()):
            message = f"{path}: damping and friction have no effect on a {joint.type} joint"
            yield _warning("dynamics-without-effect", f"{path} / dynamics", message, "remove them, or change the type")
        return
    for name, value in losses.items():
        if value < 0:
            message = f"{path}: the {name} {value:g} is negative, so that the joint gains energy"
            yield _warning("negative-dynamics", f"{path} / dynamics", message, "correct its sign")


def _check_axis(path: str, axis: Vector) -> Iterator[Finding]:
    """An axis has a direction; its length should be 1."""
    length = math.hypot(*axis)
    if length == 0:
        yield _error(
            "zero-axis", f"{path} / axis", f"{path}: the axis has no direction", 'write for example xyz="0 0 1"'
        )
    elif abs(length - 1) > _ROUNDING:
        shown = " ".join(f"{value:g}" for value in axis)
        message = f"{path}: the axis {shown} has length {length:g}, and is normalised"
        yield _warning("axis-not-unit", f"{path} / axis", message, "write a unit vector")


def _check_limit(path: str, joint: Joint, limit: Limit) -> Iterator[Finding]:
    """The range of positions is not empty, and effort and velocity are magnitudes."""
    place = f"{path} / limit"
    if joint.type in LIMITED and limit.lower > limit.upper:
        message = f"{path}: the lower limit {limit.lower:g} is above the upper limit {limit.upper:g}"
        yield _error("limit-order", place, message, "exchange or correct the limits")
    for name, value in (("effort", limit.effort), ("velocity", limit.velocity)):
        if value is not None and value < 0:
            message = f"{path}: the {name} limit {value:g} is negative, so that it is always exceeded"
            yield _warning("negative-limit", place, message, "limits of effort and velocity are magnitudes")


def check_mimics(robot: Robot) -> Iterator[Finding]:
    """Every mimic relation is between joints of one degree of freedom; chains are legal, cycles are not."""
    joints = _first_of_each_name(robot.joints)
    leaders: dict[str, str] = {}
    for path, joint in numbered("joint", robot.joints):
        if joint.mimic is not None:
            leaders.setdefault(joint.name, joint.mimic.joint)
            yield from _check_mimic(f"{path} / mimic", joint, joints.get(joint.mimic.joint), joints)
    for cycle in _cycles(leaders, leaders):
        message = f"joints mimic each other in a cycle: {' → '.join(map(repr, [*cycle, cycle[0]]))}"
        yield _error("mimic-cycle", f"joint {cycle[0]} / mimic", message, "one joint of the cycle must move by itself")


def _check_mimic(path: str, joint: Joint, leader: Joint | None, names: Collection[str]) -> Iterator[Finding]:
    """One mimic relation; its leader is None if it does not exist."""
    if joint.type == "fixed":
        message = f"joint {joint.name!r} is fixed, so that its mimic has no effect"
        yield _warning("mimic-without-effect", path, message, "remove the mimic, or change the type")
    elif joint.type not in SCALAR:
        message = f"joint {joint.name!r} is {joint.type}, and can't mimic a single position"
        yield _error("mimic-type", path, message, "remove the mimic, or change the type")
    elif leader is None:
        target = joint.mimic.joint if joint.mimic else ""
        meant = _meant(target, joint.name, names)
        hint = f"perhaps {meant!r} is meant" if meant else "add the joint, or correct its name"
        yield _error("unknown-mimic", path, f"joint {joint.name!r} mimics joint {target!r}, which does not exist", hint)
    elif leader.type == "fixed":
        message = f"joint {joint.name!r} mimics the fixed joint {leader.name!r}, and is held at its offset"
        yield _warning("mimic-of-fixed", path, message, "make it fixed, or let it mimic a joint that moves")
    elif leader.type not in SCALAR:
        message = (
            f"joint {joint.name!r} mimics joint {leader.name!r}, which is {leader.type} and has no single position"
        )
        yield _error("mimic-type", path, message, "let it mimic a revolute, continuous or prismatic joint")


def _meant(target: str, own: str, names: Collection[str]) -> str:
    """The joint that `own` may be meant to mimic: if `target` lacks a prefix, that of its side; else the most alike."""
    whole = [name for name in names if name.endswith(target) and name != own]
    return nearest(own, whole, 0) or nearest(target, names)


def unit_axes(robot: Robot) -> Robot:
    """The robot with unit vectors as axes; where an axis has no meaning, a zero becomes the default.

    An axis whose length is 1 but for 1e-12 stays as it is, bit by bit.
    """
    joints = ((joint, _unit(joint.axis)) for joint in robot.joints)
    return msgspec.structs.replace(
        robot,
        joints=tuple(
            joint if axis is joint.axis else msgspec.structs.replace(joint, axis=axis) for joint, axis in joints
        ),
    )


def _unit(axis: Vector) -> Vector:
    """The unit vector along `axis`; x for a zero vector."""
    largest = max(map(abs, axis))
    if largest == 0:
        return (1.0, 0.0, 0.0)
    if abs(math.hypot(*axis) - 1) < _EXACT:
        return axis
    scaled = [value / largest for value in axis]
    length = math.hypot(*scaled)
    return (scaled[0] / length, scaled[1] / length, scaled[2] / length)
