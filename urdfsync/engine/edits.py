"""The user's edited files of a package, with their bases."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import msgspec

from urdfsync.common.diagnostics import Diagnostic, findings_of
from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.generation import Generation, generate_robot
from urdfsync.engine.inspect.inputs import Inputs, inspect
from urdfsync.engine.inspect.package_files import CLASS_FOLDER
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.plan import decide_robot
from urdfsync.merge import edits as merge_edits
from urdfsync.project.config import Config, working_folder


class EditedFile(msgspec.Struct, frozen=True):
    """An edited text file."""

    KEYS = ("path", "owner", "edits")

    path: str
    """The path from the configuration's folder, POSIX."""
    owner: str
    base: str | None
    """The base: the text that urdfsync wrote last. None if the base is lost, or if urdfsync never wrote the file."""
    mine: str
    is_in_conflict: bool = False

    @property
    def edits(self) -> Sequence[merge_edits.Edit] | None:
        """The edits, by elements of the class; None if base or file is not a single class."""
        return None if self.base is None else merge_edits.find_edits(self.base, self.mine)


class RobotEdits(msgspec.Struct, frozen=True):
    """The user's edits in the package of one robot."""

    KEYS = ("robot", "failed", "files")

    robot: str
    root: Path
    """The configuration's folder: the paths of `files` count from here."""
    files: tuple[EditedFile, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = ()
    """Why the edits are unknown, if `failed`."""
    failed: bool = False


def find_edited(
    inputs: Inputs, generation: Generation, actions: Iterable[Action] | None = None
) -> Iterator[EditedFile]:
    """Yield the edited files of a robot, in the order of their paths.

    Raises UrdfsyncError. `actions` are the package's actions; if it is None, this decides on them.
    """
    if actions is None:
        inputs, decision = decide_robot(inputs, generation)
        actions = decision.actions
    files = inputs.files
    for action in actions:
        key = action.origin or action.path
        is_text = action.role not in (Role.IMPORT, Role.ORDER)
        is_users = action.base is None and action.generated is None  # a class of the user's own is no edit
        # a class that the user turned into a folder has no hash
        if is_text and action.mine is None and files.on_disk(key, action.role) is CLASS_FOLDER:
            key, is_edited = f"{key.removesuffix('.mo')}/package.mo", True
        else:
            is_edited = action.mine not in (None, action.base, action.generated)
        if is_text and not is_users and is_edited:
            base = inputs.last.base(action.base) if action.base else None
            if action.generated and action.reason is Reason.KEEP:  # the text has all changes of the generated one
                base = generation.package.content(inputs.folder.path(action.path)).decode()
            yield EditedFile(key, action.owner, base, files.any_text(key), action.is_conflict)


def find_edits(paths: Sequence[str], config: Config, options: BuildOptions) -> Iterator[RobotEdits]:
    """Yield the edits in the files at these paths, or in all files. Raises ConfigError for a path without a robot."""
    for robot in config.select(paths):
        try:
            inputs = inspect(config, robot, options)
            yield RobotEdits(robot.name, config.root, find_edited_at(paths, inputs, generate_robot(inputs)))
        except Exception as error:  # noqa: BLE001 - one robot's error does not stop the others
            yield RobotEdits(robot.name, config.root, diagnostics=findings_of(error), failed=True)


def find_edited_at(paths: Sequence[str], inputs: Inputs, generation: Generation) -> tuple[EditedFile, ...]:
    """Return the edited files of a robot at these paths, or all of a named robot. Raises UrdfsyncError."""
    files, root, robot = tuple(find_edited(inputs, generation)), inputs.config.root, inputs.robot
    places = {text: Path(os.path.normpath(working_folder() / text)) for text in paths}
    if not paths or robot.name in paths or robot.source in places.values():
        return files
    return tuple(file for file in files if any(map((root / file.path).is_relative_to, places.values())))
