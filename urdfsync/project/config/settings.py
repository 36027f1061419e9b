"""The values of a configuration: keys of its tables, and robots."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, TypeAlias

import msgspec

from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.common.files import shown
from urdfsync.common.spelling import nearest
from urdfsync.domain import Target
from urdfsync.project.config.paths import working_folder

FILE_NAME = "urdfsync.toml"
DEFAULT_DOMAIN = "urdf"
DEFAULT_OUTPUT = "modelica"
STATE_FOLDER = ".urdfsync"
"""Holds the recorded state; beside the configuration."""
OWN_KEYS = ("source", "arguments", "command", "command_inputs", "package", "class", "renamed")
"""Keys that `[defaults]` can't have."""
CompilerName: TypeAlias = Literal["rumoca", "omc"]
"""The name of a compiler, the default first: each is a module of `checks/compilers`."""


class SharedKeys(msgspec.Struct, frozen=True, kw_only=True):
    """The keys of a robot's table whose values stay as written; only paths become absolute."""

    source: Path
    output: Path = msgspec.field(default_factory=lambda: Path(DEFAULT_OUTPUT))
    domain: str = DEFAULT_DOMAIN
    command: tuple[str, ...] = ()
    """The command that writes the source; empty for none."""
    command_inputs: tuple[Path, ...] = ()
    """The files that the command depends on."""
    templates: Path | None = None
    package_paths: tuple[Path, ...] = ()
    users: tuple[Path, ...] = ()
    """Files and folders that hold models of the user's, beside the configuration's folder and `output`."""
    create_parents: bool = False
    on_conflict: Literal["keep", "merge"] = "keep"
    """What to do with a file that both sides changed: keep it, or merge changes that fit together."""
    on_build: Literal["nothing", "check"] = "nothing"
    """Check the package after each build."""
    ignore: frozenset[str] = frozenset()
    """Codes of warnings and notes that are not shown."""
    refuse: frozenset[str] = frozenset()
    """Codes of findings about a source with which a build writes nothing."""
    renamed: Mapping[str, str] = {}
    """Old → new name of elements, declared by the user."""


class Keys(SharedKeys, frozen=True, kw_only=True):
    """The keys of a robot's table that all domains share; the table also has the domain's options."""

    package: str
    class_: str = msgspec.field(name="class", default="")
    arguments: Mapping[str, str | int | float | bool] | None = None


class CheckConfig(msgspec.Struct, frozen=True):
    """The keys of the table `[check]`: how packages are compiled and simulated."""

    library: Path | None = None
    """The folder that holds the Modelica Standard Library, absolute; None to search for the library."""
    tool: Literal[CompilerName, "both"] = "rumoca"
    """See `checks.compilers.choose`."""
    omc: str = ""
    """OpenModelica's compiler, as an absolute path or a name on the PATH; empty to search for the compiler."""

    def program(self, compiler: str) -> str:
        """Return the program in the key with a compiler's name; empty without such a key."""
        named: str = getattr(self, compiler, "")
        return named


class RobotConfig(SharedKeys, frozen=True, kw_only=True):
    """One robot of the configuration."""

    name: str
    source_text: str
    """The source's path in the state: relative to the configuration, POSIX; only the name of an absolute path."""
    target: Target
    options: Any
    """An instance of `Domain.options`."""
    arguments: Mapping[str, str] | None = None
    """Arguments of xacro; without the key None, and the source's name or content shows whether it is xacro."""
    lines: Mapping[str, int] = {}
    """Line of every key in the configuration; `""` has the table's own line, `KEY.NAME` that of an entry in a table.
    """

    @property
    def folder(self) -> Path:
        """The folder of the generated package."""
        return self.output.joinpath(*self.target.package.split("."))

    def has_class(self, name: str) -> bool:
        """Whether a full name, or a name below the package, belongs to the package."""
        place = self.folder.joinpath(*name.split("."))
        return name.startswith(f"{self.target.package}.") or place.with_suffix(".mo").is_file()

    def without_ignored(self, diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
        """Leave out ignored warnings and notes; errors stay."""
        return tuple(
            finding for finding in diagnostics if finding.severity is Severity.ERROR or finding.code not in self.ignore
        )


class Config(msgspec.Struct, frozen=True):
    """A configuration file and its robots, in the order of the file."""

    file: Path
    robots: tuple[RobotConfig, ...]
    check: CheckConfig = CheckConfig()
    check_lines: Mapping[str, int] = {}
    """Line of every key of the table `[check]`."""

    @property
    def root(self) -> Path:
        """The folder of the configuration, which holds `.urdfsync/` as well."""
        return self.file.parent

    def without_ignored(self, diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
        """Leave out warnings and notes that all robots ignore, of findings that belong to no robot."""
        # most builds have no such finding, and there may be 1,000 robots
        return tuple(one for one in diagnostics if any(robot.without_ignored([one]) for robot in self.robots))

    def select(self, names: Sequence[str]) -> tuple[RobotConfig, ...]:
        """Return the robots for names, sources, or paths around or in their packages; all robots without `names`.

        Raises ConfigError for a name that means no robot, and for a configuration without robots.
        """
        if not self.robots:
            message, hint = "the configuration has no robot", "add one with `urdfsync add SOURCE`"
            raise ConfigError.of("no-robots", message, shown(self.file), hint=hint)
        robot_names, chosen = [robot.name for robot in self.robots], set[str]()
        for name in names:
            place = Path(os.path.normpath(working_folder() / name))
            meant = (
                [name]
                if name in robot_names
                else [
                    robot.name
                    for robot in self.robots
                    if place == robot.source or place.is_relative_to(robot.folder) or robot.folder.is_relative_to(place)
                ]
            )
            if not meant:
                near = nearest(name, robot_names)
                hint = f"did you mean `{near}`?" if near else f"name one of {', '.join(robot_names)}"
                message = f"no robot `{name}` in the configuration"
                raise ConfigError.of("unknown-robot", message, shown(self.file), hint=hint)
            chosen.update(meant)
        return tuple(robot for robot in self.robots if not names or robot.name in chosen)

    def select_one(self, robots: Sequence[str], command: str, model: str = "") -> RobotConfig:
        """Return the named robot, the robot whose package has the `model`, or the only robot.

        Raises ConfigError for several robots: `command` takes one.
        """
        chosen = self.select(robots)
        owners = [robot for robot in chosen if model and robot.has_class(model)]
        if len(owners) == 1:
            return owners[0]
        if len(chosen) > 1:
            names = ", ".join(robot.name for robot in chosen)
            message = f"{len(chosen)} robots match; `urdfsync {command}` takes one at a time"
            hint = f"name one: {names}"
            if model:
                message = f"`{model}` is in none of the packages of {names}, so it does not tell the robot"
                hint = f"name the robot that the model uses: `urdfsync {command} {chosen[0].name} --model {model}`"
            raise ConfigError.of("robots", message, hint=hint)
        return chosen[0]
