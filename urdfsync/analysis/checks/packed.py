"""Writes each library as one text for the compiler: the classes that are needed.

rumoca 0.10.2 goes through all libraries for each model: with whole ones, a check of a six-axis arm takes twice the
time. A class is kept if compiled texts or kept classes contain its name and the names of all classes around it. Models
can reach no other class. Comments name the file and line from which a text comes.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias

import msgspec

# a string or comment without an end goes on to the end of the text: else each quotation mark would look for it
_STRING = r'"(?:\\.|[^"\\])*+(?:"|\\?\Z)'
_REMARK = r"//[^\n]*+|/\*.*?(?:\*/|\Z)"
_QUOTED = r"'(?:\\.|[^'\\])*+(?:'|\\?\Z)"
_NAME = rf"(?:{_QUOTED}|[A-Za-z_]\w*+)"
_KINDS = "package|model|block|function|record|type|connector|class"
_GAP = rf"(?:\s++|{_REMARK})*+"
_FRONT = re.compile(rf"\ufeff?{_GAP}(?:within\b(?:{_REMARK}|{_QUOTED}|[^;/'])*+;{_GAP})?", re.DOTALL)
"""The text before the class of a file."""
_DEEPEST = 50
"""Deepest nesting of packages that are taken apart; each is read once more for each package around it."""
_MARK = "// urdfsync: "
_PLACE = re.compile(rf"{_MARK}(.+):(\d+)$")
_BLANK = re.compile(rf"(?:\s++|{_REMARK}|\b(?:public|protected)\b)*+", re.DOTALL)
_CLASS = re.compile(
    rf"(?:(?:encapsulated|partial|pure|impure|expandable|operator)\b{_GAP})*+(?P<kind>{_KINDS})\b{_GAP}"
    rf"(?:extends\b{_GAP})?+(?P<name>{_NAME})(?:{_GAP}{_STRING}(?:{_GAP}\+{_GAP}{_STRING})*+)?+(?:{_GAP}(?P<short>=))?",
    re.DOTALL,
)
_SIGN = re.compile(rf"{_STRING}|{_QUOTED}|{_REMARK}|(?P<sign>[;(){{}}\[\]])", re.DOTALL)
_BEGIN_OR_END = re.compile(
    rf"{_STRING}|{_QUOTED}|{_REMARK}"
    rf"|\b(?:{_KINDS})\b{_GAP}(?:extends\b{_GAP})?+(?P<begin>{_NAME})(?!{_GAP}=)|\bend\b{_GAP}(?P<end>{_NAME})",
    re.DOTALL,
)
_OPERATORS = "constructor 0 String + - * / ^ == <> > < >= <= and or not".split()
_UNNAMED = {"constructor", "destructor", "equalityConstraint", *(f"'{operator}'" for operator in _OPERATORS)}
"""Functions that Modelica calls although no text names them."""
_WORD = re.compile(rf"{_STRING}|{_REMARK}|({_NAME})", re.DOTALL)


class ClassText(msgspec.Struct, frozen=True, array_like=True):
    """A text of a class; the text of a package lacks the classes inside."""

    owner: str
    """The full name of the class."""
    text: str
    names: str
    """The names in the text, a line for each."""


LibraryTexts: TypeAlias = Sequence[ClassText]
"""The texts of all classes of a library, in the order of its text."""


def class_texts(name: str, texts: Mapping[str, bytes]) -> list[ClassText]:
    """Return the texts of all classes of a library; `texts` are by their path in the library's folder."""
    inside = dict[str, list[str]]()
    for path in sorted(path for path in texts if path.endswith(".mo")):
        inside.setdefault(_stem(path).rpartition("/")[0], []).append(path)
    top = "package.mo" if "package.mo" in texts else next(iter(texts), "")
    found = _texts(name, top, texts, inside) if top else ()
    return [ClassText(owner, text, "\n".join(names_in(text))) for owner, text in found]


def names_in(text: str) -> frozenset[str]:
    """Return the names in a text, keywords included; names in comments and strings do not count."""
    return frozenset(filter(None, _WORD.findall(text)))


def packed(libraries: Mapping[str, LibraryTexts], named: Iterable[str]) -> dict[str, str]:
    """Return the text of each library, with the classes that are reached from the words `named`."""
    names, inside = dict[str, list[str]](), dict[str, set[str]]()
    for class_text in itertools.chain.from_iterable(libraries.values()):
        names.setdefault(class_text.owner, []).append(class_text.names)
        inside.setdefault(class_text.owner.rpartition(".")[0], set()).add(class_text.owner)
    reached, found, new, waiting = {*libraries, *named, *_UNNAMED}, set[str](), [*libraries], dict[str, list[str]]()
    while new:
        owner = new.pop()
        if (word := owner.rpartition(".")[2]) not in reached:
            waiting.setdefault(word, []).append(owner)
            continue
        found.add(owner)
        new += inside.get(owner, ())
        for word in {*"\n".join(names.get(owner, ())).split("\n")} - reached:  # an empty library has no text
            reached.add(word)
            new += waiting.pop(word, ())
    return {name: "".join(_kept(library, found)) for name, library in libraries.items()}


def _kept(library: LibraryTexts, found: Container[str]) -> Iterator[str]:
    """Yield the texts of the classes `found`, and empty lines for others: the lines of a file keep their numbers."""
    has_begun = False
    for class_text in library:
        is_found = class_text.owner in found
        has_begun = is_found if class_text.text.startswith(f"\n{_MARK}") else has_begun or is_found
        if is_found:
            yield class_text.text
        elif has_begun:
            yield "\n" * class_text.text.count("\n")


def original_place(text: str, line: int) -> tuple[str, int]:
    """Return the file, below the library's folder, and the line in it from which a line of a packed text comes."""
    for since, each in enumerate(reversed(text.split("\n")[:line])):
        if place := _PLACE.match(each):
            return place[1], int(place[2]) + since - 1
    return "", line


def _stem(path: str) -> str:
    """Return the path of a file's class: without `.mo`, and for a package without `/package.mo`."""
    return path.removesuffix(".mo").removesuffix("/package")


def _texts(
    owner: str, path: str, texts: Mapping[str, bytes], inside: Mapping[str, Sequence[str]]
) -> Iterator[tuple[str, str]]:
    """Yield the texts of a class and of the classes inside, each with the name of the class that contains it.

    `inside` has the files of classes by their folder; these classes follow the name and comment of the folder's
    package.
    """
    text = texts[path].decode("utf-8", "replace")
    front = _FRONT.match(text)
    text = "\n" * text.count("\n", 0, front.end()) + text[front.end() :] if front else text
    above, start, place = owner.rpartition(".")[0], 0, path.encode(errors="replace").decode()
    if path.rpartition("/")[2] == "package.mo":
        blank = _BLANK.match(text)
        head = _CLASS.match(text, blank.end() if blank else 0)
        above, start = owner, head.end() if head else 0
        yield owner, f"\n{_MARK}{place}:1\n{text[:start]}"
        for file in inside.get(path.removesuffix("package.mo").rstrip("/"), ()):
            if file != path:
                yield from _texts(f"{owner}.{_stem(file).rpartition('/')[2]}", file, texts, inside)
    yield owner, f"\n{_MARK}{place}:{1 + text.count(chr(10), 0, start)}\n"
    for name, each in _members(above, text, start, len(text)):
        yield name or owner, each


def _members(owner: str, text: str, at: int, end: int, deep: int = 0) -> Iterator[tuple[str, str]]:
    """Yield the texts of a package's body: each class in it, and the texts around them.

    The rest of the body stays whole behind a class without an end, as does a package that is `deep` inside others.
    """
    since = at
    while at < end:
        if blank := _BLANK.match(text, at, end):
            at = blank.end()
        found = _CLASS.match(text, at, end)
        stop = _end_of(text, found, end) if found else _semicolon(text, at, end)
        if not stop:
            break
        if found:
            if since < at:
                yield owner, text[since:at]
            name = f"{owner}.{found['name']}" if owner else found["name"]
            if found["kind"] == "package" and not found["short"] and deep < _DEEPEST:
                yield name, text[at : found.end()]
                yield from _members(name, text, found.end(), stop, deep + 1)
            else:
                yield name, text[at:stop]
            since = stop
        at = max(stop, at + 1)
    if since < end:
        yield owner, text[since:end]


def _end_of(text: str, found: re.Match[str], end: int) -> int:
    """Return where a class ends, or 0."""
    if found["short"]:
        return _semicolon(text, found.end(), end)
    name, depth = found["name"], 1
    for match in _BEGIN_OR_END.finditer(text, found.end(), end):
        depth += (match["begin"] == name) - (match["end"] == name)
        if not depth:
            return _semicolon(text, match.end(), end)
    return 0


def _semicolon(text: str, at: int, end: int) -> int:
    """Return where a statement ends: behind its semicolon, or without a semicolon at `end`."""
    depth = 0
    for match in _SIGN.finditer(text, at, end):
        sign = match["sign"] or ""
        if sign == ";" and depth <= 0:
            return match.end()
        depth += (sign in "([{") - (sign in ")]}") if sign else 0
    return end
