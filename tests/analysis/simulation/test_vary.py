"""Many cases of a model: outcomes, failures, what is remembered, and cases that are cut off."""

from __future__ import annotations

import contextlib
import csv
import os
import signal
import subprocess
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import msgspec
import psutil
import pytest
from support.commands import Execute
from support.simulation import Compiler, run

from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.compilers.compiler import (
    CompileJob,
    CompilerError,
    CompileResult,
    CompileTask,
    SimulationResult,
    Tool,
)
from urdfsync.analysis.checks.process import Limits
from urdfsync.analysis.simulation.outcomes import QUANTITIES, Outcome, Study, table
from urdfsync.common import processes
from urdfsync.common.diagnostics import UrdfsyncError

MASS = "robot.lower.parameters.inertial.mass"
FEW = f"{MASS}=[0.5,1,1.5,2.5,3,4]"
"""Cases of which the last three pass a limit, since the stand-in moves the shoulder to the value."""


class CaseCompiler:
    """Replace `compilers.run_job`: the shoulder moves to the varied value; some values fail, or end the process."""

    def __init__(self) -> None:
        self.tasks: list[CompileTask] = []
        self.problems: dict[float, str] = {}
        self.terminations: dict[float, str] = {}
        self.crashes: set[float] = set()
        self.answer: CompileResult | None = None
        """In place of all results."""

    def __call__(
        self,
        tool: Tool,
        job: CompileJob,
        cache: UserCache,
        limits: Limits,
        progress: Callable[[], None],
        on_result: Callable[[CompileResult], None],
    ) -> list[CompileResult]:
        """Return the result of each task, and hand each on at once."""
        results = []
        for task in job.tasks:
            if self.answer:
                return [self.answer] * len(job.tasks)
            progress()
            self.tasks.append(task)
            value = task.runs[0].parameters.get(MASS, 1.0)
            if value in self.crashes:
                raise CompilerError.of("compiler-crashed", "rumoca crashed at Arm.ArmTest: signal 11 (SIGSEGV)")
            values = {
                "time": (0.0, 1.0, 2.0),
                "robot.shoulder.revolute.phi": (0.0, value / 2, value),
                "robot.shoulder.revolute.w": (0.0, value, 0.0),
                "robot.shoulderAxis.tau": (2.0, 2.0, 2.0),
            }
            limits_of_shoulder = {"lower": -2.0, "upper": 2.0, "velocity": 5.0}
            parameters = {
                f"robot.shoulder.parameters.limits.{name}": limit for name, limit in limits_of_shoulder.items()
            }
            problem = self.problems.get(value, "")
            simulated = SimulationResult(
                {} if problem else values,
                problem=problem,
                termination=self.terminations.get(value, ""),
                parameters=parameters,
            )
            results.append(CompileResult(runs=(simulated,)))
            on_result(results[-1])
        return results

    @property
    def values(self) -> list[float]:
        """The simulated values of the mass, in order."""
        return [task.runs[0].parameters[MASS] for task in self.tasks]


@pytest.fixture
def cases(compiler: Compiler, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> CaseCompiler:
    """A compiler of cases, with an empty cache."""
    monkeypatch.undo()
    monkeypatch.chdir(tmp_path / "project")
    found = CaseCompiler()
    monkeypatch.setattr("urdfsync.analysis.checks.compilers.run_job", found)
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: tmp_path / "cache")
    return found


def study(*vary: str, **options: Any) -> Study:
    import urdfsync

    return urdfsync.vary(vary=vary or (FEW,), **{"jobs": 1, **options})


def statuses(found: Study) -> list[str]:
    return [outcome.status for outcome in found.outcomes]


def test_each_case_is_judged(cases: CaseCompiler) -> None:
    found = study()
    assert statuses(found) == ["within"] * 3 + ["beyond"] * 3
    assert (found.within, found.beyond, found.failed, found.worst) == (3, 3, 0, 6)
    assert found.replay == f"urdfsync simulate arm --set {MASS}=4.0"
    assert found.outcomes[5].heaviest == "joint shoulder: position 4 of 2 rad"
    position, speed, effort = found.summaries
    assert (position.quantity, position.limit, position.beyond) == ("position", 2.0, 3)
    assert (speed.least, speed.median, speed.greatest, speed.limit, speed.beyond) == (0.5, 2.0, 4.0, 5.0, 0)
    assert (effort.unit, effort.greatest) == ("N·m", 2.0)


def test_the_command_of_the_worst_case_names_another_configuration(
    cases: CaseCompiler, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    file = str(Path("project/urdfsync.toml"))
    assert study(f"{MASS}=[1]", config=file).replay == f"urdfsync simulate arm --config {file} --set {MASS}=1.0"


def test_the_table_has_a_row_for_each_case(cases: CaseCompiler) -> None:
    cases.problems = {1.5: "non-finite derivative, for state 'x'"}
    rows = list(csv.DictReader(table(study())))
    assert [row["case"] for row in rows] == ["1", "2", "3", "4", "5", "6"]
    assert [float(row[MASS]) for row in rows] == [0.5, 1, 1.5, 2.5, 3, 4]
    assert [row["shoulder.final"] for row in rows] == ["0.5", "1.0", "", "2.5", "3.0", "4.0"]
    assert rows[5]["shoulder.passed"] == "position"
    assert float(rows[5]["shoulder.energy"]) == pytest.approx(8.0)  # 2 N·m over 4 rad, by trapezoids
    assert rows[2]["problem"] == "non-finite derivative, for state 'x'"


@pytest.mark.slow
def test_a_failed_case_is_told_and_the_others_go_on(cases: CaseCompiler, execute: Execute) -> None:
    cases.problems = {1.0: "assert failed at t=0.25: too late", 3.0: "assert failed at t=0.25: too late"}
    found = execute("simulate", "arm", "--vary", FEW, code=1).words
    assert "2 of 6 cases within all limits; 2 beyond; 2 failed" in found
    assert "2 cases failed (the first is case 2): assert failed at t=0.25: too late" in found


def test_cases_that_the_model_ended_are_told(cases: CaseCompiler, execute: Execute) -> None:
    cases.terminations = {1.0: "it has landed", 3.0: "it has landed"}
    told = execute("simulate", "arm", "--vary", FEW).words
    assert "in 2 cases the model ended the simulation: it has landed" in told


def test_the_reasons_are_told_also_if_nothing_can_be_drawn(cases: CaseCompiler, execute: Execute) -> None:
    pytest.importorskip("matplotlib")
    cases.problems = {1.0: "too late", 3.0: "too late"}
    printed = execute("simulate", "--vary", f"{MASS}=[1,3]", "--csv", "a.csv", "--plot", "a.png", code=1)
    assert "2 cases failed (the first is case 1): too late" in printed.words
    assert "a.png: warning: all cases failed, so there is nothing to draw" in printed.words
    assert (Path("a.csv").exists(), Path("a.png").exists()) == (True, False)


@pytest.mark.slow
def test_a_process_that_dies_takes_one_case_with_it(cases: CaseCompiler) -> None:
    cases.crashes = {1.0}
    found = study()
    assert statuses(found) == ["within", "failed", "within", "beyond", "beyond", "beyond"]
    assert found.outcomes[1].problem == "rumoca crashed at Arm.ArmTest: signal 11 (SIGSEGV)"
    cases.crashes = {1.0, 1.5, 2.5, 3.0, 4.0}
    assert statuses(study(seed=1, stop=1.0)) == ["within", *["failed"] * 5]
    assert 3.0 not in cases.values[-5:], "after three in a row no process is started for the others"


@pytest.mark.slow
def test_finished_cases_are_remembered_and_failed_ones_tried_again(cases: CaseCompiler) -> None:
    cases.problems = {1.0: "no"}
    first = study()
    cases.problems, cases.tasks = {}, []
    second = study()
    assert (first.known, second.known, cases.values) == (0, 5, [1.0])
    assert study().known == 6
    assert study(f"{MASS}=[1,7]").known == 1, "a case is known in any study"
    assert study(stop=1.0).known == 0


@pytest.mark.slow
def test_ctrl_c_keeps_finished_cases(cases: CaseCompiler, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(what: str, done: int, total: int) -> None:
        if done >= 2:
            raise KeyboardInterrupt

    monkeypatch.setattr("urdfsync.analysis.simulation.vary._CHUNK", 2)
    monkeypatch.setattr("urdfsync.analysis.simulation.vary._WINDOW", 1)
    monkeypatch.setattr("urdfsync.output.console.Console.progress", lambda _, *given: interrupt(*given))
    told = execute("simulate", "--vary", FEW, "--jobs", 1, code=130).words
    assert "interrupted; 2 of 6 cases are kept; run the command again to finish the work" in told
    cases.tasks = []
    resumed = study()
    assert (resumed.known, cases.values) == (2, [1.5, 2.5, 3.0, 4.0])
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: Path.cwd() / "another cache")
    assert list(table(study())) == list(table(resumed))


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        (CompileResult(parameters=(MASS, "robot.lower.m")), "has no parameter `robot.lower.parameters.inertial.mas`"),
        (CompileResult(parameters=()), f"has no parameter `{MASS}`"),
        (CompileResult(structural=(MASS,)), f"`{MASS}` can't be varied: the compiler evaluates it"),
        (CompileResult(without_effect=(MASS,)), f"`{MASS}` can't be changed: nothing in the compiled model"),
        (CompileResult(problem="unbalanced model"), "unbalanced model"),
    ],
)
def test_a_model_that_cannot_vary_ends_the_command(cases: CaseCompiler, answer: CompileResult, words: str) -> None:
    cases.answer = answer
    with pytest.raises(UrdfsyncError) as caught:
        study(FEW.replace("mass", "mas") if answer.parameters else FEW)
    assert words in str(caught.value)


def test_a_value_is_given_or_varied(cases: CaseCompiler) -> None:
    with pytest.raises(UrdfsyncError, match="has a value, and is varied, too"):
        study(values=(f"{MASS}=2",))
    assert cases.tasks == []


def test_openmodelica_gets_a_text_for_each_case(cases: CaseCompiler, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("urdfsync.analysis.checks.compilers.find_missing", lambda tool: None)
    study(f"{MASS}=[2,3]", tool="omc")
    assert ["inertial(mass = 2.0)" in task.source for task in cases.tasks] == [True, False]
    assert [task.parameters for task in cases.tasks] == [(MASS,)] * 2


def test_the_document_obeys_its_schema(cases: CaseCompiler, execute: Execute) -> None:
    cases.problems = {1.0: "no"}
    printed = execute("simulate", "--vary", FEW, "--jobs", 1, "--csv", "a.csv", "--format", "json", code=1)
    (found,) = printed.json["results"]
    assert (found["within"], found["beyond"], found["failed"], found["worst"]) == (2, 3, 1, 6)
    assert found["cases"][1] == {"number": 2, "values": {MASS: 1.0}, "status": "failed", "load": 0.0, "problem": "no"}
    assert found["files"] == {"csv": "a.csv"}


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["png", "svg"])
def test_the_same_cases_give_the_same_picture(cases: CaseCompiler, kind: str) -> None:
    pytest.importorskip("matplotlib")
    pictures = []
    for name in ("a", "b"):
        study(FEW, "robot.elbow.phi_start=0..1", cases=3, files={"plot": Path(f"{name}.{kind}")})
        pictures.append(Path(f"{name}.{kind}").read_bytes())
    assert pictures[0] == pictures[1]


@pytest.mark.parametrize(
    ("option", "value"),
    [("--cases", 3), ("--jobs", 3), ("--seed", 0), ("--sampling", "random")],
)
def test_options_of_cases_need_cases(cases: CaseCompiler, execute: Execute, option: str, value: object) -> None:
    assert f"`{option}` needs `--vary`" in execute("simulate", option, value, code=2).words
    assert cases.tasks == []


def test_options_of_samples_choose_the_values(cases: CaseCompiler, execute: Execute) -> None:
    found = list[list[float]]()
    for options in ((), ("--seed", 0), ("--seed", 1), ("--sampling", "random")):
        cases.tasks = []
        execute(
            "simulate",
            "--vary",
            f"{MASS}=0..2",
            "--cases",
            3,
            "--jobs",
            1,
            *options,
            "--tolerance",
            1 / (1 + len(found)),
        )
        found.append(cases.values)
    first, same, other, independent = found
    assert first == same
    assert len({tuple(values) for values in found}) == 3, (other, independent)


def test_a_page_has_no_cases(cases: CaseCompiler, execute: Execute) -> None:
    assert "`--vary` has no page" in execute("simulate", "--vary", FEW, "--report", "a.html", code=2).words


# --- with the embedded compiler -----------------------------------------------------------------------------------

VARIED = f"{MASS}=2..60", "robot.elbow.parameters.dynamics.friction=0..2", "robot.elbow.phi_start=[0.1,0.4]"


@pytest.mark.slow
def test_cases_equal_single_simulations(arm: Path, modelica_library: Path) -> None:
    found = study(*VARIED, cases=1, stop=0.5)
    for number, outcome in enumerate(found.outcomes):
        alone = run(stop=0.5, values=tuple(found.varied.settings(number)))
        for joint, case in zip(alone.joints, outcome.joints, strict=True):
            ranges = [getattr(joint, name) for name in QUANTITIES]
            assert [(one.least, one.greatest) if one else None for one in ranges] == [
                (one.least, one.greatest) if one else None for one in case.extents
            ]
            assert joint.position is not None
            assert case.final == alone.series[joint.position.variable][-1]


def command(folder: Path, file: str, *options: str) -> subprocess.Popen[str]:
    """Start a study of six cases, one at a time, with a cache below `folder`."""
    words = (
        "urdfsync",
        "simulate",
        "--vary",
        f"{MASS}=1..60",
        "--cases",
        "6",
        "--stop",
        "0.1",
        "--csv",
        file,
        *options,
    )
    environment = {**os.environ, **processes.importable(), "XDG_CACHE_HOME": str(folder)}
    return subprocess.Popen(
        [*processes.python_module(words[0]), *words[1:]],
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )


def wait_for_results(folder: Path, count: int) -> None:
    """Wait until a command has kept so many outcomes; there are other results in the cache, too."""
    end = time.monotonic() + 300
    while time.monotonic() < end:
        if sum(map(is_outcome, folder.glob("urdfsync/results/*"))) >= count:
            return
        time.sleep(0.05)
    raise AssertionError("no outcome was kept")


def is_outcome(file: Path) -> bool:
    try:
        return bool(msgspec.msgpack.decode(file.read_bytes(), type=Outcome).joints)
    except (OSError, ValueError):
        return False


def children_of(process: subprocess.Popen[str]) -> Sequence[psutil.Process]:
    return psutil.Process(process.pid).children(recursive=True)


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT])
def test_a_study_that_was_ended_goes_on(
    arm: Path, modelica_library: Path, tmp_path: Path, number: signal.Signals
) -> None:
    ended, whole = tmp_path / "ended", tmp_path / "whole"
    first = command(ended, "a.csv", "--jobs", "1")
    wait_for_results(ended, 2)
    compilers = children_of(first)
    first.send_signal(number)
    _, err = first.communicate(timeout=60)
    assert first.returncode == (130 if number is signal.SIGINT else -number)
    assert ("of 6 cases are kept; run the command again" in err) == (number is signal.SIGINT)
    _, alive = psutil.wait_procs(compilers, timeout=30)
    assert not alive
    for folder, file in ((ended, "a.csv"), (whole, "b.csv")):
        again = command(folder, file)
        out, err = again.communicate(timeout=600)
        assert again.returncode == 0, err
        assert ("remembered" in out) == (folder == ended)


@pytest.mark.slow
def test_a_compiler_that_is_killed_fails_one_case(arm: Path, modelica_library: Path, tmp_path: Path) -> None:
    process = command(tmp_path / "cache", "a.csv", "--jobs", "1")
    wait_for_results(tmp_path / "cache", 1)
    for child in children_of(process):
        with contextlib.suppress(psutil.Error):
            child.kill()
    out, err = process.communicate(timeout=600)
    assert process.returncode == 1, err
    assert "1 case failed" in out
    rows = csv.DictReader(Path("a.csv").read_text().splitlines())
    assert [row["status"] for row in rows].count("failed") == 1
