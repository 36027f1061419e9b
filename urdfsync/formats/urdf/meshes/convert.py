"""Converts a mesh file for the package: to STL and OBJ in metres, with facts of the shape for models."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from urdfsync.common.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import Conversion, Dependency
from urdfsync.domain.scene import PageMesh
from urdfsync.formats.urdf.meshes import lookup
from urdfsync.formats.urdf.meshes.process import STL_COUNT, MeshError, MeshProcess, MeshRequest, is_binary_stl

_FORMATS = (".dae", ".glb", ".gltf", ".obj", ".off", ".ply", ".stl")

_process = MeshProcess()


def convert(dependency: Dependency, file: Path, content: bytes, others: Mapping[str, bytes]) -> Conversion:
    """Return the imported form of the mesh in `file`, and its facts.

    Form and facts depend only on contents, URI and scale. `others` has the mesh's libraries of materials and textures.

    STL and OBJ files without a scale stay unchanged; all other files become binary STL with the scale applied. The fact
    `bounds` is `[[x, y, z], [x, y, z]]`, least and greatest. If the dependency needs outermost points, the fact `hull`
    has them (see `geometry.support_points`). Both facts are in metres, in the mesh's frame. If shapes need the mesh's
    colours (see `lookup.PARTS`), a mesh of several colours becomes one file per colour: OBJ for an OBJ without a scale,
    else STL.

    Raises SourceError with the diagnostic `unreadable-mesh`.
    """
    mesh = lookup.mesh(dependency.key)
    suffix = lookup.suffix(mesh.filename)
    try:
        if suffix not in _FORMATS:
            raise MeshError(f"the format isn't one of {', '.join(_FORMATS)}")  # noqa: TRY301 - reported like findings of the process
        colors = next((name for name in (lookup.PARTS, lookup.COLORS) if name in dependency.facts), "")
        is_obj = suffix == ".obj" and lookup.as_is(mesh)
        request = MeshRequest(suffix, mesh.scale, lookup.HULL in dependency.facts, colors, is_obj)
        (whole, facts), *parts = _process.read(request, content, others)
    except MeshError as error:
        message = f"the mesh {mesh.filename} can't be read: {error}"
        finding = Diagnostic(Severity.ERROR, "unreadable-mesh", message, str(file), hint=error.hint)
        raise SourceError(finding) from error
    is_split = colors == lookup.PARTS and parts
    more = tuple(Conversion(part, its_facts) for part, its_facts in parts)
    return Conversion(content if lookup.as_is(mesh) and not is_split else whole, facts, more)


def stated_triangles(content: bytes) -> int | None:
    """Return the number of triangles in the head of a binary STL file; None for any other file."""
    return int.from_bytes(content[STL_COUNT], "little") if is_binary_stl(content) else None


def triangles(path: str, content: bytes, key: str, most: int) -> PageMesh | str:
    """Return about `most` triangles of a mesh without its scale, or the reason why the mesh can't be read.

    The mesh is the imported file at `path`, to which the scale in `key` is applied. Without a path, `content` is the
    file that the URDF names.
    """
    mesh = lookup.mesh(key)
    scale = [1 / factor if path and factor else 1.0 for factor in mesh.scale]
    try:
        request = MeshRequest(
            lookup.suffix(path or mesh.filename), (scale[0], scale[1], scale[2]), with_hull=False, most=most
        )
        ((packed, facts),) = _process.read(request, content)
    except MeshError as error:
        return str(error)
    return PageMesh(content=packed, **facts)
