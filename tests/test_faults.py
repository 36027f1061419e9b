"""Outputs that are missing, of another kind, or not writable: a repair or one clear error, and no loss."""

from __future__ import annotations

import contextlib
import ctypes
import itertools
import os
import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from support import workplace
from support.commands import Execute
from support.networks import LADDER, MANIFEST, RECORD, edit
from support.networks import R1 as MODEL
from support.workplace import Contents

from urdfsync.commands import cli
from urdfsync.common.diagnostics import OutputError
from urdfsync.common.files import Tree
from urdfsync.engine.result import Exit

MINE = "// mine\n"
CAN_CHANGE_MODES = os.name == "posix"


def contents(folder: Path) -> Contents:
    """Every file below a folder except the lock and this machine's records; a link counts with its target."""
    found = workplace.contents(folder).items()
    return {n: c for n, c in found if c != "folder" and not re.search(r"\.urdfsync/(lock$|deps/)", n)}


@pytest.fixture
def edited(project: Path, execute: Execute) -> Path:
    """A built network of which one model is edited."""
    assert cli.main(["build"]) == Exit.IN_STEP
    (project / MODEL).write_text((project / MODEL).read_text() + MINE)
    execute("build")
    return project


@pytest.fixture
def stale(edited: Path) -> Path:
    """The network after a change of its source that concerns the edited model and its record."""
    edit("ladder.json", '"ohm": 100', '"ohm": 120')
    edit("ladder.json", '"R2"', '"R3"')
    return edited


def assert_error(execute: Execute, command: list[str], words: str) -> None:
    """The command exits with 2 after a line with the state of the robot, and a line about the error."""
    lines = execute(*command, code=Exit.ERROR).errors
    assert len([line for line in lines if ": error: " in line]) == 1, lines
    assert words in lines[-1].replace("\\", "/"), lines
    assert lines[:-1] in ([], ["ladder: 1 error, nothing was changed"])


# Gone


def test_a_package_that_was_removed_is_written_again_and_that_is_said(edited: Path, execute: Execute) -> None:
    before, model = contents(edited), (edited / MODEL).read_bytes()
    shutil.rmtree(edited / LADDER)
    assert execute("build").out == "ladder: 14 restored because you deleted them\n"
    generated = model.removesuffix(MINE.encode())
    other = {MANIFEST: b"", ".urdfsync/notes/ladder.json": b""}  # written files, and no edits
    assert {**before, **other} == {**contents(edited), MODEL: before[MODEL], **other}
    assert (edited / MODEL).read_bytes() == generated
    assert cli.main(["build", "--check"]) == Exit.IN_STEP


def test_what_is_left_of_a_package_keeps_its_edits(edited: Path, execute: Execute) -> None:
    before = contents(edited)
    for path in (edited / LADDER).rglob("*"):
        if path.is_file() and path != edited / MODEL:
            path.unlink()
    assert "13 restored because you deleted them" in execute("build").out
    assert contents(edited) == before


# Something else


def a_folder(path: Path, outside: Path) -> None:
    path.unlink()
    path.mkdir()
    (path / "mine.txt").write_text("mine")


def a_link(path: Path, outside: Path) -> None:
    path.rename(outside / path.name)
    path.symlink_to(outside / path.name)


def a_link_to_nothing(path: Path, outside: Path) -> None:
    shutil.rmtree(path) if path.is_dir() else path.unlink()
    path.symlink_to(outside / "nothing")


FILES = (MODEL, RECORD, f"{LADDER}/package.order", MANIFEST)
FOLDERS = (LADDER, f"{LADDER}/Elements", ".urdfsync", ".urdfsync/robots")
COMMANDS = (["build"], ["resolve", "--all", "--take"])
LINKS = (a_link, a_link_to_nothing)


@pytest.mark.parametrize(
    ("place", "replace", "command"),
    [
        *itertools.product(FILES, (a_folder, *LINKS), COMMANDS),
        *itertools.product(FOLDERS, LINKS, COMMANDS[:1]),
        *itertools.product(["modelica"], LINKS[:1], (["build"], ["build", "--check"], ["status"])),
    ],
)
def test_a_file_or_folder_that_is_something_else(
    stale: Path, tmp_path: Path, execute: Execute, place: str, replace: Callable[[Path, Path], None], command: list[str]
) -> None:
    outside = tmp_path / "outside"
    outside.mkdir()
    replace(stale / place, outside)
    before = contents(tmp_path)
    kind = "a folder" if replace is a_folder else "a symbolic link"
    assert_error(execute, command, f"{place}: error: {kind} is where ")
    assert contents(tmp_path) == before


# Not allowed


_ABOVE_MODES = 0b110
"""CAP_DAC_OVERRIDE and CAP_DAC_READ_SEARCH, by which root ignores the modes of files."""


@contextlib.contextmanager
def modes_count() -> Iterator[None]:
    """Modes of files are obeyed, even if the tests run as root."""
    if not CAN_CHANGE_MODES or os.geteuid() != 0:
        yield
        return
    libc = ctypes.CDLL(None, use_errno=True)
    if not hasattr(libc, "capset"):
        pytest.skip("root may do everything on this system")
    header, data = (ctypes.c_uint32 * 2)(0x20080522, 0), (ctypes.c_uint32 * 6)()
    assert libc.capget(header, data) == 0
    effective = data[0]
    data[0] = effective & ~_ABOVE_MODES
    assert libc.capset(header, data) == 0
    try:
        yield
    finally:
        data[0] = effective
        assert libc.capset(header, data) == 0


@contextlib.contextmanager
def mode(path: Path, bits: int) -> Iterator[None]:
    """A file or folder has this mode for a while."""
    old = path.stat().st_mode
    path.chmod(bits)
    try:
        with modes_count():
            yield
    finally:
        path.chmod(old)


denying = pytest.mark.skipif(not CAN_CHANGE_MODES, reason="modes mean nothing on this system")
DENIED = [
    (LADDER, 0o500, f"{LADDER}"),
    ("modelica", 0o000, "modelica/package.mo: error: "),
    (f"{LADDER}/Elements", 0o500, f"{LADDER}/Elements/"),
    (f"{LADDER}/Elements", 0o000, f"{LADDER}/Elements/"),
    (RECORD, 0o000, f"{RECORD}: error: "),
    (MODEL, 0o000, f"{MODEL}: error: "),
    (".urdfsync", 0o000, ".urdfsync"),
    (".urdfsync/robots", 0o500, ".urdfsync/robots/"),
    (".urdfsync/robots", 0o000, ".urdfsync/robots"),
    (MANIFEST, 0o000, f"{MANIFEST}: error: "),
    ("ladder.json", 0o000, "urdfsync.toml:2: error: robot `ladder`: the source ladder.json can't be read: "),
    ("urdfsync.toml", 0o000, "urdfsync.toml: error: the configuration can't be read: "),
]


@denying
@pytest.mark.parametrize(("place", "bits", "words"), DENIED, ids=[f"{place}-{bits:o}" for place, bits, _ in DENIED])
def test_what_is_not_allowed_is_one_error_and_changes_nothing(
    stale: Path, execute: Execute, place: str, bits: int, words: str
) -> None:
    before = contents(stale)
    with mode(stale / place, bits):
        assert_error(execute, ["build"], words)
    assert contents(stale) == before
    assert cli.main(["build"]) == Exit.IN_STEP
    assert (stale / MODEL).read_text().endswith(MINE)
    assert "120" in (stale / RECORD).read_text()
    assert (stale / LADDER / "Elements/R3.mo").exists()


@denying
@pytest.mark.parametrize("command", [["build"], ["build", "--check"], ["build", "--dry-run"], ["status"]])
def test_a_project_in_step_needs_no_rights(edited: Path, command: list[str]) -> None:
    before = contents(edited)
    with contextlib.ExitStack() as stack:
        for folder in sorted(path for path in edited.rglob("*") if path.is_dir()):
            stack.enter_context(mode(folder, 0o500))
        assert cli.main(command) == Exit.IN_STEP
    assert contents(edited) == before


def test_nothing_outside_of_its_root_is_read(tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("secret")
    with pytest.raises(OutputError, match="leaves"):
        Tree(tmp_path / "root").read(tmp_path / "secret")
