"""A project whose joint `elbow` is used in models of the user's, and is called `wrist` by the next export."""

from __future__ import annotations

from pathlib import Path

import pytest

import support.urdfs as urdfs
from support.commands import Execute

CONFIG = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\nusers = ["../plant"]\n'
CELL = """\
within;\r
model Cell "robot.elbowAxis"\r
  Arm.Arm robot; Real elbow = 1 "elbow";\r
equation\r
  connect(robot.elbowAxis, motor); // robot.elbowAxis\r
  connect(
    robot.
      elbowSupport, housing);
end Cell;\r
"""
MINE = """\
within Arm.Links;
model Mine
  extends Arm(redeclare Joints.Elbow elbow(checkLimits = false));
  Joints.ElbowParameters numbers;
  Real angle = elbow.phi;
end Mine;
"""
BENCH = "model Bench\n  Arm.Links.Mine mine(elbow(fixedStart = true));\n  Real angle = mine.elbow.phi;\nend Bench;\n"
FILES = {"Cell.mo": CELL, "../plant/Bench.mo": BENCH, "modelica/Arm/Links/Mine.mo": MINE}
RENAMED = {
    "Cell.mo": CELL.replace("connect(robot.elbowAxis", "connect(robot.wristAxis").replace("elbowS", "wristS"),
    "../plant/Bench.mo": BENCH.replace("elbow", "wrist"),
    "modelica/Arm/Links/Mine.mo": MINE.replace("elbow", "wrist").replace("Elbow", "Wrist"),
}
NO_OLD_NAMES = "none of your models uses a name that is known to have another one now"
COMMAND = ("resolve", "--rename-uses")
NAMES = (*COMMAND, "elbow=wrist")


def write_source(joint: str, other: str = "swing") -> None:
    joints = (urdfs.joint(joint, "continuous", "base", "limb"), urdfs.joint(other, "revolute", "limb", "hand"))
    Path("arm.urdf").write_text(urdfs.robot(*(urdfs.link(name, 1.0) for name in ("base", "limb", "hand")), *joints))


def texts() -> dict[str, str]:
    return {path: Path(path).read_bytes().decode() for path in FILES}


def make_user(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Path:
    """A project whose joint `elbow` is used in models around the package and in it; now the source calls it `wrist`.

    The user trusts it with what lies outside of its folder.
    """
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "settings"))
    trusted = tmp_path / "settings/urdfsync/trusted.toml"
    trusted.parent.mkdir(parents=True)
    trusted.write_text(f"folders = ['{tmp_path / 'cell'}']\n")
    project = tmp_path / "cell"
    project.mkdir()
    (tmp_path / "plant").mkdir()
    monkeypatch.chdir(project)
    Path("urdfsync.toml").write_text(CONFIG)
    write_source("elbow")
    execute("build")
    for path, text in FILES.items():
        Path(path).write_bytes(text.encode())
    write_source("wrist")
    return project
