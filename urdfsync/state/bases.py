"""The texts that urdfsync wrote last, by their hash: kept to merge with, and safe to lose.

One file per robot, `.urdfsync/base/<robot>.json.gz`, of parts that are JSON each and compressed by themselves: texts of
one package resemble each other, so little is left of them. A build adds a part with what is new. Texts that are needed
no more stay until the parts have become as large again as the first one. A text counts only if its hash is right.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterable, Iterator, Mapping
from typing import Self

import msgspec

from urdfsync.manifest import text_hash

_GZIP = 16 + zlib.MAX_WBITS
_FAST = 1
_MOST = 64
"""Parts of one file."""


class Bases:
    """The kept texts of one robot."""

    def __init__(
        self, texts: Mapping[str, str | msgspec.Raw], content: bytes = b"", parts: tuple[int, ...] = ()
    ) -> None:
        """`texts` are strings, or JSON of such; `content` is the file's, and `parts` says how long (bytes) each is."""
        self._texts, self._parts = texts, parts
        self.content = content

    @classmethod
    def loads(cls, content: bytes) -> Self:
        """The texts in a file's content; none if that is lost or damaged."""
        texts: dict[str, str | msgspec.Raw] = {}
        parts = []
        try:
            for size, part in _parts(content):
                texts |= msgspec.json.decode(part, type=dict[str, msgspec.Raw])
                parts.append(size)
        except (zlib.error, msgspec.DecodeError, UnicodeDecodeError, RecursionError):
            return cls({})  # what is missing is rendered again, see `outputs`
        return cls(texts, content, tuple(parts))

    def __contains__(self, digest: str | None) -> bool:
        """Whether a text is kept under this hash; whether it is the right one, only `get` knows."""
        return digest in self._texts

    def get(self, digest: str) -> str | None:
        """The text with this hash, None if it is not here."""
        text = self._texts.get(digest)
        if isinstance(text, msgspec.Raw):
            try:
                text = msgspec.json.decode(text, type=str)
            except (msgspec.DecodeError, UnicodeDecodeError):
                return None
        return text if text is not None and text_hash(text) == digest else None

    def plus(self, texts: Mapping[str, str]) -> Self | None:
        """These and more, by their hashes; None if it is time to write the file anew."""
        if not self._parts:
            return None
        if not texts:
            return self
        part = dumps(texts.items())
        content, parts = self.content + part, (*self._parts, len(part))
        if len(content) > 2 * parts[0] or len(parts) > _MOST:
            return None
        return type(self)({**self._texts, **texts}, content, parts)


def dumps(texts: Iterable[tuple[str, str]]) -> bytes:
    """The content of a file with these hashes and texts, of which one at a time has to be there."""
    packer = zlib.compressobj(_FAST, wbits=_GZIP)
    parts, before = [packer.compress(b"{")], b""
    for digest, text in texts:
        parts.append(packer.compress(b"%s\n%s:" % (before, msgspec.json.encode(digest))))
        parts.append(packer.compress(msgspec.json.encode(text)))  # by itself: the largest texts have megabytes
        before = b","
    return b"".join([*parts, packer.compress(b"}\n"), packer.flush()])


def _parts(content: bytes) -> Iterator[tuple[int, bytes]]:
    """Length and unpacked content of every part. Raises `zlib.error` for whatever is none."""
    while content:
        unpacker = zlib.decompressobj(_GZIP)
        part = unpacker.decompress(content)
        if not unpacker.eof:
            raise zlib.error("cut short")
        yield len(content) - len(unpacker.unused_data), part
        content = unpacker.unused_data
