"""A simulation in words: each joint beside its limits."""

from __future__ import annotations

from support.commands import Execute
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
