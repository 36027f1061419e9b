"""The texts that urdfsync wrote last, by their hash: kept to merge with, and safe to lose.

One file per robot, `.urdfsync/base/<robot>.json.gz`, of parts that are JSON each and compressed by themselves: texts of
one package resemble each other, so little is left of them. A build adds a part with what is new: texts, and of a long
one the passage that is new, if it is short. Texts that are needed no more stay until the parts have become as large
again as the first one. A text counts only if its hash is right.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Self, TypeAlias

import msgspec

from urdfsync.manifest import text_hash

_GZIP = 16 + zlib.MAX_WBITS
_FAST = 1
_MOST = 64
"""Parts of one file."""
_LONG = 4096
"""Characters from which on a text may be kept as a passage."""


class Passage(msgspec.Struct, frozen=True, array_like=True):
    """A text by what differs from another one, which is kept as a whole."""

    whole: str
    """Hash of the other text."""
    start: int
    """So many characters of it come first,"""
    new: str
    """then this,"""
    end: int
    """and then so many of its last characters."""

    @classmethod
    def of(cls, text: str, digest: str, whole: str) -> Self:
        """What differs in a text from another one of this hash."""
        ours, theirs = len(text), len(whole)
        start = _alike(lambda low, high: text[low:high] == whole[low:high], min(ours, theirs))
        end = _alike(
            lambda low, high: text[ours - high : ours - low] == whole[theirs - high : theirs - low],
            min(ours, theirs) - start,
        )
        return cls(digest, start, text[start : ours - end], end)

    def text(self, whole: str) -> str:
        """The text, from the other one."""
        return whole[: self.start] + self.new + whole[len(whole) - self.end :]


Stored: TypeAlias = str | Passage | msgspec.Raw
"""A text, or the JSON of one."""


class Bases:
    """The kept texts of one robot."""

    def __init__(self, texts: Mapping[str, Stored], content: bytes = b"", parts: tuple[int, ...] = ()) -> None:
        """`texts` are by their hashes; `content` is the file's, and `parts` says how long (bytes) each is."""
        self._texts, self._parts = texts, parts
        self._last: tuple[str, str] = "", ""
        """Hash and text of the whole with which a passage was compared last: mostly, it is that of the next one."""
        self.content = content

    @classmethod
    def loads(cls, content: bytes) -> Self:
        """The texts in a file's content; none if that is lost or damaged."""
        texts: dict[str, Stored] = {}
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
        kept = self._kept(digest)
        if isinstance(kept, Passage):
            whole = self._whole(kept.whole)
            kept = None if whole is None else kept.text(whole)
        return kept if kept is not None and text_hash(kept) == digest else None

    def plus(self, texts: Mapping[str, str], before: Mapping[str, str] | None = None) -> Self | None:
        """These and more, by their hashes; None if it is time to write the file anew.

        `before` are the hashes of texts that some of the new ones resemble.
        """
        if not self._parts:
            return None
        if not texts:
            return self
        news = {digest: self._shortened(text, (before or {}).get(digest)) for digest, text in texts.items()}
        part = dumps(news.items())
        content, parts = self.content + part, (*self._parts, len(part))
        if len(content) > 2 * parts[0] or len(parts) > _MOST:
            return None
        more = type(self)({**self._texts, **news}, content, parts)
        more._last = self._last
        return more

    def _kept(self, digest: str) -> str | Passage | None:
        """What is kept under a hash, whatever it is."""
        kept = self._texts.get(digest)
        if not isinstance(kept, msgspec.Raw):
            return kept
        try:
            return msgspec.json.decode(kept, type=str | Passage)
        except (msgspec.DecodeError, UnicodeDecodeError):
            return None

    def _whole(self, digest: str) -> str | None:
        """The text with this hash, if it is not kept as a passage itself."""
        if self._last[0] != digest:
            kept = self._kept(digest)
            if not isinstance(kept, str) or text_hash(kept) != digest:
                return None
            self._last = digest, kept
        return self._last[1]

    def _shortened(self, text: str, before: str | None) -> str | Passage:
        """How a text is kept that resembles that of a hash."""
        if before is None or len(text) < _LONG:
            return text
        digest, whole = before, self._whole(before)
        if whole is None and isinstance(kept := self._kept(before), Passage):
            digest, whole = kept.whole, self._whole(kept.whole)
        passage = None if whole is None else Passage.of(text, digest, whole)
        return passage if passage and 2 * len(passage.new) <= len(text) else text


def dumps(texts: Iterable[tuple[str, str | Passage]]) -> bytes:
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


def _alike(same: Callable[[int, int], bool], most: int) -> int:
    """How many characters are alike, of `most` from one side: `same` says whether those between two places are."""
    low, high = 0, most
    while low < high:
        middle = (low + high + 1) // 2
        if same(low, middle):
            low = middle
        else:
            high = middle - 1
    return low
