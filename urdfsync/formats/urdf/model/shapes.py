"""Template data of a link's visuals and collisions, and the height of a robot that stands on its collisions."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from msgspec import to_builtins

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
_IN_MODEL = ("component", "type", "label", "is_collision", "y")


def link_shapes(
    link: Link, imports: Mapping[str, Import], package: str, options: Options
) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Return a link's visuals and collisions, each with all data for models and records.

    A shape whose mesh is not imported is left out; it has a number, so other shapes keep their names if the mesh is
    found later. If the base is floating, each collision can touch the ground, except a mesh without
    outermost points.
    """
    visuals: list[dict[str, Any]] = []
    for number, visual in by_number(link.visuals).items():
        for part in _visual(number, visual, imports, package):
            part["y"] = _ROW * (len(visuals) + 1)
            visuals.append(part)
    collisions: list[dict[str, Any]] = []
    for number, collision in by_number(link.collisions if options.collisions else ()).items():
        if shape := _shape("collision", number, collision, imports, package):
            shape.update(y=-_ROW * (len(collisions) + 1), is_collision=True, color=PINK, opacity=0.5)
            if options.base == "floating":
                shape["hull"] = hull(collision.geometry, imports)
                shape["touches"] = not isinstance(collision.geometry, Mesh) or bool(shape["hull"])
            collisions.append(shape)
    return visuals, collisions


def link_model(
    visuals: Sequence[Mapping[str, Any]],
    collisions: Sequence[Mapping[str, Any]],
    contact: Contact | None = None,
) -> dict[str, Any]:
    """Return the structure of a link for its model, without numbers and names of the URDF.

    Each collision that can touch the ground has a contact; see `link_shapes`. From `contact`, the model needs only the
    names of the given numbers.
    """
    contacts = [
        {
            "component": shape["component"].replace("collision", "contact"),
            "type": "Points" if shape["type"] == "Mesh" else shape["type"],
            "record": shape["component"],
            "y": shape["y"],
        }
        for shape in collisions
        if shape["touches"]
    ]
    return {
        "visuals": [{key: shape[key] for key in _IN_MODEL} for shape in visuals],
        "collisions": [{key: shape[key] for key in _IN_MODEL} for shape in collisions],
        "contacts": contacts,
        "surface": list(to_builtins(contact)) if contact and contacts else [],
        "top": max([100, *(shape["y"] + 20 for shape in visuals)]),
        "bottom": min([-100, *(shape["y"] - 20 for shape in collisions)]),
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


def _visual(number: int, visual: Visual, imports: Mapping[str, Import], package: str) -> Iterator[dict[str, Any]]:
    """Yield a visual with its colour; a mesh with several colours gives one part per colour."""
    shape = _shape("visual", number, visual, imports, package)
    if shape is None:
        return
    if visual.material is not None and visual.material.rgba is not None:
        *tones, opacity = (min(max(part, 0.0), 1.0) for part in visual.material.rgba)
        yield shape | {"color": tuple(round(255 * tone) for tone in tones), "opacity": opacity}
        return
    if not isinstance(visual.geometry, Mesh):
        yield shape | {"color": GREY, "opacity": 1.0}
        return
    key = lookup.key(visual.geometry)
    facts = imports[key].facts
    colors = facts.get(lookup.PARTS) or facts.get(lookup.COLORS) or [None]
    files = [key, *(further_key(key, part) for part in range(1, len(colors) + 1))]
    if lookup.COLORS in facts and len(colors) > 1:
        del files[0]  # the whole mesh, which other shapes use
    for part, (color, file) in enumerate(zip(colors, files, strict=False), 1):
        colored = shape | {"color": tuple(color) if color else GREY, "opacity": 1.0}
        if len(colors) > 1:
            label = f"{shape['label']}, colour {part}"
            colored |= {
                "component": f"{shape['component']}_{part}",
                "label": label,
                "title": shape["title"].replace(shape["label"], label, 1),
                "uri": f"modelica://{package}/{imports[file].target}",
                "bounds": imports[file].facts["bounds"],
            }
        yield colored


def _shape(
    word: str, number: int, shape: Visual | Collision, imports: Mapping[str, Import], package: str
) -> dict[str, Any] | None:
    """Return the common data of visuals and collisions; None for a mesh that is not imported."""
    mesh = imports.get(lookup.key(shape.geometry)) if isinstance(shape.geometry, Mesh) else None
    if isinstance(shape.geometry, Mesh) and mesh is None:
        return None
    label = f"{word.capitalize()} {number}"
    return {
        "component": f"{word}{number}",
        "type": type(shape.geometry).__name__,
        "label": label,
        "title": f'{label}: "{shape.name}"' if shape.name else label,
        "is_collision": False,
        "touches": False,
        "origin": shape.origin,
        "geometry": shape.geometry,
        "uri": f"modelica://{package}/{mesh.target}" if mesh else "",
        "bounds": mesh.facts["bounds"] if mesh else (),
        "hull": (),
    }
