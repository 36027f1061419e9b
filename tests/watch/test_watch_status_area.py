"""The status at the bottom of a terminal: it is replaced, and nothing else is ever erased."""

from __future__ import annotations

import io
import os
import signal
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.text import Text
from support.screen import Screen

from urdfsync.watch.status_area import StatusArea


@pytest.fixture(autouse=True)
def _terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm-256color")


def area(screen: Screen, *, status: bool = True) -> StatusArea:
    result = StatusArea(screen, status=status)
    result.console.size = (screen.width, screen.height)
    return result


def write(found: StatusArea, lines: list[str], status: list[str] | None = None) -> None:
    found.write([Text(line) for line in lines], None if status is None else [Text(line) for line in status])


def test_lines_scroll_above_the_status() -> None:
    screen = Screen()
    found = area(screen)
    write(found, ["one"], ["arm settling", "cart in step"])
    write(found, ["two", "three"])
    assert screen.shown() == ["one", "two", "three", "arm settling", "cart in step"]
    write(found, [], ["arm in step"])
    assert screen.shown() == ["one", "two", "three", "arm in step"]
    found.close()
    assert screen.shown() == ["one", "two", "three"]


def test_each_change_is_written_at_once() -> None:
    screen = Screen()
    found = area(screen)
    write(found, ["one", "two"], ["status"])
    write(found, ["three", "four"], ["another"])
    assert screen.writes == 2


def test_the_cursor_stays_visible_and_below() -> None:
    screen = Screen()
    found = area(screen)
    write(found, [], ["status"])
    assert "\x1b[?25l" not in screen.getvalue()
    screen.write("^C")
    write(found, ["stopped"], [])
    assert screen.shown() == ["stopped"]


def test_long_lines_are_the_terminals_matter_and_a_long_status_is_cut() -> None:
    screen = Screen(width=20)
    found = area(screen)
    write(found, ["x" * 30], ["y" * 30])
    assert screen.shown() == ["x" * 20, "x" * 10, "y" * 19 + "…"]
    wide = Screen(width=200)
    write(area(wide), ["x" * 150], ["y" * 150])
    assert [len(row) for row in wide.shown()] == [150, 79]


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


def test_on_a_lower_terminal_there_is_less_room() -> None:
    assert [area(Screen(height=height)).room for height in (60, 24, 12, 9, 4, 2)] == [20, 8, 4, 4, 3, 1]


def test_no_status_unless_people_look(monkeypatch: pytest.MonkeyPatch) -> None:
    pipe = io.StringIO()
    write(StatusArea(pipe), ["one"], ["status"])
    assert pipe.getvalue() == "one\n"
    screen = Screen()
    write(area(screen, status=False), ["one"], ["status"])
    assert screen.shown() == ["one"]
    monkeypatch.setenv("TERM", "dumb")
    screen = Screen()
    write(area(screen), ["one"], ["status"])
    assert screen.getvalue() == "one\n"


def test_in_the_background_only_lines_are_written(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = Screen()
    found = area(screen)
    monkeypatch.setattr(screen, "fileno", lambda: 1)
    group = os.getpgrp()
    monkeypatch.setattr(os, "tcgetpgrp", lambda _: group)
    write(found, ["one"], ["status"])
    monkeypatch.setattr(os, "tcgetpgrp", lambda _: group + 1)
    screen.write("$ of a shell\n")
    write(found, ["two"], ["status 2"])
    assert screen.shown() == ["one", "status", "$ of a shell", "two"]
    monkeypatch.setattr(os, "tcgetpgrp", lambda _: group)
    write(found, [])
    assert screen.shown() == ["one", "status", "$ of a shell", "two", "status 2"]


@pytest.mark.skipif(sys.platform == "win32", reason="programs can't be stopped and continued")
def test_a_program_that_is_continued_leaves_alone_what_was_written_meanwhile() -> None:
    screen = Screen()
    found = area(screen)
    before = signal.getsignal(signal.SIGCONT)
    found.start()
    write(found, ["one"], ["status"])
    screen.write("stopped\n$ fg\n")
    os.kill(os.getpid(), signal.SIGCONT)
    assert screen.shown() == ["one", "status", "stopped", "$ fg", "status"]
    found.close()
    assert screen.shown() == ["one", "status", "stopped", "$ fg"]
    assert signal.getsignal(signal.SIGCONT) == before


ROW = st.text("abc", max_size=25)


@given(st.lists(st.tuples(st.lists(ROW, max_size=4), st.none() | st.lists(ROW, max_size=5)), max_size=12))
def test_scrollback_is_never_erased(steps: list[tuple[list[str], list[str] | None]]) -> None:
    screen = Screen(width=10, height=6)
    found = area(screen)
    written: list[str] = []
    for lines, status in steps:
        write(found, lines, status and status[:5])
        written += [line[start : start + 10] for line in lines for start in range(0, max(len(line), 1), 10)]
    found.close()
    assert screen.shown() == "\n".join(written).rstrip("\n").split("\n")
