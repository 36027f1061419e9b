"""The daemon: events of the file system, settled batches, builds.

One thread does everything, in rounds: it waits for a message or for the time at which something is due, samples what
is due, and builds what has settled. Events only say where to look. What is built is decided by what is there, and by
the build itself, so an event too many or too few costs time and nothing else.

What robots are built from is sampled; outputs are looked at by builds, and by nobody else as long as nothing is heard
of them. A build that wrote something is followed by another: that finds nothing to do unless somebody else was
writing. So what the daemon wrote is told from what others wrote without knowing what it wrote: the last build of every
robot wrote nothing, and what is there later is compared with what that build saw.
"""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import msgspec

from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.engine.cache import Cache
from urdfsync.watching import builder, events, stash
from urdfsync.watching.builds import Builds
from urdfsync.watching.checks import Checks
from urdfsync.watching.guard import Guard
from urdfsync.watching.inbox import Ended, Examined, Inbox, Lost, Message, Stop
from urdfsync.watching.observer import Observer
from urdfsync.watching.options import Options
from urdfsync.watching.reading import judge
from urdfsync.watching.robots import Robots, Watched
from urdfsync.watching.runner import Runner
from urdfsync.watching.samples import alike
from urdfsync.watching.scope import Sight, sight
from urdfsync.watching.settings import Loaded, Settings
from urdfsync.watching.settling import Verdict
from urdfsync.watching.stash import Stash

_PAUSE = 0.25
"""Seconds between two looks whether a pause is over."""
_POLL = 1.0
"""Seconds between two looks at sources and what they need, where there are no events."""
_HOUR = 3600.0
"""Seconds between two looks that trust no stat values."""


class Daemon:
    """Keeps the packages of one configuration in step until it is told to stop."""

    def __init__(self, options: Options, listener: events.Listener) -> None:
        self._options, self._tell = options, listener
        self._file = str(options.file.absolute())
        self._inbox = Inbox()
        self._observer = Observer(self._inbox.notice, lambda: self._inbox.put(Lost()))
        self._settings = Settings(options)
        self._memory = Cache()
        self._robots = Robots(options.times, options.request.package_paths, self._memory)
        request = msgspec.structs.replace(options.request, progress=self._progress, cache=self._memory)
        self._checks = Checks(
            options.request,
            listener,
            lambda errand, found: self._inbox.put(Examined(errand, found)),
            options.examine,
        )
        self._builds = Builds(
            self._robots,
            request,
            listener,
            self._touch,
            self._arm,
            self._run_command,
            self._check,
            self._update_pause,
        )
        self._runner = Runner(
            options.command, options.file.absolute().parent, lambda robot, code: self._inbox.put(Ended(robot, code))
        )
        self._sight = Sight({}, {}, frozenset(), {})
        self._stash = Stash(stash.store(os.environ, Path(os.path.expanduser("~"))))  # noqa: PTH111 - it can't fail
        self._config: Config
        self._stopped = ""
        self._paused = self._warm = False
        self._unwatched: tuple[Diagnostic, ...] = ()
        self._next_poll = self._next_rescan = self._next_hour = 0.0

    def stop(self, signal: str) -> None:
        """End when the build in hand is finished, or given up if it has not begun to write. For signal handlers."""
        self._stopped = signal
        self._inbox.put(Stop(signal))

    def run(self) -> None:
        """Watch until `stop` is called. Raises ConfigError for a configuration that can't be used at the start.

        Raises HeldError if another daemon watches it, OutputError if the state can't be written.
        """
        loaded = self._settings.load(self._robots.look(self._file))
        with Guard(loaded.config) as guard, self._observer.open(), self._checks:
            self._take(loaded)
            self._next_rescan = time.monotonic() + self._options.rescan
            self._next_hour = time.monotonic() + _HOUR
            while not self._stopped:
                self._receive(self._inbox.wait(self._patience()))
                with contextlib.suppress(builder.StoppedError):
                    self._work(guard)
        self._tell(events.Stopping(self._stopped))

    def _take(self, loaded: Loaded, again: bool = False) -> None:
        """Put a configuration in force: everything is built."""
        self._config = loaded.config
        self._checks.reset()
        self._robots.load(loaded.config, loaded.robots)
        self._tell(events.Started(loaded.config.file, tuple(watched.name for watched in self._robots), again))
        if loaded.advice:
            self._tell(events.Noted(loaded.advice))
        self._arm()
        for watched in self._robots:
            watched.announced = True
            watched.settler.touch(time.monotonic())

    # What happens

    def _receive(self, messages: Iterable[Message]) -> None:
        paths = set()
        for message in messages:
            match message:
                case str():
                    paths.add(message)
                case Lost():
                    self._next_rescan = 0.0
                case Ended(robot, code):
                    self._on_ended(robot, code)
                case Examined(errand, found):
                    self._checks.ended(errand, found)
        if paths:
            self._notice(paths)

    def _notice(self, paths: set[str]) -> None:
        """Some paths may have changed."""
        concerned: dict[str, set[str]] = {}
        for path in paths:
            for name in self._sight.concerned(path):
                concerned.setdefault(name, set()).add(path)
        settings = self._settings
        if "" in concerned and settings.has_changed(self._robots.look(self._file)):
            settings.settler.touch(time.monotonic())
        affected = self._robots.named(concerned)
        if not all(watched.knows(concerned[watched.name]) for watched in affected):
            self._arm()
        for watched in affected:
            if not watched.settler.calm or self._robots.has_news(watched, concerned[watched.name]):
                watched.notice(concerned[watched.name])
                self._touch(watched)

    def _touch(self, watched: Watched) -> None:
        """Something changed: the robot has to settle."""
        if not watched.announced:
            self._tell(events.Settling(watched.name))
            watched.announced = True
        watched.settler.touch(time.monotonic())

    def _arm(self) -> None:
        """Watch where changes can be seen as things are now."""
        if self._options.poll:
            return
        self._sight = sight(str(self._config.root), self._robots.scopes, [self._file])
        self._inbox.matters = self._sight.concerned
        folders = dict.fromkeys(self._sight.folders, False) | dict.fromkeys(self._sight.trees, True)
        found = self._observer.arm(folders)
        known = {trouble.hint for trouble in self._unwatched}
        if new := tuple(trouble for trouble in found if trouble.hint not in known):
            self._tell(events.Noted(new))
        elif self._unwatched and not found:
            self._tell(events.Recovered("all folders are watched again"))
        self._unwatched = found

    # What is due

    def _patience(self) -> float:
        """Seconds until something is due."""
        now = time.monotonic()
        deadlines = [self._settings.settler.deadline, *(watched.settler.deadline for watched in self._robots)]
        due = [deadline for deadline in deadlines if deadline is not None]
        if self._paused:
            due = [max(deadline, now + _PAUSE) for deadline in due]
        elif not due and not self._warm:
            return 0.0
        looks = [self._next_rescan, self._next_poll] if self._is_polling else [self._next_rescan]
        return max(min([*due, *looks]) - now, 0.0)

    @property
    def _is_polling(self) -> bool:
        """Whether there are no events, or not of all folders."""
        return self._options.poll or bool(self._unwatched)

    def _work(self, guard: Guard) -> None:
        now = time.monotonic()
        if now >= self._next_rescan:
            self._rescan(now, guard)
        elif self._is_polling and now >= self._next_poll:
            self._poll(now)
        self._settle_settings(now)
        due = [one for one in self._robots if one.settler.deadline is not None and one.settler.deadline <= now]
        if due and self._update_pause():
            return
        ready = [watched for watched in due if self._take_sample(watched)]
        if ready and self._update_pause():
            for watched in ready:
                self._touch(watched)
        elif ready:
            self._builds.build(self._config, ready)
        elif not self._warm and all(watched.settler.calm for watched in self._robots):
            self._warm = True  # now that there is time
            builder.warm_up(self._config, [watched.robot for watched in self._robots])

    def _settle_settings(self, now: float) -> None:
        settler = self._settings.settler
        if settler.deadline is None or settler.deadline > now:
            return
        match self._settings.look(self._robots.look(self._file), now):
            case Loaded() as loaded:
                self._take(loaded, again=True)
            case trouble if trouble:
                self._tell(events.Noted(trouble))

    def _take_sample(self, watched: Watched) -> bool:
        """Take the sample that is due. Returns whether the robot is to be built now."""
        settler = watched.settler
        sample = self._robots.sample(watched)
        match settler.look((sample, self._robots.outputs(watched, watched.noticed)), time.monotonic()):
            case Verdict.PENDING:
                return False
            case Verdict.EXPIRED:
                self._builds.fail(self._config, watched)
                return False
        watched.settled = sample
        if watched.failed is None and self._robots.confirm(watched, sample):
            self._calm(watched)
            return False
        return sample[watched.scope.source].content == watched.scope.built or self._judge(watched)

    def _calm(self, watched: Watched) -> None:
        watched.trouble = ()
        watched.settler.readable()
        if watched.announced:
            self._tell(events.Calm(watched.name))
        watched.rest()

    def _judge(self, watched: Watched) -> bool:
        """Whether what has settled is a model to be believed; if not, it is waited for."""
        settler, source = watched.settler, watched.settled[watched.scope.source].content
        try:
            found = judge(self._config, watched.robot, watched.scope.names, self._memory)
        except Exception as error:  # noqa: BLE001 - a bug in a domain must not end the daemon; nothing is written yet
            watched.trouble = (builder.unexpected(error, f"{shown(watched.robot.source)} can't be read"),)
            self._builds.fail(self._config, watched)
            return False
        if found.content and found.content != source:  # written between the sample and this
            self._touch(watched)
            return False
        if found.errors:
            self._wait(watched, found.errors)
            return False
        settler.readable()
        if found.gone and not settler.believed:
            reason = f"{found.gone} of {len(watched.scope.names)} elements are gone, so it is watched a little longer"
            self._tell(events.Waiting(watched.name, reason))
            settler.doubt(time.monotonic())
            return False
        return True

    def _wait(self, watched: Watched, errors: tuple[Diagnostic, ...]) -> None:
        """The source is no model: somebody may be writing it."""
        new, watched.trouble = errors != watched.trouble, errors
        if watched.settler.wait(time.monotonic()) is Verdict.EXPIRED:
            self._builds.fail(self._config, watched)
        elif new or watched.announced:
            self._tell(events.Waiting(watched.name, "waiting for the exporter", errors))

    # Now and then

    def _rescan(self, now: float, guard: Guard) -> None:
        """Look at everything: events may be lost, and what failed may work now."""
        self._next_rescan, self._next_poll = now + self._options.rescan, now + _POLL
        with contextlib.suppress(OutputError):  # as long as the folder can't be written to, nobody can take the lock
            guard.renew()
        if now >= self._next_hour:
            self._next_hour = now + _HOUR
            self._robots.rehash_all()
        self._arm()
        self._look_at_settings()
        for watched in self._robots:
            if watched.settler.calm and not self._robots.confirm(watched, self._robots.sample(watched)):
                self._touch(watched)
            elif watched.settler.calm and watched.failed is not None:
                watched.settler.touch(now)
        self._robots.tidy([self._file])

    def _poll(self, now: float) -> None:
        """Look at what robots are built from."""
        self._next_poll = now + _POLL
        self._look_at_settings()
        for watched in self._robots:
            if watched.settler.calm and not alike(watched.built or {}, self._robots.sample(watched)):
                self._touch(watched)

    def _look_at_settings(self) -> None:
        if self._settings.settler.calm and self._settings.has_changed(self._robots.look(self._file)):
            self._settings.settler.touch(time.monotonic())

    def _update_pause(self) -> bool:
        """Whether nothing must be built now; says so when that changes. What was paused has to settle again."""
        holder = self._stash.holder(self._config.root)
        if holder is not None and not self._paused:
            self._tell(events.Paused(f"pre-commit (process {holder}) has stashed unstaged changes away"))
        resumed = holder is None and self._paused
        if resumed:
            self._tell(events.Resumed())
            for watched in self._robots:
                if not watched.settler.calm:
                    self._touch(watched)
        self._paused = holder is not None
        return self._paused or resumed

    def _progress(self, what: str, done: int, total: int) -> None:
        """A step of the build under way, and a place at which it can be given up."""
        if self._stopped:
            raise builder.StoppedError
        self._tell.progress(what, done, total)

    def _check(self, robot: RobotConfig) -> None:
        self._checks.ask(self._config, robot)

    # --exec

    def _run_command(self, robot: RobotConfig, files: Sequence[Path]) -> None:
        if self._options.command:
            with self._noting(robot.name):
                self._runner.run(robot, files)

    def _on_ended(self, robot: str, code: int) -> None:
        self._tell(events.Ran(robot, code))
        if code:
            self._note_command(robot, f"ended with exit code {code}" if code > 0 else f"was ended by signal {-code}")
        with self._noting(robot):
            self._runner.ended(robot)

    @contextlib.contextmanager
    def _noting(self, robot: str) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            self._note_command(robot, f"can't be started: {error.strerror or error}")

    def _note_command(self, robot: str, what: str) -> None:
        message = f"robot `{robot}`: the command of --exec {what}"
        hint = "it runs again after the next build that changes something"
        self._tell(events.Noted((Diagnostic(Severity.WARNING, "exec", message, hint=hint),)))
