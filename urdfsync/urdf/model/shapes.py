"""Visuals and collisions of a link as the templates need them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from urdfsync.domain import Import, Target
from urdfsync.literals import real, string, vector
from urdfsync.urdf.meshes import lookup as mesh_lookup
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Box, Capsule, Collision, Cylinder, Geometry, Link, Material, Mesh, Sphere, Visual

GREY = (180, 180, 180)
PINK = (255, 105, 180)
_ROW = 30  # distance of the shapes in the link's diagram


def link_shapes(
    link: Link, imports: Mapping[str, Import], target: Target, options: Options
) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Template data of a link's visuals and collisions; a shape whose mesh was never found is left out.

    Shapes are numbered as in the URDF, so that the others keep their names when a mesh is found later.
    """
    visuals = list(_numbered("visual", link.visuals, imports, target))
    collisions = list(_numbered("collision", link.collisions, imports, target)) if options.collisions else []
    for row, shape in enumerate(visuals, 1):
        shape["y"] = row * _ROW
    for row, shape in enumerate(collisions, 1):
        shape["y"] = -row * _ROW
        shape["hull"] = shape["hull"] if options.base == "floating" else ()
    return visuals, collisions


def structure(shape: Mapping[str, Any]) -> dict[str, Any]:
    """What of a shape a model can say: nothing that is a number or a name in the URDF."""
    return {key: shape[key] for key in ("component", "type", "label", "is_collision", "y")}


def numbers(shape: Mapping[str, Any]) -> dict[str, Any]:
    """What of a shape a record can say."""
    return {key: shape[key] for key in ("component", "type", "title", "origin", "numbers", "color", "opacity", "hull")}


def contacts(collisions: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Template data of the ground contacts of a link: one per collision shape, a mesh by its outermost points.

    A mesh without any has none.
    """
    return [
        {
            "component": shape["component"].replace("collision", "contact"),
            "type": "Points" if shape["type"] == "Mesh" else shape["type"],
            "record": shape["component"],
            "y": shape["y"],
        }
        for shape in collisions
        if shape["type"] != "Mesh" or shape["hull"]
    ]


def _numbered(
    word: str, shapes: Sequence[Visual | Collision], imports: Mapping[str, Import], target: Target
) -> Iterator[dict[str, Any]]:
    for number, shape in enumerate(shapes, 1):
        numbers = _numbers(shape.geometry, imports, target)
        if numbers is None:
            continue
        is_collision = isinstance(shape, Collision)
        color, opacity = (PINK, 0.5) if isinstance(shape, Collision) else _color(shape.material)
        label = f"{word.capitalize()} {number}"
        yield {
            "component": f"{word}{number}",
            "type": type(shape.geometry).__name__,
            "label": label,
            "title": f'{label}: "{shape.name}"' if shape.name else label,
            "origin": shape.origin,
            "numbers": numbers,
            "color": color,
            "opacity": opacity,
            "is_collision": is_collision,
            "hull": hull(shape.geometry, imports) if is_collision else (),
        }


def hull(geometry: Geometry, imports: Mapping[str, Import]) -> Sequence[Sequence[float]]:
    """Outermost points of an imported mesh, in metres; empty for all other shapes."""
    if not isinstance(geometry, Mesh):
        return ()
    found = imports.get(mesh_lookup.key(geometry))
    return found.facts["hull"] if found else ()


def _numbers(geometry: Geometry, imports: Mapping[str, Import], target: Target) -> list[tuple[str, str]] | None:
    match geometry:
        case Box(size=size):
            return [("size", vector(size))]
        case Sphere(radius=radius):
            return [("radius", real(radius))]
        case Cylinder(radius=radius, length=length) | Capsule(radius=radius, length=length):
            return [("radius", real(radius)), ("length", real(length))]
        case Mesh():
            found = imports.get(mesh_lookup.key(geometry))
            if found is None:
                return None
            lower, upper = found.facts["bounds"]
            uri = string(f"modelica://{target.package}/{found.target}")
            return [("uri", uri), ("lower", vector(lower)), ("upper", vector(upper))]


def _color(material: Material | None) -> tuple[tuple[int, ...], float]:
    if material is None or material.rgba is None:
        return GREY, 1.0
    *rgb, alpha = (min(max(part, 0.0), 1.0) for part in material.rgba)
    return tuple(round(255 * part) for part in rgb), alpha
