"""Adds the loops in a YAML beside a URDF to this URDF, as elements. `example-parallel-robots` has such files.

    closed_loop: [[FRAME, FRAME], …]          pairs of links
    type: [3d | 6d, …]                        a ball or a fixed joint for each pair
    name_mot: [JOINT, …]                      the joints that have a motor
    joint_name: [JOINT, …]                    joints whose type URDF lacks, each with
    joint_type: [SPHERICAL | UJOINT_XY | FIXED, …]

The elements go to the end of the URDF, so that all readers of the URDF see the elements and their lines. A joint of
several axes becomes a chain of joints.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any
from xml.etree.ElementTree import SubElement

from urdfsync.diagnostics import SourceError
from urdfsync.spelling import counted
from urdfsync.urdf.parse import xml

AXES = "joint_axes"
"""Element that gives a joint several axes in a row: `<joint_axes joint axes>`."""
SUFFIX, OPTION = ".yaml", ""
_KINDS = {"3d": "ball", "6d": "fixed"}
_TYPES = {
    "FIXED": "",
    "SPHERICAL": "xyz",
    **{f"UJOINT_{a}{b}": f"{a}{b}".lower() for a in "XYZ" for b in "XYZ" if a != b},
}
_MARK = b"closed_loop"
_LARGEST = 100_000
"""The size limit of a YAML, in bytes: PyYAML needs up to 2 s and 60 MB. Even 10,000 loops need fewer bytes."""
_DEEPEST = 50
"""Deepest nesting of lists in a YAML: PyYAML needs three levels of recursion for each."""
_MOST = 10_000_000
"""The greatest number of characters of all elements: aliases of YAML may repeat a long name 10,000 times."""
_DIRECTIONS = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}
_DRAKE = {"ball": "", "planar": "", "universal": "xy"}
"""Types of `<drake:joint>` with the axes of their chains, by Drake's parser of URDF and its class UniversalJoint."""


def join(content: bytes, other: bytes, file: str) -> tuple[bytes, Sequence[tuple[int, int]]]:
    """Return the URDF with the YAML's elements before the last tag, and the line of each element in both files.

    A YAML without loops adds nothing. Raises SourceError for an unreadable YAML.
    """
    end = content.rfind(b"</robot")
    if _MARK not in other or end < 0:
        return content, ()
    import yaml  # a late import saves most robots 20 ms

    try:
        document = _compose(other)
        elements = _bounded(_elements(document)) if document else []
        lines = "".join(f"\n{element}" for element, _ in elements)
        lines.encode()  # refuses half a character such as `\uD800`
    except (yaml.YAMLError, _LoopsError, ValueError, OverflowError) as error:  # the last two for `\UFFFFFFFF`, `\uD800`
        mark = getattr(error, "problem_mark", None)
        line = mark.line + 1 if mark else other.count(b"\n", 0, other.find(_MARK)) + 1
        message = f"this is no list of loops: {getattr(error, 'problem', None) or error}"
        hint = "write `closed_loop: [[FRAME, FRAME]]` and `type: [6d]`"
        raise SourceError.of("loops-file", message, file, line, hint=hint) from None
    first = content.count(b"\n", 0, end) + 2
    places = [(number, line) for number, (_, line) in enumerate(elements, first)]
    text = lines.encode("ascii", "xmlcharrefreplace")  # the URDF may have any encoding
    return content[:end] + text + b"\n" + content[end:], places


class _LoopsError(Exception):
    """An unreadable node of the YAML, with the attributes of PyYAML's errors."""

    def __init__(self, problem: str, node: Any = None) -> None:
        super().__init__(problem)
        self.problem, self.problem_mark = problem, node and node.start_mark


def _compose(content: bytes) -> Any:
    """Return the root node of a YAML, or None for an empty file. Raises YAMLError, ValueError and `_LoopsError`."""
    import yaml

    class Loader(yaml.SafeLoader):  # type: ignore[misc] # PyYAML has no types
        depth = 0

        def compose_node(self, parent: Any, index: Any) -> Any:
            if self.depth == _DEEPEST:
                raise _LoopsError(f"lists are nested {_DEEPEST} deep", self.peek_event())
            self.depth += 1
            node = super().compose_node(parent, index)
            self.depth -= 1
            return node

    if len(content) > _LARGEST:
        raise _LoopsError(f"the file has more than {_LARGEST:,} bytes")
    return yaml.compose(content, Loader)


def _bounded(elements: Iterator[tuple[str, int]]) -> list[tuple[str, int]]:
    """Return the elements. Raises `_LoopsError` if the elements are too long."""
    kept, size = list[tuple[str, int]](), 0
    for element, line in elements:
        kept.append((element, line))
        size += len(element)
        if size > _MOST:
            raise _LoopsError(f"the elements for the URDF have more than {_MOST:,} characters")
    return kept


def _items(parts: Mapping[str, Any], key: str) -> Sequence[Any]:
    """Return the items of a list; empty if the key is missing."""
    node = parts.get(key)
    if node is None or node.value in ("", "null", "~"):
        return ()
    if node.id != "sequence":
        raise _LoopsError(f"`{key}` is no list", node)
    return node.value  # type: ignore[no-any-return] # it is a list of nodes


def _names(nodes: Sequence[Any], key: str) -> Sequence[Any]:
    """Return the nodes. Raises `_LoopsError` for a list or a mapping."""
    for node in nodes:
        if node.id != "scalar":
            raise _LoopsError(f"an item of `{key}` is no name", node)
    return nodes


def _elements(document: Any) -> Iterator[tuple[str, int]]:
    """Yield each element, and its line in the YAML."""
    from xml.sax.saxutils import quoteattr  # a late import saves most robots 9 ms

    if document.id != "mapping":
        return  # a YAML of another kind, which contains the word `closed_loop`
    parts = dict[str, Any]()
    for key, value in document.value:
        if key.id != "scalar":
            continue
        if key.value in parts:
            raise _LoopsError(f"the key `{key.value}` stands twice", key)
        parts[key.value] = value
    for key, node in parts.items():
        if key.startswith("closed_loop") and "closed_loop" not in parts and node.id == "sequence":
            raise _LoopsError(f"the key `{key}` is unknown; perhaps `closed_loop` is meant", node)
    pairs, kinds = _items(parts, "closed_loop"), _names(_items(parts, "type"), "type")
    if len(pairs) != len(kinds):
        raise _LoopsError(f"the file has {counted(len(pairs), 'loop')} and {counted(len(kinds), 'type')}")
    for pair, kind in zip(pairs, kinds, strict=True):
        if pair.id != "sequence" or len(pair.value) != 2:
            raise _LoopsError("an item of `closed_loop` is no pair of frames", pair)
        first, second = (quoteattr(end.value) for end in _names(pair.value, "closed_loop"))
        if kind.value.lower() not in _KINDS:
            raise _LoopsError(f"the type {kind.value!r} is none of {', '.join(_KINDS)}", kind)
        name = quoteattr(f"{pair.value[0].value}_{pair.value[1].value}")
        ends = f"<link1 link={first}/><link2 link={second}/>"
        kind_name = _KINDS[kind.value.lower()]
        yield f'<loop_joint name={name} type="{kind_name}">{ends}</loop_joint>', pair.start_mark.line + 1
    for joint in _names(_items(parts, "name_mot"), "name_mot"):
        name = quoteattr(joint.value)
        yield f"<transmission name={name}><joint name={name}/></transmission>", joint.start_mark.line + 1
    joints, kinds = (_names(_items(parts, key), key) for key in ("joint_name", "joint_type"))
    if len(joints) != len(kinds):
        raise _LoopsError(f"the file has {counted(len(joints), 'joint')} and {counted(len(kinds), 'joint type')}")
    for joint, kind in zip(joints, kinds, strict=True):
        if kind.value not in _TYPES:
            raise _LoopsError(f"the joint type {kind.value!r} is none of {', '.join(_TYPES)}", kind)
        yield f'<{AXES} joint={quoteattr(joint.value)} axes="{_TYPES[kind.value]}"/>', joint.start_mark.line + 1


def split_joints(document: xml.Document, balls: Collection[str] = ()) -> xml.Document:
    """Return the document with one joint for each axis of a joint; a joint without an axis becomes fixed.

    The new joints count as only measured. Elements with an unknown joint or axes stay. Joints of Drake become plain
    joints or chains. The named `balls` become chains, and each joint of such a chain gets the ball's damping.
    """
    root, places = document.root, document.lines
    own = {
        part: _DRAKE[kind] for part in root if part.tag == "drake:joint" and (kind := part.get("type", "")) in _DRAKE
    }
    for joint in own:
        joint.tag = "joint"
    own |= {joint: "xyz" for joint in root.findall("joint") if joint.get("name") in balls}
    chains = [(joint, axes, places[joint], joint.find("dynamics[@damping]")) for joint, axes in own.items() if axes]
    joints = {joint.get("name", ""): joint for joint in root.findall("joint")}
    for element in root.findall(AXES):
        name, axes = element.get("joint", ""), element.get("axes", "")
        if name in joints and _DIRECTIONS.keys() >= set(axes):
            root.remove(element)
            chains.append((joints[name], axes, places[element], None))
    lines = dict(places) if chains else {}
    for first, letters, line, damping in chains:
        name, chain = first.get("name", ""), [first]
        for part in [part for part in chain[0] if part.tag in ("axis", "limit", "dynamics")]:
            chain[0].remove(part)
        if not letters:
            chain[0].set("type", "fixed")
            continue
        names = [f"{name}_{letter}" for letter in letters]
        links = [SubElement(root, "link", name=inner) for inner in names[:-1]]
        for inner in names[:-1]:
            chain.append(SubElement(root, "joint"))
            SubElement(chain[-1], "parent", link=inner)
        children = [*names[:-1], *(child.get("link", "") for child in chain[0].findall("child"))]
        control = SubElement(root, "ros2_control", name=name)
        for joint, letter, new, child in zip(chain, letters, names, children, strict=False):
            joint.attrib |= {"name": new, "type": "continuous"}
            SubElement(joint, "axis", xyz=_DIRECTIONS[letter])
            for old in joint.findall("child"):
                joint.remove(old)
            SubElement(joint, "child", link=child)
            if damping is not None:
                SubElement(joint, "dynamics", damping=damping.get("damping", ""))
            SubElement(SubElement(control, "joint", name=new), "state_interface", name="position")
        for part in (*chain, *links, control):
            lines |= dict.fromkeys(part.iter(), line)
    return document._replace(lines=lines or places)
