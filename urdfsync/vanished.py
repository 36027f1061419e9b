"""Names that a package has no more, and texts that still mention them."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Set

_WORDS = re.compile(
    r"""
    "(?:[^"\\]|\\.)*"          # a string
    | //[^\n]* | /\*.*?\*/     # a comment
    | '(?:[^'\\]|\\.)*'        # a quoted name
    | (?P<name>[^\W\d]\w*)
    """,
    re.VERBOSE | re.DOTALL,
)


def names(before: Iterable[str], now: Iterable[str], gone: Collection[str]) -> frozenset[str]:
    """The names of elements in the texts of a package's last version that none of its texts has now.

    `gone` are identifiers of elements that are gone or called otherwise now; a name counts if it begins with one.
    """
    prefixes = tuple(identifier.lower() for identifier in gone)
    if not prefixes:
        return frozenset()
    old = {name for text in before for name, _ in _found(text) if name.lower().startswith(prefixes)}
    return frozenset(old - {name for text in now for name, _ in _found(text)}) if old else frozenset()


def mentions(text: str, vanished: Set[str]) -> list[tuple[str, int]]:
    """The vanished names that a text mentions outside of strings and comments, each with its first line, from 1."""
    first: dict[str, int] = {}
    for name, place in _found(text):
        if name in vanished:
            first.setdefault(name, text.count("\n", 0, place) + 1)
    return list(first.items())


def _found(text: str) -> Iterator[tuple[str, int]]:
    for match in _WORDS.finditer(text):
        if match["name"]:
            yield match["name"], match.start()
