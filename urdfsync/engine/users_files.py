"""The user's own models outside of a robot's package: where they are looked for, and which of them use the robot."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path

import msgspec

from urdfsync import dependencies
from urdfsync.config import FILE_NAME, Config, RobotConfig
from urdfsync.modelica.files import TooManyFoldersError, class_of_file, files_that_use, modelica_files

_NOT_USERS = (FILE_NAME, "pyvenv.cfg")
"""Files that make a folder another project, or a virtual environment of Python."""


_MOST = 20_000
"""Folders that are looked through, in a second: a stranger's configuration may name the whole disk."""


class UsersFiles(msgspec.Struct, frozen=True, dict=True):
    """The user's files outside of all packages."""

    all: Mapping[Path, bytes]
    mentioning: Mapping[Path, bytes]
    """Those that use the robot, or the class of another such file."""
    is_too_wide: bool = False
    """Whether there are so many folders that no file was looked for."""

    @cached_property
    def tops(self) -> dict[str, Path]:
        """Return the files or folders of top-level classes, by name; where several have one name, none."""
        places_by_name = dict[str, set[Path]]()
        for path in self.all:
            folder = path.parent.parent if path.name == "package.mo" else path.parent
            if folder / "package.mo" not in self.all:
                place = path.parent if path.name == "package.mo" else path
                places_by_name.setdefault(class_of_file(path), set()).add(place)
        return {name: places.pop() for name, places in places_by_name.items() if len(places) == 1}


def find_users_files(
    config: Config, robot: RobotConfig, names: Iterable[str], former_folder: Path | None = None
) -> UsersFiles:
    """Return the user's Modelica files, by whether they mention one of the names of a robot's package.

    They are below the configuration's folder, `output` and what `users` names. Left out are the packages of all robots,
    of which `former_folder` may be one, other projects, virtual environments, and what can't be read.
    """
    packages = {str(configured.folder) for configured in config.robots} | {str(former_folder)}
    contents = dict[Path, bytes]()
    places = (config.root, robot.output, *robot.users)
    folders = (place for place in places if place.suffix != ".mo")
    try:
        below = [*map(Path, modelica_files(*folders, others=_NOT_USERS, left_out=packages, most=_MOST))]
    except TooManyFoldersError:
        return UsersFiles({}, {}, is_too_wide=True)
    for path in (*below, *(place for place in places if place.suffix == ".mo")):
        if not any(str(parent) in packages for parent in path.parents):
            with contextlib.suppress(OSError):
                contents[path] = dependencies.read_file(path)
    return UsersFiles(contents, files_that_use(contents, names))
