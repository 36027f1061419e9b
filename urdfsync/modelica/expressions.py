"""Modelica's names and expressions (language specification 3.6, appendix A.2.7): what is missing, and which names.

Precedence is not looked at: operands and operators just have to alternate, with signs where a sum can begin.
"""

from __future__ import annotations

from urdfsync.modelica.lexer import is_identifier
from urdfsync.modelica.reader import Reader
from urdfsync.modelica.syntax import Name

_ARITHMETIC = frozenset("+-*/^")
_OPERATORS = frozenset("or and < <= > >= == <> :".split()) | _ARITHMETIC
CALLED = frozenset({"assert", "der", "initial", "pure"})
"""Keywords that are called like functions."""


class ExpressionReader(Reader):
    """Reads names and expressions. All methods raise FaultError where something is missing.

    Names in expressions are added to `uses`, without the indices of loops and reductions.
    """

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._subscripts = 0

    def name(self) -> Name:
        """A name, possibly with dots."""
        line, is_global = self.line, bool(self.accept("."))
        parts = [self.identifier()]
        while self.word == "." and is_identifier(self.following):
            self.step()
            parts.append(self.identifier())
        return Name(tuple(parts), line, is_global)

    def description(self) -> None:
        """A description string, if there is one."""
        if self.word[:1] == '"':
            self.step()
            while self.accept("+"):
                if self.word[:1] != '"':
                    raise self.lack("a string")
                self.step()

    def subscripts(self) -> None:
        """Subscripts or the sizes of an array, if there are any."""
        if self.word == "[":
            self._subscripts += 1
            try:
                self.listed(self._subscript, "[", "]")
            finally:
                self._subscripts -= 1

    def _subscript(self) -> None:
        if not (self.word == ":" and self.following in (",", "]") and self.step()):
            self.expression()

    def reference(self) -> None:
        """A reference to a component or function."""
        line, is_global = self.line, bool(self.accept("."))
        parts = [self.identifier()]
        self.subscripts()
        while self.word == "." and is_identifier(self.following):
            self.step()
            parts.append(self.identifier())
            self.subscripts()
        self.uses.append(Name(tuple(parts), line, is_global, is_called=self.word == "("))

    def expression(self) -> None:
        """Any expression."""
        while self.accept("if"):
            self._choice("then")
            while self.accept("elseif"):
                self._choice("then")
            self.expect("else")
        self._signed()
        while operator := self._operator():
            if operator in _ARITHMETIC:
                self.deeper(self._primary)
            else:
                self._signed()

    def _choice(self, word: str) -> None:
        self.deeper(self.expression)
        self.expect(word)
        self.deeper(self.expression)

    def _operator(self) -> str:
        if self.word == "." and self.following in _ARITHMETIC:
            self.step()
        return self.accept(*_OPERATORS)

    def _signed(self) -> None:
        """An operand at the beginning of a sum."""
        self.accept("not")
        if self.word == "." and self.following in ("+", "-"):
            self.step()
        self.accept("+", "-")
        self.deeper(self._primary)

    def _primary(self) -> None:
        word = self.word
        if word[:1] == '"' or word[:1].isdecimal() or word in ("true", "false") or (word == "end" and self._subscripts):
            self.step()
        elif word == "(":
            self._group()
        elif word == "[":
            self._matrix()
        elif word == "{":
            self.listed(self._item, "{", "}")
        elif word in CALLED:
            self.step()
            self.call()
        elif is_identifier(word) or word == ".":
            self.reference()
            if self.word == "(":
                self.call()
        else:
            raise self.lack("an expression")

    def _group(self) -> None:
        """An expression in parentheses, or the outputs of a function, some of which may be left out."""
        self.expect("(")
        while self.word != ")":
            if not self.accept(","):
                self.expression()
                if self.word != ")":
                    self.expect(",")
        self.expect(")")
        self.subscripts()

    def _matrix(self) -> None:
        self.expect("[")
        self.expression()
        while self.accept(",", ";"):
            self.expression()
        self.expect("]")

    def _item(self) -> None:
        start = len(self.uses)
        self.expression()
        if self.accept("for"):
            self.forget(self.indices(), start)

    def call(self) -> None:
        """The arguments of a function."""
        names: set[str] = set()
        self.deeper(lambda: self.listed(lambda: self._passed(names)))

    def _passed(self, names: set[str]) -> None:
        if is_identifier(self.word) and self.following == "=":
            name = self.identifier()
            self.once(names, name, f"sets `{name}` twice")
            self.step()
        elif names:
            raise self.lack("the name of an argument")
        if self.accept("function"):
            self.uses.append(self.name()._replace(is_called=True))
            self.call()
        else:
            self._item()

    def indices(self) -> set[str]:
        """The indices of a loop or of a reduction; returns their names."""
        found = set()
        while True:
            found.add(self.identifier())
            if self.accept("in"):
                self.expression()
            if not self.accept(","):
                return found

    def forget(self, indices: set[str], start: int) -> None:
        """Drop the names of indices from those that were read since there were `start` of them."""
        self.uses[start:] = [name for name in self.uses[start:] if name.is_global or name.parts[0] not in indices]
