"""Bytes of a URDF to a Robot: strict XML, URDF's defaults, the model checks, and yourdfpy as second reader.

Defaults are those of ROS's urdfdom; what urdfdom accepts and this reader does not is an error with file and line.
Where a robot can be read in one sensible way although something is amiss, that is a warning.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence

import msgspec

from urdfsync import profiling
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf import validate
from urdfsync.urdf.parse import xml
from urdfsync.urdf.parse.fields import Element, Findings
from urdfsync.urdf.parse.joint import read_actuated, read_joint
from urdfsync.urdf.parse.link import read_link, read_material, resolve_materials
from urdfsync.urdf.parse.xml import Node, ParseError
from urdfsync.urdf.robot import Joint, Robot

_MODELLED = ("link", "joint", "material")
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
_XACRO_LOGIC = ("xacro:macro", "xacro:if", "xacro:unless", "xacro:insert_block")
# Attributes that may hold any text: a `${…}` left over in them is odd, but no reason to refuse the robot.
_TEXTS = ("name", "link", "joint", "filename", "group")


class RobotReading(msgspec.Struct, frozen=True):
    """What reading a URDF gave: the robot, unless a diagnostic is an error, and the diagnostics.

    `lines` maps paths to lines: `robot`, `link NAME`, `joint NAME`, and below them for example
    `link NAME / visual 2`, `link NAME / visual 2 / mesh`, `joint NAME / limit`; shapes count from 1.
    """

    robot: Robot | None
    diagnostics: tuple[Diagnostic, ...]
    lines: Mapping[str, int]


def read_robot(content: bytes, file: str, *, cross_check: bool = False) -> RobotReading:
    """Read a URDF; `file` is how diagnostics name it. Raises nothing for bad input.

    All faults of the model are reported, not only the first; a fault of the XML is one error. With `cross_check`,
    yourdfpy reads a robot without errors too, and the two readings are compared.
    """
    findings = Findings(file)
    try:
        root = xml.parse(content)
    except ParseError as error:
        findings.extend([error.diagnostic])
        return RobotReading(None, findings.result(), {})
    findings.extend(root.document.warnings)
    robot = _read_robot(root, findings) if _is_urdf(root, findings) else None
    if cross_check and robot is not None and not findings.failed:
        _cross_check(content, robot, findings)
    return RobotReading(None if findings.failed else robot, findings.result(), findings.lines)


@profiling.stage("cross-check")
def _cross_check(content: bytes, robot: Robot, findings: Findings) -> None:
    # Late, since yourdfpy takes most of a second to load, and a plain build does without it.
    from urdfsync.urdf.parse.second_reader import compare_readers

    findings.extend_checks(compare_readers(content, robot))


def _is_urdf(root: Node, findings: Findings) -> bool:
    """Return whether this is a URDF that xacro has expanded; if not, add one error that says what it is."""
    if root.tag != "robot":
        kind, _, hint = _OTHER_ROOTS.get(root.tag, "no URDF; name the URDF file instead").partition("; ")
        message = f"the root element is <{root.tag}> and not <robot>: this is {kind}"
        findings.add(Severity.ERROR, "not-urdf", root.line, message, hint)
        return False
    # One of these is in each text with something of xacro, since `&` may stand for any character. Most have none.
    if not any(sign in root.document.content for sign in (b"xacro:", b"$", b"&")):
        return True
    has_links = any(child.tag == "link" for child in root.children)
    tags: list[Node] = []
    expressions: list[Node] = []
    unexpanded: list[Node] = []
    for child in root.children:
        for node in child.walk():
            if node.tag.startswith("xacro:"):
                tags.append(node)
            for name, value in node.attributes.items() if child.tag in _MODELLED else ():
                if "${" in value or "$(" in value:
                    (expressions if name in _TEXTS else unexpanded).append(node)
    unexpanded += [node for node in tags if node.tag in _XACRO_LOGIC or not has_links]
    if unexpanded:
        message = f"this is a xacro file that is not expanded: <{unexpanded[0].tag}>"
        hint = "run `xacro FILE.xacro > FILE.urdf`, and name the result"
        findings.add(Severity.ERROR, "xacro-source", unexpanded[0].line, message, hint)
        return False
    for node in [*tags, *expressions][:1]:
        message = "the file has leftovers of xacro, which are taken literally or ignored"
        hint = "expand the source with xacro, if this file is not the result of it"
        findings.warn("xacro-leftover", node.line, message, hint)
    return True


def _read_robot(root: Node, findings: Findings) -> Robot:
    """Return the robot; it is of use only if no diagnostic is an error."""
    top = Element(root, "robot", findings)
    top.expect(("name",))
    name = root.attributes.get("name", "")
    if not name.strip():
        top.warn("missing-name", "the robot has no name", 'write <robot name="…">')
    children = _children_by_tag(root)
    extensions = list(top.extensions("", _MODELLED))

    def elements(*tags: str) -> Iterator[Element]:
        return (Element(node, path, findings) for tag in tags for path, node in children[tag])

    actuated = [named for element in elements("transmission", "ros2_control") for named in read_actuated(element)]
    materials = [(element.path, read_material(element)) for element in elements("material")]
    links = [link for element in elements("link") if (link := read_link(element, extensions)).name]
    joints = [joint for element in elements("joint") if (joint := read_joint(element, extensions)) and joint.name]
    complete = len(links) == len(children["link"]) and len(joints) == len(children["joint"])
    robot = Robot(
        name,
        resolve_materials(dict(validate.numbered("link", links)), materials, findings),
        _mark_actuated(joints, {joint for _, joint in actuated}),
        tuple(extensions),
    )
    findings.extend_checks(validate.check(robot, complete=complete))
    if complete:  # else the joint that a transmission names may be one of those left out
        findings.extend_checks(validate.check_actuated(actuated, {joint.name for joint in joints}))
    return validate.normalise_axes(robot)


def _children_by_tag(root: Node) -> Mapping[str, Sequence[tuple[str, Node]]]:
    """Return the children of the root by tag, with their paths; those that share a name are told apart by numbers."""
    names: Counter[tuple[str, str]] = Counter()
    children: defaultdict[str, list[tuple[str, Node]]] = defaultdict(list)
    for node in root.children:
        name, others = node.attributes.get("name", ""), children[node.tag]
        path = f"{node.tag} {name}" if name.strip() else f"{node.tag} number {len(others) + 1}"
        names[node.tag, name] += 1
        count = names[node.tag, name]
        others.append((path if count == 1 else f"{path} #{count}", node))
    return children


def _mark_actuated(joints: Sequence[Joint], names: set[str]) -> tuple[Joint, ...]:
    return tuple(msgspec.structs.replace(joint, actuated=True) if joint.name in names else joint for joint in joints)
