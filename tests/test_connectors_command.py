"""Builds and diffs say which connectors of the robot model come, go or have another name, and how a frame is kept."""

from __future__ import annotations

from pathlib import Path

import pytest
import support.urdfs as urdfs

from urdfsync import cli

Capture = pytest.CaptureFixture[str]

LINKS = tuple(urdfs.link(name, 1.0) for name in ("base", "arm", "hand"))
SWING = urdfs.joint("swing", "continuous", "base", "arm")
GRIP = urdfs.joint("grip", "fixed", "arm", "hand")
CONFIG = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\ncross_check = false\n'


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "urdfsync.toml").write_text(CONFIG)
    (tmp_path / "arm.urdf").write_text(urdfs.robot(*LINKS[:2], SWING))
    assert cli.main(["build", "-q"]) == 0
    return tmp_path


def said(capsys: Capture, *arguments: str) -> str:
    capsys.readouterr()
    cli.main([*arguments])
    streams = capsys.readouterr()
    return " ".join((streams.out + streams.err).split())


def test_a_leaf_that_gets_a_child_loses_its_frame_and_both_commands_say_so(project: Path, capsys: Capture) -> None:
    (project / "arm.urdf").write_text(urdfs.robot(*LINKS, SWING, GRIP))
    assert 'link arm frame was arm_linkFrame list "arm" in `frames` to keep it' in said(capsys, "diff", "arm.urdf")
    note = 'note: link arm: its frame `arm_linkFrame` is gone; list "arm" in `frames` to keep it [connector-changed]'
    assert note in said(capsys, "build")
    assert "arm_linkFrame" not in (project / "modelica/Arm/Arm.mo").read_text()
    assert "connector-changed" not in said(capsys, "build")


def test_the_option_keeps_it(project: Path, capsys: Capture) -> None:
    (project / "urdfsync.toml").write_text(CONFIG + 'frames = ["arm"]\n')
    (project / "arm.urdf").write_text(urdfs.robot(*LINKS, SWING, GRIP))
    assert "connector-changed" not in said(capsys, "build")
    assert "connect(arm_link.frame_a, arm_linkFrame)" in (project / "modelica/Arm/Arm.mo").read_text()


def test_a_joint_that_moves_no_more_loses_its_flanges(project: Path, capsys: Capture) -> None:
    (project / "arm.urdf").write_text(urdfs.robot(*LINKS[:2], SWING.replace("continuous", "fixed")))
    found = said(capsys, "build")
    assert "joint swing: its axis `swingAxis` is gone" in found
    assert "joint swing: its support `swingSupport` is gone" in found


def test_numbers_change_no_connector(project: Path, capsys: Capture) -> None:
    (project / "arm.urdf").write_text(urdfs.robot(urdfs.link("base", 2.0), LINKS[1], SWING))
    assert "connector-changed" not in said(capsys, "build")
