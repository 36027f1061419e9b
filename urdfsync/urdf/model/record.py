"""Template data of the record of a whole robot, `<Robot>Parameters.mo`, and the integer tables of its structure.

Links that fixed joints connect move as one *body*. Body 1 has the root link. A *moving joint* is revolute, continuous
or prismatic; moving joint `i` moves body `i + 1`. Moving joints are counted in canonical order, so the body that
carries a joint has a smaller number than the moved body. The tables assign links to bodies. Modelica adds up the masses
of a body's links, so no number is written twice. All counts start at 1. The template writes the tables that refer to
data of links and joints.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import msgspec

from urdfsync.domain import Import
from urdfsync.urdf.assembly import Assembly
from urdfsync.urdf.connectors import free_name, taken_names
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.joint import joint_record
from urdfsync.urdf.model.shapes import link_shapes, standing_height
from urdfsync.urdf.options import USES
from urdfsync.urdf.robot import MOTION_KINDS, MOTIONS, Joint, Motion, limits_acceleration, reflected_inertia

_TURNS: Mapping[Motion, int] = {"rotational": 1, "translational": 2}


def record_data(assembly: Assembly, imports: Mapping[str, Import]) -> dict[str, Any]:
    """Return the data of the record of a whole robot.

    A record outside of a package states the used libraries.
    """
    tree, options, package = assembly.tree, assembly.options, assembly.target.package
    is_generic, taken = not obstacles(tree.joints), taken_names(tree)
    links, joints, drawn, drives = [], [], [], assembly.connectors.drives
    for number, link in enumerate(tree.links, 1):
        identifier, (visuals, _) = tree.link(link.name), link_shapes(link, imports, package, options)
        shapes = [
            shape | {"component": free_name(identifier, shape["component"].capitalize(), taken)} for shape in visuals
        ]
        data = {"number": number, "component": identifier.component, "name": link.name}
        links.append({**data, "inertial": link.inertial, "visuals": shapes})
        for shape in shapes:
            # Modelica has no capsule shape: a capsule is drawn as a cylinder and two spheres
            kinds = ("Capsule", "LowerEnd", "UpperEnd") if shape["type"] == "Capsule" else (shape["type"],)
            length_axis = 1 if shape["type"] in ("Box", "Mesh") else 3  # in the shape frame: 1 is x, 3 is z
            drawn += [
                {"link": number, "visual": shape["component"], "type": kind, "length_axis": length_axis}
                for kind in kinds
            ]
    for number, joint in enumerate(tree.joints, 1):
        data = {"number": number, "component": tree.joint(joint.name).component}
        joints.append(data | joint_record(joint))
    numbers = {link.name: number for number, link in enumerate(tree.links, 1)}
    moving = [joint for joint in tree.joints if joint.type in MOTION_KINDS]

    def referred(referred_joints: list[Joint]) -> list[dict[str, Any]]:
        return [
            {
                "component": tree.joint(joint.name).component,
                "type": joint.type,
                "has_inertia": reflected_inertia(joint) is not None,
            }
            for joint in referred_joints
        ]

    axes = [  # drivable joints, turning joints first; the record has a constant with the number of each flange
        {"constant": drives[joint.name].axis, "name": joint.name, "vector": f"{motion}Axis", "number": number}
        for motion in MOTIONS
        for number, joint in enumerate(tree.axes(motion), 1)
    ]
    structure = {
        "connection_matrix": [(numbers[joint.parent], numbers[joint.child]) for joint in tree.joints],
        "moveable_joints": [(number, 1) for number, joint in enumerate(tree.joints, 1) if joint.type != "fixed"],
        "tables": tables(tree) if is_generic else None,
        "links": [tree.link(link.name).component for link in tree.links],
        "joints": referred([*tree.joints]),
        "moving": referred(moving),
        "turning": referred([joint for joint in moving if MOTION_KINDS[joint.type] == "rotational"]),
        "sliding": referred([joint for joint in moving if MOTION_KINDS[joint.type] == "translational"]),
        "followers": referred([joint for joint in tree.leaders_first() if joint.mimic is not None]),
        "accelerations": any(map(limits_acceleration, tree.joints)),
        "shapes": drawn,
        "axes": axes if is_generic else [],
    }
    return {
        "is_generic": is_generic,
        "uses": () if package else USES,
        "name": assembly.robot.name,
        "standing_height": standing_height(tree, imports) if options.base == "floating" else None,
        "structure": structure,
        "links": links,
        "joints": joints,
    }


class Tables(msgspec.Struct, frozen=True):
    """The integer tables, as `UrdfSync.Records.Robot` describes them."""

    link_bodies: list[int]
    """The body of each link."""
    joint_tree: list[tuple[int, int]]
    """For each moving joint: the body that carries the joint; 1 for a turning joint, 2 for a sliding joint."""
    first_joints: list[int]
    """For each body: the first joint on the body; without a joint, the number of joints + 1."""
    next_joints: list[int]
    """For each moving joint: the next joint on the same body; without a next joint, the number of joints + 1."""
    moving: Mapping[Motion, list[int]]
    """The moving joints of each kind."""
    axes: Mapping[Motion, list[int]]
    """For each kind, the moving joint of each driven axis."""
    followers: list[tuple[int, int]]
    """The numbers of each follower and its leader, leaders first; 0 stands for a fixed leader."""


def obstacles(joints: Iterable[Joint]) -> list[Joint]:
    """Return the planar, floating and ball joints: a record with such joints has no tables."""
    return [joint for joint in joints if joint.type not in MOTION_KINDS and joint.type != "fixed"]


def tables(tree: KinematicTree) -> Tables:
    """Return the integer tables of a robot without `obstacles`."""
    moving = [joint for joint in tree.joints if joint.type in MOTION_KINDS]
    numbers = {joint.name: number for number, joint in enumerate(moving, 1)}
    bodies = {tree.links[0].name: 1}
    for joint in tree.joints:
        bodies[joint.child] = numbers[joint.name] + 1 if joint.name in numbers else bodies[joint.parent]
    none = len(moving) + 1
    first, following = [none] * none, [none] * len(moving)
    for joint in reversed(moving):
        number, body = numbers[joint.name], bodies[joint.parent]
        following[number - 1], first[body - 1] = first[body - 1], number
    return Tables(
        link_bodies=[bodies[link.name] for link in tree.links],
        joint_tree=[(bodies[joint.parent], _TURNS[MOTION_KINDS[joint.type]]) for joint in moving],
        first_joints=first,
        next_joints=following,
        moving={kind: [numbers[j.name] for j in moving if MOTION_KINDS[j.type] == kind] for kind in _TURNS},
        axes={kind: [numbers[joint.name] for joint in tree.axes(kind)] for kind in _TURNS},
        followers=[
            (numbers[joint.name], numbers.get(joint.mimic.joint, 0))
            for joint in tree.leaders_first()
            if joint.mimic is not None
        ],
    )
