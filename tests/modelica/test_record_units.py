"""No number of the robots that are read from a record is without a unit."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from support.modelica import URDFSYNC

BARE = re.compile(r"^  (?:\w+ )*?Real (\w+)(\[[^\]]*\])?(?!.*unit)[^(]*$", re.MULTILINE)
PLAIN = {
    "axisStarts": {"lower", "upper", "start"},
    "axisValues": {"x", "y"},
    "jointVector": {"ofTurning", "ofSliding", "factor", "x"},
    "sweepTurns": {"start", "lower", "upper", "velocity", "reach", "turn", "room", "above", "below"},
    "AxisSweeps": {"start", "lower", "upper", "velocity", "reach", "turn"},
    "jacobian": {"J"},
}
"""Numbers of any unit, and the Jacobian, whose rows have two."""
RATIOS = {"followerMultipliers"}
"""rad or m per rad or m."""


def files() -> Iterable[Path]:
    yield from (URDFSYNC / "Dynamics").glob("*.mo")
    yield from (URDFSYNC / "Records").glob("*.mo")
    names = ("PartialRecordRobot", "PartialGenericRobot", "GenericRobot", "ArticulatedRobot", "AxisSweeps")
    yield from (URDFSYNC / "Robots" / f"{name}.mo" for name in (*names, "MultiBodyGenericRobot"))


def test_no_number_is_without_a_unit() -> None:
    found = {
        (file.stem, name)
        for file in files()
        for name, _ in BARE.findall(file.read_text("utf-8"))
        if name not in RATIOS | PLAIN.get(file.stem, set())
    }
    assert found <= {(kind, "multiplier") for kind in ("RotationalMimic", "TranslationalMimic")}
