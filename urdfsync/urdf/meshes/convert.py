"""A mesh file as the package needs it: STL and OBJ in metres, with the facts that models need of the shape."""

from __future__ import annotations

from pathlib import Path

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import Conversion, Dependency
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.meshes.process import MeshError, MeshProcess

_FORMATS = (".dae", ".glb", ".gltf", ".obj", ".off", ".ply", ".stl")

_process = MeshProcess()


def convert(dependency: Dependency, file: Path, content: bytes) -> Conversion:
    """The imported form of a mesh found at `file`, and its facts; a function of `content`, URI and scale.

    STL and OBJ files without a scale stay as they are; all else becomes binary STL with the scale
    applied. The facts are `bounds` (`[[x, y, z], [x, y, z]]`, least and greatest) and, if the dependency needs it,
    `hull` (see `geometry.support_points`), in metres and in the mesh's frame.

    Raises SourceError with one diagnostic, `unreadable-mesh`, if the file can't be read as a mesh.
    """
    mesh = lookup.mesh(dependency.key)
    suffix = lookup.suffix(mesh.filename)
    try:
        if suffix not in _FORMATS:
            raise MeshError(f"its format isn't one of {', '.join(_FORMATS)}")  # noqa: TRY301 - told as what the process finds
        stl, facts = _process.read(suffix, mesh.scale, content, with_hull=lookup.HULL in dependency.facts)
    except MeshError as error:
        message = f"the mesh {mesh.filename} can't be read: {error}"
        hint = "export it again, best as STL or OBJ"
        raise SourceError(Diagnostic(Severity.ERROR, "unreadable-mesh", message, str(file), hint=hint)) from error
    return Conversion(content if lookup.as_is(mesh) else stl, facts)
