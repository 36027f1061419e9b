"""Finds inertias that no body has, or that are not those of the link's shapes."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import msgspec

from urdfsync.formats.urdf.kinematics.poses import Matrix, dot, pose, principal_moments, turned_inertia
from urdfsync.formats.urdf.plausibility.shapes import LIGHT, TUNGSTEN, LinkShape, volume
from urdfsync.formats.urdf.robot import Box, Collision, Cylinder, Inertia, Inertial, Origin, Sphere, Vector, Visual
from urdfsync.formats.urdf.validate import Finding

_GYRATION, _GYRATION_IN_MOTION = 3, 1.5
"""Greatest radius of gyration, relative to the distance of a body's farthest point; also of one behind a moving joint.

A real body has at most 1, but its shapes may be simplified.
"""
_MARKER = 0.002
"""In m: a smaller shape only marks a place, and the size of its body is unknown."""
_UNKNOWN_GYRATION, _UNKNOWN_SIZE = 10, 0.5
"""Greatest radius of gyration of a body of unknown size, in lengths of the robot, and the least length in m."""
_POINT = 1e-6
"""In m: a smaller radius of gyration is a rounding error of 0."""
_TOLERANCE = 1e-6
"""Relative to the largest principal moment."""
_OUTSTANDING = 5
"""A missing point makes a number of an inertia so much larger than all others, or more."""
_FITS, _DIFFERS = 0.05, 0.2
"""Inertias are the same up to 5 % of their largest moment, and differ from 20 % on."""
_BESIDE = 0.25
"""A centre of mass is beside a shape, whose inertia it has, by a quarter of the shape's reach."""


def find_wrong_inertia(body: LinkShape, inertial: Inertial, length: float, *, is_moving: bool) -> Iterator[Finding]:
    """Yield a finding if no body of the link's shapes has its inertia, in a robot of this length in m.

    `is_moving` tells whether a joint moves the link.
    """
    place = f"link {body.link.name} / inertial"
    if impossible := _impossible(inertial, place):
        yield impossible
    elif not body.mass:
        return
    elif words := _wrong_size(body, inertial, length, is_moving=is_moving):
        yield Finding("inertia-size", f"{place} / inertia", f"{place}: {words}")
    elif words := _misfit(body, inertial):
        yield Finding("inertia-shape", f"{place} / inertia", f"{place}: {words}")


def _wrong_size(body: LinkShape, inertial: Inertial, length: float, *, is_moving: bool) -> str:
    """Return why no body of the link's size has its radius of gyration, in words; empty if one can have it.

    A mass without shape and inertia away from the link's frame may be the point mass of a pendulum.
    """
    gyration, radius = body.gyration, body.radius
    is_in_joint = is_moving and math.hypot(*inertial.origin.xyz) < _POINT
    # a ball of tungsten is the smallest body
    least = math.sqrt(0.6) * math.cbrt(3 * body.mass / (4 * math.pi * TUNGSTEN)) / 2 if is_moving else _POINT
    factor = _GYRATION_IN_MOTION if is_moving and body.mass > LIGHT else _GYRATION
    if gyration < least and (radius or is_in_joint) and body.mass > LIGHT:
        shape = " with a shape" if radius else ""
        if gyration < _POINT:
            return f"a body of {body.mass:g} kg{shape} has no inertia"
        return f"with a radius of gyration of {gyration:.2g} m, a body of {body.mass:g} kg is denser than tungsten"
    if _MARKER < radius < math.inf and gyration > factor * radius:
        return f"the radius of gyration is {gyration:.3g} m, but the link's shapes reach only {radius:.3g} m"
    if not _MARKER < radius < math.inf and gyration > _UNKNOWN_GYRATION * max(length, _UNKNOWN_SIZE):
        return f"the radius of gyration is {gyration:.3g} m in a robot of {length:.3g} m"
    return ""


class _Solid(NamedTuple):
    """A part of a body of one density, in the link's frame."""

    mass: float
    origin: Origin
    own: Inertia
    """The inertia about the origin, in its axes."""


def _misfit(body: LinkShape, inertial: Inertial) -> str:
    """Return to what other body of the link's simple shapes the inertia belongs, in words; empty if unknown."""
    center, inertia, trace = inertial.origin.xyz, inertial.inertia, inertial.inertia.trace
    bodies = _bodies(body)
    # traces need no rotations: mostly they show that the inertia belongs to none of these bodies
    if not any(abs(trace - likely) < 2 * _FITS * trace for solids in bodies for likely in _likely_traces(solids)):
        return ""
    given = turned_inertia(pose(inertial.origin)[0], inertia)
    size = max(given[k][k] for k in range(3))

    def error(other: Matrix) -> float:
        pairs = zip(itertools.chain(*given), itertools.chain(*other), strict=True)
        return max(abs(a - b) for a, b in pairs) / size

    if any(error(_joined(solids, center)) < _DIFFERS for solids in bodies):
        return ""
    for solids in bodies:
        if error(_joined(solids, (0.0, 0.0, 0.0))) < _FITS and math.hypot(*center) > 0:
            return "the inertia fits the shapes about the link's origin, not about the centre of mass"
        away, (_, origin, own) = math.dist(solids[0].origin.xyz, center), solids[0]
        if error(_joined([_moved(solid, center) for solid in solids], center)) < _FITS:
            if len(solids) > 1:
                return "the inertia fits the sum of the shapes' own, without the terms of their distances"
            if away > _BESIDE * max(body.visuals + body.collisions, key=lambda extent: extent.reach).reach:
                return f"the inertia fits the shape, but the centre of mass is {away:.3g} m beside it"
        if len(solids) == 1 and away < _FITS * body.radius:
            for x, y, z in itertools.permutations((own.ixx, own.iyy, own.izz)):
                if error(turned_inertia(pose(origin)[0], Inertia(ixx=x, iyy=y, izz=z))) < _FITS:
                    return "the inertia fits the shape with its axes exchanged"
    return ""


def _bodies(body: LinkShape) -> list[list[_Solid]]:
    """Return the bodies of the collision and of the visual shapes, as solids of one density with the link's mass.

    A mesh, a capsule or an ellipsoid is no solid. Shapes that differ in nothing are one body.
    """
    forms: list[list[tuple[Box | Cylinder | Sphere, Origin]]] = []
    groups: Sequence[Sequence[Visual | Collision]] = (body.link.collisions, body.link.visuals)
    for shapes in groups:
        form = [(one.geometry, one.origin) for one in shapes if isinstance(one.geometry, Box | Cylinder | Sphere)]
        if len(form) == len(shapes) and form not in forms:
            forms.append(form)
    bodies = []
    for form in forms:
        volumes = [volume(geometry) for geometry, _ in form]
        masses = [body.mass * part / sum(volumes) for part in volumes if sum(volumes)]
        solids = [_Solid(mass, origin, _own_inertia(one, mass)) for mass, (one, origin) in zip(masses, form)]  # noqa: B905
        bodies += [solids] if solids else []
    return bodies


def _likely_traces(solids: Sequence[_Solid]) -> tuple[float, float]:
    """Return the traces of two wrong inertias: about the link's origin, and without the terms of distances."""
    own = sum(solid.own.trace for solid in solids)
    return own, own + sum(2 * solid.mass * dot(solid.origin.xyz, solid.origin.xyz) for solid in solids)


def _joined(solids: Sequence[_Solid], point: Vector) -> Matrix:
    """Return the inertia of solids about a point, by the parallel axis theorem."""
    xx = yy = zz = xy = xz = yz = 0.0
    for mass, origin, own in solids:
        tensor = turned_inertia(pose(origin)[0], own)
        x, y, z = (a - b for a, b in zip(origin.xyz, point, strict=True))
        xx += tensor[0][0] + mass * (y * y + z * z)
        yy += tensor[1][1] + mass * (x * x + z * z)
        zz += tensor[2][2] + mass * (x * x + y * y)
        xy += tensor[0][1] - mass * x * y
        xz += tensor[0][2] - mass * x * z
        yz += tensor[1][2] - mass * y * z
    return (xx, xy, xz), (xy, yy, yz), (xz, yz, zz)


def _moved(solid: _Solid, point: Vector) -> _Solid:
    return solid._replace(origin=Origin(xyz=point, rpy=solid.origin.rpy))


def _own_inertia(geometry: Box | Cylinder | Sphere, mass: float) -> Inertia:
    """Return the inertia of a solid box, cylinder or sphere about its centre."""
    match geometry:
        case Box(size=(x, y, z)):
            a, b, c = mass * (y * y + z * z) / 12, mass * (x * x + z * z) / 12, mass * (x * x + y * y) / 12
        case Cylinder(radius=radius, length=length):
            a = b = mass * (3 * radius * radius + length * length) / 12
            c = mass * radius * radius / 2
        case Sphere(radius=radius):
            a = b = c = mass * radius * radius * 2 / 5
    return Inertia(ixx=a, iyy=b, izz=c)


def _impossible(inertial: Inertial, place: str) -> Finding | None:
    """Return the finding about an inertia that no body has: principal moments are positive, and form a triangle."""
    low, middle, high = principal_moments(inertial.inertia)
    tolerance = _TOLERANCE * max(abs(low), abs(high)) + max(inertial.mass, 0) * _POINT**2
    low, middle = (0.0 if abs(moment) < tolerance else moment for moment in (low, middle))
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
