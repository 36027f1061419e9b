"""FMUs: what is exported, that FMPy's words and differences are told, and what is refused before anything is compiled.

With a real OpenModelica only where there is one.
"""

from __future__ import annotations

import io
import json
import math
import os
import sys
import tempfile
import tracemalloc
import zipfile
from pathlib import Path
from typing import Any

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.commands import Execute
from support.simulation import Compiler

from urdfsync import cli, config
from urdfsync.checks.compilers import omc
from urdfsync.checks.compilers.compiler import CompileResult, Export, Tool
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.simulation import fmu
from urdfsync.simulation.export import Exported, export, is_exported
from urdfsync.simulation.fmu import Trial, try_out
from urdfsync.simulation.results import SimulateOptions, SimulateResult

DESCRIPTION = b"""<fmiModelDescription description="Arm.ArmRun, exported by urdfsync 0.1.0">
  <ModelExchange modelIdentifier="Arm_ArmRun">
    <SourceFiles/>
  </ModelExchange>
  <CoSimulation modelIdentifier="Arm_ArmRun"/>
  <ScalarVariable name="der(der(der(robot.elbow.phi)))"/><ScalarVariable name="der(robot.elbow.phi)"/>
</fmiModelDescription>
"""
BOTH = Export("2.0", "me_cs")
OPTIONS = SimulateOptions(tool=Tool("omc"))


def archive() -> bytes:
    """An FMU as OpenModelica writes it, but for its code."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as file:
        file.writestr("modelDescription.xml", DESCRIPTION)
        file.writestr("binaries/linux64/Arm_ArmRun.so", b"code")
    return content.getvalue()


@pytest.fixture
def openmodelica(compiler: Compiler, monkeypatch: pytest.MonkeyPatch) -> Compiler:
    """A stand-in for OpenModelica that makes an FMU of anything."""
    monkeypatch.setattr("urdfsync.checks.compilers.find_missing", lambda _: None)
    compiler.results = [CompileResult(fmu=archive(), version="1.27.0")]
    return compiler


def exported(options: SimulateOptions = OPTIONS) -> Exported:
    loaded = config.load(Path("urdfsync.toml").absolute())
    return export(loaded, loaded.robots[0], options, BOTH, lambda *_: None, for_trial=True)


def test_run_is_exported_as_a_model_of_its_own_with_the_tolerance_inside(openmodelica: Compiler) -> None:
    values = ("robot.elbow.parameters.dynamics.damping=4",)
    found = exported(msgspec.structs.replace(OPTIONS, values=values, tolerance=1e-9))
    assert (found.model, found.name, found.tolerance) == ("Arm.ArmRun", "Arm_ArmRun", 1e-9)
    (task,) = openmodelica.jobs[0].tasks
    assert task.export == BOTH
    assert "extends Arm.ArmRun(robot(elbow(parameters(dynamics(damping = 4)))));" in task.source
    assert "Tolerance = 1e-09" in task.source
    assert found.tool == "OpenModelica 1.27.0"


def test_higher_derivatives_get_the_names_that_fmi_has_for_them(openmodelica: Compiler) -> None:
    with zipfile.ZipFile(io.BytesIO(exported().content)) as file:
        text = file.read("modelDescription.xml").decode()
        assert file.read("binaries/linux64/Arm_ArmRun.so") == b"code"
    assert 'name="der(robot.elbow.phi,3)"' in text
    assert 'name="der(robot.elbow.phi)"' in text
    assert "<ModelExchange" in text


def test_co_simulation_alone_is_cut_out_of_both(openmodelica: Compiler) -> None:
    """Since OpenModelica reduces the index in another way then, which fails with floating bases."""
    loaded = config.load(Path("urdfsync.toml").absolute())
    found = export(loaded, loaded.robots[0], OPTIONS, Export("2.0", "cs"), lambda *_: None)
    assert openmodelica.jobs[0].tasks[0].export == BOTH
    with zipfile.ZipFile(io.BytesIO(found.content)) as file:
        text = file.read("modelDescription.xml").decode()
    assert "<ModelExchange" not in text
    assert '<CoSimulation modelIdentifier="Arm_ArmRun"/>' in text


def test_a_model_that_can_not_be_exported_is_told_with_what_the_compiler_says(openmodelica: Compiler) -> None:
    openmodelica.results = [CompileResult("Error: no C compiler was found: install clang.")]
    with pytest.raises(UrdfsyncError, match="no C compiler was found: install clang"):
        exported()


@pytest.mark.parametrize(("arguments", "words"), [
    (["--output", "arm.zip"], "an FMU's name ends with .fmu"),
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
    assert "ArmRun.fmu: error: it is there, and urdfsync did not write it" in capsys.readouterr().err
    assert Path("ArmRun.fmu").read_text() == "mine"
    assert cli.main(["fmu", "-q", "--output", "ArmRun.fmu"]) == 0
    assert zipfile.is_zipfile("ArmRun.fmu")


def test_a_stranger_s_file_at_the_default_name_is_read_within_limits(tmp_path: Path) -> None:
    """A bomb of 5 MB may have a description of 5 GB; the first 64 KB of it tell."""
    file, words = tmp_path / "ArmRun.fmu", b'<a description="Arm.ArmRun, exported by urdfsync 0.1.0">'
    for compression, is_ours in ((zipfile.ZIP_DEFLATED, True), (zipfile.ZIP_BZIP2, False), (zipfile.ZIP_LZMA, False)):
        with zipfile.ZipFile(file, "w", compression) as bomb, bomb.open("modelDescription.xml", "w") as entry:
            entry.write(words)
            for _ in range(8):
                entry.write(bytes(2**20))
        tracemalloc.start()
        try:
            assert is_exported(file) is is_ours
            assert tracemalloc.get_traced_memory()[1] < 2**20
        finally:
            tracemalloc.stop()
    with file.open("wb") as large:
        large.truncate(2**40)
    assert not is_exported(file)


@pytest.mark.skipif(sys.platform == "win32", reason="no pipes there")
def test_a_pipe_at_the_default_name_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "ArmRun.fmu")
    assert not is_exported(tmp_path / "ArmRun.fmu")


@given(st.binary(max_size=8), st.integers(0, 10**6), st.booleans())
def test_damage_to_an_fmu_makes_it_no_error(damage: bytes, place: int, is_cut: bool) -> None:
    content = archive()
    place %= len(content)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "a.fmu"
        file.write_bytes(content[:place] + damage + (b"" if is_cut else content[place + len(damage) :]))
        assert is_exported(file) in (True, False)


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


class Fmpy:
    """In the place of `process.run`: FMPy says this, and the FMU moves like this."""

    def __init__(self, findings: list[str], **series: dict[str, list[float]]) -> None:
        self.answer: Any = fmu._Examined(findings, series, {"cs": "a step failed"} if findings else {})
        self.request: Any = None

    def __call__(self, function: object, request: Any, **_: object) -> list[Any]:
        """Answer."""
        self.request = request
        return [self.answer]


REFERENCE = {"time": (0.0, 0.5, 0.5, 1.0), "elbow_phi": (0.0, 0.25, 0.5, 1.0), "elbow_tau": (0.0, 1.0, 2.0, 4.0)}


@pytest.fixture
def reference(monkeypatch: pytest.MonkeyPatch) -> list[SimulateOptions]:
    """The options with which `simulate` is asked for the trajectory; at 0.5 s there is an event."""
    asked: list[SimulateOptions] = []

    def simulate(_config: object, _robot: object, options: SimulateOptions, _progress: object) -> SimulateResult:
        asked.append(options)
        return SimulateResult("arm", "Arm.ArmRun", 1.0, 0.5, 1e-10, (), REFERENCE, (), 1.0, is_known=False)

    monkeypatch.setattr(fmu, "simulate", simulate)
    return asked


def tried(options: SimulateOptions = OPTIONS) -> Trial:
    loaded = config.load(Path("urdfsync.toml").absolute())
    return try_out(loaded, loaded.robots[0], options, exported(), ("me", "cs"), lambda *_: None)


def test_a_trajectory_is_compared_at_all_results_with_the_nearest_at_an_event(
    openmodelica: Compiler, reference: list[SimulateOptions], monkeypatch: pytest.MonkeyPatch
) -> None:
    same = {"time": [0.0, 0.5, 1.0], "elbow_phi": [0.0, 0.5, 1.0], "elbow_tau": [0.0, 2.0, 4.0]}
    monkeypatch.setattr("urdfsync.checks.process.run", Fmpy([], me=same, cs={**same, "elbow_tau": [0.0, 2.0, 4.4]}))
    found = tried()
    assert found.agreement == {"me": 0.0, "cs": pytest.approx(0.1)}
    assert (found.worst["cs"], found.compared) == ("elbow_tau", 2)
    assert reference[0].as_exported
    assert reference[0].tolerance == 1e-10


def test_a_motion_goes_step_by_step_and_only_to_co_simulation(
    openmodelica: Compiler, reference: list[SimulateOptions], monkeypatch: pytest.MonkeyPatch
) -> None:
    Path("motion.csv").write_text("time,shoulder_phi,elbow_phi\n0,0,0\n1,1,1\n2,4,8\n3,9,27\n")
    fmpy = Fmpy([])
    monkeypatch.setattr("urdfsync.checks.process.run", fmpy)
    tried(msgspec.structs.replace(OPTIONS, motion=Path("motion.csv")))
    assert fmpy.request.kinds == ["cs"]
    place = fmpy.request.times.index(pytest.approx(1.5))
    assert fmpy.request.inputs["shoulder_phi"][place] == pytest.approx(1.5**2)
    assert fmpy.request.inputs["elbow_phi"][place] == pytest.approx(1.5**3)


def test_findings_and_differences_are_warnings_and_the_file_is_there(
    openmodelica: Compiler,
    reference: list[SimulateOptions],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    far = {"time": [0.0, 0.5, 1.0], "elbow_tau": [0.0, 2.0, 5.0]}
    monkeypatch.setattr("urdfsync.checks.process.run", Fmpy(["`x` is no name"], me=far))
    monkeypatch.setattr("importlib.util.find_spec", lambda name: name)
    assert cli.main(["fmu", "--check", "--kind", "me"]) == 1
    assert Path("ArmRun.fmu").is_file()
    assert capsys.readouterr().err.splitlines() == [
        "ArmRun.fmu: warning: FMPy: `x` is no name [fmu-not-valid]",
        "ArmRun.fmu: warning: CoSimulation: FMPy can't simulate it: a step failed [fmu-not-simulated]",
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
    cli.main(["fmu", "--check", "--fmi", "3", "--kind", "cs", "--input", "motion.csv", "--json"])
    (robot,) = json.loads(capsys.readouterr().out)["results"]
    assert robot["trial"]["agreement"]["cs"] < 1e-3, "steps of its inputs shake the filters"


def test_a_trajectory_that_is_no_number_or_ends_early_does_not_agree(
    openmodelica: Compiler, reference: list[SimulateOptions], monkeypatch: pytest.MonkeyPatch
) -> None:
    late = {"time": [0.0, 0.5, 1.0], "elbow_tau": [0.0, float("nan"), 4.0]}
    monkeypatch.setattr(
        "urdfsync.checks.process.run", Fmpy([], me=late, cs={"time": [0.0, 0.5], "elbow_tau": [0.0, 2.0]})
    )
    found = tried()
    assert found.agreement["me"] == math.inf
    assert found.problems == {"cs": "the FMU ends at 0.5 s, not at 1 s"}
    openmodelica.results = [CompileResult(fmu=archive())]
    monkeypatch.setattr("urdfsync.checks.process.run", Fmpy([], me={"time": [0.0, 0.5, 1.0]}))
    assert tried().problems == {"me": "the FMU has no variable of the model"}


def test_a_model_without_a_package_gets_another_name(openmodelica: Compiler) -> None:
    Path("Cell.mo").write_text("model Cell\n  extends Arm.ArmTest;\nend Cell;\n")
    found = exported(msgspec.structs.replace(OPTIONS, model="Cell"))
    assert (found.model, found.name) == ("Cell", "Cell_FMU")
    assert openmodelica.jobs[0].tasks[0].source.startswith("model Cell_FMU ")


def test_what_the_check_finds_is_in_the_json(
    openmodelica: Compiler,
    reference: list[SimulateOptions],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr("urdfsync.checks.process.run", Fmpy(["`x` is no name"], me=dict(REFERENCE)))  # type: ignore[arg-type]
    monkeypatch.setattr("importlib.util.find_spec", lambda name: name)
    assert cli.main(["fmu", "--check", "--kind", "me", "--json"]) == 1
    (robot,) = json.loads(capsys.readouterr().out)["results"]
    assert [one["code"] for one in robot["diagnostics"]] == ["fmu-not-valid", "fmu-not-simulated"]


def test_a_link_in_the_place_of_the_file_is_not_followed(openmodelica: Compiler, tmp_path: Path) -> None:
    content = archive()
    (tmp_path / "elsewhere.fmu").write_bytes(content)
    Path("ArmRun.fmu").symlink_to(tmp_path / "elsewhere.fmu")
    assert cli.main(["fmu", "-q"]) == 2
    assert (tmp_path / "elsewhere.fmu").read_bytes() == content
