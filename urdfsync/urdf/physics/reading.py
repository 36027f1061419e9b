"""Pinocchio's own reading of a URDF: nothing of ours is between the file and the reference but its XML.

Only `mimic` elements are taken from the XML, since Pinocchio's reader leaves them out.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.extras import install_command
from urdfsync.urdf.parse import xml
from urdfsync.urdf.robot import Mimic

Array = NDArray[np.float64]


class PinocchioRobot(NamedTuple):
    """What the reference knows of a robot."""

    model: Any
    """Pinocchio's model; its first joint is the free motion of the root link."""
    followers: Mapping[str, Mimic]
    """By joint."""


def read(content: bytes, file: str) -> PinocchioRobot:
    """Read a URDF with Pinocchio. Raises SourceError if Pinocchio is not installed or refuses the file."""
    pin = pinocchio()
    root = xml.parse(content).root
    followers = {
        joint.get("name", ""): Mimic(
            mimic.get("joint", ""), float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))
        )
        for joint in root.findall("joint")
        for mimic in joint.findall("mimic")
    }
    unused = "_" * (1 + max(len(element.get("name", "")) for element in root.iter()))
    try:
        model = pin.buildModelFromXML(content.decode("utf-8-sig"), pin.JointModelFreeFlyer(), unused)
    except (ValueError, RuntimeError) as error:
        message = f"Pinocchio can't read this file: {str(error).rstrip('.')}"
        hint = "correct the file, or compare it without physics"
        raise SourceError(Diagnostic(Severity.ERROR, "pinocchio-refuses", message, file, hint=hint)) from error
    return PinocchioRobot(model, followers)


def pinocchio() -> Any:
    """The library; raises SourceError if it is not installed."""
    try:
        import pinocchio  # an optional extra
    except ImportError:
        message = "Pinocchio, the reference for physics, is not installed"
        hint = install_command("physics")
        raise SourceError(Diagnostic(Severity.ERROR, "no-pinocchio", message, hint=hint)) from None
    return pinocchio
