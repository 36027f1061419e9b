"""Typed access to the attributes and children of URDF elements; every fault becomes a finding with its line.

Numbers are decimals as ROS's urdfdom takes them: no `nan`, `inf`, hexadecimals, underscores or decimal commas.
Defaults are given by the caller. A value that can't be read is an error, and its default stands in, so that
reading goes on and finds the next fault.
"""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Collection, Iterator
from typing import TypeVar

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf.reader.checks import nearest
from urdfsync.urdf.reader.xml import Node
from urdfsync.urdf.robot import Extension, Vector

Missing = TypeVar("Missing", float, None)

NUMBER = r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_BLANK = r"[ \t\r\n\f\v]"
_DECIMAL = re.compile(NUMBER)
_BLANKS = re.compile(f"{_BLANK}+")
_NUMBERS = {
    count: re.compile(rf"{_BLANK}*(?:{NUMBER}{_BLANK}+){{{count - 1}}}{NUMBER}{_BLANK}*") for count in (1, 3, 4)
}
"""That many decimal numbers between blanks."""
_ELEMENTS = {
    "link",
    "joint",
    "material",
    "inertial",
    "inertia",
    "visual",
    "collision",
    "origin",
    "geometry",
    "mass",
    "axis",
}
"""Elements of URDF that a stray place does not make misspelt ones."""
_GROUPED = 3
_LINES_SHOWN = 8
_SHOWN = 60


class Findings:
    """Collects what there is to say about a file, or a part of one, and the line of each element by its path."""

    def __init__(self, file: str = "", diagnostics: Collection[Diagnostic] = ()) -> None:
        self.file = file
        self.lines: dict[str, int] = {}
        self._diagnostics: list[Diagnostic] = []
        for found in diagnostics:
            self._diagnostics.append(msgspec.structs.replace(found, file=file))

    @property
    def failed(self) -> bool:
        """Whether an error was found."""
        return any(diagnostic.severity is Severity.ERROR for diagnostic in self._diagnostics)

    def add(self, severity: Severity, code: str, line: int, message: str, hint: str) -> None:
        """Add a finding about a line of the file."""
        self._diagnostics.append(Diagnostic(severity, code, message, self.file, line, hint=hint))

    def warn(self, code: str, line: int, message: str, hint: str) -> None:
        """Add a warning about a line of the file."""
        self.add(Severity.WARNING, code, line, message, hint)

    def adopt(self, part: Findings, line: int) -> None:
        """Add the findings of a part of the file whose line 0 is this one; of a path's lines the first counts."""
        for path, below in part.lines.items():
            self.lines.setdefault(path, line + below)
        for found in part._diagnostics:
            self.add(found.severity, found.code, line + found.line, found.message, found.hint)

    def say_as(self, other: Findings) -> bool:
        """Whether the other ones are the same."""
        return self.lines == other.lines and self._diagnostics == other._diagnostics

    def copy(self) -> Findings:
        """The same, to add others; all lines are known."""
        findings = Findings(self.file)
        findings.lines, findings._diagnostics = self.lines, [*self._diagnostics]
        return findings

    def line(self, path: str) -> int:
        """Line of the element, or of the nearest one that contains it; 0 if unknown."""
        while path not in self.lines:
            path, separator, _ = path.rpartition(" / ")
            if not separator:
                return self.lines.get("robot", 0)
        return self.lines[path]

    def result(self) -> tuple[Diagnostic, ...]:
        """All findings by line; more than three warnings of one code are told as one."""
        by_code: dict[tuple[Severity, str], list[Diagnostic]] = {}
        for diagnostic in sorted(self._diagnostics, key=lambda diagnostic: (diagnostic.line, diagnostic.column)):
            by_code.setdefault((diagnostic.severity, diagnostic.code), []).append(diagnostic)
        told: list[Diagnostic] = []
        for (severity, _), group in by_code.items():
            told += group if severity is Severity.ERROR or len(group) <= _GROUPED else [_as_one(group)]
        return tuple(sorted(told, key=lambda diagnostic: (diagnostic.line, diagnostic.column)))


def _as_one(group: list[Diagnostic]) -> Diagnostic:
    """The first of the findings, with the lines of the others in its message."""
    lines = list(dict.fromkeys(str(diagnostic.line) for diagnostic in group[1:]))
    shown = ", ".join(lines[:_LINES_SHOWN]) + (", …" if len(lines) > _LINES_SHOWN else "")
    message = f"{group[0].message} (and {len(group) - 1} more like it: line{'s' * (len(lines) > 1)} {shown})"
    return msgspec.structs.replace(group[0], message=message)


class Element(msgspec.Struct, frozen=True, eq=False):
    """An element of the URDF with its place in the robot, for example `joint elbow / limit`."""

    node: Node
    path: str
    findings: Findings

    def __post_init__(self) -> None:
        self.findings.lines.setdefault(self.path, self.node.line)

    def error(self, code: str, message: str, hint: str) -> None:
        """Add an error about this element."""
        self.findings.add(Severity.ERROR, code, self.node.line, message, hint)

    def warn(self, code: str, message: str, hint: str) -> None:
        """Add a warning about this element."""
        self.findings.warn(code, self.node.line, message, hint)

    def child(self, tag: str, *attributes: str) -> Element | None:
        """The first child with this tag; `attributes` are those that URDF knows, to find misspelt ones."""
        found = [node for node in self.node.children if node.tag == tag]
        if not found:
            return None
        element = Element(found[0], f"{self.path} / {tag}", self.findings)
        if len(found) > 1:
            message = f"{self.path} has {len(found)} <{tag}> elements, of which the first counts"
            extra = Element(found[1], f"{element.path} #2", self.findings)
            extra.warn("duplicate-element", message, "remove the others")
        element.expect(attributes)
        return element

    def expect(self, attributes: Collection[str]) -> None:
        """Warn about attributes that look like misspelt ones of `attributes`."""
        for name in self.node.attributes:
            if name not in attributes:
                absent = [known for known in attributes if known not in self.node.attributes]
                if meant := nearest(name, absent):
                    message = f"{self.path}: the attribute {name!r} is unknown, and has no effect"
                    self.warn("unknown-attribute", message, f"perhaps {meant!r} is meant")

    def extensions(self, owner: str, tags: Collection[str]) -> Iterator[Extension]:
        """The children that have none of `tags`; warns about those that look like a misspelt one."""
        for node in self.node.children:
            if node.tag not in tags:
                yield extension(owner, node, self.path, tags, self.findings)

    def text(self, name: str) -> str:
        """A text that must be there; an empty one, after an error, if it is not."""
        self._require(name)
        value = self.node.attributes.get(name, "")
        if name in self.node.attributes and not value.strip():
            self.error("empty-attribute", f"{self.path}: the attribute {name!r} is empty", "fill it in")
        return value if value.strip() else ""

    def number(self, name: str, missing: Missing) -> float | Missing:
        """A decimal number, or `missing` if the attribute is absent."""
        values = self._numbers(name, 1)
        return missing if values is None else values[0]

    def required(self, name: str) -> float:
        """A decimal number that must be there; 1, after an error, if it is not."""
        self._require(name)
        return self.number(name, 1.0)

    def required_vector(self, name: str) -> Vector:
        """Three decimal numbers that must be there; ones, after an error, if they are not."""
        self._require(name)
        return self.vector(name, (1.0, 1.0, 1.0))

    def vector(self, name: str, missing: Vector) -> Vector:
        """Three decimal numbers, or `missing` if the attribute is absent."""
        values = self._numbers(name, 3)
        return missing if values is None else (values[0], values[1], values[2])

    def _require(self, name: str) -> None:
        """Add an error if the attribute is absent."""
        if name not in self.node.attributes:
            self.error("missing-attribute", f"{self.path} has no attribute {name!r}", f"add {name}=…")

    def _numbers(self, name: str, count: int) -> tuple[float, ...] | None:
        """The numbers of an attribute; None if it is absent, or after an error."""
        text = self.node.attributes.get(name)
        if text is None:
            return None
        try:
            return parse_numbers(text, count)
        except ValueError as error:
            code = "bad-number" if text.strip() else "empty-attribute"
            message = f"{self.path}: {name}={brief(text)} {error}"
            self.error(code, message, "write decimal numbers such as -0.5 or 1e-3")
            return None


def extension(owner: str, node: Node, path: str, tags: Collection[str], findings: Findings) -> Extension:
    """A child of the element at `path` that has none of `tags`; warns about one that looks like a misspelt one."""
    if node.tag not in _ELEMENTS and ":" not in node.tag and (meant := nearest(node.tag, tags, 0.8)):
        message = f"{path}: the element <{node.tag}> is unknown, and has no effect"
        findings.warn("unknown-element", node.line, message, f"perhaps <{meant}> is meant")
    return Extension(owner, node.tag, node.canonical())


@functools.lru_cache(maxsize=1024)
def parse_numbers(text: str, count: int) -> tuple[float, ...]:
    """Exactly `count` decimal numbers between blanks; raises ValueError that says what is wrong.

    Negative zero becomes zero, so that it makes no difference between two exports.
    """
    if not _NUMBERS[count].fullmatch(text):
        words = [word for word in _BLANKS.split(text) if word]
        wrong = next((word for word in words if not _DECIMAL.fullmatch(word)), None)
        if wrong is None:
            raise ValueError(f"has {len(words)} numbers instead of {count}")
        raise ValueError(f"is not a decimal number{f': {brief(wrong)}' if len(words) > 1 else ''}")
    values = tuple([float(word) + 0.0 for word in text.split()])
    if not all(map(math.isfinite, values)):
        raise ValueError("is too large for a floating-point number")
    return values


def brief(text: str) -> str:
    """The text in quotes, cut off if it is long."""
    return repr(text if len(text) <= _SHOWN else text[:_SHOWN] + "…")
