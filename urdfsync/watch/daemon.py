"""The daemon: one thread that waits for events, lets files settle, and builds.

An event only says where to look. What is built is decided by the files on disk, so an event too many or too few costs
time and nothing else.

A robot is built until a build leaves all files as they were before it. So the daemon need not know what it wrote
itself: after a build that wrote something, or during which somebody else did, the files settle, and are built again.
"""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Iterable, Sequence
from pathlib import Path
from queue import Empty, SimpleQueue

import msgspec

from urdfsync import config
from urdfsync.config import STATE_FOLDER, Config, warnings
from urdfsync.diagnostics import ConfigError, Diagnostic, OutputError, Severity, SourceError
from urdfsync.engine.build import WAITING
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Result
from urdfsync.files import shown
from urdfsync.state.lock import Lock, LockedError
from urdfsync.watch import build, events, precommit
from urdfsync.watch.checks import CheckEnded, CheckQueue
from urdfsync.watch.exec import CommandEnded, CommandRunner
from urdfsync.watch.observer import Observer
from urdfsync.watch.paths import WatchedPaths, find_robot_paths, find_watched_paths
from urdfsync.watch.robot import Hashes, Invalid, Resting, Unsettled, WatchedRobot, read_state

_PAUSE = 0.25
"""Seconds between two looks whether pre-commit has ended."""
_POLL = 1.0
"""Seconds between two reads of all inputs, where there are no events; and of a source that is invalid."""


class WatchOptions(msgspec.Struct, frozen=True):
    """What the command line asks for; times in seconds."""

    file: Path
    """The configuration."""
    robots: tuple[str, ...] = ()
    """Names of the robots; empty for all."""
    settle: float = 0.3
    """Without an event before a build."""
    sample: float = 0.2
    """Between the two looks that have to show the same; with 0 there is one look."""
    give_up_after: float = 30.0
    """Until an invalid source is an error."""
    recheck_shrunk: float = 2.0
    """Until a source that has lost many elements is believed."""
    rescan: float = 30.0
    """Between two reads of everything."""
    poll: bool = False
    """Do without events."""
    command: str = ""
    """What to run after a build that changed something; empty for nothing."""
    build: BuildOptions = msgspec.field(default_factory=BuildOptions)


class Daemon:
    """Keeps the packages of one configuration in step until it is told to stop."""

    def __init__(self, options: WatchOptions, listener: events.Listener) -> None:
        self._options, self._listener = options, listener
        self._build_options = msgspec.structs.replace(options.build, progress=self._progress)
        self._queue: SimpleQueue[object] = SimpleQueue()
        """Paths that may have changed, `CommandEnded`, `CheckEnded`, and None to wake the daemon."""
        self._observer = Observer(self._queue)
        self._robots: dict[str, WatchedRobot] = {}
        self._checks = CheckQueue(self._queue, options.build)
        self._commands = CommandRunner(self._queue, options.command, options.file.absolute().parent)
        self._config: Config
        self._config_hash = self._hash_config()
        self._watched = WatchedPaths()
        self._unwatched: tuple[Diagnostic, ...] = ()
        self._stop_signal = ""
        self._building: Sequence[str] = ()
        """Robots that are built, until the user was told for whom they wait."""
        self._is_working = True
        self._is_paused = False
        self._next_poll = self._next_rescan = 0.0

    def stop(self, signal: str) -> None:
        """End when the build in hand is finished, or given up if it has not begun to write. For signal handlers.

        Called again, it raises KeyboardInterrupt while there is work, but not while a check is cleared away.
        """
        if self._stop_signal and self._is_working:
            raise KeyboardInterrupt
        self._stop_signal = self._stop_signal or signal
        self._queue.put(None)

    def run(self) -> None:
        """Watch until `stop` is called. Raises ConfigError for a configuration that can't be used at the start.

        Raises LockedError if another daemon watches it, OutputError if the lock can't be written.
        """
        loaded = config.load(self._options.file)
        try:
            lock_file = loaded.root / STATE_FOLDER / "watch.lock"
            with Lock(lock_file, 0) as lock, contextlib.closing(self._observer), self._checks:
                self._acquire(lock)
                try:
                    self._work(loaded, lock)
                finally:
                    self._is_working = False
        except KeyboardInterrupt:
            if not self._stop_signal:
                raise
        self._listener(events.Stopping(self._stop_signal))

    def _work(self, loaded: Config, lock: Lock) -> None:
        self._use(loaded)
        self._next_rescan = time.monotonic() + self._options.rescan
        while not self._stop_signal:
            self._receive()
            if time.monotonic() >= self._next_rescan:
                with contextlib.suppress(OutputError):  # where this daemon can't write the lock, no other can
                    self._acquire(lock)
                self._rescan()
            elif self._is_polling and time.monotonic() >= self._next_poll:
                self._poll()
            self._build_settled()

    def _acquire(self, lock: Lock) -> None:
        """Take the daemon's lock; again if its file was deleted, since another daemon could not see it."""
        try:
            lock.acquire()
        except LockedError:
            message = f"{lock.holder()} watches this configuration already"
            hint = "use that one, or stop it first"
            found = Diagnostic(Severity.ERROR, "watched", message, shown(self._options.file.absolute()), hint=hint)
            raise LockedError(found) from None

    def _note(self, diagnostics: tuple[Diagnostic, ...]) -> None:
        if diagnostics:
            self._listener(events.Noted(diagnostics))

    def _progress(self, what: str, _done: int, _total: int) -> None:
        """Give up the build under way, which has come to a place for that; or say whom it waits for."""
        if self._stop_signal:
            raise KeyboardInterrupt
        if what.startswith(WAITING):
            self._show_all([events.Waiting(name, what) for name in self._building])
            self._building = []

    # The configuration

    def _use(self, loaded: Config, again: bool = False) -> None:
        """Put a configuration in force, and build all. Raises ConfigError for robots that it lacks."""
        robots = loaded.select(self._options.robots)
        self._config = loaded
        self._checks.use(loaded)
        before, self._robots = self._robots, {}
        for robot in robots:  # of those that were watched before, the last results are still known
            paths = find_robot_paths(loaded, robot, self._options.build.package_paths)
            state = Unsettled(time.monotonic() + self._options.settle)
            watched = before.get(robot.name) or WatchedRobot(robot, paths, state)
            watched.robot, watched.paths, watched.state, watched.built = robot, paths, state, None
            self._robots[robot.name] = watched
        self._listener(events.Started(loaded.file, tuple(self._robots), again))
        self._note(tuple(warnings.find_warnings(loaded, robots)))
        self._watch_folders()

    def _hash_config(self) -> str:
        return read_state(str(self._options.file.absolute())).sha256

    def _reload_config(self) -> bool:
        """Read the configuration again if it has changed; while it is invalid, the last valid one stays in force."""
        before, self._config_hash = self._config_hash, self._hash_config()
        if before == self._config_hash:
            return False
        try:
            self._use(config.load(self._options.file), again=True)
        except ConfigError as error:
            self._note(error.diagnostics)
            return False
        return True

    # Events

    def _receive(self) -> None:
        """Wait until something happens or is due; let settle what has changed, and take note of all else."""
        paths: set[str] = set()
        with contextlib.suppress(Empty):  # the first `get` waits; the others take what has come meanwhile
            message = self._queue.get(timeout=self._seconds_until_due())
            while True:
                match message:
                    case str():
                        paths.add(message)
                    case CommandEnded():
                        self._show_all(self._commands.finish(message))
                    case CheckEnded():
                        self._show_all(self._checks.finish(message))
                message = self._queue.get_nowait()
        by_robot: dict[str, set[str]] = {}
        for path in paths:
            for name in self._watched.robots_for(path):
                by_robot.setdefault(name, set()).add(path)
        affected = [watched for name, watched in self._robots.items() if name in by_robot]
        known = (path in one.files or path in one.paths.outputs for one in affected for path in by_robot[one.name])
        if not all(known):
            self._watch_folders()  # a folder or a link may have been replaced
        self._touch([one for one in affected if one.is_told or one.has_changed(by_robot[one.name])])

    def _show_all(self, found: Iterable[events.Event]) -> None:
        for event in found:
            self._listener(event)

    def _seconds_until_due(self) -> float:
        now = time.monotonic()
        due = [self._next_rescan, *(watched.state.due for watched in self._robots.values())]
        due += [self._next_poll] if self._is_polling else []
        due += [now + _PAUSE] if self._is_paused else []
        return max(min(due) - now, 0.0)

    def _touch(self, robots: Sequence[WatchedRobot]) -> None:
        """Let robots settle, since something changed; all from the same moment, so that they are built together."""
        due = time.monotonic() + self._options.settle
        for watched in robots:
            if not watched.is_told:
                file, watched.changed_file = watched.changed_file, ""
                self._listener(events.Settling(watched.name, shown(Path(file)) if file else ""))
            watched.state = Unsettled(due)

    # Looks without an event

    @property
    def _is_polling(self) -> bool:
        """Whether there are no events, or not of all folders."""
        return self._options.poll or bool(self._unwatched)

    def _watch_folders(self) -> None:
        if self._options.poll:
            return
        self._watched = find_watched_paths(self._config, {name: one.paths for name, one in self._robots.items()})
        found = self._observer.watch_folders(self._watched)
        known = {diagnostic.hint for diagnostic in self._unwatched}
        self._note(tuple(diagnostic for diagnostic in found if diagnostic.hint not in known))
        if self._unwatched and not found:
            self._listener(events.Recovered("all folders are watched again"))
        self._unwatched = found

    def _rescan(self) -> None:
        """Look at everything: events may be lost, and a build that failed may work now."""
        now = time.monotonic()
        self._next_rescan, self._next_poll = now + self._options.rescan, now + _POLL
        self._watch_folders()
        resting = [watched for watched in self._robots.values() if watched.is_resting]
        self._touch([watched for watched in resting if watched.has_changed()])
        for watched in resting:
            if watched.failure is not None and watched.is_resting:
                watched.state = Unsettled(now, is_told=False)

    def _poll(self) -> None:
        """Look at the inputs of all robots."""
        self._next_poll = time.monotonic() + _POLL
        resting = [watched for watched in self._robots.values() if watched.is_resting]
        self._touch([one for one in resting if one.has_changed(one.files.keys() - one.paths.outputs)])

    def _update_pause(self) -> bool:
        """Return whether nothing must be built now, since pre-commit has stashed changes away."""
        stash = precommit.find_stash(self._config.root)
        if stash and not self._is_paused:
            reason = f"pre-commit (process {stash[1]}) has stashed unstaged changes away"
            self._listener(events.Paused(reason))
        elif self._is_paused and not stash:
            self._listener(events.Resumed())
        self._is_paused = stash is not None
        return self._is_paused

    # Builds

    def _build_settled(self) -> None:
        """Look at the robots that are due, and build those whose files have settled."""
        now = time.monotonic()
        if self._is_paused:
            self._update_pause()
        due = [watched for watched in self._robots.values() if watched.state.due <= now]
        settled = [watched for watched in due if self._has_settled(watched, now)]
        if settled and self._reload_config():
            return
        ready = [watched for watched in settled if self._is_ready(watched, now)]
        if ready and self._update_pause():
            for watched in ready:
                watched.state = Unsettled(now + _PAUSE, is_told=watched.is_told)
        elif ready:
            self._build(ready)

    def _has_settled(self, watched: WatchedRobot, now: float) -> bool:
        """Look at a robot's files; return whether they are as at the last look, or time is up for an invalid source."""
        options, before = self._options, watched.hashes
        sample = watched.read_files()
        match watched.state:
            case Invalid(_, since) as state:
                end = since + options.give_up_after
                if sample == before and now < end:
                    watched.state = Invalid(min(now + _POLL, end), since)
                    return False
                if sample == before:
                    return True
                watched.state = Unsettled(now + options.sample, sample)
                return not options.sample
            case Unsettled(is_told=False) if _is_new(watched, before, sample):
                self._touch([watched])  # its event may come later
                return False
            case Unsettled() as state:
                watched.state = msgspec.structs.replace(state, due=now + options.sample, sample=sample)
                return sample == state.sample or not options.sample
        return False

    def _is_ready(self, watched: WatchedRobot, now: float) -> bool:
        """Return whether a robot is to be built, of which the files have settled."""
        # not after a failure, which may have had another cause
        if watched.failure is None and watched.hashes == watched.built:
            if watched.is_told:
                self._listener(events.Unchanged(watched.name))
            self._rest(watched)
            return False
        error, lost = build.judge_source(self._config, watched.robot, watched.paths, self._build_options)
        if error is not None:
            self._watch_culprits(watched, error)
            self._wait_for_valid(watched, error.diagnostics, now)
            return False
        source = watched.files[str(watched.robot.source)].sha256
        if lost and isinstance(watched.state, Unsettled) and watched.state.shrunk != source:
            reason = f"{lost} of {len(watched.paths.built_names)} elements are gone: {_waiting_for(watched)}"
            self._listener(events.Waiting(watched.name, reason))
            watched.state = Unsettled(now + self._options.recheck_shrunk, watched.hashes, shrunk=source)
            return False
        return True

    def _watch_culprits(self, watched: WatchedRobot, error: SourceError) -> None:
        """Watch what xacro has read, or looked for, that no build has recorded yet."""
        paths = watched.paths
        found = paths.inputs.union(error.reads), paths.patterns.union(error.patterns)
        if found != (paths.inputs, paths.patterns):
            watched.paths = msgspec.structs.replace(paths, inputs=found[0], patterns=found[1])
            watched.read_files()
            self._watch_folders()

    def _wait_for_valid(self, watched: WatchedRobot, errors: tuple[Diagnostic, ...], now: float) -> None:
        """Wait for the exporter, which may be at work on a source that is invalid; after some time that is an error."""
        if isinstance(watched.state, Invalid) or errors == watched.failure:
            self._take_failure(watched, build.failed_result(self._config, watched.robot, errors))
            self._rest(watched)
        else:
            self._listener(events.Waiting(watched.name, _waiting_for(watched), errors))
            watched.state = Invalid(now + min(_POLL, self._options.give_up_after), now)

    def _build(self, robots: Sequence[WatchedRobot]) -> None:
        """Build robots. One that has written, or of which a file is other than before, has to settle again."""
        self._building = [watched.name for watched in robots if watched.is_told]
        self._show_all(list(map(events.Building, self._building)))
        before, writers = {watched.name: watched.hashes for watched in robots}, set()
        for result in build.build_robots(self._config, [watched.robot for watched in robots], self._build_options):
            watched = self._robots[result.robot]
            watched.built = None  # what is saved meanwhile is built, even if it is as before the last change
            if result.writes:
                writers.add(result.robot)
            if not result.failed:
                self._take_result(watched, result)
            elif watched.read_files() == before[watched.name]:
                self._take_failure(watched, result)
        self._renew_paths(robots)
        for watched in robots:
            old, now = before[watched.name], watched.read_files()
            if now == old and watched.name not in writers:  # git may have taken back what was written
                self._rest(watched)
            elif _is_new(watched, old, now):
                watched.state = Resting()
                self._touch([watched])  # somebody saved meanwhile: the user is told
            else:  # most likely its own writes: confirmed without a word
                watched.state = Unsettled(time.monotonic() + self._options.settle, is_told=False)

    def _renew_paths(self, robots: Sequence[WatchedRobot]) -> None:
        """Find the paths of some robots again, after a build."""
        before = [watched.paths for watched in robots]
        for watched in robots:
            watched.paths = find_robot_paths(self._config, watched.robot, self._options.build.package_paths)
        if before != [watched.paths for watched in robots]:
            self._watch_folders()

    def _rest(self, watched: WatchedRobot) -> None:
        """Leave a robot alone until something changes; check its package, unless it could not be built."""
        watched.built, watched.state = watched.hashes, Resting()
        if watched.failure is None:
            self._show_all(self._checks.check(watched.robot))

    def _take_failure(self, watched: WatchedRobot, result: Result) -> None:
        again = watched.failure == result.diagnostics
        if watched.is_told or not again:
            self._listener(events.Failed(result, again))
        watched.failure = result.diagnostics

    def _take_result(self, watched: WatchedRobot, result: Result) -> None:
        recovered, decided = watched.failure is not None, result.actions.decided
        files = tuple(Path(os.path.normpath(result.root / action.path)) for action in decided if action.writes)
        left_alone = frozenset((action.path, str(action.reason)) for action in decided if not action.writes)
        if result.is_broken:
            left_alone |= {(one.file, one.message) for one in result.diagnostics}
        if watched.is_told or files or recovered or left_alone != watched.left_alone:
            self._listener(events.Built(result, files, recovered))
        watched.failure, watched.left_alone = None, left_alone
        watched.pending = tuple(dict.fromkeys((*watched.pending, *files)))
        if watched.pending and not result.is_broken:
            self._show_all(self._commands.run(watched.robot, watched.pending))
            watched.pending = ()


def _waiting_for(watched: WatchedRobot) -> str:
    return f"waiting for the exporter of {shown(watched.robot.source)}"


def _is_new(watched: WatchedRobot, before: Hashes, now: Hashes) -> bool:
    """Whether an input is other than before: somebody saved it, since the daemon writes none."""
    changed = [path for path in watched.paths.inputs if path in before and before[path] != now[path]]
    watched.changed_file = min(changed, default="")
    return bool(changed)
