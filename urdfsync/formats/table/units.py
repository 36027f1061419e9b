"""Converts the numbers of columns to SI."""

from __future__ import annotations

import functools
import re
from collections import defaultdict
from collections.abc import Mapping
from decimal import Decimal
from typing import Any, NamedTuple

from urdfsync.common.diagnostics import SourceError
from urdfsync.common.extras import install_command

_COHERENT = frozenset("m kg s A K mol cd rad sr Hz N Pa J W C V F Ohm S Wb T H lm lx Bq Gy kat".split())
"""The SI units without a prefix: loading pint takes longer than a whole build."""
_DERIVED = "N", "Pa", "J", "W", "C"
"""The SI units that other units become, such as lbf, bar, kWh, hp and Ah."""
_PRODUCTS = {"J/s": "W", "W.s": "J", "A.s": "C", "N/m2": "Pa"}
"""Products with a name of their own; `N.m` is a torque, and `V.A` an apparent power."""
_TERM = rf"(?:{'|'.join(sorted(_COHERENT))})(?:-?[1-9])?"
_MODELICA = re.compile(rf"(?:1|{_TERM}(?:\.{_TERM})*)(?:/(?:{_TERM}|\({_TERM}(?:\.{_TERM})+\)))?")
"""Matches a product of SI units, or a quotient of two products, in Modelica's spelling."""
_WORD = re.compile(r"([A-Za-z]+)(-?[1-9])?")
_POWERS = {"n": -9, "u": -6, "m": -3, "c": -2, "k": 3, "M": 6, "G": 9}
"""Powers of ten of the prefixes that need no pint."""
_GRAM = re.compile(r"\Ag(?=\Z|\.[cm]?m2\Z)")
"""Matches the gram of a mass or an inertia; Modelica has kilograms."""
_UNIT = re.compile(r"(?=.)(?!.*[.*/^]{2})(?!.*\d[\deE])(1/)?[^\W\d_%°]*+[%°]?+[\w.*/()^-]*+")
_LONGEST = 100
"""The greatest number of characters of a unit."""
_KNOWN = frozenset(
    "meter gram second ampere kelvin mole candela radian steradian hertz newton pascal joule watt coulomb volt "
    "farad ohm Ohm siemens weber tesla henry lumen lux becquerel gray sievert katal minute hour day degree turn "
    "liter metric_ton bar revolutions_per_minute degree_Celsius delta_degree_Celsius degree_Fahrenheit "
    "delta_degree_Fahrenheit arcminute arcsecond standard_atmosphere pound_force_per_square_inch meter_Hg inch foot "
    "yard mile pound force_pound gallon force_kilogram force_ounce horsepower metric_horsepower electron_volt "
    "watt_hour ampere_hour calorie british_thermal_unit knot kilometer_per_hour mile_per_hour percent "
    "ppm".split()
)
"""The allowed units, by pint's names. Further units of pint would surprise: `mil` is an angle, `G` is gauss."""
_PREFIXES = frozenset(" pico nano micro milli centi deci hecto kilo mega giga tera".split(" "))
"""The allowed prefixes. With others, typing errors become units: `PS` would be petasiemens."""


class Unit(NamedTuple):
    """A unit: number · `factor` + `offset` is the number in the SI unit `si`."""

    factor: Decimal
    offset: Decimal
    si: str
    """The SI unit in Modelica's spelling, for example `kg.m2/s2`; `1` for a number without a unit."""

    def convert(self, number: Decimal) -> float:
        """Return a number in SI."""
        return float(number * self.factor + self.offset)


@functools.lru_cache(maxsize=256)
def find_unit(text: str) -> Unit:
    """Return a unit such as `N.cm`, `kg.m2`, `W/(m2.K)` or `degC`; `1` stands for no unit.

    Raises ValueError for an unknown unit, SourceError without pint.
    """
    text = _with_dots(text)
    if unit := _find_simple(text):
        return unit
    registry = _load_registry(text)
    written = _quantity(registry, 1, text)
    one, zero = (quantity.to_base_units().magnitude for quantity in (written, _quantity(registry, 0, text)))
    return Unit(one - zero, zero, _si(written, registry))


def _find_simple(text: str) -> Unit | None:
    """Return a product of SI units with prefixes, such as `N.cm` or `g.cm2`; None for other units: pint knows them."""
    kilograms, power = _GRAM.subn("kg", text)
    power *= -3

    def plain(word: re.Match[str]) -> str:
        nonlocal power
        symbol, prefix, rest = word[1], word[1][0], word[1][1:]
        if symbol in _COHERENT or prefix not in _POWERS or rest == "kg":
            return word[0]
        power += _POWERS[prefix] * int(word[2] or 1) * (-1 if "/" in kilograms[: word.start()] else 1)
        return f"{rest}{word[2] or ''}"

    si = _WORD.sub(plain, kilograms)
    return Unit(Decimal(10) ** power, Decimal(0), _PRODUCTS.get(si, si)) if _MODELICA.fullmatch(si) else None


def is_same_kind(text: str, other: str) -> bool:
    """Return whether numbers can be converted between two units. Raises the errors of `find_unit`."""
    text, other = map(_with_dots, (text, other))
    if text == other:
        return True
    registry = _load_registry(text)
    return bool(_quantity(registry, 1, text).is_compatible_with(_quantity(registry, 1, other)))


def _with_dots(text: str) -> str:
    """Return a unit with `N.m` instead of `Nm` and the like, and with `ozf.in` instead of `oz-in`.

    pint reads `Nm` as a textile unit, an ounce and a kilogram as masses; the torque of servos is in ounces or kilograms
    of force. Raises ValueError for a long text, since pint would try all places for the end of a prefix.
    """
    if len(text) > _LONGEST:
        raise ValueError(f"`{text[:_LONGEST]}…` is no unit")
    dotted = re.sub(r"\b([mk]?N(?=[cm]?m\b)|[kM]?V(?=A\b))", r"\1.", text)
    return re.sub(r"\b(oz|kg)f?[.-](in|cm)\b(?!/s)", r"\1f.\2", dotted)


def _load_registry(text: str) -> Any:
    try:
        return _registry()
    except ImportError:
        hint = install_command("table")
        raise SourceError.of("no-pint", f"the unit `{text}` needs pint, which is not installed", hint=hint) from None


@functools.lru_cache(maxsize=1)
def _registry() -> Any:
    import pint

    registry: Any = pint.UnitRegistry(non_int_type=Decimal)
    registry.define("Ohm = ohm")
    return registry


def _quantity(registry: Any, number: int, text: str) -> Any:
    product = re.sub(r"(?<=[\w%°)])\.(?=[^\W\d(])", "*", text) if _UNIT.fullmatch(text) else "no unit"
    try:
        quantity = registry.Quantity(Decimal(number), re.sub(r"(?<=[^\W\d])(-?[1-9])", r"**\1", product))
    except Exception:  # noqa: BLE001 - pint parses any text, and raises many kinds of errors
        raise ValueError(f"`{text}` is no unit") from None
    for name, power in quantity.unit_items():
        prefix, unit, _ = next(iter(registry.parse_unit_name(name)))
        if unit not in _KNOWN or prefix not in _PREFIXES:
            raise ValueError(f"`{text}` is no unit: {name.replace('_', ' ')} is not known here")
        if power % 1:
            raise ValueError(f"`{text}` is no unit: Modelica has whole powers alone")
    return quantity


def _si(quantity: Any, registry: Any) -> str:
    """Return the SI unit of a quantity in Modelica's spelling; its factors keep their order. `1` stands for no unit."""
    powers = defaultdict[str, int](int)
    for name, power in quantity.unit_items():
        for symbol, inner in _coherent(name, registry).items():
            powers[symbol] += int(power * inner)
    above = [f"{symbol}{power if power > 1 else ''}" for symbol, power in powers.items() if power > 0]
    below = [f"{symbol}{-power if power < -1 else ''}" for symbol, power in powers.items() if power < 0]
    quotient = f"/{below[0] if len(below) == 1 else '(' + '.'.join(below) + ')'}" if below else ""
    unit = f"{'.'.join(above) or '1'}{quotient}"
    return _PRODUCTS.get(unit, unit)


def _coherent(name: str, registry: Any) -> Mapping[str, int]:
    """Return a unit with pint's name as powers of SI units: without its prefix, or in `_DERIVED` or base units."""
    _, unit, _ = next(iter(registry.parse_unit_name(name)))
    symbol = "Ohm" if unit == "ohm" else str(registry.get_symbol(unit))
    if symbol in _COHERENT:
        return {symbol: 1}
    quantity = registry.Quantity(1, name)
    if derived := next(filter(quantity.is_compatible_with, _DERIVED), ""):
        return {derived: 1}
    return {registry.get_symbol(base): power for base, power in quantity.to_base_units().unit_items()}
