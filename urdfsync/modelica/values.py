"""Reads the values in a class by their paths: of base classes, of components, and of connections."""

from __future__ import annotations

import functools
import json
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from urdfsync.modelica.lexer import Token, lex

_NUMBER = r"(?:[-+]\s*+)?(?:Modelica\.Constants\.inf\b|(?:\d++(?:\.\d*+)?|\.\d++)(?:[eE][-+]?\d++)?)"
_NUMBERS = re.compile(rf"(?:\s|[{{}}\[\],;]|{_NUMBER})*+")
_EMPTY = re.compile(r"fill\(0, 0, \d+\)")
_ENDS_OF_CONNECTION = re.compile(r"connect\(((?:\[[^\]]*\]|[^,\[])*),((?:\[[^\]]*\]|[^)\[])*)\)")
_SECTIONS = ("equation", "public", "protected", "initial")
_CLASSES = ("record", "model")
_PASSED = ("within", "end", "annotation", "assert", "import", "if", "for", "when", "algorithm")
_ENDS = ("(", "=", ";", "[", "if", "constrainedby")
_DEPTH = {**dict.fromkeys("([{", 1), **dict.fromkeys(")]}", -1)}


class Value(NamedTuple):
    """One value in a text."""

    path: str
    """`limits.effort` of a base class, `arm.inertial.mass` or `condition of arm` of a component; else `connect`."""
    type: str
    """The base class, or the component's type with prefixes; `equation` for a connection or an equation."""
    text: str
    """The expression; for a connection, its two ends, separated by a blank."""
    line: int


class Values(NamedTuple):
    """The values of a class in order, with the descriptions and types of its components."""

    values: list[Value]
    titles: dict[str, str]
    types: list[Value]
    """The types of the components by their names; a base class has the path `extends`."""


@functools.lru_cache(maxsize=4096)  # cached: most texts on disk equal the generated texts
def read_values(text: str) -> Values:
    """Return the values in a text of one class without syntax errors."""
    read, statement, depth = Values([], {}, []), list[Token](), 0
    for token in lex(text)[0]:
        depth += _DEPTH.get(token.text, 0)
        statement.append(token)
        if token.text == ";" and depth == 0:
            read.values.extend(_of_statement(text, statement, read))
            statement = []
    return read


def literals(text: str) -> tuple[float, ...] | str | None:
    """Return the numbers of an expression, or its string or truth value; None if it is not a literal."""
    text = _EMPTY.sub("", text.strip())
    if text.startswith('"'):
        try:
            return str(json.loads(text, strict=False))
        except ValueError:
            return None
    if not _NUMBERS.fullmatch(text):
        return text if text in ("true", "false") else None
    return tuple(float(re.sub(r"\s|Modelica\.Constants\.", "", number)) + 0.0 for number in re.findall(_NUMBER, text))


def _of_statement(text: str, tokens: list[Token], read: Values) -> Iterator[Value]:
    """Yield the values of an extends clause, a component or an equation; add its description and type to `read`."""
    while tokens[0].text in _SECTIONS:
        del tokens[0]
    if tokens[0].text in _CLASSES:
        del tokens[: 3 if tokens[2].text.startswith('"') else 2]
    words = [token.text for token in tokens]
    if words[0] == "annotation" and "experiment" in words:
        yield from _modifiers(text, tokens, words.index("experiment") + 1, "experiment", "annotation")
    if words[0] in _PASSED:
        return
    if words[0] == "connect":
        ends = _ENDS_OF_CONNECTION.match("".join(words))
        if ends:
            yield Value("connect", "equation", f"{ends[1]} {ends[2]}", _line(text, tokens[0]))
        return
    at = next(k for k, word in enumerate(words) if word in _ENDS or word.startswith('"'))
    last = 0 if words[0] == "extends" else at - 1
    is_equation = words[0] != "extends" and (not last or words[last - 1] == ".")
    path = "".join(words[:at] if is_equation else words[last:at] if last else ())
    type_ = "equation" if is_equation else "".join(words[:last] if last else words[1:at])
    if not is_equation:
        read.types.append(Value(path or "extends", "", type_, _line(text, tokens[0])))
    if words[at] == "[":
        at = _close(words, at) + 1
    if words[at] == "(":
        yield from _modifiers(text, tokens, at, path, type_)
        at = _close(words, at) + 1
    if words[at] == "=":
        end = next(k for k in range(at + 2, len(words)) if words[k] in (";", "annotation") or words[k].startswith('"'))
        yield Value(path, type_, text[tokens[at + 1].start : tokens[end].start].strip(), _line(text, tokens[at + 1]))
        at = end
    if words[at] == "if":
        end = next(k for k in range(at, len(words)) if words[k] in (";", "annotation") or words[k].startswith('"'))
        condition = text[tokens[at + 1].start : tokens[end].start].strip()
        yield Value(f"condition of {path}", type_, condition, _line(text, tokens[at]))
        at = end
    if words[at].startswith('"'):
        read.titles[path] = str(literals(words[at]))


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
        if words[at] == "redeclare" and not {"(", "="} & {*words[at:end]}:  # the value is the type
            *type_words, name = (word for word in words[at + 1 : end] if word != "parameter")
            place = f"{path}.{name}" if path else name
            yield Value(place, type_, "".join(type_words), _line(text, tokens[at]))
        while words[at] in ("each", "final", "redeclare", "replaceable"):
            at += 1
        inner = f"{path}.{words[at]}" if path else words[at]
        if words[at + 1] == "(":
            yield from _modifiers(text, tokens, at + 1, inner, type_)
        elif words[at + 1] == "=":
            yield Value(
                inner, type_, text[tokens[at + 2].start : tokens[end].start].strip(), _line(text, tokens[at + 2])
            )
        at = end + 1


def _close(words: Sequence[str], at: int) -> int:
    """Return the place of the bracket that closes the bracket at a place."""
    depth = 0
    for k in range(at, len(words)):
        depth += _DEPTH.get(words[k], 0)
        if not depth:
            return k
    return len(words) - 1


def _line(text: str, token: Token) -> int:
    return text.count("\n", 0, token.start) + 1
