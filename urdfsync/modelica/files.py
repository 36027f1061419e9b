"""Finds files of Modelica, the class of each, and the words in them, without parsing."""

from __future__ import annotations

import contextlib
import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import TypeAlias

from urdfsync.answers.dependencies import is_file, scan_modelica

ClassName: TypeAlias = tuple[str, ...]
PACKAGE_FILE = "package.mo"
NOT_CLASSES = "Resources"
_NO_CODE = re.compile(rb"('(?:[^'\\\n]|\\.)*')|\"(?:[^\"\\]|\\.)*\"|//[^\n]*|/\*.*?\*/", re.DOTALL)
"""Matches strings and comments. Quoted names may look like these: they match as a group."""


def class_path(file: PurePosixPath) -> PurePosixPath:
    """Return the path of a stored class, without suffix; for a `package.mo`, the path of its folder."""
    return file.parent if file.name == PACKAGE_FILE else file.with_suffix("")


def class_parts(path: str) -> tuple[str, ...]:
    """Return the name of a file's class, from its POSIX path below the package."""
    return tuple(path.removesuffix(".mo").removesuffix("/package").split("/")) if path != PACKAGE_FILE else ()


class TooManyFoldersError(Exception):
    """There are too many folders to search."""


def modelica_files(
    *folders: Path, others: Collection[str] = (), left_out: Collection[str] = (), most: int | None = None
) -> Iterator[str]:
    """Yield all Modelica files below folders, each once; links, hidden folders and `Resources` are left out.

    A folder below them is also left out if it holds a file with a name in `others`, or if it is in `left_out`. All
    files and folders that are read are recorded as dependencies. Unreadable folders are left out. Raises
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
            if entry.name.startswith(".") or entry.name == NOT_CLASSES:
                continue
            with contextlib.suppress(OSError):  # some file systems list no types
                if entry.is_dir(follow_symlinks=False):
                    waiting += [entry.path] if entry.path not in left_out else []
                elif entry.name.endswith(".mo") and entry.is_file(follow_symlinks=False):
                    yield entry.path


def files_that_use(files: Mapping[Path, bytes], names: Iterable[str]) -> dict[Path, bytes]:
    """Return the files that use one of these names, or the class of another such file.

    A file is named like its class. Strings and comments do not count: a documentation may mention a name.
    """
    users, words, known = dict[Path, bytes](), set(names), set[str]()
    while words:
        known |= words
        for path, content in files.items():  # contents may be read lazily
            if path not in users and any(_is_used(word, content) for word in words):
                users[path] = content
        words = {*map(class_of_file, users)} - known
    return dict(sorted(users.items()))


def has_word(text: bytes, name: bytes) -> bool:
    """Whether a name stands in a text as a word of its own."""
    return name in text and re.search(rb"\b" + re.escape(name) + rb"\b", text) is not None


def text_of(content: bytes) -> str:
    """Return the text of a file for parsing; it keeps bytes that are not UTF-8."""
    return content.decode(errors="surrogateescape").replace("\r\n", "\n")


def code_of(content: bytes) -> bytes:
    """Return the content of a file without its strings and comments; it need not parse."""
    return _NO_CODE.sub(rb"\1 ", content)


def _is_used(name: str, content: bytes) -> bool:
    word = name.encode(errors="surrogateescape")
    return has_word(content, word) and has_word(code_of(content), word)


def class_of_file(path: Path) -> str:
    """Return the name of a file's class."""
    return path.parent.name if path.name == PACKAGE_FILE else path.stem


def place_of(path: Path, files: Collection[Path]) -> tuple[Path, ClassName]:
    """Return the folder that holds a file's top-level class, and the full name of the package around it."""
    folder = path.parent.parent if path.name == PACKAGE_FILE else path.parent
    parts: list[str] = []
    while folder / PACKAGE_FILE in files or is_file(folder / PACKAGE_FILE):
        parts.insert(0, folder.name)
        folder = folder.parent
    return folder, tuple(parts)
