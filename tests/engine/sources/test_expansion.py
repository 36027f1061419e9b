"""What can't be expanded is one error at its place, in bounded time; what a file may do meanwhile is limited."""

from __future__ import annotations

import shutil
import sys
import time
from pathlib import Path

import msgspec
import pytest
from support import xacros
from support.commands import Execute
from support.files import unchanged
from support.xacros import problem, value, write_line

from urdfsync.engine.sources import expansion
from urdfsync.engine.sources.expansion import SourceFiles
from urdfsync.project.config import load
from urdfsync.project.state.expansion import Expansion


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="it has no such limits")
@pytest.mark.parametrize(
    "expression", ["[i for i in range(10**15)]", "len('a' * 10**12)", "9**9**9**9", "[[0] * 10**8 for i in range(99)]"]
)
def test_an_endless_expression_is_ended(folder: Path, monkeypatch: pytest.MonkeyPatch, expression: str) -> None:
    monkeypatch.setattr(expansion, "CPU_SECONDS", 1.0)
    begin = time.monotonic()
    found = problem(write_line(folder, value(expression)))
    assert "arm.urdf.xacro:" in found
    assert "expanding it takes more than 1 s or 1 GB" in found
    assert time.monotonic() - begin < expansion.WALL_SECONDS


@pytest.mark.skipif(sys.platform == "win32", reason="it has no such limits")
def test_the_line_that_takes_too_long_is_told(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(expansion, "CPU_SECONDS", 0.5)
    inputs = write_line(folder, '<xacro:include filename="more.xacro"/>')
    endless = value("[0 for i in range(10**15) if i == -1]")
    (folder / "more.xacro").write_text(f"{xacros.HEAD.format('more')}\n\n{endless}</robot>")
    assert problem(inputs).startswith("more.xacro:4: error: expanding it takes more than 0.5 s")


@pytest.mark.skipif(sys.platform == "win32", reason="it has no such limits")
def test_a_machine_that_has_all_files_does_not_use_the_recorded_source(
    folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    xacros.write(folder)
    execute("build")
    shutil.rmtree(".urdfsync/notes")
    monkeypatch.setattr(expansion, "WALL_SECONDS", 0.0)
    assert "expanding it takes more than" in execute("build", "--check", code=2).err


@pytest.mark.parametrize(
    ("recorded", "present", "changed"),
    [
        ("ws/pk", "project/ws/pk", False),
        ("ws/pk", "project/first/pk", True),
        ("ws/pk", "outside/pk", True),
        ("package://pk/.", "project/ws/pk", True),
        ("package://pk/.", "outside/pk", False),
        ("package://pk/.", "", False),
        (None, "", False),
        (None, "project/ws/pk", True),
    ],
)
def test_a_package_is_looked_for_again(folder: Path, recorded: str | None, present: str, changed: bool) -> None:
    """A package that this machine lacks is no change, and neither is another folder outside of the project."""
    if present:
        (folder / present).mkdir(parents=True)
        (folder / present / "package.xml").write_text("<package><name>pk</name></package>")
    xacros.write(folder / "project")
    (robot,) = load(folder / "project/urdfsync.toml").robots
    search = [folder / place for place in ("project/first", "project/ws", "outside")]
    inputs = SourceFiles(folder / "project", robot.source, search)
    made = inputs.look(robot, Expansion(packages={"pk": recorded}))
    made = msgspec.structs.replace(made, packages={"pk": recorded})
    assert inputs.find_changes(robot, made) == (("packages",) if changed else ())


def test_what_it_prints_nothing_of_is_no_robot(folder: Path, execute: Execute) -> None:
    xacros.write(folder, {"arm.urdf.xacro": f"{xacros.HEAD.format('arm')}</robot>"}, xacros.CONFIG)
    with unchanged(folder):
        assert "urdf/arm.urdf.xacro:1: error: the robot has no link" in execute("build", code=2).err


def test_a_failed_expansion_leaves_the_package(folder: Path, execute: Execute) -> None:
    xacros.write(folder)
    execute("build")
    (folder / "urdf/masses.yaml").write_text("upper: [1\n")
    with unchanged(folder):
        assert "urdf/masses.yaml:2: error:" in execute("build", code=2).err
