"""Two questions at the same time: whatever becomes of the second process, the answer is the one that is true."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import urdfsync
from urdfsync.stamping import beside

pytestmark = [
    pytest.mark.skipif(not hasattr(os, "fork"), reason="needs a second process"),
    pytest.mark.filterwarnings("ignore:.*multi-threaded.*fork:DeprecationWarning"),  # pytest-xdist has threads
]


class Asked:
    """Two questions with their answers; takes down which of them were asked in this process."""

    def __init__(
        self, *, first: bool = True, second: bool = True, elsewhere: Callable[[], object] = lambda: None
    ) -> None:
        """`elsewhere` happens to the first one if it is asked in another process."""
        self.answers = {"first": first, "second": second}
        self.elsewhere = elsewhere
        self.here: list[str] = []
        self.process = os.getpid()

    def both(self) -> bool:
        return beside.both(lambda: self._ask("first"), lambda: self._ask("second"))

    def _ask(self, name: str) -> bool:
        if os.getpid() != self.process:
            self.elsewhere()
        self.here.append(name)
        return self.answers[name]


@pytest.fixture
def forking(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(beside, "_may_fork", lambda: True)


@pytest.mark.parametrize("first", [True, False])
@pytest.mark.parametrize("second", [True, False])
@pytest.mark.parametrize("fork", [True, False])
def test_both_have_to_be_so(first: bool, second: bool, fork: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(beside, "_may_fork", lambda: fork)
    assert Asked(first=first, second=second).both() is (first and second)


def test_only_a_yes_is_taken_from_another_process(forking: None) -> None:
    asked = Asked()
    assert asked.both()
    assert asked.here == ["second"]
    asked = Asked(elsewhere=lambda: os._exit(beside._NO))
    assert asked.both()
    assert asked.here == ["second", "first"]


def _interrupted() -> None:
    raise KeyboardInterrupt


def _lost() -> None:
    raise FileNotFoundError


ENDS: dict[str, Callable[[], object]] = {
    "killed": lambda: os.kill(os.getpid(), signal.SIGKILL),
    "interrupted": _interrupted,
    "a file that is gone": _lost,
    "the end of a program": sys.exit,
    "another exit code": lambda: os._exit(0),
}


@pytest.mark.parametrize("answer", [True, False])
@pytest.mark.parametrize("end", ENDS)
def test_a_process_that_comes_to_no_answer(forking: None, end: str, answer: bool) -> None:
    asked = Asked(first=answer, elsewhere=ENDS[end])
    assert asked.both() is answer
    assert asked.here == ["second", "first"]


def test_a_process_that_can_not_be_made(forking: None, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse() -> int:
        raise BlockingIOError

    monkeypatch.setattr(os, "fork", refuse)
    asked = Asked()
    assert asked.both()
    assert asked.here == ["second", "first"]


def test_a_process_of_whose_end_nobody_hears(forking: None) -> None:
    """Whoever started this one may have said that it does not wait for its children."""
    before = signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    try:
        asked = Asked()
        assert asked.both()
    finally:
        signal.signal(signal.SIGCHLD, before)
    assert asked.here == ["second", "first"]


@pytest.mark.parametrize("error", [KeyboardInterrupt, FileNotFoundError])
def test_no_process_is_left_behind(forking: None, error: type[BaseException], monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[int] = []

    def fork(original: Callable[[], int] = os.fork) -> int:
        made.append(process := original())
        return process

    def fail() -> bool:
        raise error

    monkeypatch.setattr(os, "fork", fork)
    with pytest.raises(error):
        beside.both(lambda: True, fail)
    with pytest.raises(ChildProcessError):
        os.waitpid(made[0], os.WNOHANG)


def test_where_one_process_has_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    monkeypatch.setattr(os, "sched_getaffinity", lambda process: {0, 1}, raising=False)
    monkeypatch.setitem(sys.modules, "threading", sys)
    assert not beside._may_fork(), "there may be threads"
    monkeypatch.delitem(sys.modules, "threading")
    assert beside._may_fork()
    with monkeypatch.context() as patch:
        patch.setattr(os, "sched_getaffinity", lambda process: {1}, raising=False)
        assert not beside._may_fork(), "no other core"
    with monkeypatch.context() as patch:
        patch.delattr(os, "sched_getaffinity")
        assert beside._may_fork()
        patch.setattr(os, "cpu_count", lambda: None)
        assert not beside._may_fork()
    monkeypatch.delattr(os, "fork")
    assert not beside._may_fork()


PROGRAM = """
import atexit, os, sys
from urdfsync.stamping import beside

beside._may_fork = lambda: True
atexit.register(print, "end")
print("begin", end=" ")
here = os.getpid()
answer = beside.both(lambda: print("first") or os.getpid() != here, lambda: True)
print(answer, end=" ")
"""


def test_the_other_process_says_nothing() -> None:
    """Neither what was to be said before, nor what it says itself, nor what is said at the end of the program."""
    variables = {**os.environ, "PYTHONPATH": str(Path(urdfsync.__file__).parents[1]), "PYTHONUNBUFFERED": ""}
    done = subprocess.run([sys.executable, "-c", PROGRAM], env=variables, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "begin True end\n", "")
