"""Writes the URDF of a robot; each element has a line of its own, and the place in the source that it comes from."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape
from typing import Any

from urdfsync.formats.translation.files import SourcePlace

_BLANKS = {ord(blank): f"&#{ord(blank)};" for blank in "\n\r\t"}
"""Characters that XML would read as a space in an attribute."""
_DECIMALS = 15
"""Decimals of computed numbers: later digits are rounding errors."""


class UrdfElement:
    """An element of the URDF."""

    def __init__(self, tag: str, line: int | SourcePlace, /, text: str = "", **attributes: Any) -> None:
        """`line` is a number of a place, or the place itself, or 0 for that of the element around this one."""
        self.tag, self.line, self.text, self.attributes = tag, line, text, attributes
        self.children: list[UrdfElement] = []

    def add(self, tag: str, line: int | SourcePlace = 0, /, text: str = "", **attributes: Any) -> UrdfElement:
        """Add an element, and return it. Numbers are written with all their digits; None is left out."""
        self.children.append(child := UrdfElement(tag, line, text, **attributes))
        return child

    def lines(self, line: int | SourcePlace = 1, depth: int = 0) -> Iterator[tuple[str, int | SourcePlace]]:
        """Yield the lines of the text, each with its place, or the number of its place."""
        line, indent = self.line or line, "  " * depth
        written = {name: _text(value) for name, value in self.attributes.items() if value is not None}
        head = f"{indent}<{self.tag}{in_xml(written)}"
        if not self.children:
            yield f"{head}>{escape(self.text, quote=False)}</{self.tag}>" if self.text else f"{head}/>", line
            return
        yield f"{head}>", line
        for child in self.children:
            yield from child.lines(line, depth + 1)
        yield f"{indent}</{self.tag}>", line


def write(robot: UrdfElement, numbered: Sequence[SourcePlace] = ()) -> tuple[str, tuple[tuple[int, str, int], ...]]:
    """Return the text of a URDF, and each of its lines that begins another place in the files of the source.

    `numbered` has the places of the numbers 1, 2, …; any other number stands for the first place.
    """
    lines = list(robot.lines())
    places = [
        line if isinstance(line, tuple) else numbered[line - 1 if 0 < line <= len(numbered) else 0] for _, line in lines
    ]
    # a place holds until the next one
    changes = [number for number, place in enumerate(places) if not number or place != places[number - 1]]
    return "\n".join([*(text for text, _ in lines), ""]), tuple((number + 1, *places[number]) for number in changes)


def in_xml(attributes: Mapping[str, str]) -> str:
    """Return attributes as they stand in a tag, with a space before each."""
    # `xml.sax.saxutils` would do this, but loads a client of HTTP: 0.05 s of each translation
    quoted = {name: escape(value).translate(_BLANKS) for name, value in attributes.items()}
    return "".join(f' {name}="{value}"' for name, value in quoted.items())


def free_name(name: str, taken: set[str]) -> str:
    """Return a name that is not taken, perhaps with a number, and take it."""
    number, free = 2, name
    while free in taken:
        number, free = number + 1, f"{name}_{number}"
    taken.add(free)
    return free


def listed(names: Sequence[str]) -> str:
    """Return names in quotes, the first eight of them."""
    return ", ".join(map(repr, names[:8])) + (", …" if len(names) > 8 else "")


def rounded(numbers: Iterable[float]) -> tuple[float, ...]:
    """Return computed numbers without the digits that are rounding errors."""
    return tuple(round(float(number), _DECIMALS) for number in numbers)


def _text(value: str | float | Sequence[float]) -> str:
    if isinstance(value, str):
        return value
    numbers = (value,) if isinstance(value, float | int) else value
    return " ".join(repr(float(number) + 0.0) for number in numbers)  # adding 0.0 makes 0.0 of -0.0
