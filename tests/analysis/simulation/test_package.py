"""The model that is simulated or exported, with its package: what is found or refused, and what a compiler says."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from support.simulation import OWN, Compiler, refused, run

from urdfsync.analysis.checks.compilers.compiler import CompileResult


@pytest.mark.slow
@pytest.mark.parametrize("place", ["Cells/package.mo", "elsewhere/Cells/package.mo", "elsewhere/Cells.mo"])
def test_models_of_the_user_are_found(
    compiler: Compiler, modelica_library: Path, place: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = Path(place)
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("package Cells\n" + OWN + "end Cells;\n")
    monkeypatch.setenv("MODELICAPATH", os.pathsep.join((str(modelica_library), str(Path("elsewhere").resolve()))))
    assert run(model="Cells.Own").model == "Cells.Own"


@pytest.mark.slow
def test_a_package_that_is_out_of_step_is_simulated_with_a_warning(compiler: Compiler) -> None:
    file = Path("arm.urdf")
    file.write_text(file.read_text().replace('damping="0.5"', 'damping="0.7"'))
    assert [one.code for one in run().diagnostics] == ["out-of-step", "limit-passed"]


def write(text: str, name: str = "m.csv") -> Callable[[], None]:
    return lambda: (Path(name).write_text(text), None)[1]


MOTION = "time,shoulder_phi,elbow_phi\n0,0,0\n2,2,2\n"


@pytest.mark.parametrize(
    ("prepare", "options", "words"),
    [
        (None, {"model": "ArmTst"}, "there is no model `ArmTst`; did you mean `ArmTest`?"),
        (None, {"model": "Arm.ArmTst"}, "did you mean `ArmTest`?"),
        (None, {"model": "Plant.Cell"}, "libraries have to be beside the package"),
        (None, {"model": "Links"}, "it is a package"),
        (None, {"model": "ArmRun"}, "`Arm.ArmRun` has inputs; give a CSV file with `--input`; its first line is "
         "time,shoulder_phi,elbow_phi"),
        (write(MOTION), {"model": "ArmTest", "motion": Path("m.csv")}, "the model has no inputs that a motion could "
         "drive; leave `--input` out"),
        (write(MOTION), {"motion": Path("m.csv"), "stop": 3.0}, "the motion ends at 2 s, before the stop time, 3 s"),
        (None, {"method": "bdff"}, "did you mean `bdf`?"),
        (None, {"values": ("a",)}, "gives no value"),
        (write("not a robot", "arm.urdf"), {}, "arm.urdf"),
    ],
)  # fmt: skip
def test_bad_input_is_refused_before_anything_is_compiled(
    compiler: Compiler, prepare: Callable[[], None] | None, options: dict[str, Any], words: str
) -> None:
    if prepare:
        prepare()
    assert words in refused(**options)
    assert compiler.jobs == []


def test_a_package_that_is_not_built_is_refused(compiler: Compiler) -> None:
    shutil.rmtree("modelica")
    assert "is not built; run `urdfsync build`" in refused()


@pytest.mark.slow
def test_a_parameter_that_does_not_exist_is_refused_with_the_nearest(compiler: Compiler) -> None:
    compiler.results = [CompileResult(parameters=("robot.elbow.parameters.dynamics.damping",))]
    found = refused(values=("robot.elbow.parameters.dynamics.dampin=1",))
    assert "did you mean `robot.elbow.parameters.dynamics.damping`?" in found
    compiler.results = [CompileResult(parameters=())]
    assert "has no parameter `b`" in refused(values=("b=1",)), "the model has no parameters at all"
    compiler.results = [CompileResult("unbalanced model: 4 equations, 3 unknowns"), CompileResult(parameters=("a",))]
    assert "has no parameter `b`" in refused(values=("b=1",)), "what is set keeps the model from compiling"
    assert [bool(job.tasks[0].runs) for job in compiler.jobs[2:]] == [True, False]
    compiler.results = [CompileResult("unbalanced model: 4 equations, 3 unknowns"), CompileResult()]
    assert "1 equation too many" in (found := refused(values=("b=1",)))
    assert "check whether one of these is final, or has a value of the wrong type: b" in found


def test_a_file_that_can_not_be_read_is_told_in_place_of_what_the_compiler_says(compiler: Compiler) -> None:
    Path("modelica/Arm/Own.mo").write_text("model Own\n  Real\nend Own;")
    compiler.results = [CompileResult("something or other")]
    assert refused().startswith("modelica/Arm/Own.mo:3: error: ")


def test_what_is_wrong_with_a_model_of_the_user_is_told_of_its_file(compiler: Compiler) -> None:
    Path("Own.mo").write_text(OWN)
    compiler.results = [CompileResult("unbalanced model: 2 equations, 3 unknowns")]
    assert refused(model="Own") == "Own.mo: error: there is 1 equation too few [unbalanced]"
