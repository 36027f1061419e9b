"""Builds: plans every robot, and writes what the plan says, all of it or nothing.

Nothing is locked to find out that nothing is to be done. Whoever has something to write takes the
build lock, makes sure that the plan still holds, and keeps the lock until all robots are built.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec

from urdfsync import looking, profiling
from urdfsync.config import STATE_FOLDER, Config, RobotConfig, shown
from urdfsync.diagnostics import Diagnostic, OutputError, Severity, StateError, UrdfsyncError
from urdfsync.outcome import Result
from urdfsync.planning import leftovers, shared
from urdfsync.planning.crew import Crew
from urdfsync.planning.disk import Disk
from urdfsync.planning.situation import Progress, Request
from urdfsync.planning.work import Work
from urdfsync.state.lock import Lock, LockedError, build_lock
from urdfsync.state.store import Store
from urdfsync.state.transaction import Change, Transactions, UnfinishedError

__all__ = ["Progress", "Request", "build"]

_ATTEMPTS = 5
"""How often a plan is made anew because somebody saved a file in between."""


def build(config: Config, robots: Sequence[RobotConfig], request: Request) -> Iterator[Result]:
    """Build robots one after the other; one that fails does not stop the others."""
    with (
        build_lock(config.root, config.root / STATE_FOLDER, request.wait, shown) as lock,
        Crew(config, robots, request) as crew,
    ):
        builder = _Builder(config, request, lock, crew)
        for count, robot in enumerate(robots):
            request.progress(robot.name, count, len(robots))
            result = builder.build(robot)
            said = builder.said()
            yield msgspec.structs.replace(result, diagnostics=(*said, *result.diagnostics)) if said else result


class _Builder:
    """The robots of one command."""

    def __init__(self, config: Config, request: Request, lock: Lock, crew: Crew) -> None:
        self._config, self._request, self._lock, self._crew = config, request, lock, crew
        outputs = list(dict.fromkeys(robot.output for robot in config.robots))
        self._transactions = Transactions(config.root, config.root / STATE_FOLDER, shown, outputs)
        self._said: list[Diagnostic] = []
        self._first = True

    def build(self, robot: RobotConfig) -> Result:
        """Build one robot. Whatever is wrong comes back as diagnostics, with what has become of the files."""
        result = Result(robot.name, robot.target.package, robot.folder, self._config.root, dry=self._request.dry)
        try:
            return self._run(robot, result)
        except UrdfsyncError as error:
            locked, unfinished = isinstance(error, LockedError), isinstance(error, UnfinishedError)
            found = error.diagnostics
        except OSError as error:
            locked = unfinished = False
            place = Path(error.filename) if isinstance(error.filename, str) else robot.folder
            found = (Diagnostic(Severity.ERROR, "system", error.strerror or str(error), shown(place)),)
        return msgspec.structs.replace(result, diagnostics=found, failed=True, locked=locked, unfinished=unfinished)

    def said(self) -> list[Diagnostic]:
        """What there is to say that belongs to no robot of this command, each only once."""
        if self._first:
            stray = leftovers.strays(Store(self._config.root, shown), self._config)
            self._said += [stray] if stray else []
            self._first = False
        said, self._said = self._said, []
        return said

    def _run(self, robot: RobotConfig, result: Result) -> Result:
        """Plan, and write unless the run is dry; again if that has been overtaken by other builds or by the user."""
        saved = robot.folder
        for _ in range(_ATTEMPTS):
            self._recover()
            work = self._crew.plan(robot)
            if self._request.dry:
                if self._is_current(work):
                    return _done(result, work)
                continue
            if work.writes or work.bases or any(action.writes for action in work.decision.actions.decided):
                looking.beyond()  # and it will look different
                with profiling.stage("waiting"):
                    self._lock.acquire(waiting=self._wait)
                if not self._is_current(work):
                    continue
                overtaken = self._write(robot, work)
                if overtaken:
                    saved = overtaken[0]
                    continue
            return _done(result, work)
        message = "it changes all the time while urdfsync builds"
        hint = "close what writes to it, then build again"
        raise OutputError(Diagnostic(Severity.ERROR, "restless", message, shown(saved), hint=hint))

    def _write(self, robot: RobotConfig, work: Work) -> tuple[Path, ...]:
        """Carry out a plan. Returns the files that somebody saved in between."""
        store, changes = Store(self._config.root, shown), [*self._around(robot, work), *work.writes]
        if self._request.memory:
            self._request.memory.invalidate(robot.name)
        store.bases(robot.name).add(work.bases)
        if not changes:
            return ()
        applied = self._transactions.apply(robot.name, changes, work.emptied)
        self._said += applied.diagnostics
        if work.mentioned is not None and not applied.overtaken:
            store.bases(robot.name).prune(work.mentioned)
            if work.former:
                store.bases(work.former).prune(())
        return applied.overtaken

    def _around(self, robot: RobotConfig, work: Work) -> list[Change]:
        """What this robot needs of the files that it shares with others."""
        around = shared.changes(work.decision.shared, Disk(self._config, robot).read_path)
        return [*around, *Store(self._config.root, shown).ignoring()]

    @profiling.staged("looking")
    def _is_current(self, work: Work) -> bool:
        """Whether no other build has written, or begun to, since the plan was made.

        Nearly every build writes the manifest, as its last file: so that one is looked at again here, and the others
        when they are written.
        """
        targets = {change.path for change in work.writes[:-1]}
        return not self._transactions.pending() and Store(self._config.root, shown).is_unchanged(work.witness, targets)

    def _recover(self) -> None:
        """Wait for a build that is writing; finish what one has left that was killed."""
        if not self._transactions.pending():
            return
        if self._request.dry:
            with build_lock(self._config.root, self._config.root / STATE_FOLDER, self._request.wait, shown) as lock:
                lock.acquire(shared=True, waiting=self._wait)
            if self._transactions.pending():
                message, hint = "the last build was interrupted", "run `urdfsync build`, which finishes it"
                place = shown(self._config.root / STATE_FOLDER)
                raise StateError(Diagnostic(Severity.ERROR, "interrupted", message, place, hint=hint))
            return
        self._lock.acquire(waiting=self._wait)
        self._said += self._transactions.recover(self._request.repair)

    def _wait(self) -> None:
        self._request.progress("waiting for another build", 0, 1)


def _done(result: Result, work: Work) -> Result:
    return msgspec.structs.replace(
        result,
        actions=work.decision.actions,
        diagnostics=work.diagnostics,
        changes=work.changes,
        standoffs=work.decision.standoffs,
        drawing=work.drawing,
    )
