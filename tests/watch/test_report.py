"""The lines of the daemon: what is said, what only if somebody asks, and what is not said again."""

from __future__ import annotations

import datetime
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec
import pytest
from support.screen import Terminal

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.domain import ChangeClass, Role
from urdfsync.domain import ChangeKind as Event
from urdfsync.domain.changes import Change
from urdfsync.domain.comparison import Changes
from urdfsync.engine.actions import Action, Actions, Reason
from urdfsync.engine.result import Checked, Result
from urdfsync.output.console import Console
from urdfsync.watch import events, report
from urdfsync.watch.report import Report

pytestmark = pytest.mark.usefixtures("folder")

TIME = "14:03:12  "
ELBOW = "modelica/Arm/Links/Elbow.mo"
BROKEN = Diagnostic(Severity.ERROR, "xml-syntax", "this is no XML", "arm.urdf", 12, 3, "correct it")
ODD = Diagnostic(Severity.WARNING, "odd", "this is odd", "arm.urdf", 7)
MOVED = Diagnostic(Severity.WARNING, "odd", "this is odd", "arm.urdf", 8)
OTHER = Diagnostic(Severity.WARNING, "odd", "this is odd, too", "arm.urdf", 9)
NO_CLASS = Diagnostic(Severity.ERROR, "compile", "there is no class `Foo`", ELBOW, 4)
LACKING = Diagnostic(Severity.WARNING, "no-compiler", "there is no compiler", hint="install it")
EVIL = Diagnostic(Severity.ERROR, "odd", "\x1b[2Jgone", "arm.urdf")


def change(path: str, old: Any, new: Any, unit: str = "", kind: Event = Event.CHANGED) -> Change:
    return Change(tuple(path.split(" / ")), kind, ChangeClass.PARAMETER, old, new, unit)


def action(kind: Reason, name: str = "Elbow", generated: str = "generated", waits: bool = False) -> Action:
    path = f"modelica/Arm/Links/{name}.mo"
    return Action(path, kind, Role.RECORD, "link elbow", "base", generated, mine="mine", is_waiting=waits)


def built(*actions: Action, robot: str = "arm", recovered: bool = False, **more: Any) -> events.Built:
    files = tuple(Path(action.path).absolute() for action in actions if action.writes)
    more.setdefault("writes", bool(files or more.get("changes")))
    return events.Built(
        Result(robot=robot, package="Arm", folder=Path("Arm"), root=Path(), actions=Actions(actions), **more),
        files,
        recovered,
    )


def failed(*diagnostics: Diagnostic, robot: str = "arm", again: bool = False) -> events.Failed:
    return events.Failed(
        Result(robot=robot, package="Arm", folder=Path("Arm"), root=Path(), diagnostics=diagnostics, failed=True), again
    )


def told(*found: events.Event, **options: Any) -> list[str]:
    """The lines of these events; those for the error stream begin with `!`."""
    report = Report(Console(**options))
    lines = [line for event in found for line in report.take(event, TIME.strip())]
    return [f"{'! ' if line.error else ''}{str(line.text).rstrip()}" for line in lines]


HEAVIER = Changes((change("link elbow / mass", 1.2, 1.35, "kg"),))
MASS = "link elbow: mass 1.2 → 1.35 kg (+12.5 %)"
STARTED = events.Started(Path("urdfsync.toml"), ("arm", "gripper"))
UPDATED = built(action(Reason.UPDATE), changes=HEAVIER)
IN_STEP = built(action(Reason.UNCHANGED))
RECOVERED = built(action(Reason.UNCHANGED), recovered=True)
CONFLICT = built(action(Reason.CONFLICT))
ORPHAN = built(action(Reason.ORPHAN))
RIGHT, KNOWN = events.CheckDone("arm", Checked.RIGHT, 2.54), events.CheckDone("arm", Checked.RIGHT)
WRONG = events.CheckDone("arm", Checked.WRONG, 2.54, (NO_CLASS,))
BUSY = (
    events.Settling("arm"),
    events.Waiting("arm", "waiting for the exporter", (BROKEN,)),
    events.Unchanged("arm"),
    events.Building("arm"),
    IN_STEP,
    events.Checking("arm"),
    events.Ran("arm", 0),
)
NO_XML = "! arm.urdf:12:3: error: this is no XML; correct it [xml-syntax]"
IS_ODD, IS_ODD_TOO = "! arm.urdf:7: warning: this is odd [odd]", "! arm.urdf:9: warning: this is odd, too [odd]"
IS_WRONG = [f"! {TIME}arm  checked: 1 error (2.5 s)", f"! {ELBOW}:4: error: there is no class `Foo` [compile]"]
IS_RIGHT = f"{TIME}arm  checked: compiles (2.5 s)"
IS_BROKEN = [f"! {TIME}arm  1 error, nothing was changed", NO_XML]

Case = tuple[Sequence[events.Event], list[str]]

SAID: dict[str, Case] = {
    "a build is one line, with robots in a column": (
        (STARTED, UPDATED),
        [f"{TIME}watching 2 robots of urdfsync.toml", f"{TIME}arm      {MASS}, 1 file written"],
    ),
    "of all that goes on between builds, people see a robot that waits, and its end": (
        (*BUSY, IN_STEP),
        [f"{TIME}arm  waiting for the exporter", f"{TIME}arm  in step again"],
    ),
    "of robots that wait for the same process, people see one": (
        (events.Waiting("arm", "waiting for process 7"), events.Waiting("leg", "waiting for process 7"), IN_STEP),
        [f"{TIME}arm  waiting for process 7", f"{TIME}arm  in step again"],
    ),
    "an error is told once, and so is its end": (
        (failed(BROKEN), failed(BROKEN, again=True), RECOVERED, IN_STEP),
        [*IS_BROKEN, f"{TIME}arm  in step again"],
    ),
    "an end of an error that comes with a build": (
        (failed(BROKEN), built(action(Reason.UPDATE), changes=HEAVIER, recovered=True)),
        [*IS_BROKEN, f"{TIME}arm  {MASS}, 1 file written, in step again"],
    ),
    "a check is one line": ((events.Checking("arm"), RIGHT), [IS_RIGHT]),
    "what a check finds is not said again": (
        (WRONG, WRONG, RIGHT),
        [*IS_WRONG, IS_WRONG[0], IS_RIGHT],
    ),
    "what was known of a package took no time": ((KNOWN,), [f"{TIME}arm  checked: compiles"]),
    "what could not be checked is a warning": (
        (events.CheckDone("arm", Checked.INCOMPLETE, 0.0, (LACKING,)),),
        [f"{TIME}arm  checked in part", "! warning: there is no compiler; install it [no-compiler]"],
    ),
    "warnings are told when they are new, wherever they are now": (
        (built(diagnostics=(ODD,)), built(diagnostics=(MOVED,)), built(diagnostics=(MOVED, OTHER))),
        [IS_ODD, IS_ODD_TOO],
    ),
    "warnings that come again are told again": (
        (built(), built(diagnostics=(ODD,)), built(), built(diagnostics=(ODD,))),
        [IS_ODD, IS_ODD],
    ),
    "what concerns the daemon": (
        (events.Noted((ODD, BROKEN)), events.Stopping("SIGINT")),
        [
            IS_ODD.replace("! ", f"! {TIME}"),
            NO_XML.replace("! ", f"! {TIME}"),
            f"{TIME}stopped by SIGINT",
        ],
    ),
    "a configuration that is read again": (
        (events.Started(Path("urdfsync.toml"), ("arm",), again=True),),
        [f"{TIME}configuration read again, watching 1 robot of urdfsync.toml"],
    ),
    "nothing in a message can move the cursor": (
        (events.Noted((EVIL,)),),
        [f"! {TIME}arm.urdf: error: \\x1b[2Jgone [odd]"],
    ),
    # builds in one line: two changes find room, more are counted
    "two changes": (
        (built(action(Reason.UPDATE), changes=Changes((*HEAVIER.changes, change("joint a / effort", 54, 60, "N·m")))),),
        [f"{TIME}arm  {MASS}; joint a: effort 54 → 60 N·m (+11.1 %), 1 file written"],
    ),
    "many changes": (
        (
            built(
                *4 * [action(Reason.UPDATE)],
                changes=Changes((
                    *(change(f"link {name} / inertial / mass", 1, 2 + ord(name), "kg") for name in "abc"),
                    *(change(f"link a / inertial / inertia / {name}", 1, 2, "kg·m²") for name in ("ixx", "iyy")),
                )),
            ),
        ),
        [f"{TIME}arm  ~3 (5 parameter changes), 4 files written"],
    ),
    "a long change": (
        (built(action(Reason.UPDATE), changes=Changes((change(f"link {'a' * 120}", None, None, kind=Event.ADDED),))),),
        [f"{TIME}arm  1 parameter change, 1 file written"],
    ),
    "another name": (
        (
            built(
                *(action(Reason.CREATE, "Gripper"), action(Reason.DELETE, "Tool"), action(Reason.MOVE, "Wrist")),
                changes=Changes((change("link tool", "tool", "gripper", kind=Event.RENAMED),)),
            ),
        ),
        [
            f"{TIME}arm  link tool: renamed to gripper, 1 file written, 1 deleted, 1 moved with your edits",
            "  move       modelica/Arm/Links/Wrist.mo  its path is new; your edits move here",
        ],
    ),
    "nothing is said of files that stay": (
        (built(action(Reason.KEEP), action(Reason.UNCHANGED), changes=HEAVIER),),
        [f"{TIME}arm  {MASS}"],
    ),
    "another template": (
        (built(action(Reason.UPDATE), changes=Changes(HEAVIER.changes, generator=True)),),
        [f"{TIME}arm  a template, an option or urdfsync itself changed, 1 file written"],
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", SAID)
def test_what_is_said(name: str) -> None:
    found, lines = SAID[name]
    assert told(*found) == lines


def test_verbose_says_what_goes_on_and_lists_changes_and_files() -> None:
    assert told(*BUSY, verbose=True) == [
        f"{TIME}arm  settling",
        f"{TIME}arm  waiting for the exporter",
        NO_XML,
        f"{TIME}arm  as before",
        f"{TIME}arm  building",
        f"{TIME}arm  in step again",
        f"{TIME}arm  checking",
        f"{TIME}arm  command ended with 0",
    ]
    lines = [f"{TIME}arm  {MASS}, 1 file written", f"  {MASS}", f"  update     {ELBOW}  link elbow"]
    assert told(UPDATED, verbose=True) == lines


def test_quiet_leaves_errors_and_conflicts() -> None:
    noise = (STARTED, UPDATED, events.Noted((ODD,)), built(diagnostics=(ODD,)))
    assert told(*noise, built(recovered=True), RIGHT, events.Stopping("SIGTERM"), quiet=True) == []
    assert told(failed(ODD, BROKEN), WRONG, RIGHT, WRONG, quiet=True) == [*IS_BROKEN, *IS_WRONG, *IS_WRONG]
    lines = told(CONFLICT, CONFLICT, quiet=True)
    assert lines[:2] == [f"{TIME}arm  1 conflict", f"  conflict   {ELBOW}  it is not a text, so it can't be merged"]
    assert lines.count(lines[0]) == 1


def test_conflicts_are_shown_as_in_build_and_only_once_and_so_is_their_end() -> None:
    first = told(CONFLICT)
    assert first[0] == f"{TIME}arm  1 conflict"
    assert f"  conflict   {ELBOW}  link elbow" in first
    assert f"    urdfsync resolve {ELBOW} --keep" in first
    assert told(CONFLICT, CONFLICT) == first
    assert told(CONFLICT, built(action(Reason.CONFLICT, generated="other"))) == first + first
    again = built(action(Reason.CONFLICT), changes=HEAVIER)
    assert told(CONFLICT, again) == [*first, f"{TIME}arm  {MASS}, 1 conflict"]
    assert told(CONFLICT, built(action(Reason.CONFLICT), recovered=True)) == [*first, f"{TIME}arm  1 conflict"]
    assert told(CONFLICT, IN_STEP, IN_STEP) == [*first, f"{TIME}arm  in step again"]
    waiting = built(action(Reason.UPDATE), action(Reason.CONFLICT), action(Reason.UPDATE, "Base", waits=True))
    assert told(waiting)[0] == f"{TIME}arm  1 file written, 1 conflict (1 file waits for it)"


def test_what_is_broken_is_one_line_until_it_is_not() -> None:
    broken = built(action(Reason.KEEP), diagnostics=(NO_CLASS, MOVED, BROKEN), is_broken=True)
    assert told(broken, broken, built(action(Reason.KEEP)), broken) == [
        "! arm.urdf:8: warning: this is odd [odd]",
        f"! {TIME}arm  broken: {ELBOW}:4: there is no class `Foo`, and 1 more",
        f"{TIME}arm  in step again",
        "! arm.urdf:8: warning: this is odd [odd]",
        f"! {TIME}arm  broken: {ELBOW}:4: there is no class `Foo`, and 1 more",
    ]


def test_warnings_that_a_build_has_shown_are_not_shown_again(tmp_path: Path) -> None:
    event = built(action(Reason.KEEP), diagnostics=(ODD, OTHER))
    event = events.Built(msgspec.structs.replace(event.result, root=tmp_path), ())
    (tmp_path / ".urdfsync").mkdir()
    assert told(event) == [IS_ODD, IS_ODD_TOO]
    assert told(event) == []
    assert told(event, verbose=True)[:2] == [IS_ODD, IS_ODD_TOO]


# On terminals, and in pipes


PAGE = (Path(__file__).parents[2] / "docs" / "watch.md").read_text(encoding="utf-8")


def become_terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    """Make both streams one terminal."""
    monkeypatch.setenv("TERM", "xterm-256color")
    found = Terminal()
    monkeypatch.setattr(sys, "stdout", found)
    monkeypatch.setattr(sys, "stderr", found)
    return found


def show(monkeypatch: pytest.MonkeyPatch, people: Report, event: events.Event, time: str = "14:03:12") -> None:
    moment = datetime.datetime.fromisoformat(f"2026-03-04T{time}+01:00")
    monkeypatch.setattr(report, "now", lambda: moment)
    people.show(event)


def test_the_page_shows_what_a_terminal_shows(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = become_terminal(monkeypatch)
    monkeypatch.setenv("NO_COLOR", "1")
    (example,) = re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL)
    mass = [
        change(f"link {name} / inertial / mass", 1.2, new, "kg") for name, new in (("elbow", 1.35), ("a", 2), ("b", 3))
    ]
    inertia = [change(f"link a / inertial / inertia / {name}", 1, 2) for name in ("ixx", "iyy")]
    renamed = change("link tool", "tool", "probe", kind=Event.RENAMED)
    updates = 4 * [action(Reason.UPDATE)]
    broken = Diagnostic(Severity.ERROR, "xml-syntax", "this is not well-formed XML", "cad/cart.urdf", 47, 30)
    found = (
        events.Started(Path("urdfsync.toml"), ("arm", "crane", "gripper", "cart")),
        built(*updates[:2], changes=Changes((mass[0],))),
        built(*updates, robot="gripper", changes=Changes((*mass, *inertia))),
        built(*updates, action(Reason.MOVE, "Probe"), changes=Changes((renamed,))),
        failed(broken, robot="cart"),
        events.Waiting("crane", "waiting for the exporter of cad/crane.urdf"),
    )
    people, moments = Report(Console()), re.findall(r"^\d\d:\d\d:\d\d", example, re.MULTILINE)
    for event, moment in zip(found, moments, strict=True):
        show(monkeypatch, people, event, moment)
    assert terminal.getvalue() == example


def test_a_terminal_has_colours(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = become_terminal(monkeypatch)
    show(monkeypatch, Report(Console()), UPDATED)
    assert "\x1b[1m" in terminal.getvalue()


def test_a_pipe_has_lines_only_and_errors_go_their_way(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    people = Report(Console())
    for event in (STARTED, UPDATED, failed(ODD, BROKEN)):
        show(monkeypatch, people, event)
    out, err = capsys.readouterr()
    assert out.splitlines() == [f"{TIME}watching 2 robots of urdfsync.toml", f"{TIME}arm      {MASS}, 1 file written"]
    assert err.splitlines()[-1] == NO_XML.removeprefix("! ")
