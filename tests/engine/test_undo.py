"""What a build wrote over comes back as it was: a file, a merge that may be made again; but not over a later save."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from support.commands import Execute
from support.files import unchanged
from support.networks import LADDER, MINE, R2, RECORD, add_resistor, configure, conflicts, edit, resistor, run

from urdfsync import config
from urdfsync.engine.actions import Choice, Reason, UsersChoice, sides_hash
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions

MODEL = f"{LADDER}/Ladder.mo"


@pytest.fixture
def deleted(execute: Execute, project: Path) -> Path:
    """An edited model whose element is gone, and that the user has let a build delete."""
    execute("build")
    edit(f"{LADDER}/Elements/R2.mo", "equation", "  Real mine;\nequation")
    edit("ladder.json", '{"name": "R2", "between": ["middle", "out"]', '{"name": "R3", "between": ["in", "out"]')
    execute("build")
    orphan = project / LADDER / "Elements/R2.mo"
    (project / "mine.txt").write_text(orphan.read_text())
    execute("resolve", str(orphan), "--take")
    return orphan


def test_an_orphan_that_was_deleted_is_given_back_with_the_record_beside_it(deleted: Path, execute: Execute) -> None:
    edit("ladder.json", "220.5", "330")
    execute("build")
    assert execute("resolve", str(deleted), "--undo").err == ""
    for _ in range(2):
        assert deleted.read_text() == Path("mine.txt").read_text()
        listed = Path(LADDER, "Elements/package.order").read_text().split()
        assert [name for name in listed if name.startswith("R2")] == ["R2", "R2Parameters"]
        found = {action.path: action.reason for action in run(dry=True).actions}
        assert found[f"{LADDER}/Elements/R2Parameters.mo"] is Reason.NEEDED
        execute("build", "--check")
    execute("resolve", str(deleted), "--undo", code=2)


def test_a_model_is_given_back_with_the_classes_that_it_uses(project: Path, execute: Execute) -> None:
    """They were deleted once no text used them any more."""
    execute("build")
    edit(MODEL, '"Element R2"', MINE)
    edit("ladder.json", '{"name": "R2", "between": ["middle", "out"]', '{"name": "R3", "between": ["in", "out"]')
    execute("resolve", MODEL, "--take")
    assert not Path(R2).exists()
    execute("resolve", MODEL, "--undo", code=3)
    execute("resolve", MODEL, "--keep")
    assert Path(R2).exists()


def test_a_choice_that_changed_no_text_is_taken_back_once(deleted: Path, execute: Execute) -> None:
    execute("resolve", str(deleted), "--undo")
    execute("resolve", str(deleted), "--keep")
    execute("resolve", str(deleted), "--undo")
    assert run(dry=True).actions.decided[0].reason is Reason.ORPHAN
    printed = execute("resolve", str(deleted), "--undo", "--quiet", code=2)
    assert printed.errors == [line for line in printed.errors if "error: nothing to undo" in line] != []


def test_nothing_to_undo_is_said_of_a_file_in_conflict_too(project: Path, execute: Execute) -> None:
    execute("build")
    edit(RECORD, "100", "101")
    resistor(150)
    assert "error: nothing to undo" in execute("resolve", RECORD, "--undo", "--quiet", code=3).err


def test_a_file_that_took_the_place_of_a_deleted_one_stays(deleted: Path, execute: Execute) -> None:
    deleted.write_text("model R2\nend R2;\n")
    execute("resolve", str(deleted), "--undo", code=2)
    assert deleted.read_text() == "model R2\nend R2;\n"


def test_what_was_not_taken_along_by_a_rename_can_be_given_back(execute: Execute, project: Path) -> None:
    execute("build")
    edit(f"{LADDER}/Elements/R1.mo", "equation", "  Real mine;\nequation")
    edit("ladder.json", '"R1"', '"R8"')
    renamed = Path(f"{LADDER}/Elements/R8.mo")
    execute("resolve", f"{LADDER}/Elements/R1.mo", "--take")
    assert "Real mine;" not in renamed.read_text()
    execute("resolve", str(renamed), "--undo", code=3)
    assert "Real mine;" in renamed.read_text()
    assert "end R8;" in renamed.read_text()
    execute("resolve", str(renamed), "--keep")
    execute("build", "--check")


@pytest.fixture
def merged(project: Path, execute: Execute) -> Path:
    """The network's model was edited and merged with one more resistor; what the user had is in `mine.txt`."""
    execute("build")
    edit(MODEL, "Elements.C1 elementC1", "parameter Real mine = 1;\n\n  Elements.C1 elementC1")
    add_resistor("R3")
    (project / "mine.txt").write_text(Path(MODEL).read_text())
    lines = execute("build", "--merge").lines
    assert lines[-1] == f"  merge      {Path(MODEL)}  R3; merged with your edits"
    return project


def test_undo_gives_back_what_was_there_before_the_merge(merged: Path, execute: Execute) -> None:
    both = Path(MODEL).read_text()
    execute("resolve", MODEL, "--undo", "--dry-run", code=3)
    assert Path(MODEL).read_text() == both
    assert execute("resolve", MODEL, "--undo", code=3).lines[0] == "ladder: 1 file given back as you had it, 1 conflict"
    assert Path(MODEL).read_text() == Path("mine.txt").read_text()
    assert execute("build", code=3).lines[0] == "ladder: 1 conflict"


def test_what_the_configuration_merges_stays_undone(merged: Path, execute: Execute) -> None:
    """The next build would merge it again."""
    execute("resolve", MODEL, "--undo", code=3)
    configure('on_conflict = "merge"\n')
    execute("build")
    execute("resolve", MODEL, "--undo")
    for command in (["build"], ["build", "--merge"], ["build", "--full", "--merge"]):
        assert execute(*command).lines[0] == "ladder: in step, 16 files, 1 kept because you edited it"


@pytest.mark.parametrize("again", ["--merge", "--undo"])
def test_a_merge_that_was_undone_can_be_made_again(merged: Path, execute: Execute, again: str) -> None:
    both = Path(MODEL).read_text()
    execute("resolve", MODEL, "--undo", code=3)
    execute("build", code=3)
    execute("resolve", MODEL, again)
    assert Path(MODEL).read_text() == both
    execute("build", "--check")
    execute("resolve", MODEL, "--undo", code=3)
    assert Path(MODEL).read_text() == Path("mine.txt").read_text()


def test_a_merge_with_a_rename_that_was_undone_can_be_made_again(execute: Execute, project: Path) -> None:
    execute("build")
    edit(MODEL, "Elements.C1 elementC1", "Elements.C1 mine;\n\n  Elements.C1 elementC1")
    edit("ladder.json", '"C1"', '"C3"')
    execute("build", "--merge")
    both = Path(MODEL).read_text()
    assert "Elements.C3 mine;" in both
    for _ in range(2):
        execute("resolve", MODEL, "--undo", code=3)
        execute("resolve", MODEL, "--merge")
        assert Path(MODEL).read_text() == both


def test_a_file_that_was_saved_since_is_not_given_back(merged: Path, execute: Execute) -> None:
    edit(MODEL, "Real mine = 1", "Real mine = 2")
    with unchanged(merged, but=".urdfsync/lock"):
        assert "or the file has changed since" in execute("resolve", MODEL, "--undo", code=2).err


def test_a_merge_that_another_export_goes_beyond_can_be_undone(merged: Path) -> None:
    add_resistor("R4")
    assert conflicts(choices={MODEL: Choice.UNDO}) == [MODEL]
    assert Path(MODEL).read_text() == Path("mine.txt").read_text()


def test_what_was_taken_can_be_given_back(project: Path, execute: Execute) -> None:
    execute("build")
    edit(MODEL, '"Element R2"', '"Element R2, 1 %"')
    edit("ladder.json", '{"name": "R2", "between": ["middle", "out"]', '{"name": "R3", "between": ["in", "out"]')
    mine = Path(MODEL).read_text()
    execute("resolve", MODEL, "--take")
    assert "1 %" not in Path(MODEL).read_text()
    execute("resolve", MODEL, "--undo", code=3)
    assert Path(MODEL).read_text() == mine


def test_what_nobody_edited_is_not_given_back(execute: Execute, project: Path) -> None:
    execute("build")
    add_resistor("R3")
    execute("build")
    assert "nothing to undo" in execute("resolve", MODEL, "--undo", code=2).err


def test_nothing_is_undone_where_no_build_wrote_over_the_file(project: Path) -> None:
    """The command refuses that before; a choice may be older than the files."""
    run()
    edit(MODEL, "end Ladder;", "// mine\nend Ladder;")
    mine = Path(MODEL).read_text()
    assert run(choices={MODEL: Choice.UNDO}).conflicts == []
    assert Path(MODEL).read_text() == mine


def test_what_a_stranger_put_beside_the_state_is_no_bug(merged: Path, execute: Execute) -> None:
    file = merged / ".urdfsync/aside/ladder/index.json"
    for text in ("", "x", "[]", '{"x.mo": {"file": "../x.mo"}}', "\ud800", "[" * 100_000):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, errors="surrogatepass")
        execute("build")


def put_aside() -> list[str]:
    folder = Path(".urdfsync/aside/ladder")
    index = json.loads((folder / "index.json").read_text()) if (folder / "index.json").exists() else {}
    assert all((folder / aside["file"]).is_file() for aside in index.values())
    return sorted(index)


def test_what_was_put_aside_goes_once_its_file_is_saved(merged: Path, execute: Execute) -> None:
    assert put_aside() == ["Ladder.mo"]
    edit(MODEL, "Real mine = 1", "Real mine = 2")
    resistor(120)
    execute("build")
    assert put_aside() == []


def test_texts_that_nobody_edited_are_not_put_aside(merged: Path, execute: Execute) -> None:
    resistor(120)
    execute("build")
    assert put_aside() == ["Ladder.mo"]


def test_a_file_that_comes_after_the_look_is_not_written_over(deleted: Path) -> None:
    path = deleted.relative_to(Path.cwd()).as_posix()
    deleted.write_text("model R2\nend R2;\n")
    loaded = config.load(Path("urdfsync.toml"))
    choices = {path: UsersChoice(Choice.UNDO, sides_hash(None, None))}
    list(build(loaded, loaded.robots, BuildOptions(choices=choices)))
    assert deleted.read_text() == "model R2\nend R2;\n"


def test_no_text_that_was_put_aside_is_ever_written_over(project: Path, execute: Execute) -> None:
    execute("build")
    for number in (1, 2):
        edit(MODEL, "equation", f"  Real mine{number};\nequation")
        execute("resolve", MODEL, "--take")
    kept = "".join(path.read_text() for path in Path(".urdfsync/aside").rglob("*.mo"))
    assert "mine1" in kept
    assert "mine2" in kept


def test_a_recorded_text_that_this_machine_did_not_generate_can_be_given_back(project: Path, execute: Execute) -> None:
    """As in a clone, or where a stranger has recorded what a person wrote."""
    execute("build")
    shutil.rmtree(".urdfsync/notes")
    before = Path(RECORD).read_text()
    resistor(120)
    assert "1 text that this machine did not generate is replaced" in execute("build", "--verbose").err
    execute("resolve", RECORD, "--undo")
    assert Path(RECORD).read_text() == before
    execute("build", "--check")


def test_a_choice_can_be_undone_after_its_file_has_moved(project: Path, execute: Execute) -> None:
    execute("build")
    edit(f"{LADDER}/Elements/R1.mo", "equation", "  Real mine;\nequation")
    edit(MODEL, '"Element R1"', '"Element R1, 1 %"')
    edit("ladder.json", '"R1"', '"R8"')
    old, new = Path(f"{LADDER}/Elements/R1.mo"), Path(f"{LADDER}/Elements/R8.mo")
    execute("resolve", str(old), "--take", code=3)
    assert "Real mine;" not in old.read_text()
    execute("resolve", MODEL, "--take")
    assert not old.exists()
    execute("resolve", str(new), "--undo", code=None)
    assert "Real mine;" in new.read_text()
    assert "end R8;" in new.read_text()
