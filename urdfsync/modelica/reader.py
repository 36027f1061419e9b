"""Read Modelica token by token: say what is missing where, and go on behind it."""

from __future__ import annotations

import re
from collections.abc import Callable

from urdfsync.modelica.lexer import Fault, is_identifier, lex
from urdfsync.modelica.syntax import Name

DEEPEST = 50
"""How many brackets, classes and blocks are read within each other: deeper ones would exhaust Python's stack."""
SECTIONS = frozenset({"equation", "algorithm", "public", "protected"})

_LONGEST = 60
"""Characters of what is quoted from a text."""
_QUOTE = '"'


class FaultError(Exception):
    """Ends the reading of an element or equation."""

    def __init__(self, reason: str, line: int) -> None:
        super().__init__(reason)
        self.fault = Fault(reason, line)


def short(text: str) -> str:
    """A piece of a text as a sentence can quote it."""
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"


class Reader:
    """Goes through tokens from the first to the last; what is wrong with them is in `faults`."""

    def __init__(self, text: str) -> None:
        self.found, self.faults = lex(text)
        self.at = 0
        self.uses: list[Name] = []
        """Names that were read and do not belong to any syntax value yet."""
        self._depth = 0

    @property
    def word(self) -> str:
        """The token that comes now; empty behind the last one."""
        return self.found[self.at].text

    @property
    def line(self) -> int:
        """The line of that token."""
        return self.found[self.at].line

    @property
    def following(self) -> str:
        """The token after that."""
        return self.found[min(self.at + 1, len(self.found) - 1)].text

    def since(self, start: int) -> str:
        """The tokens read since the one with the number `start`, with blanks where they would run together."""
        text = " ".join(token.text for token in self.found[start : self.at])
        return re.sub(r" ?([.()\[\]]) ?", r"\1", text)

    def step(self) -> str:
        """Go on to the next token, and return this one."""
        word = self.word
        self.at += bool(word)
        return word

    def accept(self, *words: str) -> str:
        """Go on if it is one of these, and return it; else return an empty text."""
        return self.step() if self.word in words else ""

    def expect(self, word: str) -> None:
        """Go on if it is this one. Raises FaultError for any other."""
        if not self.accept(word):
            raise self.lack(f"`{word}`")

    def identifier(self) -> str:
        """Go on behind a name without dots, and return it. Raises FaultError if there is none."""
        if not is_identifier(self.word):
            raise self.lack("a name")
        return self.step()

    def fault(self, reason: str) -> FaultError:
        """Say that something is wrong with this token."""
        return FaultError(reason, self.line)

    def lack(self, what: str) -> FaultError:
        """Say that something is missing before this token."""
        before = "a string" if self.word[:1] == _QUOTE else f"`{short(self.word)}`" if self.word else "its end"
        return self.fault(f"lacks {what} before {before}")

    def once(self, seen: set[str], key: str, reason: str) -> None:
        """Note that something is there twice if its key is in `seen`; else put it there."""
        if key in seen:
            self.faults.append(Fault(reason, self.found[self.at - 1].line))
        seen.add(key)

    def taken(self, start: int) -> tuple[Name, ...]:
        """Take the names that were read since there were `start` of them."""
        names = tuple(self.uses[start:])
        del self.uses[start:]
        return names

    def each(self, read: Callable[[], None]) -> None:
        """Read one element or equation and its semicolon; if something is wrong with it, go on behind it."""
        start, uses = self.at, len(self.uses)
        try:
            self.deeper(read)
            self.expect(";")
        except FaultError as error:
            self.faults.append(error.fault)
            del self.uses[uses:]
            while self.word not in (";", "end", "", *SECTIONS):
                self.step()
            if self.word == ";" or self.at == start:
                self.step()

    def deeper(self, read: Callable[[], None]) -> None:
        """Read what is inside of something. Raises FaultError beyond `DEEPEST`."""
        if self._depth == DEEPEST:
            raise self.fault(f"nests more than {DEEPEST} deep")
        self._depth += 1
        try:
            read()
        finally:
            self._depth -= 1

    def listed(self, read: Callable[[], object], opening: str = "(", closing: str = ")") -> None:
        """Read a list in brackets, with commas between its items; it may be empty."""
        self.expect(opening)
        if self.word != closing:
            read()
            while self.accept(","):
                read()
        if not self.accept(closing):
            raise self.lack(f"`,` or `{closing}`")
