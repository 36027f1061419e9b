"""Runs a child process under limits of time and memory, with a text for it and its lines as they come.

A child has a process group of its own, so a key that interrupts this process does not reach it: whatever happens here
ends it. It keeps an open stdin as long as somebody waits for it; one that calls `end_with_parent` is not
left behind when this process is killed.
"""

from __future__ import annotations

import contextlib
import enum
import math
import os
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import IO, TYPE_CHECKING, cast

import msgspec

if TYPE_CHECKING:
    import psutil

INTERVAL = 0.2
"""Seconds between two looks at the memory and the clock."""
WORDS = 8192
"""So many of the last bytes on stderr are kept."""

_PATIENCE = 10.0  # s: for pipes that somebody else holds open
_CRASH = 0xC0000000  # Windows: exit codes from here on are exceptions


class Ending(enum.Enum):
    """How a child came to its end."""

    EXITED = "exited"
    CRASHED = "crashed"
    OUT_OF_TIME = "out of time"
    OUT_OF_MEMORY = "out of memory"


class Limits(msgspec.Struct, frozen=True):
    """What a child and all that it starts may take."""

    seconds: float = math.inf
    """Time by the clock."""
    memory: float = math.inf
    """Resident bytes of all of them together."""


UNLIMITED = Limits()


class Result(msgspec.Struct, frozen=True):
    """How a child ended."""

    ending: Ending
    code: int
    """The exit code; for a crash the number of the signal, or the exception on Windows."""
    memory: int
    """The most resident bytes that were seen, of the child and all that it started."""
    words: str
    """The end of what it wrote to stderr."""
    seconds: float
    """By the clock."""

    @property
    def good(self) -> bool:
        """Whether the child said that all is well."""
        return self.ending is Ending.EXITED and self.code == 0

    @property
    def cause(self) -> str:
        """The code in words: `exit code 3`, `signal 11 (SIGSEGV)`."""
        if self.ending is Ending.EXITED:
            return f"exit code {self.code}"
        if self.code >= _CRASH:
            return f"exception 0x{self.code:08X}"
        names = {one.value: f" ({one.name})" for one in signal.Signals}
        return f"signal {self.code}{names.get(self.code, '')}"


def ignore(line: str) -> None:
    """Nobody wants to hear what a child writes."""


def run(
    command: Sequence[str],
    text: str = "",
    tell: Callable[[str], None] = ignore,
    limits: Limits = UNLIMITED,
    environment: Mapping[str, str] | None = None,
    tick: Callable[[], None] = lambda: None,
) -> Result:
    """Run `command` with `text` on its stdin, and `tell` each line that it writes to stdout, without its end.

    Stdin stays open until the child has ended. `environment` adds to that of this process. `tick`
    is called every now and then; whatever it raises gives the child up. At the end, and at
    any exception, also one of `tell`, nothing that the child started is left. May be called from any thread;
    `tell` is called from the same one. Raises OSError if there is no such program.
    """
    tree = _Tree()
    child = subprocess.Popen(  # noqa: S603 - the caller's command
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=os.environ | dict(environment or {}),
        start_new_session=True,
        creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
    )
    tree.plant(child.pid)
    talk = _Conversation(child, tree, tell, limits, tick)
    try:
        return talk.result(text)
    finally:
        tree.kill()
        child.wait()
        talk.close()


def python(module: str) -> list[str]:
    """The command that runs a module with this Python; the working folder has no say in what it imports."""
    return [sys.executable, "-P", "-m", module]


def importable() -> dict[str, str]:
    """What the environment of such a command needs so that it finds this package, if that is not installed."""
    home = Path(__file__).parents[2]
    if home.name in ("site-packages", "dist-packages"):
        return {}
    others = os.environ.get("PYTHONPATH")
    return {"PYTHONPATH": os.pathsep.join([str(home), *([others] if others else [])])}


def end_with_parent() -> None:
    """From now on this process ends as soon as its stdin does; call it after the last line was read from there.

    Except on Linux, native code that does not let other threads run puts the end off until it is done.
    """
    if sys.platform == "linux":
        import fcntl

        with contextlib.suppress(OSError):  # no pipe
            fcntl.fcntl(0, fcntl.F_SETOWN, os.getpid())
            fcntl.fcntl(0, fcntl.F_SETFL, fcntl.fcntl(0, fcntl.F_GETFL) | os.O_ASYNC)  # the system sends SIGIO
    threading.Thread(target=_await_end, name="end-with-parent", daemon=True).start()


def _await_end() -> None:
    with contextlib.suppress(OSError):
        while os.read(0, 4096):  # not through sys.stdin, whose lock would disturb the interpreter at its end
            pass
    os._exit(1)


class _Tree:
    """A child and all that it started."""

    def __init__(self) -> None:
        import psutil

        self._process = psutil.Process
        self._errors = (psutil.NoSuchProcess, psutil.AccessDenied)
        self._known: set[psutil.Process] = set()
        self._group = 0
        self.peak = 0

    def plant(self, child: int) -> None:
        """From here on `child` is the root, by its process id."""
        self._group = child
        with contextlib.suppress(*self._errors):
            self._known.add(self._process(child))

    def measure(self) -> int:
        """Resident bytes of all of them now."""
        total = 0
        for process in self._members():
            with contextlib.suppress(*self._errors):
                total += process.memory_info().rss
        self.peak = max(self.peak, total)
        return total

    def kill(self) -> None:
        """End them all: stop them until none is new, so that none starts another meanwhile."""
        stopped: set[psutil.Process] = set()
        while new := self._members() - stopped:
            for process in new:
                with contextlib.suppress(*self._errors):
                    process.suspend()
            stopped |= new
        for process in stopped:
            with contextlib.suppress(*self._errors):
                process.kill()
        if sys.platform != "win32":
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.killpg(self._group, signal.SIGKILL)  # those whose parents were gone before anybody looked

    def _members(self) -> set[psutil.Process]:
        found = set()
        for process in self._known:
            with contextlib.suppress(*self._errors):
                if process.is_running():
                    found.add(process)
                    found.update(process.children(recursive=True))
        self._known = found
        return found


class _Conversation:
    """What goes to and from a child, and the look at its limits."""

    def __init__(
        self,
        child: subprocess.Popen[bytes],
        tree: _Tree,
        tell: Callable[[str], None],
        limits: Limits,
        tick: Callable[[], None],
    ) -> None:
        self._child, self._tree, self._tell, self._limits, self._tick = child, tree, tell, limits, tick
        self._lines: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        self._reading = True
        self._words = self._rest = b""
        self._threads: dict[IO[bytes], threading.Thread] = {}
        self._started = time.monotonic()

    def result(self, text: str) -> Result:
        """Follow the child until it has ended or must."""
        self._start(text.encode())
        ending = self._follow()
        self._tree.kill()
        code = self._child.wait()
        if ending is Ending.EXITED and (code < 0 or code >= _CRASH):
            ending = Ending.CRASHED
        while self._reading and self._pass_on(_PATIENCE):
            pass
        if self._rest and ending is Ending.EXITED:
            self._tell(_decoded(self._rest))
        self.close()
        words = self._words.decode(errors="replace").strip()
        return Result(ending, abs(code), self._tree.peak, words, time.monotonic() - self._started)

    def close(self) -> None:
        """Close the pipes, except such as a stranger still holds."""
        for stream, thread in self._threads.items():
            thread.join(_PATIENCE)
            if not thread.is_alive():
                with contextlib.suppress(OSError):  # what could not be written to a child that is gone
                    stream.close()

    def _start(self, text: bytes) -> None:
        jobs: tuple[tuple[IO[bytes], Callable[[IO[bytes]], None]], ...] = (
            (cast(IO[bytes], self._child.stdin), lambda stream: _write(stream, text)),
            (cast(IO[bytes], self._child.stdout), self._read),
            (cast(IO[bytes], self._child.stderr), self._listen),
        )
        for stream, job in jobs:
            self._threads[stream] = threading.Thread(target=job, args=(stream,), daemon=True)
            self._threads[stream].start()

    def _read(self, stdout: IO[bytes]) -> None:
        for line in stdout:
            self._lines.put(line)
        self._lines.put(b"")

    def _listen(self, stderr: IO[bytes]) -> None:
        while words := os.read(stderr.fileno(), WORDS):
            self._words = (self._words + words)[-WORDS:]

    def _follow(self) -> Ending:
        due = 0.0
        while self._child.poll() is None:
            if self._reading:
                self._pass_on(INTERVAL)
            else:
                with contextlib.suppress(subprocess.TimeoutExpired):
                    self._child.wait(INTERVAL)
            self._tick()
            now = time.monotonic() - self._started
            if now >= self._limits.seconds:
                return Ending.OUT_OF_TIME
            if now >= due:
                due = now + INTERVAL
                if self._tree.measure() > self._limits.memory:
                    return Ending.OUT_OF_MEMORY
        return Ending.EXITED

    def _pass_on(self, patience: float) -> bool:
        """Tell the next line if it comes within `patience` s; one without an end waits, it may be torn off."""
        try:
            line = self._lines.get(timeout=patience)
        except queue.Empty:
            return False
        self._reading = line != b""
        if line.endswith(b"\n"):
            self._tell(_decoded(line))
        else:
            self._rest = line or self._rest
        return True


def _decoded(line: bytes) -> str:
    return line.decode(errors="replace").rstrip("\r\n")


def _write(stdin: IO[bytes], text: bytes) -> None:
    with contextlib.suppress(OSError):  # the child may end before it has read all
        stdin.write(text)
        stdin.flush()
