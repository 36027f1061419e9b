"""The lines that scroll: what is said, what only if somebody asks, and what is not said again."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.diff.changes import Change, Changes
from urdfsync.domain import ChangeClass, Role
from urdfsync.domain import ChangeKind as Event
from urdfsync.engine.actions import Action, Actions, Kind
from urdfsync.outcome import Checked, Result
from urdfsync.watch import events
from urdfsync.watch.event_log import EventLog, build_summary

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


def action(kind: Kind, generated: str = "generated") -> Action:
    return Action(ELBOW, kind, Role.RECORD, "link elbow", "base", generated, mine="mine")


STARTED = events.Started(Path("urdfsync.toml"), ("arm", "gripper"))
UPDATED = built(action(Kind.UPDATE), changes=HEAVIER)
IN_STEP = built(action(Kind.UNCHANGED))
CONFLICT = built(action(Kind.CONFLICT))


def told(*found: events.Event, **options: Any) -> list[str]:
    """The lines of these events; those for the error stream begin with `!`."""
    log = EventLog(Console(file=io.StringIO(), width=100), **options)
    lines = [line for event in found for line in log.lines(event, "14:03:12")]
    return [f"{'! ' if line.error else ''}{line.text.plain.rstrip()}" for line in lines]


NO_CLASS = Diagnostic(Severity.ERROR, "compile", "there is no class `Foo`", ELBOW, 4)
NO_COMPILER = Diagnostic(Severity.WARNING, "no-compiler", "there is no compiler", hint="install it")
CHECKED = events.CheckDone("arm", Checked.RIGHT, 2.54)
WRONG = events.CheckDone("arm", Checked.WRONG, 2.54, (NO_CLASS,))
MOVED = Diagnostic(Severity.WARNING, "odd", "this is odd", "arm.urdf", 8)
OTHER = Diagnostic(Severity.WARNING, "odd", "this is odd, too", "arm.urdf", 9)
BUSY = [
    events.Settling("arm"),
    events.Waiting("arm", "waiting for the exporter", (BROKEN,)),
    events.Unchanged("arm"),
    events.Building("arm"),
    IN_STEP,
    events.Ran("arm", 0),
    events.Paused("pre-commit runs"),
    events.Resumed(),
    events.Checking("arm"),
]
NOISE = [STARTED, UPDATED, events.Noted((ODD,)), built(diagnostics=(ODD,)), events.Recovered("all is well")]
FAILING = [failed(BROKEN), failed(BROKEN, again=True)]
XML = "! arm.urdf:12:3: error: this is no XML; correct it [xml-syntax]"
ERROR, WARNING = "! 14:03:12  arm  1 error, nothing was changed", "! arm.urdf:7: warning: this is odd [odd]"
MASS = "14:03:12  arm  link elbow: mass 1.2 → 1.35 kg (+12.5 %), 1 record written"
FOO = ["! 14:03:12  arm  checked: 1 error (2.5 s)", f"! {ELBOW}:4: error: there is no class `Foo` [compile]"]
TOLD: dict[str, tuple[list[events.Event], dict[str, bool], list[str]]] = {
    "a build is one line, with robots in a column": (
        [STARTED, UPDATED], {},
        ["14:03:12  watching 2 robots of urdfsync.toml", MASS.replace("arm  ", "arm      ")],
    ),
    "a verbose build lists changes and files": (
        [UPDATED], {"verbose": True},
        [MASS, "  link elbow / mass: 1.2 → 1.35 kg (+12.5 %)",
         f"  update     {ELBOW}  link elbow: mass 1.2 → 1.35 kg (+12.5 %)"],
    ),
    "what goes on between builds is not told": (BUSY, {}, []),
    "but to those who ask": (
        BUSY, {"verbose": True},
        ["14:03:12  arm  changed, settling", "14:03:12  arm  waiting for the exporter", XML,
         "14:03:12  arm  as before", "14:03:12  arm  building", "14:03:12  arm  in step, 1 file",
         "14:03:12  arm  command ended with 0", "14:03:12  paused: pre-commit runs", "14:03:12  building again",
         "14:03:12  arm  checking"],
    ),
    "an error is told once, and so is its end": (
        [*FAILING, built(action(Kind.UNCHANGED), recovered=True), IN_STEP], {},
        [ERROR, XML, "14:03:12  arm  in step again"],
    ),
    "also if something is written then": (
        [*FAILING, built(action(Kind.UPDATE), changes=HEAVIER, recovered=True)], {},
        [ERROR, XML, f"{MASS}, in step again"],
    ),
    "a check is one line": ([events.Checking("arm"), CHECKED], {}, ["14:03:12  arm  checked: compiles (2.5 s)"]),
    "what a check found is not said again": (
        [WRONG, WRONG, CHECKED], {},
        [*FOO, "! 14:03:12  arm  checked: 1 error as before", "14:03:12  arm  checked: compiles again (2.5 s)"],
    ),
    "quiet checks say what is new and wrong": ([CHECKED, WRONG, WRONG, CHECKED, WRONG], {"quiet": True}, [*FOO, *FOO]),
    "what could not be checked is a warning": (
        [events.CheckDone("arm", Checked.INCOMPLETE, 0.0, (NO_COMPILER,))], {},
        ["14:03:12  arm  not checked completely", "! warning: there is no compiler; install it [no-compiler]"],
    ),
    "warnings are told when they are new": (
        [built(diagnostics=(ODD,)), built(diagnostics=(MOVED,)), built(diagnostics=(MOVED, OTHER))], {},
        [WARNING, "! arm.urdf:9: warning: this is odd, too [odd]"],
    ),
    "or come back": ([built(diagnostics=(ODD,)), built(), built(diagnostics=(ODD,))], {}, [WARNING, WARNING]),
    "what concerns the daemon": (
        [events.Noted((ODD, BROKEN)), events.Recovered("all folders are watched again"), events.Stopping("SIGINT")], {},
        ["! 14:03:12  arm.urdf:7: warning: this is odd [odd]", XML.replace("! ", "! 14:03:12  "),
         "14:03:12  all folders are watched again", "14:03:12  stopped by SIGINT"],
    ),
    "another configuration": (
        [events.Started(Path("urdfsync.toml"), ("arm",), again=True)], {},
        ["14:03:12  configuration read again, watching 1 robot of urdfsync.toml"],
    ),
    "quiet leaves errors alone": (
        [*NOISE, built(recovered=True), events.Stopping("SIGTERM"), failed(ODD, BROKEN)], {"quiet": True},
        [ERROR.replace("arm  ", "arm      "), XML],
    ),
}  # fmt: skip


@pytest.mark.parametrize(("found", "options", "lines"), TOLD.values(), ids=TOLD)
def test_what_is_told(found: list[events.Event], options: dict[str, bool], lines: list[str]) -> None:
    assert told(*found, **options) == lines


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
        "14:03:12  arm  link elbow: mass 1.2 → 1.35 kg (+12.5 %), 1 conflict as before"
    ]
    after_error = built(action(Kind.CONFLICT), recovered=True)
    assert told(CONFLICT, after_error)[len(first) :] == ["14:03:12  arm  1 conflict as before"]


def test_conflicts_that_are_settled_are_told() -> None:
    assert told(CONFLICT, IN_STEP, IN_STEP)[-1:] == ["14:03:12  arm  in step again"]
    assert told(CONFLICT, IN_STEP, IN_STEP).count("14:03:12  arm  in step again") == 1


def test_files_that_are_kept_are_listed_once() -> None:
    left = built(action(Kind.ORPHAN))
    first = told(left)
    assert first[:2] == [
        "14:03:12  arm  in step, 0 files, 1 no longer generated but kept because you edited it",
        f"  orphan     {ELBOW}  no longer generated, but you edited it; kept",
    ]
    assert told(left, left) == first


def test_builds_with_nothing_to_do_have_warnings_of_their_own() -> None:
    summary = Diagnostic(Severity.NOTE, "left-out", "1 mesh left out", "arm.urdf")
    idle, busy = built(diagnostics=(summary,)), built(action(Kind.UPDATE), diagnostics=(ODD,))
    lines = told(idle, busy, idle, busy)
    assert [line for line in lines if line.startswith("!")] == [
        "! arm.urdf: note: 1 mesh left out [left-out]",
        "! arm.urdf:7: warning: this is odd [odd]",
    ]


def test_quiet_leaves_conflicts_in_brief() -> None:
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

INERTIAL_MASS = ("link elbow", "inertial", "mass")


def change(path: tuple[str, ...], old: Any, new: Any, unit: str = "", kind: Event = Event.CHANGED) -> Change:
    return Change(path, kind, ChangeClass.PARAMETER, old, new, unit)


def file(kind: Kind, name: str = "Elbow", role: Role = Role.RECORD, **more: Any) -> Action:
    return Action(f"modelica/Arm/Links/{name}.mo", kind, role, **more)


def said(changes: list[Change] | Changes | None, *actions: Action, known: bool = False) -> str:
    found = Changes(tuple(changes)) if isinstance(changes, list) else changes
    return ", ".join(
        build_summary(Result("arm", "Arm", Path("Arm"), Path(), Actions(actions), changes=found), known=known)
    )


WRITTEN = file(Kind.UPDATE)
ELBOW_MASS = change(INERTIAL_MASS, 1.2, 1.35, "kg")
EFFORT = change(("joint elbow", "limit", "effort"), 54, 60, "N·m")
VISUAL = change(("link elbow", "visual 1", "origin", "xyz[2]"), 0.0, 0.1, "m")
ORIGIN = change(("joint hold", "origin", "xyz[2]"), 0.0, 0.1, "m")
VECTOR = [change(("link elbow", "inertial", "origin", f"xyz[{index}]"), 1.0, 2.0, "m") for index in range(3)]
MASSES = [change((f"link {name}", "inertial", "mass"), 1, 2 + ord(name), "kg") for name in "abc"]
INERTIA = [change(("link a", "inertial", "inertia", name), 1, 2, "kg·m²") for name in ("ixx", "iyy")]
RENAMED = change(("link tool",), "tool", "gripper", kind=Event.RENAMED)
WRIST = change(("joint wrist",), None, {"type": "fixed"}, kind=Event.ADDED)
EIGHT = [change((f"link {name}",), None, {"x": name}, kind=Event.ADDED) for name in "abcdefgh"]
THREE = [change((f"link {name}",), name, name * 2, kind=Event.RENAMED) for name in "xyz"]
LONG_NAMES = [change((f"link {name * 60}",), None, None, kind=Event.ADDED) for name in "abc"]
STRUCTURE = [
    file(Kind.CREATE, "Gripper", Role.MODEL),
    file(Kind.UPDATE),
    file(Kind.DELETE, "Tool", Role.MODEL),
]
FOREIGN = Changes((Change(("link a", "gazebo"), Event.ADDED, ChangeClass.UNMODELLED, None, "<x/>"),))
KEPT = [file(Kind.KEEP), file(Kind.UNCHANGED), file(Kind.ORPHAN), file(Kind.NEEDED)]
WAITS = [file(Kind.CONFLICT), file(Kind.UPDATE, "Base", held=True)]


@pytest.mark.parametrize(
    ("changes", "files", "words"),
    [
        ([ELBOW_MASS], [WRITTEN], "link elbow: mass 1.2 → 1.35 kg (+12.5 %), 1 record written"),
        # the group of a number is named where it tells it from others
        ([VISUAL], [WRITTEN], "link elbow: visual 1 origin xyz[2] 0 → 0.1 m, 1 record written"),
        ([ORIGIN], [WRITTEN], "joint hold: origin xyz[2] 0 → 0.1 m, 1 record written"),
        ([change(("joint a", "mimic", "joint"), "b", "c")], [], "joint a: mimic joint b → c, nothing to write"),
        # two rows find room, more are counted
        (
            [change(INERTIAL_MASS, 1, 2, "kg"), EFFORT],
            [WRITTEN],
            "link elbow: mass 1 → 2 kg (+100 %); joint elbow: effort 54 → 60 N·m (+11.1 %), 1 record written",
        ),
        (VECTOR, [WRITTEN], "link elbow: inertial origin xyz[0, 1, 2] (1, 1, 1) → (2, 2, 2) m, 1 record written"),
        ([*MASSES, *INERTIA], 4 * [WRITTEN], "5 changes in 3 elements, 4 records written"),
        # elements that come and go, and renames, are named
        (
            [RENAMED, WRIST, *MASSES[:2]],
            STRUCTURE,
            "link tool renamed to gripper, joint wrist added, 2 more changes in 2 elements, 2 files written, 1 deleted",
        ),
        ([RENAMED], STRUCTURE, "link tool renamed to gripper, 2 files written, 1 deleted"),
        ([*EIGHT, *THREE], [WRITTEN], "11 changes in 11 elements, 1 record written"),
        (LONG_NAMES, [WRITTEN], "3 changes in 3 elements, 1 record written"),
        # edits that moved, were merged, or had to be restored
        (None, [file(Kind.MOVE, "Wrist", origin="Links/Elbow.mo")], "your edits moved from Elbow.mo to Wrist.mo"),
        (
            None,
            [file(Kind.MERGE), file(Kind.RESTORE, "Base")],
            "Base.mo restored because you deleted it, Elbow.mo merged with your edits",
        ),
        (None, [file(Kind.MERGE, name) for name in "ABCD"], "4 merged with your edits"),
        # nothing is said of files that stay
        (None, KEPT, ""),
        (FOREIGN, KEPT, "link a: gazebo added (not modelled), nothing to write"),
        (
            Changes((change(INERTIAL_MASS, 1, 2),), generator=True),
            [file(Kind.UPDATE, role=Role.MODEL)],
            "a template, an option or urdfsync itself changed, 1 model written",
        ),
        (None, [WRITTEN, *WAITS], "1 record written, 1 conflict, 1 change waiting for that"),
    ],
)
def test_a_build_in_one_line(changes: list[Change] | Changes | None, files: list[Action], words: str) -> None:
    assert said(changes, *files) == words
