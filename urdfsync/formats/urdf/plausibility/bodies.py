"""Finds bodies that cannot be: masses, densities and centres of mass."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.plausibility.inertias import find_wrong_inertia
from urdfsync.formats.urdf.plausibility.shapes import LIGHT, TUNGSTEN, Extent, LinkShape
from urdfsync.formats.urdf.robot import Vector
from urdfsync.formats.urdf.validate import Finding

_DENSEST = 10_000
"""In kg/m³: the greatest density of a cube as large as the robot; steel has 7,900."""
_HEAVY = 500
"""In kg: the density of a lighter robot is not checked, since its size is uncertain."""
_AWAY, _FAR_AWAY, _FARTHEST = 10, 2, 50
"""A centre of mass is too far from a link without shapes by ten lengths of the robot and two metres, or by 50 m."""
_OUTSIDE, _OUTSIDE_AT_LEAST = 2.5, 0.1
"""A centre of mass is too far outside of shapes by 2.5 times the largest shape's reach and 10 cm.

Simplified shapes leave out motors: those of a published humanoid do so by 2.4 times.
"""
_AIR = 1
"""In kg/m³: no body is lighter."""
_METAL, _UNLIKE = 9_000, 5
"""A body is too dense beside others by five times their usual density, if it is denser than most metals, in kg/m³."""
_LEAST_VOLUME = 1e-5
"""In m³: smaller shapes only mark a place."""
_DUST = 1e-6
"""In kg: a lighter mass behind a moving joint stands for none."""


def find_impossible_bodies(tree: KinematicTree, bodies: Mapping[str, LinkShape], length: float) -> Iterator[Finding]:
    """Yield a finding for each body that cannot be, in a robot of this length in m."""
    yield from _check_masses(tree, bodies, length)
    yield from _check_densities(bodies)
    moving = {joint.child for joint in tree.joints if joint.type != "fixed"}
    rigid, masses = {tree.links[0].name: tree.links[0].name}, dict[str, float]()
    for joint in tree.joints:  # links joined by fixed joints are one body
        rigid[joint.child] = rigid[joint.parent] if joint.type == "fixed" else joint.child
    for name, body in bodies.items():
        masses[rigid[name]] = masses.get(rigid[name], 0.0) + body.mass
    for name, body in bodies.items():
        if body.inertial is None:
            continue
        yield from find_wrong_inertia(body, body.inertial, length, is_moving=name in moving)
        if body.mass:
            yield from _check_center(body, body.inertial.origin.xyz, length)
        elif body.link.collisions and not masses[rigid[name]]:
            message = f"link {name!r} has a mass of 0 and a collision shape: a frame has no shape, a body a mass"
            yield Finding("no-inertia", f"link {name} / inertial", message, "state the mass and the inertia")


def _check_masses(tree: KinematicTree, bodies: Mapping[str, LinkShape], length: float) -> Iterator[Finding]:
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
        mass, child = masses[joint.child], bodies[joint.child]
        if not mass and masses[joint.parent] and not (child.inertial and child.collisions):  # else the link is told
            message = f"joint {joint.name!r} moves no mass: no link behind it has an <inertial>"
            yield Finding("no-inertia", f"joint {joint.name}", message)
        elif 0 < mass < _DUST <= masses[joint.parent]:
            message = f"joint {joint.name!r} moves a mass of {mass:g} kg: a simulator may take it for none"
            yield Finding("no-inertia", f"joint {joint.name}", message)
    if total <= _HEAVY:
        return
    radii = [body.radius for body in bodies.values() if math.isfinite(body.radius)]
    size = 2 * max([length / 2, *radii, *(body.gyration for body in bodies.values())])
    if total > _DENSEST * size * size * size:  # `**` of a large number would raise an error
        message = f"the masses add up to {total:.6g} kg in a robot of {size:.3g} m: they may be in grams"
        yield Finding("mass-unit", "robot", message)


def _check_center(body: LinkShape, center: Vector, length: float) -> Iterator[Finding]:
    """Check that the centre of mass is not far outside of the link's shapes, nor of the robot.

    Without visual shapes, collision shapes may stand for a part of the link, such as a foot.
    """
    place, shapes = f"link {body.link.name} / inertial", (*body.visuals, *body.collisions) if body.visuals else ()
    reach = max((shape.reach for shape in shapes), default=0.0)
    is_inside = any(math.dist(shape.center, center) <= shape.reach for shape in shapes)
    gap = _distance_from_box(shapes, center) if shapes and not is_inside else 0.0
    away, far = math.hypot(*center), max(_AWAY * length, _FAR_AWAY) if length and not body.radius else _FARTHEST
    if body.mass > LIGHT and gap > max(_OUTSIDE * reach, _OUTSIDE_AT_LEAST):
        message = f"{place}: the centre of mass is {gap:.4g} m outside of shapes that reach {reach:.3g} m"
    elif away > far:
        message = f"{place}: the centre of mass is {away:.6g} m away from its link, in a robot of {length:.3g} m"
    else:
        return
    yield Finding("center-of-mass", f"{place} / origin", message)


def _distance_from_box(shapes: Sequence[Extent], point: Vector) -> float:
    """Return the distance of a point from a box around shapes, in m."""
    lowers = (min(shape.center[k] - shape.reach for shape in shapes) for k in range(3))
    uppers = (max(shape.center[k] + shape.reach for shape in shapes) for k in range(3))
    return math.hypot(*(max(lower - x, x - upper, 0.0) for lower, x, upper in zip(lowers, point, uppers, strict=True)))


def _check_densities(bodies: Mapping[str, LinkShape]) -> Iterator[Finding]:
    """Check that no body is denser than tungsten or lighter than air, where shapes around it tell its volume.

    Three bodies or more also tell a usual density.
    """
    measured = {
        name: body.volumes
        for name, body in bodies.items()
        if body.visuals and body.mass and body.gyration < body.radius
    }
    dense = {
        name: bodies[name].mass / max(volumes)
        for name, volumes in measured.items()
        if min(volumes, default=0.0) > _LEAST_VOLUME
    }
    usual = sorted(dense.values())[len(dense) // 2] if len(dense) > 1 else 0.0
    for name, density in dense.items():
        mass, volumes = bodies[name].mass, measured[name]
        # a mesh may show a part of its body only
        is_unlike = len(dense) > 2 and density > max(_METAL, _UNLIKE * usual) and not bodies[name].has_meshes
        if mass > LIGHT and not (mass / min(volumes) >= _AIR and density <= TUNGSTEN and not is_unlike):
            volume = max(volumes) if density > _AIR else min(volumes)
            shown = mass / volume
            message = f"link {name} / inertial: {mass:.4g} kg in shapes of {volume * 1000:.3g} l are "
            message += f"{shown:,.0f} kg/m³" if shown > 10 else f"{shown:.2g} kg/m³"
            if _AIR <= usual <= TUNGSTEN:
                message += f"; as dense as other links, it would have {usual * volume:.3g} kg"
            yield Finding("density", f"link {name} / inertial / mass", message)
