"""`build --repair`: what two branches built, merged by git, markers in the manifest and all."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from subprocess import CalledProcessError
from typing import Any

import pytest
from support.git import NEEDS_GIT, Repository

from urdfsync import config
from urdfsync.engine.actions import Kind
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.outcome import Result
from urdfsync.state.record import Choice

LADDER = "modelica/Ladder"
MANIFEST = ".urdfsync/robots/ladder.toml"
Snapshot = Callable[[Path], dict[str, tuple[int, bytes]]]


def run(**request: Any) -> Result:
    loaded = config.load(Path("urdfsync.toml"))
    (result,) = build(loaded, loaded.robots, BuildOptions(**request))
    return result


def edit(path: str, old: str, new: str) -> None:
    text = Path(path).read_text()
    assert old in text
    Path(path).write_text(text.replace(old, new))


def kinds(result: Result) -> dict[str, Kind]:
    return {
        a.path.removeprefix(f"{LADDER}/"): a.kind for a in result.actions if a.kind is not Kind.UNCHANGED and not a.held
    }


@pytest.fixture
def merged(project: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two branches, each with changes of source and package, merged; git could not merge the manifest."""
    run()
    repository = Repository(project, monkeypatch)
    repository.commit()
    repository.git("switch", "-q", "-c", "other")
    edit("ladder.json", '"ohm": 220.5', '"ohm": 330')
    edit(f"{LADDER}/Elements/C1.mo", "end C1;", "// theirs\nend C1;")
    run()
    repository.commit()
    repository.git("switch", "-q", "main")
    edit("ladder.json", '"ohm": 100', '"ohm": 150')
    edit(f"{LADDER}/Elements/R1Parameters.mo", "end R1", "  // ours\nend R1")
    assert run(choices={f"{LADDER}/Elements/R1Parameters.mo": Choice.MERGE}).conflicts == []
    repository.commit()
    with pytest.raises(CalledProcessError):
        repository.git("merge", "-q", "other")
    assert "<<<<<<<" in (project / MANIFEST).read_text()
    return project


@NEEDS_GIT
def test_a_state_with_markers_is_refused_with_the_way_out(merged: Path, snapshot_of: Snapshot) -> None:
    before = snapshot_of(merged)
    result = run()
    (found,) = result.diagnostics
    assert result.failed
    assert found.file == MANIFEST
    assert found.line
    assert "--repair" in found.hint
    assert snapshot_of(merged) == before


@NEEDS_GIT
def test_a_repaired_state_knows_what_each_branch_wrote(merged: Path) -> None:
    result = run(repair=True)
    assert not result.failed, result.diagnostics
    assert [found.code for found in result.diagnostics] == ["repaired-state"]
    text = (merged / f"{LADDER}/Elements/R1Parameters.mo").read_text()
    assert "// ours" in text
    assert "// theirs" in (merged / f"{LADDER}/Elements/C1.mo").read_text()
    assert "330" in (merged / f"{LADDER}/Elements/R2Parameters.mo").read_text()
    assert "<<<<<<<" not in (merged / MANIFEST).read_text()
    assert kinds(run())["Elements/C1.mo"] is Kind.KEEP


def test_a_repair_of_what_is_sound_changes_nothing(project: Path, snapshot_of: Snapshot) -> None:
    run()
    before = snapshot_of(project)
    assert run(repair=True).in_step
    assert snapshot_of(project) == before


def test_damage_that_leaves_nothing_counts_as_a_lost_state(project: Path) -> None:
    run()
    edit(f"{LADDER}/Elements/C1.mo", "end C1;", "// mine\nend C1;")
    (project / MANIFEST).write_text("not a manifest")
    result = run(repair=True)
    assert [action.path for action in result.conflicts] == [f"{LADDER}/Elements/C1.mo"]
    assert set(kinds(result).values()) == {Kind.UNOWNED, Kind.ADOPT}
    assert "// mine" in (project / f"{LADDER}/Elements/C1.mo").read_text()
