"""Triangles as arrays: moved, measured, written as STL, and the few points on which such a body stands or rolls."""

from __future__ import annotations

import itertools
import math
import struct
from collections.abc import Iterable
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from urdfsync.urdf.meshes.errors import NO_TRIANGLES, NOT_FINITE, TOO_LARGE, MeshError
from urdfsync.urdf.meshes.plain import LARGEST, Corners, check_count
from urdfsync.urdf.robot import Vector

Array: TypeAlias = npt.NDArray[np.float64]
Indices: TypeAlias = npt.NDArray[np.int64]
Facts: TypeAlias = dict[str, list[list[float]]]

FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
"""A triangle of a binary STL file."""

_HEADER = b"binary STL, written by urdfsync".ljust(80)
_STEPS = 36  # directions on each great circle
_TIE = 1e-9  # of the size: what is meant to be equal differs by rounding
_CROWD = 1000  # points in a plane: if they are on a line, so many are extreme in dozens of directions, and take minutes
_THIN = 1e-7  # of the size: points that lie so near to a line are on it
_MARGIN = 1e-5  # of the size: far above the error of single precision
_CHUNK = 1 << 14  # points whose products with all directions stay in the cache
_MANY = 4  # directions in which a point is extreme, on average, before that looks odd
_PRODUCTS = 1 << 22  # numbers that a step may work on at a time, to bound the memory
_DIGITS = 6


class Triangles(NamedTuple):
    """Triangles whose outer side is the one from which their corners are counter-clockwise."""

    points: Array
    """n × 3."""
    faces: Indices
    """m × 3, of `points`."""


def triangles(corners: Corners) -> Triangles:
    """The same triangles as arrays of numpy, in the same memory."""
    points = np.frombuffer(corners.points) if corners.points else np.empty(0)
    faces = np.frombuffer(corners.faces, dtype=np.int64) if corners.faces else np.empty(0, dtype=np.int64)
    return Triangles(points.reshape(-1, 3), faces.reshape(-1, 3))


def placed(mesh: Triangles, pose: Array) -> Triangles:
    """Triangles moved by an affine transformation (4 × 4); one that mirrors keeps their outer sides."""
    points = np.empty(mesh.points.shape)
    for start in range(0, len(points), _CHUNK):
        x, y, z = (mesh.points[start : start + _CHUNK, axis, np.newaxis] for axis in range(3))
        points[start : start + _CHUNK] = x * pose[:3, 0] + y * pose[:3, 1] + z * pose[:3, 2] + pose[:3, 3]
    return Triangles(points, mesh.faces[:, ::-1] if np.linalg.det(pose[:3, :3]) < 0 else mesh.faces)


def joined(parts: Iterable[Triangles]) -> Triangles:
    """All triangles as one mesh. Raises MeshError for more than `MAX_TRIANGLES`, and for a corner that is no point."""
    points, faces = [np.empty((0, 3))], [np.empty((0, 3), dtype=np.int64)]
    count = triangles = 0
    for part in parts:
        triangles += len(part.faces)
        check_count(triangles)
        if len(part.faces) and (part.faces.min() < 0 or part.faces.max() >= len(part.points)):
            raise MeshError("one of its faces has an index that no vertex has")
        points.append(part.points)
        faces.append(part.faces + count)
        count += len(part.points)
    return Triangles(np.concatenate(points), np.concatenate(faces))


def import_form(mesh: Triangles, scale: Vector, with_hull: bool = True) -> tuple[Triangles, Facts]:
    """A mesh in metres, and what models need of its shape: `bounds`, and perhaps `hull` (see `support_points`).

    Raises MeshError for a mesh without triangles, and for numbers that an STL file can't hold.
    """
    if not len(mesh.faces):
        raise MeshError(NO_TRIANGLES)
    if not np.isfinite(bounds(_used_points(mesh))).all():
        raise MeshError(NOT_FINITE)
    with np.errstate(over="ignore", invalid="ignore"):
        scaled = placed(mesh, np.diag((*scale, 1.0)))
    points = _used_points(scaled)
    extent = bounds(points)
    if not (np.abs(extent) <= LARGEST).all():
        raise MeshError(TOO_LARGE)
    return scaled, {"bounds": extent, **({"hull": support_points(points)} if with_hull else {})}


def _used_points(mesh: Triangles) -> Array:
    is_used = np.zeros(len(mesh.points), dtype=np.bool_)
    is_used[mesh.faces] = True
    used: Array = mesh.points[is_used]
    return used


def binary_stl(mesh: Triangles) -> bytes:
    """Triangles as binary STL; the normal of a triangle without area is zero."""
    facets = np.zeros(len(mesh.faces), dtype=FACET)
    for start in range(0, len(facets), _CHUNK):
        part = slice(start, start + _CHUNK)
        a, b, c = (mesh.points[mesh.faces[part, corner]] for corner in range(3))
        normals = np.cross(b - a, c - a)
        lengths = np.sqrt(normals[:, 0] ** 2 + normals[:, 1] ** 2 + normals[:, 2] ** 2)[:, np.newaxis]
        facets["normal"][part] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
        facets["corners"][part] = np.stack((a, b, c), axis=1)
    return b"".join((_HEADER, struct.pack("<I", len(facets)), facets.view(np.uint8).data))


def bounds(points: Array) -> list[list[float]]:
    """Least and greatest coordinates of `points` (n × 3): `[[x, y, z], [x, y, z]]`."""
    return [_plain(points.min(axis=0)), _plain(points.max(axis=0))]


def support_points(points: Array) -> list[list[float]]:
    """Some points of the convex hull of `points` (n × 3, metres): rounded to 1e-6 m, sorted, each once.

    They are the extreme points along 122 fixed directions: three great circles normal to the
    coordinate axes in steps of 10°, and the faces, edges and corners of a cube. Where a whole edge or
    face is extreme, its own extreme points count, so that a wheel keeps the rims of both sides.
    """
    size = float(np.ptp(points, axis=0).max())
    chosen = []
    for number, near in enumerate(_nearly_extreme(points, _DIRECTIONS, size)):
        if (near == near[0]).all():  # as for most directions: one corner
            chosen.append(near[:1])
            continue
        heights = _products(near, _DIRECTIONS[number : number + 1])[:, 0]
        chosen.append(_corners(near[heights >= heights.max() - _TIE * size], number, size))
    rounded = np.round(np.concatenate(chosen), _DIGITS) + 0.0  # -0.0 becomes 0.0
    return [list(point) for point in sorted(set(map(tuple, rounded.tolist())))]


def _directions() -> Array:
    """Unit vectors (122 × 3), rounded so that they are the same on every machine."""
    angles = [2 * math.pi * step / _STEPS for step in range(_STEPS)]
    circle = [(math.cos(angle), math.sin(angle), 0.0) for angle in angles]
    circles = [(*one[3 - axis :], *one[: 3 - axis]) for axis in range(3) for one in circle]
    corners = [one for one in itertools.product((-1, 0, 1), repeat=3) if any(one)]
    cube = [tuple(coordinate / math.hypot(*one) for coordinate in one) for one in corners]
    rounded = np.round(circles + cube, 12) + 0.0
    return np.array(sorted(set(map(tuple, rounded.tolist()))))


_DIRECTIONS = _directions()
_NORMALS = np.cross(_DIRECTIONS[:, np.newaxis], _DIRECTIONS)  # per pair of directions
_CROSSING = np.linalg.norm(_NORMALS, axis=2) > _MARGIN  # the pairs that are not parallel


def _nearly_extreme(points: Array, directions: Array, size: float) -> list[Array]:
    """Per direction, the points that may be extreme: found in single precision, with a margin for its errors.

    All points are looked at once, since a large mesh has millions.
    """
    middle = points.mean(axis=0)
    axes = directions.T.astype(np.float32)
    highest = np.full(len(directions), -np.inf, dtype=np.float32)
    found = []
    for start in range(0, len(points), _CHUNK):
        part = points[start : start + _CHUNK]
        heights = ((part - middle) / (size or 1.0)).astype(np.float32) @ axes
        highest = np.maximum(highest, heights.max(axis=0))
        near = heights >= highest - np.float32(_MARGIN)
        if np.count_nonzero(near) > _MANY * len(heights):  # as where many points are one
            near &= _is_first(part)[:, np.newaxis]
        rows, columns = np.divmod(np.flatnonzero(near), near.shape[1])  # ten times as fast as `near.nonzero()`
        found.append((columns, rows + start, heights[rows, columns]))
    columns, rows, values = map(np.concatenate, zip(*found, strict=True))
    extreme = values >= highest[columns] - np.float32(_MARGIN)
    columns, rows = columns[extreme], rows[extreme]
    rows = rows[np.argsort(columns, kind="stable")]
    return [points[part] for part in np.split(rows, np.cumsum(np.bincount(columns, minlength=len(directions)))[:-1])]


def _is_first(points: Array) -> npt.NDArray[np.bool_]:
    """Per point, whether none before it is the same."""
    first = np.zeros(len(points), dtype=np.bool_)
    first[np.unique(points, axis=0, return_index=True)[1]] = True
    return first


def _corners(tied: Array, number: int, size: float) -> Array:
    """Of points in a plane normal to a direction: those extreme along the other directions, two where these tie too."""
    if (tied == tied[0]).all():
        return tied[:1]
    if len(tied) > _CROWD and (ends := _ends_of_line(tied, size)) is not None:
        return ends
    along, others = _NORMALS[number], _CROSSING[number]
    if len(tied) > _CHUNK:
        tied = np.unique(np.concatenate(_nearly_extreme(tied, _DIRECTIONS[others], size)), axis=0)
    parts = math.ceil(np.count_nonzero(others) * len(tied) / _PRODUCTS)
    found: list[npt.NDArray[np.signedinteger]] = []
    for part in np.array_split(np.flatnonzero(others), parts):
        heights = _products(tied, _DIRECTIONS[part])
        extreme = heights >= heights.max(axis=0) - _TIE * size
        positions = _products(tied, along[part])
        found.append(np.where(extreme, positions, -np.inf).argmax(axis=0))
        found.append(np.where(extreme, positions, np.inf).argmin(axis=0))
    corners: Array = tied[np.unique(np.concatenate(found))]
    return corners


def _ends_of_line(points: Array, size: float) -> Array | None:
    """The ends of the line on which all points are; None if they are on none."""
    axis = np.ptp(points, axis=0).argmax()
    ends: Array = points[[points[:, axis].argmin(), points[:, axis].argmax()]]
    offsets = np.cross(points - ends[0], ends[1] - ends[0])
    is_line = (np.abs(offsets) <= _THIN * size * np.linalg.norm(ends[1] - ends[0])).all()
    return ends if is_line else None


def _products(points: Array, directions: Array) -> Array:
    """Scalar products (points × directions); without a matrix product, whose rounding depends on the machine."""
    x, y, z = (points[:, axis, np.newaxis] * directions[np.newaxis, :, axis] for axis in range(3))
    products: Array = x + y + z
    return products


def _plain(point: Array) -> list[float]:
    return [float(coordinate) for coordinate in point]
