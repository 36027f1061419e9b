"""The daemon: one thread that waits for events, lets files settle, and builds.

An event only says where to look. What is built is decided by the files on disk, so an event too many or too few costs
time and nothing else.

A build is followed by a dry one, which finds nothing to do unless somebody else was writing. So the daemon need not
know what it wrote itself: any file that differs from what the dry build saw was changed by others.
"""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Sequence
from pathlib import Path
from queue import Empty, SimpleQueue

import msgspec

from urdfsync import config
from urdfsync.config import Config, warnings
from urdfsync.diagnostics import ConfigError, Diagnostic, OutputError
from urdfsync.engine.cache import Cache
from urdfsync.engine.options import BuildOptions
from urdfsync.outcome import Result
from urdfsync.watch import build, events, precommit
from urdfsync.watch.checks import CheckEnded, CheckQueue
from urdfsync.watch.debounce import Debouncer, Phase, Times
from urdfsync.watch.exec import CommandEnded, CommandRunner
from urdfsync.watch.observer import Observer
from urdfsync.watch.paths import CONFIG, WatchedPaths, find_robot_paths, find_watched_paths
from urdfsync.watch.robots import WatchedRobot, find_changes, read_state
from urdfsync.watch.single_instance import SingleInstance

_PAUSE = 0.25
"""Seconds between two looks whether pre-commit has ended."""
_POLL = 1.0
"""Seconds between two reads of all inputs, where there are no events."""


class WatchOptions(msgspec.Struct, frozen=True):
    """What the command line asks for; times in seconds."""

    file: Path
    """The configuration."""
    robots: tuple[str, ...] = ()
    """Names of the robots; empty for all."""
    times: Times = msgspec.field(default_factory=Times)
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
        self._file = str(options.file.absolute())
        self._cache = Cache()
        self._build_options = msgspec.structs.replace(options.build, progress=self._progress, cache=self._cache)
        self._queue: SimpleQueue[object] = SimpleQueue()
        """Paths that may have changed, `CommandEnded`, `CheckEnded`, and None to wake the daemon."""
        self._observer = Observer(self._queue)
        self._robots: dict[str, WatchedRobot] = {}
        self._checks = CheckQueue(self._queue, options.build)
        self._commands = CommandRunner(self._queue, options.command, options.file.absolute().parent)
        self._config: Config
        self._config_hash = read_state(self._file).sha256
        self._config_debouncer = Debouncer(options.times)
        self._config_errors: tuple[Diagnostic, ...] = ()
        self._watched = WatchedPaths()
        self._unwatched: tuple[Diagnostic, ...] = ()
        self._stop_signal = ""
        self._is_paused = self._is_warm = False
        self._next_poll = self._next_rescan = 0.0

    def stop(self, signal: str) -> None:
        """End when the build in hand is finished, or given up if it has not begun to write. For signal handlers."""
        self._stop_signal = signal
        self._queue.put(None)

    def run(self) -> None:
        """Watch until `stop` is called. Raises ConfigError for a configuration that can't be used at the start.

        Raises AlreadyWatchedError if another daemon watches it, OutputError if the lock can't be written.
        """
        loaded = config.load(self._options.file)
        try:
            with SingleInstance(loaded) as instance, contextlib.closing(self._observer), self._checks:
                self._use(loaded)
                self._next_rescan = time.monotonic() + self._options.rescan
                while not self._stop_signal:
                    self._receive()
                    if time.monotonic() >= self._next_rescan:
                        with contextlib.suppress(OutputError):  # where this daemon can't write the lock, no other can
                            instance.renew()
                        self._rescan()
                    elif self._is_polling and time.monotonic() >= self._next_poll:
                        self._poll()
                    self._settle_config()
                    self._build_settled()
        except KeyboardInterrupt:
            if not self._stop_signal:
                raise
        self._show(events.Stopping(self._stop_signal))

    def _show(self, *found: events.Event) -> None:
        for event in found:
            self._listener.show(event)

    def _note(self, diagnostics: tuple[Diagnostic, ...]) -> None:
        if diagnostics:
            self._show(events.Noted(diagnostics))

    def _progress(self, what: str, done: int, total: int) -> None:
        """Show a step of the build under way, which is a place at which it can be given up."""
        if self._stop_signal:
            raise KeyboardInterrupt
        self._listener.progress(what, done, total)

    # The configuration

    def _use(self, loaded: Config, again: bool = False) -> None:
        """Put a configuration in force, and build all. Raises ConfigError for robots that it lacks."""
        robots = loaded.select(self._options.robots)
        self._config, self._config_errors = loaded, ()
        self._checks.use(loaded)
        before, self._robots = self._robots, {}
        for robot in robots:  # of those that were watched before, the last results are still known
            paths = find_robot_paths(loaded, robot, self._options.build.package_paths, self._cache)
            watched = before.get(robot.name) or WatchedRobot(robot, paths, Debouncer(self._options.times))
            watched.robot, watched.paths, watched.built, watched.is_announced = robot, paths, None, True
            self._robots[robot.name] = watched
        self._cache.forget_others(self._robots)
        self._show(events.Started(loaded.file, tuple(robot.name for robot in robots), again))
        self._note(tuple(warnings.find_warnings(loaded, robots)))
        self._watch_folders()
        self._touch(*self._robots.values())

    def _look_at_config(self) -> None:
        if self._config_debouncer.is_idle and read_state(self._file).sha256 != self._config_hash:
            self._config_debouncer.touch(time.monotonic())

    def _settle_config(self) -> None:
        """Read the configuration again once it has settled; while it is invalid, the last valid one stays in force."""
        debouncer, now = self._config_debouncer, time.monotonic()
        if not debouncer.is_due(now):
            return
        found = read_state(self._file).sha256
        if debouncer.add_sample(found, now) is not Phase.SETTLED:
            return
        debouncer.rest()
        if found == self._config_hash:
            return
        self._config_hash = found
        try:
            self._use(config.load(self._options.file), again=True)
        except ConfigError as error:
            if error.diagnostics != self._config_errors:
                self._config_errors = error.diagnostics
                self._note(error.diagnostics)

    # Events

    def _receive(self) -> None:
        """Wait until something happens or is due, and take note of all that has happened."""
        paths: set[str] = set()
        with contextlib.suppress(Empty):
            message = self._queue.get(timeout=self._seconds_until_due())
            while True:
                match message:
                    case str():
                        paths.add(message)
                    case CommandEnded():
                        self._show(events.Ran(message.robot, message.code))
                        self._note(self._commands.finish(message))
                    case CheckEnded():
                        self._show(*self._checks.finish(message))
                message = self._queue.get_nowait()
        if paths:
            self._receive_paths(paths)

    def _seconds_until_due(self) -> float:
        now = time.monotonic()
        deadlines = [
            self._config_debouncer.deadline,
            *(watched.debouncer.deadline for watched in self._robots.values()),
        ]
        due = [deadline for deadline in deadlines if deadline is not None]
        if self._is_paused:
            due = [max(deadline, now + _PAUSE) for deadline in due]
        elif not due and not self._is_warm:
            return 0.0
        reads = [self._next_rescan, self._next_poll] if self._is_polling else [self._next_rescan]
        return max(min([*due, *reads]) - now, 0.0)

    def _receive_paths(self, paths: set[str]) -> None:
        """Let settle what has changed at some of these paths."""
        by_robot: dict[str, set[str]] = {}
        for path in paths:
            for name in self._watched.robots_for(path):
                by_robot.setdefault(name, set()).add(path)
        if CONFIG in by_robot:
            self._look_at_config()
        affected = [self._robots[name] for name in by_robot if name in self._robots]
        if not all(watched.has_only_files(by_robot[watched.name]) for watched in affected):
            self._watch_folders()  # a folder or a link may have been replaced
        changed = [
            watched
            for watched in affected
            if not watched.debouncer.is_idle or watched.has_changed_at(by_robot[watched.name])
        ]
        self._touch(*changed)

    def _touch(self, *robots: WatchedRobot) -> None:
        """Let robots settle, since something changed; all from the same moment, so that they are built together."""
        now = time.monotonic()
        for watched in robots:
            if not watched.is_announced:
                self._show(events.Settling(watched.name))
                watched.is_announced = True
            watched.debouncer.touch(now)

    # Looks without an event

    @property
    def _is_polling(self) -> bool:
        """Whether there are no events, or not of all folders."""
        return self._options.poll or bool(self._unwatched)

    def _watch_folders(self) -> None:
        if self._options.poll:
            return
        robots = {name: watched.paths for name, watched in self._robots.items()}
        self._watched = find_watched_paths(str(self._config.root), self._file, robots)
        found = self._observer.watch_folders(self._watched)
        known = {diagnostic.hint for diagnostic in self._unwatched}
        self._note(tuple(diagnostic for diagnostic in found if diagnostic.hint not in known))
        if self._unwatched and not found:
            self._show(events.Recovered("all folders are watched again"))
        self._unwatched = found

    def _rescan(self) -> None:
        """Look at everything: events may be lost, and a build that failed may work now."""
        now = time.monotonic()
        self._next_rescan, self._next_poll = now + self._options.rescan, now + _POLL
        self._watch_folders()
        self._look_at_config()
        for watched in self._robots.values():
            if not watched.debouncer.is_idle:
                continue
            watched.read_files()
            if not watched.is_as_built():
                self._touch(watched)
            elif watched.failure is not None:
                watched.debouncer.touch(now)

    def _poll(self) -> None:
        """Look at the inputs of all robots."""
        self._next_poll = time.monotonic() + _POLL
        self._look_at_config()
        idle = [watched for watched in self._robots.values() if watched.debouncer.is_idle]
        self._touch(*(watched for watched in idle if watched.has_changed_at({*watched.paths.input_files()})))

    def _update_pause(self) -> bool:
        """Return whether nothing must be built now. What was paused has to settle again."""
        stash = precommit.find_stash(self._config.root)
        if stash and not self._is_paused:
            self._show(events.Paused(f"pre-commit (process {stash[1]}) has stashed unstaged changes away"))
        has_resumed = stash is None and self._is_paused
        if has_resumed:
            self._show(events.Resumed())
            self._touch(*(watched for watched in self._robots.values() if not watched.debouncer.is_idle))
        self._is_paused = stash is not None
        return self._is_paused or has_resumed

    # Builds

    def _build_settled(self) -> None:
        """Build the robots whose files have settled; while there is nothing to do, get ready for the first change."""
        now = time.monotonic()
        due = [watched for watched in self._robots.values() if watched.debouncer.is_due(now)]
        if due and self._update_pause():
            return
        ready = [watched for watched in due if self._settle(watched, now)]
        if ready and self._update_pause():  # reading may have taken a while
            self._touch(*ready)
        elif ready:
            self._build(ready)
        elif not self._is_warm and all(watched.debouncer.is_idle for watched in self._robots.values()):
            self._is_warm = True
            build.warm_up(self._config, [watched.robot for watched in self._robots.values()])

    def _settle(self, watched: WatchedRobot, now: float) -> bool:
        """Take the sample of a robot that is due. Returns whether the robot is to be built now."""
        debouncer, files = watched.debouncer, watched.read_files()
        phase = debouncer.add_sample({path: state.sha256 for path, state in files.items()}, now)
        if phase is Phase.IDLE:
            self._give_up(watched)
        if phase is not Phase.SETTLED:
            return False
        if watched.failure is None and watched.is_as_built():
            watched.source_errors = ()
            debouncer.note_valid()
            if watched.is_announced:
                self._show(events.Unchanged(watched.name))
            watched.rest()
            return False
        is_built_source = files[watched.paths.source].text_sha256 == watched.paths.built_hash
        return is_built_source or self._is_source_ready(watched)

    def _is_source_ready(self, watched: WatchedRobot) -> bool:
        """Return whether a settled source is valid and can be believed; if not, wait for it."""
        found = build.read_source(self._config, watched.robot, watched.paths, self._cache)
        if found.sha256 and found.sha256 != watched.files[watched.paths.source].sha256:
            self._touch(watched)  # written between the sample and this
            return False
        if found.errors:
            is_new, watched.source_errors = found.errors != watched.source_errors, found.errors
            if watched.debouncer.wait_for_valid(time.monotonic()) is Phase.IDLE:
                self._give_up(watched)
            elif is_new or watched.is_announced:
                self._show(events.Waiting(watched.name, "waiting for the exporter", found.errors))
            return False
        watched.debouncer.note_valid()
        if found.lost and not watched.debouncer.is_rechecked:
            of_all = f"{found.lost} of {len(watched.paths.built_names)} elements are gone"
            self._show(events.Waiting(watched.name, f"{of_all}, so it is watched a little longer"))
            watched.debouncer.recheck_shrunk(time.monotonic())
            return False
        return True

    def _build(self, robots: Sequence[WatchedRobot]) -> None:
        """Build robots. One for which another build would write something has to settle: somebody else was writing."""
        self._show(*(events.Building(watched.name) for watched in robots if watched.is_announced))
        by_name, settled = {w.name: w for w in robots}, {w.name: w.files for w in robots}
        for result in build.build_robots(self._config, [watched.robot for watched in robots], self._build_options):
            watched = by_name[result.robot]
            watched.read_files()
            if not result.failed:
                self._take_result(watched, result)
            elif not watched.changed_inputs(settled[watched.name]):
                self._take_failure(watched, result)
        self._renew_paths(robots)
        before = {watched.name: watched.read_files() for watched in robots}
        # what workers see does not get into the cache
        dry = msgspec.structs.replace(self._build_options, dry=True, compares_state=True, jobs=1)
        built = [watched.robot for watched in robots if watched.failure is None]
        results = {result.robot: result for result in build.build_robots(self._config, built, dry)}
        for watched in robots:
            # a file that changed in between may have been looked at before or after that
            is_same = not find_changes(before[watched.name], watched.read_files())
            is_done = watched.failure is not None or (is_same and self._is_confirmed(watched, results[watched.name]))
            if is_done and not watched.changed_inputs(settled[watched.name]):
                self._rest(watched)
            else:
                self._touch(watched)

    def _is_confirmed(self, watched: WatchedRobot, dry: Result) -> bool:
        """Return whether another build would find all as the last one left it."""
        has_work = dry.failed or dry.renews_state or any(action.writes for action in dry.actions.decided)
        return not has_work and build.left_alone(dry) == watched.left_alone

    def _renew_paths(self, robots: Sequence[WatchedRobot]) -> None:
        """Find the paths of some robots again, after a build."""
        before = [watched.paths for watched in robots]
        for watched in robots:
            paths = self._options.build.package_paths
            watched.paths = find_robot_paths(self._config, watched.robot, paths, self._cache)
        if before != [watched.paths for watched in robots]:
            self._watch_folders()

    def _rest(self, watched: WatchedRobot) -> None:
        watched.rest()
        if watched.failure is None:
            self._show(*self._checks.check(watched.robot))

    def _give_up(self, watched: WatchedRobot) -> None:
        """Tell that a source is invalid, and leave the robot alone until something changes."""
        self._take_failure(watched, build.failed_result(self._config, watched.robot, watched.source_errors))
        self._rest(watched)

    def _take_failure(self, watched: WatchedRobot, result: Result) -> None:
        again = watched.failure == result.diagnostics
        if watched.is_announced or not again:
            self._show(events.Failed(result, again))
        watched.failure, watched.is_announced = result.diagnostics, False

    def _take_result(self, watched: WatchedRobot, result: Result) -> None:
        recovered, decided = watched.failure is not None, result.actions.decided
        files = tuple(Path(os.path.normpath(result.root / action.path)) for action in decided if action.writes)
        left_alone = build.left_alone(result)
        if watched.is_announced or files or recovered or left_alone != watched.left_alone:
            self._show(events.Built(result, files, recovered))
        watched.failure, watched.is_announced, watched.left_alone = None, False, left_alone
        watched.source_errors = ()
        if files:
            self._note(self._commands.run(watched.robot, files))
