"""A `.mo` file as an editor saves it: with other blanks and line breaks, and the same words in the same order."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping

from urdfsync.modelica.lexer import lex
from urdfsync.modelica.parser import SECTIONS


@dataclasses.dataclass(frozen=True)
class Style:
    """The layout of an editor."""

    indent: str
    equals: str
    """The sign of a modifier, with its blanks."""
    comma: str
    annotation: str
    """The beginning of an annotation, with the blanks before it."""
    item: str = ""
    """The blanks before each item of an outermost list, after the blanks of a comma."""
    between: str = ""
    """A line between declarations."""
    ending: str = "\n"


STYLES: Mapping[str, Style] = {
    "OMEdit": Style("  ", " = ", ", ", " annotation(\n    "),
    "Dymola": Style("  ", "=", ",", "\n    annotation (", between="\n"),
    "own": Style("\t", "\t= ", " ,", "\n\tannotation\n\t( ", item="\n\t\t", ending="\r\n"),
}


def resaved(text: str, style: Style) -> str:
    """The text in a style; comments stay, each with the blanks around it."""
    tokens, _ = lex(text)
    found, depth, place, before = "", 0, 0, ""
    words = [token.text for token in tokens]
    for number, token in enumerate(tokens):
        gap, word = text[place : token.start], token.text
        place = token.start + len(word)
        if "/*" in gap or "//" in gap:
            found += gap + word
        elif before == "annotation":
            pass  # the bracket is written already
        elif word == "annotation":
            found += f"\n{style.indent}{style.annotation.lstrip()}" if before == ";" else style.annotation
        elif not before or not word:
            found += gap + word
        elif not depth and (before == ";" or _is_header(words, number)):
            outer = word == "end" or word in SECTIONS
            found += f"\n{style.between}{'' if outer else style.indent}{word}"
        elif word == "=" and depth:
            found += style.equals
        elif word == ",":
            found += style.comma
        elif depth == 1 and before in ("(", ","):
            found += style.item + word
        elif depth == 0 and word == "=":
            found += f" {word} "
        elif _run_together(before, word) or (not depth and before not in (".", "(", "[") and word not in _TIGHT):
            found += " " + word
        else:
            found += word
        depth += (word in ("(", "[", "{")) - (word in (")", "]", "}"))
        before = word
    return found.replace("\r\n", "\n").replace("\n", style.ending)


_TIGHT = frozenset("; . ( [ ) ] { } , :".split())


def _run_together(one: str, other: str) -> bool:
    """Whether two tokens would be read as one."""
    return bool(re.fullmatch(r"[\w'].*", other) and re.fullmatch(r".*[\w']", one)) or f"{one}{other}" in (
        ":=", "==", "<=", ">=", "<>", "//", "/*",
    )  # fmt: skip


def _is_header(words: list[str], number: int) -> bool:
    """Whether a declaration begins behind a section, or behind the name and the description of the class."""
    last = number - 2 if words[number - 1][:1] == '"' else number - 1
    is_head = last > 0 and words[last - 1] in ("model", "record", "block", "package", "function") and last < 12
    return words[number - 1] in SECTIONS or (is_head and words[number][:1] != '"')
