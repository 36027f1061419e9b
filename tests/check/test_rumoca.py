"""The embedded compiler in its process: results, and what is said when it fails."""

from __future__ import annotations

import math
import subprocess
import sys
from pathlib import Path

import pytest

from urdfsync import processes
from urdfsync.check.cache import UserCache
from urdfsync.check.compilers import MISSING, require, run_job
from urdfsync.check.compilers.compiler import CompileJob, CompilerError, CompileResult, CompileTask, Simulation
from urdfsync.diagnostics import Diagnostic

DECAY = """
model M
  parameter Real k = 1;
  Real x(start = 1, fixed = true);
  Real y[3, 3];
equation
  der(x) = -k*x;
  for i in 1:3 loop
    for j in 1:3 loop
      y[i, j] = k*x;
    end for;
  end for;%s
end M;
"""
GOOD = CompileTask("M", "model M\n  Real x = time;\nend M;", (Simulation(1.0, 0.5),), ("x",), title="Plant.Good")
BAD = CompileTask("M", "model M\n  Real x;\nend M;")


def decay(*runs: Simulation, values: tuple[str, ...] = ("x", "y[2,3]")) -> CompileTask:
    return CompileTask("M", DECAY % "", runs, values)


def results(tmp_path: Path, *tasks: CompileTask, roots: tuple[str, ...] = ()) -> list[CompileResult]:
    return run_job("rumoca", CompileJob(roots, tasks), UserCache(tmp_path / "cache"))


def failure(tmp_path: Path, *tasks: CompileTask) -> Diagnostic:
    """What is said."""
    with pytest.raises(CompilerError) as caught:
        run_job("rumoca", CompileJob((), tasks), UserCache(tmp_path / "cache"))
    (diagnostic,) = caught.value.diagnostics
    return diagnostic


def fake_worker(monkeypatch: pytest.MonkeyPatch, program: str) -> None:
    """Instead of the worker, a program that hands out one good result and then goes its own way."""
    said = "import sys; sys.stdin.readline(); print('{\"unknowns\": 7}', flush=True); "
    monkeypatch.setattr(processes, "python_module", lambda *_: [sys.executable, "-c", said + program])


def test_models_are_compiled_counted_and_simulated(tmp_path: Path) -> None:
    runs = (Simulation(1.0, 0.25), Simulation(1.0, 0.25, {"k": 2.0}, tolerance=1e-10))
    found, unbalanced = results(tmp_path, decay(*runs), CompileTask("M", DECAY % "\n  x = 1;"))
    assert (found.problem, found.unknowns, found.states) == ("", 10, 1)
    for run, k, error in zip(found.runs, (1.0, 2.0), (1e-4, 1e-8), strict=True):
        assert list(run.values) == ["time", "x", "y[2,3]"]
        assert (run.values["time"][0], run.values["time"][-1]) == (0.0, 1.0)
        assert run.values["x"][-1] == pytest.approx(math.exp(-k), rel=error)
        assert run.values["y[2,3]"][0] == k
    assert f"{found.unknowns + 1} equations, {found.unknowns} unknowns" in unbalanced.problem, "as the compiler counts"


def test_a_model_that_does_not_compile_is_a_result_and_the_next_one_follows(tmp_path: Path) -> None:
    sources = ["model M\n  Real x;\nend M;", "model M\n  Absent a;\nend M;", "model M\n  Real\nend M;"]
    found = results(tmp_path, *(CompileTask("M", source) for source in sources), decay())
    assert "unbalanced model: 0 equations, 1 unknowns" in found[0].problem
    assert "Absent" in found[1].problem
    assert [bool(one.problem) for one in found] == [True, True, True, False]


def test_a_run_that_fails_says_why(tmp_path: Path) -> None:
    infinite = "model M\n  Real x;\nequation\n  x = if time > 0.45 then 1e308*(10 + time) else 1;\nend M;"
    found = results(
        tmp_path,
        decay(Simulation(1.0, 0.5, {"absent": 1.0}), values=("x",)),
        decay(Simulation(1.0, 0.5), values=("absent",)),
        CompileTask("M", DECAY % '\n  assert(x > 0.5, "too small");', (Simulation(1.0, 0.1),)),
        CompileTask("M", infinite, (Simulation(1.0, 0.5),), ("x",)),
    )
    problems = [one.runs[0].problem for one in found]
    assert 'unknown parameter "absent"' in problems[0]
    assert 'unknown variable "absent"' in problems[1]
    assert "too small" in problems[2]
    assert problems[3] == "non-finite (inf) value computed for `x`", "without places inside the compiler"


def test_the_search_path_of_the_user_has_no_say(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "Pumps.mo").write_text("package Pumps\n  model P\n  end P;\nend Pumps;\n")
    monkeypatch.setenv("MODELICAPATH", str(tmp_path))
    task = CompileTask("M", "model M\n  import Pumps;\n  Pumps.P p;\nend M;")
    (without,), (given,) = results(tmp_path, task), results(tmp_path, task, roots=(str(tmp_path / "Pumps.mo"),))
    assert "Pumps" in without.problem
    assert given.problem == ""


@pytest.mark.skipif(sys.platform == "win32", reason="no such signals")
@pytest.mark.parametrize(("signal", "hint"), [("SIGSEGV", "report it"), ("SIGKILL", "want of memory")])
def test_a_crash_is_one_line(signal: str, hint: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    words = "sys.stderr.write('a\\nlast words\\n'); sys.stderr.flush()"
    fake_worker(monkeypatch, f"import os, signal; {words}; os.kill(os.getpid(), signal.{signal})")
    diagnostic = failure(tmp_path, BAD, GOOD)
    assert diagnostic.code == "compiler-crashed"
    assert diagnostic.message.startswith("the compiler broke down at Plant.Good: signal ")
    assert diagnostic.message.endswith(f"({signal}): last words")
    assert hint in diagnostic.hint


@pytest.mark.parametrize(("program", "code", "words"), [
    ("", "compiler-crashed", "at Plant.Good: exit code 0"),
    (f"sys.stderr.write('no such wheel'); sys.exit({MISSING})", "no-compiler", "no such wheel"),
])  # fmt: skip
def test_a_worker_that_answers_too_little_is_explained(
    program: str, code: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    fake_worker(monkeypatch, program)
    diagnostic = failure(tmp_path, BAD, GOOD)
    assert diagnostic.code == code
    assert words in diagnostic.message


def test_each_compiler_needs_its_own_only(monkeypatch: pytest.MonkeyPatch) -> None:
    absent = "rumoca"
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name == absent else name)
    monkeypatch.setattr("shutil.which", lambda name: name)
    require("omc")
    with pytest.raises(CompilerError, match="rumoca is not installed; pip install rumoca"):
        require("rumoca")
    absent = "OMPython"
    require("rumoca")
    with pytest.raises(CompilerError, match="OMPython is not installed"):
        require("omc")


def test_a_worker_ends_with_whoever_started_it_and_prints_only_answers(tmp_path: Path) -> None:
    program = (
        "import os; from urdfsync.processes import *; answers = reserve_stdout(); os.write(1, b'noise');"
        "end_with_parent(); answers.write(b'answer'); answers.flush(); import time; time.sleep(60)"
    )
    command = [sys.executable, "-c", program]
    done = subprocess.run(
        command, input=b"", capture_output=True, timeout=50, check=False, env=processes.importable() or None
    )
    assert (done.returncode, done.stdout, done.stderr) == (1, b"answer", b"noise")
