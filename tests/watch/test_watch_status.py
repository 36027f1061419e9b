"""A status line per robot: what it says, and which lines are left where not all find room."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Actions, Kind
from urdfsync.engine.result import Checked, Result
from urdfsync.watch import events
from urdfsync.watch.status import Activity, StatusTable

BROKEN = Diagnostic(Severity.ERROR, "xml-syntax", "this is no\nXML", "arm.urdf", 12, 3)
ODD = Diagnostic(Severity.WARNING, "odd", "this is odd", "arm.urdf", 7)


def result(robot: str, *kinds: Kind, failed: bool = False, diagnostics: tuple[Diagnostic, ...] = ()) -> Result:
    actions = Actions(Action(f"modelica/Arm/F{number}.mo", kind, Role.RECORD) for number, kind in enumerate(kinds))
    return Result(robot, "Arm", Path("Arm"), Path(), actions, diagnostics, failed)


def started(*robots: str) -> events.Started:
    return events.Started(Path("urdfsync.toml"), robots)


def board(*found: events.Event, robots: tuple[str, ...] = ("arm",)) -> StatusTable:
    result = StatusTable()
    for number, event in enumerate((started(*robots), *found)):
        result.take(event, f"12:00:0{number}")
    return result


BUILT = events.Built(result("arm", Kind.UPDATE))
UNCHANGED = events.Built(result("arm", Kind.UNCHANGED))
CONFLICT = events.Built(result("arm", Kind.CONFLICT, Kind.UPDATE))
FAILED = events.Failed(result("arm", failed=True, diagnostics=(ODD, BROKEN)))


SETTLING, BUILDING = events.Settling("arm"), events.Building("arm")
CHECKING = events.Checking("arm")
RIGHT = events.CheckDone("arm", Checked.RIGHT, 2.5)
WRONG = events.CheckDone("arm", Checked.WRONG, 2.5, (ODD, BROKEN))
IS_BUILT, IS_BROKEN = "in step, built at 12:00:01", "error: arm.urdf:12: this is no XML"
IS_WRONG = "checked with errors: arm.urdf:12: this is no XML"


@pytest.mark.parametrize(
    ("found", "text"),
    [
        ([], "not looked at yet"),
        ([SETTLING], "settling"),
        ([events.Waiting("arm", "waiting for the exporter")], "waiting for the exporter"),
        (
            [events.Waiting("arm", "waiting for the exporter", (BROKEN,))],
            "waiting for the exporter: arm.urdf:12: this is no XML",
        ),
        ([BUILDING], "building"),
        ([BUILT], IS_BUILT),
        ([UNCHANGED], "in step"),
        ([FAILED], IS_BROKEN),
        ([CONFLICT], "conflict in F0.mo"),
        ([events.Built(result("arm", Kind.CONFLICT, Kind.UNOWNED))], "conflict in 2 files"),
        # a build that did nothing keeps the time of the last one
        ([BUILT, BUILDING, UNCHANGED], IS_BUILT),
        ([CONFLICT, UNCHANGED], "in step"),
        # one that calms down is as before
        ([BUILT, SETTLING, events.Unchanged("arm")], IS_BUILT),
        ([CONFLICT, SETTLING, events.Unchanged("arm")], "conflict in F0.mo"),
        ([FAILED, SETTLING, events.Unchanged("arm")], IS_BROKEN),
        # a check goes on beside the rest, and counts when it finds something that is not worse
        ([BUILT, CHECKING], "checking"),
        ([BUILT, CHECKING, RIGHT], IS_BUILT),
        ([BUILT, CHECKING, WRONG], IS_WRONG),
        ([BUILT, CHECKING, SETTLING], "settling"),
        ([BUILT, CHECKING, SETTLING, events.Unchanged("arm")], "checking"),
        ([BUILT, WRONG, BUILDING, UNCHANGED], IS_WRONG),
        ([BUILT, WRONG, CHECKING, RIGHT], IS_BUILT),
        ([CONFLICT, CHECKING], "conflict in F0.mo"),
        ([CONFLICT, WRONG], IS_WRONG),
        ([WRONG, FAILED], IS_BROKEN),
    ],
)
def test_the_status_of_a_robot(found: list[events.Event], text: str) -> None:
    (status,) = board(*found).rows.values()
    assert status.text == text


def test_a_new_configuration_brings_robots_and_takes_others_away() -> None:
    found = board(BUILT, WRONG, events.Settling("cart"), started("crane", "arm"), robots=("arm", "cart"))
    assert [(robot, status.text) for robot, status in found.rows.items()] == [
        ("crane", "not looked at yet"),
        ("arm", "in step, built at 12:00:01"),
    ]


def drawn(found: StatusTable, room: int) -> list[str]:
    return [str(line) for line in found.lines(room, marks=False)]


ACTIVITIES: dict[Activity, Callable[[str], events.Event]] = {
    Activity.ERROR: lambda robot: events.Failed(result(robot, failed=True)),
    Activity.CONFLICT: lambda robot: events.Built(result(robot, Kind.CONFLICT)),
    Activity.WAITING: lambda robot: events.Waiting(robot, "waiting"),
    Activity.BUILDING: events.Building,
    Activity.SETTLING: events.Settling,
    Activity.IN_STEP: lambda robot: events.Built(result(robot)),
}


@given(st.lists(st.sampled_from(sorted(ACTIVITIES)), min_size=1, max_size=12), st.integers(1, 12))
def test_nobody_is_hidden_behind_a_calmer_one(activities: list[Activity], room: int) -> None:
    robots = tuple(f"r{number:02}" for number in range(len(activities)))
    found = board(
        *(ACTIVITIES[activity](robot) for activity, robot in zip(activities, robots, strict=True)), robots=robots
    )
    lines = drawn(found, room)
    assert len(lines) <= room
    shown = [status for robot, status in found.rows.items() if any(line.startswith(robot) for line in lines)]
    hidden = [status for robot, status in found.rows.items() if not any(line.startswith(robot) for line in lines)]
    assert not hidden or f"and {len(hidden)} more" in lines[-1]
    order = list(Activity)
    assert all(order.index(one.activity) <= order.index(other.activity) for one in shown for other in hidden)
