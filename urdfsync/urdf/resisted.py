"""Whether anything resists the motion of each joint, seen from bounds: what `resistance` adds up need not be."""

from __future__ import annotations

import math
from collections.abc import Iterable

import msgspec

from urdfsync.urdf.kinematics import own_range
from urdfsync.urdf.validate import principal_moments
from urdfsync.urdf.robot import Joint, Link
from urdfsync.urdf.skeleton import MOTIONS, Skeleton

_CLEAR = 1e-8
"""What is above that much of all terms is far from rounding, for each way in which `resistance` adds them up."""


class _Masses(msgspec.Struct):
    """By link: mass (kg) and least principal moment of inertia (kg.m2), and the sums of masses and of all moments."""

    mass: dict[str, float] = {}
    least: dict[str, float] = {}
    total: float = 0.0
    spread: float = 0.0


def clearly_resisted(skeleton: Skeleton) -> bool:
    """Whether no joint with an axis has a resistance of 0, nor yields; if not, it takes a closer look.

    About any axis, a body has at least its least principal moment of inertia, and what else moves with it or gives
    way behind it only adds to that. So one body fixed to the child of each joint tells, if it is heavy enough.
    """
    found = _masses(skeleton.links)
    if min(found.least.values()) < 0 or _starts_shifted(skeleton.joints):
        return False
    resisting = {
        "translational": (found.mass, _CLEAR * found.total),
        "rotational": (found.least, _CLEAR * (found.spread + found.total * _reach(skeleton) ** 2)),
    }
    for joint in reversed(skeleton.joints):
        if joint.type in MOTIONS:
            values, enough = resisting[MOTIONS[joint.type]]
            if not values[joint.child] > enough:
                return False
        else:
            for values, _ in resisting.values():
                values[joint.parent] = max(values[joint.parent], values[joint.child])
    return True


def _masses(links: Iterable[Link]) -> _Masses:
    found = _Masses()
    for link in links:
        found.mass[link.name] = found.least[link.name] = 0.0
        if link.inertial is not None:
            inertia = link.inertial.inertia
            found.mass[link.name], found.least[link.name] = link.inertial.mass, principal_moments(inertia)[0]
            found.total += link.inertial.mass
            found.spread += inertia.ixx + inertia.iyy + inertia.izz
    return found


def _reach(skeleton: Skeleton) -> float:
    """How far (m) a joint or a centre of mass can be from the root, at most."""
    far = {skeleton.links[0].name: 0.0}
    for joint in skeleton.joints:
        far[joint.child] = far[joint.parent] + math.hypot(*joint.origin.xyz)
    inertials = ((link.name, link.inertial) for link in skeleton.links)
    centres = [far[name] + math.hypot(*inertial.origin.xyz) for name, inertial in inertials if inertial is not None]
    return max(*far.values(), *centres, 0.0)


def _starts_shifted(joints: Iterable[Joint]) -> bool:
    """Whether a joint may be shifted at the start; where joints follow each other, ranges are not looked into."""
    ranges = [own_range(joint) for joint in joints if MOTIONS.get(joint.type) == "translational"]
    led = bool(ranges) and any(joint.mimic is not None for joint in joints)
    return led or any(lower > 0 or upper < 0 for lower, upper in ranges)
