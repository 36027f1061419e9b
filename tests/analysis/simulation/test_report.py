"""A simulation in words: each joint beside its limits."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from support.commands import Execute
from support.corpus import REPOSITORY
from support.files import outputs
from support.simulation import Compiler

SHOWN = """\
arm: Arm.ArmTest, 10 s in steps of 0.02 s; … s
  joint     position     limits  speed/limit  effort/limit
  shoulder  0 … 2.5 rad  -2 … 2  1/3 rad/s    1 N·m
  elbow     0 … 0.5 rad  -       0 rad/s      -
"""


def test_joints_are_shown_beside_their_limits(compiler: Compiler, execute: Execute) -> None:
    before = outputs()
    printed = execute("simulate")
    first, *rest = printed.lines
    assert first.startswith("arm: Arm.ArmTest, 10 s in steps of 0.02 s; ")
    assert rest == SHOWN.splitlines()[1:]
    assert printed.errors == [
        "arm: compiling Arm.ArmTest with rumoca",
        "warning: joint shoulder: position passes its limit, 2 rad, at 2 s; by up to 0.5 rad, for 0 s [limit-passed]",
    ]
    assert max(map(len, printed.lines)) <= 80
    assert outputs() == before


def test_a_large_model_is_told_before(compiler: Compiler, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("urdfsync.analysis.simulation.run._LONG", 0.0)
    (told,) = [line for line in execute("simulate").errors if "compiling" in line]
    assert ", 2 axes: some 8 s of processor time and 0.2 GB of memory; the generic robot" in told


FOUR_BAR = """\
[robots.arm]
source = "arm.urdf"
package = "Arm"
start = { crank_pivot = 1.2, crank_pin = -0.88242, rocker_pivot = 1.20663 }

[[robots.arm.loops]]
name = "rocker_pin"
kind = "revolute"
frames = [{ link = "coupler", xyz = [0.6, 0, -0.025] }, { link = "rocker", xyz = [0.4, 0, 0] }]
axis = [0, 0, 1]
"""


@pytest.mark.slow
def test_a_model_with_loops_may_take_longer(
    compiler: Compiler, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The generic robot has no loops, so it is no way out."""
    shutil.copy(REPOSITORY / "modelica/UrdfSync/Resources/robots/four_bar/four_bar.urdf", "arm.urdf")
    Path("urdfsync.toml").write_text(FOUR_BAR)
    execute("build", "--full", "-q")
    monkeypatch.setattr("urdfsync.analysis.simulation.run._LONG", 0.0)
    (told,) = [line for line in execute("simulate").errors if "compiling" in line]
    assert "much more than" in told
    assert "the generic robot" not in told
