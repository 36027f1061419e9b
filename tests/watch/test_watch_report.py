"""What people see on terminals and in pipes while the daemon runs, and what programs read."""

from __future__ import annotations

import contextlib
import datetime
import io
import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest
from support.screen import Screen

from urdfsync.changes import Change, Changes
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import ChangeClass, Role
from urdfsync.domain import ChangeKind as Event
from urdfsync.engine.actions import Action, Actions, Kind
from urdfsync.engine.result import Result
from urdfsync.output.console import Console
from urdfsync.watch import events, report
from urdfsync.watch.report import TextReport

PAGE = (Path(__file__).parents[2] / "docs" / "watch.md").read_text(encoding="utf-8")
BROKEN = Diagnostic(Severity.ERROR, "xml-syntax", "this is no XML", "arm.urdf", 12)


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setattr(report, "now", clock)


Terminal = Callable[..., Screen]


@pytest.fixture
def terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    """A function that makes both streams a terminal of 60 columns, or so many, and 18 rows."""

    def made(width: int = 60) -> Screen:
        found = Screen(width, 18)
        monkeypatch.setenv("COLUMNS", str(width))
        monkeypatch.setenv("LINES", "18")
        monkeypatch.setattr(sys, "stdout", found)
        monkeypatch.setattr(sys, "stderr", found)
        return found

    return made


def clock() -> datetime.datetime:
    return datetime.datetime(2026, 3, 4, 14, 3, 12, tzinfo=datetime.timezone(datetime.timedelta(hours=1)))


def result(robot: str, *kinds: Kind, **more: Any) -> Result:
    actions = Actions(Action(f"modelica/Arm/F{number}.mo", kind, Role.RECORD) for number, kind in enumerate(kinds))
    return Result(robot, "Arm", Path("Arm").absolute(), Path.cwd(), actions, **more)


def built(robot: str, *kinds: Kind) -> events.Built:
    return events.Built(result(robot, *kinds), (Path("x"),) if Kind.UPDATE in kinds else ())


FAILED = events.Failed(result("arm", failed=True, diagnostics=(BROKEN,)))


Look = Callable[..., list[str]]


@pytest.fixture
def look(terminal: Terminal) -> Look:
    """A function that shows events on a terminal, and gives what is on it then."""

    def shown(*found: events.Event, robots: tuple[str, ...] = ("arm", "gripper"), **options: Any) -> list[str]:
        screen = terminal()
        tell(TextReport(Console(**options)), *found, robots=robots)
        return screen.shown()

    return shown


def tell(people: TextReport, *found: events.Event, robots: tuple[str, ...] = ("arm",)) -> None:
    for event in (events.Started(Path("urdfsync.toml"), robots), *found):
        people.show(event)


def test_a_line_per_robot_stays_below_what_scrolls(look: Look) -> None:
    assert look(built("gripper", Kind.UPDATE), events.Settling("arm")) == [
        "14:03:12  watching 2 robots of urdfsync.toml",
        "14:03:12  gripper  1 file written",
        "",
        "… arm      settling",
        "✓ gripper  in step, built at 14:03:12",
    ]


def test_the_page_shows_what_a_terminal_shows(terminal: Terminal, monkeypatch: pytest.MonkeyPatch) -> None:
    (example,) = re.findall(r"```text\n(.*?)\n```", PAGE, re.DOTALL)
    moments = iter(re.findall(r"^\d\d:\d\d:\d\d", example, re.MULTILINE))
    screen = terminal(110)
    people = TextReport(Console())
    mass = [
        change(f"link {name}", "inertial / mass", 1.2, 1.35 + index) for index, name in enumerate(("elbow", "a", "b"))
    ]
    inertia = [change("link a", f"inertial / inertia / {name}", 1.0, 2.0) for name in ("ixx", "iyy")]
    renamed = Change(("link tool",), Event.RENAMED, ChangeClass.STRUCTURAL, "tool", "probe")
    files = [Action(f"F{number}.mo", Kind.UPDATE, role) for number, role in enumerate([Role.RECORD, *3 * [Role.MODEL]])]
    moved = Action("Links/Probe.mo", Kind.MOVE, Role.MODEL, origin="Links/Tool.mo")
    broken = Diagnostic(Severity.ERROR, "xml-syntax", "this is not well-formed XML", "cad/cart.urdf", 47, 30)
    for event in (
        events.Started(Path("urdfsync.toml"), ("arm", "crane", "gripper", "cart")),
        told("arm", [*2 * [Action("F.mo", Kind.UPDATE, Role.RECORD)]], mass[:1]),
        told("gripper", [*4 * [Action("F.mo", Kind.UPDATE, Role.RECORD)]], [*mass, *inertia]),
        told("arm", [*files, moved], [renamed]),
        events.Failed(result("cart", failed=True, diagnostics=(broken,))),
    ):
        moment = datetime.datetime.fromisoformat(f"2026-03-04T{next(moments)}+01:00")
        monkeypatch.setattr(report, "now", lambda moment=moment: moment)
        people.show(event)
    people.show(events.Waiting("crane", "waiting for the exporter"))
    assert "\n".join(screen.shown()) == example


def change(element: str, path: str, old: float, new: float) -> Change:
    return Change((element, *path.split(" / ")), Event.CHANGED, ChangeClass.PARAMETER, old, new, "kg")


def told(robot: str, actions: Sequence[Action], changes: Sequence[Change]) -> events.Built:
    """A build with these changes."""
    found = Result(robot, "Arm", Path("Arm"), Path(), Actions(actions), changes=Changes(tuple(changes)))
    return events.Built(found, (Path("F.mo"),))


def test_errors_appear_above_the_status_too(look: Look) -> None:
    assert look(built("gripper", Kind.UNCHANGED), FAILED, events.Paused("pre-commit runs")) == [
        "14:03:12  watching 2 robots of urdfsync.toml",
        "14:03:12  arm      1 error, nothing was changed",
        "arm.urdf:12: error: this is no XML [xml-syntax]",
        "",
        "paused: pre-commit runs",
        "✗ arm      error: arm.urdf:12: this is no XML",
        "✓ gripper  in step",
    ]


def test_of_many_robots_those_are_shown_that_need_attention(look: Look) -> None:
    robots = ("arm", "crane" * 10, *(f"cart{number}" for number in range(58)))
    rows = look(*(built(robot) for robot in robots), FAILED, events.Settling("cart40"), robots=robots)
    assert rows[-6:] == [
        "",
        "✗ arm                       error: arm.urdf:12: this is no XML"[:59] + "…",
        "✓ cranecranecranecranecra…  in step",
        "✓ cart0                     in step",
        "… cart40                    settling",
        "… and 56 more: 56 in step",
    ]


def test_the_terminal_is_left_in_order_whatever_happens(terminal: Terminal) -> None:
    screen = terminal()
    people = TextReport(Console())
    with contextlib.suppress(ValueError), people:
        tell(people, built("arm", Kind.UPDATE))
        raise ValueError("a bug")
    assert screen.shown()[1:] == ["14:03:12  arm  1 file written"]
    assert screen.rows[-1] == ""


def test_a_command_has_the_terminal_for_itself(look: Look) -> None:
    assert look(built("arm"), events.Running("arm"))[1:] == []
    assert look(built("arm"), events.Running("arm"), events.Ran("arm", 0), robots=("arm",))[-1] == "✓ arm  in step"


def test_stopping_takes_the_status_away(look: Look) -> None:
    assert look(built("arm"), events.Stopping("SIGINT"))[1:] == ["14:03:12  stopped by SIGINT"]


def test_colours_obey_no_color(terminal: Terminal, monkeypatch: pytest.MonkeyPatch) -> None:
    coloured = terminal()
    tell(TextReport(Console()), built("arm"))
    assert "\x1b[32m" in coloured.getvalue()
    monkeypatch.setenv("NO_COLOR", "1")
    plain = terminal()
    tell(TextReport(Console()), built("arm"))
    assert not re.search(r"\x1b\[[\d;]*m", plain.getvalue())
    assert plain.shown() == coloured.shown()


def test_a_pipe_has_lines_only_and_errors_go_their_way(capsys: pytest.CaptureFixture[str]) -> None:
    with TextReport(Console()) as people:
        tell(people, built("arm", Kind.UPDATE), FAILED)
    streams = capsys.readouterr()
    assert [line[8:] for line in streams.out.splitlines()] == [
        "  watching 1 robot of urdfsync.toml",
        "  arm  1 file written",
    ]
    assert streams.err.splitlines()[1] == "arm.urdf:12: error: this is no XML [xml-syntax]"


def test_an_error_stream_elsewhere_gets_the_errors(terminal: Terminal, monkeypatch: pytest.MonkeyPatch) -> None:
    screen, elsewhere = terminal(), io.StringIO()
    monkeypatch.setattr(sys, "stderr", elsewhere)
    tell(TextReport(Console()), FAILED)
    assert screen.shown()[1:] == ["", "✗ arm  error: arm.urdf:12: this is no XML"]
    assert elsewhere.getvalue().splitlines()[1] == "arm.urdf:12: error: this is no XML [xml-syntax]"
