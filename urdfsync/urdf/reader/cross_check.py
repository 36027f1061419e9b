"""yourdfpy as second reader: an independent look at the same bytes, to catch a misreading before it spreads.

yourdfpy is imported at the first call only; it takes most of a second.
"""

from __future__ import annotations

import contextlib
import io
import logging
from collections.abc import Iterator
from typing import Any

from urdfsync.diagnostics import Severity
from urdfsync.urdf.reader.checks import Finding
from urdfsync.urdf.robot import Robot

_FAILURES = (ArithmeticError, AttributeError, LookupError, SyntaxError, TypeError, ValueError)
"""What yourdfpy raises for files that the strict reader takes: it looks for attributes without asking."""
_SHOWN = 5
_HINT = "please report this file; cross_check = false builds it as urdfsync reads it"


def cross_check(content: bytes, robot: Robot) -> Iterator[Finding]:
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
    """A note that only one reader has seen the file."""
    message = f"not cross-checked: yourdfpy {reason}"
    return Finding(Severity.NOTE, "second-reader-failed", "robot", message, "the strict reading alone counts")


def _reason(error: Exception) -> str:
    """The exception in a few words."""
    return f"{type(error).__name__}: {' '.join(str(error).split())}"[:120]


def _difference(ours: set[str], theirs: set[str]) -> str:
    """What only one of the readers has, in a few words; empty if they agree."""
    parts = []
    for title, names in (("without", ours - theirs), ("with", theirs - ours)):
        if names:
            shown = sorted(names)[:_SHOWN] + ["…"] * (len(names) > _SHOWN)
            parts.append(f"{title} {', '.join(shown)}")
    return "; ".join(parts)


def _read(content: bytes) -> Any:
    """The robot as yourdfpy reads it; its log is switched off meanwhile, since every problem is reported here."""
    import yourdfpy

    with _silent("yourdfpy.urdf"):
        return yourdfpy.URDF.load(io.BytesIO(content), load_meshes=False, build_scene_graph=False).robot


@contextlib.contextmanager
def _silent(name: str) -> Iterator[None]:
    """Switch a logger off for a while."""
    logger = logging.getLogger(name)
    before, logger.disabled = logger.disabled, True
    try:
        yield
    finally:
        logger.disabled = before
