"""The texts that urdfsync wrote last, by their hash: kept to merge with, and safe to lose.

Like git's loose objects, but as plain text: `base/<robot>/<hash>` in the state folder. A text counts only if its hash
is right. Most have less than a block of the disk, so that compressing them would save nothing.
"""

from __future__ import annotations

import contextlib
import errno
import os
import stat
from collections.abc import Collection, Mapping
from pathlib import Path

from urdfsync.config import shown
from urdfsync.dependencies import list_folder, read_unrecorded
from urdfsync.files import TEMPORARY, failure, text_digest
from urdfsync.state import file_operations


class BaseStore:
    """The kept texts of one robot; `folder` need not exist."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._names: set[str] | None = None

    def __contains__(self, digest: str | None) -> bool:
        """Whether a text is kept under this hash; only `get` checks that it is the right one."""
        if self._names is None:
            self._names = set()
            with contextlib.suppress(OSError):  # there is none, or it can't be read: then nothing is kept
                self._check_links()
                self._names.update(list_folder(self._folder))
        return digest in self._names

    def get(self, digest: str) -> str | None:
        """The text with this hash (see `text_digest`), None if it is not kept."""
        if digest not in self:
            return None
        path = self._folder / digest
        try:  # it may be a stranger's, who has committed it
            content = read_unrecorded(path) if stat.S_ISREG(path.lstat().st_mode) else b""
            return content.decode() if text_digest(content) == digest else None
        except (OSError, UnicodeDecodeError):
            return None

    def add(self, texts: Mapping[str, str]) -> None:
        """Keep texts by their hashes. Raises OutputError.

        Nothing is synced: what a power failure takes is rendered again, or its file conflicts.
        """
        new = {digest: text for digest, text in texts.items() if digest not in self}
        if not new:
            return
        temporary = self._folder / f".{os.urandom(8).hex()}{TEMPORARY}"
        try:
            self._check_links()
            for folder in (self._folder.parent.parent, self._folder.parent, self._folder):
                file_operations.make_folder(folder)
            for digest, text in new.items():
                file_operations.write(temporary, text.encode())
                os.replace(temporary, f"{self._folder}{os.sep}{digest}")  # noqa: PTH105 - thousands
        except OSError as error:
            with contextlib.suppress(OSError):
                temporary.unlink()
            raise failure(error, shown(self._folder)) from None
        self._names = None

    def prune(self, wanted: Collection[str]) -> None:
        """Remove all other texts. What can't be removed stays."""
        self._names = None
        with contextlib.suppress(OSError):
            self._check_links()
            for name in set(os.listdir(self._folder)) - set(wanted):  # noqa: PTH208 - thousands
                (self._folder / name).unlink()
        if not wanted:
            file_operations.remove_folder(self._folder)

    def _check_links(self) -> None:
        """Refuse to go through a link. Raises OSError."""
        for folder in (self._folder.parent.parent, self._folder.parent, self._folder):
            if folder.is_symlink():
                raise NotADirectoryError(errno.ENOTDIR, "a symbolic link is where a folder is needed", str(folder))
