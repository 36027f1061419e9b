"""A project that commands run in, and all that they must leave alone."""

from __future__ import annotations

import contextlib
import io
import os
import re
import shutil
import signal
import sys
import tempfile
import threading
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import FrameType
from unittest import mock

from urdfsync import __main__, hook
from urdfsync.outcome import Exit

CODES = {int(code) for code in Exit}
WATCHING = 0.4
"""Seconds for the daemon: it has built by then, or will not."""
TIME_LIMIT = 60.0
"""Seconds after which a command hangs."""
WATCH = ["watch", "--settle", "1", "--sample", "1", "--patience", "0.1"]
_SHOWN = 300
_CONTROLS = re.compile("[\\x00-\\x1f\\x7f-\\x9f]")
"""What must not be in the text of a record either, which otherwise has names as they are."""

Contents = Mapping[str, bytes | str]


class Fault(Exception):  # noqa: N818 - what a command did, not what is wrong with it
    """Something that must not happen has happened."""


class Workplace:
    """A folder with a project, and another folder beside it that nothing may touch. Commands run in this process."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.project, self.outside = folder / "project", folder / "outside"
        self._temporary, self._home = folder / "temporary", folder / "home"

    def fill(self, template: Path) -> None:
        """Make the project a copy of another one, and all else as new."""
        for place in (self.project, self.outside, self._temporary):
            shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(template, self.project, symlinks=True)
        self._home.mkdir(parents=True, exist_ok=True)
        self._temporary.mkdir()
        (self.outside / "folder").mkdir(parents=True)
        (self.outside / "victim.mo").write_text("precious")
        (self.outside / "folder/package.order").write_text("precious\n")

    def run(self, command: Sequence[str]) -> tuple[int, str]:
        """Run a command in the project as its program would; returns exit code and output.

        Raises Fault for a traceback, for an exit code that stands for nothing, for characters that a terminal obeys,
        and for a change outside of the project.
        """
        before = self._others()
        with self._surroundings(), _output() as output:
            code = _call(command)
        said = output.getvalue().decode(errors="replace")
        reports = [path.read_text() for path in self._temporary.glob("urdfsync-*.traceback.txt")]
        if reports or "Traceback (most" in said:
            raise Fault(f"{' '.join(command)}: {(reports or [said])[0][-2000:]}")
        if code not in CODES:
            raise Fault(f"{' '.join(command)}: exit code {code}: {said[-_SHOWN:]}")
        shown = _CONTROLS.findall(said) if command[0] == "record" else (c for c in said if not c.isprintable())
        if odd := set(shown) - {"\n"}:
            raise Fault(f"{' '.join(command)}: the output has {sorted(odd)!r}: {said[-_SHOWN:]!r}")
        if changed := changes(before, self._others()):
            raise Fault(f"{' '.join(command)}: changes outside of the project: {changed[:5]}")
        return code, said

    def _others(self) -> Contents:
        """All around the project that must stay: the home folder but for urdfsync's own cache in it."""
        home = contents(self._home).items()
        mine = {name: content for name, content in home if not f"{name}/".startswith(".cache/urdfsync/")}
        return contents(self.outside) | {name: content for name, content in mine.items() if name != ".cache"}

    @contextlib.contextmanager
    def _surroundings(self) -> Iterator[None]:
        home = {"HOME": str(self._home), "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1"}
        with (
            mock.patch.dict(os.environ, home),
            mock.patch.object(tempfile, "tempdir", str(self._temporary)),
            contextlib.chdir(self.project),
        ):
            yield


def _call(command: Sequence[str]) -> int:
    """Call the program that a command names: `hook` is the one of the hooks of git."""
    program, arguments = (hook.main, command[1:]) if command[0] == "hook" else (__main__.main, command)
    limit = _terminated_soon() if command[0] == "watch" else _limited_time()
    with mock.patch.object(sys, "argv", ["urdfsync", *arguments]), limit:
        return program()


@contextlib.contextmanager
def _limited_time() -> Iterator[None]:
    """Raise Fault in what waits without end, such as for a writer of a FIFO."""

    def stop(_number: int, _frame: FrameType | None) -> None:
        raise Fault(f"it hangs: {TIME_LIMIT:g} s are over")

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, TIME_LIMIT)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


@contextlib.contextmanager
def _terminated_soon() -> Iterator[None]:
    """Send this process SIGTERM after a while, and again for a daemon that was not ready the first time."""
    done = threading.Event()

    def terminate() -> None:
        wait = WATCHING
        while not done.wait(wait):
            os.kill(os.getpid(), signal.SIGTERM)
            wait = 10 * WATCHING

    before = signal.signal(signal.SIGTERM, lambda *_: None)  # until the daemon has handlers, and after it has ended
    thread = threading.Thread(target=terminate)
    thread.start()
    try:
        yield
    finally:
        done.set()
        thread.join()
        signal.signal(signal.SIGTERM, before)


@contextlib.contextmanager
def _output() -> Iterator[io.BytesIO]:
    """Both streams of a command as one."""
    written = io.BytesIO()
    stream = io.TextIOWrapper(written, encoding="utf-8", write_through=True)
    with contextlib.redirect_stdout(stream), contextlib.redirect_stderr(stream):
        yield written
    stream.detach()  # or it closes what it has written to


def contents(folder: Path) -> dict[str, bytes | str]:
    """What is below a folder, by path: the bytes of a file, where a link leads, of all else its kind."""
    found: dict[str, bytes | str] = {}
    for place, folders, files in os.walk(folder):
        for path in (Path(place, name) for name in (*folders, *files)):
            name = path.relative_to(folder).as_posix()
            if path.is_symlink():
                found[name] = f"link to {path.readlink()}"
            elif path.is_file():
                found[name] = path.read_bytes()
            else:
                found[name] = "folder" if path.is_dir() else "special"
    return found


def changes(before: Contents, after: Contents) -> list[str]:
    """The paths that differ."""
    return sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name))
