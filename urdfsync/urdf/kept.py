"""What one piece of work keeps for the next of its kind, in a process that does it again and again."""

from __future__ import annotations

import operator
from collections.abc import Callable, Hashable, Mapping
from typing import Any, TypeVar

from urdfsync.domain import Parts, Piece

_Value = TypeVar("_Value")
_Element = TypeVar("_Element")
_ABSENT = object()


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
        """`make(name, element, *common)` of each element, by its name and in their order.

        It is called for those alone that are other objects than the last time.
        """
        (last, *others), known = self._last.get(name, (({},), {}))
        if len(others) != len(common) or any(map(operator.is_not, others, common)):
            last, known = {}, {}
        values = {
            key: known[key] if last.get(key, _ABSENT) is element else make(key, element, *common)
            for key, element in elements.items()
        }
        return self._keep(name, (elements, *common), values)

    def piece(self, of: _Value) -> _Value | Piece:
        """What a part of a text is made of, or its recipe; as a piece, if anything is kept."""
        return Piece(of) if self._keeps else of

    def same(self, name: Hashable, value: _Value) -> _Value:
        """The object of the last time if it is equal to this value, so that what is made of it is found again.

        For values of which equal ones give the same texts.
        """
        known = self._last.get(name)
        if known is None or known[1] != value:
            known = (), value
        found: _Value = self._keep(name, *known)
        return found

    def _keep(self, name: Hashable, made_of: tuple[Any, ...], value: _Value) -> _Value:
        if self._keeps:
            self._now[name] = made_of, value
        return value
