"""`urdfsync watch` as a process of its own or as a thread of the test, with its output."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import IO, Any, Self

from urdfsync.engine.options import BuildOptions
from urdfsync.watch import events
from urdfsync.watch.daemon import Daemon, WatchOptions

REPOSITORY = Path(__file__).parents[2]
LIMIT = 60.0
"""Seconds after which a test gives up, on any busy machine."""

QUICK = {"settle": 0.02, "give_up_after": 0.1}

NEVER = 100000.0
"""Seconds between rescans, too long for any test."""

RECORD = Path("modelica/Ladder/Elements/R2Parameters.mo")
MODEL = Path("modelica/Ladder/Elements/R2.mo")

Event = Mapping[str, Any]
ENDED = (events.Built, events.Failed, events.Unchanged)
ENDS = ("built", "failed", "calm")
"""Events that end the sequence of a robot's events."""


def ladder(ohm: float) -> str:
    """Return the source of the RC network with another resistance."""
    example = REPOSITORY / "tests/rcnetwork/examples/ladder.json"
    return example.read_text().replace("220.5", f"{ohm:g}")


def save(ohm: float) -> None:
    """Change the source of the working folder."""
    Path("ladder.json").write_text(ladder(ohm))


def holds(ohm: float) -> bool:
    """Whether the package is built with this resistance."""
    return f"{ohm:g}" in RECORD.read_text()


def until(condition: Callable[[], bool], pause: float = 0.01) -> None:
    """Wait for a condition of which no event tells."""
    deadline = time.monotonic() + LIMIT
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(pause)


class Listener:
    """The events of a daemon."""

    def __init__(self) -> None:
        self.events: list[Any] = []
        self._news = threading.Condition()

    def show(self, event: Any) -> None:
        """Take an event."""
        with self._news:
            self.events.append(event)
            self._news.notify_all()

    def until(self, condition: Callable[[], Any]) -> None:
        """Wait for a condition; check it after each event."""
        with self._news:
            assert self._news.wait_for(condition, LIMIT), self.said

    @property
    def mark(self) -> int:
        """The number of the next event."""
        return len(self.events)

    @property
    def said(self) -> str:
        """All that is known, to explain a failure."""
        return repr(self.events)


class Watch(Listener):
    """A daemon that runs inside of a `with` block; a thread reads its events from a pipe."""

    def __init__(
        self, folder: Path, *arguments: str, path: Sequence[Path] = (), before: Sequence[str] = (), **environment: str
    ) -> None:
        """Python also imports from the folders `path`; `before` is a command that starts the daemon."""
        super().__init__()
        paths = os.pathsep.join(map(str, [REPOSITORY, *path]))
        self._command = [*before, sys.executable, "-m", "urdfsync", "watch", "--format=json", *arguments]
        self._environment = {**os.environ, "PYTHONPATH": paths, "PYTHONWARNINGS": "error", **environment}
        self._folder = folder
        self._errors: IO[bytes] = tempfile.TemporaryFile()  # noqa: SIM115 - closed with the daemon

    def __enter__(self) -> Self:
        self.process = subprocess.Popen(
            self._command, cwd=self._folder, env=self._environment, stdout=subprocess.PIPE, stderr=self._errors
        )
        self._reader = threading.Thread(target=self._read)
        self._reader.start()
        return self

    def __exit__(self, *_: object) -> None:
        with contextlib.suppress(ProcessLookupError):
            self.process.send_signal(signal.SIGCONT)
            self.process.kill()
        self.process.wait()
        self._reader.join()
        if self.process.stdout:
            self.process.stdout.close()
        self._errors.close()

    def _read(self) -> None:
        for line in self.process.stdout or ():
            self.show(json.loads(line))
        with self._news:
            self._news.notify_all()

    def wait(self, what: str, wanted: Callable[[Event], bool] = lambda event: True, since: int = 0) -> Event:
        """The first event of this kind that is wanted, from the one with this number on; waits for it."""

        def found() -> Event | None:
            return next((e for e in self.events[since:] if e.get("event") == what and wanted(e)), None)

        self.until(lambda: found() is not None or not self._reader.is_alive())
        event = found()
        assert event is not None, f"no event `{what}`: {self.said}"
        return event

    def rest(self, since: int = 0, robots: int = 1) -> None:
        """Wait until so many robots have ended since then, and no robot is being built."""

        def rests() -> bool:
            about = [(event.get("result", event), event["event"]) for event in self.events[since:]]
            last = {told["robot"]: kind for told, kind in about if "robot" in told}
            return len(last) >= robots and all(event in (*ENDS, "ran") for event in last.values())

        self.until(rests)

    def stop(self, number: int = signal.SIGTERM) -> int:
        """Send a signal; returns the exit code."""
        self.process.send_signal(number)
        code = self.process.wait(LIMIT)
        self._reader.join()
        return code

    def kinds(self, since: int = 0) -> list[str]:
        """The names of the events from the one with this number on."""
        return [event["event"] for event in self.events[since:]]

    @property
    def errors(self) -> str:
        """The output of the process on its error stream."""
        self._errors.seek(0)
        return self._errors.read().decode()

    @property
    def said(self) -> str:
        """All that is known, to explain a failure."""
        lines = (
            f"{event.get('event', event)} {event.get('robot', '')} {event.get('summary', '')}" for event in self.events
        )
        return "\n".join([*lines, self.errors])


Start = Callable[..., Watch]
"""The fixture `start` of `tests/watch`."""


class Daemons(Listener):
    """A daemon in a thread of the test, with its events: for faults that a test injects."""

    def __init__(self, then: Callable[[Any], object] = lambda event: None, **options: Any) -> None:
        """Wait for the first build. The daemon waits while `then` is called, with each event."""
        super().__init__()
        self._then = then
        build = BuildOptions(wait=1)
        self._daemon = Daemon(WatchOptions(Path("urdfsync.toml"), build=build, **(QUICK | options)), self.show)
        self._thread = threading.Thread(target=self._daemon.run)
        self._thread.start()
        self.until(lambda: any(isinstance(one, ENDED) for one in self.events))

    def show(self, event: Any) -> None:
        """Take an event."""
        super().show(event)
        self._then(event)

    def wait(self, kind: type, since: int = 0, wanted: Callable[[Any], bool] = lambda event: True) -> Any:
        """The first event of this kind that is wanted, from the one with this number on; waits for it."""

        def found() -> Any:
            return next((one for one in self.events[since:] if isinstance(one, kind) and wanted(one)), None)

        self.until(lambda: found() is not None)
        return found()

    def after(self, act: Callable[[], object], kind: type, wanted: Callable[[Any], bool] = lambda event: True) -> Any:
        """Do something, and wait for the next event of this kind that is wanted."""
        since = self.mark
        act()
        return self.wait(kind, since, wanted)

    def kinds(self, since: int = 0) -> list[str]:
        """The names of the events from the one with this number on."""
        return [type(event).__name__ for event in self.events[since:]]

    def stop(self) -> None:
        self._daemon.stop("SIGTERM")
        self._thread.join(LIMIT)
        assert not self._thread.is_alive()


@contextlib.contextmanager
def stopped(process: subprocess.Popen[bytes]) -> Iterator[None]:
    """The process does not run for a while."""
    process.send_signal(signal.SIGSTOP)
    try:
        yield
    finally:
        process.send_signal(signal.SIGCONT)
