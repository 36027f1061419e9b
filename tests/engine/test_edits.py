"""`urdfsync diff --edits`: what the user changed in generated files, by elements."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute
from support.files import unchanged
from support.networks import LADDER, RECORD, edit, rename

ROBOT_MODEL = "modelica/Ladder/Ladder.mo"


@pytest.fixture
def edited(project: Path, execute: Execute) -> Path:
    """The project of the second domain, built, with a number changed and a component added by hand."""
    execute("build", "-q")
    edit(RECORD, "100", "101")
    edit(ROBOT_MODEL, "equation", "  Real mine; // measured\n\nequation")
    return project


def test_edits_are_told_by_element(execute: Execute, edited: Path) -> None:
    with unchanged(edited):
        lines = execute("diff", "--edits").lines
    assert lines == [
        "ladder: 2 files edited",
        f"  {RECORD}  element R1",
        "    component `R`: R 100 → 101",
        f"  {ROBOT_MODEL}  network",
        "    component `mine`: added",
        "    comments: changed",
    ]


def test_paths_choose(execute: Execute, edited: Path) -> None:
    assert execute("diff", "--edits", RECORD).lines[0] == "ladder: 1 file edited"
    assert execute("diff", "--edits", "modelica/Ladder/Elements").lines[0] == "ladder: 1 file edited"
    assert execute("diff", "--edits", "ladder").lines[0] == "ladder: 2 files edited"
    assert "no robot `nowhere` in the configuration" in execute("diff", "--edits", "nowhere", code=2).err


def test_verbose_shows_the_lines(execute: Execute, edited: Path) -> None:
    lines = execute("diff", "--edits", RECORD, "-v").lines
    text = '  parameter Modelica.Units.SI.Resistance R = {} "Resistance";'
    assert [line[4:] for line in lines if line[4:5] in ("+", "-")][2:] == [
        f"-{text.format(100)}",
        f"+{text.format(101)}",
    ]


def test_a_class_that_became_a_folder_is_edited(execute: Execute, edited: Path) -> None:
    folder = Path(f"{LADDER}/Elements/R2")
    folder.mkdir()
    folder.with_suffix(".mo").rename(folder / "package.mo")
    edit(folder / "package.mo", "end R2;", "  // mine\nend R2;")
    lines = execute("diff", "--edits").lines
    assert lines[0] == "ladder: 3 files edited"
    assert lines[3:5] == [f"  {folder}/package.mo  element R2", "    comments: changed"]


def test_nothing_is_edited(execute: Execute, project: Path) -> None:
    execute("build", "-q")
    assert execute("diff", "--edits").lines == ["ladder: nothing is edited"]


def test_a_merge_leaves_the_edits(execute: Execute, edited: Path) -> None:
    """What the export brought in is no edit."""
    rename("R2", "R9")
    before = execute("diff", "--edits").lines
    execute("build", "--merge", "-q")
    assert execute("diff", "--edits").lines == before


def test_other_blanks_and_no_modelica(execute: Execute, edited: Path) -> None:
    edit(RECORD, "101", " 100")
    assert "    only blanks, or the order of things" in execute("diff", "--edits", RECORD).lines
    (edited / RECORD).write_text("no model\n")
    ((file,),) = (robot["files"] for robot in execute("diff", "--edits", "--format=json", RECORD).json["results"])
    assert file["edits"] is None  # an empty list stands for other blanks


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("model A\n  Real q;\n  Real q;\nend A;\n", "declares `q` twice"),
        ("model\n", "lacks a name before its end"),
    ],
)
def test_a_fault_is_told_as_by_a_build(execute: Execute, edited: Path, text: str, what: str) -> None:
    (edited / RECORD).write_text(text)
    (said,) = [line for line in execute("diff", "--edits", RECORD).lines if "only its lines can be compared" in line]
    assert said.startswith(f"    the file {what} (line ")
    assert f"error: the file {what}" in execute("build", code=None).err


def test_two_classes_are_no_single_class(execute: Execute, edited: Path) -> None:
    (edited / RECORD).write_text("model A\nend A;\nmodel B\nend B;\n")
    assert "    the file is no single class, so only" in execute("diff", "--edits", RECORD).out


def test_programs_get_the_texts(execute: Execute, edited: Path) -> None:
    (robot,) = execute("diff", "--edits", "--format=json").json["results"]
    assert robot["files"][0] == {
        "path": RECORD,
        "owner": "element R1",
        "edits": [{"element": "component `R`", "part": "R", "base": "100", "mine": "101"}],
    }
