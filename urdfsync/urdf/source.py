"""Bytes to Robot: strict XML, URDF's defaults, then the model checks, and yourdfpy as second reader.

Defaults are those of ROS's urdfdom; what it takes and this reader does not is an error with file and line.
Where a robot can be read in one sensible way although something is amiss, that is a warning.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TypeAlias, TypeVar

import msgspec

from urdfsync import profiling
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Parts
from urdfsync.urdf.reader import checks, chunks, xml
from urdfsync.urdf.reader.actuated import Actuated, check_actuated
from urdfsync.urdf.reader.chunks import Chunk
from urdfsync.urdf.reader.faults import Fault
from urdfsync.urdf.reader.fields import Element, Findings
from urdfsync.urdf.reader.link import resolve_materials
from urdfsync.urdf.reader.part import MODELLED, Leftover, Part, read_part
from urdfsync.urdf.reader.renumbering import Last, renumbered
from urdfsync.urdf.robot import Joint, Link, Material, Robot

_Document: TypeAlias = chunks.Document[Part]
_Element = TypeVar("_Element", Link, Joint)

_OTHER_ROOTS = {
    "sdf": "an SDF file; export URDF instead",
    "gazebo": "a Gazebo file; export URDF instead",
    "mujoco": "a MuJoCo model; export URDF instead",
    "mujocoinclude": "a part of a MuJoCo model; export URDF instead",
    "COLLADA": "a COLLADA mesh; name the URDF that uses it instead",
    "launch": "a ROS launch file; name the URDF that it loads instead",
    "package": "a ROS package manifest; name the URDF instead",
    "html": "a web page; download the file itself",
}
_KEY = "document"
"""Where `Parts` hold what the last reading has left."""


class RobotReading(msgspec.Struct, frozen=True):
    """What reading a URDF gave: the robot, unless a diagnostic is an error, and what there is to say.

    `lines` maps paths to lines: `robot`, `link NAME`, `joint NAME`, and below them for example
    `link NAME / visual 2`, `link NAME / visual 2 / mesh`, `joint NAME / limit`; shapes count from 1.
    """

    robot: Robot | None
    diagnostics: tuple[Diagnostic, ...]
    lines: Mapping[str, int]


def read_robot(content: bytes, file: str, *, cross_check: bool = True, parts: Parts | None = None) -> RobotReading:
    """Read a URDF; `file` is how diagnostics name it. Raises nothing for bad input.

    All faults of the model are reported, not only the first; a fault of the XML is one error.
    With `cross_check`, a robot without errors is read a second time, by yourdfpy, and compared.
    `parts` are those of an earlier reading: what has not changed since the last one without errors is not read
    again, and its links and joints are the same objects. yourdfpy is not asked again about names, types and the tree
    if it has agreed on them, and the text differs from that one in numbers alone.
    """
    kept: Parts = {} if parts is None else parts
    last: Last | None = kept.get(_KEY)
    try:
        text, said = xml.decode(content)
        document = chunks.read(text, "robot", read_part, last.document if last else None)
    except Fault as fault:
        return RobotReading(None, Findings(file, [fault.diagnostic]).result(), {})
    head = text[: document.begin]
    renewed = renumbered(last, document, said, head) if last else None
    if last and renewed:
        robot: Robot | None = renewed.robot
        findings = last.findings
    else:
        findings = Findings(file, [*said, *document.prefixes.values()])
        robot = _assemble(document, last.robot if last else None, findings) if _is_urdf(document, findings) else None
    both, agreed = findings.copy(), renewed is not None and renewed.agreed
    if robot is not None and cross_check and not (findings.failed or agreed):
        agreed = _agrees(content, robot, both)
    if robot is None or both.failed:
        return RobotReading(None, both.result(), both.lines)
    kept[_KEY] = Last(document, said, robot, findings, head if agreed else None)
    return RobotReading(robot, both.result(), both.lines)


@profiling.stage("cross-check")
def _agrees(content: bytes, robot: Robot, findings: Findings) -> bool:
    """Whether the second reader agrees; if not, that is added to the findings."""
    from urdfsync.urdf.reader.cross_check import cross_check

    found = list(cross_check(content, robot))
    _add(found, findings)
    return not found


def _add(found: Iterable[checks.Finding], findings: Findings) -> None:
    """Give findings about a robot the lines of the file that it was read from."""
    for finding in found:
        findings.add(finding.severity, finding.code, findings.line(finding.path), finding.message, finding.hint)


def _is_urdf(document: _Document, findings: Findings) -> bool:
    """Whether this is a URDF that xacro has expanded; if not, there is one error that says what it is."""
    root = document.root
    if root.tag != "robot":
        kind, _, hint = _OTHER_ROOTS.get(root.tag, "no URDF; name the URDF file instead").partition("; ")
        message = f"the root element is <{root.tag}> and not <robot>: this is {kind}"
        findings.add(Severity.ERROR, "not-urdf", root.line, message, hint)
        return False
    left = list(_leftovers(document))
    expressions = [(line, one) for line, one in left if one.expression]
    xacro = [(line, one) for line, one in left if not one.expression]
    has_links = any(chunk.tag == "link" for chunk in document.chunks)
    unexpanded = [(line, one) for line, one in expressions if one.grave]
    unexpanded += [(line, one) for line, one in xacro if one.grave or not has_links]
    if unexpanded:
        line, first = unexpanded[0]
        message = f"this is a xacro file that is not expanded: <{first.tag}>"
        hint = "run `xacro FILE.xacro > FILE.urdf`, and name the result"
        findings.add(Severity.ERROR, "xacro-source", line, message, hint)
        return False
    for line, _ in [*xacro, *expressions][:1]:
        message = "the file has leftovers of xacro, which are taken literally or ignored"
        hint = "expand the source with xacro, if this file is not the result of it"
        findings.warn("xacro-leftover", line, message, hint)
    return True


def _leftovers(document: _Document) -> Iterator[tuple[int, Leftover]]:
    """What xacro has left in the file, with its lines."""
    for chunk, line in zip(document.chunks, document.lines, strict=True):
        for left in chunk.made.leftovers:
            yield line + left.line, left


def _assemble(document: _Document, before: Robot | None, findings: Findings) -> Robot:
    """The robot with its faults among the findings; it is of use only if none of them is an error."""
    root = Element(document.root, "robot", findings)
    root.expect(("name",))
    name = root.node.attributes.get("name", "")
    if not name.strip():
        root.warn("missing-name", "the robot has no name", 'write <robot name="…">')
    others, materials, links, joints = _by_kind(document, findings)
    extensions = tuple(extension for chunk in (*others, *links, *joints) for extension in chunk.made.extensions)
    known = [(chunk.path, chunk.made.read) for chunk in materials if isinstance(chunk.made.read, Material)]
    bodies = [chunk.made.read for chunk in links if isinstance(chunk.made.read, Link)]
    actuated = [named for chunk in others for named in chunk.made.actuated]
    moves = _with_actuated([chunk.made.read for chunk in joints if isinstance(chunk.made.read, Joint)], actuated)
    complete = len(bodies) == len(links) and len(moves) == len(joints)
    resolved = resolve_materials(list(checks.numbered("link", bodies)), known, findings)
    robot = Robot(name, resolved, moves, extensions)
    faults = [fault for chunk in (*links, *joints) for fault in chunk.made.faults] if complete else None
    _add(checks.check(robot, complete=complete, of_elements=faults), findings)
    if complete:
        _add(check_actuated(actuated, {joint.name for joint in moves}), findings)
    return _as_before(checks.unit_axes(robot), before)


def _with_actuated(joints: Iterable[Joint], actuated: Iterable[Actuated]) -> tuple[Joint, ...]:
    """The joints, those marked that a transmission or ros2_control drives."""
    names = {named.joint for named in actuated}
    return tuple([msgspec.structs.replace(joint, actuated=True) if joint.name in names else joint for joint in joints])


def _by_kind(document: _Document, findings: Findings) -> tuple[list[Chunk[Part]], ...]:
    """What is not modelled, materials, links and joints; their findings are taken in that order."""
    kinds: dict[str, list[tuple[Chunk[Part], int]]] = {tag: [] for tag in ("", "material", "link", "joint")}
    for chunk, line in zip(document.chunks, document.lines, strict=True):
        kinds[chunk.tag if chunk.tag in MODELLED else ""].append((chunk, line))
    for kind in kinds.values():
        for chunk, line in kind:
            findings.adopt(chunk.made.findings, line)
    return tuple([chunk for chunk, _ in kind] for kind in kinds.values())


def _as_before(robot: Robot, before: Robot | None) -> Robot:
    """The robot, with the objects of another one for links and joints that are equal."""
    if before is None:
        return robot
    return Robot(robot.name, _same(robot.links, before.links), _same(robot.joints, before.joints), robot.extensions)


def _same(elements: Iterable[_Element], before: Iterable[_Element]) -> tuple[_Element, ...]:
    named = {element.name: element for element in before}
    return tuple([old if (old := named.get(new.name)) == new else new for new in elements])
