"""What becomes of hand edits, build after build: merged, moved, kept, never lost."""

from __future__ import annotations

import builtins
import errno
import os
import shutil
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from support.files import unchanged
from support.networks import (
    C1,
    LADDER,
    MANIFEST,
    R1,
    RECORD,
    Snapshot,
    configure,
    conflicts,
    drop,
    edit,
    failure,
    inner_kinds,
    kinds,
    own_model,
    rename,
    resistor,
    run,
    run_all,
    source,
)
from support.replay import contents
from support.urdfs import joint, links, robot

from urdfsync import cli
from urdfsync.engine.actions import Choice, Reason
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.files import text_digest

ASIDE = Path(".urdfsync/conflicts/ladder/Elements")
SHUNT = f"{LADDER}/Elements/Shunt.mo"
MAY, SENSOR = "  // measured in May\nend R1", "  // a sensor here\nequation"


def as_rc_pair() -> None:
    """Make a capacitor of the resistor R1: its model is another, its record, too."""
    source('"R1", "between": ["in", "middle"], "ohm": 100', '"R1", "between": ["in", "middle"], "farad": 1e-9')


def merging() -> None:
    configure('on_conflict = "merge"\n')


def assert_rejected_again_and_again(name: str) -> None:
    """A build finds one conflict, whose merge mentions a name that is gone, and so does the next one."""
    for _ in range(2):
        (found,) = run().conflict_texts
        assert found.rejected.startswith("in the merge, ")
        assert f"{name}`" in found.rejected


@pytest.fixture
def conflict(project: Path) -> Path:
    """A project in which the user and the source changed the model of R1, at different places."""
    run()
    edit(R1, "end R1;", "  annotation (Documentation);\nend R1;")
    as_rc_pair()
    return project


# Conflicts, and what resolves them


@pytest.mark.slow
def test_base_generated_and_merge_are_put_aside_and_come_back_if_somebody_deletes_them(conflict: Path) -> None:
    before = Path(R1).read_bytes()
    assert exit_code([run()]) is Exit.CONFLICT
    assert Path(R1).read_bytes() == before
    base, generated = ((ASIDE / f"R1.{name}.mo").read_text() for name in ("base", "generated"))
    assert "parameters.R*i" in base
    assert "parameters.C*der(v)" in generated
    merge = (ASIDE / "R1.merge.mo").read_text()
    assert "annotation (Documentation);" in merge
    assert "parameters.C*der(v)" in merge
    aside = contents(conflict)
    shutil.rmtree(".urdfsync/conflicts")
    assert run().conflict_texts[0].base == base
    assert contents(conflict) == aside


def test_resolving_one_conflict_releases_what_waited_which_is_told_till_then(conflict: Path) -> None:
    waited = run()
    assert RECORD in {action.path for action in waited.actions if action.is_waiting}, "its parameter has another name"
    first, again = waited.changes, run().changes
    assert first is not None
    assert again is not None
    assert [(c.path, c.old, c.new) for c in again.changes] == [(c.path, c.old, c.new) for c in first.changes]
    source('"ohm": 220.5', '"ohm": 300')
    more = run().changes
    assert more is not None
    assert len(more.changes) == len(first.changes) + 1
    done = run(choices={R1: Choice.TAKE})
    assert done.changes is not None
    assert not any(action.is_waiting for action in done.actions)
    assert "C = 1e-09" in Path(RECORD).read_text()
    assert run().changes is None


@pytest.mark.parametrize("choice", [Choice.KEEP, Choice.TAKE, None])
def test_a_file_that_was_there_before_is_a_conflict_that_has_no_merge(project: Path, choice: Choice | None) -> None:
    Path(R1).parent.mkdir(parents=True)
    mine = "within Ladder.Elements;\nmodel R1\nend R1;\n"
    Path(R1).write_text(mine)
    assert kinds(run())[R1] is Reason.UNOWNED
    assert conflicts(choices={R1: Choice.MERGE}), "there is no base to merge with"
    assert Path(R1).read_text() == mine
    if choice is None:
        Path(R1).unlink()
    assert not conflicts(choices={R1: choice} if choice else {})
    assert (Path(R1).read_text() == mine) is (choice is Choice.KEEP)
    assert kinds(run()) == ({R1: Reason.KEEP} if choice is Choice.KEEP else {})


# Merges


def test_contradicting_edits_are_never_merged(project: Path) -> None:
    merging()
    run()
    edit(RECORD, "100", "101")
    resistor(150)
    assert kinds(run())[RECORD] is Reason.CONFLICT
    assert kinds(run(choices={RECORD: Choice.MERGE}))[RECORD] is Reason.CONFLICT
    assert "101" in Path(RECORD).read_text()
    assert "<<<<<<< mine" in (ASIDE / "R1Parameters.merge.txt").read_text()
    assert not (ASIDE / "R1Parameters.merge.mo").exists(), "a text with markers is no Modelica"


def test_a_merge_that_is_no_model_is_rejected_with_the_reason(project: Path) -> None:
    merging()
    run()
    whole = f"{LADDER}/Ladder.mo"
    edit(whole, "equation", "  Elements.R1 elementR9, mine;\n\nequation")
    rename("R2", "R9")
    (found,) = run().conflict_texts
    assert (found.path, found.merge is not None) == (whole, True)
    assert found.merge is None or found.merge.text is None
    assert "elementR9" in found.rejected


def test_two_things_with_one_name_are_a_contradiction_that_names_it(project: Path) -> None:
    merging()
    run()
    whole = f"{LADDER}/Ladder.mo"
    edit(whole, "equation", "  Elements.R1 elementR9;\n\nequation")
    rename("R2", "R9")
    (found,) = run().conflict_texts
    assert found.merge is not None
    assert (found.path, found.rejected, found.merge.text) == (whole, "", None)
    assert found.merge.contradictions[0].startswith("component `elementR9`: you added `Elements.R1 elementR9;`")


def test_who_writes_the_new_value_himself_has_no_conflict(project: Path) -> None:
    run()
    edit(RECORD, "100", "150")
    edit(RECORD, "end R1", MAY)
    resistor(150)
    mine = Path(RECORD).read_bytes()
    assert kinds(run())[RECORD] is Reason.INCLUDED
    assert Path(RECORD).read_bytes() == mine
    with unchanged(project):
        assert kinds(run()) == {RECORD: Reason.KEEP}


@pytest.mark.parametrize("path", [R1, RECORD, f"{LADDER}/Elements/package.order"])
@pytest.mark.parametrize("length", [7, 8])  # 8 where both branches gave a file another name
def test_merge_markers_are_never_taken_for_an_edit(project: Path, path: str, length: int) -> None:
    merging()
    run()
    text = Path(path).read_text()
    Path(path).write_text(f"{'<' * length} HEAD\n{text}{'=' * length}\n{text}// mine\n{'>' * length} theirs\n")
    resistor(150)
    with unchanged(project):
        for request in ({}, {"dry": True}, {"choices": {path: Choice.MERGE}}):
            (result,) = run_all(**request)
            (found,) = result.diagnostics
            assert exit_code([result]) is Exit.ERROR
            assert (found.file, found.line, found.code) == (path, 1, "merge-markers")


def test_merge_markers_are_refused_in_a_file_that_would_move(project: Path) -> None:
    run()
    edit(R1, "end R1;", "<<<<<<< HEAD\nend R1;")
    rename("R1", "Shunt")
    assert f"{R1}:" in failure()


# Renames


def test_edits_move_with_their_elements_new_name(project: Path) -> None:
    run()
    edit(R1, "equation", SENSOR)
    rename("R1", "Shunt")
    result = run()
    assert (kinds(result)[SHUNT], kinds(result)[R1]) == (Reason.MOVE, Reason.MOVED_AWAY)
    assert not Path(R1).exists()
    text = Path(SHUNT).read_text()
    assert "// a sensor here" in text
    assert "model Shunt" in text
    assert "R1" not in text
    assert kinds(run()) == {SHUNT: Reason.KEEP}


def test_edits_that_contradict_the_new_name_wait_where_they_are(project: Path) -> None:
    run()
    edit(R1, "model R1", "model R1 // best of all")
    edit(R1, "R1Parameters parameters", "MyParameters parameters")
    mine = Path(R1).read_bytes()
    rename("R1", "Shunt")
    result = run()
    assert kinds(result) == {SHUNT: Reason.CONFLICT}
    assert result.conflict_texts[0].origin == R1
    assert Path(R1).read_bytes() == mine
    assert not Path(SHUNT).exists()
    again = run()
    assert kinds(again) == {SHUNT: Reason.CONFLICT}
    assert again.conflict_texts == result.conflict_texts, "the base is recorded, although the model knows R1 no more"
    rename("Shunt", "Branch")
    result = run()
    assert kinds(result) == {SHUNT.replace("Shunt", "Branch"): Reason.CONFLICT}, "a second name finds the file, too"
    assert result.conflict_texts[0].origin == R1
    rename("Branch", "R1")
    assert kinds(run()) == {R1: Reason.KEEP}, "the old name is back, and nothing is new for it"


# Bases that are lost


@pytest.mark.parametrize("built", [False, True], ids=["before the conflict", "in the conflict"])
def test_a_clone_reaches_the_same_result(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, built: bool
) -> None:
    run()
    edit(RECORD, "end R1", MAY)
    edit(C1, "equation", SENSOR)
    resistor(150)
    rename("C1", "Filter")
    if built:
        run()
        run()
    local = ("conflicts", "lock")
    other = shutil.copytree(project, tmp_path / "clone", ignore=shutil.ignore_patterns(*local))
    first = run()
    run(choices={RECORD: Choice.MERGE})
    monkeypatch.chdir(other)
    assert run().conflict_texts == first.conflict_texts
    run(choices={RECORD: Choice.MERGE})
    here, there = (
        {path: text for path, text in contents(folder).items() if "/aside/" not in path} for folder in (other, project)
    )
    assert here == there
    assert "150" in (other / RECORD).read_text()


def test_without_its_base_a_conflict_has_no_merge(project: Path) -> None:
    run()
    edit(RECORD, "end R1", MAY)
    resistor(150)
    shutil.rmtree(".urdfsync/bases")
    (found,) = run().conflict_texts
    assert found.base is None
    assert found.merge is None
    assert [path.name for path in ASIDE.iterdir()] == ["R1Parameters.generated.mo"]


# Choices that wait for others


@pytest.fixture
def two_conflicts(project: Path) -> tuple[str, str]:
    """The records of R1 and R2 conflict."""
    run()
    other = RECORD.replace("R1", "R2")
    for path, number in ((RECORD, "100"), (other, "220.5")):
        edit(path, number, f"{number} + 1")
    resistor(150)
    resistor(300, before=220.5)
    run()
    return RECORD, other


@pytest.mark.parametrize("choice", [Choice.KEEP, Choice.TAKE])
def test_a_choice_holds_until_the_package_can_move(two_conflicts: tuple[str, str], choice: Choice) -> None:
    edit("urdfsync.toml", '"Ladder"', '"Plant.Ladder"\ncreate_parents = true')
    one, two = (path.replace("modelica/", "modelica/Plant/") for path in two_conflicts)
    assert conflicts() == [one, two]
    assert conflicts(choices={one: choice}) == [two]
    assert conflicts() == [two]
    assert not conflicts(choices={two: choice})
    assert all(("+ 1" in Path(path).read_text()) is (choice is Choice.KEEP) for path in (one, two))
    assert run().in_step


def test_what_is_put_aside_goes_with_the_robots_name(two_conflicts: tuple[str, str], project: Path) -> None:
    edit("urdfsync.toml", "robots.ladder", "robots.leiter")
    assert len(run().conflicts) == 2
    assert [path.name for path in (project / ".urdfsync/conflicts").iterdir()] == ["leiter"]


# What stays, and in which order


def test_the_packages_around_wait_with_the_package(project: Path) -> None:
    edit("urdfsync.toml", '"Ladder"', '"Plant.Ladder"\ncreate_parents = true')
    run()
    edit(RECORD.replace("modelica/", "modelica/Plant/"), "100", "101")
    resistor(150)
    edit("urdfsync.toml", "Plant.Ladder", "Plant.Leiter")
    assert conflicts()
    assert Path("modelica/Plant/package.order").read_text() == "Ladder\n"


def test_of_an_ambiguous_base_every_text_counts(project: Path) -> None:
    """Two branches have recorded one each, of which git has united the lines."""
    run()
    first = text_digest(Path(RECORD).read_bytes())
    resistor(150)
    run()
    edit(MANIFEST, 'domain "rcnetwork"\n', f'domain "rcnetwork"\n\nfile {first}  Elements/R1Parameters.mo\n')
    edit(RECORD, "end R1", MAY)
    resistor(170, before=150)
    (found,) = run().conflict_texts
    merged = found.merged(Choice.MERGE)
    assert merged == found.generated.replace("end R1", MAY)


@pytest.mark.parametrize("adopts", [False, True])
def test_own_classes_beside_a_new_package_are_listed_if_it_is_adopted(project: Path, adopts: bool) -> None:
    own = Path(LADDER, "Mine.mo")
    own.parent.mkdir(parents=True)
    own.write_text("within Ladder;\nmodel Mine\nend Mine;\n")
    run(adopts=adopts)
    assert ("Mine" in Path(LADDER, "package.order").read_text().split()) is adopts


# Names that the package has no more

POWER = "  Real power = v*i;\n"
GONE = "change or remove this use"
USER = {
    "MyLadder.mo": """\
within;
model MyLadder
  extends Ladder.Ladder(redeclare Modelica.Electrical.Analog.Basic.Resistor elementC1, elementR1(R = 2));
  Ladder.Elements.C1 other;
  Real C3 = elementC1.v;
equation
  connect(other.p, elementC1.p);
end MyLadder;
""",
    "bench/MyBench.mo": """\
model MyBench "Tries C1"
  MyLadder mine;
  Real u = mine.elementC1.v + mine.elementR1.v;
end MyBench;
""",
    "Stranger.mo": "model Stranger\n  C1 other;\nend Stranger;\n",
    "Broken.mo": "model Broken\n  Ladder.Ladder C1\nend Broken;\n",
}
"""Files around the package, by their path in the output folder."""


def write_user() -> None:
    for path, text in USER.items():
        Path("modelica", path).parent.mkdir(exist_ok=True)
        Path("modelica", path).write_text(text)


def warnings(result: Result) -> list[str]:
    """Where texts use names that the package loses, and what is said of it."""
    assert {one.code for one in result.diagnostics} <= {"unresolved", "syntax"}
    found = [one for one in result.diagnostics if one.code == "unresolved"]
    return [f"{Path(one.file).name}:{one.line}: {one.message}; {one.hint}" for one in found]


def test_a_merge_that_mentions_what_is_gone_is_a_conflict(project: Path) -> None:
    merging()
    run()
    whole = f"{LADDER}/Ladder.mo"
    edit(whole, "equation", "  Real power = elementC1.v*elementC1.i;\n\nequation")
    rename("C1", "Tank")
    for _ in range(2):  # the second time, the state knows the new name already
        (found,) = run().conflict_texts
        assert found.path == whole
        assert found.merge is not None
        assert found.merge.text is None
        line = found.merge.proposal.split("\n").index("  Real power = elementC1.v*elementC1.i;") + 1
        assert found.rejected == f"in the merge, Ladder has no `elementC1` (line {line})"


def test_a_merge_that_brings_in_a_use_of_what_the_user_removed_is_a_conflict(project: Path) -> None:
    """Even if the class might inherit it from a library that builds do not read."""
    merging()
    run()
    model = Path(f"{LADDER}/Ladder.mo")
    lines = [line for line in model.read_text().splitlines(keepends=True) if "node_middle" not in line]
    lines.insert(2, "  extends Modelica.Icons.Example;\n")
    model.write_text("".join(lines))
    source('"farad": 4.7e-6}', '"farad": 4.7e-6},\n    {"name": "R7", "between": ["middle", "out"], "ohm": 1}')
    assert_rejected_again_and_again("node_middle")


def test_a_merge_that_mentions_what_a_renamed_element_loses_is_a_conflict(project: Path) -> None:
    own_model(f"<% if element.name == 'R1' %>\n{POWER}<% endif %>\n")
    run()
    edit(R1, "equation", "  Real energy = 2*power;\n\nequation")
    rename("R1", "Shunt")
    assert_rejected_again_and_again("power")


def test_a_merge_that_takes_away_what_was_lacking_a_part_is_a_conflict(project: Path) -> None:
    """`elementC1.power` meant nothing before, but `elementC1` did."""
    own_model(f"<% if kind == 'resistor' %>\n{POWER}<% endif %>\n")
    run()
    edit(f"{LADDER}/Ladder.mo", "equation", "  Real mine = elementC1.power;\n\nequation")
    drop("C1")
    source('"ohm": 100', '"farad": 100')
    assert_rejected_again_and_again("elementC1")


def test_a_merge_that_mentions_what_the_user_deleted_before_is_taken_and_told(project: Path) -> None:
    """It brings in nothing: that it means nothing was true before."""
    merging()
    run()
    Path(C1).unlink()
    edit(f"{LADDER}/Ladder.mo", "equation", "  Elements.C1 other;\n\nequation")
    drop("C1")
    result = run()
    assert kinds(result)[f"{LADDER}/Ladder.mo"] is Reason.MERGE
    assert result.is_broken
    assert [one.message for one in result.diagnostics] == ["there is no class `Elements.C1`"]


def test_a_merge_that_mentions_what_is_gone_is_a_conflict_if_its_model_gets_another_name(project: Path) -> None:
    run()
    edit(f"{LADDER}/Ladder.mo", "equation", "  Real mine = elementR1.v;\n\nequation")
    drop("R1")
    configure('class = "Net"\n')
    assert_rejected_again_and_again("elementR1")


def test_a_merge_that_mentions_what_the_user_gives_up_leaves_the_package_broken(project: Path) -> None:
    run()
    edit(C1, "equation", SENSOR)
    edit(f"{LADDER}/Ladder.mo", "equation", "  Elements.C1 other;\n\nequation")
    drop("C1")
    (found,) = run().conflict_texts
    assert not found.rejected
    result = run(choices={C1: Choice.TAKE, found.path: Choice.MERGE})
    assert result.is_broken
    assert [one.message for one in result.diagnostics if one.code == "unresolved"] == [
        "there is no class `Elements.C1`"
    ]
    assert cli.main(["resolve", C1, "--undo"]) == 0
    assert not run().is_broken


def test_what_the_user_keeps_may_be_mentioned(project: Path) -> None:
    """A class that is no longer generated, and one that is generated without what it has."""
    own_model(f"<% if kind == 'resistor' %>\n{POWER}<% endif %>\n")
    merging()
    run()
    Path("modelica/Bench.mo").write_text("model Bench\n  Ladder.Elements.C1 one;\nend Bench;\n")
    edit(C1, "equation", SENSOR)
    edit(R1, "v = parameters.R*i", "v = 2*parameters.R*i")
    edit(f"{LADDER}/Ladder.mo", "equation", "  Real power = elementR1.power;\n\nequation")
    drop("C1")
    as_rc_pair()
    assert conflicts() == [R1]
    assert conflicts(dry=True, choices={R1: Choice.TAKE}) == [f"{LADDER}/Ladder.mo"]
    result = run(choices={C1: Choice.KEEP, R1: Choice.KEEP})
    assert kinds(result)[f"{LADDER}/Ladder.mo"] is Reason.MERGE
    (found,) = result.diagnostics
    assert (found.file, found.message) == (R1, "R1Parameters has no `R`")  # the class that is kept is for a resistor


def test_edits_move_into_a_parent_package_that_is_made_for_them(project: Path) -> None:
    run()
    edit(R1, "equation", SENSOR)
    edit("urdfsync.toml", 'package = "Ladder"', 'package = "Plant.Ladder"')
    configure("create_parents = true\n")
    assert kinds(run())["modelica/Plant/Ladder/Elements/R1.mo"] is Reason.MOVE


@pytest.mark.parametrize("used", ["C1", "C1Parameters"], ids=["edited model", "record"])
def test_a_merge_may_mention_what_stays(project: Path, used: str) -> None:
    merging()
    run()
    if used == "C1":
        edit(C1, "equation", SENSOR)
    edit(f"{LADDER}/Ladder.mo", "equation", f"  Elements.{used} other;\n\nequation")
    drop("C1")
    result = run()
    assert kinds(result)[f"{LADDER}/Ladder.mo"] is Reason.MERGE
    assert not result.diagnostics
    assert Path(LADDER, f"Elements/{used}.mo").exists()
    assert run().in_step


def test_a_class_of_which_the_user_made_a_folder_finds_the_record_that_stays_for_it(project: Path) -> None:
    run()
    mine = Path(C1).with_suffix("") / "package.mo"
    mine.parent.mkdir()
    Path(C1).rename(mine)
    drop("C1")
    assert not run().diagnostics
    assert Path(C1.replace(".mo", "Parameters.mo")).exists()


def test_the_line_of_an_orphan_that_the_user_deletes_goes_once_nothing_waits(project: Path) -> None:
    run()
    edit(C1, "equation", SENSOR)
    drop("C1")
    run()
    order = Path(LADDER, "Elements/package.order")
    assert "C1" in order.read_text().split()
    Path(C1).unlink()
    edit(R1, "end R1;", "  annotation (Documentation);\nend R1;")
    as_rc_pair()
    for _ in range(2):
        assert conflicts() == [R1]
        assert "C1" in order.read_text().split()
    run(choices={R1: Choice.TAKE})
    assert "C1" not in order.read_text().split()


def test_own_classes_in_the_package_that_use_what_is_gone_are_named(project: Path) -> None:
    run()
    mine = Path(f"{LADDER}/Elements/Mine.mo")
    mine.write_text('within Ladder.Elements;\nmodel Mine "C1"\n  // C1\n  extends C1;\nend Mine;\n')
    edit(f"{LADDER}/Elements/R2.mo", "equation", "  C1 other;\n\nequation")
    drop("C1")
    for _ in range(2):
        assert warnings(run()) == [
            f"Mine.mo:4: there is no class `C1`; {GONE}",
            f"R2.mo:7: there is no class `C1`; {GONE}",
        ]


def test_files_around_the_package_that_use_what_is_gone_are_named(project: Path) -> None:
    run()
    write_user()
    drop("C1")
    expected = [
        "MyBench.mo:3: MyLadder has no `elementC1`; did you mean `mine.elementR1.v`?",
        "MyLadder.mo:3: Ladder has no `elementC1`; did you mean `elementR1`?; also in lines 5, 7",
        f"MyLadder.mo:4: there is no class `Ladder.Elements.C1`; {GONE}",
    ]
    for request in ({"dry": True}, {}, {}):
        assert sorted(warnings(run(**request))) == expected


def test_a_record_that_a_model_of_the_users_needs_stays_as_long_as_it_does(project: Path) -> None:
    run()
    bench, record = Path("modelica/Bench.mo"), Path(C1.replace(".mo", "Parameters.mo"))
    bench.write_text("model Bench\n  parameter Ladder.Elements.C1Parameters numbers;\nend Bench;\n")
    drop("C1")
    for _ in range(2):
        assert warnings(run()) == []
        assert (record.exists(), Path(C1).exists()) == (True, False)
    bench.unlink()
    run()
    assert not record.exists()


@pytest.mark.parametrize(
    ("path", "old", "new", "words"),
    [
        ("ladder.json", '"C1"', '"Tank"', "use `Tank` instead"),
        ("urdfsync.toml", '"Ladder"', '"Rungs"', "use `Rungs.Rungs` instead"),
    ],
)
def test_uses_of_what_has_another_name_get_the_new_one(
    project: Path, path: str, old: str, new: str, words: str
) -> None:
    run()
    write_user()
    edit(path, old, new)
    (found,) = [line for line in warnings(run()) if line.startswith("MyLadder") and "`element" not in line]
    assert words in found


@pytest.mark.parametrize(
    ("module", "name"), [(None, ""), (builtins, "open"), (os, "lstat")], ids=["link", "file", "folder"]
)
def test_an_own_class_that_cant_be_read_stops_no_build(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, module: ModuleType | None, name: str
) -> None:
    """Neither where it is behind a link, nor where the file is refused, nor where its folder lets nobody look at it."""
    run()
    mine, refused = Path(f"{LADDER}/Elements/Mine.mo").absolute(), [""]
    mine.write_text("within Ladder.Elements;\nmodel Mine\n  extends C1;\nend Mine;\n")
    drop("C1")
    if module is None:
        mine.symlink_to(mine.rename(tmp_path / "Mine.mo"))
    else:
        real = getattr(module, name)
        refused.clear()

        def refusing(path: Any, *arguments: Any, **keywords: Any) -> Any:
            if str(path) == str(mine):
                refused.append(path)
                raise PermissionError(errno.EACCES, "Permission denied", str(path))
            return real(path, *arguments, **keywords)

        monkeypatch.setattr(module, name, refusing)
    result = run()
    assert refused
    assert not result.diagnostics
    assert not Path(C1).exists()


@pytest.mark.parametrize("is_folder", [False, True], ids=["file", "folder"])
def test_an_edited_file_stays_if_something_of_the_users_is_at_its_new_place(project: Path, is_folder: bool) -> None:
    run()
    edit(R1, "equation", SENSOR)
    mine, place = Path(R1).read_bytes(), Path(SHUNT)
    if is_folder:
        place = place.with_suffix("") / "package.mo"
        place.parent.mkdir()
    place.write_text("mine")
    rename("R1", "Shunt")
    found = kinds(run())
    assert (found[R1], found[SHUNT]) == (Reason.ORPHAN, Reason.UNOWNED)
    assert (Path(R1).read_bytes(), place.read_text()) == (mine, "mine")


def test_a_conflict_holds_back_structure_but_not_numbers_until_it_is_resolved(
    project: Path, snapshot_of: Snapshot
) -> None:
    run()
    before = snapshot_of(project / LADDER)
    resistor(120)
    source('"R2"', '"R3"')
    edit(f"{LADDER}/Ladder.mo", "end Ladder;", "// mine\nend Ladder;")
    first = run()
    assert inner_kinds(first) == {"Elements/R1Parameters.mo": Reason.UPDATE, "Ladder.mo": Reason.CONFLICT}
    after = snapshot_of(project / LADDER)
    assert {path for path in before if before[path] != after[path]} == {"Ladder.mo", "Elements/R1Parameters.mo"}
    assert b"// mine" in after["Ladder.mo"][1]
    waiting = {f"Elements/R{n}{kind}.mo" for n in "23" for kind in ("", "Parameters")} | {"Elements/package.order"}
    for result in (first, run()):
        assert {action.path.removeprefix(f"{LADDER}/") for action in result.actions if action.is_waiting} == waiting
        assert exit_code([result]) is Exit.CONFLICT
    source('"R3"', '"R2"')
    assert inner_kinds(run()) == {"Ladder.mo": Reason.KEEP}, "the source came back"
    source('"R2"', '"R3"')
    assert inner_kinds(run()) == {"Ladder.mo": Reason.CONFLICT}
    Path(f"{LADDER}/Ladder.mo").unlink()
    resolved = run()
    assert exit_code([resolved]) is Exit.IN_STEP
    assert inner_kinds(resolved)["Ladder.mo"] is Reason.RESTORE
    assert inner_kinds(resolved)["Elements/R3.mo"] is Reason.CREATE
    assert not (project / LADDER / "Elements/R2.mo").exists()
    assert run().in_step


def test_a_conflict_about_a_number_holds_no_new_file_back(folder: Path) -> None:
    (folder / "urdfsync.toml").write_text('[robots.bot]\nsource = "bot.urdf"\npackage = "Bot"\n')
    (folder / "bot.urdf").write_text(robot(*links(base=1.0, arm=2.0), joint("elbow", "continuous", "base", "arm")))
    run()
    edit("modelica/Bot/Links/ArmParameters.mo", "mass = 2", "mass = 2.5")
    more = [*links(base=1.0, arm=3.0, hand=1.0), joint("elbow", "continuous", "base", "arm")]
    (folder / "bot.urdf").write_text(robot(*more, joint("wrist", "continuous", "arm", "hand")))
    result = run()
    assert [action.path for action in result.actions if action.is_conflict] == ["modelica/Bot/Links/ArmParameters.mo"]
    assert not any(action.is_waiting for action in result.actions)
    assert Path("modelica/Bot/Links/Hand.mo").is_file()
