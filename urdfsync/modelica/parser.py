"""Read Modelica text into syntax values, and say what is missing in it or there twice.

The grammar is the concrete syntax of the language specification 3.6 (appendix A). It is generous where that costs
nothing: it does not ask which kind of class may have what. Elements and equations are read one by one, so that one
that is no Modelica does not hide what is wrong with another one.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

import msgspec

from urdfsync.modelica.expressions import CALLED, ExpressionReader
from urdfsync.modelica.lexer import Fault, is_identifier
from urdfsync.modelica.reader import SECTIONS, short
from urdfsync.modelica.syntax import Class, Component, Connection, Extends, Import, Modifier, Name, StoredText

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


def parse(text: str) -> StoredText:
    """Read a text that should be a file of Modelica; whatever can't be read of it is left out."""
    parser = _Parser(text)
    parser.document()
    return StoredText(tuple(parser.faults), parser.within, parser.within_line, tuple(parser.classes))


class _Body(msgspec.Struct):
    """What has been read of a class so far; lists for the fields of `Class`."""

    imports: list[Import] = msgspec.field(default_factory=list)
    extends: list[Extends] = msgspec.field(default_factory=list)
    classes: list[Class] = msgspec.field(default_factory=list)
    components: list[Component] = msgspec.field(default_factory=list)
    connections: list[Connection] = msgspec.field(default_factory=list)
    uses: list[Name] = msgspec.field(default_factory=list)


class _Parser(ExpressionReader):
    """Reads classes, elements and equations. All methods but `document` raise FaultError where something is missing."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._open: tuple[str, ...] = ()
        """Names of the classes around this place."""
        self._body = _Body()
        """The class around this place."""
        self.within: str | None = None
        self.within_line = 0

    @property
    def classes(self) -> list[Class]:
        """The classes of the file, once it has been read."""
        return self._body.classes

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
        self.within = str(self.name()) if self.word != ";" else ""

    def _stored(self, names: set[str]) -> None:
        prefixes = self._prefixes((("final",),))
        if self.word == "end":
            raise self.fault("has an `end` too many")
        if not self._is_class():
            raise self.lack("a class")
        self._body.classes.append(self._class(names, prefixes))

    # --- classes --------------------------------------------------------------------------------------------------

    def _is_class(self) -> bool:
        return self.word in _CLASSES or any(self.word in prefixes for prefixes in _CLASS_PREFIXES)

    def _prefixes(self, groups: Iterable[tuple[str, ...]]) -> set[str]:
        """At most one of each group, in order."""
        return {found for prefixes in groups if (found := self.accept(*prefixes))}

    def _class(self, names: set[str], prefixes: set[str]) -> Class:
        """A class; `names` are those declared before in the class around it, `prefixes` what was read already."""
        prefixes |= self._prefixes(_CLASS_PREFIXES)
        kind = self.accept(*_CLASSES)
        if not kind:
            raise self.lack("the kind of class")
        if kind == "operator":
            kind = " ".join(filter(None, (kind, self.accept("record", "function"))))
        is_extension = bool(self.accept("extends"))
        line, text = self.line, self.identifier()
        name = Name((text,), line)
        self.once(names, text, f"declares `{text}` twice")
        found = Class(name, kind, frozenset(prefixes), is_extension=is_extension)
        if not is_extension and self.accept("="):
            return self._short_class(found)
        arguments = self._arguments() if is_extension and self.word == "(" else ()
        self.description()
        around, self._open = self._open, (*self._open, text)
        outer, self._body = self._body, _Body()
        try:
            self._composition()
            self._end_class(text)
            parts = msgspec.structs.asdict(self._body)
        finally:
            self._open, self._body = around, outer
        return msgspec.structs.replace(found, arguments=arguments, **{key: tuple(parts[key]) for key in parts})

    def _short_class(self, found: Class) -> Class:
        if self.accept("enumeration"):
            literals: dict[str, None] = {}
            seen: set[str] = set()
            self.listed(partial(self._literal, literals, seen))
            found = msgspec.structs.replace(found, literals=tuple(literals))
        elif self.accept("der"):
            self.listed(self.name)
            found = msgspec.structs.replace(found, is_derivative=True)
        else:
            start = len(self.uses)
            name, _ = self._type()
            del self.uses[start:]
            arguments = self._arguments() if self.word == "(" else ()
            found = msgspec.structs.replace(found, alias=Extends(name, arguments))
        self._comment()
        return found

    def _literal(self, literals: dict[str, None], seen: set[str]) -> None:
        if self.accept(":"):
            return
        name = self.identifier()
        self.once(seen, name, f"declares `{name}` twice")
        literals[name] = None
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
                start = len(self.uses)
                self.each(partial(self._equation, equations if section == "equation" else None))
                self._body.uses += self.taken(start)
            if word == "annotation" and self.word not in ("end", ""):
                self.faults.append(Fault(f"goes on after the annotation of `{self._open[-1]}`", self.line))

    def _end_class(self, name: str) -> None:
        other = is_identifier(self.following) and self.following not in self._open
        if self.word != "end" or not (other or self.following == name):
            raise self.lack(f"`end {name}`")
        self.step()
        found = self.step()
        if found != name:
            self.faults.append(Fault(f"ends `{name}` with `end {found}`", self.found[self.at - 1].line))

    # --- elements -------------------------------------------------------------------------------------------------

    def _element(self, names: set[str]) -> None:
        if self.accept("annotation"):
            self._unread_arguments()
        elif self.accept("import"):
            self._body.imports.append(self._import())
        elif self.accept("extends"):
            parent = self._base()
            self.once(names, f"extends {parent.type}", f"extends `{parent.type}` twice")
            self._body.extends.append(parent)
            self._annotation()
        elif self.accept("external"):
            start = len(self.uses)
            self._external()
            self._body.uses += self.taken(start)
        else:
            prefixes = self._prefixes(_ELEMENT_PREFIXES)
            if self._is_class():
                found = self._class(names, prefixes)
                self._body.classes.append(msgspec.structs.replace(found, constraint=self._constraint()))
            else:
                components = self._components(names, prefixes)
                constraint = self._constraint()
                self._body.components += [msgspec.structs.replace(one, constraint=constraint) for one in components]

    def _base(self) -> Extends:
        """A class with its modifiers."""
        name = self.name()
        return Extends(name, self._arguments() if self.word == "(" else ())

    def _import(self) -> Import:
        alias = ""
        if self.following == "=":
            alias = self.identifier()
            self.step()
        name = self.name()
        members: list[tuple[str, str]] = []
        is_everything = False
        if self.accept("."):
            if self.word == "{":
                self.listed(lambda: members.append(self._imported()), "{", "}")
            else:
                self.expect("*")
                is_everything = True
        self._comment()
        return Import(name, alias, tuple(members), is_everything)

    def _imported(self) -> tuple[str, str]:
        alias = self.identifier()
        return alias, self.identifier() if self.accept("=") else alias

    def _external(self) -> None:
        self.description()
        if self.word not in (";", "annotation"):
            start = len(self.uses)
            self.expression()
            if self.accept("="):
                self.expression()
            # the function of the other language has a name of its own
            self.uses[start:] = [name for name in self.uses[start:] if not name.is_called]
        self._comment()

    def _components(self, names: set[str], prefixes: set[str]) -> list[Component]:
        start = len(self.uses)
        kind, more = self._type()
        sizes = self.taken(start)
        found = []
        while True:
            start = len(self.uses)
            line, text = self.line, self.identifier()
            self.once(names, text, f"declares `{text}` twice")
            self.subscripts()
            arguments = self._modification()
            if self.accept("if"):
                self.expression()
            uses = (*sizes, *self.taken(start))
            found.append(Component(Name((text,), line), kind, frozenset(prefixes | more), arguments, uses))
            self._comment()
            if not self.accept(","):
                return found

    def _type(self) -> tuple[Name, set[str]]:
        """Read a type, and its prefixes."""
        prefixes = self._prefixes(_TYPE_PREFIXES)
        name = self.name()
        self.subscripts()
        return name, prefixes

    def _constraint(self) -> Extends | None:
        if not self.accept("constrainedby"):
            return None
        found = self._base()
        self._comment()
        return found

    def _comment(self) -> None:
        """A description, an annotation, both or none."""
        self.description()
        self._annotation()

    def _annotation(self) -> None:
        if self.accept("annotation"):
            self._unread_arguments()

    def _unread_arguments(self) -> None:
        """The arguments of an annotation, in which names have meanings of their own."""
        start = len(self.uses)
        self._arguments()
        del self.uses[start:]

    # --- modifiers ------------------------------------------------------------------------------------------------

    def _modification(self) -> tuple[Modifier, ...]:
        """Modifiers in parentheses and a value, whose names are added to `uses`; both may be missing."""
        arguments = self._arguments() if self.word == "(" else ()
        if self.accept("=", ":=") and not self.accept("break"):
            self.expression()
        return arguments

    def _arguments(self) -> tuple[Modifier, ...]:
        names: set[str] = set()
        found: list[Modifier] = []
        self.deeper(lambda: self.listed(partial(self._argument, names, found)))
        return tuple(found)

    def _argument(self, names: set[str], found: list[Modifier]) -> None:
        is_redeclared = bool(self.accept("redeclare"))
        prefixes = self._prefixes(_ARGUMENT_PREFIXES)
        declares = bool(self.accept("replaceable")) or is_redeclared
        if self.accept("break"):
            self._break(found)
            return
        if declares and self._is_class():
            definition = self._class(names, prefixes)
            modifier = Modifier(definition.name, is_redeclared=is_redeclared, definition=definition)
        else:
            start = len(self.uses)
            kind = self._type()[0] if declares else None
            name = self.name()
            if str(name) not in _REPEATABLE:
                self.once(names, str(name), f"sets `{name}` twice")
            if declares:
                self.subscripts()
            arguments = self._modification()
            modifier = Modifier(name, arguments, self.taken(start), is_redeclared, kind)
            self.description()
            if declares:
                self._annotation()
        found.append(msgspec.structs.replace(modifier, constraint=self._constraint()))

    def _break(self, found: list[Modifier]) -> None:
        """What is taken away of a base class: a component, or a connection."""
        start = len(self.uses)
        if self.accept("connect"):
            self.expression()
            del self.uses[start:]
        else:
            found.append(Modifier(self.name(), is_break=True))

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
                self._unread_arguments()
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
        first, one = self._end()
        self.expect(",")
        second, other = self._end()
        self.expect(")")
        self._body.connections.append(Connection(one, other))
        first, second = sorted((first, second))
        self.once(seen, f"connect {first} {second}", f"connects `{first}` and `{second}` twice")

    def _end(self) -> tuple[str, Name]:
        """One end of a connection: its text with subscripts, and its name."""
        start = self.at
        self.reference()
        return self.since(start), self.uses[-1]  # the names in its subscripts come before

    def _block(self, kind: str, *, repeats: bool) -> None:
        start = len(self.uses)
        indices: set[str] = set()
        if kind == "for":
            indices = self.indices()
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
        self.forget(indices, start)

    def _equations(self, *, repeats: bool) -> None:
        seen: set[str] | None = None if repeats else set()
        while self.word not in _BLOCK_ENDS:
            self.each(partial(self._equation, seen))
