"""Converts a mesh file for the package: to STL and OBJ in metres, with facts of the shape for models."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import Conversion, Dependency
from urdfsync.pages.scene import Triangles
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.meshes.process import MeshError, MeshProcess, Request

_FORMATS = (".dae", ".glb", ".gltf", ".obj", ".off", ".ply", ".stl")

_process = MeshProcess()


def convert(dependency: Dependency, file: Path, content: bytes, others: Mapping[str, bytes]) -> Conversion:
    """Return the imported form of a mesh at `file`, and its facts. Both depend only on contents, URI and scale.

    `others` has the libraries of materials and the textures that the mesh names.

    STL and OBJ files without a scale stay as they are; all else becomes binary STL with the scale applied. The facts
    are `bounds` (`[[x, y, z], [x, y, z]]`, least and greatest) and, if the dependency needs it, `hull` (see
    `geometry.support_points`). Both are in metres and in the mesh's frame. If its colours are needed (see
    `lookup.PARTS`), a mesh of several colours becomes one file per colour: OBJ if an OBJ stays as it is, else STL.

    Raises SourceError with one diagnostic, `unreadable-mesh`, if the file can't be read as a mesh.
    """
    mesh = lookup.mesh(dependency.key)
    suffix = lookup.suffix(mesh.filename)
    try:
        if suffix not in _FORMATS:
            raise MeshError(f"its format isn't one of {', '.join(_FORMATS)}")  # noqa: TRY301 - reported like findings of the process
        colors = next((name for name in (lookup.PARTS, lookup.COLORS) if name in dependency.facts), "")
        is_obj = suffix == ".obj" and lookup.as_is(mesh)
        request = Request(suffix, mesh.scale, lookup.HULL in dependency.facts, colors, is_obj)
        (whole, facts), *parts = _process.read(request, content, others)
    except MeshError as error:
        message = f"the mesh {mesh.filename} can't be read: {error}"
        hint = "export it again, best as STL or OBJ"
        raise SourceError(Diagnostic(Severity.ERROR, "unreadable-mesh", message, str(file), hint=hint)) from error
    is_split = colors == lookup.PARTS and parts
    more = tuple(Conversion(part, its_facts) for part, its_facts in parts)
    return Conversion(content if lookup.as_is(mesh) and not is_split else whole, facts, more)


def triangles(path: str, content: bytes, key: str, most: int) -> Triangles | str:
    """Return about `most` triangles of a mesh without its scale, or why there are none.

    The mesh is the imported file at `path`, which has the scale of its `key`; without a path it is the source's file.
    """
    mesh = lookup.mesh(key)
    scale = [1 / factor if path and factor else 1.0 for factor in mesh.scale]
    try:
        request = Request(
            lookup.suffix(path or mesh.filename), (scale[0], scale[1], scale[2]), with_hull=False, most=most
        )
        ((packed, facts),) = _process.read(request, content)
    except MeshError as error:
        return str(error)
    return Triangles(content=packed, **facts)
