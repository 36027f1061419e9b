"""The process around the compiler, with models that need no library."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

from urdfsync.checking import process
from urdfsync.checking.compilers import worker
from urdfsync.checking.compilers.compiler import MISSING
from urdfsync.checking.compilers.tasks import Job, Outcome, Series, Simulation, Task
from urdfsync.checking.process import Ending, Result

DECAY = """
model M
  Real x(start = 1, fixed = true);
  Real y[2, 3];
  parameter Real k = 1;
  discrete Real d(start = 0);
  Integer n;
  output Real z;
equation
  der(x) = -k*x;
  y = {{x, x, x}, {x, x, k*x}};
  when time > 0.5 then
    d = time;
  end when;
  n = 3;
  z = 2*x;%s
end M;
"""


def work(*tasks: Task, roots: tuple[str, ...] = (), **environment: str) -> tuple[Result, list[Outcome]]:
    """What comes of tasks, and of the process."""
    lines: list[str] = []
    text = msgspec.json.encode(Job(roots, tasks)).decode() + "\n"
    command = process.python("urdfsync.checking.compilers.worker")
    result = process.run(command, text, lines.append, environment=process.importable() | environment)
    return result, [msgspec.json.decode(line, type=Outcome) for line in lines]


def decay(*runs: Simulation, values: tuple[str, ...] = ("x", "y[2,3]")) -> Task:
    return Task("M", DECAY % "", runs, values)


def test_a_finer_tolerance_gives_a_finer_result() -> None:
    _, (outcome,) = work(decay(*(Simulation(1.0, 1.0, tolerance=tolerance) for tolerance in (1e-3, 1e-10))))
    coarse, fine = (abs(run.values["x"][-1] - math.exp(-1)) for run in outcome.runs)
    assert fine < 1e-9 < coarse


def test_a_model_is_compiled_counted_and_simulated() -> None:
    result, (outcome,) = work(decay(Simulation(1.0, 0.25), Simulation(1.0, 0.25, {"k": 2.0})))
    assert result.good
    assert outcome.problem == ""
    assert (outcome.unknowns, outcome.states) == (10, 1)
    assert outcome.megabytes > 1
    for run, k in zip(outcome.runs, (1.0, 2.0), strict=True):
        assert run.problem == ""
        assert list(run.values) == ["time", "x", "y[2,3]"]
        assert run.values["time"][:2] == (0.0, 0.25)
        assert run.values["time"][-1] == 1.0
        assert run.values["x"][-1] == pytest.approx(math.exp(-k), rel=1e-4)
        assert run.values["y[2,3]"][0] == k


def test_unknowns_are_counted_as_the_compiler_counts_them() -> None:
    balanced, unbalanced = Task("M", DECAY % ""), Task("M", DECAY % "\n  x = 1;")
    _, (first, second) = work(balanced, unbalanced)
    assert f"{first.unknowns + 1} equations, {first.unknowns} unknowns" in second.problem


def test_a_model_that_does_not_compile_is_an_outcome_and_the_next_one_follows() -> None:
    result, outcomes = work(
        Task("M", "model M\n  Real x;\nend M;"),
        Task("M", "model M\n  Absent a;\nend M;"),
        Task("M", "model M\n  Real\nend M;"),
        Task("Other", "model M end M;"),
        decay(),
    )
    assert result.good
    problems = [outcome.problem for outcome in outcomes]
    assert "unbalanced model: 0 equations, 1 unknowns" in problems[0]
    assert "Absent" in problems[1]
    assert all(problems[:4])
    assert not problems[4]


@pytest.mark.parametrize(
    ("run", "values", "words"),
    [
        (Simulation(1.0, 0.5, {"absent": 1.0}), ("x",), 'unknown parameter "absent"'),
        (Simulation(1.0, 0.5), ("absent",), 'unknown variable "absent"'),
    ],
)
def test_a_run_that_fails_says_why(run: Simulation, values: tuple[str, ...], words: str) -> None:
    _, (outcome,) = work(decay(run, Simulation(1.0, 0.5, {"k": 1.0}), values=values))
    assert outcome.problem == ""
    assert words in outcome.runs[0].problem


def test_an_assertion_that_fails_is_a_problem_of_the_run() -> None:
    source = DECAY % '\n  assert(x > 0.5, "too small");'
    _, (outcome,) = work(Task("M", source, (Simulation(1.0, 0.1),)))
    assert "too small" in outcome.runs[0].problem


def test_what_is_no_number_is_a_problem_of_the_run() -> None:
    source = "model M\n  Real x;\nequation\n  x = if time > 0.45 then 1e308*(10 + time) else 1;\nend M;"
    _, (outcome,) = work(Task("M", source, (Simulation(1.0, 0.5),), ("x",)))
    assert outcome.runs[0].problem == "non-finite (inf) value computed for `x`", "without places inside the compiler"


def test_a_series_holds_numbers_only() -> None:
    """JSON knows no others; this compiler finds them itself, another version may not."""

    class Result(dict[str, Any]):
        time = np.array([0.0, 0.5])

    class Model:
        def simulate(self, *_: object, **__: object) -> Result:
            return Result(x=np.array([1.0, 2.0]), y=np.array([1.0, np.nan]))

    model: Any = Model()
    series = worker._run(model, Simulation(0.5, 0.5), ("x", "y"))
    assert series == Series(problem="y is not finite at 0.5 s")


def test_what_native_code_prints_is_no_answer() -> None:
    program = (
        "import os, sys; from urdfsync.checking.compilers import worker; answers = worker._reserve_stdout(); "
        "os.write(1, b'noise'); answers.write(b'answer'); answers.flush()"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, check=True)
    assert (done.stdout, done.stderr) == (b"answer", b"noise")


def test_without_a_compiler_it_ends_with_a_code_of_its_own(tmp_path: Path) -> None:
    (tmp_path / "rumoca.py").write_text("raise ImportError('no such wheel')\n")
    path = f"{tmp_path}{os.pathsep}{process.importable().get('PYTHONPATH', '')}"
    result, outcomes = work(decay(), PYTHONPATH=path)
    assert (result.ending, result.code, outcomes) == (Ending.EXITED, MISSING, [])
    assert "no such wheel" in result.words
