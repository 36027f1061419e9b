"""Read Modelica text into syntax values, and say what is missing in it or there twice.

The grammar is the concrete syntax of the language specification 3.6 (appendix A). It is generous where that costs
nothing: it does not ask which kind of class may have what, nor for the precedence of operators. Elements and equations
are read one by one, so that one that is no Modelica does not hide what is wrong with another one.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator

import msgspec

from urdfsync.modelica.lexer import Fault, is_name, lex
from urdfsync.modelica.syntax import Class, Component, Extends, Import, Modifier, Name, StoredText

_DEEPEST = 50
"""How many brackets, classes and blocks are read within each other: deeper ones would exhaust Python's stack."""
_LONGEST = 60
"""Characters of what is quoted from a text."""

_SECTIONS = frozenset({"equation", "algorithm", "public", "protected"})
_BLOCK_ENDS = frozenset({"end", "else", "elseif", "elsewhen", "", *_SECTIONS})
_CLASSES = frozenset("class model record block connector type package function operator".split())
_CLASS_PREFIXES = ("encapsulated",), ("partial",), ("expandable", "pure", "impure")
_ELEMENT_PREFIXES = ("redeclare",), ("final",), ("inner",), ("outer",), ("replaceable",)
_ARGUMENT_PREFIXES = ("each",), ("final",)
_TYPE_PREFIXES = ("flow", "stream"), ("discrete", "parameter", "constant"), ("input", "output")
_ARITHMETIC = frozenset("+-*/^")
_OPERATORS = frozenset("or and < <= > >= == <> :".split()) | _ARITHMETIC
_BRANCHES = {"if": ("elseif", "else"), "when": ("elsewhen",)}
_CALLED = frozenset({"assert", "der", "initial", "pure"})
"""Keywords that are called like functions."""
_REPEATABLE = frozenset(
    "choice derivative file from inverse noDerivative noneFromVersion normallyConstant zeroDerivative".split()
)
"""Annotations that may stand more than once in one place."""


def parse(text: str) -> StoredText:
    """Read a text that should be a file of Modelica; whatever can't be read of it is left out."""
    parser = _Parser(text)
    parser.document()
    return StoredText(parser.faults, parser.within, parser.within_line, parser.around.classes)


class _FaultError(Exception):
    """Ends the reading of an element or equation."""

    def __init__(self, reason: str, line: int) -> None:
        super().__init__(reason)
        self.fault = Fault(reason, line)


class _Parser:
    """Reads one text from the first token to the last.

    A method reads what it is named for. It raises _FaultError where something is missing; `_each` catches that, and
    goes on behind the element or equation.
    """

    def __init__(self, text: str) -> None:
        self.tokens, self.faults = lex(text)
        self.at = 0
        self.within: str | None = None
        self.within_line = 0
        self.around = Class(Name(("",), 0), "")
        """The class around this place; at first one that stands for the file."""
        self._open: tuple[str, ...] = ()
        """Names of the classes around this place."""
        self._uses: list[Name] = []
        """Names that were read and do not belong to any syntax value yet."""
        self._depth = self._subscript_depth = 0

    # --- tokens ---------------------------------------------------------------------------------------------------

    @property
    def word(self) -> str:
        """The token that comes now; empty behind the last one."""
        return self.tokens[self.at].text

    @property
    def line(self) -> int:
        """The line of that token."""
        return self.tokens[self.at].line

    @property
    def following(self) -> str:
        """The token after that."""
        return self.tokens[min(self.at + 1, len(self.tokens) - 1)].text

    def _step(self) -> str:
        word = self.word
        self.at += bool(word)
        return word

    def _accept(self, *words: str) -> str:
        """Go on if the token is one of these, and return it; else return an empty text."""
        return self._step() if self.word in words else ""

    def _expect(self, word: str) -> None:
        if not self._accept(word):
            raise self._lack(f"`{word}`")

    def _identifier(self) -> str:
        if not is_name(self.word):
            raise self._lack("a name")
        return self._step()

    def _lack(self, what: str) -> _FaultError:
        before = "a string" if self.word[:1] == '"' else f"`{_short(self.word)}`" if self.word else "its end"
        return _FaultError(f"lacks {what} before {before}", self.line)

    def _once(self, seen: set[str], key: str, reason: str) -> None:
        """Note a fault if the key is in `seen`; else put it there."""
        if key in seen:
            self.faults.append(Fault(reason, self.tokens[self.at - 1].line, is_repetition=True))
        seen.add(key)

    def _since(self, start: int) -> str:
        """Return the tokens since the one with the number `start`, with blanks where they would run together."""
        text = " ".join(token.text for token in self.tokens[start : self.at])
        return re.sub(r" ?([.()\[\]]) ?", r"\1", text)

    def _taken(self, start: int) -> tuple[Name, ...]:
        """Take the names that were read since there were `start` of them."""
        names = tuple(self._uses[start:])
        del self._uses[start:]
        return names

    def _enter(self) -> None:
        if self._depth == _DEEPEST:
            raise _FaultError(f"nests more than {_DEEPEST} deep", self.line)
        self._depth += 1

    def _each(self, read: Callable[..., None], *arguments: object) -> None:
        """Read one element or equation and its semicolon; if something is wrong with it, go on behind it."""
        start, uses = self.at, len(self._uses)
        state = self._depth, self._subscript_depth, self._open, self.around
        try:
            self._enter()
            read(*arguments)
            self._depth -= 1
            self._expect(";")
        except _FaultError as error:
            self.faults.append(error.fault)
            self._depth, self._subscript_depth, self._open, self.around = state
            del self._uses[uses:]
            while self.word not in (";", "end", "", *_SECTIONS):
                self._step()
            if self.word == ";" or self.at == start:
                self._step()

    def _list(self, opening: str = "(", closing: str = ")", *, separators: str = ",") -> Iterator[None]:
        """Yield before each item of a list in brackets; it may be empty."""
        self._expect(opening)
        self._enter()
        if self.word != closing:
            yield
            while self._accept(*separators):
                yield
        self._depth -= 1
        if not self._accept(closing):
            raise self._lack(f"`,` or `{closing}`")

    # --- names and expressions ------------------------------------------------------------------------------------

    def _name(self, *, has_subscripts: bool = False) -> Name:
        line, is_global = self.line, bool(self._accept("."))
        parts: list[str] = []
        while not parts or (self.word == "." and is_name(self.following) and self._step()):
            parts.append(self._identifier())
            if has_subscripts:
                self._subscripts()
        return Name(tuple(parts), line, is_global)

    def _reference(self) -> Name:
        """A reference to a component or function."""
        name = self._name(has_subscripts=True)
        self._uses.append(name._replace(is_called=self.word == "("))
        return self._uses[-1]

    def _subscripts(self) -> None:
        """Subscripts or the sizes of an array, if there are any."""
        if self.word == "[":
            self._subscript_depth += 1
            for _ in self._list("[", "]"):
                if not (self.word == ":" and self.following in (",", "]") and self._step()):
                    self._expression()
            self._subscript_depth -= 1

    def _expression(self) -> None:
        while self._accept("if"):
            self._enter()
            is_branch = True
            while is_branch:
                self._expression()
                self._expect("then")
                self._expression()
                is_branch = bool(self._accept("elseif"))
            self._depth -= 1
            self._expect("else")
        operator = "or"  # a sign may stand at the beginning, as behind any operator that is no arithmetic one
        while operator:
            if operator not in _ARITHMETIC:
                self._accept("not")
                if self.word == "." and self.following in ("+", "-"):
                    self._step()
                self._accept("+", "-")
            self._operand()
            if self.word == "." and self.following in _ARITHMETIC:
                self._step()
            operator = self._accept(*_OPERATORS)

    def _operand(self) -> None:
        word = self.word
        is_literal = word[:1] == '"' or word[:1].isdecimal() or word in ("true", "false")
        if is_literal or (word == "end" and self._subscript_depth):
            self._step()
        elif word == "(":
            self._group()
        elif word == "[" and self.following != "]":
            for _ in self._list("[", "]", separators=",;"):
                self._expression()
        elif word == "{":
            for _ in self._list("{", "}"):
                self._item()
        elif self._accept(*_CALLED):
            self._call()
        elif is_name(word) or word == ".":
            self._reference()
            if self.word == "(":
                self._call()
        else:
            raise self._lack("an expression")

    def _group(self) -> None:
        """An expression in parentheses, or the outputs of a function, some of which may be left out."""
        for _ in self._list():
            if self.word not in (",", ")"):
                self._expression()
        self._subscripts()

    def _item(self) -> None:
        """An expression, possibly with the indices of a reduction."""
        start = len(self._uses)
        self._expression()
        if self._accept("for"):
            self._forget(self._indices(), start)

    def _call(self) -> None:
        """The arguments of a function."""
        names: set[str] = set()
        for _ in self._list():
            if is_name(self.word) and self.following == "=":
                name = self._identifier()
                self._once(names, name, f"sets `{name}` twice")
                self._step()
            elif names:
                raise self._lack("the name of an argument")
            if self._accept("function"):
                self._uses.append(self._name()._replace(is_called=True))
                self._call()
            else:
                self._item()

    def _indices(self) -> set[str]:
        """The indices of a loop or of a reduction; returns their names."""
        found: set[str] = set()
        while not found or self._accept(","):
            found.add(self._identifier())
            if self._accept("in"):
                self._expression()
        return found

    def _forget(self, indices: set[str], start: int) -> None:
        """Drop the names of indices from those that were read since there were `start` of them."""
        self._uses[start:] = [name for name in self._uses[start:] if name.is_global or name.parts[0] not in indices]

    # --- classes --------------------------------------------------------------------------------------------------

    def document(self) -> None:
        """A whole file."""
        if self.word == "within":
            self._each(self._within)
        names: set[str] = set()
        while self.word:
            self._each(self._stored_class, names)

    def _within(self) -> None:
        self.within_line = self.line
        self._expect("within")
        self.within = str(self._name()) if self.word != ";" else ""

    def _stored_class(self, names: set[str]) -> None:
        prefixes = self._prefixes((("final",),))
        if self.word == "end":
            raise _FaultError("has an `end` too many", self.line)
        if not self._is_class():
            raise self._lack("a class")
        self.around.classes.append(self._class(names, prefixes))

    def _is_class(self) -> bool:
        return self.word in _CLASSES or any(self.word in prefixes for prefixes in _CLASS_PREFIXES)

    def _prefixes(self, groups: Iterable[tuple[str, ...]]) -> set[str]:
        """At most one of each group, in order."""
        return {found for prefixes in groups if (found := self._accept(*prefixes))}

    def _class(self, names: set[str], prefixes: set[str]) -> Class:
        """A class; `names` are those declared before in the class around it, `prefixes` those read already."""
        prefixes |= self._prefixes(_CLASS_PREFIXES)
        kind = self._accept(*_CLASSES)
        if not kind:
            raise self._lack("the kind of class")
        if kind == "operator":
            kind = " ".join(filter(None, (kind, self._accept("record", "function"))))
        is_extension = bool(self._accept("extends"))
        line, text = self.line, self._identifier()
        self._once(names, text, f"declares `{text}` twice")
        found = Class(Name((text,), line), kind, frozenset(prefixes), is_extension=is_extension)
        if not is_extension and self._accept("="):
            return self._short_class(found)
        found.arguments = self._arguments() if is_extension else ()
        self._description()
        outer, self._open, self.around = (self._open, self.around), (*self._open, text), found
        self._composition()
        is_other_end = is_name(self.following) and self.following not in self._open
        if self.word != "end" or not (is_other_end or self.following == text):
            raise self._lack(f"`end {text}`")
        self._step()
        if (end := self._step()) != text:
            self.faults.append(Fault(f"ends `{text}` with `end {end}`", self.tokens[self.at - 1].line))
        self._open, self.around = outer
        return found

    def _short_class(self, found: Class) -> Class:
        if self._accept("enumeration"):
            literals: list[str] = []
            seen: set[str] = set()
            for _ in self._list():
                if not self._accept(":"):
                    literals.append(self._identifier())
                    self._once(seen, literals[-1], f"declares `{literals[-1]}` twice")
                    self._comment()
            found.literals = tuple(dict.fromkeys(literals))
        elif self._accept("der"):
            for _ in self._list():
                self._name()
            found.is_derivative = True
        else:
            start = len(self._uses)
            name, _ = self._type()
            del self._uses[start:]
            found.alias = Extends(name, self._arguments())
        self._comment()
        return found

    def _composition(self) -> None:
        """Elements, equations and algorithms up to the class's `end`."""
        names: set[str] = set()
        equations: set[str] = set()
        section = "public"
        while (word := self.word) not in ("end", ""):
            if word == "initial" and self.following in ("equation", "algorithm"):
                self._step()
            if found := self._accept(*_SECTIONS):
                section = found
            elif section in ("public", "protected") or word == "external":
                self._each(self._element, names)
            else:
                start = len(self._uses)
                self._each(self._equation, equations if section == "equation" else None)
                self.around.uses += self._taken(start)
            if word == "annotation" and self.word not in ("end", ""):
                self.faults.append(Fault(f"goes on after the annotation of `{self._open[-1]}`", self.line))

    # --- elements -------------------------------------------------------------------------------------------------

    def _element(self, names: set[str]) -> None:
        if self.word == "annotation":
            self._annotation()
        elif self._accept("import"):
            self._import()
        elif self._accept("extends"):
            parent = self._base()
            self._once(names, f"extends {parent.type}", f"extends `{parent.type}` twice")
            self.around.extends.append(parent)
            self._annotation()
        elif self._accept("external"):
            self._external()
        else:
            prefixes = self._prefixes(_ELEMENT_PREFIXES)
            if self._is_class():
                found = self._class(names, prefixes)
                found.constraint = self._constraint()
                self.around.classes.append(found)
            else:
                self._components(names, prefixes)

    def _base(self) -> Extends:
        """A class with its modifiers."""
        name = self._name()
        return Extends(name, self._arguments())

    def _import(self) -> None:
        alias = ""
        if self.following == "=":
            alias = self._identifier()
            self._step()
        name = self._name()
        members: list[tuple[str, str]] = []
        is_everything = False
        if self._accept("."):
            if self.word == "{":
                for _ in self._list("{", "}"):
                    short = self._identifier()
                    members.append((short, self._identifier() if self._accept("=") else short))
            else:
                self._expect("*")
                is_everything = True
        self._comment()
        self.around.imports.append(Import(name, alias, tuple(members), is_everything))

    def _external(self) -> None:
        self._description()
        start = len(self._uses)
        if self.word not in (";", "annotation"):
            self._expression()
            if self._accept("="):
                self._expression()
        # the function of the other language has a name of its own
        self.around.uses += [name for name in self._taken(start) if not name.is_called]
        self._comment()

    def _components(self, names: set[str], prefixes: set[str]) -> None:
        start, found = len(self._uses), list[Component]()
        kind, more = self._type()
        sizes = self._taken(start)
        while not found or self._accept(","):
            line, text = self.line, self._identifier()
            self._once(names, text, f"declares `{text}` twice")
            self._subscripts()
            arguments = self._modification()
            if self._accept("if"):
                self._expression()
            uses = (*sizes, *self._taken(start))
            found.append(Component(Name((text,), line), kind, frozenset(prefixes | more), arguments, uses))
            self._comment()
        constraint = self._constraint()
        self.around.components += [msgspec.structs.replace(one, constraint=constraint) for one in found]

    def _type(self) -> tuple[Name, set[str]]:
        """A type; returns it with its prefixes."""
        prefixes = self._prefixes(_TYPE_PREFIXES)
        name = self._name()
        self._subscripts()
        return name, prefixes

    def _constraint(self) -> Extends | None:
        if not self._accept("constrainedby"):
            return None
        found = self._base()
        self._comment()
        return found

    def _comment(self) -> None:
        """A description, an annotation, both or none."""
        self._description()
        self._annotation()

    def _description(self) -> None:
        """A description string, if there is one."""
        if self.word[:1] == '"':
            self._step()
            while self._accept("+"):
                if self.word[:1] != '"':
                    raise self._lack("a string")
                self._step()

    def _annotation(self) -> None:
        """An annotation, if there is one; names have meanings of their own in it."""
        if self._accept("annotation"):
            start = len(self._uses)
            self._arguments()
            del self._uses[start:]

    # --- modifiers ------------------------------------------------------------------------------------------------

    def _modification(self) -> tuple[Modifier, ...]:
        """Modifiers in parentheses and a value, whose names are added to `_uses`; both may be missing."""
        arguments = self._arguments()
        if self._accept("=", ":=") and not self._accept("break"):
            self._expression()
        return arguments

    def _arguments(self) -> tuple[Modifier, ...]:
        """Modifiers in parentheses, if there are any."""
        names: set[str] = set()
        return tuple(found for _ in self._list() if (found := self._argument(names))) if self.word == "(" else ()

    def _argument(self, names: set[str]) -> Modifier | None:
        """One modifier; None for a connection that is taken away."""
        is_redeclared = bool(self._accept("redeclare"))
        prefixes = self._prefixes(_ARGUMENT_PREFIXES)
        declares = bool(self._accept("replaceable")) or is_redeclared
        start = len(self._uses)
        if self._accept("break"):
            if not self._accept("connect"):
                return Modifier(self._name())
            self._expression()
            del self._uses[start:]
            return None
        if declares and self._is_class():
            definition = self._class(names, prefixes)
            return Modifier(definition.name, (), (), is_redeclared, None, definition, self._constraint())
        kind = self._type()[0] if declares else None
        name = self._name()
        if str(name) not in _REPEATABLE:
            self._once(names, str(name), f"sets `{name}` twice")
        if declares:
            self._subscripts()
        arguments = self._modification()
        uses = self._taken(start)
        self._description()
        if declares:
            self._annotation()
        return Modifier(name, arguments, uses, is_redeclared, kind, None, self._constraint())

    # --- equations and statements ---------------------------------------------------------------------------------

    def _equation(self, seen: set[str] | None) -> None:
        """An equation, or a statement if `seen` is None: statements may be repeated."""
        start, word = self.at, self.word
        if word == "annotation":
            self._annotation()
            return
        if self._accept("if", "when", "for", "while"):
            self._block(word, repeats=seen is None)
        elif seen is None and self._accept("break", "return"):
            pass
        elif seen is not None and self._accept("connect"):
            self._connect(seen)
        else:
            sign = ":=" if seen is None else "="
            self._expression()
            if self._accept(sign):
                self._expression()
            elif not (is_name(word) or word in _CALLED or word == ".") or self.tokens[self.at - 1].text != ")":
                raise self._lack(f"`{sign}`")
            if seen is not None:
                text = self._since(start)
                self._once(seen, text, f"has the equation `{_short(text)}` twice")
        self._comment()

    def _connect(self, seen: set[str]) -> None:
        texts: list[str] = []
        for mark in ("(", ","):
            self._expect(mark)
            start = self.at
            self._reference()
            texts.append(self._since(start))
        self._expect(")")
        first, second = sorted(texts)
        self._once(seen, f"connect {first} {second}", f"connects `{first}` and `{second}` twice")

    def _block(self, kind: str, *, repeats: bool) -> None:
        start = len(self._uses)
        indices: set[str] = set()
        begin = "loop" if kind in ("for", "while") else "then"
        branch = kind
        while branch:
            if branch == "for":
                indices = self._indices()
            elif branch != "else":
                self._expression()
            if branch != "else":
                self._expect(begin)
            seen: set[str] | None = None if repeats else set()
            while self.word not in _BLOCK_ENDS:
                self._each(self._equation, seen)
            branch = self._accept(*_BRANCHES.get(kind, ())) if branch != "else" else ""
        if (self.word, self.following) != ("end", kind):
            raise self._lack(f"`end {kind}`")
        self._step()
        self._step()
        self._forget(indices, start)


def _short(text: str) -> str:
    """Return a piece of a text as a sentence can quote it."""
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"
