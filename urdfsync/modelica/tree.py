"""A class as a tree of the things that it consists of: elements, equations, modifiers. The tree keeps every byte.

Things have keys by which they are found in another version of the class: a component its name, a modifier its name, an
equation what it says. Blanks and comments stand between the things, so they are part of the tree, but of no thing.
"""

from __future__ import annotations

import itertools
import re
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Sequence
from enum import Enum
from functools import cached_property
from typing import TypeAlias

import msgspec

from urdfsync.modelica.lexer import Token, is_name, lex
from urdfsync.modelica.parser import (
    ARGUMENT_PREFIXES,
    CLASS_PREFIXES,
    CLASS_STARTS,
    CLASSES,
    ELEMENT_PREFIXES,
    SECTIONS,
    TYPE_PREFIXES,
    SyntaxParser,
    read,
)
from urdfsync.modelica.syntax import Name

LAYOUT = frozenset({"Placement", "Line", "Icon", "Diagram"})
"""Annotations that say where something stands in a diagram, and what it looks like."""

_REMARK = re.compile(r"[^\S\n]*(?://[^\n]*|/\*(?:(?!\*/)[^\n])*\*/)(?=\s*\n)")
"""A comment that ends a line."""

_INITIAL = "initial equation "
_PASSED = frozenset({"input", "output"})
_OPEN, _CLOSED = frozenset("([{"), frozenset(")]}")
_LONGEST_INTEGER = 20

_GEOMETRY = frozenset({"extent", "points", "origin", "rotation"})
"""Arguments that say where something is drawn."""
_TAIL = frozenset({"external", "annotation"})
"""What ends a class, behind all sections."""

Words: TypeAlias = tuple[str | float, ...]
"""What a text says: its tokens, numbers by their value, without blanks and comments. Integers stay integers."""


class TreeKind(Enum):
    """How the parts of a tree stand beside each other."""

    SLOTS = "slots"
    """Each has a role, such as `type`, and the order of roles is fixed; not every role is taken."""
    BODY = "body"
    """Elements and equations, and the words that begin sections."""
    LIST = "list"
    """Modifiers and annotations in parentheses, with commas between them."""
    ARRAY = "array"
    """Items in braces, of which the order counts."""
    SUM = "sum"
    """Terms with `+` between them."""


class Leaf(msgspec.Struct, frozen=True, eq=False, dict=True):
    """A text of which a change is no business of the parts in it: a number, a name, an expression, a statement."""

    text: str
    start: int
    """Its place in the whole text, from 0."""
    words: Words

    @property
    def meaning(self) -> object:
        """Equal for texts that say the same."""
        return self.words

    @property
    def bare(self) -> object:
        """Equal for texts that say the same, but for the layout of the diagram."""
        return self.words


class SyntaxTree(msgspec.Struct, frozen=True, eq=False, dict=True):
    """A thing that consists of others."""

    kind: TreeKind
    parts: tuple[Part, ...]
    start: int
    opening: str = ""
    closing: str = ""
    """Blanks and comments before the closing bracket, and the bracket."""
    is_function: bool = False
    """Whether it is the body of a function: the order of its inputs and outputs counts."""

    @property
    def separator(self) -> str:
        """What stands between two parts."""
        return {TreeKind.LIST: ",", TreeKind.ARRAY: ",", TreeKind.SUM: "+"}.get(self.kind, "")

    @cached_property
    def text(self) -> str:
        """The tree as it was read, every byte."""
        last = len(self.parts) - 1
        inner = (
            f"{part.before}{part.node.text}{part.after}{self.separator if number < last else ''}{part.remark}"
            for number, part in enumerate(self.parts)
        )
        return "".join((self.opening, *inner, self.closing))

    @cached_property
    def meaning(self) -> object:
        """Equal for trees that say the same in the same order."""
        return self.kind, tuple((part.key, part.node.meaning) for part in self.parts)

    @cached_property
    def bare(self) -> object:
        """Equal for trees that say the same, but for the order of declarations and the layout of the diagram."""
        said = [
            (part.key, section_name(self.sections[part.key]), part.node.bare)
            for part in self.parts
            if not (
                (self.kind is TreeKind.LIST and part.key in LAYOUT)
                or (part.key == "annotation" and is_empty(part.node))
                or is_section(part.key)
            )
        ]
        return self.kind, tuple(said if self.kind is TreeKind.ARRAY else sorted(said, key=lambda one: one[0]))

    @cached_property
    def sections(self) -> dict[str, str]:
        """The section of each part by its key: the key of its first word; empty before the first one, and for a list.

        What ends a class is in the section `tail`.
        """
        section, found = "", dict[str, str]()
        for part in self.parts:
            section = part.key if is_section(part.key) else section
            found[part.key] = section
        if self.kind is TreeKind.BODY:
            found |= dict.fromkeys(itertools.takewhile(_TAIL.__contains__, reversed(found)), "tail")
        return found

    @property
    def signature(self) -> list[str]:
        """The keys of the inputs and outputs of a function, in order."""
        return [part.key for part in self.parts if self.is_function and not _PASSED.isdisjoint(_type_words(part))]

    def find(self, key: str) -> Part | None:
        """The part with this key."""
        return self._by_key.get(key)

    @cached_property
    def _by_key(self) -> dict[str, Part]:
        return {part.key: part for part in self.parts}

    @cached_property
    def has_duplicate_keys(self) -> bool:
        """Whether two things in it can't be told apart."""
        return len(self._by_key) < len(self.parts) or any(
            isinstance(part.node, SyntaxTree) and part.node.has_duplicate_keys for part in self.parts
        )


Node: TypeAlias = Leaf | SyntaxTree


class Part(msgspec.Struct, frozen=True, eq=False):
    """A thing at its place among others."""

    key: str
    before: str
    """Blanks and comments before it."""
    node: Node
    after: str = ""
    """Blanks and comments between it and the separator."""
    remark: str = ""
    """A comment behind it, and behind the separator if there is one, that ends the line."""


def is_section(key: str) -> bool:
    """Whether a part of a body is the word that begins a section."""
    return key.startswith("section ")


def section_name(section: str) -> str:
    """Return the name of a section without its number; what stands before the first one is public."""
    return section.rpartition(" ")[0] or section or "section public"


def is_empty(node: Node) -> bool:
    """Whether nothing is in an annotation but layout."""
    return isinstance(node, SyntaxTree) and all(part.key in LAYOUT for part in node.parts)


def comments(text: str) -> list[str]:
    """Return the comments of a text."""
    tokens, _ = lex(text)
    places = [0, *(end for token in tokens for end in (token.start, token.start + len(token.text)))]
    gaps = (text[start:stop] for start, stop in zip(places[::2], places[1::2], strict=False))
    return [found for gap in gaps for found in re.findall(r"//[^\n\r]*|/\*.*?\*/", gap, re.DOTALL)]


def read_tree(text: str) -> SyntaxTree | None:
    """Read a text that is one class; None if it is no Modelica, several classes, or has things with the same name."""
    reader = _TreeReader(text)
    stored = read(reader)
    if stored.faults or len(stored.classes) != 1:
        return None
    reader.at = 0  # again, with the same tokens
    found = reader.file()
    return None if found.has_duplicate_keys else found


def key_by_whole_equation(*trees: SyntaxTree) -> tuple[SyntaxTree, ...]:
    """Name equations by all that they say, in all versions of a body, if one of them has several for one variable."""
    counts = [Counter(_variable(part) for part in tree.parts) for tree in trees]
    several = {name for names in counts for name, count in names.items() if name and count > 1}
    return tuple(
        msgspec.structs.replace(tree, parts=tuple(_keyed(tree.parts, several))) if several else tree for tree in trees
    )


def _variable(part: Part) -> str:
    """What names an equation if it is the only one for its variable; empty for anything else."""
    is_equation = isinstance(part.node, SyntaxTree) and part.node.find("equation")
    return part.key.partition(" = ")[0] if is_equation else ""


def _keyed(parts: Sequence[Part], variables: Collection[str]) -> Iterator[Part]:
    for part in parts:
        if (
            _variable(part) in variables
            and isinstance(part.node, SyntaxTree)
            and isinstance(part.node.parts[0].node, Leaf)
        ):
            kind = _INITIAL if part.key.startswith(_INITIAL) else ""
            part = msgspec.structs.replace(part, key=f"{kind}equation {_said(part.node.parts[0].node.words)}")
        yield part


def as_sum(node: Node) -> Node:
    """Make a sum with one term of an expression that is nothing but a name; return others as they are."""
    if not isinstance(node, Leaf) or any(
        not isinstance(word, str) or not (is_name(word) or word == ".") for word in node.words
    ):
        return node
    return SyntaxTree(TreeKind.SUM, _numbered([Part("", "", node)]), node.start)


def words_of(text: str) -> Words:
    """What a text says."""
    tokens, _ = lex(text)
    return _words(tokens[:-1])


def _words(tokens: Sequence[Token]) -> Words:
    return tuple(
        _number(token.text) if token.text[0].isdecimal() else token.text.replace("\r\n", "\n") for token in tokens
    )


def _number(text: str) -> float:
    """The value of a number; a whole one without a point stays an Integer, unless no tool could read it."""
    return int(text) if text.isdecimal() and len(text) < _LONGEST_INTEGER else float(text)


def _said(words: Words) -> str:
    return " ".join(word if isinstance(word, str) else str(float(word)) for word in words)


def _type_words(part: Part) -> Words:
    """The prefixes and the type of a component, or of several; empty for anything else."""
    if not (isinstance(part.node, SyntaxTree) and part.key.startswith("component ")):
        return ()
    found = part.node.find("type") or part.node.find("components")
    return found.node.words if found and isinstance(found.node, Leaf) else ()


def _drawn(words: Words) -> Words:
    """What an item of an array says, but for where it is drawn."""
    found, depth, is_place = list[str | float](), 0, False
    for number, word in enumerate(words):
        depth += (word in _OPEN) - (word in _CLOSED)
        if depth <= 1 and (word == "," or word in _CLOSED):
            is_place = False
        elif depth == 1 and word in _GEOMETRY and words[number + 1] == "=":
            is_place = True
        found += [] if is_place else [word]
    return tuple(found)


def _numbered(parts: Sequence[Part]) -> tuple[Part, ...]:
    """Items or terms with what they say as keys, but for where they are drawn; one may be there twice."""
    seen = Counter[str]()
    found = []
    for part in parts:
        said = _said(_drawn(part.node.words) if isinstance(part.node, Leaf) else ())
        seen[said] += 1
        found.append(msgspec.structs.replace(part, key=f"{said} #{seen[said]}"))
    return tuple(found)


class _TreeReader(SyntaxParser):
    """Makes the tree of a text that the parser found right: it says how far each thing goes."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._text = text
        self._end = 0
        """Where the text ends that is in the tree."""

    # --- parts ----------------------------------------------------------------------------------------------------

    def _take(self) -> str:
        """Go beyond one token, and return it."""
        token = self.tokens[self.at]
        self._step()
        self._end = token.start + len(token.text)
        return token.text

    def _blanks(self) -> str:
        """What stands before the token that comes now."""
        return self._text[self._end : self.tokens[self.at].start]

    def _leaf(self, key: str, start: int) -> Part:
        """The tokens from the one with the number `start` up to here."""
        tokens = self.tokens[start : self.at]
        before, first, last = self._text[self._end : tokens[0].start], tokens[0].start, tokens[-1]
        self._end = last.start + len(last.text)
        return Part(key, before, Leaf(self._text[first : self._end], first, _words(tokens)))

    def _slot(self, key: str, read: Callable[[], object]) -> list[Part]:
        """What a method of the parser reads, as a leaf; nothing if there is nothing."""
        start = self.at
        read()
        return [self._leaf(key, start)] if self.at > start else []

    def _separated(self, part: Part, separator: str) -> Part:
        """A thing with the separator and the comment behind it, if they are there."""
        after = ""
        if self.word == separator:
            after = self._blanks()
            self._take()
        return msgspec.structs.replace(part, after=after, remark=self._remark())

    def _remark(self) -> str:
        found = _REMARK.match(self._text, self._end)
        remark = found[0].rstrip("\r") if found else ""
        self._end += len(remark)
        return remark

    def _slots(self, key: str, parts: Sequence[Part]) -> Part:
        """A thing with the roles that were read; what stands before the first stands before the thing."""
        first, *rest = parts
        inner = msgspec.structs.replace(first, before="")
        return Part(key, first.before, SyntaxTree(TreeKind.SLOTS, (inner, *rest), first.node.start))

    def _items(self, key: str, kind: TreeKind, read: Callable[[], Part]) -> Part:
        """A list in brackets; `annotation` stands before its bracket."""
        first, start, before = self.at, self.tokens[self.at].start, self._blanks()
        end = self._end
        while self._take() not in ("(", "{"):
            pass
        opening = self._text[start : self._end]
        parts: list[Part] = []
        while self.word not in (")", "}"):
            parts.append(self._separated(read(), ","))
        closing = self._blanks() + self._take()
        if kind is TreeKind.LIST and len({part.key for part in parts}) < len(parts):  # such as `choice`
            self._end = end
            return self._leaf(key, first)
        items = _numbered(parts) if kind is TreeKind.ARRAY else tuple(parts)
        return Part(key, before, SyntaxTree(kind, items, start, opening, closing))

    # --- expressions ----------------------------------------------------------------------------------------------

    def _value(self) -> list[Part]:
        if self.word not in ("=", ":="):
            return []
        sign = self._slot("sign", self._step)
        return [self._slots("value", [*sign, self._whole_expression("expression")])]

    def _whole_expression(self, key: str) -> Part:
        """An expression: a sum or an array of things that have names, or a leaf."""
        start = self.at
        if self._accept("break"):
            return self._leaf(key, start)
        self._expression()
        stop, self.at = self.at, start
        depth, operators, items = 0, set[str](), [start]
        for number, token in enumerate(self.tokens[start:stop], start=start):
            depth += (token.text in ("(", "[", "{")) - (token.text in (")", "]", "}"))
            if token.text == "," and depth == 1:
                items.append(number + 1)
            elif token.text == "for" and depth == 1:
                operators.add("for")
            elif depth == 0 and not (is_name(token.text) or token.text in (".", ")", "]", "}")):
                operators.add(token.text)
        if operators == {"+"} and self.word != "+":
            return self._sum(key, stop)
        if self.word == "{" and not operators and all(map(self._begins_with_name, items)):
            return self._items(key, TreeKind.ARRAY, self._array_item)
        self.at = stop
        return self._leaf(key, start)

    def _begins_with_name(self, number: int) -> bool:
        return is_name(self.tokens[number].text) or (
            self.tokens[number].text == "{" and is_name(self.tokens[number + 1].text)
        )

    def _array_item(self) -> Part:
        start = self.at
        self._expression()
        return self._leaf("", start)

    def _sum(self, key: str, stop: int) -> Part:
        place, before, parts = self.tokens[self.at].start, self._blanks(), list[Part]()
        self._end = place
        while self.at < stop:
            start, depth = self.at, 0
            while self.at < stop and (depth or self.word != "+"):
                depth += (self.word in ("(", "[", "{")) - (self.word in (")", "]", "}"))
                self._step()
            part = self._leaf("", start)
            parts.append(self._separated(part, "+") if self.at < stop else part)
        return Part(key, before, SyntaxTree(TreeKind.SUM, _numbered(parts), place))

    # --- modifiers ------------------------------------------------------------------------------------------------

    def _modifiers(self) -> list[Part]:
        return [self._items("arguments", TreeKind.LIST, self._modifier)] if self.word == "(" else []

    def _note(self) -> list[Part]:
        """A description, an annotation, both or none."""
        found = self._slot("description", self._description)
        return (
            [*found, self._items("annotation", TreeKind.LIST, self._modifier)] if self.word == "annotation" else found
        )

    def _modifier(self) -> Part:
        start, end = self.at, self._end
        parts = self._slot("prefixes", lambda: self._prefixes(ARGUMENT_PREFIXES))
        declares = not {token.text for token in self.tokens[start : self.at]}.isdisjoint({"redeclare", "replaceable"})
        if self.word == "break" or (declares and self.word in CLASS_STARTS):
            self.at, self._end = start, end
            found = self._argument(set())
            return self._leaf(str(found.name) if found else _said(_words(self.tokens[start : self.at])), start)
        if declares:
            parts += self._slot("type", self._kind)
        name = Name((), 0)

        def read_name() -> None:
            nonlocal name
            name = self._name()

        parts += self._slot("name", read_name)
        if declares:
            parts += self._slot("sizes", self._subscripts)
        parts += [*self._modifiers(), *self._value(), *self._note(), *self._limits()]
        return self._slots(str(name), parts)

    def _kind(self) -> None:
        """Prefixes of a type, and the type."""
        self._prefixes(TYPE_PREFIXES)
        self._name()
        self._subscripts()

    def _limits(self) -> list[Part]:
        """A class after `constrainedby`, and the notes behind it."""
        if self.word != "constrainedby":
            return []
        word = self._slot("word", self._step)
        return [self._slots("constraint", [*word, *self._slot("type", self._name), *self._modifiers()]), *self._note()]

    # --- classes --------------------------------------------------------------------------------------------------

    def file(self) -> SyntaxTree:
        """The whole text."""
        parts: list[Part] = []
        if self.word == "within":
            parts += self._slot("within", lambda: self._each(self._within))
        prefixes = self._slot("prefixes", lambda: self._accept("final"))
        parts += [*prefixes, *self._class_parts(), *self._slot(";", self._step)]
        return SyntaxTree(TreeKind.SLOTS, tuple(parts), 0, "", self._text[self._end :])

    def _class_parts(self) -> list[Part]:
        start = self.at
        self._prefixes(CLASS_PREFIXES)
        kind = self._accept(*CLASSES)
        if kind == "operator":
            kind = self._accept("record", "function")
        is_extension = bool(self._accept("extends"))
        self.name = self._identifier()
        if not is_extension and self._accept("="):
            return [self._leaf("head", start), *self._short_parts()]
        head = [self._leaf("head", start), *(self._modifiers() if is_extension else ())]
        head += self._slot("description", self._description)
        name, body = self.name, self._body(is_function=kind == "function")
        end = self.at
        self._step()
        self._step()
        self.name = name
        return [*head, body, self._leaf("end", end)]

    def _short_parts(self) -> list[Part]:
        """What stands behind the equals sign of a short class."""
        if self.word not in ("enumeration", "der"):
            return [*self._slot("type", self._kind), *self._modifiers(), *self._note()]
        start = self.at
        self._step()
        depth = 1
        self._step()
        while depth:
            depth += (self.word == "(") - (self.word == ")")
            self._step()
        return [self._leaf("definition", start), *self._note()]

    def _body(self, *, is_function: bool) -> Part:
        place, section, count = self._end, "public", Counter[str]()
        parts: list[Part] = []
        while self.word not in ("end", ""):
            if self._begins_section():
                start = self.at
                self._accept("initial")
                self._step()
                section = _said(_words(self.tokens[start : self.at]))
                count[section] += 1
                part = self._leaf(f"section {section} {count[section]}", start)
            elif self.word == "annotation":
                part = self._slots("annotation", [*self._note(), *self._slot(";", self._step)])
            elif section in ("public", "protected") or self.word == "external":
                part = self._declaration()
            elif section.endswith("algorithm"):
                start = self.at
                while self.word not in ("end", "", "annotation") and not self._begins_section():
                    self._each(self._equation, None)
                part = self._leaf(f"statements of {section} {count[section]}", start)
            else:
                part = self._equation_part(section)
            parts.append(msgspec.structs.replace(part, remark=self._remark()))
        (tree,) = key_by_whole_equation(SyntaxTree(TreeKind.BODY, tuple(parts), place, is_function=is_function))
        return Part("body", "", tree)

    def _begins_section(self) -> bool:
        return self.word in SECTIONS or (self.word == "initial" and self.following in ("equation", "algorithm"))

    def _declaration(self) -> Part:
        start = self.at
        if self._accept("import"):
            alias = f"import {self.word}" if self.following == "=" else ""
            self._import()
            key, parts = alias or _said(_words(self.tokens[start : self.at])), [self._leaf("import", start)]
        elif self._accept("external"):
            self._external()
            key, parts = "external", [self._leaf("external", start)]
        elif self._accept("extends"):
            parts = [self._leaf("word", start), *self._slot("type", self._name)]
            key = f"extends {''.join(map(str, _words(self.tokens[start + 1 : self.at])))}"
            parts += [*self._modifiers(), *self._note()]
        else:
            parts = self._slot("prefixes", lambda: self._prefixes(ELEMENT_PREFIXES))
            if self.word in CLASS_STARTS:
                parts += [*self._class_parts(), *self._limits()]
                key = f"class {self.name}"
            else:
                key, more = self._component()
                parts += more
        return self._slots(key, [*parts, *self._slot(";", self._step)])

    def _component(self) -> tuple[str, list[Part]]:
        start, end = self.at, self._end
        parts = self._slot("type", self._kind)
        name = self.word
        parts += [*self._slot("name", self._step), *self._slot("sizes", self._subscripts)]
        parts += [*self._modifiers(), *self._value()]
        if self.word == "if":
            parts += self._slot("condition", lambda: (self._step(), self._expression()))
        parts += self._note()
        if self.word == ",":  # several components of one declaration stand or fall together
            self.at, self._end = start, end
            found = self._components(set(), set())
            return f"component {', '.join(str(one.name) for one in found)}", [self._leaf("components", start)]
        return f"component {name}", [*parts, *self._limits()]

    def _equation_part(self, section: str) -> Part:
        start, word = self.at, self.word
        kind = "" if section == "equation" else f"{section} "
        if word == "connect":
            self._step()
            self._connect(set())
            leaf = self._leaf("connect", start)
            ends = sorted(_connected(self.tokens[start : self.at]))
            key = f"connect {' '.join(ends)}"
            node = Leaf(leaf.node.text, leaf.node.start, tuple(ends))
            parts = [msgspec.structs.replace(leaf, node=node)]
        elif word in ("if", "when", "for"):
            self._equation(set())
            header = next(number for number in range(start, self.at) if self.tokens[number].text in ("then", "loop"))
            key, parts = _said(_words(self.tokens[start:header])), [self._leaf("equation", start)]
        else:
            self._expression()
            left = self.tokens[start : self.at]
            if self._accept("="):
                self._expression()
            # an equation is named by a variable that stands alone on its left side
            is_alone = all(is_name(one.text) or one.text[0] in ".()[]" or one.text == "der" for one in left)
            named = left if is_alone and self.at > start + len(left) else self.tokens[start : self.at]
            key, parts = f"equation {_said(_words(named))}", [self._leaf("equation", start)]
        return self._slots(f"{kind}{key}", [*parts, *self._note(), *self._slot(";", self._step)])


def _connected(tokens: Sequence[Token]) -> Iterator[str]:
    """The two connectors of a `connect(a, b)`."""
    depth, said = 0, ""
    for token in tokens[2:-1]:
        depth += (token.text == "[") - (token.text == "]")
        if token.text == "," and not depth:
            yield said
            said = ""
        else:
            said += token.text
    yield said
