"""The numbers of `<dynamics>` and the laws of mechanisms, written a second time, to check the first reading and models.

A mechanism stands here once: its numbers in `OF_DYNAMICS`, its effort in `mechanism_efforts`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

OF_DYNAMICS = {"armature": "armature", "springStiffness": "spring_stiffness", "springReference": "spring_reference"}
"""Numbers of the records of axes that records leave out if the source does, with their attributes in `<dynamics>`."""


def mechanism_efforts(numbers: Mapping[str, Any], positions: Any) -> Any:
    """Return the efforts that mechanisms take from the drives at positions; `numbers` are those of `OF_DYNAMICS`.

    All are arrays with a value for each joint. An effort that pushes a joint towards positive positions is negative.
    """
    return numbers["spring_stiffness"] * (positions - numbers["spring_reference"])
