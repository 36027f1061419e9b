"""Results of builds: whether a package is in step, what is said of it in a line, and the exit code."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
import pytest

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.domain import Role
from urdfsync.domain.comparison import Changes
from urdfsync.engine.actions import Action, Actions, Choice, Reason
from urdfsync.engine.decide.conflicts import Conflict
from urdfsync.engine.result import Checked, Exit, Result, exit_code
from urdfsync.merge import Merge, merge

FAULT = Diagnostic(Severity.ERROR, "broken", "it is broken")
HINT = Diagnostic(Severity.WARNING, "odd", "it is odd")


def result(*reasons: Reason, **fields: Any) -> Result:
    """A build that does this to one file after the other; those that wait have their fields from `waiting`."""
    waiting = fields.pop("waiting", ())
    actions = [Action(f"{number}.mo", reason, Role.MODEL, base="hash") for number, reason in enumerate(reasons)]
    actions += [Action(f"w{number}.mo", reason, Role.MODEL, is_waiting=True) for number, reason in enumerate(waiting)]
    return Result(
        robot="arm", package="Arm", folder=Path.cwd() / "Arm", root=Path.cwd(), actions=Actions(actions), **fields
    )


@pytest.mark.parametrize(
    ("build", "summary"),
    [
        (result(Reason.NEEDED), "in step, 0 files, 1 orphan kept because your files need it"),
        (result(Reason.UNCHANGED), "in step, 1 file"),
        (result(Reason.UPDATE, Reason.CREATE, writes=True), "2 files written"),
        (result(Reason.UPDATE, writes=True), "1 file written"),
        (result(Reason.UPDATE, Reason.CREATE, writes=True, dry=True), "2 files to write"),
        (result(Reason.KEEP, Reason.KEEP), "in step, 2 files, 2 kept because you edited them"),
        (result(Reason.UNCHANGED, renews=True, dry=True), "in step, 1 file"),
        (result(Reason.UNCHANGED, renews=True), "in step, 1 file, recorded state renewed: commit .urdfsync"),
        (result(Reason.UPDATE, Reason.KEEP, writes=True, dry=True), "1 file to write, 1 kept because you edited it"),
        (result(Reason.CONFLICT, Reason.UNOWNED), "2 conflicts"),
        (result(Reason.CONFLICT, waiting=[Reason.UPDATE]), "1 conflict (1 file waits for it)"),
        (
            result(Reason.CONFLICT, Reason.UNOWNED, waiting=[Reason.UPDATE, Reason.DELETE]),
            "2 conflicts (2 files wait for them)",
        ),
        (result(Reason.UNCHANGED, stale=("a",)), "inputs changed since the last build"),
        (
            result(Reason.KEEP, is_broken=True),
            "broken: an edited file does not fit the package, 1 kept because you edited it",
        ),
        (result(Reason.UNCHANGED, checked=Checked.RIGHT), "in step, 1 file; checked: compiles"),
        (result(Reason.UNCHANGED, checked=Checked.INCOMPLETE), "in step, 1 file; checked in part"),
        (result(checked=Checked.WRONG, diagnostics=(FAULT, HINT, FAULT)), "in step, 0 files; checked: 2 errors"),
        (result(failed=True, diagnostics=(HINT, FAULT)), "1 error, nothing was changed"),
        (result(failed=True, unfinished=True, diagnostics=(FAULT,)), "1 error, the next build writes the rest"),
    ],
)
def test_what_happened_is_said_in_a_line(build: Result, summary: str) -> None:
    assert build.summary == summary


@pytest.mark.parametrize(
    ("build", "code", "code_of_a_check"),
    [
        (result(Reason.UNCHANGED), Exit.IN_STEP, Exit.IN_STEP),
        (result(Reason.UNCHANGED, renews=True, dry=True), Exit.IN_STEP, Exit.IN_STEP),
        (result(Reason.UPDATE, writes=True), Exit.IN_STEP, Exit.IN_STEP),
        (result(Reason.UPDATE, writes=True, dry=True), Exit.IN_STEP, Exit.OUT_OF_STEP),
        (result(Reason.UNCHANGED, stale=("a",)), Exit.IN_STEP, Exit.OUT_OF_STEP),
        (result(Reason.KEEP, is_broken=True, dry=True), Exit.CONFLICT, Exit.CONFLICT),
        (result(Reason.KEEP, is_broken=True), Exit.CONFLICT, Exit.CONFLICT),
        (result(Reason.CONFLICT), Exit.CONFLICT, Exit.CONFLICT),
        (result(failed=True, locked=True), Exit.LOCKED, Exit.LOCKED),
        (result(failed=True), Exit.ERROR, Exit.ERROR),
        (result(Reason.UNCHANGED, checked=Checked.WRONG), Exit.ERROR, Exit.ERROR),
        (result(Reason.UNCHANGED, checked=Checked.INCOMPLETE), Exit.IN_STEP, Exit.IN_STEP),
    ],
)
def test_the_exit_code_is_that_of_the_worst(build: Result, code: Exit, code_of_a_check: Exit) -> None:
    assert (exit_code([build]), exit_code([build], check=True)) == (code, code_of_a_check)
    assert build.in_step == (code_of_a_check is Exit.IN_STEP) or build.checked is Checked.WRONG
    assert exit_code([result(failed=True), build, result()]) is Exit.ERROR
    if code is not Exit.ERROR:
        assert exit_code([result(Reason.CONFLICT), build]) in (Exit.CONFLICT, Exit.LOCKED)


def test_a_package_is_built_once_a_file_of_it_was_written() -> None:
    assert result(Reason.UPDATE).is_built
    new = msgspec.structs.replace(result(), actions=Actions([Action("a.mo", Reason.CREATE, Role.MODEL)]))
    assert (new.is_built, new.is_first) == (False, True)
    found = msgspec.structs.replace(new, actions=Actions([Action("a.mo", Reason.UNCHANGED, Role.MODEL)]))
    assert (found.is_built, found.is_first) == (True, False)
    assert not result().is_first


@pytest.mark.parametrize(
    ("build", "are_told"),
    [(result(Reason.UPDATE, writes=True), True), (result(Reason.CONFLICT), True), (result(Reason.UNCHANGED), False)],
)
def test_changes_of_the_model_are_told_if_they_reach_a_file(build: Result, are_told: bool) -> None:
    changes = Changes()
    found = msgspec.structs.replace(build, changes=changes).effective_changes
    assert (found is changes) == are_told


FITTING = merge("a\n\nb\n", "1\n\nb\n", "a\n\n2\n")


@pytest.mark.parametrize(
    ("merged", "rejected", "reason", "relation"),
    [
        (FITTING, "", Reason.CONFLICT, "the changes fit together: --merge takes both"),
        (Merge(None, "x", ()), "it has a flaw", Reason.CONFLICT, "--merge would not be right: it has a flaw"),
        (None, "", Reason.UNOWNED, "there is no base, so it can't be merged"),
        (
            None,
            "",
            Reason.CONFLICT,
            "its merge base, the text that urdfsync wrote last, is not recorded, so it can't be merged",
        ),
        (None, "it is a folder", Reason.CONFLICT, "it is a folder"),
        (Merge(None, "", ("",)), "", Reason.CONFLICT, "the changes contradict each other"),
        (Merge(None, "", ("", "a")), "", Reason.CONFLICT, "the changes contradict each other in 2 places"),
        (Merge(None, "", ("a", "b", "c")), "", Reason.CONFLICT, "a; b; c"),
        (Merge(None, "", ("a", "b", "c", "d", "e")), "", Reason.CONFLICT, "a; b; c; and 2 more"),
    ],
)
def test_how_the_sides_of_a_conflict_stand(merged: Merge | None, rejected: str, reason: Reason, relation: str) -> None:
    texts = Conflict("0.mo", "base", "mine", "generated", merged, rejected=rejected)
    (disputed,) = result(reason, conflict_texts=(texts,)).conflicts
    assert disputed.relation == relation
    assert disputed.merges == disputed.offers(Choice.MERGE) == (merged is FITTING)


def test_what_is_no_text_has_nothing_to_merge() -> None:
    (disputed,) = result(Reason.CONFLICT).conflicts
    assert (disputed.relation, disputed.saved) == ("it is not a text, so it can't be merged", {})
    assert not disputed.offers(Choice.MERGE)
