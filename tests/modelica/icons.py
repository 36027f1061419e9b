"""What annotations of the library's classes say of icons.

Icons are inherited from classes of the library; those of the standard library are not looked up.
"""

from __future__ import annotations

import dataclasses
import functools
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from urdfsync.modelica.lexer import lex

LIBRARY = Path(__file__).parents[2] / "modelica" / "UrdfSync"

Point = tuple[float, float]

_CLOSING = {")", "}", "]", ",", ";"}


@dataclasses.dataclass(frozen=True)
class Call:
    """What annotations are made of: `name(key=value, …)`; arguments without a key are not kept."""

    name: str
    arguments: Mapping[str, Any]

    def get(self, key: str, default: Any = None) -> Any:
        """The argument `key`, or `default` where it is not given."""
        return self.arguments.get(key, default)


class _Reader:
    """Reads values of annotations: numbers, strings, names, arrays, calls; other expressions as their text."""

    def __init__(self, words: Sequence[str], start: int) -> None:
        self._words, self._next = words, start

    def value(self) -> Any:
        """The value that begins here."""
        start = self._next
        result = self._primary()
        depth = 0
        while depth or self._peek() not in _CLOSING:
            depth += {"(": 1, "{": 1, "[": 1, ")": -1, "}": -1, "]": -1}.get(self._take(), 0)
            result = " ".join(self._words[start : self._next])
        return result

    def _primary(self) -> Any:
        word = self._take()
        if word[0].isdigit() or (word in "-." and self._peek()[:1].isdigit()):
            return float(word if word[0].isdigit() else word + self._take())
        if word[0] == '"':
            return word[1:-1].replace('\\"', '"').replace("\\\\", "\\")
        if word == "{":
            return [value for _, value in self._items("}")]
        while self._peek() == ".":
            word += self._take() + self._take()
        if word[0].isalpha() and self._peek() == "(":
            self._take()
            return Call(word, {key: value for key, value in self._items(")") if key})
        return word

    def _items(self, end: str) -> Iterator[tuple[str, Any]]:
        while self._peek() != end:
            key = ""
            if self._words[self._next + 1] == "=":
                key = self._take()
                self._take()
            result = self.value()
            yield (key or (result.name if isinstance(result, Call) and end == ")" else "")), result
            if self._peek() == ",":
                self._take()
        self._take()

    def _peek(self) -> str:
        return self._words[self._next]

    def _take(self) -> str:
        self._next += 1
        return self._words[self._next - 1]


def annotations_in(text: str) -> list[Call]:
    """Every `annotation (…)` of a Modelica text, in the order of the text."""
    words = [token.text for token in lex(text)[0]]
    return [_Reader(words, at).value() for at, word in enumerate(words) if word == "annotation"]


@dataclasses.dataclass(frozen=True)
class Icon:
    """The graphics of a class, those of its base classes first."""

    graphics: tuple[Call, ...] = ()
    extent: tuple[Point, Point] = ((-100, -100), (100, 100))
    """Lower left and upper right corner of its coordinate system."""


_EXTENDS = re.compile(r"^ *extends (UrdfSync\.[\w.]+)", re.MULTILINE)


def source(name: str) -> str:
    """Text of the class with the full name `name`, from its own file or the `package.mo` of its own folder."""
    path = LIBRARY.parent.joinpath(*name.split("."))
    return (path / "package.mo" if path.is_dir() else path.with_suffix(".mo")).read_text("utf-8")


def bases(text: str) -> list[str]:
    """Full names of the classes of the library that a Modelica text extends."""
    return _EXTENDS.findall(text)


@functools.cache
def icon(name: str) -> Icon:
    """The icon of the class with the full name `name`."""
    text = source(name)
    inherited = [icon(base) for base in bases(text)]
    own = [
        graphic for note in annotations_in(text) for graphic in note.get("Icon", Call("Icon", {})).get("graphics", [])
    ]
    notes = [note.get("Icon") for note in annotations_in(text) if note.get("Icon")]
    system = next((note.get("coordinateSystem") for note in notes), None)
    lower, upper = system.get("extent") if system else next((base.extent for base in inherited), Icon.extent)
    return Icon(
        (*(graphic for base in inherited for graphic in base.graphics), *own),
        ((lower[0], lower[1]), (upper[0], upper[1])),
    )


def corners(graphic: Call) -> list[Point]:
    """The points that bound a graphic, turned and moved as `rotation` and `origin` say (coordinates of the icon)."""
    points: list[Point] = [(x, y) for x, y in graphic.get("points") or graphic.get("extent")]
    if "extent" in graphic.arguments:
        (x1, y1), (x2, y2) = points
        points = [(x1, y1), (x2, y1), (x2, y2), (x1, y2)]
    angle = math.radians(graphic.get("rotation", 0.0))
    x0, y0 = graphic.get("origin", [0.0, 0.0])
    c, s = math.cos(angle), math.sin(angle)
    return [(x0 + c * x - s * y, y0 + s * x + c * y) for x, y in points]


def classes() -> list[str]:
    """Full names of all classes of the library that have a file of their own, packages included."""
    files = sorted(LIBRARY.rglob("*.mo"))
    paths = [file.parent if file.name == "package.mo" else file.with_suffix("") for file in files]
    return [".".join(path.relative_to(LIBRARY.parent).parts) for path in paths]
