"""Moves, measures and writes arrays of triangles, and finds the few points on which a body stands or rolls."""

from __future__ import annotations

import itertools
import math
import struct
from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from urdfsync.formats.urdf.meshes.process import COARSER, MeshError, MeshFacts
from urdfsync.formats.urdf.robot import Vector

Array: TypeAlias = npt.NDArray[np.float64]
Indices: TypeAlias = npt.NDArray[np.int64]

MAX_TRIANGLES = 1_000_000
"""The greatest number of triangles of one mesh, in all its places in the scene: 50 MB of binary STL."""

_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER = b"binary STL, written by urdfsync".ljust(80)
_LARGEST = np.finfo(np.float32).max  # STL has single precision
_STEPS = 36  # Directions on each great circle.
_TIE = 1e-9  # Relative to the mesh's size: equal lengths may differ by rounding.
_NEAR = 1e-8  # Relative to the mesh's size, for a possible tie: far above the error of a matrix product.
_CHUNK = 1 << 14  # So many points, times all directions, fit into the processor's cache.
_DIGITS = 6
_CLOSED = 1e-4  # Relative to the surface: areas of a closed mesh add up to less.


class Triangles(NamedTuple):
    """Triangles with counter-clockwise corners, seen from outside."""

    points: Array
    """n × 3."""
    faces: Indices
    """m × 3, indices of `points`."""


def placed(mesh: Triangles, pose: Array) -> Triangles:
    """Move triangles by an affine transformation (4 × 4). Mirrored triangles keep their outer sides."""
    if np.array_equal(pose, np.identity(4)):
        return mesh
    points = np.empty(mesh.points.shape)
    # the rounding of a matrix product would depend on the machine; chunks need little memory
    for start in range(0, len(points), _CHUNK):
        x, y, z = (mesh.points[start : start + _CHUNK, axis, np.newaxis] for axis in range(3))
        points[start : start + _CHUNK] = x * pose[:3, 0] + y * pose[:3, 1] + z * pose[:3, 2] + pose[:3, 3]
    return Triangles(points, mesh.faces[:, ::-1] if np.linalg.det(pose[:3, :3]) < 0 else mesh.faces)


def joined(parts: Sequence[Triangles], most: float = MAX_TRIANGLES) -> Triangles:
    """Return all triangles as one mesh. Raises MeshError for a wrong number of triangles, or a wrong index."""
    triangles = sum(len(part.faces) for part in parts)
    if not triangles:
        raise MeshError("the file has no triangles")
    if triangles > most:
        raise MeshError(f"the file has {triangles:,} triangles, more than {MAX_TRIANGLES:,}", COARSER)
    for part in parts:
        if len(part.faces) and (part.faces.min() < 0 or part.faces.max() >= len(part.points)):
            raise MeshError("a face has an index that no vertex has")
    if len(parts) == 1:  # a copy of a large mesh would take a quarter of the memory
        return parts[0]
    from trimesh.util import append_faces  # a late import saves pages 0.7 s

    return Triangles(*append_faces([part.points for part in parts], [part.faces for part in parts]))


def import_form(mesh: Triangles, scale: Vector, with_hull: bool) -> tuple[Triangles, MeshFacts]:
    """Return a mesh in metres, with the facts of its shape: `bounds`, `volume`, and on request `hull`.

    See `volume` and `support_points`. Raises MeshError for numbers too large for STL.
    """
    mesh = scaled(mesh, scale)
    points = _used_points(mesh)
    facts = {"bounds": bounds(points), "volume": volume(mesh)}
    return mesh, facts | ({"hull": support_points(points)} if with_hull else {})


def scaled(mesh: Triangles, scale: Vector) -> Triangles:
    """Return a mesh in metres. Raises MeshError for numbers too large for STL."""
    with np.errstate(over="ignore", invalid="ignore"):
        mesh = placed(mesh, np.diag((*scale, 1.0)))
    if not (np.abs(_used_points(mesh)) <= _LARGEST).all():
        raise MeshError("the file has coordinates that are infinite, or too large for single precision")
    return mesh


def _used_points(mesh: Triangles) -> Array:
    is_used = np.zeros(len(mesh.points), dtype=np.bool_)
    is_used[mesh.faces] = True
    return mesh.points if is_used.all() else mesh.points[is_used]


def binary_stl(mesh: Triangles) -> bytes:
    """Return triangles as binary STL. A triangle without area has a normal of zero."""
    facets = np.zeros(len(mesh.faces), dtype=_FACET)
    for start in range(0, len(facets), _CHUNK):
        part = slice(start, start + _CHUNK)
        a, b, c = (mesh.points[mesh.faces[part, corner]] for corner in range(3))
        normals = np.cross(b - a, c - a)
        lengths = np.sqrt(normals[:, 0] ** 2 + normals[:, 1] ** 2 + normals[:, 2] ** 2)[:, np.newaxis]
        facets["normal"][part] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
        facets["corners"][part] = np.stack((a, b, c), axis=1)
    return b"".join((_HEADER, struct.pack("<I", len(facets)), facets.view(np.uint8).data))


def stl_triangles(content: bytes) -> Triangles:
    """Return the finite triangles of a binary STL file. Raises MeshError if no triangle is finite."""
    corners = np.frombuffer(content, dtype=_FACET, offset=len(_HEADER) + 4)["corners"].astype(np.float64)
    points = corners[np.isfinite(corners).all(axis=(1, 2))].reshape(-1, 3)
    return joined([Triangles(points, np.arange(len(points)).reshape(-1, 3))], math.inf)


def obj(mesh: Triangles) -> bytes:
    """Return triangles as the text of an OBJ file."""
    used, faces = np.unique(mesh.faces, return_inverse=True)
    points = (f"v {x!r} {y!r} {z!r}\n" for x, y, z in mesh.points[used].tolist())
    triangles = (f"f {a} {b} {c}\n" for a, b, c in (faces.reshape(-1, 3) + 1).tolist())
    return "".join(itertools.chain(points, triangles)).encode()


def bounds(points: Array) -> list[list[float]]:
    """Return the least and the greatest coordinates of `points` (n × 3): `[[x, y, z], [x, y, z]]`."""
    columns = np.ascontiguousarray(points.T)  # numpy is ten times slower along the other axis
    return [columns.min(axis=1).tolist(), columns.max(axis=1).tolist()]


def volume(mesh: Triangles) -> float:
    """Return the volume that a mesh encloses, in its unit³, with four digits; 0 for an open mesh.

    The areas of a closed surface, as vectors, add up to zero. A tube without ends counts as closed: its volume is a
    third too small.
    """
    center, areas, whole, surface = mesh.points.mean(axis=0), np.zeros(3), 0.0, 0.0
    with np.errstate(over="ignore", invalid="ignore"):
        for start in range(0, len(mesh.faces), _CHUNK):
            a, b, c = (mesh.points[mesh.faces[start : start + _CHUNK, corner]] - center for corner in range(3))
            normals = np.cross(b - a, c - a) / 2
            areas += normals.sum(axis=0)
            surface += float(np.sqrt((normals**2).sum(axis=1)).sum())
            whole += float((a * normals).sum()) / 3
        is_closed = np.abs(areas).max() <= _CLOSED * surface < np.inf
    return float(f"{abs(whole):.4g}") if is_closed else 0.0


def support_points(points: Array) -> list[list[float]]:
    """Return some points of the convex hull of `points` (n × 3, in m): rounded to 1e-6 m, sorted, without repetition.

    These points are extreme along 122 fixed directions: three great circles normal to the coordinate axes in steps of
    10°, and the faces, edges and corners of a cube. If a whole edge or face is extreme, its own extreme points count: a
    wheel keeps the rims of both sides.
    """
    size = float(np.ptp(points, axis=0).max())
    near = _nearly_extreme(points, _DIRECTIONS, size)
    chosen = []
    for number, direction in enumerate(_DIRECTIONS):
        heights = _products(near, direction[np.newaxis])[:, 0]
        tied = near[heights >= heights.max() - _TIE * size]
        is_corner = (tied == tied[0]).all()  # so in most directions
        chosen.append(tied[:1] if is_corner else _corners(tied, number, size))
    rounded = np.round(np.concatenate(chosen), _DIGITS) + 0.0  # -0.0 becomes 0.0
    return [list(point) for point in sorted(set(map(tuple, rounded.tolist())))]


def _directions() -> Array:
    """Return unit vectors (122 × 3), which rounding makes equal on all machines."""
    angles = [2 * math.pi * step / _STEPS for step in range(_STEPS)]
    circle = [(math.cos(angle), math.sin(angle), 0.0) for angle in angles]
    circles = [(*vector[3 - axis :], *vector[: 3 - axis]) for axis in range(3) for vector in circle]
    corners = [vector for vector in itertools.product((-1, 0, 1), repeat=3) if any(vector)]
    cube = [tuple(coordinate / math.hypot(*vector) for coordinate in vector) for vector in corners]
    rounded = np.round(circles + cube, 12) + 0.0
    return np.array(sorted(set(map(tuple, rounded.tolist()))))


_DIRECTIONS = _directions()
_NORMALS = np.cross(_DIRECTIONS[:, np.newaxis], _DIRECTIONS)  # For each pair of directions.
_CROSSING = np.linalg.norm(_NORMALS, axis=2) > 1e-6  # Pairs of directions that are not parallel.


def _nearly_extreme(points: Array, directions: Array, size: float) -> Array:
    """Return the points that may be extreme along a direction: mostly a few hundred of a million points."""
    highest = np.full(len(directions), -np.inf)
    candidates = []
    for start in range(0, len(points), _CHUNK):
        part = points[start : start + _CHUNK]
        heights = (part - points[0]) @ directions.T
        highest = np.maximum(highest, heights.max(axis=0))
        candidates.append(part[(heights >= highest - _NEAR * size).any(axis=1)])
    return np.concatenate(candidates)


def _corners(tied: Array, number: int, size: float) -> Array:
    """Return the tied points that are extreme along another direction, too; of a further tie, both ends."""
    others, along = _DIRECTIONS[_CROSSING[number]], _NORMALS[number][_CROSSING[number]]
    tied = np.unique(_nearly_extreme(tied, others, size), axis=0)
    heights, positions = _products(tied, others), _products(tied, along)
    extreme = heights >= heights.max(axis=0) - _TIE * size
    ends = (np.where(extreme, positions, -np.inf).argmax(axis=0), np.where(extreme, positions, np.inf).argmin(axis=0))
    corners: Array = tied[np.unique(ends)]
    return corners


def _products(points: Array, directions: Array) -> Array:
    """Return scalar products (points × directions)."""
    # the rounding of a matrix product would depend on the machine
    x, y, z = (points[:, axis, np.newaxis] * directions[np.newaxis, :, axis] for axis in range(3))
    products: Array = x + y + z
    return products
