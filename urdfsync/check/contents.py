"""What a folder or a file contains, in one hash: results are remembered by contents, never by sizes and times."""

from __future__ import annotations

import errno
import hashlib
import os
from collections.abc import Iterator
from pathlib import Path

_PIECE = 2**20


def content_hash(root: Path) -> str:
    """Return the SHA-256 (hex) over a file, or over the names and contents of all files below a folder.

    Hidden files and Python's caches are left out. What can't be read counts as such: a compiler can't read it either.
    Raises OSError for a link to a folder below, which may lead anywhere: what is behind it is not looked at.
    """
    top = os.path.realpath(root)
    found = hashlib.sha256()
    for path in _files(top) if os.path.isdir(top) else [top]:  # noqa: PTH112 - 3,000 files: strings halve the time
        found.update(f"{path[len(top) :]}\0{_file_hash(path)}\n".encode(errors="surrogateescape"))
    return found.hexdigest()


def _files(folder: str) -> Iterator[str]:
    """Yield the files below a folder, in the order of their names; a folder that can't be read has none."""
    try:
        with os.scandir(folder) as entries:
            inside = sorted(entries, key=lambda entry: entry.name)
    except OSError:
        return
    for entry in inside:
        if entry.name.startswith(".") or entry.name == "__pycache__":
            continue
        if not entry.is_dir():
            yield entry.path
        elif entry.is_symlink():
            raise OSError(errno.ELOOP, "it is a link to a folder", entry.path)
        else:
            yield from _files(entry.path)


def _file_hash(path: str) -> str:
    found = hashlib.sha256()
    try:
        if not os.path.isfile(path):  # noqa: PTH113 - a pipe or a device would never end
            return ""
        with open(path, "rb") as file:  # noqa: PTH123
            while piece := file.read(_PIECE):
                found.update(piece)
    except OSError:
        return ""
    return found.hexdigest()
