"""Reads Modelica text: names, faults, and parts.

The grammar is the concrete syntax of the language specification 3.6 (appendix A). It ignores restrictions for kinds of
classes, and the precedence of operators. Elements and equations are read one by one, so a fault in an element does not
hide faults in others.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Callable, Collection, Iterator, Sequence

import msgspec

from urdfsync.modelica.lexer import Fault, Lexer, is_name, is_number
from urdfsync.modelica.syntax import Class, Component, Extends, ImportClause, Modifier, Name, StoredText

_DEEPEST = 50
"""Deepest nesting of brackets, classes and blocks: deeper nesting would exhaust Python's stack."""
_NUMBER = r"[-+]?\d++(?:\.\d*+)?(?:[eE][-+]?\d++)?\s*+"
_ARRAY = rf"\{{\s*+{_NUMBER}(?:,\s*+{_NUMBER})*+\}}\s*+"
_NUMBERS = re.compile(rf"{_ARRAY}|\{{\s*+{_ARRAY}(?:,\s*+{_ARRAY})*+\}}")
"""An array of numbers, or of arrays of numbers."""
_LONGEST = 60
"""The greatest number of characters of a quote."""

SECTIONS = frozenset({"equation", "algorithm", "public", "protected"})
_BLOCK_ENDS = frozenset({"end", "else", "elseif", "elsewhen", "", *SECTIONS})
_CLASSES = frozenset("class model record block connector type package function operator".split())
# prefixes in order; at most one of each group
_CLASS_PREFIXES = ("encapsulated",), ("partial",), ("expandable", "pure", "impure")
_ELEMENT_PREFIXES = ("redeclare",), ("final",), ("inner",), ("outer",), ("replaceable",)
_ARGUMENT_PREFIXES = ("redeclare",), ("each",), ("final",), ("replaceable",)
_TYPE_PREFIXES = ("flow", "stream"), ("discrete", "parameter", "constant"), ("input", "output")
_CLASS_STARTS = _CLASSES.union(*_CLASS_PREFIXES)
_OPEN, _CLOSED = frozenset("([{"), frozenset(")]}")
_ARITHMETIC = frozenset("+-*/^")
_OPERATORS = frozenset("or and < <= > >= == <> :".split()) | _ARITHMETIC
_BLOCKS = frozenset({"if", "when", "for", "while"})
_BRANCHES = {"if": ("elseif", "else"), "when": ("elsewhen",)}
_CALLED = frozenset({"assert", "der", "initial", "pure"})
"""Keywords that expressions call like functions."""
_REPEATABLE = frozenset(
    "choice derivative file from inverse noDerivative noneFromVersion normallyConstant zeroDerivative".split()
)
"""Annotations that may be repeated in one place."""


def parse(text: str) -> StoredText:
    """Read the text of a Modelica file; unreadable parts are left out."""
    return Parser(text).read()


class _FaultError(Exception):
    """Ends the reading of an element or equation."""

    def __init__(self, reason: str, line: int) -> None:
        super().__init__(reason)
        self.fault = Fault(reason, line)


class Parser(Lexer):
    """Reads one text from the first token to the last.

    A method reads the part in its name, and returns the part's value. For a missing token it raises _FaultError;
    `_each` catches this error, and continues after the element or equation.
    """

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.faults: list[Fault] = []
        self.at = 0
        self._within: str | None = None
        self._within_line = 0
        self.open = [Class(Name(("",), 0), "")]
        """The classes around the present place, from the file itself to the innermost class."""
        self._libraries = list[str]()
        """Libraries that `uses` annotations name."""
        self._names = list[Name]()
        """Names in expressions that no element has taken yet."""
        self._seen = set[str]()
        """Keys of earlier elements and equations in this section, to find repetitions."""
        self._depth = self._subscript_depth = 0

    def read(self) -> StoredText:
        """Read all of the text."""
        self.document()
        faults = [*self.endless, *self.strange_escapes(), *self.faults]
        return StoredText(faults, self._within, self._within_line, self.open[0].classes, tuple(self._libraries))

    # --- tokens ---------------------------------------------------------------------------------------------------

    @property
    def word(self) -> str:
        """The present token; empty after the last token."""
        try:
            return self.words[self.at]
        except IndexError:
            self.read_statement()
            return self.words[self.at]

    @property
    def line(self) -> int:
        """The line of the present token."""
        return self.line_at(self.starts[self.at]) if self.word or self.words else 1

    @property
    def following(self) -> str:
        """The next token, within a statement."""
        return self.words[self.at + 1] if self.word not in (";", "") else ""

    def _step(self) -> str:
        word = self.word
        self.at += bool(word)
        return word

    def _accept(self, *words: str) -> str:
        """Consume and return the present token if it is one of these; else return an empty text."""
        word = self.word
        if word not in words:
            return ""
        self.at += 1
        return word

    def _expect(self, word: str) -> None:
        if self.word != word:
            raise self._lack(f"`{word}`")
        self.at += 1

    def _identifier(self) -> str:
        if not is_name(self.word):
            raise self._lack("a name")
        return self._step()

    def _lack(self, what: str) -> _FaultError:
        before = "a string" if self.word[:1] == '"' else f"`{_short(self.word)}`" if self.word else "its end"
        return _FaultError(f"lacks {what} before {before}", self.line)

    def _since(self, start: int) -> str:
        """Return the tokens from number `start` to the present token, with blanks where tokens would run together."""
        return re.sub(r" ?([.()\[\]]) ?", r"\1", " ".join(self.words[start : self.at]))

    def _once(self, seen: set[str], key: str, reason: str) -> None:
        """Record a fault if the key is in `seen`; else add the key."""
        if key in seen:
            self.faults.append(Fault(reason, self.line_at(self.starts[self.at - 1]), is_repetition=True))
        seen.add(key)

    def _declared_name(self, names: set[str]) -> Name:
        """Read a declared name; `names` has names that are declared beside it."""
        text, start = self._identifier(), self.starts[self.at - 1]
        self._once(names, text, f"declares `{text}` twice")
        return Name((text,), self.line_at(start), starts=(start,))

    def _take_names(self, mark: int) -> tuple[Name, ...]:
        """Return the names from number `mark` on, and remove them."""
        if len(self._names) == mark:
            return ()
        names = tuple(self._names[mark:])
        del self._names[mark:]
        return names

    def _leave_out(self, indices: set[str], mark: int) -> None:
        """Remove the indices of a loop from the names from number `mark` on."""
        names = self._take_names(mark)
        self._names += (name for name in names if name.is_global or name.parts[0] not in indices)

    def _enter(self) -> None:
        if self._depth == _DEEPEST:
            raise _FaultError(f"nests more than {_DEEPEST} deep", self.line)
        self._depth += 1

    def _list(self, opening: str = "(", closing: str = ")", *, separators: str = ",") -> Iterator[None]:
        """Yield once before each item of a list in brackets; the list may be empty."""
        self._expect(opening)
        self._enter()
        if self.word != closing:
            yield
            while self._accept(*separators):
                yield
        self._depth -= 1
        if not self._accept(closing):
            raise self._lack(f"`,` or `{closing}`")

    def _each(self, read: Callable[..., None], *arguments: object) -> None:
        """Read one element or equation with its semicolon; after a fault, continue behind the semicolon."""
        start, depth, subscript_depth, classes = self.at, self._depth, self._subscript_depth, len(self.open)
        mark = len(self._names)
        try:
            self._enter()
            read(*arguments)
            self._depth -= 1
            self._expect(";")
            self._note(";", self.at - 1)
        except _FaultError as error:
            self.faults.append(error.fault)
            self._depth, self._subscript_depth = depth, subscript_depth
            del self.open[classes:], self._names[mark:]
            while self.word not in (";", "end", "", *SECTIONS):
                self._step()
            if self.word == ";" or self.at == start:
                self._step()

    # --- hooks that the reader of trees (`urdfsync.modelica.tree`) overrides
    # ---------------------------------------------

    def _mark(self) -> int:
        """Return a `mark` for `_note`: a part with this mark contains all parts that are noted after the mark."""
        return 0

    def _note(self, key: str, start: int, mark: int | None = None) -> None:
        """Note that the tokens from number `start` on are a part with this key."""

    def _note_statement(self, start: int) -> None:
        """Note that the tokens from this number on are an element, an equation, or the words of a section."""

    def _next_word(self) -> str:
        """Return the first word of the next element or equation."""
        return self.word

    def _skips_rest(self) -> bool:
        """Skip the rest of an element or equation if only its name counts; return whether this skipped anything."""
        return False

    # --- names and expressions ------------------------------------------------------------------------------------

    def _name(self, *, has_subscripts: bool = False) -> Name:
        """Read a name with dots; with `has_subscripts`, also read subscripts, and the names in the subscripts."""
        word = self.word
        line, is_global = self.line_at(self.starts[self.at]), word == "."
        self.at += is_global
        parts, starts = [self._identifier()], [self.starts[self.at - 1]]
        while True:
            if has_subscripts and self.word == "[":
                self._subscripts()
            if self.word != "." or not is_name(self.following):
                return Name(tuple(parts), line, is_global, starts=tuple(starts))
            starts.append(self.starts[self.at + 1])
            parts.append(self.words[self.at + 1])
            self.at += 2

    def _reference(self) -> None:
        """Read a component or function, after the names in its subscripts."""
        name = self._name(has_subscripts=True)
        self._names.append(name._replace(is_called=True) if self.word == "(" else name)

    def _subscripts(self) -> None:
        """Read subscripts or the sizes of an array, if there are any."""
        if self.word == "[":
            self._subscript_depth += 1
            if self.following == "]":
                self._step()
                raise self._lack("a subscript")
            for _ in self._list("[", "]"):
                if not (self.word == ":" and self.following in (",", "]") and self._step()):
                    self._expression()
            self._subscript_depth -= 1

    def _expression(self) -> None:
        word = self.word
        # fast path for the commonest expressions: saves 0.5 of 0.9 s for a robot model of 1,000 links
        if word[:1] == '"' or word[:1].isdecimal():
            stop = self.at + 1
        elif word == "{" and (array := _NUMBERS.match(self.text, self.starts[self.at])):
            stop = bisect_left(self.starts, array.end(), self.at)
        else:
            stop = 0
        if stop and self.words[stop] in (",", ")", "}", ";"):
            self.at = stop
            return
        while branch := self._accept("if"):
            self._enter()
            while branch:
                self._expression()
                self._expect("then")
                self._expression()
                branch = self._accept("elseif")
            self._depth -= 1
            self._expect("else")
        operator = "or"  # a sign is allowed at the beginning, and after any operator that is not arithmetic
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
        is_literal = word[:1] == '"' or is_number(word) or word in ("true", "false")
        if is_literal or (word == "end" and self._subscript_depth):
            self._step()
        elif word == "(":  # an expression, or outputs of a function; some outputs may be omitted
            for _ in self._list():
                if self.word not in (",", ")"):
                    self._expression()
            self._subscripts()
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
                self._call_named()
        else:
            raise self._lack("an expression")

    def _call_named(self) -> None:
        """Read the arguments of the function whose name was read last."""
        place = len(self._names) - 1
        if arguments := self._call():
            self._names[place] = self._names[place]._replace(arguments=arguments)

    def _call(self) -> tuple[Name, ...]:
        """Read the arguments of a function. Returns the names of named arguments."""
        names, arguments = set[str](), list[Name]()
        for _ in self._list():
            if is_name(self.word) and self.following == "=":
                name, start = self._identifier(), self.starts[self.at - 1]
                self._once(names, name, f"sets `{name}` twice")
                arguments.append(Name((name,), self.line_at(start), starts=(start,)))
                self._step()
            elif names:
                raise self._lack("the name of an argument")
            if self._accept("function"):
                self._names.append(self._name()._replace(is_called=True))
                self._call_named()
            else:
                self._item()
        return tuple(arguments)

    def _item(self) -> None:
        """Read an expression, possibly with the indices of a reduction."""
        mark = len(self._names)
        self._expression()
        if self._accept("for"):
            self._leave_out(self._indices(), mark)

    def _indices(self) -> set[str]:
        """Read the indices of a loop or of a reduction, and the names in their ranges."""
        indices = set[str]()
        while not indices or self._accept(","):
            indices.add(self._identifier())
            if self._accept("in"):
                self._expression()
        return indices

    # --- classes --------------------------------------------------------------------------------------------------

    def document(self) -> None:
        """Read a whole file."""
        if self.word == "within":
            mark = self._mark()
            self._each(self._within_clause)
            self._note("within", 0, mark)
        names: set[str] = set()
        while self.word:
            self._each(self._stored_class, names)

    def _within_clause(self) -> None:
        self._within_line = self.line
        self._expect("within")
        if self.word == ".":
            raise self._lack("a name")
        self._within = str(self._name()) if self.word != ";" else ""

    def _stored_class(self, names: set[str]) -> None:
        prefixes = self._prefixes((("final",),))
        if self.word == "end":
            raise _FaultError("has one `end` too many", self.line)
        if self.word not in _CLASS_STARTS:
            raise self._lack("a class")
        self.open[-1].classes.append(self._class(names, prefixes))

    def _prefixes(self, groups: Sequence[tuple[str, ...]], key: str = "prefixes") -> set[str]:
        """Read at most one prefix of each group, in order."""
        start = self.at
        prefixes = {word for group in groups if (word := self._accept(*group))}
        if prefixes and key:
            self._note(key, start)
        return prefixes

    def _class(self, names: set[str], prefixes: set[str]) -> Class:
        """Read a class; `names` are declared names in the class around it, `prefixes` are the prefixes already read."""
        start = self.at
        prefixes |= self._prefixes(_CLASS_PREFIXES, "")
        kind = self._accept(*_CLASSES)
        if not kind:
            raise self._lack("the kind of class")
        if kind == "operator" and (more := self._accept("record", "function")):
            kind = f"operator {more}"
        is_extension = bool(self._accept("extends"))
        name = self._declared_name(names)
        definition = Class(name, kind, frozenset(prefixes), is_extension=is_extension)
        is_short = not is_extension and bool(self._accept("="))
        self._note("head", start)
        if is_short:
            self._short_class(definition)
            return definition
        definition.arguments = self._arguments() if is_extension else ()
        self._description()
        self.open.append(definition)
        self._composition()
        around = {
            str(enclosing.name) for enclosing in self.open
        }  # a wrong name is a mistake, unless it ends a class around this class
        if self.word != "end" or not is_name(end := self.following) or (end in around and end != str(name)):
            raise self._lack(f"`end {name}`")
        self.at += 2
        self._note("end", self.at - 2)
        if end != str(name):
            self.faults.append(Fault(f"ends `{name}` with `end {end}`", self.line_at(self.starts[self.at - 1])))
        self.open.pop()
        return definition

    def _short_class(self, definition: Class) -> None:
        """Read the rest of a class after an equals sign."""
        start, mark = self.at, self._mark()
        if self._accept("enumeration"):
            names: set[str] = set()
            literals: list[str] = []
            for _ in self._list():
                if not self._accept(":"):
                    literals.append(str(self._declared_name(names)))
                    self._comment()
            definition.literals = tuple(dict.fromkeys(literals))
            self._note("definition", start, mark)
        elif self._accept("der"):
            for _ in self._list():
                self._name()
            definition.is_derivative = True
            self._note("definition", start)
        else:
            _, name = self._type()
            definition.alias = Extends(name, self._arguments())
        self._comment()

    def _composition(self) -> None:
        """Read elements, equations and algorithms up to the class's `end`."""
        names, equations = set[str](), set[str]()
        section = "public"
        while True:
            self._seen = equations if section == "equation" else names
            word, start = self._next_word(), self.at
            if word in ("end", ""):
                break
            if word == "initial" and self.following in ("equation", "algorithm"):
                self._step()
            if new_section := self._accept(*SECTIONS):
                section = new_section
            elif section in ("public", "protected") or word == "external":
                self._each(self._element, names)
            else:
                self._each(self._equation, equations if section == "equation" else None)
                self.open[-1].uses += self._take_names(0)
            self._note_statement(start)
            if word == "annotation":
                self._expect_end()

    def _expect_end(self) -> None:
        """Record a fault if anything follows the annotation of a class."""
        if self.word not in ("end", ""):
            self.faults.append(Fault(f"goes on after the annotation of `{self.open[-1].name}`", self.line))

    # --- elements -------------------------------------------------------------------------------------------------

    def _element(self, names: set[str]) -> None:
        around, start, mark = self.open[-1], self.at, self._mark()
        if self.word == "annotation":
            self._annotation()
        elif self._accept("import"):
            around.imports.append(self._import())
            self._note("import", start, mark)
        elif self._accept("extends"):
            self._note("word", start)
            base = self._base()
            self._once(names, f"extends {base.type}", f"extends `{base.type}` twice")
            around.extends.append(base)
            self._annotation()
        elif self._accept("external"):
            self._external()
            self._note("external", start, mark)
        else:
            prefixes = self._prefixes(_ELEMENT_PREFIXES)
            if self.word in _CLASS_STARTS:
                definition = self._class(names, prefixes)
                definition.constraint = self._constraint(prefixes)
                around.classes.append(definition)
            else:
                around.components += self._components(names, prefixes)

    def _type(self) -> tuple[set[str], Name]:
        """Read prefixes of a type, the type, and sizes of an array."""
        start = self.at
        prefixes, name = self._prefixes(_TYPE_PREFIXES, ""), self._name()
        self._subscripts()
        self._note("type", start)
        return prefixes, name

    def _base(self) -> Extends:
        """Read a class with its modifiers."""
        start, name = self.at, self._name()
        self._note("type", start)
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
                short = member = self._identifier()
                if self._accept("="):
                    member = self._identifier()
                start = self.starts[self.at - 1]
                names[short] = name._replace(
                    parts=(*name.parts, member), line=self.line_at(start), starts=(*name.starts, start)
                )
        self._comment()
        return ImportClause(name, names)

    def _external(self) -> None:
        self._description()
        mark = len(self._names)
        if self.word not in (";", "annotation"):
            self._expression()
            if self._accept("="):
                self._expression()
        # the name of the external function is no Modelica name
        self.open[-1].uses += [name for name in self._take_names(mark) if not name.is_called]
        self._comment()

    def _components(self, names: set[str], prefixes: set[str]) -> list[Component]:
        """Read the components of one declaration."""
        start, mark, names_mark = self.at, self._mark(), len(self._names)
        more, kind = self._type()
        sizes = self._take_names(names_mark)
        components: list[Component] = []
        while not components or self._accept(","):
            name = self._declared_name(names)
            self._note("name", self.at - 1)
            if not components and self._skips_rest():
                return []
            self._sizes()
            arguments = self._modification()
            condition = self.at
            if self._accept("if"):
                self._expression()
                self._note("condition", condition)
            uses = (*sizes, *self._take_names(names_mark))
            components.append(Component(name, kind, frozenset(prefixes | more), arguments, uses))
            self._comment()
        constraint = self._constraint(prefixes)
        if components[1:]:  # in the tree, the components of one declaration are one part
            self._note("components", start, mark)
        return (
            [msgspec.structs.replace(component, constraint=constraint) for component in components]
            if constraint
            else components
        )

    def _sizes(self) -> None:
        start = self.at
        self._subscripts()
        self._note("sizes", start)

    def _constraint(self, prefixes: Collection[str]) -> Extends | None:
        """Read the constraining class of a replaceable element, if there is one."""
        start, mark = self.at, self._mark()
        if "replaceable" not in prefixes or not self._accept("constrainedby"):
            return None
        self._note("word", start)
        base = self._base()
        self._note("constraint", start, mark)
        self._comment()
        return base

    def _comment(self) -> None:
        """Read a description, an annotation, both or none."""
        self._description()
        self._annotation()

    def _description(self) -> None:
        """Read a description string, if there is one."""
        if self.word[:1] == '"':
            start = self.at
            self._step()
            while self._accept("+"):
                if self.word[:1] != '"':
                    raise self._lack("a string")
                self._step()
            self._note("description", start)

    def _annotation(self) -> None:
        """Read an annotation, if there is one; names in annotations are not recorded."""
        if self._accept("annotation"):
            for argument in self._arguments("annotation"):
                if argument.name.parts == ("uses",):
                    self._libraries += (used.name.parts[0] for used in argument.arguments)

    # --- modifiers ------------------------------------------------------------------------------------------------

    def _modification(self) -> tuple[Modifier, ...]:
        """Read modifiers in parentheses and a value; both may be missing."""
        arguments = self._arguments()
        start, mark = self.at, self._mark()
        if self._accept("=", ":="):
            self._note("sign", start)
            if not self._accept("break"):
                self._expression()
            self._note("expression", start + 1)
            self._note("value", start, mark)
        return arguments

    def _arguments(self, key: str = "arguments") -> tuple[Modifier, ...]:
        """Read modifiers in parentheses, if there are any."""
        if self.word != "(" and key == "arguments":
            return ()
        start, mark, names = self.at - (key == "annotation"), self._mark(), set[str]()
        modifiers = tuple([modifier for _ in self._list() if (modifier := self._argument(names))])
        self._note(key, start, mark)
        return modifiers

    def _argument(self, names: set[str]) -> Modifier | None:
        """Read one modifier; returns None for a removed connection."""
        start, mark, names_mark = self.at, self._mark(), len(self._names)
        prefixes = self._prefixes(_ARGUMENT_PREFIXES)
        declares, is_redeclared = not prefixes.isdisjoint({"redeclare", "replaceable"}), "redeclare" in prefixes
        if self._accept("break"):
            if self._accept("connect"):
                self._expression()
                self._take_names(names_mark)
                self._note(self._since(start), start, mark)
                return None
            name = self._name()
            self._note(str(name), start, mark)
            return Modifier(name)
        if declares and self.word in _CLASS_STARTS:
            definition = self._class(names, prefixes)
            constraint = self._constraint(prefixes)
            self._note(str(definition.name), start, mark)
            return Modifier(definition.name, (), (), is_redeclared, definition.alias, constraint)
        new_type: Extends | None = None
        if declares:
            new_type = Extends(self._type()[1])
        if self.word == ".":
            raise self._lack("a name")
        at = self.at
        name = self._name()
        self._note("name", at)
        if str(name) not in _REPEATABLE:
            self._once(names, str(name), f"sets `{name}` twice")
        if declares:
            self._sizes()
        arguments = self._modification()
        uses = self._take_names(names_mark)
        self._description()
        if declares:
            self._annotation()
        constraint = self._constraint(prefixes)
        self._note(str(name), start, mark)
        return Modifier(name, arguments, uses, is_redeclared, new_type, constraint)

    # --- equations and statements ---------------------------------------------------------------------------------

    def _equation(self, seen: set[str] | None) -> None:
        """Read an equation; if `seen` is None, read a statement, which may be repeated."""
        start, mark, word = self.at, self._mark(), self.word
        if word == "annotation":
            self._annotation()
            return
        if self._accept(*_BLOCKS):
            self._block(word, repeats=seen is None)
            self._note("equation", start, mark)
        elif seen is None and self._accept("break", "return"):
            pass
        elif seen is not None and self._accept("connect"):
            self._connect(seen)
            self._note("connect", start, mark)
        else:
            sign = ":=" if seen is None else "="
            self._expression()
            if self.word == sign:
                self._note("left", start)
                self._step()
                self._expression()
            elif not (is_name(word) or word in _CALLED or word == ".") or self.words[self.at - 1] != ")":
                raise self._lack(f"`{sign}`")
            self._note("equation", start, mark)
            if seen is not None:
                text = self._since(start)
                self._once(seen, text, f"has the equation `{_short(text)}` twice")
        if not self._skips_rest():
            self._comment()

    def _connect(self, seen: set[str]) -> None:
        texts = list[str]()
        for mark in ("(", ","):
            self._expect(mark)
            start = self.at
            self._reference()
            texts.append(self._since(start))
            self._note("end", start)
        self._expect(")")
        first, second = sorted(texts)
        self._once(seen, f"connect {first} {second}", f"connects `{first}` and `{second}` twice")

    def _block(self, kind: str, *, repeats: bool) -> None:
        """Read the rest of an equation or statement with nested equations or statements, which may be repeated."""
        start, mark = self.at - 1, len(self._names)
        indices = set[str]()
        branch = kind
        while branch:
            if branch == "for":
                indices = self._indices()
            elif branch != "else":
                self._expression()
            if branch == kind:
                self._note("header", start)
            if branch != "else":
                self._expect("loop" if kind in ("for", "while") else "then")
            seen: set[str] | None = None if repeats else set()
            while self.word not in _BLOCK_ENDS:
                self._each(self._equation, seen)
            branch = self._accept(*_BRANCHES.get(kind, ())) if branch != "else" else ""
        if (self.word, self.following) != ("end", kind):
            raise self._lack(f"`end {kind}`")
        self.at += 2
        self._leave_out(indices, mark)


def _short(text: str) -> str:
    """Return a piece of a text as a quote."""
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"
