"""Template data of the record of a whole robot, and of the bench in which the generic robot reads it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.domain import Import, Piece, Recipe, Target
from urdfsync.urdf.kinematics import compose, link_poses, lowest_point, pose, start_positions
from urdfsync.urdf.model import notes, tables
from urdfsync.urdf.model.connectors import connectors
from urdfsync.urdf.model.numbers import JointNumbers, joint_numbers
from urdfsync.urdf.model.shapes import hull
from urdfsync.urdf.options import USES, Options
from urdfsync.urdf.robot import Inertial, Joint
from urdfsync.urdf.skeleton import Motion, Skeleton

_WORDS: Mapping[Motion, Mapping[str, Any]] = {
    "rotational": {
        "domain": "Rotational",
        "axis": "rotationalAxis",
        "support": "rotationalSupport",
        "range": "rotationalRange",
        "drive": "rotationalDrive",
        "sweep": "rotationalSweep",
        "position": "Angle",
        "velocity": "AngularVelocity",
        "q": "phi",
        "v": "w",
        "effort": "tau",
        "unit": "rad",
        "effort_unit": "N.m",
        "reach": "1",
        "color": "0, 0, 0",
        "icon_x": -60,
        "drive_y": 30,
    },
    "translational": {
        "domain": "Translational",
        "axis": "translationalAxis",
        "support": "translationalSupport",
        "range": "translationalRange",
        "drive": "translationalDrive",
        "sweep": "translationalSweep",
        "position": "Position",
        "velocity": "Velocity",
        "q": "s",
        "v": "v",
        "effort": "f",
        "unit": "m",
        "effort_unit": "N",
        "reach": "0.1",
        "color": "0, 127, 0",
        "icon_x": 30,
        "drive_y": 70,
    },
}


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


class Axis(msgspec.Struct, frozen=True):
    """An axis that can be driven, with the number that it has in the flange vectors of its kind."""

    constant: str
    """What the record calls that number."""
    name: str
    number: int


def generic_data(skeleton: Skeleton, target: Target, options: Options) -> dict[str, Any]:
    """Data of the bench in which the generic robot reads the record: structure only."""
    return _model_data(skeleton, target, options) | {"note": notes.generic_note(target.name, options.base)}


def _model_data(structure: Skeleton, target: Target, options: Options) -> dict[str, Any]:
    """What all models of the whole robot need."""
    return {
        "within": target.package,
        "type": target.name,
        "record": f"{target.name}Parameters",
        "title": f"robot {target.name}",
        "base": options.base,
        "vectors": vectors(structure),
    }


def record_data(
    structure: Recipe | Piece,
    links: Sequence[RecordLink | Piece],
    joints: Sequence[RecordJoint | Piece],
    ground: tuple[Skeleton, Mapping[str, Import]] | None,
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


def structure_data(structure: Skeleton) -> dict[str, Any]:
    """What the record says of the structure: its matrices, tables and axes."""
    number = {link.name: k for k, link in enumerate(structure.links, 1)}
    generic = tables.has_tables(structure.joints)
    return {
        "connection_matrix": [(number[joint.parent], number[joint.child]) for joint in structure.joints],
        "moveable_joints": [(k, 1) for k, joint in enumerate(structure.joints, 1) if joint.type != "fixed"],
        "tables": tables.record_tables(structure) if generic else [],
        "vectors": vectors(structure) if generic else [],
    }


def standing_height(skeleton: Skeleton, imports: Mapping[str, Import]) -> float | None:
    """Height of the root frame when the lowest collision shape just touches the ground; None without any shape."""
    poses = link_poses(skeleton, start_positions(skeleton))
    heights = [
        lowest_point(shape.geometry, compose(poses[link.name], pose(shape.origin)), hull(shape.geometry, imports))
        for link in skeleton.links
        for shape in link.collisions
    ]
    lowest = min((height for height in heights if height is not None and math.isfinite(height)), default=None)
    return None if lowest is None else round(-lowest, 12)


def vectors(skeleton: Skeleton) -> list[dict[str, Any]]:
    """One entry per kind of motion that the robot can be driven in: its words, and its axes in order."""
    constants = connectors(skeleton, ()).axes
    result = []
    for motion, words in _WORDS.items():
        axes = [
            Axis(constants[joint.name], joint.name, number) for number, joint in enumerate(skeleton.axes(motion), 1)
        ]
        if axes:
            result.append({**words, "axes": axes, **_bench_lines(words["icon_x"], words["drive_y"])})
    return result


def _bench_lines(icon_x: int, y: int) -> dict[str, Any]:
    """Lines of the bench's diagram: the robot's icon is 40 wide around x = 40, its upper border at y = -20."""
    axis, support = 40 + icon_x // 5, 40 + (icon_x + 30) // 5
    return {
        "drive_x": -20,
        "flange_line": f"{{0, {y}}}, {{{axis}, {y}}}, {{{axis}, -20}}",
        "support_line": f"{{-10, {y - 10}}}, {{-10, {y - 20}}}, {{{support}, {y - 20}}}, {{{support}, -20}}",
        "input_line": f"{{-120, {y}}}, {{-22, {y}}}",
        "sweep_line": f"{{-39, {y}}}, {{-22, {y}}}",
    }
