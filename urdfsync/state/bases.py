"""The texts that urdfsync wrote last, by their hash: kept to merge with, and safe to lose.

`base/<robot>/texts` in the state folder has a line for each: its hash, a blank, and the text as JSON. Lines are added
at the end; when most of them are of no use any more, the file is written anew. A text counts only if its hash is right.
A file for each, as git's loose objects, would take more than the bar of a first build of 100 links has left.
"""

from __future__ import annotations

import contextlib
import errno
import itertools
import re
import stat
from collections.abc import Collection, Mapping
from pathlib import Path

import msgspec

from urdfsync.dependencies import file_type, read_file
from urdfsync.files import TEMPORARY, failure, text_digest
from urdfsync.state import file_operations

_LINE = rb"(?m)^([0-9a-f]{64}) (.*)\n"


class BaseStore:
    """The kept texts of one robot; `folder` need not exist."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._file = folder / "texts"
        self._content: bytes | None = None
        self._places: dict[str, slice] = {}
        """Where the texts are in the content, by their hashes."""
        self._added: set[str] = set()
        """Hashes of texts that have come since the content was read."""

    def __contains__(self, digest: str | None) -> bool:
        """Whether a text is kept under this hash; only `get` checks that it is the right one."""
        self._read()
        return digest in self._places or digest in self._added

    def get(self, digest: str) -> str | None:
        """The text with this hash (see `text_digest`), None if it is not kept."""
        if digest in self._added:
            self._content = None
        content = self._read()
        try:  # it may be a stranger's, who has committed it
            text = msgspec.json.decode(content[self._places[digest]], type=str)
            return text if text_digest(text.encode()) == digest else None
        except (KeyError, msgspec.DecodeError, UnicodeError):
            return None

    def add(self, texts: Mapping[str, str]) -> None:
        """Keep texts by their hashes. Raises OutputError.

        Nothing is synced: what a power failure takes is rendered again, or its file conflicts.
        """
        new = {digest: text for digest, text in texts.items() if digest not in self}
        if not new:
            return
        lines = (_line(digest, msgspec.json.encode(text)) for digest, text in new.items())
        try:
            self._check_links()
            for folder in (self._folder.parent.parent, self._folder.parent, self._folder):
                file_operations.make_folder(folder)
            file_operations.append(self._file, itertools.chain([b"\n"], lines))  # the last line may have been cut off
        except OSError as error:
            raise failure(error, self._folder) from None
        self._added |= new.keys()

    def prune(self, wanted: Collection[str]) -> None:
        """Remove all other texts, once they are more than the wanted ones. What can't be removed stays."""
        self._read()
        kept = self._places.keys() | self._added
        if 0 < len(kept) <= 2 * len(kept.intersection(wanted)):
            return
        temporary, self._content = self._folder / f".texts{TEMPORARY}", None
        content = self._read()
        left = [_line(digest, content[place]) for digest, place in self._places.items() if digest in wanted]
        with contextlib.suppress(OSError):
            self._check_links()
            file_operations.remove(temporary)  # of a build that was killed here
            if left:
                file_operations.append(temporary, left)
                file_operations.replace(temporary, self._file)
            else:
                file_operations.remove(self._file)
                file_operations.remove_folder(self._folder)
        self._content = None

    def _read(self) -> bytes:
        """Read the file, once. There may be none, or one that can't be read: then nothing is kept."""
        if self._content is None:
            self._content = b""
            with contextlib.suppress(OSError):
                self._check_links()
                self._content = read_file(self._file)
            self._places = {line[1].decode(): slice(*line.span(2)) for line in re.finditer(_LINE, self._content)}
            self._added.clear()
        return self._content

    def _check_links(self) -> None:
        """Refuse to go through a link. Raises OSError."""
        for path in (self._folder.parent.parent, self._folder.parent, self._folder, self._file):
            if stat.S_ISLNK(file_type(path, follow=False)):
                raise NotADirectoryError(errno.ENOTDIR, "a symbolic link is where a folder is needed", str(path))


def _line(digest: str, text: bytes) -> bytes:
    return b"%s %s\n" % (digest.encode(), text)
