"""A mesh file as the package needs it: STL and OBJ in metres, with the facts that models need of the shape."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import Conversion, Dependency
from urdfsync.urdf.meshes import lookup as mesh_lookup
from urdfsync.urdf.meshes.errors import MeshError
from urdfsync.urdf.meshes.geometry import Array, bounds, placed, support_points
from urdfsync.urdf.meshes.reading import FACET, read_mesh
from urdfsync.urdf.robot import Vector

_HEADER = b"binary STL, written by urdfsync".ljust(80)


def convert(dependency: Dependency, file: Path, content: bytes) -> Conversion:
    """The imported form of a mesh found at `file`, and its facts; a function of `content`, URI and scale.

    STL and OBJ files without a scale stay as they are; all else becomes binary STL with the scale
    applied. The facts are `bounds` (`[[x, y, z], [x, y, z]]`, least and greatest) and `hull` (see
    `mesh_geometry.support_points`), in metres and in the mesh's frame.

    Raises SourceError with one diagnostic, `unreadable-mesh`, if the file can't be read as a mesh.
    """
    mesh = mesh_lookup.mesh(dependency.key)
    try:
        corners = _scaled(read_mesh(mesh_lookup.suffix(mesh.filename), content), mesh.scale)
    except MeshError as error:
        message = f"the mesh {mesh.filename} can't be read: {error}"
        hint = "export it again, best as STL or OBJ"
        raise SourceError(Diagnostic(Severity.ERROR, "unreadable-mesh", message, str(file), hint=hint)) from error
    points = corners.reshape(-1, 3)
    imported = content if mesh_lookup.as_is(mesh) else _binary_stl(corners)
    return Conversion(imported, {"bounds": bounds(points), "hull": support_points(points)})


def _scaled(corners: Array, scale: Vector) -> Array:
    """The triangles (n × 3 × 3), within the range of the numbers in an STL file. Raises MeshError."""
    with np.errstate(over="ignore", invalid="ignore"):
        scaled = placed(corners, np.diag((*scale, 1.0)))
    if not (np.abs(scaled) <= np.finfo(np.float32).max).all():
        raise MeshError("its coordinates are too large for single precision")
    return scaled


def _binary_stl(corners: Array) -> bytes:
    """Triangles (n × 3 × 3) as binary STL; the normal of a triangle without area is zero."""
    facets = np.zeros(len(corners), dtype=FACET)
    facets["corners"] = corners
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.sqrt(normals[:, 0] ** 2 + normals[:, 1] ** 2 + normals[:, 2] ** 2)[:, np.newaxis]
    facets["normal"] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
    return b"".join((_HEADER, struct.pack("<I", len(corners)), facets.tobytes()))
