"""The one error that makes a file unreadable, and what to do about XML that is not well formed."""

from __future__ import annotations

import re

from lxml import etree

from urdfsync.diagnostics import Diagnostic, Severity

WAIT = "wait until the export is complete"

_AMPERSAND = "an `&` begins no character reference", "write `&amp;`"
_WORDS = {
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
"""What to say instead of the parser's message, if that does not tell, and what to do; by the type of its error."""
_DEPTH = re.compile(r"Excessive depth in document: (\d+)")


class Fault(Exception):  # noqa: N818 - becomes a diagnostic
    """The one error that makes a file unreadable: a diagnostic that does not know the file's name."""

    def __init__(self, code: str, message: str, hint: str, line: int = 0, column: int = 0) -> None:
        super().__init__(message)
        self.diagnostic = Diagnostic(Severity.ERROR, code, message, "", line, column, hint)


def of_syntax(error: etree.XMLSyntaxError, log: etree._ListErrorLog) -> Fault:
    """The gravest entry of the parser's log, of several the first, as an error."""
    found = log.filter_from_fatals() or log.filter_from_errors()
    if not found:
        return _fault(str(error.msg), "correct the XML", error.lineno or 1, 0)
    entry = found[0]
    message, hint = _WORDS.get(entry.type, ("", "correct the XML"))
    if deep := _DEPTH.match(entry.message):
        message, hint = f"elements stand inside of one another {deep[1]} deep", "make it less deep"
    return _fault(message or entry.message, hint, entry.line, entry.column)


def _fault(message: str, hint: str, line: int, column: int) -> Fault:
    return Fault("xml-syntax", f"this is not well-formed XML: {message}", f"{hint}, or {WAIT}", line, column)
