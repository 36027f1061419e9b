"""yourdfpy as second reader: an independent reading of the same bytes, to find a misreading before it spreads.

Loading this module takes most of a second, because of yourdfpy.
"""

from __future__ import annotations

import hashlib
import io
import logging
from collections.abc import Iterator, Set
from typing import Any, NamedTuple

import yourdfpy

from urdfsync.urdf.robot import Robot
from urdfsync.urdf.validate import Finding

# What yourdfpy raises for files that the strict reader accepts: it expects attributes that may be absent.
_FAILURES = (ArithmeticError, AttributeError, LookupError, SyntaxError, TypeError, ValueError)
_SHOWN = 5
_TEXTS = 100


class _Structure(NamedTuple):
    """What both readers have to agree on."""

    links: frozenset[str]
    joints: frozenset[str]
    """Each with its name, type, parent and child."""


# The structure on which both readers have agreed, by the hash of a text without the characters of numbers. Most changes
# in the daemon are of numbers; not to ask again saves 130 of the 250 ms that a changed mass of 1,000 links may take.
_agreed: dict[bytes, _Structure] = {}


def compare_readers(content: bytes, robot: Robot) -> Iterator[Finding]:
    """Compare the names, types and tree of `robot` with what yourdfpy reads from the same bytes."""
    ours = _structure(robot)
    text = hashlib.sha256(content.translate(None, b"0123456789+-.eE")).digest()
    if _agreed.get(text) == ours:
        return
    theirs = _read(content)
    if isinstance(theirs, str):
        yield _not_checked(f"can't read this file ({theirs})")
    elif ours.links and not theirs.links:
        yield _not_checked("finds no link in this file")
    else:
        for kind, one, other in zip(_Structure._fields, ours, theirs, strict=True):
            if one != other:
                message = f"yourdfpy reads other {kind}: {_difference(one, other)}"
                yield Finding("second-reader-differs", "robot", message)
    if theirs == ours:
        _agreed[text] = ours
        for old in list(_agreed)[:-_TEXTS]:
            del _agreed[old]


def _structure(robot: Any) -> _Structure:
    """Return what has to agree; the attributes of both readers' robots have the same names."""
    return _Structure(
        frozenset(str(link.name) for link in robot.links),
        frozenset(f"{joint.name} ({joint.type}, {joint.parent} → {joint.child})" for joint in robot.joints),
    )


def _not_checked(reason: str) -> Finding:
    return Finding("second-reader-failed", "robot", f"not cross-checked: yourdfpy {reason}")


def _difference(ours: Set[str], theirs: Set[str]) -> str:
    """Return the names that only one of the readers has."""
    parts = []
    for title, names in (("without", ours - theirs), ("with", theirs - ours)):
        if names:
            shown = sorted(names)[:_SHOWN] + ["…"] * (len(names) > _SHOWN)
            parts.append(f"{title} {', '.join(shown)}")
    return "; ".join(parts)


def _read(content: bytes) -> _Structure | str:
    """Return what yourdfpy reads, or why it can't read it, in a few words."""
    logger = logging.getLogger("yourdfpy.urdf")
    before, logger.disabled = logger.disabled, True  # every problem is reported here
    try:
        read = yourdfpy.URDF.load(io.BytesIO(content), load_meshes=False, build_scene_graph=False)
        return _structure(read.robot)
    except _FAILURES as error:
        return f"{type(error).__name__}: {' '.join(str(error).split())}"[:120]
    finally:
        logger.disabled = before
