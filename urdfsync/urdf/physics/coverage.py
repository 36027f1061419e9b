"""What the comparison does not cover, as far as it matters for a robot."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from urdfsync.urdf.kinematics.tree import MOTION_KINDS, KinematicTree
from urdfsync.urdf.options import Options

_BENCHES = {
    ("package",): "Run and Test (they are only compiled)",
    ("record",): "the bench around the generic robot (it is only compiled)",
    ("package", "record"): "Run, Test and the generic robot with the record (they are only compiled)",
}
"""Per approach, what is around that which is compared."""


def unchecked(skeleton: KinematicTree, options: Options) -> Iterator[str]:
    """One sentence each, without a full stop."""
    joints, links = skeleton.joints, skeleton.links
    if all(joint.type == "fixed" for joint in joints):
        yield "no joint moves, so that only poses, masses and the forces on the root link are compared"
    if not any(link.inertial and link.inertial.mass > 0 for link in links):
        yield "no link has a mass, so that efforts show the losses of joints only"
    approach = tuple(sorted(set(options.approach)))
    yield f"{_listed([*_idle(skeleton, options), _BENCHES[approach]])} are not compared"


def _idle(skeleton: KinematicTree, options: Options) -> Iterator[str]:
    """What the robot has and the motion does not show, and why."""
    joints, links = skeleton.joints, skeleton.links
    idle = {
        "limits": any(joint.limit for joint in joints if joint.type in MOTION_KINDS),
        "calibrations": any(joint.calibration for joint in joints),
        "safety controllers": any(joint.safety_controller for joint in joints),
        "shapes": any(link.visuals or link.collisions for link in links),
    }
    if there := [noun for noun, is_there in idle.items() if is_there]:
        yield f"{_listed(there)} (they change no motion)"
    touches = options.base == "floating" and options.collisions and "package" in options.approach
    if touches and any(link.collisions for link in links):
        yield "contacts with the ground (the robot moves high above it)"


def _listed(parts: Sequence[str]) -> str:
    """`a`, `a and b`, `a, b and c`."""
    *most, last = parts
    return f"{', '.join(most)}{' and ' if most else ''}{last}"
