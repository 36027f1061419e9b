"""Typed access to the attributes and children of URDF elements; every fault becomes a diagnostic with its line.

Numbers are decimals as ROS's urdfdom accepts them: no `nan`, `inf`, hexadecimals, underscores or decimal commas. A
value that can't be read is an error, and a default takes its place, so that reading goes on and finds the next fault.
"""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Collection, Iterable, Iterator
from typing import Any, TypeVar

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf.parse.xml import Node
from urdfsync.urdf.robot import Extension, Vector
from urdfsync.urdf.validate import Finding, nearest

Missing = TypeVar("Missing", float, None)
Numbers = TypeVar("Numbers", bound=msgspec.Struct)

_DECIMAL = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_BLANKS = re.compile(r"[ \t\r\n\f\v]+")
# Elements of URDF: in a place where they mean nothing they are no misspelt other element.
_ELEMENTS = frozenset("link joint material inertial inertia visual collision origin geometry mass axis".split())
_SHOWN_ALONE = 3
_LINES_SHOWN = 8
_TEXT_SHOWN = 60


class Findings:
    """Collects the diagnostics of one file, and the line of each element by its path (see `RobotReading.lines`)."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.lines: dict[str, int] = {}
        self._diagnostics: list[Diagnostic] = []

    @property
    def failed(self) -> bool:
        """Whether an error was found."""
        return any(diagnostic.severity is Severity.ERROR for diagnostic in self._diagnostics)

    def extend(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Add diagnostics that do not have the file's name yet."""
        self._diagnostics += (msgspec.structs.replace(found, file=self.file) for found in diagnostics)

    def extend_checks(self, findings: Iterable[Finding]) -> None:
        """Add what checks say about elements, at the lines of these."""
        for found in findings:
            self.add(found.severity, found.code, self.line(found.path), found.message, found.hint)

    def add(self, severity: Severity, code: str, line: int, message: str, hint: str) -> None:
        """Add a diagnostic about a line of the file."""
        self._diagnostics.append(Diagnostic(severity, code, message, self.file, line, hint=hint))

    def warn(self, code: str, line: int, message: str, hint: str) -> None:
        """Add a warning about a line of the file."""
        self.add(Severity.WARNING, code, line, message, hint)

    def line(self, path: str) -> int:
        """Return the line of the element, or of the nearest one that contains it; 0 if unknown."""
        while path not in self.lines:
            path, separator, _ = path.rpartition(" / ")
            if not separator:
                return self.lines.get("robot", 0)
        return self.lines[path]

    def result(self) -> tuple[Diagnostic, ...]:
        """Return all diagnostics by line; more than three warnings of one code become one."""
        by_code: dict[tuple[Severity, str], list[Diagnostic]] = {}
        for diagnostic in sorted(self._diagnostics, key=lambda found: (found.line, found.column)):
            by_code.setdefault((diagnostic.severity, diagnostic.code), []).append(diagnostic)
        shown: list[Diagnostic] = []
        for (severity, _), group in by_code.items():
            if severity is Severity.ERROR or len(group) <= _SHOWN_ALONE:
                shown += group
                continue
            lines = list(dict.fromkeys(str(diagnostic.line) for diagnostic in group[1:]))
            listed = ", ".join(lines[:_LINES_SHOWN]) + (", …" if len(lines) > _LINES_SHOWN else "")
            more = f"(and {len(group) - 1} more like it: line{'s' * (len(lines) > 1)} {listed})"
            shown.append(msgspec.structs.replace(group[0], message=f"{group[0].message} {more}"))
        return tuple(sorted(shown, key=lambda found: (found.line, found.column)))


class Element(msgspec.Struct, frozen=True, eq=False, gc=False):
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
        """Return the first child with this tag; `attributes` are those that URDF knows, to find misspelt ones."""
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
        given = self.node.attributes
        for name in given:
            if name in attributes or ":" in name:
                continue
            if meant := nearest(name, [known for known in attributes if known not in given]):
                message = f"{self.path}: the attribute {name!r} is unknown, and has no effect"
                self.warn("unknown-attribute", message, f"perhaps {meant!r} is meant")

    def extensions(self, owner: str, tags: Collection[str]) -> Iterator[Extension]:
        """Yield the children that have none of `tags`; warn about those that look like a misspelt one."""
        for node in self.node.children:
            if node.tag in tags:
                continue
            if node.tag not in _ELEMENTS and ":" not in node.tag and (meant := nearest(node.tag, tags, 0.8)):
                message = f"{self.path}: the element <{node.tag}> is unknown, and has no effect"
                self.findings.warn("unknown-element", node.line, message, f"perhaps <{meant}> is meant")
            yield Extension(owner, node.tag, node.canonical())

    def text(self, name: str) -> str:
        """Return a text that must be there; an empty one, after an error, if it is not."""
        self._require(name)
        value = self.node.attributes.get(name, "")
        if name in self.node.attributes and not value.strip():
            self.error("empty-attribute", f"{self.path}: the attribute {name!r} is empty", "fill it in")
        return value if value.strip() else ""

    def number(self, name: str, missing: Missing) -> float | Missing:
        """Return a number, or `missing` if the attribute is absent."""
        values = self._numbers(name, 1)
        return missing if values is None else values[0]

    def numbers(self, kind: type[Numbers]) -> Numbers:
        """Return a struct of numbers; its fields have the names of the attributes, and their defaults."""
        defaults: tuple[Any, ...] = kind.__struct_defaults__
        return kind(*map(self.number, kind.__struct_fields__, defaults))

    def vector(self, name: str, missing: Vector) -> Vector:
        """Return three numbers, or `missing` if the attribute is absent."""
        values = self._numbers(name, 3)
        return missing if values is None else (values[0], values[1], values[2])

    def required(self, name: str) -> float:
        """Return a number that must be there; 1, after an error, if it is not."""
        self._require(name)
        return self.number(name, 1.0)

    def required_vector(self, name: str) -> Vector:
        """Return three numbers that must be there; ones, after an error, if they are not."""
        self._require(name)
        return self.vector(name, (1.0, 1.0, 1.0))

    def _require(self, name: str) -> None:
        if name not in self.node.attributes:
            self.error("missing-attribute", f"{self.path} has no attribute {name!r}", f"add {name}=…")

    def _numbers(self, name: str, count: int) -> tuple[float, ...] | None:
        """Return the numbers of an attribute; None if it is absent, or after an error."""
        text = self.node.attributes.get(name)
        if text is None:
            return None
        try:
            return parse_numbers(text, count)
        except ValueError as error:
            code = "bad-number" if text.strip() else "empty-attribute"
            message = f"{self.path}: {name}={quoted(text)} {error}"
            self.error(code, message, "write decimal numbers such as -0.5 or 1e-3")
            return None


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
