"""Template data of a link's visuals and collisions, and the height of a robot that stands on its collisions."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeAlias

import msgspec

from urdfsync.domain import Import, further_key
from urdfsync.formats.urdf.kinematics.poses import compose, dot, link_poses, pose, start_positions
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.meshes import lookup
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import (
    Box,
    Capsule,
    Collision,
    Contact,
    Cylinder,
    Ellipsoid,
    Geometry,
    Link,
    Mesh,
    Origin,
    Primitive,
    Sphere,
    Visual,
    by_number,
)

_Body: TypeAlias = Primitive | Sequence[Sequence[float]]
GREY = (180, 180, 180)
PINK = (255, 105, 180)
_ROW = 30  # distance of the shapes in the link's diagram


class ModelShape(msgspec.Struct, frozen=True):
    """A shape in the model of a link, without numbers of the URDF."""

    component: str
    type: str
    """The class in the library's `Records` and `Visualizers`."""
    label: str
    is_collision: bool
    y: int
    """The height of the component in the link's diagram."""


class DrawnShape(msgspec.Struct, frozen=True):
    """A collision, or a visual in one colour: a mesh with several colours gives several."""

    model: ModelShape
    title: str
    origin: Origin
    geometry: Geometry
    color: Sequence[int]
    opacity: float
    uri: str = ""
    """The imported file of a mesh."""
    bounds: Sequence[Sequence[float]] = ()
    """The lowest and the greatest coordinates in this file."""
    hull: Sequence[Sequence[float]] = ()
    """The outermost points of a mesh that can touch the ground."""
    touches: bool = False
    """Whether the shape is a collision that can touch the ground."""


def link_shapes(
    link: Link, imports: Mapping[str, Import], package: str, options: Options
) -> tuple[list[DrawnShape], list[DrawnShape]]:
    """Return a link's visuals and collisions.

    A shape whose mesh is not imported is left out; it has a number, so other shapes keep their names if the mesh is
    found later. If the base is floating, each collision can touch the ground, except a mesh without
    outermost points.
    """
    visuals, collisions = list[DrawnShape](), list[DrawnShape]()
    for number, visual in by_number(link.visuals).items():
        parts = _colored_parts(visual, imports)
        for part, (file, color, opacity) in enumerate(parts, 1):
            model = _model(visual, number, part if len(parts) > 1 else 0, _ROW * (len(visuals) + 1))
            visuals.append(_drawn(visual, model, file, package, color, opacity))
    for number, collision in by_number(link.collisions if options.collisions else ()).items():
        for file in _files(collision.geometry, imports):
            model = _model(collision, number, 0, -_ROW * (len(collisions) + 1))
            shape = _drawn(collision, model, file, package, PINK, 0.5)
            if options.base == "floating":
                points = hull(collision.geometry, imports)
                touches = bool(points) or not isinstance(collision.geometry, Mesh)
                shape = msgspec.structs.replace(shape, hull=points, touches=touches)
            collisions.append(shape)
    return visuals, collisions


def link_model(
    visuals: Sequence[DrawnShape], collisions: Sequence[DrawnShape], contact: Contact | None = None
) -> dict[str, Any]:
    """Return the structure of a link for its model.

    Each collision that can touch the ground has a contact. From `contact`, the model needs only the names of the given
    numbers.
    """
    drawn, hidden = [shape.model for shape in visuals], [shape.model for shape in collisions]
    contacts = [
        {
            "component": model.component.replace("collision", "contact"),
            "type": "Points" if model.type == "Mesh" else model.type,
            "record": model.component,
            "y": model.y,
        }
        for model in (shape.model for shape in collisions if shape.touches)
    ]
    return {
        "visuals": drawn,
        "collisions": hidden,
        "contacts": contacts,
        "surface": list(msgspec.to_builtins(contact)) if contact and contacts else [],
        "top": max([100, *(shape.y + 20 for shape in drawn)]),
        "bottom": min([-100, *(shape.y - 20 for shape in hidden)]),
    }


def hull(geometry: Geometry, imports: Mapping[str, Import]) -> Sequence[Sequence[float]]:
    """Return the outermost points of an imported mesh, in metres; empty for any other shape."""
    file = imports.get(lookup.key(geometry)) if isinstance(geometry, Mesh) else None
    return file.facts["hull"] if file else ()


def touching(link: Link, imports: Mapping[str, Import]) -> Iterator[tuple[Origin, _Body]]:
    """Yield the poses and shapes of collisions that can touch the ground; a mesh as its outermost points."""
    for shape in link.collisions:
        if not isinstance(shape.geometry, Mesh):
            yield shape.origin, shape.geometry
        elif points := hull(shape.geometry, imports):
            yield shape.origin, points


def standing_height(tree: KinematicTree, imports: Mapping[str, Import]) -> float | None:
    """Return the height of the root frame when the lowest collision shape begins to press on the ground.

    A mesh touches with its outermost points. None without a shape, or if the places of all shapes are infinite.
    """
    poses = link_poses(tree, start_positions(tree))
    heights = []
    for link in tree.links:
        free = (link.contact and link.contact.min_depth) or 0.0
        for origin, shape in touching(link, imports):
            (_, _, up), (_, _, height) = compose(poses[link.name], pose(origin))
            height += free
            match shape:
                case Box(size=size):
                    heights.append(height - sum(abs(a) * edge / 2 for a, edge in zip(up, size, strict=True)))
                case Sphere(radius=radius):
                    heights.append(height - radius)
                case Ellipsoid(radii=radii):
                    heights.append(height - math.hypot(*(a * radius for a, radius in zip(up, radii, strict=True))))
                case Capsule(radius=radius, length=length):
                    heights.append(height - abs(up[2]) * length / 2 - radius)
                case Cylinder(radius=radius, length=length):
                    heights.append(height - abs(up[2]) * length / 2 - radius * math.hypot(up[0], up[1]))
                case points:
                    heights += [height + dot(up, point) for point in points]
    lowest = min(filter(math.isfinite, heights), default=None)
    # the last digits of sines differ between machines
    return None if lowest is None else round(-lowest, 12)


def _files(geometry: Geometry, imports: Mapping[str, Import]) -> list[Import | None]:
    """Return the imported file of a mesh, None for any other shape, or nothing for a mesh that is not imported."""
    if not isinstance(geometry, Mesh):
        return [None]
    file = imports.get(lookup.key(geometry))
    return [file] if file else []


def _colored_parts(visual: Visual, imports: Mapping[str, Import]) -> list[tuple[Import | None, Sequence[int], float]]:
    """Return the parts of a visual, each with its file, its colour and its opacity."""
    files = _files(visual.geometry, imports)
    if visual.material is not None and visual.material.rgba is not None:
        *tones, opacity = (min(max(part, 0.0), 1.0) for part in visual.material.rgba)
        return [(file, tuple(round(255 * tone) for tone in tones), opacity) for file in files]
    if not isinstance(visual.geometry, Mesh) or not files:
        return [(file, GREY, 1.0) for file in files]
    key = lookup.key(visual.geometry)
    facts = imports[key].facts
    colors = [tuple(color or GREY) for color in facts.get(lookup.PARTS) or facts.get(lookup.COLORS) or [None]]
    if len(colors) > 1:
        keys = [key, *(further_key(key, part) for part in range(1, len(colors) + 1))]
        if lookup.COLORS in facts:
            del keys[0]  # the whole mesh, which other shapes use
        files = [imports[name] for name in keys[: len(colors)]]
    return [(file, color, 1.0) for file, color in zip(files, colors, strict=True)]


def _model(shape: Visual | Collision, number: int, part: int, y: int) -> ModelShape:
    """Return a shape of a link's model; `part` is 0 for a shape of one colour."""
    word, ending, colour = type(shape).__name__, f"_{part}" if part else "", f", colour {part}" if part else ""
    component, label = f"{word.lower()}{number}{ending}", f"{word} {number}{colour}"
    return ModelShape(component, type(shape.geometry).__name__, label, isinstance(shape, Collision), y)


def _drawn(
    shape: Visual | Collision,
    model: ModelShape,
    file: Import | None,
    package: str,
    color: Sequence[int],
    opacity: float,
) -> DrawnShape:
    title = f'{model.label}: "{shape.name}"' if shape.name else model.label
    uri, bounds = (f"modelica://{package}/{file.target}", file.facts["bounds"]) if file else ("", ())
    return DrawnShape(model, title, shape.origin, shape.geometry, color, opacity, uri, bounds)
