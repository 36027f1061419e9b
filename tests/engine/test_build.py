"""Builds of the RC network domain: what is written, what is left alone, and what is refused."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from support.files import models, unchanged
from support.networks import LADDER, Snapshot, edit, run, said
from support.networks import inner_kinds as kinds
from support.networks import set_keys as configure

from urdfsync.engine.actions import Reason
from urdfsync.engine.result import Exit, exit_code
from urdfsync.modelica.stamp import split

# What a build writes


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


def test_a_package_that_moves_takes_edits_along_and_leaves_what_is_the_users(project: Path) -> None:
    run()
    (project / LADDER / "Bench.mo").write_text("within Ladder;\nmodel Bench\nend Bench;\n")
    edit(f"{LADDER}/package.order", "Ladder\n", "Bench\nLadder\n")
    edit(f"{LADDER}/Elements/R1.mo", "end R1;", "// mine\nend R1;")
    edit(f"{LADDER}/Ladder.mo", "end Ladder;", "// mine, too\nend Ladder;")
    configure(package='"Filter"')
    result = run()
    left = {path.relative_to(project / LADDER).as_posix() for path in (project / LADDER).rglob("*.*")}
    assert left == {"package.mo", "package.order", "Bench.mo"}
    moved, _ = split((project / "modelica/Filter/Elements/R1.mo").read_text())
    assert moved.startswith("within Filter.Elements;\n")
    assert moved.endswith("// mine\nend R1;\n")
    assert models()["modelica/Filter/Filter.mo"].endswith("// mine, too\nend Filter;\n")
    assert (project / LADDER / "package.order").read_text() == "Bench\n"
    assert said(result) == [
        "urdfsync.toml:1: warning: the package moved from modelica/Ladder to modelica/Filter; these files stay "
        "there, since urdfsync did not write them: modelica/Ladder/Bench.mo, modelica/Ladder/package.mo, "
        "modelica/Ladder/package.order; move the files that you need, then delete the old folder [left-behind]"
    ]
    assert run().in_step
    assert run().diagnostics == ()


def test_what_stays_in_a_former_output_folder_is_told_as_long_as_it_is_there(project: Path) -> None:
    run()
    mine = project / LADDER / "Mine.mo"
    mine.write_text("within Ladder;\nmodel Mine\nend Mine;\n")
    configure(output='"lib"')
    assert "these files stay there" in said(run())[0]
    for _ in range(2):
        assert said(run()) == [
            f"{LADDER}: warning: there is another class `Ladder`; move the files that you need, then delete it "
            "[left-behind]"
        ]
    shutil.move(mine, project / "lib/Ladder/Mine.mo")
    shutil.rmtree(project / LADDER)
    assert not any("left-behind" in found for found in said(run()))


def test_a_package_that_cant_move_stays(project: Path, snapshot_of: Snapshot) -> None:
    run()
    foreign = project / "modelica/Filter/Ladder.mo"
    foreign.parent.mkdir()
    foreign.write_text("mine")
    configure(package='"Filter"', **{"class": '"Ladder"'})
    before = snapshot_of(project / LADDER)
    for _ in range(2):
        assert exit_code([run()]) is Exit.CONFLICT
        assert snapshot_of(project / LADDER) == before
    foreign.unlink()
    assert exit_code([run()]) is Exit.IN_STEP
    assert not (project / LADDER).exists()


# Other versions
