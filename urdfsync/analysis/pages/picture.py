"""Makes the picture of a robot: its scenes, and the triangles of their meshes. Simplified meshes are remembered."""

from __future__ import annotations

import contextlib
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import NamedTuple, TypeAlias

import msgspec

from urdfsync.analysis.checks import cache as caches
from urdfsync.analysis.versions.comparison import VersionContents
from urdfsync.common.dependencies.program import contents_hash
from urdfsync.common.dependencies.reads import read_file
from urdfsync.common.diagnostics import UrdfsyncError
from urdfsync.common.files import digest, shown
from urdfsync.domain import Import, Role, Target, Version, registry
from urdfsync.domain.scene import Body, Hinge, LoopConstraint, PageMesh, Pictures, Scene
from urdfsync.engine.edits import EditedFile
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.last_build import NO_MODEL
from urdfsync.modelica.values import literals, read_values

_MOST, _LEAST = 500_000, 200
"""The greatest number of triangles of a page, and the least share of one mesh. A triangle takes some 13 bytes."""
_FINE = 200
"""With fewer cells along a mesh's longest edge, in each of which corners are merged, the loss is visible."""
_Place: TypeAlias = tuple[str, str]
"""An element, and the path of a value in its record."""
_MOST_REFUSED = 4
"""The greatest number of files that are too large for the package, but read for the picture: each may take 16 s."""


class Picture(msgspec.Struct, frozen=True):
    """A robot, and its older version."""

    now: Scene
    before: Scene | None
    """None if nothing changed, or there is no older version."""
    meshes: Mapping[str, PageMesh]
    """The meshes of both versions by their names, those of visual shapes first."""
    poses: Mapping[str, Mapping[str, float]]
    """Named poses of files beside the source: positions by hinges."""
    undrawn: Sequence[str]
    """Files of the package with edits that the picture does not show."""
    notes: Sequence[str]
    """Sentences about missing parts, then about meshes whose simplification is visible."""


class _EditedNumbers(NamedTuple):
    """Numbers that the user wrote into the record of an element."""

    values: tuple[float, ...]
    file: str
    """The record's path below the package."""


class _MeshFile(NamedTuple):
    """A file with a mesh: an imported one, or, if that is too large for the package, the source's file."""

    path: str
    content: bytes
    key: str
    is_source: bool = False


def picture(
    inputs: Inputs, generation: Generation, older: VersionContents | None, edited: Sequence[EditedFile]
) -> Picture:
    """Return the picture of a robot, beside an older version, both with the edited numbers of its records.

    The facts are those of the source. Raises UrdfsyncError for a domain without pictures.
    """
    robot, imported = inputs.robot, generation.imported
    pictures = inputs.domain.pictures
    if pictures is None:
        message = f"packages of the domain `{robot.domain}` have no picture"
        raise UrdfsyncError.of("no-picture", message, shown(robot.source))
    imports, sources = dict(generation.now.imports or {}), dict[str, _MeshFile]()
    for dependency, file in imported.refused[:_MOST_REFUSED]:
        if dependency.key not in imports:  # otherwise the copy of an earlier build is used
            with contextlib.suppress(OSError):
                content = read_file(file)
                imports[dependency.key] = Import(dependency.target, digest(content), "", {})
                sources[dependency.key] = _MeshFile(dependency.target, content, dependency.key, is_source=True)
    numbers, undrawn = _edited_numbers(inputs, generation, edited)
    version = msgspec.structs.replace(generation.now, imports=imports, options=robot.options)
    now, names, lacking = _scene(pictures, version, robot.target, numbers)
    undrawn += (numbers[place].file for place in lacking)
    before, files = None, _by_name(names, imports, imported.contents, sources)
    if older:
        version, contents = older
        with contextlib.suppress(*NO_MODEL):  # the recorded model may be invalid
            version = msgspec.structs.replace(version, options=version.options or robot.options)
            before, names, _ = _scene(pictures, version, robot.target, numbers)
            files |= _by_name(names, version.imports or {}, contents, {})
    shapes = [shape for scene in (now, before) if scene for body in scene.bodies for shape in body.shapes]
    seen = sorted(files.keys() & {shape.mesh for shape in shapes if shape.kind == "visual"})
    others = sorted(files.keys() & {shape.mesh for shape in shapes} - {*seen})
    cache, code, most, meshes = (
        caches.UserCache.default(),
        contents_hash(*registry.code(robot.domain)),
        _MOST,
        dict[str, PageMesh | str](),
    )
    for group in (seen, others):
        stated = {name: pictures.stated_triangles(files[name].content) for name in group}
        read = {name: _read(pictures, cache, files[name], _MOST, code) for name in group if stated[name] is None}
        counts = {name: count for name, count in stated.items() if count is not None}
        counts |= {name: mesh.faces for name, mesh in read.items() if isinstance(mesh, PageMesh)}
        shares = dict.fromkeys(counts.keys() - read.keys(), _MOST) | _shares(counts, most)
        read |= {name: _read(pictures, cache, files[name], share, code) for name, share in shares.items()}
        most -= sum(mesh.faces for mesh in read.values() if isinstance(mesh, PageMesh))
        meshes |= read
    if any(isinstance(mesh, PageMesh) and mesh.cells for mesh in meshes.values()):
        cache.trim()
    notes = (f"{files[name].path} can't be shown: {mesh}" for name, mesh in meshes.items() if isinstance(mesh, str))
    shown_meshes = {name: mesh for name, mesh in meshes.items() if isinstance(mesh, PageMesh)}
    poses, faults = pictures.named_poses(robot.source, generation.now.snapshot)
    return Picture(
        now,
        before,
        shown_meshes,
        poses,
        [*dict.fromkeys(undrawn)],
        (*now.missing, *faults, *notes, *_coarse(shown_meshes, files)),
    )


def _edited_numbers(
    inputs: Inputs, generation: Generation, files: Sequence[EditedFile]
) -> tuple[dict[_Place, _EditedNumbers], list[str]]:
    """Return the edited numbers of records by their places, and the files with other edits."""
    numbers, others = dict[_Place, _EditedNumbers](), list[str]()
    for file in files:
        path = inputs.folder.path(file.path)
        artifact, edits = generation.package.artifacts.get(path), file.edits
        if edits is not None and all(edit.is_for_readers or edit.part == "layout" for edit in edits):
            continue
        if edits is None or file.base is None or artifact is None or artifact.role is not Role.RECORD:
            others.append(path)
            continue
        base, mine = ({value.path: value for value in read_values(text)} for text in (file.base, file.mine))
        others += [path] * (not base.keys() <= mine.keys())
        for value in mine.values():
            if value.path in base and value.text == base[value.path].text:
                continue
            element, rest = file.owner, value.path
            if " " not in file.owner:  # the record of the whole robot
                component, _, rest = value.path.partition(".")
                name = mine.get(f"{component}.name")
                element = f"{'link' if value.type.endswith('.Link') else 'joint'} {literals(name.text) if name else ''}"
            values = literals(value.text)
            if isinstance(values, tuple):
                numbers[element, rest] = _EditedNumbers(values, path)
            else:
                others.append(path)
    return numbers, others


def _scene(
    pictures: Pictures, version: Version, target: Target, numbers: Mapping[_Place, _EditedNumbers]
) -> tuple[Scene, Mapping[str, str], Collection[_Place]]:
    """Return the scene of a version with edited numbers, the imports of its meshes, and the places that it lacks."""
    arguments = version.imports or {}, target, version.options
    plain, names = pictures.scene(version.snapshot, *arguments)
    snapshot, lacking = pictures.with_numbers(version.snapshot, {place: each.values for place, each in numbers.items()})
    try:
        scene, _ = pictures.scene(snapshot, *arguments)
    except NO_MODEL:  # the edited numbers open a loop, say
        return plain, names, numbers.keys()
    parts: Sequence[Body | Hinge | LoopConstraint] = (*plain.bodies, *plain.hinges, *plain.loops)
    facts = {part.element: part.facts for part in parts}
    replace = msgspec.structs.replace
    scene = replace(
        scene,
        bodies=tuple(replace(body, facts=facts[body.element]) for body in scene.bodies),
        hinges=tuple(replace(hinge, facts=facts[hinge.element]) for hinge in scene.hinges),
        loops=tuple(replace(loop, facts=facts[loop.element]) for loop in scene.loops),
    )
    return scene, names, lacking


def _by_name(
    names: Mapping[str, str],
    imports: Mapping[str, Import],
    contents: Mapping[str, bytes],
    sources: Mapping[str, _MeshFile],
) -> dict[str, _MeshFile]:
    """Return the available file of each mesh."""
    present = {key: file.target for key, file in imports.items() if file.target in contents}
    files = {**{key: _MeshFile(target, contents[target], key) for key, target in present.items()}, **sources}
    return {names[key]: files[key] for key in sorted(files, reverse=True)}


def _shares(faces: Mapping[str, int], most: int) -> dict[str, int]:
    """Return the triangles of each mesh that has to be simplified; others get what small meshes do not need."""
    shares = dict[str, int]()
    for number, name in enumerate(sorted(faces, key=faces.__getitem__)):
        share = max(_LEAST, most // (len(faces) - number))
        if faces[name] > share:
            shares[name] = share
        most -= min(faces[name], share)
    return shares


def _read(
    pictures: Pictures, cache: caches.UserCache, file: _MeshFile, most: int, code: Iterable[object]
) -> PageMesh | str:
    """Return the triangles of a mesh, or why it can't be shown."""
    key = caches.digest(digest(file.content), file.path, file.key, most, *code)
    if known := cache.load(key, PageMesh):
        return known
    mesh = pictures.triangles("" if file.is_source else file.path, file.content, file.key, most)
    if isinstance(mesh, PageMesh) and mesh.cells:  # simplifying takes up to 16 s
        cache.save(key, mesh)
    return mesh


def _coarse(meshes: Mapping[str, PageMesh], files: Mapping[str, _MeshFile]) -> Iterable[str]:
    """Yield one line about all meshes whose simplification is visible, if there are any."""
    coarse = sorted((mesh.faces / mesh.total, name) for name, mesh in meshes.items() if 0 < mesh.cells < _FINE)
    if coarse:
        (_, worst), count = coarse[0], len(coarse)
        example = f"{files[worst].path} has {meshes[worst].faces:,} of its {meshes[worst].total:,} triangles"
        yield f"{count} {'mesh is' if count == 1 else 'meshes are'} coarser here than in the file: {example}"
