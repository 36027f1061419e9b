"""The triangles of a mesh file, in any format that is imported, and strictly: a part of a mesh is no mesh.

trimesh reads STL, PLY, OFF and glTF, pycollada COLLADA (see `mesh_collada`). OBJ is read here: of
trimesh's readings, a relative index counts from the end of the file and not from its own line, index 0
is the last vertex, and a comment after a number is an error.
"""

from __future__ import annotations

import contextlib
import io
import logging
import re
import warnings
from collections.abc import Callable, Iterator, Mapping

import numpy as np
import numpy.typing as npt

from urdfsync.urdf.mesh_collada import read_collada
from urdfsync.urdf.mesh_geometry import Array, MeshError, placed

_AXES = 3
_TRIANGLE = 3
_COMPRESSIONS = (b"KHR_draco_mesh_compression", b"EXT_meshopt_compression")
_PARTIAL = "it ends early"
_STL_HEADER = 84  # bytes
_STL_FACET = 50
_SEEN_FOR_GARBAGE = (
    ArithmeticError,
    AttributeError,
    LookupError,
    MemoryError,
    NameError,
    NotImplementedError,
    RecursionError,
    TypeError,
    ValueError,
    DeprecationWarning,  # see `_strict`
)
"""What trimesh and pycollada raise for broken files, whose structure they take for granted."""


def read_mesh(suffix: str, content: bytes) -> Array:
    """Corners of all triangles (n × 3 × 3, in metres for COLLADA, else in the file's unit), at least one, all finite.

    `suffix` is the format, in lower case with the dot. Raises MeshError.
    """
    reader = _READERS.get(suffix)
    if reader is None:
        raise MeshError(f"its format isn't one of {', '.join(sorted(_READERS))}")
    try:
        with _strict():
            corners = reader(content)
    except ImportError as error:
        raise MeshError(f"a Python package is missing: {error}") from error
    except _SEEN_FOR_GARBAGE as error:
        detail = f": {error}" if str(error) else ""
        raise MeshError(f"its content isn't a {suffix} mesh ({type(error).__name__}{detail})") from error
    if not len(corners):
        raise MeshError("it has no triangles")
    if not np.isfinite(corners).all():
        raise MeshError("it has coordinates that aren't finite numbers")
    return corners


@contextlib.contextmanager
def _strict() -> Iterator[None]:
    """Numbers that numpy can't read to the end are an error in all its versions; trimesh's log is silent."""
    log = logging.getLogger("trimesh")
    level = log.level
    log.setLevel(logging.CRITICAL + 1)
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.filterwarnings("error", "string or file could not be read", DeprecationWarning)
            yield
    finally:
        log.setLevel(level)


def _read_stl(content: bytes) -> Array:
    """A binary file has the length that its header announces; in an ASCII file, trimesh passes over broken solids."""
    corners = _read_trimesh("stl", content)
    binary = len(content) == _STL_HEADER + _STL_FACET * len(corners)
    if not binary and content.lower().count(b"endfacet") != len(corners):
        raise MeshError(_PARTIAL)
    return corners


def _read_ply(content: bytes) -> Array:
    """All elements; trimesh passes over those that an ASCII file announces and doesn't hold."""
    header, _, body = content.partition(b"end_header")
    announced = sum(int(count) for count in re.findall(rb"^element +\S+ +(\d+)", header, re.MULTILINE))
    if b"format ascii" in header and len(body.split(b"\n")) - 1 < announced:
        raise MeshError(_PARTIAL)
    return _read_trimesh("ply", content)


def _read_off(content: bytes) -> Array:
    """All faces; trimesh passes over those that the file announces and doesn't hold."""
    lines = [line.split(b"#")[0].strip() for line in content.partition(b"OFF")[2].splitlines()]
    filled = [line for line in lines if line]
    vertices, faces = map(int, filled[0].split()[:2])
    if len(filled) <= vertices + faces:
        raise MeshError(_PARTIAL)
    return _read_trimesh("off", content)


def _read_gltf(suffix: str) -> Callable[[bytes], Array]:
    def read(content: bytes) -> Array:
        for compression in _COMPRESSIONS:
            if compression in content:
                raise MeshError(f"it is compressed ({compression.decode()})")
        return _read_trimesh(suffix, content)

    return read


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
    import trimesh

    scene = trimesh.load_scene(
        io.BytesIO(content), file_type=suffix, resolver=_NoOtherFiles(), process=False, skip_materials=True
    )
    parts = [np.empty((0, 3, 3))]
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
    faces: list[tuple[int, int]] = []
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
    vertices = np.fromstring(b" ".join(coordinates), sep=" ").reshape(-1, _AXES)
    indices = np.fromstring(re.sub(rb"/\S*", b"", b" ".join(corners)), dtype=np.int64, sep=" ")
    sizes, counts = np.array(faces, dtype=np.int64).reshape(-1, 2).T
    absolute = np.where(indices > 0, indices - 1, indices + np.repeat(counts, sizes))
    unknown = (indices == 0) | (absolute < 0) | (absolute >= len(vertices))
    if unknown.any():
        raise MeshError(f"a face refers to vertex {indices[unknown][0]} of {len(vertices)}")
    return vertices[absolute[_fans(sizes)]]


def _fans(sizes: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """Triangles (n × 3) of polygons that have `sizes` corners each, as indices into the row of all their corners."""
    counts = sizes - 2
    first = np.repeat(np.cumsum(sizes) - sizes, counts)
    step = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.column_stack((first, first + step + 1, first + step + 2))


_READERS: dict[str, Callable[[bytes], Array]] = {
    ".dae": read_collada,
    ".glb": _read_gltf("glb"),
    ".gltf": _read_gltf("gltf"),
    ".obj": _read_obj,
    ".off": _read_off,
    ".ply": _read_ply,
    ".stl": _read_stl,
}
