"""The check of one robot from end to end, with the real compiler and Pinocchio, on a robot with two joints."""

from __future__ import annotations

import itertools
import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from support.corpus import REPOSITORY
from support.urdfs import dynamics, joint, limit, link, robot

from urdfsync import config
from urdfsync.check.cache import UserCache
from urdfsync.check.collector import Step
from urdfsync.check.compilers.compiler import CompileJob, CompileResult
from urdfsync.check.results import CheckOptions, CheckResult, CheckStatus, exit_code
from urdfsync.check.robot import check_robot
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions

ARM = robot(
    link("base", 3.0),
    link("arm", 2.0, rpy="0.1 0.2 0.3"),
    link("hand", 0.7),
    joint("shoulder", "revolute", "base", "arm", axis="0 1 0", rpy="0.4 0.5 0.6", inside=[limit(), dynamics(0.5, 0.2)]),
    joint("elbow", "continuous", "arm", "hand", axis="0 0 1", inside=[dynamics(0.1, 0.0)]),
)

Check = Callable[..., CheckResult]


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


def check(physics: bool = False, steps: list[Step] | None = None) -> CheckResult:
    loaded = config.load(Path("urdfsync.toml").absolute())
    told = [] if steps is None else steps
    return check_robot(loaded, loaded.robots[0], CheckOptions(physics=physics, compilers=2), told.append)


def replace(file: Path, old: str, new: str) -> None:
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))


def codes(result: CheckResult) -> list[str]:
    return [one.code for one in result.diagnostics if one.severity == "error"]


@pytest.mark.slow
def test_each_edit_is_told_with_what_it_changes(arm: Path, modelica_library: Path) -> None:
    """Edits are results, not failures: what is generated agrees with the reference."""
    replace(arm / "Joints" / "ElbowParameters.mo", "damping = 0.1", "damping = 0.2")
    replace(arm / "Links" / "HandParameters.mo", "mass = 0.7", "mass = 0.9")
    replace(arm / "Links" / "Base.mo", "model Base", "// looked at\nmodel Base")
    result = check(physics=True)
    assert codes(result) == []
    assert [one.model for one in result.compiled] == ["Arm", "ArmRun", "ArmTest"]
    assert result.deviations
    assert not result.differs
    assert (result.status(strict=False), result.status(strict=True)) == (CheckStatus.RIGHT, CheckStatus.DIFFERS)
    elements = {effect.files: {one.element for one in effect.deviations} for effect in result.effects}
    assert elements.keys() == {("Joints/ElbowParameters.mo",), ("Links/HandParameters.mo",), ("Links/Base.mo",)}
    assert elements["Joints/ElbowParameters.mo",] == {"joint elbow"}
    assert elements["Links/HandParameters.mo",] >= {"robot", "joint elbow", "joint shoulder"}
    assert elements["Links/Base.mo",] == set()
    assert {effect.owners for effect in result.effects} == {("joint elbow",), ("link hand",), ("link base",)}


@pytest.mark.slow
def test_an_edited_robot_that_can_not_be_moved_is_not_right(arm: Path, modelica_library: Path) -> None:
    """It compiles, and an assertion of the user's ends every simulation."""
    replace(arm / "Joints" / "Elbow.mo", "equation\n", 'equation\n  assert(false, "not ready yet");\n')
    result = check(physics=True)
    assert codes(result) == []
    assert len(result.compiled) == 3
    assert result.status(strict=False) is CheckStatus.INCOMPLETE
    (gap,) = result.gaps
    assert "not ready yet" in gap
    assert (exit_code([result], strict=False), exit_code([result], strict=True)) == (0, 1)


@pytest.mark.slow
def test_a_generator_that_is_wrong_is_found_whoever_edited_what(arm: Path, modelica_library: Path) -> None:
    """A template of the user's turns origins in the wrong order: roll, pitch and yaw about axes that turn along."""
    templates = Path("templates")
    shutil.copytree(REPOSITORY / "templates" / "urdf", templates)
    replace(templates / "macros.jinja", "{3, 2, 1}", "{1, 2, 3}")
    with Path("urdfsync.toml").open("a") as file:
        file.write('templates = "templates"\n')
    rebuild()
    result = check(physics=True)
    assert result.status(strict=False) is CheckStatus.DIFFERS
    assert max(one.relative for one in result.deviations or ()) > 1e-2


@pytest.mark.slow
def test_a_package_that_is_not_in_step_is_compiled_and_said_to_be_so(arm: Path, modelica_library: Path) -> None:
    replace(Path("arm.urdf"), 'type="continuous"', 'type="fixed"')
    result = check()
    assert (result.in_step, result.status(strict=False)) == (False, CheckStatus.DIFFERS)
    assert [one.model for one in result.compiled] == ["Arm", "ArmRun", "ArmTest"]
    assert all(one.unknowns > 100 for one in result.compiled)


def test_what_was_right_is_not_compiled_again_until_something_changes(
    arm: Path, modelica_library: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    jobs: list[str] = []
    problems = [""]

    def run_job(name: str, job: CompileJob, cache: UserCache) -> Iterator[CompileResult]:
        jobs.extend(task.title for task in job.tasks)
        yield from (CompileResult(problems[0], 7, 2) for _ in job.tasks)

    monkeypatch.setattr("urdfsync.check.compilers.compiler.run_job", lambda *given: (one for one in run_job(*given)))
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: tmp_path / "cache")
    first, second = check(), check()
    assert len(jobs) == 3
    assert first.compiled == second.compiled
    assert (second.status(strict=True), second.unchecked) == (CheckStatus.RIGHT, first.unchecked)
    replace(arm / "Links" / "Base.mo", "model Base", "// looked at\nmodel Base")
    problems[0] = "something is wrong"
    assert [check().failed for _ in range(2)] == [True, True]
    assert len(jobs) == 9, "what is wrong is compiled again"


def test_without_a_library_nothing_is_compiled(arm: Path) -> None:
    """The configuration names a folder with nothing in it."""
    Path("nothing").mkdir()
    with Path("urdfsync.toml").open("a") as file:
        file.write('[check]\nlibrary = "nothing"\n')
    result = check()
    assert codes(result) == ["wrong-library-folder"]
    assert any("nothing was compiled" in sentence for sentence in result.gaps)


def test_nothing_is_compiled_that_does_not_parse(arm: Path) -> None:
    (arm / "Joints" / "Elbow.mo").write_text("within Arm.Joints;\nmodel Elbow\n  Real x = ;\nend Elbow;\n")
    result = check()
    assert result.failed
    assert [(one.file, one.line) for one in result.diagnostics if one.severity == "error"] == [
        ("modelica/Arm/Joints/Elbow.mo", 3)
    ]
    assert result.compiled == ()
    assert any("nothing was compiled" in sentence for sentence in result.gaps)


def test_a_file_that_the_package_refers_to_and_that_is_not_there_is_named(arm: Path) -> None:
    """A mesh of the user's; a link in the documentation is none of its business."""
    hand = arm / "Links" / "Hand.mo"
    visual = '  parameter String cover = "modelica://Arm/Resources/cover.stl";\n'
    replace(hand, "equation\n", f"{visual}equation\n")
    replace(hand, "end Hand;", 'end Hand; // see "<a href=modelica://Arm/Resources/none.html>"')
    (found,) = [one for one in check().diagnostics if one.code == "missing-resource"]
    line = hand.read_text().split("\n").index(visual.rstrip("\n")) + 1
    assert (found.file, found.line, found.severity) == ("modelica/Arm/Links/Hand.mo", line, "error")
    (arm / "Resources").mkdir(exist_ok=True)
    (arm / "Resources" / "cover.stl").touch()
    assert "missing-resource" not in codes(check())


def test_it_is_told_what_is_being_done_and_how_far_it_is(arm: Path) -> None:
    steps: list[Step] = []
    check(steps=steps)
    assert steps[0].what == "arm: reading the source and the package"
    assert "arm: checking files and names" in [step.what for step in steps]
    assert all(0 <= one.done <= other.done <= 1 for one, other in itertools.pairwise(steps[:4]))


def test_a_source_with_errors_is_told(arm: Path) -> None:
    Path("arm.urdf").write_text(ARM[: len(ARM) // 2])
    result = check()
    assert result.failed
    assert result.diagnostics[0].file == "arm.urdf"


def test_a_robot_that_was_not_built_is_out_of_step(arm: Path) -> None:
    """What would be generated is checked as far as it goes: here there is no library."""
    shutil.rmtree(arm)
    shutil.rmtree(".urdfsync")
    Path("nothing").mkdir()
    with Path("urdfsync.toml").open("a") as file:
        file.write('[check]\nlibrary = "nothing"\n')
    result = check()
    assert (result.built, result.in_step) == (False, False)
    assert codes(result) == ["wrong-library-folder"]


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
def test_what_is_no_file_is_told_and_no_more(arm: Path) -> None:
    (arm / "Links" / "Gone.mo").symlink_to("nowhere.mo")
    (arm / "Joints" / "Elbow.mo").write_text("within Arm.Joints;\nmodel Elbow\n  Real x = ;\nend Elbow;\n")
    found = check().diagnostics
    assert [(one.code, one.file) for one in found if one.code == "no-file"] == [
        ("no-file", "modelica/Arm/Links/Gone.mo")
    ]
