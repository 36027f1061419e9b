"""Annotations of Modelica texts as values, with the statements of the annotations."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from urdfsync.modelica.lexer import lex

_CLOSING = {")", "}", "]", ",", ";"}
_PREFIXES = frozenset(
    "equation protected public parameter final constant inner outer replaceable redeclare input output".split()
)


@dataclasses.dataclass(frozen=True)
class Call:
    """A value in an annotation: `name(key=value, …)`; a call among the arguments has its name as key."""

    name: str = ""
    arguments: Mapping[str, Any] = dataclasses.field(default_factory=dict)

    def get(self, key: str, default: Any = None) -> Any:
        """The argument `key`, or `default` without such an argument."""
        return self.arguments.get(key, default)


class _Reader:
    """Reads values of annotations: numbers, strings, names, arrays and calls; another expression stays a text."""

    def __init__(self, words: Sequence[str], start: int) -> None:
        self.words, self.next = words, start

    def value(self) -> Any:
        """The value at the present place of the text."""
        start = self.next
        result = self._primary()
        depth = 0
        while depth or self._peek() not in _CLOSING:
            depth += {"(": 1, "{": 1, "[": 1, ")": -1, "}": -1, "]": -1}.get(self._take(), 0)
            result = " ".join(self.words[start : self.next])
        return result

    def _primary(self) -> Any:
        word = self._take()
        if word[0].isdigit() or (word in "-." and self._peek()[:1].isdigit()):
            return float(word if word[0].isdigit() else word + self._take())
        if word[0] == '"':
            return word[1:-1].replace('\\"', '"').replace("\\\\", "\\")
        if word == "{":
            return [value for _, value in self._items("}")]
        while self._peek() == ".":
            word += self._take() + self._take()
        if word[0].isalpha() and self._peek() == "(":
            self._take()
            return Call(word, {key: value for key, value in self._items(")") if key})
        return word

    def _items(self, end: str) -> Iterator[tuple[str, Any]]:
        while self._peek() != end:
            key = ""
            if self.words[self.next + 1] == "=":
                key = self._take()
                self._take()
            result = self.value()
            yield (key or (result.name if isinstance(result, Call) and end == ")" else "")), result
            if self._peek() == ",":
                self._take()
        self._take()

    def _peek(self) -> str:
        return self.words[self.next]

    def _take(self) -> str:
        self.next += 1
        return self.words[self.next - 1]


def annotations_in(text: str) -> list[Call]:
    """Every `annotation (…)` of a Modelica text, in the order of the text."""
    words = [token.text for token in lex(text)[0]]
    return [_Reader(words, at).value() for at, word in enumerate(words) if word == "annotation"]


def statements(text: str) -> Iterator[tuple[list[str], Call]]:
    """Declarations and equations of the only class in a text, without leading keywords, each with its annotation.

    The statement for the annotation of the class itself is empty.
    """
    words = [token.text for token in lex(text)[0]]
    begin = next(k for k, word in enumerate(words) if word in ("model", "block", "package", "record", "function"))
    reader = _Reader(words, begin + (3 if words[begin + 2].startswith('"') else 2))
    statement, note, depth = list[str](), Call(), 0
    while word := words[reader.next]:
        if word == "annotation" and not depth:
            note = reader.value()
            continue
        reader.next += 1
        depth += (word in "({[") - (word in ")}]")
        if word == ";" and not depth:
            yield statement, note
            statement, note = [], Call()
        elif statement or word not in _PREFIXES:
            statement.append(word)
