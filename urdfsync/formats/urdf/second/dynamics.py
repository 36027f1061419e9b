"""The numbers of `<dynamics>` and their laws, written a second time, to check the first reading and models.

A loss or a mechanism stands here once: its number in `LOSSES` or `OF_AXES`, its effort in `loss_efforts` or
`mechanism_efforts`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

LOSSES = {"damping": "damping", "friction": "friction"}
"""Numbers of losses in records, with their attributes in `<dynamics>`; planar joints have them for each direction."""
OF_AXES = {"armature": "armature", "springStiffness": "spring_stiffness", "springReference": "spring_reference"}
"""The other numbers in records, which only a joint that turns about or slides along an axis has."""
DEFAULTS = {"damping": 0.0, "friction": 0.0}
"""Attributes that records have for each `<dynamics>`. Records leave out other numbers if the source does."""


def paths(kind: str) -> Mapping[str, str]:
    """Return the attributes of `<dynamics>` by their paths in the record of a joint of a type."""
    match kind:
        case "revolute" | "continuous" | "prismatic":
            return {f"dynamics.{field}": attribute for field, attribute in (LOSSES | OF_AXES).items()}
        case "planar":
            groups = ("translation", "rotation")
            return {f"{group}.{field}": attribute for group in groups for field, attribute in LOSSES.items()}
        case "ball":
            return {"damping": "damping"}
    return {}


def loss_efforts(numbers: Mapping[str, Any], velocities: Any) -> Any:
    """Return the efforts that losses take from the drives at velocities.

    `numbers` has the attributes, and the steepness of dry friction. All are arrays with a value for each coordinate.
    """
    dry = numbers["friction"] * np.tanh(numbers["steepness"] * velocities / 2)
    return numbers["damping"] * velocities + dry


def mechanism_efforts(numbers: Mapping[str, Any], positions: Any) -> Any:
    """Return the efforts that mechanisms take from the drives at positions, likewise.

    An effort that pushes a joint towards positive positions is negative.
    """
    return numbers["spring_stiffness"] * (positions - numbers["spring_reference"])
