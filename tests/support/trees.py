"""Random robots for property tests: trees of all joint types, mimic relations without cycles, elements in any order."""

from __future__ import annotations

import math
from collections.abc import Sequence

from hypothesis import strategies as st

from urdfsync.urdf.robot import Joint, JointType, Limit, Link, Mimic, Origin, Robot, Vector

SCALAR: tuple[JointType, ...] = ("continuous", "revolute", "prismatic")
TYPES: tuple[JointType, ...] = (*SCALAR, "fixed", "planar", "floating")

NUMBERS = st.floats(-3, 3)
VECTORS = st.tuples(NUMBERS, NUMBERS, NUMBERS)
ORIGINS = st.builds(Origin, VECTORS, VECTORS)
LIMITS = st.tuples(NUMBERS, NUMBERS).map(sorted).map(lambda ends: Limit(ends[0], ends[1]))
MULTIPLIERS = st.sampled_from([-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 3.0])
NAMES = st.from_regex(r"[a-cA-C_]{1,2}[0-9]{0,2}", fullmatch=True)


def unit(vector: Vector) -> Vector:
    """The unit vector along a vector; z if it is about zero."""
    length = math.hypot(*vector)
    return (0.0, 0.0, 1.0) if length < 1e-3 else (vector[0] / length, vector[1] / length, vector[2] / length)


AXES = VECTORS.map(unit)


@st.composite
def robots(draw: st.DrawFn, types: Sequence[JointType] = TYPES, size: int = 7, mimics: bool = True) -> Robot:
    """A robot of up to `size` links."""
    count = draw(st.integers(1, size))
    links = [Link(name) for name in draw(st.lists(NAMES, min_size=count, max_size=count, unique=True))]
    names = draw(st.lists(NAMES, min_size=count - 1, max_size=count - 1, unique=True))
    joints: list[Joint] = []
    for number, name in enumerate(names, start=1):
        parent = links[draw(st.integers(0, number - 1))].name
        kind = draw(st.sampled_from(types))
        limit = draw(LIMITS) if kind in ("revolute", "prismatic") else None
        mimic = draw(_mimics(joints)) if mimics and kind in SCALAR else None
        origin, axis = draw(ORIGINS), draw(AXES)
        joints.append(Joint(name, kind, parent, links[number].name, origin, axis, limit, mimic=mimic))
    return Robot("random", tuple(draw(st.permutations(links))), tuple(draw(st.permutations(joints))))


def _mimics(joints: Sequence[Joint]) -> st.SearchStrategy[Mimic | None]:
    """Nothing, or following one of the joints that can be followed."""
    leaders = [joint.name for joint in joints if joint.type in (*SCALAR, "fixed")]
    return st.none() | st.builds(Mimic, st.sampled_from(leaders), MULTIPLIERS, NUMBERS) if leaders else st.none()
