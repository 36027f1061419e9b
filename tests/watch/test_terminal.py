"""The status at the bottom of a terminal: it is replaced, and nothing else is ever erased; what commands print."""

from __future__ import annotations

import os
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.text import Text
from support.daemon import REPOSITORY
from support.screen import Screen, print_on_terminal

from urdfsync.watch.terminal import StatusArea


@pytest.fixture(autouse=True)
def _terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm-256color")


def area(screen: Screen) -> StatusArea:
    result = StatusArea(screen)
    result.console.size = (screen.width, screen.height)
    return result


def write(found: StatusArea, lines: list[str], status: list[str]) -> None:
    found.write([Text(line) for line in lines], [Text(line) for line in status])


@pytest.mark.parametrize("width", [30, 60])
def test_after_a_resize_nothing_is_erased_but_status(width: int) -> None:
    screen = Screen(width=40)
    found = area(screen)
    write(found, ["one", "two"], ["a" * 39, "b" * 39])
    screen.width = width
    found.console.width = width
    write(found, ["three"], ["c" * 39])
    assert [row for row in screen.shown() if row in ("one", "two", "three")] == ["one", "two", "three"]
    assert screen.shown()[-1][:29] == "c" * 29


def test_while_a_shell_has_the_terminal_no_status_is_written(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-Z, then `bg`, and later `fg`."""
    screen, group = Screen(), os.getpgrp()
    found = area(screen)
    monkeypatch.setattr(screen, "fileno", lambda: 1)
    monkeypatch.setattr(os, "tcgetpgrp", lambda _: group + 1)
    write(found, ["one"], ["status"])
    assert screen.shown() == ["one"]
    monkeypatch.setattr(os, "tcgetpgrp", lambda _: group)
    write(found, ["two"], ["status"])
    assert screen.shown() == ["one", "two", "status"]


ROW = st.text("abc", max_size=25)


@given(st.lists(st.tuples(st.lists(ROW, max_size=4), st.lists(ROW, max_size=5)), max_size=12))
def test_scrollback_is_never_erased(steps: list[tuple[list[str], list[str]]]) -> None:
    screen = Screen(width=10, height=6)
    found = area(screen)
    written: list[str] = []
    for lines, status in steps:
        write(found, lines, status)
        written += [line[start : start + 10] for line in lines for start in range(0, max(len(line), 1), 10)]
    write(found, [], [])
    assert screen.shown() == "\n".join(written).rstrip("\n").split("\n")


# Commands on a real terminal

PROGRAM = r"""
import os, sys
from pathlib import Path
from urdfsync.watch import events
from urdfsync.output.console import Console
from urdfsync.watch.report import Report

with Report(Console()) as listener:
    listener.show(events.Started(Path("urdfsync.toml"), ("arm", "cart")))
    sys.stderr.write("a library warns\n")
    listener.show(events.Running("arm"))
    os.system(r"exec >&2; printf 'one\r\ntwo\n\n 10 %%\r100 %%\nthree\nfour\n'")
    listener.show(events.Ran("arm", 0))
os.system("echo after >&2")
"""


@pytest.mark.skipif(sys.platform == "win32", reason="needs a terminal of POSIX")
def test_what_commands_and_libraries_print_stays() -> None:
    screen, variables = Screen(60, 18), {"PYTHONPATH": str(REPOSITORY), "TERM": "xterm", "NO_COLOR": "1"}
    screen.write(print_on_terminal([sys.executable, "-c", PROGRAM], variables, (60, 18))[1])
    rows = screen.shown()
    assert rows[0].endswith("  watching 2 robots of urdfsync.toml")
    assert rows[1:] == ["a library warns", "one", "two", "", "100 %", "three", "four", "after"]
