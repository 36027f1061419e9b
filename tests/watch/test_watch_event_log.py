"""The lines that scroll: what is said, what only if somebody asks, and what is not said again."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console as Screen

from urdfsync.changes import Change, Changes
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import ChangeClass, Role
from urdfsync.domain import ChangeKind as Event
from urdfsync.engine.actions import Action, Actions, Kind
from urdfsync.engine.result import Checked, Result
from urdfsync.output.console import Console
from urdfsync.watch import events
from urdfsync.watch.event_log import EventLog

BROKEN = Diagnostic(Severity.ERROR, "xml-syntax", "this is no XML", "arm.urdf", 12, 3, "correct it")
ODD = Diagnostic(Severity.WARNING, "odd", "this is odd", "arm.urdf", 7)
HEAVIER = Changes((Change(("link elbow", "mass"), Event.CHANGED, ChangeClass.PARAMETER, 1.2, 1.35, "kg"),))
ELBOW = "modelica/Arm/Links/Elbow.mo"


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def built(*actions: Action, recovered: bool = False, **more: Any) -> events.Built:
    files = tuple(Path(action.path).absolute() for action in actions if action.writes)
    return events.Built(Result("arm", "Arm", Path("Arm"), Path(), Actions(actions), **more), files, recovered)


def failed(*diagnostics: Diagnostic, again: bool = False) -> events.Failed:
    return events.Failed(Result("arm", "Arm", Path("Arm"), Path(), diagnostics=diagnostics, failed=True), again)


def action(kind: Kind, mine: str = "mine", generated: str = "generated") -> Action:
    return Action(ELBOW, kind, Role.RECORD, "link elbow", "base", generated, mine=mine)


STARTED = events.Started(Path("urdfsync.toml"), ("arm", "gripper"))
UPDATED = built(action(Kind.UPDATE), changes=HEAVIER)
IN_STEP = built(action(Kind.UNCHANGED))
CONFLICT = built(action(Kind.CONFLICT))


def told(*found: events.Event, **options: Any) -> list[str]:
    """The lines of these events; those for the error stream begin with `!`."""
    log = EventLog(Console(**options), Screen(file=io.StringIO(), width=100))
    lines = [line for event in found for line in log.lines(event, "14:03:12")]
    return [f"{'! ' if line.error else ''}{str(line.text).rstrip()}" for line in lines]


def test_a_build_is_one_line_with_robots_in_a_column() -> None:
    assert told(STARTED, UPDATED) == [
        "14:03:12  watching 2 robots of urdfsync.toml",
        "14:03:12  arm      link elbow: mass 1.2 → 1.35 kg (+12.5 %), 1 file written",
    ]


def test_what_goes_on_between_builds_is_for_those_who_ask() -> None:
    busy = (
        events.Settling("arm"),
        events.Waiting("arm", "waiting for the exporter", (BROKEN,)),
        events.Unchanged("arm"),
        events.Building("arm"),
        IN_STEP,
        events.Ran("arm", 0),
        events.Paused("pre-commit runs"),
        events.Resumed(),
    )
    assert told(*busy) == []
    assert told(*busy, verbose=True) == [
        "14:03:12  arm  changed, settling",
        "14:03:12  arm  waiting for the exporter",
        "! arm.urdf:12:3: error: this is no XML; correct it [xml-syntax]",
        "14:03:12  arm  as before",
        "14:03:12  arm  building",
        "14:03:12  arm  in step, 1 file",
        "14:03:12  arm  command ended with 0",
        "14:03:12  paused: pre-commit runs",
        "14:03:12  building again",
    ]


def test_a_verbose_build_lists_changes_and_files() -> None:
    assert told(UPDATED, verbose=True) == [
        "14:03:12  arm  link elbow: mass 1.2 → 1.35 kg (+12.5 %), 1 file written",
        "  link elbow: mass 1.2 → 1.35 kg (+12.5 %)",
        f"  update     {ELBOW}  link elbow: mass 1.2 → 1.35 kg (+12.5 %)",
    ]


def test_an_error_is_told_once_and_so_is_its_end() -> None:
    lines = told(failed(BROKEN), failed(BROKEN, again=True), built(action(Kind.UNCHANGED), recovered=True), IN_STEP)
    assert lines == [
        "! 14:03:12  arm  1 error, nothing was changed",
        "! arm.urdf:12:3: error: this is no XML; correct it [xml-syntax]",
        "14:03:12  arm  in step again",
    ]
    recovered = built(action(Kind.UPDATE), changes=HEAVIER, recovered=True)
    assert told(failed(BROKEN), recovered)[-1].endswith("1 file written, in step again")


NO_CLASS = Diagnostic(Severity.ERROR, "compile", "there is no class `Foo`", ELBOW, 4)
CHECKED = events.CheckDone("arm", Checked.RIGHT, 2.54)
WRONG = events.CheckDone("arm", Checked.WRONG, 2.54, (NO_CLASS,))


def test_a_check_is_one_line_and_what_holds_is_not_said_again() -> None:
    wrong = [f"! {ELBOW}:4: error: there is no class `Foo` [compile]"]
    assert told(events.Checking("arm"), CHECKED) == ["14:03:12  arm  checked: compiles (2.5 s)"]
    assert told(WRONG, WRONG, CHECKED) == [
        "! 14:03:12  arm  checked: 1 error (2.5 s)",
        *wrong,
        "! 14:03:12  arm  checked: 1 error (2.5 s)",
        "14:03:12  arm  checked: compiles (2.5 s)",
    ]
    assert told(CHECKED, WRONG, CHECKED, WRONG, quiet=True) == ["! 14:03:12  arm  checked: 1 error (2.5 s)", *wrong] * 2
    assert told(events.Checking("arm"), verbose=True) == ["14:03:12  arm  checking"]


def test_what_was_known_of_a_package_took_no_time() -> None:
    assert told(events.CheckDone("arm", Checked.RIGHT)) == ["14:03:12  arm  checked: compiles"]


def test_what_could_not_be_checked_is_a_warning() -> None:
    lacking = Diagnostic(Severity.WARNING, "no-compiler", "there is no compiler", hint="install it")
    assert told(events.CheckDone("arm", Checked.INCOMPLETE, 0.0, (lacking,))) == [
        "14:03:12  arm  not checked completely",
        "! warning: there is no compiler; install it [no-compiler]",
    ]


def test_conflicts_are_shown_as_in_build_and_only_once() -> None:
    first = told(CONFLICT)
    assert first[0] == "14:03:12  arm  1 conflict"
    assert f"  conflict   {ELBOW}  link elbow" in first
    assert f"    urdfsync resolve {ELBOW} --keep" in first
    assert told(CONFLICT, CONFLICT) == first
    other = built(action(Kind.CONFLICT, generated="other"))
    assert told(CONFLICT, other) == first + first
    again = built(action(Kind.CONFLICT), changes=HEAVIER)
    assert told(CONFLICT, again)[len(first) :] == [
        "14:03:12  arm  link elbow: mass 1.2 → 1.35 kg (+12.5 %), 1 conflict"
    ]
    after_error = built(action(Kind.CONFLICT), recovered=True)
    assert told(CONFLICT, after_error)[len(first) :] == ["14:03:12  arm  1 conflict"]


def test_conflicts_that_are_settled_are_told() -> None:
    assert told(CONFLICT, IN_STEP, IN_STEP)[-1:] == ["14:03:12  arm  in step again"]
    assert told(CONFLICT, IN_STEP, IN_STEP).count("14:03:12  arm  in step again") == 1


def test_files_that_are_kept_are_listed_once() -> None:
    left = built(action(Kind.ORPHAN))
    first = told(left)
    assert first[:2] == [
        "14:03:12  arm  1 no longer generated but kept because you edited it",
        f"  orphan     {ELBOW}  no longer generated, but you edited it; kept",
    ]
    assert told(left, left) == first


def test_warnings_are_told_when_they_are_new() -> None:
    moved = Diagnostic(Severity.WARNING, "odd", "this is odd", "arm.urdf", 8)
    other = Diagnostic(Severity.WARNING, "odd", "this is odd, too", "arm.urdf", 9)
    assert told(built(diagnostics=(ODD,)), built(diagnostics=(moved,)), built(diagnostics=(moved, other))) == [
        "! arm.urdf:7: warning: this is odd [odd]",
        "! arm.urdf:9: warning: this is odd, too [odd]",
    ]
    assert told(built(), built(diagnostics=(ODD,)), built(), built(diagnostics=(ODD,))) == 2 * [
        "! arm.urdf:7: warning: this is odd [odd]"
    ]


def test_builds_with_nothing_to_do_have_warnings_of_their_own() -> None:
    summary = Diagnostic(Severity.NOTE, "left-out", "1 mesh left out", "arm.urdf")
    idle, busy = built(diagnostics=(summary,)), built(action(Kind.UPDATE), diagnostics=(ODD,))
    lines = told(idle, busy, idle, busy)
    assert [line for line in lines if line.startswith("!")] == [
        "! arm.urdf: note: 1 mesh left out [left-out]",
        "! arm.urdf:7: warning: this is odd [odd]",
    ]


def test_what_concerns_the_daemon() -> None:
    noted = events.Noted((ODD, BROKEN))
    assert told(noted, events.Recovered("all folders are watched again"), events.Stopping("SIGINT")) == [
        "! 14:03:12  arm.urdf:7: warning: this is odd [odd]",
        "! 14:03:12  arm.urdf:12:3: error: this is no XML; correct it [xml-syntax]",
        "14:03:12  all folders are watched again",
        "14:03:12  stopped by SIGINT",
    ]
    again = events.Started(Path("urdfsync.toml"), ("arm",), again=True)
    assert told(again) == ["14:03:12  configuration read again, watching 1 robot of urdfsync.toml"]


def test_quiet_leaves_errors_and_conflicts() -> None:
    noise = (STARTED, UPDATED, events.Noted((ODD,)), built(diagnostics=(ODD,)), events.Recovered("all is well"))
    assert told(*noise, built(recovered=True), events.Stopping("SIGTERM"), quiet=True) == []
    assert told(failed(ODD, BROKEN), quiet=True) == [
        "! 14:03:12  arm  1 error, nothing was changed",
        "! arm.urdf:12:3: error: this is no XML; correct it [xml-syntax]",
    ]
    lines = told(CONFLICT, CONFLICT, quiet=True)
    assert lines[:2] == [
        "14:03:12  arm  1 conflict",
        f"  conflict   {ELBOW}  it is no text that could be merged",
    ]
    assert lines.count(lines[0]) == 1


def test_nothing_in_a_message_can_move_the_cursor() -> None:
    evil = Diagnostic(Severity.ERROR, "odd", "\x1b[2Jgone", "arm.urdf")
    assert not any("\x1b" in line for line in told(events.Noted((evil,)), failed(evil)))


# A build in one line


def change(path: str, old: Any, new: Any, unit: str = "", kind: Event = Event.CHANGED) -> Change:
    return Change(tuple(path.split(" / ")), kind, ChangeClass.PARAMETER, old, new, unit)


def file(kind: Kind, name: str = "Elbow", **more: Any) -> Action:
    return Action(f"modelica/Arm/Links/{name}.mo", kind, Role.RECORD, **more)


MASS = change("link elbow / inertial / mass", 1.0, 2.0, "kg")
EFFORT = change("joint elbow / limit / effort", 54, 60, "N·m")
MASSES = [change(f"link {name} / inertial / mass", 1, 2 + ord(name), "kg") for name in "abc"]
INERTIA = [change(f"link a / inertial / inertia / {name}", 1, 2, "kg·m²") for name in ("ixx", "iyy")]
RENAMED = change("link tool", "tool", "gripper", kind=Event.RENAMED)
LONG_NAME = change(f"link {'a' * 120}", None, None, kind=Event.ADDED)
WRITTEN = file(Kind.UPDATE)
KEPT = [file(Kind.KEEP), file(Kind.UNCHANGED)]


@pytest.mark.parametrize(
    ("changes", "files", "words"),
    [
        # two changes find room, more are counted
        (
            Changes((MASS, EFFORT)),
            [WRITTEN],
            "link elbow: inertial / mass 1 → 2 kg (+100 %); joint elbow: limit / effort 54 → 60 N·m (+11.1 %), "
            "1 file written",
        ),
        (Changes((*MASSES, *INERTIA)), 4 * [WRITTEN], "5 changes in 3 elements, 4 files written"),
        (Changes((LONG_NAME,)), [WRITTEN], "1 change in 1 element, 1 file written"),
        (
            Changes((RENAMED,)),
            [file(Kind.CREATE, "Gripper"), file(Kind.DELETE, "Tool"), file(Kind.MOVE, "Wrist")],
            "link tool: renamed to gripper, 1 file written, 1 deleted, 1 moved with your edits",
        ),
        (Changes((MASS,)), KEPT, "link elbow: inertial / mass 1 → 2 kg (+100 %)"),  # nothing is said of files that stay
        (
            Changes((MASS,), generator=True),
            [WRITTEN],
            "a template, an option or urdfsync itself changed, 1 file written",
        ),
        (
            None,
            [WRITTEN, file(Kind.CONFLICT), file(Kind.UPDATE, "Base", held=True)],
            "1 file written, 1 conflict, 1 change waiting for that",
        ),
    ],
)
def test_a_build_in_one_line(changes: Changes | None, files: list[Action], words: str) -> None:
    assert told(built(*files, changes=changes))[0] == f"14:03:12  arm  {words}"
