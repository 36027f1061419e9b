"""CAD renumbers: an edit follows its part, or the file becomes a conflict that asks the user."""

from __future__ import annotations

import itertools
import re
import shutil
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import get_args

import pytest
from support import corpus
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.networks import edit
from support.renumbering import Renumbering, renumberings
from support.replay import contents
from support.urdfs import joint, limit, link, robot
from test_unions import WAYS

from urdfsync.api import load
from urdfsync.engine.actions import Reason
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Exit, Result
from urdfsync.urdf.options import LeftOut

CONFIGURATION = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\napproach = ["package", "record"]\n'
LINK, JOINT = "modelica/Arm/Links/Link_{}.mo", "modelica/Arm/Joints/Joint_{}Parameters.mo"
MINE = "\n  Real mine = 1;\n\nequation"


def arm(*masses: float, first: int = 1, order: str = "") -> str:
    """An arm of numbered parts; `order` has other numbers for the parts."""
    numbers = list(order) or [str(number) for number in range(first, first + len(masses))]
    elements, parent = [link("base", 9.0)], "base"
    for number, mass in zip(numbers, masses, strict=True):
        elements.append(link(f"link_{number}", mass))
        origin = f"{mass / 10} 0 0.1"
        limits = [limit(effort=10.0)]
        elements.append(joint(f"joint_{number}", "revolute", parent, f"link_{number}", xyz=origin, inside=limits))
        parent = f"link_{number}"
    return robot(*elements)


@pytest.fixture
def edited(folder: Path, execute: Execute) -> Path:
    """A folder with a built arm; the user adds a component to the second link, and changes a number of its joint."""
    Path("urdfsync.toml").write_text(CONFIGURATION)
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3))
    execute("build")
    edit(LINK.format(2), "\nequation", MINE)
    edit(JOINT.format(2), "effort = 10", "effort = 12")
    return folder


@pytest.fixture
def repository(folder: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Repository:
    """A repository with a built arm, which is not committed yet."""
    Path("urdfsync.toml").write_text(CONFIGURATION)
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3))
    repository = Repository(folder, monkeypatch)
    execute("build")
    return repository


EXPORTS = {
    "exchanged": (arm(1.1, 2.2, 3.3, order="132"), 3),
    "inserted": (arm(1.1, 5.5, 2.2, 3.3), 3),
    "inserted at the root": (arm(5.5, 1.1, 2.2, 3.3), 3),
    "removed": (arm(2.2, 3.3), 1),
    "shifted": (arm(1.1, 2.2, 3.3, first=2), 3),
    "rotated": (arm(1.1, 2.2, 3.3, order="231"), 3),
}


@pytest.mark.parametrize(("export", "number"), EXPORTS.values(), ids=EXPORTS)
def test_edits_go_with_their_parts(edited: Path, execute: Execute, export: str, number: int) -> None:
    Path("arm.urdf").write_text(export)
    told = execute("diff", code=Exit.OUT_OF_STEP).lines
    assert f"link_2: is now link_{number}" in told[1] + told[2]
    execute("build")
    assert "Real mine = 1" in Path(LINK.format(number)).read_text()
    assert "effort = 12" in Path(JOINT.format(number)).read_text()
    texts = [path.read_text() for path in Path("modelica").rglob("*.mo")]
    assert sum("Real mine = 1" in text or "effort = 12" in text for text in texts) == 2
    assert execute("build", "--check").words.endswith("2 kept because you edited them")


def test_many_names_are_told_in_one_line(edited: Path, execute: Execute) -> None:
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3, first=1))
    execute("build")
    Path("arm.urdf").write_text(arm(5.5, 1.1, 2.2, 3.3, 4.4, 6.6))
    Path("arm.urdf").write_text(arm(5.5, 1.1, 2.2, 3.3))
    assert "link link_1: is now link_2" in execute("diff", code=Exit.OUT_OF_STEP).out
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3, 4.4, 6.6))
    execute("build")
    Path("arm.urdf").write_text(arm(5.5, 1.1, 2.2, 3.3, 4.4, 6.6))
    printed = execute("diff", code=Exit.OUT_OF_STEP)
    assert printed.lines[1] == "  link link_1: is now link_2 (and 4 more numbers shifted by one)"
    (found,) = execute("diff", "--format=json", code=Exit.OUT_OF_STEP).json["results"]
    first = found["result"]["changes"]["changes"][0]
    assert (first["path"], first["kind"], first["new"]) == (["link link_1"], "renamed", "link_2")


def test_names_in_the_files_of_the_whole_robot_follow(edited: Path, execute: Execute) -> None:
    Path("urdfsync.toml").write_text(f'{CONFIGURATION}on_conflict = "merge"\n')
    run = Path("modelica/Arm/ArmRun.mo")
    edit(run, "\nequation\n", "\n  Real seen = robot.joint_2Axis.phi + robot.joint_1Axis.phi;\n\nequation\n")
    Path("arm.urdf").write_text(arm(1.1, 5.5, 2.2, 3.3))
    execute("build")
    assert "Real seen = robot.joint_3Axis.phi + robot.joint_1Axis.phi;" in run.read_text()


@pytest.mark.parametrize(("answer", "name"), [("--merge", "link_2"), ("--keep", "link_1")])
@pytest.mark.parametrize("is_open", [False, True])
def test_an_edit_in_a_text_that_the_exchange_leaves_as_it_was_is_settled_once(
    folder: Path, execute: Execute, answer: str, name: str, is_open: bool
) -> None:
    """Two different legs: the robot's model does not show an exchange of their names."""

    def export(*names: str, mass: float = 9.0) -> None:
        parts = zip(names, (1.1, 2.2), strict=True)
        elements = [
            (link(name, weight), joint(f"to_{name}", "continuous", "base", name, xyz=f"{weight} 0 0"))
            for name, weight in parts
        ]
        Path("arm.urdf").write_text(robot(link("base", mass), *itertools.chain.from_iterable(elements)))

    def value() -> str:
        return str(re.findall(r"Real mine = (\w+)\.m;", Path("modelica/Arm/Arm.mo").read_text())[0])

    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    export("link_1", "link_2")
    execute("build")
    edit("modelica/Arm/Arm.mo", "\nequation\n", "\n  Real mine = link_1.m;\n\nequation\n")
    if is_open:
        edit("modelica/Arm/Links/BaseParameters.mo", "9", "8")
    export("link_2", "link_1", mass=7.0 if is_open else 9.0)
    execute("build", code=Exit.CONFLICT)
    execute("resolve", "modelica/Arm/Arm.mo", answer, code=None)
    assert value() == name
    if is_open:
        execute("build", code=Exit.CONFLICT)
        assert value() == name
        execute("resolve", "--all", "--take")
    assert value() == name
    execute("build", "--check")


def test_models_and_configuration_that_use_another_part_are_told_until_they_are_saved(
    edited: Path, execute: Execute
) -> None:
    mine, lines = Path("Mine.mo"), "  Arm.Arm robot;\n  Real x = robot.link_2.body.m;\n  Arm.Links.Link_1 other;\n"
    mine.write_text(f"model Mine\n{lines}end Mine;\n")
    Path("urdfsync.toml").write_text(f"{CONFIGURATION}start = {{joint_2 = 0.1}}\n")
    execute("build")
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3, order="132"))
    told = (
        "Mine.mo:3: warning: `link_2` names another part now; the former part is called `link_3`",
        "urdfsync.toml:5: warning: `joint_2` names another part now",
    )
    for command in ("build", "build", "status"):
        words = execute(command, "--verbose").words
        assert all(text in words for text in told)
        assert "`Link_1`" not in words
    execute("build", "--check")
    for file in (mine, Path("urdfsync.toml")):
        file.write_text(f"{file.read_text()}\n")
    assert "other-part" not in execute("status", "--verbose").words


def unclear(execute: Execute) -> None:
    """An export after which `link_1` may be another part: `link_2` has its mass, `link_3` has its shape."""

    def solid(name: str, mass: float, size: float) -> str:
        box = f'<visual><geometry><box size="{size} {size} {size}"/></geometry></visual>'
        return link(name, mass).replace("</link>", f"{box}</link>")

    def export(*parts: tuple[float, float]) -> None:
        names = [f"link_{number}" for number in range(1, len(parts) + 1)]
        joints = [
            joint(f"to_{name}", "continuous", parent, name, xyz="0 0 0", rpy="0 0 0")
            for parent, name in itertools.pairwise(["base", *names])
        ]
        solids = [solid(name, *part) for name, part in zip(names, parts, strict=True)]
        Path("arm.urdf").write_text(robot(link("base", 9.0), *solids, *joints))

    export((1.1, 0.1), (2.2, 0.2), (3.3, 0.3))
    execute("build")
    edit(LINK.format(1), "\nequation", MINE)
    execute("build")
    export((1.5, 0.15), (1.1, 0.25), (5.5, 0.1))


@pytest.mark.slow
@pytest.mark.parametrize(("answer", "number"), [(["--keep"], 1), (["--moved", "link_3"], 3), (["--take"], 0)])
def test_what_cannot_be_known_is_asked(folder: Path, execute: Execute, answer: list[str], number: int) -> None:
    Path("urdfsync.toml").write_text(CONFIGURATION)
    unclear(execute)
    printed = execute("diff", code=Exit.OUT_OF_STEP).words
    assert "`link_1` may be another part now" in printed
    assert 'link_1 = "link_2"' in printed
    for _ in range(2):
        words = execute("build", code=Exit.CONFLICT).words
        assert "`link_1` may be another part now" in words
        assert "--moved link_2 your edit belongs to the part of this name --keep it is the same part" in words
    assert "Real mine" in Path(LINK.format(1)).read_text()
    execute("resolve", LINK.format(1), *answer)
    holders = [path.as_posix() for path in Path("modelica").rglob("*.mo") if "Real mine" in path.read_text()]
    assert holders == ([LINK.format(number)] if number else [])
    execute("build", "--check")
    for path in {LINK.format(1), LINK.format(number or 1)}:
        execute("resolve", path, "--undo")
    assert [str(path) for path in Path("modelica").rglob("*.mo") if "Real mine" in path.read_text()] == [LINK.format(1)]
    execute("build", "--check")


def test_nothing_is_asked_if_nobody_edited(folder: Path, execute: Execute) -> None:
    """But a finding names a model of the user's that uses the part."""
    Path("urdfsync.toml").write_text(CONFIGURATION)
    unclear(execute)
    Path("Mine.mo").write_text("model Mine\n  Arm.Arm robot;\n  Real x = robot.link_1.body.m;\nend Mine;\n")
    edit(LINK.format(1), MINE, "\nequation")
    words = execute("build").words
    assert "Mine.mo:3: warning: `link_1` may name another part now" in words
    assert words.count("another part") == 1
    execute("build", "--check")


def test_an_edit_of_a_common_file_that_names_what_may_be_another_part_is_asked_about(
    folder: Path, execute: Execute
) -> None:
    Path("urdfsync.toml").write_text(CONFIGURATION)
    unclear(execute)
    edit(LINK.format(1), MINE, "\nequation")
    edit("modelica/Arm/Arm.mo", "\nequation", "\n  Real mine = link_1.m;\n\nequation")
    assert "It uses `link_1`, which may be another part now" in execute("build", code=Exit.CONFLICT).words
    words = execute("resolve", "modelica/Arm/Arm.mo", "--moved", "link_2", code=Exit.ERROR).words
    assert "this file belongs to no single part" in words
    execute("resolve", "modelica/Arm/Arm.mo", "--keep")
    execute("build", "--check")


@NEEDS_GIT
def test_a_clone_asks_nothing_about_words_in_a_remark(repository: Repository, execute: Execute) -> None:
    """The user made the edit before the export; this machine knows that, and a clone finds out from the commits."""
    edit("modelica/Arm/Links/package.mo", "\n  annotation", '\n  constant Real mine = 1 "Of link_2";\n\n  annotation')
    repository.commit()
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3, order="213"))
    execute("build")
    repository.commit()
    repository.git("clone", "-q", ".", "clone")
    execute("build", "--config", "clone/urdfsync.toml")


@NEEDS_GIT
def test_a_clone_asks_what_the_original_asks(repository: Repository, execute: Execute) -> None:
    """And a second build asks the same in the same words; the answer counts in each clone."""
    unclear(execute)
    first, second = (execute("build", code=Exit.CONFLICT).out for _ in range(2))
    assert first.partition("conflict  ")[2] == second.partition("conflict  ")[2] != ""
    repository.commit()
    repository.git("clone", "-q", ".", "clone")
    recorded = contents(Path(".urdfsync/robots"))
    words = execute("build", "--config", "clone/urdfsync.toml", code=Exit.CONFLICT).words
    assert "`link_1` may be another part now" in words
    assert contents(Path("clone/.urdfsync/robots")) == recorded
    execute("resolve", LINK.format(1), "--keep")
    repository.commit()
    shutil.rmtree("clone")
    repository.git("clone", "-q", ".", "clone")
    execute("build", "--check", "--config", "clone/urdfsync.toml")


def test_the_same_part_gets_what_is_new(folder: Path, execute: Execute) -> None:
    record = LINK.format(1).replace(".mo", "Parameters.mo")
    Path("urdfsync.toml").write_text(CONFIGURATION)
    unclear(execute)
    edit(record, "end Link_1Parameters;", "  // mine\nend Link_1Parameters;")
    execute("resolve", LINK.format(1), record, "--keep", code=Exit.CONFLICT)
    execute("resolve", record, "--merge")
    assert "1.5" in Path(record).read_text()
    execute("build", "--check")


def test_an_edit_moves_into_a_file_that_is_edited_too(folder: Path, execute: Execute) -> None:
    Path("urdfsync.toml").write_text(CONFIGURATION)
    unclear(execute)
    edit(LINK.format(3), "\nequation", "\n  Real another = 2;\n\nequation")
    execute("build", code=Exit.CONFLICT)
    execute("resolve", LINK.format(1), "--moved", "link_3", code=None)
    text = Path(LINK.format(3)).read_text()
    assert "Real mine = 1;" in text
    assert "Real another = 2;" in text
    assert "Real mine" not in Path(LINK.format(1)).read_text()


def test_an_edit_that_contradicts_the_one_there_does_not_move(folder: Path, execute: Execute) -> None:
    Path("urdfsync.toml").write_text(CONFIGURATION)
    unclear(execute)
    edit(LINK.format(3), "\nequation", MINE.replace("1", "2"))
    execute("build", code=Exit.CONFLICT)
    words = execute("resolve", LINK.format(1), "--moved", "link_3", code=Exit.ERROR).words
    assert "your edit contradicts this file; move the edit by hand, then use --take" in words
    assert "Real mine = 2;" in Path(LINK.format(3)).read_text()


@pytest.mark.parametrize(("name", "message"), [
    ("lnk_2", "the source has no link `lnk_2`; did you mean `link_2`? [wrong-rename]"),
    ("link_1", "this file belongs to link `link_1` already; name the part that the edit belongs to: --moved NAME"),
])  # fmt: skip
def test_an_answer_names_another_part_that_exists(folder: Path, execute: Execute, name: str, message: str) -> None:
    Path("urdfsync.toml").write_text(CONFIGURATION)
    unclear(execute)
    words = execute("resolve", LINK.format(1), "--moved", name, code=Exit.ERROR).words
    assert f"{LINK.format(1)}: error: {message}" in words
    assert "Real mine" in Path(LINK.format(1)).read_text()


def test_an_edit_of_a_part_that_is_gone_is_asked_about(edited: Path, execute: Execute) -> None:
    """The second part is removed, and the third one takes its name."""
    Path("arm.urdf").write_text(arm(1.1, 3.3))
    words = execute("build", code=Exit.CONFLICT).words
    assert "`link_2` is another part now, the former `link_3`" in words
    execute("resolve", "--all", "--take")
    assert "mine" not in Path(LINK.format(2)).read_text()


@pytest.mark.slow
def test_edits_change_places_once_while_a_number_conflicts(edited: Path, execute: Execute) -> None:
    """Conflicts about numbers delay only exchanged names."""
    record = LINK.format(1).replace(".mo", "Parameters.mo")
    edit(record, "1.1", "1.5")
    Path("arm.urdf").write_text(arm(1.2, 2.2, 3.3, order="132"))
    for _ in range(3):
        execute("build", code=Exit.CONFLICT)
        assert "Real mine" in Path(LINK.format(2)).read_text()
    execute("resolve", record, "--take")
    assert "Real mine" in Path(LINK.format(3)).read_text()
    execute("build", "--check")


def test_a_part_that_one_export_forgot_is_the_same_part(folder: Path, execute: Execute) -> None:
    """If it comes back with all its numbers; with others, the user is asked."""
    Path("urdfsync.toml").write_text(CONFIGURATION)
    Path("arm.urdf").write_text(arm(1.1, 2.2))
    execute("build")
    edit(LINK.format(2), "\nequation", MINE)
    edit(JOINT.format(2), "effort = 10", "effort = 12")
    edited = contents(Path("modelica"))
    for mass, code in ((2.2, Exit.IN_STEP), (2.5, Exit.CONFLICT)):
        Path("arm.urdf").write_text(arm(1.1))
        execute("build")
        Path("arm.urdf").write_text(arm(1.1, mass))
        printed = execute("build", code=code)
        assert ("is another part now" in printed.words) == (code is Exit.CONFLICT)
        assert (contents(Path("modelica")) == edited) == (code is Exit.IN_STEP)


def test_a_new_part_does_not_inherit_the_edit_of_one_that_is_gone(folder: Path, execute: Execute) -> None:
    Path("urdfsync.toml").write_text(CONFIGURATION)
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3))
    execute("build")
    edit(LINK.format(3), "\nequation", MINE)
    Path("arm.urdf").write_text(arm(1.1, 2.2))
    execute("build")
    Path("arm.urdf").write_text(arm(1.1, 2.2, 7.7))
    assert "`link_3` is another part now" in execute("build", code=Exit.CONFLICT).words
    execute("resolve", LINK.format(3), "--take")
    assert "Real mine" not in Path(LINK.format(3)).read_text()


def test_an_edit_that_cannot_move_is_asked_about(folder: Path, execute: Execute) -> None:
    """The edit of a removed part blocks the rename."""
    Path("urdfsync.toml").write_text(CONFIGURATION)
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3))
    execute("build")
    edit(LINK.format(2), "\nequation", MINE)
    edit(LINK.format(3), "\nequation", "\n  Real former = 3;\n\nequation")
    Path("arm.urdf").write_text(arm(1.1, 2.2))
    execute("build")
    Path("arm.urdf").write_text(arm(1.1, 9.9, 2.2))
    words = execute("build", code=Exit.CONFLICT).words
    assert "`link_2` is another part now" in words
    assert "`link_3` is another part now" in words
    execute("resolve", LINK.format(2), "--moved", code=Exit.ERROR)
    execute("resolve", LINK.format(3), "--take", code=None)
    execute("resolve", LINK.format(2), "--moved", code=None)
    assert "Real mine" in Path(LINK.format(3)).read_text()


def test_a_moved_edit_is_given_back_although_another_edit_waits_to_move_to_its_place(
    folder: Path, execute: Execute
) -> None:
    Path("urdfsync.toml").write_text(CONFIGURATION)
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3))
    execute("build")
    edit("modelica/Arm/Links/Link_1Parameters.mo", "mass = 1.1", "mass = 1.2")
    for number in (1, 2):
        edit(LINK.format(number), "\nequation", f"\n  Real mine{number} = 1;\n\nequation")
    Path("arm.urdf").write_text(arm(2.2, 9.9, 3.3))
    assert "`link_1` is another part now, the former `link_2`" in execute("build", code=Exit.CONFLICT).words
    mine = Path(LINK.format(1)).read_text()
    execute("resolve", LINK.format(1), "--moved", "link_3", code=Exit.CONFLICT)
    assert f"{LINK.format(1)} its path is new; your edits move here" in execute("status", code=Exit.CONFLICT).words
    assert "Real mine1" in Path(LINK.format(3)).read_text()
    words = execute("resolve", LINK.format(2), "--undo", code=Exit.CONFLICT).words
    assert f"{LINK.format(2)}: error: nothing to undo" in words
    execute("resolve", LINK.format(1), "--undo", code=Exit.CONFLICT)
    assert Path(LINK.format(1)).read_text() == mine
    assert "Real mine2" in Path(LINK.format(2)).read_text()


def test_a_class_made_a_folder_is_asked_about(edited: Path, execute: Execute) -> None:
    file = Path(LINK.format(2))
    file.with_suffix("").mkdir()
    file.rename(file.with_suffix("") / "package.mo")
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3, order="132"))
    assert "`link_2` is another part now" in execute("build", code=Exit.CONFLICT).words
    words = execute("resolve", LINK.format(2), "--moved", "link_3", code=Exit.ERROR).words
    assert "one of the two classes is a folder; move the edit by hand, then use --keep" in words


def test_a_model_that_extends_the_robot_uses_names_alone(edited: Path, execute: Execute) -> None:
    Path("Mine.mo").write_text("model Mine\n  extends Arm.Arm;\nequation\n  x = joint_2Axis.phi;\nend Mine;\n")
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3, order="132"))
    assert "Mine.mo:4: warning: `joint_2Axis` names another part now" in execute("build").words


@pytest.mark.slow
@NEEDS_GIT
def test_edits_that_git_left_with_exchanged_names_change_places_together(
    repository: Repository, execute: Execute
) -> None:
    repository.commit()
    repository.git("checkout", "-q", "-b", "export")
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3, order="132"))
    execute("build")
    repository.commit()
    repository.git("checkout", "-q", "main")
    for number in (2, 3):
        edit(LINK.format(number), "\nequation", MINE.replace("1", str(number)))
    repository.commit()
    repository.merge("export")
    execute("build", code=Exit.CONFLICT)
    words = execute("resolve", LINK.format(2), "--moved", "link_3", code=Exit.ERROR).words
    assert "your edit in this file may belong to another part, too" in words
    execute("resolve", LINK.format(2), LINK.format(3), "--moved")
    for number, other in ((2, 3), (3, 2)):
        assert f"Real mine = {other};" in Path(LINK.format(number)).read_text()
        assert f"Real mine = {number};" not in Path(LINK.format(number)).read_text()
    execute("build", "--check")
    for number in (2, 3):
        execute("resolve", LINK.format(number), "--undo", code=None)
    for number in (2, 3):
        assert f"Real mine = {number};" in Path(LINK.format(number)).read_text()
    execute("build", "--check")


@NEEDS_GIT
def test_ordinary_edits_after_an_exchange_are_not_asked_about(repository: Repository, execute: Execute) -> None:
    """An earlier commit has another edit in this place, which belonged to another part."""
    for effort, order in (("12", ""), ("", "132"), ("15", "132")):
        if effort:
            edit(JOINT.format(2), "effort = 10", f"effort = {effort}")
        Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3, order=order))
        execute("build")
        repository.commit()
    execute("build", "--check")
    assert "effort = 12" in Path(JOINT.format(3)).read_text()


def test_exchanges_can_be_declared_and_count_once(folder: Path, execute: Execute) -> None:
    """Two equal wheels; both have other masses after the export."""

    def export(*masses: float) -> None:
        wheels = [link(f"link_{number}", mass) for number, mass in enumerate(masses, 1)]
        hubs = [joint(f"hub_{number}", "continuous", "base", f"link_{number}") for number in (1, 2)]
        Path("arm.urdf").write_text(robot(link("base", 9.0), *wheels, *hubs))

    Path("urdfsync.toml").write_text(CONFIGURATION)
    export(1.1, 1.1)
    execute("build")
    edit(LINK.format(1), "\nequation", MINE)
    export(1.5, 1.7)
    Path("urdfsync.toml").write_text(f'{CONFIGURATION}renamed = {{link_1 = "link_2", link_2 = "link_1"}}\n')
    for mass in (1.5, 1.5, 1.9):
        export(mass, 1.7)
        execute("build")
        assert "Real mine" in Path(LINK.format(2)).read_text()
        assert "mine" not in Path(LINK.format(1)).read_text()
    assert "rename-done" in execute("status", "--verbose").words
    Path("urdfsync.toml").write_text(CONFIGURATION)
    execute("build")
    assert "Real mine" in Path(LINK.format(2)).read_text()


@pytest.mark.parametrize("declared", ["", 'renamed = {link_3 = "link_2"}\n'], ids=["found", "declared"])
def test_a_renamed_part_and_the_one_that_is_gone_keep_their_own_edits(
    edited: Path, execute: Execute, declared: str
) -> None:
    """Both parts are edited; the third part takes the name of the second, which is removed."""
    edit(LINK.format(3), "\nequation", MINE.replace("mine", "third"))
    Path("urdfsync.toml").write_text(f"{CONFIGURATION}{declared}")
    Path("arm.urdf").write_text(arm(1.1, 3.3))
    words = execute("build", code=Exit.CONFLICT).words
    assert "`link_2` is another part now, the former `link_3`" in words
    execute("resolve", "--all", "--take")
    text = Path(LINK.format(2)).read_text()
    assert "Real third" in text
    assert "mine" not in text
    execute("build", "--check")


CHANGES = {
    "another mass": ('mass value="3.3"', 'mass value="3.5"', LINK),
    "another position": (f'xyz="{3.3 / 10} ', 'xyz="0.5 ', JOINT),
}


@pytest.mark.parametrize("more", [(), (4.4,)], ids=["three parts", "four parts"])
@pytest.mark.parametrize(("old", "new", "file"), CHANGES.values(), ids=CHANGES)
def test_a_part_is_gone_and_the_next_one_has_its_name_and_other_numbers(
    folder: Path, execute: Execute, old: str, new: str, file: str, more: tuple[float, ...]
) -> None:
    Path("urdfsync.toml").write_text(CONFIGURATION)
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3, *more))
    execute("build")
    edit(LINK.format(2), "\nequation", MINE)
    edit(JOINT.format(2), "effort = 10", "effort = 12")
    export = arm(1.1, 3.3, *more)
    assert old in export
    Path("arm.urdf").write_text(export.replace(old, new))
    words = execute("build", code=Exit.CONFLICT).words
    name = Path(file.format(2)).stem.removesuffix("Parameters").lower()
    assert f"`{name}` may be another part now: parts next to it, or like it, have other names" in words


def test_half_an_exchange_is_declared(folder: Path, execute: Execute) -> None:
    """The second part has taken the name of the third one: the build asks about the edit of the third part."""
    Path("urdfsync.toml").write_text(CONFIGURATION)
    Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3))
    execute("build")
    edit(LINK.format(3), "\nequation", MINE)
    Path("urdfsync.toml").write_text(f'{CONFIGURATION}renamed = {{link_2 = "link_3"}}\n')
    Path("arm.urdf").write_text(arm(1.1, 2.5, 3.5))
    words = execute("build", code=Exit.CONFLICT).words
    assert "`link_3` is another part now, the former `link_2`" in words
    Path("urdfsync.toml").write_text(f'{CONFIGURATION}renamed = {{link_2 = "link_3", link_3 = "link_2"}}\n')
    execute("build")
    assert ["Real mine" in Path(LINK.format(number)).read_text() for number in (2, 3)] == [True, False]


def legs(*masses: float) -> str:
    """Legs with a common base."""
    elements = [link("base", 9.0)]
    for number, mass in enumerate(masses, 1):
        elements += [link(f"link_{number}", mass), joint(f"to_{number}", "continuous", "base", f"link_{number}")]
    return robot(*elements)


EXCHANGE = {"link_1": "link_2", "link_2": "link_1"}
TWINS: dict[str, tuple[dict[str, str], list[float], int]] = {
    "the same export": (EXCHANGE, [1.1, 1.1, 1.1], 1),
    "another mass": (EXCHANGE, [1.1, 1.1, 4.4], 1),
    "one leg more": ({f"link_{number}": f"link_{number + 1}" for number in (1, 2, 3)}, [1.1] * 4, 3),
}


@pytest.mark.parametrize(("renames", "masses", "number"), TWINS.values(), ids=TWINS)
def test_what_is_declared_of_parts_that_look_alike_counts_once(
    folder: Path, execute: Execute, renames: dict[str, str], masses: list[float], number: int
) -> None:
    Path("urdfsync.toml").write_text(CONFIGURATION)
    Path("arm.urdf").write_text(legs(1.1, 1.1, 1.1))
    execute("build")
    edit(LINK.format(2), "\nequation", MINE)
    words = ", ".join(f'{old} = "{new}"' for old, new in renames.items())
    Path("urdfsync.toml").write_text(f"{CONFIGURATION}renamed = {{{words}}}\n")
    for last in (masses[-1], masses[-1], 5.5):
        Path("arm.urdf").write_text(legs(*masses[:-1], last))
        execute("build")
        holders = [path.name for path in Path("modelica").rglob("*.mo") if "Real mine" in path.read_text()]
        assert holders == [f"Link_{number}.mo"]
    shutil.rmtree(".urdfsync/notes")  # another machine has the record, and no notes
    Path("arm.urdf").write_text(legs(*masses[:-1], 6.6))
    execute("build")
    assert "Real mine" in Path(LINK.format(number)).read_text()


def test_names_declared_before_the_first_build_move_nothing(folder: Path, execute: Execute) -> None:
    legs = [link("base", 9.0), *(link(name, 1.1) for name in ("link_1", "link_2"))]
    joints = [joint(f"to_{name}", "continuous", "base", name) for name in ("link_1", "link_2")]
    Path("arm.urdf").write_text(robot(*legs, *joints))
    Path("urdfsync.toml").write_text(f'{CONFIGURATION}renamed = {{link_1 = "link_2", link_2 = "link_1"}}\n')
    execute("build")
    edit(LINK.format(1), "\nequation", MINE)
    for _ in range(2):
        execute("build")
        assert "Real mine" in Path(LINK.format(1)).read_text()


def test_a_recorded_model_that_the_files_contradict_moves_nothing(edited: Path, execute: Execute) -> None:
    """A stranger exchanged two links in the record: the edit stays, and the build asks about it."""
    state = Path(".urdfsync/robots/arm.state")
    text = state.read_text()
    elements = dict(re.findall(r'^model \["links","(link_[23])",(.*)\]$', text, re.MULTILINE))
    for name, other in (("link_2", "link_3"), ("link_3", "link_2")):
        text = text.replace(
            f'model ["links","{name}",{elements[name]}]', f'model ["links","{name}",{elements[other]}] '
        )
    state.write_text(text)
    assert "may be another part now" in execute("build", code=Exit.CONFLICT).words
    assert "Real mine" in Path(LINK.format(2)).read_text()


@pytest.mark.parametrize("lost", ["links", "joints"])
@pytest.mark.parametrize("export", EXPORTS)
def test_a_recorded_model_that_lacks_parts_loses_no_edit(
    edited: Path, execute: Execute, lost: str, export: str
) -> None:
    """A possible result of git: one branch removed parts, the other changed the files that name these parts."""
    state = Path(".urdfsync/robots/arm.state")
    text = state.read_text()
    for number in "123":
        kept = re.sub(rf'^model \["{lost}","\w+_{number}",.*\n', "", text, flags=re.MULTILINE)
        assert kept != text
        state.write_text(kept)
        Path("arm.urdf").write_text(EXPORTS[export][0])
        code = execute("build", code=None).code
        assert code in (Exit.IN_STEP, Exit.CONFLICT)
        assert sum("Real mine" in path.read_text() for path in Path("modelica/Arm").rglob("*.mo")) == 1


@NEEDS_GIT
@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize(
    ("edits_first", "driver"),
    [(False, True), (True, False), *(pytest.param(both, both, marks=pytest.mark.large) for both in (False, True))],
)
def test_one_branch_exchanges_names_and_the_other_edits(
    repository: Repository, execute: Execute, way: str, edits_first: bool, driver: bool
) -> None:
    """From either side of git's merge, an edit follows its part, or the build asks about it."""
    if driver:
        execute("merge-driver", "--install")
    repository.commit()
    model, joint_file = "modelica/Arm/Arm.mo", "modelica/Arm/Joints/Joint_{}.mo"
    for branch in ("theirs", "ours"):
        repository.git("checkout", "-q", "-b", branch, "main")
        if (branch == "ours") is edits_first:
            edit(LINK.format(2), "\nequation", MINE)
            edit(joint_file.format(2), "\nequation", MINE)
            edit(model, "\nequation", "\n  Real mine = link_2.m;\n\nequation")
        else:
            Path("arm.urdf").write_text(arm(1.1, 2.2, 3.3, order="132"))
        execute("build")
        repository.commit(branch)
    for command in WAYS[way]:
        repository.git(*command.split())
    Path("theirs.patch").unlink(missing_ok=True)
    if way in ("squash", "patch"):
        repository.git("branch", "-q", "-D", "theirs")
    words = execute("build", code=None).words
    if "It uses `link_2`, which is another part now" in words:
        edit(model, "link_2.m;", "link_3.m;")
        execute("resolve", model, "--keep", code=None)
    for file in (LINK.format(2), joint_file.format(2)):
        if "Real mine" in Path(file).read_text():
            assert "another part" in words
            execute(
                "resolve",
                file,
                "--moved",
                Path(LINK.format(3) if "Link" in file else "joint_3").stem.lower(),
                code=None,
            )
    texts = {path.as_posix(): path.read_text() for path in Path("modelica").rglob("*.mo")}
    holders = sorted(path for path, text in texts.items() if "Real mine" in text)
    assert holders == sorted([model, LINK.format(3), joint_file.format(3)])
    assert "Real mine = link_3.m;" in texts[model]
    execute("build", "--check")


def hand(path: Path, kind: str) -> str:
    """Edit a file by hand; return the text by which tests find the edit, or nothing if the file has no place."""
    text = path.read_text()
    if kind == "number":
        begin = text.index("extends")
        found = re.search(r'(?<![\w."])\d+(?:\.\d+)?(?:e-?\d+)?(?=[,)}\s])', text[begin:])
        if not found:
            return ""
        path.write_text(f"{text[: begin + found.start()]}7171.25{text[begin + found.end() :]}")
        return "7171.25"
    if "\nequation\n" not in text:
        return ""
    new = "\n  Real byHand = 3;\n\nequation\n" if kind == "component" else '\nequation\n  assert(true, "byHand");\n'
    path.write_text(text.replace("\nequation\n", new, 1))
    return "byHand"


def plan() -> Result:
    (result,) = build(configuration := load("urdfsync.toml"), configuration.robots, BuildOptions())
    return result


def meetings(source: bytes, random: Random) -> Iterator[tuple[Renumbering, str, str]]:
    """Each kind of export meets each kind of edit of one element: the fate of the edit."""
    Path("r.urdf").write_bytes(source)
    built = plan()
    assert not built.failed, built.diagnostics
    shutil.copytree("modelica", "../built", dirs_exist_ok=True)
    shutil.copytree(".urdfsync", "../state", dirs_exist_ok=True)
    owners = sorted({action.owner for action in built.actions if action.owner.startswith(("link ", "joint "))})
    for exported, kind in itertools.product(renumberings(source, random), ("number", "component", "equation")):
        for name, saved in (("modelica", "../built"), (".urdfsync", "../state")):
            shutil.rmtree(name)
            shutil.copytree(saved, name)
        owner = random.choice(owners)
        files = [action.path for action in built.actions if action.owner == owner and action.path.endswith(".mo")]
        path = next((path for path in files if path.endswith("Parameters.mo") is (kind == "number")), None)
        if path is None or not (mark := hand(Path(path), kind)):
            continue
        Path("r.urdf").write_bytes(exported.source)
        result = plan()
        if any(found.code == "loop-open" for found in result.diagnostics):
            continue  # a part in another place holds the loop open
        assert not result.failed, result.diagnostics
        part, _, name = owner.partition(" ")
        expected = exported.names.get((part, name), name)
        holders = [
            action for action in result.actions if Path(action.path).is_file() and mark in Path(action.path).read_text()
        ]
        if any(action.reason is Reason.ASKED for action in result.actions):
            yield exported, kind, "asked"
        elif any(action.is_conflict for action in result.actions):
            yield exported, kind, "conflict"
        elif [action.owner for action in holders] == [f"{part} {expected}"]:
            yield exported, kind, "followed"
        elif [action.reason for action in holders] == [Reason.ORPHAN]:
            yield exported, kind, "left"
        else:
            yield exported, kind, f"WRONG: {owner} is {expected}, the edit is in {[action.path for action in holders]}"


FILES = [file for file in corpus.robots() if file != corpus.ABSENT and not file.endswith("spot_arm.urdf")]
"""The parent of a joint in this model is a missing link."""
IN_CI = [file for file in FILES if file.endswith("puma560_robot.urdf")]


@pytest.mark.slow
@pytest.mark.parametrize(
    "file",
    [file if file in IN_CI else pytest.param(file, marks=pytest.mark.large) for file in FILES] or [corpus.ABSENT],
)
def test_edits_meet_exports_that_renumber(corpus: Path, folder: Path, file: str) -> None:
    """No edit moves to another part, and the build asks about few edits."""
    source = (corpus / file).read_bytes()
    if source.count(b"<link ") < 5:
        pytest.skip("fewer than five links")
    names = ", ".join(f'"{name}"' for name in get_args(LeftOut))
    Path("urdfsync.toml").write_text(f'[robots.r]\nsource = "r.urdf"\npackage = "R"\nallow = [{names}]\n')
    found = Counter[str]()
    for exported, kind, what in meetings(source, Random(file)):
        assert not what.startswith("WRONG"), f"{exported.kind}, {kind}: {what}"
        found[what] += 1
    print(dict(found))  # noqa: T201
    assert found["asked"] <= 3 + found.total() // 10
