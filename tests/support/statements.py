"""A `.mo` file as a list of statements, read without the parser, and random edits of them."""

from __future__ import annotations

import dataclasses
import itertools
import re
from collections.abc import Iterator, Sequence
from random import Random

from urdfsync.modelica.lexer import lex
from urdfsync.modelica.parser import SECTIONS

_HEADS = frozenset("model record block package function".split())
_LAYOUT = frozenset({"Placement", "Line", "Icon", "Diagram"})


@dataclasses.dataclass(frozen=True)
class Statement:
    """One element or equation of a class."""

    key: str
    """A component's name, the ends of a connection, or the whole statement."""
    said: tuple[str, ...]
    """The words of the statement without its layout."""
    start: int
    stop: int
    """Behind its semicolon."""
    section: str


def statements(text: str) -> list[Statement]:
    """The statements between the head and the end of a class without inner classes."""
    tokens, _ = lex(text)
    at = next(number for number, token in enumerate(tokens) if token.text in _HEADS) + 2
    at += tokens[at].text[:1] == '"'
    found, section, words, start, depth = list[Statement](), "public", list[str](), 0, 0
    for token in itertools.islice(tokens, at, None):
        if not words and token.text in SECTIONS:
            section = token.text
            continue
        start = start if words else token.start
        words.append(token.text.replace("\r\n", "\n"))
        depth += (token.text in ("(", "[", "{")) - (token.text in (")", "]", "}"))
        if token.text == ";" and not depth:
            said = tuple(_without_layout(words))
            found.append(Statement(_key(words, said, section), said, start, token.start + 1, section))
            words = []
    return found[:-1]


def _without_layout(words: Sequence[str]) -> Iterator[str]:
    text = "\0".join(words)
    inner = r"(?:[^()]|\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\))*"
    text = re.sub(rf"(?<=[\0])({'|'.join(_LAYOUT)})\0\({inner}\)(\0,)?", "", text)
    yield from re.sub(r"\0annotation\0\(\0+\)|\0,(?=\0+\))", "", text).split("\0")


def _key(words: Sequence[str], said: Sequence[str], section: str) -> str:
    if words[0] == "connect":
        ends = "".join(words[2 : words.index(")")]).split(",")
        return f"connect {' '.join(sorted(ends))}"
    if words[0] in ("extends", "annotation"):
        return " ".join(itertools.takewhile(lambda word: word not in ("(", "annotation", ";"), words)) or words[0]
    if section in ("public", "protected") and words[0] != "import":
        stops = (number for number, word in enumerate(words) if word in _STOPS or word[:1] == '"')
        return words[next(stops) - 1]
    return " ".join(said)


_STOPS = frozenset("( = [ ; if annotation constrainedby".split())


class Editor:
    """A person who edits a file; each added word is unique and begins with the person's name."""

    def __init__(self, name: str, random: Random, share: int | None = None) -> None:
        self._name, self._random, self._count = name, random, 0
        self._share = share
        """The person changes only the first or only the second of each two statements; None allows both."""

    def edit(self, text: str, kind: str) -> str:
        """Apply one edit to the text; the text stays if it has no place for the edit."""
        self._count += 1
        tag = f"{self._name}{self._count}"
        if kind in ("component", "connect", "equation"):
            return self._add(text, kind, tag)
        places = [one for number, one in enumerate(statements(text)) if self._share is None or self._is_his(one)]
        place = self._random.choice(places) if places else None
        if place is None:
            return text
        old = text[place.start : place.stop]
        return text[: place.start] + self._changed(old, kind, tag, place) + text[place.stop :]

    def _is_his(self, place: Statement) -> bool:
        return sum(place.key.encode()) % 2 == self._share

    def _add(self, text: str, kind: str, tag: str) -> str:
        found = [one for one in statements(text) if one.key != "annotation"]
        equations = [one for one in found if one.section == "equation"]
        declared = [one for one in found if one.section == "public"]
        line = {"component": f"Real {tag}(start = 1)", "connect": f"connect({tag}, a.b)", "equation": f"{tag} = 1"}[
            kind
        ]
        after = declared if kind == "component" else equations
        stop = after[-1].stop if after else (declared[-1].stop if kind == "component" and declared else None)
        return text if stop is None else f"{text[:stop]}\n  {line};{text[stop:]}"

    def _changed(self, old: str, kind: str, tag: str, place: Statement) -> str:
        head, _, note = old.partition("annotation")
        numbers = [token for token in lex(head)[0] if token.text[:1].isdecimal()]
        match kind:
            case "remark":
                return f"{old} // {tag}"
            case "comment":
                return f"/* {tag} */ {old}"
            case "remove" if place.key != "annotation" and place.section != "equation":
                return ""
            case "number" if numbers:
                number = self._random.choice(numbers)
                return f"{old[: number.start]}7171.{self._count}{old[number.start + len(number.text) :]}"
            case "modifier" if place.section == "public" and re.match(r"(?!annotation)[\w.\s]+\(\s*\w+ *=", old):
                return old.replace("(", f"({tag} = {self._count}, ", 1)
            case "type" if place.section == "public" and (
                found := re.match(r"(?!ext|ann|import)[\w.]+(?=\s+\w+\s*\()", old)
            ):
                return f"{tag}.Type{old[found.end() :]}"
            case "move" if "{{" in note:
                return f"{head}annotation" + re.sub(r"{{(-?)(?=[0-9])", r"{{\g<1>1", note, count=1)
        return old


KINDS = "component connect equation remark comment remove number modifier type move".split()
