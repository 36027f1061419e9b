"""Makes sources by xacro, by another translator, or by a command of the user's, before a build reads them.

The state records the inputs of a source with hashes (see `state.expansion`). If an input changed, the source is made
again.
"""

from __future__ import annotations

import os
import re
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import msgspec

from urdfsync.common import system
from urdfsync.common.dependencies.places import label
from urdfsync.common.dependencies.reads import read_file, read_variable
from urdfsync.common.diagnostics import SourceError
from urdfsync.common.files import digest, shown, text_digest
from urdfsync.common.processes import exit_cause, importable, is_out_of_time, python_module
from urdfsync.domain import Translator
from urdfsync.engine.sources import ros_packages
from urdfsync.engine.sources.exchange import Answer, Request, fault, not_unicode
from urdfsync.engine.sources.translators import XACRO
from urdfsync.engine.sources.xacro_worker import find_matches
from urdfsync.project.config import Config, RobotConfig
from urdfsync.project.state.expansion import Expansion

CPU_SECONDS = 20.0
"""CPU time for one expansion, on Linux and macOS. The largest robots take 2 s."""
MEMORY = 1_000_000_000
"""Bytes that the process of an expansion may allocate, on Linux."""
WALL_SECONDS = 120.0
"""Time for one expansion, on every system: `CPU_SECONDS` may take that long on a busy machine."""
_COMMAND_SECONDS = 600.0
"""Time for a command, which may wait for a server."""
_PACKAGE = "package://"
_INPUTS = "source arguments command patterns packages variables".split()
"""The inputs of a source that are no files."""


class SourceFiles:
    """The input files of one source: their places, and their names in the state."""

    def __init__(self, root: Path, source: Path, package_paths: Sequence[Path]) -> None:
        self.root, self.source, self.package_paths = root, source, tuple(package_paths)
        self._packages = ros_packages.Packages(self.package_paths, source)

    def path(self, name: str) -> Path | None:
        """Return the path of a file by its name; None if its package is not on this machine."""
        if not name.startswith(_PACKAGE):
            return Path(os.path.normpath(self.root / name))
        package, _, rest = name.removeprefix(_PACKAGE).partition("/")
        folder = self._packages.folder(package)
        return folder / rest if folder else None

    def name(self, path: str | Path, packages: Mapping[str, str | None]) -> str:
        """Return a file's name in the state; if possible, this name is the same on every machine."""
        file = Path(path)
        if not file.is_relative_to(self.root):
            for package, folder in packages.items():
                if folder and file.is_relative_to(folder):
                    return f"{_PACKAGE}{package}/{file.relative_to(folder).as_posix()}"
        # an absolute path if file and root are on different drives: no relative path leads there
        return Path(os.path.relpath(file, self.root) if file.parts[:2] == self.root.parts[:2] else file).as_posix()

    def package(self, name: str) -> str | None:
        """Return the name in the state of a package's folder; None if the package is not on this machine."""
        folder = self._packages.folder(name)
        return self.name(folder, {name: str(folder)}) if folder else None

    def look(self, robot: RobotConfig, names: Expansion) -> Expansion:
        """Return the present inputs of a robot's source; for a command, the configuration lists the files."""
        if robot.command:
            names = Expansion(files={self.name(path, {}): None for path in robot.command_inputs})
        key = {"source": robot.source_text, "arguments": robot.arguments or {}, "command": robot.command}
        return msgspec.structs.replace(self.read(names), **key)

    def read(self, names: Expansion) -> Expansion:
        """Return the present files, patterns, packages and variables that `names` lists, without text.

        If a package is missing on this machine, its files count as unchanged.
        """
        places = {name: self.path(name) for name in (*names.files, *names.patterns)}
        return Expansion(
            files={name: _file_hash(path) if (path := places[name]) else old for name, old in names.files.items()},
            patterns={
                name: _names_hash(path) if (path := places[name]) else old for name, old in names.patterns.items()
            },
            packages={name: self.package(name) or old for name, old in names.packages.items()},
            variables={name: _variable_hash(name) for name in names.variables},
        )

    def find_changes(self, robot: RobotConfig, made: Expansion) -> tuple[str, ...]:
        """Return the inputs that changed since a source was made: the kinds of inputs, and each file."""
        now = self.look(robot, made)
        others = (key for key in _INPUTS if getattr(now, key) != getattr(made, key))
        return (*others, *(name for name in {**made.files, **now.files} if made.files.get(name) != now.files.get(name)))

    def why_not_expandable(self, made: Expansion, error: SourceError) -> str:
        """Return what this machine lacks to expand a source again, as a clause; empty for a faulty source."""
        if error.diagnostics[0].code == "not-installed":
            return error.diagnostics[0].message
        places = {name: self.path(name) for name, sha256 in made.files.items() if sha256}
        missing = [name for name, path in places.items() if path is None or _file_hash(path) is None]
        return f"{missing[0]} is not on this machine" if missing else ""

    def places(self, made: Expansion) -> list[tuple[int, str, int]]:
        """Return the line of each element in an expansion, with the element's original file and line."""
        try:
            files = [shown(self.path(name) or Path(name)) for name in made.files]
            entries = (map(int, re.split("[=:]", entry)) for entry in made.places.split())
            return [(line, files[number], origin) for line, number, origin in entries]
        except (IndexError, ValueError):  # urdfsync did not write this text
            return []


def _file_hash(path: Path) -> str | None:
    """Return the hash of a file, ignoring kinds of line ends; None for an unreadable file."""
    try:
        return text_digest(read_file(path))
    except (OSError, ValueError):  # a stranger may have written an invalid name
        return None


def _names_hash(pattern: Path) -> str:
    """Return a hash of the names of files that match a pattern."""
    names = "\0".join(os.path.basename(path) for path in find_matches(str(pattern)))  # noqa: PTH119
    return digest(names.encode(errors="surrogateescape"))


def _variable_hash(name: str) -> str | None:
    """Return the hash of an environment variable; None if it is not set."""
    value = read_variable(name)
    return None if value is None else digest(value.encode(errors="surrogateescape"))


def expand(
    inputs: SourceFiles,
    arguments: Mapping[str, str],
    contents: Mapping[str, bytes] | None = None,
    translator: Translator = XACRO,
) -> Expansion:
    """Expand a source by its translator, in a process of its own. Raises SourceError.

    `contents` override files on disk, by absolute path.
    """
    if label(str(inputs.source)):  # another process finds no files of a revision
        message, hint = (
            "its expansion is not recorded",
            "name a revision with a complete build, or use --against ./FILE",
        )
        raise SourceError.of("broken-state", message, shown(inputs.source), hint=hint)
    answer = _ask(translator, inputs, arguments, contents=contents or {})
    names = {path: inputs.name(path, answer.packages) for path in answer.files}
    number = {path: index for index, path in enumerate(sorted(names, key=names.__getitem__))}
    made = Expansion(
        arguments=arguments,
        files={names[path]: answer.files[path] for path in number},
        patterns={inputs.name(path, answer.packages): _names_hash(Path(path)) for path in answer.patterns},
        packages={name: folder and inputs.name(folder, {name: folder}) for name, folder in answer.packages.items()},
        variables={name: _variable_hash(name) for name in answer.variables},
        unused=answer.unknown,
        warnings=answer.warnings,
        places=" ".join(f"{line}={number[file]}:{origin}" for line, file, origin in answer.places),
        text=answer.text,
    )
    if (problem := answer.problem) is not None:
        message = problem.message or f"expanding it takes more than {CPU_SECONDS:g} s or {MEMORY / 1e9:g} GB"
        for path in answer.files:
            message = message.replace(path, shown(Path(path)))
        file = shown(Path(problem.file)) if problem.file else shown(inputs.source)
        place, hint = (file, problem.line), problem.hint or translator.hints.get(problem.code, "")
        inputs.read(made)  # records them as dependencies, as `find_changes` does after a success
        raise SourceError.of(problem.code, message, *place, hint=hint)
    return made


def compare(inputs: SourceFiles, arguments: Mapping[str, str], text: str, translator: Translator) -> Answer:
    """Let a translator compare a text with its source, in a process of its own. Raises SourceError."""
    answer = _ask(translator, inputs, arguments, text=text)
    if answer.problem:
        raise SourceError.of(answer.problem.code, answer.problem.message, shown(inputs.source))
    return answer


def _ask(translator: Translator, inputs: SourceFiles, arguments: Mapping[str, str], **more: Any) -> Answer:
    """Expand a source in another process; `more` are further fields of the request."""
    folders = tuple(map(str, inputs.package_paths))
    request = Request(str(inputs.source), arguments, folders, CPU_SECONDS, MEMORY, str(inputs.root), **more)
    limits = Answer(problem=fault(f"{translator.name}-limits", ""))
    try:
        question = msgspec.json.encode(request)
    except UnicodeEncodeError:
        return Answer(problem=not_unicode(translator.name))
    try:
        done = subprocess.run(  # noqa: S603 - a command of ours
            python_module(translator.module),
            input=question,
            capture_output=True,
            timeout=WALL_SECONDS,
            env={**os.environ, **importable(), "PYTHONHASHSEED": "0"},  # the text is the same each time
            **system.own_group(),  # Ctrl-C must reach only this process, which then ends the worker
            check=False,
        )
        return msgspec.json.decode(done.stdout, type=Answer)
    except subprocess.TimeoutExpired:
        return limits
    except msgspec.DecodeError:  # the process ended too early
        if done.returncode < 0 or is_out_of_time(done.returncode):
            return limits
        words = done.stderr.decode(errors="replace").strip().splitlines()[-1:]
        return Answer(problem=fault(translator.name, ": ".join([exit_cause(done.returncode), *words])))


def run_command(config: Config, robot: RobotConfig) -> None:
    """Run a robot's command, which writes the source, in the configuration's folder. Raises SourceError if it fails."""
    try:
        done = subprocess.run(  # noqa: S603 - the user has trusted this configuration
            system.command(robot.command, config.root),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            cwd=config.root,
            timeout=_COMMAND_SECONDS,
            check=False,
        )
        words = done.stdout.decode(errors="replace").strip().splitlines()[-1:]
        reason = ": ".join([exit_cause(done.returncode), *words]) if done.returncode else ""
        if not reason and not robot.source.is_file():
            reason = f"it did not write {shown(robot.source)}"
    except subprocess.TimeoutExpired:
        reason = f"it takes more than {_COMMAND_SECONDS:g} s"
    except OSError as error:
        reason = error.strerror or str(error)
    if reason:
        message = f"robot `{robot.name}`: the command `{system.join_words(robot.command)}` failed: {reason}"
        place, hint = (shown(config.file), robot.lines.get("command", 0)), "correct it, then build again"
        raise SourceError.of("command", message, *place, hint=hint)
