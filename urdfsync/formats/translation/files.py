"""Reads the files of a source within limits, and records all of them."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from pathlib import Path
from xml.etree.ElementTree import Element

from msgspec.structs import replace

from urdfsync.common.dependencies.facts import read_unrecorded
from urdfsync.common.dependencies.places import real
from urdfsync.common.diagnostics import Diagnostic
from urdfsync.common.files import text_digest
from urdfsync.engine.sources.exchange import fault
from urdfsync.engine.sources.ros_packages import is_visible_file
from urdfsync.formats.urdf.parse.xml import ParseError, parse

_COMMENT = re.compile(rb"<!--.*?(?:-->|\Z)", re.DOTALL)
"""A comment, also one without end: looking for the end of each would take minutes."""

SourcePlace = tuple[str, int]
"""A file, and a line in it."""


def _lines_of(comment: re.Match[bytes]) -> bytes:
    """Return the line ends of a comment; without an end it stays, for the parser to refuse."""
    return b"\n" * comment[0].count(b"\n") if comment[0].endswith(b"-->") else comment[0]


class TranslationError(Exception):
    """A fault for which there is no robot."""

    def __init__(self, message: str, place: SourcePlace = ("", 0), hint: str = "", code: str = "") -> None:
        super().__init__(message)
        self._problem = fault(code, message, *place, hint)

    def problem(self, code: str) -> Diagnostic:
        """Return the fault; `code` counts unless the fault has a code of its own."""
        return replace(self._problem, code=self._problem.code or code)


class Files:
    """Reads the files of a source, and records all of them."""

    def __init__(self, contents: Mapping[str, bytes], folders: Collection[str]) -> None:
        """`contents` of files override the disk. Included files are in one of the `folders`, or below it."""
        self._contents, self._folders = contents, [real(folder) for folder in folders]
        self.hashes: dict[str, str | None] = {}
        self.places: dict[Element, SourcePlace] = {}
        """Where each element stands."""

    def read(self, path: str, place: SourcePlace = ("", 0)) -> bytes:
        """Return the content of a file that is named at `place`. Raises TranslationError."""
        self.hashes[path] = None
        try:
            content = self._contents[path] if path in self._contents else read_unrecorded(path)
        except (OSError, ValueError) as error:  # ValueError for a zero in the name
            reason = getattr(error, "strerror", None) or str(error)
            hint = "put the file there, or correct the name" if place[0] else ""
            raise TranslationError(f"{path} can't be read: {reason}", place, hint) from None
        self.hashes[path] = text_digest(content)
        return content

    def parse(self, path: str, place: SourcePlace = ("", 0), *, has_any_comments: bool = False) -> Element:
        """Return the root element of an XML file. Raises TranslationError.

        With `has_any_comments`, comments may contain `--`, and may stand above the XML declaration.
        """
        content = self.read(path, place)
        if has_any_comments:
            content = _COMMENT.sub(_lines_of, content)
        try:
            document = parse(content)
        except ParseError as error:
            fault = error.diagnostic
            raise TranslationError(fault.message, (path, fault.line), fault.hint, fault.code) from None
        self.places |= {element: (path, line) for element, line in document.lines.items()}
        return document.root

    def fault(self, element: Element, message: str, hint: str = "") -> TranslationError:
        """Return an error about an element."""
        return TranslationError(message, self.places[element], hint)

    def is_there(self, path: str) -> bool:
        """Return whether a file exists; a missing one is recorded, since it would count if it came."""
        is_there = path in self._contents or is_visible_file(path)
        if not is_there:
            self.hashes[path] = None
        return is_there

    def check_inside(self, path: str, place: SourcePlace) -> None:
        """Refuse a file outside of the folders. Raises TranslationError."""
        if not any(Path(real(path)).is_relative_to(folder) for folder in self._folders):
            hint = "move the file into the folder of the source, or of the configuration"
            raise TranslationError(f"the included file {path} is outside of the project", place, hint)
