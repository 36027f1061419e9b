"""The check of one robot from end to end, with the real compiler and Pinocchio, on a robot with two joints."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from support.corpus import REPOSITORY
from support.urdfs import dynamics, joint, limit, link, robot

from urdfsync import config
from urdfsync.checking.examine import examine
from urdfsync.checking.process import Limits
from urdfsync.checking.verdict import Standing, Verdict, exit_code
from urdfsync.checking.wishes import Wishes
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions

ARM = robot(
    link("base", 3.0),
    link("arm", 2.0, rpy="0.1 0.2 0.3"),
    link("hand", 0.7),
    joint("shoulder", "revolute", "base", "arm", axis="0 1 0", rpy="0.4 0.5 0.6", inside=[limit(), dynamics(0.5, 0.2)]),
    joint("elbow", "continuous", "arm", "hand", axis="0 0 1", inside=[dynamics(0.1, 0.0)]),
)

Check = Callable[..., Verdict]


@pytest.fixture
def arm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project with the robot, built; the package's folder."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.urdf").write_text(ARM)
    (tmp_path / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\ncross_check = false\n')
    rebuild()
    return tmp_path / "modelica" / "Arm"


def rebuild() -> None:
    loaded = config.load(Path("urdfsync.toml").absolute())
    (result,) = build(loaded, loaded.robots, BuildOptions())
    assert not result.failed


def check(physics: bool = False) -> Verdict:
    loaded = config.load(Path("urdfsync.toml").absolute())
    wishes = Wishes(physics=physics, workers=2)
    return examine(loaded, loaded.robots[0], wishes, Limits(), lambda *_: None, lambda _: None)


def replace(file: Path, old: str, new: str) -> None:
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))


def codes(verdict: Verdict) -> list[str]:
    return [one.code for one in verdict.diagnostics if one.severity == "error"]


@pytest.mark.slow
def test_each_edit_is_told_with_what_it_changes(arm: Path, modelica_library: Path) -> None:
    """Edits are results, not failures: what is generated agrees with the reference."""
    replace(arm / "Joints" / "ElbowParameters.mo", "damping = 0.1", "damping = 0.2")
    replace(arm / "Links" / "HandParameters.mo", "mass = 0.7", "mass = 0.9")
    replace(arm / "Links" / "Base.mo", "model Base", "// looked at\nmodel Base")
    verdict = check(physics=True)
    assert codes(verdict) == []
    assert [one.model for one in verdict.compiled] == ["Arm", "ArmRun", "ArmTest"]
    assert verdict.generated is not None
    assert verdict.generated.agrees
    assert (verdict.standing(strict=False), verdict.standing(strict=True)) == (Standing.RIGHT, Standing.DIFFERS)
    elements = {effect.files: {one.element for one in effect.deviations} for effect in verdict.effects}
    assert elements.keys() == {("Joints/ElbowParameters.mo",), ("Links/HandParameters.mo",), ("Links/Base.mo",)}
    assert elements["Joints/ElbowParameters.mo",] == {"joint elbow"}
    assert elements["Links/HandParameters.mo",] >= {"robot", "joint elbow", "joint shoulder"}
    assert elements["Links/Base.mo",] == set()
    assert {effect.owners for effect in verdict.effects} == {("joint elbow",), ("link hand",), ("link base",)}


@pytest.mark.slow
def test_an_edited_robot_that_can_not_be_moved_is_not_right(arm: Path, modelica_library: Path) -> None:
    """It compiles, and an assertion of the user's ends every simulation."""
    replace(arm / "Joints" / "Elbow.mo", "equation\n", 'equation\n  assert(false, "not ready yet");\n')
    verdict = check(physics=True)
    assert codes(verdict) == []
    assert len(verdict.compiled) == 3
    assert verdict.standing(strict=False) is Standing.INCOMPLETE
    (gap,) = verdict.gaps
    assert "not ready yet" in gap
    assert (exit_code([verdict], strict=False), exit_code([verdict], strict=True)) == (0, 1)


@pytest.mark.slow
def test_a_generator_that_is_wrong_is_found_whoever_edited_what(arm: Path, modelica_library: Path) -> None:
    """A template of the user's turns origins in the wrong order: roll, pitch and yaw about axes that turn along."""
    templates = Path("templates")
    shutil.copytree(REPOSITORY / "templates" / "urdf", templates)
    replace(templates / "macros.jinja", "{3, 2, 1}", "{1, 2, 3}")
    with Path("urdfsync.toml").open("a") as file:
        file.write('templates = "templates"\n')
    rebuild()
    verdict = check(physics=True)
    assert verdict.standing(strict=False) is Standing.DIFFERS
    assert verdict.generated is not None
    worst = verdict.generated.worst()
    assert worst is not None
    assert worst.relative > 1e-2


@pytest.mark.slow
def test_a_package_that_is_not_in_step_is_compiled_and_said_to_be_so(arm: Path, modelica_library: Path) -> None:
    replace(Path("arm.urdf"), 'type="continuous"', 'type="fixed"')
    verdict = check()
    assert (verdict.in_step, verdict.standing(strict=False)) == (False, Standing.DIFFERS)
    assert [one.model for one in verdict.compiled] == ["Arm", "ArmRun", "ArmTest"]
    assert all(one.unknowns > 100 for one in verdict.compiled)


def test_without_a_library_nothing_is_compiled(arm: Path) -> None:
    """The configuration names a folder with nothing in it."""
    Path("nothing").mkdir()
    with Path("urdfsync.toml").open("a") as file:
        file.write('[check]\nlibrary = "nothing"\n')
    verdict = check()
    assert codes(verdict) == ["wrong-library-folder"]
    assert any("nothing was compiled" in sentence for sentence in verdict.gaps)


def test_nothing_is_compiled_that_does_not_parse(arm: Path) -> None:
    (arm / "Joints" / "Elbow.mo").write_text("within Arm.Joints;\nmodel Elbow\n  Real x = ;\nend Elbow;\n")
    verdict = check()
    assert verdict.failed
    assert [(one.file, one.line) for one in verdict.diagnostics if one.severity == "error"] == [
        ("modelica/Arm/Joints/Elbow.mo", 3)
    ]
    assert verdict.compiled == ()
    assert any("nothing was compiled" in sentence for sentence in verdict.gaps)


def test_a_source_with_errors_is_told(arm: Path) -> None:
    Path("arm.urdf").write_text(ARM[: len(ARM) // 2])
    verdict = check()
    assert verdict.failed
    assert verdict.diagnostics[0].file == "arm.urdf"


def test_a_robot_that_was_not_built_is_out_of_step(arm: Path) -> None:
    """What would be generated is checked as far as it goes: here there is no library."""
    shutil.rmtree(arm)
    shutil.rmtree(".urdfsync")
    Path("nothing").mkdir()
    with Path("urdfsync.toml").open("a") as file:
        file.write('[check]\nlibrary = "nothing"\n')
    verdict = check()
    assert (verdict.built, verdict.in_step) == (False, False)
    assert codes(verdict) == ["wrong-library-folder"]


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
def test_what_is_no_file_is_told_and_no_more(arm: Path) -> None:
    (arm / "Links" / "Gone.mo").symlink_to("nowhere.mo")
    (arm / "Joints" / "Elbow.mo").write_text("within Arm.Joints;\nmodel Elbow\n  Real x = ;\nend Elbow;\n")
    found = check().diagnostics
    assert [(one.code, one.file) for one in found if one.code == "no-file"] == [
        ("no-file", "modelica/Arm/Links/Gone.mo")
    ]
