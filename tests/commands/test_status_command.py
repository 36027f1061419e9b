"""`urdfsync status` as people and programs use it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from support.networks import LADDER, Snapshot, edit

from urdfsync import cli
from urdfsync.state.lock import build_lock

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def built(project: Path, capsys: Capture) -> Path:
    """A built project."""
    cli.main(["build"])
    capsys.readouterr()
    return project


def shown(capsys: Capture, *arguments: str, code: int = 0) -> list[str]:
    """What a status prints on the output stream, line by line."""
    capsys.readouterr()
    assert cli.main(["status", *arguments]) == code
    return capsys.readouterr().out.splitlines()


def warned(capsys: Capture, *arguments: str) -> list[str]:
    """What a status prints on the error stream."""
    capsys.readouterr()
    cli.main(["status", *arguments])
    return capsys.readouterr().err.splitlines()


def document(capsys: Capture, *arguments: str, code: int = 0) -> dict[str, Any]:
    capsys.readouterr()
    assert cli.main(["status", "--json", *arguments]) == code
    streams = capsys.readouterr()
    assert streams.err == ""
    loaded: dict[str, Any] = json.loads(streams.out)
    assert (loaded["command"], loaded["exit"]) == ("status", code)
    return loaded


# Files


def test_in_step(built: Path, capsys: Capture) -> None:
    assert shown(capsys) == ["ladder: in step, 14 files"]
    assert shown(capsys, "--quiet") == []


def test_never_built(project: Path, capsys: Capture, snapshot_of: Snapshot) -> None:
    before = snapshot_of(project)
    assert shown(capsys) == ["ladder: not built yet", "  a build: 14 files to write"]
    assert len(shown(capsys, "--verbose")) == 2 + 14
    assert snapshot_of(project) == before


def test_files_of_every_kind(built: Path, capsys: Capture, snapshot_of: Snapshot) -> None:
    edit(built / "ladder.json", "220.5", "330")
    edit(built / LADDER / "Ladder.mo", "end Ladder;", "// mine\nend Ladder;")
    (built / LADDER / "Elements/C1.mo").unlink()
    before = snapshot_of(built)
    assert shown(capsys) == [
        "ladder: out of step, 14 files: 1 missing, 1 stale, 1 edited",
        "  1 parameter change in the source",
        "  a build: 1 file to write, 1 to restore",
        "  edited     modelica/Ladder/Ladder.mo",
        "  missing    modelica/Ladder/Elements/C1.mo  it was deleted; written again",
        "  stale      modelica/Ladder/Elements/R2Parameters.mo  what it is made from changed",
    ]
    everything = shown(capsys, "--verbose")
    assert len(everything) == 3 + 14
    assert "  in step    modelica/Ladder/Elements/C1Parameters.mo" in everything
    assert snapshot_of(built) == before


def test_a_conflict(built: Path, capsys: Capture) -> None:
    edit(built / "ladder.json", "220.5", "330")
    edit(built / LADDER / "Elements/R2Parameters.mo", "220.5", "221")
    conflict = "  conflict   modelica/Ladder/Elements/R2Parameters.mo  you edited it"
    lines = shown(capsys, code=3)
    assert any(line.startswith(conflict) for line in lines)
    assert "`urdfsync resolve FILE --keep`" in lines[-1]
    assert any(line.startswith(conflict) for line in shown(capsys, "--quiet", code=3))


def test_many_stale_files_are_named_only_if_asked_for(built: Path, capsys: Capture) -> None:
    elements = [{"name": f"R{n}", "between": ["in", "ground"], "ohm": 1.0} for n in range(10, 30)]
    (built / "ladder.json").write_text(json.dumps({"name": "many", "elements": elements}))
    lines = shown(capsys)
    stale = int(lines[0].partition(": ")[2].split("files: ")[1].split()[0])
    assert sum(line.startswith("  stale ") for line in lines) == 19
    assert lines[-1] == f"  … and {stale - 19} more stale files; --verbose shows them"
    assert sum(line.startswith("  stale ") for line in shown(capsys, "--verbose")) == stale


# Robots


def test_a_broken_source_does_not_hide_the_others(built: Path, capsys: Capture) -> None:
    with (built / "urdfsync.toml").open("a") as file:
        file.write('[robots.other]\nsource = "no.json"\npackage = "Other"\ndomain = "rcnetwork"\n')
    assert shown(capsys, code=2) == ["ladder: in step, 14 files"]
    assert "the source no.json does not exist" in warned(capsys)[0]
    assert warned(capsys)[1] == "other: 1 error, so nothing can be said of its files"
    assert [robot["failed"] for robot in document(capsys, code=2)["robots"]] == [False, True]
    assert shown(capsys, "ladder") == ["ladder: in step, 14 files"]


def test_what_is_left_of_a_robot_that_is_no_longer_configured(built: Path, capsys: Capture) -> None:
    edit(built / "urdfsync.toml", "[robots.ladder]", "[robots.other]")
    edit(built / "urdfsync.toml", '"Ladder"', '"Other"')
    assert shown(capsys)[0] == "other: not built yet"
    (note,) = warned(capsys)
    assert "the state of `ladder` is still there" in note


def test_without_its_state_a_package_is_not_known_as_built(built: Path, capsys: Capture) -> None:
    for file in (built / ".urdfsync/robots").iterdir():
        file.unlink()
    (robot,) = document(capsys)["robots"]
    assert (robot["built"], robot["in_step"]) == (False, True)
    assert shown(capsys)[0] == "ladder: in step, 14 files"


def test_a_build_that_is_writing_is_waited_for(built: Path, capsys: Capture) -> None:
    with build_lock(built, built / ".urdfsync", 0) as lock:
        lock.acquire()
        assert shown(capsys) == ["ladder: in step, 14 files"], "it only reads, and nothing is half written"
