"""yourdfpy as second reader: an independent reading of the same bytes, to find a misreading before it spreads.

Loading this module takes most of a second, because of yourdfpy.
"""

from __future__ import annotations

import hashlib
import io
import logging
from collections.abc import Iterator, Mapping
from typing import Any

import yourdfpy

from urdfsync.urdf.robot import Robot
from urdfsync.urdf.validate import Finding

# What yourdfpy raises for files that the strict reader accepts: it expects attributes that may be absent.
_FAILURES = (ArithmeticError, AttributeError, LookupError, SyntaxError, TypeError, ValueError)
_SHOWN = 5
_TEXTS = 100

_Structure = Mapping[str, frozenset[str]]
"""What both readers have to agree on: names of links, and names, types, parents and children of joints."""

# The structure on which both readers have agreed, by the hash of a text without the characters of numbers. Most changes
# in the daemon are of numbers; not to ask again saves 130 of the 250 ms that a changed mass of 1,000 links may take.
_agreed: dict[bytes, _Structure] = {}


def compare_readers(content: bytes, robot: Robot) -> Iterator[Finding]:
    """Compare the names, types and tree of `robot` with what yourdfpy reads from the same bytes."""
    ours = _structure(robot)
    text = hashlib.sha256(content.translate(None, b"0123456789+-.eE")).digest()
    if _agreed.get(text) == ours:
        return
    theirs: _Structure | None = None
    failure = "finds no link in this file"
    logger = logging.getLogger("yourdfpy.urdf")
    before, logger.disabled = logger.disabled, True  # every problem is reported here
    try:
        theirs = _structure(yourdfpy.URDF.load(io.BytesIO(content), load_meshes=False, build_scene_graph=False).robot)
    except _FAILURES as error:
        reason = f"{type(error).__name__}: {' '.join(str(error).split())}"[:120]
        failure = f"can't read this file ({reason})"
    finally:
        logger.disabled = before
    if theirs is None or (ours["links"] and not theirs["links"]):
        yield Finding("second-reader-failed", "robot", f"not cross-checked: yourdfpy {failure}")
        return
    for kind, one in ours.items():
        parts = []
        for title, names in (("without", one - theirs[kind]), ("with", theirs[kind] - one)):
            if names:
                shown = sorted(names)[:_SHOWN] + ["…"] * (len(names) > _SHOWN)
                parts.append(f"{title} {', '.join(shown)}")
        if parts:
            yield Finding("second-reader-differs", "robot", f"yourdfpy reads other {kind}: {'; '.join(parts)}")
    if theirs == ours:
        _agreed[text] = ours
        for old in list(_agreed)[:-_TEXTS]:
            del _agreed[old]


def _structure(robot: Any) -> _Structure:
    """Return what has to agree; the attributes of both readers' robots have the same names."""
    return {
        "links": frozenset(str(link.name) for link in robot.links),
        "joints": frozenset(f"{joint.name} ({joint.type}, {joint.parent} → {joint.child})" for joint in robot.joints),
    }
