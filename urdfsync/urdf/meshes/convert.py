"""A mesh file as the package needs it: STL and OBJ in metres, with the facts that models need of the shape."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import Conversion, Dependency
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.meshes.errors import MeshError
from urdfsync.urdf.meshes.plain import PLAIN, bounds
from urdfsync.urdf.meshes.process import THREADS, MeshProcess

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
    mesh, with_hull = lookup.mesh(dependency.key), lookup.HULL in dependency.facts
    suffix, as_is = lookup.suffix(mesh.filename), lookup.as_is(mesh)
    try:
        if suffix not in _FORMATS:
            raise MeshError(f"its format isn't one of {', '.join(_FORMATS)}")  # noqa: TRY301 - told as what readers find
        if suffix not in PLAIN or len(content) > _SMALL:
            stl, facts = _process.read(suffix, mesh.scale, content, with_hull)
            return Conversion(content if as_is else stl, facts)
        corners = PLAIN[suffix](content)
        if as_is and not with_hull:
            return Conversion(content, {"bounds": bounds(corners)})
        with _single_thread():
            from urdfsync.urdf.meshes.geometry import binary_stl, import_form, triangles  # with numpy, see `plain`
        form, facts = import_form(triangles(corners), mesh.scale, with_hull)
        return Conversion(content if as_is else binary_stl(form), facts)
    except MeshError as error:
        message = f"the mesh {mesh.filename} can't be read: {error}"
        hint = "export it again, best as STL or OBJ"
        raise SourceError(Diagnostic(Severity.ERROR, "unreadable-mesh", message, str(file), hint=hint)) from error


@contextlib.contextmanager
def _single_thread() -> Iterator[None]:
    """Have numpy run in one thread if it is loaded within this context for the first time.

    Its threads wait for each other in a loop: the outermost points of eleven small meshes take 90 ms of CPU time with
    them, and 30 ms without. The variable is removed afterwards, since commands of the user's must not inherit it.
    """
    if THREADS in os.environ:  # the user chose
        yield
        return
    os.environ[THREADS] = "1"
    try:
        yield
    finally:
        del os.environ[THREADS]
