"""A document in chunks: each child of the root with the text up to the next one.

What a chunk says depends on its own text and on the namespaces of the root, and on nothing else. So a chunk that was
there at the last reading is taken over from there, and only the text between such chunks is parsed: an *excerpt* of
the document, which holds its beginning, what is new, and its end. A document that nothing is known of is its own
excerpt, so there is one way of reading.

Why that is right: in the excerpt, a chunk was cut out where another child of the root begins, or where the root ends;
so the parser stood between two children there, and it would stand there again after each of those chunks, as it did
at the last reading. Wherever this is in doubt, the whole is parsed.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Generic, TypeAlias, TypeVar

import msgspec

from urdfsync.diagnostics import Diagnostic
from urdfsync.urdf.reader import xml
from urdfsync.urdf.reader.xml import Node

T = TypeVar("T")

_MISSES = 16
"""Known chunks that are looked for in vain, before all that follows counts as new: each look goes through the text."""
_FAR = ("<!DOCTYPE", "xml:id")
"""Signs of something that children of the root may depend on beside their own texts."""
_TAG = re.compile(r"<[^!?]")

Make: TypeAlias = Callable[[Node, str, str], T]
"""Makes of a child of the root, its path and its text what is to be had of it."""


class _DoubtError(Exception):
    """An excerpt does not tell what the whole document says."""


class Chunk(msgspec.Struct, Generic[T], frozen=True, eq=False):
    """A child of the root: its text, the number of line feeds in that, and what was made of it."""

    tag: str
    name: str
    path: str
    """As findings call it: `link wheel`, the second of that name `link wheel #2`; `link number 3` has no name."""
    text: str
    height: int
    made: T


class Document(msgspec.Struct, Generic[T], frozen=True, eq=False):
    """The root, without its children, and these as chunks; `lines` has the line where each begins."""

    root: Node
    namespaces: Mapping[str, str]
    """URIs by prefix, as the root declares them."""
    chunks: Sequence[Chunk[T]]
    lines: Sequence[int]
    prefixes: Mapping[str, Diagnostic]
    """A warning for each prefix that lacks a namespace."""
    far: bool
    """Whether what its children say may depend on more than their texts."""


def read(text: str, root: str, make: Make[T], last: Document[T] | None = None) -> Document[T]:
    """The document that `text` is, which `xml.decode` gave; what is as in the last one is taken from there.

    The children of a root with another tag are left out. Raises xml.Fault.
    """
    far = any(sign in text for sign in _FAR)
    if last is None or last.far or far:
        return _Assembly([text], root, make, None).read(far)
    try:
        return _Assembly(_cut(text, last.chunks), root, make, last).read()
    except (_DoubtError, xml.Fault):  # what is wrong, the whole tells best
        return _Assembly([text], root, make, last).read()


def _cut(text: str, chunks: Iterable[Chunk[T]]) -> list[str | Chunk[T]]:
    """The text as chunks that are known, and what is between them; each of that begins with a tag but the first."""
    pieces: list[str | Chunk[T]] = []
    done, missed = 0, 0
    for chunk in chunks:
        at = done if text.startswith(chunk.text, done) else text.find(chunk.text, done)
        if at < 0:
            missed += 1
            if missed > _MISSES:
                break
            continue
        if at > done:
            _add(text[done:at], pieces)
        pieces.append(chunk)
        done = at + len(chunk.text)
    _add(text[done:], pieces)
    return pieces


def _add(new: str, pieces: list[str | Chunk[T]]) -> None:
    """Add what is between chunks; if it begins with no tag, the chunk before it is another one, too."""
    while pieces and (isinstance(pieces[-1], str) or not _TAG.match(new)):
        piece = pieces.pop()
        new = (piece if isinstance(piece, str) else piece.text) + new
    pieces.append(new)


class _Assembly(Generic[T]):
    """Puts what the parser hands over and the chunks that it does not see into one document."""

    def __init__(self, pieces: Iterable[str | Chunk[T]], tag: str, make: Make[T], last: Document[T] | None) -> None:
        self._tag, self._make, self._last = tag, make, last
        self._cut_out: dict[int, list[Chunk[T]]] = {}
        """Chunks that are known, by the offset in the excerpt where they belong."""
        texts: list[str] = []
        offset = 0
        for piece in pieces:
            if isinstance(piece, str):
                texts.append(piece)
                offset += len(piece)
            else:
                self._cut_out.setdefault(offset, []).append(piece)
        self._excerpt = "".join(texts)

    def read(self, far: bool = False) -> Document[T]:
        """Parse the excerpt. Raises xml.Fault, or _DoubtError if it does not tell what the whole says."""
        prefixes = xml.parse(self._excerpt, self)
        if self._waiting:
            raise _DoubtError
        return Document(self._root, self._namespaces, self._chunks, self._lines, prefixes, far)

    def root(self, root: Node, namespaces: Mapping[str, str]) -> None:
        """See `xml.Taker`."""
        same = self._last is not None and self._last.namespaces == namespaces
        if self._cut_out and not same:
            raise _DoubtError
        self._root, self._namespaces = root, namespaces
        self._known = {chunk.path: chunk for chunk in self._last.chunks} if self._last and same else {}
        self._waiting = dict(self._cut_out)
        self._chunks: list[Chunk[T]] = []
        self._lines: list[int] = []
        self._names: Counter[tuple[str, str]] = Counter()
        self._tags: Counter[str] = Counter()
        self._below = 0

    def take(self, node: Node) -> None:
        """See `xml.Taker`."""
        if node.child is None or self._root.tag != self._tag:
            return
        self._put_back(node.child.line, node.child.begin)
        name, text = node.attributes.get("name", ""), node.child.text
        path = self._path(node.tag, name)
        chunk = self._known.get(path)
        if chunk is None or chunk.text != text:
            chunk = Chunk(node.tag, name, path, text, text.count("\n"), self._make(node, path, text))
        self._chunks.append(chunk)
        self._lines.append(node.child.line + self._below)

    def end(self, line: int, offset: int) -> None:
        """See `xml.Taker`."""
        self._put_back(line, offset)

    def _put_back(self, line: int, offset: int) -> None:
        """Add the chunks that were cut out there, where the excerpt has that line."""
        for chunk in self._waiting.pop(offset, ()):
            if self._path(chunk.tag, chunk.name) != chunk.path:
                raise _DoubtError
            self._chunks.append(chunk)
            self._lines.append(line + self._below)
            self._below += chunk.height

    def _path(self, tag: str, name: str) -> str:
        """The path of the next child; elements of one tag are told apart by their names, and counted."""
        self._tags[tag] += 1
        self._names[tag, name] += 1
        count = self._names[tag, name]
        path = f"{tag} {name}" if name.strip() else f"{tag} number {self._tags[tag]}"
        return path if count == 1 else f"{path} #{count}"
