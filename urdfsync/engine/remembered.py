"""Remembers the result of a robot's last complete build that had nothing to do, with all that this build has read.

Builds, dry runs, `status`, `diff`, the hooks and the daemon ask `recall` before they plan a robot.
"""

from __future__ import annotations

import os
from collections.abc import Sequence

import msgspec

from urdfsync import noop, registry
from urdfsync.changes import Changes
from urdfsync.config import STATE_FOLDER, Config, RobotConfig
from urdfsync.dependencies import record
from urdfsync.dependencies.facts import Entry, Facts
from urdfsync.dependencies.places import is_clone
from urdfsync.dependencies.reads import Reads
from urdfsync.dependencies.record import DependencyRecord, FactList
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.actions import Action, Actions, FileStatus, Reason
from urdfsync.engine.inspect.inputs import read_stray_states
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Outlook, Result
from urdfsync.files import digest, shown

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


class RecordKeys:
    """The keys of the robots of one configuration: each holds all that decides about a robot and is no file."""

    def __init__(self, config: Config, options: BuildOptions) -> None:
        folders = [(robot.name, str(robot.folder)) for robot in config.robots]
        shared = repr(
            (folders, options.merges, config.file, config.check, options.package_paths, record.surroundings())
        )
        self._shared = digest(shared.encode(errors="surrogateescape"))
        self._is_plain = not (options.full or options.draw or options.choices or options.adopts or options.removes)

    def key(self, robot: RobotConfig) -> str:
        """Return the robot's key; empty if the options ask for a new plan. Raises ConfigError for a broken domain."""
        if not self._is_plain:
            return ""
        own = msgspec.structs.replace(robot, lines={}, ignore=frozenset(), refuse=frozenset())
        codes = sorted(robot.ignore), sorted(robot.refuse)  # sets have another order in each process
        code = "" if registry.is_own(robot.domain) else registry.program(robot.domain)
        # paths become bytes: names of files may not be UTF-8
        return digest(msgspec.json.encode((own, codes, self._shared, code), enc_hook=os.fsencode))


def recall(config: Config, robot: RobotConfig, key: str, seen: dict[Entry, Facts]) -> tuple[Outlook, FactList] | None:
    """Return the remembered outlook for a robot, and the facts of all that it rests on.

    Returns None if anything has changed since, or nothing is remembered.
    `seen` has facts that were looked at just now, and gets the others.
    """
    folder, name = str(config.root / STATE_FOLDER), f"{robot.name}{noop.ROBOT}"
    found = record.recall(folder, name, key, seen) if key else None
    if found is None:
        return None
    try:
        stored = msgspec.msgpack.decode(found.result, type=_Stored)
    except (msgspec.MsgspecError, UnicodeDecodeError):
        return None
    if stored.lines and stored.lines != _lines(robot):
        return None
    known = Actions(stored.actions), stored.diagnostics
    return Outlook(*known, is_broken=stored.is_broken, changes=stored.changes), found.facts


def remember(config: Config, robot: RobotConfig, key: str, result: Result) -> None:
    """Remember a result without writes; the list of its reads is complete."""
    if not key or result.failed or result.stale or result.conflicts or result.settled:
        return
    stated = any(finding.file == shown(config.file) for finding in result.diagnostics)
    stored = _Stored(
        tuple(result.actions), result.diagnostics, result.is_broken, result.changes, _lines(robot) if stated else ""
    )
    findings = robot.without_ignored(result.diagnostics)
    words = [result.summary, _quick_commands(result), still(findings) or noop.NONE, *map(finding_key, findings)]
    try:
        content = msgspec.msgpack.encode(stored)
    except UnicodeEncodeError:  # a file's name is not UTF-8
        return
    folder = str(config.root / STATE_FOLDER)
    DependencyRecord(key, result.reads, words, content).save(folder, f"{robot.name}{noop.ROBOT}")


def remember_configuration(config: Config, reads: Reads) -> None:
    """Remember a configuration without warnings whose robots were all built: then a no-op build need not read it."""
    if noop.robot_keys(str(config.file), {}) is not None:
        return  # the record still holds
    for robot in config.robots:
        is_plain = registry.is_own(robot.domain) and robot.output.is_relative_to(config.root)
        if (robot.on_build == "check" and not is_clone()) or not is_plain:
            return  # these builds do more than compare
    with reads:
        strays = read_stray_states(config)
    if not strays:
        keys = RecordKeys(config, BuildOptions())
        noop.remember(str(config.file), reads, {robot.name: keys.key(robot) for robot in config.robots})


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
