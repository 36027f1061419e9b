"""A package as a check looks at it: its texts, where people find them, and what they stand for. Pure."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Collection, Mapping
from pathlib import Path

from urdfsync.diagnostics import Diagnostic, Severity


@dataclasses.dataclass(frozen=True, slots=True)
class Package:
    """A Modelica package that is stored as a folder. Paths are POSIX ones, below that folder."""

    name: str
    """Its full name, as in `Plant.Robots.Arm`."""
    folder: Path
    """Where people find it, whether or not it has been written yet."""
    texts: Mapping[str, bytes]
    """Its `.mo` and `package.order` files by path."""
    shown: Callable[[Path], str]
    """How people see a path."""
    owners: Mapping[str, str] = dataclasses.field(default_factory=dict)
    """The element that a file belongs to, in the domain's words: `joint elbow`."""
    edited: Collection[str] = ()
    """The files that differ from what is generated."""

    def text(self, path: str) -> str:
        """The text of a file; what is not UTF-8 in it is replaced."""
        return self.texts[path].decode("utf-8", "replace")

    def finding(
        self, severity: Severity, code: str, message: str, path: str, line: int = 0, column: int = 0, hint: str = ""
    ) -> Diagnostic:
        """A finding in one of the files, or in a folder; it names the element."""
        owner = self.owners.get(path, "")
        words = f"{owner}: {message}" if owner else message
        return Diagnostic(severity, code, words, self.shown(self.folder / path), line, column, hint)
