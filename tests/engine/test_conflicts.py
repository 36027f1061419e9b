"""A conflict about numbers of one element's record is one of that file: all else of an export is written."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from support import urdfs
from support.commands import Execute
from support.files import fresh_models, models
from support.networks import edit

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Choice, Reason, UsersChoice
from urdfsync.engine.conflicts import find_conflict, resolve

FORE, HAND, WRIST = (
    "modelica/Arm/Links/ForeParameters.mo",
    "modelica/Arm/Links/Hand.mo",
    "modelica/Arm/Joints/Wrist.mo",
)
ELBOW = urdfs.joint("elbow", "revolute", "base", "fore")


def export(mass: float, *names: tuple[str, str]) -> None:
    """Write the source: a forearm of this mass, and for each pair a joint with its link, in a chain."""
    links, joints, parent = [urdfs.link("base", 1.0), urdfs.link("fore", mass)], [ELBOW], "fore"
    for joint, link in names:
        links.append(urdfs.link(link, 1.0))
        joints.append(urdfs.joint(joint, "revolute", parent, link))
        parent = link
    Path("arm.urdf").write_text(urdfs.robot(*links, *joints))


@pytest.fixture
def conflict(folder: Path, execute: Execute) -> Path:
    """A forearm that was weighed, which the export has made heavier while it got a hand."""
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    export(2.5)
    execute("build")
    edit(FORE, "2.5", "2.6")
    export(2.75, ("wrist", "hand"))
    said = execute("build", code=3)
    assert "1 conflict" in said.out
    assert "wait" not in said.out
    return folder


def test_structure_is_written(conflict: Path, execute: Execute) -> None:
    assert Path(HAND).exists()
    assert "wrist" in Path("modelica/Arm/Arm.mo").read_text()
    assert "2.6" in Path(FORE).read_text()
    before = models()
    for command, code in (("status", 3), ("build --check", 3), ("build", 3)):
        assert "1 conflict" in execute(*command.split(), code=code).out
    assert models() == before


@pytest.mark.parametrize(
    "then", [(), (("wrist", "hand"),), (("gelenk", "hand"),), (("wrist", "hand"), ("knuckle", "tip"))]
)
def test_what_is_exported_meanwhile_is_written_and_the_end_is_a_fresh_build(
    conflict: Path, execute: Execute, then: tuple[tuple[str, str], ...]
) -> None:
    if then:
        edit(HAND, "end Hand;", "  // mine\nend Hand;")
    export(2.875, *then)
    execute("build", code=3)
    execute("resolve", FORE, "--take")
    assert execute("status").lines[0].startswith("arm: in step")
    built = models()
    assert {path: text.replace("  // mine\n", "") for path, text in built.items()} == fresh_models(conflict / "fresh")
    assert sum("// mine" in text for text in built.values()) == bool(then)


MINE, BOTH, GENERATED = "2\n\na\n", "2\n\nb\n", "1\n\nb\n"
FITTING, DISPUTED, SAME = (("1\n\na\n", MINE, GENERATED), ("1\n", "2\n", "3\n"), ("1\n\na\n", BOTH, GENERATED))


@pytest.mark.parametrize(
    ("before", "texts", "choice", "after", "text"),
    [
        (Reason.CONFLICT, FITTING, None, Reason.CONFLICT, None),
        (Reason.CONFLICT, FITTING, Choice.MERGE, Reason.MERGE, BOTH),
        (Reason.CONFLICT, FITTING, Choice.KEEP, Reason.KEEP, None),
        (Reason.CONFLICT, FITTING, Choice.TAKE, Reason.UPDATE, None),
        (Reason.CONFLICT, FITTING, Choice.EDIT, Reason.MERGE, "edited"),
        (Reason.CONFLICT, DISPUTED, Choice.MERGE, Reason.CONFLICT, None),
        (Reason.CONFLICT, DISPUTED, Choice.MERGE_GENERATED, Reason.MERGE, "3\n"),
        (Reason.CONFLICT, DISPUTED, Choice.MERGE_MINE, Reason.KEEP, None),
        (Reason.CONFLICT, SAME, Choice.MERGE, Reason.INCLUDED, None),
        (Reason.UNOWNED, FITTING, Choice.TAKE, Reason.UPDATE, None),
        (Reason.MOVE, FITTING, None, Reason.MOVE, BOTH),
        (Reason.MOVE, FITTING, Choice.KEEP, Reason.MOVE, MINE),
        (Reason.MOVE, FITTING, Choice.TAKE, Reason.MOVE, None),
        (Reason.MOVE, DISPUTED, None, Reason.CONFLICT, None),
        (Reason.MOVE, DISPUTED, Choice.TAKE, Reason.MOVE, None),
        (Reason.ORPHAN, None, None, Reason.ORPHAN, None),
        (Reason.ORPHAN, None, Choice.KEEP, Reason.FORGET, None),
        (Reason.ORPHAN, None, Choice.TAKE, Reason.DELETE, None),
        (Reason.KEEP, None, Choice.TAKE, Reason.UPDATE, None),
        (Reason.KEEP, None, Choice.KEEP, Reason.KEEP, None),
        (Reason.UPDATE, None, Choice.KEEP, Reason.UPDATE, None),
    ],
)
def test_what_the_user_chose_becomes_of_a_file(
    before: Reason, texts: tuple[str, str, str] | None, choice: Choice | None, after: Reason, text: str | None
) -> None:
    action = Action("a.txt", before, Role.MODEL, "", "base", "new", mine="mine")
    conflicts = {"a.txt": find_conflict(action, [texts[0]], *texts[1:])} if texts else {}
    choices = {"a.txt": UsersChoice(choice, action.sides, "edited")} if choice else {}
    (resolved,), merged = resolve([action], conflicts, choices, merging=False)
    assert (resolved.reason, merged.get("a.txt")) == (after, text)
    is_answered = after is Reason.KEEP and before is Reason.CONFLICT
    assert resolved.base == ("new" if is_answered else "base"), "who keeps the text has answered the export"
    gone = msgspec.structs.replace(action, mine=None)
    if choice is Choice.TAKE and before is not Reason.MOVE:
        (resolved,), _ = resolve([gone], conflicts, choices, merging=False)
        assert resolved.reason is before, "there is no file that the generated text can replace"


def test_clean_merges_need_no_word_of_the_user_if_the_configuration_allows_them() -> None:
    action = Action("a.txt", Reason.CONFLICT, Role.MODEL, mine="mine")
    for texts, reason in ((FITTING, Reason.MERGE), (DISPUTED, Reason.CONFLICT), (SAME, Reason.INCLUDED)):
        (resolved,), _ = resolve([action], {"a.txt": find_conflict(action, texts[:1], *texts[1:])}, {}, merging=True)
        assert (resolved.reason, resolved.choice) == (reason, None)
    found = find_conflict(action, FITTING[:1], *FITTING[1:])
    choices = {"a.txt": UsersChoice(Choice.EDIT, action.sides, MINE)}
    (resolved,), _ = resolve([action], {"a.txt": found}, choices, merging=True)
    assert (resolved.reason, resolved.choice) == (Reason.KEEP, Choice.KEEP), "edited, and left as it was"


def test_edits_of_a_file_that_git_united_are_those_that_no_branch_recorded() -> None:
    action = Action("a.txt", Reason.CONFLICT, Role.MODEL)
    ours, theirs = "1\n\na\n\n2\n", "3\n\na\n\n4\n"
    for mine, merged in (("1\n\na\n\n4\n", "5\n\na\n\n6\n"), ("1\n\nb\n\n4\n", "5\n\nb\n\n6\n")):
        for bases in ([ours, theirs], [theirs, ours]):
            found = find_conflict(action, bases, mine, "5\n\na\n\n6\n")
            assert (found.merged(Choice.MERGE), found.rejected) == (merged, "")


def test_bases_of_two_branches_that_give_different_merges_give_none() -> None:
    action = Action("a.txt", Reason.CONFLICT, Role.MODEL)
    both = find_conflict(action, ["1\n", "2\n"], "3\n", "1\n")
    assert both.merged(Choice.MERGE) is None
    assert both.rejected == "two branches recorded different bases, which give different merges"
    same = find_conflict(action, ["1\n\na\n", "1\r\n\r\na\r\n"], MINE, GENERATED)
    assert (same.base, same.merged(Choice.MERGE), same.rejected) == ("1\n\na\n", BOTH, "")
