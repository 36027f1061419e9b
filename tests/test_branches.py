"""Two branches that both export, edit and build: one build brings all in step. Random: `test_state_machine`."""

from __future__ import annotations

import contextlib
import json
import re
import subprocess
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from support.branches import add, drop, export, note, set_value
from support.commands import Execute
from support.files import fresh_models, models
from support.git import NEEDS_GIT, Repository
from support.networks import C1, MODEL, R2, RECORD, configure, edit, kinds, run

from urdfsync.engine.actions import Choice, Reason

pytestmark = NEEDS_GIT


@pytest.fixture
def repository(project: Path, monkeypatch: pytest.MonkeyPatch) -> Repository:
    """The network, built and committed."""
    export(list)
    run()
    repository = Repository(project, monkeypatch)
    repository.commit()
    return repository


def branch(repository: Repository, name: str, *steps: Callable[[], object], start: str = "main") -> None:
    """Make a branch from another one; build and commit each step."""
    repository.git("checkout", "-q", "-B", name, start)
    for step in steps:
        step()
        run()
        repository.commit()


def unite(repository: Repository, how: str) -> None:
    """Bring the branch `theirs` together with `ours`, and check `ours` out."""
    start = repository.git("merge-base", "ours", "theirs").strip()
    repository.git("checkout", "-q", "ours")
    if how == "merge":
        repository.git("merge", "-q", "--no-edit", "theirs")
    elif how == "cherry-pick":
        repository.git("cherry-pick", f"{start}..theirs")
    else:
        repository.git("rebase", "-q", "theirs")


def without_notes(found: Mapping[str, str]) -> dict[str, str]:
    return {path: re.sub(r"  // .*\n", "", text) for path, text in found.items()}


@pytest.mark.parametrize("how", ["merge", "cherry-pick", "rebase"])
def test_exports_and_edits_of_two_branches_meet(repository: Repository, tmp_path: Path, how: str) -> None:
    branch(repository, "ours", lambda: set_value("R1", 150), lambda: note(C1, "ours"))
    branch(repository, "theirs", lambda: set_value("C2", 5e-6), lambda: note(R2, "theirs"), start="main")
    unite(repository, how)
    result = run()
    assert result.in_step
    assert kinds(result) == {C1: Reason.KEEP, R2: Reason.KEEP}
    assert without_notes(models()) == fresh_models(tmp_path / "fresh")
    assert "ours" in Path(C1).read_text()
    assert "theirs" in Path(R2).read_text()


def merge_and_settle(repository: Repository) -> None:
    """Merge `theirs` into `ours`, with or without conflicts."""
    repository.git("checkout", "-q", "ours")
    repository.merge("theirs")
    repository.commit()


def unite_two_elements(repository: Repository, execute: Execute, how: str, command: str = "merge") -> None:
    """Two branches add an element each; git merges by elements, by lines, or leaves markers of either kind."""
    Path("ladder.json").write_text(json.dumps(json.loads(Path("ladder.json").read_text()), indent=1))
    if how == "driver":
        Path(".gitattributes").write_text("*.mo merge=urdfsync\n")
        execute("merge-driver", "--install")
    repository.git("config", "merge.conflictStyle", "diff3" if how == "diff3" else "merge")
    branch(repository, "start", list)
    branch(repository, "ours", lambda: add("R8"), start="start")
    branch(repository, "theirs", lambda: add("R9"), start="start")
    with contextlib.suppress(subprocess.CalledProcessError):
        repository.git(command, "ours")
    repository.git("checkout", "-q", "theirs", "--", "ladder.json")
    add("R8")


@pytest.mark.parametrize("how", ["driver", "lines", "diff3"])
@pytest.mark.parametrize("is_committed", [False, True])
def test_what_git_made_of_two_builds_is_nobodys_edit(
    repository: Repository, execute: Execute, tmp_path: Path, how: str, is_committed: bool
) -> None:
    unite_two_elements(repository, execute, how)
    if is_committed:
        repository.commit()
    result = run()
    assert not result.conflicts
    assert models() == fresh_models(tmp_path / "fresh")
    repository.git("add", "-A")
    assert run().in_step


@pytest.mark.parametrize("how", ["driver", "lines"])
def test_what_is_taken_out_of_a_merge_is_an_edit(repository: Repository, execute: Execute, how: str) -> None:
    unite_two_elements(repository, execute, how)
    if how == "lines":
        edit(MODEL, "<<<<<<< HEAD\n", "")
        edit(MODEL, "=======\n", "")
        Path(MODEL).write_text(re.sub(r">>>>>>> .*\n", "", Path(MODEL).read_text()))
    edit(MODEL, "  connect(elementR8.n, ground.p);\n", "")
    assert len(run().conflicts) == 1


def test_what_git_made_of_two_builds_is_put_aside(repository: Repository, execute: Execute) -> None:
    unite_two_elements(repository, execute, "driver")
    merged = Path(MODEL).read_text()
    run()
    assert Path(MODEL).read_text() != merged
    run(choices={MODEL: Choice.UNDO})
    assert Path(MODEL).read_text() == merged


@pytest.mark.parametrize("command", ["rebase", "cherry-pick"])
def test_what_a_rebase_stops_at_is_nobodys_edit(
    repository: Repository, execute: Execute, tmp_path: Path, command: str
) -> None:
    unite_two_elements(repository, execute, "lines", command)
    assert "<<<<<<<" in Path(MODEL).read_text()
    assert not run().conflicts
    assert models() == fresh_models(tmp_path / "fresh")
    repository.git("add", "-A")
    assert run().in_step


def test_an_edit_of_what_git_merged_stays(repository: Repository, execute: Execute, tmp_path: Path) -> None:
    configure('on_conflict = "merge"\n')
    note(MODEL, "mine")
    unite_two_elements(repository, execute, "driver")
    assert kinds(run())[MODEL] is Reason.MERGE
    assert "// mine" in Path(MODEL).read_text()
    assert without_notes(models()) == fresh_models(tmp_path / "fresh")


def test_an_edit_with_an_ambiguous_base_is_never_kept_in_silence(repository: Repository) -> None:
    branch(repository, "ours", lambda: set_value("R1", 150), lambda: note(RECORD, "ours"))
    branch(repository, "theirs", lambda: set_value("R1", 170))
    merge_and_settle(repository)
    edit("ladder.json", "150", "170")
    (found,) = run().conflicts
    assert found.action.path == RECORD
    run(choices={RECORD: Choice.TAKE})
    assert "170" in Path(RECORD).read_text()
    assert run().in_step


def test_a_deletion_against_a_change_and_its_return(repository: Repository, tmp_path: Path) -> None:
    branch(repository, "ours", lambda: drop("C2"))
    branch(repository, "theirs", lambda: set_value("C2", 5e-6))
    merge_and_settle(repository)
    assert not run().conflicts
    wanted = fresh_models(tmp_path / "fresh")
    assert {path: text for path, text in models().items() if path in wanted} == wanted
    export(lambda found: found.append({"name": "C2", "between": ["out", "ground"], "farad": 5e-6}))
    assert not run().conflicts
    assert models() == fresh_models(tmp_path / "fresh")
    assert run().in_step


def test_a_source_that_goes_back_to_an_earlier_export_after_the_merge(repository: Repository, tmp_path: Path) -> None:
    earlier = Path("ladder.json").read_text()
    branch(repository, "ours", lambda: set_value("R1", 150))
    branch(repository, "theirs", lambda: add("R8"))
    unite(repository, "merge")
    Path("ladder.json").write_text(earlier)
    assert not run().conflicts
    assert models() == fresh_models(tmp_path / "fresh")


def test_an_orphan_that_one_branch_keeps_stays_the_users(repository: Repository) -> None:
    """The other branch still generates the file, and records another text."""

    def keep() -> None:
        note(C1, "ours")
        drop("C1")
        run()
        run(choices={C1: Choice.KEEP})

    branch(repository, "ours", keep)
    branch(repository, "theirs", lambda: set_value("C2", 5e-6))
    merge_and_settle(repository)
    run()
    assert "// ours" in Path(C1).read_text()
    assert run().in_step


def test_branches_that_merge_each_other(repository: Repository, tmp_path: Path) -> None:
    branch(repository, "ours", lambda: set_value("R1", 150))
    branch(repository, "theirs", lambda: set_value("C2", 5e-6))
    repository.git("branch", "-q", "before", "ours")
    unite(repository, "merge")
    set_value("R2", 330)
    run()
    repository.commit()
    repository.git("checkout", "-q", "theirs")
    repository.git("merge", "-q", "--no-edit", "before")
    set_value("C1", 3e-6)
    run()
    repository.commit()
    unite(repository, "merge")
    assert not run().conflicts
    assert models() == fresh_models(tmp_path / "fresh")
    assert run().in_step
