"""What a settled source is: a model, none, or one that has lost so much that it is better looked at again."""

from __future__ import annotations

from collections.abc import Set as AbstractSet

import msgspec

from urdfsync import registry
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine import source
from urdfsync.engine.cache import Cache
from urdfsync.files import digest

_MANY = 3
"""So many elements have to be gone at least for a source to be doubtful, and more than half of all."""


class Judgement(msgspec.Struct, frozen=True):
    """What is to be said of a source."""

    content: str = ""
    """SHA-256 (hex) of the bytes that were read; empty if they could not be."""
    errors: tuple[Diagnostic, ...] = ()
    """Why it is no model; empty if it is one."""
    gone: int = 0
    """How many of the elements of the last build it has no more, if these are many."""


def judge(
    config: Config, robot: RobotConfig, known: AbstractSet[tuple[str, str]], cache: Cache | None = None
) -> Judgement:
    """Read the source of a robot; `known` are the kinds and names of its elements in the last build."""
    try:
        content = source.read_source(config, robot)
        domain = registry.domain(robot.domain)
    except UrdfsyncError as error:
        return Judgement(errors=error.diagnostics)
    reading = source.read_cached(domain, robot.options, content, shown(robot.source), cache)
    errors = tuple(found for found in reading.diagnostics if found.severity is Severity.ERROR)
    if reading.snapshot is None or errors:
        return Judgement(digest(content), reading.diagnostics)
    named = domain.names(reading.snapshot, robot.target).items()
    gone = len(known - {(kind, name) for kind, names in named for name in names})
    return Judgement(digest(content), gone=gone if gone >= _MANY and 2 * gone > len(known) else 0)
