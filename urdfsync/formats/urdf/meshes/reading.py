"""Reads the triangles of a mesh file by trimesh. An incomplete mesh is an error."""

from __future__ import annotations

import contextlib
import gc
import io
import json
import re
import warnings
from collections.abc import Iterator, Mapping

import numpy as np
import trimesh

from urdfsync.common.diagnostics import cut
from urdfsync.formats.urdf.meshes.collada import collada_parts
from urdfsync.formats.urdf.meshes.geometry import MAX_TRIANGLES, Triangles, joined, placed
from urdfsync.formats.urdf.meshes.materials import Color, library_colors, number_materials
from urdfsync.formats.urdf.meshes.process import MeshError, is_binary_stl

_COMPRESSIONS = (b"KHR_draco_mesh_compression", b"EXT_meshopt_compression")
_FACES = {
    ".off": re.compile(rb"^\w{0,8}?OFF(?:\s++|#[^\n]*+\n)*+\d++\s++(\d++)", re.MULTILINE),
    ".ply": re.compile(rb"^element[ \t]+face[ \t]+(\d+)", re.MULTILINE),
}
"""Patterns for the number of faces that a file announces, by suffix."""
_MOST_COLORS = 20
"""The greatest number of colours of one mesh. Each colour becomes a shape; further colours become grey."""
_LONGEST, _NAMES = 60, 3
"""The greatest number of characters of a missing file's name in a warning, and the most names."""
_FROM_Y_UP = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]], dtype=np.float64)
"""Turns glTF's upward y axis into z, as Drake, Blender and RViz (since 2025: ros2/rviz#1229) do."""
_SOLID_LINE = re.compile(rb"^[ \t]*(?:end)?solid\b.*$", re.MULTILINE | re.IGNORECASE)


class _OtherFiles(dict[str, bytes]):
    """The other files that trimesh may read: only files whose changes the daemon watches."""

    def __missing__(self, name: str) -> bytes:
        raise MeshError(f"the mesh needs another file, {name}")


def read_mesh(
    suffix: str, content: bytes, others: Mapping[str, bytes] | None = None, most: float = MAX_TRIANGLES
) -> Triangles:
    """Read all triangles at their places in the scene, in metres or in the file's unit. Raises MeshError.

    `others` has the buffers of a glTF file.
    """
    with _damage_is_an_error():
        parts = collada_parts(content) if suffix == ".dae" else _parts(suffix, content, buffers=others)
        mesh = joined([triangles for _, triangles in parts], most)
        if len(mesh.faces) < _announced(suffix, content):  # trimesh ignores missing faces
            raise MeshError("the end of the file is missing")
    gc.collect()  # scenes have reference cycles and hold copies of large meshes
    return mesh


def read_parts(
    suffix: str, content: bytes, others: Mapping[str, bytes]
) -> tuple[dict[Color | None, Triangles], list[str]]:
    """Read the triangles of an OBJ or COLLADA file by colour; None stands for no colour.

    Also return the missing colours, in words. `others` has the other files that the mesh names. Raises MeshError.
    """
    by_color: dict[Color | None, list[Triangles]] = {}
    with _damage_is_an_error():
        if suffix == ".dae":
            parts_with_colors = collada_parts(content, others)
        else:
            parts_with_colors = _parts(suffix, content, library_colors(content, others))
        for color, triangles in parts_with_colors:
            by_color.setdefault(color, []).extend([triangles] if len(triangles.faces) else ())
        joined([part for some in by_color.values() for part in some])  # raises MeshError for no or too many triangles
        by_size = sorted(by_color, key=lambda color: sum(len(part.faces) for part in by_color[color]), reverse=True)
        for color in by_size[_MOST_COLORS:]:
            by_color.setdefault(None, []).extend(by_color.pop(color) if color else ())
        parts = {color: joined(some) for color, some in by_color.items() if some}
    gc.collect()
    missing = [f"`{cut(name, _LONGEST)}` not found" for name, other in others.items() if not other][:_NAMES]
    if suffix == ".dae" and None not in parts:
        missing = []  # the missing pictures have no colours, such as bump maps
    return parts, missing or ["a part has no colour"] * (None in parts and len(parts) > 1)


@contextlib.contextmanager
def _damage_is_an_error() -> Iterator[None]:
    """Turn any exception into a MeshError: libraries raise all kinds of errors for damaged files.

    Numbers that numpy can't read completely are an error in all versions of numpy. A MemoryError is left to the caller.
    """
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")  # libraries use deprecated parts of numpy
            warnings.filterwarnings("error", "string or file could not be read", DeprecationWarning)
            yield
    except (MeshError, MemoryError):
        raise
    except Exception as error:
        detail = f": {error}" if str(error) else ""
        raise MeshError(f"the file is damaged or of another format ({type(error).__name__}{detail})") from error


def _parts(
    suffix: str,
    content: bytes,
    colors: Mapping[bytes, Color] | None = None,
    buffers: Mapping[str, bytes] | None = None,
) -> Iterator[tuple[Color | None, Triangles]]:
    """Yield the triangles of a file with their colours. An OBJ file has `colors` by material; other files have none."""
    files = {name: buffer for name, buffer in (buffers or {}).items() if buffer}
    by_name = dict[str, Color | None]()
    if suffix == ".stl":
        content = _one_solid(content)
    if suffix == ".obj":
        if colors:
            content, used = number_materials(content)
            by_name = {f"m{number}": colors.get(name) for number, name in enumerate(used)}
            files["m"] = b"".join(b"newmtl m%d\n" % number for number in range(len(used)))
        content = _plain_obj(content, with_materials=bool(colors))
    if suffix == ".gltf":
        json.loads(content)  # without this, trimesh would take invalid JSON for a reference to another file
    is_gltf = suffix in (".gltf", ".glb")
    if is_gltf:
        for compression in _COMPRESSIONS:
            if compression in content:
                raise MeshError(f"the file is compressed ({compression.decode()})")
    scene = trimesh.load_scene(
        io.BytesIO(content),
        file_type=suffix[1:],
        resolver=_OtherFiles(files),
        process=False,
        skip_materials=not colors,
    )
    for color in dict.fromkeys(by_name.values()):  # in the order of the file; trimesh reverses the order
        yield color, Triangles(np.empty((0, 3)), np.empty((0, 3), dtype=np.int64))
    for node in scene.graph.nodes_geometry:
        pose, name = scene.graph[node]
        geometry = scene.geometry[name]
        if isinstance(geometry, trimesh.Trimesh):
            material = getattr(geometry.visual, "material", None) if by_name else None
            points = np.asarray(geometry.vertices, dtype=np.float64)
            color = by_name.get(material.name) if material else None
            yield color, placed(Triangles(points, np.asarray(geometry.faces)), _FROM_Y_UP @ pose if is_gltf else pose)


def _announced(suffix: str, content: bytes) -> int:
    """Return the number of triangles that a file announces. The file may have more triangles."""
    if suffix == ".stl":
        return content.count(b"endfacet") + content.count(b"ENDFACET")
    match = _FACES[suffix].search(content) if suffix in _FACES else None
    return int(match[1]) if match else 0


def _one_solid(content: bytes) -> bytes:
    """Return a binary STL file unchanged, and an STL text with all facets in one solid.

    Names of solids are removed, since a name may be any word, even `vertex`.
    """
    if is_binary_stl(content):
        return content
    if not content.rstrip().rpartition(b"\n")[2].lstrip().lower().startswith(b"endsolid"):
        raise MeshError("the end of the file is missing")
    return b"solid\n" + _SOLID_LINE.sub(b"", content) + b"\nendsolid\n"


def _plain_obj(content: bytes, *, with_materials: bool) -> bytes:
    """Return only vertices and faces, without references to textures and normals.

    All indices count from 1. With materials, faces keep their materials, in a library `m`.

    The reader of trimesh takes index 0 for 1, and counts negative indices from the end of the file. It skips indented
    lines, and faces with less than three corners. It fails if only some corners have references.
    """
    text = content.replace(b"\r\n", b"\n").replace(b"\\\n", b" ").replace(b"\t", b" ")
    statements = rb"^ *((?:[vf]|usemtl) .*)" if with_materials else rb"^ *([vf] .*)"
    text = b"\n".join(re.findall(statements, re.sub(rb"#.*|(?<=\d)/\S*", b"", text), re.MULTILINE))
    text = b"mtllib m\n" + text if with_materials else text
    if re.search(rb"^f.* -", text, re.MULTILINE):
        text = _count_from_the_first(text)
    if re.search(rb"^[vf](?: +\S+){0,2} *$", text, re.MULTILINE):
        raise MeshError("a vertex or face has less than three numbers")
    if re.search(rb"^f.* (?:0+(?: |$)|[-/])", text, re.MULTILINE):
        raise MeshError("a face has an index that no vertex has")
    return text


def _count_from_the_first(text: bytes) -> bytes:
    """Replace negative indices of an OBJ file, which count back from their own line, by positive indices."""
    vertices = 0

    def replaced(line: re.Match[bytes]) -> bytes:
        nonlocal vertices
        if line[1] == b"v":
            vertices += 1
            return line[0]
        return re.sub(rb" -\d+", lambda index: b" %d" % (vertices + 1 + int(index[0])), line[0])

    return re.sub(rb"^(v|f) .*", replaced, text, flags=re.MULTILINE)
