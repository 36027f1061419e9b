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

from urdfsync.check.cache import UserCache
from urdfsync.check.compilers import omc, run_job
from urdfsync.check.compilers.compiler import (
    CompileJob,
    CompilerError,
    CompileResult,
    CompileTask,
    Simulation,
    compile_task,
)
from urdfsync.check.errors import explain
from urdfsync.check.package import PackageFiles

TASK = CompileTask("Probe_", 'model Probe_ "a \\ b"\nend Probe_;\n')
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
    assert omc.package_files([str(robot), str(library)]) == expected
    assert omc.package_files([str(robot), str(files[0])]) == [files[0], robot / "package.mo"]


def test_a_call_asks_for_its_messages_in_the_same_breath() -> None:
    assert (
        omc.load_expression(Path("/x/A b/package.mo")) == 'loadFile("/x/A b/package.mo", uses=false); getErrorString()'
    )
    load, check = omc.check_expressions(TASK)
    assert load == 'loadString("model Probe_ \\"a \\\\ b\\"\nend Probe_;\n", uses=false); getErrorString()'
    assert check == "checkModel(Probe_); getErrorString()"


@given(st.lists(st.text()))
def test_texts_survive_being_quoted(texts: list[str]) -> None:
    assert omc.strings("\n".join(map(omc.quoted, texts))) == texts


# --- what omc says ----------------------------------------------------------------------------------------------------


def test_a_balanced_model_compiles() -> None:
    assert omc.check_result(BALANCED + NO_MESSAGES, TASK) == CompileResult(unknowns=4)
    warning = '"[/x/a.mo:1:1-2:2:writable] Warning: Something is odd.\n"\n'
    assert omc.check_result(BALANCED + warning, TASK) == CompileResult(unknowns=4)


def test_an_unbalanced_model_is_a_problem() -> None:
    found = omc.check_result(BALANCED.replace("4 variable", "5 variable") + NO_MESSAGES, TASK)
    assert found.problem == "unbalanced model: 4 equations, 5 unknowns"


def test_errors_keep_their_places() -> None:
    found = omc.check_result(f'""\n"{LOST}Error: Error occurred while flattening model Probe_\n"\n', TASK)
    package = PackageFiles("Arm", Path("/robots/Arm"), {})
    (first,) = explain(found.problem, omc.complaints(found.problem), package, {Path("/ws/Arm"): package.folder})
    assert (Path(first.file), first.line, first.column) == (Path("/robots/Arm/Joints/Elbow.mo"), 76, 3)
    assert first.message == 'Variable orgin.frame_a not found in scope "Arm"'


@pytest.mark.parametrize("answer", ["", "\n", '""\n""\n', "false\n"])
def test_an_answer_that_says_nothing_is_no_success(answer: str) -> None:
    assert omc.check_result(answer, TASK).problem
    assert omc.load_problem(answer)


def test_what_was_loaded_is_there() -> None:
    assert omc.load_problem("true\n" + NO_MESSAGES) == ""
    assert omc.load_problem('true\n"Notification: Modelica 4.0.0 was loaded"\n') == ""
    assert omc.load_problem('false\n"Error: no such file"\n') == "Error: no such file"


def test_a_simulation_is_refused() -> None:
    task = CompileTask("Probe_", "", (Simulation(1, 0.1),))
    (run,) = omc.check_result(BALANCED + NO_MESSAGES, task).runs
    assert run.problem == "OpenModelica only compiles here"


# --- a session --------------------------------------------------------------------------------------------------------


def test_a_library_that_can_not_be_loaded_is_the_problem_of_every_task(tmp_path: Path) -> None:
    (tmp_path / "package.mo").touch()
    job = CompileJob((str(tmp_path),), (TASK, TASK))

    def ask(expression: str) -> str:
        return 'false\n"Error: parse error"\n' if expression.startswith("loadFile") else "true\n"

    assert [one.problem for one in omc.results(ask, job)] == ["Error: parse error"] * 2


def test_tasks_after_one_that_fails_are_done() -> None:
    answers = iter(["/tmp\n", "true\n", BALANCED, 'false\n"Error: text"\n', "true\n", BALANCED])
    found = list(omc.results(lambda expression: next(answers), CompileJob((), (TASK, TASK, TASK))))
    assert [(one.problem, one.unknowns) for one in found] == [("", 4), ("Error: text", 0), ("", 4)]


def test_a_refusal_is_a_problem() -> None:
    def ask(expression: str) -> str:
        if "checkModel" in expression:
            raise omc.RefusedError("OMC error occurred")
        return "true\n"

    assert [one.problem for one in omc.results(ask, CompileJob((), (TASK,)))] == ["OMC error occurred"]


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
    tasks = (CompileTask("Good", "model Good\nend Good;"), CompileTask("Bad", "model Bad\nend Bad;"))
    good, bad = run_job("omc", CompileJob((str(tmp_path),), tasks), UserCache(tmp_path / "cache"))
    assert (good.problem, good.unknowns) == ("", 4)
    assert bad.problem.startswith("[/ws/Arm/Joints/Elbow.mo:76:3-76:35:writable] Error: Variable")
    asked = (fake / "asked.txt").read_text()
    assert f'loadFile("{tmp_path}/package.mo", uses=false); getErrorString()' in asked


@needs_library
@needs_scripts
def test_an_omc_that_does_not_start_is_one_clear_line(fake: Path, tmp_path: Path) -> None:
    (fake / "omc").write_text("no program")
    with pytest.raises(CompilerError, match="OpenModelica does not start"):
        list(run_job("omc", CompileJob((), (TASK,)), UserCache(tmp_path / "cache")))


@needs_library
def test_a_missing_omc_is_one_clear_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("OPENMODELICAHOME", raising=False)
    with pytest.raises(CompilerError, match="`omc` is not on the PATH; install OpenModelica"):
        list(run_job("omc", CompileJob((), (TASK,)), UserCache(tmp_path / "cache")))


@needs_library
@needs_omc
@pytest.mark.slow
def test_a_real_omc_compiles_the_double_pendulum(modelica_library: Path, tmp_path: Path) -> None:
    job = CompileJob((str(modelica_library), str(URDFSYNC)), (compile_task("UrdfSync.Examples.DoublePendulum"),))
    (result,) = run_job("omc", job, UserCache(tmp_path / "cache"))
    assert result.problem == ""
    assert result.unknowns > 0
