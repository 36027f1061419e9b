"""Names of what a robot has beside its links and joints: connectors and couplings in the model, visuals in the record.

Such a name is made from the name of its element. Where an element has that name already, the connector gives way,
with a number; so a new connector never renames an element, whose name is that of a file.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import msgspec

from urdfsync.urdf.drives import can_be_driven
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.names import GENERATED, Identifier


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


def connectors(skeleton: KinematicTree, frames: Iterable[str]) -> Connectors:
    """The names for a robot; `frames` are the links that get a frame of their own."""
    taken = _taken(skeleton)
    driven = [joint.name for joint in skeleton.joints if can_be_driven(joint)]
    return Connectors(
        {name: _free(skeleton.link(name), "Frame", taken) for name in frames},
        {name: _free(skeleton.joint(name), "Axis", taken) for name in driven},
        {name: _free(skeleton.joint(name), "Support", taken) for name in driven},
        {joint.name: _free(skeleton.joint(joint.name), "Mimic", taken) for joint, _ in skeleton.followers()},
    )


def visual_names(skeleton: KinematicTree, visuals: Mapping[str, Iterable[str]]) -> dict[str, tuple[str, ...]]:
    """Components of the whole-robot record for visuals, by link; `visuals` are `visual1`, `visual2`, … of each link."""
    taken = _taken(skeleton)
    return {
        link: tuple([_free(skeleton.link(link), word[0].upper() + word[1:], taken) for word in words])
        for link, words in visuals.items()
    }


def _taken(skeleton: KinematicTree) -> frozenset[str]:
    """Names that are not to be had, in lower case."""
    return GENERATED | {identifier.component.lower() for identifier in skeleton.names.values()}


def _free(identifier: Identifier, suffix: str, taken: frozenset[str]) -> str:
    """The component's name with a suffix, and with the first free number from 2 if that is taken."""
    name, number = identifier.component + suffix, 2
    while name.lower() in taken:
        name, number = f"{identifier.component}{suffix}_{number}", number + 1
    return name
