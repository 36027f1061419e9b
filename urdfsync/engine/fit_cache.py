"""What is known of texts by their hashes: interfaces of files, and which files fit what they use.

Losing it changes no finding (tests/engine/test_fit.py). It serves the row "one mass changed, robot model edited" of
docs/speed.md: a robot model of 1,000 links uses 2,000 classes, which take 5 s to parse and whose names take 2 s to
resolve.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

import msgspec

import urdfsync
from urdfsync.files import digest, put, text_digest
from urdfsync.modelica.files import parse_file
from urdfsync.modelica.interfaces import decode_interface, encode_interface, interface_digest
from urdfsync.modelica.syntax import StoredText

T = TypeVar("T")

_MOST = 20_000
"""Interfaces that are kept."""


class Source(msgspec.Struct, frozen=True, array_like=True):
    """The file of a class, as others see it."""

    text: str
    """Hash of its text."""
    interface: str
    """Hash of its interface."""


class Fit(msgspec.Struct, frozen=True, array_like=True):
    """What a file rests on in which every name means something."""

    key: str
    """Hash of its text and of where it belongs."""
    uses: Mapping[str, Source | None]
    """The classes that were looked for, by their full names; None for those that are not there."""


class FitCache:
    """What is known of the files that one robot's package uses."""

    def __init__(self, folder: Path, robot: str) -> None:
        """`folder` is the configuration's. What is known lies in the user's cache folder: no repository brings it."""
        self._name = digest(f"{folder}\0{robot}\0{_program()}".encode(errors="surrogateescape"))
        self._parsed = dict[str, StoredText]()
        """Interfaces, and whole texts of files that are looked at, by the hashes of the texts."""
        self._used, self._is_new = set[str](), False
        self.fits = dict[str, Fit]()
        """Files that fit, as far as they were looked at."""

    @functools.cached_property
    def known_fits(self) -> dict[str, Fit]:
        """The files that fitted when they were looked at last."""
        return _load(self._file(), dict[str, Fit]) or {}

    @functools.cached_property
    def _interfaces(self) -> dict[str, bytes]:
        return _load(self._file("interfaces"), dict[str, bytes]) or {}

    def _file(self, suffix: str = "fits") -> Path:
        import platformdirs  # 4 ms; most packages are not edited

        return platformdirs.user_cache_path("urdfsync", appauthor=False) / "fits" / f"{self._name}.{suffix}"

    def read(self, content: bytes) -> StoredText:
        """Return the interface of a file; all of it if it was read by `parse`."""
        sha256 = text_digest(content)
        if sha256 not in self._parsed:
            self._parsed[sha256] = decode_interface(self._interface(sha256, content))
        return self._parsed[sha256]

    def parse(self, content: bytes) -> StoredText:
        """Return all of a file; `read` gives that from now on."""
        found = self._parsed[text_digest(content)] = parse_file(content)
        return found

    def source(self, content: bytes) -> Source:
        """Return the hashes of a file."""
        sha256 = text_digest(content)
        return Source(sha256, interface_digest(self._interface(sha256, content)))

    def interface(self, content: bytes) -> StoredText:
        """Return the interface of a file."""
        return decode_interface(self._interface(text_digest(content), content))

    def _interface(self, sha256: str, content: bytes) -> bytes:
        self._used.add(sha256)
        if sha256 not in self._interfaces:
            self._interfaces[sha256] = encode_interface(self._parsed.get(sha256) or parse_file(content))
            self._is_new = True
        return self._interfaces[sha256]

    def save(self) -> None:
        """Write what is new. If it cannot be written, it is found out again."""
        with contextlib.suppress(OSError, UnicodeEncodeError):  # the latter for a path that is not UTF-8
            if self.fits != self.known_fits:
                _save(self._file(), self.fits)
            if self._is_new:
                kept = self._interfaces
                if len(kept) > _MOST:
                    kept = {sha256: one for sha256, one in kept.items() if sha256 in self._used}
                _save(self._file("interfaces"), kept)


@functools.cache
def _program() -> str:
    """Return a hash of what makes the findings."""
    package, found = Path(urdfsync.__file__).parent, hashlib.sha256()
    for path in sorted([*package.glob("modelica/*.py"), *package.glob("engine/fit*.py")]):
        found.update(path.read_bytes())
    return found.hexdigest()


def _load(file: Path, kind: type[T]) -> T | None:
    try:
        return msgspec.msgpack.decode(file.read_bytes(), type=kind)
    except (OSError, ValueError):
        return None


def _save(file: Path, value: Any) -> None:
    file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    put(file, msgspec.msgpack.encode(value))
