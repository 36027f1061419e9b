"""What becomes of hand edits, build after build: merged, moved, kept, never lost."""

from __future__ import annotations

import builtins
import errno
import json
import os
import shutil
import tomllib
import zlib
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from urdfsync import config
from urdfsync.engine.actions import Kind
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.outcome import Exit, Result, exit_code
from urdfsync.state.record import Choice

Snapshot = Callable[[Path], dict[str, tuple[int, bytes]]]

LADDER = "modelica/Ladder"
R1 = f"{LADDER}/Elements/R1.mo"
RECORD = f"{LADDER}/Elements/R1Parameters.mo"
ASIDE = ".urdfsync/conflicts/ladder/Elements"


def run(**request: Any) -> Result:
    """Build the robot `ladder` of the working folder."""
    loaded = config.load(Path("urdfsync.toml"))
    (result,) = build(loaded, loaded.robots, BuildOptions(**request))
    assert not result.failed, result.diagnostics
    return result


def edit(path: str, old: str, new: str) -> None:
    text = Path(path).read_bytes().decode()
    assert old in text
    Path(path).write_bytes(text.replace(old, new).encode())


def source(old: str, new: str) -> None:
    edit("ladder.json", old, new)


def kinds(result: Result) -> dict[str, Kind]:
    return {a.path: a.kind for a in result.actions if a.kind is not Kind.UNCHANGED and not a.held}


def as_rc_pair() -> None:
    """Make a capacitor of the resistor R1: its model is another, its record, too."""
    source('"R1", "between": ["in", "middle"], "ohm": 100', '"R1", "between": ["in", "middle"], "farad": 1e-9')


def merging() -> None:
    with Path("urdfsync.toml").open("a") as file:
        file.write('on_conflict = "merge"\n')


@pytest.fixture
def conflict(project: Path) -> Path:
    """A project in which the user and the source changed the model of R1, at different places."""
    run()
    edit(R1, "end R1;", "  annotation (Documentation);\nend R1;")
    as_rc_pair()
    return project


# Conflicts and what settles them


def test_base_generated_and_merge_are_put_aside(conflict: Path) -> None:
    before = (conflict / R1).read_bytes()
    assert exit_code([run()]) is Exit.CONFLICT
    assert (conflict / R1).read_bytes() == before
    base, generated = ((conflict / ASIDE / f"R1.{name}.mo").read_text() for name in ("base", "generated"))
    assert "parameters.R*i" in base
    assert "parameters.C*der(v)" in generated
    merge = (conflict / ASIDE / "R1.merge.mo").read_text()
    assert "annotation (Documentation);" in merge
    assert "parameters.C*der(v)" in merge
    assert run().conflict_texts[0].base == base


def test_a_merge_with_markers_is_not_put_aside_as_modelica(project: Path) -> None:
    run()
    edit(RECORD, "100", "101")
    source('"ohm": 100', '"ohm": 150')
    run()
    assert "<<<<<<< mine" in (project / ASIDE / "R1Parameters.merge.txt").read_text()
    assert not (project / ASIDE / "R1Parameters.merge.mo").exists()


def test_what_is_put_aside_comes_back_if_somebody_deletes_it(conflict: Path, snapshot_of: Snapshot) -> None:
    run()
    before = snapshot_of(conflict)
    shutil.rmtree(conflict / ".urdfsync/conflicts")
    run()
    assert {path: text for path, (_, text) in snapshot_of(conflict).items()} == {p: t for p, (_, t) in before.items()}


def test_keep_is_remembered_until_something_new_would_be_written(conflict: Path) -> None:
    run()
    mine = (conflict / R1).read_bytes()
    kept = run(choices={R1: Choice.KEEP})
    assert kinds(kept)[R1] is Kind.KEEP
    assert not kept.conflicts
    assert kinds(run()) == {R1: Kind.KEEP}
    assert (conflict / R1).read_bytes() == mine
    source('"farad": 1e-9', '"ohm": 7')
    assert kinds(run())[R1] is Kind.CONFLICT


def test_settling_one_conflict_releases_what_waited(conflict: Path) -> None:
    waited = run()
    held = {action.path for action in waited.actions if action.held}
    assert RECORD in held, "its parameter has another name"
    done = run(choices={R1: Choice.TAKE})
    assert not any(action.held for action in done.actions)
    assert "Capacitance" in (conflict / RECORD).read_text() or "C" in (conflict / RECORD).read_text()


def test_a_choice_for_what_does_not_conflict_changes_nothing(project: Path, snapshot_of: Snapshot) -> None:
    run()
    edit(R1, "end R1;", "// mine\nend R1;")
    run()
    before = snapshot_of(project)
    run(choices={R1: Choice.TAKE, RECORD: Choice.KEEP})
    assert snapshot_of(project) == before


def test_a_file_that_was_there_before_can_be_kept_or_taken(project: Path) -> None:
    Path(R1).parent.mkdir(parents=True)
    Path(R1).write_text("within Ladder.Elements;\nmodel R1\nend R1;\n")
    assert kinds(run())[R1] is Kind.UNOWNED
    assert run(choices={R1: Choice.MERGE}).conflicts, "there is no base to merge with"
    assert not run(choices={R1: Choice.KEEP}).conflicts
    assert Path(R1).read_text() == "within Ladder.Elements;\nmodel R1\nend R1;\n"
    assert kinds(run()) == {R1: Kind.KEEP}


def test_an_orphan_can_be_let_go_or_deleted(project: Path) -> None:
    run()
    orphans = [f"{LADDER}/Elements/{name}.mo" for name in ("R1", "C1")]
    for path in orphans:
        edit(path, "equation", "// mine\nequation")
    text = json.loads(Path("ladder.json").read_text())
    text["elements"] = [e for e in text["elements"] if e["name"] not in ("R1", "C1")]
    Path("ladder.json").write_text(json.dumps(text))
    assert [kinds(run())[path] for path in orphans] == [Kind.ORPHAN, Kind.ORPHAN]
    run(choices={orphans[0]: Choice.KEEP, orphans[1]: Choice.TAKE})
    assert Path(orphans[0]).exists()
    assert not Path(orphans[1]).exists()
    assert kinds(run()) == {}


# Merges


def test_a_record_with_an_edit_elsewhere_merges(project: Path) -> None:
    merging()
    run()
    edit(RECORD, "end R1", "  // measured in May\nend R1")
    source('"ohm": 100', '"ohm": 150')
    result = run()
    assert kinds(result)[RECORD] is Kind.MERGE
    text = Path(RECORD).read_text()
    assert "// measured in May" in text
    assert "150" in text
    assert kinds(run()) == {RECORD: Kind.KEEP}
    source('"ohm": 150', '"ohm": 100')
    run()
    assert "// measured in May" in Path(RECORD).read_text()
    assert "150" not in Path(RECORD).read_text()


def test_contradicting_edits_are_never_merged(project: Path) -> None:
    merging()
    run()
    edit(RECORD, "100", "101")
    source('"ohm": 100', '"ohm": 150')
    assert kinds(run())[RECORD] is Kind.CONFLICT
    assert kinds(run(choices={RECORD: Choice.MERGE}))[RECORD] is Kind.CONFLICT
    assert "101" in Path(RECORD).read_text()


def test_who_writes_the_new_value_himself_has_no_conflict(project: Path, snapshot_of: Snapshot) -> None:
    run()
    edit(RECORD, "100", "150")
    edit(RECORD, "end R1", "  // measured in May\nend R1")
    source('"ohm": 100', '"ohm": 150')
    mine = Path(RECORD).read_bytes()
    assert kinds(run())[RECORD] is Kind.INCLUDED
    assert Path(RECORD).read_bytes() == mine
    before = snapshot_of(project)
    assert kinds(run()) == {RECORD: Kind.KEEP}
    assert snapshot_of(project) == before


def test_edits_of_a_file_with_other_line_endings_survive(project: Path) -> None:
    merging()
    run()
    edit(RECORD, "end R1", "  // measured in May\nend R1")
    edit(RECORD, "\n", "\r\n")
    source('"ohm": 100', '"ohm": 150')
    run()
    text = Path(RECORD).read_bytes()
    assert b"150" in text
    assert text.count(b"\r\n") == text.count(b"\n")


# Renames


def rename(old: str, new: str) -> None:
    source(f'"{old}"', f'"{new}"')


def test_edits_move_with_their_elements_new_name(project: Path) -> None:
    run()
    edit(R1, "equation", "  // a sensor here\nequation")
    rename("R1", "Shunt")
    result = run()
    new = f"{LADDER}/Elements/Shunt.mo"
    assert kinds(result)[new] is Kind.MOVE
    assert kinds(result)[R1] is Kind.LEAVE
    assert not Path(R1).exists()
    text = Path(new).read_text()
    assert "// a sensor here" in text
    assert "model Shunt" in text
    assert "R1" not in text
    assert kinds(run()) == {new: Kind.KEEP}


def test_edits_that_contradict_the_new_name_wait_where_they_are(project: Path) -> None:
    run()
    edit(R1, "model R1", "model R1 // best of all")
    edit(R1, "R1Parameters parameters", "MyParameters parameters")
    mine = Path(R1).read_bytes()
    rename("R1", "Shunt")
    new = f"{LADDER}/Elements/Shunt.mo"
    result = run()
    assert kinds(result) == {new: Kind.CONFLICT}
    assert result.conflict_texts[0].origin == R1
    assert Path(R1).read_bytes() == mine
    assert not Path(new).exists()
    again = run()
    assert kinds(again) == {new: Kind.CONFLICT}
    assert again.conflict_texts == result.conflict_texts, "the base is recorded, although the model knows R1 no more"
    recorded = tomllib.loads((project / ".urdfsync/robots/ladder.toml").read_text())
    assert recorded["files"]["Elements/Shunt.mo"]["origin"] == "Elements/R1.mo"


@pytest.mark.parametrize("choice", [Choice.KEEP, Choice.TAKE])
def test_a_choice_lets_the_file_go_to_its_new_place(project: Path, choice: Choice) -> None:
    run()
    edit(R1, "R1Parameters parameters", "MyParameters parameters")
    mine = Path(R1).read_text()
    rename("R1", "Shunt")
    run()
    new = f"{LADDER}/Elements/Shunt.mo"
    assert not run(choices={new: choice}).conflicts
    assert not Path(R1).exists()
    assert (Path(new).read_text() == mine) is (choice is Choice.KEEP)
    assert run().in_step
    assert f"{LADDER}/Elements/R1Parameters.mo" not in kinds(run())


def test_a_second_rename_finds_the_file_that_still_waits(project: Path) -> None:
    run()
    edit(R1, "R1Parameters parameters", "MyParameters parameters")
    rename("R1", "Shunt")
    run()
    rename("Shunt", "Branch")
    result = run()
    new = f"{LADDER}/Elements/Branch.mo"
    assert kinds(result) == {new: Kind.CONFLICT}
    assert result.conflict_texts[0].origin == R1
    rename("Branch", "R1")
    assert kinds(run()) == {R1: Kind.KEEP}, "the old name is back, and nothing is new for it"


def test_a_file_that_the_user_renamed_himself_is_merged_in_its_place(project: Path) -> None:
    merging()
    run()
    new = f"{LADDER}/Elements/Shunt.mo"
    edit(R1, "equation", "  // a sensor here\nequation")
    Path(R1).rename(new)
    rename("R1", "Shunt")
    assert kinds(run())[new] is Kind.MERGE
    assert "model Shunt" in Path(new).read_text()
    assert "// a sensor here" in Path(new).read_text()


# Bases that are lost


_LOCAL = ("base", "conflicts", "lock", "journal", "undo", "folders.json")
"""What is not committed of the state folder."""


def clone(project: Path, to: Path) -> Path:
    """The project without what is not committed."""
    shutil.copytree(project, to, ignore=shutil.ignore_patterns(*_LOCAL))
    return to


@pytest.mark.parametrize("built", [False, True], ids=["before the conflict", "in the conflict"])
def test_a_clone_reaches_the_same_result(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, built: bool
) -> None:
    run()
    edit(RECORD, "end R1", "  // measured in May\nend R1")
    edit(f"{LADDER}/Elements/C1.mo", "equation", "  // a sensor here\nequation")
    source('"ohm": 100', '"ohm": 150')
    rename("C1", "Filter")
    if built:
        run()
        run()
    other = clone(project, tmp_path / "clone")
    first = run()
    run(choices={RECORD: Choice.MERGE})
    monkeypatch.chdir(other)
    assert run().conflict_texts == first.conflict_texts
    run(choices={RECORD: Choice.MERGE})

    def files(folder: Path) -> dict[str, bytes]:
        found = (path for path in folder.rglob("*") if path.is_file() and path.name != "folders.json")
        return {path.relative_to(folder).as_posix(): path.read_bytes() for path in found}

    assert files(other) == files(project)
    assert "150" in (other / RECORD).read_text()


def test_a_clone_keeps_bases_before_they_can_be_rendered_no_more(project: Path) -> None:
    run()
    shutil.rmtree(project / ".urdfsync/base")
    assert run().in_step
    assert list((project / ".urdfsync/base/ladder").iterdir())
    edit(R1, "equation", "  // a sensor here\nequation")
    with Path("urdfsync.toml").open("a") as file:
        file.write('templates = "own"\n')
    own = project / "own/element"
    own.mkdir(parents=True)
    text = (Path(__file__).parent / "rcnetwork/templates/element/model.mo.jinja").read_text()
    (own / "model.mo.jinja").write_text(text.replace("end <<", "  annotation (Icon);\nend <<"))
    (standoff,) = [s for s in run().conflict_texts if s.path == R1]
    assert standoff.merge is not None
    assert standoff.merge.text is not None


def test_without_its_base_a_conflict_has_no_merge(project: Path) -> None:
    run()
    edit(RECORD, "end R1", "  // measured in May\nend R1")
    source('"ohm": 100', '"ohm": 150')
    shutil.rmtree(project / ".urdfsync/base")
    (project / ".urdfsync/robots/ladder.json").unlink()
    (standoff,) = run().conflict_texts
    assert standoff.base is None
    assert standoff.merge is None
    assert sorted(path.name for path in (project / ASIDE).iterdir()) == ["R1Parameters.generated.mo"]


def test_a_damaged_base_counts_as_lost(project: Path) -> None:
    run()
    for kept in (project / ".urdfsync/base/ladder").iterdir():
        kept.write_bytes(zlib.compress(zlib.decompress(kept.read_bytes()).replace(b"R1", b"XX")))
    edit(RECORD, "end R1", "  // measured in May\nend R1")
    source('"ohm": 100', '"ohm": 150')
    (standoff,) = run().conflict_texts
    assert standoff.base is not None, "rendered again from what is recorded"
    assert "XX" not in standoff.base


# Choices that wait for others


@pytest.fixture
def two_conflicts(project: Path) -> tuple[str, str]:
    """The records of R1 and R2 conflict."""
    run()
    other = RECORD.replace("R1", "R2")
    for path, number in ((RECORD, "100"), (other, "220.5")):
        edit(path, number, f"{number} + 1")
    source('"ohm": 100', '"ohm": 150')
    source('"ohm": 220.5', '"ohm": 300')
    run()
    return RECORD, other


@pytest.mark.parametrize("choice", [Choice.KEEP, Choice.TAKE])
def test_a_choice_holds_until_the_others_are_made(two_conflicts: tuple[str, str], choice: Choice) -> None:
    one, two = two_conflicts
    assert [action.path for action in run(choices={one: choice}).conflicts] == [two]
    assert [action.path for action in run().conflicts] == [two]
    assert not run(choices={two: choice}).conflicts
    assert all(("+ 1" in Path(path).read_text()) is (choice is Choice.KEEP) for path in two_conflicts)
    assert run().in_step


def test_an_edit_after_a_choice_asks_again(two_conflicts: tuple[str, str]) -> None:
    one, two = two_conflicts
    run(choices={one: Choice.TAKE})
    assert [action.path for action in run().conflicts] == [two]
    edit(one, "end R1", "  // an afterthought\nend R1")
    assert [action.path for action in run().conflicts] == [one, two]


@pytest.mark.parametrize("choice", [Choice.KEEP, Choice.TAKE])
def test_choices_are_remembered_while_the_package_can_not_move(two_conflicts: tuple[str, str], choice: Choice) -> None:
    text = Path("urdfsync.toml").read_text().replace('"Ladder"', '"Plant.Ladder"')
    Path("urdfsync.toml").write_text(text + "create_parents = true\n")
    one, two = (path.replace("modelica/", "modelica/Plant/") for path in two_conflicts)
    assert [action.path for action in run().conflicts] == [one, two]
    assert [action.path for action in run(choices={one: choice}).conflicts] == [two]
    assert [action.path for action in run().conflicts] == [two]
    assert not run(choices={two: choice}).conflicts
    assert run().in_step
    assert all(("+ 1" in Path(path).read_text()) is (choice is Choice.KEEP) for path in (one, two))


def test_taking_an_orphan_waits_like_everything_else(two_conflicts: tuple[str, str]) -> None:
    orphan = f"{LADDER}/Elements/C2.mo"
    edit(orphan, "equation", "// mine\nequation")
    source('"C2", "between": ["out", "ground"], "farad": 4.7e-6', '"C9", "between": ["out", "in"], "farad": 1')
    assert kinds(run())[orphan] is Kind.ORPHAN
    run(choices={orphan: Choice.TAKE})
    assert Path(orphan).exists()
    run(choices=dict.fromkeys(two_conflicts, Choice.TAKE))
    assert not Path(orphan).exists()


def test_what_is_put_aside_goes_with_the_robots_name(two_conflicts: tuple[str, str], project: Path) -> None:
    text = Path("urdfsync.toml").read_text().replace("robots.ladder", "robots.leiter")
    Path("urdfsync.toml").write_text(text)
    assert len(run().conflicts) == 2
    assert [path.name for path in (project / ".urdfsync/conflicts").iterdir()] == ["leiter"]


def test_an_edit_made_while_a_rename_waits_follows_it(project: Path) -> None:
    run()
    edit(RECORD.replace("R1", "R2"), "220.5", "221")
    source('"ohm": 220.5', '"ohm": 300')
    rename("R1", "Shunt")
    run()
    edit(R1, "equation", "  // a sensor here\nequation")
    run(choices={RECORD.replace("R1", "R2"): Choice.KEEP})
    assert "// a sensor here" in Path(f"{LADDER}/Elements/Shunt.mo").read_text()
    assert not Path(R1).exists()


# What a kept file needs


def drop(name: str) -> None:
    """Take an element out of the source."""
    network = json.loads(Path("ladder.json").read_text())
    network["elements"] = [element for element in network["elements"] if element["name"] != name]
    Path("ladder.json").write_text(json.dumps(network))


def test_an_orphan_that_is_let_go_takes_its_record_along(project: Path) -> None:
    run()
    edit(R1, "equation", "// mine\nequation")
    drop("R1")
    found = kinds(run())
    assert (found[R1], found[RECORD]) == (Kind.ORPHAN, Kind.NEEDED)
    run(choices={R1: Choice.KEEP})
    order = Path(f"{LADDER}/Elements/package.order")
    assert Path(RECORD).exists()
    assert {"R1", "R1Parameters"} <= set(order.read_text().split())
    assert kinds(run()) == {}


def test_an_orphan_that_is_deleted_takes_its_line_along(project: Path) -> None:
    run()
    edit(R1, "equation", "// mine\nequation")
    drop("R1")
    run()
    run(choices={R1: Choice.TAKE})
    assert not {"R1", "R1Parameters"} & set(Path(f"{LADDER}/Elements/package.order").read_text().split())
    assert not Path(RECORD).exists()


@pytest.mark.parametrize("path", [R1, RECORD, f"{LADDER}/Elements/package.order"])
def test_merge_markers_are_never_taken_for_an_edit(project: Path, snapshot_of: Snapshot, path: str) -> None:
    merging()
    run()
    text = Path(path).read_text()
    Path(path).write_text(f"<<<<<<< HEAD\n{text}=======\n{text}>>>>>>> theirs\n")
    source('"ohm": 100', '"ohm": 150')
    before = snapshot_of(project)
    loaded = config.load(Path("urdfsync.toml"))
    for request in (BuildOptions(), BuildOptions(dry=True), BuildOptions(choices={path: Choice.MERGE})):
        (result,) = build(loaded, loaded.robots, request)
        (found,) = result.diagnostics
        assert exit_code([result]) is Exit.ERROR
        assert (found.file, found.line, found.code) == (path, 1, "merge-markers")
    assert snapshot_of(project) == before


def test_a_file_with_windows_line_ends_keeps_them(project: Path) -> None:
    run()
    edit(RECORD, "\n", "\r\n")
    source('"ohm": 100', '"ohm": 150')
    assert kinds(run())[RECORD] is Kind.UPDATE
    text = Path(RECORD).read_bytes()
    assert b"150" in text
    assert text.count(b"\r\n") == text.count(b"\n")
    assert kinds(run()) == {}


# Names that the package has no more


def test_a_merge_that_mentions_what_is_gone_is_a_conflict(project: Path) -> None:
    merging()
    run()
    whole = f"{LADDER}/Ladder.mo"
    edit(whole, "equation", "  Real power = C1.v*C1.i;\n\nequation")
    rename("C1", "Tank")
    for _ in range(2):  # the second time, the state knows the new name already
        (standoff,) = run().conflict_texts
        assert standoff.path == whole
        assert standoff.merge is not None
        assert standoff.merge.text is None
        line = standoff.merge.proposal.split("\n").index("  Real power = C1.v*C1.i;") + 1
        assert standoff.rejected == f"the merge mentions `C1`, which the package has no more (line {line})"


def test_uses_are_named_as_long_as_a_conflict_waits(project: Path) -> None:
    run()
    write_user(project)
    edit(f"{LADDER}/Ladder.mo", "equation", "  Real power = C1.v*C1.i;\n\nequation")
    drop("C1")
    first, second = run(), run()
    assert first.conflicts
    assert warnings(first) == warnings(second)
    assert len(warnings(first)) == 3


def warnings(result: Result) -> list[str]:
    """Where texts use names that the package loses, and what is said of it."""
    assert {one.code for one in result.diagnostics} <= {"vanished-name"}
    return [f"{Path(one.file).name}:{one.line}: {one.message}; {one.hint}" for one in result.diagnostics]


def test_own_classes_that_use_what_is_gone_are_named(project: Path) -> None:
    run()
    mine = Path(f"{LADDER}/Elements/Mine.mo")
    mine.write_text('within Ladder.Elements;\nmodel Mine "C1"\n  // C1\n  extends C1;\nend Mine;\n')
    edit(f"{LADDER}/Elements/R2.mo", "equation", "  C1 other;\n\nequation")
    drop("C1")
    gone, hint = "but the package has no `C1` any more", "adapt your text to what the package is now"
    assert warnings(run()) == [
        f"Mine.mo:4: `C1` is used here, {gone}; {hint}",
        f"R2.mo:7: `C1` is used here, {gone}; {hint}",
    ]
    assert not run().diagnostics


USER = {
    "MyLadder.mo": """\
within;
model MyLadder
  extends Ladder.Ladder(redeclare Modelica.Electrical.Analog.Basic.Resistor C1, R1(R = 2));
  Ladder.Elements.C1 other;
  Real C3 = C1.v;
equation
  connect(other.p, C1.p);
end MyLadder;
""",
    "bench/MyBench.mo": """\
model MyBench "Tries C1"
  MyLadder mine;
  Real u = mine.C1.v + mine.R1.v;
end MyBench;
""",
    "Stranger.mo": "model Stranger\n  C1 other;\nend Stranger;\n",
    "Broken.mo": "model Broken\n  Ladder.Ladder C1\nend Broken;\n",
}


def write_user(project: Path) -> None:
    for path, text in USER.items():
        (project / "modelica" / path).parent.mkdir(exist_ok=True)
        (project / "modelica" / path).write_text(text)


def test_files_around_the_package_that_use_what_is_gone_are_named(project: Path) -> None:
    run()
    write_user(project)
    drop("C1")
    gone, hint = "but the package has no `C1` any more", "adapt your text to what the package is now"
    expected = [
        f"Broken.mo:2: `C1` is used here, {gone}; {hint}",
        f"MyBench.mo:3: `mine.C1.v` is used here, {gone}; {hint}",
        f"MyLadder.mo:3: `C1` is used here, {gone}; {hint}; also in lines 4, 5, 7",
    ]
    assert sorted(warnings(run(dry=True))) == expected
    assert sorted(warnings(run())) == expected
    assert not run().diagnostics


def test_uses_of_a_renamed_element_get_its_new_name(project: Path) -> None:
    run()
    write_user(project)
    rename("C1", "Tank")
    assert sorted(warnings(run()))[2].endswith("no `C1` any more; it is `Tank` now; also in lines 4, 5, 7")


def test_a_package_that_moves_is_told_by_its_new_name(project: Path) -> None:
    run()
    write_user(project)
    edit("urdfsync.toml", 'package = "Ladder"', 'package = "Rungs"')
    found = [line for line in warnings(run()) if line.startswith("MyLadder")]
    assert found[0].endswith("but the package has no `Ladder` any more; it is `Rungs` now; also in line 4")


def test_a_record_stays_while_a_file_of_the_users_needs_it(project: Path) -> None:
    run()
    mine, record = project / "modelica" / "Mine.mo", f"{LADDER}/Elements/C1Parameters.mo"
    mine.write_text("model Mine\n  parameter Ladder.Elements.C1Parameters p;\nend Mine;\n")
    drop("C1")
    result = run()
    assert kinds(result)[record] is Kind.NEEDED
    assert not result.diagnostics
    assert Path(record).exists()
    assert kinds(run()) == {record: Kind.NEEDED}
    assert "C1Parameters" in Path(f"{LADDER}/Elements/package.order").read_text().split()
    mine.write_text("model Mine\n  // Ladder.Elements.C1Parameters\nend Mine;\n")
    assert kinds(run())[record] is Kind.DELETE
    assert not Path(record).exists()


def test_a_record_of_a_renamed_element_does_not_stay(project: Path) -> None:
    run()
    (project / "modelica" / "Mine.mo").write_text("model Mine\n  Ladder.Elements.C1Parameters p;\nend Mine;\n")
    rename("C1", "Tank")
    (line,) = warnings(run())
    assert line.endswith("no `C1Parameters` any more; it is `TankParameters` now")
    assert not Path(f"{LADDER}/Elements/C1Parameters.mo").exists()


def test_an_own_class_behind_a_link_stops_no_build(project: Path, tmp_path: Path) -> None:
    run()
    (tmp_path / "Mine.mo").write_text("within Ladder.Elements;\nmodel Mine\n  extends C1;\nend Mine;\n")
    Path(f"{LADDER}/Elements/Mine.mo").symlink_to(tmp_path / "Mine.mo")
    drop("C1")
    assert not run().diagnostics
    assert not Path(f"{LADDER}/Elements/C1.mo").exists()


@pytest.mark.parametrize(("module", "name"), [(builtins, "open"), (os, "stat")], ids=["file", "folder"])
def test_an_own_class_that_cant_be_read_stops_no_build(
    project: Path, monkeypatch: pytest.MonkeyPatch, module: ModuleType, name: str
) -> None:
    """Neither where the file is refused, nor where its folder lets nobody look at it."""
    run()
    mine = Path(f"{LADDER}/Elements/Mine.mo").absolute()
    mine.write_text("within Ladder.Elements;\nmodel Mine\n  extends C1;\nend Mine;\n")
    drop("C1")
    real, refused = getattr(module, name), []

    def refusing(path: Any, *arguments: Any, **keywords: Any) -> Any:
        if str(path) == str(mine):
            refused.append(path)
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return real(path, *arguments, **keywords)

    monkeypatch.setattr(module, name, refusing)
    result = run()
    assert refused
    assert not result.diagnostics
    assert not Path(f"{LADDER}/Elements/C1.mo").exists()


# What waits


def test_what_waits_is_told_until_it_is_settled(conflict: Path) -> None:
    first = run().changes
    again = run().changes
    assert first is not None
    assert again is not None
    assert [(c.path, c.old, c.new) for c in again.changes] == [(c.path, c.old, c.new) for c in first.changes]
    source('"ohm": 220.5', '"ohm": 300')
    more = run().changes
    assert more is not None
    assert len(more.changes) == len(first.changes) + 1
    assert run(choices={R1: Choice.TAKE}).changes is not None
    assert run().changes is None


def test_line_ends_of_the_source_are_no_change(project: Path, snapshot_of: Snapshot) -> None:
    """So that two machines that check out text in their own way record the same."""
    run()
    before = snapshot_of(project / ".urdfsync")
    edit("ladder.json", "\n", "\r\n")
    assert run().in_step
    assert snapshot_of(project / ".urdfsync") == before
