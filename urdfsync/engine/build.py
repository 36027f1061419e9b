"""Builds robots: plans each robot whose remembered result does not hold any more, and carries out the plan.

Planning locks nothing. A build with something to write takes the build lock, and verifies the plan. It keeps the lock
until all robots are built.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import msgspec

from urdfsync.common.dependencies.facts import Dependencies
from urdfsync.common.dependencies.reads import Reads, include
from urdfsync.common.diagnostics import (
    ConfigError,
    Diagnostic,
    OutputError,
    Severity,
    SourceError,
    UrdfsyncError,
    findings_of,
)
from urdfsync.common.files import shown
from urdfsync.common.processes import machine
from urdfsync.engine.inspect.inputs import read_stray_states
from urdfsync.engine.inspect.package_files import PackageFiles
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.plan import plan_robot
from urdfsync.engine.remembered import RobotMemory
from urdfsync.engine.result import Outlook, Result
from urdfsync.engine.stage.writes import Plan, shared_change
from urdfsync.project.config import STATE_FOLDER, Config, RobotConfig
from urdfsync.project.config.trust import find_untrusted_output
from urdfsync.project.state import notes
from urdfsync.project.state.lock import Lock, LockedError, build_lock
from urdfsync.project.state.store import Store
from urdfsync.project.state.transaction import UNFINISHED, Transactions, find_leftovers

if TYPE_CHECKING:
    from urdfsync.engine.pool import Planned

WAITING = "waiting for"
"""Words of progress while another process builds; a description of the process follows."""
_LEAST_ROBOTS = 6
"""With fewer robots, importing urdfsync in each worker takes longer than it saves."""
_ATTEMPTS = 5
"""The greatest number of attempts to plan one robot: another build or a save may make a plan outdated."""


def build(config: Config, robots: Sequence[RobotConfig], options: BuildOptions) -> Iterator[Result]:
    """Build robots one after the other; a failure does not stop the other robots."""
    with contextlib.ExitStack() as stack:
        lock = stack.enter_context(build_lock(config.root / STATE_FOLDER, options.wait))
        builder = _Builder(config, options, lock)
        known = builder.recall(robots)
        changed = [robot for robot in robots if robot.name not in known]
        if len(changed) >= _LEAST_ROBOTS and (options.jobs or machine.cores()) > 1:
            from urdfsync.engine.pool import plan_ahead  # multiprocessing takes 15 ms to import

            builder.plans = plan_ahead(config, changed, options)
            stack.callback(builder.plans.close)
        for count, robot in enumerate(robots):
            options.progress(robot.name, count, len(robots))
            built = known.get(robot.name) or builder.build(robot)
            notes = config.without_ignored([*([] if count else read_stray_states(config)), *builder.notes])
            builder.notes = []
            findings = (*notes, *robot.without_ignored(built.outlook.diagnostics))
            others = {"diagnostics": findings, "dry": options.dry, "reads": built.reads, **built.failure}
            yield Result.of(config, robot, built.outlook, **others)


def _refuse(robot: RobotConfig, outlook: Outlook) -> Outlook | None:
    """Return an outlook without writes whose errors are the findings that `refuse` names; None without any."""
    if not any(finding.code in robot.refuse for finding in outlook.diagnostics):
        return None
    findings = list[Diagnostic]()
    for finding in outlook.diagnostics:
        if finding.code in robot.refuse:
            hint = f"{finding.hint or 'correct the source'}; to accept it, take the code out of `refuse`"
            findings.append(msgspec.structs.replace(finding, severity=Severity.ERROR, hint=hint))
        elif finding.severity is not Severity.NOTE:  # notes tell what a build does
            findings.append(finding)
    return Outlook(diagnostics=tuple(findings), changes=outlook.changes)


class _Built(NamedTuple):
    """The outlook of one robot whose plan was carried out, or its failure."""

    outlook: Outlook
    reads: Dependencies
    """All that the build has read; written files have their new facts."""
    failure: Mapping[str, Any] = {}
    """Fields of the result of a failed build."""


class _Builder:
    """The robots of one command."""

    def __init__(self, config: Config, options: BuildOptions, lock: Lock) -> None:
        self._config, self._options, self._lock = config, options, lock
        self._memory = RobotMemory(config, options)
        self.plans: Generator[tuple[RobotConfig, Planned]] | None = None
        """The plans of the robots that are not remembered, if there are many."""
        self._state_folder = config.root / STATE_FOLDER
        self._transactions = Transactions(config.root, {robot.output for robot in config.robots})
        self.notes: list[Diagnostic] = []
        """Findings that belong to no robot of this command."""

    def recall(self, robots: Iterable[RobotConfig]) -> dict[str, _Built]:
        """Return what is remembered, by name of robot; robots whose package leaves something to do have none."""
        known = dict[str, _Built]()
        for robot in robots:
            if not robot.output.is_relative_to(self._config.root):
                continue  # it matters who trusts the folder
            with contextlib.suppress(UrdfsyncError):  # its domain is missing, or broken: the build reports it
                if found := self._memory.recall(robot):
                    known[robot.name] = _Built(*found)
        return known

    def build(self, robot: RobotConfig) -> _Built:
        """Build one robot. All errors become diagnostics."""
        self._reads = Reads()
        try:
            untrusted = None if self._options.trusted else find_untrusted_output(self._config, robot)
            if untrusted:
                raise ConfigError(untrusted)  # noqa: TRY301 - the `except` below reports it
            return self._plan_and_write(robot)
        except Exception as error:  # noqa: BLE001 - other robots go on: each build reads all from the disk
            findings = findings_of(error)
            failure = {
                "failed": True,
                "locked": isinstance(error, LockedError),
                "unfinished": any(finding.code == UNFINISHED for finding in findings),
                "source_error": error if isinstance(error, SourceError) else None,
            }
            return _Built(Outlook(diagnostics=findings), self._reads.entries, failure=failure)

    def _plan_and_write(self, robot: RobotConfig) -> _Built:
        """Plan, and write unless the run is dry. Repeat if another build or a save made the plan outdated."""
        saved, folders = robot.folder, self._folders(robot)
        for attempt in range(_ATTEMPTS):
            with Reads() as self._reads:
                leftovers = self._clear_leftovers(folders)
                if self.plans and not attempt:
                    planned, others = next(planned for other, planned in self.plans if other is robot)
                    include(others)
                    if isinstance(planned, Exception):
                        raise planned
                    plan = planned
                else:
                    plan = plan_robot(self._config, robot, self._options, self._reads)
            if not self._options.removes and (refused := _refuse(robot, plan.outlook)) is not None:
                return _Built(refused, self._reads.entries, failure={"failed": True})
            folders |= {*plan.emptied, *(change.path.parent for change in plan.writes.in_order())}  # the last package's
            is_writing = not self._options.dry and bool(plan.outlook.writes or plan.writes)
            if is_writing:
                self._lock.acquire(self._wait)
            if find_leftovers(folders) != leftovers or not Store(self._config.root).is_unchanged(plan.state):
                continue  # another build has written, or begun to write, since the plan was made
            if not is_writing:
                return self._finish(robot, plan, {})
            files = PackageFiles(self._config, robot)
            # a package without its order would count as the user's: if the build is killed, the order is there first
            ordered = sorted(plan.shared, key=lambda file: file.content is not None)
            shared = [change for file in ordered if (change := shared_change(file, files)) is not None]
            writes = msgspec.structs.replace(plan.writes, files=(*shared, *plan.writes.files))
            self._note_edits(robot, plan)
            applied = self._transactions.apply(writes, plan.emptied)
            self.notes += applied.diagnostics
            if applied.overtaken is None:
                return self._finish(robot, plan, applied.written)
            saved = applied.overtaken
        message = "it keeps changing during the build"
        hint = "close the program that writes it, then build again"
        raise OutputError.of("restless", message, shown(saved), hint=hint)

    def _finish(self, robot: RobotConfig, plan: Plan, written: Mapping[str, str | None]) -> _Built:
        """Save this machine's notes; remember a plan without writes. Returns the plan's outlook and its reads.

        `written` has the hashes of the written files by path.
        """
        if plan.notes:
            written = {**written, **notes.save(self._state_folder, robot.name, plan.notes)}
        self._reads.renew(written)
        facts = self._reads.entries
        # without `renews`, a plan writes less than the next one may
        if self._reads.complete and self._options.renews and not (plan.writes or plan.outlook.writes):
            result = Result.of(self._config, robot, plan.outlook, dry=self._options.dry, reads=facts)
            self._memory.remember(robot, result)
        return _Built(plan.outlook, facts)

    def _note_edits(self, robot: RobotConfig, plan: Plan) -> None:
        """Note the parts of the edits before the plan moves them: if this build is killed, the next one asks nobody."""
        known = Store(self._config.root).notes(robot.name)
        if plan.notes and plan.notes.edits != known.edits:
            notes.save(self._state_folder, robot.name, msgspec.structs.replace(known, edits=plan.notes.edits))

    def _folders(self, robot: RobotConfig) -> set[Path]:
        """Return the folders in which a killed build of a robot may have left temporary files."""
        state, above = self._state_folder, robot.folder.parents
        trees = robot.folder, *(state / kind / robot.name for kind in ("aside", "bases", "conflicts"))
        around = above[: 1 + above.index(robot.output)]
        return {Path(folder) for tree in trees for folder, _, _ in os.walk(tree)} | {
            *around,
            state,
            *(state / kind for kind in ("notes", "robots", "svg")),
        }

    def _clear_leftovers(self, folders: Iterable[Path]) -> list[str]:
        """Wait for a build that is writing; clear what a killed one left. Return what a dry run leaves there."""
        if (found := find_leftovers(folders)) and self._options.dry:
            with contextlib.suppress(OutputError), build_lock(self._state_folder, self._options.wait) as lock:
                lock.acquire(self._wait)  # without a lock in this folder, no process writes
            return find_leftovers(folders)
        if found:
            self._lock.acquire(self._wait)
            self.notes += self._transactions.clear(find_leftovers(folders))
        return []

    def _wait(self) -> None:
        self._options.progress(f"{WAITING} {self._lock.holder()}, which is building", 0, 1)
