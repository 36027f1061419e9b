"""`urdfsync simulate` as people type it: what they see, files that they name, exit codes."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from support.commands import Execute
from support.files import outputs
from support.simulation import Compiler

from urdfsync.analysis.checks.process import LimitError
from urdfsync.common.diagnostics import Diagnostic, Severity


@pytest.mark.slow
def test_all_arguments_reach_the_compiler(compiler: Compiler, execute: Execute) -> None:
    execute(
        *("simulate", "arm", "--model", "ArmTest", "--stop", 2, "--step", 0.5, "--tolerance", 1e-3, "--method", "bdf"),
        *(
            "--set",
            "robot.elbow.w_start=1",
            "--set",
            "robot.checkLimits=false",
            "--variable",
            "robot.*.r_0[1]",
            "--csv",
            "a.csv",
        ),
    )
    (task,) = compiler.jobs[0].tasks
    assert "extends Arm.ArmTest(robot(elbow(w_start = 1), checkLimits = false));" in task.source
    assert [(one.stop, one.step, one.tolerance, one.method) for one in task.runs] == [(2.0, 0.5, 1e-3, "bdf")]


@pytest.mark.slow
def test_a_page_has_the_motion(compiler: Compiler, execute: Execute) -> None:
    printed = execute("simulate", "--report", "arm.html")
    assert printed.lines[-1] == "  report: arm.html"
    page = Path("arm.html").read_text("utf-8")
    (data,) = re.findall('<script type="application/json" id="data">(.*?)</script>', page)
    motion = json.loads(data)["motion"]
    assert [joint["element"] for joint in motion["joints"]] == ["joint shoulder", "joint elbow"]
    assert motion["series"]["time"] == list(compiler.values["time"])
    assert [limit["quantity"] for limit in motion["joints"][0]["passed"]] == ["position"]
    assert "position passes its limit, 2 rad" in page


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--csv", "modelica"), "modelica: error: a folder is in its place"),
        (("--csv", "nowhere/a.csv"), "there is no such folder"),
        (("--csv", "arm.urdf"), "the source of the robot has this name"),
        (("--csv", "modelica/Arm/ArmTest.mo"), "ArmTest.mo: error: a file of a Modelica package has this name"),
        (("--csv", "modelica/Arm/package.order"), "a file of a Modelica package has this name; name another file"),
        (("--csv", "a.html", "--report", "a.html"), "two outputs have this name"),
        (("--csv", "urdfsync.toml"), "the configuration has this name"),
        (("--input", "m.csv", "--csv", "m.csv"), "the file with the inputs has this name"),
        (("--plot", "a.pdf"), "a plot is one of .png, .svg"),
        (("--csv", "a.svg", "--plot", "a.svg"), "two outputs have this name"),
        (("--report", "a.pdf"), "a page's name ends with .html"),
        (("--input", "absent.csv"), "absent.csv"),
        (("--stop", "0"), "'0' is no amount"),
        (("--step", "nan"), "'nan' is no amount"),
        (("--vary", "a=0..1", "--seed", "-1"), "'-1' is no seed; give a whole number, 0 or more"),
        (("--against", ""), "an empty text is no revision; give one such as HEAD~1"),
        (("--variable", "robot.*"), "`--variable` adds a variable to a file, and no file is named; give `--csv FILE`"),
        (("nobody",), "no robot `nobody`"),
    ],
)
def test_bad_arguments_are_refused_and_nothing_is_written(
    compiler: Compiler, execute: Execute, arguments: tuple[str, ...], words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: name)
    Path("m.csv").write_text("time,shoulder_phi,elbow_phi\n0,0,0\n1,1,1\n")
    before = outputs()
    assert words in execute("simulate", *arguments, code=2).words
    assert (outputs(), compiler.jobs) == (before, [])


def test_what_is_not_installed_is_said_first(
    compiler: Compiler, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    found = execute("simulate", "--plot", "a.png", code=2).words
    assert "`--plot` needs matplotlib, which is not installed; pip install matplotlib" in found
    assert compiler.jobs == []


@pytest.mark.slow
def test_one_of_several_robots_has_to_be_named(compiler: Compiler, execute: Execute) -> None:
    with Path("urdfsync.toml").open("a") as file:
        file.write('[robots.other]\nsource = "arm.urdf"\npackage = "Other"\n')
    assert "name one: arm, other" in execute("simulate", code=2).words
    execute("simulate", "arm")
    for model in ("Arm.ArmTest", "ArmTest"):  # the model names the robot
        assert "arm: Arm.ArmTest" in execute("simulate", "--model", model).words
    told = execute("simulate", "--model", "Plant.Cell", code=2).words
    assert "`Plant.Cell` is in none of the packages of arm, other, so it does not tell the robot" in told
    assert "name the robot that the model uses: `urdfsync simulate arm --model Plant.Cell`" in told


def test_no_output_replaces_the_source_of_another_robot(compiler: Compiler, execute: Execute) -> None:
    with Path("urdfsync.toml").open("a") as file:
        file.write('[robots.other]\nsource = "other.urdf"\npackage = "Other"\n')
    Path("other.urdf").write_bytes(Path("arm.urdf").read_bytes())
    words = execute("simulate", "arm", "--csv", "other.urdf", code=2).words
    assert "other.urdf: error: the source of robot `other` has this name" in words
    assert compiler.jobs == []


def test_an_interruption_leaves_nothing(compiler: Compiler, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("urdfsync.analysis.checks.compilers.run_job", interrupt)
    before = outputs()
    assert "interrupted" in execute("simulate", "--csv", "a.csv", code=130).words
    assert outputs() == before


def test_a_limit_of_time_is_told_with_its_option(
    compiler: Compiler, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    def take_too_long(*arguments: object) -> None:
        limits = arguments[3]
        raise LimitError(Diagnostic(Severity.ERROR, "out-of-time", f"{limits.owner}: {limits.seconds:g} s"))  # type: ignore[attr-defined]

    monkeypatch.setattr("urdfsync.analysis.checks.compilers.run_job", take_too_long)
    assert "the simulation of `Arm.ArmTest`: 5 s [out-of-time]" in execute("simulate", "--timeout", "5", code=2).words


def test_quiet_shows_warnings_to_nobody(compiler: Compiler, execute: Execute) -> None:
    printed = execute("simulate", "-q")
    assert (printed.out, printed.err) == ("", "")
