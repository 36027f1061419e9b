"""The embedded compiler in its process: results, and what is said when it fails."""

from __future__ import annotations

import math
import sys
from pathlib import Path

import pytest

from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.compilers import find_missing, run_job, state
from urdfsync.analysis.checks.compilers.compiler import CompileJob, CompileResult, CompileTask, Simulation, Tool
from urdfsync.analysis.checks.compilers.rumoca import METHODS
from urdfsync.analysis.checks.contents import content_hash
from urdfsync.analysis.checks.process import Limits

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


def decay(*runs: Simulation, values: tuple[str, ...] = ("x", "y[2,3]")) -> CompileTask:
    return CompileTask("M", DECAY % "", runs, values)


def results(tmp_path: Path, *tasks: CompileTask, roots: tuple[str, ...] = ()) -> list[CompileResult]:
    return run_job(
        Tool("rumoca"), CompileJob(roots, tasks), UserCache(tmp_path / "cache"), Limits("the check", 60, 4e9)
    )


def test_another_rumoca_is_another_state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its version alone does not tell."""
    module = tmp_path / "rumoca/__init__.py"
    module.parent.mkdir()
    module.write_text("")
    monkeypatch.delitem(sys.modules, "rumoca", raising=False)
    monkeypatch.syspath_prepend(tmp_path)
    before = state(Tool("rumoca"), content_hash)
    module.write_text("# built anew\n")
    assert state(Tool("rumoca"), content_hash) != before


def test_models_are_compiled_counted_and_simulated(tmp_path: Path) -> None:
    runs = (Simulation(1.0, 0.25), Simulation(1.0, 0.25, {"k": 2.0}, tolerance=1e-10))
    found, unbalanced = results(tmp_path, decay(*runs), CompileTask("M", DECAY % "\n  x = 1;"))
    assert (found.problem, found.unknowns) == ("", 10)
    for run, k, error in zip(found.runs, (1.0, 2.0), (1e-4, 1e-8), strict=True):
        assert list(run.values) == ["time", "x", "y[2,3]"]
        assert (run.values["time"][0], run.values["time"][-1]) == (0.0, 1.0)
        assert run.values["x"][-1] == pytest.approx(math.exp(-k), rel=error)
        assert run.values["y[2,3]"][0] == k
    assert f"{found.unknowns + 1} equations, {found.unknowns} unknowns" in unbalanced.problem, "as the compiler counts"


PARTS = """
package M
  record Numbers
    Real gain = 2;
    Real idle = 3;
  end Numbers;
  model Part
    parameter Numbers numbers;
    Real x(start = 0, fixed = true);
  equation
    der(x) = numbers.gain;
  end Part;
  model Whole
    parameter Numbers numbers;
    parameter Integer size = 2;
    Part first(numbers = numbers), second[size];
    Real y = first.x + second[1].x;
  end Whole;
  model Top
    extends Whole(%s);
  end Top;
end M;
"""


def parts(*parameters: str, modifiers: str = "", method: str = "") -> CompileTask:
    pattern = r"y|(?:.*\.)?x|numbers\.gain"
    run = Simulation(1.0, 0.5, method=method)
    return CompileTask("M.Top", PARTS % modifiers, (run,), pattern=pattern, parameters=parameters)


def test_what_a_pattern_matches_comes_back(tmp_path: Path) -> None:
    results_of = results(tmp_path, *(parts(method=method) for method in METHODS))
    for (run,) in (one.runs for one in results_of):
        assert set(run.values) == {"time", "first.x", "second[1].x", "second[2].x", "y"}, (
            "nothing of the compiler's own"
        )
        assert run.values["y"][-1] == pytest.approx(4.0)
        assert run.parameters == {"numbers.gain": 2.0}


def test_a_parameter_that_is_set_has_to_be_there_and_to_have_an_effect(tmp_path: Path) -> None:
    right, structural, absent, idle = results(
        tmp_path,
        parts("numbers.gain", modifiers="numbers(gain = 5)"),
        parts("size", modifiers="size = 3"),
        parts("numbers.gian", modifiers="numbers(gian = 5)"),
        parts("numbers.idle", modifiers="numbers(idle = 5)"),
    )
    assert right.runs[0].values["first.x"][-1] == pytest.approx(5.0)
    assert "second[3].x" in structural.runs[0].values
    assert ("numbers.gain" in (absent.parameters or ()), absent.runs) == (True, ())
    assert (idle.without_effect, idle.runs) == (("numbers.idle",), ())


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


def test_each_compiler_needs_its_own_only(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("urdfsync.common.system.find_program", lambda name, *_, **__: None)
    missing = find_missing(Tool("omc"))
    assert find_missing(Tool("rumoca")) is None
    assert missing is not None
    assert "`omc` is not on the PATH" in missing.message
    monkeypatch.setattr("urdfsync.common.system.find_program", lambda name, *_, **__: name)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name == "rumoca" else name)
    missing = find_missing(Tool("rumoca"))
    assert find_missing(Tool("omc")) is None
    assert missing is not None
    assert "rumoca is not installed" in missing.message
