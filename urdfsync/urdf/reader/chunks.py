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
from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import accumulate
from typing import Generic, TypeAlias, TypeVar

import msgspec

from urdfsync.diagnostics import Diagnostic
from urdfsync.urdf.reader import xml
from urdfsync.urdf.reader.faults import Fault
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
    begin: int
    """Offset of the first child in the text; 0 if there is none."""
    size: int
    """Length of the text."""
    far: bool
    """Whether what its children say may depend on more than their texts."""


def read(text: str, root: str, make: Make[T], last: Document[T] | None = None) -> Document[T]:
    """The document that `text` is, which `xml.decode` gave; what is as in the last one is taken from there.

    The children of a root with another tag are left out. Raises Fault.
    """
    if last is not None and not last.far:
        pieces = _cut(text, last)
        if not any(_is_far(piece) for piece in pieces if isinstance(piece, str)):
            try:
                return _Assembly(pieces, root, make, last).read(len(text))
            except (_DoubtError, Fault):  # what is wrong, the whole tells best
                return _Assembly([text], root, make, last).read(len(text))
    return _Assembly([text], root, make, None).read(len(text), _is_far(text))


def _is_far(text: str) -> bool:
    """Whether there is such a sign; none of them goes beyond the begin of a child, which is a tag."""
    return any(sign in text for sign in _FAR)


def _cut(text: str, last: Document[T]) -> list[str | range]:
    """The text as numbers of chunks that are known, and what is between them; all but the first begin with a tag."""
    chunks, count = last.chunks, len(last.chunks)
    texts = [chunk.text for chunk in chunks]
    begins = list(accumulate(map(len, texts), initial=last.begin))
    first = _leading(map(text.startswith, texts, begins), count)
    done, shift = begins[first] if first else 0, len(text) - last.size
    places = [begin + shift for begin in begins[bisect_left(begins, done - shift, first, count) : count]]
    rest = count - _leading(map(text.startswith, reversed(texts), reversed(places)), len(places))
    end = begins[rest] + shift if rest < count else len(text)
    pieces: list[str | range] = []
    if first:
        pieces += text[: last.begin], range(first)
    for piece in _between(text[done:end], chunks, range(first, rest)):
        _add(piece, pieces, chunks)
    if rest < count:
        pieces.append(range(rest, count))
        _add(text[begins[count] + shift :], pieces, chunks)
    return pieces


def _leading(found: Iterable[bool], count: int) -> int:
    """How many of these `count` are true before the first that is not."""
    return next((number for number, true in enumerate(found) if not true), count)


def _between(text: str, chunks: Sequence[Chunk[T]], numbers: range) -> Iterator[str | range]:
    """A part of the text as known chunks of these numbers, and what is between them."""
    done, missed = 0, 0
    for number in numbers:
        known = chunks[number].text
        at = done if text.startswith(known, done) else text.find(known, done)
        if at < 0:
            missed += 1
            if missed > _MISSES:
                break
            continue
        if at > done:
            yield text[done:at]
        yield range(number, number + 1)
        done = at + len(known)
    if done < len(text):
        yield text[done:]


def _add(new: str | range, pieces: list[str | range], chunks: Sequence[Chunk[T]]) -> None:
    """Add a piece; if a text begins with no tag, the chunk before it is another one, too."""
    if isinstance(new, str):
        while pieces and (isinstance(pieces[-1], str) or not _TAG.match(new)):
            piece = pieces.pop()
            if isinstance(piece, str):
                new = piece + new
            elif piece:
                pieces.append(piece[:-1])
                new = chunks[piece[-1]].text + new
    pieces.append(new)


class _Assembly(Generic[T]):
    """Puts what the parser hands over and the chunks that it does not see into one document."""

    def __init__(self, pieces: Iterable[str | range], tag: str, make: Make[T], last: Document[T] | None) -> None:
        self._tag, self._make, self._last = tag, make, last
        self._cut_out: dict[int, list[range]] = {}
        """Numbers of chunks that are known, by the offset in the excerpt where they belong."""
        texts: list[str] = []
        offset = 0
        for piece in pieces:
            if isinstance(piece, str):
                texts.append(piece)
                offset += len(piece)
            elif piece:
                self._cut_out.setdefault(offset, []).append(piece)
        self._excerpt = "".join(texts)

    def read(self, size: int, far: bool = False) -> Document[T]:
        """Parse the excerpt of a text of this size. Raises Fault, or _DoubtError if it does not tell enough."""
        prefixes = xml.parse(self._excerpt, self)
        if self._waiting:
            raise _DoubtError
        return Document(self._root, self._namespaces, self._chunks, self._lines, prefixes, self._begin, size, far)

    def root(self, root: Node, namespaces: Mapping[str, str]) -> None:
        """See `xml.Taker`."""
        same = self._last is not None and self._last.namespaces == namespaces
        if self._cut_out and not same:
            raise _DoubtError
        self._root, self._namespaces = root, namespaces
        self._before: Sequence[Chunk[T]] = self._last.chunks if self._last and same else ()
        self._by_path: dict[str, Chunk[T]] = {}
        self._paths = _Paths(self._before)
        self._waiting = dict(self._cut_out)
        self._chunks: list[Chunk[T]] = []
        self._lines: list[int] = []
        self._begin = self._below = 0

    def take(self, node: Node) -> None:
        """See `xml.Taker`."""
        if node.child is None or self._root.tag != self._tag:
            return
        self._put_back(node.child.line, node.child.begin)
        name, text = node.attributes.get("name", ""), node.child.text
        path = self._paths.next(node.tag, name)
        chunk = self._known(path)
        if chunk is None or chunk.text != text:
            chunk = Chunk(node.tag, name, path, text, text.count("\n"), self._make(node, path, text))
        self._begin = self._begin if self._chunks else node.child.begin
        self._chunks.append(chunk)
        self._lines.append(node.child.line + self._below)

    def end(self, line: int, offset: int) -> None:
        """See `xml.Taker`."""
        self._put_back(line, offset)

    def _put_back(self, line: int, offset: int) -> None:
        """Add the chunks that were cut out there, where the excerpt has that line."""
        for run in self._waiting.pop(offset, ()):
            if self._last is None or not self._paths.stay(run):
                raise _DoubtError
            lines = self._last.lines[run.start : run.stop]
            shift = line + self._below - lines[0]
            self._begin = self._begin if self._chunks else offset
            self._chunks += self._before[run.start : run.stop]
            self._lines += [number + shift for number in lines] if shift else lines
            self._below += lines[-1] - lines[0] + self._before[run[-1]].height

    def _known(self, path: str) -> Chunk[T] | None:
        """The chunk of that path in the last document."""
        number = len(self._chunks)
        if number < len(self._before) and self._before[number].path == path:
            return self._before[number]
        self._by_path = self._by_path or {chunk.path: chunk for chunk in self._before}
        return self._by_path.get(path)


class _Paths(Generic[T]):
    """The paths of children, one by one; those of one tag are told apart by their names, and counted.

    As long as tags and names are those of the last document, paths are so, too, and nothing is counted.
    """

    def __init__(self, last: Sequence[Chunk[T]]) -> None:
        self._last = last
        self._alike = 0
        """So many children have the tags and names of the last document; -1 if they are counted."""
        self._names: Counter[tuple[str, str]] = Counter()
        self._tags: Counter[str] = Counter()

    def next(self, tag: str, name: str) -> str:
        """The path of the next child."""
        if 0 <= self._alike < len(self._last):
            chunk = self._last[self._alike]
            if chunk.tag == tag and chunk.name == name:
                self._alike += 1
                return chunk.path
        self._count()
        return self._counted(tag, name)

    def stay(self, run: range) -> bool:
        """Whether the next children, which are these of the last document, have the paths that they had."""
        if run.start == self._alike:
            self._alike = run.stop
            return True
        self._count()
        chunks = self._last[run.start : run.stop]
        return all(self._counted(chunk.tag, chunk.name) == chunk.path for chunk in chunks)

    def _count(self) -> None:
        """Count from now on, and what was there so far."""
        for chunk in self._last[: max(self._alike, 0)]:
            self._counted(chunk.tag, chunk.name)
        self._alike = -1

    def _counted(self, tag: str, name: str) -> str:
        self._tags[tag] += 1
        self._names[tag, name] += 1
        count = self._names[tag, name]
        path = f"{tag} {name}" if name.strip() else f"{tag} number {self._tags[tag]}"
        return path if count == 1 else f"{path} #{count}"
