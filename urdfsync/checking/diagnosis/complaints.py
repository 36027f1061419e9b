"""What compilers say of a model that does not compile, taken apart: rumoca's texts, and messages of OpenModelica. Pure.

rumoca says everything in one text: complaints in lines or after semicolons, some with a place in brackets, some drawn
with a frame around the source. OpenModelica puts the place first.
"""

from __future__ import annotations

import enum
import re
from collections.abc import Iterator

import msgspec


class Kind(enum.Enum):
    """What sort of complaint it is."""

    CLASS = "class"
    """A class that is not there: `reference`."""
    FUNCTION = "function"
    COMPONENT = "component"
    BALANCE = "balance"
    """As many `equations`, but so many `unknowns`."""
    UNPARSED = "unparsed"
    """Some file in the folder `file` does not parse."""
    LAYOUT = "layout"
    OTHER = "other"


UNRESOLVED = frozenset({Kind.CLASS, Kind.FUNCTION, Kind.COMPONENT})


class Complaint(msgspec.Struct, frozen=True):
    """One thing that a compiler does not like."""

    kind: Kind
    words: str
    """In the compiler's words, in one line."""
    file: str = ""
    """As the compiler names it; empty if it does not."""
    line: int = 0
    column: int = 0
    reference: str = ""
    equations: int = 0
    unknowns: int = 0


_COLOURS = re.compile(r"\x1b\[[0-9;]*m")
_BALANCE = re.compile(r"(\d+) equation(?:s|\(s\))?(?:,| and) (\d+) (?:unknown|variable)")
_UNPARSED = re.compile(r"Failed to load source root '([^']*)': parse source-root files")
_LAYOUT = re.compile(r"invalid Modelica package layout under '[^']*': (.*)", re.DOTALL)
_RULE = re.compile(r"PKG-\d+ ")
_RULED_FILE = re.compile(r"\b(file|directory) '([^']*)'")
_FRAMED = re.compile(r"×(?P<words>[^╭]*?)\n\s*╭─+\[(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+)\]")
_MESSAGE = re.compile(
    r"^(?:\[(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+)-\d+:\d+:\w+\] )?(?P<level>Error|Warning|Notification): ",
    re.MULTILINE,
)
_PIECES = re.compile(r"\n|; (?=\S)")
_PREFIXES = re.compile(
    r"^(?:- <[^>]*> \[\w+\]: |\w+ failed: |[\w.]+ failed in \w+: |[\w.]+ could not be compiled: |Failed to [^:]*: )+"
)
_PLACE = re.compile(r" \[(?P<file>[^\[\]]*):(?P<line>\d+):(?P<column>\d+)\]$")
_REFERENCE = re.compile(
    r"unresolved (?P<kind>component reference|function call|type reference|import|extends base class): '(?P<name>.+)'$"
)
_NO_BASE = re.compile(r"base class not found: `(?P<name>[^`]+)` does not exist$")
_KINDS = {"component reference": Kind.COMPONENT, "function call": Kind.FUNCTION}


def complaints(text: str) -> list[Complaint]:
    """What a compiler complains about, each once, in its order; never nothing, unless the text is empty."""
    text = _COLOURS.sub("", text).strip()
    if balance := _BALANCE.search(text):
        equations, unknowns = map(int, balance.groups())
        if equations != unknowns:
            return [Complaint(Kind.BALANCE, _folded(text), equations=equations, unknowns=unknowns)]
    if unparsed := _UNPARSED.search(text):
        return [Complaint(Kind.UNPARSED, _folded(text), unparsed[1])]
    if layout := _LAYOUT.search(text):
        return list(dict.fromkeys(_rules(layout[1])))
    found = list(dict.fromkeys([*_framed(text), *_messages(text)] or _pieces(text)))
    return found or ([Complaint(Kind.OTHER, _folded(text))] if text else [])


def _folded(text: str) -> str:
    return " ".join(text.split())


def _rules(text: str) -> Iterator[Complaint]:
    """Rules of a package's layout that are broken."""
    for words in re.split(r";\s+(?=PKG-\d+)", text):
        file = _RULED_FILE.search(words)
        words = _RULED_FILE.sub(r"the \1", _RULE.sub("", words, count=1), count=1)
        yield Complaint(Kind.LAYOUT, _folded(words), file[2] if file else "")


def _framed(text: str) -> Iterator[Complaint]:
    for found in _FRAMED.finditer(text):
        words = _folded(found["words"].replace("│", " "))
        yield Complaint(Kind.OTHER, words, found["file"], int(found["line"]), int(found["column"]))


def _messages(text: str) -> Iterator[Complaint]:
    """Errors of OpenModelica; each goes on to the beginning of the next message."""
    found = list(_MESSAGE.finditer(text))
    ends = [*(following.start() for following in found[1:]), len(text)]
    for message, end in zip(found, ends, strict=bool(found)):
        if message["level"] == "Error":
            words = _folded(text[message.end() : end])
            line, column = int(message["line"] or 0), int(message["column"] or 0)
            yield Complaint(Kind.OTHER, words, message["file"] or "", line, column)


def _pieces(text: str) -> Iterator[Complaint]:
    for piece in _PIECES.split(text):
        words = _PREFIXES.sub("", piece.strip())
        if not words or words[-1] == ":":  # a heading
            continue
        place = _PLACE.search(words)
        if place:
            words = words[: place.start()]
        if named := _REFERENCE.match(words) or _NO_BASE.match(words):
            kind = _KINDS.get(named.groupdict().get("kind") or "", Kind.CLASS)
            yield Complaint(kind, _folded(words), reference=named["name"])
        elif place:
            yield Complaint(Kind.OTHER, _folded(words), place["file"], int(place["line"]), int(place["column"]))
        else:
            yield Complaint(Kind.OTHER, _folded(words))
