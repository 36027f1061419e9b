"""What one piece of work keeps for the next of its kind, in a process that does it again and again."""

from __future__ import annotations

import operator
from collections.abc import Callable, Hashable
from typing import Any, TypeVar

from urdfsync.domain import Parts, Piece

_Value = TypeVar("_Value")


class Kept:
    """Values of one kind by their names, each with all that it was made of; those of the last time serve this time.

    What is not asked for this time is forgotten. Without `parts`, nothing is kept.
    """

    def __init__(self, parts: Parts | None, kind: str) -> None:
        self._last: dict[Hashable, tuple[tuple[Any, ...], Any]] = {} if parts is None else parts.get(kind, {})
        self._now: dict[Hashable, tuple[tuple[Any, ...], Any]] = {}
        self._keeps = parts is not None
        if parts is not None:
            parts[kind] = self._now

    def get(self, name: Hashable, make: Callable[..., _Value], *made_of: Any) -> _Value:
        """What is made of these very objects; equal ones don't count, since 0.0 and -0.0 are equal."""
        known = self._last.get(name)
        if known is None or any(map(operator.is_not, known[0], made_of)):
            known = made_of, make(*made_of)
        if self._keeps:
            self._now[name] = known
        value: _Value = known[1]
        return value

    def piece(self, name: Hashable, make: Callable[..., _Value], *made_of: Any) -> _Value | Piece:
        """The same as a piece of a text, if anything is kept."""
        if not self._keeps:
            return make(*made_of)
        return self.get(name, lambda *found: Piece(make(*found)), *made_of)

    def same(self, name: Hashable, value: _Value) -> _Value:
        """The value of the last time if this one is equal to it: for what gives the same texts then."""
        known = self._last.get(name)
        if known is None or known[1] != value:
            known = (), value
        if self._keeps:
            self._now[name] = known
        found: _Value = known[1]
        return found
