"""Makes the patch of the sources that takes over what users edited in the records of packages."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path

import msgspec

from urdfsync.config import Config, RobotConfig
from urdfsync.dependencies.facts import read_unrecorded
from urdfsync.diagnostics import ConfigError, Diagnostic, UrdfsyncError, findings_of
from urdfsync.domain import Role
from urdfsync.engine.edits import RobotEdits, find_edits
from urdfsync.engine.generation import generate_robot
from urdfsync.engine.inspect.inputs import inspect
from urdfsync.engine.options import BuildOptions
from urdfsync.files import shown
from urdfsync.patches.edited import EditedValue, Staying, edited_values, other_edits
from urdfsync.patches.literals import replaced
from urdfsync.patches.search import NewTexts, Search
from urdfsync.patches.sources import Contents, SourceReader, look
from urdfsync.patches.unified import path_in, top_of, unified


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
    for edited in find_edits(paths, config, options):
        robot = next(robot for robot in config.robots if robot.name == edited.robot)
        if edited.failed:
            yield RobotPatch(edited.robot, diagnostics=edited.diagnostics, failed=True)
            continue
        try:
            yield _find_patch(config, robot, options, edited)
        except Exception as error:  # noqa: BLE001 - one robot's error does not stop the others
            yield RobotPatch(edited.robot, diagnostics=findings_of(error), failed=True)


def _find_patch(config: Config, robot: RobotConfig, options: BuildOptions, edited: RobotEdits) -> RobotPatch:
    """Return the changes of one robot's source. Raises UrdfsyncError."""
    if robot.command and edited.files:
        message = f"robot `{robot.name}`: its source is made by a command, so no patch of it would last"
        hint = "change what the command reads"
        raise ConfigError.of("made-by-command", message, shown(config.file), robot.lines.get("command", 0), hint=hint)
    inputs = inspect(config, robot, options)
    generation, values, staying = generate_robot(inputs), list[EditedValue](), list[Staying]()
    artifacts, places = generation.package.artifacts, dict[str, str]()
    for file in edited.files:
        path = inputs.folder.path(file.path)
        is_record = path in artifacts and artifacts[path].role is Role.RECORD and file.edits is not None
        found = list(edited_values(file, path)) if is_record else []
        of_file = [each for each in found if isinstance(each, EditedValue)]
        staying += [each for each in found if isinstance(each, Staying)]
        staying += other_edits(file, [each.told.partition(" ")[0] for each in found])
        values, places = [*values, *of_file], {**places, path: file.path}
    if not values:
        return RobotPatch(robot.name, {}, tuple(staying))
    reader = SourceReader(config, robot, options)
    contents = reader.contents()
    owners = generation.package.owners
    refused = partial(_refusals, config, list(_other_readers(config, robot, options)))
    search = Search(partial(look, reader, inputs, generation), contents, owners, values, refused)
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
                yield SourceReader(config, other, options)


def _refusals(config: Config, others: Sequence[SourceReader], contents: Contents) -> list[str]:
    """Return why changed contents can't be in the patch: outside of the project, or read by another robot."""
    top = top_of(config.root)
    outside = [file for file in contents if path_in(top, file) is None]
    reasons = [f"its number is in {shown(file)}, outside of {shown(top)}" for file in outside]
    return [*reasons, *(f"its number also feeds robot `{other.name}`" for other in others if other.is_fed(contents))]


def patch_text(config: Config, patches: Sequence[RobotPatch]) -> bytes:
    """Return the changes of all robots as one patch. Raises OSError for a file that can't be read."""
    changes: NewTexts = {literal: text for patch in patches for literal, text in patch.changes.items()}
    before: Mapping[Path, bytes] = {literal.file: read_unrecorded(literal.file) for literal in changes}
    top, after = top_of(config.root), replaced(before, changes)
    paths = {file: path_in(top, file) or "" for file in after}
    return b"".join(unified(paths[file], before[file], after[file]) for file in sorted(after))
