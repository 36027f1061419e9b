"""Template data of the record approach: `<Robot>Parameters.mo` and its bench, `<Robot>Generic.mo`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.domain import Import, Piece, Recipe, Target
from urdfsync.urdf.kinematics.tree import KinematicTree, Motion
from urdfsync.urdf.model import notes, tables
from urdfsync.urdf.model.connectors import connectors
from urdfsync.urdf.model.numbers import JointNumbers, joint_numbers
from urdfsync.urdf.model.stance import standing_height
from urdfsync.urdf.options import USES, Options
from urdfsync.urdf.robot import Inertial, Joint

_VECTORS: Mapping[Motion, str] = {"rotational": "rotationalAxis", "translational": "translationalAxis"}


class RecordLink(msgspec.Struct, frozen=True):
    """A link in the record of the whole robot; `number` counts from 1."""

    number: int
    component: str
    name: str
    inertial: Inertial | None


class RecordJoint(msgspec.Struct, frozen=True):
    """A joint in the record of the whole robot; `number` counts from 1."""

    number: int
    component: str
    joint: Joint

    @property
    def numbers(self) -> JointNumbers:
        """What the record says of it."""
        return joint_numbers(self.joint)


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
    structure: Recipe | Piece,
    links: Sequence[RecordLink | Piece],
    joints: Sequence[RecordJoint | Piece],
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


def structure_data(structure: KinematicTree) -> dict[str, Any]:
    """What the record says of the structure: its matrices, tables and axes."""
    number = {link.name: k for k, link in enumerate(structure.links, 1)}
    generic = tables.has_tables(structure.joints)
    return {
        "connection_matrix": [(number[joint.parent], number[joint.child]) for joint in structure.joints],
        "moveable_joints": [(k, 1) for k, joint in enumerate(structure.joints, 1) if joint.type != "fixed"],
        "tables": tables.record_tables(structure) if generic else [],
        "axes": record_axes(structure) if generic else [],
    }


def record_axes(skeleton: KinematicTree) -> list[RecordAxis]:
    """The driven joints: those that turn, then those that slide."""
    constants = connectors(skeleton, ()).axes
    return [
        RecordAxis(constants[joint.name], joint.name, vector, number)
        for motion, vector in _VECTORS.items()
        for number, joint in enumerate(skeleton.axes(motion), 1)
    ]
