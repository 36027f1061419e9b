"""Reads the loops of a robot from a source and the configuration.

- `<loop_joint>` of Isaac Sim and early Drake: `<link1>` and `<link2>`, each with `link`, `xyz` and `rpy`. Isaac Sim's
  page has `<link1>` twice. Exporters of Fusion 360 write `<parent>` and `<child>`: see `_read_ends`.
- `<drake:ball_constraint>`: two bodies, each with a point.
- `<joint>` of SDF within `<gazebo>`: the frame is given in the child link; all joints at zero close the loop.
- Two links `closing_NAME_1` and `closing_NAME_2` of onshape-to-robot. These names state no kind of joint. The loop
  counts as a ball: in a planar loop, a ball has the effect of a hinge.
- The option `loops`. Such a loop replaces a loop of the source with an equal name or equal frames.

Other forms of loops are only reported: no page documents raisim's pins, MuJoCo's `<equality>` or joints of plugins as
parts of a URDF. MuJoCo documents only `<compiler>`, `<option>` and `<size>` as parts of a URDF (XML reference, URDF).
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from xml.etree.ElementTree import Element

import msgspec
from msgspec.structs import replace

from urdfsync.formats.urdf import validate
from urdfsync.formats.urdf.kinematics.poses import AXES, Pose, across, angles, compose, inverse, link_poses, pose
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.options import LoopFrame, LoopOption, Options
from urdfsync.formats.urdf.parse.closures import Closures
from urdfsync.formats.urdf.parse.fields import Reader, quoted
from urdfsync.formats.urdf.parse.gazebo import FORCES
from urdfsync.formats.urdf.robot import Link, Loop, LoopKind, Origin, Robot, Vector

_BALL = "drake:ball_constraint"
TAGS = ("loop_joint", _BALL)
"""Elements that close loops as children of `<robot>`; within `<gazebo>`, `<joint>` closes a loop."""
_PARTS: Mapping[str, Sequence[str]] = {
    "loop_joint": (
        *("link1", "link2", "axis", "parent", "child", "origin", "parent_origin", "child_origin"),
        *("world_origin", "world_axis"),  # exporters also write origin and axis in the frame of the root
    ),
    _BALL: (f"{_BALL}_body_A", f"{_BALL}_p_AP", f"{_BALL}_body_B", f"{_BALL}_p_BQ"),
}
_NO_LOOPS = frozenset({"link", "joint", "material", "transmission", "ros2_control", "sensor", "drake:joint", *TAGS})

_KINDS: Mapping[str, LoopKind] = {
    "ball": "ball",
    "spherical": "ball",
    "revolute": "revolute",
    "continuous": "revolute",
    "universal": "universal",
    "fixed": "fixed",
}
_JOINS_NOTHING = re.compile("collision|contact|exclude|group|chain|effector|frame|virtual|sensor|camera")
"""Elements that name links without joining them, such as elements of SRDF."""
_CONSTRAINS = re.compile("constraint|equality|coupl|weld|gear|tendon|spring")
_CLOSING = re.compile(r"(closing_.+)_([12])")
_DETACHABLE = ("parent_link", "child_link")
_DIGITS = 12
_X, _, _Z = AXES


class _NameAttribute(msgspec.Struct):
    name: str


def _find_loop_elements(root: Element) -> Iterator[Element]:
    """Yield the elements of a robot that close loops."""
    for child in root:
        if child.tag in TAGS:
            yield child
        elif child.tag == "gazebo":
            yield from child.findall("joint")


def tell_foreign_loops(reader: Reader, root: Element, options: Options) -> None:
    """Add a finding for each unread element that joins or constrains links.

    If the configuration has a loop between the two links, the element is not reported.
    """
    links = {name for link in root.iterfind("link") if not (name := link.get("name", "")).isdecimal()}
    stated = {frozenset({loop.parent, loop.child}) for loop in configured_loops(options.loops)}
    for child in root:
        if child.tag == "gazebo":  # as gz-sim's page on DetachableJoint documents
            pairs = ((part, {part.findtext(tag, "").strip() for tag in _DETACHABLE}) for part in child.iter("plugin"))
            found = [(part, pair) for part, pair in pairs if len(pair & links) == len(_DETACHABLE)]
        elif child.tag in _NO_LOOPS or FORCES.search(child.tag):
            continue
        else:
            constraints = ((part, set[str]()) for part in child.iter() if _CONSTRAINS.search(part.tag))
            found = list(_find_pairs(child, links)) or [*itertools.islice(constraints, 1)]
        for part, pair in found:
            words = f"<{part.tag}> {part.get('name', '')}".rstrip()
            if not pair:
                reader.add(part, "force-left-out", f"{words} constrains the robot, but is left out of the model")
            elif frozenset(pair) not in stated:
                message = (
                    f"{words} joins links {' and '.join(map(repr, sorted(pair)))} in a form that urdfsync does not read"
                )
                hint = 'state the loop in `loops` of the configuration, or leave it out by `allow = ["loop-joint"]`'
                reader.add(part, "loop-joint", message, hint)


def _find_pairs(element: Element, links: Collection[str]) -> Iterator[tuple[Element, set[str]]]:
    """Yield the innermost elements that name two links in attributes or texts, or in those of their parts."""
    if _JOINS_NOTHING.search(element.tag):
        return
    words = [text for name, text in element.items() if name != "name"]
    words += [text.strip() for part in element for text in (*part.attrib.values(), part.text or "")]
    inner = [pair for part in element for pair in _find_pairs(part, links)]
    yield from inner
    if not inner and len(pair := {word for word in words if word in links}) == 2:
        yield element, pair


def read_loops(reader: Reader, root: Element, robot: Robot, options: Options, closures: Closures) -> tuple[Loop, ...]:
    """Return the loops of a robot. `robot` is a tree, with all parts but the loops. Faulty loops are left out."""
    links = {link.name for link in robot.links}
    ends = {joint.name: joint.child for joint in robot.joints if joint.name not in links}
    # a loop may name a joint instead of the joint's child link: both have one frame
    stated = [
        replace(loop, parent=ends.get(loop.parent, loop.parent), child=ends.get(loop.child, loop.child))
        for loop in _stated_loops(reader, root, robot, closures)
    ]
    configured = configured_loops(options.loops)
    faulty = {finding.path for finding in validate.check_loops(configured, links)}
    paths = validate.element_paths("loop", (loop.name for loop in configured))
    # option_names reports faulty loops
    chosen = [loop for path, loop in zip(paths, configured, strict=True) if path not in faulty]
    of_source = [*_without_rivals(reader, stated, configured), *_frames_by_name(reader, robot.links, configured)]
    reader.extend(validate.check_loops(of_source, links))
    return tuple(map(_unit, (*chosen, *of_source)))


def _stated_loops(reader: Reader, root: Element, robot: Robot, closures: Closures) -> Iterator[Loop]:
    """Yield the loops of the URDF, then those of the YAML."""
    elements = list(_find_loop_elements(root))
    poses = link_poses(KinematicTree.of(robot), {}) if elements else {}
    names = [element.get("name") or f"loop_{number}" for number, element in enumerate(elements, start=1)]
    of_gazebo = {link.get("name") for part in root.iterfind("gazebo") for link in part.iterfind("link")}
    paths = validate.element_paths("loop", [*names, *(loop.name for loop, _ in closures.loops)])
    for element, name, path in zip(elements, names, paths, strict=False):
        reader.place(element, path)
        if element.tag == "loop_joint":
            loop = _read_loop_joint(reader, element, path, name, poses)
        elif element.tag == _BALL:
            loop = _read_ball(reader, element, path, name)
        else:
            loop = _read_joint(reader, element, path, name, poses, of_gazebo - poses.keys())
        if loop is not None and loop.parent and loop.child:  # reader.read reports a missing name
            yield loop
    for (loop, line), path in zip(closures.loops, paths[len(names) :], strict=True):
        reader.put(path, line, closures.file)
        yield loop


def _without_rivals(reader: Reader, loops: Iterable[Loop], configured: Sequence[Loop]) -> Iterator[Loop]:
    """Yield the loops that the configuration does not replace; report each loop that it has with other numbers."""
    for loop in loops:
        rival = _find_rival(loop, configured)
        if rival is None:
            yield loop
        elif _unit(rival) != _unit(loop):
            message = f"loop {loop.name!r} differs from `loops` in the configuration: the configuration counts"
            reader.tell("loop-contradiction", f"loop {loop.name}", message)


def configured_loops(loops: Sequence[LoopOption]) -> list[Loop]:
    """Return the loops of the option `loops`; their axes are not normalised."""
    return [_between(loop.name, loop.kind, loop.frames, loop.axis, loop.child_axis) for loop in loops]


def _find_rival(loop: Loop, configured: Sequence[Loop]) -> Loop | None:
    """Return the configured loop that has the name or the frames of a loop of the source."""
    return next((other for other in configured if other.name == loop.name or _ends(other) == _ends(loop)), None)


def _between(
    name: str, kind: LoopKind, frames: Iterable[str | LoopFrame], axis: Vector = _Z, child_axis: Vector = _X
) -> Loop:
    """Return a loop between two frames; axes that its kind lacks are the default: sources fill these in differently."""
    parent, child = (LoopFrame(end) if isinstance(end, str) else end for end in frames)
    origins = Origin(parent.xyz, parent.rpy), Origin(child.xyz, child.rpy)
    axes = (axis if kind in ("revolute", "universal") else _Z), (child_axis if kind == "universal" else _X)
    return Loop(name, kind, parent.link, child.link, *origins, *axes)


def _ends(loop: Loop) -> frozenset[tuple[str, Origin]]:
    return frozenset({(loop.parent, loop.origin), (loop.child, loop.child_origin)})


def _vector(reader: Reader, element: Element, place: str, path: str) -> Vector | None:
    return reader.numbers(element, [place], path, "bad-number", 3)  # type: ignore[return-value] # has three numbers


def _second_axis(axis: Vector) -> Vector:
    return across(validate.unit_vector(axis))[1]


def _unit(loop: Loop) -> Loop:
    axes = validate.unit_vector(loop.axis), validate.unit_vector(loop.child_axis)
    return replace(loop, axis=axes[0], child_axis=axes[1])


def _kind(reader: Reader, element: Element, path: str) -> LoopKind | None:
    text = element.get("type", "")
    if text not in _KINDS:
        message = f"{path} has type={quoted(text)}, which is no kind of loop"
        reader.add(element, "loop-joint", message, validate.perhaps(text, _KINDS))
    return _KINDS.get(text)


def _expect_parts(reader: Reader, element: Element, path: str, *attributes: str) -> None:
    """Report unexpected attributes and parts of an element that closes a loop."""
    reader.expect(element, path, ("name", *attributes))
    for part in element:
        if part.tag not in _PARTS[element.tag]:
            reader.keep(part, path, _PARTS[element.tag], path, moves=True)
        elif part.tag == "axis":
            reader.expect(part, f"{path} / axis", ("xyz", "frame"))


def _read_loop_joint(reader: Reader, element: Element, path: str, name: str, poses: Mapping[str, Pose]) -> Loop | None:
    _expect_parts(reader, element, path, "type")
    ends = [child for child in element if child.tag in ("link1", "link2")]  # Isaac Sim's exporter writes link1 twice
    kind = _kind(reader, element, path)
    if not ends and {"parent", "child"} <= {part.tag for part in element}:
        frames = _read_ends(reader, element, path, poses)
    elif len(ends) == 2:
        frames = [
            reader.read(end, f"{path} / link{number}", LoopFrame, path) for number, end in enumerate(ends, start=1)
        ]
    else:
        reader.add(element, "missing-element", f"{path} has {len(ends)} of the elements <link1> and <link2>")
        return None
    if (frame := element.find("axis[@frame]")) is not None and frame.get("frame") != "parent":
        message = f"{path} has its <axis> in the frame {quoted(frame.get('frame', ''))}"
        reader.add(element, "loop-joint", message, 'write the axis in the frame of the parent: frame="parent"')
    axis = _vector(reader, element, "axis@xyz", path) or _X
    return kind and _between(name, kind, frames, axis, _second_axis(axis))


def _read_ends(reader: Reader, element: Element, path: str, poses: Mapping[str, Pose]) -> list[LoopFrame]:
    """Return the frames of the elements `<parent>` and `<child>`.

    Each element states the place of its frame itself, or in `<parent_origin>` or `<child_origin>`. Without an
    orientation in `<child_origin>`, both frames are parallel with all joints at zero, as at the export. `<origin>` is
    the frame of a URDF joint in the parent link.
    """
    frames = list[LoopFrame]()
    for tag in ("parent", "child"):
        end = next(element.iter(tag))
        frames.append(reader.read(end, f"{path} / {tag}", LoopFrame, path))
        for part in (*element.findall(f"{tag}_origin"), *(element.findall("origin") if tag == "parent" else ())):
            origin = reader.read(part, f"{path} / {part.tag}", Origin, path)
            frames[-1] = LoopFrame(frames[-1].link, origin.xyz, origin.rpy)
    parent, child = frames
    own = element.find("child_origin")
    if own is not None and "rpy" not in own.attrib and {parent.link, child.link} <= poses.keys():
        held = compose(poses[parent.link], pose(Origin(parent.xyz, parent.rpy)))
        frames[1] = replace(child, rpy=_origin(compose(inverse(poses[child.link]), held)).rpy)
    return frames


def _read_ball(reader: Reader, element: Element, path: str, name: str) -> Loop | None:
    _expect_parts(reader, element, path)
    frames = []
    for body, point in (_PARTS[_BALL][:2], _PARTS[_BALL][2:]):
        part = reader.find(element, body)
        if part is None:
            reader.add(element, "missing-element", f"{path} has no <{body}>")
            return None
        place = _vector(reader, element, f"{point}@value", path) or (0.0, 0.0, 0.0)
        frames.append(LoopFrame(reader.read(part, path, _NameAttribute, path).name, place))
    return _between(name, "ball", frames)


def _read_joint(
    reader: Reader, element: Element, path: str, name: str, poses: Mapping[str, Pose], in_gazebo: Collection[str | None]
) -> Loop | None:
    """Read a joint of SDF as a loop; `<pose>` gives its frame in the child link.

    `in_gazebo` are the links that only Gazebo has. A joint to such a link closes no loop of the robot.
    """
    kind = _kind(reader, element, path)
    parent, child = (element.findtext(tag, "").strip() for tag in ("parent", "child"))
    for tag, link in (("parent", parent), ("child", child)):
        if not link:
            reader.add(element, "missing-element", f"{path} has no <{tag}>")
        elif kind and link in in_gazebo:
            hint = 'add that link to the robot, or leave the loop out by `allow = ["loop-joint"]`'
            reader.add(element, "loop-joint", f"{path} has a frame on link {link!r}, which only Gazebo has", hint)
            kind = None
    for tag, attribute in (("pose", "relative_to"), ("axis/xyz", "expressed_in"), ("axis2/xyz", "expressed_in")):
        part = reader.find(element, tag)
        frame = child if part is None else part.get(attribute) or child
        if kind and child and frame != child:
            message, hint = f"{path} has its <{tag}> in the frame {frame!r}", f"use the frame of link {child!r}"
            reader.add(element, "loop-joint", message, hint)
            kind = None
    numbers = reader.numbers(element, ["pose"], path, "bad-number", 6) or (0.0,) * 6
    axis = _vector(reader, element, "axis/xyz", path) or _Z
    second = _vector(reader, element, "axis2/xyz", path)
    if kind is None or parent not in poses or child not in poses:
        known = kind is None or not (parent and child)
        return None if known else Loop(name, kind or "ball", parent, child)  # validate reports a missing link
    own = Origin(numbers[:3], numbers[3:])  # type: ignore[arg-type] # six numbers
    origin = _origin(compose(inverse(poses[parent]), compose(poses[child], pose(own))))
    frames = LoopFrame(parent, origin.xyz, origin.rpy), LoopFrame(child, own.xyz, own.rpy)
    return _between(name, kind, frames, axis, second or _second_axis(axis))


def _origin(of: Pose) -> Origin:
    """Return a pose as place and angles; rounding makes the numbers equal on all machines."""
    rotation, place = of
    xyz, rpy = (tuple(round(value, _DIGITS) + 0.0 for value in values) for values in (place, angles(rotation)))
    return Origin(xyz, rpy)  # type: ignore[arg-type]


def _frames_by_name(reader: Reader, links: Sequence[Link], configured: Sequence[Loop]) -> Iterator[Loop]:
    """Yield a ball for each pair of links with onshape-to-robot's names of a loop, unless `configured` has the loop."""
    pairs: dict[str, dict[str, str]] = {}
    for link in links:
        if match := _CLOSING.fullmatch(link.name):
            pairs.setdefault(match[1], {})[match[2]] = link.name
    framed = {link for loop in configured for link in (loop.parent, loop.child)}
    for name, pair in pairs.items():
        if len(pair) == 1:
            (end,) = pair.values()
            if end not in framed:
                other = f"{name}_{'2' if '1' in pair else '1'}"
                message = f"link {end!r} closes no loop by its name: there is no link {other!r}"
                hint = validate.perhaps(other, {link.name for link in links} - {end})
                reader.tell("loop-one-end", f"link {end}", message, hint)
            continue
        loop = Loop(name, "ball", pair["1"], pair["2"])
        if _find_rival(loop, configured) is None:
            reader.lines.setdefault(f"loop {name}", reader.lines[f"link {pair['1']}"])
            message = f"links {pair['1']!r} and {pair['2']!r} close a loop by their names, as a ball"
            reader.tell("loop-by-name", f"loop {name}", message)
            yield loop
