"""Which things of three versions of a body are the same thing, where their names alone do not say so.

Equations, connections and base classes are named by what they say. Where both sides have taken one out of base, what
stands there instead is its new version: else both new ones would stay, side by side.
"""

from __future__ import annotations

from collections import defaultdict

import msgspec

from urdfsync.modelica.tree import Leaf, Part, SyntaxTree, is_equation, key_by_whole_equation

_ALIKE = 0.5
"""Share of words that two equations have in common at least, if one is the new version of the other."""
_MOST_COMPARISONS = 200_000
"""So many pairs of equations are compared at most: a second."""


class TooManyPairsError(Exception):
    """So many things have other versions that comparing each with each would take minutes."""


def pair(base: SyntaxTree, mine: SyntaxTree, generated: SyntaxTree) -> tuple[SyntaxTree, SyntaxTree, SyntaxTree]:
    """Return the three bodies with one key for each thing. Raises TooManyPairsError."""
    base, mine, generated = key_by_whole_equation(base, mine, generated)
    gone = [part for part in base.parts if not mine.find(part.key) and not generated.find(part.key)]
    if not gone:
        return base, mine, generated
    ours, theirs = _Added(mine, base), _Added(generated, base)
    for part in gone:
        one, other = ours.find_version(part), theirs.find_version(part)
        if (one and other) or ((one or other) and is_equation(part)):
            ours.take(one, part.key)
            theirs.take(other, part.key)
    return base, ours.with_keys(), theirs.with_keys()


class _Added:
    """The parts of a side that base lacks; each is the new version of one thing at most."""

    def __init__(self, side: SyntaxTree, base: SyntaxTree) -> None:
        self._side = side
        self._keys: dict[int, str] = {}
        """Keys in base of parts that are new versions, by the identity of the part."""
        self._parts = defaultdict[str, list[Part]](list)
        """Parts by the first word of their keys, connections also by each of their ends."""
        for part in side.parts:
            if not base.find(part.key):
                kind, *ends = part.key.split()
                for name in (kind, *set(ends)) if kind == "connect" else (kind,):
                    self._parts[name].append(part)
        self._comparisons = 0

    def find_version(self, part: Part) -> Part | None:
        """What the side has instead of a thing of base."""
        kind, *ends = part.key.split()
        if is_equation(part):
            added = self._free(kind)
            self._comparisons += len(added)
            if self._comparisons > _MOST_COMPARISONS:
                raise TooManyPairsError
            alike = [(_likeness(part, one), one) for one in added]
            best = max(alike, key=lambda pair: pair[0], default=None)
            return best[1] if best and best[0] >= _ALIKE else None
        if kind == "connect":
            return next((one for end in ends for one in self._free(end) if one.key.startswith("connect ")), None)
        return next(iter(self._free(kind)), None) if kind == "extends" else None

    def _free(self, name: str) -> list[Part]:
        self._parts[name] = [part for part in self._parts[name] if id(part) not in self._keys]
        return self._parts[name]

    def take(self, version: Part | None, key: str) -> None:
        """Name a part as the thing of base that it is a version of."""
        if version:
            self._keys[id(version)] = key

    def with_keys(self) -> SyntaxTree:
        """Return the body with the keys that were taken."""
        parts = [msgspec.structs.replace(one, key=self._keys.get(id(one), one.key)) for one in self._side.parts]
        return self._side.with_parts(parts)


def _likeness(one: Part, other: Part) -> float:
    words, others = map(_words, (one, other))
    return len(words & others) / max(len(words | others), 1)


def _words(part: Part) -> set[object]:
    leaf = part.node.parts[0].node if isinstance(part.node, SyntaxTree) else part.node
    return set(leaf.words) if isinstance(leaf, Leaf) else set()
