"""A package as a check looks at it: its texts, where people find them, and what they stand for. Pure."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection, Mapping
from pathlib import Path, PurePosixPath

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.modelica.lexer import lex

_NOT_CLASSES = frozenset({"Resources"})
"""Folders of a package that hold no classes, whatever is in them."""
_MODELS = frozenset({"model", "block"})
"""Kinds of classes that can be compiled by themselves."""
_PREFIXES = frozenset({"final", "encapsulated", "partial"})


class Package(msgspec.Struct, frozen=True):
    """A Modelica package that is stored as a folder. Paths are POSIX ones, below that folder."""

    name: str
    """Its full name, as in `Plant.Robots.Arm`."""
    folder: Path
    """Where people find it, whether or not it has been written yet."""
    texts: Mapping[str, bytes]
    """Its `.mo` and `package.order` files by path."""
    shown: Callable[[Path], str]
    """How people see a path."""
    owners: Mapping[str, str] = msgspec.field(default_factory=dict)
    """The element that a file belongs to, in the domain's words: `joint elbow`."""
    edited: Collection[str] = ()
    """The files that differ from what is generated."""

    def text(self, path: str) -> str:
        """The text of a file; what is not UTF-8 in it is replaced."""
        return self.texts[path].decode("utf-8", "replace")

    @property
    def top(self) -> Path:
        """Where people find the top-level package that it is in, or is."""
        return (self.folder, *self.folder.parents)[self.name.count(".")]

    def own_models(self, generated: Collection[str]) -> list[str]:
        """The user's models and blocks that are files and not partial, by their full names below the package.

        `generated` are the paths of the files that are not the user's.
        """
        own = (PurePosixPath(path) for path in sorted(self.texts) if path not in generated)
        files = [path for path in own if holds_class(path) and path.name != "package.mo"]
        return [".".join(path.with_suffix("").parts) for path in files if _is_model(self.text(str(path)), path.stem)]

    def finding(
        self, severity: Severity, code: str, message: str, path: str, line: int = 0, column: int = 0, hint: str = ""
    ) -> Diagnostic:
        """A finding in one of the files, or in a folder; it names the element."""
        owner = self.owners.get(path, "")
        words = f"{owner}: {message}" if owner else message
        return Diagnostic(severity, code, words, self.shown(self.folder / path), line, column, hint)


def holds_class(path: PurePosixPath) -> bool:
    """Whether a file of a package is one that tools read as Modelica."""
    hidden = any(part.startswith(".") for part in path.parts)
    return path.suffix == ".mo" and not hidden and _NOT_CLASSES.isdisjoint(path.parts[:-1])


def _is_model(text: str, name: str) -> bool:
    """Whether a file begins with a class of this name that can be compiled by itself."""
    words = [token.text for token in lex(text)[0]]
    start = words.index(";") + 1 if words[0] == "within" and ";" in words else 0
    head = list(itertools.takewhile((_MODELS | _PREFIXES).__contains__, words[start:]))
    return not _MODELS.isdisjoint(head) and "partial" not in head and words[start + len(head)] == name
