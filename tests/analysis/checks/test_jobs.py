"""Versions of a package for a compiler: what it reads, and by which names people see its files."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

import msgspec
import pytest
from support.checks import Compiling, status
from support.two_joints import check, rebuild, write

from urdfsync.analysis.checks.compilers.compiler import CompileJob, CompileResult, CompileTask, SimulationResult, Tool
from urdfsync.analysis.checks.jobs import Jobs
from urdfsync.analysis.checks.libraries import Libraries
from urdfsync.analysis.checks.process import Limits
from urdfsync.analysis.checks.results import CheckStatus
from urdfsync.project import config
from urdfsync.project.config import library_folder


@pytest.mark.skipif(sys.platform != "linux", reason="names of files are Unicode there")
def test_in_a_folder_that_is_not_utf8_the_compiler_gets_copies(
    arm: Path, modelica_library: Path, compiler: Compiling, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / os.fsdecode(b"caf\xe9")
    folder.mkdir()
    for name in ("arm.urdf", "urdfsync.toml"):
        shutil.copy(name, folder)
    monkeypatch.chdir(folder)
    rebuild()
    write({"Pumps/package.mo": "package Pumps\n  model Small\n  end Small;\nend Pumps;\n"})
    write(
        {
            "Arm/Own.mo": "within Arm;\nmodel Own\n  Pumps.Small pump;\nend Own;\n",
            "Bench.mo": "model Bench\n  Arm.Arm a;\nend Bench;\n",
        }
    )
    result = check()
    assert (status(result, strict=True), len(result.compiled)) == (CheckStatus.RIGHT, 5)
    assert "Bench" in compiler.models
    assert any(root.endswith("/Pumps") for root in compiler.roots)
    assert all(root.encode() for root in compiler.roots)


class Reading:
    """In the place of `compilers.run_job`: reads the files of its job, and names the folders in all that it says."""

    def __call__(self, _tool: Tool, job: CompileJob, *_: object) -> list[CompileResult]:
        self.job, roots = job, " ".join(job.roots)
        self.texts = {file.name: file.read_bytes() for root in job.roots for file in Path(root).rglob("*.mo")}
        return [CompileResult(roots, warnings=roots, runs=(SimulationResult(problem=roots),))]


@pytest.fixture
def reading(monkeypatch: pytest.MonkeyPatch) -> Reading:
    found = Reading()
    monkeypatch.setattr("urdfsync.analysis.checks.compilers.run_job", found)
    return found


@pytest.fixture
def jobs(tmp_path: Path) -> Jobs:
    """Those of a robot in a package, which needs a library."""
    (tmp_path / "Pumps").mkdir()
    (tmp_path / "Pumps/Small.mo").write_bytes(b"as it was")
    text = '[robots.arm]\nsource = "arm.urdf"\npackage = "Plant.Arm"\n'
    robot = config.parse(text, tmp_path / "urdfsync.toml", "urdfsync.toml").robots[0]
    needed, around = Libraries({}, {"Pumps": tmp_path / "Pumps"}), {"Plant/Control.mo": b"around"}
    return Jobs(robot, Tool("omc"), needed, around, Limits("the check", 1.0, 1e9), tmp_path / "work")


TEXTS, TASK = {"Elbow.mo": b"own"}, CompileTask("P", "model P\n  import Pumps;\nend P;\n")


def test_what_a_compiler_says_names_the_files_that_people_know(jobs: Jobs, reading: Reading) -> None:
    (result,) = jobs.run("as/it is", TEXTS, [TASK])
    roots = [str(library_folder() / "UrdfSync"), str(jobs.needed.others["Pumps"]), str(jobs.robot.output / "Plant")]
    assert result.problem == result.warnings == result.runs[0].problem == " ".join(roots)
    assert [*reading.job.roots] == [*roots[:2], str(jobs.folder / "as-it is/Plant")]
    assert (reading.texts["Elbow.mo"], reading.texts["Control.mo"]) == (b"own", b"around")
    assert reading.job.tasks[0].source == "model P\n  import UrdfSync;\n  import Pumps;\nend P;\n"


def test_files_may_have_another_content_in_a_copy(jobs: Jobs, reading: Reading) -> None:
    library, robot = jobs.needed.others["Pumps"], jobs.robot
    files = robot.folder / "Elbow.mo", robot.output / "Plant/Control.mo", library / "Small.mo"
    (result,) = jobs.run("other", TEXTS, [TASK], {file: file.name.encode() for file in files})
    assert {reading.texts[file.name].decode() for file in files} == {file.name for file in files}
    assert str(library) in result.problem
    assert str(library) not in reading.job.roots
    assert (library / "Small.mo").read_bytes() == b"as it was"


def test_a_place_in_a_copied_library_is_one_in_its_own_files(
    jobs: Jobs, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    library, services, numbers = (tmp_path / f"{name} 4.1.0" for name in ("Modelica", "ModelicaServices", "Complex"))
    for file in (library / "package.mo", services / "package.mo", numbers := numbers.with_suffix(".0.mo")):
        file.parent.mkdir(exist_ok=True)
        file.write_text("package It end It;\n")
    originals = {
        "UrdfSync/Robots/PartialBench.mo": library_folder() / "UrdfSync/Robots/PartialBench.mo",
        "ModelicaServices/package.mo": services / "package.mo",
        "Complex.mo": numbers,
    }

    def complain(_tool: Tool, job: CompileJob, *_: object) -> list[CompileResult]:
        assert all(Path(job.roots[0], copy).read_bytes() == file.read_bytes() for copy, file in originals.items())
        return [CompileResult(" ".join(f"[{job.roots[0]}/{copy}:7:1]" for copy in originals))]

    monkeypatch.setattr("urdfsync.analysis.checks.compilers.run_job", complain)
    task = CompileTask("P", "model P\n  extends UrdfSync.Robots.PartialBench;\nend P;\n")
    standard = {"Modelica": library, "ModelicaServices": services, "Complex": numbers}
    needed = Libraries(standard, {})
    (result,) = msgspec.structs.replace(jobs, tool=Tool("rumoca"), needed=needed).run("it", TEXTS, [task])
    assert result.problem == " ".join(f"[{file}:7:1]" for file in originals.values())
