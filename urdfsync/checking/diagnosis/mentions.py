"""Where the files of a package mention a name, comments and strings left out, and what they declare. Pure."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable, Iterator, Sequence

import msgspec

from urdfsync.checking.diagnosis.package import Package
from urdfsync.modelica.lexer import Token, is_identifier, lex
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import Declared, declared

_BRACKETS = {"[": 1, "]": -1}


class Mention(msgspec.Struct, frozen=True):
    """A name, possibly with dots, at a place in a file."""

    name: str
    path: str
    line: int


class Mentions(msgspec.Struct, frozen=True, dict=True):
    """All names in the files of a package; those in edited files come first."""

    package: Package

    @functools.cached_property
    def paths(self) -> Sequence[str]:
        """The files of classes."""
        edited = set(self.package.edited)
        return sorted(
            (path for path in self.package.texts if path.endswith(".mo")), key=lambda path: path not in edited
        )

    @functools.cached_property
    def all(self) -> Sequence[Mention]:
        """Every name of the package wherever it stands."""
        return [mention for path in self.paths for mention in _mentions(path, self.package.text(path))]

    @functools.cached_property
    def declared(self) -> dict[str, Sequence[Declared]]:
        """Per file what it declares."""
        return {path: [*declared(parse(self.package.text(path)).classes)] for path in self.paths}

    @functools.cached_property
    def _by_name(self) -> dict[str, list[Mention]]:
        return _grouped((one.name, one) for one in self.all)

    @functools.cached_property
    def _by_beginning(self) -> dict[str, list[Mention]]:
        return _grouped((beginning, one) for one in self.all for beginning in _beginnings(one.name))

    def exact(self, name: str) -> Sequence[Mention]:
        """Where a name stands by itself."""
        return self._by_name.get(name, ())

    def of(self, name: str) -> Sequence[Mention]:
        """Where a name stands; or longer ones that begin with it, if it does not stand by itself anywhere."""
        return self.exact(name) or self._by_beginning.get(name, ())

    def alike(self, name: str) -> set[str]:
        """Other names of as many parts that are mentioned, or are those of files."""
        files = {path.removesuffix(".mo").replace("/", ".") for path in self.paths}
        return {one for one in {*self._by_name, *files} if one.count(".") == name.count(".")} - {name}

    def names_in(self, path: str) -> set[str]:
        """What a file declares, without the names of classes around it."""
        return {one.path[-1] for one in self.declared[path]}


def _grouped(pairs: Iterable[tuple[str, Mention]]) -> dict[str, list[Mention]]:
    groups: dict[str, list[Mention]] = {}
    for key, mention in pairs:
        groups.setdefault(key, []).append(mention)
    return groups


def _beginnings(name: str) -> Iterator[str]:
    """What stands before each dot."""
    return (name[: dot.start()] for dot in re.finditer(r"\.", name))


def _mentions(path: str, text: str) -> Iterator[Mention]:
    found, _ = lex(text)
    before = ""
    for at, token in enumerate(found):
        if before != "." and is_identifier(token.text):
            yield Mention(_name(found, at), path, token.line)
        before = token.text


def _name(found: Sequence[Token], at: int) -> str:
    """The whole name that begins with a token."""
    parts = [found[at].text]
    at += 1
    while at < len(found):
        at = _behind_subscripts(found, at)
        if at + 1 >= len(found) or found[at].text != "." or not is_identifier(found[at + 1].text):
            break
        parts.append(found[at + 1].text)
        at += 2
    return ".".join(parts)


def _behind_subscripts(found: Sequence[Token], at: int) -> int:
    depth = 0
    while at < len(found) and (depth or found[at].text == "["):
        depth += _BRACKETS.get(found[at].text, 0)
        at += 1
    return at
