"""What a process remembers of the robot that it built last, for one that builds again and again.

Each entry stands with all that it was made of, and serves only who asks for exactly that: a memory spares work, and
never says what is on disk. Of each kind there is one entry, so a memory is as large as one robot.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Generic, TypeVar

import msgspec

from urdfsync.domain import Artifact, Domain, Import, Order, Parts, Reading, Snapshot, Target
from urdfsync.files import digest
from urdfsync.planning import generate

_Value = TypeVar("_Value")


class Memory:
    """The source that was read last, and the files that were made last of a model."""

    def __init__(self) -> None:
        self._reading: _Last[Reading] = _Last()
        self._parts: _Last[Parts] = _Last()
        self._artifacts: _Last[Sequence[Artifact | Order]] = _Last()

    def read(self, domain: Domain, options: Any, content: bytes, name: str) -> Reading:
        """What the domain reads in a source: who judges one, and then builds it, reads it once.

        What the next version of the source has in common with it need not be read again.
        """
        parts = self._parts.get((domain, options, name), dict)
        return self._reading.get((domain, options, content, name), lambda: domain.read(content, name, options, parts))

    def artifacts(
        self, domain: Domain, snapshot: Snapshot, imports: Mapping[str, Import], target: Target, options: Any
    ) -> Sequence[Artifact | Order]:
        """The files of a package, see `generate.artifacts`: those of the last build are those that it has made.

        What they are made of is compared as JSON, in which the numbers 1 and 1.0 differ, as they do in a text.
        """
        made_of = msgspec.json.encode((snapshot, imports, target, options), order="sorted")
        return self._artifacts.get(
            (domain, digest(made_of)), lambda: generate.artifacts(domain, snapshot, imports, target, options)
        )


class _Last(Generic[_Value]):
    """The last value of a kind, with its key."""

    def __init__(self) -> None:
        self._entry: tuple[object, _Value] | None = None

    def get(self, key: object, make: Callable[[], _Value]) -> _Value:
        """The value of this key, made unless it is the last one; where that raises, the last one stays."""
        if self._entry is None or self._entry[0] != key:
            self._entry = key, make()
        return self._entry[1]
