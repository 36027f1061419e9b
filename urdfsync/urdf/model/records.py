"""Template data of the record approach: `<Robot>Parameters.mo` and its bench, `<Robot>Generic.mo`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.domain import Import, Target
from urdfsync.urdf.kinematics.tree import MOTION_KINDS, KinematicTree, Motion
from urdfsync.urdf.model import notes, shapes, tables
from urdfsync.urdf.model.connectors import connectors, visual_names
from urdfsync.urdf.model.stance import standing_height
from urdfsync.urdf.options import USES, Options
from urdfsync.urdf.robot import Inertial, Joint, JointType, Limit, Link

_VECTORS: Mapping[Motion, str] = {"rotational": "rotationalAxis", "translational": "translationalAxis"}
UNLIMITED: Mapping[str, None] = {"lower": None, "upper": None, "velocity": None, "effort": None}
"""Limits of a joint that has none, for the template of its record."""


class RecordLink(msgspec.Struct, frozen=True):
    """A link in the record of the whole robot, with its visuals; `number` counts from 1."""

    number: int
    component: str
    name: str
    inertial: Inertial | None
    visuals: tuple[shapes.Numbers, ...]


class RecordJoint(msgspec.Struct, frozen=True):
    """A joint in the record of the whole robot; `number` counts from 1."""

    number: int
    component: str
    joint: Joint

    @property
    def limits(self) -> Limit | Mapping[str, None]:
        """Its limits, all of them absent if it has none."""
        return self.joint.limit or UNLIMITED


class TableJoint(msgspec.Struct, frozen=True):
    """A joint whose numbers the tables refer to."""

    component: str
    type: JointType


class DrawnShape(msgspec.Struct, frozen=True):
    """An entry in the tables of shapes: a visual, or one of the three parts that a capsule is drawn as."""

    link: int
    """Number of its link, counted from 1."""
    visual: str
    """Component of the record with its numbers."""
    type: str
    """Class of that record; `LowerEnd` and `UpperEnd` are the round ends of a capsule."""
    length_axis: int
    """Axis of the shape frame along which its length is: 1 is x, 3 is z."""


class RecordAxis(msgspec.Struct, frozen=True):
    """A driven joint, with the vector of flanges and its number in it, counted from 1."""

    constant: str
    """What the record calls that number."""
    name: str
    vector: str
    number: int


def generic_data(skeleton: KinematicTree, target: Target, options: Options) -> dict[str, Any]:
    """Data of the bench in which the generic robot reads the record: structure only."""
    return {
        "within": target.package,
        "type": target.name,
        "record": f"{target.name}Parameters",
        "title": f"robot {target.name}",
        "note": notes.generic_note(target.name, options.base),
        "base": options.base,
        "rotational_axes": len(skeleton.axes("rotational")),
        "translational_axes": len(skeleton.axes("translational")),
    }


def record_data(
    structure: Mapping[str, Any],
    links: Sequence[RecordLink],
    joints: Sequence[RecordJoint],
    ground: tuple[KinematicTree, Mapping[str, Import]] | None,
    target: Target,
    name: str,
    generic: bool,
) -> dict[str, Any]:
    """Data of the record of the whole robot; a package around it names the libraries that it uses.

    `structure` is made by `structure_data`; `ground` is what has a part in the height that a mobile robot stands at;
    `generic` says whether the robot has tables.
    """
    return {
        "within": target.package,
        "record": f"{target.name}Parameters",
        "title": f"robot {target.name}",
        "note": notes.record_note(target.name, generic),
        "uses": () if target.package else USES,
        "name": name,
        "standing_height": standing_height(*ground) if ground else None,
        "structure": structure,
        "links": links,
        "joints": joints,
    }


def record_link(
    number: int,
    component: str,
    link: Link,
    visuals: Sequence[str],
    imports: Mapping[str, Import],
    package: str,
    options: Options,
) -> RecordLink:
    """A link of the record; `visuals` are the components of those visuals that can be shown."""
    found, _ = shapes.numbers(Link(link.name, visuals=link.visuals), imports, package, options)
    named = [msgspec.structs.replace(shape, component=name) for shape, name in zip(found, visuals, strict=True)]
    return RecordLink(number, component, link.name, link.inertial, tuple(named))


def structure_data(structure: KinematicTree, looks: Mapping[str, Sequence[shapes.Look]]) -> dict[str, Any]:
    """What the record says of the structure: its matrices, tables and axes; `looks` are the visuals of each link."""
    number = {link.name: k for k, link in enumerate(structure.links, 1)}
    generic = tables.has_tables(structure.joints)
    moving = tables.moving_joints(structure)
    return {
        "connection_matrix": [(number[joint.parent], number[joint.child]) for joint in structure.joints],
        "moveable_joints": [(k, 1) for k, joint in enumerate(structure.joints, 1) if joint.type != "fixed"],
        "tables": tables.structure(structure) if generic else None,
        "links": [structure.link(link.name).component for link in structure.links],
        "joints": _table_joints(structure, structure.joints),
        "moving": _table_joints(structure, moving),
        "turning": _table_joints(structure, (joint for joint in moving if MOTION_KINDS[joint.type] == "rotational")),
        "sliding": _table_joints(structure, (joint for joint in moving if MOTION_KINDS[joint.type] == "translational")),
        "followers": _table_joints(structure, tables.following_joints(structure)),
        "shapes": list(_drawn_shapes(structure, looks)),
        "axes": record_axes(structure) if generic else [],
    }


def _table_joints(skeleton: KinematicTree, joints: Iterable[Joint]) -> list[TableJoint]:
    return [TableJoint(skeleton.joint(joint.name).component, joint.type) for joint in joints]


def _drawn_shapes(structure: KinematicTree, looks: Mapping[str, Sequence[shapes.Look]]) -> Iterator[DrawnShape]:
    """The entries of the tables of shapes, link by link."""
    names = record_visuals(structure, looks)
    for number, link in enumerate(structure.links, 1):
        for look, name in zip(looks.get(link.name, ()), names.get(link.name, ()), strict=True):
            yield DrawnShape(number, name, look.type, 1 if look.type in ("Box", "Mesh") else 3)
            if look.type == "Capsule":
                yield DrawnShape(number, name, "LowerEnd", 3)
                yield DrawnShape(number, name, "UpperEnd", 3)


def record_visuals(structure: KinematicTree, looks: Mapping[str, Sequence[shapes.Look]]) -> dict[str, tuple[str, ...]]:
    """The components of the visuals of each link."""
    return visual_names(structure, {link: [look.component for look in found] for link, found in looks.items()})


def record_axes(skeleton: KinematicTree) -> list[RecordAxis]:
    """The driven joints: those that turn, then those that slide."""
    constants = connectors(skeleton, ()).axes
    return [
        RecordAxis(constants[joint.name], joint.name, vector, number)
        for motion, vector in _VECTORS.items()
        for number, joint in enumerate(skeleton.axes(motion), 1)
    ]
