"""Reads the rows of the catalogue, with their units, for the second reading and for Pinocchio."""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping
from typing import Any

PATHS = {
    **{name: f"limits.{name}" for name in ("effort", "velocity")},
    **{name: f"dynamics.{name}" for name in ("damping", "friction", "armature")},
    "reduction": "transmission.reduction",
    "rotor_inertia": "transmission.rotorInertia",
}
"""Numbers of a row, and their paths in records."""


def read_motors(root: Any) -> Mapping[str, Mapping[str, float]]:
    """Return the numbers of each joint with a row, in SI."""
    return {
        row.get("joint"): {name: _read(text) for name, text in row.items() if name in PATHS}
        for row in root.findall("catalogue_row")
    }


@functools.lru_cache(maxsize=256)  # pint's registry takes 0.3 s
def _read(text: str) -> float:
    """Return a number with a unit, such as `410 [N.cm]`, in SI."""
    number, unit = text.removesuffix("]").split("[")
    try:
        import pint
    except ImportError:
        return float(number)  # without pint, the first reading refuses all units but SI units
    torque = re.sub(r"\b([mk]?N)([cm]?m)\b", r"\1.\2", unit.replace("integer", "1"))
    torque = re.sub(r"\boz(?:f|)[-.]in\b", "ozf*in", torque)
    product = re.sub(r"(?<=[^\W\d])\.", "*", torque)
    one: Any = pint.Quantity(re.sub(r"(?<=[A-Za-z])(-?\d)", r"**\1", product))
    return float(number) * float(one.to_base_units().magnitude)
