"""`urdfsync status` as people and programs use it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from support.commands import Execute
from support.files import unchanged
from support.networks import LADDER, configure, edit

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
            "  R2: ohm 220.5 → 330 Ω (+49.7 %)",
            "  edited     modelica/Ladder/Ladder.mo",
            "  missing    modelica/Ladder/Elements/C1.mo  you deleted it",
            "  stale      modelica/Ladder/Elements/R2Parameters.mo  it differs from its generated text",
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
        file = Path(LADDER, "Elements/R2Parameters.mo")
        assert found[-1] == f"  settle the conflict with `urdfsync resolve {file} --keep` (or --edit, --take)"


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
    assert "the source no.json does not exist" in found.errors[1]
    assert found.errors[0] == "other: 1 error, nothing was changed"
    assert [robot["failed"] for robot in execute("status", "--format=json", code=2).json["results"]] == [False, True]
    assert execute("status", "ladder").lines == ["ladder: in step, 14 files"]


def test_without_its_state_a_package_is_in_step(built: Path, execute: Execute) -> None:
    for file in (built / ".urdfsync/robots").iterdir():
        file.unlink()
    (robot,) = execute("status", "--format=json").json["results"]
    assert (robot["is_built"], robot["in_step"]) == (True, True)
    assert execute("status").lines == ["ladder: in step, 14 files"]


def test_a_build_that_is_writing_is_waited_for(built: Path, execute: Execute) -> None:
    with build_lock(built / ".urdfsync", 0) as lock:
        lock.acquire()
        assert execute("status").lines == ["ladder: in step, 14 files"], "it only reads, and nothing is half written"


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
