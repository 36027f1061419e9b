"""Reads `urdfsync.toml` into a frozen `Config`; reports all faults at once, each with its line.

All paths in the file count from the file's folder. A robot's table may hold the keys of `Keys` and the options of its
domain. `[defaults]` may hold the same keys without source, package and class, `[check]` the keys of `CheckConfig`.
"""

from __future__ import annotations

import functools
import json
import math
import os
import stat
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, NamedTuple, Union, get_args, get_origin

import msgspec

from urdfsync.common import system
from urdfsync.common.dependencies import reads
from urdfsync.common.diagnostics import IGNORABLE, OF_SOURCES, ConfigError, Diagnostic, Severity
from urdfsync.common.files import shown
from urdfsync.common.spelling import nearest
from urdfsync.domain import Domain, Target, registry
from urdfsync.project.config import tomlfile
from urdfsync.project.config.names import find_name_problems, is_robot_name, model_class
from urdfsync.project.config.settings import (
    DEFAULT_DOMAIN,
    FILE_NAME,
    OWN_KEYS,
    STATE_FOLDER,
    CheckConfig,
    CompilerName,
    Config,
    Keys,
    RobotConfig,
    SharedKeys,
)

_WORDS = {
    str: "a string",
    Path: "a path",
    int: "an integer",
    float: "a number",
    bool: "true or false",
    dict: "a table",
}

_fields = functools.cache(msgspec.structs.fields)
"""The fields of each struct type. In the daemon, finding the fields would take a tenth of a small build's time."""


def find(start: Path) -> Path:
    """Find the configuration file in `start` or the nearest folder above it. Raises ConfigError without such a file."""
    for folder in (start, *start.parents):
        # a pipe of this name counts, too: `load` reports it as unreadable
        if reads.file_type(folder / FILE_NAME) not in (0, stat.S_IFDIR):
            return folder / FILE_NAME
    message = f"no {FILE_NAME} in {start} or a folder above it"
    hint = "write one with `urdfsync init SOURCE`, or name one with --config"
    raise ConfigError.of("no-config", message, hint=hint)


def load(file: Path) -> Config:
    """Read a configuration file. Raises ConfigError with all faults of the file."""
    code, line = "unreadable-config", 0
    try:
        text = reads.read_file(file).decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
        place = file.absolute()
        return parse(text, place.resolve() if ".." in place.parts else place, shown(file))
    except FileNotFoundError:
        message, hint, code = "the configuration does not exist", "write one with `urdfsync init SOURCE`", "no-config"
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        message, hint = "the configuration is not UTF-8", "save it as UTF-8"
    except OSError as error:
        message = f"the configuration can't be read: {error.strerror}"
        hint = system.held_hint(error) or "name a file that you may read"
    raise ConfigError.of(code, message, shown(file), line, hint=hint)


def parse(text: str, file: Path, name: str) -> Config:
    """Read the configuration in `text` of the file at the absolute path `file`; errors call it `name`.

    Raises ConfigError with one diagnostic for each fault.
    """
    reader = _ConfigReader(text, name, file.parent)
    reader.check_characters()
    robots = () if reader.problems else tuple(reader.robots())
    check, check_lines = reader.check()
    reader.find_clashes(robots)
    reader.check_codes(robots)
    if reader.problems:
        raise ConfigError(*sorted(reader.problems, key=lambda problem: problem.line))
    return Config(file, robots, check, check_lines)


def in_words(kind: Any) -> str:
    """Return the values that a key may have in words: `a string`, `"fixed" or "floating"`, `a list of strings`."""
    origin, arguments = get_origin(kind), get_args(kind)
    if origin is Annotated:
        return in_words(arguments[0])
    if origin is Literal:
        return " or ".join(map(json.dumps, arguments))
    if origin in (Union, UnionType):  # `Literal[…] | tuple[…]` is a Union, `tuple[…] | None` a UnionType
        return " or ".join(in_words(part) for part in arguments if part is not NoneType)
    if origin is Mapping:
        kinds = {str: "strings", float: "numbers"}
        is_any = bool in get_args(arguments[1])
        words = kinds.get(arguments[1]) or ("strings, numbers, true and false" if is_any else in_words(arguments[1]))
        keys = f" with the keys {', '.join(get_args(arguments[0]))}" if get_origin(arguments[0]) is Literal else ""
        return f"a table of {words}{keys}"
    if origin in (tuple, list, frozenset):
        count = "" if arguments[-1] is ... or origin is not tuple else f"{len(arguments)} "
        parts = get_args(arguments[0]) if get_origin(arguments[0]) in (Union, UnionType) else arguments[:1]
        kinds = {str: "strings", Path: "paths", float: "numbers"}
        names = ("tables" if _is_struct(part) else kinds.get(part) or in_words(part) for part in parts)
        return f"a list of {count}{' or '.join(names)}"
    return _WORDS.get(kind, f"of the type {kind}")


def _is_struct(kind: Any) -> bool:
    return isinstance(kind, type) and issubclass(kind, msgspec.Struct)


def _is_finite(value: Any) -> bool:
    """Whether a value of TOML has no nan and no inf: JSON and models allow neither."""
    if isinstance(value, dict | list):
        return all(map(_is_finite, value.values() if isinstance(value, dict) else value))
    return not isinstance(value, float) or math.isfinite(value)


class _Table(NamedTuple):
    """A table: its name in messages, its values, and the line of each key; `""` has the table's own line."""

    name: str
    values: Mapping[str, Any]
    lines: Mapping[str, int]


class _ConfigReader:
    """One pass over a document; gathers `problems` instead of stopping at the first."""

    def __init__(self, text: str, file: str, root: Path) -> None:
        self.problems: list[Diagnostic] = []
        self._document = tomlfile.parse(text, file, ConfigError)
        self._lines, self._item_lines = tomlfile.find_lines(text)
        self._file, self._root = file, root

    def check_characters(self) -> None:
        """Report control characters: no name, path or option needs them, and some systems end a text there."""
        for path, text in tomlfile.strings(self._document):
            if any(ord(char) < 32 or ord(char) == 127 for char in text):
                message = f"there is a control character in {text!r}"
                self._report("control-character", self._line(*path), message, "write it without")

    def robots(self) -> Iterator[RobotConfig]:
        """Yield every robot with a faultless table."""
        self._refuse_unknown(self._table("the configuration", self._document), {"check", "defaults", "robots"})
        defaults, robots = self._subtable("defaults"), self._subtable("robots")
        allowed = set(_KEY_NAMES)
        for name, values in robots.items():
            if not isinstance(values, dict):
                self._report("wrong-value", self._line("robots", name), f"`robots.{name}` must be a table")
                continue
            if not is_robot_name(name):
                message = f"the robot's name {name!r} can't be a file's name"
                hint = "use letters, digits, `_`, `-` and `.`, a letter or digit first"
                self._report("robot-name", self._line("robots", name), message, hint)
                continue
            try:
                domain = registry.domain(str(values.get("domain", defaults.get("domain", DEFAULT_DOMAIN))))
            except ConfigError as error:
                line = self._line(*(("robots", name) if "domain" in values else ("defaults",)), "domain")
                self.problems += [msgspec.structs.replace(d, file=self._file, line=line) for d in error.diagnostics]
                continue
            allowed |= _names_of(domain.options)
            if (robot := self._robot(name, values, defaults, domain)) is not None:
                yield robot
        table = self._table("`[defaults]`", defaults, "defaults")
        for key in OWN_KEYS:
            if key in defaults:
                message = f"`{key}` can't have a default: every robot has its own"
                self._report("unknown-key", table.lines[key], message)
        self._refuse_unknown(table, allowed)

    def check(self) -> tuple[CheckConfig, Mapping[str, int]]:
        """Read the table `[check]`, and the lines of its keys."""
        table = self._table("`[check]`", self._subtable("check"), "check")
        self._refuse_unknown(table, _names_of(CheckConfig))
        keys: CheckConfig = self._read(table, CheckConfig) or CheckConfig()
        for compiler in get_args(CompilerName):
            program = keys.program(compiler)
            if Path(program).name != program:  # a bare name is looked for on the PATH
                keys = msgspec.structs.replace(keys, **{compiler: str(self._absolute(Path(program)))})
        return keys, table.lines

    def find_clashes(self, robots: Sequence[RobotConfig]) -> None:
        """Report two robots with the same name or package folder, or with one package inside of the other."""
        names: dict[str, str] = {}
        folders = {_folded(robot.folder): robot.name for robot in reversed(robots)}
        for robot in robots:
            clashes = []
            if (other := names.setdefault(robot.name.casefold(), robot.name)) != robot.name:
                clashes.append(f"robots `{other}` and `{robot.name}` differ in case only")
            elif (other := folders[_folded(robot.folder)]) != robot.name:
                clashes.append(f"robots `{other}` and `{robot.name}` have the same package")
            around = filter(None, (folders.get(_folded(parent)) for parent in robot.folder.parents))
            clashes += [f"the package of robot `{robot.name}` lies inside that of robot `{other}`" for other in around]
            for message in clashes:
                self._report("clash", robot.lines["package"], message)

    def check_codes(self, robots: Sequence[RobotConfig]) -> None:
        """Report ignored and refused codes that no warning of the robots' formats has."""
        if not any(robot.ignore or robot.refuse for robot in robots):
            return  # other domains are looked for on Python's path, which takes 3 ms
        own = frozenset[str]().union(*(registry.domain(name).warnings for name in {robot.domain for robot in robots}))
        for key, codes, noun, end in (
            ("ignore", IGNORABLE | own, "warning or note", "errors can't be ignored"),
            ("refuse", OF_SOURCES | own, "warning or note about a source", "errors always stop a build"),
        ):
            wrong = {(robot.lines[key], code) for robot in robots for code in getattr(robot, key) - codes}
            for line, code in sorted(wrong):
                near = nearest(code, sorted(codes))
                hint = f"did you mean `{near}`?" if near else f"write the code at the end of a warning; {end}"
                self._report("unknown-code", line, f"no {noun} has the code `{code}`", hint)

    def _robot(self, name: str, own: dict[str, Any], defaults: dict[str, Any], domain: Domain) -> RobotConfig | None:
        """Read a robot from its own table and the defaults; None for a faulty table."""
        before, allowed = len(self.problems), _KEY_NAMES | _names_of(domain.options)
        inheritable = allowed.difference(OWN_KEYS, own)
        inherited = {key: value for key, value in defaults.items() if key in inheritable}
        lines = {key: self._line("defaults", key) for key in inherited}
        lines |= {key: self._line("robots", name, key) for key in ("", *own)}
        table = _Table(f"robot `{name}`", inherited | own, lines)
        self._refuse_unknown(table, allowed)
        keys, options = self._read(table, Keys), self._read(table, domain.options)
        if keys is None:
            return None
        for key, value in table.values.items():
            path = ("robots", name) if key in own else ("defaults",)
            if isinstance(value, dict):
                lines |= {f"{key}.{entry}": self._line(*path, key, entry) for entry in value}
            elif isinstance(value, list):
                items = [f"{key}.{item.get('name')}" for item in value if isinstance(item, dict)]
                item_lines = self._item_lines.get((*path, key), [lines[key]] * len(items))
                lines |= dict(zip(items, item_lines, strict=False))
        olds: dict[str, str] = {}
        for old, new in keys.renamed.items():
            if (other := olds.setdefault(new, old)) != old:
                message = f"robot `{name}`: both `{other}` and `{old}` are renamed to `{new}`"
                self._report("wrong-rename", lines[f"renamed.{old}"], message, "take one entry out")
        for key, message, hint in find_name_problems(keys.package, keys.class_):
            self._report("modelica-name", lines[key], message, hint)
        if keys.command and keys.arguments is not None:
            message, hint = f"robot `{name}`: `command` writes a source that xacro does not expand", "take one out"
            self._report("wrong-value", lines["arguments"], message, hint)
        elif keys.command_inputs and not keys.command:
            message = f"robot `{name}`: `command_inputs` without `command`"
            self._report("wrong-value", lines["command_inputs"], message, "add the command, or take the inputs out")
        output = self._absolute(keys.output)
        for folder, owner in ((STATE_FOLDER, "urdfsync"), (".git", "git")):
            if Path(_folded(output)).is_relative_to(_folded(self._root / folder)):
                message = f"`output` can't be in {folder}: {owner} keeps its own files there"
                self._report("wrong-value", lines["output"], message, "name another folder")
        if len(self.problems) > before:
            return None
        source, given = Path(table.values["source"]), keys.arguments or {}
        # as texts, like the arguments on xacro's command line
        arguments = {key: value if isinstance(value, str) else json.dumps(value) for key, value in given.items()}
        shared: dict[str, Any] = {field.name: getattr(keys, field.name) for field in _fields(SharedKeys)}
        return RobotConfig(
            **shared | {"output": output},
            name=name,
            source_text=source.name if source.is_absolute() else Path(os.path.normpath(source)).as_posix(),
            target=Target(keys.package, model_class(keys.package, keys.class_)),
            arguments=None if keys.arguments is None else arguments,
            options=options,
            lines=lines,
        )

    def _read(self, table: _Table, struct: type[msgspec.Struct]) -> Any:
        """Return an instance of `struct` with the values in `table`; None if a key is wrong or missing."""
        values: dict[str, Any] = {}
        before = len(self.problems)
        for field in _fields(struct):
            key = field.encode_name
            if key not in table.values:
                if field.required:
                    message, hint = f"{table.name} has no `{key}`", f"add a line `{key} = …`"
                    self._report("missing-key", table.lines[""], message, hint)
                continue
            words = "finite numbers"
            is_right = _is_finite(table.values[key])
            try:
                values[field.name] = msgspec.convert(table.values[key], field.type, dec_hook=self._path)
            except msgspec.ValidationError:
                words, is_right = in_words(field.type), False
            if not is_right and not self._find_wrong_items(table, key, field.type):
                given = json.dumps(table.values[key], ensure_ascii=False, default=str)
                self._report("wrong-value", table.lines[key], f"`{key}` must be {words}, not {given}")
        try:
            return struct(**values) if len(self.problems) == before else None
        except (TypeError, ValueError) as error:  # contradictory options
            self._report("wrong-value", table.lines[""], f"{table.name}: {error}")
            return None

    def _find_wrong_items(self, table: _Table, key: str, kind: Any) -> bool:
        """Report faults inside of the tables of a list; False if there is none, or `key` is no list of tables."""
        item_kind, items = next(iter(get_args(kind)), None), table.values[key]
        struct = next(filter(_is_struct, (item_kind, *get_args(item_kind))), None)
        if struct is None or not isinstance(items, list):
            return False
        before, line = len(self.problems), table.lines[key]
        # lines of `[[…]]`; tables within one value have the line of the value
        headers = (lines for path, lines in self._item_lines.items() if path[-1] == key and lines[0] == line)
        lines = next(headers, [line] * len(items))
        for item, item_line in zip(items, lines, strict=False):
            if isinstance(item, dict):
                part = _Table(f"`{key}` of {table.name}", item, dict.fromkeys(("", *item), item_line))
                self._refuse_unknown(part, _names_of(struct))
                self._read(part, struct)
        return len(self.problems) > before

    def _path(self, kind: type, value: Any) -> Path:
        """Return a path in the file as an absolute path; msgspec calls this function, and reports its TypeError."""
        if kind is not Path or not isinstance(value, str) or not value:  # "." is the folder of the configuration
            raise TypeError
        return self._absolute(Path(value))

    def _absolute(self, path: Path) -> Path:
        """Return a path without `..` and `.`. Symbolic links are not followed: messages show the user's path."""
        return Path(os.path.normpath(self._root / path))

    def _refuse_unknown(self, table: _Table, allowed: Collection[str]) -> None:
        for key in table.values:
            if key not in allowed:
                near = nearest(key, sorted(allowed))
                hint = f"did you mean `{near}`?" if near else f"use one of {', '.join(sorted(allowed))}"
                self._report("unknown-key", table.lines[key], f"unknown key `{key}` in {table.name}", hint)

    def _table(self, name: str, values: Mapping[str, Any], *path: str) -> _Table:
        return _Table(name, values, {key: self._line(*path, key) for key in ("", *values)})

    def _subtable(self, key: str) -> dict[str, Any]:
        value = self._document.get(key, {})
        if isinstance(value, dict):
            return value
        self._report("wrong-value", self._line(key), f"`{key}` must be a table")
        return {}

    def _line(self, *path: str) -> int:
        return tomlfile.nearest(self._lines, *filter(None, path))

    def _report(self, code: str, line: int, message: str, hint: str = "") -> None:
        self.problems.append(Diagnostic(Severity.ERROR, code, message, self._file, line, hint=hint))


def _names_of(struct: type[msgspec.Struct]) -> set[str]:
    return {field.encode_name for field in _fields(struct)}


_KEY_NAMES = _names_of(Keys)


def _folded(path: Path) -> str:
    return str(path).casefold()
