"""The texts that urdfsync wrote last, by their hash: kept to merge with, and safe to lose.

`base/<robot>/texts` in the state folder has a line for each: its hash, a blank, and the text as JSON. Lines are added
at the end; when most of them are of no use any more, the file is written anew. A text counts only if its hash is right.
A file for each, as git's loose objects, would take more than the bar of a first build of 100 links has left.
"""

from __future__ import annotations

import contextlib
import errno
from collections.abc import Collection, Mapping
from pathlib import Path

import msgspec

from urdfsync.config import shown
from urdfsync.dependencies import read_unrecorded
from urdfsync.files import TEMPORARY, failure, text_digest
from urdfsync.state import file_operations


class BaseStore:
    """The kept texts of one robot; `folder` need not exist."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._file = folder / "texts"
        self._texts: dict[str, bytes] | None = None

    def __contains__(self, digest: str | None) -> bool:
        """Whether a text is kept under this hash; only `get` checks that it is the right one."""
        return digest in self._read()

    def get(self, digest: str) -> str | None:
        """The text with this hash (see `text_digest`), None if it is not kept."""
        try:  # it may be a stranger's, who has committed it
            text = msgspec.json.decode(self._read().get(digest, b"null"), type=str | None)
            return text if text is not None and text_digest(text.encode()) == digest else None
        except (msgspec.DecodeError, UnicodeError):
            return None

    def add(self, texts: Mapping[str, str]) -> None:
        """Keep texts by their hashes. Raises OutputError.

        Nothing is synced: what a power failure takes is rendered again, or its file conflicts.
        """
        new = {digest: msgspec.json.encode(text) for digest, text in texts.items() if digest not in self}
        if not new:
            return
        try:
            self._check_links()
            for folder in (self._folder.parent.parent, self._folder.parent, self._folder):
                file_operations.make_folder(folder)
            file_operations.append(self._file, b"\n" + _lines(new))  # the last line may have been cut off
        except OSError as error:
            raise failure(error, shown(self._folder)) from None
        self._read().update(new)

    def prune(self, wanted: Collection[str]) -> None:
        """Remove all other texts, once they are more than the wanted ones. What can't be removed stays."""
        left = {digest: text for digest, text in self._read().items() if digest in wanted}
        if left and 2 * len(left) >= len(self._read()):
            return
        temporary = self._folder / f".texts{TEMPORARY}"
        with contextlib.suppress(OSError):
            self._check_links()
            file_operations.remove(temporary)  # of a build that was killed here
            if left:
                file_operations.write(temporary, _lines(left))
                file_operations.replace(temporary, self._file)
            else:
                file_operations.remove(self._file)
                file_operations.remove_folder(self._folder)
        self._texts = None

    def _read(self) -> dict[str, bytes]:
        """The texts as JSON, by their hashes."""
        if self._texts is None:
            self._texts = {}
            with contextlib.suppress(OSError):  # there is none, or it can't be read: then nothing is kept
                self._check_links()
                for line in read_unrecorded(self._file).split(b"\n")[:-1]:
                    digest, _, text = line.partition(b" ")
                    self._texts[digest.decode(errors="replace")] = text
        return self._texts

    def _check_links(self) -> None:
        """Refuse to go through a link. Raises OSError."""
        for path in (self._folder.parent.parent, self._folder.parent, self._folder, self._file):
            if path.is_symlink():
                raise NotADirectoryError(errno.ENOTDIR, "a symbolic link is where a folder is needed", str(path))


def _lines(texts: Mapping[str, bytes]) -> bytes:
    return b"".join(b"%s %s\n" % (digest.encode(), text) for digest, text in texts.items())
