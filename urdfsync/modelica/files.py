"""Finds Modelica files, their classes, and the words in these files, without parsing."""

from __future__ import annotations

import contextlib
import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import TypeAlias

from urdfsync.common.dependencies.facts import MODELICA
from urdfsync.common.dependencies.reads import is_file, scan_folder

ClassName: TypeAlias = tuple[str, ...]
PACKAGE_FILE = "package.mo"
NOT_CLASSES = "Resources"
_NO_CODE = re.compile(rb"('(?:[^'\\\n]|\\.)*+'?)|\"(?:[^\"\\]|\\.)*+(?:\"|\\?\Z)|//[^\n]*+|/\*.*?(?:\*/|\Z)", re.DOTALL)
"""Matches strings and comments. A quoted name may contain what looks like a comment, so quoted names match, too: as a
group."""


def class_path(file: PurePosixPath) -> PurePosixPath:
    """Return the path of a class's file without suffix; for a `package.mo`, the path of its folder."""
    return file.parent if file.name == PACKAGE_FILE else file.with_suffix("")


def as_file(path: str) -> str:
    """Return the path of a class's file, or the path that it would have if the class is a folder."""
    return f"{path.removesuffix('/package.mo').removesuffix('.mo')}.mo"


def class_parts(path: str) -> tuple[str, ...]:
    """Return the name of a file's class, from its POSIX path below the package."""
    return tuple(path.removesuffix(".mo").removesuffix("/package").split("/")) if path != PACKAGE_FILE else ()


class TooManyFoldersError(Exception):
    """There are too many folders to search."""


def modelica_files(
    *folders: Path, others: Collection[str] = (), left_out: Collection[str] = (), most: int | None = None
) -> Iterator[str]:
    """Yield all Modelica files below folders, each once; links, hidden folders and `Resources` are left out.

    Folders in `left_out`, and folders with a file of a name in `others`, are left out, too. Everything that this reads
    is recorded as a dependency. Unreadable folders are left out. Raises TooManyFoldersError beyond `most` folders.
    """
    tops, seen, names_left_out = [*map(str, folders)], set[str](), dict[str, list[str]]()
    for path in sorted(left_out):
        around, name = os.path.split(path)
        names_left_out.setdefault(around, []).append(name)
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
            kind = "/".join((MODELICA, *names_left_out.get(current, ())))
            inside = sorted(scan_folder(current, kind), key=lambda entry: entry.name)
        if current not in tops and any(entry.name in others for entry in inside):
            continue
        for entry in inside:
            if entry.name.startswith(".") or entry.name == NOT_CLASSES:
                continue
            with contextlib.suppress(OSError):  # some file systems list no types
                path = os.path.join(current, entry.name)  # noqa: PTH118 - strings: there are thousands
                if entry.is_dir(follow_symlinks=False):
                    waiting += [path] if path not in left_out else []
                elif entry.name.endswith(".mo") and entry.is_file(follow_symlinks=False):
                    yield path


def files_that_use(files: Mapping[Path, bytes], names: Iterable[str]) -> dict[Path, bytes]:
    """Return the files that use one of these names, or the class of another file in the result.

    A class has the name of its file. Strings and comments do not count: a documentation may mention a name.
    """
    users, words, known = dict[Path, bytes](), set(names), set[str]()
    while words:
        known |= words
        for path, content in files.items():  # this may read contents on demand
            if path not in users and any(_is_used(word, content) for word in words):
                users[path] = content
        words = {*map(class_of_file, users)} - known
    return dict(sorted(users.items()))


def has_word(text: bytes, name: bytes) -> bool:
    """Whether a text contains a name as a whole word."""
    return name in text and re.search(rb"\b" + re.escape(name) + rb"\b", text) is not None


def text_of(content: bytes) -> str:
    """Return the text of a file for parsing; bytes that are not UTF-8 stay (as surrogates)."""
    return content.decode(errors="surrogateescape").replace("\r\n", "\n")


def code_of(content: bytes) -> bytes:
    """Return the content of a file without strings and comments; the file may have syntax errors."""
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
