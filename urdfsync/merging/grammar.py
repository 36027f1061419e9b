"""Modelica's grammar, as far as telling whether a text is Modelica: what is missing where, and what is there twice.

It follows the concrete syntax of the language specification 3.6 (appendix A), and is generous where that costs
nothing: it does not ask which kind of class may have what. Elements and equations are read one by one, so that one
that is no Modelica does not hide what is wrong with another one.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import NamedTuple

from urdfsync.merging.expressions import CALLED, ExpressionReader
from urdfsync.merging.reading import SECTIONS, Finding, is_identifier, short

_CLASSES = frozenset("class model record block connector type package function operator".split())
_CLASS_PREFIXES = ("encapsulated",), ("partial",), ("expandable", "pure", "impure")
_ELEMENT_PREFIXES = ("redeclare",), ("final",), ("inner",), ("outer",), ("replaceable",)
_ARGUMENT_PREFIXES = ("each",), ("final",)
_TYPE_PREFIXES = ("flow", "stream"), ("discrete", "parameter", "constant"), ("input", "output")
_BLOCK_ENDS = frozenset({"end", "else", "elseif", "elsewhen", "", *SECTIONS})
_REPEATABLE = frozenset(
    "choice derivative file from inverse noDerivative noneFromVersion normallyConstant zeroDerivative".split()
)
"""Annotations that may stand more than once in one place."""


class Declared(NamedTuple):
    """A class or component that a text declares."""

    path: tuple[str, ...]
    """Its name, after those of the classes around it."""
    line: int
    """The line in which its declaration begins, from 1."""
    type: str = ""
    """A component's type as it is written; empty for a class."""


class Outline(NamedTuple):
    """What a file of Modelica declares, as far as it can be read."""

    findings: list[Finding]
    within: str | None
    """What its `within` clause names; None if it has none."""
    within_line: int
    declared: list[Declared]
    """Parts before the class that they belong to."""


def findings(text: str) -> list[Finding]:
    """All that is wrong with a text that should be a file of Modelica."""
    return outline(text).findings


def outline(text: str) -> Outline:
    """What is in a text that should be a file of Modelica, and what is wrong with it."""
    parser = _Parser(text)
    parser.document()
    return Outline(parser.findings, parser.within, parser.within_line, parser.declared)


class _Parser(ExpressionReader):
    """Reads classes, elements and equations. All methods but `document` raise FaultError where something is missing."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._open: tuple[str, ...] = ()
        """Names of the classes around this place."""
        self.within: str | None = None
        self.within_line = 0
        self.declared: list[Declared] = []

    def document(self) -> None:
        """A whole file."""
        if self.word == "within":
            self.each(self._within)
        names: set[str] = set()
        while self.word:
            self.each(partial(self._stored, names))

    def _within(self) -> None:
        self.within_line = self.line
        self.expect("within")
        self.within = self.name() if self.word != ";" else ""

    def _stored(self, names: set[str]) -> None:
        self.accept("final")
        if self.word == "end":
            raise self.fault("has an `end` too many")
        if not self._is_class():
            raise self.lack("a class")
        self._declared_class(names)

    # --- classes --------------------------------------------------------------------------------------------------

    def _is_class(self) -> bool:
        return self.word in _CLASSES or any(self.word in prefixes for prefixes in _CLASS_PREFIXES)

    def _prefixes(self, groups: Iterable[tuple[str, ...]]) -> None:
        """At most one of each group, in order."""
        for prefixes in groups:
            self.accept(*prefixes)

    def _declared_class(self, names: set[str]) -> None:
        line = self.line
        name = self._class(names)
        self.declared.append(Declared((*self._open, name), line))

    def _class(self, names: set[str]) -> str:
        """Read a class, and return its name."""
        self._prefixes(_CLASS_PREFIXES)
        kind = self.accept(*_CLASSES)
        if not kind:
            raise self.lack("the kind of class")
        if kind == "operator":
            self.accept("record", "function")
        extends = self.accept("extends")
        name = self.identifier()
        self.once(names, name, f"declares `{name}` twice")
        if not extends and self.accept("="):
            self._short_class()
        else:
            if extends and self.word == "(":
                self._arguments()
            self.description()
            around, self._open = self._open, (*self._open, name)
            try:
                self._composition()
                self._end_class(name)
            finally:
                self._open = around
        return name

    def _short_class(self) -> None:
        if self.accept("enumeration"):
            literals: set[str] = set()
            self.listed(partial(self._literal, literals))
        elif self.accept("der"):
            self.listed(self.name)
        else:
            self._type()
            if self.word == "(":
                self._arguments()
        self._comment()

    def _literal(self, literals: set[str]) -> None:
        if self.accept(":"):
            return
        name = self.identifier()
        self.once(literals, name, f"declares `{name}` twice")
        self._comment()

    def _composition(self) -> None:
        """Elements, equations and algorithms up to the class's `end`."""
        names: set[str] = set()
        equations: set[str] = set()
        section = "public"
        while (word := self.word) not in ("end", ""):
            if word == "initial" and self.following in ("equation", "algorithm"):
                self.step()
            if found := self.accept(*SECTIONS):
                section = found
            elif section in ("public", "protected") or word == "external":
                self.each(partial(self._element, names))
            else:
                self.each(partial(self._equation, equations if section == "equation" else None))
            if word == "annotation" and self.word not in ("end", ""):
                self.findings.append(Finding(f"goes on after the annotation of `{self._open[-1]}`", self.line))

    def _end_class(self, name: str) -> None:
        other = is_identifier(self.following) and self.following not in self._open
        if self.word != "end" or not (other or self.following == name):
            raise self.lack(f"`end {name}`")
        self.step()
        found = self.step()
        if found != name:
            self.findings.append(Finding(f"ends `{name}` with `end {found}`", self.found[self.at - 1].line))

    # --- elements -------------------------------------------------------------------------------------------------

    def _element(self, names: set[str]) -> None:
        if self.accept("annotation"):
            self._arguments()
        elif self.accept("import"):
            self._import()
        elif self.accept("extends"):
            parent = self.name()
            self.once(names, f"extends {parent}", f"extends `{parent}` twice")
            if self.word == "(":
                self._arguments()
            self._annotation()
        elif self.accept("external"):
            self._external()
        else:
            self._prefixes(_ELEMENT_PREFIXES)
            if self._is_class():
                self._declared_class(names)
            else:
                self._components(names)
            self._constraint()

    def _import(self) -> None:
        if self.following == "=":
            self.identifier()
            self.step()
        self.name()
        if self.accept("."):
            if self.word == "{":
                self.listed(self.identifier, "{", "}")
            else:
                self.expect("*")
        self._comment()

    def _external(self) -> None:
        self.description()
        if self.word not in (";", "annotation"):
            self.expression()
            if self.accept("="):
                self.expression()
        self._comment()

    def _components(self, names: set[str]) -> None:
        line = self.line
        kind = self._type()
        while True:
            name = self.identifier()
            self.once(names, name, f"declares `{name}` twice")
            self.declared.append(Declared((*self._open, name), line, kind))
            self.subscripts()
            self._modification()
            if self.accept("if"):
                self.expression()
            self._comment()
            if not self.accept(","):
                return

    def _type(self) -> str:
        """Read a type with its prefixes, and return its name."""
        self._prefixes(_TYPE_PREFIXES)
        name = self.name()
        self.subscripts()
        return name

    def _constraint(self) -> None:
        if self.accept("constrainedby"):
            self.name()
            if self.word == "(":
                self._arguments()
            self._comment()

    def _comment(self) -> None:
        """A description, an annotation, both or none."""
        self.description()
        self._annotation()

    def _annotation(self) -> None:
        if self.accept("annotation"):
            self._arguments()

    # --- modifiers ------------------------------------------------------------------------------------------------

    def _modification(self) -> None:
        if self.word == "(":
            self._arguments()
        if self.accept("=", ":=") and not self.accept("break"):
            self.expression()

    def _arguments(self) -> None:
        names: set[str] = set()
        self.deeper(lambda: self.listed(partial(self._argument, names)))

    def _argument(self, names: set[str]) -> None:
        redeclares = self.accept("redeclare")
        self._prefixes(_ARGUMENT_PREFIXES)
        declares = self.accept("replaceable") or redeclares
        if self.accept("break"):
            self.accept("connect")
            self.expression()
        elif declares and self._is_class():
            self._class(names)
        else:
            if declares:
                self._type()
            name = self.name()
            if name not in _REPEATABLE:
                self.once(names, name, f"sets `{name}` twice")
            if declares:
                self.subscripts()
            self._modification()
            self.description()
            if declares:
                self._annotation()
        self._constraint()

    # --- equations and statements ---------------------------------------------------------------------------------

    def _equation(self, seen: set[str] | None) -> None:
        """An equation or a statement; those of algorithms may be repeated, so that there is nothing to see."""
        start = self.at
        match self.word:
            case "if" | "when" | "for" | "while" as kind:
                self.step()
                self._block(kind, repeats=seen is None)
            case "annotation":
                self.step()
                self._arguments()
                return
            case "break" | "return" if seen is None:
                self.step()
            case "connect" if seen is not None:
                self.step()
                self._connect(seen)
            case _:
                self._simple("=" if seen is not None else ":=")
                if seen is not None:
                    text = self.since(start)
                    self.once(seen, text, f"has the equation `{short(text)}` twice")
        self._comment()

    def _simple(self, sign: str) -> None:
        """An equation or an assignment, by its sign, or the call of a function."""
        first = self.word
        self.expression()
        if self.accept(sign):
            self.expression()
        elif not (is_identifier(first) or first in CALLED or first == ".") or self.found[self.at - 1].text != ")":
            raise self.lack(f"`{sign}`")

    def _connect(self, seen: set[str]) -> None:
        self.expect("(")
        first = self._end()
        self.expect(",")
        second = self._end()
        self.expect(")")
        first, second = sorted((first, second))
        self.once(seen, f"connect {first} {second}", f"connects `{first}` and `{second}` twice")

    def _end(self) -> str:
        """One end of a connection."""
        start = self.at
        self.reference()
        return self.since(start)

    def _block(self, kind: str, *, repeats: bool) -> None:
        if kind == "for":
            self.indices()
        else:
            self.expression()
        self.expect("loop" if kind in ("for", "while") else "then")
        self._equations(repeats=repeats)
        more = {"if": "elseif", "when": "elsewhen"}.get(kind)
        while more and self.accept(more):
            self.expression()
            self.expect("then")
            self._equations(repeats=repeats)
        if kind == "if" and self.accept("else"):
            self._equations(repeats=repeats)
        if (self.word, self.following) != ("end", kind):
            raise self.lack(f"`end {kind}`")
        self.step()
        self.step()

    def _equations(self, *, repeats: bool) -> None:
        seen: set[str] | None = None if repeats else set()
        while self.word not in _BLOCK_ENDS:
            self.each(partial(self._equation, seen))
