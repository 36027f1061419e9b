"""The triangles of a mesh file, in any format that is imported, and strictly: a part of a mesh is no mesh.

STL and OBJ are read here: Modelica tools draw them, so most packages have no others, and trimesh takes most of a
second to load. Of trimesh's readings of OBJ, a relative index counts from the end of the file and not from its own
line, index 0 is the last vertex, and a comment after a number is an error. pycollada reads COLLADA (see `collada`),
trimesh all else.
"""

from __future__ import annotations

import io
import json
import re
from collections.abc import Callable, Iterator, Mapping
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from urdfsync.urdf.meshes.collada import read_collada
from urdfsync.urdf.meshes.errors import MeshError, guarded
from urdfsync.urdf.meshes.geometry import Array, placed

Indices: TypeAlias = npt.NDArray[np.int64]

FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
"""A triangle of a binary STL file."""

_AXES = 3
_TRIANGLE = 3
_COMPRESSIONS = (b"KHR_draco_mesh_compression", b"EXT_meshopt_compression")
_STL_COUNT = slice(80, 84)
_SOLID_LINE = re.compile(rb"^[ \t]*(?:end)?solid\b.*$", re.MULTILINE | re.IGNORECASE)  # the name may be any words
_STL_VERTEX = re.compile(rb"\bvertex\s+(\S+)\s+(\S+)\s+(\S+)", re.IGNORECASE)
_POINTER = b"version https://git-lfs"


def read_mesh(suffix: str, content: bytes) -> Array:
    """Return the corners of all triangles (n × 3 × 3), at least one, all finite; in metres, or the file's unit.

    Only COLLADA has a unit. `suffix` is the format, in lower case with the dot. Raises MeshError.
    """
    if content.startswith(_POINTER):
        raise MeshError("it is a Git LFS pointer, and `git lfs pull` brings the file itself")
    reader = _READERS.get(suffix)
    if reader is None:
        raise MeshError(f"its format isn't one of {', '.join(sorted(_READERS))}")
    corners = reader(content)
    if not len(corners):
        raise MeshError("it has no triangles")
    if not np.isfinite(corners).all():
        raise MeshError("it has coordinates that aren't finite numbers")
    return corners


def _read_stl(content: bytes) -> Array:
    announced = int.from_bytes(content[_STL_COUNT], "little")
    if len(content) == _STL_COUNT.stop + announced * FACET.itemsize:  # some of these begin with `solid`, too
        facets = np.frombuffer(content, FACET, offset=_STL_COUNT.stop)
        return np.asarray(facets["corners"], dtype=np.float64)
    if content.lstrip()[:5].lower() == b"solid":
        return _read_ascii_stl(content)
    if not announced:
        raise MeshError("it has no triangles")
    raise MeshError(f"its length doesn't fit the {announced} triangles that it announces")


def _read_ascii_stl(content: bytes) -> Array:
    facets = _SOLID_LINE.sub(b"", content)
    vertices = _STL_VERTEX.findall(facets)
    words = facets.lower().split()
    complete = _TRIANGLE * words.count(b"endfacet") == len(vertices) == words.count(b"vertex")
    if not complete or words.count(b"facet") != words.count(b"endfacet") or not _ends_solid(content):
        raise MeshError("its end is missing")
    with guarded():
        return np.array(vertices, dtype=np.float64).reshape(-1, _TRIANGLE, _AXES)


def _ends_solid(content: bytes) -> bool:
    return content.rstrip().rpartition(b"\n")[2].lstrip().lower().startswith(b"endsolid")


def _read_ply(content: bytes) -> Array:
    header = content.partition(b"end_header")[0]
    announced = re.search(rb"^element[ \t]+face[ \t]+(\d+)", header, re.MULTILINE)
    return _complete(_read_trimesh("ply", content), int(announced[1]) if announced else 0)


def _read_off(content: bytes) -> Array:
    announced = re.search(rb"OFF(?:\s|#.*)*\d+\s+(\d+)", content)
    return _complete(_read_trimesh("off", content), int(announced[1]) if announced else 0)


def _complete(corners: Array, faces: int) -> Array:
    """All triangles of that many faces; trimesh passes over those that a file announces and doesn't hold."""
    if len(corners) < faces:
        raise MeshError("its end is missing")
    return corners


def _read_gltf(content: bytes) -> Array:
    try:
        json.loads(content)  # where this fails, trimesh looks for another file
    except ValueError as error:
        raise MeshError(f"its content isn't JSON: {error}") from error
    return _read_glb(content, "gltf")


def _read_glb(content: bytes, suffix: str = "glb") -> Array:
    for compression in _COMPRESSIONS:
        if compression in content:
            raise MeshError(f"it is compressed ({compression.decode()})")
    return _read_trimesh(suffix, content)


class _NoOtherFiles(Mapping[str, bytes]):
    """What trimesh may read besides: nothing, since only the mesh file itself is watched for changes."""

    def __getitem__(self, name: str) -> bytes:
        raise MeshError(f"it needs another file, {name}")

    def __iter__(self) -> Iterator[str]:
        return iter(())

    def __len__(self) -> int:
        return 0


def _read_trimesh(suffix: str, content: bytes) -> Array:
    """All triangles of the scene that trimesh reads, moved by its nodes."""
    parts = [np.empty((0, _TRIANGLE, _AXES))]
    with guarded():
        import trimesh

        scene = trimesh.load_scene(
            io.BytesIO(content), file_type=suffix, resolver=_NoOtherFiles(), process=False, skip_materials=True
        )
        for node in scene.graph.nodes_geometry:
            pose, name = scene.graph[node]
            geometry = scene.geometry[name]
            if isinstance(geometry, trimesh.Trimesh):
                parts.append(placed(np.asarray(geometry.vertices, dtype=np.float64)[geometry.faces], pose))
        return np.concatenate(parts)


def _read_obj(content: bytes) -> Array:
    """Positions and faces."""
    coordinates: list[bytes] = []
    corners: list[bytes] = []
    faces: list[tuple[int, int]] = []  # number of corners, and of vertices so far
    for number, line in enumerate(content.replace(b"\\\n", b" ").replace(b"\\\r\n", b" ").splitlines(), start=1):
        words = (line.partition(b"#")[0] if b"#" in line else line).split()
        if words and words[0] in (b"v", b"f"):
            if len(words) <= _TRIANGLE:
                raise MeshError(f"its line {number} ends early")
            if words[0] == b"v":
                coordinates += words[1 : 1 + _AXES]
            else:
                corners += words[1:]
                faces.append((len(words) - 1, len(coordinates) // _AXES))
    with guarded():
        vertices = np.fromstring(b" ".join(coordinates), sep=" ").reshape(-1, _AXES)
        indices = np.fromstring(re.sub(rb"/\S*", b"", b" ".join(corners)), dtype=np.int64, sep=" ")
    return vertices[_from_zero(indices, np.array(faces, dtype=np.int64).reshape(-1, 2), len(vertices))]


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


_READERS: dict[str, Callable[[bytes], Array]] = {
    ".dae": read_collada,
    ".glb": _read_glb,
    ".gltf": _read_gltf,
    ".obj": _read_obj,
    ".off": _read_off,
    ".ply": _read_ply,
    ".stl": _read_stl,
}
