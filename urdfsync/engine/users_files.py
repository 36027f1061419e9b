"""The user's own models outside of a robot's package: where they are looked for, and which of them use the robot."""

from __future__ import annotations

import contextlib
from collections.abc import Collection
from pathlib import Path

from urdfsync import dependencies
from urdfsync.config import FILE_NAME, Config, RobotConfig
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.engine.package_files import key_of
from urdfsync.files import text_digest
from urdfsync.modelica.files import files_that_use, has_word, modelica_files
from urdfsync.state.store import Store

_NOT_USERS = (FILE_NAME, "pyvenv.cfg")
"""Files that make a folder another project, or a virtual environment of Python."""


def find_users_files(
    config: Config, robot: RobotConfig, packages: Collection[Path], names: Collection[str]
) -> dict[Path, bytes]:
    """Return the Modelica files that mention one of the names of a robot's package, or the class in another such file.

    They are below the configuration's folder, `output` and what `users` names, and in none of the folders `packages`.
    Left out are files as builds of other robots wrote them, other projects, virtual environments, and what can't be
    read.
    """
    found = {}
    for place in dict.fromkeys((config.root, robot.output, *robot.users)):
        for path in [place] if place.suffix == ".mo" else map(Path, modelica_files(place, _NOT_USERS)):
            if path not in found and not any(parent in packages for parent in path.parents):
                with contextlib.suppress(OSError):
                    found[path] = dependencies.read_file(path)
    hits = [path for path, content in found.items() if any(has_word(content, name.encode()) for name in names)]
    for other in config.robots:
        inside = [path for path in hits if other.folder in path.parents]
        if inside and other.name != robot.name:
            with contextlib.suppress(UrdfsyncError):  # the other robot's own build says what is wrong with its record
                record = Store(config.root).load(other.name)
                for path in inside:
                    written = record.files.get(key_of(path, config.root)) if record else None
                    if written and text_digest(found[path]) in written.hashes:
                        del found[path]
    return files_that_use(found, names)
