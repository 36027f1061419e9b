"""What is left over when robots or packages get other names in the configuration, and what to say about it."""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterable
from pathlib import Path

from urdfsync.config import Config, shown
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.actions import DELETES, Action
from urdfsync.engine.package_files import PackageFiles
from urdfsync.state.manifest import Manifest
from urdfsync.state.store import Store

_FEW = 3
"""So many files are named; of more, only their number."""


def former_name(store: Store, config: Config, folder: str) -> str | None:
    """The name under which a robot that is no longer configured was built into this folder."""
    return next((name for name in _strays(store, config) if _folder(store, name) == folder), None)


def renamed_robot(old: str, new: str, file: str, line: int) -> Diagnostic:
    """A note that a robot has another name than in the last build."""
    message = f"robot `{new}` was called `{old}`; what urdfsync recorded of it goes with the new name"
    return Diagnostic(Severity.NOTE, "renamed-robot", message, file, line)


def left_behind(
    files: PackageFiles, recorded: Manifest, is_own: bool, actions: Iterable[Action], folder: str, file: str, line: int
) -> list[Diagnostic]:
    """A warning if something stays in the folder that a package had in the last build.

    `is_own` says that a build in this checkout wrote that folder.
    """
    actions = list(actions)
    if any(action.held for action in actions):
        return []
    old = files.path(recorded.folder)
    message = f"the package moved from {shown(old)} to {shown(files.path(folder))}"
    if not files.is_inside(f"{recorded.folder}/package.mo"):
        message += ", and the old folder is none of urdfsync's any more"
        return [Diagnostic(Severity.WARNING, "left-behind", message, file, line, hint="delete it by hand")]
    gone = {files.path(action.path) for action in actions if action.kind in DELETES}
    new = files.path(folder)
    rest = [path for path in _files(old) if path not in gone and new not in path.parents]
    if not rest:
        return []
    if not is_own:
        message += "; the old folder was not built in this checkout, so it stays as it is"
        hint = f"take over what you need, then delete it: `rm -r {shlex.quote(shown(old))}`"
        return [Diagnostic(Severity.WARNING, "left-behind", message, file, line, hint=hint)]
    theirs = [shown(path) for path in rest[:_FEW]] + ([f"{len(rest) - _FEW} more"] if len(rest) > _FEW else [])
    message += f"; what you wrote or edited, and what that needs, stayed behind: {', '.join(theirs)}"
    hint = "take over what you need, then delete the old folder"
    return [Diagnostic(Severity.WARNING, "left-behind", message, file, line, hint=hint)]


def orphaned_state(store: Store, config: Config) -> list[Diagnostic]:
    """A note if there is state of robots that are in the configuration no more."""
    built = set(store.names())
    heirs = {_key(robot.folder, config) for robot in config.robots if robot.name not in built}
    found = [name for name in _strays(store, config) if _folder(store, name) not in heirs]
    if not found:
        return []
    listed = ", ".join(f"`{name}`" for name in found)
    message = f"the state of {listed} is still there, but the configuration has no such robot"
    folder = shown(store.folder / "robots")
    hint = f"bring the robot back, or delete {folder}/{found[0]}.* and what is left of its package"
    return [Diagnostic(Severity.NOTE, "stray-state", message, shown(config.file), hint=hint)]


def _strays(store: Store, config: Config) -> list[str]:
    known = {robot.name.casefold() for robot in config.robots}
    return [name for name in store.names() if name.casefold() not in known]


def _folder(store: Store, name: str) -> str | None:
    """Where a robot was built to, None if its state can't be read."""
    try:
        state = store.load(name)
    except UrdfsyncError:
        return None
    return state.manifest.folder if state else None


def _key(folder: Path, config: Config) -> str:
    return Path(os.path.relpath(folder, config.root)).as_posix()


def _files(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*") if not path.is_dir())
