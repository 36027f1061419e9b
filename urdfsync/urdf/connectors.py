"""Names of what a robot has beside its links and joints: connectors and couplings in the model, visuals in the record.

Such a name is made from the name of its element. Where an element has that name already, the connector gives way,
with a number; so a new connector never renames an element, whose name is that of a file.
"""

from __future__ import annotations

import msgspec

from urdfsync.urdf.drives import can_be_driven
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.names import GENERATED, Identifier
from urdfsync.urdf.options import Options


class Connectors(msgspec.Struct, frozen=True):
    """Component names in the robot model, by the URDF name of the link or joint that they belong to."""

    frames: dict[str, str]
    """Of links: the leaves, and those that the options name."""
    axes: dict[str, str]
    """Of joints that can be driven."""
    supports: dict[str, str]
    """Of the same joints: where the housings of their drives are."""
    couplings: dict[str, str]
    """Of joints that follow another one."""


def connector_names(tree: KinematicTree, options: Options) -> Connectors:
    """Return the names for a robot, in canonical order.

    Names in the option `frames` that are no link are left out: `check_options` reports them.
    """
    taken = taken_names(tree)
    if options.frames == "all":  # with the root, although it has frame_a: a link that becomes the root keeps its frame
        framed = {link.name for link in tree.links}
    else:
        framed = {leaf.name for leaf in tree.leaves()}.union(() if options.frames == "leaves" else options.frames)
    driven = [joint.name for joint in tree.joints if can_be_driven(joint)]
    return Connectors(
        {link.name: free_name(tree.link(link.name), "Frame", taken) for link in tree.links if link.name in framed},
        {name: free_name(tree.joint(name), "Axis", taken) for name in driven},
        {name: free_name(tree.joint(name), "Support", taken) for name in driven},
        {joint.name: free_name(tree.joint(joint.name), "Mimic", taken) for joint, _ in tree.followers()},
    )


def taken_names(tree: KinematicTree) -> frozenset[str]:
    """Return the names that are not to be had, in lower case."""
    return GENERATED | {identifier.component.lower() for identifier in tree.names.values()}


def free_name(identifier: Identifier, suffix: str, taken: frozenset[str]) -> str:
    """Return the component's name with a suffix, and with the first free number from 2 if that is taken."""
    name, number = identifier.component + suffix, 2
    while name.lower() in taken:
        name, number = f"{identifier.component}{suffix}_{number}", number + 1
    return name
