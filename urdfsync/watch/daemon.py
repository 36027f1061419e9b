"""The daemon: one thread that waits for events, lets files settle, and builds.

An event only says where to look. What is built is decided by the files on disk, so an event too many or too few costs
time and nothing else.

A build that wrote something is followed by another one, which finds nothing to do unless somebody else was writing.
So the daemon need not know what it wrote itself: after the last build, any file that differs from what this build saw
was changed by others.
"""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Iterable, Sequence
from pathlib import Path

import msgspec

from urdfsync import config
from urdfsync.config import Config, shown, warnings
from urdfsync.diagnostics import ConfigError, Diagnostic, OutputError
from urdfsync.engine.actions import Kind
from urdfsync.engine.cache import Cache
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package_files import FileState
from urdfsync.outcome import Result
from urdfsync.watch import build, events, precommit
from urdfsync.watch.checks import CheckQueue
from urdfsync.watch.debounce import Debouncer, Phase, Times
from urdfsync.watch.event_queue import CheckEnded, CommandEnded, EventQueue, EventsLost, Message, Stop
from urdfsync.watch.exec import CommandRunner
from urdfsync.watch.input_files import InputFiles, has_changes, same_content
from urdfsync.watch.observer import Observer
from urdfsync.watch.paths import CONFIG, find_watched_paths
from urdfsync.watch.precommit import PrecommitStash
from urdfsync.watch.robots import WatchedRobot, WatchedRobots
from urdfsync.watch.single_instance import SingleInstance

_PAUSE = 0.25
"""Seconds between two looks whether pre-commit has ended."""
_POLL = 1.0
"""Seconds between two reads of all inputs, where there are no events."""
_HOUR = 3600.0
"""Seconds between two reads that trust no stat values."""
_MAX_BUILDS = 3
"""Builds of one robot in a row; if the last one wrote something, somebody else writes, and the robot has to settle."""


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
        self._queue = EventQueue()
        self._observer = Observer(self._queue)
        self._inputs = InputFiles()
        self._robots = WatchedRobots(options.times, options.build.package_paths, self._inputs, self._cache)
        self._checks = CheckQueue(self._queue, options.build)
        self._commands = CommandRunner(self._queue, options.command, options.file.absolute().parent)
        home = Path(os.path.expanduser("~"))  # noqa: PTH111 - Path.home() raises where there is none
        self._stash = PrecommitStash(precommit.store_folder(os.environ, home))
        self._config: Config
        self._config_state = self._inputs.read(self._file)
        self._config_debouncer = Debouncer[FileState](options.times)
        self._config_errors: tuple[Diagnostic, ...] = ()
        self._unwatched: tuple[Diagnostic, ...] = ()
        self._stop_signal = ""
        self._is_paused = self._is_warm = False
        self._next_poll = self._next_rescan = self._next_rehash = 0.0

    def stop(self, signal: str) -> None:
        """End when the build in hand is finished, or given up if it has not begun to write. For signal handlers."""
        self._stop_signal = signal
        self._queue.put(Stop())

    def run(self) -> None:
        """Watch until `stop` is called. Raises ConfigError for a configuration that can't be used at the start.

        Raises AlreadyWatchedError if another daemon watches it, OutputError if the lock can't be written.
        """
        loaded = config.load(self._options.file)
        try:
            with SingleInstance(loaded) as instance, self._observer.open(), self._checks:
                self._use(loaded)
                now = time.monotonic()
                self._next_rescan, self._next_rehash = now + self._options.rescan, now + _HOUR
                while not self._stop_signal:
                    self._receive(self._queue.wait(self._seconds_until_due()))
                    self._work(instance)
        except KeyboardInterrupt:
            if not self._stop_signal:
                raise
        self._listener.show(events.Stopping(self._stop_signal))

    def _use(self, loaded: Config, again: bool = False) -> None:
        """Put a configuration in force, and build all. Raises ConfigError for robots that it lacks."""
        robots = loaded.select(self._options.robots)
        self._config, self._config_errors = loaded, ()
        self._checks.use(loaded)
        self._robots.use(loaded, robots)
        self._show(events.Started(loaded.file, tuple(robot.name for robot in robots), again))
        self._note(tuple(warnings.find_warnings(loaded, robots)))
        self._watch_folders()
        for watched in self._robots:
            watched.is_announced = True
        self._touch(*self._robots)

    def _show(self, *found: events.Event) -> None:
        for event in found:
            self._listener.show(event)

    def _note(self, diagnostics: tuple[Diagnostic, ...]) -> None:
        if diagnostics:
            self._show(events.Noted(diagnostics))

    # Messages

    def _receive(self, messages: Iterable[Message]) -> None:
        paths: set[str] = set()
        for message in messages:
            match message:
                case str():
                    paths.add(message)
                case EventsLost():
                    self._next_rescan = 0.0
                case CommandEnded(robot, code):
                    self._show(events.Ran(robot, code))
                    self._note(self._commands.finish(robot, code))
                case CheckEnded():
                    self._show(*self._checks.finish(message))
        if paths:
            self._receive_paths(paths)

    def _receive_paths(self, paths: set[str]) -> None:
        """Let settle what has changed at some of these paths."""
        by_robot: dict[str, set[str]] = {}
        for path in paths:
            for name in self._queue.watched.robots_for(path):
                by_robot.setdefault(name, set()).add(path)
        if CONFIG in by_robot and self._config_has_changed():
            self._config_debouncer.touch(time.monotonic())
        affected = self._robots.named(by_robot)
        if not all(watched.has_only_files(by_robot[watched.name]) for watched in affected):
            self._watch_folders()  # a folder or a link may have been replaced
        changed = [
            watched
            for watched in affected
            if not watched.debouncer.is_idle or self._robots.has_changed_at(watched, by_robot[watched.name])
        ]
        for watched in changed:
            watched.touch_outputs(by_robot[watched.name])
        self._touch(*changed)

    def _touch(self, *robots: WatchedRobot) -> None:
        """Let robots settle, since something changed; all from the same moment, so that they are built together."""
        now = time.monotonic()
        for watched in robots:
            if not watched.is_announced:
                self._show(events.Settling(watched.name))
                watched.is_announced = True
            watched.debouncer.touch(now)

    def _watch_folders(self) -> None:
        if self._options.poll:
            return
        paths = find_watched_paths(str(self._config.root), self._file, self._robots.paths)
        self._queue.watched = paths
        found = self._observer.watch_folders(paths)
        known = {diagnostic.hint for diagnostic in self._unwatched}
        if new := tuple(diagnostic for diagnostic in found if diagnostic.hint not in known):
            self._show(events.Noted(new))
        elif self._unwatched and not found:
            self._show(events.Recovered("all folders are watched again"))
        self._unwatched = found

    # Work that is due

    def _seconds_until_due(self) -> float:
        now = time.monotonic()
        deadlines = [self._config_debouncer.deadline, *(watched.debouncer.deadline for watched in self._robots)]
        due = [deadline for deadline in deadlines if deadline is not None]
        if self._is_paused:
            due = [max(deadline, now + _PAUSE) for deadline in due]
        elif not due and not self._is_warm:
            return 0.0
        reads = [self._next_rescan, self._next_poll] if self._is_polling else [self._next_rescan]
        return max(min([*due, *reads]) - now, 0.0)

    @property
    def _is_polling(self) -> bool:
        """Whether there are no events, or not of all folders."""
        return self._options.poll or bool(self._unwatched)

    def _work(self, instance: SingleInstance) -> None:
        now = time.monotonic()
        if now >= self._next_rescan:
            self._rescan(now, instance)
        elif self._is_polling and now >= self._next_poll:
            self._poll(now)
        self._settle_config(now)
        due = [w for w in self._robots if w.debouncer.deadline is not None and w.debouncer.deadline <= now]
        if due and self._update_pause():
            return
        ready = [watched for watched in due if self._settle(watched, now)]
        if ready and self._update_pause():  # reading may have taken a while
            self._touch(*ready)
        elif ready:
            self._build(ready)
        elif not self._is_warm and all(watched.debouncer.is_idle for watched in self._robots):
            self._is_warm = True
            build.warm_up(self._config, [watched.robot for watched in self._robots])

    def _config_has_changed(self) -> bool:
        return self._inputs.read(self._file).sha256 != self._config_state.sha256

    def _settle_config(self, now: float) -> None:
        """Read the configuration again once it has settled; while it is invalid, the last valid one stays in force."""
        debouncer = self._config_debouncer
        if debouncer.deadline is None or debouncer.deadline > now:
            return
        state = self._inputs.read(self._file)
        if debouncer.add_sample(state, now) is not Phase.SETTLED:
            return
        debouncer.rest()
        if state.sha256 == self._config_state.sha256:
            return
        self._config_state = state
        try:
            self._use(config.load(self._options.file), again=True)
        except ConfigError as error:
            if error.diagnostics != self._config_errors:
                self._config_errors = error.diagnostics
                self._note(error.diagnostics)

    def _settle(self, watched: WatchedRobot, now: float) -> bool:
        """Take the sample of a robot that is due. Returns whether the robot is to be built now."""
        debouncer, inputs = watched.debouncer, self._robots.inputs(watched)
        sample = inputs, self._robots.outputs(watched, watched.touched_outputs)
        phase = debouncer.add_sample(sample, now)
        if phase is Phase.IDLE:
            self._give_up(watched)
        if phase is not Phase.SETTLED:
            return False
        watched.settled = inputs
        if watched.failure is None and self._robots.is_as_built(watched, inputs):
            watched.source_errors = ()
            debouncer.note_valid()
            if watched.is_announced:
                self._show(events.Unchanged(watched.name))
            watched.rest()
            return False
        is_built_source = inputs[watched.paths.source].text_sha256 == watched.paths.built_hash
        return is_built_source or self._is_source_ready(watched)

    def _is_source_ready(self, watched: WatchedRobot) -> bool:
        """Return whether a settled source is a model that can be believed; if not, wait for it."""
        try:
            found = build.read_source(self._config, watched.robot, watched.paths, self._cache)
        except Exception as error:  # noqa: BLE001 - a bug in a domain must not end the daemon; nothing is written yet
            message = f"{shown(watched.robot.source)} can't be read"
            watched.source_errors = (build.internal_error(error, message),)
            self._give_up(watched)
            return False
        if found.sha256 and found.sha256 != watched.settled[watched.paths.source].sha256:
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

    # Builds

    def _build(self, robots: Sequence[WatchedRobot]) -> None:
        """Build robots until a build of each finds nothing to write."""
        for watched in robots:
            if watched.is_announced:
                self._show(events.Building(watched.name))
        options = self._build_options
        for _ in range(_MAX_BUILDS):
            self._build_once({watched.name: watched for watched in robots}, options)
            options = msgspec.structs.replace(options, jobs=1)  # what workers see does not get into the cache
            robots = [watched for watched in robots if not self._is_finished(watched)]
            if not robots:
                return
            if self._update_pause():
                break
        self._touch(*robots)

    def _build_once(self, robots: dict[str, WatchedRobot], options: BuildOptions) -> None:
        for result in build.build_robots(self._config, [watched.robot for watched in robots.values()], options):
            watched = robots[result.robot]
            if not result.failed:
                self._take_result(watched, result)
            elif same_content(watched.settled, self._robots.inputs(watched)):
                self._take_failure(watched, result)
        have_changed = [self._robots.renew_paths(watched) for watched in robots.values()]
        if any(have_changed):
            self._watch_folders()

    def _is_finished(self, watched: WatchedRobot) -> bool:
        """Return whether nothing is left to do for a robot at once.

        Inputs that changed since they were sampled, before the build, have to settle. A build that wrote something is
        never the last. What changes later has an event, or is found by a rescan.
        """
        before, watched.settled = watched.settled, self._robots.inputs(watched)
        if has_changes(before, watched.settled):
            self._touch(watched)
            return True
        is_confirmed = self._robots.has_built_all(watched) and same_content(before, watched.settled)
        if watched.failure is None and not is_confirmed:
            return False
        self._rest(watched)
        return True

    def _rest(self, watched: WatchedRobot) -> None:
        watched.rest()
        if watched.failure is None:
            self._show(*self._checks.check(watched.robot))
        else:
            self._robots.note_outputs(watched)

    def _give_up(self, watched: WatchedRobot) -> None:
        """Tell that a source is no model, and leave the robot alone until something changes."""
        self._take_failure(watched, build.failed_result(self._config, watched.robot, watched.source_errors))
        self._rest(watched)

    def _take_failure(self, watched: WatchedRobot, result: Result) -> None:
        again = watched.failure == result.diagnostics
        if watched.is_announced or not again:
            self._show(events.Failed(result, again))
        watched.failure, watched.is_announced = result.diagnostics, False

    def _take_result(self, watched: WatchedRobot, result: Result) -> None:
        files, recovered = build.written_files(result), watched.failure is not None
        decided = result.actions.decided
        differing = (action for action in decided if action.kind is not Kind.UNCHANGED and not action.writes)
        left_alone = frozenset((action.path, str(action.kind)) for action in differing)
        if watched.is_announced or files or recovered or left_alone != watched.left_alone:
            self._show(events.Built(result, files, recovered))
        watched.failure, watched.is_announced, watched.left_alone = None, False, left_alone
        watched.source_errors = ()
        if files:
            self._note(self._commands.run(watched.robot, files))

    def _progress(self, what: str, done: int, total: int) -> None:
        """Show a step of the build under way, which is a place at which it can be given up."""
        if self._stop_signal:
            raise KeyboardInterrupt
        self._listener.progress(what, done, total)

    # Now and then

    def _rescan(self, now: float, instance: SingleInstance) -> None:
        """Look at everything: events may be lost, and a build that failed may work now."""
        self._next_rescan, self._next_poll = now + self._options.rescan, now + _POLL
        with contextlib.suppress(OutputError):  # where this daemon can't write the lock, no other one can
            instance.renew()
        if now >= self._next_rehash:
            self._next_rehash = now + _HOUR
            self._inputs.rehash_all()
            self._cache.rehash_all()
        self._watch_folders()
        self._look_at_config()
        for watched in self._robots:
            if not watched.debouncer.is_idle:
                continue
            if not self._robots.is_as_built(watched, self._robots.inputs(watched)):
                self._touch(watched)
            elif watched.failure is not None:
                watched.debouncer.touch(now)
        self._inputs.forget_others([self._file, *(path for w in self._robots for path in w.paths.input_files())])

    def _poll(self, now: float) -> None:
        """Look at the inputs of all robots."""
        self._next_poll = now + _POLL
        self._look_at_config()
        idle = [watched for watched in self._robots if watched.debouncer.is_idle]
        self._touch(*(w for w in idle if not same_content(w.built or {}, self._robots.inputs(w))))

    def _look_at_config(self) -> None:
        if self._config_debouncer.is_idle and self._config_has_changed():
            self._config_debouncer.touch(time.monotonic())

    def _update_pause(self) -> bool:
        """Return whether nothing must be built now. What was paused has to settle again."""
        holder = self._stash.holder(self._config.root)
        if holder is not None and not self._is_paused:
            self._show(events.Paused(f"pre-commit (process {holder}) has stashed unstaged changes away"))
        has_resumed = holder is None and self._is_paused
        if has_resumed:
            self._show(events.Resumed())
            self._touch(*(watched for watched in self._robots if not watched.debouncer.is_idle))
        self._is_paused = holder is not None
        return self._is_paused or has_resumed
