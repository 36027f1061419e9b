"""The embedded compiler behind its Protocol: outcomes, limits, and what is said when it fails."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest

from urdfsync.checking.cache import Cache
from urdfsync.checking.compilers.choice import require
from urdfsync.checking.compilers.compiler import MISSING, Compiler, CompilerError
from urdfsync.checking.compilers.rumoca import Rumoca
from urdfsync.checking.compilers.tasks import Job, Outcome, Simulation, Task, compiling
from urdfsync.checking.libraries import library, references, slim
from urdfsync.checking.process import UNLIMITED, Limits
from urdfsync.config import library_folder
from urdfsync.diagnostics import Diagnostic

GOOD = Task("M", "model M\n  Real x = time;\nend M;", (Simulation(1.0, 0.5),), ("x",), name="Plant.Good")
BAD = Task("M", "model M\n  Real x;\nend M;")


@pytest.fixture
def rumoca(tmp_path: Path) -> Compiler:
    return Rumoca(Cache(tmp_path / "cache"))


def failure(rumoca: Compiler, job: Job, limits: Limits = UNLIMITED) -> tuple[Diagnostic, tuple[Outcome, ...]]:
    """What is said, and what was found out before."""
    with pytest.raises(CompilerError) as caught:
        rumoca.compile(job, limits)
    (diagnostic,) = caught.value.diagnostics
    return diagnostic, caught.value.outcomes


def fake_worker(monkeypatch: pytest.MonkeyPatch, program: str) -> None:
    """Instead of the worker, a program that hands out one good outcome and then goes its own way."""
    said = "import sys; sys.stdin.readline(); print('{\"unknowns\": 7}', flush=True); "
    monkeypatch.setattr("urdfsync.checking.process.python", lambda module: [sys.executable, "-c", said + program])


def test_every_task_has_an_outcome_that_is_told_at_once(rumoca: Compiler) -> None:
    told: list[tuple[int, Outcome]] = []
    outcomes = rumoca.compile(Job((), (GOOD, BAD)), UNLIMITED, lambda number, outcome: told.append((number, outcome)))
    assert told == list(enumerate(outcomes))
    assert outcomes[0].runs[0].values["x"] == (0.0, 0.5, 1.0)
    assert "unbalanced" in outcomes[1].problem


def test_the_search_path_of_the_user_has_no_say(
    rumoca: Compiler, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "Pumps.mo").write_text("package Pumps\n  model P\n  end P;\nend Pumps;\n")
    monkeypatch.setenv("MODELICAPATH", str(tmp_path))
    task = Task("M", "model M\n  import Pumps;\n  Pumps.P p;\nend M;")
    (without,) = rumoca.compile(Job((), (task,)), UNLIMITED)
    (given,) = rumoca.compile(Job((str(tmp_path / "Pumps.mo"),), (task,)), UNLIMITED)
    assert "Pumps" in without.problem
    assert given.problem == ""


def test_a_compiler_that_takes_too_much_memory_is_ended(rumoca: Compiler, monkeypatch: pytest.MonkeyPatch) -> None:
    fake_worker(monkeypatch, "x = bytearray(b'x') * 300_000_000; sys.stdin.read()")
    diagnostic, outcomes = failure(rumoca, Job((), (BAD, GOOD)), Limits(60, 200e6))
    assert diagnostic.code == "compiler-out-of-memory"
    assert "GB at Plant.Good, more than the 0.2 GB that it may" in diagnostic.message
    assert "--memory" in diagnostic.hint
    assert outcomes == (Outcome(unknowns=7),)


def test_a_compiler_that_takes_too_long_is_ended(rumoca: Compiler, monkeypatch: pytest.MonkeyPatch) -> None:
    fake_worker(monkeypatch, "sys.stdin.read()")
    diagnostic, _ = failure(rumoca, Job((), (BAD, GOOD)), Limits(3.0))
    assert diagnostic.code == "compiler-out-of-time"
    assert diagnostic.message == "the compiler was not done after 3 s, at Plant.Good"
    assert "--timeout" in diagnostic.hint


@pytest.mark.skipif(sys.platform == "win32", reason="no such signals")
@pytest.mark.parametrize(("signal", "hint"), [("SIGSEGV", "report it"), ("SIGKILL", "want of memory")])
def test_a_crash_is_one_line(signal: str, hint: str, rumoca: Compiler, monkeypatch: pytest.MonkeyPatch) -> None:
    fake_worker(monkeypatch, f"import os, signal; sys.stderr.write('a\\nlast words\\n'); sys.stderr.flush(); "
                f"os.kill(os.getpid(), signal.{signal})")  # fmt: skip
    diagnostic, outcomes = failure(rumoca, Job((), (BAD, GOOD)))
    assert diagnostic.code == "compiler-crashed"
    assert diagnostic.message.startswith("the compiler broke down at Plant.Good: signal ")
    assert diagnostic.message.endswith(f"({signal}): last words")
    assert hint in diagnostic.hint
    assert len(outcomes) == 1


def test_a_worker_that_answers_too_little_has_broken_down(rumoca: Compiler, monkeypatch: pytest.MonkeyPatch) -> None:
    fake_worker(monkeypatch, "")
    diagnostic, _ = failure(rumoca, Job((), (BAD, GOOD)))
    assert "at Plant.Good: exit code 0" in diagnostic.message


def test_a_compiler_that_is_not_installed_is_named(rumoca: Compiler, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "rumoca", None)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name == "rumoca" else name)
    diagnostic, _ = failure(rumoca, Job((), (GOOD,)))
    assert (diagnostic.code, diagnostic.hint) == ("no-compiler", "pip install psutil rumoca")
    assert "rumoca is not installed" in diagnostic.message


def test_each_tool_needs_its_own_only(monkeypatch: pytest.MonkeyPatch) -> None:
    absent = "rumoca"
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name == absent else name)
    monkeypatch.setattr("shutil.which", lambda name: name)
    require("omc")
    with pytest.raises(CompilerError, match="rumoca is not installed"):
        require("rumoca")
    absent = "OMPython"
    require("rumoca")
    with pytest.raises(CompilerError, match="OMPython is not installed"):
        require("omc")


def test_one_that_can_not_be_loaded_too(rumoca: Compiler, monkeypatch: pytest.MonkeyPatch) -> None:
    fake_worker(monkeypatch, f"sys.stderr.write('no such wheel'); sys.exit({MISSING})")
    diagnostic, _ = failure(rumoca, Job((), (BAD, GOOD)))
    assert (diagnostic.code, diagnostic.hint) == ("no-compiler", "pip install psutil rumoca")
    assert "no such wheel" in diagnostic.message


def test_what_tell_raises_ends_the_compiler(rumoca: Compiler) -> None:
    def tell(number: int, outcome: Outcome) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        rumoca.compile(Job((), (GOOD,)), UNLIMITED, tell)


def test_the_parent_imports_nothing_native(rumoca: Compiler, tmp_path: Path) -> None:
    """In a process of its own, since other tests here have imported all that there is."""
    from urdfsync.checking import process

    program = (
        "import sys; from pathlib import Path; from urdfsync.checking.cache import Cache; "
        "from urdfsync.checking.compilers.rumoca import *; from urdfsync.checking.compilers.tasks import *; "
        f"Rumoca(Cache(Path({str(tmp_path)!r}))).compile(Job((), (Task('M', 'model M end M;'),)), Limits()); "
        "print(sorted(sys.modules.keys() & {'rumoca', 'numpy', 'pinocchio', 'lxml'}))"
    )
    lines: list[str] = []
    process.run([sys.executable, "-c", program], "", lines.append, environment=process.importable())
    assert lines == ["[]"]


@pytest.mark.slow
def test_with_the_standard_library(rumoca: Compiler, modelica_library: Path, tmp_path: Path) -> None:
    """A pendulum of the library against the physics of a point mass; takes 5 s of CPU, its cache being empty."""
    cache = Cache(tmp_path / "cache")
    source = """
model Pendulum
  import Modelica;
  inner Modelica.Mechanics.MultiBody.World world(g = 10);
  Modelica.Mechanics.MultiBody.Joints.Revolute revolute;
  Modelica.Mechanics.MultiBody.Parts.Body body(r_CM = {2, 0, 0}, m = 3);
  Real a = revolute.a;
equation
  connect(world.frame_b, revolute.frame_a);
  connect(revolute.frame_b, body.frame_a);
end Pendulum;
"""
    found = library.standard(os.environ, Path.home(), modelica_library)
    roots = (*slim.Copies(found, cache).roots(references.mentioned([source])), str(library_folder() / "UrdfSync"))
    task = Task("Pendulum", source, (Simulation(0.001, 0.001),), ("a", "revolute.phi"))
    pendulum, example = rumoca.compile(Job(roots, (task, compiling("UrdfSync.Examples.HoldingTorque"))), UNLIMITED)
    assert pendulum.problem == ""
    inertia = 3 * 2**2 + 0.001  # Body's own default
    assert pendulum.runs[0].values["a"][0] == pytest.approx(-10 * 3 * 2 / inertia)
    assert example.problem == ""
    assert example.unknowns > example.states > 0
    assert 0 < cache.size() < 100e6
    assert time.time() - next(cache.libraries.iterdir()).stat().st_mtime < 3600
