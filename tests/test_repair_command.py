"""`build --repair`: what two branches built, merged by git, markers in the manifest and all."""

from __future__ import annotations

from pathlib import Path
from subprocess import CalledProcessError

import pytest
from support.files import unchanged
from support.git import NEEDS_GIT, Repository
from support.networks import C1, LADDER, MANIFEST, RECORD, edit, kinds, resistor, run, run_all

from urdfsync.engine.actions import Kind
from urdfsync.state.record import Choice


@NEEDS_GIT
def test_a_repaired_state_knows_what_each_branch_wrote(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run()
    repository = Repository(project, monkeypatch)
    repository.commit()
    repository.git("switch", "-q", "-c", "other")
    resistor(330, before=220.5)
    edit(C1, "end C1;", "// theirs\nend C1;")
    run()
    repository.commit()
    repository.git("switch", "-q", "main")
    resistor(150)
    edit(RECORD, "end R1", "  // ours\nend R1")
    assert run(choices={RECORD: Choice.MERGE}).conflicts == []
    repository.commit()
    with pytest.raises(CalledProcessError):
        repository.git("merge", "-q", "other")
    with unchanged(project):
        (found,) = run_all()[0].diagnostics
        assert (found.file, found.line > 0, "--repair" in found.hint) == (MANIFEST, True, True)
    assert [found.code for found in run(repair=True).diagnostics] == ["repaired-state"]
    assert "// ours" in Path(RECORD).read_text()
    assert "// theirs" in Path(C1).read_text()
    assert "330" in Path(LADDER, "Elements/R2Parameters.mo").read_text()
    assert "<<<<<<<" not in Path(MANIFEST).read_text()
    assert kinds(run())[C1] is Kind.KEEP


def test_damage_that_leaves_nothing_counts_as_a_lost_state(project: Path) -> None:
    run()
    edit(C1, "end C1;", "// mine\nend C1;")
    Path(MANIFEST).write_text("not a manifest")
    result = run(repair=True)
    assert [action.path for action in result.conflicts] == [C1]
    assert set(kinds(result).values()) == {Kind.UNOWNED, Kind.ADOPT}
    assert "// mine" in Path(C1).read_text()
