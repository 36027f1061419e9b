"""Reads elements into the structs of `urdf.robot`.

A field of numbers or text is the attribute of its name. A field that is a struct is the child element of its name. One
without a default is required. What no field asks for is kept as text (see `Robot.extensions`).

Numbers are decimals as ROS's urdfdom accepts them: no `nan`, `inf`, hexadecimals, underscores or decimal commas. An
unreadable value is an error. A default replaces it, so that the reading goes on and finds the next fault.
"""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Annotated, Any, TypeVar, get_args, get_origin
from xml.etree.ElementTree import Element

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity, cut
from urdfsync.urdf.kinematics.poses import roll_pitch_yaw
from urdfsync.urdf.robot import JointType, Vector
from urdfsync.urdf.validate import Finding, diagnostic, perhaps

Values = TypeVar("Values", bound=msgspec.Struct)

_DECIMAL = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_BLANKS = re.compile(r"[ \t\r\n\f\v]+")
_COUNTS = {str: 0, JointType: 0, float: 1, float | None: 1, Vector: 3}
"""Numbers of an attribute, by the type of its field; 0 for text."""
_ONE_VALUE = {"parent": "link", "child": "link", "axis": "xyz", "mass": "value"}
"""Child elements of fields of numbers or text, with their only attribute."""
_REPEATED = ("visual", "collision")
_ELSEWHERE = ("transmission", "start")
"""Fields whose elements are outside of their struct's element."""
# Elements of URDF. In a place where one means nothing, it is not taken for a misspelt other element.
_ELEMENTS = frozenset("link joint material inertial inertia visual collision origin geometry mass axis".split())
_SHOWN_ALONE = 3
_LINES_SHOWN = 8
_TEXT_SHOWN = 60


class Reader:
    """A reader of the elements of one file; each has its path in the robot, such as `joint elbow / limit`."""

    def __init__(self, element_lines: Mapping[Element, int], allowed: Collection[str] = ()) -> None:
        self.element_lines = element_lines
        self.allowed = allowed
        """Codes of errors that become warnings."""
        self.version = 1, 0
        """Version of URDF of the file."""
        self.lines: dict[str, int] = {}
        """Line of each path: see `RobotReading`."""
        self.diagnostics: list[Diagnostic] = []
        """Diagnostics so far, without the name of the file."""
        self.extensions: list[tuple[str, Element]] = []
        """Elements outside of all structs, each with its owner."""
        self.used = set[Element]()
        """The elements in `extensions`, or inside of them, that are read otherwise."""

    @property
    def failed(self) -> bool:
        """Whether an error was found."""
        return any(entry.severity is Severity.ERROR for entry in self.diagnostics)

    def add(self, element: Element, code: str, message: str, hint: str = "") -> None:
        """Add a finding about an element."""
        entry = diagnostic(code, message, self.element_lines[element], hint)
        if code in self.allowed:
            entry = msgspec.structs.replace(
                entry, severity=Severity.WARNING, hint="name it in `allow` to build the robot without it"
            )
        self.diagnostics.append(entry)

    def extend(self, findings: Iterable[Finding]) -> None:
        """Add findings about elements, at their lines or those of the nearest elements around them."""
        for code, path, message, hint in findings:
            place = path
            while place not in self.lines and " / " in place:
                place = place.rpartition(" / ")[0]
            self.diagnostics.append(diagnostic(code, message, self.lines.get(place, self.lines["robot"]), hint))

    def drop_newer(self, element: Element, path: str, attributes: Iterable[str], version: tuple[int, int]) -> None:
        """Remove attributes of URDF `version` from an element of an older file, with a warning."""
        newer = [name for name in attributes if name in element.attrib] if self.version < version else []
        if newer:
            needed, given = (f"{major}.{minor}" for major, minor in (version, self.version))
            message = f"{path}: {', '.join(newer)} has no effect, since the file is of URDF {given}"
            self.add(element, "newer-attribute", message, f'write <robot version="{needed}" …>')
        for name in newer:
            del element.attrib[name]

    def place(self, element: Element, path: str) -> str:
        """Remember the line of an element; return its path."""
        self.lines.setdefault(path, self.element_lines[element])
        return path

    def children(self, element: Element, path: str, tags: Collection[str], owner: str) -> dict[str, Element]:
        """Return the first child of each tag, visuals and collisions aside; others become extensions of `owner`."""
        by_tag: dict[str, Element] = {}
        for child in element:
            tag = child.tag
            if tag not in tags:
                self.keep(child, path, tags, owner)
            elif tag in _REPEATED:
                continue
            elif tag not in by_tag:
                by_tag[tag] = child
                self.place(child, f"{path} / {tag}")
            else:
                self.add(child, "duplicate-element", f"{path} has another <{tag}>, and the first counts")
        return by_tag

    def keep(self, child: Element, path: str, tags: Collection[str], owner: str) -> None:
        """Keep an element that has none of `tags`; warn about one that looks like a misspelt one."""
        is_known = child.tag in _ELEMENTS or child.tag in tags or ":" in child.tag
        if not is_known and (hint := perhaps(child.tag, tags, 0.8)):
            message = f"{path}: the element <{child.tag}> is unknown, and has no effect"
            self.add(child, "unknown-element", message, hint)
        self.extensions.append((owner, child))

    def unmodelled(self) -> Iterator[tuple[str, Element]]:
        """Yield the unread elements with their owners: each as a whole, or the unread ones inside of it."""
        waiting = self.extensions[::-1]
        while waiting:
            owner, element = waiting.pop()
            if element not in self.used:
                yield owner, element
                continue
            name = element.get("name") or element.get("reference", "")
            waiting += [(owner or f"{element.tag} {name}".rstrip(), child) for child in reversed(element)]

    def find(self, element: Element, tags: str) -> Element | None:
        """Return the first element at a path of tags below an element, and mark it as read."""
        # ElementTree's own paths know no prefix without a namespace, such as that of drake:gear_ratio
        tag, _, rest = tags.partition("/")
        for child in element:
            if child.tag == tag and (end := self.find(child, rest) if rest else child) is not None:
                self.used.add(child)
                return end
        return None

    def numbers(
        self, element: Element, places: Iterable[str], path: str, code: str, count: int = 1
    ) -> tuple[float, ...] | None:
        """Return the numbers at the first of some places; None if there are none or, after a warning, faulty ones.

        A place is a path of tags. In the element there, the attribute behind `@` counts, else `value`, else the text.
        """
        for place in places:
            tags, _, attribute = place.partition("@")
            holder = self.find(element, tags) if tags else element
            if holder is None or (attribute and attribute not in holder.attrib):
                continue
            text = holder.get(attribute or "value") or holder.text or ""
            try:
                return parse_numbers(text, count)
            except ValueError as error:
                shown = f"{attribute}={quoted(text)}" if attribute else quoted(text.strip())
                self.add(holder, code, f"{path}: <{holder.tag}> {shown} {error}")
                return None
        return None

    def expect(self, element: Element, path: str, attributes: Collection[str]) -> None:
        """Warn about misspelt `attributes`; other attributes have no effect."""
        for name in element.attrib:
            if name in attributes or ":" in name or name == "xmlns":
                continue
            if hint := perhaps(name, [other for other in attributes if other not in element.attrib]):
                message = f"{path}: the attribute {name!r} is unknown, and has no effect"
                self.add(element, "unknown-attribute", message, hint)

    def read(self, element: Element, path: str, struct: type[Values], owner: str, **given: Any) -> Values:
        """Return a struct from attributes and children, with the `given` fields."""
        attributes, children, required = _schema(struct)
        self.expect(element, path, attributes)
        read = [self._value(element, path, name, count, default) for name, (count, default) in attributes.items()]
        if not children:
            if len(element):
                self.children(element, path, (), owner)
            return struct(*read)
        values = {**given, **dict(zip(attributes, read, strict=True))}
        elements = self.children(element, path, children, owner)
        for name, child in elements.items():
            if name in values:
                continue
            kind, default = children[name]
            place = f"{path} / {name}"
            if name in _ONE_VALUE:
                self.expect(child, place, (_ONE_VALUE[name],))
                if len(child):
                    self.children(child, place, (), owner)
                values[name] = self._value(child, place, _ONE_VALUE[name], kind, default)
            else:
                if name == "origin" and "quat_xyzw" in child.attrib:
                    self._write_as_rpy(child, place)
                values[name] = self.read(child, place, kind, owner)
        for name in required:
            if name not in elements:
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
        # a required value gets one that no later check complains of, so that a fault is told once
        return ("", 1.0, None, (1.0, 1.0, 1.0))[count] if is_required else default


# 45,000 elements of a robot of 1,000 links have one of 15 kinds.
@functools.cache
def _schema(
    struct: type[msgspec.Struct],
) -> tuple[Mapping[str, tuple[int, Any]], Mapping[str, tuple[Any, Any]], Sequence[str]]:
    """Return attributes and children of a struct's element, and its required children.

    Both have defaults. Attributes have counts of numbers, 0 for text; children have counts or their struct.
    """
    attributes: dict[str, tuple[int, Any]] = {}
    children: dict[str, tuple[Any, Any]] = {}
    required: list[str] = []
    for field in msgspec.structs.fields(struct):
        kind = get_args(field.type)[0] if get_origin(field.type) is Annotated else field.type
        kinds = (kind, *get_args(kind))
        structs = [part for part in kinds if isinstance(part, type) and issubclass(part, msgspec.Struct)]
        if field.name in _ELSEWHERE:
            continue
        if structs:
            name = field.name.removesuffix("s") if field.default == () else field.name  # visuals: elements <visual>
            children[name] = structs[0], field.default
        elif field.name in _ONE_VALUE:
            children[field.name] = _COUNTS[kind], field.default
            if field.required:
                required.append(field.name)
        elif kind in _COUNTS:
            attributes[field.name] = _COUNTS[kind], field.default
    return attributes, children, required


# Many attributes have the same text, such as `xyz="0 0 0"`. Serves the row "one mass changed in the daemon, 1,000
# links" of docs/speed.md: 50 of 500 ms.
@functools.lru_cache(maxsize=1024)
def parse_numbers(text: str, count: int) -> tuple[float, ...]:
    """Return exactly `count` decimal numbers between blanks; raise ValueError with the fault.

    Negative zero becomes zero: then two exports do not differ by it.
    """
    words = [word for word in _BLANKS.split(text) if word]
    wrong = next((word for word in words if not _DECIMAL.fullmatch(word)), None)
    if wrong is not None:
        raise ValueError(f"is not a decimal number{f': {quoted(wrong)}' if len(words) > 1 else ''}")
    if len(words) != count:
        raise ValueError(f"has {len(words)} number{'s' * (len(words) != 1)} instead of {count}")
    values = tuple([float(word) + 0.0 for word in words])
    if not all(map(math.isfinite, values)):
        raise ValueError("is too large for a floating-point number")
    return values


def quoted(text: str) -> str:
    """Return the text in quotes, cut if it is long."""
    return repr(cut(text, _TEXT_SHOWN))


def located(findings: Iterable[Finding], file: str, lines: Mapping[str, int]) -> tuple[Diagnostic, ...]:
    """Return findings about elements of a file, with the lines of its reading."""
    reader = Reader({})
    reader.lines.update(lines)
    reader.extend(findings)
    return summary(reader.diagnostics, file)


def summary(diagnostics: Iterable[Diagnostic], file: str) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of a file by line; more than three warnings of one code become one."""
    by_code: dict[tuple[Severity, str], list[Diagnostic]] = {}
    for entry in sorted(diagnostics, key=lambda entry: (entry.line, entry.column)):
        by_code.setdefault((entry.severity, entry.code), []).append(msgspec.structs.replace(entry, file=file))
    shown: list[Diagnostic] = []
    for (severity, _), group in by_code.items():
        if severity is Severity.ERROR or len(group) <= _SHOWN_ALONE:
            shown += group
            continue
        lines = list(dict.fromkeys(str(entry.line) for entry in group[1:]))
        listed = ", ".join(lines[:_LINES_SHOWN]) + (", …" if len(lines) > _LINES_SHOWN else "")
        more = f"(and {len(group) - 1} more like it: line{'s' * (len(lines) > 1)} {listed})"
        shown.append(msgspec.structs.replace(group[0], message=f"{group[0].message} {more}"))
    return tuple(sorted(shown, key=lambda entry: (entry.line, entry.column)))
