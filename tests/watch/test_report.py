"""What people see on terminals and in pipes while the daemon runs: lines that scroll, and a status line per robot."""

from __future__ import annotations

import contextlib
import datetime
import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.screen import Screen

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.domain import ChangeClass, Role
from urdfsync.domain import ChangeKind as Event
from urdfsync.domain.changes import Change
from urdfsync.domain.comparison import Changes
from urdfsync.engine.actions import Action, Actions, Reason
from urdfsync.engine.result import Checked, Result
from urdfsync.output.console import Console
from urdfsync.watch import events, report
from urdfsync.watch.report import Activity, Report

PAGE = (Path(__file__).parents[2] / "docs" / "watch.md").read_text(encoding="utf-8")
BROKEN = Diagnostic(Severity.ERROR, "xml-syntax", "this is no\nXML", "arm.urdf", 12)
ODD = Diagnostic(Severity.WARNING, "odd", "this is odd", "arm.urdf", 7)

Terminal = Callable[..., Screen]


@pytest.fixture(autouse=True)
def _terminal(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm-256color")
    clock(monkeypatch, "14:03:12")


def clock(monkeypatch: pytest.MonkeyPatch, time: str) -> None:
    moment = datetime.datetime.fromisoformat(f"2026-03-04T{time}+01:00")
    monkeypatch.setattr(report, "now", lambda: moment)


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


def look(terminal: Terminal, *found: events.Event, robots: Sequence[str] = ("arm", "gripper")) -> list[str]:
    """Show events on a terminal; what is on it then, but for the first line."""
    screen = terminal()
    tell(Report(Console()), started(*robots), *found)
    return screen.shown()[1:]


def tell(people: Report, *found: events.Event) -> None:
    for event in found:
        people.show(event)


def started(*robots: str) -> events.Started:
    return events.Started(Path("urdfsync.toml"), robots)


def built(robot: str, *kinds: Reason, **more: Any) -> events.Built:
    actions = Actions(Action(f"modelica/Arm/F{number}.mo", kind, Role.RECORD) for number, kind in enumerate(kinds))
    return events.Built(
        Result(
            robot=robot,
            package="Arm",
            folder=Path("Arm"),
            root=Path(),
            actions=actions,
            writes=Reason.UPDATE in kinds,
            **more,
        ),
        (Path("x"),) * (Reason.UPDATE in kinds),
    )


def failed(robot: str, *diagnostics: Diagnostic) -> events.Failed:
    return events.Failed(
        Result(robot=robot, package="Arm", folder=Path("Arm"), root=Path(), diagnostics=diagnostics, failed=True)
    )


BUILT, UNCHANGED = built("arm", Reason.UPDATE), built("arm", Reason.UNCHANGED)
CONFLICT, FAILED = built("arm", Reason.CONFLICT, Reason.UPDATE), failed("arm", ODD, BROKEN)
SETTLING, BUILDING, CALM = events.Settling("arm"), events.Building("arm"), events.Unchanged("arm")
CHECKING, RIGHT = events.Checking("arm"), events.CheckDone("arm", Checked.RIGHT, 2.5)
WRONG = events.CheckDone("arm", Checked.WRONG, 2.5, (ODD, BROKEN))


def test_the_page_shows_what_a_terminal_shows(terminal: Terminal, monkeypatch: pytest.MonkeyPatch) -> None:
    def change(element: str, path: str, new: float) -> Change:
        return Change((element, *path.split(" / ")), Event.CHANGED, ChangeClass.PARAMETER, 1.2, new, "kg")

    (example,) = re.findall(r"```text\n(.*?)\n```", PAGE, re.DOTALL)
    start, *moments = re.findall(r"^\d\d:\d\d:\d\d", example, re.MULTILINE)
    clock(monkeypatch, start)
    mass = [change(f"link {name}", "inertial / mass", 1.35 + index) for index, name in enumerate(("elbow", "a", "b"))]
    inertia = [change("link a", f"inertial / inertia / {name}", 2.0) for name in ("ixx", "iyy")]
    renamed = Change(("link tool",), Event.RENAMED, ChangeClass.STRUCTURAL, "tool", "probe")
    broken = Diagnostic(Severity.ERROR, "xml-syntax", "this is not well-formed XML", "cad/cart.urdf", 47, 30)
    screen, people = terminal(110), Report(Console())
    tell(people, started("arm", "crane", "gripper", "cart"))
    found = (
        built("arm", *2 * [Reason.UPDATE], changes=Changes((mass[0],))),
        built("gripper", *4 * [Reason.UPDATE], changes=Changes((*mass, *inertia))),
        built("arm", *4 * [Reason.UPDATE], Reason.MOVE, changes=Changes((renamed,))),
        failed("cart", broken),
    )
    for event, moment in zip(found, moments, strict=True):
        clock(monkeypatch, moment)
        tell(people, event)
    tell(people, events.Waiting("crane", "waiting for the exporter of cad/crane.urdf"))
    assert "\n".join(screen.shown()).replace("F4.mo", "Links/Probe.mo") == example


def test_errors_appear_above_the_status_too(terminal: Terminal) -> None:
    assert look(terminal, built("gripper", Reason.UNCHANGED), FAILED, events.Paused("pre-commit runs")) == [
        "14:03:12  arm      1 error, nothing was changed",
        "arm.urdf:7: warning: this is odd [odd]",
        "arm.urdf:12: error: this is no XML [xml-syntax]",
        "",
        "paused: pre-commit runs",
        "✗ arm      error: arm.urdf:12: this is no XML",
        "✓ gripper  in step",
    ]


def test_of_many_robots_those_are_shown_that_need_attention(terminal: Terminal) -> None:
    robots = ("arm", "crane" * 10, *(f"cart{number}" for number in range(58)))
    rows = look(terminal, *map(built, robots), FAILED, events.Settling("cart40"), robots=robots)
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
    with contextlib.suppress(ValueError), Report(Console()) as people:
        tell(people, started("arm"), BUILT)
        raise ValueError("a bug")
    assert screen.shown()[1:] == ["14:03:12  arm  1 file written"]
    assert screen.rows[-1] == ""


def test_a_command_has_the_terminal_for_itself_and_stopping_takes_the_status_away(terminal: Terminal) -> None:
    assert look(terminal, built("arm"), events.Running("arm")) == []
    assert look(terminal, built("arm"), events.Running("arm"), events.Ran("arm", 0))[-2] == "✓ arm      in step"
    assert look(terminal, built("arm"), events.Stopping("SIGINT")) == ["14:03:12  stopped by SIGINT"]


def test_colours_obey_no_color(terminal: Terminal, monkeypatch: pytest.MonkeyPatch) -> None:
    coloured = terminal()
    tell(Report(Console()), started("arm"), BUILT)
    assert "\x1b[32m" in coloured.getvalue()
    monkeypatch.setenv("NO_COLOR", "1")
    plain = terminal()
    tell(Report(Console()), started("arm"), BUILT)
    assert not re.search(r"\x1b\[[\d;]*m", plain.getvalue())
    assert plain.shown() == coloured.shown()


def test_a_pipe_has_lines_only_and_errors_go_their_way(capsys: pytest.CaptureFixture[str]) -> None:
    with Report(Console()) as people:
        tell(people, started("arm"), BUILT, FAILED)
    out, err = capsys.readouterr()
    assert out.splitlines() == ["14:03:12  watching 1 robot of urdfsync.toml", "14:03:12  arm  1 file written"]
    assert err.splitlines()[-1] == "arm.urdf:12: error: this is no XML [xml-syntax]"


# The status of each robot


def status(*found: events.Event, robots: Sequence[str] = ("arm",)) -> Report:
    result = Report(Console())
    for number, event in enumerate((started(*robots), *found)):
        list(result.take(event, f"12:00:0{number}"))
    return result


IS_BUILT, IS_BROKEN = "in step, built at 12:00:01", "error: arm.urdf:12: this is no XML"
IS_WRONG = "checked with errors: arm.urdf:12: this is no XML"
WAITING = "waiting for the exporter"


@pytest.mark.parametrize(
    ("found", "text"),
    [
        ([], "not looked at yet"),
        ([SETTLING], "settling"),
        ([events.Waiting("arm", WAITING)], WAITING),
        ([events.Waiting("arm", WAITING, (BROKEN,))], f"{WAITING}: arm.urdf:12: this is no XML"),
        ([BUILDING], "building"),
        ([BUILT], IS_BUILT),
        ([UNCHANGED], "in step"),
        ([FAILED], IS_BROKEN),
        ([CONFLICT], "conflict in F0.mo: run `urdfsync resolve`"),
        ([built("arm", Reason.CONFLICT, Reason.UNOWNED)], "conflict in 2 files: run `urdfsync resolve`"),
        # a build that did nothing keeps the time of the last one
        ([BUILT, BUILDING, UNCHANGED], IS_BUILT),
        ([CONFLICT, UNCHANGED], "in step"),
        # one that calms down is as before
        ([BUILT, SETTLING, CALM], IS_BUILT),
        ([CONFLICT, SETTLING, CALM], "conflict in F0.mo: run `urdfsync resolve`"),
        ([FAILED, SETTLING, CALM], IS_BROKEN),
        # a check goes on beside the rest, and counts when it finds something that is not worse
        ([BUILT, CHECKING], "checking"),
        ([BUILT, CHECKING, RIGHT], IS_BUILT),
        ([BUILT, CHECKING, WRONG], IS_WRONG),
        ([BUILT, CHECKING, SETTLING], "settling"),
        ([BUILT, CHECKING, SETTLING, CALM], "checking"),
        ([BUILT, WRONG, BUILDING, UNCHANGED], IS_WRONG),
        ([BUILT, WRONG, CHECKING, RIGHT], IS_BUILT),
        ([CONFLICT, CHECKING], "conflict in F0.mo: run `urdfsync resolve`"),
        ([CONFLICT, WRONG], IS_WRONG),
        ([WRONG, FAILED], IS_BROKEN),
        # another configuration
        ([BUILT, WRONG, SETTLING, started("arm", "crane")], "settling"),
        ([BUILT, WRONG, started("arm", "crane")], IS_BUILT),
        ([SETTLING, started("crane"), started("arm")], "not looked at yet"),
    ],
)
def test_the_status_of_a_robot(found: list[events.Event], text: str) -> None:
    assert status(*found).rows["arm"].text == text


ACTIVITIES: dict[Activity, Callable[[str], events.Event]] = {
    Activity.ERROR: failed,
    Activity.CONFLICT: lambda robot: built(robot, Reason.CONFLICT),
    Activity.WAITING: lambda robot: events.Waiting(robot, "waiting"),
    Activity.BUILDING: events.Building,
    Activity.SETTLING: events.Settling,
    Activity.IN_STEP: built,
}


@given(st.lists(st.sampled_from(sorted(ACTIVITIES)), min_size=1, max_size=12), st.integers(1, 12))
def test_nobody_is_hidden_behind_a_calmer_one(activities: list[Activity], room: int) -> None:
    robots = [f"r{number:02}" for number in range(len(activities))]
    found = status(*(ACTIVITIES[one](robot) for one, robot in zip(activities, robots, strict=True)), robots=robots)
    lines = list(map(str, found.status_lines(room, marks=False)))
    assert len(lines) <= room
    shown = {robot for robot in robots if any(line.startswith(robot) for line in lines)}
    hidden = set(robots) - shown
    assert not hidden or f"and {len(hidden)} more" in lines[-1]
    ranks = {robot: list(Activity).index(row.activity) for robot, row in found.rows.items()}
    assert all(ranks[one] <= ranks[other] for one in shown for other in hidden)
