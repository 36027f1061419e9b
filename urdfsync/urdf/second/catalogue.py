"""Reads the rows of the catalogue once more, with their units, for the second reading and for Pinocchio."""

from __future__ import annotations

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
    """Return the numbers of each joint that has a row, in SI."""
    header = root.find("catalogue_header")
    factors = {} if header is None else {name: _factor(text) for name, text in header.items() if name in PATHS}
    motors = dict[str, dict[str, float]]()
    for row in root.findall("catalogue_row"):
        cells = {name: (row.get(name) or "").strip() for name in factors}
        motors[row.get("joint")] = {name: float(text) * factors[name] for name, text in cells.items() if text}
    return motors


def _factor(header: str) -> float:
    """Return the factor from the unit in a header to SI."""
    unit = header.partition("[")[2].partition("]")[0].strip()
    try:
        import pint
    except ImportError:
        return 1.0  # without pint, the first reading refuses all units but those of SI
    if unit in ("1", "integer"):
        return 1.0
    product = re.sub(r"(?<=[^\W\d])\.", "*", unit)
    return float(pint.UnitRegistry()(re.sub(r"(?<=[A-Za-z])(-?\d)", r"**\1", product)).to_base_units().magnitude)
