"""All that the page of a robot shows, gathered from what other commands know. Writes nothing."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath

import msgspec

from urdfsync import registry
from urdfsync.changes import Changes, compare
from urdfsync.config import Config, RobotConfig
from urdfsync.dependencies import read_file
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.domain import ChangeClass, ChangeKind, Domain, Import
from urdfsync.engine.edits import RobotEdits, find_edited
from urdfsync.engine.generation import Generation, generate_robot
from urdfsync.engine.inputs import inspect
from urdfsync.engine.last_build import NO_MODEL
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.renames import find_renames
from urdfsync.engine.result import DisputedFile
from urdfsync.files import digest, shown
from urdfsync.output.outline import outline
from urdfsync.output.sections import Section
from urdfsync.scene import Scene, Triangles
from urdfsync.versions.comparison import Contents, compare_sources
from urdfsync.versions.report import to_section

_MOST_REFUSED = 4
"""Files that are tried once more for the picture: each may take 16 s."""


class Content(msgspec.Struct, frozen=True):
    """The page of one robot as values."""

    robot: RobotConfig
    version: Contents
    """What is shown."""
    section: Section
    """What changed, in words."""
    against: str
    """The older version, in words."""
    now: Scene
    before: Scene | None
    """None if nothing changed, or there is no older version."""
    meshes: Mapping[str, Triangles]
    """Those of both versions, by names that follow from their contents."""
    names_now: Mapping[str, str]
    names_before: Mapping[str, str]
    """The names by the paths that shapes have."""
    statuses: Mapping[str, str]
    """Elements that are `changed`, `added`, `removed` or `renamed`; the page adds those with other meshes."""
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


def gather(
    config: Config,
    robot: RobotConfig,
    against: str | None,
    options: BuildOptions,
    folder: Path,
    shown_before: Sequence[Contents] = (),
) -> Content:
    """Return all about one robot; `against` is a file, counted from `folder`, or a git revision.

    Where nothing changed since the last build, the older version is the first of `shown_before` that differs.
    Raises UrdfsyncError if the source can't be read, or the older version.
    """
    options = msgspec.structs.replace(options, dry=True)
    (compared,) = compare_sources([robot], against, config, options, folder)
    if compared.result.failed:
        raise UrdfsyncError(*compared.result.diagnostics)
    generation = generate_robot(inspect(config, robot, options))
    version = generation.now, generation.imported.contents
    changes, result = compared.result.changes, compared.result
    older = compared.versions[0] if compared.versions else _last_build(generation)
    domain, before = registry.domain(robot.domain), None
    other = next((each for each in shown_before if each[0] != version[0]), None)
    if other and not (changes and changes.changes):
        same = find_renames(domain, other[0].snapshot, version[0].snapshot, robot.renamed)
        older, changes = other, compare(other[0], version[0], domain, robot.options, same)
        told = msgspec.structs.replace(result, changes=changes)
        compared = msgspec.structs.replace(compared, result=told, against="the picture before")
    imports, files = {**generation.imported.imports}, {**version[1]}
    simplified = list(_add_refused(generation, domain, imports, files))
    now = domain.scene(version[0].snapshot, imports, robot.target, robot.options)
    if now is None:
        message = f"packages of the domain `{robot.domain}` have no picture"
        raise UrdfsyncError.of("no-picture", message, shown(robot.source))
    if older and changes and changes.changes:
        old, options_then = older[0], older[0].options or robot.options
        with contextlib.suppress(*NO_MODEL):  # what is recorded may be no model
            before = domain.scene(old.snapshot, old.imports or {}, robot.target, options_then)
    contents = [_meshes(now, (version[0], files)), _meshes(before, older)]
    paths = {name: path for every in contents for path, (name, _) in every.items()}
    meshes, problems = domain.triangles({name: content for every in contents for name, content in every.values()})
    names_now, names_before = ({path: name for path, (name, _) in every.items()} for every in contents)
    actions = result.actions if against is None else None  # others are those of a comparison
    renames = changes.renames if changes and before else {}
    return Content(
        robot=robot,
        version=version,
        section=to_section(compared),
        against=(compared.against or "the last build").encode("utf-8", "replace").decode(),
        now=now,
        before=before,
        meshes=meshes,
        names_now=names_now,
        names_before=names_before,
        statuses=_statuses(changes) if changes else {},
        renamed={f"{kind} {old}": f"{kind} {new}" for (kind, old), new in renames.items()},
        changes=_change_words(changes) if changes else {},
        files=_files(generation),
        diagram=domain.drawing(version[0].snapshot, generation.imported.imports, robot.target, robot.options) or "",
        edits=RobotEdits(robot.name, config.root, tuple(find_edited(generation, actions))),
        conflicts=result.conflicts,
        notes=(
            *now.missing,
            *simplified,
            *(f"{paths[name]} can't be shown: {problem}" for name, problem in problems.items()),
            # triangles without area are left out of every mesh
            *(
                f"{paths[name]} is simplified for this page: {len(of.faces):,} of its {of.total:,} triangles are left"
                for name, of in meshes.items()
                if of.is_simplified
            ),
        ),
    )


def _last_build(generation: Generation) -> Contents | None:
    """Return the version that is recorded of the last complete build, with its imports as far as they are still so."""
    last, contents = generation.inputs.last, dict[str, bytes]()
    if last.version is None:
        return None
    for entry in (last.version.imports or {}).values():
        content = generation.inputs.files.read(last.folder.key(entry.target))
        if content is not None and digest(content) == entry.target_hash:
            contents[entry.target] = content
    return last.version, contents


def _add_refused(
    generation: Generation, domain: Domain, imports: dict[str, Import], contents: dict[str, bytes]
) -> Iterator[str]:
    """Add files that are too large for the package, simplified for the picture; yield what to say of that."""
    for dependency, file in generation.imported.refused[:_MOST_REFUSED]:
        if dependency.key not in imports:  # else the copy of an earlier build is there
            wanted = msgspec.structs.replace(dependency, is_for_picture=True)
            with contextlib.suppress(UrdfsyncError, OSError):  # it is damaged, and the findings say so
                conversion = domain.convert(wanted, file, read_file(file), {})
                imports[dependency.key] = Import(dependency.target, "", "", None, conversion.facts)
                contents[dependency.target] = conversion.content
                yield f"`{dependency.uri}` is not in the package, and simplified for this page"


def _meshes(scene: Scene | None, version: Contents | None) -> dict[str, tuple[str, bytes]]:
    """Return the imported meshes of a scene by their paths, each with a name that follows from its content."""
    used = {shape.mesh for body in scene.bodies for shape in body.shapes} if scene else set[str]()
    contents = {path: content for path, content in version[1].items() if path in used} if version else {}
    return {path: (f"{digest(each)}{PurePosixPath(path).suffix}", each) for path, each in contents.items()}


def _statuses(changes: Changes) -> dict[str, str]:
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
    return statuses


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
        name = shown(folder / path).encode("utf-8", "replace").decode()  # a folder may have any bytes for a name
        files.setdefault(artifact.owner, []).append(name)
    return files
