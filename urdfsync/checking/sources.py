"""The classes that a robot's package and the user's files can refer to: texts at hand, and libraries on disk.

Files of libraries are read when a name needs them.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from urdfsync.checking.libraries import dependencies, library
from urdfsync.checking.libraries.library import LibraryError
from urdfsync.config import Config, RobotConfig, library_folder
from urdfsync.modelica.names import LIBRARY
from urdfsync.modelica.parser import parse
from urdfsync.modelica.scopes import UNKNOWN, Stored, Unknown
from urdfsync.modelica.syntax import StoredText

_PACKAGE = "package.mo"


class DiskSources:
    """Looks for a class among texts first, then in libraries."""

    def __init__(self, config: Config, robot: RobotConfig, texts: Mapping[Path, bytes]) -> None:
        """`texts` are files by their absolute path; whether they are on disk does not matter."""
        self._config, self._robot = config, robot
        self._places = dependencies.search_path(robot)
        self._roots: dict[str, Path | None] = {}
        self._own = tuple(robot.target.package.split("."))
        self.classes: dict[tuple[str, ...], Stored] = {}
        """The classes of the texts by their full names; their files are absolute paths."""
        self.unread: list[Path] = []
        """Texts that are no Modelica; nothing is known of their classes."""
        for path, content in texts.items():
            self._add(path, content, set(texts))

    def stored(self, name: tuple[str, ...]) -> Stored | Unknown | None:
        """Return the class with this full name, see `Sources`."""
        if name in self.classes:
            return self.classes[name]
        if any(_is_file_of(path, name[-1]) for path in self.unread):
            return UNKNOWN
        path = None if name[: len(self._own)] == self._own else self._file(name)
        if path is None:
            return None
        try:
            found = _parsed(path.read_bytes())
        except OSError:
            return UNKNOWN
        definition = next((one for one in found.classes if one.name.parts[0] == name[-1]), None)
        return Stored(definition, str(path)) if definition is not None and not _is_broken(found) else UNKNOWN

    def names_in(self, name: tuple[str, ...]) -> Iterable[str]:
        """Return the names of the classes that are stored below a package, see `Sources`."""
        found = {other[-1] for other in self.classes if other[:-1] == name}
        if not name:
            return found | {LIBRARY, *self._roots}
        path = None if name[: len(self._own)] == self._own else self._file(name)
        if path is not None and path.name == _PACKAGE:
            for entry in path.parent.iterdir():
                if (entry / _PACKAGE).is_file() or (entry.suffix == ".mo" and entry.name != _PACKAGE):
                    found.add(entry.name.removesuffix(".mo"))
        return found

    def _add(self, path: Path, content: bytes, files: set[Path]) -> None:
        found = _parsed(content)
        within = tuple(found.within.split(".")) if found.within else ()
        expected = _place(path, files)
        if _is_broken(found) or (expected and within != expected):
            self.unread.append(path)  # tools can't load it; who looks at the layout says so
            return
        for one in found.classes:
            self.classes.setdefault((*within, one.name.parts[0]), Stored(one, str(path)))

    def _file(self, name: tuple[str, ...]) -> Path | None:
        """The file of a library in which a class is stored."""
        root = self._root(name[0])
        if root is None or len(name) == 1:
            return root and (root if root.suffix == ".mo" else root / _PACKAGE)
        if root.suffix == ".mo":
            return None
        folder = root.joinpath(*name[1:])
        return next((path for path in (folder / _PACKAGE, Path(f"{folder}.mo")) if path.is_file()), None)

    def _root(self, name: str) -> Path | None:
        """The folder or file of a library; None if there is none of this name."""
        if name not in self._roots:
            self._roots[name] = self._find(name)
        return self._roots[name]

    def _find(self, name: str) -> Path | None:
        if name == LIBRARY and self._own[0] != LIBRARY:
            return library_folder() / LIBRARY
        if name not in library.PARTS:
            return library.find(name, self._places)
        try:
            found = library.standard(os.environ, library.home(), self._config.check.library)
        except LibraryError:
            return None
        return dict(zip(library.PARTS, (found.modelica, found.services, found.complex), strict=True))[name].path


def _parsed(content: bytes) -> StoredText:
    return parse(content.decode(errors="replace").replace("\r\n", "\n"))


def _is_broken(found: StoredText) -> bool:
    """Whether parts of a text could not be read."""
    return any(not fault.reason.endswith(" twice") for fault in found.faults)


def _place(path: Path, files: set[Path]) -> tuple[str, ...]:
    """The full name of the package that a file is in, by the folders around it; empty if it is in none."""
    folder = path.parent.parent if path.name == _PACKAGE else path.parent
    parts: list[str] = []
    while folder / _PACKAGE in files or (folder / _PACKAGE).is_file():
        parts.insert(0, folder.name)
        folder = folder.parent
    return tuple(parts)


def _is_file_of(path: Path, name: str) -> bool:
    return name in (path.stem, path.parent.name) if path.name == _PACKAGE else path.stem == name
