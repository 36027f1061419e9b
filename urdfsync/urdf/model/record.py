"""Template data of the record approach: `<Robot>Parameters.mo` and its bench, `<Robot>Generic.mo`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from urdfsync.domain import Import, Target
from urdfsync.urdf.connectors import connector_names, visual_names
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.shapes import link_shapes, standing_height
from urdfsync.urdf.model.tables import has_tables, tables
from urdfsync.urdf.options import USES, Options
from urdfsync.urdf.robot import MOTION_KINDS, Joint, Limit, Motion

NO_LIMITS: Mapping[str, None] = dict.fromkeys(Limit.__struct_fields__)
"""Limits of a joint that has none, for the template of its record."""
_VECTORS: Mapping[Motion, str] = {"rotational": "rotationalAxis", "translational": "translationalAxis"}


def generic_data(tree: KinematicTree, target: Target, options: Options) -> dict[str, Any]:
    """Return the data of the bench in which the generic robot reads the record: structure only."""
    return {
        "within": target.package,
        "type": target.name,
        "record": f"{target.name}Parameters",
        "title": f"robot {target.name}",
        "base": options.base,
        "rotational_axes": len(tree.axes("rotational")),
        "translational_axes": len(tree.axes("translational")),
    }


def record_data(
    name: str, tree: KinematicTree, imports: Mapping[str, Import], target: Target, options: Options
) -> dict[str, Any]:
    """Return the data of the record of a whole robot; `name` is the robot's in the URDF.

    All is counted from 1. Without a package around it, the record itself names the libraries that it uses.
    """
    is_generic = has_tables(tree.joints)
    visuals = {link.name: link_shapes(link, imports, target.package, options)[0] for link in tree.links}
    named = visual_names(tree, {link: [shape["component"] for shape in shapes] for link, shapes in visuals.items()})
    links, joints, drawn = [], [], []
    for number, link in enumerate(tree.links, 1):
        shapes = [
            shape | {"component": component}
            for shape, component in zip(visuals[link.name], named[link.name], strict=True)
        ]
        component = tree.link(link.name).component
        links.append(
            {"number": number, "component": component, "name": link.name, "inertial": link.inertial, "visuals": shapes}
        )
        for shape in shapes:
            kinds = ("Capsule", "LowerEnd", "UpperEnd") if shape["type"] == "Capsule" else (shape["type"],)
            length_axis = 1 if shape["type"] in ("Box", "Mesh") else 3  # of the shape frame: 1 is x, 3 is z
            drawn += [
                {"link": number, "visual": shape["component"], "type": kind, "length_axis": length_axis}
                for kind in kinds
            ]
    for number, joint in enumerate(tree.joints, 1):
        limits = joint.limit or NO_LIMITS
        component = tree.joint(joint.name).component
        joints.append({"number": number, "component": component, "joint": joint, "limits": limits})
    numbers = {link.name: number for number, link in enumerate(tree.links, 1)}
    moving = [joint for joint in tree.joints if joint.type in MOTION_KINDS]

    def referred(found: list[Joint]) -> list[dict[str, str]]:
        return [{"component": tree.joint(joint.name).component, "type": joint.type} for joint in found]

    structure = {
        "connection_matrix": [(numbers[joint.parent], numbers[joint.child]) for joint in tree.joints],
        "moveable_joints": [(number, 1) for number, joint in enumerate(tree.joints, 1) if joint.type != "fixed"],
        "tables": tables(tree) if is_generic else None,
        "links": [tree.link(link.name).component for link in tree.links],
        "joints": referred([*tree.joints]),
        "moving": referred(moving),
        "turning": referred([joint for joint in moving if MOTION_KINDS[joint.type] == "rotational"]),
        "sliding": referred([joint for joint in moving if MOTION_KINDS[joint.type] == "translational"]),
        "followers": referred([j for j in tree.leaders_first() if j.type in MOTION_KINDS and j.mimic is not None]),
        "shapes": drawn,
        "axes": _axes(tree) if is_generic else [],
    }
    is_mobile = options.base == "floating"
    return {
        "within": target.package,
        "type": target.name,
        "record": f"{target.name}Parameters",
        "title": f"robot {target.name}",
        "is_generic": is_generic,
        "uses": () if target.package else USES,
        "name": name,
        "standing_height": standing_height(tree, imports) if is_mobile else None,
        "structure": structure,
        "links": links,
        "joints": joints,
    }


def _axes(tree: KinematicTree) -> list[dict[str, Any]]:
    """Return the driven joints, those that turn first: with the constant that has the number of its flanges."""
    constants = connector_names(tree, Options()).axes
    return [
        {"constant": constants[joint.name], "name": joint.name, "vector": vector, "number": number}
        for motion, vector in _VECTORS.items()
        for number, joint in enumerate(tree.axes(motion), 1)
    ]
