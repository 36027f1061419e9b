"""Measures the shapes of links; finds shapes far outside of the robot."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple, TypeAlias

from urdfsync.domain import Import, further_key
from urdfsync.formats.urdf.kinematics.poses import moved, pose
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.meshes.lookup import BOUNDS, PARTS, VOLUME, key, mesh
from urdfsync.formats.urdf.robot import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Ellipsoid,
    Inertial,
    Link,
    Mesh,
    Primitive,
    Sphere,
    Vector,
    Visual,
)
from urdfsync.formats.urdf.validate import Finding

LIGHT = 0.05
"""In kg: a lighter part may only mark a place, and its numbers need not be exact."""
TUNGSTEN = 20_000
"""In kg/m³: no body is denser."""
_FAR, _FAR_AWAY = 10, 2
"""A shape is too far from its link if its distance exceeds ten lengths of the robot and two metres."""
_BESIDE, _BESIDE_PART = 0.01, 0.2
"""A collision shape is beside an equal visual shape by 1 cm and a fifth of its reach."""
_TOO_LARGE, _LARGEST = 20, 2.0
"""A mesh of more than 20 lengths of the robot and more than 2 m is probably in another unit."""
_SCALES = (0.001, 0.01, 0.0254)
"""In m: a millimetre, a centimetre and an inch. Most programs export millimetres."""


_Bounds: TypeAlias = tuple[Sequence[float], Sequence[float]]


class Extent(NamedTuple):
    """Place and size of a shape, in its link's frame."""

    center: Vector
    reach: float
    """In m, from the center; infinite for a mesh that is not in the package."""
    volume: float
    """In m³; infinite for such a mesh, 0 for an open one."""


class LinkShape(NamedTuple):
    """A link with its inertia and the extents of its shapes."""

    link: Link
    visuals: tuple[Extent, ...]
    collisions: tuple[Extent, ...]
    mass: float
    """In kg; 0 without an `<inertial>`."""
    gyration: float
    """In m: the root mean square distance of the mass from its centre; 0 without mass or inertia."""
    radius: float
    """In m: the reach of all shapes from the centre of mass; infinite if unknown, 0 without shapes."""

    @property
    def inertial(self) -> Inertial | None:
        """The link's inertia."""
        return self.link.inertial

    @property
    def has_meshes(self) -> bool:
        """Whether a shape is a mesh."""
        shapes: Sequence[Visual | Collision] = (*self.link.visuals, *self.link.collisions)
        return any(isinstance(shape.geometry, Mesh) for shape in shapes)

    @property
    def volumes(self) -> list[float]:
        """In m³: of the visual and of the collision shapes, which may be simplified; empty if one is unknown."""
        groups = [group for group in (self.visuals, self.collisions) if group]
        are_known = all(0 < shape.volume < math.inf for group in groups for shape in group)
        return [sum(shape.volume for shape in group) for group in groups] if are_known else []


def find_length(tree: KinematicTree) -> float:
    """Return the length of a robot's longest chain, in m: the sum of the distances from joint to joint."""
    distances = {tree.links[0].name: 0.0}
    for joint in tree.joints:
        distances[joint.child] = distances[joint.parent] + math.hypot(*joint.origin.xyz)
    return max(distances.values())


def find_bodies(tree: KinematicTree, imports: Mapping[str, Import], length: float) -> Mapping[str, LinkShape]:
    """Return the bodies of links of a robot of this length by name; `imports` have the facts of meshes."""
    largest, bodies = _largest(length), {}
    for link in tree.links:
        visuals = tuple(_extent(shape, imports, largest) for shape in link.visuals)
        collisions = tuple(_extent(shape, imports, largest) for shape in link.collisions)
        mass, gyration, center = 0.0, 0.0, (0.0, 0.0, 0.0)
        if link.inertial is not None:
            mass, center, inertia = link.inertial.mass, link.inertial.origin.xyz, link.inertial.inertia
            gyration = math.sqrt(max(inertia.trace, 0.0) / 2 / mass) if mass else 0.0
        radii = (math.dist(shape.center, center) + shape.reach for shape in (*visuals, *collisions))
        bodies[link.name] = LinkShape(link, visuals, collisions, mass, gyration, max(radii, default=0.0))
    return bodies


def _extent(shape: Visual | Collision, imports: Mapping[str, Import], largest: float) -> Extent:
    """Return the extent of a shape; a mesh larger than `largest` is in another unit, and its size unknown."""
    geometry, place = shape.geometry, shape.origin.xyz
    if not isinstance(geometry, Mesh):
        return Extent(place, _reach(geometry), volume(geometry))
    (lower, upper), enclosed = _measured(geometry, imports) or (((), ()), math.inf)
    size = math.dist(lower, upper)
    if not lower or size > largest:
        return Extent(place, math.inf, math.inf)
    x, y, z = ((a + b) / 2 for a, b in zip(lower, upper, strict=True))
    return Extent(moved(pose(shape.origin), (x, y, z)), size / 2, enclosed)


def find_far_shapes(bodies: Mapping[str, LinkShape], length: float) -> Iterator[Finding]:
    """Yield a finding for each shape far outside of a robot of this length."""
    far = max(_FAR * length, _FAR_AWAY)
    for body in bodies.values() if length else ():
        for (place, shape), extent in zip(_places(body.link), (*body.visuals, *body.collisions), strict=True):
            away = math.hypot(*shape.origin.xyz)
            if away - (extent.reach if math.isfinite(extent.reach) else 0) > far:
                message = f"{place} is {away:.3g} m away from its link, in a robot of {length:.3g} m"
                yield Finding("shape-far", f"{place} / origin", message)


def find_displaced_collisions(bodies: Mapping[str, LinkShape]) -> Iterator[Finding]:
    """Yield a finding for each link whose one collision shape equals its one visual shape, but stands beside it."""
    for name, body in bodies.items():
        visuals, collisions = body.link.visuals, body.link.collisions
        if len(visuals) == len(collisions) == 1 and visuals[0].geometry == collisions[0].geometry:
            (visual,), (collision,) = body.visuals, body.collisions
            away = math.dist(visual.center, collision.center)
            is_simple = not isinstance(visuals[0].geometry, Mesh | Sphere)  # spheres may touch the ground
            if is_simple and away > max(_BESIDE, _BESIDE_PART * visual.reach):
                place = f"link {name} / collision 1"
                message = f"link {name}: its visual and its collision shape have one form, but are {away:.3g} m apart"
                yield Finding("collision-beside", f"{place} / origin", message)


def find_large_meshes(tree: KinematicTree, imports: Mapping[str, Import], length: float) -> Iterator[Finding]:
    """Yield a finding for each mesh that is too large for a robot of this length, at its first shape."""
    sizes = {key: math.dist(*file.facts[BOUNDS]) for key, file in imports.items() if file.facts.get(BOUNDS)}
    large = {key: size for key, size in sizes.items() if size > _largest(length)}
    if not large:
        return
    for link in tree.links:
        for place, shape in _places(link):
            found = key(shape.geometry) if isinstance(shape.geometry, Mesh) else ""
            if size := large.pop(found, 0.0):
                fitting = [scale for scale in _SCALES if length / _TOO_LARGE < size * scale < _TOO_LARGE * length]
                factors = " ".join(f"{factor * fitting[0]:g}" for factor in mesh(found).scale) if fitting else ""
                message = f"mesh `{mesh(found).filename}` is {size:.3g} m large in a robot of {length:.3g} m"
                hint = f'write scale="{factors}", or export it in m' if len(fitting) == 1 else ""
                yield Finding("mesh-size", f"{place} / geometry", message, hint)


def _places(link: Link) -> Iterator[tuple[str, Visual | Collision]]:
    """Yield the path of each shape, with the shape: visual shapes first."""
    yield from ((f"link {link.name} / visual {number}", shape) for number, shape in enumerate(link.visuals, start=1))
    yield from ((f"link {link.name} / collision {number}", shape) for number, shape in enumerate(link.collisions, 1))


def _measured(mesh: Mesh, imports: Mapping[str, Import]) -> tuple[_Bounds, float] | None:
    """Return bounds and volume of a mesh in the package; None without bounds."""
    whole = key(mesh)
    files = [imports[whole]] if whole in imports else []
    if files and PARTS in files[0].facts:  # one file for each colour
        further = (further_key(whole, number) for number in range(1, len(files[0].facts[PARTS])))
        files += [imports[name] for name in further if name in imports]
    if not files or not all(file.facts.get(BOUNDS) for file in files):
        return None
    lower = [min(coordinates) for coordinates in zip(*(file.facts[BOUNDS][0] for file in files), strict=True)]
    upper = [max(coordinates) for coordinates in zip(*(file.facts[BOUNDS][1] for file in files), strict=True)]
    volumes = [file.facts.get(VOLUME, 0.0) for file in files]
    return (lower, upper), sum(volumes) if all(volumes) else 0.0


def _largest(length: float) -> float:
    return max(_LARGEST, _TOO_LARGE * length) if length else math.inf


def _reach(geometry: Primitive) -> float:
    match geometry:
        case Box(size=size):
            return math.hypot(*size) / 2
        case Cylinder(radius=radius, length=length):
            return math.hypot(radius, length / 2)
        case Capsule(radius=radius, length=length):
            return radius + length / 2
        case Sphere(radius=radius):
            return radius
        case Ellipsoid(radii=radii):
            return max(radii)


def volume(geometry: Primitive) -> float:
    """Return the volume of a simple shape in m³."""
    match geometry:
        case Box(size=(x, y, z)):
            return x * y * z
        case Cylinder(radius=radius, length=length):
            return math.pi * radius * radius * length
        case Capsule(radius=radius, length=length):
            return math.pi * radius * radius * (length + 4 / 3 * radius)
        case Sphere(radius=radius):
            return 4 / 3 * math.pi * radius * radius * radius
        case Ellipsoid(radii=(a, b, c)):
            return 4 / 3 * math.pi * a * b * c
