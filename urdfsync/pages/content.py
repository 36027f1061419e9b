"""All that the page of a robot shows, gathered from what other commands know. Writes nothing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

import msgspec

from urdfsync import registry
from urdfsync.changes import Changes
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.domain import ChangeClass, ChangeKind, Version
from urdfsync.engine.edits import RobotEdits, find_edited
from urdfsync.engine.generation import Generation, generate_robot
from urdfsync.engine.inputs import inspect
from urdfsync.engine.last_build import NO_MODEL
from urdfsync.engine.options import BuildOptions
from urdfsync.files import digest, shown
from urdfsync.output.conflicts import DisputedFile, find_conflicts
from urdfsync.output.markdown import Section
from urdfsync.output.outline import outline
from urdfsync.scene import Body, Scene, Triangles
from urdfsync.versions.comparison import Comparison, compare_sources
from urdfsync.versions.report import to_section


class Content(msgspec.Struct, frozen=True):
    """The page of one robot as values."""

    robot: RobotConfig
    section: Section
    """What changed, in words."""
    against: str
    """The older version, in words."""
    now: Scene
    before: Scene | None
    """None if nothing changed, or there is no older version."""
    meshes: Mapping[str, Triangles]
    """By the names that shapes have for them, in both versions."""
    statuses: Mapping[str, str]
    """Elements that are `changed`, `added`, `removed` or `renamed`."""
    renamed: Mapping[str, str]
    """New names of elements by the old ones."""
    changes: Mapping[str, Sequence[str]]
    """What changed of each element, in words."""
    files: Mapping[str, Sequence[str]]
    """Files of each element, as people see them."""
    diagram: str
    """SVG; empty if there is none."""
    edits: RobotEdits
    conflicts: Sequence[DisputedFile]
    notes: Sequence[str]
    """What the picture does not show as it is."""


def gather(config: Config, robot: RobotConfig, against: str | None, options: BuildOptions, folder: Path) -> Content:
    """Return all about one robot; `against` is a file, counted from `folder`, or a git revision.

    Raises UrdfsyncError if the source can't be read, or the older version.
    """
    options = msgspec.structs.replace(options, dry=True)
    (compared,) = compare_sources([robot], against, config, options, folder)
    if compared.result.failed:
        raise UrdfsyncError(*compared.result.diagnostics)
    generation = generate_robot(inspect(config, robot, options))
    pictures = _Pictures(robot)
    now = pictures.scene(generation.now, generation.imported.contents)
    if now is None:
        message = f"packages of the domain `{robot.domain}` have no picture"
        raise UrdfsyncError.of("no-picture", message, shown(robot.source))
    changes = compared.result.changes
    before, renamed = None, dict[str, str]()
    if changes is not None and changes.changes:
        renamed = {f"{kind} {old}": f"{kind} {new}" for (kind, old), new in changes.renames.items()}
        before = _before(generation, compared, pictures)
    meshes, problems = pictures.triangles()
    actions = compared.result.actions if against is None else None  # others are those of a comparison
    drawing = pictures.domain.drawing(generation.now.snapshot, generation.imported.imports, robot.target, robot.options)
    return Content(
        robot=robot,
        section=to_section(compared),
        against="the last build" if against is None else against,
        now=now,
        before=before,
        meshes=meshes,
        statuses=_statuses(changes, now, before) if changes else {},
        renamed=renamed,
        changes=_change_words(changes) if changes else {},
        files=_files(generation),
        diagram=drawing or "",
        edits=RobotEdits(robot.name, config.root, tuple(find_edited(generation, actions))),
        conflicts=find_conflicts([compared.result]),
        notes=(*now.missing, *problems, *_simplified(meshes, pictures.names)),
    )


class _Pictures:
    """Scenes of a robot, and the contents of their meshes: one that both versions have is there once."""

    def __init__(self, robot: RobotConfig) -> None:
        self.domain, self._robot = registry.domain(robot.domain), robot
        self._contents = dict[str, bytes]()
        self.names = dict[str, str]()
        """Names of the files for people."""

    def scene(self, version: Version, contents: Mapping[str, bytes]) -> Scene | None:
        """Return the scene of a version, whose shapes have the names of meshes; `contents` are by path."""
        options = self._robot.options if version.options is None else version.options
        scene = self.domain.scene(version.snapshot, version.imports or {}, self._robot.target, options)
        if scene is None:
            return None
        bodies = [
            msgspec.structs.replace(
                body,
                shapes=tuple(
                    msgspec.structs.replace(shape, mesh=self._mesh(shape.mesh, contents)) for shape in body.shapes
                ),
            )
            for body in scene.bodies
        ]
        return msgspec.structs.replace(scene, bodies=tuple(bodies))

    def _mesh(self, path: str, contents: Mapping[str, bytes]) -> str:
        if not path or path not in contents:
            return ""
        name = f"{digest(contents[path])}{PurePosixPath(path).suffix}"
        self._contents[name], self.names[name] = contents[path], path
        return name

    def triangles(self) -> tuple[Mapping[str, Triangles], list[str]]:
        """Return the meshes of all scenes, and in words which can't be shown."""
        if not self._contents:
            return {}, []
        meshes, problems = self.domain.triangles(self._contents)
        return meshes, [f"{self.names[name]} can't be shown: {problem}" for name, problem in problems.items()]


def _before(generation: Generation, compared: Comparison, pictures: _Pictures) -> Scene | None:
    """Return the older version's scene; None if there is none, or what is recorded of it is no model."""
    if compared.versions:
        return pictures.scene(*compared.versions[0])
    last = generation.inputs.last
    if last.version is None:
        return None
    contents = dict[str, bytes]()
    for entry in (last.version.imports or {}).values():
        content = generation.inputs.files.read(last.folder.key(entry.target))
        if content is not None and digest(content) == entry.target_hash:
            contents[entry.target] = content
    try:
        return pictures.scene(last.version, contents)
    except NO_MODEL:
        return None


def _statuses(changes: Changes, now: Scene, before: Scene | None) -> dict[str, str]:
    """Return which elements differ; rounding, and what is not modelled, is no difference."""
    statuses = dict[str, str]()
    for change in changes.changes:
        kind = change.element.partition(" ")[0]
        if change.kind is ChangeKind.RENAMED:
            statuses[f"{kind} {change.new}"] = "renamed"
        elif len(change.path) == 1:
            statuses[change.element] = str(change.kind)
        elif not (change.noise or change.change_class is ChangeClass.UNMODELLED):
            statuses[change.element] = "changed"
    old = {body.element: _looks(body) for body in before.bodies} if before else {}
    for body in now.bodies:  # a mesh may have another content
        if body.element in old and old[body.element] != _looks(body):
            statuses.setdefault(body.element, "changed")
    return statuses


def _looks(body: Body) -> list[Any]:
    return [(shape.kind, shape.form, shape.mesh) for shape in body.shapes]


def _change_words(changes: Changes) -> dict[str, list[str]]:
    """Return what changed of each element that has its own row."""
    words = dict[str, list[str]]()
    for element, of_element in changes.by_element().items():
        rows = outline(msgspec.structs.replace(changes, changes=tuple(of_element)))
        words[element] = [str(row) for of_rows in rows.values() for row in of_rows]
    return words


def _files(generation: Generation) -> dict[str, list[str]]:
    folder, files = generation.inputs.robot.folder, dict[str, list[str]]()
    for path, artifact in generation.package.artifacts.items():
        files.setdefault(artifact.owner, []).append(shown(folder / path))
    return files


def _simplified(meshes: Mapping[str, Triangles], names: Mapping[str, str]) -> Iterator[str]:
    """Yield a sentence for each mesh of which the page has fewer triangles than the file."""
    for name, mesh in meshes.items():
        # triangles without area are left out of every mesh
        if mesh.is_simplified:
            numbers = f"{len(mesh.faces):,} of its {mesh.total:,} triangles"
            yield f"{names[name]} is simplified for this page: {numbers} are left"
