"""STL and OBJ, read strictly: a part of a mesh is no mesh.

They are read here since Modelica tools draw them, so most packages have no others, and trimesh takes most of a second
to load. numpy is not loaded either: that takes a quarter of a first build of a small robot, and most need bounds alone.
Of trimesh's readings of OBJ, a relative index counts from the end of the file and not from its own line, index 0 is the
last vertex, and a comment after a number is an error.
"""

from __future__ import annotations

import itertools
import math
import re
import struct
from array import array
from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeVar

from urdfsync.urdf.meshes.errors import NO_TRIANGLES, NOT_FINITE, TOO_LARGE, MeshError

MAX_TRIANGLES = 1_000_000
"""Of one mesh, in all its places; so many have 50 MB as binary STL."""
LARGEST = 3.4028234663852886e38
"""The largest number in single precision, which STL has."""

_Number = TypeVar("_Number", int, float)

_AXES = 3
_TRIANGLE = 3
_FACET = struct.Struct("<12x9f2x")  # the corners between a normal and an attribute
_STL_COUNT = slice(80, 84)
_SOLID_LINE = re.compile(rb"^[ \t]*(?:end)?solid\b.*$", re.MULTILINE | re.IGNORECASE)  # the name may be any words
_STL_VERTEX = re.compile(rb"\bvertex\s+(\S+\s+\S+\s+\S+)", re.IGNORECASE)


class Corners(NamedTuple):
    """Triangles as plain arrays."""

    points: array[float]
    """x, y and z of each point in turn."""
    faces: array[int]
    """Three indices of points for each triangle."""


def bounds(mesh: Corners) -> list[list[float]]:
    """Least and greatest coordinates of used points: `[[x, y, z], [x, y, z]]`. Raises MeshError if unfit for STL."""
    if not mesh.faces:
        raise MeshError(NO_TRIANGLES)
    used = set(mesh.faces)
    axes: list[Sequence[float]] = [mesh.points[axis::_AXES] for axis in range(_AXES)]
    if len(used) < len(axes[0]):
        axes = [[axis[index] for index in used] for axis in axes]
    if not all(all(map(math.isfinite, axis)) for axis in axes):
        raise MeshError(NOT_FINITE)
    found = [list(map(min, axes)), list(map(max, axes))]
    if max(map(abs, itertools.chain(*found))) > LARGEST:
        raise MeshError(TOO_LARGE)
    return found


def check_count(triangles: int) -> None:
    """Raise MeshError for more triangles than a mesh may have."""
    if triangles > MAX_TRIANGLES:
        raise MeshError(f"it has more than {MAX_TRIANGLES:,} triangles")


def read_stl(content: bytes) -> Corners:
    """Read a binary or a text file. Raises MeshError."""
    announced = int.from_bytes(content[_STL_COUNT], "little")
    if len(content) == _STL_COUNT.stop + announced * _FACET.size:  # some of these begin with `solid`, too
        check_count(announced)
        facets = _FACET.iter_unpack(content[_STL_COUNT.stop :])
        return _separate(array("d", itertools.chain.from_iterable(facets)))
    if content.lstrip()[:5].lower() == b"solid":
        return _read_ascii_stl(content)
    if not announced:
        raise MeshError(NO_TRIANGLES)
    raise MeshError(f"its length doesn't fit the {announced} triangles that it announces")


def _read_ascii_stl(content: bytes) -> Corners:
    facets = _SOLID_LINE.sub(b"", content).lower()
    check_count(facets.count(b"endfacet"))
    vertices = _STL_VERTEX.findall(facets)
    ends = facets.count(b"endfacet")
    is_complete = facets.count(b"facet") == 2 * ends and _TRIANGLE * ends == len(vertices) == facets.count(b"vertex")
    if not is_complete or not content.rstrip().rpartition(b"\n")[2].lstrip().lower().startswith(b"endsolid"):
        raise MeshError("its end is missing")
    return _separate(_numbers(float, b" ".join(vertices)))


def _separate(points: array[float]) -> Corners:
    """Triangles each of which has points of its own, in their order."""
    return Corners(points, array("q", range(len(points) // _AXES)))


def read_obj(content: bytes) -> Corners:
    """Read positions and faces. Raises MeshError."""
    coordinates, corners = bytearray(), bytearray()
    vertices, triangles = 0, 0
    faces: list[tuple[int, int]] = []  # number of corners, and of vertices so far
    for number, line in enumerate(content.replace(b"\\\n", b" ").replace(b"\\\r\n", b" ").splitlines(), start=1):
        words = (line.partition(b"#")[0] if b"#" in line else line).split()
        if words and words[0] in (b"v", b"f"):
            if len(words) <= _TRIANGLE:
                raise MeshError(f"its line {number} ends early")
            if words[0] == b"v":
                coordinates += b" ".join(words[1 : 1 + _AXES]) + b" "
                vertices += 1
            else:
                triangles += len(words) - _TRIANGLE
                check_count(triangles)
                corners += b" ".join(words[1:]) + b" "
                faces.append((len(words) - 1, vertices))
    points = _numbers(float, coordinates)
    indices = _numbers(int, re.sub(rb"/\S*", b"", corners))
    return Corners(points, _from_zero(indices, faces, vertices))


def _from_zero(indices: array[int], faces: Sequence[tuple[int, int]], vertices: int) -> array[int]:
    """Triangles as indices that count from 0; OBJ counts from 1, or back from the last vertex so far."""
    if len(indices) != sum(size for size, _ in faces):
        raise MeshError("one of its faces refers to no vertex")
    if indices and len(indices) == _TRIANGLE * len(faces) and min(indices) > 0 and max(indices) <= vertices:
        return array("q", [index - 1 for index in indices])  # as nearly all files: large ones take a second less
    found, begin = array("q"), 0
    for size, so_far in faces:
        corners = []
        for index in indices[begin : begin + size]:
            corners.append(index - 1 if index > 0 else so_far + index)
            if index == 0 or not 0 <= corners[-1] < vertices:
                raise MeshError(f"one of its faces refers to vertex {index} of {vertices}")
        for second, third in itertools.pairwise(corners[1:]):
            found.extend((corners[0], second, third))
        begin += size
    return found


def _numbers(kind: type[_Number], words: bytes | bytearray) -> array[_Number]:
    """Numbers of a kind between blanks. Raises MeshError."""
    try:
        if b"_" in words:  # which Python reads in numbers
            raise ValueError  # noqa: TRY301 - as for one that Python can't read
        return array("d" if kind is float else "q", map(kind, words.split()))
    except (OverflowError, ValueError):  # whose own texts quote the file, which may be long
        raise MeshError("it is damaged or of another format: one of its numbers can't be read") from None


PLAIN: dict[str, Callable[[bytes], Corners]] = {".stl": read_stl, ".obj": read_obj}
"""The readers by suffix."""
