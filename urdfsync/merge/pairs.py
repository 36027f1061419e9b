"""Which things of three versions of a body are the same thing, where their names alone do not say so.

Equations, connections and base classes are named by what they say. Where both sides have taken one out of base, what
stands there instead is its new version: else both new ones would stay, side by side.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Container, Mapping, Sequence

import msgspec

from urdfsync.modelica.tree import Leaf, Part, SyntaxTree, is_equation, key_by_whole_equation

_ALIKE = 0.5
"""Share of words that two equations have in common at least, if one is the new version of the other."""
_MOST_COMPARISONS = 400_000
"""The most pairs of equations that are compared: a second."""


class TooManyPairsError(Exception):
    """So many things have other versions that comparing each with each would take minutes."""


def pair(base: SyntaxTree, mine: SyntaxTree, generated: SyntaxTree) -> tuple[SyntaxTree, SyntaxTree, SyntaxTree]:
    """Return the three bodies with one key for each thing. Raises TooManyPairsError."""
    base, *sides = key_by_whole_equation(base, mine, generated)
    removed = [part for part in base.parts if not any(side.find(part.key) for side in sides)]
    new = [[part for part in side.parts if not base.find(part.key)] for side in sides]
    if sum(map(is_equation, removed)) * max(sum(map(is_equation, parts)) for parts in new) > _MOST_COMPARISONS:
        raise TooManyPairsError
    added = [*map(_by_words, new)]
    # the keys in base of new versions, by the keys that they have in each side
    keys: list[dict[str, str]] = [{}, {}]
    for part in removed:
        versions = [_find_version(part, parts, taken) for parts, taken in zip(added, keys, strict=True)]
        if all(versions) or (any(versions) and is_equation(part)):
            for version, taken in zip(versions, keys, strict=True):
                taken.update({version.key: part.key} if version else {})
    mine, generated = (_renamed(side, taken) for side, taken in zip(sides, keys, strict=True))
    return base, mine, generated


def _by_words(parts: Sequence[Part]) -> Mapping[str, Sequence[Part]]:
    """Return things by the first words of their keys, connections also by each of their ends."""
    parts_by_word = defaultdict[str, list[Part]](list)
    for part in parts:
        kind, *ends = part.key.split()
        for name in (kind, *set(ends)) if kind == "connect" else (kind,):
            parts_by_word[name].append(part)
    return parts_by_word


def _find_version(part: Part, added: Mapping[str, Sequence[Part]], taken: Container[str]) -> Part | None:
    """Return the part that a side has instead of a part of base."""
    kind, *ends = part.key.split()
    words = ends if kind == "connect" else [kind] if is_equation(part) or kind == "extends" else []
    free = [candidate for word in words for candidate in added.get(word, ()) if candidate.key not in taken]
    if not is_equation(part):
        return next((candidate for candidate in free if candidate.key.startswith(kind)), None)
    best = max(free, key=lambda candidate: _likeness(part, candidate), default=None)
    return best if best and _likeness(part, best) >= _ALIKE else None


def _renamed(side: SyntaxTree, keys: Mapping[str, str]) -> SyntaxTree:
    if not keys:
        return side
    return side.with_parts([msgspec.structs.replace(part, key=keys.get(part.key, part.key)) for part in side.parts])


def _likeness(part: Part, other: Part) -> float:
    words, others = map(_words, (part, other))
    return len(words & others) / max(len(words | others), 1)


def _words(part: Part) -> set[object]:
    leaf = part.node.parts[0].node if isinstance(part.node, SyntaxTree) else part.node
    return set(leaf.words) if isinstance(leaf, Leaf) else set()
