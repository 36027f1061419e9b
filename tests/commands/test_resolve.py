"""`urdfsync resolve` from end to end: conflicts of real builds, settled, and what waited for that."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from support.commands import SETTLE, Editor, Execute
from support.crashes import Operation, before_each
from support.files import unchanged
from support.networks import FRESH, LADDER, MINE, MODEL, RECORD, ROBOT, add_resistor, configure, edit, resistor

from urdfsync import cli
from urdfsync.api import build_and_check
from urdfsync.engine.result import Result
from urdfsync.state.lock import build_lock

SIGNAL = f"{LADDER}/Resources/step.txt"


@pytest.fixture
def clean(execute: Execute, project: Path) -> Path:
    """The network's model is edited, one more resistor is in the source: both fit together."""
    execute("build")
    edit(MODEL, "Elements.C1 elementC1", "parameter Real mine = 1;\n\n  Elements.C1 elementC1")
    add_resistor("R3")
    return project


# Choices


def test_merge_takes_both(clean: Path, execute: Execute) -> None:
    assert f"    urdfsync resolve {Path(MODEL)} --merge" in execute("build", code=3).lines
    assert execute("resolve", MODEL, "--merge").lines[0] == "ladder: 3 files written, 1 merged with your edits"
    text = Path(MODEL).read_text()
    assert "parameter Real mine = 1;" in text
    assert FRESH in text
    execute("build", "--check")


def test_take_replaces_the_edits(contradictory: Path, execute: Execute) -> None:
    execute("build", code=3)
    lines = execute("resolve", MODEL, "--take").lines
    assert lines[0] == "ladder: 4 files written, 2 deleted"
    assert lines[-1] == f"  update     {MODEL}  the generated file; --undo brings your edits back"
    assert MINE not in Path(MODEL).read_text()
    assert FRESH in Path(MODEL).read_text()
    assert execute("build").lines[0] == "ladder: in step, 14 files"


def test_take_gives_back_a_file_that_does_not_conflict(project: Path, execute: Execute) -> None:
    execute("build")
    before = Path(MODEL).read_text()
    edit(MODEL, "equation", "  Real mine;\n\nequation")
    for choice in ("--keep", "--merge"):
        assert f"{MODEL}: error: the file has no conflict" in execute("resolve", MODEL, choice, code=2).err
    assert execute("resolve", MODEL, "--take").lines[0] == "ladder: 1 file written"
    assert Path(MODEL).read_text() == before


def test_take_of_a_file_that_does_not_conflict_waits_for_nothing(contradictory: Path, execute: Execute) -> None:
    before = Path(RECORD).read_text()
    edit(RECORD, "100", "101")
    execute("build", code=3)
    execute("resolve", RECORD, "--take", code=3)
    assert Path(RECORD).read_text() == before
    assert "choice" not in Path(".urdfsync/robots/ladder.state").read_text()


@pytest.mark.parametrize(("side", "number"), [("mine", "101"), ("generated", "150")])
def test_a_side_may_be_preferred_where_both_changed_the_same(
    project: Path, execute: Execute, side: str, number: str
) -> None:
    """What does not contradict is merged either way."""
    execute("build")
    edit(RECORD, "100", "101")
    edit(RECORD, "end R1Parameters", "  Real mine;\nend R1Parameters")
    resistor(150)
    assert "Component `R`: you set `R = 101`, the export changes 100 to 150." in execute("build", code=3).words
    execute("resolve", RECORD, "--merge", "--prefer", side)
    text = Path(RECORD).read_text()
    assert f"R = {number} " in text
    assert "Real mine;" in text
    execute("build", "--check")


def test_a_preferred_side_needs_merge(contradictory: Path, execute: Execute) -> None:
    assert "--prefer goes with --merge" in execute("resolve", MODEL, "--keep", "--prefer", "mine", code=2).err


def test_a_preferred_side_that_mentions_what_is_gone_is_refused(contradictory: Path, execute: Execute) -> None:
    text = Path(MODEL).read_text()
    assert (
        "in the merge, there is no class `Elements.R2`"
        in execute("resolve", MODEL, "--merge", "--prefer", "mine", code=3).words
    )
    assert Path(MODEL).read_text() == text
    for words in (("status",), ("build",)):
        assert "--prefer mine" not in execute(*words, code=3).out, "it is not proposed"
    execute("resolve", MODEL, "--merge", "--prefer", "generated")
    assert MINE not in Path(MODEL).read_text()


def test_keep_is_remembered_until_the_generated_text_changes_again(contradictory: Path, execute: Execute) -> None:
    mine, elements = Path(MODEL).read_text(), Path(LADDER) / "Elements"
    execute("build", code=3)
    assert (elements / "R2.mo").exists()
    assert not (elements / "R3.mo").exists()
    execute("resolve", MODEL, "--keep")
    assert (elements / "R2.mo").exists(), "the kept file uses it"
    assert "R3" in (elements / "package.order").read_text().splitlines(), "what waited is written"
    assert not list(Path(".urdfsync/conflicts").rglob("*.*"))
    for arguments in (["build"], ["build", "--full"], ["build", "--check"]):
        assert execute(*arguments).lines[0].startswith("ladder: in step, 14 files, 1 kept because you edited it, 2 no")
    edit("ladder.json", "220.5", "330")
    execute("build")
    assert Path(MODEL).read_text() == mine
    add_resistor("R4")
    execute("build", code=3)
    assert Path(MODEL).read_text() == mine


@pytest.fixture
def misfit(execute: Execute, project: Path) -> Path:
    """The network's model is kept, and uses an element that the source has no more, and whose file the user deleted."""
    execute("build")
    edit(MODEL, "equation", "  Elements.C1 other;\n\nequation")
    Path(f"{LADDER}/Elements/C1.mo").unlink()
    edit("ladder.json", '"C1"', '"C3"')
    edit("ladder.json", '"farad": 1e-6', '"ohm": 5')
    assert conflicts(execute) == ["Ladder.mo"]
    execute("resolve", MODEL, "--keep", code=3)
    return project


def test_a_kept_file_that_does_not_fit_is_told_until_it_does(misfit: Path, execute: Execute) -> None:
    said = (
        "Ladder.mo:10: error: there is no class `Elements.C1`; change or remove this use; also in line 27 [unresolved]"
    )
    for command, code in (("build", 3), ("build --check", 1), ("status", 1), ("build", 3)):
        printed = execute(*command.split(), code=code)
        assert said in printed.err
        assert "broken" in printed.lines[0]
    edit(MODEL, "  Elements.C1 other;\n", "")
    edit(MODEL, "  Elements.C1 elementC1", "  Elements.C3 elementC1")
    assert execute("build").err == ""


def test_a_merge_that_is_not_offered_changes_nothing(execute: Execute, contradictory: Path) -> None:
    execute("build", code=3)
    with unchanged(contradictory, but=".urdfsync/lock"):
        proposal = Path(".urdfsync/conflicts/ladder/Ladder.merge.txt")
        printed = execute("resolve", MODEL, "--merge", code=3)
        assert "Component `elementR2`: you changed it, the export removes it." in printed.words
        assert f"    urdfsync resolve {Path(MODEL)} --merge --prefer generated" in printed.lines
        assert not any(line.startswith(("  keep ", "  merge ", "  update ")) for line in printed.lines)
        assert MINE in proposal.read_text()


def test_a_dry_run_writes_nothing(clean: Path, execute: Execute) -> None:
    with unchanged(clean, but=".urdfsync/lock"):
        assert (
            execute("resolve", MODEL, "--merge", "--dry-run").lines[0]
            == "ladder: 3 files to write, 1 to merge with your edits"
        )


# Several files


@pytest.fixture
def several(clean: Path) -> Path:
    """One conflict that merges, one that doesn't, and an imported file that both sides changed."""
    edit(f"{LADDER}/Elements/R1Parameters.mo", "R = 100", "R = 110")
    edit("ladder.json", '"ohm": 100', '"ohm": 120')
    edit(SIGNAL, "#1", "#1 ")
    edit("step.csv", "0.1,5", "0.1,7")
    return clean


def conflicts(execute: Execute) -> list[str]:
    """The conflicts that a dry build finds."""
    robots = execute("build", "--dry-run", "--format=json", code=None).json["results"]
    return [found["action"]["path"].removeprefix(f"{LADDER}/") for robot in robots for found in robot["conflicts"]]


def test_a_folder_stands_for_all_below_it(several: Path, execute: Execute) -> None:
    assert conflicts(execute) == ["Elements/R1Parameters.mo", "Ladder.mo", "Resources/step.txt"]
    execute("resolve", f"{LADDER}/Elements", "--keep", code=3)
    assert conflicts(execute) == ["Ladder.mo", "Resources/step.txt"]
    execute("resolve", LADDER, "--take")
    assert "R = 110" in Path(f"{LADDER}/Elements/R1Parameters.mo").read_text()
    assert "0.1 7.0" in Path(SIGNAL).read_text()


def test_of_several_files_those_are_settled_that_can_be(several: Path, execute: Execute) -> None:
    record = f"{LADDER}/Elements/R1Parameters.mo"
    with unchanged(several, but=".urdfsync/lock"):
        execute("resolve", MODEL, "nothing.mo", "--keep", code=2)
    execute("resolve", MODEL, record, "--merge", code=3)
    assert conflicts(execute) == ["Elements/R1Parameters.mo", "Resources/step.txt"]
    execute("resolve", MODEL, record, "--keep", code=3)
    assert conflicts(execute) == ["Resources/step.txt"]


def test_all_that_can_be_merged_is_merged(several: Path, execute: Execute) -> None:
    assert (
        execute("resolve", "--all", "--merge", code=3).lines[0]
        == "ladder: broken: a file that you edited does not fit, 1 merged with your edits, 2 conflicts, "
        "3 files wait until all conflicts are resolved"
    )
    assert conflicts(execute) == ["Elements/R1Parameters.mo", "Resources/step.txt"]
    execute("resolve", "--all", "--keep")
    text = Path(MODEL).read_text()
    assert "parameter Real mine = 1;" in text
    assert FRESH in text
    assert execute("resolve", "--all", "--take").err == "note: nothing is in conflict [no-conflict]\n"


def test_a_choice_that_waits_can_be_made_again(several: Path, execute: Execute) -> None:
    execute("resolve", MODEL, "--merge", code=3)
    execute("resolve", MODEL, "--take", code=3)
    execute("resolve", "--all", "--keep")
    assert "parameter Real mine = 1;" not in Path(MODEL).read_text()


# What a path may be


@pytest.mark.parametrize(
    "typed", ["Ladder.mo", "../Ladder/Ladder.mo", ".", "{project}/modelica/Ladder/Ladder.mo", "../../link/Ladder.mo"]
)
def test_paths_count_from_the_working_folder(
    execute: Execute, clean: Path, monkeypatch: pytest.MonkeyPatch, typed: str
) -> None:
    Path("link").symlink_to(LADDER, target_is_directory=True)
    monkeypatch.chdir(LADDER)
    execute("resolve", typed.format(project=clean), "--merge")


def test_a_path_that_is_no_conflict(execute: Execute, clean: Path) -> None:
    with unchanged(clean, but=".urdfsync/lock"):
        for typed in ("nothing.mo", f"{LADDER}/Elements/R1.mo", "", "ladder.json"):
            words = f"error: nothing conflicts in `{typed}`; see `urdfsync status` for the conflicts [no-conflict]\n"
            assert execute("resolve", typed, "--keep", code=2).err == words


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--keep"], "name files or folders, or use --all; see `urdfsync status` for the conflicts"),
        ([], "one of the arguments --keep --take --merge --edit --undo --moved is required"),
        ([MODEL, "--all", "--keep"], "--all goes without paths"),
        (["--moved", "R1", "--keep"], "argument --keep: not allowed with argument --moved"),
        (["--all", "--undo"], "--undo goes with paths, not with --all"),
    ],
)
def test_bad_usage(clean: Path, execute: Execute, arguments: list[str], words: str) -> None:
    error = execute("resolve", *arguments, code=2).err
    assert error.startswith("usage: urdfsync resolve ")
    assert f"\nerror: {words}" in error
    assert execute("resolve", *arguments, "--format=json", code=2).json["diagnostics"][0]["code"] == "usage"


# Orphans


@pytest.fixture
def orphan(execute: Execute, project: Path) -> Path:
    """An edited model whose element is gone."""
    execute("build")
    edit(f"{LADDER}/Elements/R2.mo", "equation", "  Real mine;\nequation")
    edit("ladder.json", '{"name": "R2", "between": ["middle", "out"]', '{"name": "R3", "between": ["in", "out"]')
    execute("build")
    return project / LADDER / "Elements/R2.mo"


def test_a_build_says_what_can_be_done_about_orphans(orphan: Path, execute: Execute) -> None:
    execute("build", "--full")
    add_resistor("R4")
    *_, place, _, advice = execute("build").lines
    assert place == f"  orphan     {orphan.relative_to(Path.cwd())}  no longer generated, but you edited it; kept"
    assert advice == "  of an orphan: `urdfsync resolve FILE --keep` makes it yours, --take deletes it"


def classes() -> set[str]:
    """The lines of R2 in the order of its package."""
    return {name for name in Path(LADDER, "Elements/package.order").read_text().split() if name.startswith("R2")}


def test_an_orphan_that_is_kept_is_the_users_own_with_the_record_that_it_needs(orphan: Path, execute: Execute) -> None:
    execute("resolve", str(orphan), "--keep")
    for _ in range(2):
        assert "kept because you edited" not in execute("build").lines[0]
        assert "Real mine;" in orphan.read_text()
        assert orphan.with_name("R2Parameters.mo").exists()
        assert classes() == {"R2", "R2Parameters"}


def test_an_orphan_has_to_be_named_to_be_deleted(orphan: Path, execute: Execute) -> None:
    execute("resolve", "--all", "--take")
    execute("resolve", str(orphan.parent), "--take", code=2)
    assert orphan.exists()
    assert (
        "the file is no longer generated: there is nothing to merge"
        in execute("resolve", str(orphan), "--merge", code=2).err
    )
    assert (
        f"  delete     {orphan.relative_to(Path.cwd())}  deleted; --undo brings it back"
        in execute("resolve", str(orphan), "--take").lines
    )
    assert not orphan.exists()
    assert not orphan.with_name("R2Parameters.mo").exists()
    assert classes() == set()


# Elements with another name


@pytest.fixture
def moved(execute: Execute, project: Path) -> Path:
    """An edited model of an element that has another name, with an edit that contradicts the new name."""
    execute("build")
    edit(f"{LADDER}/Elements/R2.mo", '"Resistor R2"', '"My resistor R2"')
    edit("ladder.json", '"R2"', '"R5"')
    return project


@pytest.mark.parametrize("name", ["R2", "R5"])
def test_a_file_that_moves_is_known_by_both_names(moved: Path, execute: Execute, name: str) -> None:
    assert conflicts(execute) == ["Elements/R5.mo"]
    execute("resolve", f"{LADDER}/Elements/{name}.mo", "--take")
    assert not Path(f"{LADDER}/Elements/R2.mo").exists()
    assert '"Resistor R5"' in Path(f"{LADDER}/Elements/R5.mo").read_text()
    execute("build", "--check")


def test_a_file_that_moves_can_be_kept_and_gets_its_new_name(moved: Path, execute: Execute) -> None:
    mine = Path(f"{LADDER}/Elements/R2.mo").read_text()
    assert execute("resolve", f"{LADDER}/Elements/R2.mo", "--keep").lines[0].endswith("1 moved with your edits")
    assert not Path(f"{LADDER}/Elements/R2.mo").exists()
    kept = Path(f"{LADDER}/Elements/R5.mo").read_text()
    assert kept == mine.replace("model R2", "model R5").replace("end R2", "end R5").replace("R2Param", "R5Param")
    execute("build", "--check")


def test_a_file_that_moves_later_is_kept_as_it_is_until_then(moved: Path, execute: Execute) -> None:
    edit(MODEL, '"Element R2"', '"Element R2, 1 %"')
    old, new = Path(f"{LADDER}/Elements/R2.mo"), Path(f"{LADDER}/Elements/R5.mo")
    mine = old.read_text()
    assert execute("resolve", str(old), "--keep", code=3).err == ""
    assert old.read_text() == mine
    assert conflicts(execute) == ["Ladder.mo"]
    execute("resolve", MODEL, "--take")
    assert not old.exists()
    assert new.read_text() == mine.replace("R2P", "R5P").replace("model R2", "model R5").replace("end R2", "end R5")
    execute("build", "--check")


# What is saved meanwhile


def save_before(monkeypatch: pytest.MonkeyPatch, path: Path, old: str, new: str) -> None:
    """Let somebody save a file after `resolve` has looked at it, and before it builds."""

    def save_and_build(*arguments: Any) -> Iterator[Result]:
        edit(path, old, new)
        return build_and_check(*arguments)

    monkeypatch.setattr("urdfsync.commands.resolve.build_and_check", save_and_build)


CHANGED = "changed after they were read, so your choice was not applied; look at it, then choose again"


@pytest.mark.parametrize("choice", ["--take", "--keep", "--edit", "--merge --prefer generated"])
@pytest.mark.parametrize("named", [MODEL, "--all"])
def test_a_file_that_is_saved_after_the_look_stays_in_conflict(
    contradictory: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, choice: str, named: str, editor: Editor
) -> None:
    editor(SETTLE)
    save_before(monkeypatch, Path(MODEL), MINE, '"Element R2, 2 %"')
    printed = execute("resolve", named, *choice.split(), code=3)
    assert CHANGED in printed.err
    assert not any(line.startswith(("  keep ", "  merge ", "  update ")) for line in printed.lines)
    assert '"Element R2, 2 %"' in Path(MODEL).read_text()
    assert conflicts(execute) == ["Ladder.mo"]


def test_a_merge_is_not_taken_of_a_text_that_nobody_has_seen(
    clean: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    save_before(monkeypatch, Path(MODEL), "Real mine = 1", "Real mine = 2")
    assert CHANGED in execute("resolve", MODEL, "--merge", code=3).err
    assert FRESH not in Path(MODEL).read_text()


def test_an_export_after_the_look_is_not_taken(clean: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    save_before(monkeypatch, Path("ladder.json"), '"R3"', '"R4"')
    assert CHANGED in execute("resolve", MODEL, "--take", code=3).err
    assert "Real mine" in Path(MODEL).read_text()


def test_an_orphan_that_is_saved_after_the_look_is_not_deleted(
    orphan: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    save_before(monkeypatch, orphan, "Real mine;", "Real mine, yours;")
    assert CHANGED in execute("resolve", str(orphan), "--take", code=3).err
    assert "Real mine, yours;" in orphan.read_text()


def test_an_edit_without_conflict_that_is_saved_after_the_look_stays(
    project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    execute("build")
    edit(MODEL, "equation", "  Real mine;\n\nequation")
    save_before(monkeypatch, Path(MODEL), "Real mine;", "Real mine, yours;")
    assert CHANGED in execute("resolve", MODEL, "--take", code=3).err
    assert "Real mine, yours;" in Path(MODEL).read_text()


@pytest.mark.parametrize("operation", ["write", "exchange", "sync"])
def test_a_save_while_the_choice_is_carried_out_stays(contradictory: Path, execute: Execute, operation: str) -> None:
    saved = Path(MODEL).read_text().replace("1 %", "2 %")

    def save(found: Operation) -> None:
        if found.name == operation:
            Path(MODEL).write_text(saved)

    with before_each(save):
        assert CHANGED in execute("resolve", MODEL, "--take", code=3).err
    assert Path(MODEL).read_text() == saved
    assert conflicts(execute) == ["Ladder.mo"]


# Robots, locks, programs


def second_robot(text: str) -> None:
    Path("other.json").write_text(text)
    configure(ROBOT.format("other", "Other").replace("ladder.json", "other.json"))


def test_only_the_robots_that_are_concerned_are_built(clean: Path, execute: Execute) -> None:
    second_robot(Path("ladder.json").read_text())
    assert execute("resolve", MODEL, "--merge").out.startswith("ladder: ")
    assert not Path("modelica/Other").exists()


def test_a_broken_robot_hinders_no_other(clean: Path, execute: Execute) -> None:
    second_robot("{")
    errors = execute("resolve", "modelica/Other/Other.mo", "--keep", code=2).err
    assert "other.json:1: error: " in errors
    assert "nothing conflicts in `modelica/Other/Other.mo`; correct the errors first" in errors
    assert execute("resolve", "ladder", "--merge").out.startswith("ladder: ")
    execute("resolve", "--all", "--keep", code=2)


@pytest.mark.parametrize("choice", ["--merge", "--keep"])
def test_a_broken_package_without_a_conflict_is_told(project: Path, execute: Execute, choice: str) -> None:
    execute("build")
    edit(MODEL, "Elements.C1 elementC1", "Elements.C9 elementC1")
    printed = execute("resolve", "--all", choice, code=3)
    assert "there is no class `Elements.C9`" in printed.err
    assert "nothing is in conflict" in printed.err


def test_another_build_is_waited_for(clean: Path, execute: Execute) -> None:
    with build_lock(clean / ".urdfsync", 0) as lock:
        lock.acquire()
        execute("resolve", MODEL, "--merge", "--wait", "0", code=4)
    assert "parameter Real mine = 1;" in Path(MODEL).read_text()
    assert FRESH not in Path(MODEL).read_text()


def test_a_configuration_elsewhere(
    clean: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute
) -> None:
    monkeypatch.chdir(tmp_path)
    (line,) = [
        line
        for line in execute("build", "--config", "project/urdfsync.toml", code=3).lines
        if line.startswith("    urdfsync resolve")
    ]
    command = line.split()[1:]
    assert command == ["resolve", str(Path("project") / MODEL), "--merge", "--config", "project/urdfsync.toml"]
    assert cli.main(command) == 0
