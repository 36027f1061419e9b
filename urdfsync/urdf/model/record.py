"""Template data of the record of a whole robot, `<Robot>Parameters.mo`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from urdfsync.domain import Import
from urdfsync.urdf.connectors import Connectors, free_name, taken_names
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.joint import joint_record
from urdfsync.urdf.model.shapes import link_shapes, standing_height
from urdfsync.urdf.model.tables import obstacles, tables
from urdfsync.urdf.options import USES, Options
from urdfsync.urdf.robot import MOTION_KINDS, MOTIONS, Joint, limits_acceleration, reflected_inertia


def record_data(
    name: str,
    tree: KinematicTree,
    names: Connectors,
    imports: Mapping[str, Import],
    package: str,
    options: Options,
) -> dict[str, Any]:
    """Return the data of the record of a whole robot; `name` is the robot's in the URDF.

    All is counted from 1. A record outside of a package names the libraries that it uses.
    """
    is_generic, taken = not obstacles(tree.joints), taken_names(tree)
    links, joints, drawn = [], [], []
    for number, link in enumerate(tree.links, 1):
        identifier, (visuals, _) = tree.link(link.name), link_shapes(link, imports, package, options)
        shapes = [
            shape | {"component": free_name(identifier, shape["component"].capitalize(), taken)} for shape in visuals
        ]
        data = {"number": number, "component": identifier.component, "name": link.name}
        links.append({**data, "inertial": link.inertial, "visuals": shapes})
        for shape in shapes:
            # Modelica has no shape of a capsule: it is drawn as a cylinder and two spheres
            kinds = ("Capsule", "LowerEnd", "UpperEnd") if shape["type"] == "Capsule" else (shape["type"],)
            length_axis = 1 if shape["type"] in ("Box", "Mesh") else 3  # of the shape frame: 1 is x, 3 is z
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

    axes = [  # driven joints, those that turn first, with the constant that has the number of their flanges
        {"constant": names.drives[joint.name].axis, "name": joint.name, "vector": f"{motion}Axis", "number": number}
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
        "name": name,
        "standing_height": standing_height(tree, imports) if options.base == "floating" else None,
        "structure": structure,
        "links": links,
        "joints": joints,
    }
