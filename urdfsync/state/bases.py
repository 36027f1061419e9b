"""The texts that urdfsync wrote last, by their hash: kept to merge with, and safe to lose.

One JSON file per robot, `.urdfsync/base/<robot>.json.gz`: texts of one package resemble each other, so little is left
of them. A text counts only if its hash is right.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterable, Mapping

import msgspec

from urdfsync.manifest import text_hash

_GZIP = 16 + zlib.MAX_WBITS
_FAST = 1


class Bases:
    """The kept texts of one robot."""

    def __init__(self, texts: Mapping[str, str | msgspec.Raw]) -> None:
        """`texts` are strings, or JSON of such."""
        self._texts = texts

    @classmethod
    def loads(cls, content: bytes | None) -> Bases:
        """The texts in a file's content; none if that is lost or damaged."""
        if content is None:
            return cls({})
        try:
            return cls(msgspec.json.decode(zlib.decompress(content, _GZIP), type=dict[str, msgspec.Raw]))
        except (zlib.error, msgspec.DecodeError, UnicodeDecodeError, RecursionError):
            return cls({})  # what is missing is rendered again, see `outputs`

    def get(self, digest: str) -> str | None:
        """The text with this hash, None if it is not here."""
        text = self._texts.get(digest)
        if isinstance(text, msgspec.Raw):
            try:
                text = msgspec.json.decode(text, type=str)
            except (msgspec.DecodeError, UnicodeDecodeError):
                return None
        return text if text is not None and text_hash(text) == digest else None


def dumps(texts: Iterable[tuple[str, str]]) -> bytes:
    """The content of a file with these hashes and texts, of which one at a time has to be there."""
    packer = zlib.compressobj(_FAST, wbits=_GZIP)
    parts, before = [packer.compress(b"{")], b""
    for digest, text in texts:
        parts.append(packer.compress(b"%s\n%s:" % (before, msgspec.json.encode(digest))))
        parts.append(packer.compress(msgspec.json.encode(text)))  # by itself: the largest texts have megabytes
        before = b","
    return b"".join([*parts, packer.compress(b"}\n"), packer.flush()])
