"""Reads the bytes of a URDF into a Robot, and checks the robot.

Defaults are those of ROS's urdfdom. A fault is an error with file and line, even where urdfdom accepts the file. If
only one reading makes sense, the fault is a warning.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple
from xml.etree.ElementTree import Element

from msgspec.structs import replace

from urdfsync.common.diagnostics import Detail, Diagnostic, SourceError, cut
from urdfsync.domain import Companion
from urdfsync.formats.urdf import validate
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.parse import xml
from urdfsync.formats.urdf.parse.catalogue import CatalogueRow, find_gaps, read_rows, with_rows
from urdfsync.formats.urdf.parse.chains import find_axes, find_balls_in_loops, split
from urdfsync.formats.urdf.parse.closures import Closures, read_closures
from urdfsync.formats.urdf.parse.drives import DriveStatement, configured_drives, read_drives, read_motors, with_drives
from urdfsync.formats.urdf.parse.elements import read_joint, read_link, read_material, resolve_materials
from urdfsync.formats.urdf.parse.fields import Reader, quoted, summary
from urdfsync.formats.urdf.parse.gazebo import read_contacts, warn_of_left_out, write_springs
from urdfsync.formats.urdf.parse.loops import TAGS, read_loops, tell_foreign_loops
from urdfsync.formats.urdf.parse.sensors import read_sensors
from urdfsync.formats.urdf.robot import Joint, Link, Robot

_MODELLED = ("link", "joint", "material")
_TRANSLATED = ("left_out", "free_root")
"""Elements that translators of other formats add: a part that acts and that no model has, and a free root link."""
_DIALECTS = frozenset({"gazebo", "ros2_control", "transmission", "sensor", "mujoco", "drake:joint"})
"""Children of `<robot>` that other code reads, or that do not concern links and joints."""
_XACRO = ("include", "macro", "if", "unless", "property")
"""Elements of xacro that need the prefix `xacro:` since ROS Noetic."""
_LONGEST, _KINDS = 60, 12
"""The greatest number of characters of a tag, and the most tags, in the note on unmodelled elements."""
_XACRO_LOGIC = ("xacro:macro", "xacro:if", "xacro:unless", "xacro:insert_block")
# Attributes with free text: a remaining `${…}` in one is a warning, in any other an error.
_TEXTS = ("name", "link", "joint", "filename", "group")
_VERSION = re.compile(r"\s*([0-9]{1,9})\.([0-9]{1,9})")
_NEWEST = 1, 2
_DEFAULTS = Options()


class RobotReading(NamedTuple):
    """The robot of a URDF, unless a diagnostic is an error, and the diagnostics.

    `lines` maps paths to lines. Paths are `robot`, `link NAME` and `joint NAME`, and longer paths such as `link NAME /
    visual 2`, `link NAME / visual 2 / mesh`, `joint NAME / limit`. Shapes count from 1.
    """

    robot: Robot | None
    diagnostics: tuple[Diagnostic, ...]
    lines: Mapping[str, int]
    files: Mapping[str, str] = {}
    """File of each path that is not in the URDF itself."""
    unmodelled: tuple[Diagnostic, ...] = ()
    """The note on unmodelled elements, if the URDF has such elements."""


def read_robot(content: bytes, file: str, options: Options = _DEFAULTS, *companions: Companion) -> RobotReading:
    """Read a URDF; `file` is its name in diagnostics.

    `companions` are a YAML with loops and the catalogue. Raises nothing for bad input. The options choose drives and
    loops, and parts that may be left out.

    Reports all faults of the model, but only the first fault of a companion or of the XML.
    """
    closures, rows = Closures(), dict[str, CatalogueRow]()
    try:
        for companion in companions:
            if companion.option == "catalogue":
                rows.update(read_rows(companion, options))
            else:
                closures = read_closures(companion)
        document = xml.parse(content)
    except SourceError as error:
        return RobotReading(None, error.diagnostics, {})
    except xml.ParseError as error:
        return RobotReading(None, summary([error.diagnostic], file), {})
    reader = Reader(document.lines, options.allow)
    robot = _read(reader, document, options, closures, rows) if _is_urdf(reader, document) else None
    diagnostics = summary([*document.warnings, *reader.diagnostics], file)
    if robot is None or reader.failed:
        return RobotReading(None, diagnostics, reader.lines, reader.files)
    return RobotReading(robot, diagnostics, reader.lines, reader.files, summary(_note_unmodelled(reader), file))


def _note_unmodelled(reader: Reader) -> Iterator[Diagnostic]:
    """Yield one note on all unmodelled elements and attributes, with their lines; nothing if all are modelled."""
    elements = (
        (reader.element_lines[part], f"<{cut(part.tag, _LONGEST)}>", part.get("name") or owner)
        for owner, part in reader.unmodelled()
    )
    attributes = (
        (reader.element_lines[part], f'{cut(name, _LONGEST)}="…"', f"of <{part.tag}>")
        for name, part in reader.attributes
    )
    lines = sorted([*elements, *attributes])
    counts = Counter(word for _, word, _ in lines)
    kinds = [f"{count} {word}" for word, count in counts.items()]
    if len(kinds) > _KINDS:
        kinds[_KINDS:] = [f"{len(kinds) - _KINDS} other kinds"]
    if kinds:
        details = tuple(Detail(line, cut(f"{word} {name}".rstrip(), 4 * _LONGEST)) for line, word, name in lines)
        yield validate.diagnostic("not-modelled", f"not modelled: {', '.join(kinds)}", lines[0][0], details=details)


def _is_urdf(reader: Reader, document: xml.XmlDocument) -> bool:
    """Return whether the file is an expanded URDF; if not, add one error."""
    root = document.root
    if root.tag != "robot":
        reader.add(root, "not-urdf", f"the root element is <{root.tag}> and not <robot>: this is no URDF")
        return False
    if "$" not in document.text and "xacro:" not in document.text:
        return True
    has_links = root.find("link") is not None
    leftovers: list[Element] = []
    for child in root:
        for element in child.iter():
            names = [name for name, text in element.items() if "${" in text or "$(" in text]
            if child.tag not in _MODELLED:  # plugins of simulators use `$(…)`, too
                names = []
            is_xacro = element.tag.startswith("xacro:")
            if (is_xacro and (element.tag in _XACRO_LOGIC or not has_links)) or not set(names).issubset(_TEXTS):
                message = f"this is a xacro file that is not expanded: <{element.tag}>"
                reader.add(element, "xacro-source", message)
                return False
            if is_xacro or names:
                leftovers.append(element)
    if leftovers:
        message = "the file has leftovers of xacro, which are taken literally or ignored"
        reader.add(leftovers[0], "xacro-leftover", message)
    return True


def _read_version(reader: Reader, root: Element) -> tuple[int, int]:
    """Return the version of URDF of the file; 1.0 if it states none."""
    text = root.get("version")
    if text is None:
        return 1, 0
    match = _VERSION.fullmatch(text)
    if not match or int(match[1]) != 1:
        reader.add(root, "bad-version", f"version={quoted(text)} is no version 1.x of URDF")
        return _NEWEST
    version = 1, int(match[2])
    if version > _NEWEST:
        reader.add(root, "newer-version", f"the file is of URDF 1.{version[1]}, and is read as 1.{_NEWEST[1]}")
    return version


def _read(
    reader: Reader, document: xml.XmlDocument, options: Options, closures: Closures, rows: Mapping[str, CatalogueRow]
) -> Robot:
    """Return the robot; it is complete only if no diagnostic is an error."""
    root = document.root
    reader.place(root, "robot")
    reader.expect(root, "robot", ("name", "version"), moves=False)
    reader.version = _read_version(reader, root)
    name = root.get("name", "")
    if not name.strip():
        reader.add(root, "missing-name", "the robot has no name")
    axes = find_axes(reader, root, closures)
    _classify(reader, root)
    warn_of_left_out(reader, root)
    tell_foreign_loops(reader, root, options)
    _tell_translated(reader, root, options)
    links, joints, stated = _read_parts(reader, root, closures, rows)
    is_complete = len(links) + len(joints) == len(root.findall("link")) + len(root.findall("joint"))
    links, joints = split(reader, links, joints, axes)
    drives = [*configured_drives(options), *stated]
    joints = with_rows(reader, with_drives(reader, joints, drives), rows)
    robot = Robot(name, tuple(links), tuple(joints))
    reader.extend(validate.check(robot, complete=is_complete))
    moving = [replace(joint, axis=validate.unit_vector(joint.axis)) for joint in joints]
    robot = replace(robot, joints=tuple(moving))
    if not reader.failed:
        robot = replace(robot, loops=read_loops(reader, root, robot, options, closures))
        robot = _without_balls_in_loops(reader, robot, drives, rows)
    if is_complete:  # the joint of a transmission may be missing in an incomplete robot
        known = {joint.name for joint in (*joints, *robot.joints)}  # a ball in a loop, and its hinges
        reader.extend(_find_idle_drives(stated, known))
    reader.diagnostics += find_gaps(robot.joints, rows)
    sensors = read_sensors(reader, root, {link.name for link in robot.links}, robot.joints) if is_complete else ()
    return replace(robot, extensions=_extensions(reader), sensors=sensors)


def _classify(reader: Reader, root: Element) -> None:
    """Report the elements of the robot that URDF does not have, and keep those that are not modelled."""
    for child in root:
        if child.tag == "drake:joint":
            message = f"<drake:joint> {quoted(child.get('name', ''))} is of a type that URDF does not have"
            reader.add(child, "unknown-joint-type", message)
        if child.tag in _DIALECTS:
            reader.extensions.append(("", child))
        elif child.tag in _XACRO or (child.tag != "link" and any(map(len, child.iter("link")))):
            reader.extensions.append(("", child))
            message = f"<{child.tag}> has no effect in URDF: the elements that it stands for are missing"
            reader.add(child, "xacro-leftover", message, f"write <xacro:{child.tag} …>, or move its links out")
        elif child.tag not in (*_MODELLED, *TAGS, *_TRANSLATED):
            reader.keep(child, "robot", (*_MODELLED, *TAGS), "")
        if child.tag in ("gazebo", "ros2_control"):
            reader.used.add(child)  # other code reads or reports each of its parts
    for element in root.iterfind("gazebo/joint"):
        reader.used.update((element, *(part for part in element if part.tag in ("parent", "child", "pose"))))


def _tell_translated(reader: Reader, root: Element, options: Options) -> None:
    """Add a finding for each part that a translator left out, and one if a free robot is bolted down."""
    for part in root.iterfind("left_out"):
        words = f"{part.get('what', '')} {part.get('name', '')}".rstrip()
        reader.add(part, "part-left-out", f"{words}: this acts on the robot, but no model has it")
    for element in root.iterfind("free_root") if options.base == "fixed" else ():
        message = f"link {element.get('link', '')!r} moves freely in the source, but is bolted down"
        reader.add(element, "free-root", message)


def _read_parts(
    reader: Reader, root: Element, closures: Closures, rows: Mapping[str, CatalogueRow]
) -> tuple[list[Link], list[Joint], list[DriveStatement]]:
    """Read each element of the robot alone; links and joints without a name or an end are left out, after an error."""

    def elements(tag: str) -> list[tuple[Element, str]]:
        children = root.findall(tag)
        paths = validate.element_paths(tag, [element.get("name", "") for element in children])
        return [(element, reader.place(element, path)) for element, path in zip(children, paths, strict=True)]

    contacts = read_contacts(reader, root)
    driving = [place for tag in ("ros2_control", "transmission", "gazebo") for place in elements(tag)]
    drives = [drive for element, path in driving for drive in read_drives(reader, element, path)]
    drives += read_motors(reader, closures)
    materials = {path: read_material(reader, element, path) for element, path in elements("material")}
    links = {
        path: read_link(reader, element, path, contacts.get(element.get("name", "")))
        for element, path in elements("link")
    }
    given = {name: row.cells.keys() for name, row in rows.items()}
    write_springs(reader, root)
    joints = [
        read_joint(reader, element, path, given.get(element.get("name", ""), ())) for element, path in elements("joint")
    ]
    named_links = [link for link in resolve_materials(reader, root, links, materials) if link.name]
    return named_links, [joint for joint in joints if joint and joint.name], drives


def _find_idle_drives(drives: Iterable[DriveStatement], joints: Collection[str]) -> Iterator[validate.Finding]:
    """Yield a finding for each drive of a joint that does not exist."""
    for drive in drives:
        if drive.joint not in joints:
            verb = "drives" if drive.is_driven else "names"
            message = f"{drive.path.partition(' / ')[0]} {verb} joint {drive.joint!r}, which does not exist"
            hint = validate.perhaps(drive.joint, joints)
            yield validate.Finding("unknown-actuated-joint", drive.path, message, hint)


def _extensions(reader: Reader) -> dict[str, dict[str, tuple[str, ...]]]:
    """Return what no model shows, as text by owner and tag."""
    extensions = dict[str, dict[str, tuple[str, ...]]]()
    for owner, tag, text in sorted((owner, part.tag, xml.canonical(part)) for owner, part in reader.unmodelled()):
        tags = extensions.setdefault(owner, {})
        tags[tag] = (*tags.get(tag, ()), text)
    return extensions


def _without_balls_in_loops(
    reader: Reader, robot: Robot, drives: Sequence[DriveStatement], rows: Mapping[str, CatalogueRow]
) -> Robot:
    """Return the robot with three hinges instead of each ball in a loop; the hinges may have drives."""
    held = find_balls_in_loops(robot.joints, robot.loops)
    if not held:
        return robot
    for name in held:
        message = f"joint {name!r} is a ball in a loop: three continuous joints replace the ball"
        reader.tell("loop-ball", f"joint {name}", message)
    links, joints = split(reader, robot.links, robot.joints, dict.fromkeys(held, "xyz"))
    hinges = with_drives(reader, joints[-3 * len(held) :], drives)  # `split` adds the hinges at the end
    joints[-3 * len(held) :] = with_rows(reader, hinges, rows)
    known, robot = {*validate.check(robot)}, replace(robot, links=tuple(links), joints=tuple(joints))
    reader.extend(finding for finding in validate.check(robot) if finding not in known)
    return robot
