"""OpenModelica: what it is told, what its answers mean, and its absence. With a real `omc` only where there is one."""

from __future__ import annotations

import importlib.util
import json
import sys
import types
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import fake_omc

from urdfsync.check.cache import UserCache
from urdfsync.check.compilers import installed_version, omc, run_job
from urdfsync.check.compilers.compiler import (
    CompileJob,
    CompilerError,
    CompileResult,
    CompileTask,
    Simulation,
)
from urdfsync.check.process import Limits

TASK = CompileTask("Probe_", 'model Probe_ "a \\ b"\nend Probe_;\n', (Simulation(1, 0.1),))
BALANCED = '"Check of Probe_ completed successfully.\nClass Probe_ has 4 equation(s) and 4 variable(s).\n1 of these."\n'
LOST = '[/ws/Arm/Joints/Elbow.mo:76:3-76:35:writable] Error: Variable orgin.frame_a not found in scope \\"Arm\\".\n'
ODD = '"[/x/a.mo:1:1-2:2:writable] Warning: Something is odd.\n"\n'

needs_library = pytest.mark.skipif(importlib.util.find_spec("OMPython") is None, reason="no OMPython")
needs_scripts = pytest.mark.skipif(sys.platform == "win32", reason="the stand-in for omc is a script")


def work(
    answer: Callable[[str], str], job: CompileJob, monkeypatch: pytest.MonkeyPatch
) -> tuple[list[CompileResult], list[str]]:
    """The results of a job with a stand-in for the client library, and what that was asked."""
    asked: list[str] = []

    class RefusedError(Exception):
        pass

    class Session:
        def sendExpression(self, expression: str, parsed: bool) -> str:  # noqa: N802 - its name there
            asked.append(expression)
            if (found := answer(expression)) == "refuse":
                raise RefusedError("OMC error occurred")
            return found

    library = types.SimpleNamespace(OMCSessionLocal=Session, OMSessionException=RefusedError)
    monkeypatch.setitem(sys.modules, "OMPython", library)
    return list(omc.work(job)), asked


def test_packages_are_loaded_before_what_rests_on_them_each_call_with_its_messages(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    library, robot = tmp_path / "library", tmp_path / "A b"
    names = ("Complex 4.1.0.mo", "ModelicaServices 4.1.0/package.mo", "Modelica 4.1.0/package.mo")
    for file in (*(library / name for name in names), library / "Resources" / "text", robot / "package.mo"):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    job = CompileJob((str(robot), str(library)), (TASK,))
    (result,), asked = work(lambda call: BALANCED if call.startswith("check") else "true\n", job, monkeypatch)
    loads = [
        f'loadFile("{file.as_posix()}", uses=false)' for file in (*(library / n for n in names), robot / "package.mo")
    ]
    text = 'loadString("model Probe_ \\"a \\\\ b\\"\nend Probe_;\n", uses=false)'
    assert asked == [
        "cd(getTempDirectoryPath())",
        *(f"{call}; getErrorString()" for call in (*loads, text, "checkModel(Probe_)")),
    ]
    assert (result.problem, result.unknowns) == ("", 4)
    assert result.runs[0].problem == "OpenModelica only compiles here"


@given(st.lists(st.text()))
def test_texts_survive_being_quoted(texts: list[str]) -> None:
    assert omc.strings("\n".join(map(omc.quoted, texts))) == texts


@pytest.mark.parametrize(("load", "check", "problem"), [
    ("true\n" + ODD, BALANCED + ODD, ""),
    ("true\n", BALANCED.replace("4 variable", "5 variable"), "unbalanced model: 4 equations, 5 unknowns"),
    ("true\n", f'""\n"{LOST}Error: Error occurred while flattening\n"\n',
     LOST.replace("\\", "") + "Error: Error occurred while flattening"),
    ("true\n", "", "the model does not compile"),
    ("true\n", "false\n", "false"),
    ("true\n", "refuse", "OMC error occurred"),
    ('false\n"Error: text"\n', BALANCED, "Error: text"),
    ('""\n""\n', BALANCED, "OpenModelica can't load it and gives no reason"),
    ("refuse", BALANCED, "OMC error occurred"),
])  # fmt: skip
def test_every_answer_but_success_is_a_problem_of_its_task(
    load: str, check: str, problem: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    bad = CompileTask("Bad", "model Bad end Bad;")

    def answer(call: str) -> str:
        if "Bad" in call:
            return check if call.startswith("checkModel") else load
        return BALANCED if call.startswith("checkModel") else "true\n"

    results, _ = work(answer, CompileJob((), (TASK, bad, TASK)), monkeypatch)
    assert [one.problem for one in results] == ["", problem, ""]


def test_a_library_that_can_not_be_loaded_is_the_problem_of_every_task(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "package.mo").touch()
    for said, problem in (('false\n"Error: parse error"\n', "Error: parse error"), ("refuse", "OMC error occurred")):
        job = CompileJob((str(tmp_path),), (TASK, TASK))
        results, _ = work(lambda call, said=said: said if "loadFile" in call else "true\n", job, monkeypatch)  # type: ignore[misc]
        assert [one.problem for one in results] == [problem] * 2


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
    (fake / "answers.json").write_text(json.dumps({"checkModel(Good": BALANCED, "checkModel(Bad": failed}))
    (tmp_path / "package.mo").touch()
    tasks = (CompileTask("Good", "model Good\nend Good;"), CompileTask("Bad", "model Bad\nend Bad;"))
    good, bad = run_job(
        "omc", CompileJob((str(tmp_path),), tasks), UserCache(tmp_path / "cache"), Limits("the check", 60, 2e9)
    )
    assert (good.problem, good.unknowns) == ("", 4)
    assert bad.problem.startswith("[/ws/Arm/Joints/Elbow.mo:76:3-76:35:writable] Error: Variable")
    assert f'loadFile("{tmp_path}/package.mo", uses=false); getErrorString()' in (fake / "asked.txt").read_text()


@needs_library
@needs_scripts
def test_an_omc_that_does_not_start_or_is_not_there_is_one_clear_line(
    fake: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cache = UserCache(tmp_path / "cache")
    (fake / "omc").write_text("no program")
    with pytest.raises(CompilerError, match="OpenModelica does not start"):
        run_job("omc", CompileJob((), (TASK,)), cache, Limits("the check", 60, 2e9))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(CompilerError, match="`omc` is not on the PATH; install OpenModelica"):
        run_job("omc", CompileJob((), (TASK,)), cache, Limits("the check", 60, 2e9))


@needs_scripts
def test_another_omc_is_another_version(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """So that what one of them found right is not taken from the cache for the other."""
    program = tmp_path / "bin" / "omc"
    program.parent.mkdir()
    monkeypatch.setenv("OPENMODELICAHOME", str(tmp_path))
    found = [installed_version("omc")]
    for version in ("1.24", "1.25"):
        program.write_text(f"#!/bin/sh\necho OpenModelica {version}\n")
        program.chmod(0o755)
        found.append(installed_version("omc"))
    assert len(set(found)) == 3
