"""Makes the links, joints and loops of a robot from a model of SDF."""

from __future__ import annotations

from collections.abc import Iterable

from urdfsync.formats.sdf.frames import Frame, Frames
from urdfsync.formats.sdf.joints import JointAxis, SdfJoint, read_joints
from urdfsync.formats.sdf.leftovers import add_leftovers
from urdfsync.formats.sdf.parts import add_link, add_sensor
from urdfsync.formats.sdf.tree import LOOP_KINDS, find_tree
from urdfsync.formats.sdf.urdf import Urdf, turn
from urdfsync.formats.translation.writer import UrdfElement, free_name, rounded
from urdfsync.formats.urdf.kinematics.poses import IDENTITY, moved
from urdfsync.formats.urdf.robot import Vector


def translated(frames: Frames, model: Frame) -> UrdfElement:
    """Return the URDF of a model. Raises TranslationError."""
    for part in (part for scope in model.each() for part in scope.parts):
        frames.check(part)
    document, joints = frames.document, read_joints(frames, model.of_kind("joint"))
    tree = find_tree(frames.world, list(model.of_kind("link")), joints, frames.link_of(model))
    urdf, is_fixed = Urdf(frames, model, tree), tree.root is frames.world
    if is_fixed:
        urdf.root.add("link", document.places[model.content], name=urdf.links[frames.world])
    elif not document.flag(model.static_holder, "static"):
        urdf.root.add("free_root", document.places[tree.root.element], link=urdf.links[tree.root])
        if frames.pose(tree.root, frames.world) != IDENTITY:
            poses = (holder.find("pose") for holder in (model.element, model.content, tree.root.element))
            place = next((pose for pose in poses if pose is not None), model.element)
            urdf.root.add("start-pose", document.places[place], name=model.name)
    links = [*([] if is_fixed else [tree.root]), *(joint.child for joint in tree.joints)]
    for link in links:
        add_link(urdf, link)
    for joint in tree.joints:
        _add_joint(urdf, joint)
    for joint in tree.loops:
        _add_loop(urdf, joint)
    _add_frames(urdf, [frame for frame in model.of_kind("frame") if frames.link_of(frame) in (*links, tree.root)])
    for joint in tree.joints:
        for sensor in joint.frame.element.iterfind("sensor"):
            if joint.is_turned or len(joint.axes) > 1:  # parent and child of the sensor are others in the URDF
                urdf.note(sensor, joint.frame.name)
            else:
                add_sensor(urdf, sensor, joint.child, {"joint": joint.frame.name}, joint.frame)
    for link in tree.loose:
        urdf.leave_out("loose link", link.name, link.element)
    add_leftovers(urdf, model, joints)
    return urdf.root


def _add_joint(urdf: Urdf, joint: SdfJoint) -> None:
    """Add a joint of the tree; one with two axes becomes two hinges with a link without mass between them."""
    line, child = urdf.document.places[joint.frame.element], joint.child
    rotation, place = urdf.frames.pose(child, joint.parent)
    origin = urdf.place(joint.parent, joint.parent, (rotation, moved((rotation, place), urdf.offsets[child])))
    parts = list(zip(urdf.joint_names[joint.frame], joint.axes or (None,), strict=True))[
        :: -1 if joint.is_turned else 1
    ]
    parent = urdf.links[joint.parent]
    for number, (name, axis) in enumerate(parts, start=1):
        kind = joint.kind if len(parts) == 1 else "revolute"
        if kind == "revolute" and axis is not None and axis.range is None:
            kind = "continuous"
        end = urdf.links[child] if number == len(parts) else free_name(name, urdf.taken)
        node = urdf.root.add("joint", line, name=name, type="fixed" if kind == "screw" else kind)
        node.add("parent", link=parent)
        node.add("child", link=end)
        urdf.add_origin(node, origin if number == 1 else IDENTITY)
        if axis is not None:
            _add_axis(urdf, node, joint, axis)
        if joint.damping:
            node.add("dynamics", damping=joint.damping)
        if number < len(parts):
            urdf.root.add("link", line, name=end)
        parent = end


def _add_axis(urdf: Urdf, node: UrdfElement, joint: SdfJoint, axis: JointAxis) -> None:
    x, y, z = _turned(urdf, axis, joint.child)
    node.add("axis", xyz=rounded((-x, -y, -z) if joint.is_turned else (x, y, z)))
    lower, upper = axis.range if axis.range and node.attributes["type"] != "continuous" else (None, None)
    if lower is None and node.attributes["type"] == "prismatic":  # in URDF, a limit of a sliding joint has a range
        for name in (name for name, value in axis.most.items() if value is not None):
            node.add(name, urdf.document.places[joint.frame.element])
    elif {lower, upper, *axis.most.values()} - {None}:
        node.add("limit", lower=lower, upper=upper).attributes |= axis.most
    if any(axis.dynamics.values()):
        node.add("dynamics").attributes |= axis.dynamics
    if axis.mimic:
        node.add("mimic", **axis.mimic)


def _turned(urdf: Urdf, axis: JointAxis, base: Frame) -> Vector:
    """Return the direction of an axis in a frame."""
    rotation, _ = urdf.frames.pose(axis.given_in, base)
    return moved((rotation, (0.0, 0.0, 0.0)), axis.vector)


def _add_loop(urdf: Urdf, joint: SdfJoint) -> None:
    """Add a loop in SDF's own words, which URDF has in `<gazebo>`: with its frame in the child link."""
    frame, kind = joint.frame, "universal" if joint.kind == "revolute2" else joint.kind
    if kind not in LOOP_KINDS:
        urdf.leave_out(f"{kind} joint that closes a loop", frame.name, frame.element)
        return
    if joint.has_numbers:
        urdf.leave_out("limits, losses or coupling of a joint that closes a loop", frame.name, frame.element)
    loop = urdf.root.add("gazebo", urdf.document.places[frame.element]).add("joint", name=frame.name, type=kind)
    loop.add("parent", text=urdf.links[joint.parent])
    loop.add("child", text=urdf.links[joint.child])
    rotation, place = urdf.place(frame, joint.child)
    loop.add("pose", text=" ".join(map(repr, (*rounded(place), *turn(rotation)))))
    for tag, axis in zip(("axis", "axis2"), joint.axes, strict=False):
        loop.add(tag).add("xyz", text=" ".join(map(repr, rounded(_turned(urdf, axis, frame)))))


def _add_frames(urdf: Urdf, frames: Iterable[Frame]) -> None:
    """Add a link without mass at a fixed joint for each `<frame>`."""
    for frame in frames:
        link, line = urdf.frames.link_of(frame), urdf.document.places[frame.element]
        name = free_name(frame.name, urdf.taken)
        urdf.root.add("link", line, name=name)
        joint = urdf.root.add("joint", line, name=free_name(f"{name}_fixed", urdf.taken_joints), type="fixed")
        joint.add("parent", link=urdf.links[link])
        joint.add("child", link=name)
        urdf.add_origin(joint, urdf.place(frame, link))
