"""Bytes to XML elements: strict, except for two faults that ROS's own parser does not mind either.

A faulty XML declaration and prefixes without a namespace are accepted with a warning. All else that is not
well-formed XML is one error with its line and column. Entities are never declared, expanded or fetched.
"""

from __future__ import annotations

import codecs
import copy
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Protocol

import msgspec
from lxml import etree

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf.reader.faults import WAIT, Fault, of_syntax

_UNDECLARED = "urn:undeclared:"
_NO_NAMESPACE = re.compile(r"Namespace prefix (?P<prefix>\S+) (?:on|for) ")
_BYTE_ORDER_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
    (b"<\0", "utf-16-le"),
    (b"\0<", "utf-16-be"),
)
_DECLARATION = re.compile(
    r"""<\?xml\s+version\s*=\s*(["'])(?P<version>[^"'<>]*)\1
    (?:\s+encoding\s*=\s*(["'])(?P<encoding>[A-Za-z][\w.-]*)\3)?
    (?:\s+standalone\s*=\s*(["'])(?:yes|no)\5)?\s*\?>""",
    re.VERBOSE | re.ASCII,
)
_FAULTY_DECLARATION = re.compile(r"\s*<\?xml\s[^<>]*\?>", re.IGNORECASE | re.ASCII)
"""One that ROS's parser takes. It says nothing of the encoding, since other parsers pass it over."""
_MARKUP = re.compile(
    r"""<!--.*?(?:-->|\Z) | <!\[CDATA\[.*?(?:\]\]>|\Z) | <\?.*?(?:\?>|\Z)
    | <!(?P<entity>ENTITY)
    | <![A-Z](?:[^"'\[<>]|"[^"]*"|'[^']*')*
    | ^(?P<conflict><{7}|>{7})(?=[ ]|$)""",
    re.VERBOSE | re.DOTALL | re.MULTILINE,
)
"""What may hold `<` without a tag; and what is refused."""
_START = re.compile(r"<([^\s<>/!?=][^\s<>/]*)")
_DEEP = 100
_INK = re.compile(r"[^\n]")
_STRICT: dict[str, Any] = {
    "recover": False,
    "no_network": True,
    "load_dtd": False,
    "huge_tree": False,
}


class Child(msgspec.Struct, eq=False):
    """Where a child of the root stands: its line, and the offset of its start tag in the text that is parsed.

    Its own text goes on up to the next child; `before + text + after` is a document of its own: the start tag of the
    root, this child, the end tag of the root.
    """

    line: int
    begin: int
    before: str
    after: str
    text: str = ""
    parsed: Sequence[etree._Element] = ()

    def elements(self) -> Sequence[etree._Element]:
        """The child and all elements below it, in document order, as a tree of their own."""
        if not self.parsed:
            root = etree.fromstring(
                (self.before + self.text + self.after).encode(), etree.XMLParser(resolve_entities=False, **_STRICT)
            )
            self.parsed = list(next(root.iterchildren("*")).iter("*"))
        return self.parsed


class Node(msgspec.Struct, eq=False):
    """One XML element: `tag` with its prefix as written, `line` where its start tag begins.

    `child` is the child of the root that it is or belongs to, None for the root: lines count from that child's line
    on, and elements in document order from the child itself, which has the `number` 0.
    """

    tag: str
    attributes: Mapping[str, str]
    line: int
    number: int
    child: Child | None
    children: list[Node]

    def walk(self) -> Iterator[Node]:
        """This element and all below it, in document order."""
        waiting = [self]
        while waiting:
            node = waiting.pop()
            yield node
            waiting += reversed(node.children)

    def canonical(self) -> str:
        """The element as canonical XML 2.0, without comments, indentation and invented namespaces; not of the root."""
        if self.child is None:
            raise ValueError("the root is written by nobody")
        element = copy.deepcopy(self.child.elements()[self.number])
        text = etree.tostring(element, method="c14n2", with_comments=False, strip_text=True).decode()
        return re.sub(rf' xmlns:[^=]+="{_UNDECLARED}[^"]*"', "", text)


class Taker(Protocol):
    """What `parse` hands the elements to. It may begin again with the root: then all before that is void."""

    def root(self, root: Node, namespaces: Mapping[str, str]) -> None:
        """The root, as it is without its children; URIs that it declares, by prefix."""

    def take(self, node: Node) -> None:
        """The next child of the root, which nobody else keeps."""

    def end(self, line: int, offset: int) -> None:
        """The end tag of the root."""


def parse(text: str, taker: Taker) -> Mapping[str, Diagnostic]:
    """Parse what `decode` gave; return a warning for each prefix that lacks a namespace. Raises Fault.

    There never is a tree of the whole: the children of the root are handed over one by one.
    """
    plain = _without_markup(text)
    prefixes: dict[str, Diagnostic] = {}
    while True:
        declared = _declare(text, plain, prefixes)
        builder = _Builder(text, plain, declared, taker)
        try:
            missing = _build(declared, prefixes, builder)
        finally:
            builder.forget()
        if not missing:
            return prefixes
        prefixes |= missing


def tree(content: bytes) -> etree._Element:
    """The root element of an XML file, with prefixes declared that lack a namespace. Raises Fault."""
    text, _ = decode(content)
    plain = _without_markup(text)
    prefixes: dict[str, Diagnostic] = {}
    while True:
        root, missing = _tree(_declare(text, plain, prefixes), prefixes)
        if root is not None:
            return root
        prefixes |= missing


def decode(content: bytes) -> tuple[str, list[Diagnostic]]:
    """The text with unified line ends, and blanks for the XML declaration, which is checked here.

    Also returns what is to be said about the declaration. Raises Fault.
    """
    if content.startswith(b"version https://git-lfs"):
        raise Fault("lfs-pointer", "the file is a Git LFS pointer, not the robot", "run `git lfs pull`", 1)
    encoding = next((name for mark, name in _BYTE_ORDER_MARKS if content.startswith(mark)), "")
    declaration = _DECLARATION.match(content[:200].decode(encoding or "latin-1", errors="ignore"))
    declared = (declaration and declaration["encoding"]) or "utf-8"
    warnings = []
    if not encoding and declared.lower().startswith(("utf-16", "utf-32", "ucs")):
        message = f"the XML declaration says {declared}, but the bytes do not; they are read as UTF-8"
        warnings.append(_warning("xml-declaration", message, "declare UTF-8"))
        declared = "utf-8"
    text = _to_text(content, encoding or declared)
    if not text.strip("\0 \t\n"):
        raise Fault("file-empty", "the file is empty", f"export the robot again, or {WAIT}", 1)
    declaration = _DECLARATION.match(text) or _FAULTY_DECLARATION.match(text)
    if declaration:
        warnings += _faults(declaration)
        text = _INK.sub(" ", text[: declaration.end()]) + text[declaration.end() :]
    return text, warnings


def _faults(declaration: re.Match[str]) -> Iterator[Diagnostic]:
    """What is to be said about an XML declaration."""
    if declaration.re is _DECLARATION:
        if declaration["version"] not in ("1.0", "1.1"):
            message = f"there is no XML version {declaration['version']!r}; the file is read as 1.0"
            yield _warning("xml-version", message, 'write version="1.0"')
        return
    plain = declaration[0].lstrip()
    line = declaration[0].count("\n", 0, -len(plain)) + 1
    if plain != declaration[0]:
        message = "the XML declaration does not stand at the very beginning; the file is read as UTF-8"
        yield _warning("xml-declaration", message, "remove the blanks before it", line)
    if not _DECLARATION.match(plain):
        message = "the XML declaration is not well formed; the file is read as XML 1.0 in UTF-8"
        yield _warning("xml-declaration", message, 'write <?xml version="1.0" encoding="UTF-8"?>', line)


def _warning(code: str, message: str, hint: str, line: int = 1) -> Diagnostic:
    return Diagnostic(Severity.WARNING, code, message, line=line, hint=hint)


def _to_text(content: bytes, encoding: str) -> str:
    """Decode, and unify the line ends as XML asks for."""
    try:
        text = content.decode(encoding)
        if not text.isascii():
            text.encode()
    except UnicodeDecodeError as error:
        before = content[: error.start].decode(encoding, errors="replace")
        name = encoding.removesuffix("-sig").upper()
        raise Fault(
            "file-encoding",
            f"byte 0x{content[error.start]:02x} is not {name}: the file is cut off or has another encoding",
            "save the file as UTF-8, or name its encoding in the XML declaration",
            before.count("\n") + 1,
            len(before) - before.rfind("\n"),
        ) from None
    except (LookupError, UnicodeError):
        hint = "save the file as UTF-8 and declare that"
        raise Fault("file-encoding", f"the declared encoding {encoding!r} can't be read", hint, 1) from None
    return text.replace("\r\n", "\n").replace("\r", "\n") if "\r" in text else text


def _without_markup(text: str) -> str:
    """The text with blanks for all `<` that begin no tag; raises Fault for merge markers and entity declarations."""

    def blank(match: re.Match[str]) -> str:
        if match["conflict"] or match["entity"]:
            raise _forbidden(bool(match["entity"]), text.count("\n", 0, match.start()) + 1)
        return _INK.sub(" ", match[0])

    telling = ("<!", "<?", "<" * 7, ">" * 7)
    return _MARKUP.sub(blank, text) if any(sign in text for sign in telling) else text


def _forbidden(entity: bool, line: int) -> Fault:
    if entity:
        hint = "replace the entities by their text"
        return Fault("xml-entity", "the file declares XML entities, which urdfsync never expands", hint, line)
    return Fault("merge-conflict", "the file has merge conflict markers", "resolve the merge, then build again", line)


def _starts(plain: str) -> Iterator[tuple[str, int, int]]:
    """All start tags in document order: name, line, offset.

    The parser itself knows only the line where a start tag ends, and none beyond 65535.
    """
    line, counted, count = 1, 0, plain.count
    for match in _START.finditer(plain):
        begin = match.start()
        line += count("\n", counted, begin)
        counted = begin
        yield match[1], line, begin


def _declare(text: str, plain: str, prefixes: Mapping[str, Diagnostic]) -> str:
    """The text with namespaces for these prefixes in the root's start tag."""
    root = _START.search(plain) if prefixes else None
    if root is None:
        return text
    declarations = "".join(f' xmlns:{prefix}="{_UNDECLARED}{prefix}"' for prefix in prefixes)
    return text[: root.end()] + declarations + text[root.end() :]


class _Builder:
    """The parser's target: makes nodes of a child of the root, and hands them over where the next one begins."""

    def __init__(self, text: str, plain: str, declared: str, taker: Taker) -> None:
        self._text, self._plain, self._declared, self._taker = text, plain, declared, taker
        self._starts = _starts(plain)
        self._start = ("", 1, 0)
        self._open: list[Node] = []
        self._before = self._after = ""
        self._node: Node | None = None
        """The last child of the root, and where it stands."""
        self._child: Child | None = None
        self._number = 0
        self.deep = False
        """Whether elements are nested so deep that a tree may be refused."""

    def start(self, _: str, attributes: Mapping[str, str], namespaces: Mapping[str, str]) -> None:
        """A start tag; the attributes as in lxml's own trees."""
        tag, line, offset = self._start = next(self._starts)
        above, child = self._open, self._child
        depth = len(above)
        if depth > 1 and child is not None:
            self._number = number = self._number + 1
            node = Node(tag, attributes, line - child.line, number, child, [])
            above[-1].children.append(node)
            if depth > _DEEP:
                self.deep = True
        elif depth:
            self._hand_over(offset)
            self._before = self._before or self._declared[: offset + len(self._declared) - len(self._text)]
            self._child, self._number = Child(line, offset, self._before, self._after), 0
            self._node = node = Node(tag, attributes, 0, 0, self._child, [])
        else:
            node = Node(tag, attributes, line, 0, None, [])
            self._after = f"</{tag}>"
            self._taker.root(node, dict(namespaces))
        above.append(node)

    def end(self, _: str) -> None:
        """An end tag, or the end of an empty element."""
        self._open.pop()
        if not self._open:
            _, line, begin = self._start
            offset = self._plain.rfind("</")
            self._hand_over(offset)
            self._taker.end(line + self._plain.count("\n", begin, offset), offset)

    def close(self) -> None:
        """The end of the document; for the parser."""

    def forget(self) -> None:
        """Let go of everything: lxml's parser keeps its target until cycles are searched for."""
        vars(self).clear()

    def _hand_over(self, end: int) -> None:
        """The last child of the root is complete, and its text ends there."""
        if self._node is not None and self._child is not None:
            self._child.text = self._text[self._child.begin : end]
            self._taker.take(self._node)


def _build(text: str, prefixes: Mapping[str, Diagnostic], builder: _Builder) -> dict[str, Diagnostic]:
    """Parse without a tree, and return the same as `_tree`: it is asked wherever something may be wrong."""
    target: Any = builder
    parser = etree.XMLParser(target=target, resolve_entities="internal", **_STRICT)  # else `&amp;` is given as `&#38;`
    try:
        etree.fromstring(text.encode(), parser)
    except etree.XMLSyntaxError as error:
        missing = _tree(text, prefixes)[1]
        if not missing:
            raise of_syntax(error, parser.error_log) from None
        return missing
    if builder.deep or "xml:id" in text or parser.error_log.filter_from_errors():
        return _tree(text, prefixes)[1]
    _refuse_entities(parser.error_log)
    return {}


def _tree(text: str, prefixes: Mapping[str, Diagnostic]) -> tuple[etree._Element | None, dict[str, Diagnostic]]:
    """The root as a tree; or None, and a warning for each prefix beside these that lacks a namespace. Raises Fault."""
    parser = etree.XMLParser(resolve_entities=False, **_STRICT)
    try:
        root = etree.fromstring(text.encode(), parser)
    except etree.XMLSyntaxError as error:
        missing = _undeclared_prefixes(parser.error_log)
        if missing is None or not missing.keys() - prefixes.keys():
            raise of_syntax(error, parser.error_log) from None
        return None, missing
    _refuse_entities(parser.error_log)
    return root, {}


def _refuse_entities(log: etree._ListErrorLog) -> None:
    """Raise Fault for a reference to an entity that may be declared elsewhere."""
    for entry in log.filter_from_warnings():
        if entry.type == etree.ErrorTypes.WAR_UNDECLARED_ENTITY:
            raise Fault("xml-entity", entry.message, "replace the entity by its text", entry.line)


def _undeclared_prefixes(log: etree._ListErrorLog) -> dict[str, Diagnostic] | None:
    """Per undeclared prefix the warning about its first use; None if anything else is wrong."""
    found: dict[str, Diagnostic] = {}
    for entry in log.filter_from_errors():
        match = _NO_NAMESPACE.match(entry.message)
        if entry.type != etree.ErrorTypes.NS_ERR_UNDEFINED_NAMESPACE or not match:
            return None
        prefix = match["prefix"]
        message = f"the prefix {prefix!r} is not declared"
        hint = f"add xmlns:{prefix}=… to the root element"
        found.setdefault(prefix, Diagnostic(Severity.WARNING, "xml-prefix", message, line=entry.line, hint=hint))
    return found or None
