"""A class as a tree of nodes: elements, equations, modifiers. The tree keeps every byte.

A node's key is the same in all versions of the class: a component's or modifier's name, or an equation's words.
Blanks and comments stand between nodes, and belong to no node. At first, only the name of an element or equation is
read; the children of most are never needed.
"""

from __future__ import annotations

import itertools
import re
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from enum import Enum
from functools import cached_property
from typing import NamedTuple, TypeAlias

import msgspec

from urdfsync.modelica.lexer import STATEMENT, Fault, is_name, is_number, lex, words_in
from urdfsync.modelica.parser import SECTIONS, Parser

LAYOUT = frozenset({"Placement", "Line", "Icon", "Diagram"})
"""Annotations about places and graphics in a diagram."""

_REMARK = re.compile(r"[^\S\n]*+(?://[^\n]*+|/\*(?:(?!\*/)[^\n])*\*/)(?=\s*\n)")
"""A comment that ends a line."""

INITIAL = "initial equation "
"""The beginning of the key of an initial equation."""
_EQUATION = re.compile(rf"(?:{INITIAL})?(?:equation|if|for|when) ")
"""The beginning of the key of an equation; connections have other keys."""
_PASSED = frozenset({"input", "output"})
_OPEN, _CLOSED = frozenset("([{"), frozenset(")]}")
_PUNCTUATION = _OPEN | _CLOSED | {",", ";"}
_BEFORE_SIGN = _OPEN | {",", ";", "="}
_LONGEST_INTEGER = 20

_GEOMETRY = frozenset({"extent", "points", "origin", "rotation"})
"""Arguments that contain places of graphics."""
_TAIL = frozenset({"external", "annotation"})
"""Keys of the children at the end of a class, after all sections."""

Words: TypeAlias = tuple[str | float, ...]
"""The tokens of a text without blanks and comments; numbers are values. Integers stay integers."""


class UnreadableError(Exception):
    """An element or equation has a syntax error, or two children of one name."""


class TreeKind(Enum):
    """The arrangement of a tree's children."""

    SLOTS = "slots"
    """Children with roles, such as `type`, in a fixed order; children may be missing."""
    BODY = "body"
    """Elements and equations, and the words that begin sections."""
    LIST = "list"
    """Modifiers and annotations in parentheses, with commas between them."""
    ARRAY = "array"
    """Items in braces; their order counts."""
    SUM = "sum"
    """Terms with `+` between them."""


_SEPARATORS = {TreeKind.LIST: ",", TreeKind.ARRAY: ",", TreeKind.SUM: "+"}


class Leaf:
    """A text that changes as a whole: a number, a name, an expression, a statement."""

    def __init__(self, text: str, words: Words | None = None) -> None:
        self.text = text
        self._words = words

    @cached_property
    def words(self) -> Words:
        """The words of the text; a connection has only its two ends, in alphabetical order."""
        return words_of(self.text) if self._words is None else self._words


class SyntaxTree:
    """A node with children."""

    def __init__(
        self,
        kind: TreeKind,
        children: Sequence[Child],
        opening: str = "",
        closing: str = "",
        *,
        is_function: bool = False,
    ) -> None:
        """`closing` has the closing bracket with the blanks and comments before it.

        `is_function` marks the body of a function: the order of its inputs and outputs counts.
        """
        self.kind, self.opening, self.closing, self.is_function = kind, opening, closing, is_function
        self._children = children

    @property
    def children(self) -> Sequence[Child]:
        """The children in the order of the text. Raises UnreadableError."""
        return self._children

    def with_children(self, children: Sequence[Child]) -> SyntaxTree:
        """Return the same tree with other children."""
        return SyntaxTree(self.kind, children, self.opening, self.closing, is_function=self.is_function)

    @property
    def separator(self) -> str:
        """The sign between two children."""
        return _SEPARATORS.get(self.kind, "")

    @cached_property
    def text(self) -> str:
        """The text of the tree, byte for byte."""
        separators = [*(len(self.children) - 1) * [self.separator], ""]
        inner = (
            f"{child.before}{child.node.text}{child.after}{separator}{child.remark}"
            for child, separator in zip(self.children, separators, strict=False)
        )
        return "".join((self.opening, *inner, self.closing))

    @cached_property
    def sections(self) -> dict[str, str]:
        """The key of each child's section, by the child's key; empty before the first section, and in a list.

        The children at the end of a class are in the section `tail`.
        """
        section, sections = "", dict[str, str]()
        for child in self.children:
            section = child.key if is_section(child.key) else section
            sections[child.key] = section
        if self.kind is TreeKind.BODY:
            sections |= dict.fromkeys(itertools.takewhile(_TAIL.__contains__, reversed(sections)), "tail")
        return sections

    @property
    def signature(self) -> list[str]:
        """The keys of the inputs and outputs of a function, in order."""
        return [child.key for child in self.children if self.is_function and not _PASSED.isdisjoint(_type_words(child))]

    def find(self, key: str) -> Child | None:
        """Return the child with this key."""
        return self._by_key.get(key)

    @cached_property
    def _by_key(self) -> dict[str, Child]:
        return {child.key: child for child in self.children}

    def says(self, *, layout: bool) -> list[tuple[str, str, Node]]:
        """Return the children with their keys; without `layout`, sorted, and without layout and section words."""
        if layout:
            return [(child.key, "", child.node) for child in self.children]
        children = [
            (child.key, section_name(self.sections[child.key]), child.node)
            for child in self.children
            if not (
                (self.kind is TreeKind.LIST and child.key in LAYOUT)
                or (child.key == "annotation" and is_empty(child.node))
                or is_section(child.key)
            )
        ]
        return children if self.kind is TreeKind.ARRAY else sorted(children, key=lambda child: child[:2])


class Statement(SyntaxTree):
    """An element or equation with its semicolon; its children are read when they are needed."""

    def __init__(self, text: str, *, is_equation: bool) -> None:
        super().__init__(TreeKind.SLOTS, ())
        self.text = text
        self._is_equation = is_equation

    @cached_property
    def children(self) -> Sequence[Child]:
        """The children in the order of the text. Raises UnreadableError."""
        return _TreeReader(self.text, {}).statement(is_equation=self._is_equation)


Node: TypeAlias = Leaf | SyntaxTree


class Child(msgspec.Struct, frozen=True, eq=False):
    """A node at its place in a tree."""

    key: str
    before: str
    """Blanks and comments before the node."""
    node: Node
    after: str = ""
    """Blanks and comments between the node and the separator."""
    remark: str = ""
    """A comment at the end of the node's line, after the separator if there is one."""


def is_same(node: Node, other: Node, *, layout: bool = True) -> bool:
    """Whether two nodes have the same meaning; without `layout`, layout and order do not count."""
    if node is other or node.text == other.text:
        return True
    if isinstance(node, Leaf) or isinstance(other, Leaf):
        return isinstance(node, Leaf) and isinstance(other, Leaf) and node.words == other.words
    children, other_children = node.says(layout=layout), other.says(layout=layout)
    return (
        node.kind is other.kind
        and [child[:2] for child in children] == [child[:2] for child in other_children]
        and all(
            is_same(child[2], other_child[2], layout=layout)
            for child, other_child in zip(children, other_children, strict=True)
        )
    )


def is_section(key: str) -> bool:
    """Whether a child of a body is the first word of a section."""
    return key.startswith("section ")


def is_equation(child: Child) -> bool:
    """Whether a child of a body is an equation, but no connection."""
    return _EQUATION.match(child.key) is not None


def section_name(section: str) -> str:
    """Return the name of a section without its number; children before the first section are public."""
    return section.rpartition(" ")[0] or section or "section public"


def is_empty(node: Node) -> bool:
    """Whether an annotation contains only layout."""
    return isinstance(node, SyntaxTree) and all(child.key in LAYOUT for child in node.children)


def comments(text: str) -> list[str]:
    """Return the comments of a text."""
    if "//" not in text and "/*" not in text:
        return []
    tokens, _ = lex(text)
    places = [0, *(end for token in tokens for end in (token.start, token.start + len(token.text)))]
    gaps = (text[start:stop] for start, stop in zip(places[::2], places[1::2], strict=False))
    return [comment for gap in gaps for comment in re.findall(r"//[^\n\r]*+|/\*.*?(?:\*/|\Z)", gap, re.DOTALL)]


def key_by_whole_equation(*trees: SyntaxTree) -> tuple[SyntaxTree, ...]:
    """Key equations for a variable by all their words, in all versions, if one version has several of them."""
    counts = [Counter(_variable(child) for child in tree.children) for tree in trees]
    several = {name for names in counts for name, count in names.items() if name and count > 1}
    return tuple(tree.with_children(list(_keyed(tree.children, several))) if several else tree for tree in trees)


def _variable(child: Child) -> str:
    """Return the variable that can be the key of an equation; empty if there is none."""
    return child.key.partition(" = ")[0] if is_equation(child) else ""


def _keyed(children: Sequence[Child], variables: Collection[str]) -> Iterator[Child]:
    for child in children:
        if _variable(child) in variables and isinstance(child.node, SyntaxTree):
            kind = INITIAL if child.key.startswith(INITIAL) else ""
            words = _said(words_of(child.node.children[0].node.text))
            child = msgspec.structs.replace(child, key=f"{kind}equation {words}")
        yield child


def as_sum(node: Node) -> Node:
    """Turn an expression of only a name into a sum with one term; return any other expression unchanged."""
    if not isinstance(node, Leaf) or any(
        not isinstance(word, str) or not (is_name(word) or word == ".") for word in node.words
    ):
        return node
    return SyntaxTree(TreeKind.SUM, _numbered([Child("", "", node)]))


def words_of(text: str) -> Words:
    """Return the words of a text."""
    return _words(words_in(text))


def _words(tokens: Sequence[str]) -> Words:
    """Return words with numbers as values; a zero has no sign, as in generated texts."""
    words = [_number(token) if is_number(token) else token.replace("\r\n", "\n") for token in tokens]
    pairs = zip(["(", *words], words, [*words[1:], ""], strict=False)
    is_sign = [word in ("-", "+") and number == 0 and before in _BEFORE_SIGN for before, word, number in pairs]
    return tuple(word for word, leave_out in zip(words, is_sign, strict=True) if not leave_out)


def _number(text: str) -> float:
    """Return the value of a number; without a point it is an Integer, unless it is too long for tools."""
    return int(text) if text.isdecimal() and len(text) < _LONGEST_INTEGER else float(text)


def _said(words: Words) -> str:
    return " ".join(word if isinstance(word, str) else str(float(word)) for word in words)


def _type_words(child: Child) -> Words:
    """Return the prefixes and the type in a declaration of components; empty for anything else."""
    if not (isinstance(child.node, SyntaxTree) and child.key.startswith("component ")):
        return ()
    type_child = child.node.find("type") or child.node.find("components")
    return type_child.node.words if type_child and isinstance(type_child.node, Leaf) else ()


def _drawn(words: Words) -> Words:
    """Return the words of an array's item, without its place in the diagram."""
    drawn, depth, is_place = list[str | float](), 0, False
    for number, word in enumerate(words):
        depth += (word in _OPEN) - (word in _CLOSED)
        if depth <= 1 and (word == "," or word in _CLOSED):
            is_place = False
        elif depth == 1 and word in _GEOMETRY and words[number + 1] == "=":
            is_place = True
        drawn += [] if is_place else [word]
    return tuple(drawn)


def _numbered(children: Sequence[Child]) -> list[Child]:
    """Return items or terms with their words, except places in the diagram, as keys; equal keys get a number."""
    seen = Counter[str]()
    numbered = []
    for child in children:
        words = _said(_drawn(words_of(child.node.text)))
        seen[words] += 1
        numbered.append(msgspec.structs.replace(child, key=f"{words} #{seen[words]}"))
    return numbered


class Span(NamedTuple):
    """A piece of a text: the tokens from number `start` up to the token before `stop`."""

    key: str
    """The child's role in the node around it, such as `type`, or the name of a modifier."""
    start: int
    stop: int
    inner: Sequence[Span] = ()
    body: SyntaxTree | None = None
    """The elements and equations in the body of a class."""


class KnownStatement(NamedTuple):
    """An element or equation that an earlier text contained, too."""

    child: Child
    names: Sequence[tuple[str, str]]
    """Names that the statement takes, each with the fault for a second statement with this name."""


KnownStatements: TypeAlias = dict[tuple[str, str], KnownStatement]
"""Elements and equations that were read before, by section and by text, with blanks before."""


def read_tree(text: str, statements: KnownStatements | None = None) -> SyntaxTree | None:
    """Read a text of one class; None for a syntax error, several classes, or two nodes of one name.

    Known `statements` are not read again, and new ones are added.
    """
    return _TreeReader(text, {} if statements is None else statements).file()


def find_faults(text: str, statements: KnownStatements) -> Sequence[Fault]:
    """Return the faults of a text, without faults inside of known elements and equations."""
    return _TreeReader(text, statements, reads_all=True).read().faults


class _OpenBody:
    """The body of a class while it is read."""

    def __init__(self, mark: int, end: int, *, skips: bool) -> None:
        self.skips = skips
        """Whether to read only the names of elements and equations."""
        self.mark = mark
        """The number of spans before the present element or equation."""
        self.end = end
        """The place in the text up to which `children` reaches."""
        self.children: list[Child] = []
        self.section = ""
        """The first words of the present section, such as `initial equation`."""
        self.sections = Counter[str]()
        self.names: list[tuple[str, str]] = []
        """Names that the present element or equation takes, each with the fault for a repetition."""

    def add(self, child: Child, text: str, stop: int) -> None:
        """Add a child that ends at this place in the text, and the comment after the child."""
        remark = _remark_at(text, stop)
        self.children.append(msgspec.structs.replace(child, remark=remark) if remark else child)
        self.end = stop + len(remark)


class _TreeReader(Parser):
    """Makes the tree while parsing: the hooks of the parser note the extent of each child."""

    def __init__(self, text: str, statements: KnownStatements, *, reads_all: bool = False) -> None:
        super().__init__(text)
        self._statements, self._reads_all = statements, reads_all
        self._spans: list[Span] = []
        self._body = _OpenBody(0, 0, skips=False)
        """The body of the innermost class around the present place."""
        self._end = 0
        """The place in the text up to which the tree reaches."""

    def file(self) -> SyntaxTree | None:
        """Read the whole text; None unless it is one class that can be merged."""
        try:
            stored = self.read()
            if stored.faults or len(stored.classes) != 1:
                return None
            children = self._slots(self._spans).children
            return SyntaxTree(TreeKind.SLOTS, children, closing=self.text[self._end :])
        except UnreadableError:
            return None

    def statement(self, *, is_equation: bool) -> Sequence[Child]:
        """Read one element or equation. Raises UnreadableError."""
        self._each(self._equation if is_equation else self._element, set())
        if self.faults or self.endless or self.word:
            raise UnreadableError
        return self._slots(self._spans).children

    # --- hooks of the parser --------------------------------------------------------------------------------------

    def _mark(self) -> int:
        return len(self._spans)

    def _note(self, key: str, start: int, mark: int | None = None) -> None:
        inner = () if mark is None else tuple(self._spans[mark:])
        if inner:
            del self._spans[mark:]
        if self.at > start:
            self._spans.append(Span(key, start, self.at, inner))

    def _composition(self) -> None:
        around, mark = self._body, self._mark()
        self._body = _OpenBody(mark, self._stop(self.at), skips=not self._reads_all)
        super()._composition()
        if not self._reads_all and not self.faults:
            is_function = self.open[-1].kind.endswith("function")
            (tree,) = key_by_whole_equation(SyntaxTree(TreeKind.BODY, self._body.children, is_function=is_function))
            self._spans.append(Span("body", self.at, self.at, (), _with_unique_keys(tree)))
        self._body = around

    def _next_word(self) -> str:
        body = self._body
        while self.at == len(self.words) and not body.section.endswith("algorithm"):
            match = STATEMENT.match(self.text, body.end)
            statement = match and self._statements.get((body.section, match[0]))
            if not match or not statement:
                break
            for key, reason in statement.names:
                if key in self._seen:
                    line = self.line_at(body.end + len(statement.child.before))
                    self.faults.append(Fault(reason, line, is_repetition=True))
                self._seen.add(key)
            body.add(statement.child, self.text, match.end())
            self.position = body.end
            if statement.child.key == "annotation":
                self._expect_end()
        body.names = []
        return self.word

    def _once(self, seen: set[str], key: str, reason: str) -> None:
        if seen is self._seen:
            self._body.names.append((key, reason))
        super()._once(seen, key, reason)

    def _skips_rest(self) -> bool:
        if not self._body.skips:
            return False
        depth, words = 0, self.words
        for at in range(self.at, len(words)):
            word = words[at]
            if word not in _PUNCTUATION:
                continue
            if word == ";":  # in brackets, a semicolon ends a row of a matrix
                self.at = at if not depth else self.at
                return not depth
            if word == "," and not depth:  # several components in one declaration
                return False
            depth += (word in _OPEN) - (word in _CLOSED)
        return False

    def _note_statement(self, start: int) -> None:
        body, words, text = self._body, self.words[start : self.at], self.text
        first, stop = self.starts[start], self._stop(self.at)
        before, own_text = text[body.end : first], text[first:stop]
        if words[-1] in SECTIONS:
            body.section = " ".join(words)
            body.sections[body.section] += 1
            child = Child(f"section {body.section} {body.sections[body.section]}", before, Leaf(own_text))
        elif body.section.endswith("algorithm") and words[0] not in _TAIL:
            previous = body.children.pop()
            if is_section(previous.key):
                body.children.append(previous)
                child = Child(f"statements of {previous.key.partition(' ')[2]}", before, Leaf(own_text))
            else:  # all statements of an algorithm section are one child
                own_text = f"{previous.node.text}{previous.remark}{before}{own_text}"
                child = Child(previous.key, previous.before, Leaf(own_text))
        elif self.faults or not body.skips:
            child = Child("", before, Leaf(own_text))
        else:
            node = Statement(own_text, is_equation=body.section.endswith("equation") and words[0] not in _TAIL)
            child = Child(self._key(self._spans[body.mark :]), before, node)
            if words.index(";") == len(words) - 1:
                self._statements[body.section, before + own_text] = KnownStatement(child, body.names)
        del self._spans[body.mark :]
        body.add(child, text, stop)

    def _key(self, spans: Sequence[Span]) -> str:
        """Return the key of an element or equation; it is the same in other versions of the class."""
        first = next(span for span in spans if span.key not in ("prefixes", "type"))
        inner = self.words[first.start : first.stop]
        if first.key == "import":
            return f"import {inner[1]}" if "=" in inner[2:3] else _said(_words(inner))
        if first.key == "word":
            return f"extends {''.join(self.words[spans[1].start : spans[1].stop])}"
        if first.key == "head":
            return f"class {inner[-2] if inner[-1] == '=' else inner[-1]}"
        if first.key in ("name", "components"):
            names = [self.words[span.start] for span in first.inner or spans if span.key == "name"]
            return f"component {', '.join(names)}"
        if first.key == "connect":
            return f"connect {' '.join(self._ends(first))}"
        if first.key != "equation":
            return first.key
        kind = INITIAL if self._body.section == INITIAL.strip() else ""
        ends = [span for span in first.inner if span.key in ("header", "left")]
        if ends and ends[0].key == "header":
            return f"{kind}{_said(_words(self.words[ends[0].start : ends[0].stop]))}"
        # a single variable on the left side is the key of the equation
        variable = self.words[ends[0].start : ends[0].stop] if ends else []
        is_alone = all(is_name(word) or word[0] in ".()[]" or word == "der" for word in variable)
        return f"{kind}equation {_said(_words(variable if variable and is_alone else inner))}"

    def _ends(self, connection: Span) -> list[str]:
        """Return the two connectors of a `connect(a, b)`, in alphabetical order."""
        return sorted("".join(self.words[end.start : end.stop]) for end in connection.inner)

    # --- the children -----------------------------------------------------------------------------------------------

    def _stop(self, at: int) -> int:
        """Return the end of the token before this token's number."""
        return self.starts[at - 1] + len(self.words[at - 1])

    def _blanks(self, at: int) -> str:
        """Return the blanks before a token, and step over them."""
        before = self.text[self._end : self.starts[at]]
        self._end = self.starts[at]
        return before

    def _said(self, stop: int) -> str:
        """Return the text up to the token with this number, and step over it."""
        text = self.text[self._end : self._stop(stop)]
        self._end += len(text)
        return text

    def _slots(self, spans: Sequence[Span]) -> SyntaxTree:
        """Return a tree of children with roles. Raises UnreadableError if two children have the same role."""
        return _with_unique_keys(SyntaxTree(TreeKind.SLOTS, [self._slot(span) for span in spans]))

    def _slot(self, span: Span) -> Child:
        """Return a child of an element; the span's key is the child's role."""
        if span.body:
            self._end += len(span.body.text)
            return Child("body", "", span.body)
        before = self._blanks(span.start)
        if span.key in ("value", "constraint"):
            return Child(span.key, before, self._slots(span.inner))
        if span.key in ("arguments", "annotation"):
            return Child(span.key, before, self._listed(span))
        if span.key == "expression":
            return Child(span.key, before, self._expressed(span))
        words = tuple(self._ends(span)) if span.key == "connect" else None
        return Child(span.key, before, Leaf(self._said(span.stop), words))

    def _listed(self, span: Span) -> Node:
        """Return modifiers in parentheses; `annotation` stands before them."""
        begin, children = self._end, list[Child]()
        opening = self._said(span.start + 1 + (span.key == "annotation"))
        for item in span.inner:
            before = self._blanks(item.start)
            is_whole = not item.inner or any(inner.key == "head" for inner in item.inner)
            node = Leaf(self._said(item.stop)) if is_whole else self._slots(item.inner)
            children.append(self._separated(Child(item.key, before, node), item.stop, ","))
        closing = self.text[self._end : self._stop(span.stop)]
        self._end += len(closing)
        if len({child.key for child in children}) < len(children):  # such as `choice`
            return Leaf(self.text[begin : self._end])
        return SyntaxTree(TreeKind.LIST, children, opening, closing)

    def _separated(self, child: Child, at: int, separator: str) -> Child:
        """Return a child with the blanks before its separator, and the comment after the separator."""
        after = ""
        if self.words[at] == separator:
            after = self._blanks(at)
            self._said(at + 1)
        remark = _remark_at(self.text, self._end)
        self._end += len(remark)
        return msgspec.structs.replace(child, after=after, remark=remark)

    def _expressed(self, span: Span) -> Node:
        """Return an expression: a sum or an array of named nodes, or a leaf."""
        depth, operators, items, terms = 0, set[str](), [span.start], [span.start]
        for at in range(span.start, span.stop):
            word = self.words[at]
            depth += (word in _OPEN) - (word in _CLOSED)
            if depth == 1 and word == ",":
                items.append(at + 1)
            elif depth == 1 and word == "for":
                operators.add(word)
            elif depth == 0 and not (is_name(word) or word in (".", ")", "]", "}")):
                operators.add(word)
                terms.append(at + 1)
        if operators == {"+"} and terms[1] > span.start + 1:
            return self._sequence(TreeKind.SUM, terms, span)
        if self.words[span.start] == "{" and not operators and all(map(self._begins_with_name, items)):
            return self._sequence(TreeKind.ARRAY, [span.start + 1, *items[1:]], span)
        return Leaf(self._said(span.stop))

    def _begins_with_name(self, at: int) -> bool:
        word = self.words[at]
        return is_name(word) or (word == "{" and is_name(self.words[at + 1]))

    def _sequence(self, kind: TreeKind, starts: Sequence[int], span: Span) -> SyntaxTree:
        """Return a sum or an array; each item begins at one of these tokens."""
        children, has_bracket = list[Child](), kind is TreeKind.ARRAY
        opening = self._said(span.start + 1) if has_bracket else ""
        separators = [*(start - 1 for start in starts[1:]), span.stop - has_bracket]
        for start, stop in zip(starts, separators, strict=True):
            child = Child("", self._blanks(start), Leaf(self._said(stop)))
            is_last = stop == separators[-1] and not has_bracket
            children.append(child if is_last else self._separated(child, stop, "," if has_bracket else "+"))
        closing = self.text[self._end : self._stop(span.stop)] if has_bracket else ""
        self._end += len(closing)
        return SyntaxTree(kind, _numbered(children), opening, closing)


def _remark_at(text: str, place: int) -> str:
    """Return the comment at a place in a text if the comment ends the line."""
    match = _REMARK.match(text, place)
    return match[0].rstrip("\r") if match else ""


def _with_unique_keys(tree: SyntaxTree) -> SyntaxTree:
    """Return a tree of these children. Raises UnreadableError if two children have the same key."""
    if len({child.key for child in tree.children}) < len(tree.children):
        raise UnreadableError
    return tree
