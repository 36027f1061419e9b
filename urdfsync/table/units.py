"""Converts the numbers of columns to SI."""

from __future__ import annotations

import functools
import re
from decimal import Decimal
from typing import Any, NamedTuple

from urdfsync.diagnostics import SourceError
from urdfsync.extras import install_command

_COHERENT = frozenset("m kg s A K mol cd rad sr Hz N Pa J W C V F Ohm S Wb T H lm lx Bq Gy kat".split())
"""The SI units without a prefix: loading pint takes longer than a whole build."""
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
    "watt_hour ampere_hour volt_ampere calorie british_thermal_unit knot kilometer_per_hour mile_per_hour percent "
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
    one, zero = (_quantity(registry, number, text).to_base_units() for number in (1, 0))
    factor = one.magnitude - zero.magnitude
    return Unit(factor, zero.magnitude, _si(text, registry) or _as_modelica(one.unit_items(), registry))


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
    return Unit(Decimal(10) ** power, Decimal(0), si) if _MODELICA.fullmatch(si) else None


def is_same_kind(text: str, other: str) -> bool:
    """Return whether numbers can be converted between two units. Raises the errors of `find_unit`."""
    text, other = map(_with_dots, (text, other))
    if text == other:
        return True
    registry = _load_registry(text)
    return bool(_quantity(registry, 1, text).is_compatible_with(_quantity(registry, 1, other)))


def _with_dots(text: str) -> str:
    """Return a unit with `N.m` instead of `Nm` and the like, and with `ozf.in` instead of `oz-in`.

    pint reads `Nm` as a textile unit, and an ounce as a mass; the torque of servos is in ounces of force. Raises
    ValueError for a long text, since pint would try all places for the end of a prefix.
    """
    if len(text) > _LONGEST:
        raise ValueError(f"`{text[:_LONGEST]}…` is no unit")
    return re.sub(r"\bozf?[.-]in\b", "ozf.in", re.sub(r"\b([mk]?N)([cm]?m)\b", r"\1.\2", text))


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
    for name, _ in quantity.unit_items():
        prefix, unit, _ = next(iter(registry.parse_unit_name(name)))
        if unit not in _KNOWN or prefix not in _PREFIXES:
            raise ValueError(f"`{text}` is no unit: {name.replace('_', ' ')} is not known here")
    return quantity


def _si(text: str, registry: Any) -> str:
    """Return a unit without prefixes, such as `N.m` for `N.cm`; empty if Modelica can't write this unit."""
    plain = re.sub(r"[A-Za-z]+", lambda match: _without_prefix(match[0], registry), text)
    return plain if _MODELICA.fullmatch(plain) else ""


def _without_prefix(symbol: str, registry: Any) -> str:
    names = [name for prefix, name, _ in registry.parse_unit_name(symbol) if prefix]
    plain = "Ohm" if names and names[0] == "ohm" else str(registry.get_symbol(names[0])) if names else symbol
    return plain if plain in _COHERENT else symbol


def _as_modelica(units: Any, registry: Any) -> str:
    """Return base units in Modelica's spelling, for example `kg.m2/(s2.K)`; `1` for no unit."""
    powers = [(registry.get_symbol(name), power) for name, power in units]
    above = [f"{symbol}{power if power != 1 else ''}" for symbol, power in powers if power > 0]
    below = [f"{symbol}{-power if power != -1 else ''}" for symbol, power in powers if power < 0]
    if not below:
        return ".".join(above) or "1"
    return f"{'.'.join(above) or '1'}/{below[0] if len(below) == 1 else '(' + '.'.join(below) + ')'}"
