"""`urdfsync status` as people and programs use it; and how files stand for actions that a small project has not."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from support.commands import Execute
from support.files import unchanged
from support.networks import LADDER, configure, edit

from urdfsync.changes import Change, Changes
from urdfsync.domain import ChangeClass, ChangeKind, Role
from urdfsync.engine.actions import Action, Actions, FileStatus, Kind, Reason
from urdfsync.engine.result import Result
from urdfsync.output.status import lines, summary
from urdfsync.state.lock import build_lock


@pytest.fixture
def built(project: Path, execute: Execute) -> Path:
    """A built project."""
    execute("build")
    return project


def test_never_built(project: Path, execute: Execute) -> None:
    with unchanged(project):
        assert execute("status", code=1).lines == ["ladder: not built yet: 14 files to write"]
        assert len(execute("status", "--verbose", code=1).lines) == 1 + 14


def test_files_of_every_kind(built: Path, execute: Execute) -> None:
    assert execute("status").lines == ["ladder: in step, 14 files"]
    assert execute("status", "--quiet").lines == []
    edit(built / "ladder.json", "220.5", "330")
    edit(built / LADDER / "Ladder.mo", "end Ladder;", "// mine\nend Ladder;")
    (built / LADDER / "Elements/C1.mo").unlink()
    with unchanged(built):
        assert execute("status", code=1).lines == [
            "ladder: out of step: 1 file to write, 1 to restore, 1 kept because you edited it",
            "  1 parameter change in the source",
            "  edited     modelica/Ladder/Ladder.mo",
            "  missing    modelica/Ladder/Elements/C1.mo  you deleted it",
            "  stale      modelica/Ladder/Elements/R2Parameters.mo  its generated text changed",
        ]
        everything = execute("status", "--verbose", code=1).lines
        assert len(everything) == 2 + 14
        assert "  in step    modelica/Ladder/Elements/C1Parameters.mo" in everything


def test_a_conflict(built: Path, execute: Execute) -> None:
    edit(built / "ladder.json", "220.5", "330")
    edit(built / LADDER / "Elements/R2Parameters.mo", "220.5", "221")
    conflict = (
        "  conflict   modelica/Ladder/Elements/R2Parameters.mo  component `R`: you set `R = 221`, the export changes"
    )
    for option in ([], ["--quiet"]):
        found = execute("status", *option, code=3).lines
        assert any(line.startswith(conflict) for line in found)
        file = Path(LADDER, "Elements/R2Parameters.mo")
        assert found[-1].startswith(
            f"  settle the conflict with `urdfsync resolve {file} --merge --prefer mine` (or --edit"
        )


def test_of_what_settles_conflicts_only_that_is_proposed_which_can(built: Path, execute: Execute) -> None:
    edit(built / LADDER / "Ladder.mo", "end Ladder;", "// mine\nend Ladder;")
    edit(built / LADDER / "Elements/R2Parameters.mo", "220.5", "221")
    for file in (built / ".urdfsync").rglob("*/*/*"):
        file.unlink()  # the bases
    for file in (built / ".urdfsync/robots").iterdir():
        file.unlink()
    edit(built / "ladder.json", "220.5", "330")
    for command in ("status", "diff"):
        found = execute(command, code=None).lines
        assert found[-1] == "  settle each conflict with `urdfsync resolve FILE --keep` (or --edit, --take)"


def test_many_stale_files_are_named_only_if_asked_for(built: Path, execute: Execute) -> None:
    elements = [{"name": f"R{n}", "between": ["in", "ground"], "ohm": 1.0} for n in range(10, 30)]
    (built / "ladder.json").write_text(json.dumps({"name": "many", "elements": elements}))
    found = execute("status", code=1).lines
    assert sum(line.startswith("  stale ") for line in found) == 19
    stale = sum(line.startswith("  stale ") for line in execute("status", "--verbose", code=1).lines)
    assert found[-1] == f"  … and {stale - 19} more stale files; --verbose shows them"


def test_a_broken_source_does_not_hide_the_others(built: Path, execute: Execute) -> None:
    configure('[robots.other]\nsource = "no.json"\npackage = "Other"\ndomain = "rcnetwork"\n')
    found = execute("status", code=2)
    assert found.lines == ["ladder: in step, 14 files"]
    assert "the source no.json does not exist" in found.errors[0]
    assert found.errors[1] == "other: 1 error, nothing was changed"
    assert [robot["failed"] for robot in execute("status", "--json", code=2).json["results"]] == [False, True]
    assert execute("status", "ladder").lines == ["ladder: in step, 14 files"]


def test_without_its_state_a_package_is_out_of_step(built: Path, execute: Execute) -> None:
    for file in (built / ".urdfsync/robots").iterdir():
        file.unlink()
    (robot,) = execute("status", "--json", code=1).json["results"]
    assert (robot["is_built"], robot["in_step"]) == (True, False)
    assert execute("status", code=1).lines == [
        "ladder: out of step: 12 already equal to the generated text",
    ]


def test_a_build_that_is_writing_is_waited_for(built: Path, execute: Execute) -> None:
    with build_lock(built / ".urdfsync", 0) as lock:
        lock.acquire()
        assert execute("status").lines == ["ladder: in step, 14 files"], "it only reads, and nothing is half written"


# Each action


def action(reason: Reason, waits: bool = False, path: str = "") -> Action:
    return Action(path or f"Arm/{reason}.mo", reason, Role.MODEL, "link tip", base="b", mine="m", is_waiting=waits)


def result_of(*actions: Action, changes: Changes | None = None) -> Result:
    writes = any(one.writes or one.reason is Reason.ADOPT for one in actions)
    place = Path("/project/Arm"), Path("/project")
    return Result("arm", "Arm", *place, Actions(actions), changes=changes, dry=True, writes=writes)


def said(result: Result, *, verbose: bool = False) -> list[str]:
    return list(map(str, lines(result, verbose=verbose)))


def changed(*classes: ChangeClass, noise: bool = False) -> Changes:
    new = 1 + 1e-9 if noise else 2.0
    return Changes(tuple(Change(("link tip", "mass"), ChangeKind.CHANGED, one, 1.0, new) for one in classes))


@pytest.mark.parametrize("reason", [reason for reason in Reason if reason is not Reason.FORGET])
def test_every_action_says_how_its_file_stands(reason: Reason) -> None:
    status = reason.status
    assert (status is FileStatus.CONFLICT) == (reason.kind is Kind.CONFLICT)
    assert (status in (FileStatus.STALE, FileStatus.MISSING)) == Action("A.mo", reason, Role.MODEL).writes
    shown, *_ = (line for line in said(result_of(action(reason)), verbose=True) if f"Arm/{reason}.mo" in line)
    assert shown.startswith(f"  {status}")
    assert not shown.endswith(".mo") or reason in (Reason.UNCHANGED, Reason.KEEP)


def test_a_conflict_of_a_renamed_element_is_where_the_file_is() -> None:
    conflict = Action("Arm/New.mo", Reason.CONFLICT, Role.MODEL, base="b", origin="Arm/Old.mo")
    move = Action("Arm/Other.mo", Reason.MOVE, Role.MODEL, base="b", origin="Arm/Same.mo")
    shown = "\n".join(said(result_of(conflict, move)))
    assert "conflict   /project/Arm/Old.mo" in shown
    assert "stale      /project/Arm/Other.mo" in shown


@pytest.mark.parametrize(
    ("kinds", "words"),
    [
        ([Reason.UNCHANGED], "in step, 1 file"),
        (
            [Reason.UNCHANGED, Reason.KEEP, Reason.ORPHAN, Reason.FORGET],
            "in step, 2 files, 1 kept because you edited it, 1 no longer generated but kept because you edited it",
        ),
        ([Reason.UNCHANGED, Reason.ADOPT], "out of step: 1 already equal to the generated text"),
        (
            [Reason.UPDATE, Reason.RESTORE, Reason.KEEP, Reason.CREATE],
            "out of step: 2 files to write, 1 to restore, 1 kept because you edited it",
        ),
        ([Reason.CONFLICT, Reason.UNOWNED, Reason.UNCHANGED], "out of step: 2 conflicts"),
    ],
)
def test_a_robot_in_one_line(kinds: list[Reason], words: str) -> None:
    found = result_of(*map(action, kinds))
    assert summary(found) == words
    assert found.in_step == words.startswith("in step")


def test_a_conflict_in_a_package_that_was_never_built() -> None:
    new = [Action(f"Arm/{name}.mo", Reason.CREATE, Role.MODEL) for name in "ab"]
    assert (
        summary(result_of(*new, Action("Arm/c.mo", Reason.UNOWNED, Role.MODEL)))
        == "not built yet: 2 files to write, 1 conflict"
    )


@pytest.mark.parametrize(
    ("kinds", "changes", "words"),
    [
        ([Reason.UNCHANGED, Reason.KEEP], None, []),
        ([Reason.DELETE, Reason.DELETE], None, []),
        (
            [Reason.UPDATE, Reason.CREATE, Reason.DELETE],
            changed(ChangeClass.PARAMETER, ChangeClass.STRUCTURAL, ChangeClass.PARAMETER),
            ["1 structural and 2 parameter changes in the source"],
        ),
        ([Reason.UNCHANGED], changed(ChangeClass.UNMODELLED), []),
        (
            [Reason.UPDATE],
            changed(ChangeClass.PARAMETER, noise=True),
            ["1 parameter change by rounding in the source"],
        ),
        (
            [Reason.UPDATE],
            Changes(generator=True),
            ["a template, an option or urdfsync itself changed"],
        ),
    ],
)
def test_what_the_next_build_does(kinds: list[Reason], changes: Changes | None, words: list[str]) -> None:
    shown = said(result_of(*map(action, kinds), changes=changes))
    assert [line.strip() for line in shown[1:] if ".mo" not in line] == words


def test_what_waits_for_a_conflict_is_counted_and_says_so() -> None:
    waiting = [action(Reason.UPDATE, waits=True, path=path) for path in ("a.mo", "b.mo")]
    found = result_of(action(Reason.CONFLICT), *waiting, action(Reason.CREATE), changes=changed(ChangeClass.STRUCTURAL))
    shown = said(found)
    assert shown[0].endswith("out of step: 1 file to write, 1 conflict, 2 files wait until the conflict is resolved")
    assert sum("waits until the conflicts are resolved" in line for line in shown) == 2


def test_robots_are_meant_by_their_sources_and_outputs_too(built: Path, execute: Execute) -> None:
    Path("other.json").write_text(Path("ladder.json").read_text())
    with Path("urdfsync.toml").open("a") as file:
        file.write('[robots.other]\nsource = "other.json"\npackage = "Other"\ndomain = "rcnetwork"\n')
    ladder, other = "ladder: in step, 14 files", "other: not built yet: 14 files to write"
    for arguments in (["ladder"], ["ladder.json"], [LADDER], [f"{LADDER}/Elements/R1.mo"]):
        assert execute("status", *arguments).lines == [ladder]
    assert execute("status", "modelica", "ladder.json", code=1).lines[:2] == [ladder, other]
    assert execute("status", "ladder", "other.json", code=1).lines[:2] == [ladder, other]
    assert "no robot `laddr.json`" in execute("status", "laddr.json", code=2).err
