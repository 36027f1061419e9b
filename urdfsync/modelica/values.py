"""Reads the values in a record by their paths: of base classes and of components."""

from __future__ import annotations

import functools
import json
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from urdfsync.modelica.lexer import Token, lex

_NUMBER = r"(?:[-+]\s*+)?(?:Modelica\.Constants\.inf\b|(?:\d++(?:\.\d*+)?|\.\d++)(?:[eE][-+]?\d++)?)"
_NUMBERS = re.compile(rf"(?:\s|[{{}}\[\],;]|{_NUMBER}(?=\s*+(?:[}}\],;]|\Z)))*+")
"""Numbers in brackets; two numbers have something between them, so `1+1` is none."""
_EMPTY = re.compile(r"fill\(0, 0, \d+\)")
_SECTIONS = ("public", "protected")
_PASSED = ("within", "end", "annotation", "import")
_ENDS = ("(", "=", ";", "[", "if", "constrainedby")
_DEPTH = {**dict.fromkeys("([{", 1), **dict.fromkeys(")]}", -1)}


class Value(NamedTuple):
    """One value in a text."""

    path: str
    """`limits.effort` of a base class, `arm.inertial.mass` of a component."""
    type: str
    """The base class, or the component's type with prefixes."""
    text: str
    """The expression, without comments around it."""
    line: int
    start: int = 0
    """Where the expression begins in the text."""


@functools.lru_cache(maxsize=4096)  # cached: most texts on disk equal the generated texts
def read_values(text: str) -> tuple[Value, ...]:
    """Return the values in a text of one record without syntax errors, in order."""
    values, statement, depth = list[Value](), list[Token](), 0
    for token in lex(text)[0]:
        depth += _DEPTH.get(token.text, 0)
        statement.append(token)
        if token.text == ";" and depth == 0:
            values.extend(_of_statement(text, statement))
            statement = []
    return tuple(values)


def literals(text: str) -> tuple[float, ...] | str | None:
    """Return the numbers of an expression, or its string or truth value; None if it is not a literal."""
    text = _EMPTY.sub("", text.strip())
    if text.startswith('"'):
        try:
            return str(json.loads(text, strict=False))
        except ValueError:
            return None
    text = without_comments(text)
    if not _NUMBERS.fullmatch(text):
        return text if text in ("true", "false") else None
    return tuple(float(re.sub(r"\s|Modelica\.Constants\.", "", number)) + 0.0 for number in re.findall(_NUMBER, text))


def without_comments(text: str) -> str:
    """Return an expression without strings, with blanks for its comments."""
    return re.sub(r"/\*.*?(?:\*/|\Z)|//[^\n]*+", " ", text, flags=re.DOTALL)


def _of_statement(text: str, tokens: list[Token]) -> Iterator[Value]:
    """Yield the values of an extends clause or a component."""
    while tokens[0].text in _SECTIONS:
        del tokens[0]
    if tokens[0].text == "record":
        del tokens[: 3 if tokens[2].text.startswith('"') else 2]
    words = [token.text for token in tokens]
    if words[0] in _PASSED:
        return
    at = next(k for k, word in enumerate(words) if word in _ENDS or word.startswith('"'))
    last = 0 if words[0] == "extends" else at - 1
    path, type_ = "".join(words[last:at] if last else ()), "".join(words[:last] if last else words[1:at])
    if words[at] == "[":
        at = _close(words, at) + 1
    if words[at] == "(":
        yield from _modifiers(text, tokens, at, path, type_)
        at = _close(words, at) + 1
    if words[at] == "=":
        end = next(k for k in range(at + 2, len(words)) if words[k] in (";", "annotation") or words[k].startswith('"'))
        yield _value(text, path, type_, tokens[at + 1 : end])


def _modifiers(text: str, tokens: Sequence[Token], at: int, path: str, type_: str) -> Iterator[Value]:
    """Yield the values of the modifiers in the parentheses that open at a token."""
    words = [token.text for token in tokens]
    stop = _close(words, at)
    at += 1
    while at < stop:
        end, depth = at, 0
        while end < stop and (words[end] != "," or depth):
            depth += _DEPTH.get(words[end], 0)
            end += 1
        while words[at] in ("each", "final", "redeclare", "replaceable"):
            at += 1
        inner = f"{path}.{words[at]}" if path else words[at]
        if words[at + 1] == "(":
            yield from _modifiers(text, tokens, at + 1, inner, type_)
        elif words[at + 1] == "=":
            yield _value(text, inner, type_, tokens[at + 2 : end])
        at = end + 1


def _close(words: Sequence[str], at: int) -> int:
    """Return the place of the bracket that closes the bracket at a place."""
    depth = 0
    for k in range(at, len(words)):
        depth += _DEPTH.get(words[k], 0)
        if not depth:
            return k
    return len(words) - 1


def _value(text: str, path: str, type_: str, tokens: Sequence[Token]) -> Value:
    start, line = tokens[0].start, text.count("\n", 0, tokens[0].start) + 1
    return Value(path, type_, text[start : tokens[-1].start + len(tokens[-1].text)], line, start)
