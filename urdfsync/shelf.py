"""Many texts in little memory: all of a large package have to be there before the first is written.

They resemble each other, so hardly anything is left of them when they are compressed together. That is done in
batches, so that none needs all others to be read again; those of most packages need not be compressed at all.
"""

from __future__ import annotations

import bisect
import zlib
from array import array
from collections import deque

import msgspec

_BATCH = 1 << 15
"""Least bytes of a batch."""
_ROOM = 1 << 20
"""Bytes that are kept as they are: those that were put there last."""
_FAST = 1


class Shelf:
    """Contents by name. Cheap for who takes them in the order in which they were put there."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}
        self._ends = array("Q")
        """Where each content ends if all stand one behind the other."""
        self._batches: list[bytes] = []
        self._firsts, self._starts = [0], [0]
        """Number of the first content of each batch and where it begins, and the same of what is not compressed yet."""
        self._rest: deque[bytes] = deque()
        self._taken: tuple[int, bytes] = -1, b""
        """Number and content of the batch that was read last."""

    def __contains__(self, name: str) -> bool:
        return name in self._numbers

    def put(self, name: str, content: bytes) -> None:
        """Put something there under a name that nothing has."""
        self._numbers[name] = len(self._numbers)
        self._ends.append((self._ends[-1] if self._ends else 0) + len(content))
        self._rest.append(content)
        while self._ends[-1] - self._starts[-1] > _ROOM:
            self._compress()

    def get(self, name: str) -> bytes:
        """Read what is there under a name. Raises KeyError if nothing is."""
        number = self._numbers[name]
        batch = bisect.bisect_right(self._firsts, number) - 1
        if batch == len(self._batches):
            return self._rest[number - self._firsts[batch]]
        before, after = self._starts[batch : batch + 2]
        if self._taken[0] != batch:
            self._taken = -1, b""  # before there is another one
            self._taken = batch, zlib.decompress(self._batches[batch], bufsize=after - before)
        start = self._ends[number - 1] if number else 0
        return self._taken[1][start - before : self._ends[number] - before]

    def _compress(self) -> None:
        """Make a batch of what has been there longest."""
        contents, size = [], 0
        while size < _BATCH:
            contents.append(self._rest.popleft())
            size += len(contents[-1])
        self._batches.append(zlib.compress(b"".join(contents), _FAST))
        self._firsts.append(self._firsts[-1] + len(contents))
        self._starts.append(self._starts[-1] + size)


class Shelved(msgspec.Struct, frozen=True):
    """A content that is on a shelf."""

    shelf: Shelf
    name: str
    hash: str
    """SHA-256 (hex) of the content."""

    def read(self) -> bytes:
        """The content."""
        return self.shelf.get(self.name)
