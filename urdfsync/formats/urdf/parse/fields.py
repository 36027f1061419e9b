"""Reads elements into the structs of `urdf.robot`.

A field of numbers or text comes from the attribute with its name. A struct comes from the child element with its name.
A field without a default is required. Unknown parts are kept as text and reported. A part that may change the motion
gets a warning. One note counts all other parts.

SDFormat writes values as text: `<axis><xyz>0 1 0</xyz></axis>`, `<lower>-1</lower>`, `<pose>0 0 1 0 0 0</pose>`
(sdformat.org/spec, version 1.11). Such texts are read with a warning.

Numbers are decimals as ROS's urdfdom accepts them: no `nan`, `inf`, hexadecimals, underscores or decimal commas. An
unreadable value is an error. A default replaces the value, so that the reader goes on and finds the next fault.
"""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Annotated, Any, TypeVar, get_args, get_origin
from xml.etree.ElementTree import Element

import msgspec

from urdfsync.common.diagnostics import Detail, Diagnostic, Severity, cut
from urdfsync.formats.urdf.kinematics.poses import roll_pitch_yaw
from urdfsync.formats.urdf.robot import (
    SHAPES,
    STATED_ELSEWHERE,
    Calibration,
    Collision,
    Inertial,
    Joint,
    JointType,
    Link,
    Origin,
    SafetyController,
    Vector,
    Visual,
)
from urdfsync.formats.urdf.validate import Finding, diagnostic, perhaps

Values = TypeVar("Values", bound=msgspec.Struct)

_DECIMAL = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_BLANKS = re.compile(r"[ \t\r\n\f\v]+")
_COUNTS = {str: 0, JointType: 0, float: 1, float | None: 1, Vector: 3}
"""Types of fields, with the count of numbers in the attribute; 0 for text."""
_ONE_VALUE = {"parent": "link", "child": "link", "axis": "xyz", "mass": "value"}
"""Fields of numbers or text that URDF writes as child elements, each with the only attribute of its element."""
_REPEATED = ("visual", "collision")
_LENGTHS = {"xyz": 3, "rpy": 3, "quat_xyzw": 4}
"""Vectors that an unknown attribute with so many numbers may mean."""
_POSE = 6
_STILL = frozenset({Link, Visual, Collision, Calibration, SafetyController, *SHAPES.values()})
"""Structs whose unknown parts do not change the motion."""
_NEUTRAL = frozenset({"name", "id", "sensor", "dont_collapse"})
"""Attributes and elements that never change the motion; `dont_collapse` keeps a fixed joint in Isaac Gym."""
_MASSES = ("inertial", "mass", "inertia")
_MASS_WORDS = re.compile("mass|inerti", re.IGNORECASE)
_BY_KIND = frozenset({"unknown-attribute", "unknown-element"})
"""Codes of warnings about unknown names: a file gets one warning for each name."""
_SHOWN_ALONE = 3
_TEXT_SHOWN = 60


class Reader:
    """A reader of the elements of one file. Each element has a path in the robot, such as `joint elbow / limit`."""

    def __init__(self, element_lines: dict[Element, int], allowed: Collection[str] = ()) -> None:
        self.element_lines = element_lines
        self.allowed = allowed
        """Codes of errors that become warnings."""
        self.version = 1, 0
        """Version of URDF of the file."""
        self.lines: dict[str, int] = {}
        """Line of each path: see `RobotReading`."""
        self.files: dict[str, str] = {}
        """File of each path that is not in the source itself."""
        self.diagnostics: list[Diagnostic] = []
        """Diagnostics so far, without the name of the file."""
        self.extensions: list[tuple[str, Element]] = []
        """Elements without a field in a struct, each with its owner."""
        self.attributes: list[tuple[str, Element]] = []
        """Unknown attributes that do not change the motion, each with its element."""
        self.used = set[Element]()
        """Elements of `extensions`, or inside of these, that other code reads."""

    @property
    def failed(self) -> bool:
        """Whether an error was found."""
        return any(entry.severity is Severity.ERROR for entry in self.diagnostics)

    def add(self, element: Element, code: str, message: str, hint: str = "") -> None:
        """Add a finding about an element."""
        entry = diagnostic(code, message, self.element_lines[element], hint)
        if code in self.allowed:
            entry = msgspec.structs.replace(
                entry, severity=Severity.WARNING, hint="nothing to do: `allow` leaves this part out"
            )
        self.diagnostics.append(entry)

    def extend(self, findings: Iterable[Finding]) -> None:
        """Add findings, as `tell` does."""
        for finding in findings:
            self.tell(*finding)

    def tell(self, code: str, path: str, message: str, hint: str = "") -> None:
        """Add a finding about the element at a path, with the line of the nearest known element around it."""
        place = path
        while place not in self.lines and " / " in place:
            place = place.rpartition(" / ")[0]
        entry = diagnostic(code, message, self.lines.get(place, self.lines["robot"]), hint)
        self.diagnostics.append(msgspec.structs.replace(entry, file=self.files.get(place, "")))

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

    def put(self, path: str, line: int, file: str) -> None:
        """Remember line and file of a new path; no `file` means the source itself."""
        self.lines[path] = line
        self.files |= {path: file} if file else {}

    def children(
        self, element: Element, path: str, tags: Collection[str], owner: str, *, moves: bool = False
    ) -> dict[str, Element]:
        """Return the first child with each tag of `tags`, without visuals and collisions.

        Children with other tags become extensions of `owner`; `moves` says whether such a child would change the
        motion.
        """
        by_tag: dict[str, Element] = {}
        for child in element:
            tag = child.tag
            if tag == "pose" and "origin" in tags and "origin" not in by_tag and element.find("origin") is None:
                self._take_texts(child, f"{path} / pose", _schema(Origin)[0])
                tag = "origin" if "xyz" in child.attrib else tag
            if tag not in tags:
                self.keep(child, path, tags, owner, moves=moves)
            elif tag in _REPEATED:
                continue
            elif tag not in by_tag:
                by_tag[tag] = child
                self.place(child, f"{path} / {tag}")
            else:
                self.add(child, "duplicate-element", f"{path} has another <{tag}>, and the first counts")
        return by_tag

    def keep(self, child: Element, path: str, tags: Collection[str], owner: str, *, moves: bool = False) -> None:
        """Keep an element whose tag is none of `tags`. Warn if it would change the motion or looks misspelt."""
        self.extensions.append((owner, child))
        mass = next((part for part in child.iter() if part.tag in _MASSES), None)
        if mass is not None:
            message = f"{path}: this <{mass.tag}> is misplaced, and is left out of the model"
            self.add(mass, "stray-inertial", message)
            return
        alike = "" if child.tag in _moving_tags() or ":" in child.tag else perhaps(child.tag, tags, 0.8)
        kinds = ((tag, kind) for tag, (kind, _) in _schema(Joint)[1].items() if isinstance(kind, type))
        named = (tag for tag, kind in kinds if _schema(kind)[0].keys() & child.attrib.keys())
        meant = next((tag for tag in named if tag != child.tag), "")
        is_moving = child.tag in _moving_tags() or any(map(_MASS_WORDS.search, (child.tag, *child.attrib)))
        is_zero = not len(child) and _is_zero(" ".join((*child.attrib.values(), child.text or "")))
        if alike or ((moves or is_moving or (owner and meant)) and child.tag not in _NEUTRAL and not is_zero):
            hint = alike or (f"perhaps <{meant}> is meant" if meant else "")
            message = f"{path}: the element <{child.tag}> is unknown there, and has no effect"
            self.add(child, "unknown-element", message, hint)

    def unmodelled(self) -> Iterator[tuple[str, Element]]:
        """Yield each unread element with its owner: whole extensions, or the unread parts of a read extension."""
        waiting = self.extensions[::-1]
        while waiting:
            owner, element = waiting.pop()
            if element not in self.used:
                yield owner, element
                continue
            name = element.get("name") or element.get("reference", "")
            waiting += [(owner or f"{element.tag} {name}".rstrip(), child) for child in reversed(element)]

    def find(self, element: Element, tags: str) -> Element | None:
        """Return the first element at a path of tags below `element`, and mark all elements of the path as read."""
        # the paths of ElementTree refuse a prefix without a namespace, such as drake:gear_ratio
        tag, _, rest = tags.partition("/")
        for child in element:
            if child.tag == tag and (end := self.find(child, rest) if rest else child) is not None:
                self.used.add(child)
                return end
        return None

    def numbers(
        self, element: Element, places: Iterable[str], path: str, code: str, count: int = 1
    ) -> tuple[float, ...] | None:
        """Return the numbers at the first existing place; None without a place or, after a warning, for faulty text.

        A place is a path of tags. In the last element, the attribute behind `@` counts, else `value`, else the text.
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

    def number(self, element: Element, places: Iterable[str], path: str, code: str) -> float | None:
        """Return a single number, as `numbers` does."""
        numbers = self.numbers(element, places, path, code)
        return numbers[0] if numbers else None

    def keep_first(self, element: Element, numbers: dict[str, float], field: str, number: float, words: str) -> None:
        """Add a number of an element to those of a part, or warn if an earlier one contradicts it."""
        if numbers.setdefault(field, number) != number:
            message = f"{words} {number:g} contradicts {numbers[field]:g}, the first value, which counts"
            self.add(element, "duplicate-element", message)

    def expect(self, element: Element, path: str, attributes: Collection[str], *, moves: bool = True) -> None:
        """Report unexpected attributes: with a warning if the attribute may change the motion or looks misspelt."""
        for name in element.attrib:
            if name in attributes or name.startswith("xml"):
                continue
            absent = tuple(other for other in attributes if other not in element.attrib)
            hint = _alike(name, absent)
            may_move = (moves and name not in _NEUTRAL) or _MASS_WORDS.search(name)
            if hint or (may_move and not _is_zero(element.attrib[name])):
                message = f"{path}: the attribute {name!r} is unknown there, and has no effect"
                hint = hint or _meant(len(element.attrib[name].split()), absent, tuple(attributes))
                self.add(element, "unknown-attribute", message, hint)
            else:
                self.attributes.append((name, element))

    def _take_texts(self, element: Element, path: str, attributes: Iterable[str]) -> None:
        """Turn texts in SDFormat's spelling into attributes of their element, with a warning.

        The text of `<origin>` and `<pose>` has six numbers; the text of any other element becomes its only attribute.
        """
        absent = [name for name in attributes if name not in element.attrib]
        texts = {part.tag: part for part in element if not len(part) and not part.attrib and (part.text or "").strip()}
        words = (element.text or "").split()
        read = {name: (texts[name].text or "").strip() for name in absent if name in texts}
        if not read and absent == ["xyz", "rpy"] and len(words) == _POSE and not element.attrib:
            read = {"xyz": " ".join(words[:3]), "rpy": " ".join(words[3:])}
        elif not read and len(absent) == 1 and words and not element.attrib:
            read = {absent[0]: " ".join(words)}
        for name in read:
            if name in texts:
                element.remove(texts[name])
        if read:
            element.attrib.update(read)
            message = f"{path}: its text is in the spelling of SDFormat, and is read as {', '.join(read)}"
            self.add(element, "sdf-spelling", message)

    def read(self, element: Element, path: str, struct: type[Values], owner: str, **given: Any) -> Values:
        """Read a struct from the attributes and children of an element; `given` has the fields read before."""
        attributes, children, required = _schema(struct)
        moves = struct not in _STILL
        if not children and (len(element) or (struct is Origin and element.text)):
            self._take_texts(element, path, attributes)
        self.expect(element, path, attributes, moves=moves)
        read = [self._value(element, path, name, count, default) for name, (count, default) in attributes.items()]
        if not children:
            if len(element):
                self.children(element, path, (), owner, moves=moves)
            return struct(*read)
        values = {**given, **dict(zip(attributes, read, strict=True))}
        elements = self.children(element, path, children, owner, moves=moves)
        for name, child in elements.items():
            if name in values:
                continue
            kind, default = children[name]
            place = f"{path} / {name}"
            if name in _ONE_VALUE:
                attribute = _ONE_VALUE[name]
                if attribute not in child.attrib:
                    self._take_texts(child, place, (attribute,))
                self.expect(child, place, (attribute,))
                if len(child):
                    self.children(child, place, (), owner, moves=True)
                values[name] = self._value(child, place, attribute, kind, default)
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
        quaternion, text = self._value(origin, path, "quat_xyzw", 4, None), origin.attrib.pop("quat_xyzw", "")
        if quaternion is None:
            return
        if "rpy" in origin.attrib:
            self.add(origin, "two-orientations", f"{path} has an orientation as rpy and one as quat_xyzw")
        elif not any(quaternion):
            self.add(origin, "bad-number", f"{path}: quat_xyzw={quoted(text)} has no direction")
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
        # this value passes all later checks: the missing value is reported only once
        return ("", 1.0, None, (1.0, 1.0, 1.0))[count] if is_required else default


# The 45,000 elements of a robot with 1,000 links need only 15 different structs.
@functools.cache
def _schema(
    struct: type[msgspec.Struct],
) -> tuple[Mapping[str, tuple[int, Any]], Mapping[str, tuple[Any, Any]], Sequence[str]]:
    """Return the attributes, the children and the required children of a struct's element.

    Each attribute has its count of numbers (0 for text) and its default. Each child has its count or its struct, and
    its default.
    """
    attributes: dict[str, tuple[int, Any]] = {}
    children: dict[str, tuple[Any, Any]] = {}
    required: list[str] = []
    for field in msgspec.structs.fields(struct):
        kind = get_args(field.type)[0] if get_origin(field.type) is Annotated else field.type
        kinds = (kind, *get_args(kind))
        structs = [part for part in kinds if isinstance(part, type) and issubclass(part, msgspec.Struct)]
        if field.name in STATED_ELSEWHERE:
            continue
        if structs:
            name = field.name.removesuffix("s") if field.default == () else field.name  # visuals: <visual>
            children[name] = structs[0], field.default
        elif field.name in _ONE_VALUE:
            children[field.name] = _COUNTS[kind], field.default
            if field.required:
                required.append(field.name)
        elif kind in _COUNTS:
            attributes[field.name] = _COUNTS[kind], field.default
    return attributes, children, required


@functools.cache
def _moving_tags() -> frozenset[str]:
    """Return the tags that change the motion in any place."""
    parts = {**_schema(Joint)[1], **_schema(Inertial)[1]}
    return frozenset({"pose", *(tag for tag, (kind, _) in parts.items() if kind not in _STILL)})


_alike = functools.lru_cache(maxsize=1024)(perhaps)  # takes 0.1 ms; a robot may have 10,000 unknown attributes


def _meant(count: int, absent: Sequence[str], attributes: Sequence[str]) -> str:
    """Return a hint about an unknown attribute of `count` words: the only vector of this length, or all attributes."""
    if count == _LENGTHS["quat_xyzw"] and "rpy" in attributes:
        return 'write quat_xyzw="x y z w" in a robot of version="1.1", or rpy in rad'
    alike = absent if len(attributes) == 1 else [name for name in absent if _LENGTHS.get(name) == count]
    if len(alike) == 1:
        return f"perhaps {alike[0]!r} is meant{', in rad' if alike[0] == 'rpy' else ''}"
    return f"URDF has {', '.join(attributes)} there" if attributes else ""


def _is_zero(text: str) -> bool:
    """Return whether a text has only zeros: some exporters write an `<origin>` of zeros into each link."""
    return not set(text) - set(" 0.-+\t\n")


# Many attributes have equal texts, such as `xyz="0 0 0"`. Serves the row "one mass changed in the daemon, 1,000 links"
# of docs/speed.md: 50 of 500 ms.
@functools.lru_cache(maxsize=1024)
def parse_numbers(text: str, count: int) -> tuple[float, ...]:
    """Return exactly `count` decimal numbers, separated by blanks.

    Raises ValueError with the fault. Negative zero becomes zero: exporters write either.
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
    """Return a text in quotes; a long text is cut."""
    return repr(cut(text, _TEXT_SHOWN))


def located(
    findings: Iterable[Finding], file: str, lines: Mapping[str, int], files: Mapping[str, str]
) -> tuple[Diagnostic, ...]:
    """Return diagnostics for findings about a file; `lines` and `files` are those of `RobotReading`."""
    reader = Reader({})
    reader.lines.update(lines)
    reader.files.update(files)
    reader.extend(findings)
    return summary(reader.diagnostics, file)


def summary(diagnostics: Iterable[Diagnostic], file: str) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of a file and its companions in order of lines. Those without a file are of `file`.

    More than three warnings with one code become one warning. All warnings about one unknown name become one warning.
    """
    by_code: dict[tuple[Severity, str, str, str], list[Diagnostic]] = {}
    named = (entry if entry.file else msgspec.structs.replace(entry, file=file) for entry in diagnostics)
    for entry in sorted(named, key=lambda entry: (entry.line, entry.column)):
        kind = entry.message.rpartition(": ")[2] if entry.code in _BY_KIND else ""
        by_code.setdefault((entry.severity, entry.code, kind, entry.file), []).append(entry)
    shown: list[Diagnostic] = []
    for (severity, _, kind, _), group in by_code.items():
        if severity is Severity.ERROR or len(group) <= (1 if kind else _SHOWN_ALONE):
            shown += group
            continue
        shown.append(msgspec.structs.replace(group[0], details=tuple(Detail(entry.line) for entry in group[1:])))
    return tuple(sorted(shown, key=lambda entry: (entry.file != file, entry.line, entry.column)))
