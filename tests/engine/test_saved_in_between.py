"""Somebody saves a file in the instant in which a build replaces it, and the source changes before the build is told.

The save stays, and is compared with what was written there before. No other file is taken for one that was edited.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from support.commands import Execute
from support.networks import edit, rename, run

from urdfsync.engine.result import Exit
from urdfsync.project.state import file_operations

R1 = "modelica/Ladder/Elements/R1Parameters.mo"
R2 = "modelica/Ladder/Elements/R2Parameters.mo"
MINE = "// mine\n"
SaveInBetween = Callable[..., None]


def set_ohms(source: Path, ohms: int) -> None:
    """Give all resistors so many ohms."""
    source.write_text(re.sub(r'"ohm": \d+', f'"ohm": {ohms}', source.read_text()))


@pytest.fixture
def save_in_between(project: Path, monkeypatch: pytest.MonkeyPatch) -> SaveInBetween:
    """A function that lets the next build be overtaken: R1's record is saved, and then something else happens."""

    def arrange(then: Callable[[], object], operation: str = "exchange") -> None:
        real = getattr(file_operations, operation)

        def saved(one: str, two: str) -> None:
            target = Path(two)
            if target == project / R1:
                monkeypatch.setattr(file_operations, operation, real)
                target.write_text((target.read_text() if target.exists() else "") + MINE)
                then()
            real(one, two)

        monkeypatch.setattr(file_operations, operation, saved)

    return arrange


def test_a_newer_source_is_written_to_all_other_files(
    project: Path, save_in_between: SaveInBetween, execute: Execute
) -> None:
    source = project / "ladder.json"
    execute("build")
    set_ohms(source, 70)
    save_in_between(lambda: set_ohms(source, 80))
    assert " 1 conflict\n" in execute("build", code=Exit.CONFLICT).out
    assert "80" in (project / R2).read_text()
    assert (project / R1).read_text().endswith(MINE)
    execute("resolve", R1, "--merge")
    assert "80" in (project / R1).read_text()
    assert (project / R1).read_text().endswith(MINE)
    execute("build", "--check")


def test_a_source_that_is_broken_for_a_while_changes_nothing_about_it(
    execute: Execute, project: Path, save_in_between: SaveInBetween
) -> None:
    source = project / "ladder.json"
    execute("build")
    set_ohms(source, 70)
    whole = source.read_text()
    save_in_between(lambda: os.truncate(source, 50))
    execute("build", code=Exit.ERROR)
    assert "70" not in (project / R2).read_text(), "a build that is overtaken stops"
    source.write_text(whole)
    set_ohms(source, 80)
    execute("build", code=Exit.CONFLICT)
    assert "80" in (project / R2).read_text()
    assert (project / R1).read_text().endswith(MINE)
    execute("resolve", R1, "--merge")
    assert "80" in (project / R1).read_text()


def test_a_first_build_keeps_what_somebody_puts_in_its_way(
    execute: Execute, project: Path, save_in_between: SaveInBetween
) -> None:
    save_in_between(lambda: set_ohms(project / "ladder.json", 80), "place")
    execute("build", code=Exit.CONFLICT)
    assert (project / R1).read_text() == MINE
    assert not (project / R2).exists(), "it waits"


def test_an_edit_whose_new_place_is_taken_stays_at_its_old_one(project: Path, save_in_between: SaveInBetween) -> None:
    rename("R1", "R9")
    run()
    edit(R1.replace("R1", "R9"), "100", "101")
    rename("R9", "R1")
    save_in_between(lambda: None, "place")
    assert [(found.code, found.file) for found in run().diagnostics] == [("no-class", str(Path(R1)))]
    assert (project / R1).read_text() == MINE
    assert "101" in (project / R1.replace("R1", "R9")).read_text()
