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

from urdfsync.dependencies import file_type, list_folder
from urdfsync.modelica.parser import parse
from urdfsync.modelica.scopes import UNKNOWN, Stored, Unknown
from urdfsync.modelica.syntax import StoredText

_PACKAGE = "package.mo"
_NOT_CLASSES = "Resources"


class StoredClasses:
    """The `Sources` of one robot's package, see `modelica.scopes`; files are known by their absolute paths."""

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
        self._package, self._folder, self._texts = tuple(package.split(".")), folder, texts
        self._find, self._gone = functools.cache(find), tuple(gone.split(".")) if gone else ()
        self.users: dict[tuple[str, ...], Stored] = {}
        """The classes of the user's files, by their full names."""
        self.unread: list[Path] = []
        """Files of the user that are no Modelica, or not where their class belongs: its classes are unknown."""
        for path, content in others.items():
            found = _parsed(content)
            within = tuple(found.within.split(".")) if found.within else ()
            expected = _package_around(path, others)
            if found.is_broken or (expected and within != expected):
                self.unread.append(path)
                continue
            for one in found.classes:
                self.users.setdefault((*within, one.name.parts[0]), Stored(one, str(path)))

    @property
    def own(self) -> list[tuple[str, ...]]:
        """The full names of the classes that are files of the robot's package."""
        paths = [PurePosixPath(path) for path in self._texts if path.endswith(".mo")]
        classes = [path for path in paths if _NOT_CLASSES not in path.parts[:-1]]
        return [
            (*self._package, *(path.parent if path.name == _PACKAGE else path.with_suffix("")).parts)
            for path in classes
        ]

    def stored(self, name: tuple[str, ...]) -> Stored | Unknown | None:
        """Return the class with this full name, see `Sources`."""
        if name in self.users:
            return self.users[name]
        if self._is_own(name):
            stem = "/".join(name[len(self._package) :])
            for path in (f"{stem}/{_PACKAGE}".lstrip("/"), f"{stem}.mo"):
                if path in self._texts:
                    return _class_in(self._texts[path], name[-1], self._folder / path)
            return None
        if self._gone and name[: len(self._gone)] == self._gone:
            return None
        if name[-1] in map(_class_name, self.unread):
            return UNKNOWN
        file = self._file(name)
        try:
            return _class_in(file.read_bytes(), name[-1], file) if file else None
        except OSError:
            return UNKNOWN

    def names_in(self, name: tuple[str, ...]) -> Iterable[str]:
        """Return the names of the classes that are stored below a package, see `Sources`."""
        found = {other[-1] for other in (*self.users, *self.own) if other[:-1] == name}
        path = None if not name or self._is_own(name) else self._file(name)
        if path is not None and path.name == _PACKAGE:
            for entry in path.parent.iterdir():
                if (entry / _PACKAGE).is_file() or (entry.suffix == ".mo" and entry.name != _PACKAGE):
                    found.add(entry.name.removesuffix(".mo"))
        return found if name else found | {self._package[0]}

    def _is_own(self, name: tuple[str, ...]) -> bool:
        return name[: len(self._package)] == self._package

    def _file(self, name: tuple[str, ...]) -> Path | None:
        """Return the file of a library in which a class is stored."""
        root = self._find(name[0])
        if root is None or len(name) == 1:
            return root and (root if root.suffix == ".mo" else root / _PACKAGE)
        if root.suffix == ".mo":
            return None
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


def _class_in(content: bytes, name: str, file: Path) -> Stored | Unknown:
    found = _parsed(content)
    definition = next((one for one in found.classes if one.name.parts[0] == name), None)
    return UNKNOWN if definition is None or found.is_broken else Stored(definition, str(file))


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
