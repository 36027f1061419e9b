"""OpenModelica: what it is told, what its answers mean, and its absence. With a real `omc` only where there is one."""

from __future__ import annotations

import importlib.util
import json
import shutil
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import fake_omc
from support.modelica import URDFSYNC

from urdfsync.checking import process
from urdfsync.checking.compilers import omc, omc_worker
from urdfsync.checking.compilers.compiler import CompilerError
from urdfsync.checking.compilers.omc import NOT_SIMULATED, OpenModelica
from urdfsync.checking.compilers.tasks import Job, Outcome, Simulation, Task, compiling
from urdfsync.checking.diagnosis.complaints import Kind, complaints
from urdfsync.checking.process import Limits

TASK = Task("Probe_", 'model Probe_ "a \\ b"\nend Probe_;\n')
BALANCED = '"Check of Probe_ completed successfully.\nClass Probe_ has 4 equation(s) and 4 variable(s).\n1 of these."\n'
NO_MESSAGES = '""\n'
LOST = '[/ws/Arm/Joints/Elbow.mo:76:3-76:35:writable] Error: Variable orgin.frame_a not found in scope \\"Arm\\".\n'

needs_library = pytest.mark.skipif(importlib.util.find_spec("OMPython") is None, reason="no OMPython")
needs_scripts = pytest.mark.skipif(sys.platform == "win32", reason="the stand-in for omc is a script")
needs_omc = pytest.mark.skipif(shutil.which("omc") is None, reason="no omc on the PATH")


# --- what omc is told -------------------------------------------------------------------------------------------------


def test_packages_are_loaded_before_what_rests_on_them(tmp_path: Path) -> None:
    library, robot = tmp_path / "library", tmp_path / "Arm"
    for name in ("Modelica 4.1.0", "ModelicaServices 4.1.0", "Resources"):
        (library / name).mkdir(parents=True)
    robot.mkdir()
    files = [library / "Complex 4.1.0.mo", *(library / f"{name} 4.1.0" / "package.mo" for name in omc._FIRST[:0:-1])]
    for file in (*files, robot / "package.mo"):
        file.touch()
    expected = [files[0], files[2], files[1], robot / "package.mo"]
    assert omc.packages([str(robot), str(library)]) == expected
    assert omc.packages([str(robot), str(files[0])]) == [files[0], robot / "package.mo"]


def test_a_call_asks_for_its_messages_in_the_same_breath() -> None:
    assert omc.loading(Path("/x/A b/package.mo")) == 'loadFile("/x/A b/package.mo", uses=false); getErrorString()'
    load, check = omc.checking(TASK)
    assert load == 'loadString("model Probe_ \\"a \\\\ b\\"\nend Probe_;\n", uses=false); getErrorString()'
    assert check == "checkModel(Probe_); getErrorString()"


@given(st.lists(st.text()))
def test_texts_survive_being_quoted(texts: list[str]) -> None:
    assert omc.strings("\n".join(map(omc.quoted, texts))) == texts


# --- what omc says ----------------------------------------------------------------------------------------------------


def test_a_balanced_model_compiles() -> None:
    assert omc.outcome(BALANCED + NO_MESSAGES, TASK) == Outcome(unknowns=4)
    warning = '"[/x/a.mo:1:1-2:2:writable] Warning: Something is odd.\n"\n'
    assert omc.outcome(BALANCED + warning, TASK) == Outcome(unknowns=4)


def test_an_unbalanced_model_is_a_problem() -> None:
    found = omc.outcome(BALANCED.replace("4 variable", "5 variable") + NO_MESSAGES, TASK)
    (complaint,) = complaints(found.problem)
    assert (complaint.kind, complaint.equations, complaint.unknowns) == (Kind.BALANCE, 4, 5)


def test_errors_keep_their_places() -> None:
    found = omc.outcome(f'""\n"{LOST}Error: Error occurred while flattening model Probe_\n"\n', TASK)
    first, second = complaints(found.problem)
    assert (first.file, first.line, first.column) == ("/ws/Arm/Joints/Elbow.mo", 76, 3)
    assert first.words == 'Variable orgin.frame_a not found in scope "Arm".'
    assert second.words == "Error occurred while flattening model Probe_"


@pytest.mark.parametrize("answer", ["", "\n", '""\n""\n', "false\n"])
def test_an_answer_that_says_nothing_is_no_success(answer: str) -> None:
    assert omc.outcome(answer, TASK).problem
    assert omc.loaded(answer)


def test_what_was_loaded_is_there() -> None:
    assert omc.loaded("true\n" + NO_MESSAGES) == ""
    assert omc.loaded('true\n"Notification: Modelica 4.0.0 was loaded"\n') == ""
    assert omc.loaded('false\n"Error: no such file"\n') == "Error: no such file"


def test_a_simulation_is_refused() -> None:
    task = Task("Probe_", "", (Simulation(1, 0.1),))
    (run,) = omc.outcome(BALANCED + NO_MESSAGES, task).runs
    assert run.problem == NOT_SIMULATED


# --- a session --------------------------------------------------------------------------------------------------------


def test_a_library_that_can_not_be_loaded_is_the_problem_of_every_task(tmp_path: Path) -> None:
    (tmp_path / "package.mo").touch()
    job = Job((str(tmp_path),), (TASK, TASK))

    def ask(expression: str) -> str:
        return 'false\n"Error: parse error"\n' if expression.startswith("loadFile") else "true\n"

    assert [one.problem for one in omc_worker.outcomes(ask, job)] == ["Error: parse error"] * 2


def test_tasks_after_one_that_fails_are_done() -> None:
    answers = iter(["/tmp\n", "true\n", BALANCED, 'false\n"Error: text"\n', "true\n", BALANCED])
    found = list(omc_worker.outcomes(lambda expression: next(answers), Job((), (TASK, TASK, TASK))))
    assert [(one.problem, one.unknowns) for one in found] == [("", 4), ("Error: text", 0), ("", 4)]


def test_a_refusal_is_a_problem() -> None:
    def ask(expression: str) -> str:
        if "checkModel" in expression:
            raise omc_worker.RefusedError("OMC error occurred")
        return "true\n"

    assert [one.problem for one in omc_worker.outcomes(ask, Job((), (TASK,)))] == ["OMC error occurred"]


@pytest.fixture
def fake(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with an `omc` that answers from `answers.json`, first on the PATH."""
    folder = tmp_path / "home" / "bin"
    folder.mkdir(parents=True)
    script = folder / "omc"
    script.write_text(f"#!{sys.executable}\n{Path(fake_omc.__file__).read_text()}")
    script.chmod(0o755)
    monkeypatch.setenv("PATH", str(folder), prepend=":")
    monkeypatch.delenv("OPENMODELICAHOME", raising=False)
    return folder


@needs_library
@needs_scripts
def test_the_client_library_carries_questions_and_answers(fake: Path, tmp_path: Path) -> None:
    failed = f'""\n"{LOST}"\n'
    (fake / "answers.json").write_text(
        json.dumps({"checkModel(Good": BALANCED + NO_MESSAGES, "checkModel(Bad": failed})
    )
    (tmp_path / "package.mo").touch()
    told: list[int] = []
    job = Job((str(tmp_path),), (Task("Good", "model Good\nend Good;"), Task("Bad", "model Bad\nend Bad;")))
    good, bad = OpenModelica().compile(job, Limits(120), lambda number, outcome: told.append(number))
    assert told == [0, 1]
    assert (good.problem, good.unknowns) == ("", 4)
    assert bad.problem.startswith("[/ws/Arm/Joints/Elbow.mo:76:3-76:35:writable] Error: Variable")
    asked = (fake / "asked.txt").read_text()
    assert f'loadFile("{tmp_path}/package.mo", uses=false); getErrorString()' in asked


@needs_library
@needs_scripts
def test_an_omc_that_does_not_start_is_one_clear_line(fake: Path) -> None:
    (fake / "omc").write_text("no program")
    with pytest.raises(CompilerError, match="OpenModelica does not start"):
        OpenModelica().compile(Job((), (TASK,)), Limits(120))


@pytest.mark.parametrize("name", ["OMPython", "psutil"])
def test_a_missing_library_is_one_clear_line(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    known = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda one: None if one == name else known(one))
    with pytest.raises(CompilerError) as caught:
        OpenModelica().compile(Job((), (TASK,)), Limits())
    assert str(caught.value).startswith(f"error: there is no compiler: {name} is not installed; install OpenModelica")


@needs_library
def test_a_missing_omc_is_one_clear_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("OPENMODELICAHOME", raising=False)
    with pytest.raises(CompilerError, match="`omc` is not on the PATH; install OpenModelica"):
        OpenModelica().compile(Job((), (TASK,)), Limits())


@pytest.mark.parametrize(
    ("ending", "code"),
    [
        (process.Ending.OUT_OF_TIME, "compiler-out-of-time"),
        (process.Ending.OUT_OF_MEMORY, "compiler-out-of-memory"),
        (process.Ending.CRASHED, "compiler-crashed"),
    ],
)
def test_limits_and_crashes_name_the_model(ending: process.Ending, code: str, monkeypatch: pytest.MonkeyPatch) -> None:
    result = process.Result(ending, 11, 10**9, "last words", 1.0)
    monkeypatch.setattr(omc, "require", lambda: None)
    monkeypatch.setattr(process, "run", lambda *arguments, **more: result)
    with pytest.raises(CompilerError) as caught:
        OpenModelica().compile(Job((), (compiling("Arm.ArmRun"),)), Limits(5, 2e9))
    (found,) = caught.value.diagnostics
    assert found.code == code
    assert "Arm.ArmRun" in found.message


@needs_library
@needs_omc
@pytest.mark.slow
def test_a_real_omc_compiles_the_double_pendulum(modelica_library: Path) -> None:
    job = Job((str(modelica_library), str(URDFSYNC)), (compiling("UrdfSync.Examples.DoublePendulum"),))
    (outcome,) = OpenModelica().compile(job, Limits(600))
    assert outcome.problem == ""
    assert outcome.unknowns > 0
