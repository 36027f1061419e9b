"""The triangles of OFF, PLY and glTF files, as trimesh reads them, and strictly: a part of a mesh is no mesh."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Iterator, Mapping

import numpy as np
import trimesh

from urdfsync.urdf.meshes.errors import MeshError, damage_is_an_error
from urdfsync.urdf.meshes.geometry import Triangles, joined, placed

_COMPRESSIONS = (b"KHR_draco_mesh_compression", b"EXT_meshopt_compression")
_ANNOUNCED = {
    ".off": re.compile(rb"OFF(?:\s|#[^\n]*\n)*\d+\s+(\d+)"),
    ".ply": re.compile(rb"^element[ \t]+face[ \t]+(\d+)", re.MULTILINE),
}
"""How many faces a file announces."""


class _NoOtherFiles(Mapping[str, bytes]):
    """What trimesh may read besides: nothing, since only the mesh file itself is watched for changes."""

    def __getitem__(self, name: str) -> bytes:
        raise MeshError(f"it needs another file, {name}")

    def __iter__(self) -> Iterator[str]:
        return iter(())

    def __len__(self) -> int:
        return 0


def read_scene(suffix: str, content: bytes) -> Triangles:
    """Read all triangles, moved by the nodes of the scene; in metres, or the file's unit. Raises MeshError."""
    if suffix in (".gltf", ".glb"):
        for compression in _COMPRESSIONS:
            if compression in content:
                raise MeshError(f"it is compressed ({compression.decode()})")
    with damage_is_an_error():
        if suffix == ".gltf":
            json.loads(content)  # where this fails, trimesh looks for another file
        mesh = joined(_parts(suffix, content))
        announced = _ANNOUNCED[suffix].search(content) if suffix in _ANNOUNCED else None
        if announced and len(mesh.faces) < int(announced[1]):  # trimesh passes over those that are missing
            raise MeshError("its end is missing")
    return mesh


def _parts(suffix: str, content: bytes) -> Iterator[Triangles]:
    scene = trimesh.load_scene(
        io.BytesIO(content), file_type=suffix[1:], resolver=_NoOtherFiles(), process=False, skip_materials=True
    )
    for node in scene.graph.nodes_geometry:
        pose, name = scene.graph[node]
        geometry = scene.geometry[name]
        if isinstance(geometry, trimesh.Trimesh):
            yield placed(Triangles(np.asarray(geometry.vertices, dtype=np.float64), np.asarray(geometry.faces)), pose)
