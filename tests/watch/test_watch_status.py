"""A status line per robot: what it says, and which lines are left where not all find room."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Actions, Kind
from urdfsync.outcome import Checked, Result
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


def words(*found: events.Event) -> str:
    (status,) = board(*found).rows.values()
    return status.text


BUILT = events.Built(result("arm", Kind.UPDATE))
UNCHANGED = events.Built(result("arm", Kind.UNCHANGED))
CONFLICT = events.Built(result("arm", Kind.CONFLICT, Kind.UPDATE))
FAILED = events.Failed(result("arm", failed=True, diagnostics=(ODD, BROKEN)))


def test_a_robot_on_its_way() -> None:
    assert words() == "not looked at yet"
    assert words(events.Settling("arm")) == "settling"
    assert words(events.Waiting("arm", "waiting for the exporter")) == "waiting for the exporter"
    waiting = events.Waiting("arm", "waiting for the exporter", (BROKEN,))
    assert words(waiting) == "waiting for the exporter: arm.urdf:12: this is no XML"
    assert words(events.Building("arm")) == "building"
    assert words(BUILT) == "in step, built at 12:00:01"
    assert words(UNCHANGED) == "in step"
    assert words(FAILED) == "error: arm.urdf:12: this is no XML"


def test_a_conflict_names_its_file_or_says_how_many() -> None:
    assert words(CONFLICT) == "conflict in F0.mo"
    assert words(events.Built(result("arm", Kind.CONFLICT, Kind.UNOWNED))) == "conflict in 2 files"


def test_a_build_that_did_nothing_keeps_the_time_of_the_last_one() -> None:
    assert words(BUILT, events.Building("arm"), UNCHANGED) == "in step, built at 12:00:01"
    assert words(CONFLICT, UNCHANGED) == "in step"


def test_a_robot_that_calms_down_stands_as_before() -> None:
    for before in (BUILT, CONFLICT, FAILED):
        assert words(before, events.Settling("arm")) == "settling"
        assert words(before, events.Settling("arm"), events.Unchanged("arm")) == words(before)


RIGHT = events.CheckDone("arm", Checked.RIGHT, 2.5)
WRONG = events.CheckDone("arm", Checked.WRONG, 2.5, (ODD, BROKEN))
CHECKING = events.Checking("arm")


def test_a_check_goes_on_beside_the_rest_and_counts_when_it_finds_something() -> None:
    built, wrong = words(BUILT), "checked with errors: arm.urdf:12: this is no XML"
    assert words(BUILT, CHECKING) == "checking"
    assert words(BUILT, CHECKING, RIGHT) == built
    assert words(BUILT, CHECKING, WRONG) == wrong
    assert words(BUILT, CHECKING, events.Settling("arm")) == "settling"
    assert words(BUILT, CHECKING, events.Settling("arm"), events.Unchanged("arm")) == "checking"
    assert words(BUILT, WRONG, events.Building("arm"), UNCHANGED) == wrong
    assert words(BUILT, WRONG, CHECKING, RIGHT) == built


def test_what_a_check_found_yields_to_what_is_worse() -> None:
    assert words(CONFLICT, CHECKING) == "conflict in F0.mo"
    assert words(CONFLICT, WRONG).startswith("checked with errors")
    assert words(WRONG, FAILED) == "error: arm.urdf:12: this is no XML"


def test_a_new_configuration_brings_robots_and_takes_others_away() -> None:
    found = board(BUILT, WRONG, events.Settling("cart"), started("crane", "arm"), robots=("arm", "cart"))
    assert [(robot, status.text) for robot, status in found.rows.items()] == [
        ("crane", "not looked at yet"),
        ("arm", "in step, built at 12:00:01"),
    ]


def test_where_not_all_find_room_those_that_need_attention_do_in_their_usual_order() -> None:
    robots = tuple(f"r{number}" for number in range(60))
    found = board(*(events.Built(result(robot)) for robot in robots), robots=robots)
    found.take(events.Settling("r10"), "")
    found.take(events.Built(result("r50", Kind.CONFLICT)), "")
    found.take(events.Failed(result("r55", failed=True)), "")
    assert drawn(found, 6) == [
        "",
        "r0   in step",
        "r10  settling",
        "r50  conflict in F0.mo",
        "r55  error",
        "… and 56 more: 56 in step",
    ]
    assert drawn(found, 3) == ["r50  conflict in F0.mo", "r55  error", "… and 58 more: 1 settling, 57 in step"]


def drawn(found: StatusTable, room: int) -> list[str]:
    return [line.plain for line in found.lines(room, marks=False)]


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
