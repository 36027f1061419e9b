"""`urdfsync fmu` as people type it: where the file goes, and what is said; with a real OpenModelica if there is one."""

from __future__ import annotations

import json
import os
import zipfile
from pathlib import Path

import pytest
from support.commands import Execute
from support.fmu import REFERENCE, Fmpy, archive
from support.simulation import Compiler

from urdfsync.analysis.checks.compilers import omc
from urdfsync.analysis.checks.compilers.compiler import CompileResult
from urdfsync.analysis.simulation.results import SimulateOptions
from urdfsync.commands import cli


@pytest.mark.parametrize(("arguments", "words"), [
    (["-o", "arm.zip"], "an FMU's name ends with .fmu"),
    (["--output", "none/arm.fmu"], "there is no such folder"),
    (["--input", "motion.csv"], "`--input` is the motion for `--check`"),
    (["--input", "motion.csv", "--check", "--kind", "me"], "`--input` is the motion for `--check` of co-simulation"),
])  # fmt: skip
def test_bad_arguments_are_refused_before_anything_is_compiled(
    openmodelica: Compiler, arguments: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["fmu", *arguments]) == 2
    assert words in capsys.readouterr().err
    assert openmodelica.jobs == []


def test_the_file_is_written_where_the_user_says(openmodelica: Compiler, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["fmu", "--output", "robot.fmu"]) == 0
    assert zipfile.is_zipfile("robot.fmu")
    first, last = capsys.readouterr().out.splitlines()
    assert first.startswith("arm: Arm.ArmRun by OpenModelica 1.27.0, FMI 2.0, model exchange and co-simulation; ")
    assert last == "  fmu: robot.fmu"


def test_a_file_of_the_users_is_replaced_only_if_it_is_named(
    openmodelica: Compiler, capsys: pytest.CaptureFixture[str]
) -> None:
    openmodelica.results *= 4
    assert cli.main(["fmu", "-q"]) == 0
    assert cli.main(["fmu", "-q"]) == 0, "urdfsync wrote it"
    Path("ArmRun.fmu").write_text("mine")
    assert cli.main(["fmu", "-q"]) == 2
    assert "ArmRun.fmu: error: the file exists, and urdfsync did not write it" in capsys.readouterr().err
    assert Path("ArmRun.fmu").read_text() == "mine"
    assert cli.main(["fmu", "-q", "--output", "ArmRun.fmu"]) == 0
    assert zipfile.is_zipfile("ArmRun.fmu")


def test_bad_motions_and_missing_programs_are_told_before_the_export(
    openmodelica: Compiler, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With nothing that this command has not: it has no `--tool` and no `--method`."""
    monkeypatch.setattr("importlib.util.find_spec", lambda name: name)
    Path("m.csv").symlink_to(os.devnull)
    assert "m.csv: error: the file can't be read" in execute("fmu", "--check", "--input", "m.csv", code=2).words
    assert openmodelica.jobs == []


def test_a_parameter_that_does_not_exist_is_refused_with_the_nearest(openmodelica: Compiler, execute: Execute) -> None:
    known = CompileResult(parameters=("robot.elbow.parameters.dynamics.damping",))
    openmodelica.results = [CompileResult("Error: Modified element dampin not found."), known]
    said = execute("fmu", "--set", "robot.elbow.dampin=1", code=2).words
    assert "`Arm.ArmRun` has no parameter `robot.elbow.dampin`" in said
    assert "did you mean `robot.elbow.parameters.dynamics.damping`?" in said
    openmodelica.results = [CompileResult("Error: Too few equations."), CompileResult()]
    assert "Too few equations" in execute("fmu", "--set", "robot.elbow.dampin=1", code=2).words


def test_no_other_compiler_is_proposed_for_what_only_openmodelica_can(
    arm: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(arm))
    monkeypatch.delenv("OPENMODELICAHOME", raising=False)
    said = execute("fmu", code=2).words
    assert "`omc` is not on the PATH; install OpenModelica" in said
    assert "rumoca" not in said
    assert not Path("ArmRun.fmu").exists()


def test_findings_and_differences_are_warnings_and_the_file_is_there(
    openmodelica: Compiler,
    reference: list[SimulateOptions],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    far = {"time": [0.0, 0.5, 1.0], "elbow_tau": [0.0, 2.0, 5.0]}
    monkeypatch.setattr("urdfsync.analysis.checks.process.run", Fmpy(["`x` is no name"], me=far))
    monkeypatch.setattr("importlib.util.find_spec", lambda name: name)
    assert cli.main(["fmu", "--check", "--kind", "me"]) == 1
    assert Path("ArmRun.fmu").is_file()
    assert capsys.readouterr().err.splitlines() == [
        "ArmRun.fmu: warning: FMPy: `x` is no name [fmu-not-valid]",
        "ArmRun.fmu: warning: CoSimulation: FMPy can't simulate the FMU: a step failed [fmu-not-simulated]",
        "ArmRun.fmu: warning: ModelExchange: `elbow_tau` differs from `simulate` by 2.5e-01 of its size; "
        "try a smaller `--tolerance` [fmu-differs]",
    ]


@pytest.fixture
def real(arm: Path, modelica_library: Path) -> None:
    """OpenModelica and FMPy as they are."""
    if omc.program("") is None:
        pytest.skip("no OpenModelica")
    pytest.importorskip("fmpy")


@pytest.mark.slow
@pytest.mark.usefixtures("real")
def test_a_real_fmu_is_valid_and_moves_like_the_model(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["fmu", "--check", "--model", "ArmTest", "--stop", "0.5"]) == 0
    assert "FMPy finds nothing wrong" in capsys.readouterr().out


@pytest.mark.slow
@pytest.mark.usefixtures("real")
def test_a_real_fmu_follows_a_motion_in_fmi_3(capsys: pytest.CaptureFixture[str]) -> None:
    """OpenModelica 1.27 leaves out what FMI 3.0 wants for initial values, which FMPy finds."""
    Path("motion.csv").write_text("time,shoulder_phi,elbow_phi\n0,0,0\n0.1,0.01,0.02\n0.2,0.1,0.2\n0.3,0.3,0.6\n")
    cli.main(["fmu", "--check", "--fmi", "3", "--kind", "cs", "--input", "motion.csv", "--format=json"])
    (robot,) = json.loads(capsys.readouterr().out)["results"]
    assert robot["trial"]["agreement"]["cs"] < 1e-3, "steps of its inputs shake the filters"


def test_what_the_check_finds_is_in_the_json(
    openmodelica: Compiler,
    reference: list[SimulateOptions],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr("urdfsync.analysis.checks.process.run", Fmpy(["`x` is no name"], me=dict(REFERENCE)))  # type: ignore[arg-type]
    monkeypatch.setattr("importlib.util.find_spec", lambda name: name)
    assert cli.main(["fmu", "--check", "--kind", "me", "--format=json"]) == 1
    (robot,) = json.loads(capsys.readouterr().out)["results"]
    assert [one["code"] for one in robot["diagnostics"]] == ["fmu-not-valid", "fmu-not-simulated"]


def test_a_link_in_the_place_of_the_file_is_not_followed(openmodelica: Compiler, tmp_path: Path) -> None:
    content = archive()
    (tmp_path / "elsewhere.fmu").write_bytes(content)
    Path("ArmRun.fmu").symlink_to(tmp_path / "elsewhere.fmu")
    assert cli.main(["fmu", "-q"]) == 2
    assert (tmp_path / "elsewhere.fmu").read_bytes() == content
