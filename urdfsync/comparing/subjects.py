"""What a command is to look at: a source, or a robot's name, to the robots and files that are meant."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec

from urdfsync import registry
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.domain import Target
from urdfsync.modelica.names import class_name

DOMAIN = "urdf"
"""What a source is that no robot of the configuration has."""


class Subject(msgspec.Struct, frozen=True):
    """One source, with how a package is made from it."""

    name: str
    source: Path
    """Absolute."""
    domain: str
    options: Any
    """An instance of the domain's options."""
    target: Target
    package_paths: tuple[Path, ...] = ()
    robot: RobotConfig | None = None
    """The robot of the configuration that has it; None for a source that is in no configuration."""


def find(source: str, config: Config | None, names: Sequence[str], folder: Path) -> list[Subject]:
    """The subjects that `source` means: a path from `folder`, else a robot's name; empty for all robots.

    `names` leaves only robots of these names. Without a configuration, or in none, a source is a subject of its own.
    Raises ConfigError if there is nothing of that name.
    """
    path = Path(os.path.normpath(folder / source))
    if config is None:
        if not path.is_file():
            raise _unknown(source, None)
        return [_alone(path)]
    chosen = config.select(names)
    if not source:
        return [_of_robot(robot) for robot in chosen]
    using = [robot for robot in config.robots if _is_same(robot.source, path)]
    if not using and path.is_file():
        if names:
            raise _not_of(source, names, config)
        return [_alone(path)]
    using = using or [robot for robot in config.robots if robot.name == source]
    if not using:
        raise _unknown(source, config)
    left = [robot for robot in using if robot in chosen]
    if not left:
        raise _not_of(source, names, config)
    return [_of_robot(robot) for robot in left]


def _of_robot(robot: RobotConfig) -> Subject:
    return Subject(
        robot.name, robot.source, robot.domain, robot.options, robot.target, robot.package_paths, robot=robot
    )


def _alone(path: Path) -> Subject:
    name = class_name(path.name.partition(".")[0])
    return Subject(path.name, path, DOMAIN, registry.domain(DOMAIN).options(), Target(name, name))


def _is_same(one: Path, two: Path) -> bool:
    return one == two or os.path.realpath(one) == os.path.realpath(two)


def _unknown(source: str, config: Config | None) -> ConfigError:
    message = f"there is no file {source!r}"
    if config is not None:
        message += f", and no robot of this name in {shown(config.file)}"
        hint = f"it has {', '.join(robot.name for robot in config.robots)}"
    else:
        hint = "name a source that exists"
    return ConfigError(Diagnostic(Severity.ERROR, "no-source", message, hint=hint))


def _not_of(source: str, names: Sequence[str], config: Config) -> ConfigError:
    message = f"{source!r} is not the source of {' or '.join(f'`{name}`' for name in names)}"
    hint = "leave out --robot, or name the robot alone"
    return ConfigError(Diagnostic(Severity.ERROR, "other-source", message, shown(config.file), hint=hint))
