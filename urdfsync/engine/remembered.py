"""Remembers the result of a robot's last complete build that had nothing to do, with all that this build has read.

Builds, dry runs, `status`, `diff`, the hooks and the daemon ask it before they plan a robot.
"""

from __future__ import annotations

import os
from collections.abc import Sequence

import msgspec

from urdfsync.common import noop
from urdfsync.common.dependencies.facts import Dependencies
from urdfsync.common.dependencies.memory import CONFIGURATION, ROBOT, Memory, Remembered
from urdfsync.common.dependencies.places import is_clone
from urdfsync.common.dependencies.reads import Reads
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.files import digest, shown
from urdfsync.domain import registry
from urdfsync.domain.comparison import Changes
from urdfsync.engine.actions import Action, Actions, FileStatus, Reason
from urdfsync.engine.inspect.inputs import read_stray_states
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Outlook, Result
from urdfsync.project.config import STATE_FOLDER, Config, RobotConfig

_SILENT = frozenset({Reason.UNCHANGED, Reason.KEEP, Reason.UNKNOWN})
"""Reasons of actions that `build` does not list."""


class _Stored(msgspec.Struct, frozen=True, array_like=True):
    """The parts of a result with nothing to write that do not follow from the configuration."""

    actions: tuple[Action, ...]
    diagnostics: tuple[Diagnostic, ...]
    is_broken: bool
    changes: Changes | None
    lines: str
    """Hash of the robot's lines in the configuration if `diagnostics` state one; else empty."""


class RobotMemory:
    """The results of the robots of one configuration that are remembered, for one command."""

    def __init__(self, config: Config, options: BuildOptions) -> None:
        self._config, self._memory = config, Memory(config.root / STATE_FOLDER)
        self._asks_for_plan = bool(options.full or options.draw or options.choices or options.adopts or options.removes)
        folders = [(robot.name, str(robot.folder)) for robot in config.robots]
        shared = repr((folders, options.merges, config.file, config.check, options.package_paths))
        self._shared = digest(shared.encode(errors="surrogateescape"))

    def key(self, robot: RobotConfig) -> str:
        """Return all that decides about a robot and is no file. Raises ConfigError for a broken domain."""
        own = msgspec.structs.replace(robot, lines={}, ignore=frozenset(), refuse=frozenset())
        codes = sorted(robot.ignore), sorted(robot.refuse)  # sets have another order in each process
        parts = own, codes, self._shared, registry.program(robot.domain)
        return digest(msgspec.json.encode(parts, enc_hook=os.fsencode))  # names of files may not be UTF-8

    def recall(self, robot: RobotConfig) -> tuple[Outlook, Dependencies] | None:
        """Return the remembered outlook for a robot, and all that it rests on.

        Returns None if anything has changed since, if nothing is remembered, or if the options ask for a new plan.
        Raises ConfigError for a broken domain.
        """
        if self._asks_for_plan or (found := self._memory.recall(f"{robot.name}{ROBOT}", self.key(robot))) is None:
            return None
        try:
            stored = msgspec.msgpack.decode(found.result, type=_Stored)
        except (msgspec.MsgspecError, UnicodeDecodeError):
            return None
        if stored.lines and stored.lines != _lines(robot):
            return None
        known = Actions(stored.actions), stored.diagnostics
        return Outlook(*known, is_broken=stored.is_broken, changes=stored.changes), found.dependencies

    def remember(self, robot: RobotConfig, result: Result) -> None:
        """Remember a result without writes; the list of its reads is complete."""
        if self._asks_for_plan or result.failed or result.stale or result.conflicts or result.settled:
            return
        stated = any(finding.file == shown(self._config.file) for finding in result.diagnostics)
        lines, findings = _lines(robot) if stated else "", robot.without_ignored(result.diagnostics)
        stored = _Stored(tuple(result.actions), result.diagnostics, result.is_broken, result.changes, lines)
        words = [result.summary, _quick_commands(result), still(findings) or noop.NONE, *map(finding_key, findings)]
        try:
            content = msgspec.msgpack.encode(stored)
        except UnicodeEncodeError:  # a file's name is not UTF-8
            return
        self._memory.save(f"{robot.name}{ROBOT}", self.key(robot), Remembered(result.reads, words, content))


def remember_configuration(config: Config, reads: Reads) -> None:
    """Remember a configuration without warnings whose robots were all built: then a no-op build need not read it."""
    memory, name = Memory(config.root / STATE_FOLDER), f"{config.file.name}{CONFIGURATION}"
    if memory.recall(name):
        return  # it still holds
    for robot in config.robots:
        is_plain = registry.is_own(robot.domain) and robot.output.is_relative_to(config.root)
        if (robot.on_build == "check" and not is_clone()) or not is_plain:
            return  # these builds do more than compare
    with reads:
        strays = read_stray_states(config)
    if reads.complete and not strays:
        robots = RobotMemory(config, BuildOptions())
        words = [word for robot in config.robots for word in (robot.name, robots.key(robot))]
        memory.save(name, "", Remembered(reads.entries, words))


def _lines(robot: RobotConfig) -> str:
    return digest(repr(sorted(robot.lines.items())).encode())


def _quick_commands(result: Result) -> str:
    """Return the commands (`hook build status`) that tell no more than the summary and a number of findings.

    `-` stands for none. `noop` reads these words.
    """
    findings = (each.severity is Severity.ERROR or each.file.endswith(".mo") for each in result.diagnostics)
    if not result.in_step:
        return noop.NONE
    if any(findings) or any(action.reason not in _SILENT for action in result.actions):
        return noop.IN_STEP
    is_edited = any(action.status is not FileStatus.IN_STEP for action in result.actions)
    return f"{noop.IN_STEP} build" if is_edited else f"{noop.IN_STEP} build status"


def still(findings: Sequence[Diagnostic]) -> str:
    """Return a sentence about findings that were told before; empty without any."""
    codes = ", ".join(dict.fromkeys(finding.code for finding in findings))
    return noop.still(len(findings), codes) if findings else ""


def finding_key(finding: Diagnostic) -> str:
    """Return a hash of a finding, the same from each working folder."""
    file = os.path.abspath(finding.file)  # noqa: PTH100 - strings: many robots have many findings
    return digest(f"{finding.code}\0{finding.statement}\0{file}".encode(errors="surrogatepass"))
