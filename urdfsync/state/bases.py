"""The texts that urdfsync wrote last, by their hash: kept to merge with, and safe to lose.

One JSON file per robot, `.urdfsync/base/<robot>.json`. A text counts only if its hash is right.
"""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from urdfsync.manifest import text_hash


class Bases:
    """The kept texts of one robot."""

    def __init__(self, texts: Mapping[str, str]) -> None:
        self._texts = texts

    @classmethod
    def loads(cls, content: bytes | None) -> Bases:
        """The texts in a file's content; none if that is lost or damaged."""
        if content is None:
            return cls({})
        try:
            return cls(msgspec.json.decode(content, type=dict[str, str]))
        except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
            return cls({})  # what is missing is rendered again, see `outputs`

    def dumps(self) -> bytes:
        """The file's content."""
        return msgspec.json.encode(self._texts, order="sorted") + b"\n"

    def get(self, digest: str) -> str | None:
        """The text with this hash, None if it is not here."""
        text = self._texts.get(digest)
        return text if text is not None and text_hash(text) == digest else None
