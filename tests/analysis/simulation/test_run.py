"""A simulation from the configuration to series: what is compiled, what comes back, what is refused."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from support.simulation import OWN, Compiler, refused, run

from urdfsync.analysis.checks.compilers.compiler import CompileResult, SimulationResult
from urdfsync.common.diagnostics import Severity


def test_test_is_simulated_as_its_annotation_says(compiler: Compiler) -> None:
    result = run()
    (task,) = compiler.jobs[0].tasks
    assert "extends Arm.ArmTest;" in task.source
    assert [(one.stop, one.step, one.tolerance) for one in task.runs] == [(10.0, 0.02, 1e-6)]
    assert (result.model, result.stop, result.step, result.is_known) == ("Arm.ArmTest", 10.0, 0.02, False)
    assert [joint.element for joint in result.joints] == ["joint shoulder", "joint elbow"]
    assert result.series == compiler.values


@pytest.mark.slow
def test_a_limit_that_is_passed_is_a_warning(compiler: Compiler) -> None:
    (found,) = run().diagnostics
    assert (found.severity, found.code) == (Severity.WARNING, "limit-passed")
    assert found.message == "joint shoulder: position passes its limit, 2 rad, at 2 s; by up to 0.5 rad, for 0 s"
    Path("urdfsync.toml").write_text(Path("urdfsync.toml").read_text() + 'ignore = ["limit-passed"]\n')
    assert run().diagnostics == ()


def test_a_pattern_that_no_variable_matches_is_a_warning(compiler: Compiler) -> None:
    found = run(variables=("robot.elbow.*", "robot.elbo.*", "table[1,2]")).diagnostics
    assert [one.message for one in found if one.code == "no-variable"] == [
        "no variable has the name `robot.elbo.*`",
        "no variable has the name `table[1,2]`",
    ]


def test_arguments_come_before_the_annotation(compiler: Compiler) -> None:
    run(stop=3.0, step=0.5, tolerance=1e-4, method="bdf", values=("robot.elbow.parameters.dynamics.damping=4",))
    (task,) = compiler.jobs[0].tasks
    assert "extends Arm.ArmTest(robot(elbow(parameters(dynamics(damping = 4)))));" in task.source
    assert task.parameters == ("robot.elbow.parameters.dynamics.damping",)
    (one,) = task.runs
    assert (one.stop, one.step, one.tolerance, one.method) == (3.0, 0.5, 1e-4, "bdf")


@pytest.mark.parametrize("options", [{"stop": 1.0, "step": 1e-9}, {"stop": 1e9}, {"stop": 1e300, "step": 1e-300}])
def test_too_many_instants_are_refused(compiler: Compiler, options: dict[str, float]) -> None:
    assert "are more than 10000000 instants; give a greater `--step`" in refused(**options)
    assert compiler.jobs == []


def test_a_model_without_annotation_has_the_defaults(compiler: Compiler) -> None:
    Path("Own.mo").write_text(OWN)
    result = run(model="Own")
    assert (result.stop, result.step, result.tolerance) == (1.0, 0.002, 1e-6)
    assert str(Path("Own.mo").resolve()) in compiler.jobs[0].roots


def test_inputs_follow_the_motion_and_drives_the_inputs(compiler: Compiler) -> None:
    Path("m.csv").write_text("time,shoulder_phi,elbow_phi [deg]\n0,0,0\n0.5,1,90\n2,2,180\n")
    result = run(motion=Path("m.csv"))
    assert (result.model, result.stop) == ("Arm.ArmRun", 2.0)
    assert "extends Arm.ArmRun(shoulderDrive(exact = true), elbowDrive(exact = true));" in compiler.source
    assert "shoulder_phi = course1(time);" in compiler.source
    assert "constant Real q2[3] = {0.0, 1.5707963267948966, 3.141592653589793};" in compiler.source


@pytest.mark.slow
def test_the_same_is_simulated_once(compiler: Compiler, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.undo()
    monkeypatch.chdir(tmp_path / "project")
    monkeypatch.setattr("urdfsync.analysis.checks.compilers.run_job", compiler)
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: tmp_path / "cache")
    first, second = run(), run()
    assert (first.is_known, second.is_known, len(compiler.jobs)) == (False, True, 1)
    assert second.series == {name: tuple(values) for name, values in first.series.items()}
    file = Path("modelica/Arm/Joints/ElbowParameters.mo")
    file.write_text(file.read_text().replace("damping = 0.5", "damping = 0.75"))
    assert not run().is_known, "an edit"
    assert [run(stop=stop).is_known for stop in (1.0, 2.0, 1.0)] == [False, False, True]


def test_a_model_without_the_robot_has_no_joints(compiler: Compiler) -> None:
    compiler.values = {"time": (0.0, 1.0)}
    assert [one.code for one in run().diagnostics] == ["no-joints"]


@pytest.mark.parametrize(
    ("problem", "words"),
    [
        ("Modelica assert failed at t=0.25: too late", "stops at 0.25 s: Modelica assert failed"),
        ("non-finite derivative evaluation for state 'x'", "stops before its end: non-finite"),
        ("initial variable projection did not satisfy the residual system", "does not initialise"),
        ("assert failed at t=0.000: too late", "does not initialise"),
        ("The following assertion has been violated at time 0.500000", "stops at 0.5 s"),
        ("The corrector could not converge.; can't continue. time = 0.000000", "does not initialise"),
    ],
)
def test_a_simulation_that_fails_says_when(compiler: Compiler, problem: str, words: str) -> None:
    compiler.results = [CompileResult(runs=(SimulationResult(problem=problem),))] * 2
    assert words in refused()


@pytest.mark.slow
def test_results_until_a_simulation_stops_are_kept(compiler: Compiler) -> None:
    """And it is simulated again the next time."""
    stopped = SimulationResult(problem="Modelica assert failed at t=2.25: too late")
    compiler.results = [CompileResult(runs=(stopped,))]
    result = run(step=0.25)
    assert [one.stop for job in compiler.jobs for one in job.tasks[0].runs] == [10.0, 2.0]
    assert result.series["time"] == (0.0, 1.0, 2.0)
    assert [one.element for one in result.joints] == ["joint shoulder", "joint elbow"]
    (error,) = (one for one in result.diagnostics if one.severity is Severity.ERROR)
    assert "stops at 2.25 s: Modelica assert failed" in error.message
    assert error.message.endswith("results until 2 s are kept")
    assert not any(one.severity is Severity.ERROR for one in run(step=0.25).diagnostics)
    assert len(compiler.jobs) == 3


def test_a_model_that_ends_the_simulation_is_a_note(compiler: Compiler) -> None:
    ended = SimulationResult(compiler.values, termination="landed", parameters=compiler.parameters)
    compiler.results = [CompileResult(runs=(ended,))]
    assert "`Arm.ArmTest` ends the simulation at 2 s: landed" in [one.message for one in run().diagnostics]


# --- with the embedded compiler -----------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_motion_comes_back(arm: Path, modelica_library: Path) -> None:
    times = np.linspace(0, 1, 51)
    rows = [f"{t!r},{math.sin(2 * t)!r},{math.degrees(math.cos(3 * t))!r}" for t in times.tolist()]
    Path("m.csv").write_text("\n".join(["time,shoulder_phi,elbow_phi [deg]", *rows, ""]))
    series = run(motion=Path("m.csv"), step=0.01).series
    moments = np.array(series["time"])
    for joint, course in (("shoulder", np.sin(2 * moments)), ("elbow", np.cos(3 * moments))):
        assert np.abs(series[f"robot.{joint}.revolute.phi"] - course).max() < 1e-6
        assert np.array_equal(series[f"robot.{joint}.revolute.phi"], series[f"{joint}_phi"]), "as it was asked for"


@pytest.mark.slow
@pytest.mark.large  # the next tests set parameters, too
def test_parameters_change_what_they_should(arm: Path, modelica_library: Path) -> None:
    name = "robot.elbow.parameters.dynamics.damping"
    variables = ("robot.elbow.friction.*",)
    found = run(stop=0.2, step=0.1, values=(f"{name}=400",), variables=variables).series
    speed, torque = found["robot.elbow.friction.w"][-1], found["robot.elbow.friction.tau"][-1]
    assert torque == pytest.approx(400 * speed + 0.1 * math.tanh(50 * speed))
    assert "nothing in the compiled model depends on it" in refused(
        values=("robot.elbow.friction.parameters.damping=1",)
    )
    assert "is declared final" in refused(values=("robot.m=1",))


@pytest.mark.slow
def test_a_record_that_is_handed_down_is_not_changed_in_silence(arm: Path, modelica_library: Path) -> None:
    Path("Twin.mo").write_text("""
package Twin
  record Numbers
    Real mass = 1;
    Real size = 2;
  end Numbers;
  record Whole
    Numbers first;
  end Whole;
  model Part
    parameter Numbers numbers;
    Real x(start = 0, fixed = true);
  equation
    der(x) = numbers.mass;
  end Part;
  model Robot
    parameter Whole whole;
    Part part(numbers = whole.first);
  end Robot;
  model Both
    extends Arm.ArmTest;
    Robot other;
  end Both;
end Twin;
""")
    values = ("other.whole.first.mass=7",)
    series = run(model="Twin.Both", stop=0.2, values=values, variables=("other.part.x",)).series
    assert series["other.part.x"][-1] == pytest.approx(1.4)


@pytest.mark.slow
def test_a_model_of_the_user_is_told_what_is_wrong_with_it(arm: Path, modelica_library: Path) -> None:
    Path("Own.mo").write_text(OWN.replace("  Real y = k*time;", "  Real z;"))
    assert refused(model="Own") == "Own.mo: error: there is 1 equation too few [unbalanced]"
    Path("Own.mo").write_text(OWN.replace("end Own", 'equation\n  assert(time < 0.05, "too late");\nend Own'))
    result = run(model="Own", stop=0.1, step=0.02)
    (error,) = result.diagnostics
    assert "the simulation of `Own` stops at 0.05 s: " in error.message
    assert error.message.endswith("too late; results until 0.04 s are kept")
    assert result.series["time"] == pytest.approx([0, 0.02, 0.04])
