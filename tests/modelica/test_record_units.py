"""Units of robots that are read from a record: equations of axes agree in them, and no number is without one."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest
from support.modelica import URDFSYNC

ROBOT = (URDFSYNC / "Robots" / "PartialRecordRobot.mo").read_text("utf-8")
SI = {
    "Angle": "1",
    "AngularVelocity": "1/s",
    "AngularAcceleration": "1/s2",
    "Length": "m",
    "Position": "m",
    "Velocity": "m/s",
    "Acceleration": "m/s2",
}
"""Units of the types of the standard library; rad is 1."""
FLANGES = {
    "rotationalAxis.phi": "1",
    "rotationalAxis.tau": "N.m",
    "rotationalSupport.phi": "1",
    "translationalAxis.s": "m",
    "translationalAxis.f": "N",
    "translationalSupport.s": "m",
}
BASE = {"N": {"kg": 1, "m": 1, "s": -2}}
EQUATION = re.compile(r"^    ([\w.\[\]*]+) = (der\()?([\w.\[\]]+)\)?(?: - ([\w.\[\]]+))?;$", re.MULTILINE)
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


def dimension(unit: str) -> Counter[str]:
    """Exponents of the base units of a unit like N.m or 1/s2; rad is none."""
    found: Counter[str] = Counter()
    for sign, part in zip((1, -1), unit.split("/"), strict=False):
        for factor in part.split("."):
            name, power = re.fullmatch(r"([a-zA-Z1]+?)(\d?)", factor).groups()  # type: ignore[union-attr]
            for base, exponent in BASE.get(name, {name: 1}).items():
                found[base] += sign * exponent * int(power or 1)
    return Counter({base: power for base, power in found.items() if power and base not in ("1", "rad")})


def declared() -> dict[str, Counter[str]]:
    """Dimensions of the variables of the robot model, by their types."""
    found = {name: dimension(unit) for name, unit in FLANGES.items()}
    for kind, name in re.findall(r"^  (?:\w+ )*?([\w.]+) (\w+)(?:\[[^\]]*\])?(?:\(| =|\n)", ROBOT, re.MULTILINE):
        last = kind.rpartition(".")[2]
        if kind.startswith("UrdfSync.Types."):
            text = (URDFSYNC / "Types" / f"{last}.mo").read_text("utf-8")
            (unit,) = re.findall(r'unit = "([^"]+)"', text)
            found[name] = dimension(unit)
        elif last in SI:
            found[name] = dimension(SI[last])
    return found


def sides() -> Iterator[tuple[str, list[Counter[str]]]]:
    """The equations of the axes, with the dimensions of their terms."""
    known = declared()

    def product(term: str) -> Counter[str]:
        total: Counter[str] = Counter()
        for factor in re.sub(r"\[[^\]]*\]*\]", "", term).split("*"):
            for base, power in known[factor].items():
                total[base] += power
        return Counter({base: power for base, power in total.items() if power})

    begin = ROBOT.index("  for k in 1:data.rotationalAxes loop")
    for found in EQUATION.finditer(ROBOT[begin : ROBOT.index("  for k in 1:nFollowers loop", begin)]):
        left, derivative, right, minus = found.groups()
        if right == "0":
            continue  # of any unit
        terms = [product(left), product(right)]
        if derivative:
            terms[1] = Counter({**terms[1], "s": terms[1]["s"] - 1})
        yield found[0].strip(), terms + ([product(minus)] if minus else [])


def test_equations_of_axes_agree_in_their_units() -> None:
    """Those of q, v, a and drive mix joints that turn and that slide."""
    equations = dict(sides())
    assert len(equations) == 14
    assert [text for text, terms in equations.items() if any(term != terms[0] for term in terms)] == []


def test_an_equation_without_the_metre_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each of the four in turn."""
    for term in ("q", "v", "a"):
        right = f"unitLength*{term}[data.translationalJoints[k]]"
        assert ROBOT.count(right) == 1
        with monkeypatch.context() as patch:
            patch.setattr(f"{__name__}.ROBOT", ROBOT.replace(right, right.removeprefix("unitLength*")))
            assert sum(any(part != terms[0] for part in terms) for _, terms in sides()) == 1
    with monkeypatch.context() as patch:
        patch.setattr(f"{__name__}.ROBOT", ROBOT.replace("unitLength*translationalAxis", "translationalAxis"))
        assert sum(any(part != terms[0] for part in terms) for _, terms in sides()) == 1


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


def test_units_are_read() -> None:
    assert dimension("N.m") == {"kg": 1, "m": 2, "s": -2}
    assert dimension("m/s2") == {"m": 1, "s": -2}
    assert dimension("rad/s") == dimension("1/s") == {"s": -1}
    assert dimension("1") == {}
