"""Finds classes by their full names: of a robot's package, of the user's files, of libraries.

Files of libraries are read when a name needs them.
"""

from __future__ import annotations

import contextlib
import functools
import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from urdfsync.common.dependencies.reads import is_file, read_file
from urdfsync.modelica.classes import OPAQUE, ClassNode
from urdfsync.modelica.files import NOT_CLASSES, PACKAGE_FILE, ClassName, class_of_file, class_parts, place_of, text_of
from urdfsync.modelica.names import STANDARD_LIBRARIES
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import StoredText


class StoredClasses:
    """The classes in files, for one robot's package; files have absolute paths."""

    def __init__(
        self,
        package: str,
        folder: Path,
        texts: Mapping[str, bytes],
        others: Mapping[Path, bytes],
        find: Callable[[str], Path | None],
        read: Callable[[bytes], StoredText] | None = None,
        former_package: str = "",
    ) -> None:
        """`texts` has the files of the robot's package by path below `folder`, `others` has the user's files.

        `find` returns the folder or file of any other top-level class, or None. `read` parses a file whose own names
        need not be resolved. Files of `former_package` on disk do not count.
        """
        self._find = functools.cache(lambda name: find(name) or self._beside(name))
        self._read = read or parse_file
        self._folders: dict[Path, None] = {}
        self._not_on_disk = [tuple(name.split(".")) for name in (package, former_package) if name]
        self._below, self._texts, self._others = f"{folder}{os.sep}", texts, others
        self.own: dict[ClassName, str] = {}
        """The files of the robot's package, by the full names of their classes."""
        self.users: dict[ClassName, ClassNode] = {}
        """The classes of the user's files, by their full names; of several with one name, the first class."""
        self.all_users: list[ClassNode] = []
        """The classes of the user's files, in the order of the files."""
        self.unread: list[Path] = []
        """The user's files with syntax errors or in the wrong folder: their classes are unknown."""
        self.libraries = {*STANDARD_LIBRARIES}
        """Libraries that need not be installed: their classes are not searched."""
        self.seen: dict[ClassName, str | None] = {}
        """The requested classes and their files; None for a missing class."""
        prefix = tuple(package.split("."))
        for path in texts:
            if path.endswith(".mo") and f"/{NOT_CLASSES}/" not in f"/{path}":
                self.own[(*prefix, *class_parts(path))] = self._below + path
        for file, content in others.items():
            stored = self._read(content)
            self.libraries.update(stored.libraries)
            around = tuple(stored.within.split(".")) if stored.within else ()
            folder_around, expected = place_of(file, others)
            self._folders[folder_around] = None
            if stored.is_broken or (expected and around != expected):
                self.unread.append(file)
                continue
            for definition in stored.classes:
                name = (*around, definition.name.parts[0])
                self.all_users.append(ClassNode(definition, name, str(file)))
                self.users.setdefault(name, self.all_users[-1])

    def stored(self, name: ClassName) -> ClassNode | None:
        """Return the class with this full name; `OPAQUE` for an unreadable class, None without a file."""
        file = self.seen[name] = self.file(name)
        if file is None:
            return None
        if name in self.users and name not in self.own:  # a new node each time: nodes keep resolved names
            return ClassNode(self.users[name].definition, name, file)
        try:
            text = self._read(self.content(file))
        except OSError:
            return OPAQUE
        definition = next((definition for definition in text.classes if definition.name.parts[0] == name[-1]), None)
        return OPAQUE if definition is None or text.is_broken else ClassNode(definition, name, file)

    def file(self, name: ClassName) -> str | None:
        """Return the file in which a class is stored; None if there is none."""
        if name in self.own:
            return self.own[name]
        if name in self.users:
            return self.users[name].file
        if any(name[: len(package)] == package for package in self._not_on_disk):
            return None
        # a file in the wrong folder may belong to any package without its class
        path = self._file(name) or next((path for path in self.unread if name[-1] == class_of_file(path)), None)
        return str(path) if path else None

    def content(self, file: str) -> bytes:
        """Return the content of a file. Raises OSError."""
        if (path := self.path_below(file)) in self._texts:
            return self._texts[path]
        other = self._others.get(Path(file))
        return read_file(file) if other is None else other

    def path_below(self, file: str) -> str:
        """Return the path of a file below the robot's package; empty for any other file."""
        return file.removeprefix(self._below) if file.startswith(self._below) else ""

    def has_library(self, name: str) -> bool:
        """Whether a library may be missing: a `uses` annotation of the user or around the package names the library."""
        if name in self.libraries:
            return True
        for package in self._not_on_disk[:1]:
            for end in range(1, len(package) + 1):
                file = self.seen[package[:end]] = self.file(package[:end])
                with contextlib.suppress(OSError):
                    if file and name in self._read(self.content(file)).libraries:
                        return True
        return False

    def names_in(self, name: ClassName) -> Iterable[str]:
        """Return the names of classes that are stored below this package; for the empty name, of top-level classes."""
        names = {other[len(name)] for other in (*self.users, *self.own) if other[:-1] == name or not name}
        path = self._file(name) if name and name not in self.own else None
        if path is not None and path.name == PACKAGE_FILE:
            for entry in path.parent.iterdir():
                if (entry / PACKAGE_FILE).is_file() or (entry.suffix == ".mo" and entry.name != PACKAGE_FILE):
                    names.add(entry.name.removesuffix(".mo"))
        return names

    def _beside(self, name: str) -> Path | None:
        """Return the folder or file of a top-level class beside the user's top-level classes; None if there is none."""
        places = (folder / end for folder in self._folders for end in (f"{name}/{PACKAGE_FILE}", f"{name}.mo"))
        file = next((place for place in places if is_file(place)), None)
        return file.parent if file and file.name == PACKAGE_FILE else file

    def _file(self, name: ClassName) -> Path | None:
        """Return the library's file in which a class is stored."""
        root = self._find(name[0])
        if root is None or root.suffix == ".mo":
            return root if len(name) == 1 else None
        folder = root.joinpath(*name[1:])
        return next((path for path in (folder / PACKAGE_FILE, Path(f"{folder}.mo")) if is_file(path)), None)


def parse_file(content: bytes) -> StoredText:
    """Parse the content of a file."""
    return parse(text_of(content))
