"""Elements to values: the structs of `urdf.robot` say what is read. Every fault becomes a diagnostic with its line.

A field of numbers or text is the attribute of its name, a field that is a struct the child element of its name; one
without a default is required. What no field asks for is kept as text (see `Extension`).

Numbers are decimals as ROS's urdfdom accepts them: no `nan`, `inf`, hexadecimals, underscores or decimal commas. A
value that can't be read is an error, and another takes its place, so that reading goes on and finds the next fault.
"""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any, TypeVar, get_args
from xml.etree.ElementTree import Element

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity, cut
from urdfsync.urdf.kinematics.poses import roll_pitch_yaw
from urdfsync.urdf.parse.xml import canonical, is_of_xml
from urdfsync.urdf.robot import Extension, JointType, Vector
from urdfsync.urdf.validate import Finding, diagnostic, perhaps

Values = TypeVar("Values", bound=msgspec.Struct)

_DECIMAL = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_BLANKS = re.compile(r"[ \t\r\n\f\v]+")
_COUNTS = {str: 0, JointType: 0, float: 1, float | None: 1, Vector: 3}
"""Numbers of an attribute, by the type of its field; 0 for text."""
_ONE_VALUE = {"parent": "link", "child": "link", "axis": "xyz", "mass": "value"}
"""Child elements that stand for a field of numbers or text, with their only attribute."""
_REPEATED = ("visual", "collision")
_ELSEWHERE = ("transmission",)
"""Fields whose elements do not stand in the element of their struct."""
# Elements of URDF: in a place where they mean nothing they are no misspelt other element.
_ELEMENTS = frozenset("link joint material inertial inertia visual collision origin geometry mass axis".split())
_SHOWN_ALONE = 3
_LINES_SHOWN = 8
_TEXT_SHOWN = 60


class Reader:
    """Reads elements of one file, each with its path in the robot, such as `joint elbow / limit`."""

    def __init__(self, lines: Mapping[Element, int]) -> None:
        self._lines_of_elements = lines
        self.version = 1, 0
        """Of URDF, as the file says."""
        self.lines: dict[str, int] = {}
        """By path: see `RobotReading`."""
        self.diagnostics: list[Diagnostic] = []
        """Without the name of the file."""
        self.modelled = set[Element]()
        """Of `kept` and the elements in them, those that something in the package shows."""
        self.kept: list[tuple[str, Element]] = []
        """The elements that no struct asks for, each with its owner."""
        self.unknown: list[tuple[str, Element]] = []
        """Attributes that URDF does not know, each with its element."""
        self.allowed: Collection[str] = ()
        """Codes of errors that are warnings here."""

    @property
    def failed(self) -> bool:
        """Whether an error was found."""
        return any(found.severity is Severity.ERROR for found in self.diagnostics)

    def add(self, element: Element, code: str, message: str, hint: str = "") -> None:
        """Add a finding about an element."""
        found = diagnostic(code, message, self._lines_of_elements[element], hint)
        if code in self.allowed:
            found = msgspec.structs.replace(found, severity=Severity.WARNING, hint="a build needs `allow` for it")
        self.diagnostics.append(found)

    def extend(self, findings: Iterable[Finding]) -> None:
        """Add findings about elements, at the lines of these or of the nearest ones that contain them."""
        for code, path, message, hint in findings:
            place = path
            while place not in self.lines and " / " in place:
                place = place.rpartition(" / ")[0]
            self.diagnostics.append(diagnostic(code, message, self.lines.get(place, self.lines["robot"]), hint))

    def drop_newer(self, element: Element, path: str, attributes: Iterable[str], version: tuple[int, int]) -> None:
        """Take attributes that URDF has since `version` out of an element of an older file, with a warning."""
        newer = [name for name in attributes if name in element.attrib] if self.version < version else []
        if newer:
            needed, given = (f"{major}.{minor}" for major, minor in (version, self.version))
            message = f"{path}: {', '.join(newer)} has no effect, since the file is of URDF {given}"
            self.add(element, "newer-attribute", message, f'write <robot version="{needed}" …>')
        for name in newer:
            del element.attrib[name]

    def line(self, element: Element) -> int:
        """Return the line of an element."""
        return self._lines_of_elements[element]

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
                self.add(child, "duplicate-element", f"{path} has another <{tag}>, and the first counts")
        return found

    def extension(self, child: Element, path: str, tags: Collection[str], owner: str) -> None:
        """Keep an element that has none of `tags`; warn about one that looks like a misspelt one."""
        if child.tag not in _ELEMENTS and ":" not in child.tag and (hint := perhaps(child.tag, tags, 0.8)):
            message = f"{path}: the element <{child.tag}> is unknown, and has no effect"
            self.add(child, "unknown-element", message, hint)
        self.kept.append((owner, child))

    def leave(self, element: Element, path: str, owner: str | None) -> None:
        """Keep all that is in an element which has only attributes."""
        for child in element if owner is not None else ():
            self.extension(child, path, (), owner or "")

    def show(self, element: Element, *attributes: str) -> None:
        """Note that the package shows what the text and some attributes of an element say."""
        self.modelled.add(element)
        for name in attributes:
            element.attrib.pop(name, None)

    def take_modelled(self) -> None:
        """Take what is modelled out of the elements that are kept: a change there is none of their text."""
        before = [(place, len(place[1])) for place in self.kept]
        self.kept = [
            (owner, element)
            for (owner, element), parts in before
            if self._has_rest(element) and (element.tag != "gazebo" or len(element) or not parts)
        ]

    def _has_rest(self, element: Element) -> bool:
        """Take what is modelled out of an element; return whether anything is left of it."""
        for child in list(element):
            if not self._has_rest(child):
                element.remove(child)
        has_attributes = any(name != "name" and not is_of_xml(name) for name in element.attrib)
        return element not in self.modelled or len(element) > 0 or has_attributes

    def extensions(self) -> tuple[Extension, ...]:
        """Return what is kept as text."""
        return tuple(Extension(owner, element.tag, canonical(element)) for owner, element in self.kept)

    def expect(self, element: Element, path: str, attributes: Collection[str]) -> None:
        """Warn about attributes that look like misspelt ones of `attributes`; note all others that have no meaning."""
        for name in element.attrib:
            if name in attributes or is_of_xml(name):
                continue
            others = [known for known in attributes if known not in element.attrib]
            if ":" not in name and (hint := perhaps(name, others)):
                message = f"{path}: the attribute {name!r} is unknown, and has no effect"
                self.add(element, "unknown-attribute", message, hint)
            else:
                self.unknown.append((name, element))

    def read(self, element: Element, path: str, struct: type[Values], owner: str | None = None, **given: Any) -> Values:
        """Return a struct from attributes and children, but for the fields that are `given`."""
        attributes, children, required = _schema(struct)
        self.expect(element, path, attributes)
        own = [self._value(element, path, name, count, default) for name, (count, default) in attributes.items()]
        if not children:
            if len(element):
                self.leave(element, path, owner)
            return struct(*own)
        values = {**given, **dict(zip(attributes, own, strict=True))}
        found = self.children(element, path, children, owner)
        for name, child in found.items():
            if name in values:
                continue
            kind, default = children[name]
            place = f"{path} / {name}"
            if name in _ONE_VALUE:
                self.expect(child, place, (_ONE_VALUE[name],))
                if len(child):
                    self.leave(child, place, owner)
                values[name] = self._value(child, place, _ONE_VALUE[name], kind, default)
            else:
                if name == "origin" and "quat_xyzw" in child.attrib:
                    self._write_as_rpy(child, place)
                values[name] = self.read(child, place, kind, owner)
        for name in required:
            if name not in found:
                self.add(element, "missing-element", f"{path} has no <{name}>")
                values[name] = ""
        return struct(**values)

    def _write_as_rpy(self, origin: Element, path: str) -> None:
        """Replace the `quat_xyzw` of an origin by the same orientation as `rpy`."""
        self.drop_newer(origin, path, ["quat_xyzw"], (1, 1))
        quaternion = self._value(origin, path, "quat_xyzw", 4, None)
        if quaternion is None:
            return
        if "rpy" in origin.attrib:
            self.add(origin, "two-orientations", f"{path} has an orientation as rpy and one as quat_xyzw")
        elif not any(quaternion):
            self.add(origin, "bad-number", f"{path}: quat_xyzw={quoted(origin.attrib['quat_xyzw'])} has no direction")
        else:
            origin.set("rpy", " ".join(map(repr, roll_pitch_yaw(quaternion))))
            del origin.attrib["quat_xyzw"]  # else it would be told as not modelled

    def _value(self, element: Element, path: str, name: str, count: int, default: Any) -> Any:
        text, is_required = element.get(name), default is msgspec.NODEFAULT
        if text is None:
            if not is_required:
                return default
            self.add(element, "missing-attribute", f"{path} has no attribute {name!r}")
        elif count:
            try:
                numbers = parse_numbers(text, count)
                return numbers[0] if count == 1 else numbers
            except ValueError as error:
                code = "bad-number" if text.strip() else "empty-attribute"
                self.add(element, code, f"{path}: {name}={quoted(text)} {error}")
        elif text.strip() or not is_required:
            return text
        else:
            self.add(element, "empty-attribute", f"{path}: the attribute {name!r} is empty")
        # in the place of a required value stands one that no later check complains of
        return ("", 1.0, None, (1.0, 1.0, 1.0))[count] if is_required else default


# 45,000 elements of a robot of 1,000 links have one of 15 kinds.
@functools.cache
def _schema(
    struct: type[msgspec.Struct],
) -> tuple[Mapping[str, tuple[int, Any]], Mapping[str, tuple[Any, Any]], Sequence[str]]:
    """Return attributes and children that an element has for a struct, and the children that must be there.

    Both have defaults; attributes have counts of numbers, 0 for text; children have these or the struct that they are.
    """
    attributes: dict[str, tuple[int, Any]] = {}
    children: dict[str, tuple[Any, Any]] = {}
    required: list[str] = []
    for field in msgspec.structs.fields(struct):
        kinds = (field.type, *get_args(field.type))
        structs = [kind for kind in kinds if isinstance(kind, type) and issubclass(kind, msgspec.Struct)]
        if field.name in _ELSEWHERE:
            continue
        if structs:
            name = field.name.removesuffix("s") if field.default == () else field.name  # visuals: elements <visual>
            children[name] = structs[0], field.default
        elif field.name in _ONE_VALUE:
            children[field.name] = _COUNTS[field.type], field.default
            if field.required:
                required.append(field.name)
        elif field.type in _COUNTS:
            attributes[field.name] = _COUNTS[field.type], field.default
    return attributes, children, required


# Many attributes have the same text, such as `xyz="0 0 0"`. Serves the row "one mass changed in the daemon, 1,000
# links" of docs/speed.md: 50 of 500 ms.
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
    """Return the text in quotes, cut if it is long."""
    return repr(cut(text, _TEXT_SHOWN))


def located(findings: Iterable[Finding], file: str, lines: Mapping[str, int]) -> tuple[Diagnostic, ...]:
    """Return findings about elements of a file that was read before, with the lines that its reading gave."""
    reader = Reader({})
    reader.lines.update(lines)
    reader.extend(findings)
    return summary(reader.diagnostics, file)


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
