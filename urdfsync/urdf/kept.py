"""What one piece of work keeps for the next of its kind, in a process that does it again and again.

Most elements of a large model are the same objects as the last time: finding the others is left to calls that go
through all of them in C, and a call of ours for each is made only of those.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Hashable, Mapping
from itertools import compress, repeat
from typing import Any, TypeVar

from urdfsync.domain import Parts, Piece

_Value = TypeVar("_Value")
_Element = TypeVar("_Element")
_ABSENT = object()


def changed(last: Mapping[str, Any], now: Mapping[str, Any]) -> list[str]:
    """Names of the elements that are other objects than those of the last time, or new."""
    before = map(last.get, now, repeat(_ABSENT))
    return list(compress(now, map(operator.is_not, before, now.values())))


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
        value: _Value = self._keep(name, *known)
        return value

    def each(
        self, name: Hashable, make: Callable[..., _Value], elements: Mapping[str, _Element], *common: Any
    ) -> Mapping[str, _Value]:
        """What is made of each element, its name before it and what all have in common behind it; in their order."""
        values: Mapping[str, _Value]
        (last, *others), values = self._last.get(name, ((None,), {}))
        if last is None or any(map(operator.is_not, others, common)):
            last, values = {}, {}
        made = {key: make(key, elements[key], *common) for key in changed(last, elements)}
        values = {**values, **made} if made else values
        if list(values) != list(elements):
            values = dict(zip(elements, map(values.__getitem__, elements), strict=True))
        return self._keep(name, (elements, *common), values)

    def piece(self, of: _Value) -> _Value | Piece:
        """What a part of a text is made of, or its recipe; as a piece, if anything is kept."""
        return Piece(of) if self._keeps else of

    def same(self, name: Hashable, value: _Value) -> _Value:
        """The value of the last time if this one is equal to it: for what gives the same texts then."""
        known = self._last.get(name)
        if known is None or known[1] != value:
            known = (), value
        found: _Value = self._keep(name, *known)
        return found

    def _keep(self, name: Hashable, made_of: tuple[Any, ...], value: _Value) -> _Value:
        if self._keeps:
            self._now[name] = made_of, value
        return value
