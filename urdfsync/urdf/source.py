"""Bytes to Robot: strict XML, URDF's defaults, then the model checks, and yourdfpy as second reader.

Defaults are those of ROS's urdfdom; what it takes and this reader does not is an error with file and line.
Where a robot can be read in one sensible way although something is amiss, that is a warning.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

import msgspec

from urdfsync import profiling
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf.reader import checks, xml
from urdfsync.urdf.reader.fields import Element, Findings
from urdfsync.urdf.reader.joint import read_joint
from urdfsync.urdf.reader.link import read_link, read_material, resolve_materials
from urdfsync.urdf.reader.xml import Node
from urdfsync.urdf.robot import Extension, Joint, Link, Robot

_PARTS = ("link", "joint", "material")
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
_XACRO_LOGIC = ("macro", "if", "unless", "insert_block")
_TEXTS = ("name", "link", "joint", "filename", "group")
"""Attributes that may hold any text: `${…}` left over in them is odd, but no reason to refuse the robot."""


class RobotReading(msgspec.Struct, frozen=True):
    """What reading a URDF gave: the robot, unless a diagnostic is an error, and what there is to say.

    `lines` maps paths to lines: `robot`, `link NAME`, `joint NAME`, and below them for example
    `link NAME / visual 2`, `link NAME / visual 2 / mesh`, `joint NAME / limit`; shapes count from 1.
    """

    robot: Robot | None
    diagnostics: tuple[Diagnostic, ...]
    lines: Mapping[str, int]


def read_robot(content: bytes, file: str, *, cross_check: bool = True) -> RobotReading:
    """Read a URDF; `file` is how diagnostics name it. Raises nothing for bad input.

    All faults of the model are reported, not only the first; a fault of the XML is one error.
    With `cross_check`, a robot without errors is read a second time, by yourdfpy, and compared.
    """
    document = xml.parse(content, file)
    findings = Findings(file, document.diagnostics)
    robot = None
    if document.root is not None and _is_urdf(document.root, findings):
        robot = _read(Element(document.root, "robot", findings))
    if robot is not None and cross_check and not findings.failed:
        from urdfsync.urdf.reader.cross_check import cross_check as read_again

        with profiling.stage("cross-check"):
            _add(read_again(content, robot), findings)
    return RobotReading(None if findings.failed else robot, findings.result(), findings.lines)


def _add(found: Iterable[checks.Finding], findings: Findings) -> None:
    """Give findings about a robot the lines of the file that it was read from."""
    for finding in found:
        findings.add(finding.severity, finding.code, findings.line(finding.path), finding.message, finding.hint)


def _is_urdf(root: Node, findings: Findings) -> bool:
    """Whether this is a URDF that xacro has expanded; if not, there is one error that says what it is."""
    if root.tag != "robot":
        kind, _, hint = _OTHER_ROOTS.get(root.tag, "no URDF; name the URDF file instead").partition("; ")
        message = f"the root element is <{root.tag}> and not <robot>: this is {kind}"
        findings.add(Severity.ERROR, "not-urdf", root.line, message, hint)
        return False
    xacro = [node for node in root.walk() if node.tag.startswith("xacro:")]
    expressions = list(_expressions(root))
    unexpanded = [node for node, numeric in expressions if numeric]
    unexpanded += [node for node in xacro if node.tag[6:] in _XACRO_LOGIC or not _has_links(root)]
    if unexpanded:
        message = f"this is a xacro file that is not expanded: <{unexpanded[0].tag}>"
        hint = "run `xacro FILE.xacro > FILE.urdf`, and name the result"
        findings.add(Severity.ERROR, "xacro-source", unexpanded[0].line, message, hint)
        return False
    for node in [*xacro, *(node for node, _ in expressions)][:1]:
        message = "the file has leftovers of xacro, which are taken literally or ignored"
        hint = "expand the source with xacro, if this file is not the result of it"
        findings.warn("xacro-leftover", node.line, message, hint)
    return True


def _has_links(root: Node) -> bool:
    """Whether there is a link at all."""
    return any(node.tag == "link" for node in root.children)


def _expressions(root: Node) -> Iterator[tuple[Node, bool]]:
    """The elements of links, joints and materials with a xacro expression, and whether that stands for a number."""
    for part in root.children:
        if part.tag in _PARTS:
            for node in part.walk():
                for name, value in node.attributes.items():
                    if "$" in value and ("${" in value or "$(" in value):
                        yield node, name not in _TEXTS


def _read(root: Element) -> Robot:
    """The robot with its faults among the findings; it is of use only if none of them is an error."""
    findings = root.findings
    root.expect(("name",))
    name = root.node.attributes.get("name", "")
    if not name.strip():
        root.warn("missing-name", "the robot has no name", 'write <robot name="…">')
    extensions = list(root.extensions("", _PARTS))
    known = [(element.path, read_material(element)) for element in _parts(root, "material")]
    links, joints = _read_links(root, extensions), _read_joints(root, extensions)
    complete = len(links) + len(joints) == sum(node.tag in ("link", "joint") for node in root.node.children)
    links = resolve_materials(list(checks.numbered("link", links)), known, findings)
    robot = Robot(name, links, joints, tuple(extensions))
    _add(checks.check(robot, complete=complete), findings)
    return checks.unit_axes(robot)


def _parts(root: Element, tag: str) -> Iterator[Element]:
    """The links, joints or materials of the robot, with paths such as `link wheel` and `link wheel #2`."""
    seen: Counter[str] = Counter()
    for number, node in enumerate((node for node in root.node.children if node.tag == tag), start=1):
        name = node.attributes.get("name", "")
        seen[name] += 1
        path = f"{tag} {name}" if name.strip() else f"{tag} number {number}"
        yield Element(node, path + (f" #{seen[name]}" if seen[name] > 1 else ""), root.findings)


def _read_links(root: Element, extensions: list[Extension]) -> tuple[Link, ...]:
    """All links that have a name."""
    links = ((element.text("name"), read_link(element, extensions)) for element in _parts(root, "link"))
    return tuple(link for name, link in links if name)


def _read_joints(root: Element, extensions: list[Extension]) -> tuple[Joint, ...]:
    """All joints that have a name and ends."""
    joints = ((element.text("name"), read_joint(element, extensions)) for element in _parts(root, "joint"))
    return tuple(joint for name, joint in joints if name and joint)
