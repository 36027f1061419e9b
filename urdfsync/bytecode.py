"""Compiled templates, kept in the user's cache folder: compiling one takes longer than rendering it a hundred times.

What is kept counts only for the very text, Python, Jinja, filters and sandbox that it was made of, and only if it is
whole. It is code that is run, so nobody but this user may be able to write to it, or to a folder around it.
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
    folders = [base, base / "urdfsync", base / "urdfsync" / ("Cache" if sys.platform == "win32" else "") / "templates"]
    with contextlib.suppress(OSError):
        for folder in folders:
            folder.mkdir(mode=0o700, exist_ok=True)
        if all(_is_own(folder.stat()) for folder in folders):
            return Bytecode(folders[-1])
    return None


class Bytecode(bccache.BytecodeCache):
    """The compiled templates in a folder; several processes may use it at once."""

    def __init__(self, folder: Path) -> None:
        self._folder = str(folder)
        self._maker = _maker()

    def load_bytecode(self, bucket: bccache.Bucket) -> None:
        """Give the bucket its code, if that is kept."""
        try:
            with open(self._file(bucket), "rb") as file:  # noqa: PTH123 - without a Path for each template
                content = file.read() if _is_own(os.fstat(file.fileno())) else b""
        except OSError:
            return
        if content[:_SIZE] == self._seal(bucket, content[_SIZE:]):
            bucket.code = marshal.loads(content[_SIZE:])  # noqa: S302 - a file of the user's own, and whole

    def dump_bytecode(self, bucket: bccache.Bucket) -> None:
        """Keep the bucket's code, if that is possible."""
        code, file = marshal.dumps(bucket.code), Path(self._file(bucket))
        with contextlib.suppress(OSError):  # a cache that can't be written to is none
            put(file, self._seal(bucket, code) + code)

    def _file(self, bucket: bccache.Bucket) -> str:
        return f"{self._folder}{os.sep}{bucket.key}"

    def _seal(self, bucket: bccache.Bucket, code: bytes) -> bytes:
        """What a file begins with if this code is right for the bucket."""
        facts = self._maker, _sandbox(bucket.environment), bucket.checksum.encode(), code
        return hashlib.sha256(b"\0".join(facts)).digest()


def _maker() -> bytes:
    """What turns a template into code, beside its text: Python, Jinja, the delimiters, and the filters."""
    files = [literals.__file__, str(Path(__file__).with_name("render.py")), jinja2.__file__]
    stats = [os.stat(file) for file in files]  # noqa: PTH116
    facts = [f"{file} {status.st_size} {status.st_mtime_ns}" for file, status in zip(files, stats, strict=True)]
    return "\0".join([importlib.util.MAGIC_NUMBER.hex(), sys.version, *facts]).encode()


def _sandbox(environment: jinja2.Environment) -> bytes:
    """What an environment compiles calls, loops and operators to: code for another one might go round the sandbox."""
    operators = sorted(getattr(environment, "intercepted_binops", ()))
    kinds = type(environment), environment.code_generator_class
    return repr((environment.sandboxed, [f"{one.__module__}.{one.__qualname__}" for one in kinds], operators)).encode()


def _base() -> Path | None:
    """The folder for caches of all programs, as `platformdirs` would name it, which is an optional extra."""
    if sys.platform == "win32":
        return Path(place) if (place := os.environ.get("LOCALAPPDATA")) else None
    if place := os.environ.get("XDG_CACHE_HOME", "").strip():
        return Path(place)
    return Path(os.path.expanduser("~")) / ("Library/Caches" if sys.platform == "darwin" else ".cache")  # noqa: PTH111


def _is_own(status: os.stat_result) -> bool:
    """Whether nobody but this user can write to a file or folder."""
    if not hasattr(os, "getuid"):
        return True  # there, other users can't write to it anyway
    return status.st_uid == os.getuid() and not status.st_mode & 0o022
