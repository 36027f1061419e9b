"""Typed access to the attributes and children of URDF elements; every fault becomes a diagnostic with its line.

Numbers are decimals as ROS's urdfdom accepts them: no `nan`, `inf`, hexadecimals, underscores or decimal commas. A
value that can't be read is an error, and another takes its place, so that reading goes on and finds the next fault.
"""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any, TypeVar
from xml.etree.ElementTree import Element

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf.parse.xml import canonical
from urdfsync.urdf.robot import Extension
from urdfsync.urdf.validate import Finding, nearest

Values = TypeVar("Values", bound=msgspec.Struct)

_DECIMAL = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_BLANKS = re.compile(r"[ \t\r\n\f\v]+")
_REPEATED = ("visual", "collision")
# Elements of URDF: in a place where they mean nothing they are no misspelt other element.
_ELEMENTS = frozenset("link joint material inertial inertia visual collision origin geometry mass axis".split())
_SHOWN_ALONE = 3
_LINES_SHOWN = 8
_TEXT_SHOWN = 60


class Reader:
    """Reads elements of one file, each with its path in the robot, such as `joint elbow / limit`."""

    def __init__(self, lines: Mapping[Element, int]) -> None:
        self._lines_of_elements = lines
        self.lines: dict[str, int] = {}
        """By path: see `RobotReading`."""
        self.diagnostics: list[Diagnostic] = []
        """Without the name of the file."""
        self.extensions: list[Extension] = []

    @property
    def failed(self) -> bool:
        """Whether an error was found."""
        return any(found.severity is Severity.ERROR for found in self.diagnostics)

    def error(self, element: Element, code: str, message: str, hint: str) -> None:
        """Add an error about an element."""
        line = self._lines_of_elements[element]
        self.diagnostics.append(Diagnostic(Severity.ERROR, code, message, line=line, hint=hint))

    def warn(self, element: Element, code: str, message: str, hint: str) -> None:
        """Add a warning about an element."""
        line = self._lines_of_elements[element]
        self.diagnostics.append(Diagnostic(Severity.WARNING, code, message, line=line, hint=hint))

    def extend(self, findings: Iterable[Finding]) -> None:
        """Add what checks say about elements, at the lines of these or of the nearest ones that contain them."""
        for severity, code, path, message, hint in findings:
            place = path
            while place not in self.lines and " / " in place:
                place = place.rpartition(" / ")[0]
            line = self.lines.get(place, self.lines["robot"])
            self.diagnostics.append(Diagnostic(severity, code, message, line=line, hint=hint))

    def place(self, element: Element, path: str) -> str:
        """Remember the line of an element; return its path."""
        self.lines.setdefault(path, self._lines_of_elements[element])
        return path

    def children(
        self, element: Element, path: str, tags: Collection[str], owner: str | None = None
    ) -> dict[str, Element]:
        """Return the first child of each tag, visuals and collisions aside; others become extensions of `owner`."""
        found: dict[str, Element] = {}
        for child in element:
            tag = child.tag
            if tag not in tags:
                if owner is not None:
                    self.extension(child, path, tags, owner)
            elif tag in _REPEATED:
                continue
            elif tag not in found:
                found[tag] = child
                self.place(child, f"{path} / {tag}")
            else:
                message = f"{path} has another <{tag}>, and the first counts"
                self.warn(child, "duplicate-element", message, "remove the others")
        return found

    def extension(self, child: Element, path: str, tags: Collection[str], owner: str) -> None:
        """Keep an element that has none of `tags`; warn about one that looks like a misspelt one."""
        if child.tag not in _ELEMENTS and ":" not in child.tag and (meant := nearest(child.tag, tags, 0.8)):
            message = f"{path}: the element <{child.tag}> is unknown, and has no effect"
            self.warn(child, "unknown-element", message, f"perhaps <{meant}> is meant")
        self.extensions.append(Extension(owner, child.tag, canonical(child)))

    def expect(self, element: Element, path: str, attributes: Collection[str]) -> None:
        """Warn about attributes that look like misspelt ones of `attributes`."""
        for name in element.keys():  # noqa: SIM118 - an element is no mapping
            if name in attributes or ":" in name:
                continue
            if meant := nearest(name, [known for known in attributes if known not in element.attrib]):
                message = f"{path}: the attribute {name!r} is unknown, and has no effect"
                self.warn(element, "unknown-attribute", message, f"perhaps {meant!r} is meant")

    def read(self, element: Element, path: str, kind: type[Values]) -> Values:
        """Return a struct whose fields are the attributes, by their names, types and defaults.

        An attribute without a default is required.
        """
        self.expect(element, path, kind.__struct_fields__)
        return kind(*[self._value(element, path, *field) for field in _fields(kind)])

    def _value(self, element: Element, path: str, name: str, count: int, default: Any) -> Any:
        if default is msgspec.NODEFAULT:
            if count == 0:
                return self.text(element, path, name)
            if name not in element.attrib:
                self._missing(element, path, name)
            default = 1.0 if count == 1 else (1.0,) * count
        numbers = self.numbers(element, path, name, count)
        if numbers is None:
            return default
        return numbers[0] if count == 1 else numbers

    def numbers(self, element: Element, path: str, name: str, count: int) -> tuple[float, ...] | None:
        """Return the numbers of an attribute; None if it is absent, or after an error."""
        text = element.get(name)
        if text is None:
            return None
        try:
            return parse_numbers(text, count)
        except ValueError as error:
            code = "bad-number" if text.strip() else "empty-attribute"
            message = f"{path}: {name}={quoted(text)} {error}"
            self.error(element, code, message, "write decimal numbers such as -0.5 or 1e-3")
            return None

    def text(self, element: Element, path: str, name: str) -> str:
        """Return a text that must be there; an empty one, after an error, if it is not."""
        text = element.get(name)
        if text is None:
            self._missing(element, path, name)
        elif not text.strip():
            self.error(element, "empty-attribute", f"{path}: the attribute {name!r} is empty", "fill it in")
        return text if text and text.strip() else ""

    def _missing(self, element: Element, path: str, name: str) -> None:
        self.error(element, "missing-attribute", f"{path} has no attribute {name!r}", f"add {name}=…")


@functools.cache
def _fields(kind: type[msgspec.Struct]) -> Sequence[tuple[str, int, Any]]:
    """Return name, count of numbers (0 for a text) and default of each field."""
    counts = {str: 0, float: 1, float | None: 1}
    return [(field.name, counts.get(field.type, 3), field.default) for field in msgspec.structs.fields(kind)]


# Many attributes of a robot have the same text, such as `xyz="0 0 0"`: this saves a third of reading 1,000 links.
@functools.lru_cache(maxsize=1024)
def parse_numbers(text: str, count: int) -> tuple[float, ...]:
    """Return exactly `count` decimal numbers between blanks; raise ValueError that says what is wrong.

    Negative zero becomes zero, so that it makes no difference between two exports.
    """
    words = [word for word in _BLANKS.split(text) if word]
    wrong = next((word for word in words if not _DECIMAL.fullmatch(word)), None)
    if wrong is not None:
        raise ValueError(f"is not a decimal number{f': {quoted(wrong)}' if len(words) > 1 else ''}")
    if len(words) != count:
        raise ValueError(f"has {len(words)} numbers instead of {count}")
    values = tuple([float(word) + 0.0 for word in words])
    if not all(map(math.isfinite, values)):
        raise ValueError("is too large for a floating-point number")
    return values


def quoted(text: str) -> str:
    """Return the text in quotes, cut off if it is long."""
    return repr(text if len(text) <= _TEXT_SHOWN else text[:_TEXT_SHOWN] + "…")


def summary(diagnostics: Iterable[Diagnostic], file: str) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of a file by line; more than three warnings of one code become one."""
    by_code: dict[tuple[Severity, str], list[Diagnostic]] = {}
    for found in sorted(diagnostics, key=lambda found: (found.line, found.column)):
        by_code.setdefault((found.severity, found.code), []).append(msgspec.structs.replace(found, file=file))
    shown: list[Diagnostic] = []
    for (severity, _), group in by_code.items():
        if severity is Severity.ERROR or len(group) <= _SHOWN_ALONE:
            shown += group
            continue
        lines = list(dict.fromkeys(str(found.line) for found in group[1:]))
        listed = ", ".join(lines[:_LINES_SHOWN]) + (", …" if len(lines) > _LINES_SHOWN else "")
        more = f"(and {len(group) - 1} more like it: line{'s' * (len(lines) > 1)} {listed})"
        shown.append(msgspec.structs.replace(group[0], message=f"{group[0].message} {more}"))
    return tuple(sorted(shown, key=lambda found: (found.line, found.column)))
