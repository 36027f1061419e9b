"""OpenModelica: what it is told, what its answers mean, and its absence.

The answers are those that it gave once, see `../shared/omc`. With a real `omc` only where there is one.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support import corpus, fake_omc
from support.trajectories import write_trajectory

from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.compilers import omc, run_job, state
from urdfsync.analysis.checks.compilers.compiler import (
    CompileJob,
    CompilerError,
    CompileResult,
    CompileTask,
    Complaint,
    Export,
    Simulation,
    Tool,
    compile_task,
)
from urdfsync.analysis.checks.contents import content_hash
from urdfsync.analysis.checks.process import Limits

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the stand-in for omc is a script")

BOTH_KINDS = Export("2.0", "me_cs")
RECORDED = corpus.FOLDER.parent / "omc"
TASK = CompileTask("Good", 'model Good "a \\ b"\nend Good;\n', title="Lab.Good")
BALANCED = '"Check of Good completed successfully.\nClass Good has 4 equation(s) and 4 variable(s).\n1 of these."\n'
LOST = '[/ws/Arm/Joints/Elbow.mo:76:3-76:35:writable] Error: Variable orgin.frame_a not found in scope \\"Arm\\".\n'
UNITS = """\
[/ws/Arm/Joints/Elbow.mo:27:3-27:52:writable] Warning: The following equation is INCONSISTENT due to specified unit information: a = b
Warning: The units of following sub-expressions need to be equal:
- sub-expression \\"a\\" has unit \\"Hz\\"
- sub-expression \\"b\\" has unit \\"m\\"
"""  # noqa: E501 - it says so in one line
RESULT = """\
record SimulationResult
    resultFile = "{file}",
    simulationOptions = "startTime = 0.0, stopTime = 1.0",
    messages = "{messages}",
    timeTotal = 4.768848468
end SimulationResult;
"{said}"
"""

Ask = Callable[..., list[CompileResult]]


@pytest.fixture
def ask(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Ask:
    """Do tasks with an `omc` on the PATH that gives these answers to calls that begin so."""
    folder = tmp_path / "bin"
    fake_omc.install(folder)
    monkeypatch.setenv("PATH", str(folder), prepend=":")
    monkeypatch.delenv("OPENMODELICAHOME", raising=False)

    def done(answers: Mapping[str, str], *tasks: CompileTask, roots: tuple[str, ...] = ()) -> list[CompileResult]:
        (folder / "answers.json").write_text(json.dumps(answers))
        job = CompileJob(roots, tasks or (TASK,))
        return run_job(Tool("omc"), job, UserCache(tmp_path / "cache"), Limits("the check", 60, 2e9))

    return done


def asked(tmp_path: Path) -> list[str]:
    return (tmp_path / "bin/asked.txt").read_text().splitlines()


def test_libraries_and_the_package_are_loaded_then_each_model_is_checked(ask: Ask, tmp_path: Path) -> None:
    library, robot = tmp_path / "library", tmp_path / "A b"
    for file in (library / "Modelica 4.1.0/package.mo", library / "Own/package.mo", robot / "package.mo"):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    (result,) = ask({"checkModel": BALANCED + '""\n'}, roots=(str(library), str(robot)))
    assert (result.problem, result.unknowns) == ("", 4)
    version, flags, standard, *files, text, check = asked(tmp_path)
    assert (version, standard, check) == ("getVersion()", "loadModel(Modelica)", "checkModel(Good)")
    assert flags == 'setCommandLineOptions("--matchingAlgorithm=PFPlus")'
    assert files == [f'loadFile("{folder}/package.mo")' for folder in (library / "Own", robot)]
    assert text.endswith('/task0.mo")')


def test_an_omc_without_a_c_compiler_is_told_to_do_without(ask: Ask, tmp_path: Path) -> None:
    ask({"getVersion": '"v1.27.0-dev-ea251558-rust"\n""\n', "checkModel": BALANCED + '""\n'})
    assert asked(tmp_path)[1] == 'setCommandLineOptions("--matchingAlgorithm=PFPlus --simCodeTarget=wasm-jit")'


@pytest.mark.parametrize(("load", "check", "problem"), [
    ('true\n""\n', BALANCED.replace("4 variable", "5 variable") + '""\n', "unbalanced model: 4 equations, 5 unknowns"),
    ('true\n""\n', f'""\n"{LOST}"\n', LOST.replace("\\", "").strip()),
    ('true\n""\n', '""\n""\n', "the model does not compile"),
    ('false\n"Error: text"\n', BALANCED + '""\n', "Error: text"),
    ('false\n""\n', BALANCED + '""\n', "OpenModelica can't load it and gives no reason"),
])  # fmt: skip
def test_every_answer_but_success_is_a_problem_of_its_task(ask: Ask, load: str, check: str, problem: str) -> None:
    bad = CompileTask("Bad", "model Bad end Bad;", title="Lab.Bad")
    answers = {"checkModel(Good)": BALANCED + '""\n', "checkModel(Bad)": check}
    answers |= {f'loadFile("{"x"}': load}
    found = ask(answers | ({} if load.startswith("true") else {"loadModel": load}), TASK, bad)
    assert found[1].problem == problem
    assert found[0].problem == ("" if load.startswith("true") else problem)


def test_units_that_do_not_fit_are_a_warning_of_their_own_kind(ask: Ask) -> None:
    (result,) = ask({"checkModel": f'{BALANCED}"{UNITS}"\n'})
    (complaint,) = omc.complaints(result.warnings)
    assert (complaint.code, complaint.file, complaint.line) == ("units", "/ws/Arm/Joints/Elbow.mo", 27)
    assert complaint.message.endswith('- sub-expression "a" has unit "Hz" - sub-expression "b" has unit "m"')


@pytest.mark.parametrize(("name", "number"), [("commands[2]", 0), ("positions[12]", 0), ("mine[2]", 1)])
def test_a_vector_of_inputs_with_several_units_is_right(ask: Ask, name: str, number: int) -> None:
    """OpenModelica takes the first unit of an array for all its items."""
    (result,) = ask({"checkModel": f'{BALANCED}"{UNITS}"\n'.replace('\\"a', f'\\"{name}')})
    assert len(omc.complaints(result.warnings)) == number


def test_an_error_in_a_library_counts_where_the_user_caused_it() -> None:
    said = "[/ws/Elbow.mo:9:5-9:21:writable] Notification: From here:\n"
    said += "[/lib/Parts.mo:15:3-15:75:writable] Error: Type mismatch in\n  binding.\nNotification: Something else.\n"
    assert omc.complaints(said) == [Complaint("Type mismatch in binding.", "/ws/Elbow.mo", 9, 5)]


def simulated(ask: Ask, tmp_path: Path, file: str, messages: str = "", said: str = "") -> CompileResult:
    run = Simulation(1, 0.25, {"robot.k": 2.0}, 1e-9)
    task = CompileTask("Good", "model Good end Good;", (run,), ("q[1,2]",), title="Lab.Good")
    (result,) = ask({"simulate": RESULT.format(file=file, messages=messages, said=said)}, task)
    simulate = next(call for call in asked(tmp_path) if call.startswith("simulate"))
    assert "stopTime=1, numberOfIntervals=4, tolerance=1e-09" in simulate
    assert 'simflags="-override=robot.k=2.0"' in simulate
    return result


@pytest.mark.slow
def test_the_result_of_a_simulation_is_read_from_its_file(ask: Ask, tmp_path: Path) -> None:
    series = {"time": (0.0, 0.25), "p": (1.0, 2.0), "-q[1,2]": (2.0, 0.3)}
    write_trajectory(tmp_path / "x_res.mat", {"k": 7.0}, series)
    (run,) = simulated(ask, tmp_path, f"{tmp_path}/x_res.mat").runs
    assert run.values == {"time": (0, 0.25), "q[1,2]": (2, 0.3)}


def test_what_never_changes_is_a_series_and_a_parameter(ask: Ask, tmp_path: Path) -> None:
    write_trajectory(tmp_path / "x_res.mat", {"q[1,2]": 7.0}, {"time": (0.0, 0.25, 1.0)})
    (run,) = simulated(ask, tmp_path, f"{tmp_path}/x_res.mat").runs
    assert run.values["q[1,2]"] == (7, 7, 7)
    assert run.parameters == {"q[1,2]": 7}


@pytest.mark.slow
def test_a_result_of_another_form_is_a_problem(ask: Ask, tmp_path: Path) -> None:
    write_trajectory(tmp_path / "x_res.mat", {}, {"time": (0.0, 0.25), "p": (1.0, 1.0)})
    (run,) = simulated(ask, tmp_path, f"{tmp_path}/x_res.mat").runs
    assert run.problem == "the result has no `q[1,2]`"
    for number, content in enumerate((b"", b"time,p\n0,1\n")):
        (tmp_path / f"{number}.mat").write_bytes(content)
        (run,) = simulated(ask, tmp_path, f"{tmp_path}/{number}.mat").runs
        assert run.problem.startswith("the result can't be read: ")


def test_what_stops_a_simulation_is_told(ask: Ask, tmp_path: Path) -> None:
    log = "Simulation execution failed for model: Good\nLOG_SUCCESS       | info    | The initialization finished.\n"
    log += "|                 | |       | The following assertion has been violated at time 0.500000\n"
    (run,) = simulated(ask, tmp_path, "", log).runs
    assert run.problem == (
        "Simulation execution failed for model: Good; The following assertion has been violated at time 0.500000"
    )


BUILT = """\
"{file}"
"Warning: Unknown value \\"dassl\\" for flag \\"s\\".
Notification: Building FMU for platform 'static' (1/1).
"
"""
TOO_FEW = """\
""
"Error: Too few equations, under-determined system. The model has 1 equation(s) and 2 variable(s).
[/ws/Arm.mo:3:3-3:9:writable] Warning: Variable y does not have any remaining equation to be solved in.
"
"""
FAILED = """\
Simulation execution failed for model: Good
LOG_SUCCESS       | info    | The initialization finished successfully without homotopy method.
LOG_ASSERT        | info    | [/ws/Arm/Joints/Elbow.mo:28:3-28:41:writable]
|                 | |       | The following assertion has been violated at time 0.600000
|                 | |       | ((time < 0.55)) --> \\"the elbow breaks\\"
LOG_ASSERT        | error   | No event found, but assert was triggered. Throwing now!
"""


def test_an_fmu_comes_back_and_is_told_how_to_integrate(ask: Ask, tmp_path: Path) -> None:
    """Without a solver its co-simulation takes Euler's method, one step for each of the importer's."""
    (tmp_path / "Good.fmu").write_bytes(b"an archive")
    task = CompileTask("Good", "model Good end Good;", export=Export("3.0", "cs"), title="Lab.Good")
    (result,) = ask({"buildModelFMU": BUILT.format(file=tmp_path / "Good.fmu")}, task)
    assert (result.problem, result.fmu) == ("", b"an archive")
    calls = asked(tmp_path)
    assert calls[1] == 'setCommandLineOptions("--matchingAlgorithm=PFPlus --fmiFlags=s:cvode")'
    assert calls[-1] == 'buildModelFMU(Good, version="3.0", fmuType="cs", fileNamePrefix="Good")'


def test_a_c_compiler_that_is_missing_is_told_with_what_to_install() -> None:
    said = "Error: Internal error Failed to move Arm_JacA.bin file\n"
    said += "Error: Internal error Failed to get version from cmake\n"
    (found,) = omc.complaints(said)
    assert found.message.endswith("from cmake; OpenModelica needs a C compiler, make, and for FMUs cmake: install them")
    (found,) = omc.complaints("Error: Error building simulator. Build log: /bin/sh: 1: make: not found\n")
    assert "install them" in found.message


def test_why_there_is_no_fmu_is_told(ask: Ask) -> None:
    task = CompileTask("Good", "model Good end Good;", export=BOTH_KINDS, title="Lab.Good")
    (result,) = ask({"buildModelFMU": TOO_FEW}, task)
    assert result.problem.startswith("Error: Too few equations, under-determined system.")
    (result,) = ask({"buildModelFMU": '""\n""\n'}, task)
    assert result.problem == "OpenModelica makes no FMU and gives no reason"


def test_an_assertion_that_fails_is_told_with_its_text_place_and_time(ask: Ask, tmp_path: Path) -> None:
    (run,) = simulated(ask, tmp_path, "", FAILED).runs
    assert run.problem == "assert failed at t=0.600000: the elbow breaks (/ws/Arm/Joints/Elbow.mo:28)"


def test_a_model_that_ends_the_simulation_is_told_in_its_words(ask: Ask, tmp_path: Path) -> None:
    write_trajectory(tmp_path / "x_res.mat", {}, {"time": (0.0, 0.25), "q[1,2]": (2.0, 0.3)})
    log = "LOG_STDOUT        | info    | Simulation call terminate() at time 0.250000\n"
    log += "|                 | |       | Message : the end is reached\n"
    (run,) = simulated(ask, tmp_path, f"{tmp_path}/x_res.mat", log).runs
    assert (run.termination, run.problem) == ("the end is reached", "")


def test_a_place_in_our_own_text_is_left_out(ask: Ask, tmp_path: Path) -> None:
    """A parameter that does not exist is in no file of the user's."""
    answer = '""\n"[{folder}/task0.mo:6:57-6:67:writable] Error: Modified element dampin not found.\n"\n'
    script = tmp_path / "bin/omc"
    text = script.read_text().replace(
        "sys.stdout.write(answer)", "sys.stdout.write(answer.replace('{folder}', os.getcwd()))"
    )
    script.write_text(text.replace("import json\n", "import json\nimport os\n"))
    (result,) = ask({"checkModel": answer})
    assert result.problem == "Error: Modified element dampin not found."


def test_a_model_that_can_not_be_built_does_not_compile(ask: Ask, tmp_path: Path) -> None:
    result = simulated(ask, tmp_path, "", "Failed to build model: Good", "Error: Too few equations.")
    assert (result.problem, result.runs) == ("Error: Too few equations.", ())


def test_an_omc_that_does_not_start_or_is_not_there_is_one_clear_line(
    ask: Ask, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "bin/omc").write_text("no program")
    with pytest.raises(CompilerError, match="OpenModelica does not start"):
        ask({})
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(CompilerError, match="`omc` is not on the PATH; install OpenModelica"):
        ask({})


@pytest.mark.parametrize("answer", ["", "a panic of its own\n"])
def test_an_omc_that_dies_or_says_what_nobody_knows_is_told_with_the_call(ask: Ask, answer: str) -> None:
    with pytest.raises(CompilerError, match=r"OpenModelica ended at `checkModel\(Good\)` \(exit code") as caught:
        ask({"checkModel": answer})
    assert answer.strip() in str(caught.value)


def test_another_omc_is_another_state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """So that what one of them found right is not taken from the cache for the other.

    It may say another version though the program is the same, or be built anew with the version that it had.
    """
    monkeypatch.setenv("OPENMODELICAHOME", str(tmp_path))
    found = [state(Tool("omc"), content_hash)]
    for version in ("1.26", "1.27"):
        fake_omc.install(tmp_path / "bin", {"getVersion": f'"{version}"\n""\n'})
        found.append(state(Tool("omc"), content_hash))
    libraries = "lib/omc/libOpenModelicaCompiler.so", "bin/libOpenModelicaCompiler.dll"
    for file in (*libraries, "lib/omlibrary/Modelica 4.1.0/Math.mo", "bin/omc"):
        (tmp_path / file).parent.mkdir(parents=True, exist_ok=True)
        with (tmp_path / file).open("a") as stream:
            stream.write("\n")
        found.append(state(Tool("omc"), content_hash))
    assert len({tuple(one) for one in found}) == 7


def test_an_omc_where_windows_has_programs_is_found_last(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path / "path"))
    monkeypatch.setenv("PROGRAMFILES", str(tmp_path))
    assert omc.program("") is None
    for folder in ("OpenModelica1.26.3-64bit/bin", "OpenModelica1.27.0-64bit/bin", "path"):
        fake_omc.install(tmp_path / folder, {})
        assert Path(omc.program("") or "").parent == tmp_path / folder


def test_an_omc_that_does_not_say_its_version_has_no_state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OPENMODELICAHOME", str(tmp_path))
    fake_omc.install(tmp_path / "bin", {"getVersion": ""})
    with pytest.raises(OSError, match="exit code 3"):
        state(Tool("omc"), content_hash)


@settings(max_examples=30)
@given(st.lists(st.text(), max_size=5))
def test_any_texts_are_read_as_answers(texts: list[str]) -> None:
    printed = "".join(f"true\n{omc.quoted(text)}\n" for text in texts)
    assert [one.messages for one in omc.read_answers(printed)[0]] == texts


@pytest.mark.skipif(not RECORDED.is_dir(), reason="no recorded answers of OpenModelica beside the corpus")
@pytest.mark.parametrize("name", sorted(one.name for one in RECORDED.glob("*/")) if RECORDED.is_dir() else ["none"])
def test_recorded_answers_are_understood(name: str) -> None:
    """Each fault is told once, where the user made it."""
    folder = RECORDED / name
    if not (folder / "stdout").is_file():
        pytest.skip("nothing was recorded there")
    answers, rest = omc.read_answers((folder / "stdout").read_text(encoding="utf-8"))
    assert rest.strip() == ""
    assert len(answers) == (folder / "script.mos").read_text().count("getErrorString")
    found = [
        one for answer in answers[-1:] for one in omc.complaints(answer.messages) if one.code != "compiler-warning"
    ]
    edit = folder / "edit.txt"
    expected = {"unknown-class": 1, "unknown-name": 1, "unknown-modifier": 1, "wrong-type": 1, "units": 1}
    if name in expected:
        assert len(found) == expected[name]
        assert found[0].file.endswith(edit.read_text().splitlines()[0])


def answer_of(name: str, folder: Path) -> str:
    """What OpenModelica answered to the last call of a conversation that was recorded for these tests."""
    text = (Path(__file__).parent / "omc" / name / "stdout").read_text(encoding="utf-8")
    return text.replace("FOLDER", str(folder)).split('true\n""\n')[-1]


def test_recorded_exports_are_understood(ask: Ask, tmp_path: Path) -> None:
    (tmp_path / "P.fmu").write_bytes(b"an archive")
    task = CompileTask("P", "model P end P;", export=BOTH_KINDS, title="P")
    (result,) = ask({"buildModelFMU": answer_of("fmu", tmp_path)}, task)
    assert (result.problem, result.fmu) == ("", b"an archive")
    (result,) = ask({"buildModelFMU": answer_of("fmu-unbalanced", tmp_path)}, task)
    assert result.problem.startswith("Error: Too few equations, under-determined system.")


@pytest.mark.slow
def test_recorded_ends_of_simulations_are_understood(ask: Ask, tmp_path: Path) -> None:
    task = CompileTask("S", "model S end S;", (Simulation(1, 1),), ("x",), title="S")
    (result,) = ask({"simulate": answer_of("assertion", tmp_path)}, task)
    assert result.runs[0].problem == f"assert failed at t=0.600000: the elbow breaks ({tmp_path}/s.mo:5)"
    write_trajectory(tmp_path / "T_res.mat", {}, {"time": (0.0, 0.7), "x": (1.0, 0.3)})
    (result,) = ask({"simulate": answer_of("terminate", tmp_path)}, task)
    assert result.runs[0].termination == "the end is reached"


@pytest.mark.slow
@pytest.mark.skipif(omc.program("") is None, reason="no OpenModelica")
def test_a_real_omc_compiles_and_simulates(tmp_path: Path) -> None:
    text = "model Probe_\n  Real x(start = 1, fixed = true);\nequation\n  der(x) = -x;\nend Probe_;\n"
    tasks = (
        CompileTask("Probe_", text, (Simulation(1, 0.5),), ("x",)),
        compile_task("Modelica.Blocks.Examples.PID_Controller", ["Modelica"]),
    )
    simulated, compiled = run_job(
        Tool("omc"), CompileJob((), tasks), UserCache(tmp_path), Limits("the check", 300, 4e9)
    )
    assert simulated.runs[0].values["x"][-1] == pytest.approx(0.36787944, abs=1e-6)
    assert (compiled.problem, compiled.unknowns > 0) == ("", True)
