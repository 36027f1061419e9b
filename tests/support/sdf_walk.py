"""Changes each element and attribute of SDF alone, in a robot where it can act, and looks what becomes of it."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, fromstring, tostring

import msgspec

from support.sdfs import reading
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.formats.translation.files import TranslationError
from urdfsync.formats.urdf.robot import Robot

_DESCRIPTION = Path(__file__).parents[1] / "formats" / "sdf" / "description.txt"
_MASS = "<inertial><mass>2</mass></inertial>"
_WELD = '<joint name="weld" type="fixed"><parent>world</parent><child>base</child></joint>'
_BOX = "<geometry><box><size>1 1 1</size></box></geometry>"
_PART = f"<pose>0.1 0.2 0.3 0.1 0.2 0.3</pose>{_MASS}"
_ROBOT = f"""\
<sdf version="1.12"><world name="w"><!----><model name="arm">
  <link name="base">{_MASS}</link>
  <link name="tool"><pose>0.3 0 0.2 0.4 0.5 0</pose>{_MASS}</link>
  <link name="part">{_PART}
    <visual name="v">{_BOX}</visual><collision name="c">{_BOX}</collision></link>
  <joint name="grip" type="continuous"><parent>part</parent><child>tool</child><axis><xyz>1 0 0</xyz></axis></joint>
  {_WELD}
  <joint name="turn" type="revolute"><parent>base</parent><child>part</child><axis><xyz>0 1 0</xyz></axis></joint>
</model></world></sdf>"""
_HAND = """\
<sdf version="1.9"><model name="hand"><link name="palm"/><link name="tip"><pose>1 0 0 0 0 0</pose></link>
<joint name="bend" type="continuous"><parent>palm</parent><child>tip</child><axis/></joint>
<joint name="held" type="fixed"><parent>world</parent><child>palm</child></joint></model></sdf>"""
_FILES = {"hand.sdf": _HAND, "other.sdf": _HAND.replace("1 0 0", "2 0 0")}
_SPRING = "</axis><axis2><dynamics><spring_stiffness>2</spring_stiffness></dynamics></axis2></joint>\n</model>"
_TURN, _TWO = 'name="turn" type="revolute"', 'name="turn" type="universal"'
_CONTEXTS = (
    (r"^model(/pose|@placement_frame)", _WELD, ""),
    (r"^joint/axis2", _TURN, _TWO),
    (r"axis2?/mimic@axis$", 'name="grip" type="continuous"', 'name="grip" type="universal"'),
    (r"/(gearbox_ratio|gearbox_reference_body)$", _TURN, 'name="turn" type="gearbox"'),
    (r"thread_pitch$", _TURN, 'name="turn" type="screw"'),
    (r"/(density|auto_inertia_params)$", _PART, _PART.replace(_MASS, '<inertial auto="true"/>')),
    (r"spring_reference$", "<axis><xyz>", "<axis><dynamics><spring_stiffness>2</spring_stiffness></dynamics><xyz>"),
    (r"axis2/.*spring_reference$", "</axis></joint>\n</model>", _SPRING),
    (r"^model@canonical_link", _WELD, '<frame name="mark"/>'),
    (
        r"^world/include",
        "<!---->",
        '<frame name="mark"><pose>1 2 3 0 0 0</pose></frame><include><uri>hand.sdf</uri></include>',
    ),
    (r"^model/pose@", "<!---->", '<frame name="mark"><pose>1 2 3 0 0 0</pose></frame>'),
    (r"/enable_wind$", '<world name="w">', '<world name="w"><wind><linear_velocity>1 0 0</linear_velocity></wind>'),
    (r"wind/linear_velocity$", '<model name="arm">', '<model name="arm"><enable_wind>true</enable_wind>'),
    (r"visual/transparency$", '<visual name="v">', '<visual name="v"><material><diffuse>1 0 0</diffuse></material>'),
)
"""Paths, and what stands in the robot where the path can act."""
_MADE = {
    "mimic": {"joint": "grip"},
    "sensor": {"name": "s", "type": "imu"},
    "plugin": {"name": "p", "filename": "libgazebo_ros_diff_drive.so"},
}
"""Attributes of elements that are made for those in them."""
_SENSORS = ("camera", "ray", "lidar", "imu", "force_torque")
_VALUES = {
    "joint@type": "prismatic",
    "joint/parent": "world",
    "joint/child": "tool",
    "world/include/pose@relative_to": "mark",
    "model/pose@relative_to": "mark",
    "@relative_to": "tool",
    "@frame": "tool",
    "@expressed_in": "tool",
    "@attached_to": "tool",
    "@canonical_link": "tool",
    "@placement_frame": "tool",
    "include/placement_frame": "tip",
    "include/uri": "other.sdf",
    "pose@rotation_format": "quat_xyzw",
    "mimic@joint": "weld",
    "mimic@axis": "axis2",
    "sensor@type": "lidar",
    "root@version": "1.6",
}
"""Values of texts that mean something; by the end of the path."""
_BY_TYPE = {
    "vector3": "0.2 0.3 0.4",
    "vector2d": "0.3 0.6",
    "color": "0.1 0.2 0.3 0.4",
    "pose": "0.1 0.2 0.3 0.4 0.5 0.6",
    "time": "1 2",
    "string": "other",
}


class Entry(NamedTuple):
    """An element or an attribute of SDF in one place."""

    path: str
    """Tags from a part of the robot, such as `link/pose@degrees`."""
    kind: str
    default: str
    since: str
    until: str
    has_parts: bool


class Verdict(NamedTuple):
    """What becomes of an entry that has another value; False comes first."""

    is_translated: bool
    is_told: bool
    """Whether an error or a warning names it, or an element around it."""
    is_counted: bool
    """Whether the note on unmodelled elements does."""


@functools.cache
def _description() -> Mapping[str, tuple[str, str, str, str]]:
    rows = (line.split("\t") for line in _DESCRIPTION.read_text().splitlines())
    return {path: (since, until, kind, default) for since, until, path, kind, default in rows}


def _entries(definition: str, path: str = "", around: tuple[str, ...] = ()) -> Iterator[Entry]:
    """Yield the elements and attributes of a definition, with those of the definitions that it includes."""
    path, rows = path or definition, _description()
    for name, (since, until, kind, default) in rows.items():
        if re.split("[/@]", name)[0] != definition:
            continue
        place = path + name.removeprefix(definition)
        if "/+" not in name:
            parts = any(other.startswith((f"{name}/", f"{name}@")) for other in rows)
            yield Entry(place, kind, default, since, until, parts)
        elif (inner := place.partition("+")[2]) not in (*_PARTS, definition, *around):
            yield from _entries(inner, place.replace("+", ""), (*around, definition))


_PARTS = ("sdf", "world", "model", "link", "joint", "frame", "visual", "collision", "sensor", "actor", "population")
"""Definitions that are walked alone, each in the place that `_PLACES` names."""
_PLACES = {
    "sdf": (),
    "world": ("world",),
    "model": ("world", "model"),
    **{name: ("world", "model", name) for name in ("link", "joint", "frame")},
    **{name: ("world", "model", "link", name) for name in ("visual", "collision", "sensor")},
    **{name: ("world", name) for name in ("actor", "population")},
}


def every_entry() -> Iterator[Entry]:
    """Yield each element and attribute, in each place where a part of the robot may have it.

    An element that only holds others, which are walked, is left out, and so is the name by which joints find a link.
    """
    for name in _PARTS:
        found = (entry for entry in _entries(name) if entry.kind or not entry.has_parts)
        yield from (entry for entry in found if entry.path != "link@name")


class Change(NamedTuple):
    """A robot without the elements of an entry, without its last one or with its default, and with another value."""

    bare: Element
    before: Element
    after: Element


def changes(entry: Entry) -> Iterator[Change]:
    """Change an entry alone, to each of several values."""
    path, _, attribute = entry.path.partition("@")
    tags, is_number = path.split("/"), entry.kind in ("double", "int", "unsigned int", "float")
    has_zero = is_number and entry.default not in ("0", "0.0") and not path.endswith("density")  # 0 is refused
    for value in (_value(entry), *(["0"] if has_zero else [])):
        after, element = _robot(entry, tags, is_new=not attribute)
        if attribute:
            element.set(attribute, value)
            element.text = f"{element.text} 0.7" if value == "quat_xyzw" else element.text
        elif entry.kind:
            element.text = value
        yield Change(_robot(entry, [])[0], _robot(entry, tags if attribute else tags[:-1])[0], after)


def judge(entry: Entry) -> Verdict:
    """Return what becomes of an entry, the least of several values."""
    path, _, attribute = entry.path.partition("@")
    robot, verdicts = "hand" if path.startswith("world/include") else "arm", list[Verdict]()
    for change in changes(entry):
        (_, known), (first, _), (second, findings) = (_read(each, robot) for each in change)
        around = {*path.split("/")} - {each.tag for each in change.bare.iter()}
        names = {attribute, path.split("/")[-1], *around} - {""}
        names |= {"pose"} if attribute == "placement_frame" else set()  # it places the frame of the pose
        told = {each.severity for each, text in findings.items() if text not in known.values() and _names(text, names)}
        is_translated = first is not None and second is not None and first != second
        verdicts.append(Verdict(is_translated, bool(told - {Severity.NOTE}), Severity.NOTE in told))
    return min(verdicts)


def _names(text: str, names: set[str]) -> bool:
    return any(re.search(rf"(?<![\w]){re.escape(name)}(?![\w])", text) for name in names)


def _value(entry: Entry) -> str:
    for end, value in _VALUES.items():
        if entry.path.endswith(end):
            return value
    if entry.kind == "bool":
        return "false" if entry.default in ("true", "1") else "true"
    if entry.kind in _BY_TYPE or not entry.kind:
        return _BY_TYPE.get(entry.kind, "")
    number = 0.0 if "inf" in entry.default else float(entry.default)
    return str(int(number) + 1) if "int" in entry.kind else str(number + 0.25)


def _robot(entry: Entry, tags: list[str], *, is_new: bool = False) -> tuple[Element, Element]:
    """Return the robot with the elements of a path, and the last of these, a new one if `is_new`."""
    text = _ROBOT
    for pattern, old, new in _CONTEXTS:
        if re.search(pattern, entry.path):
            assert old in text, old
            text = text.replace(old, new)
    root = fromstring(text)
    root.set("version", entry.until)
    element = root
    places = [*_PLACES[tags[0]], *tags[1:]] if tags else []
    for number, tag in enumerate(places):
        children = element.findall(tag)
        is_last = number == len(places) - 1
        if children and not (is_last and is_new and tag in ("plugin", "include")):
            element = children[-1]
            continue
        if element.tag == "geometry":
            for child in [*element]:
                element.remove(child)
        element = SubElement(element, tag, _MADE.get(tag, {}))
        if f"{tag}@name" in _description():
            element.set("name", element.get("name", f"a_{tag}"))
        if tag == "include":
            SubElement(element, "uri").text = "hand.sdf"
        if tag == "mesh":
            SubElement(element, "uri").text = "a.stl"
        if tag == "sensor":
            kinds = [word for word in places if word in _SENSORS]
            element.set("type", kinds[0] if kinds else "force_torque" if "joint" in places else "imu")
        if tag == "pose" and not (is_last and is_new):
            element.text = "0.1 0.2 0.3 0.4 0.5 0.6"
    return root, element


def _read(root: Element, robot: str) -> tuple[Robot | None, dict[Diagnostic, str]]:
    """Return the robot, if there is one, and the text of each finding."""
    try:
        found = reading(tostring(root, "unicode"), _FILES, root.findtext("world/include/name") or robot)
    except TranslationError as error:
        problem = error.problem("sdf")
        finding = Diagnostic(Severity.ERROR, problem.code, problem.message)
        return None, {finding: problem.message}
    findings = {
        each: "\n".join((each.message, *(detail.text for detail in each.details)))
        for each in (*found.diagnostics, *found.unmodelled)
    }
    if found.robot is None:
        return None, findings
    return msgspec.structs.replace(found.robot, extensions={}), findings
