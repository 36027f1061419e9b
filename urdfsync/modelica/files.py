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

from urdfsync.dependencies import scan_folder
from urdfsync.modelica.classes import OPAQUE, Node
from urdfsync.modelica.lexer import lex
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
        self._find = functools.cache(lambda name: find(name) or self._beside(name))
        self._folders: dict[Path, None] = {}
        self._not_on_disk = [tuple(name.split(".")) for name in (package, gone) if name]
        self.own: dict[ClassName, tuple[bytes, Path]] = {}
        """The files of the robot's package by the full names of their classes."""
        self.users: dict[ClassName, Node] = {}
        """The classes of the user's files, by their full names; of several of one name the first."""
        self.all_users: list[Node] = []
        """The classes of the user's files, in the order of the files."""
        self.unread: list[Path] = []
        """Files of the user that are no Modelica, or not where their class belongs: its classes are unknown."""
        for path, content in texts.items():
            place = PurePosixPath(path)
            if path.endswith(".mo") and _NOT_CLASSES not in place.parent.parts:
                self.own[(*package.split("."), *class_path(place).parts)] = content, folder / path
        for file, content in others.items():
            found = _parsed(content)
            around = tuple(found.within.split(".")) if found.within else ()
            folder_around, expected = _place(file, others)
            self._folders[folder_around] = None
            if found.is_broken or (expected and around != expected):
                self.unread.append(file)
                continue
            for one in found.classes:
                name = (*around, one.name.parts[0])
                self.all_users.append(Node(one, name, str(file)))
                self.users.setdefault(name, self.all_users[-1])

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

    def _beside(self, name: str) -> Path | None:
        """Return the folder or file of a top-level class that stands beside one of the user's; None for none."""
        places = (folder / end for folder in self._folders for end in (f"{name}/{_PACKAGE}", f"{name}.mo"))
        found = next((place for place in places if place.is_file()), None)
        return found.parent if found and found.name == _PACKAGE else found

    def _file(self, name: ClassName) -> Path | None:
        """Return the file of a library in which a class is stored."""
        root = self._find(name[0])
        if root is None or root.suffix == ".mo":
            return root if len(name) == 1 else None
        folder = root.joinpath(*name[1:])
        return next((path for path in (folder / _PACKAGE, Path(f"{folder}.mo")) if path.is_file()), None)


def modelica_files(folder: Path, others: Collection[str] = ()) -> Iterator[str]:
    """Yield all files of Modelica below a folder, but for links, hidden folders and `Resources`.

    Folders below it that hold a file of one of the names `others` are left out as well. What is looked at is recorded
    as a dependency. What can't be looked at is left out.
    """
    waiting = [str(folder)]
    while waiting:
        current = waiting.pop()
        inside: list[os.DirEntry[str]] = []
        with contextlib.suppress(OSError):
            inside = sorted(scan_folder(current), key=lambda entry: entry.name)
        if current != str(folder) and any(entry.name in others for entry in inside):
            continue
        for entry in inside:
            if entry.name.startswith(".") or entry.name == _NOT_CLASSES:
                continue
            with contextlib.suppress(OSError):  # some file systems do not tell the type with the name
                if entry.is_dir(follow_symlinks=False):
                    waiting.append(entry.path)
                elif entry.name.endswith(".mo") and entry.is_file(follow_symlinks=False):
                    yield entry.path


def files_that_use(files: Mapping[Path, bytes], names: Iterable[str]) -> dict[Path, bytes]:
    """The files that use one of these names, or the class of another such file, which is called like that file.

    Strings and comments do not count: a library of words about robots is no user.
    """
    waiting, unused, found = dict(files), list(names), {}
    while unused:
        word = unused.pop()
        for path in [path for path, content in waiting.items() if _is_used(word, content)]:
            found[path] = waiting.pop(path)
            unused.append(_class_name(path))
    return dict(sorted(found.items()))


def has_word(text: bytes, name: bytes) -> bool:
    """Whether a name stands in a text as a word of its own."""
    return name in text and re.search(rb"\b" + re.escape(name) + rb"\b", text) is not None


def text_of(content: bytes) -> str:
    """The text of a file as it is parsed; bytes that are not UTF-8 survive in it."""
    return content.decode(errors="surrogateescape").replace("\r\n", "\n")


def replace_words(content: bytes, words: Mapping[int, tuple[str, str]]) -> bytes:
    """Replace old words by new ones, by where they begin in `text_of`; all else stays, byte for byte."""
    text, pieces, end = text_of(content), list[str](), 0
    for start, (old, new) in sorted(words.items()):
        pieces += [text[end:start], new]
        end = start + len(old)
    lines = "".join((*pieces, text[end:])).encode(errors="surrogateescape").split(b"\n")
    ends = (*re.findall(rb"\r?\n", content), b"")
    return b"".join(line + end for line, end in zip(lines, ends, strict=True))


def _is_used(name: str, content: bytes) -> bool:
    return has_word(content, name.encode()) and any(token.text == name for token in lex(text_of(content))[0])


def _parsed(content: bytes) -> StoredText:
    return parse(text_of(content))


def _class_in(content: bytes, file: Path, name: ClassName) -> Node:
    found = _parsed(content)
    definition = next((one for one in found.classes if one.name.parts[0] == name[-1]), None)
    return OPAQUE if definition is None or found.is_broken else Node(definition, name, str(file))


def _class_name(path: Path) -> str:
    """The name of the class that a file is for."""
    return path.parent.name if path.name == _PACKAGE else path.stem


def _place(path: Path, files: Mapping[Path, bytes]) -> tuple[Path, ClassName]:
    """Return the folder of a file's top-level class, and the name of the package that the file is in by its folders."""
    folder = path.parent.parent if path.name == _PACKAGE else path.parent
    parts: list[str] = []
    while folder / _PACKAGE in files or (folder / _PACKAGE).is_file():
        parts.insert(0, folder.name)
        folder = folder.parent
    return folder, tuple(parts)
