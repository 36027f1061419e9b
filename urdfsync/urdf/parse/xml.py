"""Bytes to XML elements: strict, except for two faults that ROS's own parser accepts too.

A faulty XML declaration and prefixes without a namespace are accepted with a warning. All else that is not
well-formed XML is one error with its line and column. Entities are never declared, expanded or fetched.
"""

from __future__ import annotations

import codecs
import copy
import functools
import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from xml.parsers import expat

import msgspec
from lxml import etree

from urdfsync.diagnostics import Diagnostic, Severity

_WAIT = "wait until the export is complete"
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
_NO_ENCODINGS = ("idna", "punycode", "raw-unicode-escape", "unicode-escape")
"""Codecs of Python for single words: they fail in ways of their own, and one takes minutes for a file of 100 KB."""
_DECLARATION = re.compile(
    r"""<\?xml\s+version\s*=\s*(["'])(?P<version>[^"'<>]*)\1
    (?:\s+encoding\s*=\s*(["'])(?P<encoding>[A-Za-z][\w.-]*)\3)?
    (?:\s+standalone\s*=\s*(["'])(?:yes|no)\5)?\s*\?>""",
    re.VERBOSE | re.ASCII,
)
# ROS's parser accepts these. They do not name the encoding, since other parsers ignore them.
_FAULTY_DECLARATION = re.compile(r"\s*<\?xml\s[^<>]*\?>", re.IGNORECASE | re.ASCII)
# Comments and the like may hold `<` without a tag; entity declarations and merge markers are refused.
_MARKUP = re.compile(
    r"""<!--.*?(?:-->|\Z) | <!\[CDATA\[.*?(?:\]\]>|\Z) | <\?.*?(?:\?>|\Z)
    | <!(?P<entity>ENTITY)
    | <![A-Z](?:[^"'\[<>]|"[^"]*"|'[^']*')*
    | ^(?P<conflict><{7}|>{7})(?=[ ]|$)""",
    re.VERBOSE | re.DOTALL | re.MULTILINE,
)
_START_TAG = re.compile(r"<([^\s<>/!?=][^\s<>/]*)")
_NOT_NEWLINE = re.compile(r"[^\n]")

_AMPERSAND = "an `&` begins no character reference", "write `&amp;`"
# By the type of the parser's error: clearer words than its own (if it needs them), and what to do.
_SYNTAX_HINTS = {
    etree.ErrorTypes.ERR_NAME_REQUIRED: _AMPERSAND,
    etree.ErrorTypes.ERR_ENTITYREF_SEMICOL_MISSING: _AMPERSAND,
    etree.ErrorTypes.ERR_UNDECLARED_ENTITY: ("", "replace the entity by its text, or write `&amp;` for an `&`"),
    etree.ErrorTypes.ERR_LT_IN_ATTRIBUTE: ("", "close the quotes before it, or write `&lt;`"),
    etree.ErrorTypes.ERR_ATTRIBUTE_NOT_STARTED: ("the value of an attribute has no quotes", "put it in quotes"),
    etree.ErrorTypes.ERR_ATTRIBUTE_REDEFINED: ("an element has the same attribute twice", "remove one of them"),
    etree.ErrorTypes.ERR_HYPHEN_IN_COMMENT: ("`--` stands inside of a comment", "take it out, or close the comment"),
    etree.ErrorTypes.ERR_RESERVED_XML_NAME: ("an XML declaration comes too late", "remove what is before it, or it"),
    etree.ErrorTypes.ERR_INVALID_CHAR: ("a character stands here that XML does not allow", "remove it"),
}
_DEPTH = re.compile(r"Excessive depth in document: (\d+)")


class ParseError(Exception):
    """The file can't be read as XML; the diagnostic does not have the file's name yet."""

    def __init__(self, code: str, message: str, hint: str, line: int = 0, column: int = 0) -> None:
        super().__init__(message)
        self.diagnostic = Diagnostic(Severity.ERROR, code, message, "", line, column, hint)


class _Tree:
    """The document as lxml has it."""

    def __init__(self, root: etree._Element) -> None:
        self.root = root

    @functools.cached_property
    def elements(self) -> Sequence[etree._Element]:
        """All elements in document order; most robots have nothing for which they are needed."""
        return list(self.root.iter("*"))


class Node(msgspec.Struct, eq=False, gc=False):
    """One XML element; tag and attributes have prefixes as written, `line` is where its start tag begins, from 1."""

    tag: str
    attributes: Mapping[str, str]
    line: int
    children: list[Node]
    tree: _Tree
    number: int
    """Of the element in the document, from 0."""

    def walk(self) -> Iterator[Node]:
        """Yield this element and all below it, in document order."""
        waiting = [self]
        while waiting:
            node = waiting.pop()
            yield node
            waiting += reversed(node.children)

    def canonical(self) -> str:
        """Return the element as canonical XML 2.0, without comments, indentation and invented namespaces."""
        element = copy.deepcopy(self.tree.elements[self.number])
        text = etree.tostring(element, method="c14n2", with_comments=False, strip_text=True).decode()
        return re.sub(rf' xmlns:[^=]+="{_UNDECLARED}[^"]*"', "", text)


def parse(content: bytes) -> tuple[Node, str, list[Diagnostic]]:
    """Parse an XML file; return its root, its text and the warnings about it. Raises ParseError."""
    text, warnings = _decode(content)
    root, prefixes = _parse_strictly(text)
    return _to_nodes(text, _Tree(root)), text, [*warnings, *prefixes.values()]


def parse_tree(content: bytes) -> etree._Element:
    """Parse an XML file; return its root, with prefixes declared that lack a namespace. Raises ParseError."""
    text, _ = _decode(content)
    return _parse_strictly(text)[0]


def _decode(content: bytes) -> tuple[str, list[Diagnostic]]:
    """Return the text with unified line ends and without XML declaration, and warnings about the latter.

    Blanks take the place of the declaration, so that lines and columns stay.
    """
    if content.startswith(b"version https://git-lfs"):
        raise ParseError("lfs-pointer", "the file is a Git LFS pointer, not the robot", "run `git lfs pull`", 1)
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
        raise ParseError("file-empty", "the file is empty", f"export the robot again, or {_WAIT}", 1)
    declaration = _DECLARATION.match(text) or _FAULTY_DECLARATION.match(text)
    if declaration:
        warnings += _check_declaration(declaration)
        text = _NOT_NEWLINE.sub(" ", text[: declaration.end()]) + text[declaration.end() :]
    return text, warnings


def _to_text(content: bytes, encoding: str) -> str:
    """Decode, and unify the line ends as XML asks for."""
    try:
        if codecs.lookup(encoding).name in _NO_ENCODINGS:
            raise LookupError  # noqa: TRY301 - as for one that Python does not know
        text = content.decode(encoding)
        if not text.isascii():
            text.encode()
    except UnicodeDecodeError as error:
        before = content[: error.start].decode(encoding, errors="replace")
        name = encoding.removesuffix("-sig").upper()
        raise ParseError(
            "file-encoding",
            f"byte 0x{content[error.start]:02x} is not {name}: the file is cut off or has another encoding",
            "save the file as UTF-8, or name its encoding in the XML declaration",
            before.count("\n") + 1,
            len(before) - before.rfind("\n"),
        ) from None
    except (LookupError, UnicodeError):
        hint = "save the file as UTF-8 and declare that"
        raise ParseError("file-encoding", f"the declared encoding {encoding!r} can't be read", hint, 1) from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _check_declaration(declaration: re.Match[str]) -> Iterator[Diagnostic]:
    """Warn about an XML declaration that a strict parser refuses."""
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


def _parse_strictly(text: str) -> tuple[etree._Element, dict[str, Diagnostic]]:
    """Return the root as lxml reads it, and for each prefix without a namespace the warning about its first use."""
    plain = _without_markup(text)
    prefixes: dict[str, Diagnostic] = {}
    while True:
        parser = etree.XMLParser(
            recover=False, no_network=True, load_dtd=False, huge_tree=False, resolve_entities=False
        )
        try:
            root = etree.fromstring(_declare_prefixes(text, plain, prefixes).encode(), parser)
        except etree.XMLSyntaxError as error:
            missing = _undeclared_prefixes(parser.error_log)
            if not missing.keys() - prefixes.keys():
                raise _syntax_error(error, parser.error_log) from None
            prefixes |= missing
            continue
        for entry in parser.error_log.filter_from_warnings():
            if entry.type == etree.ErrorTypes.WAR_UNDECLARED_ENTITY:  # a document type may declare it elsewhere
                raise ParseError("xml-entity", entry.message, "replace the entity by its text", entry.line)
        return root, prefixes


def _without_markup(text: str) -> str:
    """Return the text with blanks for every `<` that begins no tag. Raises ParseError for what is refused."""

    def blank(match: re.Match[str]) -> str:
        line = text.count("\n", 0, match.start()) + 1
        if match["entity"]:
            message = "the file declares XML entities, which urdfsync never expands"
            raise ParseError("xml-entity", message, "replace the entities by their text", line)
        if match["conflict"]:
            hint = "resolve the merge, then build again"
            raise ParseError("merge-conflict", "the file has merge conflict markers", hint, line)
        return _NOT_NEWLINE.sub(" ", match[0])

    # Without the first look, a source of 1,000 links takes 10 ms here.
    return _MARKUP.sub(blank, text) if any(sign in text for sign in ("<!", "<?", "<" * 7, ">" * 7)) else text


def _declare_prefixes(text: str, plain: str, prefixes: Mapping[str, Diagnostic]) -> str:
    """Return the text with namespaces for these prefixes in the root's start tag."""
    root = _START_TAG.search(plain) if prefixes else None
    if root is None:
        return text
    declarations = "".join(f' xmlns:{prefix}="{_UNDECLARED}{prefix}"' for prefix in prefixes)
    return text[: root.end()] + declarations + text[root.end() :]


def _undeclared_prefixes(log: etree._ListErrorLog) -> dict[str, Diagnostic]:
    """Return a warning for each undeclared prefix; none if anything else is wrong."""
    found: dict[str, Diagnostic] = {}
    for entry in log.filter_from_errors():
        match = _NO_NAMESPACE.match(entry.message)
        if entry.type != etree.ErrorTypes.NS_ERR_UNDEFINED_NAMESPACE or not match:
            return {}
        prefix = match["prefix"]
        message = f"the prefix {prefix!r} is not declared"
        hint = f"add xmlns:{prefix}=… to the root element"
        found.setdefault(prefix, _warning("xml-prefix", message, hint, entry.line))
    return found


def _syntax_error(error: etree.XMLSyntaxError, log: etree._ListErrorLog) -> ParseError:
    """Return the first of the gravest entries of the parser's log as an error."""
    found = log.filter_from_fatals() or log.filter_from_errors()
    line, column, text, meaning = error.lineno or 1, 0, str(error.msg), ("", "correct the XML")
    if found:
        line, column, text = found[0].line, found[0].column, found[0].message
        meaning = _SYNTAX_HINTS.get(found[0].type, meaning)
    message, hint = meaning
    if deep := _DEPTH.match(text):
        message, hint = f"elements stand inside of one another {deep[1]} deep", "make it less deep"
    message = f"this is not well-formed XML: {message or text}"
    return ParseError("xml-syntax", message, f"{hint}, or {_WAIT}", line, column)


def _to_nodes(text: str, tree: _Tree) -> Node:
    """Return the root of a text that lxml has read.

    expat reads it once more: lxml does not know the line where a start tag begins, and no line above 65535.
    """
    parser = expat.ParserCreate()
    parser.specified_attributes = True  # a document type may have others
    top: list[Node] = []
    above = [top]  # the lists that the next start tag, and those after the next end tags, add to
    numbers = itertools.count()

    def start(tag: str, attributes: dict[str, str]) -> None:
        children: list[Node] = []
        above[-1].append(Node(tag, attributes, parser.CurrentLineNumber, children, tree, next(numbers)))
        above.append(children)

    def end(_: str) -> None:
        above.pop()

    parser.StartElementHandler, parser.EndElementHandler = start, end
    try:
        parser.Parse(text.encode(), True)  # noqa: FBT003 - expat's own signature
    except expat.ExpatError as error:  # it knows fewer letters in names than lxml
        message = f"this is not well-formed XML: {expat.errors.messages[error.code]}"
        raise ParseError(
            "xml-syntax", message, f"correct the XML, or {_WAIT}", error.lineno, error.offset + 1
        ) from None
    return top[0]
