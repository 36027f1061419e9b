"""What a build records while something is open, and what the builds after it make of that.

`tests/scenarios/recorded.txt` has what users see of it.
"""

from __future__ import annotations

import itertools
import struct
from collections.abc import Callable
from pathlib import Path

import pytest
from support.commands import Execute
from support.networks import (
    BASES,
    C1,
    LADDER,
    MANIFEST,
    R1,
    RECORD,
    configure,
    drop,
    edit,
    kinds,
    mentioned,
    resistor,
    run,
    source,
    stored,
)
from support.urdfs import robot

from urdfsync.engine.actions import Choice, Reason
from urdfsync.engine.inspect.package_files import bare_hash

C2 = f"{LADDER}/Elements/C2.mo"


@pytest.fixture
def conflict(project: Path) -> str:
    """A package that was built, of which one file is in conflict since."""
    run()
    edit(C2, "end C2;", "  // mine\nend C2;")
    edit("ladder.json", '"farad": 4.7e-6', '"ohm": 7')
    assert kinds(run())[C2] is Reason.CONFLICT
    return C2


def test_a_base_is_rendered_with_the_import_that_it_was_written_with(conflict: str) -> None:
    table, whole = Path("step.csv"), f"{LADDER}/Ladder.mo"
    table.write_text(table.read_text().rstrip("\n") + "\n99,5\n")
    run()
    edit(whole, "end Ladder;", "// mine\nend Ladder;")
    bases = {one.path: one.base for one in run().conflict_texts}
    assert "4 rows" in (bases[whole] or "")


@pytest.mark.parametrize("how", ["a link", "empty", "deleted"])
def test_what_the_user_does_with_a_file_that_is_his_is_his_business(project: Path, how: str) -> None:
    run()
    edit(C1, "end C1", "  // mine\nend C1")
    drop("C1")
    run()
    run(choices={C1: Choice.KEEP})
    path = Path(C1)
    path.rename("kept.mo")
    if how == "a link":
        path.symlink_to(Path("kept.mo").resolve())
    elif how == "empty":
        path.touch()
    assert not run(full=True).failed
    resistor(150)
    assert run().writes
    assert "Elements/C1.mo" not in Path(MANIFEST).read_text()


def test_old_texts_go_with_later_builds_but_are_no_reason_for_one(project: Path) -> None:
    """Their hashes stay."""
    run()
    first = bare_hash(Path(RECORD).read_bytes())
    resistor(150)
    run()
    assert first in stored(), "the state before it mentions it"
    assert run(full=True, dry=True).in_step
    for ohm in range(150, 153):
        resistor(ohm + 1, before=ohm)
        run()
        assert mentioned() <= stored().keys()
    assert stored()[first] is None
    assert sum(text is not None for text in stored().values()) == len(mentioned()) + 1


def test_while_something_is_open_no_text_goes(project: Path) -> None:
    run()
    resistor(150)
    run()
    before = stored().keys()
    edit(R1, "end R1", "  // mine\nend R1")
    source('"ohm": 150', '"farad": 1e-6')
    assert run(full=True).conflicts
    assert before <= stored().keys()


def test_a_lost_file_of_bases_is_written_anew(project: Path) -> None:
    run()
    before = {file.name: file.read_bytes() for file in BASES.iterdir()}
    for digit in "3a":
        (BASES / digit).unlink()
    run()
    assert {file.name: file.read_bytes() for file in BASES.iterdir()} == before


@pytest.mark.parametrize("damage", [lambda _: b"", lambda text: text.replace(b"record", b"records")])
def test_damaged_lines_are_mended_and_say_nothing_of_the_package(
    project: Path, damage: Callable[[bytes], bytes]
) -> None:
    run()
    before = {file.name: file.read_bytes() for file in BASES.iterdir()}
    for file in BASES.iterdir():
        file.write_bytes(damage(file.read_bytes()))
    assert stored().keys() < mentioned()
    assert run(dry=True).in_step
    assert run().summary == "in step, 14 files, recorded state renewed: commit .urdfsync"
    assert {file.name: file.read_bytes() for file in BASES.iterdir()} == before


@pytest.mark.parametrize("edited", [False, True])
def test_line_ends_of_windows_are_no_edit_and_stay(project: Path, edited: bool) -> None:
    configure('on_conflict = "merge"\n')
    run()
    if edited:
        edit(RECORD, "end R1", "  // measured in May\nend R1")
    edit(RECORD, "\n", "\r\n")
    for request in ({}, {"full": True}):
        assert kinds(run(**request)) == ({RECORD: Reason.KEEP} if edited else {})
    resistor(150)
    assert kinds(run())[RECORD] is (Reason.MERGE if edited else Reason.UPDATE)
    text = Path(RECORD).read_bytes()
    assert b"150" in text
    assert (b"// measured in May" in text) is edited
    assert text.count(b"\r\n") == text.count(b"\n")
    assert kinds(run()) == ({RECORD: Reason.KEEP} if edited else {})


def test_an_import_counts_as_renewed_when_its_copy_is(conflict: str) -> None:
    Path(f"{LADDER}/Resources/step.txt").write_text("mine")
    table = Path("step.csv")
    table.write_text(table.read_text().rstrip("\n") + "\n99,5\n")
    run()
    assert Path(MANIFEST).read_text().count("source_hash") == 1


def test_the_base_of_what_was_put_aside_stays(project: Path) -> None:
    run()
    base = bare_hash(Path(RECORD).read_bytes())
    edit(RECORD, "end R1", "  // mine\nend R1")
    resistor(150)
    run(choices={RECORD: Choice.MERGE})
    for old, new in itertools.pairwise((220.5, 330, 331, 332)):
        source(f'"ohm": {old:g}', f'"ohm": {new:g}')
        run()
    assert base in stored(), "the merge may be undone and made again"


@pytest.mark.parametrize("change", ["other", "none"])
def test_a_mesh_with_bytes_that_look_like_line_ends_is_no_text_of_others(
    folder: Path, execute: Execute, change: str
) -> None:
    """This machine wrote it: it is replaced, or deleted with its link, without a copy."""
    mesh = struct.pack("<80sI9f3fH", b"a\rb\r\nc", 1, *[0.0] * 3, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    Path("tip.stl").write_bytes(mesh)
    Path("arm.urdf").write_text(_shown("tip.stl"))
    execute("init", "arm.urdf")
    execute("build")
    (imported,) = Path("modelica/Arm/Resources").iterdir()
    assert imported.read_bytes() == mesh
    if change == "other":
        Path("tip.stl").write_bytes(mesh.replace(b"b", b"d"))
    else:
        Path("arm.urdf").write_text(_shown())
    assert "[put-aside]" not in execute("build").err
    assert not imported.exists() or imported.read_bytes() != mesh
    assert not Path(".urdfsync/aside").exists()


def _shown(*meshes: str) -> str:
    shapes = "".join(f'<visual><geometry><mesh filename="{mesh}"/></geometry></visual>' for mesh in meshes)
    return robot(f'<link name="base">{shapes}</link>', name="arm")
