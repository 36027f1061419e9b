"""Builds of the RC network domain: what is written, and what is left alone."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.files import unchanged
from support.networks import LADDER, Snapshot, edit, run
from support.networks import inner_kinds as kinds

from urdfsync.engine.actions import Reason


def test_a_first_build_writes_the_package_and_a_second_one_nothing(project: Path, snapshot_of: Snapshot) -> None:
    before = snapshot_of(project)
    planned = run(dry=True)
    assert snapshot_of(project) == before
    result = run()
    assert planned.actions == result.actions
    assert set(kinds(result).values()) == {Reason.CREATE}
    written = {path.relative_to(project / LADDER).as_posix() for path in (project / LADDER).rglob("*.*")}
    assert written == set(kinds(result))
    assert (project / LADDER / "package.order").read_text() == "Elements\nLadder\n"
    assert "R = 220.5" in (project / LADDER / "Elements/R2Parameters.mo").read_text()
    assert (project / LADDER / "Resources/step.txt").read_text().startswith("#1\ndouble signal(4, 2)\n")
    with unchanged(project):
        assert run().in_step
        assert run(full=True).in_step


@pytest.mark.parametrize(("old", "new"), [("  ", "    "), ("\n", "\r\n")], ids=["blanks", "line ends"])
def test_changed_white_space_touches_nothing(project: Path, old: str, new: str) -> None:
    """So that two machines that check out text in their own way record the same, too."""
    run()
    place = LADDER if new.isspace() and old == "  " else "."
    edit("ladder.json", old, new)
    with unchanged(project / place):
        assert run().in_step
    assert run().in_step
