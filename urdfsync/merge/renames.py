"""Renames components in texts, after one side has renamed them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterator, Mapping, Sequence

from urdfsync.modelica.lexer import Token, is_name, lex
from urdfsync.modelica.names import LIBRARY
from urdfsync.modelica.tree import Child, SyntaxTree, words_of

_COMPONENT = "component "
_MODIFIER = "("
"""Stands for the text before the name of an element of a class that is instantiated or extended."""
_ARGUMENT = "(("
"""Stands for the text before another argument, such as `upper` in `limits(upper = 1)`."""
_LIBRARIES = (LIBRARY, "Modelica")
"""Libraries, whose classes have no parts of a robot."""
_LONGEST = 40
"""The greatest number of words before a bracket that may name its class."""
_OPEN, _CLOSED = ("(", "[", "{"), (")", "]", "}")


def rename(base: str, other: str, names: Mapping[str, str], *, modifiers: bool = True) -> tuple[str, str]:
    """Return both texts with new names; `names` has new names by old names.

    A name without a dot before it is renamed if base has it without a dot, too. A name after a dot is renamed if base
    has it after the same word. So `robot.elbow` is renamed, and the user's own variable `elbow` is not. A modifier's
    name belongs to another class: it is renamed if base has it, too, but not without `modifiers`. Names of arguments,
    and of elements of elements, stay.
    """
    used = {(before, token.text) for before, token in _uses(base) if token.text in names}
    places = {place for place, _ in used} - ({_ARGUMENT} if modifiers else {_ARGUMENT, _MODIFIER})
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
    uses = [use for use in uses if use[0] != _ARGUMENT and use[1].text in names]
    yield from ((token.text, token.start) for before, token in uses if before or extends)


def find_renamed(base: SyntaxTree, mine: SyntaxTree, generated: SyntaxTree) -> dict[str, str]:
    """Return the components that the user renamed, as new names by old names: unique pairs that differ only in name."""
    old, new, others = (_components(tree) for tree in (base, mine, generated))
    removed = {name: _likeness(child, name) for name, child in old.items() if name not in new}
    added = {name: _likeness(child, name) for name, child in new.items() if name not in old and name not in others}
    counts = Counter(removed.values()), Counter(added.values())
    by_likeness = {likeness: name for name, likeness in added.items()}
    return {
        name: by_likeness[likeness]
        for name, likeness in removed.items()
        if likeness in by_likeness and all(count[likeness] == 1 for count in counts)
    }


def _components(file: SyntaxTree) -> dict[str, Child]:
    """Return the components of a class by their names."""
    body = file.find("body")
    children = body.node.children if body and isinstance(body.node, SyntaxTree) else ()
    return {child.key.removeprefix(_COMPONENT): child for child in children if child.key.startswith(_COMPONENT)}


def _likeness(child: Child, name: str) -> Hashable:
    """Return a value that is equal for two components if only their names and layouts differ."""
    children = child.node.children if isinstance(child.node, SyntaxTree) else ()
    texts = (inner.node.text for inner in children if inner.key != "annotation")
    return tuple("" if word == name else word for text in texts for word in words_of(text))


def _uses(text: str) -> Iterator[tuple[str, Token]]:
    """Yield each token with the name before its dot, with `_MODIFIER`, with `_ARGUMENT`, or with an empty text."""
    tokens, _ = lex(text)
    is_of_class = list[bool]()  # for each open bracket: whether it modifies an instance or a base of a class
    for number, token in enumerate(tokens):
        if token.text in _CLOSED and is_of_class:
            is_of_class.pop()
        before = tokens[number - 1].text if number else ""
        after = tokens[number + 1].text if number + 1 < len(tokens) else ""  # a piece of a text may end anywhere
        if before == "." and number > 1:
            yield tokens[number - 2].text, token
        elif is_of_class and before in ("(", ",", "each", "final") and after in ("=", "("):
            yield (_MODIFIER if is_of_class[-1] else _ARGUMENT), token
        else:
            yield "", token
        if token.text in _OPEN:
            is_of_class.append(token.text == "(" and _modifies_class(tokens, number))


def _modifies_class(tokens: Sequence[Token], bracket: int) -> bool:
    """Return whether a bracket follows a base, or the name of an instance, of a class that no library has."""
    words = _without_size([token.text for token in tokens[max(0, bracket - _LONGEST) : bracket]])
    type_name, first = words, _start_of_name(words)
    if first and words[first - 1] != "extends":  # the type stands before the instance
        type_name = _without_size(words[:-1])
        first = _start_of_name(type_name)
    return bool(type_name) and is_name(type_name[-1]) and type_name[first] not in _LIBRARIES


def _without_size(words: Sequence[str]) -> Sequence[str]:
    """Return the words without the size of an array at their end, such as `[3]`."""
    return words[: len(words) - 1 - words[::-1].index("[")] if words[-1:] == ["]"] and "[" in words else words


def _start_of_name(words: Sequence[str]) -> int:
    """Return the place of the first word of the name with dots at the end."""
    place = len(words) - 1
    while place >= 2 and words[place - 1] == ".":
        place -= 2
    return max(place, 0)
