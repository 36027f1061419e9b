"""Which packages a check found right, so that it need not look at them again: a small file per robot.

A check is the same again if all that it rests on is: the package, what is around it and what mentions it, urdfsync,
compiler and libraries.
The files are in the state folder, not committed, and safe to lose. One that can't be read, or not be written,
costs one check more.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import sys
from pathlib import Path

import msgspec

from urdfsync import __version__
from urdfsync.checking import workspace
from urdfsync.checking.libraries import dependencies, library
from urdfsync.config import STATE_FOLDER, Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, UrdfsyncError
from urdfsync.files import Tree, digest, put
from urdfsync.outcome import Checked

_COMPILER = "rumoca"


class Note(msgspec.Struct, frozen=True):
    """What is remembered of a check that found nothing wrong."""

    fingerprint: str
    checked: Checked
    said: tuple[Diagnostic, ...] = ()
    """What could not be checked, and what to do about it."""


class Memory:
    """What is remembered of the robots of one configuration."""

    def __init__(self, config: Config) -> None:
        self._config = config
        self._folder = config.root / STATE_FOLDER / "checked"
        self._tools: str | None = None

    def fingerprint(self, robot: RobotConfig) -> str | None:
        """SHA-256 (hex) over all that a check of a robot rests on; None if some of that can't be read."""
        if self._tools is None:
            self._tools = f"{__version__}\0{compiler()}\0{_library(self._config.check.library)}"
        total = hashlib.sha256(f"{self._tools}\0{robot.domain}\0{robot.target}\0".encode())
        try:
            texts = workspace.package_texts(robot.folder)
            around = workspace.surroundings(self._config, robot, texts)
            users = workspace.users_files(self._config, robot)
            libraries = dependencies.fingerprint(robot, [*texts.values(), *around.values(), *users.values()])
        except (UrdfsyncError, OSError):
            return None
        total.update(f"{libraries}\0".encode(errors="surrogateescape"))
        for files in (texts, around, {path.as_posix(): content for path, content in users.items()}):
            for path, content in sorted(files.items()):
                total.update(f"{path}\0{digest(content)}\n".encode(errors="surrogateescape"))
            total.update(b"\0")
        return total.hexdigest()

    def recall(self, robot: RobotConfig, fingerprint: str | None) -> Note | None:
        """What is remembered of a check of just this; None if it has to be made."""
        try:
            content = Tree(self._config.root).read(self._path(robot))
            note = msgspec.json.decode(content or b"", type=Note)
        except (UrdfsyncError, OSError, msgspec.DecodeError):
            return None
        return note if note.fingerprint == fingerprint and note.checked is not Checked.WRONG else None

    def keep(self, robot: RobotConfig, note: Note | None) -> None:
        """Remember a check, or forget the last one for None."""
        path = self._path(robot)
        with contextlib.suppress(UrdfsyncError, OSError):
            if not Tree(self._config.root).check_folder(path.parent):
                path.parent.mkdir(parents=True, exist_ok=True)
            if note is None:
                path.unlink(missing_ok=True)
                return
            put(path, msgspec.json.encode(note))

    def _path(self, robot: RobotConfig) -> Path:
        return self._folder / f"{robot.name}.json"


def compiler() -> str:
    """Name and version of the compiler, as the folder of its distribution says; empty if there is none.

    `importlib.metadata` says the same, but takes 20 ms to load.
    """
    for folder in sys.path:
        try:
            names = os.listdir(folder or os.curdir)  # noqa: PTH208 - on the way of every build
        except OSError:  # an archive, or a folder that is not there
            continue
        for name in names:
            if name.startswith(f"{_COMPILER}-") and name.endswith(".dist-info"):
                return name.removesuffix(".dist-info")
    return ""


def _library(configured: Path | None) -> str:
    """Places, versions and state of the Modelica Standard Library; why there is none if there is none."""
    try:
        found = library.standard(os.environ, library.home(), configured)
    except UrdfsyncError as error:
        return str(error)
    states = (library.state(one.path, folders_only=True) for one in (found.modelica, found.services, found.complex))
    return repr((found, *states))
