"""Visuals and collisions of a link as the templates need them."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias, TypeVar

import msgspec

from urdfsync.domain import Import
from urdfsync.urdf.meshes import lookup as mesh_lookup
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import (
    Collision,
    Geometry,
    Link,
    Material,
    Mesh,
    Origin,
    Visual,
)

GREY = (180, 180, 180)
PINK = (255, 105, 180)
_ROW = 30  # distance of the shapes in the link's diagram
_Shape = TypeVar("_Shape", Visual, Collision)


class Look(msgspec.Struct, frozen=True):
    """What of a shape a model can say: nothing that is a number or a name in the URDF."""

    component: str
    type: str
    label: str
    is_collision: bool
    y: int
    touches: bool
    """Whether it has a ground contact."""


class Numbers(msgspec.Struct, frozen=True):
    """What of a shape a record can say."""

    component: str
    type: str
    title: str
    origin: Origin
    geometry: Geometry
    uri: str
    """Where a mesh is; empty for all other shapes."""
    bounds: Sequence[Sequence[float]]
    """Lower and upper corner of a mesh, in metres; empty for all other shapes."""
    color: tuple[int, ...]
    opacity: float
    hull: Sequence[Sequence[float]]


class Contact(msgspec.Struct, frozen=True):
    """A ground contact, of the collision shape that `record` is the record of."""

    component: str
    type: str
    record: str
    y: int


Looks: TypeAlias = tuple[tuple[Look, ...], tuple[Look, ...]]
"""Visuals and collisions."""


def looks(link: Link, imports: Mapping[str, Import], options: Options) -> Looks:
    """A link's visuals and collisions for its model; a shape whose mesh was never found is left out.

    Shapes are numbered as in the URDF, so that the others keep their names when a mesh is found later.
    """
    visuals = _found(link.visuals, imports)
    collisions = _found(link.collisions, imports) if options.collisions else ()
    return (
        tuple(
            _look("visual", number, row, type(shape.geometry).__name__, touches=False)
            for row, (number, shape) in enumerate(visuals, 1)
        ),
        tuple(
            _look("collision", number, -row, type(shape.geometry).__name__, touches=_touches(shape, imports, options))
            for row, (number, shape) in enumerate(collisions, 1)
        ),
    )


@functools.lru_cache(maxsize=256)  # the shapes of one link look like those of the others
def _look(word: str, number: int, row: int, kind: str, *, touches: bool) -> Look:
    """The look of a shape; `row` counts upwards from the body in the link's diagram."""
    return Look(f"{word}{number}", kind, f"{word.capitalize()} {number}", word == "collision", row * _ROW, touches)


def numbers(
    link: Link, imports: Mapping[str, Import], package: str, options: Options
) -> tuple[list[Numbers], list[Numbers]]:
    """A link's visuals and collisions for its record; the same ones as in its model."""
    visuals = [
        _shape_numbers("visual", number, shape, _mesh(shape.geometry, imports, package), *_color(shape.material))
        for number, shape in _found(link.visuals, imports)
    ]
    collisions = [
        _shape_numbers(
            "collision",
            number,
            shape,
            _mesh(shape.geometry, imports, package),
            PINK,
            0.5,
            hull(shape.geometry, imports) if options.base == "floating" else (),
        )
        for number, shape in (_found(link.collisions, imports) if options.collisions else ())
    ]
    return visuals, collisions


def _shape_numbers(
    word: str,
    number: int,
    shape: Visual | Collision,
    mesh: tuple[str, Sequence[Sequence[float]]],
    color: tuple[int, ...],
    opacity: float,
    points: Sequence[Sequence[float]] = (),
) -> Numbers:
    title = f"{word.capitalize()} {number}" + (f': "{shape.name}"' if shape.name else "")
    kind = type(shape.geometry).__name__
    return Numbers(f"{word}{number}", kind, title, shape.origin, shape.geometry, *mesh, color, opacity, points)


def contacts(collisions: Iterable[Look]) -> list[Contact]:
    """The ground contacts of a link: one per collision shape, a mesh by its outermost points.

    A mesh without any has none.
    """
    return [
        Contact(
            shape.component.replace("collision", "contact"),
            "Points" if shape.type == "Mesh" else shape.type,
            shape.component,
            shape.y,
        )
        for shape in collisions
        if shape.touches
    ]


def meshes(shapes: Iterable[Visual | Collision], imports: Mapping[str, Import]) -> Mapping[str, Import]:
    """The imported meshes of some shapes."""
    if not imports:
        return imports
    keys = (mesh_lookup.key(shape.geometry) for shape in shapes if isinstance(shape.geometry, Mesh))
    return {key: imports[key] for key in keys if key in imports}


def _found(shapes: Sequence[_Shape], imports: Mapping[str, Import]) -> Iterator[tuple[int, _Shape]]:
    """The shapes that can be shown, with their numbers."""
    for number, shape in enumerate(shapes, 1):
        if not isinstance(shape.geometry, Mesh) or mesh_lookup.key(shape.geometry) in imports:
            yield number, shape


def _touches(shape: Collision, imports: Mapping[str, Import], options: Options) -> bool:
    return options.base == "floating" and (not isinstance(shape.geometry, Mesh) or bool(hull(shape.geometry, imports)))


def hull(geometry: Geometry, imports: Mapping[str, Import]) -> Sequence[Sequence[float]]:
    """Outermost points of an imported mesh, in metres; empty for all other shapes."""
    if not isinstance(geometry, Mesh):
        return ()
    found = imports.get(mesh_lookup.key(geometry))
    return found.facts["hull"] if found else ()


def _mesh(geometry: Geometry, imports: Mapping[str, Import], package: str) -> tuple[str, Sequence[Sequence[float]]]:
    """Address and bounds of an imported mesh; both empty for all other shapes."""
    if not isinstance(geometry, Mesh):
        return "", ()
    found = imports[mesh_lookup.key(geometry)]
    return f"modelica://{package}/{found.target}", found.facts["bounds"]


def _color(material: Material | None) -> tuple[tuple[int, ...], float]:
    if material is None or material.rgba is None:
        return GREY, 1.0
    *rgb, alpha = (min(max(part, 0.0), 1.0) for part in material.rgba)
    return tuple(round(255 * part) for part in rgb), alpha
