"""Units of columns: what a number is multiplied by, and added, to be in SI."""

from __future__ import annotations

import functools
import math
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
    one, zero = (_in_si(_quantity(registry, number, text), registry) for number in (1, 0))
    return Unit(one.magnitude - zero.magnitude, zero.magnitude, _as_modelica(one.unit_items(), registry))


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
    import platformdirs

    cache = platformdirs.user_cache_path("urdfsync", appauthor=False) / "units"  # saves 0.3 s of 0.8
    registry: Any = pint.UnitRegistry(non_int_type=Decimal, cache_folder=cache)
    registry.define("Ohm = ohm")
    return registry


def _quantity(registry: Any, number: int, text: str) -> Any:
    product = re.sub(r"(?<=[\w%°)])\.(?=[^\W\d(])", "*", text) if _UNIT.fullmatch(text) else "no unit"
    try:
        return registry.Quantity(Decimal(number), re.sub(r"(?<=[^\W\d])(-?[1-9])", r"**\1", product))
    except Exception:  # noqa: BLE001 - pint parses any text, and raises errors of many kinds
        raise ValueError(f"`{text}` is no unit") from None


def _in_si(quantity: Any, registry: Any) -> Any:
    """Return a quantity in its own units without their prefixes if these are SI units, as N.m; else in base units."""
    roots = {name: registry.parse_unit_name(name)[0][1] for name, _ in quantity.unit_items()}
    if not all(registry.get_symbol(root) in _COHERENT for root in roots.values()):
        return quantity.to_base_units()
    factors = (registry.Quantity(Decimal(1), roots[name]) ** power for name, power in quantity.unit_items())
    return quantity.to(math.prod(factors, start=registry.Quantity(Decimal(1), "")).units)


def _as_modelica(units: Any, registry: Any) -> str:
    """Return base units as Modelica writes them, for example `kg.m2/(s2.K)`; `1` for none."""
    powers = [(registry.get_symbol(name), power) for name, power in units]
    above = [f"{symbol}{power if power != 1 else ''}" for symbol, power in powers if power > 0]
    below = [f"{symbol}{-power if power != -1 else ''}" for symbol, power in powers if power < 0]
    if not below:
        return ".".join(above) or "1"
    return f"{'.'.join(above) or '1'}/{below[0] if len(below) == 1 else '(' + '.'.join(below) + ')'}"
