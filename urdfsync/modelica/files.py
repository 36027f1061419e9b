"""Classes by their full names, for the resolution of names: of a robot's package, of the user's files, of libraries.

Files of libraries are read when a name needs them.
"""

from __future__ import annotations

import contextlib
import functools
import os
import re
import stat
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import TypeAlias

from urdfsync.dependencies import file_type, list_folder
from urdfsync.modelica.classes import OPAQUE, Node
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import StoredText

ClassName: TypeAlias = tuple[str, ...]
_PACKAGE = "package.mo"
_NOT_CLASSES = "Resources"


def class_path(file: PurePosixPath) -> PurePosixPath:
    """Return the path of a stored class, without suffix: of a `package.mo` that of its folder."""
    return file.parent if file.name == _PACKAGE else file.with_suffix("")


class StoredClasses:
    """The classes that are stored in files, for one robot's package; files are known by their absolute paths."""

    def __init__(
        self,
        package: str,
        folder: Path,
        texts: Mapping[str, bytes],
        others: Mapping[Path, bytes],
        find: Callable[[str], Path | None],
        gone: str = "",
    ) -> None:
        """`texts` are the files of the robot's package by their path below `folder`, `others` files of the user's.

        `find` gives the folder or file of any other top-level class, None if there is none. `gone` is a package of
        which nothing counts that is on disk.
        """
        self._find = functools.cache(find)
        self._not_on_disk = [tuple(name.split(".")) for name in (package, gone) if name]
        self.own: dict[ClassName, tuple[bytes, Path]] = {}
        """The files of the robot's package by the full names of their classes."""
        self.users: dict[ClassName, Node] = {}
        """The classes of the user's files, by their full names."""
        self.unread: list[Path] = []
        """Files of the user that are no Modelica, or not where their class belongs: its classes are unknown."""
        for path, content in texts.items():
            place = PurePosixPath(path)
            if path.endswith(".mo") and _NOT_CLASSES not in place.parent.parts:
                self.own[(*package.split("."), *class_path(place).parts)] = content, folder / path
        for file, content in others.items():
            found = _parsed(content)
            around = tuple(found.within.split(".")) if found.within else ()
            expected = _package_around(file, others)
            if found.is_broken or (expected and around != expected):
                self.unread.append(file)
                continue
            for one in found.classes:
                name = (*around, one.name.parts[0])
                self.users.setdefault(name, Node(one, name, str(file)))

    def stored(self, name: ClassName) -> Node | None:
        """Return the class with this full name, `OPAQUE` if it can't be read; None if there is no file of it."""
        if name in self.users:
            return self.users[name]
        if name in self.own:
            return _class_in(*self.own[name], name)
        if any(name[: len(package)] == package for package in self._not_on_disk):
            return None
        if name[-1] in map(_class_name, self.unread):
            return OPAQUE
        file = self._file(name)
        try:
            return _class_in(file.read_bytes(), file, name) if file else None
        except OSError:
            return OPAQUE

    def names_in(self, name: ClassName) -> Iterable[str]:
        """Return the names of classes that are stored below this package; of the empty name, top-level ones."""
        found = {other[len(name)] for other in (*self.users, *self.own) if other[:-1] == name or not name}
        path = self._file(name) if name and name not in self.own else None
        if path is not None and path.name == _PACKAGE:
            for entry in path.parent.iterdir():
                if (entry / _PACKAGE).is_file() or (entry.suffix == ".mo" and entry.name != _PACKAGE):
                    found.add(entry.name.removesuffix(".mo"))
        return found

    def _file(self, name: ClassName) -> Path | None:
        """Return the file of a library in which a class is stored."""
        root = self._find(name[0])
        if root is None or root.suffix == ".mo":
            return root if len(name) == 1 else None
        folder = root.joinpath(*name[1:])
        return next((path for path in (folder / _PACKAGE, Path(f"{folder}.mo")) if path.is_file()), None)


def modelica_files(folder: Path) -> Iterator[str]:
    """Yield all files of Modelica below a folder, but for links, hidden folders and `Resources`.

    What is looked at is recorded as a dependency. What can't be looked at is left out.
    """
    waiting = [str(folder)]
    while waiting:
        current = waiting.pop()
        inside: list[str] = []
        with contextlib.suppress(OSError):
            inside = sorted(list_folder(current))
        for name in inside:
            path, found = f"{current}{os.sep}{name}", 0
            if name.startswith(".") or name == _NOT_CLASSES:
                continue
            with contextlib.suppress(OSError):
                found = file_type(path, follow=False)
            if found == stat.S_IFDIR:
                waiting.append(path)
            elif found == stat.S_IFREG and name.endswith(".mo"):
                yield path


def files_that_use(files: Mapping[Path, bytes], names: Iterable[str]) -> dict[Path, bytes]:
    """The files that mention one of these names, or the class of another such file, which is called like that file."""
    waiting, unused, found = dict(files), list(names), {}
    while unused:
        word = unused.pop().encode()
        for path in [path for path, content in waiting.items() if has_word(content, word)]:
            found[path] = waiting.pop(path)
            unused.append(_class_name(path))
    return dict(sorted(found.items()))


def has_word(text: bytes, name: bytes) -> bool:
    """Whether a name stands in a text as a word of its own."""
    return name in text and re.search(rb"\b" + re.escape(name) + rb"\b", text) is not None


def _parsed(content: bytes) -> StoredText:
    return parse(content.decode(errors="replace").replace("\r\n", "\n"))


def _class_in(content: bytes, file: Path, name: ClassName) -> Node:
    found = _parsed(content)
    definition = next((one for one in found.classes if one.name.parts[0] == name[-1]), None)
    return OPAQUE if definition is None or found.is_broken else Node(definition, name, str(file))


def _class_name(path: Path) -> str:
    """The name of the class that a file is for."""
    return path.parent.name if path.name == _PACKAGE else path.stem


def _package_around(path: Path, files: Mapping[Path, bytes]) -> tuple[str, ...]:
    """Return the full name of the package that a file is in, by the folders around it; empty if it is in none."""
    folder = path.parent.parent if path.name == _PACKAGE else path.parent
    parts: list[str] = []
    while folder / _PACKAGE in files or (folder / _PACKAGE).is_file():
        parts.insert(0, folder.name)
        folder = folder.parent
    return tuple(parts)
