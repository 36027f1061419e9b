"""Units of columns: what a number is multiplied by, and added, to be in SI."""

from __future__ import annotations

import functools
import re
from decimal import Decimal
from typing import Any, NamedTuple

from urdfsync.diagnostics import SourceError
from urdfsync.extras import install_command

_COHERENT = frozenset("m kg s A K mol cd rad sr Hz N Pa J W C V F Ohm S Wb T H lm lx Bq Gy kat".split())
"""The SI units without a prefix: most tables have no others, and pint takes longer to load than a whole build."""
_UNIT = re.compile(r"(?=.)(?!.*[.*/^]{2})(1/)?[^\W\d_%°]*[%°]?[\w.*/()^-]*")
_TERM = re.compile(r"([A-Za-z]+)(-?[1-9])?")


class Unit(NamedTuple):
    """A unit: a number in it, times `factor` plus `offset`, is in the SI unit `si`."""

    factor: Decimal
    offset: Decimal
    si: str
    """As Modelica writes it, for example `kg.m2/s2`; `1` for a number without unit."""

    def convert(self, number: Decimal) -> float:
        """Return a number in SI."""
        return float(number * self.factor + self.offset)


@functools.lru_cache(maxsize=256)
def find_unit(text: str) -> Unit:
    """Return a unit such as `N.cm`, `kg.m2`, `W/(m2.K)` or `degC`; `1` is a number without unit.

    Raises ValueError for an unknown one, SourceError without pint.
    """
    if text == "1" or _is_coherent(text):
        return Unit(Decimal(1), Decimal(0), text)
    registry = _load_registry(text)
    one, zero = (_quantity(registry, number, text).to_base_units() for number in (1, 0))
    factor = one.magnitude - zero.magnitude
    return Unit(factor, zero.magnitude, _si(text, registry) or _as_modelica(one.unit_items(), registry))


def is_same_kind(text: str, other: str) -> bool:
    """Whether numbers in one unit can be converted to the other one. Raises as `find_unit`."""
    if text == other:
        return True
    registry = _load_registry(text)
    return bool(_quantity(registry, 1, text).is_compatible_with(_quantity(registry, 1, other)))


def _is_coherent(text: str) -> bool:
    """Whether a unit is a product of SI units without prefixes, over at most one such product."""
    terms = re.split(r"[./]", text) if text.count("/") <= 1 else [""]
    return all((term := _TERM.fullmatch(part)) and term[1] in _COHERENT for part in terms)


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
        return registry.Quantity(Decimal(number), re.sub(r"(?<=[^\W\d])(-?[1-9])", r"**\1", product))
    except Exception:  # noqa: BLE001 - pint parses any text, and raises errors of many kinds
        raise ValueError(f"`{text}` is no unit") from None


def _si(text: str, registry: Any) -> str:
    """Return a unit without its prefixes if that is in SI, such as `N.m` for `N.cm`; else nothing."""
    plain = re.sub(r"[A-Za-z]+", lambda match: _without_prefix(match[0], registry), text)
    quantity = _quantity(registry, 0, plain).to_base_units()
    return plain if quantity.magnitude == 0 and _quantity(registry, 1, plain).to_base_units().magnitude == 1 else ""


def _without_prefix(symbol: str, registry: Any) -> str:
    if symbol in _COHERENT:
        return symbol
    names = [name for prefix, name, _ in registry.parse_unit_name(symbol) if prefix]
    plain = "Ohm" if names and names[0] == "ohm" else str(registry.get_symbol(names[0])) if names else symbol
    return plain if plain in _COHERENT else symbol


def _as_modelica(units: Any, registry: Any) -> str:
    """Return base units as Modelica writes them, for example `kg.m2/(s2.K)`; `1` for none."""
    powers = [(registry.get_symbol(name), power) for name, power in units]
    above = [f"{symbol}{power if power != 1 else ''}" for symbol, power in powers if power > 0]
    below = [f"{symbol}{-power if power != -1 else ''}" for symbol, power in powers if power < 0]
    if not below:
        return ".".join(above) or "1"
    return f"{'.'.join(above) or '1'}/{below[0] if len(below) == 1 else '(' + '.'.join(below) + ')'}"
