"""What travels from the process that checks a robot to the one that asked."""

from __future__ import annotations

import math
from pathlib import Path

import msgspec
import pytest

from urdfsync.checking import child, process
from urdfsync.checking.verdict import Comparison, Compiled, Effect, Verdict
from urdfsync.checking.wishes import Wishes
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Deviation, Quantity

VERDICT = Verdict(
    "arm",
    "Plant.Arm",
    compiled=(Compiled("ArmRun", 120, 14),),
    generated=Comparison((Deviation(Quantity.EFFORT, "joint elbow", math.inf, 1e-17, 12.5, "N·m"),)),
    effects=(Effect(("Links/Hand.mo",), ()),),
    unchecked=("nothing else",),
    diagnostics=(Diagnostic(Severity.WARNING, "code", "message", "file.mo", 3),),
    seconds=1.5,
)


def test_a_verdict_survives_the_way() -> None:
    step = child.loads(child.dumps(child.Step(verdict=VERDICT)))
    assert step.verdict == VERDICT


def test_a_step_is_one_line() -> None:
    line = child.dumps(child.Step(what="arm: compiling\nArm"))
    assert "\n" not in line
    assert child.loads(line).what == "arm: compiling\nArm"


@pytest.mark.parametrize("line", ["", "warning: something native", '{"verdict": 3}'])
def test_other_lines_are_refused(line: str) -> None:
    with pytest.raises((ValueError, msgspec.ValidationError)):
        child.loads(line)


def test_a_robot_that_is_gone_from_the_configuration_is_a_verdict(tmp_path: Path) -> None:
    """The configuration was changed between the command and its process."""
    file = tmp_path / "urdfsync.toml"
    file.write_text('[robots.leg]\nsource = "leg.urdf"\npackage = "Leg"\n')
    order = child.Order(str(file), "arm", str(tmp_path), Wishes(package_paths=(tmp_path,)))
    lines: list[str] = []
    text = msgspec.json.encode(order, enc_hook=str).decode() + "\n"
    result = process.run(process.python(child.__name__), text, lines.append, environment=process.importable())
    assert result.good, result.words
    verdict = child.loads(lines[-1]).verdict
    assert verdict is not None
    assert [one.code for one in verdict.diagnostics] == ["unknown-robot"]
