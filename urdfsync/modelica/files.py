"""Classes by their full names, for the resolution of names: of a robot's package, of the user's files, of libraries.

Files of libraries are read when a name needs them.
"""

from __future__ import annotations

import contextlib
import functools
import os
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import TypeAlias

from urdfsync.dependencies import is_file, read_file, scan_modelica
from urdfsync.modelica.classes import OPAQUE, Node
from urdfsync.modelica.names import STANDARD_LIBRARIES
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import StoredText

ClassName: TypeAlias = tuple[str, ...]
_PACKAGE = "package.mo"
_NOT_CLASSES = "Resources"
_NO_CODE = re.compile(rb"('(?:[^'\\\n]|\\.)*')|\"(?:[^\"\\]|\\.)*\"|//[^\n]*|/\*.*?\*/", re.DOTALL)
"""Strings and comments; quoted names, which may look like them, are a group."""


def class_path(file: PurePosixPath) -> PurePosixPath:
    """Return the path of a stored class, without suffix: of a `package.mo` that of its folder."""
    return file.parent if file.name == _PACKAGE else file.with_suffix("")


def class_parts(path: str) -> tuple[str, ...]:
    """Return the name of the class that a file is for, from its POSIX path below the package."""
    return tuple(path.removesuffix(".mo").removesuffix("/package").split("/")) if path != _PACKAGE else ()


class StoredClasses:
    """The classes that are stored in files, for one robot's package; files are known by their absolute paths."""

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
        """`texts` are the files of the robot's package by their path below `folder`, `others` files of the user's.

        `find` gives the folder or file of any other top-level class, None if there is none; `read` parses a file if
        names are resolved in others alone. Of `former_package`, nothing on disk counts.
        """
        self._find = functools.cache(lambda name: find(name) or self._beside(name))
        self._read = read or parse_file
        self._folders: dict[Path, None] = {}
        self._not_on_disk = [tuple(name.split(".")) for name in (package, former_package) if name]
        self._below, self._texts, self._others = f"{folder}{os.sep}", texts, others
        self.own: dict[ClassName, str] = {}
        """The files of the robot's package, by the full names of their classes."""
        self.users: dict[ClassName, Node] = {}
        """The classes of the user's files, by their full names; of several of one name the first."""
        self.all_users: list[Node] = []
        """The classes of the user's files, in the order of the files."""
        self.unread: list[Path] = []
        """Files of the user that are no Modelica, or not where their class belongs: its classes are unknown."""
        self.libraries = {*STANDARD_LIBRARIES}
        """Libraries that need not be installed: their classes are not looked for."""
        self.seen: dict[ClassName, str | None] = {}
        """The classes that were asked for, and their files; None where there is none."""
        prefix = tuple(package.split("."))
        for path in texts:
            if path.endswith(".mo") and f"/{_NOT_CLASSES}/" not in f"/{path}":
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
                self.all_users.append(Node(definition, name, str(file)))
                self.users.setdefault(name, self.all_users[-1])

    def stored(self, name: ClassName) -> Node | None:
        """Return the class with this full name, `OPAQUE` if it can't be read; None if there is no file of it."""
        file = self.seen[name] = self.file(name)
        if file is None:
            return None
        if name in self.users and name not in self.own:  # another one each time: a node has what was resolved with it
            return Node(self.users[name].definition, name, file)
        try:
            text = self._read(self.content(file))
        except OSError:
            return OPAQUE
        definition = next((definition for definition in text.classes if definition.name.parts[0] == name[-1]), None)
        return OPAQUE if definition is None or text.is_broken else Node(definition, name, file)

    def file(self, name: ClassName) -> str | None:
        """Return the file in which a class is stored; None if there is none."""
        if name in self.own:
            return self.own[name]
        if name in self.users:
            return self.users[name].file
        if any(name[: len(package)] == package for package in self._not_on_disk):
            return None
        # a file that stands in a wrong place may be meant for any package that lacks its class
        path = self._file(name) or next((path for path in self.unread if name[-1] == class_of_file(path)), None)
        return str(path) if path else None

    def content(self, file: str) -> bytes:
        """Return the content of a file. Raises OSError."""
        if (path := self.path_below(file)) in self._texts:
            return self._texts[path]
        other = self._others.get(Path(file))
        return read_file(file) if other is None else other

    def path_below(self, file: str) -> str:
        """Return the path of a file below the robot's package; empty if it is elsewhere."""
        return file.removeprefix(self._below) if file.startswith(self._below) else ""

    def has_library(self, name: str) -> bool:
        """Whether a library need not be at hand: a `uses` annotation around the package, or of the user's, names it."""
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
        """Return the names of classes that are stored below this package; of the empty name, top-level ones."""
        names = {other[len(name)] for other in (*self.users, *self.own) if other[:-1] == name or not name}
        path = self._file(name) if name and name not in self.own else None
        if path is not None and path.name == _PACKAGE:
            for entry in path.parent.iterdir():
                if (entry / _PACKAGE).is_file() or (entry.suffix == ".mo" and entry.name != _PACKAGE):
                    names.add(entry.name.removesuffix(".mo"))
        return names

    def _beside(self, name: str) -> Path | None:
        """Return the folder or file of a top-level class that stands beside one of the user's; None for none."""
        places = (folder / end for folder in self._folders for end in (f"{name}/{_PACKAGE}", f"{name}.mo"))
        file = next((place for place in places if is_file(place)), None)
        return file.parent if file and file.name == _PACKAGE else file

    def _file(self, name: ClassName) -> Path | None:
        """Return the file of a library in which a class is stored."""
        root = self._find(name[0])
        if root is None or root.suffix == ".mo":
            return root if len(name) == 1 else None
        folder = root.joinpath(*name[1:])
        return next((path for path in (folder / _PACKAGE, Path(f"{folder}.mo")) if is_file(path)), None)


class TooManyFoldersError(Exception):
    """There are more folders than may be looked through."""


def modelica_files(
    *folders: Path, others: Collection[str] = (), left_out: Collection[str] = (), most: int | None = None
) -> Iterator[str]:
    """Yield all files of Modelica below folders, each once, but for links, hidden folders and `Resources`.

    Folders below them that hold a file of one of the names `others` are left out as well, and those whose paths are in
    `left_out`. What is looked at is recorded as a dependency. What can't be looked at is left out. Raises
    TooManyFoldersError beyond `most` folders.
    """
    tops, seen = [*map(str, folders)], set[str]()
    waiting = tops[::-1]
    while waiting:
        current = waiting.pop()
        if current in seen:
            continue
        seen.add(current)
        if most is not None and len(seen) > most:
            raise TooManyFoldersError
        inside: list[os.DirEntry[str]] = []
        with contextlib.suppress(OSError):
            inside = sorted(scan_modelica(current), key=lambda entry: entry.name)
        if current not in tops and any(entry.name in others for entry in inside):
            continue
        for entry in inside:
            if entry.name.startswith(".") or entry.name == _NOT_CLASSES:
                continue
            with contextlib.suppress(OSError):  # some file systems do not tell the type with the name
                if entry.is_dir(follow_symlinks=False):
                    waiting += [entry.path] if entry.path not in left_out else []
                elif entry.name.endswith(".mo") and entry.is_file(follow_symlinks=False):
                    yield entry.path


def files_that_use(files: Mapping[Path, bytes], names: Iterable[str]) -> dict[Path, bytes]:
    """Return the files that use one of these names, or the class of another such file, which is called like that file.

    Strings and comments do not count: a library of words about robots is no user.
    """
    users, words, known = dict[Path, bytes](), set(names), set[str]()
    while words:
        known |= words
        for path, content in files.items():  # which may be read only now, each time
            if path not in users and any(_is_used(word, content) for word in words):
                users[path] = content
        words = {*map(class_of_file, users)} - known
    return dict(sorted(users.items()))


def has_word(text: bytes, name: bytes) -> bool:
    """Whether a name stands in a text as a word of its own."""
    return name in text and re.search(rb"\b" + re.escape(name) + rb"\b", text) is not None


def text_of(content: bytes) -> str:
    """Return the text of a file as it is parsed; bytes that are not UTF-8 survive in it."""
    return content.decode(errors="surrogateescape").replace("\r\n", "\n")


def code_of(content: bytes) -> bytes:
    """Return the content of a file without its strings and comments; it need not parse."""
    return _NO_CODE.sub(rb"\1 ", content)


def replace_words(content: bytes, words: Mapping[int, tuple[str, str]]) -> bytes:
    """Replace old words by new ones, by their places in `text_of`; all else stays, byte for byte."""
    text, pieces, end = text_of(content), list[str](), 0
    for start, (old, new) in sorted(words.items()):
        pieces += [text[end:start], new]
        end = start + len(old)
    lines = "".join((*pieces, text[end:])).encode(errors="surrogateescape").split(b"\n")
    ends = (*re.findall(rb"\r?\n", content), b"")
    return b"".join(line + end for line, end in zip(lines, ends, strict=True))


def _is_used(name: str, content: bytes) -> bool:
    word = name.encode(errors="surrogateescape")
    return has_word(content, word) and has_word(code_of(content), word)


def parse_file(content: bytes) -> StoredText:
    """Parse the content of a file."""
    return parse(text_of(content))


def class_of_file(path: Path) -> str:
    """Return the name of the class that a file is for."""
    return path.parent.name if path.name == _PACKAGE else path.stem


def place_of(path: Path, files: Collection[Path]) -> tuple[Path, ClassName]:
    """Return the folder of a file's top-level class, and the name of the package that the file is in by its folders."""
    folder = path.parent.parent if path.name == _PACKAGE else path.parent
    parts: list[str] = []
    while folder / _PACKAGE in files or is_file(folder / _PACKAGE):
        parts.insert(0, folder.name)
        folder = folder.parent
    return folder, tuple(parts)
