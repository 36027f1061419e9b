"""What the check of a robot's package rests on, in one hash: `check` and the check after a build remember by it."""

from __future__ import annotations

from urdfsync import __version__, registry
from urdfsync.check import compilers, libraries, package
from urdfsync.check.cache import digest
from urdfsync.check.results import CheckOptions
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.engine import source
from urdfsync.engine.options import BuildOptions
from urdfsync.files import shown
from urdfsync.state.store import Store


def fingerprint(config: Config, robot: RobotConfig, options: CheckOptions) -> str | None:
    """Return the hash of all that a check of a package in step rests on; None if some of that can't be read."""
    domain = registry.domain(robot.domain)
    try:
        texts = package.package_texts(robot.folder)
        around = package.files_around(config, robot, texts)
        users = package.users_files(config, robot)
        every = [*texts.values(), *around.values(), *users.values()]
        needed = libraries.find_libraries(config, robot, every, [name for name, _ in domain.uses(robot.options)])
        request = BuildOptions(dry=True, package_paths=options.package_paths)
        content = source.read_source(config, robot, Store(config.root), request).content
        sources = content, source.templates(config, robot, domain).digest, needed.state()
    except (UrdfsyncError, OSError):
        return None
    return digest(
        *(__version__, *(compilers.installed_version(tool, "pin", "yourdfpy") for tool in options.tools)),
        *(options.physics, robot.domain, robot.target, robot.options, *sources, str(needed.problem)),
        shown(robot.folder),  # findings name files as they are seen from the working folder
        *(sorted(files.items()) for files in (texts, around, users)),
    )
