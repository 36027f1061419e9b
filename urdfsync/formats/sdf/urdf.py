"""The URDF of a model of SDF, as it grows."""

from __future__ import annotations

import math
from collections.abc import Mapping
from xml.etree.ElementTree import Element

from urdfsync.formats.sdf.frames import WORLD, Frame, Frames
from urdfsync.formats.sdf.joints import TAGS
from urdfsync.formats.sdf.tree import JointTree
from urdfsync.formats.translation.writer import UrdfElement, free_name, rounded
from urdfsync.formats.urdf.kinematics.poses import IDENTITY, Matrix, Pose, angles, compose
from urdfsync.formats.urdf.robot import Vector

_TAGS = {"include": "model"} | {tag: f"{tag}-of-sdf" for tag in ("gazebo", "material", "ros2_control", "transmission")}
"""Tags that mean something else in URDF, by the tags that a note counts instead."""
_OFF = frozenset({"", "0", "false"})
_USUALLY_OFF = frozenset(
    "self_collide enable_wind must_be_base_link laser_retro initial_position slip1 slip2 soft_cfm".split()
)
"""Elements that are not counted if they are off, as without them."""


def turn(rotation: Matrix) -> Vector:
    """Return the angles of a rotation: of two possible triples the one that a user would write, such as 0 1.6 0."""
    roll, pitch, yaw = angles(rotation)
    other = (
        roll - math.copysign(math.pi, roll),
        math.copysign(math.pi, pitch) - pitch,
        yaw - math.copysign(math.pi, yaw),
    )
    least = min((roll, pitch, yaw), other, key=lambda each: abs(each[0]) + abs(each[2]))
    return rounded(least)  # type: ignore[return-value] # three numbers


class Urdf:
    """The URDF of a model.

    The frame of a link is that of SDF, moved to the origin of the joint that leads to the link: a joint of URDF has
    its axis through the origin of its child. Its axes stay parallel to those of SDF.
    """

    def __init__(self, frames: Frames, model: Frame, tree: JointTree) -> None:
        self.frames, self.document = frames, frames.document
        self.root = UrdfElement("robot", self.document.places[model.content], name=model.name, version="1.2")
        self.taken = {WORLD, *(link.name for link in model.of_kind("link"))}
        self.links = {
            link: free_name("world_link", self.taken) if link.name == WORLD else link.name
            for link in model.of_kind("link")
        } | {frames.world: WORLD}
        """Names of all links; before SDF 1.7, one could have the name of the world."""
        joints = (*tree.joints, *tree.loops)
        self.taken_joints = {joint.frame.name for joint in joints if len(joint.axes) < 2}
        self.joint_names = {
            joint.frame: [joint.frame.name]
            if len(joint.axes) < 2
            else [free_name(f"{joint.frame.name}_{tag}", self.taken_joints) for tag in TAGS]
            for joint in joints
        }
        """Names of the parts of each joint: one for each axis."""
        self.offsets = {joint.child: frames.pose(joint.frame, joint.child)[1] for joint in tree.joints}
        """Origin of each link in its frame of SDF."""

    def place(self, frame: Frame, link: Frame, inner: Pose = IDENTITY) -> Pose:
        """Return a pose, given in a frame of SDF, in the URDF's frame of a link."""
        rotation, (x, y, z) = compose(self.frames.pose(frame, link), inner)
        dx, dy, dz = self.offsets.get(link, (0.0, 0.0, 0.0))
        return rotation, (x - dx, y - dy, z - dz)

    def add_origin(self, holder: UrdfElement, pose: Pose) -> None:
        """Add a pose to an element of URDF."""
        rotation, place = pose
        holder.add("origin", xyz=rounded(place), rpy=turn(rotation))

    def leave_out(self, what: str, name: str, element: Element) -> None:
        """Tell of a part that acts on the robot, and that no model has."""
        self.root.add("left_out", self.document.places[element], what=what, name=name)

    def note(self, element: Element, name: str = "") -> None:
        """Count an element without an effect on the robot; one that is off as usual is not counted."""
        if element.tag in _USUALLY_OFF and (element.text or "").strip().lower() in _OFF:
            return
        self.root.add(
            _TAGS.get(element.tag, element.tag), self.document.places[element], name=element.get("name") or name or None
        )

    def copy(self, holder: UrdfElement, element: Element, full: Mapping[str, str] | None = None) -> UrdfElement:
        """Add a copy of an element; a text that is a key of `full` is replaced."""
        text = (element.text or "").strip()
        text = (full or {}).get(text, text)
        copied = holder.add(element.tag, self.document.places[element], text)
        copied.attributes.update(element.items())
        for part in element:
            self.copy(copied, part, full)
        return copied
