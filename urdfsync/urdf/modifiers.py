"""What the modifiers in a record's text say, read without a compiler: `inertial(mass = 4.2)` as `inertial.mass`, 4.2.

A text that somebody is just editing need not be Modelica: what can't be understood is left out, and nothing is raised.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from urdfsync.merging.tokens import NEWLINE, is_trivia, tokens
from urdfsync.modelica.names import KEYWORDS

_NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?", re.ASCII)
_OPEN, _CLOSE = frozenset("({["), frozenset(")}]")
_PREFIXES = frozenset({"each", "final"})


class Token(NamedTuple):
    """A token that means something, with its line (from 1) and where it begins in the text."""

    text: str
    line: int
    start: int

    @property
    def end(self) -> int:
        """Where it ends in the text."""
        return self.start + len(self.text)


class Value(NamedTuple):
    """The right-hand side of a modifier."""

    text: str
    """As it is written, on one line."""
    line: int
    key: object
    """Equal for equal values: a number, or the tokens of whatever is none."""
    items: tuple[Value, ...] | None
    """The elements, if it is an array in braces."""


class Clause(NamedTuple):
    """An `extends` clause, or the declaration of a component."""

    name: str
    """The component's name; empty for an `extends` clause."""
    line: int
    values: Mapping[str, Value]
    """By dotted name, in the order of the text; the empty name is the component itself (`Box b = big`)."""


def clauses(text: str) -> Iterator[Clause]:
    """The `extends` clauses and the components of a record, in the order of the text."""
    for statement in _statements(_lex(text)):
        found = _Statement(text, statement).clause()
        if found:
            yield found


def _lex(text: str) -> Iterator[Token]:
    """The tokens that mean something; arrays of numbers are taken apart."""
    line, start = 1, 0
    for token in _opened(tokens(text)):
        if not is_trivia(token):
            yield Token(token, line, start)
        line += token.count(NEWLINE)
        start += len(token)


def _opened(found: Sequence[str]) -> Iterator[str]:
    for token in found:
        if token[0] in "{[" and len(token) > 1:
            yield token[0]
            yield from _opened(tokens(token[1:-1]))
            yield token[-1]
        else:
            yield token


def _statements(found: Iterator[Token]) -> Iterator[list[Token]]:
    """What stands between semicolons; the head of the class belongs to its first statement."""
    statement: list[Token] = []
    for token in found:
        if token.text == ";":
            yield statement
            statement = []
        else:
            statement.append(token)


class _Statement:
    """One statement, read from left to right."""

    def __init__(self, text: str, found: list[Token]) -> None:
        self._text, self._tokens, self._next = text, found, 0

    def clause(self) -> Clause | None:
        """The statement as a clause, None if it is something else."""
        words = [token.text for token in self._tokens]
        if "extends" in words:
            start, name = words.index("extends") + 1, ""
        else:
            start = self._component()
            name = words[start] if start else ""
        if not 0 < start < len(words):
            return None
        self._next = start + 1
        values: dict[str, Value] = {}
        self._modification("", values)
        return Clause(name, self._tokens[start].line, values)

    def _component(self) -> int:
        """Where the component's name is, 0 if this is no declaration: the second of two names in succession."""
        for place, (kind, name) in enumerate(zip(self._tokens, self._tokens[1:], strict=False)):
            if kind.text in _OPEN or kind.text == "annotation":
                return 0
            if _is_name(kind.text) and _is_name(name.text):
                return place + 1
        return 0

    def _modification(self, name: str, values: dict[str, Value]) -> None:
        """What may follow a name: modifiers in parentheses, and a value."""
        if self._peek() == "(":
            self._next += 1
            while self._peek() not in (")", ""):
                self._argument(name, values)
            self._next += 1
        if self._peek() in ("=", ":="):
            self._next += 1
            self._value(name, values)

    def _argument(self, within: str, values: dict[str, Value]) -> None:
        while self._peek() in _PREFIXES:
            self._next += 1
        word = self._peek()
        if _is_name(word):
            self._next += 1
            self._modification(f"{within}.{word}" if within else word, values)
        self._skip()

    def _value(self, name: str, values: dict[str, Value]) -> None:
        start = self._next
        self._skip(comma=False)
        found = self._tokens[start : self._next]
        if len(found) > 1 and found[-1].text[0] == '"' and found[-2].text != "+":
            found = found[:-1]  # a description
        if found:
            values[name] = _value(self._text, found)

    def _skip(self, comma: bool = True) -> None:
        """Go to the end of an argument, behind its comma if `comma`."""
        depth = 0
        while word := self._peek():
            if depth == 0 and word in ",)":
                self._next += comma and word == ","
                return
            depth += (word in _OPEN) - (word in _CLOSE)
            self._next += 1

    def _peek(self) -> str:
        return self._tokens[self._next].text if self._next < len(self._tokens) else ""


def _value(text: str, found: Sequence[Token]) -> Value:
    written = " ".join(text[found[0].start : found[-1].end].split())
    joined = "".join(token.text for token in found)
    key: object = float(joined) if _NUMBER.fullmatch(joined) else tuple(token.text for token in found)
    return Value(written, found[0].line, key, _items(text, found))


def _items(text: str, found: Sequence[Token]) -> tuple[Value, ...] | None:
    """The elements of an array in braces, None for anything else."""
    if found[0].text != "{" or found[-1].text != "}":
        return None
    items: list[list[Token]] = [[]]
    depth = 0
    for token in found[1:-1]:
        if token.text == "," and depth == 0:
            items.append([])
            continue
        depth += (token.text in _OPEN) - (token.text in _CLOSE)
        if depth < 0:
            return None  # `{1} + {2}`
        items[-1].append(token)
    return tuple(_value(text, item) for item in items) if all(items) else None


def _is_name(word: str) -> bool:
    return (word[:1].isalpha() or word[:1] in ("_", "'", ".")) and word not in (".", *KEYWORDS)
