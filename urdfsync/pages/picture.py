"""Makes the picture of a robot: its scenes, and the triangles of their meshes. Simplified meshes are remembered."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

import msgspec

from urdfsync.answers.dependencies import read_file
from urdfsync.checks import cache as caches
from urdfsync.checks.fingerprint import program
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.domain import Import
from urdfsync.engine.generation import Generation
from urdfsync.engine.last_build import NO_MODEL
from urdfsync.files import digest, shown
from urdfsync.pages.scene import Pictures, Scene, Triangles
from urdfsync.versions.comparison import Contents

_MOST, _MOST_IN_ALL = 60_000, 500_000
"""The most triangles of one mesh, and of all meshes, which share these equally. A triangle takes some 13 bytes."""
_MOST_REFUSED = 4
"""The most files that are read for the picture although they are too large for the package: each may take 16 s."""


class Picture(msgspec.Struct, frozen=True):
    """A robot, and its older version. Their shapes name meshes by the hashes of their contents."""

    now: Scene
    before: Scene | None
    """None if nothing changed, or there is no older version."""
    meshes: Mapping[str, Triangles]
    """The meshes of both versions."""
    notes: Sequence[str]
    """Missing and simplified meshes, in words."""


class _File(NamedTuple):
    """A mesh file; `key` is the key of a dependency that is too large for the package, empty for an imported file."""

    path: str
    content: bytes
    key: str = ""


def picture(generation: Generation, older: Contents | None) -> Picture:
    """Return the picture of a robot, beside an older version. Raises UrdfsyncError for a domain without pictures."""
    robot, refused = generation.inputs.robot, generation.imported.refused
    imports, files = _by_hash((generation.now, generation.imported.contents))
    for dependency, file in refused[:_MOST_REFUSED]:
        if dependency.key not in imports:  # else an earlier build's copy is used
            with contextlib.suppress(OSError):
                content = read_file(file)
                name = f"{digest(content)} {dependency.key}"
                imports[dependency.key] = Import(name, "", "", {})
                files[name] = _File(dependency.target, content, dependency.key)
    pictures: Pictures | None = generation.inputs.domain.pictures
    if pictures is None:
        message = f"packages of the domain `{robot.domain}` have no picture"
        raise UrdfsyncError.of("no-picture", message, shown(robot.source))
    now, before = pictures.scene(generation.now.snapshot, imports, robot.target, robot.options), None
    if older:
        version, (imports, files_before) = older[0], _by_hash(older)
        with contextlib.suppress(*NO_MODEL):  # the recorded model may be invalid
            before = pictures.scene(version.snapshot, imports, robot.target, version.options or robot.options)
        files |= files_before
    used = {shape.mesh for scene in (now, before) if scene for body in scene.bodies for shape in body.shapes}
    names = sorted(used & files.keys())
    most, code = min(_MOST, _MOST_IN_ALL // max(1, len(names))), program(robot.domain)
    cache = caches.UserCache.default()
    meshes = {name: _read(pictures, cache, name, files[name], most, code) for name in names}
    if any(isinstance(mesh, Triangles) and mesh.is_simplified for mesh in meshes.values()):
        cache.trim()
    notes = (f"{files[name].path} {note}" for name, mesh in meshes.items() if (note := _note(mesh)))
    shown_meshes = {name: mesh for name, mesh in meshes.items() if isinstance(mesh, Triangles)}
    return Picture(now, before, shown_meshes, (*now.missing, *notes))


def _by_hash(version: Contents) -> tuple[dict[str, Import], dict[str, _File]]:
    """Return the imports of a version with hashes in place of paths, and their files by these hashes."""
    imports, contents = version[0].imports or {}, version[1]
    present = [entry for entry in imports.values() if entry.target in contents]
    files = {entry.target_hash: _File(entry.target, contents[entry.target]) for entry in present}
    return {key: msgspec.structs.replace(entry, target=entry.target_hash) for key, entry in imports.items()}, files


def _read(
    pictures: Pictures, cache: caches.UserCache, name: str, file: _File, most: int, code: Iterable[object]
) -> Triangles | str:
    """Return the triangles of a mesh, or why it can't be shown."""
    key = caches.digest(name, file.path, most, *code)
    if known := cache.load(key, Triangles):
        return known
    mesh = pictures.triangles(*file, most)
    if isinstance(mesh, Triangles) and mesh.is_simplified:  # simplifying takes up to 16 s
        cache.save(key, mesh)
    return mesh


def _note(mesh: Triangles | str) -> str:
    """Return the note about a missing or simplified mesh."""
    if isinstance(mesh, str):
        return f"can't be shown: {mesh}"
    # triangles without area are never drawn
    told = f"is simplified for this page: {mesh.faces:,} of its {mesh.total:,} triangles are left"
    return told if mesh.is_simplified else ""
