"""A mesh file as the package needs it: STL and OBJ in metres, with the facts that models need of the shape."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import Conversion, Dependency
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.meshes.process import MeshError, MeshProcess, Request, is_binary_stl

_FORMATS = (".dae", ".glb", ".gltf", ".obj", ".off", ".ply", ".stl")

MOST = 60_000
"""Triangles of one mesh in a picture: a page has some 13 bytes for each."""

_process = MeshProcess()


def convert(dependency: Dependency, file: Path, content: bytes, others: Mapping[str, bytes]) -> Conversion:
    """Return the imported form of a mesh at `file`, and its facts; they depend on contents, URI and scale alone.

    `others` has the libraries of materials and the textures that it names.

    STL and OBJ files without a scale stay as they are; all else becomes binary STL with the scale applied. The facts
    are `bounds` (`[[x, y, z], [x, y, z]]`, least and greatest) and, if the dependency needs it, `hull` (see
    `geometry.support_points`). Both are in metres and in the mesh's frame. If its colours are needed (see
    `lookup.PARTS`), a mesh of several colours becomes a file for each, in its format if that stays.

    Raises SourceError with one diagnostic, `unreadable-mesh`, if the file can't be read as a mesh.
    """
    mesh = lookup.mesh(dependency.key)
    suffix = lookup.suffix(mesh.filename)
    try:
        if suffix not in _FORMATS:
            raise MeshError(f"its format isn't one of {', '.join(_FORMATS)}")  # noqa: TRY301 - told as what the process finds
        most = MOST if dependency.is_for_picture else 0
        colors = next((name for name in (lookup.PARTS, lookup.COLORS) if name in dependency.facts and not most), "")
        is_obj = suffix == ".obj" and lookup.as_is(mesh)
        request = Request(suffix, mesh.scale, lookup.HULL in dependency.facts, colors, is_obj, most)
        (whole, facts), *parts = _process.read(request, content, others)
    except MeshError as error:
        message = f"the mesh {mesh.filename} can't be read: {error}"
        hint = "export it again, best as STL or OBJ"
        raise SourceError(Diagnostic(Severity.ERROR, "unreadable-mesh", message, str(file), hint=hint)) from error
    is_split = colors == lookup.PARTS and parts
    more = tuple(Conversion(part, its_facts) for part, its_facts in parts)
    return Conversion(content if lookup.as_is(mesh) and not (is_split or most) else whole, facts, more)


def as_stl(suffix: str, content: bytes) -> bytes:
    """Return an imported mesh as binary STL. Raises MeshError."""
    if suffix == ".stl" and is_binary_stl(content):
        return content
    return _process.read(Request(suffix, with_hull=False), content)[0][0]
