"""STL and OBJ, read strictly: a part of a mesh is no mesh.

They are read here since Modelica tools draw them, so most packages have no others, and trimesh takes most of a second
to load. Of trimesh's readings of OBJ, a relative index counts from the end of the file and not from its own line,
index 0 is the last vertex, and a comment after a number is an error.
"""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np

from urdfsync.urdf.meshes.errors import MeshError, damage_is_an_error
from urdfsync.urdf.meshes.geometry import FACET, Indices, Triangles, check_count

_AXES = 3
_TRIANGLE = 3
_STL_COUNT = slice(80, 84)
_SOLID_LINE = re.compile(rb"^[ \t]*(?:end)?solid\b.*$", re.MULTILINE | re.IGNORECASE)  # the name may be any words
_STL_VERTEX = re.compile(rb"\bvertex\s+(\S+\s+\S+\s+\S+)", re.IGNORECASE)


def read_stl(content: bytes) -> Triangles:
    """Read a binary or a text file. Raises MeshError."""
    announced = int.from_bytes(content[_STL_COUNT], "little")
    if len(content) == _STL_COUNT.stop + announced * FACET.itemsize:  # some of these begin with `solid`, too
        check_count(announced)
        points = np.frombuffer(content, FACET, offset=_STL_COUNT.stop)["corners"].reshape(-1, _AXES)
        return _separate(points.astype(np.float64))
    if content.lstrip()[:5].lower() == b"solid":
        return _read_ascii_stl(content)
    if not announced:
        raise MeshError("it has no triangles")
    raise MeshError(f"its length doesn't fit the {announced} triangles that it announces")


def _read_ascii_stl(content: bytes) -> Triangles:
    facets = _SOLID_LINE.sub(b"", content).lower()
    check_count(facets.count(b"endfacet"))
    vertices = _STL_VERTEX.findall(facets)
    ends = facets.count(b"endfacet")
    is_complete = facets.count(b"facet") == 2 * ends and _TRIANGLE * ends == len(vertices) == facets.count(b"vertex")
    if not is_complete or not content.rstrip().rpartition(b"\n")[2].lstrip().lower().startswith(b"endsolid"):
        raise MeshError("its end is missing")
    with damage_is_an_error():
        return _separate(np.fromstring(b" ".join(vertices), sep=" ").reshape(len(vertices), _AXES))


def _separate(points: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> Triangles:
    """Triangles each of which has points of its own, in their order."""
    return Triangles(points, np.arange(len(points)).reshape(-1, _TRIANGLE))


def read_obj(content: bytes) -> Triangles:
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
    with damage_is_an_error():
        points = np.fromstring(bytes(coordinates), sep=" ").reshape(vertices, _AXES)
        indices = np.fromstring(re.sub(rb"/\S*", b"", corners), dtype=np.int64, sep=" ")
    return Triangles(points, _from_zero(indices, np.array(faces, dtype=np.int64).reshape(-1, 2), vertices))


def _from_zero(indices: Indices, faces: Indices, vertices: int) -> Indices:
    """Triangles (n × 3) as indices that count from 0; OBJ counts from 1, or back from the last vertex so far."""
    sizes, counts = faces.T
    if len(indices) != sizes.sum():
        raise MeshError("one of its faces refers to no vertex")
    absolute = np.where(indices > 0, indices - 1, indices + np.repeat(counts, sizes))
    unknown = (indices == 0) | (absolute < 0) | (absolute >= vertices)
    if unknown.any():
        raise MeshError(f"one of its faces refers to vertex {indices[unknown][0]} of {vertices}")
    triangles: Indices = absolute[_fans(sizes)]
    return triangles


def _fans(sizes: Indices) -> Indices:
    """Triangles (n × 3) of polygons that have `sizes` corners each, as indices into the row of all their corners."""
    counts = sizes - (_TRIANGLE - 1)
    first = np.repeat(np.cumsum(sizes) - sizes, counts)
    step = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.column_stack((first, first + step + 1, first + step + 2))


PLAIN: dict[str, Callable[[bytes], Triangles]] = {".stl": read_stl, ".obj": read_obj}
"""The readers by suffix."""
