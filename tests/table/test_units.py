"""Units, by pint: what they are in SI, and how Modelica writes them."""

from __future__ import annotations

import math
from decimal import Decimal

import pytest

from urdfsync.table.units import find_unit, is_same_kind


@pytest.mark.parametrize(
    ("unit", "number", "value", "si"),
    [
        ("kg", "1.1", 1.1, "kg"),
        ("N.m/rad", "3", 3, "N.m/rad"),
        ("1", "0.1", 0.1, "1"),
        ("mm", "1.1", 0.0011, "m"),
        ("N.cm", "600", 6, "N.m"),
        ("kg.cm2", "1", 1e-4, "kg.m2"),
        ("W/(m2.K)", "2", 2, "W/(m2.K)"),
        ("kPa", "2", 2000, "Pa"),
        ("degC", "-5", 268.15, "K"),
        ("deg", "180", math.pi, "rad"),
        ("rpm", "60", 2 * math.pi, "rad/s"),
        ("%", "50", 0.5, "1"),
        ("kOhm", "1", 1000, "Ohm"),
        ("ft.N", "1", 0.3048, "kg.m2/s2"),
    ],
)
def test_numbers_are_converted(unit: str, number: str, value: float, si: str) -> None:
    found = find_unit(unit)
    assert found.convert(Decimal(number)) == pytest.approx(value, rel=1e-15)
    assert sorted(found.si) == sorted(si), "pint orders the units of a product"


@pytest.mark.parametrize("unit", ["", "wibble", "kg..m", "m^", "2 + 3", "__import__('os')"])
def test_no_unit(unit: str) -> None:
    with pytest.raises(ValueError, match="is no unit"):
        find_unit(unit)


def test_kinds_of_units() -> None:
    assert is_same_kind("N.cm", "N.m")
    assert not is_same_kind("N.cm", "kg")
