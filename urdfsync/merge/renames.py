"""New names for what one side has renamed, in the texts that have the old ones."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping

from urdfsync.modelica.lexer import Token, lex
from urdfsync.modelica.tree import Part, Tree

_COMPONENT = "component "


def rename(base: str, other: str, names: Mapping[str, str]) -> tuple[str, str]:
    """Return both texts with new names; `names` has them by the old ones.

    A name without a dot before it is renamed if it stands so in base, too; one behind a dot if what is before that dot
    is before a renamed name there. So `robot.elbow` follows, and a variable `elbow` of the user's own does not.
    """
    used = [(before, token.text) for before, token in _uses(base) if token.text in names]
    alone, owners = {name for before, name in used if not before}, {before for before, _ in used if before}

    def renamed(text: str) -> str:
        found = [
            token
            for before, token in _uses(text)
            if token.text in names and (before in owners if before else token.text in alone)
        ]
        for token in reversed(found):
            text = f"{text[: token.start]}{names[token.text]}{text[token.start + len(token.text) :]}"
        return text

    return renamed(base), renamed(other)


def find_renamed(base: Tree, mine: Tree, generated: Tree) -> dict[str, str]:
    """Return the components that the user gave other names, new by old: alike in all else, and no other one is."""
    old, new, others = (_components(tree) for tree in (base, mine, generated))
    gone = {name: _likeness(part, name) for name, part in old.items() if name not in new}
    come = {name: _likeness(part, name) for name, part in new.items() if name not in old and name not in others}
    counts = Counter(gone.values()), Counter(come.values())
    by_likeness = {likeness: name for name, likeness in come.items()}
    return {
        name: by_likeness[likeness]
        for name, likeness in gone.items()
        if likeness in by_likeness and all(count[likeness] == 1 for count in counts)
    }


def _components(file: Tree) -> dict[str, Part]:
    """The components of a class by their names."""
    body = file.find("body")
    parts = body.node.parts if body and isinstance(body.node, Tree) else ()
    return {part.key.removeprefix(_COMPONENT): part for part in parts if part.key.startswith(_COMPONENT)}


def _likeness(part: Part, name: str) -> object:
    """Equal for components that differ in nothing but their own names."""
    return _without(part.node.bare, name)


def _without(meaning: object, name: str) -> object:
    if isinstance(meaning, tuple):
        return tuple(_without(one, name) for one in meaning)
    return "" if meaning == name else meaning


def _uses(text: str) -> Iterator[tuple[str, Token]]:
    """Each token, and the one before the dot before it; an empty text if there is no dot."""
    tokens, _ = lex(text)
    for number, token in enumerate(tokens):
        has_dot = number > 1 and tokens[number - 1].text == "."
        yield (tokens[number - 2].text if has_dot else ""), token
