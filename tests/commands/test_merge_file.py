"""`urdfsync merge-file`: as `git merge-file`, but by elements; git calls it as a merge driver."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT, Repository

BASE = """\
model Arm "An arm"
  Body body(m = 11.5);

equation
  connect(frame_a, body.frame_a);
end Arm;
"""
MINE = BASE.replace("\nequation", "  Sensor sensor;\n\nequation").replace("An arm", "My arm")
OTHER = BASE.replace("\nequation", "  Body tool;\n\nequation").replace("11.5", "12.1")
BOTH = MINE.replace("\nequation", "  Body tool;\n\nequation").replace("11.5", "12.1")


def write(mine: str, base: str, other: str) -> tuple[str, str, str]:
    """Three files; git's have no suffix either."""
    for name, text in (("mine", mine), ("base", base), ("other", other)):
        Path(name).write_text(text)
    return "mine", "base", "other"


def test_both_sides_add_at_one_place(folder: Path, execute: Execute) -> None:
    assert execute("merge-file", *write(MINE, BASE, OTHER)).lines == []
    assert (folder / "mine").read_text() == BOTH


def test_what_both_changed_stands_between_markers(folder: Path, execute: Execute) -> None:
    mine = MINE.replace("11.5", "99")
    (folder / "mine").touch(mode=0o640)
    options = ("-L", "ours", "-L", "before", "-L", "theirs", "--marker-size", "9", "--diff3")
    assert execute("merge-file", *options, *write(mine, BASE, OTHER), code=1).err == (
        "mine: warning: 1 conflict between markers; settle them in the file [conflict]\n"
    )
    versions = [f"  Body body(m = {mass});\n" for mass in ("99", "11.5", "12.1")]
    markers = [f"{sign * 9}{label}\n" for sign, label in zip("<|=>", (" ours", " before", "", " theirs"), strict=True)]
    block = "".join(f"{marker}{text}" for marker, text in zip(markers, [*versions, ""], strict=True))
    assert (folder / "mine").read_text() == BOTH.replace("  Body body(m = 12.1);\n", block)
    assert (folder / "mine").stat().st_mode & 0o777 == 0o640


def test_the_result_may_be_printed(folder: Path, execute: Execute) -> None:
    assert execute("merge-file", "-p", *write(MINE, BASE, OTHER)).out == BOTH
    assert (folder / "mine").read_text() == MINE


def test_any_text_merges_by_lines(folder: Path, execute: Execute) -> None:
    execute("merge-file", *write("a\nb\nmine\n", "a\nb\nc\n", "other\nb\nc\n"))
    assert (folder / "mine").read_text() == "other\nb\nmine\n"


def test_elements_that_do_not_fit_together_merge_by_lines(folder: Path, execute: Execute) -> None:
    """A declaration that is there twice is for people, as after any merge of git's."""
    mine, other = BASE.replace("  Body", "  Real x;\n  Body"), BASE.replace("\nequation", "  Real x, y;\n\nequation")
    execute("merge-file", *write(mine, BASE, other))
    assert (folder / "mine").read_text() == mine.replace("\nequation", "  Real x, y;\n\nequation")


def test_errors_have_the_exit_code_that_git_knows(folder: Path, execute: Execute) -> None:
    write(MINE, BASE, OTHER)
    assert execute("merge-file", "mine", "nowhere", "other", code=255).err.startswith("nowhere: error: ")
    (folder / "base").write_bytes(b"\xff")
    assert execute("merge-file", "mine", "base", "other", code=255).err == "base: error: it is not UTF-8 [no-text]\n"
    assert "--stdout and --json" in execute("merge-file", "-p", "--json", "mine", "base", "other", code=255).out
    execute("merge-file", "mine", "base", code=255)
    assert (folder / "mine").read_text() == MINE


@pytest.mark.parametrize("size", ["0", "-3"])
def test_markers_are_never_without_length(size: str, folder: Path, execute: Execute) -> None:
    """As in git, which takes seven then."""
    execute("merge-file", "--marker-size", size, *write(MINE.replace("11.5", "99"), BASE, OTHER), code=1)
    assert "<<<<<<< mine\n" in (folder / "mine").read_text()


@NEEDS_GIT
def test_git_merges_with_it(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    repository, model = Repository(folder, monkeypatch), folder / "Arm.mo"
    command = f"'{sys.executable}' -m urdfsync merge-file --path %P --marker-size %L -L ours -L base -L theirs %A %O %B"
    repository.git("config", "merge.urdfsync.driver", command)
    (folder / ".gitattributes").write_text("*.mo merge=urdfsync\n")
    for branch, text in (("base", BASE), ("export", OTHER), ("edited", MINE)):
        repository.git("checkout", "-q", "-b", branch, *(["base"] if text == MINE else []))
        model.write_text(text)
        repository.commit(branch)
    repository.git("merge", "-q", "export")
    assert model.read_text() == BOTH


def test_messages_call_the_file_what_git_does(folder: Path, execute: Execute) -> None:
    files = write(MINE.replace("11.5", "99"), BASE, OTHER)
    assert execute("merge-file", "--path", "Arm.mo", *files, code=1).err.startswith("Arm.mo: warning: 1 conflict")
