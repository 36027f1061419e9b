"""Compiled templates, kept in the user's cache folder: compiling one takes longer than rendering it a hundred times.

What is kept counts only for the very text, Python, Jinja and filters that it was made of, and only if it is whole.
Whatever is wrong with the folder or with a file in it, the template is compiled again.
"""

from __future__ import annotations

import contextlib
import hashlib
import importlib.util
import marshal
import os
import sys
from pathlib import Path

import jinja2
from jinja2 import bccache

from urdfsync.files import put
from urdfsync.modelica import literals

_SIZE = hashlib.sha256().digest_size


def of_user() -> Bytecode | None:
    """The compiled templates of this user; None if there is no place for them that is the user's own."""
    base = _base()
    if base is None or not base.is_absolute():
        return None
    folder = base / "urdfsync" / ("Cache" if sys.platform == "win32" else "") / "templates"
    return Bytecode(folder) if _is_own(folder) else None


class Bytecode(bccache.BytecodeCache):
    """The compiled templates in a folder, which need not exist; several processes may use it at once."""

    def __init__(self, folder: Path) -> None:
        self._folder = str(folder)
        self._maker = _maker()

    def load_bytecode(self, bucket: bccache.Bucket) -> None:
        """Give the bucket its code, if that is kept."""
        try:
            with open(self._file(bucket), "rb") as file:  # noqa: PTH123 - without a Path for each template
                content = file.read()
        except OSError:
            return
        if content[:_SIZE] == self._seal(bucket, content[_SIZE:]):
            bucket.code = marshal.loads(content[_SIZE:])  # noqa: S302 - a file of the user's own, and whole

    def dump_bytecode(self, bucket: bccache.Bucket) -> None:
        """Keep the bucket's code, if that is possible."""
        code, file = marshal.dumps(bucket.code), Path(self._file(bucket))
        with contextlib.suppress(OSError):  # a cache that can't be written to is none
            file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            put(file, self._seal(bucket, code) + code)

    def _file(self, bucket: bccache.Bucket) -> str:
        return f"{self._folder}{os.sep}{bucket.key}"

    def _seal(self, bucket: bccache.Bucket, code: bytes) -> bytes:
        """What a file begins with if this code is right for the bucket."""
        return hashlib.sha256(b"%s\0%s\0%s" % (self._maker, bucket.checksum.encode(), code)).digest()


def _maker() -> bytes:
    """What turns a template into code, beside its text: Python, Jinja, the delimiters, and the filters."""
    files = [literals.__file__, str(Path(__file__).with_name("render.py")), jinja2.__file__]
    stats = [os.stat(file) for file in files]  # noqa: PTH116
    facts = [f"{file} {status.st_size} {status.st_mtime_ns}" for file, status in zip(files, stats, strict=True)]
    return "\0".join([importlib.util.MAGIC_NUMBER.hex(), sys.version, *facts]).encode()


def _base() -> Path | None:
    """The folder for caches of all programs, as `platformdirs` would name it, which is an optional extra."""
    if sys.platform == "win32":
        return Path(place) if (place := os.environ.get("LOCALAPPDATA")) else None
    if place := os.environ.get("XDG_CACHE_HOME", "").strip():
        return Path(place)
    return Path(os.path.expanduser("~")) / ("Library/Caches" if sys.platform == "darwin" else ".cache")  # noqa: PTH111


def _is_own(folder: Path) -> bool:
    """Whether nobody but this user can have written to a folder, or to the first above it that exists."""
    if not hasattr(os, "getuid"):
        return True  # there, other users can't write to it anyway
    for place in (folder, *folder.parents):
        with contextlib.suppress(FileNotFoundError):
            try:
                status = place.stat()
            except (NotADirectoryError, PermissionError):
                return False
            return status.st_uid == os.getuid() and not status.st_mode & 0o002
    return False
