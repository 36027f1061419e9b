"""Renames components in texts, after one side has renamed them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterator, Mapping

from urdfsync.modelica.lexer import Token, lex
from urdfsync.modelica.tree import Part, SyntaxTree, words_of

_COMPONENT = "component "
_MODIFIER = "("
"""Stands for the text before a modifier's name."""
_OPEN, _CLOSED = ("(", "[", "{"), (")", "]", "}")


def rename(base: str, other: str, names: Mapping[str, str], *, modifiers: bool = True) -> tuple[str, str]:
    """Return both texts with new names; `names` has new names by old names.

    A name without a dot before it is renamed if base has it without a dot, too. A name after a dot is renamed if base
    has it after the same word. So `robot.elbow` is renamed, and the user's own variable `elbow` is not. A modifier's
    name belongs to another class: it is renamed if base has it, too, but not without `modifiers`.
    """
    used = {(before, token.text) for before, token in _uses(base) if token.text in names}
    places = {place for place, _ in used} - (set() if modifiers else {_MODIFIER})
    alone = {place: {name for context, name in used if context == place} for place in places & {"", _MODIFIER}}

    def renamed(text: str) -> str:
        pieces, end = list[str](), 0
        for before, token in _uses(text):
            if token.text in names and before in places and token.text in alone.get(before, names):
                pieces += [text[end : token.start], names[token.text]]
                end = token.start + len(token.text)
        return "".join((*pieces, text[end:]))

    return renamed(base), renamed(other)


def without_clashes(names: Mapping[str, str], mine: str) -> dict[str, str]:
    """Return the new names that are free in the user's text, by old names.

    A new name is taken if the text has both names, unless the new name is renamed, too.
    """
    alone = {token.text for before, token in _uses(mine) if not before}
    free = dict(names)
    while taken := [old for old, new in free.items() if {old, new} <= alone and new not in free]:
        for old in taken:
            del free[old]
    return free


def find_uses_of(text: str, names: Mapping[str, str]) -> Iterator[tuple[str, int]]:
    """Yield the uses of these names for elements of other classes, with places in the text.

    Such a name follows a dot, or is a modifier's name. If the text extends classes, any other name may be inherited: it
    counts, too.
    """
    uses = list(_uses(text))
    extends = any(token.text == "extends" for _, token in uses)
    yield from ((token.text, token.start) for before, token in uses if (before or extends) and token.text in names)


def find_renamed(base: SyntaxTree, mine: SyntaxTree, generated: SyntaxTree) -> dict[str, str]:
    """Return the components that the user renamed, as new names by old names: unique pairs that differ only in name."""
    old, new, others = (_components(tree) for tree in (base, mine, generated))
    removed = {name: _likeness(part, name) for name, part in old.items() if name not in new}
    added = {name: _likeness(part, name) for name, part in new.items() if name not in old and name not in others}
    counts = Counter(removed.values()), Counter(added.values())
    by_likeness = {likeness: name for name, likeness in added.items()}
    return {
        name: by_likeness[likeness]
        for name, likeness in removed.items()
        if likeness in by_likeness and all(count[likeness] == 1 for count in counts)
    }


def _components(file: SyntaxTree) -> dict[str, Part]:
    """Return the components of a class by their names."""
    body = file.find("body")
    parts = body.node.parts if body and isinstance(body.node, SyntaxTree) else ()
    return {part.key.removeprefix(_COMPONENT): part for part in parts if part.key.startswith(_COMPONENT)}


def _likeness(part: Part, name: str) -> Hashable:
    """Return a value that is equal for two components if only their names and layouts differ."""
    parts = part.node.parts if isinstance(part.node, SyntaxTree) else ()
    texts = (inner.node.text for inner in parts if inner.key != "annotation")
    return tuple("" if word == name else word for text in texts for word in words_of(text))


def _uses(text: str) -> Iterator[tuple[str, Token]]:
    """Yield each token with the name before its dot, or with `_MODIFIER`, or with an empty text."""
    tokens, _ = lex(text)
    depth = 0
    for number, token in enumerate(tokens):
        depth += (token.text in _OPEN) - (token.text in _CLOSED)
        before = tokens[number - 1].text if number else ""
        if before == "." and number > 1:
            yield tokens[number - 2].text, token
        else:
            # this includes names of function arguments
            after = tokens[number + 1].text if number + 1 < len(tokens) else ""  # a piece of a text may end anywhere
            begins = depth and before in ("(", ",", "each", "final") and after in ("=", "(")
            yield (_MODIFIER if begins else ""), token
