"""Finds legal but implausible parts of a URDF: no inertia, numbers in another unit, a shape far outside of its link.

The bounds are wide, since a warning about a sound robot is worse than no warning.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import (
    JOINT_KINDS,
    Box,
    Capsule,
    Collision,
    Cylinder,
    Geometry,
    Inertial,
    Joint,
    Link,
    Mesh,
    Origin,
    Sphere,
    Visual,
)
from urdfsync.urdf.validate import Finding

_DENSEST = 10_000
"""In kg/m³: the greatest density of a cube as large as the robot; steel has 7,900."""
_HEAVY = 500
"""In kg: the density of a lighter robot is not checked, since its size is uncertain."""
_GYRATION = 3
"""Greatest radius of gyration, relative to the distance of a body's farthest point.

A real body has at most 1, but its shapes may be simplified.
"""
_MARKER = 0.002
"""In m: a smaller shape only marks a place, and the size of its body is unknown."""
_UNKNOWN_GYRATION, _UNKNOWN_SIZE = 10, 0.5
"""Greatest radius of gyration of a body of unknown size, in lengths of the robot, and the least length in m."""
_FAR, _FAR_AWAY = 10, 2
"""A shape is too far from its link if its distance exceeds ten lengths of the robot and two metres."""
_LONG_SLIDE, _LONGEST_SLIDE, _LONG_JOINT = 20, 5000, 50
"""Limits of a slide are implausible above 20 m and 20 lengths of the robot, up to 5,000 m.

A joint is implausible at more than 50 m from its parent.
"""
_FOUR_TURNS, _TWO_TURNS_IN_DEGREES = 8 * math.pi, 720
_LIGHT = 0.05
"""In kg: a lighter part may only mark a place, and may have an inertia of 0 by rounding."""


def find_implausible(tree: KinematicTree) -> Iterator[Finding]:
    """Yield a warning for each implausible part of a valid robot."""
    own_masses = {link.name: link.inertial.mass if link.inertial else 0.0 for link in tree.links}
    masses, length = dict(own_masses), find_length(tree)
    for joint in reversed(tree.joints):
        masses[joint.parent] += masses[joint.child]
    yield from _check_masses(tree, masses, length)
    for link in tree.links:
        if link.inertial is not None and link.inertial.mass:
            yield from _check_inertia(link, link.inertial, length)
            yield from _check_angles(f"link {link.name} / inertial", link.inertial.origin)
        yield from _check_shapes(link, length)
    for joint in tree.joints:
        yield from _check_angles(f"joint {joint.name}", joint.origin)
        yield from _check_limits(joint, length, own_masses[joint.child])


def find_length(tree: KinematicTree) -> float:
    """Return the length of a robot's longest chain, in m: the sum of the distances from joint to joint."""
    distances = {tree.links[0].name: 0.0}
    for joint in tree.joints:
        distances[joint.child] = distances[joint.parent] + math.hypot(*joint.origin.xyz)
    return max(distances.values())


def _check_masses(tree: KinematicTree, masses: Mapping[str, float], length: float) -> Iterator[Finding]:
    """Check that each joint moves a mass, and that the robot is no denser than steel.

    `masses` has, for each link, the mass of the link and of all links behind it.
    """
    total = max(masses.values())
    moving = [joint for joint in tree.joints if joint.type != "fixed"]
    if moving and not total:
        yield Finding("no-inertia", "robot", "no link has a mass: motion takes no force")
        return
    for joint in moving:
        if not masses[joint.child] and masses[joint.parent]:
            message = f"joint {joint.name!r} moves no mass: no link behind it has an <inertial>"
            yield Finding("no-inertia", f"joint {joint.name}", message)
    if total <= _HEAVY:
        return
    radii = [radius for link in tree.links if math.isfinite(radius := _radius(link))]
    size = 2 * max([length / 2, *radii, *(_gyration(link.inertial) for link in tree.links if link.inertial)])
    if total > _DENSEST * size * size * size:  # `**` of a large number would raise an error
        message = f"the masses add up to {total:.6g} kg in a robot of {size:.3g} m: they may be in grams"
        yield Finding("mass-unit", "robot", message)


def _check_inertia(link: Link, inertial: Inertial, length: float) -> Iterator[Finding]:
    """Check that a body of the link's size can have its radius of gyration; the link has a mass."""
    gyration, radius, place = _gyration(inertial), _radius(link), f"link {link.name} / inertial"
    if gyration == 0 and radius and inertial.mass > _LIGHT:
        message = f"{place}: a body of {inertial.mass:g} kg with a shape has no inertia"
    elif _MARKER < radius < math.inf and gyration > _GYRATION * radius:
        message = (
            f"{place}: the radius of gyration is {gyration:.3g} m, but the link's shapes reach only {radius:.3g} m"
        )
    elif not _MARKER < radius < math.inf and gyration > _UNKNOWN_GYRATION * max(length, _UNKNOWN_SIZE):
        message = f"{place}: the radius of gyration is {gyration:.3g} m in a robot of {length:.3g} m"
    else:
        return
    yield Finding("inertia-size", f"{place} / inertia", message)


def _check_shapes(link: Link, length: float) -> Iterator[Finding]:
    """Check that no shape is far outside of the robot."""
    groups: Mapping[str, Sequence[Visual | Collision]] = {"visual": link.visuals, "collision": link.collisions}
    for kind, shapes in groups.items():
        for number, shape in enumerate(shapes, start=1):
            away, far = math.hypot(*shape.origin.xyz), max(_FAR * length, _FAR_AWAY)
            if length and away > far:
                extent = _extent(shape.geometry)
                if away - (extent if math.isfinite(extent) else 0) > far:
                    place = f"link {link.name} / {kind} {number}"
                    message = f"{place} is {away:.3g} m away from its link, in a robot of {length:.3g} m"
                    yield Finding("shape-far", f"{place} / origin", message)


def _check_angles(path: str, origin: Origin) -> Iterator[Finding]:
    """Check that an orientation is not in degrees, as whole numbers of more than a turn in rad would show."""
    widest = max(map(abs, origin.rpy))
    if math.tau < widest <= _TWO_TURNS_IN_DEGREES and all(angle.is_integer() for angle in origin.rpy):
        shown = " ".join(f"{angle:g}" for angle in origin.rpy)
        yield Finding("angle-unit", f"{path} / origin", f"{path}: the angles {shown} rad may be in degrees")


def _check_limits(joint: Joint, length: float, mass: float) -> Iterator[Finding]:
    """Check that place and limits of a joint are plausible in SI units.

    `mass` is the mass of the child link. Slides with massless links may let a whole robot move anywhere, so any limit
    will do.
    """
    path, away = f"joint {joint.name}", math.hypot(*joint.origin.xyz)
    if away > _LONG_JOINT:
        message = f"{path} is {away:.6g} m away from its parent: lengths may be in millimetres"
        yield Finding("length-unit", f"{path} / origin", message)
    limit, kind = joint.limit, JOINT_KINDS[joint.type]
    if limit is None or not kind.has_limits:
        return
    place, widest = f"{path} / limit", max(abs(limit.lower), abs(limit.upper))
    if kind.motion == "rotational":
        is_whole = limit.lower.is_integer() and limit.upper.is_integer()
        if is_whole and _FOUR_TURNS < widest <= _TWO_TURNS_IN_DEGREES:
            message = f"{path}: limits of {limit.lower:g} and {limit.upper:g} rad may be in degrees"
            yield Finding("angle-unit", place, message)
    elif max(_LONG_SLIDE, _LONG_SLIDE * length) < widest <= _LONGEST_SLIDE and mass > _LIGHT:
        message = f"{path}: limits of {limit.lower:g} and {limit.upper:g} m may be in millimetres"
        yield Finding("length-unit", place, message)


def _gyration(inertial: Inertial) -> float:
    """Return the root mean square distance of the mass from its centre in m; 0 without mass or inertia."""
    inertia = inertial.inertia
    trace = max(inertia.ixx + inertia.iyy + inertia.izz, 0.0)
    return math.sqrt(trace / 2 / inertial.mass) if inertial.mass else 0.0


def _radius(link: Link) -> float:
    """Return the reach of a link's shapes from its centre of mass, in m; infinite with a mesh, 0 without shapes."""
    centre = link.inertial.origin.xyz if link.inertial else (0.0, 0.0, 0.0)
    shapes: Sequence[Visual | Collision] = (*link.visuals, *link.collisions)
    return max((math.dist(shape.origin.xyz, centre) + _extent(shape.geometry) for shape in shapes), default=0.0)


def _extent(geometry: Geometry) -> float:
    """Return the reach of a shape from its own origin, in m. A mesh is not read yet and counts as infinite."""
    match geometry:
        case Box(size=size):
            return math.hypot(*size) / 2
        case Cylinder(radius=radius, length=length):
            return math.hypot(radius, length / 2)
        case Capsule(radius=radius, length=length):
            return radius + length / 2
        case Sphere(radius=radius):
            return radius
        case Mesh():
            return math.inf
