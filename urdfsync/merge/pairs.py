"""Pairs nodes of three versions of a body that have different keys.

Equations, connections and base classes have their texts as keys, so a changed node looks removed and added. If both
sides changed a node of base, this finds the new version on each side. Without this, both new versions would stay.
"""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Mapping, Sequence

import msgspec

from urdfsync.modelica.tree import Child, Leaf, SyntaxTree, is_equation, key_by_whole_equation

_ALIKE = 0.5
"""The least share of common words in an equation and its new version."""
_MOST_COMPARISONS = 400_000
"""The greatest number of pairs of equations to compare, in about a second."""


class TooManyPairsError(Exception):
    """There are too many changed equations: comparing all pairs would take minutes."""


def pair(base: SyntaxTree, mine: SyntaxTree, generated: SyntaxTree) -> tuple[SyntaxTree, SyntaxTree, SyntaxTree]:
    """Return the three bodies; all versions of a node have the same key. Raises TooManyPairsError."""
    base, *sides = key_by_whole_equation(base, mine, generated)
    removed = [child for child in base.children if not any(side.find(child.key) for side in sides)]
    new = [[child for child in side.children if not base.find(child.key)] for side in sides]
    if sum(map(is_equation, removed)) * max(sum(map(is_equation, children)) for children in new) > _MOST_COMPARISONS:
        raise TooManyPairsError
    added = [*map(_Candidates, new)]
    for child in removed:
        versions = [candidates.find_version(child) for candidates in added]
        if all(versions) or (any(versions) and is_equation(child)):
            for version, candidates in zip(versions, added, strict=True):
                candidates.taken.update({version.key: child.key} if version else {})
    mine, generated = (_renamed(side, candidates.taken) for side, candidates in zip(sides, added, strict=True))
    return base, mine, generated


class _Candidates:
    """The new nodes of one side: candidates for new versions of nodes in base."""

    def __init__(self, children: Sequence[Child]) -> None:
        self.taken: dict[str, str] = {}
        """Keys in base by the keys of their new versions on this side."""
        self._by_word = defaultdict[tuple[str, str], deque[Child]](deque)
        self._words = {child.key: _words(child) for child in children if is_equation(child)}
        for child in children:
            kind, *ends = child.key.split()
            for word in set(ends) if kind == "connect" else (kind,):
                self._by_word[kind, word].append(child)

    def find_version(self, child: Child) -> Child | None:
        """Return the side's new version of a node of base."""
        kind, *ends = child.key.split()
        if is_equation(child):
            words = _words(child)
            free = [candidate for candidate in self._by_word[kind, kind] if candidate.key not in self.taken]
            alike = [_likeness(words, self._words[candidate.key]) for candidate in free]
            return free[alike.index(max(alike))] if max(alike, default=0) >= _ALIKE else None
        for word in ends if kind == "connect" else [kind] if kind == "extends" else []:
            candidates = self._by_word[kind, word]
            while candidates and candidates[0].key in self.taken:
                candidates.popleft()
            if candidates:
                return candidates[0]
        return None


def _renamed(side: SyntaxTree, keys: Mapping[str, str]) -> SyntaxTree:
    if not keys:
        return side
    return side.with_children(
        [msgspec.structs.replace(child, key=keys.get(child.key, child.key)) for child in side.children]
    )


def _likeness(words: set[object], others: set[object]) -> float:
    return len(words & others) / max(len(words | others), 1)


def _words(child: Child) -> set[object]:
    leaf = child.node.children[0].node if isinstance(child.node, SyntaxTree) else child.node
    return set(leaf.words) if isinstance(leaf, Leaf) else set()
