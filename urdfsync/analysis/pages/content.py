"""Gathers the content of a robot's page from the results of other commands. Writes nothing."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.analysis.pages.picture import Picture, picture
from urdfsync.analysis.versions.comparison import Comparison, VersionContents, compare_sources
from urdfsync.analysis.versions.report import to_section
from urdfsync.common.diagnostics import Diagnostic, UrdfsyncError
from urdfsync.common.files import shown
from urdfsync.domain import ChangeClass, ChangeKind, Domain, Version
from urdfsync.domain.changes import Effect
from urdfsync.domain.comparison import Changes, compare
from urdfsync.domain.scene import Body, Hinge, LoopConstraint, Scene
from urdfsync.engine.decide.steps import decide_package
from urdfsync.engine.edits import RobotEdits, find_edited
from urdfsync.engine.generation import generate_robot
from urdfsync.engine.inspect.inputs import Inputs, inspect
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package.generate import Package
from urdfsync.engine.plan import as_git_left_it
from urdfsync.engine.renames import find_matching
from urdfsync.engine.result import DisputedFile
from urdfsync.engine.stage.writes import draw_model
from urdfsync.output.documents import with_slashes
from urdfsync.output.outline import number_table, outline
from urdfsync.output.sections import Section, TextTable
from urdfsync.project.config import Config, RobotConfig


class Content(msgspec.Struct, frozen=True):
    """The page of one robot as values."""

    robot: RobotConfig
    version: VersionContents
    """The version that is shown."""
    section: Section
    """The changes in words."""
    numbers: TextTable
    """Mass, reach, loads and other properties of both versions."""
    against: str
    """The older version, in words."""
    picture: Picture
    statuses: Mapping[str, str]
    """Elements that are `changed`, `added`, `removed` or `renamed`; the page adds elements whose meshes changed."""
    renamed: Mapping[str, str]
    """New names of elements by the old ones."""
    changes: Mapping[str, Sequence[str]]
    """The changes of each element, in words."""
    files: Mapping[str, Sequence[str]]
    """Files of each element, for people."""
    diagram: str
    """SVG; empty if there is none."""
    edits: RobotEdits
    edited: Mapping[str, Sequence[tuple[str, str, str]]]
    """The user's edits of each element: the property's name as in the picture, the edit in words, the new text."""
    conflicts: Sequence[DisputedFile]
    findings: Mapping[str, Sequence[str]]
    """The findings about each element, in words."""


def gather(
    config: Config,
    robot: RobotConfig,
    against: str | None,
    options: BuildOptions,
    folder: Path,
    shown_before: Sequence[VersionContents] = (),
) -> Content:
    """Return the content of a robot's page; `against` is a git revision, else a file relative to `folder`.

    If nothing changed since the last build, the older version is the first of `shown_before` that differs. Raises
    UrdfsyncError if the source or the older version can't be read.
    """
    options = msgspec.structs.replace(options, dry=True)
    (compared,) = compare_sources([robot], against, config, options, folder)
    if compared.result.failed:
        raise UrdfsyncError(*compared.result.diagnostics)
    inputs = inspect(config, robot, options)
    generation = generate_robot(inputs)
    inputs = as_git_left_it(inputs, generation)
    compared, older = _with_older(compared, inputs, generation.now, shown_before)
    changes, result = compared.changes or Changes(), compared.result
    decision = decide_package(inputs, generation)
    edits = RobotEdits(robot.name, config.root, tuple(find_edited(inputs, generation, decision.actions)))
    drawn = picture(inputs, generation, older if changes.changes else None, edits.files)
    return Content(
        robot=robot,
        version=(generation.now, generation.imported.contents),
        section=to_section(compared),
        numbers=number_table(compared.effects or _numbers(inputs.domain, generation.now)),
        against=(compared.against or "the last build").encode("utf-8", "replace").decode(),
        picture=drawn,
        statuses=_statuses(changes),
        renamed={f"{kind} {old}": f"{kind} {new}" for (kind, old), new in changes.renames.items()},
        changes=_change_words(changes),
        files=_files(generation.package, robot),
        diagram=draw_model(inputs, generation, decision) or "",
        edits=edits,
        edited=_edited(edits, drawn.now),
        conflicts=result.conflicts,
        findings=_findings(result.diagnostics),
    )


def _with_older(
    compared: Comparison, inputs: Inputs, now: Version, shown_before: Sequence[VersionContents]
) -> tuple[Comparison, VersionContents | None]:
    """Return the comparison for the page, and its older version; see `gather`."""
    older = compared.versions[0] if compared.versions else _last_build(inputs)
    other = next((each for each in shown_before if each[0] != now), None)
    if other is None or (compared.changes and compared.changes.changes):
        return compared, older
    domain, robot = inputs.domain, inputs.robot
    same = find_matching(domain, other[0].snapshot, now.snapshot, robot.renamed)
    changes = compare(other[0], now, domain, robot.options, same)
    return msgspec.structs.replace(compared, changes=changes, against="the picture before"), other


def _numbers(domain: Domain, now: Version) -> Sequence[Effect]:
    """Return the properties of an unchanged model."""
    asked = domain.effects
    return (*asked.effects(now, now), *asked.loads(now, now, {})) if asked else ()


def _last_build(inputs: Inputs) -> VersionContents | None:
    """Return the recorded version of the last complete build, with the imports that the user has not changed."""
    last = inputs.last
    if last.version is None:
        return None
    contents = {
        file.entry.target: file.copy for file in last.imports.values() if file.copy is not None and file.is_intact
    }
    return last.version, contents


def _findings(diagnostics: Sequence[Diagnostic]) -> dict[str, list[str]]:
    by_element: dict[str, list[str]] = {}
    for finding in diagnostics:
        if finding.element:
            by_element.setdefault(finding.element.partition(" / ")[0], []).append(finding.sentence)
    return by_element


def _statuses(changes: Changes) -> dict[str, str]:
    """Return which elements differ; rounding and unmodelled parts are no difference."""
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
    """Return the changes of each element, a sentence for each row of the outline."""
    words = dict[str, list[str]]()
    for element, of_element in changes.by_element().items():
        rows = outline(msgspec.structs.replace(changes, changes=tuple(of_element)))
        words[element] = [str(row) for _, of_rows in rows for row in of_rows]
    return words


def _edited(edits: RobotEdits, scene: Scene) -> dict[str, list[tuple[str, str, str]]]:
    """Return the edits of each element of the picture, in its own files and in the robot model."""
    parts: Sequence[Body | Hinge | LoopConstraint] = (*scene.bodies, *scene.hinges, *scene.loops)
    elements = {f"component `{part.component}`": part.element for part in parts}
    edited: dict[str, list[tuple[str, str, str]]] = {part.element: [] for part in parts}
    for file in edits.files:
        for edit in file.edits or ():
            of_element = edited.get(elements.get(edit.element, "") if file.owner not in edited else file.owner)
            if of_element is not None and edit.part != "layout":
                words = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", edit.part).lower().replace(".", " ")
                of_element.append(
                    (words, f"{edit.element if not edit.part else ''} {edit.told}".strip(), edit.mine or "")
                )
    return {element: of_element for element, of_element in edited.items() if of_element}


def _files(package: Package, robot: RobotConfig) -> dict[str, list[str]]:
    files = dict[str, list[str]]()
    for path, artifact in package.artifacts.items():
        name = shown(robot.folder / path).encode("utf-8", "replace").decode()  # names of folders may have any bytes
        files.setdefault(artifact.owner, []).append(with_slashes(name))
    return files
