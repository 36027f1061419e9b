"""Read Modelica text into syntax values, and say what is missing in it or there twice.

The grammar is the concrete syntax of the language specification 3.6 (appendix A). It is generous where that costs
nothing: it does not ask which kind of class may have what, nor for the precedence of operators. Elements and equations
are read one by one, so that one that is no Modelica does not hide what is wrong with another one.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Sequence

import msgspec

from urdfsync.modelica.lexer import Fault, is_name, lex
from urdfsync.modelica.syntax import Class, Component, Extends, ImportClause, Modifier, Name, StoredText

_DEEPEST = 50
"""How many brackets, classes and blocks are read within each other: deeper ones would exhaust Python's stack."""
_LONGEST = 60
"""Characters of what is quoted from a text."""

SECTIONS = frozenset({"equation", "algorithm", "public", "protected"})
_BLOCK_ENDS = frozenset({"end", "else", "elseif", "elsewhen", "", *SECTIONS})
CLASSES = frozenset("class model record block connector type package function operator".split())
# prefixes in their order, of which each group may have one
CLASS_PREFIXES = ("encapsulated",), ("partial",), ("expandable", "pure", "impure")
ELEMENT_PREFIXES = ("redeclare",), ("final",), ("inner",), ("outer",), ("replaceable",)
ARGUMENT_PREFIXES = ("redeclare",), ("each",), ("final",), ("replaceable",)
TYPE_PREFIXES = ("flow", "stream"), ("discrete", "parameter", "constant"), ("input", "output")
CLASS_STARTS = CLASSES.union(*CLASS_PREFIXES)
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
    return read(SyntaxParser(text))


def read(parser: SyntaxParser) -> StoredText:
    """Read all that a parser has before it."""
    parser.document()
    return StoredText(parser.faults, parser.within, parser.within_line, parser.open[0].classes, tuple(parser.libraries))


class _FaultError(Exception):
    """Ends the reading of an element or equation."""

    def __init__(self, reason: str, line: int) -> None:
        super().__init__(reason)
        self.fault = Fault(reason, line)


class SyntaxParser:
    """Reads one text from the first token to the last.

    A method reads what it is named for, and returns its value, or the names used in it. It raises _FaultError where
    something is missing; `_each` catches that, and goes on behind the element or equation.
    """

    def __init__(self, text: str) -> None:
        self.tokens, self.faults = lex(text)
        self.at = 0
        self.within: str | None = None
        self.within_line = 0
        self.open = [Class(Name(("",), 0), "")]
        """The classes around this place, the innermost one last; the first stands for the file."""
        self.libraries = list[str]()
        """Libraries that `uses` annotations name."""
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

    def _since(self, start: int) -> str:
        """Return the tokens since the one with the number `start`, with blanks where they would run together."""
        text = " ".join(token.text for token in self.tokens[start : self.at])
        return re.sub(r" ?([.()\[\]]) ?", r"\1", text)

    def _once(self, seen: set[str], key: str, reason: str) -> None:
        """Note a fault if the key is in `seen`; else put it there."""
        if key in seen:
            self.faults.append(Fault(reason, self.tokens[self.at - 1].line, is_repetition=True))
        seen.add(key)

    def _declared_name(self, names: set[str]) -> Name:
        """The name of something that is declared beside `names`."""
        token, text = self.tokens[self.at], self._identifier()
        self._once(names, text, f"declares `{text}` twice")
        return Name((text,), token.line, starts=(token.start,))

    def _enter(self) -> None:
        if self._depth == _DEEPEST:
            raise _FaultError(f"nests more than {_DEEPEST} deep", self.line)
        self._depth += 1

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

    def _each(self, read: Callable[..., list[Name] | None], *arguments: object) -> list[Name]:
        """Read one element or equation and its semicolon; if something is wrong with it, go on behind it."""
        start, depth, subscript_depth, classes = self.at, self._depth, self._subscript_depth, len(self.open)
        try:
            self._enter()
            found = read(*arguments)
            self._depth -= 1
            self._expect(";")
        except _FaultError as error:
            self.faults.append(error.fault)
            self._depth, self._subscript_depth = depth, subscript_depth
            del self.open[classes:]
            while self.word not in (";", "end", "", *SECTIONS):
                self._step()
            if self.word == ";" or self.at == start:
                self._step()
            return []
        return found or []

    # --- names and expressions ------------------------------------------------------------------------------------

    def _name(self, subscripts: list[Name] | None = None) -> Name:
        """A name with dots. If it may have subscripts, `subscripts` gets the names in them."""
        line, is_global = self.line, bool(self._accept("."))
        parts, starts = list[str](), list[int]()
        while not parts or (self.word == "." and is_name(self.following) and self._step()):
            starts.append(self.tokens[self.at].start)
            parts.append(self._identifier())
            if subscripts is not None:
                subscripts += self._subscripts()
        return Name(tuple(parts), line, is_global, starts=tuple(starts))

    def _reference(self) -> list[Name]:
        """A component or function, after the names in its subscripts."""
        found: list[Name] = []
        name = self._name(found)
        return [*found, name._replace(is_called=self.word == "(")]

    def _subscripts(self) -> list[Name]:
        """Subscripts or the sizes of an array, if there are any."""
        found: list[Name] = []
        if self.word == "[":
            self._subscript_depth += 1
            for _ in self._list("[", "]"):
                if not (self.word == ":" and self.following in (",", "]") and self._step()):
                    found += self._expression()
            self._subscript_depth -= 1
        return found

    def _expression(self) -> list[Name]:
        found: list[Name] = []
        while branch := self._accept("if"):
            self._enter()
            while branch:
                found += self._expression()
                self._expect("then")
                found += self._expression()
                branch = self._accept("elseif")
            self._depth -= 1
            self._expect("else")
        operator = "or"  # a sign may stand at the beginning, as behind any operator that is no arithmetic one
        while operator:
            if operator not in _ARITHMETIC:
                self._accept("not")
                if self.word == "." and self.following in ("+", "-"):
                    self._step()
                self._accept("+", "-")
            found += self._operand()
            if self.word == "." and self.following in _ARITHMETIC:
                self._step()
            operator = self._accept(*_OPERATORS)
        return found

    def _operand(self) -> list[Name]:
        word = self.word
        if word[:1] == '"' or word[:1].isdecimal() or word in ("true", "false"):
            self._step()
            return []
        if word == "end" and self._subscript_depth:
            self._step()
            return []
        if word == "(":  # an expression, or the outputs of a function, some of which may be left out
            inside = [name for _ in self._list() if self.word not in (",", ")") for name in self._expression()]
            return inside + self._subscripts()
        if word == "[" and self.following != "]":
            return [name for _ in self._list("[", "]", separators=",;") for name in self._expression()]
        if word == "{":
            return [name for _ in self._list("{", "}") for name in self._item()]
        if self._accept(*_CALLED):
            return self._call()
        if is_name(word) or word == ".":
            found = self._reference()
            return found + self._call() if self.word == "(" else found
        raise self._lack("an expression")

    def _call(self) -> list[Name]:
        """The arguments of a function."""
        found: list[Name] = []
        names: set[str] = set()
        for _ in self._list():
            if is_name(self.word) and self.following == "=":
                name = self._identifier()
                self._once(names, name, f"sets `{name}` twice")
                self._step()
            elif names:
                raise self._lack("the name of an argument")
            if self._accept("function"):
                found.append(self._name()._replace(is_called=True))
                found += self._call()
            else:
                found += self._item()
        return found

    def _item(self) -> list[Name]:
        """An expression, possibly with the indices of a reduction."""
        found = self._expression()
        if self._accept("for"):
            indices, ranges = self._indices()
            found = _without(indices, found + ranges)
        return found

    def _indices(self) -> tuple[set[str], list[Name]]:
        """The indices of a loop or of a reduction, and the names in their ranges."""
        indices, ranges = set[str](), list[Name]()
        while not indices or self._accept(","):
            indices.add(self._identifier())
            if self._accept("in"):
                ranges += self._expression()
        return indices, ranges

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
        if self.word not in CLASS_STARTS:
            raise self._lack("a class")
        self.open[-1].classes.append(self._class(names, prefixes))

    def _prefixes(self, groups: Sequence[tuple[str, ...]]) -> set[str]:
        """At most one of each group, in order."""
        return {found for prefixes in groups if (found := self._accept(*prefixes))}

    def _class(self, names: set[str], prefixes: set[str]) -> Class:
        """A class; `names` are those declared before in the class around it, `prefixes` those read already."""
        prefixes |= self._prefixes(CLASS_PREFIXES)
        kind = self._accept(*CLASSES)
        if not kind:
            raise self._lack("the kind of class")
        if kind == "operator" and (more := self._accept("record", "function")):
            kind = f"operator {more}"
        is_extension = bool(self._accept("extends"))
        name = self._declared_name(names)
        found = Class(name, kind, frozenset(prefixes), is_extension=is_extension)
        if not is_extension and self._accept("="):
            self._short_class(found)
            return found
        found.arguments = self._arguments() if is_extension else ()
        self._description()
        self.open.append(found)
        self._composition()
        around = {str(one.name) for one in self.open}  # another name is a slip, unless it ends a class around this one
        if self.word != "end" or not is_name(end := self.following) or (end in around and end != str(name)):
            raise self._lack(f"`end {name}`")
        self._step()
        if self._step() != str(name):
            self.faults.append(Fault(f"ends `{name}` with `end {end}`", self.tokens[self.at - 1].line))
        self.open.pop()
        return found

    def _short_class(self, found: Class) -> None:
        """The part of a class behind its equals sign."""
        if self._accept("enumeration"):
            names: set[str] = set()
            literals: list[str] = []
            for _ in self._list():
                if not self._accept(":"):
                    literals.append(str(self._declared_name(names)))
                    self._comment()
            found.literals = tuple(dict.fromkeys(literals))
        elif self._accept("der"):
            for _ in self._list():
                self._name()
            found.is_derivative = True
        else:
            self._prefixes(TYPE_PREFIXES)
            name = self._name()
            self._subscripts()
            found.alias = Extends(name, self._arguments())
        self._comment()

    def _composition(self) -> None:
        """Elements, equations and algorithms up to the class's `end`."""
        names, equations = set[str](), set[str]()
        around, section = self.open[-1], "public"
        while (word := self.word) not in ("end", ""):
            if word == "initial" and self.following in ("equation", "algorithm"):
                self._step()
            if found := self._accept(*SECTIONS):
                section = found
            elif section in ("public", "protected") or word == "external":
                self._each(self._element, names)
            else:
                around.uses += self._each(self._equation, equations if section == "equation" else None)
            if word == "annotation" and self.word not in ("end", ""):
                self.faults.append(Fault(f"goes on after the annotation of `{around.name}`", self.line))

    # --- elements -------------------------------------------------------------------------------------------------

    def _element(self, names: set[str]) -> None:
        around = self.open[-1]
        if self.word == "annotation":
            self._annotation()
        elif self._accept("import"):
            around.imports.append(self._import())
        elif self._accept("extends"):
            base = self._base()
            self._once(names, f"extends {base.type}", f"extends `{base.type}` twice")
            around.extends.append(base)
            self._annotation()
        elif self._accept("external"):
            self._external()
        else:
            prefixes = self._prefixes(ELEMENT_PREFIXES)
            if self.word in CLASS_STARTS:
                found = self._class(names, prefixes)
                found.constraint = self._constraint()
                around.classes.append(found)
            else:
                around.components += self._components(names, prefixes)

    def _base(self) -> Extends:
        """A class with its modifiers."""
        name = self._name()
        return Extends(name, self._arguments())

    def _import(self) -> ImportClause:
        alias = ""
        if self.following == "=":
            alias = self._identifier()
            self._step()
        name = self._name()._replace(is_global=True)
        names: dict[str, Name] = {}
        if not self._accept("."):
            names[alias or name.parts[-1]] = name
        elif self.word != "{":
            self._expect("*")
        else:
            for _ in self._list("{", "}"):
                line, start, short = self.line, self.tokens[self.at].start, self._identifier()
                member = short
                if self._accept("="):
                    line, start, member = self.line, self.tokens[self.at].start, self._identifier()
                names[short] = name._replace(parts=(*name.parts, member), line=line, starts=(*name.starts, start))
        self._comment()
        return ImportClause(name, names)

    def _external(self) -> None:
        self._description()
        found: list[Name] = []
        if self.word not in (";", "annotation"):
            found += self._expression()
            if self._accept("="):
                found += self._expression()
        # the function of the other language has a name of its own
        self.open[-1].uses += [name for name in found if not name.is_called]
        self._comment()

    def _components(self, names: set[str], prefixes: set[str]) -> list[Component]:
        """The components of one declaration."""
        prefixes |= self._prefixes(TYPE_PREFIXES)
        kind, sizes = self._name(), self._subscripts()
        found: list[Component] = []
        while not found or self._accept(","):
            name, uses = self._declared_name(names), [*sizes, *self._subscripts()]
            arguments, values = self._modification()
            condition = self._expression() if self._accept("if") else []
            found.append(Component(name, kind, frozenset(prefixes), arguments, (*uses, *values, *condition)))
            self._comment()
        constraint = self._constraint()
        return [msgspec.structs.replace(one, constraint=constraint) for one in found]

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
            for one in self._arguments():
                if one.name.parts == ("uses",):
                    self.libraries += (used.name.parts[0] for used in one.arguments)

    # --- modifiers ------------------------------------------------------------------------------------------------

    def _modification(self) -> tuple[tuple[Modifier, ...], list[Name]]:
        """Modifiers in parentheses and the names in a value; both may be missing."""
        arguments = self._arguments()
        has_value = self._accept("=", ":=") and not self._accept("break")
        return arguments, self._expression() if has_value else []

    def _arguments(self) -> tuple[Modifier, ...]:
        """Modifiers in parentheses, if there are any."""
        names: set[str] = set()
        return tuple(found for _ in self._list() if (found := self._argument(names))) if self.word == "(" else ()

    def _argument(self, names: set[str]) -> Modifier | None:
        """One modifier; None for a connection that is taken away."""
        prefixes = self._prefixes(ARGUMENT_PREFIXES)
        declares, is_redeclared = not prefixes.isdisjoint({"redeclare", "replaceable"}), "redeclare" in prefixes
        if self._accept("break"):
            if not self._accept("connect"):
                return Modifier(self._name())
            self._expression()
            return None
        if declares and self.word in CLASS_STARTS:
            definition = self._class(names, prefixes)
            return Modifier(definition.name, (), (), is_redeclared, definition.alias, self._constraint())
        new_type: Extends | None = None
        uses: list[Name] = []
        if declares:
            self._prefixes(TYPE_PREFIXES)
            new_type = Extends(self._name())
            uses += self._subscripts()
        name = self._name()
        if str(name) not in _REPEATABLE:
            self._once(names, str(name), f"sets `{name}` twice")
        if declares:
            uses += self._subscripts()
        arguments, values = self._modification()
        self._description()
        if declares:
            self._annotation()
        return Modifier(name, arguments, (*uses, *values), is_redeclared, new_type, self._constraint())

    # --- equations and statements ---------------------------------------------------------------------------------

    def _equation(self, seen: set[str] | None) -> list[Name]:
        """An equation, or a statement if `seen` is None: statements may be repeated."""
        start, word, found = self.at, self.word, list[Name]()
        if word == "annotation":
            self._annotation()
            return []
        if self._accept("if", "when", "for", "while"):
            found = self._block(word, repeats=seen is None)
        elif seen is None and self._accept("break", "return"):
            pass
        elif seen is not None and self._accept("connect"):
            found = self._connect(seen)
        else:
            sign = ":=" if seen is None else "="
            found = self._expression()
            if self._accept(sign):
                found += self._expression()
            elif not (is_name(word) or word in _CALLED or word == ".") or self.tokens[self.at - 1].text != ")":
                raise self._lack(f"`{sign}`")
            if seen is not None:
                text = self._since(start)
                self._once(seen, text, f"has the equation `{_short(text)}` twice")
        self._comment()
        return found

    def _connect(self, seen: set[str]) -> list[Name]:
        found, texts = list[Name](), list[str]()
        for mark in ("(", ","):
            self._expect(mark)
            start = self.at
            found += self._reference()
            texts.append(self._since(start))
        self._expect(")")
        first, second = sorted(texts)
        self._once(seen, f"connect {first} {second}", f"connects `{first}` and `{second}` twice")
        return found

    def _block(self, kind: str, *, repeats: bool) -> list[Name]:
        """The rest of an equation or statement that holds others, which may repeat each other."""
        found, indices = list[Name](), set[str]()
        branch = kind
        while branch:
            if branch == "for":
                indices, found = self._indices()
            elif branch != "else":
                found += self._expression()
            if branch != "else":
                self._expect("loop" if kind in ("for", "while") else "then")
            seen: set[str] | None = None if repeats else set()
            while self.word not in _BLOCK_ENDS:
                found += self._each(self._equation, seen)
            branch = self._accept(*_BRANCHES.get(kind, ())) if branch != "else" else ""
        if (self.word, self.following) != ("end", kind):
            raise self._lack(f"`end {kind}`")
        self._step()
        self._step()
        return _without(indices, found)


def _without(indices: Collection[str], names: Sequence[Name]) -> list[Name]:
    """Return names but for those of indices."""
    return [name for name in names if name.is_global or name.parts[0] not in indices]


def _short(text: str) -> str:
    """Return a piece of a text as a sentence can quote it."""
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"
