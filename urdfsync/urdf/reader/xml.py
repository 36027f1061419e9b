"""Bytes to XML elements: strict, except for two faults that ROS's own parser does not mind either.

A wrong XML version and prefixes without a namespace are accepted with a warning. All else that is not
well-formed XML is one error with its line and column. Entities are never declared, expanded or fetched.
"""

from __future__ import annotations

import codecs
import copy
import re
import sys
from collections.abc import Iterator, Mapping
from typing import NamedTuple

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
_DECLARATION = re.compile(
    r"""<\?xml\s+version\s*=\s*(["'])(?P<version>[^"'<>]*)\1
    (?:\s+encoding\s*=\s*(["'])(?P<encoding>[A-Za-z][\w.-]*)\3)?
    (?:\s+standalone\s*=\s*(["'])(?:yes|no)\5)?\s*\?>""",
    re.VERBOSE | re.ASCII,
)
_MARKUP = re.compile(
    r"""<!--.*?(?:-->|\Z) | <!\[CDATA\[.*?(?:\]\]>|\Z) | <\?.*?(?:\?>|\Z)
    | <!(?P<entity>ENTITY)
    | ^(?P<conflict><{7}|>{7})(?=[ ]|$)
    | <(?P<start>[^\s<>/!?=][^\s<>/]*)""",
    re.VERBOSE | re.DOTALL | re.MULTILINE,
)


class Node(msgspec.Struct, frozen=True, eq=False):
    """One XML element: `tag` with its prefix as written, `line` where its start tag begins."""

    tag: str
    attributes: Mapping[str, str]
    children: tuple[Node, ...]
    line: int
    element: etree._Element

    def walk(self) -> Iterator[Node]:
        """This element and all below it, in document order."""
        waiting = [self]
        while waiting:
            node = waiting.pop()
            yield node
            waiting += reversed(node.children)

    def canonical(self) -> str:
        """The element as canonical XML 2.0, without comments, indentation and invented namespaces."""
        element = copy.deepcopy(self.element)
        text = etree.tostring(element, method="c14n2", with_comments=False, strip_text=True).decode()
        return re.sub(rf' xmlns:[^=]+="{_UNDECLARED}[^"]*"', "", text)


class Document(msgspec.Struct, frozen=True):
    """A parsed file: `root` is None if a diagnostic is an error."""

    root: Node | None
    diagnostics: tuple[Diagnostic, ...]


class _Start(NamedTuple):
    """A start tag in the text: `end` is the offset behind its name."""

    line: int
    end: int


class _Fault(Exception):  # noqa: N818 - never leaves this module
    """The one error that makes a file unreadable."""

    def __init__(self, code: str, message: str, hint: str, line: int = 0, column: int = 0) -> None:
        super().__init__(message)
        self.diagnostic = Diagnostic(Severity.ERROR, code, message, "", line, column, hint)


def parse(content: bytes, file: str) -> Document:
    """Parse the bytes of an XML file; `file` is how diagnostics name it. Raises nothing for bad input."""
    warnings: list[Diagnostic] = []
    root = None
    try:
        text, warnings = _decode(content)
        starts = _scan(text)
        tree, prefixes = _parse_strictly(text, starts)
        warnings += prefixes
        root = _node(tree, iter(starts))
    except _Fault as fault:
        warnings = [fault.diagnostic]
    return Document(root, tuple(msgspec.structs.replace(diagnostic, file=file) for diagnostic in warnings))


def _decode(content: bytes) -> tuple[str, list[Diagnostic]]:
    """The text with unified line ends, and blanks for the XML declaration, which is checked here."""
    if content.startswith(b"version https://git-lfs"):
        raise _Fault("lfs-pointer", "the file is a Git LFS pointer, not the robot", "run `git lfs pull`", 1)
    encoding = next((name for mark, name in _BYTE_ORDER_MARKS if content.startswith(mark)), "")
    declaration = _DECLARATION.match(content[:200].decode(encoding or "latin-1", errors="ignore"))
    declared = (declaration and declaration["encoding"]) or "utf-8"
    warnings = []
    if not encoding and declared.lower().startswith(("utf-16", "utf-32", "ucs")):
        message = f"the XML declaration says {declared}, but the bytes do not; they are read as UTF-8"
        warnings.append(Diagnostic(Severity.WARNING, "xml-declaration", message, line=1, hint="declare UTF-8"))
        declared = "utf-8"
    text = _to_text(content, encoding or declared)
    if not text.strip("\0 \t\n"):
        raise _Fault("file-empty", "the file is empty", f"export the robot again, or {_WAIT}", 1)
    if declaration:
        if declaration["version"] not in ("1.0", "1.1"):
            message = f"there is no XML version {declaration['version']!r}; the file is read as 1.0"
            warnings.append(Diagnostic(Severity.WARNING, "xml-version", message, line=1, hint='write version="1.0"'))
        text = re.sub(r"[^\n]", " ", text[: declaration.end()]) + text[declaration.end() :]
    return text, warnings


def _to_text(content: bytes, encoding: str) -> str:
    """Decode, and unify the line ends as XML asks for."""
    try:
        text = content.decode(encoding)
        text.encode()
    except UnicodeDecodeError as error:
        before = content[: error.start].decode(encoding, errors="replace")
        name = encoding.removesuffix("-sig").upper()
        raise _Fault(
            "file-encoding",
            f"byte 0x{content[error.start]:02x} is not {name}: the file is cut off or has another encoding",
            "save the file as UTF-8, or name its encoding in the XML declaration",
            before.count("\n") + 1,
            len(before) - before.rfind("\n"),
        ) from None
    except (LookupError, UnicodeError):
        hint = "save the file as UTF-8 and declare that"
        raise _Fault("file-encoding", f"the declared encoding {encoding!r} can't be read", hint, 1) from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _scan(text: str) -> list[_Start]:
    """All start tags in document order; raises _Fault for merge markers and entity declarations.

    The parser itself knows only the line where a start tag ends, and none beyond 65535.
    """
    starts = []
    line, counted = 1, 0
    for match in _MARKUP.finditer(text):
        line += text.count("\n", counted, match.start())
        counted = match.start()
        if match["start"]:
            starts.append(_Start(line, match.end()))
        elif match["conflict"]:
            hint = "resolve the merge, then build again"
            raise _Fault("merge-conflict", "the file has merge conflict markers", hint, line)
        elif match["entity"]:
            hint = "replace the entities by their text"
            raise _Fault("xml-entity", "the file declares XML entities, which urdfsync never expands", hint, line)
    return starts


def _parse_strictly(text: str, starts: list[_Start]) -> tuple[etree._Element, list[Diagnostic]]:
    """The root element, after declaring the prefixes that lack it, and a warning for each of these."""
    warnings: dict[str, Diagnostic] = {}
    while True:
        parser = etree.XMLParser(
            recover=False, resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False
        )
        declarations = "".join(f' xmlns:{prefix}="{_UNDECLARED}{prefix}"' for prefix in warnings)
        end = starts[0].end if starts else 0
        try:
            root = etree.fromstring((text[:end] + declarations + text[end:]).encode(), parser)
        except etree.XMLSyntaxError as error:
            missing = _undeclared_prefixes(parser.error_log)
            if missing is None or not missing.keys() - warnings.keys():
                raise _syntax_fault(error, parser.error_log) from None
            warnings |= missing
            continue
        for entry in parser.error_log.filter_from_warnings():
            if entry.type == etree.ErrorTypes.WAR_UNDECLARED_ENTITY:
                raise _Fault("xml-entity", entry.message, "replace the entity by its text", entry.line)
        return root, list(warnings.values())


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


def _syntax_fault(error: etree.XMLSyntaxError, log: etree._ListErrorLog) -> _Fault:
    """The gravest entry of the parser's log, of several the first, as an error."""
    hint = f"correct the XML, or {_WAIT}"
    found = log.filter_from_fatals() or log.filter_from_errors()
    if not found:
        return _Fault("xml-syntax", f"this is not well-formed XML: {error.msg}", hint, error.lineno or 1)
    entry = found[0]
    return _Fault("xml-syntax", f"this is not well-formed XML: {entry.message}", hint, entry.line, entry.column)


def _node(element: etree._Element, starts: Iterator[_Start]) -> Node:
    """The element and all below it; `starts` yields the start tags in document order."""
    start, name = next(starts, None), sys.intern(str(element.tag).rpartition("}")[2])
    return Node(
        tag=f"{element.prefix}:{name}" if element.prefix else name,
        attributes={sys.intern(key): value for key, value in element.items()},
        line=start.line if start else int(element.sourceline or 0),
        children=tuple([_node(child, starts) for child in element.iterchildren("*")]),
        element=element,
    )
