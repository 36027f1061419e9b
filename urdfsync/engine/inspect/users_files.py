"""Finds the user's own models outside of a robot's package, and those that use the robot."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from pathlib import Path

import msgspec

from urdfsync.common.dependencies import reads
from urdfsync.common.dependencies.facts import Facts
from urdfsync.modelica.files import (
    PACKAGE_FILE,
    TooManyFoldersError,
    class_of_file,
    files_that_use,
    modelica_files,
)
from urdfsync.project.config import FILE_NAME, Config, RobotConfig

_NOT_USERS = (FILE_NAME, "pyvenv.cfg")
"""Files that mark a folder as another project, or as a virtual environment of Python."""
_MOST = 20_000
"""The greatest number of folders to search, in about a second: a stranger's configuration may name the whole disk."""
_MOST_KEPT = 50_000_000
"""The greatest number of bytes of files in memory; further files are read again each time."""


class _FilesOnDemand(Mapping[Path, bytes]):
    """Files that are read on demand. An unreadable file counts as empty."""

    def __init__(self, paths: Iterable[Path]) -> None:
        self._paths, self._kept, self._size = dict.fromkeys(paths), dict[Path, bytes](), 0

    def __getitem__(self, path: Path) -> bytes:
        if path in self._kept:
            return self._kept[path]
        try:
            content = reads.read_file(path)
        except OSError:
            return b""
        if self._size + len(content) <= _MOST_KEPT:
            self._kept[path] = content
            self._size += len(content)
        return content

    def __contains__(self, path: object) -> bool:
        return path in self._paths

    def __iter__(self) -> Iterator[Path]:
        return iter(self._paths)

    def __len__(self) -> int:
        return len(self._paths)


class UsersFiles(msgspec.Struct, frozen=True, dict=True):
    """The user's files outside of all packages."""

    all: Mapping[Path, bytes]
    mentioning: Mapping[Path, bytes]
    """The files that use the robot, or a class of another file in this list."""
    names: frozenset[str] = frozenset()
    """The names of the robot's package, present and former ones."""
    is_too_wide: bool = False
    """Whether there are too many folders to search."""

    @cached_property
    def using(self) -> list[Path]:
        """The files of `mentioning` that can mean the robot: a copied package has a class of its own with its name."""
        direct = set[Path]()
        for name in self.names:
            direct |= {path for path in files_that_use(self.mentioning, [name]) if not self._is_hidden(name, path)}
        using = direct | files_that_use(self.mentioning, map(class_of_file, direct)).keys()
        return [path for path in self.mentioning if path in using]

    def _is_hidden(self, name: str, path: Path) -> bool:
        """Whether a name means a class of a package around this file, which Modelica finds first."""
        if re.search(rf"(?<![\w'\])])\.{re.escape(name)}\b".encode(), self.all[path]):
            return False
        around = itertools.takewhile(lambda folder: folder / PACKAGE_FILE in self.all, path.parents)
        return any(folder / file in self.all for folder in around for file in (f"{name}.mo", f"{name}/{PACKAGE_FILE}"))

    @cached_property
    def tops(self) -> dict[str, Path]:
        """Return the files or folders of top-level classes, by name; names of several classes are left out."""
        places_by_name = dict[str, set[Path]]()
        for path in self.all:
            folder = path.parent.parent if path.name == "package.mo" else path.parent
            if folder / "package.mo" not in self.all:
                place = path.parent if path.name == "package.mo" else path
                places_by_name.setdefault(class_of_file(path), set()).add(place)
        return {name: places.pop() for name, places in places_by_name.items() if len(places) == 1}


def read_saved_facts(path: Path) -> Facts:
    """Return stat values that differ after the user has saved a file, even with the same text."""
    try:
        return reads.read_stat(path)
    except OSError:
        return (0,)


def read_users_files(
    config: Config, robot: RobotConfig, names: Iterable[str], former_folder: Path | None = None
) -> UsersFiles:
    """Return the user's Modelica files, and those that mention a name of a robot's package.

    This searches below the configuration's folder, `output` and the paths of `users`. It leaves out the packages of all
    robots, the package in `former_folder`, other projects, virtual environments, and unreadable files.
    """
    packages = {str(configured.folder) for configured in config.robots} | {str(former_folder)}
    places = (config.root, robot.output, *robot.users)
    folders = (place for place in places if place.suffix != ".mo")
    try:
        below = [*map(Path, modelica_files(*folders, others=_NOT_USERS, left_out=packages, most=_MOST))]
    except TooManyFoldersError:
        return UsersFiles({}, {}, is_too_wide=True)
    paths = (*below, *(place for place in places if place.suffix == ".mo"))
    files = _FilesOnDemand(path for path in paths if not any(str(parent) in packages for parent in path.parents))
    names = frozenset(names)
    return UsersFiles(files, files_that_use(files, names), names)
