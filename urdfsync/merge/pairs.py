"""Which things of three versions of a body are the same thing, where their names alone do not say so.

Equations, connections and base classes are named by what they say. Where both sides have taken one out of base, what
stands there instead is its new version: else both new ones would stay, side by side.
"""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from urdfsync.modelica.tree import Leaf, Part, Tree, tell_apart

_ALIKE = 0.5
"""Share of words that two equations have in common at least, if one is the new version of the other."""


def pair(base: Tree, mine: Tree, generated: Tree) -> tuple[Tree, Tree, Tree]:
    """Return the three bodies with one key for each thing."""
    base, mine, generated = tell_apart(base, mine, generated)
    for part in base.parts:
        if not mine.find(part.key) and not generated.find(part.key):
            ours, theirs = (_find_version(part, side, base) for side in (mine, generated))
            if (ours and theirs) or ((ours or theirs) and _is_equation(part)):
                mine, generated = (_with_key(side, one, part.key) for side, one in ((mine, ours), (generated, theirs)))
    return base, mine, generated


def _find_version(part: Part, side: Tree, base: Tree) -> Part | None:
    """What a side has instead of a thing of base."""
    kind = part.key.partition(" ")[0]
    added = [one for one in side.parts if one.key.partition(" ")[0] == kind and not base.find(one.key)]
    if _is_equation(part):
        alike = [(_likeness(part, one), one) for one in added]
        best = max(alike, key=lambda pair: pair[0], default=None)
        return best[1] if best and best[0] >= _ALIKE else None
    if kind == "connect":
        ends = set(part.key.split()[1:])
        return next((one for one in added if not ends.isdisjoint(one.key.split()[1:])), None)
    return added[0] if added and kind == "extends" else None


def _is_equation(part: Part) -> bool:
    return isinstance(part.node, Tree) and part.node.find("equation") is not None


def _likeness(one: Part, other: Part) -> float:
    words, others = map(_words, (one, other))
    return len(words & others) / max(len(words | others), 1)


def _words(part: Part) -> set[object]:
    leaf = part.node.parts[0].node if isinstance(part.node, Tree) else part.node
    return set(leaf.words) if isinstance(leaf, Leaf) else set()


def _with_key(side: Tree, found: Part | None, key: str) -> Tree:
    """The body with another key for a thing."""
    if found is None:
        return side
    parts: Sequence[Part] = [msgspec.structs.replace(one, key=key) if one is found else one for one in side.parts]
    return msgspec.structs.replace(side, parts=tuple(parts))
