"""Finds legal but implausible parts of a URDF: no inertia, numbers in another unit, a shape far outside of its link.

The bounds are wide, since a warning about a sound robot is worse than no warning.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from urdfsync.urdf.kinematics.poses import own_range
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
_TUNGSTEN, _AIR = 20_000, 1
"""In kg/m³: the bounds of densities."""
_LEAST_VOLUME = 1e-5
"""In m³: smaller shapes only mark a place."""
_POINT = 1e-6
"""In m: a smaller radius of gyration is a rounding error of 0."""
_SAME, _SWITCHED_OFF = 1e-3, 5
"""Soft limits may be outside by this part of the joint's range; far outside, in rad or m, they are switched off."""
_OUTSIDE, _OUTSIDE_AT_LEAST = 5, 0.5
"""A centre of mass is too far outside of shapes by five times the largest shape's reach and half a metre."""
_FOLLOWED = 0.02
"""A joint may follow another one outside of its limits by this part of its range."""
_LIGHT = 0.05
"""In kg: a lighter part may only mark a place, and may have an inertia of 0 by rounding."""


def find_implausible(tree: KinematicTree) -> Iterator[Finding]:
    """Yield a warning for each implausible part of a valid robot."""
    own_masses = {link.name: link.inertial.mass if link.inertial else 0.0 for link in tree.links}
    masses, length = dict(own_masses), find_length(tree)
    for joint in reversed(tree.joints):
        masses[joint.parent] += masses[joint.child]
    yield from _check_masses(tree, masses, length)
    yield from _check_densities(tree)
    yield from _check_efforts(tree)
    yield from _check_followers(tree)
    fixed = {joint.child for joint in tree.joints if joint.type == "fixed"}
    moving = {joint.child for joint in tree.joints} - fixed
    for link in tree.links:
        if link.inertial is not None and link.inertial.mass:
            yield from _check_inertia(link, link.inertial, length, link.name in moving)
            yield from _check_centre(link, link.inertial, length)
            yield from _check_angles(f"link {link.name} / inertial", link.inertial.origin)
        elif link.inertial is not None and link.collisions and link.name not in fixed:
            message = f"link {link.name!r} has a mass of 0 and a collision shape: a frame has no shape, a body a mass"
            yield Finding("no-inertia", f"link {link.name} / inertial", message, "state the mass and the inertia")
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


def _check_inertia(link: Link, inertial: Inertial, length: float, is_moving: bool) -> Iterator[Finding]:
    """Check that a body of the link's size can have its radius of gyration; the link has a mass.

    A mass without shape and inertia away from the link's frame may be the point mass of a pendulum.
    """
    gyration, radius, place = _gyration(inertial), _radius(link), f"link {link.name} / inertial"
    is_in_joint = is_moving and math.hypot(*inertial.origin.xyz) < _POINT
    if gyration < _POINT and (radius or is_in_joint) and inertial.mass > _LIGHT:
        shape = " with a shape" if radius else ""
        message = f"{place}: a body of {inertial.mass:g} kg{shape} has no inertia"
    elif _MARKER < radius < math.inf and gyration > _GYRATION * radius:
        message = (
            f"{place}: the radius of gyration is {gyration:.3g} m, but the link's shapes reach only {radius:.3g} m"
        )
    elif not _MARKER < radius < math.inf and gyration > _UNKNOWN_GYRATION * max(length, _UNKNOWN_SIZE):
        message = f"{place}: the radius of gyration is {gyration:.3g} m in a robot of {length:.3g} m"
    else:
        return
    yield Finding("inertia-size", f"{place} / inertia", message)


def _check_centre(link: Link, inertial: Inertial, length: float) -> Iterator[Finding]:
    """Check that the centre of mass is not far outside of the link's shapes, nor of the robot."""
    centre, place = inertial.origin.xyz, f"link {link.name} / inertial"
    shapes: Sequence[Visual | Collision] = (*link.visuals, *link.collisions)
    reach = max((_extent(shape.geometry) for shape in shapes), default=0.0)
    gap = min((math.dist(shape.origin.xyz, centre) - _extent(shape.geometry) for shape in shapes), default=0.0)
    away, far = math.hypot(*centre), max(_FAR * length, _FAR_AWAY) if length and not shapes else _LONG_JOINT
    if reach > _MARKER and gap > max(_OUTSIDE * reach, _OUTSIDE_AT_LEAST):
        message = f"{place}: the centre of mass is {gap:.4g} m outside of shapes that reach {reach:.3g} m"
    elif away > far:
        message = f"{place}: the centre of mass is {away:.6g} m away from its link, in a robot of {length:.3g} m"
    else:
        return
    yield Finding("length-unit", f"{place} / origin", f"{message}: lengths may be in millimetres")


def _check_densities(tree: KinematicTree) -> Iterator[Finding]:
    """Check that no body is denser than tungsten or lighter than air, where simple shapes around it tell its volume."""
    volumes = dict[str, float]()
    masses = {link.name: link.inertial.mass for link in tree.links if link.inertial}
    for link in tree.links:
        shapes: Sequence[Visual | Collision] = link.collisions or link.visuals
        if link.inertial and _gyration(link.inertial) < _radius(link) < math.inf:
            volumes[link.name] = sum(_volume(shape.geometry) for shape in shapes)
    volumes = {name: volume for name, volume in volumes.items() if volume > _LEAST_VOLUME}
    densities = sorted(masses[name] / volume for name, volume in volumes.items())
    for name, volume in volumes.items():
        density, usual = masses[name] / volume, densities[len(densities) // 2]
        if masses[name] > _LIGHT and not _AIR <= density <= _TUNGSTEN:
            message = f"link {name} / inertial: {masses[name]:.4g} kg in shapes of {volume * 1000:.3g} l are "
            message += f"{density:,.0f} kg/m³"
            if len(densities) > 1 and _AIR <= usual <= _TUNGSTEN:
                message += f"; as dense as other links, it would have {usual * volume:.3g} kg"
            yield Finding("density", f"link {name} / inertial / mass", message)


def _check_efforts(tree: KinematicTree) -> Iterator[Finding]:
    """Check that no joint has an effort of 0 beside others with more; a source may tell which joints are driven."""
    efforts = {joint.name: joint.limit.effort for joint in tree.joints if joint.limit and not joint.mimic}
    greatest = max((effort for effort in efforts.values() if effort), default=0.0)
    are_told = any(joint.actuated for joint in tree.joints)
    for joint in tree.joints if greatest else ():
        if efforts.get(joint.name) == 0 and (joint.actuated or not are_told):
            message = f"joint {joint.name} / limit has effort = 0: no drive moves it; another joint has {greatest:g}"
            yield Finding("zero-effort", f"joint {joint.name} / limit", message)


def _check_followers(tree: KinematicTree) -> Iterator[Finding]:
    """Check that no joint that follows another one leaves its own limits."""
    joints = {joint.name: joint for joint in tree.joints}
    for joint in tree.joints:
        if joint.mimic is not None:
            leader, (lower, upper) = own_range(joints[joint.mimic.joint]), own_range(joint)
            least, most = sorted(joint.mimic.multiplier * end + joint.mimic.offset for end in leader)
            past = max(lower - least, most - upper)
            if _FOLLOWED * (upper - lower) < past < math.inf:
                message = (
                    f"joint {joint.name} follows {joint.mimic.joint} from {least:.4g} to {most:.4g}, outside of its "
                )
                message += f"limits {lower:.4g} to {upper:.4g}"
                yield Finding("mimic-limits", f"joint {joint.name} / mimic", message)


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
    soft = joint.safety_controller
    if soft and soft.soft_lower_limit < soft.soft_upper_limit:
        past = max(limit.lower - soft.soft_lower_limit, soft.soft_upper_limit - limit.upper)
        if _SAME * (limit.upper - limit.lower) < past < _SWITCHED_OFF:
            message = f"{path}: the soft limits {soft.soft_lower_limit:g} to {soft.soft_upper_limit:g} are outside of "
            message += f"the limits {limit.lower:g} to {limit.upper:g}"
            yield Finding("soft-limits", f"{path} / safety_controller", message)
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


def _volume(geometry: Geometry) -> float:
    """Return the volume of a shape in m³; a mesh is not read yet and counts as infinite."""
    match geometry:
        case Box(size=(x, y, z)):
            return x * y * z
        case Cylinder(radius=radius, length=length):
            return math.pi * radius * radius * length
        case Capsule(radius=radius, length=length):
            return math.pi * radius * radius * (length + 4 / 3 * radius)
        case Sphere(radius=radius):
            return 4 / 3 * math.pi * radius * radius * radius
        case Mesh():
            return math.inf


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
