"""Template data of the robot model, `<Robot>.mo`: connectors, parts and connections, and their places."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import msgspec

from urdfsync.domain import Target
from urdfsync.urdf.diagram import layout
from urdfsync.urdf.frames import frame_links
from urdfsync.urdf.kinematics.tree import MOTION_KINDS, KinematicTree, Motion
from urdfsync.urdf.model import notes
from urdfsync.urdf.model.connectors import Connectors, connectors
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Joint, JointType

ROW = 20
"""Height of a row of connectors on the icon: an axis, and its support 10 below."""
_PICTURE = 100  # where the picture on the icon ends, and the rows begin


class Frame(msgspec.Struct, frozen=True):
    """A frame connector of a link; `y` is its height on the icon."""

    connector: str
    link: str
    name: str
    y: int


class Drive(msgspec.Struct, frozen=True):
    """The connectors of a joint that can be driven; `y` is the height of the axis on the icon."""

    joint: str
    name: str
    motion: Motion
    axis: str
    support: str
    y: int


class Part(msgspec.Struct, frozen=True):
    """A link."""

    component: str
    type: str
    name: str


class Following(msgspec.Struct, frozen=True):
    """How a joint follows another one, by the names of components; without a `leader`, it is held."""

    coupling: str
    leader: str | None
    leader_motion: Motion | None


class JointPart(msgspec.Struct, frozen=True):
    """A joint; `axis` is its connector, if it can be driven, `followers` are the couplings of joints that follow it."""

    component: str
    type: str
    kind: JointType
    title: str
    axis: str | None
    follows: Following | None
    followers: tuple[str, ...]


class Coupling(msgspec.Struct, frozen=True):
    """A mimic coupling, by the names of components; without a `leader` it holds its follower by itself."""

    component: str
    leader: str | None
    leader_motion: Motion | None
    follower: str
    follower_motion: Motion
    name: str
    leader_name: str


class Line(msgspec.Struct, frozen=True):
    """A connection in the robot's diagram."""

    start: str
    end: str
    kind: layout.LineKind
    points: str


def robot_data(skeleton: KinematicTree, target: Target, options: Options) -> dict[str, Any]:
    """Data of the robot model. It depends on the structure of the robot alone, on no number of the URDF."""
    names = connector_names(skeleton, options)
    frames, drives = _frames(skeleton, names), drive_rows(skeleton, names)
    diagram = layout.layout(tree(skeleton, names))
    return {
        "within": target.package,
        "type": target.name,
        "title": f"robot {target.name}",
        "note": notes.robot_note(target.name),
        "base": options.base,
        "frames": frames,
        "drives": drives,
        "links": [
            Part(skeleton.link(link.name).component, skeleton.link(link.name).type, link.name)
            for link in skeleton.links
        ],
        "joints": _joints(skeleton, names),
        "couplings": couplings(skeleton, names),
        "top": icon_top(names),
        "extent": _extent(diagram.extent),
        "diagram": {name: _extent((box.x1, box.y1, box.x2, box.y2)) for name, box in diagram.placements.items()},
        "lines": [
            Line(start, end, diagram.kinds[start, end], ", ".join([f"{{{x}, {y}}}" for x, y in points]))
            for (start, end), points in diagram.lines.items()
        ],
    }


def connector_names(skeleton: KinematicTree, options: Options) -> Connectors:
    """The names of a robot's connectors."""
    return connectors(skeleton, (link.name for link in frame_links(skeleton, options)))


def drive_rows(skeleton: KinematicTree, names: Connectors) -> list[Drive]:
    """The joints that can be driven, from top to bottom of the icon."""
    joints = [joint for joint in skeleton.joints if joint.name in names.axes]
    top = icon_top(names)
    return [
        Drive(
            skeleton.joint(joint.name).component,
            joint.name,
            MOTION_KINDS[joint.type],
            names.axes[joint.name],
            names.supports[joint.name],
            top - 10 - ROW * row,
        )
        for row, joint in enumerate(joints)
    ]


def icon_top(names: Connectors) -> int:
    """Where the icon ends above: over the picture there is a row for each connector at one side."""
    rows = max(len(names.frames), len(names.axes))
    return _PICTURE + ROW * rows + 10 if rows else _PICTURE


def couplings(skeleton: KinematicTree, names: Connectors) -> list[Coupling]:
    """One entry per joint that follows another one."""
    types = {joint.name: joint.type for joint in skeleton.joints}
    result = []
    for joint, mimic in skeleton.followers():
        motion = MOTION_KINDS.get(types[mimic.joint])
        leader = skeleton.joint(mimic.joint).component if motion else None
        follower = skeleton.joint(joint.name).component
        coupling = names.couplings[joint.name]
        result.append(Coupling(coupling, leader, motion, follower, MOTION_KINDS[joint.type], joint.name, mimic.joint))
    return result


def tree(skeleton: KinematicTree, names: Connectors) -> layout.Tree:
    """What the robot's diagram shows."""
    children = {
        skeleton.link(link).component: [
            layout.TreeJoint(
                skeleton.joint(joint.name).component,
                skeleton.link(joint.child).component,
                MOTION_KINDS.get(joint.type) or ("fixed" if joint.type == "fixed" else "free"),
                names.axes.get(joint.name),
                names.supports.get(joint.name),
            )
            for joint in joints
        ]
        for link, joints in skeleton.children().items()
    }
    return layout.Tree(
        root=skeleton.link(skeleton.links[0].name).component,
        children=children,
        frames={skeleton.link(link).component: name for link, name in names.frames.items()},
        couplings=[layout.TreeCoupling(c.component, c.leader, c.follower) for c in couplings(skeleton, names)],
    )


def _frames(skeleton: KinematicTree, names: Connectors) -> list[Frame]:
    top = icon_top(names)
    return [
        Frame(connector, skeleton.link(name).component, name, top - 10 - ROW * row)
        for row, (name, connector) in enumerate(names.frames.items())
    ]


def _joints(skeleton: KinematicTree, names: Connectors) -> list[JointPart]:
    followers = skeleton.followers_by_leader()
    types = {joint.name: joint.type for joint in skeleton.joints}
    return [
        JointPart(
            skeleton.joint(joint.name).component,
            skeleton.joint(joint.name).type,
            joint.type,
            notes.joint_title(joint),
            names.axes.get(joint.name),
            _following(skeleton, joint, types, names),
            tuple(
                names.couplings[follower.name]
                for follower, _ in followers.get(joint.name, ())
                if joint.type in MOTION_KINDS
            ),
        )
        for joint in skeleton.joints
    ]


def _following(
    skeleton: KinematicTree, joint: Joint, types: Mapping[str, JointType], names: Connectors
) -> Following | None:
    if joint.mimic is None or joint.type not in MOTION_KINDS:
        return None
    motion = MOTION_KINDS.get(types[joint.mimic.joint])
    leader = skeleton.joint(joint.mimic.joint).component if motion else None
    return Following(names.couplings[joint.name], leader, motion)


def _extent(box: Iterable[int]) -> str:
    x1, y1, x2, y2 = box
    return f"{{{{{x1}, {y1}}}, {{{x2}, {y2}}}}}"
