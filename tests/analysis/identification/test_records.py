"""How `identify` reads the records on disk, and writes fitted numbers into them."""

from __future__ import annotations

import errno
import itertools
import os
from pathlib import Path

import pytest
from support.commands import Execute
from support.files import models, unchanged

from urdfsync.common import files

LINKS = Path("modelica/Gripper/Links")
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


def edit(file: Path, old: str, new: str) -> None:
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))


@pytest.mark.slow
def test_the_address_of_a_mesh_is_no_edit(gripper: Path, execute: Execute) -> None:
    """A string may contain `//`, which begins a comment elsewhere."""
    Path("part.obj").write_text(TRIANGLE)
    visual = '<visual><geometry><mesh filename="part.obj"/></geometry></visual>'
    edit(Path("gripper.urdf"), "</inertial>", f"</inertial>{visual}")
    execute("build")
    assert any('"modelica://' in file.read_text() for file in LINKS.glob("*Parameters.mo"))
    assert "joint drive" in execute("identify", "gripper", "log.csv", "--joint", "drive").out


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("0.1 + 0.1", "inertial.mass is edited to `0.1 + 0.1`, which is no number; write a number"),
        ("-0.2", "inertial.mass is edited to `-0.2`; write a mass above 0"),
        ("0", "inertial.mass is edited to `0`; write a mass above 0"),
    ],
)
def test_an_edit_that_no_body_can_have_is_named(gripper: Path, execute: Execute, value: str, words: str) -> None:
    edit(LINKS / "RightParameters.mo", "mass = ", f"mass = {value}, // was ")
    with unchanged(gripper):
        assert words in execute("identify", "gripper", "log.csv", "--write", code=2).err


@pytest.mark.slow
def test_a_number_may_have_a_comment_behind_it(gripper: Path, execute: Execute) -> None:
    edit(LINKS / "RightParameters.mo", "mass = ", "mass = 0.25 /* weighed */, // was ")
    assert execute("identify", "gripper", "log.csv").err == ""
    edit(LINKS / "RightParameters.mo", "*/,", "*/ + 0.1,")
    assert "which is no number" in execute("identify", "gripper", "log.csv", code=2).err


@pytest.mark.slow
def test_a_file_that_cant_be_written_leaves_all_as_they_were(
    gripper: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = itertools.count()

    def put(file: Path, content: bytes) -> None:
        if next(calls) == 1:
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(file))
        files.put(file, content)

    monkeypatch.setattr("urdfsync.analysis.identification.records.put", put)
    before = models()
    assert "it can't be written" in execute("identify", "gripper", "log.csv", "--write", code=2).err
    assert models() == before
    assert next(calls) == 3, "the first file was written, and taken back"


@pytest.mark.slow
def test_a_second_fit_of_the_same_log_edits_nothing(gripper: Path, execute: Execute) -> None:
    execute("identify", "gripper", "log.csv", "--write")
    with unchanged(gripper):
        told = execute("identify", "gripper", "log.csv", "--write").lines[-1]
    assert told == "  nothing written: no change is sure, so each number stays"
