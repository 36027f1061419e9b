"""Reads bytes into XML elements: strictly, except for two faults that ROS's own parser accepts.

A faulty XML declaration gets a warning. A prefix without a namespace gets none. Any other fault of the XML is one error
with its line and column. A file that declares entities is refused.

Elements are those of the standard library, with tags and attributes as written. ElementTree's parser refuses prefixes
without a namespace and knows no lines, so this module calls expat. Loading lxml would take 20 ms.
"""

from __future__ import annotations

import codecs
import re
from typing import NamedTuple
from xml.etree.ElementTree import Element, TreeBuilder, tostring
from xml.parsers import expat

from urdfsync.common.diagnostics import Diagnostic
from urdfsync.engine.sources.file_kinds import find_conflict, find_kind
from urdfsync.formats.urdf.validate import diagnostic

_DEEPEST = 256  # as in libxml2; writing an element recurses once for each level
_BYTE_ORDER_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
    (b"<\0", "utf-16-le"),
    (b"\0<", "utf-16-be"),
)
_WIDE = ("utf-16", "utf-32", "ucs")
_NO_ENCODINGS = ("idna", "punycode", "raw-unicode-escape", "unicode-escape")
"""Refused codecs of Python: some fail with unusual exceptions, one needs minutes for 100 KB."""
_DECLARATION = re.compile(
    r"""<\?xml\s+version\s*=\s*(["'])1\.[01]\1
    (?:\s+encoding\s*=\s*(["'])(?P<encoding>[A-Za-z][\w.-]*)\2)?
    (?:\s+standalone\s*=\s*(["'])(?:yes|no)\4)?\s*\?>""",
    re.VERBOSE | re.ASCII,
)
# ROS's parser accepts these faulty declarations. As in other parsers, the declared encoding is ignored.
_FAULTY_DECLARATION = r"(?ia)\s*<\?xml\s[^<>]*\?>"
_UNCLOSED = expat.errors.XML_ERROR_TAG_MISMATCH, expat.errors.XML_ERROR_NO_ELEMENTS
_HINTS = {expat.errors.XML_ERROR_MISPLACED_XML_PI: "put <?xml … ?> at the beginning of the file, above all comments"}


class ParseError(Exception):
    """The file is not readable as XML. The diagnostic has no file name."""

    def __init__(self, code: str, message: str, line: int = 1, column: int = 0, hint: str = "") -> None:
        super().__init__(message)
        self.diagnostic = diagnostic(code, message, line, hint, column)


class XmlDocument(NamedTuple):
    """An XML file; `text` has unified line ends, and no XML declaration."""

    text: str
    root: Element
    lines: dict[Element, int]
    """Lines of start tags, counted from 1, in document order."""
    warnings: list[Diagnostic]


def parse(content: bytes) -> XmlDocument:
    """Parse an XML file. Raises ParseError."""
    text, warnings = _decode(content)
    builder, parser = TreeBuilder(), expat.ParserCreate("utf-8")
    lines: dict[Element, int] = {}
    above: list[Element] = []

    def start(tag: str, attributes: dict[str, str]) -> None:
        lines[element := builder.start(tag, attributes)] = parser.CurrentLineNumber
        if len(above) == _DEEPEST:
            message = f"this is not well-formed XML: elements are nested {_DEEPEST} deep"
            raise ParseError("xml-syntax", message, lines[element])
        above.append(element)

    def end(tag: str) -> None:
        above.pop()
        builder.end(tag)

    def refuse_type(_: str, address: str | None, *_more: object) -> None:
        if address:
            message = f"the document type of the file is elsewhere ({address}), where urdfsync never looks"
            raise ParseError("xml-entity", message, parser.CurrentLineNumber)

    def refuse_entity(*_: object) -> None:
        message = "the file declares XML entities, which urdfsync never expands"
        raise ParseError("xml-entity", message, parser.CurrentLineNumber)

    parser.buffer_text = True
    parser.specified_attributes = True  # a document type may add default attributes
    parser.StartElementHandler, parser.EndElementHandler, parser.CharacterDataHandler = start, end, builder.data
    parser.StartDoctypeDeclHandler, parser.EntityDeclHandler = refuse_type, refuse_entity
    error = None
    try:
        parser.Parse(text.encode(), True)  # noqa: FBT003 - expat's own signature
    except expat.ExpatError as fault:
        error = fault
    # ends the cycle of handlers and parser, which would keep all elements until the garbage collection
    parser.StartElementHandler = parser.StartDoctypeDeclHandler = parser.EntityDeclHandler = None
    if (error or ">>>>>>>" in text) and (conflict := find_conflict(text)) is not None:
        raise ParseError(conflict.code, conflict.message, conflict.line)
    if error:
        problem = expat.ErrorString(error.code)
        if problem in _UNCLOSED and above:
            problem = f"<{above[-1].tag}> of line {lines[above[-1]]} is not closed"
        message, hint = f"this is not well-formed XML: {problem}", _HINTS.get(problem, "")
        raise ParseError("xml-syntax", message, error.lineno, error.offset + 1, hint)
    return XmlDocument(text, builder.close(), lines, warnings)


def canonical(element: Element) -> str:
    """Return an element as text, without comments and indentation, with sorted attributes.

    This removes the indentation from the element.
    """
    for part in element.iter():
        part.text, part.tail = (part.text or "").strip(), (part.tail or "").strip()
        attributes = sorted(part.items())
        part.attrib.clear()
        part.attrib.update(attributes)
    element.tail = ""
    return tostring(element, "unicode", short_empty_elements=False)


def _decode(content: bytes) -> tuple[str, list[Diagnostic]]:
    """Return the text with unified line ends and without XML declaration, and warnings about the declaration.

    Blanks replace the declaration: lines and columns stay.
    """
    if (kind := find_kind(content)) is not None:
        raise ParseError(kind.code, kind.message, kind.line, hint=kind.hint)
    encoding = next((name for mark, name in _BYTE_ORDER_MARKS if content.startswith(mark)), "")
    declaration = _DECLARATION.match(content[:200].decode(encoding or "latin-1", errors="ignore"))
    declared = ((declaration and declaration["encoding"]) or "utf-8").lower()
    is_faulty = not encoding and declared.startswith(_WIDE)  # the bytes are in another encoding
    encoding = encoding or ("utf-8" if is_faulty else declared)
    try:
        if codecs.lookup(encoding).name in _NO_ENCODINGS:
            raise LookupError  # noqa: TRY301 - Python raises LookupError for an unknown codec
        text = content.decode(encoding).replace("\r\n", "\n").replace("\r", "\n")
        if not text.isascii():
            text.encode()  # some codecs return lone surrogates
    except UnicodeDecodeError as error:
        before = content[: error.start].decode(encoding, errors="replace")
        name = encoding.removesuffix("-sig").upper()
        message = f"byte 0x{content[error.start]:02x} is not {name}: the file is cut off or has another encoding"
        line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
        raise ParseError("file-encoding", message, line, column) from None
    except (LookupError, UnicodeError):
        raise ParseError("file-encoding", f"the declared encoding {encoding!r} can't be read") from None
    if not text.strip("\0 \t\n"):
        raise ParseError("file-empty", "the file is empty")
    declaration, warnings = _DECLARATION.match(text), []
    if not declaration:
        declaration = re.match(_FAULTY_DECLARATION, text)
        is_faulty = declaration is not None
    if is_faulty:
        message = "the XML declaration has a fault; the file is read as XML 1.0 in UTF-8"
        warnings.append(diagnostic("xml-declaration", message, 1))
    if declaration:
        text = re.sub(r"[^\n]", " ", declaration[0]) + text[declaration.end() :]
    return text, warnings
