"""yourdfpy as second reader: an independent reading of the same bytes, to find a misreading before it spreads.

Loading this module takes most of a second, because of yourdfpy.
"""

from __future__ import annotations

import io
import logging
from collections.abc import Iterator
from typing import Any

import yourdfpy

from urdfsync.diagnostics import Severity
from urdfsync.urdf.robot import Robot
from urdfsync.urdf.validate import Finding

# What yourdfpy raises for files that the strict reader accepts: it expects attributes that may be absent.
_FAILURES = (ArithmeticError, AttributeError, LookupError, SyntaxError, TypeError, ValueError)
_SHOWN = 5
_HINT = "please report this file; cross_check = false builds it as urdfsync reads it"


def compare_readers(content: bytes, robot: Robot) -> Iterator[Finding]:
    """Compare the names, types and tree of `robot` with what yourdfpy reads from the same bytes."""
    try:
        other = _read(content)
    except _FAILURES as error:
        yield _not_checked(f"can't read this file ({_reason(error)})")
        return
    if robot.links and not other.links:
        yield _not_checked("finds no link in this file")
        return
    links = _difference({link.name for link in robot.links}, {str(link.name) for link in other.links})
    if links:
        yield Finding(Severity.ERROR, "second-reader-differs", "robot", f"yourdfpy reads other links: {links}", _HINT)
    joints = _difference(
        {f"{joint.name} ({joint.type}, {joint.parent} → {joint.child})" for joint in robot.joints},
        {f"{joint.name} ({joint.type}, {joint.parent} → {joint.child})" for joint in other.joints},
    )
    if joints:
        yield Finding(Severity.ERROR, "second-reader-differs", "robot", f"yourdfpy reads other joints: {joints}", _HINT)


def _not_checked(reason: str) -> Finding:
    message = f"not cross-checked: yourdfpy {reason}"
    return Finding(Severity.NOTE, "second-reader-failed", "robot", message, "the strict reading alone counts")


def _reason(error: Exception) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split())}"[:120]


def _difference(ours: set[str], theirs: set[str]) -> str:
    """Return the names that only one of the readers has; empty if they agree."""
    parts = []
    for title, names in (("without", ours - theirs), ("with", theirs - ours)):
        if names:
            shown = sorted(names)[:_SHOWN] + ["…"] * (len(names) > _SHOWN)
            parts.append(f"{title} {', '.join(shown)}")
    return "; ".join(parts)


def _read(content: bytes) -> Any:
    """Return the robot as yourdfpy reads it."""
    logger = logging.getLogger("yourdfpy.urdf")
    before, logger.disabled = logger.disabled, True  # every problem is reported here
    try:
        return yourdfpy.URDF.load(io.BytesIO(content), load_meshes=False, build_scene_graph=False).robot
    finally:
        logger.disabled = before
