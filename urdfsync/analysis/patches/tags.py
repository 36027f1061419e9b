"""Finds the places of an edit in the start tags of its element, where no reading shows its number."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from urdfsync.analysis.patches.edited import EditedValue
from urdfsync.analysis.patches.feeds import NewTexts
from urdfsync.analysis.patches.literals import Literal, literals_in

_TAG = re.compile(r"""<(?!xacro:)[\w:.-]++(?:[^<>"']++|"[^"]*"|'[^']*')*+>""")
_ATTRIBUTE = re.compile(r"""\s([\w:.-]+)\s*=\s*(?:"([^"]*)"|'([^']*)')""")
_LINE_END = re.compile(r"\r\n|\r|\n")


def start_tags(text: str, line: int) -> Iterator[re.Match[str]]:
    """Yield the start tags that begin in a line of a text, without those of xacro."""
    starts = [0, *(match.end() for match in _LINE_END.finditer(text)), len(text)]
    for match in _TAG.finditer(text, starts[min(line, len(starts) - 1) - 1]):
        if match.start() >= starts[min(line, len(starts) - 1)]:
            return
        yield match


def find_same(file: Path, text: str, tag: re.Match[str], value: EditedValue) -> Iterator[NewTexts]:
    """Yield the new numbers of each attribute that has the old ones."""
    for attribute in _ATTRIBUTE.finditer(tag[0]):
        group = 2 if attribute[2] is not None else 3
        start, end = (tag.start() + place for place in attribute.span(group))
        found = literals_in(file, text, start, end)
        if value.old and tuple(literal.value for literal in found) == value.old:
            yield {found[k]: value.words[k] for k in value.changed}


def find_empty(
    file: Path, text: str, line: int, tag: re.Match[str], value: EditedValue, present: Sequence[str]
) -> Iterator[Literal]:
    """Yield the places for a new attribute or element of a tag; the tag has elements of the `present` names."""
    *_, around, name = ["", *map(_snake, value.key[1].split("."))]
    quote = "'" if "'" in tag[0] and '"' not in tag[0] else '"'
    attributes = list(_ATTRIBUTE.finditer(tag[0]))
    if name not in [attribute[1] for attribute in attributes]:
        end = attributes[-1].end() if attributes else len(tag[0].rstrip("/>"))
        yield Literal(file, tag.start() + end, "", line, attribute=f" {name}={quote}")
    for element, attribute in (around, name), (name, "xyz" if len(value.new) > 1 else "value"):
        # a second element would take the place of the first one, with a warning
        if element and element not in present and not tag[0].endswith("/>"):
            beginning = f"{_indentation(text, tag)}<{element}"
            yield Literal(file, tag.end(), "", line, element=beginning, attribute=f' {attribute}="')


def _snake(name: str) -> str:
    return re.sub("([A-Z])", lambda match: f"_{match[1].lower()}", name)


def _indentation(text: str, tag: re.Match[str]) -> str:
    """Return the line end and the indentation of a new child of a tag; empty if its children are in the tag's line."""
    end = _LINE_END.match(text, tag.end())
    before = text[: tag.start()]
    line = before[max(before.rfind("\n"), before.rfind("\r")) + 1 :]
    return f"{end[0]}{line[len(line.rstrip()) :]}  " if end else ""
