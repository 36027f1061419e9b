"""Makes the patch of the sources that takes over what users edited in the records of packages."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path

import msgspec

from urdfsync.analysis.patches.edited import EditedValue, Staying, edited_values, other_edits
from urdfsync.analysis.patches.feeds import NewTexts
from urdfsync.analysis.patches.literals import replaced
from urdfsync.analysis.patches.search import Search
from urdfsync.analysis.patches.sources import SourceReader, look
from urdfsync.analysis.patches.unified import path_in, top_of, unified
from urdfsync.common.dependencies.facts import read_unrecorded
from urdfsync.common.diagnostics import ConfigError, Diagnostic, UrdfsyncError, findings_of
from urdfsync.common.files import shown
from urdfsync.domain import Role
from urdfsync.engine.edits import find_edited_at
from urdfsync.engine.generation import generate_robot
from urdfsync.engine.inspect.inputs import Inputs, inspect
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.sources.source import read_source
from urdfsync.project.config import Config, RobotConfig
from urdfsync.project.state.store import Store


class RobotPatch(msgspec.Struct, frozen=True):
    """The changes of a robot's source that take over its edits."""

    robot: str
    changes: NewTexts = {}
    staying: tuple[Staying, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = ()
    """Why there are no changes, if `failed`."""
    failed: bool = False


def find_patches(paths: Sequence[str], config: Config, options: BuildOptions) -> Iterator[RobotPatch]:
    """Yield the changes for the edits in the files at these paths, or in all files. Raises ConfigError as `edits`."""
    for robot in config.select(paths):
        try:
            yield _find_patch(paths, inspect(config, robot, options))
        except Exception as error:  # noqa: BLE001 - one robot's error does not stop the others
            yield RobotPatch(robot.name, diagnostics=findings_of(error), failed=True)


def _find_patch(paths: Sequence[str], inputs: Inputs) -> RobotPatch:
    """Return the changes of one robot's source. Raises UrdfsyncError."""
    config, robot, generation = inputs.config, inputs.robot, generate_robot(inputs)
    files = find_edited_at(paths, inputs, generation)
    if robot.command and files:
        message = f"robot `{robot.name}`: its source is made by a command, so no patch of it would last"
        hint = "change what the command reads"
        raise ConfigError.of("made-by-command", message, shown(config.file), robot.lines.get("command", 0), hint=hint)
    values, staying = list[EditedValue](), list[Staying]()
    artifacts, places = generation.package.artifacts, dict[str, str]()
    for file in files:
        path = inputs.folder.path(file.path)
        is_record = path in artifacts and artifacts[path].role is Role.RECORD and file.edits is not None
        found = list(edited_values(file, path)) if is_record else []
        values += [each for each in found if isinstance(each, EditedValue)]
        staying += [each for each in found if isinstance(each, Staying)]
        staying += other_edits(file, [each.told.partition(" ")[0] for each in found])
        places[path] = file.path
    if not values:
        return RobotPatch(robot.name, {}, tuple(staying))
    reader = SourceReader(config, robot, inputs.options, inputs.source)
    others = list(_other_readers(config, robot, inputs.options))
    look_with = partial(look, reader, inputs, generation)
    search = Search(reader, look_with, generation.package.owners, values, others, top_of(config.root))
    search.run()
    staying += [
        Staying(places[value.key[0]], value.told, search.reasons[value.key])
        for value in values
        if value.key in search.reasons
    ]
    return RobotPatch(robot.name, search.changes, tuple(staying))


def _other_readers(config: Config, robot: RobotConfig, options: BuildOptions) -> Iterator[SourceReader]:
    """Yield the readers of the other robots. A robot that can't be read is left out: a build reports it."""
    for other in config.robots:
        if other.name != robot.name:
            with contextlib.suppress(UrdfsyncError):
                yield SourceReader(config, other, options, read_source(config, other, Store(config.root), options))


def patch_text(config: Config, patches: Sequence[RobotPatch]) -> bytes:
    """Return the changes of all robots as one patch. Raises OSError for a file that can't be read."""
    changes: NewTexts = {literal: text for patch in patches for literal, text in patch.changes.items()}
    before: Mapping[Path, bytes] = {literal.file: read_unrecorded(literal.file) for literal in changes}
    top, after = top_of(config.root), replaced(before, changes)
    paths = {file: path_in(top, file) or "" for file in after}
    return b"".join(unified(paths[file], before[file], after[file]) for file in sorted(after))
