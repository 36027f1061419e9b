"""What the last build said of a source is counted by the next commands, unless --verbose."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute
from support.files import unchanged
from support.urdfs import joint, link, robot

COUNTED = ["arm: still 1 finding (axis-not-unit); --verbose shows it"]
NOTES = Path(".urdfsync/notes/arm.json")


def write(axis: str = "0 0 2", mass: float = 1.0) -> None:
    elements = [link("base", 1.0), link("tip", mass), joint("elbow", "revolute", "base", "tip", axis=axis)]
    Path("arm.urdf").write_text(robot(*elements))


@pytest.fixture(autouse=True)
def built(folder: Path, execute: Execute) -> Path:
    """A project whose source has an axis of a wrong length."""
    write()
    execute("init", "arm.urdf")
    assert "axis" in execute("build").err
    return folder


def test_the_next_build_counts_what_the_last_one_said(execute: Execute) -> None:
    assert execute("build").errors == COUNTED
    assert execute("status").errors == COUNTED
    assert execute("build", "--check").errors == COUNTED
    assert "axis" in execute("build", "--verbose").err
    assert execute("build", "--quiet").errors == []
    assert [one["code"] for one in execute("build", "--format=json").json["results"][0]["diagnostics"]] == [
        "axis-not-unit"
    ]


def test_what_was_mended_is_said_in_full_when_it_is_back(execute: Execute) -> None:
    write(axis="0 0 1")
    assert execute("build").err == ""
    write()
    assert "axis" in execute("build").err


def test_what_a_quiet_build_hides_is_not_told(execute: Execute) -> None:
    write(axis="0 0 1")
    assert execute("build", "--quiet").err == ""
    write()
    assert execute("build", "--quiet").err == ""
    assert "axis" in execute("build").err


def test_what_a_dry_run_says_is_not_remembered(execute: Execute) -> None:
    write(axis="0 0 3")
    for command in (["build", "--dry-run"], ["build", "--check"], ["status"], ["diff"]):
        with unchanged(Path(), but=".urdfsync/lock"):
            assert "length 3" in execute(*command, code=None).err
    assert "length 3" in execute("build").err


def test_an_error_hides_nothing_and_forgets_nothing(execute: Execute) -> None:
    write(mass=-1.0)
    for _ in range(2):
        assert "error: " in execute("build", code=2).err
    write()
    assert execute("build").errors == COUNTED


@pytest.mark.parametrize("place", [NOTES, NOTES.parent])
def test_what_is_lost_or_something_else_is_not_used(execute: Execute, tmp_path: Path, place: Path) -> None:
    other = tmp_path / "other"
    other.write_bytes(NOTES.read_bytes())
    NOTES.unlink()
    if place != NOTES:
        place.rmdir()
    place.symlink_to(other)
    before = other.read_bytes()
    assert "axis" in execute("build").err
    assert other.read_bytes() == before


def test_what_a_copy_of_the_notes_says_was_told_is_told_again(execute: Execute) -> None:
    """Anybody may have committed it."""
    content = NOTES.read_bytes()
    NOTES.unlink()
    NOTES.write_bytes(content)
    assert "axis" in execute("build").err
