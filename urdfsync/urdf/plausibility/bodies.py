"""Finds bodies that cannot be: masses, inertias, densities and centres of mass."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import msgspec

from urdfsync.urdf.kinematics.poses import dot, pose, turned_inertia
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.plausibility.shapes import Body
from urdfsync.urdf.robot import Box, Cylinder, Geometry, Inertia, Inertial, Sphere, Vector
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
_AWAY, _FAR_AWAY, _FARTHEST = 10, 2, 50
"""A centre of mass is too far from a link without shapes by ten lengths of the robot and two metres, or by 50 m."""
_OUTSIDE, _OUTSIDE_AT_LEAST = 5, 0.5
"""A centre of mass is too far outside of shapes by five times the largest shape's reach and half a metre."""
_TUNGSTEN, _AIR = 20_000, 1
"""In kg/m³: the bounds of densities."""
_LEAST_VOLUME = 1e-5
"""In m³: smaller shapes only mark a place."""
_LIGHT = 0.05
"""In kg: a lighter part may only mark a place, and may have an inertia of 0 by rounding."""
_POINT = 1e-6
"""In m: a smaller radius of gyration is a rounding error of 0."""
_TOLERANCE = 1e-6
"""Relative to the largest principal moment."""
_EXACT = 1e-12
_OUTSTANDING = 5
"""A missing point makes a number of an inertia so much larger than all others, or more."""
_FITS, _DIFFERS = 0.05, 0.2
"""An inertia is about the link's origin if it fits its shape's by 5 % there, and differs by 20 % elsewhere."""


def find_impossible_bodies(tree: KinematicTree, bodies: Mapping[str, Body], length: float) -> Iterator[Finding]:
    """Yield a finding for each body that cannot be, in a robot of this length in m."""
    yield from _check_masses(tree, bodies, length)
    yield from _check_densities(bodies)
    fixed = {joint.child for joint in tree.joints if joint.type == "fixed"}
    moving = {joint.child for joint in tree.joints} - fixed
    for body in bodies.values():
        if body.inertial is None:
            continue
        name, place = body.link.name, f"link {body.link.name} / inertial"
        if problem := _impossible(body.inertial, place):
            yield problem
        elif body.mass:
            yield from _check_inertia(body, body.inertial, length, name in moving)
        elif body.link.collisions and name not in fixed:
            message = f"link {name!r} has a mass of 0 and a collision shape: a frame has no shape, a body a mass"
            yield Finding("no-inertia", place, message, "state the mass and the inertia")
        if body.mass:
            yield from _check_center(body, body.inertial.origin.xyz, length)


def _check_masses(tree: KinematicTree, bodies: Mapping[str, Body], length: float) -> Iterator[Finding]:
    """Check that each joint moves a mass, and that the robot is no denser than steel."""
    masses = {name: body.mass for name, body in bodies.items()}
    for joint in reversed(tree.joints):
        masses[joint.parent] += masses[joint.child]  # of the link and of all links behind it
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
    radii = [body.radius for body in bodies.values() if math.isfinite(body.radius)]
    size = 2 * max([length / 2, *radii, *(body.gyration for body in bodies.values())])
    if total > _DENSEST * size * size * size:  # `**` of a large number would raise an error
        message = f"the masses add up to {total:.6g} kg in a robot of {size:.3g} m: they may be in grams"
        yield Finding("mass-unit", "robot", message)


def _check_inertia(body: Body, inertial: Inertial, length: float, is_moving: bool) -> Iterator[Finding]:
    """Check that a body of the link's size can have its radius of gyration; the link has a mass.

    A mass without shape and inertia away from the link's frame may be the point mass of a pendulum.
    """
    gyration, radius, place = body.gyration, body.radius, f"link {body.link.name} / inertial"
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
    elif _is_about_origin(body, inertial):
        message = f"{place}: the inertia fits the shape about the link's origin, not about the centre of mass"
    else:
        return
    yield Finding("inertia-size", f"{place} / inertia", message)


def _is_about_origin(body: Body, inertial: Inertial) -> bool:
    """Whether the inertia of a link with one simple shape is that of the shape about the link's origin, by mistake.

    By the parallel axis theorem, it exceeds the inertia about the centre of mass by m·(|c|²·E - c·cᵀ).
    """
    shapes = body.link.collisions or body.link.visuals
    own = _own_inertia(shapes[0].geometry, inertial.mass) if len(shapes) == 1 else None
    center = inertial.origin.xyz
    if own is None or math.dist(shapes[0].origin.xyz, center) > _FITS * math.hypot(*center):
        return False
    given = turned_inertia(pose(inertial.origin)[0], inertial.inertia)
    about_center = turned_inertia(pose(shapes[0].origin)[0], own)
    square = inertial.mass * dot(center, center)
    about_origin = [
        [about_center[i][k] + (square if i == k else 0) - inertial.mass * center[i] * center[k] for k in range(3)]
        for i in range(3)
    ]

    def differ(one: Sequence[Sequence[float]], other: Sequence[Sequence[float]]) -> float:
        return max(abs(one[i][k] - other[i][k]) for i in range(3) for k in range(3))

    size = max(given[k][k] for k in range(3))
    return differ(given, about_origin) < _FITS * size and differ(given, about_center) > _DIFFERS * size


def _own_inertia(geometry: Geometry, mass: float) -> Inertia | None:
    """Return the inertia of a solid shape about its centre; None for a mesh or a capsule."""
    match geometry:
        case Box(size=(x, y, z)):
            a, b, c = mass * (y * y + z * z) / 12, mass * (x * x + z * z) / 12, mass * (x * x + y * y) / 12
        case Cylinder(radius=radius, length=length):
            a = b = mass * (3 * radius * radius + length * length) / 12
            c = mass * radius * radius / 2
        case Sphere(radius=radius):
            a = b = c = mass * radius * radius * 2 / 5
        case _:
            return None
    return Inertia(ixx=a, iyy=b, izz=c)


def _check_center(body: Body, center: Vector, length: float) -> Iterator[Finding]:
    """Check that the centre of mass is not far outside of the link's shapes, nor of the robot."""
    place, shapes = f"link {body.link.name} / inertial", (*body.visuals, *body.collisions)
    reach = max((shape.reach for shape in shapes), default=0.0)
    gap = min((math.dist(shape.center, center) - shape.reach for shape in shapes), default=0.0)
    away, far = math.hypot(*center), max(_AWAY * length, _FAR_AWAY) if length and not shapes else _FARTHEST
    if reach > _MARKER and gap > max(_OUTSIDE * reach, _OUTSIDE_AT_LEAST):
        message = f"{place}: the centre of mass is {gap:.4g} m outside of shapes that reach {reach:.3g} m"
    elif away > far:
        message = f"{place}: the centre of mass is {away:.6g} m away from its link, in a robot of {length:.3g} m"
    else:
        return
    yield Finding("length-unit", f"{place} / origin", f"{message}: lengths may be in millimetres")


def _check_densities(bodies: Mapping[str, Body]) -> Iterator[Finding]:
    """Check that no body is denser than tungsten or lighter than air, where shapes around it tell its volume."""
    dense = {
        name: body.mass / max(body.volumes)
        for name, body in bodies.items()
        if body.mass and body.gyration < body.radius and min(body.volumes, default=0.0) > _LEAST_VOLUME
    }
    usual = sorted(dense.values())[len(dense) // 2] if len(dense) > 1 else 0.0
    for name, density in dense.items():
        mass, volumes = bodies[name].mass, bodies[name].volumes
        volume = max(volumes) if density > _AIR else min(volumes)
        if mass > _LIGHT and not (mass / min(volumes) >= _AIR and density <= _TUNGSTEN):
            message = f"link {name} / inertial: {mass:.4g} kg in shapes of {volume * 1000:.3g} l are "
            message += f"{mass / volume:,.0f} kg/m³"
            if _AIR <= usual <= _TUNGSTEN:
                message += f"; as dense as other links, it would have {usual * volume:.3g} kg"
            yield Finding("density", f"link {name} / inertial / mass", message)


def _impossible(inertial: Inertial, place: str) -> Finding | None:
    """Return the finding about an inertia that no body has: principal moments are positive, and form a triangle."""
    low, middle, high = principal_moments(inertial.inertia)
    tolerance = _TOLERANCE * max(abs(low), abs(high)) + max(inertial.mass, 0) * _POINT**2
    moments = f"its principal moments are {low:.6g}, {middle:.6g} and {high:.6g} kg·m²"
    if low < -tolerance:
        code, message = "inertia-not-positive", f"the inertia is not positive semi-definite: {moments}"
    elif low + middle < high - tolerance:
        code, message = "inertia-triangle", f"no body has this inertia: {moments}"
        message += ", and the greatest exceeds the sum of the others"
    else:
        return None
    return Finding(code, f"{place} / inertia", f"{place}: {message}{_repair(inertial.inertia)}")


def _repair(inertia: Inertia) -> str:
    """Return the power of ten that repairs the one outstanding number of an impossible inertia, in words; or empty."""
    *_, (second, _), (largest, name) = sorted((abs(getattr(inertia, name)), name) for name in Inertia.__struct_fields__)
    for exponent in range(-1, -10, -1) if largest > _OUTSTANDING * second else ():
        scaled = getattr(inertia, name) * 10.0**exponent
        low, middle, high = principal_moments(msgspec.structs.replace(inertia, **{name: scaled}))
        if low >= 0 and high <= low + middle:
            return f"; {name} = {scaled:.6g} instead of {getattr(inertia, name):g} would fit"
    return ""


def principal_moments(inertia: Inertia) -> Vector:
    """Return the eigenvalues of the inertia tensor in ascending order, in kg·m².

    The trigonometric solution of the characteristic equation gives eight digits or more. The import of numpy would take
    longer than a build of a small robot.
    """
    values = msgspec.structs.astuple(inertia)
    scale = max(map(abs, values)) or 1.0  # without this, squares of large numbers overflow
    xx, xy, xz, yy, yz, zz = (value / scale for value in values)
    mean = (xx + yy + zz) / 3
    xx, yy, zz = xx - mean, yy - mean, zz - mean
    spread = math.sqrt((xx * xx + yy * yy + zz * zz + 2 * (xy * xy + xz * xz + yz * yz)) / 6)
    if spread < _EXACT:
        return mean * scale, mean * scale, mean * scale
    determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)
    angle = math.acos(min(max(determinant / 2 / spread**3, -1.0), 1.0)) / 3
    low, middle, high = sorted(mean + 2 * spread * math.cos(angle + turn * math.tau / 3) for turn in range(3))
    return low * scale, middle * scale, high * scale
