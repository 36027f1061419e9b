"""Names that mean nothing, as `urdfsync check` tells them: in the package, and in the user's files around it."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path
from typing import Any

import pytest
from support.urdfs import dynamics, joint, limit, link, robot

from urdfsync import cli
from urdfsync.check import libraries
from urdfsync.check.afterbuild import CheckCache
from urdfsync.config import load

Capture = pytest.CaptureFixture[str]

WITH_LIBRARY = pytest.mark.skipif(
    libraries.find_library("Modelica", libraries.library_folders(os.environ)) is None,
    reason="there is no Modelica Standard Library",
)

ARM = robot(
    link("base", 3.0),
    link("upper", 2.0),
    link("hand", 0.7),
    joint("shoulder", "revolute", "base", "upper", axis="0 1 0", inside=[limit(), dynamics(0.5, 0.2)]),
    joint("elbow", "continuous", "upper", "hand", axis="0 0 1", inside=[dynamics(0.1, 0.0)]),
)
BROKEN = {
    "MyArm.mo": """\
within;
model MyArm
  extends Plant.Arm.Arm(redeclare Plant.Arm.Joints.Elbow elbo, elbow(parameters(dynamics(dampin = 5))));
  Plant.Arm.Links.Hnd other;
  parameter Real load = 2;
equation
  connect(elbwo.axis, elbow.axis);
end MyArm;
""",
    "Bench/MyBench.mo": """\
model MyBench
  extends Plant.Arm.ArmTest(robot(redeclare Plant.Arm.Joints.Elbow elbow));
  MyArm mine;
  Real x = mine.laod + robot.elbow.axs.tau;
  Real y = whatever.it.is;
end MyBench;
""",
    "Notes.mo": "model Notes\n  Nothing here;\nend Notes;\n",
    "Draft.mo": "model Draft\n  Plant.Arm.Arm arm\nend Draft;\n",
}


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the built package `Plant.Arm`; the output folder."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.urdf").write_text(ARM)
    text = '[robots.arm]\nsource = "arm.urdf"\npackage = "Plant.Arm"\ncreate_parents = true\ncross_check = false\n'
    (tmp_path / "urdfsync.toml").write_text(text)
    assert cli.main(["build", "--quiet"]) == 0
    return tmp_path / "modelica"


@pytest.fixture
def without_library(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """No Modelica Standard Library: nothing is compiled."""
    monkeypatch.setattr(libraries, "library_folders", lambda *_: [])
    monkeypatch.setenv("MODELICAPATH", "")
    monkeypatch.setenv("OPENMODELICALIBRARY", "")
    monkeypatch.setenv("HOME", str(tmp_path))


def write(folder: Path, files: dict[str, str]) -> None:
    for path, text in files.items():
        (folder / path).parent.mkdir(exist_ok=True)
        (folder / path).write_text(text)


def checked(capsys: Capture, code: int) -> tuple[list[str], Any]:
    """The findings as people read them, and the robot's entry in JSON."""
    capsys.readouterr()
    assert cli.main(["check", "--json"]) == code
    shown = capsys.readouterr()
    (found,) = json.loads(shown.out)["robots"]
    lines = [
        f"{one['file'].removeprefix('modelica/')}:{one['line']}: {one['severity']}: {one['message']}; {one['hint']}"
        for one in found["diagnostics"]
    ]
    return lines, found


@pytest.mark.slow
@WITH_LIBRARY
def test_a_user_reads_what_is_missing(project: Path, capsys: Capture) -> None:
    write(project, BROKEN)
    nested = "the redeclaration of `elbow` inside of another modifier is not checked: rumoca ignores it"
    lines, found = checked(capsys, 2)
    assert lines == [
        "Draft.mo:0: warning: this file can't be read as Modelica, so its names were not checked; "
        "open it in a Modelica tool",
        f"Bench/MyBench.mo:2: warning: {nested}; "
        "write a model that says `extends Plant.Arm.Arm(redeclare … elbow)`, and use that instead",
        "Bench/MyBench.mo:4: error: MyArm has no parameter `laod`; did you mean `mine.load`?",
        "Bench/MyBench.mo:4: error: Elbow has no connector `axs`; did you mean `robot.elbow.axis.tau`?",
        "Bench/MyBench.mo:5: error: MyBench has no element `whatever`; ",
        "MyArm.mo:3: error: Arm has no joint `elbo`; did you mean `elbow`?",
        "MyArm.mo:3: error: RotationalDynamics has no field `dampin`; did you mean `damping`?",
        "MyArm.mo:4: error: there is no class `Plant.Arm.Links.Hnd`; did you mean `Plant.Arm.Links.Hand`?",
        "MyArm.mo:7: error: MyArm has no joint `elbwo`; did you mean `elbow.axis`?",
    ]
    assert found["standing"] == "failed"
    assert len(found["compiled"]) == 3, "the package itself is right"


@WITH_LIBRARY
def test_the_package_is_not_compiled_if_names_in_it_mean_nothing(project: Path, capsys: Capture) -> None:
    file = project / "Plant" / "Arm" / "Arm.mo"
    file.write_text(file.read_text().replace("connect(shoulder.frame_b, ", "connect(sholder.frame_b, "))
    lines, found = checked(capsys, 2)
    (line,) = lines
    assert "error: robot: Arm has no joint `sholder`; did you mean `shoulder.frame_b`?" in line
    assert line.endswith("the file was edited by hand")
    assert found["gaps"] == ["nothing was compiled, since names in the package mean nothing"]


def test_without_the_standard_library_nothing_is_said_of_what_it_may_hold(
    project: Path, without_library: None, capsys: Capture
) -> None:
    """Joints extend classes of that library, so of their elements nothing can be said; the robot itself has icons."""
    write(project, {"MyArm.mo": BROKEN["MyArm.mo"]})
    assert [line.partition(";")[0] for line in checked(capsys, 2)[0]] == [
        "MyArm.mo:3: error: Arm has no joint `elbo`",
        "MyArm.mo:4: error: there is no class `Plant.Arm.Links.Hnd`",
        "MyArm.mo:7: error: MyArm has no joint `elbwo`",
    ]
    write(
        project, {"MyArm.mo": "model MyArm\n  extends Plant.Arm.Joints.Elbow;\n  Real x = inherited.x;\nend MyArm;\n"}
    )
    assert checked(capsys, 0)[0] == []


def test_other_robots_and_hidden_folders_are_left_alone(project: Path, without_library: None, capsys: Capture) -> None:
    write(project, {".backup/MyArm.mo": BROKEN["MyArm.mo"], "Resources/MyArm.mo": BROKEN["MyArm.mo"]})
    shutil.copytree(project / "Plant" / "Arm", project / "Plant" / "Other")
    with Path("urdfsync.toml").open("a") as file:
        file.write('[robots.other]\nsource = "arm.urdf"\npackage = "Plant.Other"\n')
    (project / "Plant" / "Other" / "Bad.mo").write_text(
        "within Plant.Other;\nmodel Bad\n  Plant.Arm.Bad bad;\nend Bad;\n"
    )
    capsys.readouterr()
    assert cli.main(["check", "arm"]) == 0
    assert "error" not in capsys.readouterr().out


def test_a_check_is_remembered_until_a_users_file_changes(project: Path) -> None:
    config = load(Path("urdfsync.toml").absolute())
    first = CheckCache(config).key(config.robots[0])
    write(project, {"Notes.mo": BROKEN["Notes.mo"]})
    assert CheckCache(config).key(config.robots[0]) == first
    write(project, {"MyArm.mo": BROKEN["MyArm.mo"]})
    assert CheckCache(config).key(config.robots[0]) != first
