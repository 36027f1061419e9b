"""A mesh file as the package needs it: STL and OBJ in metres, with the facts that models need of the shape."""

from __future__ import annotations

from pathlib import Path

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import Conversion, Dependency
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.meshes.errors import MeshError
from urdfsync.urdf.meshes.plain import PLAIN, bounds
from urdfsync.urdf.meshes.process import MeshProcess
from urdfsync.urdf.robot import Mesh

_FORMATS = (".dae", ".glb", ".gltf", ".obj", ".off", ".ply", ".stl")
_SMALL = 1_000_000
"""Bytes of STL and OBJ files that are read in this process: whatever they hold, that takes less than the limits of the
other one. Starting it takes as long as a small robot."""

_process = MeshProcess()


def convert(dependency: Dependency, file: Path, content: bytes) -> Conversion:
    """The imported form of a mesh found at `file`, and its facts; a function of `content`, URI and scale.

    STL and OBJ files without a scale stay as they are; all else becomes binary STL with the scale
    applied. The facts are `bounds` (`[[x, y, z], [x, y, z]]`, least and greatest) and, if the dependency needs it,
    `hull` (see `geometry.support_points`), in metres and in the mesh's frame.

    Raises SourceError with one diagnostic, `unreadable-mesh`, if the file can't be read as a mesh.
    """
    mesh = lookup.mesh(dependency.key)
    try:
        return _convert(mesh, content, lookup.HULL in dependency.facts)
    except MeshError as error:
        message = f"the mesh {mesh.filename} can't be read: {error}"
        hint = "export it again, best as STL or OBJ"
        raise SourceError(Diagnostic(Severity.ERROR, "unreadable-mesh", message, str(file), hint=hint)) from error


def _convert(mesh: Mesh, content: bytes, with_hull: bool) -> Conversion:
    suffix, as_is = lookup.suffix(mesh.filename), lookup.as_is(mesh)
    if suffix not in _FORMATS:
        raise MeshError(f"its format isn't one of {', '.join(_FORMATS)}")
    if suffix in PLAIN and len(content) <= _SMALL:
        corners = PLAIN[suffix](content)
        if as_is and not with_hull:
            return Conversion(content, {"bounds": bounds(corners)})
        from urdfsync.urdf.meshes.geometry import binary_stl, import_form, triangles  # with numpy, see `plain`

        form, facts = import_form(triangles(corners), mesh.scale, with_hull)
        return Conversion(content if as_is else binary_stl(form), facts)
    stl, facts = _process.read(suffix, mesh.scale, content, with_hull)
    return Conversion(content if as_is else stl, facts)
