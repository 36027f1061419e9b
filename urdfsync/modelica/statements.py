"""Replaces plain statements that need no reading by blanks: most statements of a robot model are unedited.

The other statements keep their lines and columns.
"""

from __future__ import annotations

import functools
import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from typing import NamedTuple

from urdfsync.modelica.lexer import Fault, is_name
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import Class, StoredText, declared

_END = ";\n"
_COMPONENT = re.compile(
    r"\s*(?:(?:replaceable|inner|outer|final|parameter|constant)\s+)*\.?(\w+)(?:\.\w+)*\s+(\w+)(?=[\s(]|\Z)"
)
_UNNAMED = re.compile(r"\s*(?:connect|assert|annotation)\s*\(")
_STRING_OR_SIGN = re.compile(r'"(?:[^"\\]|\\.)*+(?:"|\\?\Z)|[](){}[,]', re.DOTALL)
_SEEN_BY_OTHERS = re.compile(r"\b(?:redeclare|uses)\b")


_LONGEST = 1_000_000
"""The greatest number of characters of a text to read: more characters would take longer than 3 s."""
TOO_LONG = StoredText([Fault(f"has more than {_LONGEST:,} characters of yours", 1)])
"""Stands for a parsed text with more characters."""


class EditedStatements(NamedTuple):
    """The difference between an edited and the generated text."""

    same: frozenset[str]
    """The plain statements in both texts; they mean the same in both, unless a name has another meaning."""
    names: frozenset[str]
    """The names that all other statements declare, in either text."""
    is_whole: bool
    """Whether all names may have another meaning, such as after a changed `extends` or `import`."""
    generated: Class | None
    """The generated class without equal statements; None if there is none."""


class ShortText(NamedTuple):
    """A parsed text without some statements."""

    text: str
    stored: StoredText
    passed: frozenset[int]
    """Lines of components in left out statements: only their types and names were read."""


# saves 110 ms in the row "robot model edited: 1,000 links, in the daemon" of docs/speed.md
@functools.lru_cache(maxsize=64)
def parse_without(text: str, passed: frozenset[str]) -> ShortText:
    """Parse a text without these plain statements; components in them get only types and names.

    The parsed text is `TOO_LONG` if there are too many characters to read.
    """
    shortened, lines = _shorten(text, passed)
    size = len(text) - sum(map(len, passed))
    return ShortText(shortened, parse(shortened) if size <= _LONGEST else TOO_LONG, lines)


@functools.lru_cache(maxsize=8)  # saves 100 ms in the row of `parse_without`
def compare(mine: str, generated: str) -> EditedStatements:
    """Compare an edited text with the generated text."""
    own, other = (Counter(text.split(_END)) for text in (mine, generated))
    same = frozenset(statement for statement, count in own.items() if other[statement] == count and is_plain(statement))
    texts = [_END.join(statement for statement in statements if statement not in same) for statements in (own, other)]
    if max(map(len, texts)) > _LONGEST:
        return EditedStatements(same, frozenset(), is_whole=False, generated=None)
    rests = [*map(parse, texts)]
    paths = (declaration.path for rest in rests for declaration in declared(rest.classes))
    names = frozenset(path[-1] for path in paths if path[1:])  # without the class's own name
    visible = [dict(_visible(rest.classes)) for rest in rests]
    read = parse_without(mine, same)
    # a comment or a string may hide a component
    is_hidden = not read.passed <= {declaration.line for declaration in declared(read.stored.classes)}
    is_whole = visible[0] != visible[1] or is_hidden
    return EditedStatements(frozenset() if is_whole else same, names, is_whole, next(iter(rests[1].classes), None))


def _visible(classes: Iterable[Class]) -> Iterator[tuple[str, object]]:
    """Yield the parts of classes that change meanings of names: kind, base classes with redeclarations, imports."""
    for definition in classes:
        redeclared = [str(inner.type and inner.type.type) for base in definition.extends for inner in base.arguments]
        imported = [(str(clause.name), [*clause.names]) for clause in definition.imports]
        head = definition.kind, definition.prefixes
        yield str(definition.name), (head, [str(base.type) for base in definition.extends], redeclared, imported)
        yield from _visible(definition.classes)


def plain_statements(text: str) -> frozenset[str]:
    """Return the plain statements of a text."""
    return frozenset(filter(is_plain, text.split(_END)))


def is_plain(statement: str) -> bool:
    """Whether a statement, without its semicolon, only declares one component, connects, asserts or annotates.

    A statement is not plain if other classes see more than a component's type and name, as with `redeclare`.
    """
    if ";" in statement or _SEEN_BY_OTHERS.search(statement):
        return False
    component = _COMPONENT.match(statement)
    if not (component and is_name(component[1]) and is_name(component[2])):
        return bool(_UNNAMED.match(statement))
    depth = 0
    for sign in _STRING_OR_SIGN.findall(statement, component.end()) if "," in statement else ():
        depth += (sign in "([{") - (sign in ")]}")
        if sign == "," and depth <= 0:
            return False  # a comma separates several components
    return depth == 0


def mentioning(statements: Collection[str], names: Collection[str]) -> set[str]:
    """Return the statements that contain one of the names as a word."""
    near = [statement for statement in statements if any(name in statement for name in names)]
    return {statement for statement in near if not set(re.findall(r"\w+", statement)).isdisjoint(names)}


def component_of(statement: str) -> tuple[str, str] | None:
    """Return the last part of the type, and the name, of a plain statement's component; None without a component."""
    component = _COMPONENT.match(statement)
    return (component[0].split()[-2].rpartition(".")[2], component[2]) if component else None


def _shorten(text: str, passed: Collection[str]) -> tuple[str, frozenset[int]]:
    """Return a text with blanks instead of statements, and the lines of components of which type and name stay."""
    pieces, lines, line = list[str](), set[int](), 1
    for statement in text.split(_END):
        piece, end = f"{statement}{_END}", 0
        if statement in passed:
            if component := _COMPONENT.match(statement):
                end = component.end()
                lines.add(line + statement.count("\n", 0, component.start(2)))
            blanks = "\n".join([" " * len(row) for row in statement[end:].split("\n")])
            piece = f"{statement[:end]}{blanks}{_END if end else ' ' + _END[1:]}"
        pieces.append(piece)
        line += piece.count("\n")
    return "".join(pieces)[: len(text)], frozenset(lines)
