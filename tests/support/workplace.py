"""A project in which commands run, and the files that they must not change."""

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

from support import audit
from urdfsync import __main__
from urdfsync.engine.result import Exit

CODES = {int(code) for code in Exit}
WATCHING = 0.4
"""Seconds that the daemon gets for its build."""
TIME_LIMIT = 300.0
"""Seconds after which a command counts as hanging, on any busy machine."""
WATCH = ["watch", "--settle", "1", "--patience", "0.1"]
_LARGE = 100_000_000
_REPORTS = "urdfsync-*.traceback.txt"
_CONTROLS = re.compile("[\\x00-\\x1f\\x7f-\\x9f]")
"""Control characters, which not even the text of a record may contain."""

Contents = Mapping[str, bytes | str]


class Fault(Exception):  # noqa: N818 - what a command did, not what is wrong with it
    """A command did something that it must not do."""


class Workplace:
    """A folder with a project, and another folder beside it that nothing may touch. Commands run in this process."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.project, self.outside = folder / "project", folder / "outside"
        self.home, self._temporary = folder / "home", folder / "temporary"

    def fill(self, template: Path) -> None:
        """Make the project a copy of a template, and reset all other folders."""
        for place in (self.project, self.outside):
            shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(template, self.project, symlinks=True)
        self.home.mkdir(parents=True, exist_ok=True)
        self._temporary.mkdir(exist_ok=True)  # the folder stays, since multiprocessing keeps a folder inside
        for report in self._temporary.glob(_REPORTS):
            report.unlink()
        (self.outside / "folder").mkdir(parents=True)
        (self.outside / "victim.mo").write_text("precious")
        (self.outside / "folder/package.order").write_text("precious\n")

    def run(self, command: Sequence[str]) -> tuple[int, str]:
        """Run a command in the project as its program would; return exit code and output.

        Raises Fault for findings of `check_output`, for a forbidden event of this process, and for a change outside of
        the project.
        """
        before, events = self.others(), list[tuple[str, str]]()
        with self._surroundings(), _output() as output, _listening(lambda kind, what: events.append((kind, what))):
            code = _call(command)
        said = output.getvalue().decode(errors="replace")
        reports = [path.read_text() for path in self._temporary.glob(_REPORTS)]
        check_output(command, code, "\n".join([*reports, said]))
        if odd := [event for event in dict.fromkeys(events) if not self.is_allowed(*event)]:
            raise Fault(f"{' '.join(command)}: {odd[:5]}")
        if changed := changes(before, self.others()):
            raise Fault(f"{' '.join(command)}: changes outside of the project: {changed[:5]}")
        return code, said

    def others(self) -> Contents:
        """All files around the project that must stay: also the home folder without urdfsync's cache."""
        home = contents(self.home).items()
        mine = {name: content for name, content in home if not f"{name}/".startswith(".cache/urdfsync/")}
        return contents(self.outside) | {name: content for name, content in mine.items() if name != ".cache"}

    def is_allowed(self, kind: str, what: str) -> bool:
        """Whether an event is allowed: only git and Python start, no foreign code runs, writes stay in their places."""
        if kind == "start":
            return Path(what).name == "git" or Path(what).resolve() == Path(sys.executable).resolve()
        path = Path(what)
        if kind == "code":  # the sandbox runs templates, whose code has the template's name
            return not path.is_relative_to(self.project) or path.suffix == ".jinja"
        in_cache = ".cache/urdfsync" in what or path.name == ".cache"  # of the first home folder of this process
        is_device = path.parent == Path("/dev")  # not below /dev: folders of tests may be in /dev/shm
        places = (self.project, self._temporary)
        return kind == "write" and (in_cache or is_device or any(path.is_relative_to(place) for place in places))

    @contextlib.contextmanager
    def _surroundings(self) -> Iterator[None]:
        home = {"HOME": str(self.home), "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1"}
        with (
            mock.patch.dict(os.environ, home),
            mock.patch.object(tempfile, "tempdir", str(self._temporary)),
            mock.patch.object(sys, "dont_write_bytecode", new=True),  # else Python writes bytecode
            contextlib.chdir(self.project),
        ):
            yield


def _call(command: Sequence[str]) -> int:
    """Call the program."""
    limit = _terminated_soon() if command[0] == "watch" else _limited_time()
    with mock.patch.object(sys, "argv", ["urdfsync", *command]), limit:
        return __main__.main()


def check_output(command: Sequence[str], code: int, said: str) -> None:
    """Raise Fault for a traceback, for an unknown exit code, and for control characters."""
    shown = _CONTROLS.findall(said) if command[0] == "record" else (c for c in said if not c.isprintable())
    odd = set(shown) - {"\n"}
    if "Traceback (most" in said or ".traceback.txt" in said or odd or code not in CODES:
        raise Fault(f"{' '.join(command)}: exit code {code}, {sorted(odd)!r}: {said[-2000:]!r}")


@contextlib.contextmanager
def _listening(listener: audit.Listener) -> Iterator[None]:
    audit.listeners.append(listener)
    try:
        yield
    finally:
        audit.listeners.remove(listener)


@contextlib.contextmanager
def _limited_time() -> Iterator[None]:
    """Raise Fault if the block waits without end, such as for a writer of a FIFO."""

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
    """Collect both streams of a command as one."""
    written = io.BytesIO()
    stream = io.TextIOWrapper(written, encoding="utf-8", write_through=True)
    with contextlib.redirect_stdout(stream), contextlib.redirect_stderr(stream):
        yield written
    stream.detach()  # otherwise the stream closes its buffer


def contents(folder: Path) -> dict[str, bytes | str]:
    """All entries below a folder, by path: the bytes of a file, the target of a link, the kind of any other entry."""
    found: dict[str, bytes | str] = {}
    for place, folders, files in os.walk(folder):
        for path in (Path(place, name) for name in (*folders, *files)):
            name = path.relative_to(folder).as_posix()
            if path.is_symlink():
                found[name] = f"link to {path.readlink()}"
            elif path.is_file():
                size = path.stat().st_size
                found[name] = path.read_bytes() if size < _LARGE else f"{size} bytes"
            else:
                found[name] = "folder" if path.is_dir() else "special"
    return found


def changes(before: Contents, after: Contents) -> list[str]:
    """The paths that differ."""
    return sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name))
