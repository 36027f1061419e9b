"""The daemon: one thread that waits for events, lets files settle, and builds.

1. Wait for an event, or until it is time to look at the files. An event says only which files to look at. The files on
   disk decide about builds, so a wrong or lost event costs only time.
2. The robots with a changed file have to settle: no event for some time, and two equal looks.
3. All settled robots are built together. An exporter may still be writing an invalid source: it is an error only if it
   stays unchanged for some time.
4. If a build wrote a file, or a file was saved meanwhile, another build follows once the files have settled. A robot
   rests after a build that wrote nothing.
"""

from __future__ import annotations

import contextlib
import math
import os
import time
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from queue import Empty, SimpleQueue

import msgspec

from urdfsync.common.dependencies.facts import LISTINGS, Dependencies, Entry, changes, look
from urdfsync.common.dependencies.reads import Reads, read_file
from urdfsync.common.diagnostics import ConfigError, Diagnostic, OutputError, Severity
from urdfsync.common.files import shown
from urdfsync.engine.build import WAITING, build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Result
from urdfsync.project import config
from urdfsync.project.config import STATE_FOLDER, Config, warnings
from urdfsync.project.state.lock import Lock, LockedError
from urdfsync.watch import events
from urdfsync.watch.checks import CheckEnded, CheckQueue
from urdfsync.watch.exec import CommandEnded, CommandRunner
from urdfsync.watch.observer import FileEvent, Observer
from urdfsync.watch.paths import find_places, find_watched_folders
from urdfsync.watch.robot import WatchedRobot

_REST = 3.0
"""The pause after a look, as a multiple of its duration."""


class WatchOptions(msgspec.Struct, frozen=True):
    """The options of the command line; times in seconds."""

    file: Path
    """The configuration."""
    robots: tuple[str, ...] = ()
    """Names of the robots; empty for all."""
    settle: float = 0.5
    """The time without an event before a build, and between the two looks that have to be equal."""
    give_up_after: float = 30.0
    """The time until an invalid source is an error."""
    rescan: float = 30.0
    """The time between two reads of all files."""
    command: str = ""
    """The command after a build that changed something; empty for none."""
    build: BuildOptions = msgspec.field(default_factory=BuildOptions)


class Daemon:
    """Keeps the packages of one configuration in step until `stop` is called."""

    def __init__(self, options: WatchOptions, listener: events.Listener) -> None:
        self._options, self._listener = options, listener
        self._build_options = msgspec.structs.replace(options.build, progress=self._progress, renews=False)
        self._queue: SimpleQueue[object] = SimpleQueue()
        """`FileEvent`, `CommandEnded`, `CheckEnded`, and None to wake the daemon."""
        self._observer = Observer(self._queue)
        self._robots: dict[str, WatchedRobot] = {}
        self._checks = CheckQueue(self._queue, options.build)
        self._commands = CommandRunner(self._queue, options.command, options.file.absolute().parent)
        self._config: Config
        self._config_facts = self._read_config()
        self._unwatched: tuple[Diagnostic, ...] = ()
        self._stop_signal = ""
        self._building: Sequence[str] = ()
        """Robots in the present build; empty after the wait for another process was shown."""
        self._is_working = True
        self._next_rescan = 0.0
        self._next_look = math.inf
        """When to look at files, after an event."""
        self._entries_at: Mapping[str, set[Entry]] = {}
        """The entries to look at after an event, by the path of the event; for a list of names, by its folder."""
        self._touched: set[Entry] = set()
        """The entries to look at next."""
        self._earliest_look = 0.0
        """The earliest time of the next look: endless events must leave pauses."""
        self._has_new_places = False

    def stop(self, signal: str) -> None:
        """End after the present build, or before it begins to write.

        For signal handlers. The second call raises KeyboardInterrupt during work, but not during the clean-up of a
        check.
        """
        if self._stop_signal and self._is_working:
            raise KeyboardInterrupt
        self._stop_signal = self._stop_signal or signal
        self._queue.put(None)

    def run(self) -> None:
        """Watch until `stop` is called.

        Raises ConfigError for an invalid configuration at the start, LockedError if another daemon watches the
        configuration, OutputError without a writable lock.
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
            has_looked = time.monotonic() >= self._next_look
            if has_looked:
                self._look()
            if time.monotonic() >= self._next_rescan:
                with contextlib.suppress(OutputError):  # if this daemon can't write the lock, no other daemon can
                    self._acquire(lock)
                self._rescan()
            settled = self._find_settled(has_looked=has_looked)
            if settled and self._reload_config():
                continue  # the new configuration lets all robots settle again
            self._build([watched for watched in settled if self._has_to_be_built(watched)])

    def _acquire(self, lock: Lock) -> None:
        """Take the daemon's lock, again if its file was deleted, since another daemon would not see the lock."""
        try:
            lock.acquire()
        except LockedError:
            message = f"{lock.holder()} watches this configuration already"
            hint = "use that daemon, or stop it first"
            finding = Diagnostic(Severity.ERROR, "watched", message, shown(self._options.file.absolute()), hint=hint)
            raise LockedError(finding) from None

    def _note(self, diagnostics: tuple[Diagnostic, ...]) -> None:
        if diagnostics:
            self._listener(events.Noted(diagnostics))

    def _progress(self, what: str, _done: int, _total: int) -> None:
        """Give up the present build if the daemon stops; report a wait for another process."""
        if self._stop_signal:
            raise KeyboardInterrupt
        if what.startswith(WAITING):
            self._show_all([events.Waiting(name, what) for name in self._building])
            self._building = []

    # The configuration

    def _use(self, loaded: Config, again: bool = False) -> None:
        """Use a configuration from now on, and build all robots. Raises ConfigError for a missing robot."""
        robots = loaded.select(self._options.robots)
        self._config = loaded
        self._checks.use(loaded)
        before, self._robots = self._robots, {}
        due = time.monotonic() + self._options.settle
        for robot in robots:  # keep the last results of robots that were watched before
            watched = before.get(robot.name) or WatchedRobot(robot)
            watched.robot, watched.is_confirmed = robot, False
            watched.settle(due, is_told=True)
            self._robots[robot.name] = watched
        self._listener(events.Started(loaded.file, tuple(self._robots), again))
        self._note(tuple(warnings.find_warnings(loaded, robots)))
        self._watch_folders()

    def _read_config(self) -> Dependencies:
        """Return the facts about the configuration's file."""
        with Reads() as reads, contextlib.suppress(OSError):  # `load` reports the error
            read_file(self._options.file.absolute())
        return reads.entries

    def _reload_config(self) -> bool:
        """Read the configuration again if it has changed; while it is invalid, keep the last valid one."""
        if not any(changes(self._config_facts, {})):
            return False
        self._config_facts = self._read_config()
        try:
            self._use(config.load(self._options.file), again=True)
        except ConfigError as error:
            self._note(error.diagnostics)
            return False
        return True

    # Events and looks

    def _receive(self) -> None:
        """Wait for a message, or until a look is due."""
        with contextlib.suppress(Empty):  # the first `get` waits, further calls empty the queue
            message = self._queue.get(timeout=self._seconds_until_due())
            while True:
                match message:
                    case FileEvent():
                        self._has_new_places |= message.is_place
                        for path in message.paths:
                            beside = self._entries_at.get(os.path.dirname(path), ())  # noqa: PTH120
                            self._touched |= self._entries_at.get(path, set())
                            self._touched |= {entry for entry in beside if entry[0].startswith(LISTINGS)}
                        if self._touched or self._has_new_places:
                            self._next_look = self._earliest_look
                    case CommandEnded():
                        self._show_all(self._commands.finish(message))
                    case CheckEnded():
                        self._show_all(self._checks.finish(message))
                message = self._queue.get_nowait()

    def _seconds_until_due(self) -> float:
        now = time.monotonic()
        due = [self._next_rescan, self._next_look, *(watched.due for watched in self._robots.values())]
        return max(min(due) - now, 0.0)

    def _look(self) -> None:
        """Look at the files of robots after events; robots with a changed file have to settle."""
        begin = time.monotonic()
        self._next_look, has_new_places, self._has_new_places = math.inf, self._has_new_places, False
        touched, self._touched = self._touched, set()
        robots = list(self._robots.values())
        if has_new_places:
            self._watch_folders()
        else:  # what all robots have read, such as the folder of their sources, seldom changes with one robot's file
            present = {entry: look(*entry) for entry in touched}
            robots = [watched for watched in robots if not watched.has_seen(present)]
        looks = [(watched, watched.look()) for watched in robots]
        self._touch([watched for watched, is_new in looks if is_new and (watched.is_told or watched.has_changed)])
        self._earliest_look = time.monotonic() + _REST * (time.monotonic() - begin)

    def _touch(self, robots: Sequence[WatchedRobot]) -> None:
        """Let changed robots settle, all from the same moment, so that they are built together.

        A change that only adds or removes names in a folder is not reported: it rarely matters.
        """
        due = time.monotonic() + self._options.settle
        for watched in robots:
            is_told = watched.is_told or bool(watched.changed_file)
            if is_told and not watched.is_told:
                self._listener(events.Settling(watched.name, shown(Path(watched.changed_file))))
            watched.settle(due, is_told=is_told)

    def _show_all(self, shown_events: Iterable[events.Event]) -> None:
        for event in shown_events:
            self._listener(event)

    def _watch_folders(self) -> None:
        entries = set[Entry]().union(*(watched.places for watched in self._robots.values()))
        self._entries_at = find_places(entries)
        folders = find_watched_folders(self._config, entries, self._options.build.package_paths)
        unwatched = self._observer.watch_folders(folders)
        told = {diagnostic.hint for diagnostic in self._unwatched}
        self._note(tuple(diagnostic for diagnostic in unwatched if diagnostic.hint not in told))
        self._unwatched = unwatched

    def _rescan(self) -> None:
        """Look at all files, since events may be lost."""
        self._next_rescan = time.monotonic() + self._options.rescan
        self._has_new_places = True
        self._look()

    def _find_settled(self, *, has_looked: bool) -> list[WatchedRobot]:
        """Look at the robots whose time has come, unless `has_looked`; return those that have not changed since."""
        now, settled = time.monotonic(), []
        for watched in self._robots.values():
            if watched.due > now:
                continue
            if not has_looked:
                watched.look()
            if not watched.is_told and watched.changed_file:
                self._touch([watched])  # the event of this change may come later
            elif watched.seen == watched.settling:
                settled.append(watched)
            else:
                watched.settle(now + self._options.settle, is_told=watched.is_told)
        return settled

    # Builds

    def _has_to_be_built(self, watched: WatchedRobot) -> bool:
        """Whether anything changed since the last build; if not, the robot rests."""
        # retry a failed build: the cause may lie elsewhere
        if watched.failure is not None or not watched.is_confirmed or watched.has_changed:
            return True
        if watched.is_told:
            self._listener(events.Unchanged(watched.name))
        self._rest(watched)
        return False

    def _build(self, robots: Sequence[WatchedRobot]) -> None:
        """Build robots. A robot has to settle again if its build wrote files, or if a file was saved meanwhile."""
        self._building = [watched.name for watched in robots if watched.is_told]
        self._show_all(list(map(events.Building, self._building)))
        has_other_entries = False
        for result in build(self._config, [watched.robot for watched in robots], self._build_options):
            watched = self._robots[result.robot]
            has_other_entries |= watched.take(result.reads, self._config_facts)
            watched.is_confirmed = not result.writes
            if not result.failed:
                self._take_result(watched, result)
                continue
            watched.look()
            if not watched.has_changed:  # a changed robot is built again anyway
                self._take_failure(watched, result)
        if has_other_entries:
            self._watch_folders()
        for watched in robots:
            watched.look()
            if watched.changed_file:
                # a file was saved meanwhile: report this change, unless the robot was waiting for it
                watched.is_told = watched.invalid_until > 0
                self._touch([watched])
            elif watched.invalid_until:
                watched.settling, watched.due = watched.seen, watched.invalid_until
            elif watched.is_confirmed and not watched.has_changed:
                self._rest(watched)
                if watched.failure is None:
                    self._show_all(self._checks.check(watched.robot))
            else:  # most likely the build's own writes: do not report them
                watched.settle(time.monotonic() + self._options.settle, is_told=False)

    def _rest(self, watched: WatchedRobot) -> None:
        """Let a robot rest until a change, or for a while if its build failed."""
        due = math.inf if watched.failure is None else time.monotonic() + self._options.rescan
        watched.settle(due, is_told=False)

    def _take_failure(self, watched: WatchedRobot, result: Result) -> None:
        """Wait for the exporter, which may still be writing an invalid source. After some time it is an error."""
        again, error = watched.failure == result.diagnostics, result.source_error
        if error is not None and not (again or watched.invalid_until):
            reason = f"waiting for the exporter of {shown(watched.robot.source)}"
            self._listener(events.Waiting(watched.name, reason, error.diagnostics))
            watched.invalid_until, watched.is_confirmed = time.monotonic() + self._options.give_up_after, False
            return
        if watched.is_told or not again:
            self._listener(events.Failed(result, again))
        watched.failure, watched.invalid_until = result.diagnostics, 0.0

    def _take_result(self, watched: WatchedRobot, result: Result) -> None:
        recovered, decided = watched.failure is not None, result.actions.decided
        files = tuple(Path(os.path.normpath(result.root / action.path)) for action in decided if action.writes)
        left_alone = frozenset((action.path, str(action.reason)) for action in decided if not action.writes)
        if result.is_broken:
            left_alone |= {(finding.file, finding.message) for finding in result.diagnostics}
        if watched.is_told or files or recovered or left_alone != watched.left_alone:
            self._listener(events.Built(result, files, recovered))
        watched.failure, watched.invalid_until, watched.left_alone = None, 0.0, left_alone
        watched.pending = tuple(dict.fromkeys((*watched.pending, *files)))
        if watched.pending and not result.is_broken:
            self._show_all(self._commands.run(watched.robot, watched.pending))
            watched.pending = ()
