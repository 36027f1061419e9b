"""CAD counts the shapes of a link anew: an edit follows its shape, or the file becomes a conflict."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.meshes import stl
from support.networks import edit
from support.urdfs import joint, link, robot

from urdfsync.engine.result import Exit

MODEL, RECORD = Path("modelica/Arm/Links/Upper.mo"), Path("modelica/Arm/Links/UpperParameters.mo")
WHOLE = Path("modelica/Arm/ArmParameters.mo")
SIZES = {"housing": 0.4, "motor": 0.3, "cover": 0.05, "plate": 0.9}
RED, GREY, PINK = "{255, 7, 7}", "{180, 180, 180}", "{255, 105, 180}"


def arm(*shapes: str, is_named: bool = False, sizes: dict[str, float] | None = None, name: str = "upper") -> str:
    """An arm whose link `upper` has these shapes as visuals and as collisions."""
    texts = []
    for kind in ("visual", "collision"):
        for shape in shapes:
            size = {**SIZES, **(sizes or {})}[shape]
            named = f' name="{shape}"' if is_named else ""
            geometry = f'<origin xyz="{SIZES[shape] / 2} 0 0"/><geometry><box size="{size} 0.1 0.1"/></geometry>'
            texts.append(f"<{kind}{named}>{geometry}</{kind}>")
    upper = link(name, 4.0).replace("</link>", "".join([*texts, "</link>"]))
    return robot(link("base", 9.0), upper, joint("shoulder", "revolute", "base", name), name="arm")


def export(*shapes: str, **options: object) -> None:
    Path("arm.urdf").write_text(arm(*shapes, **options))  # type: ignore[arg-type]


def shape(file: Path, start: str) -> str:
    """The declaration of a component in a file."""
    text = file.read_text()
    return text[(begin := text.index(f" {start}(")) : text.index(";", begin)]


def edit_shape(file: Path, start: str, old: str, new: str) -> None:
    edit(file, declared := shape(file, start), declared.replace(old, new))


def painted(file: Path = RECORD, prefix: str = "visual") -> dict[str, str]:
    """The colours of all visuals by their lengths."""
    starts = re.findall(rf" ({prefix}\d+)\(", file.read_text())
    texts = [shape(file, start) for start in starts]
    return {re.findall(r"size = \{([\d.]+)", text)[0]: re.findall(r"color = (\{.*?\})", text)[0] for text in texts}


def hidden() -> list[str]:
    """The lengths of the boxes that the model of the link hides."""
    starts = [start for start in re.findall(r" (visual\d+)\(", MODEL.read_text()) if "= false" in shape(MODEL, start)]
    return [re.findall(r"size = \{([\d.]+)", shape(RECORD, start))[0] for start in starts]


@pytest.fixture
def start(folder: Path, execute: Execute) -> None:
    """A folder with a built arm of three unnamed shapes; builds merge."""
    assert folder.is_dir()
    Path("urdfsync.toml").write_text(
        '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\napproach = ["package", "record"]\non_conflict = "merge"\n'
    )
    export("housing", "motor", "cover")
    execute("build")


EXPORTS = {
    "exchanged": ["motor", "housing", "cover"],
    "rotated": ["motor", "cover", "housing"],
    "inserted": ["plate", "housing", "motor", "cover"],
    "inserted twice": ["plate", "housing", "plate", "motor"],
    "removed": ["motor", "cover"],
    "all but one removed": ["motor"],
    "added": ["housing", "motor", "cover", "plate"],
}
NAMES = {"named": (True, True), "unnamed": (False, False), "named later": (False, True), "unnamed later": (True, False)}


@pytest.mark.parametrize("shapes", EXPORTS.values(), ids=EXPORTS)
@pytest.mark.parametrize("names", NAMES.values(), ids=NAMES)
def test_edits_go_with_their_shapes(start: None, execute: Execute, shapes: list[str], names: tuple[bool, bool]) -> None:
    export("housing", "motor", "cover", is_named=names[0])
    execute("build")
    edit_shape(MODEL, "visual2", "= animation", "= false")
    edit_shape(RECORD, "visual2", GREY, RED)
    edit_shape(RECORD, "collision2", PINK, RED)
    edit_shape(WHOLE, "upperVisual2", GREY, RED)
    execute("build")
    export(*shapes, is_named=names[1])
    execute("build")
    assert hidden() == ["0.3"]
    expected = {str(SIZES[shape]): RED if shape == "motor" else GREY for shape in shapes}
    assert painted() == painted(WHOLE, "upperVisual") == expected
    assert painted(prefix="collision") == {size: colour.replace(GREY, PINK) for size, colour in expected.items()}
    assert execute("build", "--check").words.endswith("3 kept because you edited them")


@pytest.mark.parametrize("shapes", EXPORTS.values(), ids=EXPORTS)
def test_an_edit_elsewhere_in_the_file_stays(start: None, execute: Execute, shapes: list[str]) -> None:
    mine = "\n  Real mine = 1;\n"
    edit(MODEL, "\nequation\n", f"{mine}\nequation\n")
    edit(RECORD, "mass = 4", "mass = 5")
    export(*shapes)
    execute("build")
    edited = MODEL.read_text(), RECORD.read_text()
    MODEL.unlink()
    RECORD.unlink()
    execute("build")
    generated = MODEL.read_text(), RECORD.read_text().replace("mass = 4", "mass = 5")
    assert (edited[0].replace(mine, ""), edited[1]) == generated


def test_an_exchange_is_no_conflict_for_an_edit_elsewhere(start: None, execute: Execute) -> None:
    edit("urdfsync.toml", 'on_conflict = "merge"\n', "")
    edit(MODEL, "\nequation\n", "\n  Real mine = 1;\n\nequation\n")
    export("motor", "housing", "cover")
    assert "1 kept because you edited it" in execute("build").out


def test_an_exchange_asks_before_an_edit_follows(start: None, execute: Execute) -> None:
    """The generated text of the model does not change: only the record has the numbers."""
    edit("urdfsync.toml", 'on_conflict = "merge"\n', "")
    edit_shape(MODEL, "visual2", "= animation", "= false")
    execute("build")
    export("motor", "housing", "cover")
    printed = execute("build", code=Exit.CONFLICT)
    assert "conflict   modelica/Arm/Links/Upper.mo" in printed.out
    assert "`visual1` is now `visual2` (and 3 more numbers); the changes fit together" in printed.words
    execute("build", "--check", code=Exit.CONFLICT)
    assert hidden() == ["0.3"]
    execute("resolve", MODEL, "--merge")
    assert hidden() == ["0.3"]
    assert "= false" in shape(MODEL, "visual1")
    execute("build", "--check")


@pytest.mark.parametrize("shapes", [["housing", "cover"], ["plate", "housing", "cover"], ["cover", "housing"]])
def test_an_edit_of_a_removed_shape_conflicts(start: None, execute: Execute, shapes: list[str]) -> None:
    edit_shape(MODEL, "visual2", "= animation", "= false")
    execute("build")
    before = MODEL.read_text()
    export(*shapes)
    printed = execute("build", code=Exit.CONFLICT)
    assert "`visual2` is another part now, and the export has no part like the one that you edited" in printed.words
    execute("resolve", MODEL, "--merge", "--prefer", "mine", code=Exit.CONFLICT)
    assert MODEL.read_text() == before


def test_a_shape_with_other_numbers_keeps_its_edit(start: None, execute: Execute) -> None:
    edit_shape(RECORD, "visual2", GREY, RED)
    export("plate", "housing", "motor", "cover", sizes={"motor": 0.35})
    execute("build")
    assert painted() == {"0.9": GREY, "0.4": GREY, "0.35": RED, "0.05": GREY}


@pytest.mark.parametrize("is_numbered", [False, True])
def test_a_mesh_is_known_by_its_contents_else_by_its_name(start: None, execute: Execute, is_numbered: bool) -> None:
    """An exporter may number the files of meshes, too; or it writes other bytes under the same names."""

    def export_meshes(scale: float, **sizes: float) -> None:
        texts = []
        for number, (name, size) in enumerate(sizes.items(), 1):
            file = f"part_{number}.stl" if is_numbered else f"{name}.stl"
            Path(file).write_text(stl(size * (1 if is_numbered else scale)))
            texts.append(f'<visual><geometry><mesh filename="{file}"/></geometry></visual>')
        Path("arm.urdf").write_text(arm().replace("</link>\n<joint", "".join([*texts, "</link>\n<joint"])))

    export_meshes(1, housing=0.4, motor=0.3)
    execute("build")
    edit_shape(RECORD, "visual2", GREY, RED)
    export_meshes(1.1, plate=0.9, housing=0.4, motor=0.3)
    execute("build")
    assert RED in shape(RECORD, "visual3")
    assert RECORD.read_text().count(RED) == 1


def test_edits_follow_the_shapes_of_a_renamed_link(start: None, execute: Execute) -> None:
    edit_shape(RECORD, "visual2", GREY, RED)
    edit_shape(WHOLE, "upperVisual2", GREY, RED)
    export("plate", "housing", "motor", "cover", name="arm_1")
    execute("build")
    expected = {"0.9": GREY, "0.4": GREY, "0.3": RED, "0.05": GREY}
    assert painted(RECORD.with_name("Arm_1Parameters.mo")) == painted(WHOLE, "arm_1Visual") == expected


def test_a_name_of_the_users_own_is_in_the_way(start: None, execute: Execute) -> None:
    edit(MODEL, "\nequation\n", "\n  Real visual4 = 1;\n\nequation\n")
    edit_shape(MODEL, "visual3", "= animation", "= false")
    export("plate", "housing", "motor", "cover")
    execute("build", code=Exit.CONFLICT)


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("Arm.mo", "Links.Upper upper(", "Links.Upper upper(visual2(animation = false),"),
        ("Arm.mo", "\nequation", "\n  Real mine = upper.visual2.parameters.opacity;\n\nequation"),
        ("ArmRun.mo", "\nequation", "\n  Real mine = robot.upper.visual2.parameters.opacity;\n\nequation"),
    ],
)
def test_a_use_of_a_shape_outside_of_its_link_is_asked_about_once(
    start: None, execute: Execute, file: str, old: str, new: str
) -> None:
    path = f"modelica/Arm/{file}"
    edit(path, old, new)
    export("motor", "housing", "cover")
    printed = execute("build", code=Exit.CONFLICT)
    assert "`visual2` of `upper` may be another part now" in printed.words
    edit(path, "visual2", "visual1")
    execute("resolve", path, "--keep")
    execute("build", "--check")


def test_a_use_of_another_links_shape_is_not_asked_about(start: None, execute: Execute) -> None:
    def export_both(*shapes: str) -> None:
        (visual,) = re.findall("<visual>.*?</visual>", arm("plate"))
        Path("arm.urdf").write_text(arm(*shapes).replace("</link>", f"{visual}</link>", 1))

    export_both("housing", "motor")
    execute("build")
    edit("modelica/Arm/Arm.mo", "\nequation", "\n  Real mine = base.visual1.parameters.opacity;\n\nequation")
    export_both("motor", "housing")
    assert "1 kept because you edited it" in execute("build").out


def test_a_clone_decides_the_same(start: None, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    edit_shape(MODEL, "visual2", "= animation", "= false")
    edit_shape(RECORD, "visual2", GREY, RED)
    execute("build")
    shutil.copytree(".", "../clone")
    for name in ("notes", "cache"):
        shutil.rmtree(f"../clone/.urdfsync/{name}", ignore_errors=True)
    for folder in (".", "../clone"):
        monkeypatch.chdir(folder)
        export("plate", "housing", "motor", "cover")
        execute("build")
        assert (hidden(), painted()["0.3"]) == (["0.3"], RED)


def test_edits_follow_once_while_another_conflict_is_open(start: None, execute: Execute) -> None:
    """The first answer settles the model of the link; further builds and exports do not move its edit unseen."""
    edit("urdfsync.toml", 'on_conflict = "merge"\n', "")
    edit_shape(MODEL, "visual2", "= animation", "= false")
    other = "modelica/Arm/Links/BaseParameters.mo"
    edit(other, "mass = 9", "mass = 8")
    export("motor", "housing", "cover")
    Path("arm.urdf").write_text(Path("arm.urdf").read_text().replace('"9.0"', '"7.0"'))
    execute("build", code=Exit.CONFLICT)
    execute("resolve", MODEL, "--merge", code=None)
    assert "= false" in shape(MODEL, "visual1")
    execute("build", code=Exit.CONFLICT)
    assert "= false" in shape(MODEL, "visual1")
    export("housing", "motor", "cover")  # and back
    Path("arm.urdf").write_text(Path("arm.urdf").read_text().replace('"9.0"', '"6.0"'))
    execute("build", code=Exit.CONFLICT)
    printed = execute("build", code=Exit.CONFLICT)
    assert "conflict   modelica/Arm/Links/Upper.mo" in printed.out
    assert "`visual1` of `upper` may be another part now" in printed.out


def test_a_recorded_model_that_the_files_contradict_moves_nothing(start: None, execute: Execute) -> None:
    """A stranger has exchanged the shapes in the record."""
    edit_shape(MODEL, "visual2", "= animation", "= false")
    execute("build")
    state = Path(".urdfsync/robots/arm.state")
    shapes = [f'"size":[{SIZES[name]},0.1,0.1]{{}}[{SIZES[name] / 2},0.0,0.0]' for name in ("housing", "motor")]
    between = '},"name":"","origin":{"rpy":[0.0,0.0,0.0],"xyz":'
    one, other = (shape.format(between) for shape in shapes)
    forged = state.read_text().replace(one, "\0").replace(other, one).replace("\0", other)
    assert forged != state.read_text()
    state.write_text(forged)
    before = MODEL.read_text()
    assert "may be another part now" in execute("build", code=Exit.CONFLICT).words
    assert MODEL.read_text() == before


@NEEDS_GIT
@pytest.mark.slow
@pytest.mark.parametrize("driver", [False, True])
@pytest.mark.parametrize("edits_first", [False, True])
@pytest.mark.parametrize("file", [MODEL, RECORD])
def test_one_branch_exchanges_shapes_and_the_other_edits(
    start: None,
    execute: Execute,
    monkeypatch: pytest.MonkeyPatch,
    file: Path,
    edits_first: bool,
    driver: bool,
) -> None:
    """From either side of git's merge, an edit follows its shape, or the build asks about it."""
    repository = Repository(Path.cwd(), monkeypatch)
    if driver:
        execute("merge-driver", "--install")
    repository.commit()
    for branch in ("theirs", "ours"):
        repository.git("checkout", "-q", "-b", branch, "main")
        if (branch == "ours") is edits_first:
            edit_shape(file, "visual2", *(("= animation", "= false") if file is MODEL else (GREY, RED)))
            edit(file, "\nend Upper", "\n  // remark\nend Upper")
        else:
            export("motor", "housing", "cover")
        execute("build")
        repository.commit(branch)
    subprocess.run(["git", "merge", "-q", "--no-edit", "theirs"], capture_output=True)
    printed = execute("build", code=None)
    repository.commit()
    if printed.code == Exit.CONFLICT:
        assert "may be another part now" in printed.words, printed
        execute("resolve", file, "--keep")
    else:
        edited = hidden() if file is MODEL else [size for size, colour in painted().items() if colour == RED]
        assert edited == ["0.3"]
    execute("build", "--check")


@NEEDS_GIT
def test_an_edit_elsewhere_is_not_asked_about_after_a_merge(
    start: None, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    repository = Repository(Path.cwd(), monkeypatch)
    repository.commit()
    repository.git("checkout", "-q", "-b", "theirs")
    edit(MODEL, "\nequation\n", "\n  Real mine = 1;\n\nequation\n")
    execute("build")
    repository.commit()
    repository.git("checkout", "-q", "main")
    export("motor", "housing", "cover")
    execute("build")
    repository.commit()
    repository.merge("theirs")
    execute("build")
    assert "Real mine = 1;" in MODEL.read_text()


@NEEDS_GIT
def test_both_branches_change_the_link_and_one_counts_its_shapes_anew(
    start: None, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Then the united record has no model of the link; the commits have."""

    def export_heavier() -> None:
        edit("arm.urdf", 'mass value="4.0"', 'mass value="5.0"')

    repository = Repository(Path.cwd(), monkeypatch)
    repository.commit()
    repository.git("checkout", "-q", "-b", "theirs")
    export("plate", "housing", "motor", "cover")
    execute("build")
    repository.commit()
    repository.git("checkout", "-q", "main")
    export_heavier()
    execute("build")
    edit_shape(MODEL, "visual2", "= animation", "= false")
    execute("build")
    repository.commit()
    subprocess.run(["git", "merge", "-q", "--no-edit", "theirs"], capture_output=True)
    export("plate", "housing", "motor", "cover")
    export_heavier()
    repository.commit()
    assert "of `upper` may be another part now" in execute("build", code=Exit.CONFLICT).words
