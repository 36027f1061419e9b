"""Bytes to XML elements: strict, except for two faults that ROS's own parser accepts too.

A faulty XML declaration and prefixes without a namespace are accepted with a warning. All else that is not
well-formed XML is one error with its line and column. Entities are never declared, expanded or fetched.

The parser is expat, since it tells where a start tag begins; lxml tells where it ends, and no line above 65535.
"""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING
from xml.parsers import expat

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity

if TYPE_CHECKING:
    from lxml import etree

_WAIT = "wait until the export is complete"
_DEEPEST = 256
_UNDECLARED = "urn:undeclared:"
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
_BETWEEN_NAMES = re.compile(r"""[\s<>/="']+""")
_START_TAG = re.compile(rb"""<(?:[^>"']|"[^"]*"|'[^']*')*>""")

# What is wrong, and what to do: by expat's message, or by the text up to the character that it stops at.
_UNFINISHED = "a tag or a comment that begins here has no end", "close it"
_ERRORS = {
    expat.errors.XML_ERROR_UNCLOSED_TOKEN: _UNFINISHED,
    expat.errors.XML_ERROR_UNCLOSED_CDATA_SECTION: _UNFINISHED,
    expat.errors.XML_ERROR_UNDEFINED_ENTITY: (
        "an entity is not defined",
        "replace the entity by its text, or write `&amp;` for an `&`",
    ),
    expat.errors.XML_ERROR_DUPLICATE_ATTRIBUTE: ("an element has the same attribute twice", "remove one of them"),
    expat.errors.XML_ERROR_BAD_CHAR_REF: ("a character stands here that XML does not allow", "remove it"),
    expat.errors.XML_ERROR_MISPLACED_XML_PI: ("an XML declaration comes too late", "remove what is before it, or it"),
    expat.errors.XML_ERROR_INVALID_TOKEN: ("a character stands here that XML does not allow", "correct the XML"),
}
_INVALID_TOKENS = (
    (re.compile(r"&#?\w*.?$"), "an `&` begins no character reference", "write `&amp;`"),
    (re.compile(r"=\s*(\"[^\"<]*|'[^'<]*)<$"), "a `<` stands in an attribute", "close the quotes, or write `&lt;`"),
    (re.compile(r"=\s*[^\"']$"), "the value of an attribute has no quotes", "put it in quotes"),
    (re.compile(r"<!--[^>]*--.$"), "`--` stands inside of a comment", "take it out, or close the comment"),
)


class ParseError(Exception):
    """The file can't be read as XML; the diagnostic does not have the file's name yet."""

    def __init__(self, code: str, message: str, hint: str, line: int = 0, column: int = 0) -> None:
        super().__init__(message)
        self.diagnostic = Diagnostic(Severity.ERROR, code, message, "", line, column, hint)


class Document(msgspec.Struct, eq=False):
    """The text that nodes are parts of: in UTF-8, with unified line ends and without XML declaration."""

    content: bytes
    namespaces: dict[str, str]
    """By prefix, that of the default namespace being empty."""
    warnings: list[Diagnostic]


class XmlNode(msgspec.Struct, eq=False, gc=False):
    """One XML element; tag and attributes have prefixes as written, `line` is where its start tag begins, from 1."""

    tag: str
    attributes: Mapping[str, str]
    line: int
    children: list[XmlNode]
    document: Document
    start: int
    """Where its start tag begins in the document, in bytes."""
    end: int = 0
    """Where its end tag begins, if it has one."""

    def walk(self) -> Iterator[XmlNode]:
        """Yield this element and all below it, in document order."""
        waiting = [self]
        while waiting:
            node = waiting.pop()
            yield node
            waiting += reversed(node.children)

    def canonical(self) -> str:
        """Return the element as canonical XML 2.0, without comments, indentation and invented namespaces."""
        import html
        from xml.etree import ElementTree

        content, known = self.document.content, self.document.namespaces
        tag = _START_TAG.match(content, self.start)
        end = tag.end() if tag and tag[0].endswith(b"/>") else content.index(b">", self.end) + 1
        text = content[self.start : end].decode()
        # The element around it, which declares the prefixes that it has, is cut off again.
        words = _BETWEEN_NAMES.split(text)
        prefixes = {"", *(word.partition(":")[0] for word in words if ":" in word)} & known.keys()
        attributes = {f"xmlns:{prefix}" if prefix else "xmlns": known[prefix] for prefix in prefixes}
        declared = "".join([f' {name}="{html.escape(uri)}"' for name, uri in attributes.items()])
        around = f'<urdfsync:it xmlns:urdfsync="{_UNDECLARED}urdfsync"'
        try:
            whole = ElementTree.canonicalize(f"{around}{declared}>{text}</urdfsync:it>", strip_text=True)
        except ElementTree.ParseError:  # a fault in the use of namespaces, which `parse` does not look at
            return text
        inside = whole.removeprefix(f"{around}>").removesuffix("</urdfsync:it>")
        return re.sub(rf' xmlns:[^=]+="{_UNDECLARED}[^"]*"', "", inside)


def parse(content: bytes) -> XmlNode:
    """Parse an XML file; return its root, whose document has the warnings about the file. Raises ParseError."""
    text, warnings = _decode(content)
    document = Document(text.encode(), {}, warnings)
    top: list[XmlNode] = []
    above = [XmlNode("", {}, 0, top, document, 0)]
    used: dict[str, int] = {}  # prefixes, and the line of their first use
    parser = expat.ParserCreate("utf-8")
    parser.specified_attributes = True  # a document type may have others

    def start(tag: str, attributes: dict[str, str]) -> None:
        line = parser.CurrentLineNumber
        if len(above) > _DEEPEST:
            message = f"this is not well-formed XML: elements stand inside of one another {_DEEPEST} deep"
            raise ParseError("xml-syntax", message, f"make it less deep, or {_WAIT}", line)
        node = XmlNode(tag, attributes, line, [], document, parser.CurrentByteIndex)
        above[-1].children.append(node)
        above.append(node)
        for name in [name for name in (tag, *attributes) if ":" in name or name == "xmlns"]:
            prefix, colon, rest = name.partition(":")
            if prefix == "xmlns" and attributes.get(name) and (rest or not colon) and rest not in ("xml", "xmlns"):
                document.namespaces.setdefault(rest, attributes[name])
            elif prefix not in ("", "xml", "xmlns"):
                used.setdefault(prefix, line)

    def end(_: str) -> None:
        above.pop().end = parser.CurrentByteIndex

    def refuse_type(_: str, address: str | None, *_more: object) -> None:
        if address:
            message = f"the file has its document type elsewhere ({address}), where urdfsync never looks"
            raise ParseError("xml-entity", message, "remove the <!DOCTYPE …>", parser.CurrentLineNumber)

    def refuse_entity(*_: object) -> None:
        message = "the file declares XML entities, which urdfsync never expands"
        raise ParseError("xml-entity", message, "replace the entities by their text", parser.CurrentLineNumber)

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.StartDoctypeDeclHandler, parser.EntityDeclHandler = refuse_type, refuse_entity
    try:
        parser.Parse(document.content, True)  # noqa: FBT003 - expat's own signature
    except expat.ExpatError as error:
        if text.split("\n")[error.lineno - 1].startswith("<" * 7):
            raise _merge_conflict(error.lineno) from None
        before = document.content[: parser.ErrorByteIndex + 1]
        what, hint = _explain(expat.errors.messages[error.code], above[-1], before)
        message, hint = f"this is not well-formed XML: {what}", f"{hint}, or {_WAIT}"
        raise ParseError("xml-syntax", message, hint, error.lineno, error.offset + 1) from None
    if marker := re.search(r"^>{7}(?= |$)", text, re.MULTILINE) if ">>>>>>>" in text else None:
        raise _merge_conflict(text.count("\n", 0, marker.start()) + 1)
    for prefix, line in used.items():
        if document.namespaces.setdefault(prefix, _UNDECLARED + prefix).startswith(_UNDECLARED):
            hint = f"add xmlns:{prefix}=… to the root element"
            warnings.append(_warning("xml-prefix", f"the prefix {prefix!r} is not declared", hint, line))
    return top[0]


def parse_tree(content: bytes) -> etree._Element:
    """Return the root of an XML file that `parse` accepts, as lxml has it. Raises ParseError."""
    from lxml import etree  # takes 25 ms to load, and a build does without it

    content = parse(content).document.content
    return etree.fromstring(content, etree.XMLParser(recover=True, no_network=True, resolve_entities=False))


def _explain(message: str, around: XmlNode, before: bytes) -> tuple[str, str]:
    """Return what is wrong and what to do, by expat's message, the open element, and the text up to the error."""
    unclosed = expat.errors.XML_ERROR_TAG_MISMATCH, expat.errors.XML_ERROR_NO_ELEMENTS
    if message in unclosed and around.tag:
        return f"<{around.tag}> of line {around.line} is not closed", f"write </{around.tag}>"
    if message == expat.errors.XML_ERROR_INVALID_TOKEN:
        tail = before[-1000:].decode(errors="replace")
        for sign, what, hint in _INVALID_TOKENS:
            if sign.search(tail):
                return what, hint
    return _ERRORS.get(message, (message, "correct the XML"))


def _merge_conflict(line: int) -> ParseError:
    hint = "resolve the merge, then build again"
    return ParseError("merge-conflict", "the file has merge conflict markers", hint, line)


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
    declaration = _DECLARATION.match(text)
    if declaration and declaration["version"] not in ("1.0", "1.1"):
        message = f"there is no XML version {declaration['version']!r}; the file is read as 1.0"
        warnings.append(_warning("xml-version", message, 'write version="1.0"'))
    if faulty := None if declaration else _FAULTY_DECLARATION.match(text):
        declaration, plain = faulty, faulty[0].lstrip()
        line = faulty[0].count("\n", 0, -len(plain)) + 1
        if plain != faulty[0]:
            message = "the XML declaration does not stand at the very beginning; the file is read as UTF-8"
            warnings.append(_warning("xml-declaration", message, "remove the blanks before it", line))
        if not _DECLARATION.match(plain):
            message = "the XML declaration is not well formed; the file is read as XML 1.0 in UTF-8"
            hint = 'write <?xml version="1.0" encoding="UTF-8"?>'
            warnings.append(_warning("xml-declaration", message, hint, line))
    if declaration:
        text = re.sub(r"[^\n]", " ", declaration[0]) + text[declaration.end() :]
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


def _warning(code: str, message: str, hint: str, line: int = 1) -> Diagnostic:
    return Diagnostic(Severity.WARNING, code, message, line=line, hint=hint)
