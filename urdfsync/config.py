"""`urdfsync.toml` to a frozen `Config`, and where the files are that urdfsync brings along.

All paths in the file count from its own folder. A robot's table may hold the keys of `Keys` and
the options of its domain; `[defaults]` the same without source, package and class; `[check]` the
keys of `CheckKeys`.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import msgspec

from urdfsync import registry, tables, targets, tomlfile
from urdfsync.dependencies import depend_on, is_file, is_folder
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.domain import Domain, Target
from urdfsync.modelica.names import DEVICES
from urdfsync.spelling import nearest

FILE_NAME = "urdfsync.toml"
OWN_KEYS = ("source", "package", "class")
"""Keys that make no sense as defaults."""

STATE_FOLDER = ".urdfsync"
"""Holds what urdfsync remembers; beside the configuration."""

_SAFE_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,99}", re.ASCII)


class Keys(msgspec.Struct, frozen=True):
    """The keys of a robot's table that every domain shares."""

    source: str
    package: str
    class_: str = msgspec.field(name="class", default="")
    output: str = "modelica"
    domain: str = "urdf"
    templates: str = ""
    package_paths: tuple[str, ...] = ()
    create_parents: bool = False
    on_conflict: Literal["keep", "merge"] = "keep"
    on_build: Literal["nothing", "check"] = "nothing"


class CheckKeys(msgspec.Struct, frozen=True):
    """The keys of the table `[check]`."""

    library: str | None = None


class RobotConfig(msgspec.Struct, frozen=True):
    """One robot of the configuration; paths are absolute, `options` is an instance of `Domain.options`."""

    name: str
    source: Path
    source_text: str
    """The source's path as it is recorded: relative to the configuration, POSIX."""
    output: Path
    target: Target
    domain: str
    templates: Path | None
    package_paths: tuple[Path, ...]
    create_parents: bool
    merging: bool
    """Whether a file that both sides changed gets their merge, if that is without doubt."""
    checking: bool
    """Whether the package is checked after each build."""
    options: Any
    lines: Mapping[str, int]
    """Line of every key in the configuration; of the robot's table for `""`."""

    @property
    def folder(self) -> Path:
        """The folder of the generated package."""
        return self.output.joinpath(*self.target.package.split("."))


class CheckConfig(msgspec.Struct, frozen=True):
    """What checks need to know of the machine."""

    library: Path | None = None
    """The folder that holds the Modelica Standard Library, absolute; None to look for it."""
    line: int = 0
    """Where the configuration names it; 0 if it does not."""


class Config(msgspec.Struct, frozen=True):
    """A configuration file and its robots, in the order of the file."""

    file: Path
    robots: tuple[RobotConfig, ...]
    check: CheckConfig = CheckConfig()

    @property
    def root(self) -> Path:
        """The folder of the configuration, which holds `.urdfsync/` as well."""
        return self.file.parent

    def select(self, names: Sequence[str]) -> tuple[RobotConfig, ...]:
        """The robots of these names, or all for none. Raises ConfigError for a name that no robot has."""
        known = [robot.name for robot in self.robots]
        for name in names:
            if name not in known:
                near = nearest(name, known)
                hint = f"did you mean `{near}`?" if near else f"it has {', '.join(known)}"
                message = f"no robot `{name}` in the configuration"
                raise ConfigError(Diagnostic(Severity.ERROR, "unknown-robot", message, shown(self.file), hint=hint))
        return tuple(robot for robot in self.robots if not names or robot.name in names)


def is_robot_name(name: str) -> bool:
    """Whether a robot's name can be a file's name on every system."""
    device = name.partition(".")[0].lower() in DEVICES
    return bool(_SAFE_NAME.fullmatch(name)) and not device and not name.endswith(".")


def working_folder() -> Path:
    """The working folder. Raises ConfigError if somebody has deleted it."""
    try:
        return Path.cwd()
    except FileNotFoundError:
        message, hint = "the working folder does not exist any more", "change to a folder that exists"
        raise ConfigError(Diagnostic(Severity.ERROR, "no-folder", message, hint=hint)) from None


def find(start: Path) -> Path:
    """The configuration file of `start` or of the nearest folder above it. Raises ConfigError if there is none."""
    for folder in (start, *start.parents):
        if is_file(folder / FILE_NAME):
            return folder / FILE_NAME
    message = f"no {FILE_NAME} in {start} or a folder above it"
    hint = "write one with `urdfsync init SOURCE`, or name one with --config"
    raise ConfigError(Diagnostic(Severity.ERROR, "no-config", message, hint=hint))


def load(file: Path) -> Config:
    """Read a configuration file. Raises ConfigError with everything that is wrong in it."""
    name = shown(file)
    if file.exists() and not file.is_file():
        message, hint = "the configuration is no regular file", f"name a {FILE_NAME}"
        raise ConfigError(Diagnostic(Severity.ERROR, "unreadable-config", message, name, hint=hint))
    try:
        depend_on(file)
        text = file.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        message = "the configuration does not exist"
        hint = "write one with `urdfsync init SOURCE`"
        raise ConfigError(Diagnostic(Severity.ERROR, "no-config", message, name, hint=hint)) from None
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        message = "the configuration is not UTF-8"
        hint = "save it as UTF-8"
        raise ConfigError(Diagnostic(Severity.ERROR, "unreadable-config", message, name, line, hint=hint)) from None
    except OSError as error:
        message = f"the configuration can't be read: {error.strerror}"
        hint = "name a file that you may read"
        raise ConfigError(Diagnostic(Severity.ERROR, "unreadable-config", message, name, hint=hint)) from None
    return parse(text, file.absolute(), name)


def parse(text: str, file: Path, name: str, domains: Callable[[str], Domain] = registry.domain) -> Config:
    """The configuration in `text`, which is (or would be) at the absolute path `file`; errors call it `name`.

    Raises ConfigError with one diagnostic for each thing that is wrong.
    """
    document = tomlfile.parse(text, name, ConfigError)
    reader = _Reader(text, document, name, file.parent, domains)
    reader.check_characters()
    robots = () if reader.problems else tuple(reader.robots())
    check = reader.check()
    reader.check_clashes(robots)
    if reader.problems:
        raise ConfigError(*sorted(reader.problems, key=lambda problem: problem.line))
    return Config(file, robots, check)


class _Reader:
    """One pass over a parsed document; gathers `problems` instead of stopping at the first."""

    def __init__(
        self, text: str, document: dict[str, Any], file: str, root: Path, domains: Callable[[str], Domain]
    ) -> None:
        self.problems: list[Diagnostic] = []
        self._document, self._file, self._root = document, file, root
        self._lines = tomlfile.lines(text)
        self._domains = domains
        self._option_names: set[str] = set()

    def check_characters(self) -> None:
        """No name, path or option has a use for a control character, and some systems stop at one."""
        for path, text in tomlfile.strings(self._document):
            if any(ord(char) < 32 or ord(char) == 127 for char in text):
                message = f"there is a control character in {text!r}"
                self._report("control-character", path, message, "write it without")

    def robots(self) -> Iterator[RobotConfig]:
        """Every robot whose table is right."""
        top = self._table(self._document, "the configuration")
        self.problems += tables.unknown(top, ("check", "defaults", "robots"))
        defaults = self._subtable("defaults")
        robots = self._subtable("robots")
        if not robots and not self.problems:
            hint = "add a table `[robots.NAME]` with `source` and `package`"
            self.problems.append(top.problem("no-robots", "", "the configuration has no robot", hint))
        for name, values in robots.items():
            if not isinstance(values, dict):
                message = f"`robots.{name}` must be a table"
                self._report("wrong-value", ("robots", name), message)
            elif (robot := self._robot(name, values, defaults)) is not None:
                yield robot
        self._check_defaults(defaults)

    def check(self) -> CheckConfig:
        """The table `[check]`."""
        table = self._table(self._subtable("check"), "`[check]`", "check")
        keys, wrong = tables.read(table, CheckKeys)
        self.problems += tables.unknown(table, [field.encode_name for field in msgspec.structs.fields(CheckKeys)])
        self.problems += wrong
        if keys is None or keys.library is None:
            return CheckConfig()
        if not keys.library:
            hint = "give the path of the folder that holds the Modelica Standard Library, or take the line out"
            self.problems.append(table.problem("wrong-value", "library", "`library` must name a folder", hint))
        return CheckConfig(_absolute(self._root / keys.library), table.line("library"))

    def _robot(self, name: str, values: dict[str, Any], defaults: dict[str, Any]) -> RobotConfig | None:
        if not is_robot_name(name):
            hint = "use letters, digits, `_`, `-` and `.`, a letter or digit first"
            message = f"the robot's name {name!r} can't be a file's name"
            self._report("robot-name", ("robots", name), message, hint)
            return None
        table = self._table(values, f"robot `{name}`", "robots", name)
        domain = self._domain(table, str(values.get("domain", defaults.get("domain", "urdf"))))
        if domain is None:
            return None
        options = {field.encode_name for field in msgspec.structs.fields(domain.options)}
        self._option_names |= options
        problems = tables.unknown(table, _KEY_NAMES | options)
        usable = {key: value for key, value in defaults.items() if key in _DEFAULT_NAMES | options}
        merged = msgspec.structs.replace(table, values=usable | values)
        keys, wrong_keys = tables.read(merged, Keys)
        chosen, wrong_options = tables.read(merged, domain.options)
        problems += wrong_keys + wrong_options
        if keys is not None:
            problems += targets.problems(merged, keys.package, keys.class_)
            problems += _check_paths(merged, keys, self._root)
        self.problems += problems
        return None if problems else self._resolve(name, keys, chosen, merged)

    def _resolve(self, name: str, keys: Keys, options: Any, table: tables.Table) -> RobotConfig:
        source = Path(keys.source)
        return RobotConfig(
            name=name,
            source=_absolute(self._root / source),
            source_text=source.name if source.is_absolute() else Path(os.path.normpath(source)).as_posix(),
            output=_absolute(self._root / keys.output),
            target=Target(keys.package, targets.class_name(keys.package, keys.class_)),
            domain=keys.domain,
            templates=_absolute(self._root / keys.templates) if keys.templates else None,
            package_paths=tuple(_absolute(self._root / path) for path in keys.package_paths),
            create_parents=keys.create_parents,
            merging=keys.on_conflict == "merge",
            checking=keys.on_build == "check",
            options=options,
            lines={key: table.line(key) for key in ("", *table.values)},
        )

    def _domain(self, table: tables.Table, name: str) -> Domain | None:
        try:
            return self._domains(name)
        except ConfigError as error:
            line = table.line("domain")
            self.problems += [msgspec.structs.replace(d, file=self._file, line=line) for d in error.diagnostics]
            return None

    def _check_defaults(self, defaults: dict[str, Any]) -> None:
        table = self._table(defaults, "`[defaults]`", "defaults")
        for key in OWN_KEYS:
            if key in defaults:
                message = f"`{key}` can't have a default: every robot has its own"
                self.problems.append(table.problem("unknown-key", key, message))
        self.problems += tables.unknown(table, _KEY_NAMES | self._option_names)

    def check_clashes(self, robots: Sequence[RobotConfig]) -> None:
        """Two robots must not share a manifest or a package's folder, nor may one stand in the other's."""
        names: dict[str, str] = {}
        folders: dict[str, str] = {}
        for robot in robots:
            if (other := names.setdefault(robot.name.casefold(), robot.name)) != robot.name:
                self._clash(robot.name, f"robots `{other}` and `{robot.name}` differ in case only")
            elif (other := folders.setdefault(_folded(robot.folder), robot.name)) != robot.name:
                self._clash(robot.name, f"robots `{other}` and `{robot.name}` have the same package")
        for robot in robots:
            for parent in robot.folder.parents:
                if other := folders.get(_folded(parent), ""):
                    self._clash(robot.name, f"the package of robot `{robot.name}` lies inside that of robot `{other}`")

    def _clash(self, robot: str, message: str) -> None:
        self._report("clash", ("robots", robot, "package"), message)

    def _subtable(self, key: str) -> dict[str, Any]:
        value = self._document.get(key, {})
        if isinstance(value, dict):
            return value
        self._report("wrong-value", (key,), f"`{key}` must be a table")
        return {}

    def _table(self, values: Mapping[str, Any], name: str, *path: str) -> tables.Table:
        def line(key: str) -> int:
            own = key in self._document.get("robots", {}).get(path[-1], {}) if path[:1] == ("robots",) else True
            table = path if own or not key else ("defaults",)
            return tomlfile.nearest(self._lines, *table, *filter(None, [key]))

        return tables.Table(values, name, self._file, line)

    def _report(self, code: str, path: tuple[str, ...], message: str, hint: str = "") -> None:
        line = tomlfile.nearest(self._lines, *path)
        self.problems.append(Diagnostic(Severity.ERROR, code, message, self._file, line, hint=hint))


_KEY_NAMES = {field.encode_name for field in msgspec.structs.fields(Keys)}
_DEFAULT_NAMES = _KEY_NAMES - set(OWN_KEYS)


def _check_paths(table: tables.Table, keys: Keys, root: Path) -> list[Diagnostic]:
    found = []
    if not keys.source:
        found.append(table.problem("wrong-value", "source", "`source` must name a file", "give the path of the source"))
    if not keys.output:
        hint = 'write "." for the folder of the configuration itself'
        found.append(table.problem("wrong-value", "output", "`output` must name a folder", hint))
    if f"{_folded(_absolute(root / keys.output))}{os.sep}".startswith(f"{_folded(root / STATE_FOLDER)}{os.sep}"):
        message = f"`output` can't be in {STATE_FOLDER}: that is where urdfsync keeps its own files"
        found.append(table.problem("wrong-value", "output", message, "name another folder"))
    return found


def _absolute(path: Path) -> Path:
    """The path without `..` and `.`, symbolic links kept: what the user wrote is what messages show."""
    return Path(os.path.normpath(path))


def _folded(path: Path) -> str:
    return str(path).casefold()


def shown(path: Path) -> str:
    """A path as people see it: relative to the working folder if it is inside it."""
    text = str(path)
    try:
        current = os.getcwd()  # noqa: PTH109 - every message asks, and a Path takes five times as long
    except FileNotFoundError:  # somebody has deleted it
        return text
    inside = os.path.join(current, "")  # noqa: PTH118
    if os.path.normcase(text).startswith(os.path.normcase(inside)):
        return text[len(inside) :]
    return "." if text == current else text


def ros_package_path(environment: Mapping[str, str]) -> tuple[Path, ...]:
    """The folders of the environment variable ROS_PACKAGE_PATH."""
    folders = environment.get("ROS_PACKAGE_PATH", "").split(os.pathsep)
    return tuple(Path(folder).absolute() for folder in folders if folder)


def library_folder() -> Path:
    """The folder to put on MODELICAPATH: it holds the library `UrdfSync`."""
    return _data_folder("modelica")


def templates_folder(domain: Domain) -> Path:
    """The folder of a domain's own templates."""
    return domain.templates or _data_folder("templates") / domain.name


def _data_folder(name: str) -> Path:
    package = Path(__file__).parent
    installed = package / "_data" / name
    return installed if is_folder(installed) else package.parent / name
