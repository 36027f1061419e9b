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


# Files


def test_in_step(built: Path, execute: Execute) -> None:
    assert execute("status").lines == ["ladder: in step, 14 files"]
    assert execute("status", "--quiet").lines == []


def test_never_built(project: Path, execute: Execute) -> None:
    with unchanged(project):
        assert execute("status").lines == ["ladder: not built yet", "  a build: 14 files to write"]
        assert len(execute("status", "--verbose").lines) == 2 + 14


def test_files_of_every_kind(built: Path, execute: Execute) -> None:
    edit(built / "ladder.json", "220.5", "330")
    edit(built / LADDER / "Ladder.mo", "end Ladder;", "// mine\nend Ladder;")
    (built / LADDER / "Elements/C1.mo").unlink()
    with unchanged(built):
        assert execute("status").lines == [
            "ladder: out of step, 14 files: 1 missing, 1 stale, 1 edited",
            "  1 parameter change in the source",
            "  a build: 1 file to write, 1 to restore",
            "  edited     modelica/Ladder/Ladder.mo",
            "  missing    modelica/Ladder/Elements/C1.mo  it was deleted; written again",
            "  stale      modelica/Ladder/Elements/R2Parameters.mo  what it is made from changed",
        ]
        everything = execute("status", "--verbose").lines
        assert len(everything) == 3 + 14
        assert "  in step    modelica/Ladder/Elements/C1Parameters.mo" in everything


def test_a_conflict(built: Path, execute: Execute) -> None:
    edit(built / "ladder.json", "220.5", "330")
    edit(built / LADDER / "Elements/R2Parameters.mo", "220.5", "221")
    conflict = "  conflict   modelica/Ladder/Elements/R2Parameters.mo  you edited it"
    lines = execute("status", code=3).lines
    assert any(line.startswith(conflict) for line in lines)
    assert "`urdfsync resolve FILE --keep`" in lines[-1]
    assert any(line.startswith(conflict) for line in execute("status", "--quiet", code=3).lines)


def test_many_stale_files_are_named_only_if_asked_for(built: Path, execute: Execute) -> None:
    elements = [{"name": f"R{n}", "between": ["in", "ground"], "ohm": 1.0} for n in range(10, 30)]
    (built / "ladder.json").write_text(json.dumps({"name": "many", "elements": elements}))
    lines = execute("status").lines
    stale = int(lines[0].partition(": ")[2].split("files: ")[1].split()[0])
    assert sum(line.startswith("  stale ") for line in lines) == 19
    assert lines[-1] == f"  … and {stale - 19} more stale files; --verbose shows them"
    assert sum(line.startswith("  stale ") for line in execute("status", "--verbose").lines) == stale


# Robots


def test_a_broken_source_does_not_hide_the_others(built: Path, execute: Execute) -> None:
    configure('[robots.other]\nsource = "no.json"\npackage = "Other"\ndomain = "rcnetwork"\n')
    assert execute("status", code=2).lines == ["ladder: in step, 14 files"]
    assert "the source no.json does not exist" in execute("status", code=None).errors[0]
    assert execute("status", code=None).errors[1] == "other: 1 error, so nothing can be said of its files"
    assert [robot["failed"] for robot in execute("status", "--json", code=2).json["robots"]] == [False, True]
    assert execute("status", "ladder").lines == ["ladder: in step, 14 files"]


def test_what_is_left_of_a_robot_that_is_no_longer_configured(built: Path, execute: Execute) -> None:
    edit(built / "urdfsync.toml", "[robots.ladder]", "[robots.other]")
    edit(built / "urdfsync.toml", '"Ladder"', '"Other"')
    assert execute("status").lines[0] == "other: not built yet"
    (note,) = execute("status", code=None).errors
    assert "the state of `ladder` is still there" in note


def test_without_its_state_a_package_is_not_known_as_built(built: Path, execute: Execute) -> None:
    for file in (built / ".urdfsync/robots").iterdir():
        file.unlink()
    (robot,) = execute("status", "--json").json["robots"]
    assert (robot["built"], robot["in_step"]) == (False, True)
    assert execute("status").lines[0] == "ladder: in step, 14 files"


def test_a_build_that_is_writing_is_waited_for(built: Path, execute: Execute) -> None:
    with build_lock(built, built / ".urdfsync", 0) as lock:
        lock.acquire()
        assert execute("status").lines == ["ladder: in step, 14 files"], "it only reads, and nothing is half written"
