"""Units, by pint: what they are in SI, and how Modelica writes them."""

from __future__ import annotations

import math
import re
import subprocess
import sys
from decimal import Decimal
from typing import Any

import pint
import pytest

from urdfsync.formats.table.units import find_unit, is_same_kind


@pytest.mark.parametrize(
    ("unit", "number", "value", "si"),
    [
        ("kg", "1.1", 1.1, "kg"),
        ("N.m/rad", "3", 3, "N.m/rad"),
        ("1", "0.1", 0.1, "1"),
        ("mm", "1.1", 0.0011, "m"),
        ("N.cm", "600", 6, "N.m"),
        ("kg.cm2", "1", 1e-4, "kg.m2"),
        ("g.cm2", "1", 1e-7, "kg.m2"),
        ("kWh", "1", 3.6e6, "J"),
        ("l/s", "1", 1e-3, "m3/s"),
        ("W/(m2.K)", "2", 2, "W/(m2.K)"),
        ("degC", "-5", 268.15, "K"),
        ("deg", "180", math.pi, "rad"),
        ("rpm", "60", 2 * math.pi, "rad/s"),
        ("%", "50", 0.5, "1"),
        ("kOhm", "1", 1000, "Ohm"),
        ("Ω", "1", 1, "Ohm"),
        ("Nm", "2", 2, "N.m"),
        ("mNm", "30", 0.03, "N.m"),
        ("Nm/A", "30", 30, "N.m/A"),
        ("m^2", "2", 2, "m2"),
        ("m²", "2", 2, "m2"),
        ("J/kg/K", "2", 2, "J/(kg.K)"),
        ("1/degC", "2", 2, "1/K"),
        ("1/s", "2", 2, "1/s"),
        ("hPa", "2", 200, "Pa"),
        ("oz.in", "100", 0.7061551814226044, "N.m"),
        ("oz-in", "100", 0.7061551814226044, "N.m"),
        ("ozf.in", "100", 0.7061551814226044, "N.m"),
        ("ozf-in", "100", 0.7061551814226044, "N.m"),
        ("kg.cm", "10", 0.980665, "N.m"),
        ("kg-cm", "10", 0.980665, "N.m"),
        ("kg.cm/s", "10", 0.1, "kg.m/s"),
        ("lbf.in", "10", 1.1298482902764672, "N.m"),
        ("bar", "3.5", 350000, "Pa"),
        ("psi", "1", 6894.757293168361, "Pa"),
        ("N/mm2", "1", 1e6, "Pa"),
        ("kgf", "1", 9.80665, "N"),
        ("hp", "1", 745.6998715822702, "W"),
        ("kcal/h", "1", 1.1622222222222223, "W"),
        ("kW.h", "1", 3.6e6, "J"),
        ("Ah", "1", 3600, "C"),
        ("kVA", "1", 1000, "V.A"),
        ("µF", "1", 1e-6, "F"),
        ("W/(m.degC)", "1", 1, "W/(m.K)"),
        ("V/rpm", "1", 30 / math.pi, "V.s/rad"),
        ("bar.l/s", "1", 100, "Pa.m3/s"),
    ],
)
def test_numbers_are_converted(unit: str, number: str, value: float, si: str) -> None:
    found = find_unit(unit)
    assert found.convert(Decimal(number)) == pytest.approx(value, rel=1e-15)
    assert found.si == si


@pytest.mark.parametrize(
    "unit", ["", "wibble", "kg..m", "m^", "2 + 3", "__import__('os')", "N.m^1e9", "m99999", "m^0.5"]
)
def test_no_unit(unit: str) -> None:
    with pytest.raises(ValueError, match="is no unit"):
        find_unit(unit)


@pytest.mark.parametrize("unit", ["PS", "mil", "G", "U/min", "dB", "dBm", "Np", "oz.m", "oz.in2", "Pm"])
def test_units_that_mean_something_else_than_a_table_are_refused(unit: str) -> None:
    with pytest.raises(ValueError, match="is not known here"):
        find_unit(unit)


UNITS = "m s A K mol rad sr Hz N Pa J W C V F Ohm S Wb T H lm lx Bq Gy kat".split()
PREFIXED = [f"{prefix}{unit}{power}" for prefix in "numckMG" for unit in UNITS for power in ("", "-1")]
PRODUCTS = "g mg g.cm2 g.mm2 cm2.g g.cm kg.mm2 N.cm mN.m kW/(m2.K) N/mm2 1/ms m/ms2 kN.mm/(uA.s) kN.mm/uA2".split()


def test_units_that_are_read_without_pint_are_those_of_pint() -> None:
    registry: Any = pint.UnitRegistry(non_int_type=Decimal)
    registry.define("Ohm = ohm")
    for unit in (*PREFIXED, *PRODUCTS):
        found = find_unit(unit)
        quantities = (
            registry.Quantity(number, re.sub(r"(?<=[A-Za-z])(-?\d)", r"**\1", text.replace(".", "*")))
            for number, text in ((Decimal(1), unit), (found.factor, found.si))
        )
        one, other = (quantity.to_base_units() for quantity in quantities)
        assert (one.magnitude, one.units) == (other.magnitude, other.units), unit


def test_common_units_do_not_load_pint() -> None:
    """Loading pint takes longer than reading a table of 10,000 rows."""
    program = "import sys; from urdfsync.formats.table.units import find_unit; list(map(find_unit, sys.argv[1:]))"
    program += "; assert 'pint' not in sys.modules"
    subprocess.run([sys.executable, "-c", program, "N.cm", "g.cm2", "mm", "kW/(m2.K)"], check=True)


def test_candelas_are_no_days() -> None:
    """pint reads `mcd` as a thousandth of a hundredth of a day."""
    assert find_unit("mcd").si == "cd"


def test_kinds_of_units() -> None:
    assert is_same_kind("N.cm", "N.m")
    assert not is_same_kind("N.cm", "kg")
