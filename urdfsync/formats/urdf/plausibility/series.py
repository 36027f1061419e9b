"""Finds the odd one out of a row of equal parts: one of four wheels, of four fingers, of six legs.

Parts are a row if only numbers and places tell their names apart, and if they are congruent: the same joints stand at
the same distances behind them, about the same axes. Then equal masses and drives are expected.
"""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence, Set
from typing import NamedTuple, TypeAlias

from urdfsync.formats.urdf.kinematics.poses import own_range
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.plausibility.shapes import LIGHT, LinkShape
from urdfsync.formats.urdf.plausibility.symmetry import JOINT_NUMBERS, SIDES, WORD
from urdfsync.formats.urdf.robot import MOTION_KINDS, Joint, Vector
from urdfsync.formats.urdf.validate import Finding

_PLACES = {*SIDES, *"front rear back mid middle center centre index ring little pinky ff mf".split()}
_FEWEST = 4
_ALIKE = 0.02
"""The other parts of a row differ by this part of a number at most."""
_OUT = 2
"""The odd one differs by this factor."""
_DIGITS = 3
"""Distances in a row are equal to a millimetre, directions to a thousandth."""

_Form: TypeAlias = tuple[object, ...]
"""Type and axis of a joint, with places and forms of the joints behind it; equal forms get one number."""


class _Number(NamedTuple):
    """A number that a row has in common."""

    element: str
    block: str
    name: str
    unit: str
    values: Sequence[float]


def find_odd_ones(tree: KinematicTree, bodies: Mapping[str, LinkShape], faulty: Set[str]) -> Iterator[Finding]:
    """Yield a finding for each number of a link or joint that differs from all others of its row.

    Elements in `faulty`, such as `link wheel_1`, have another finding, and show no usual number.
    """
    stems = {joint.child: _stem(joint.child) for joint in tree.joints}
    common = {stem for stem, count in Counter(stems.values()).items() if count >= _FEWEST}
    if not common:
        return
    forms, numbers, children = dict[str, int](), dict[_Form, int](), tree.children()
    for joint in reversed(tree.joints):
        behind = [(_distances(after.origin.xyz), forms[after.name]) for after in children.get(joint.child, ())]
        # a driven wheel among passive ones is another part
        form = joint.type, joint.actuated, joint.limit is None, _distances(joint.axis), *sorted(behind)
        forms[joint.name] = numbers.setdefault(form, len(numbers))
    rows, keys = defaultdict[_Form, list[Joint]](list), {tree.links[0].name: 0}
    for joint in tree.joints:
        # parts of a row have their own places on a common link, and the same place on links of a row
        is_branch = len(children[joint.parent]) > 1
        place = () if is_branch else _distances(joint.origin.xyz)
        row = keys[joint.parent], place, stems[joint.child], forms[joint.name]
        keys[joint.child] = numbers.setdefault(row, len(numbers))
        if joint.type in MOTION_KINDS and stems[joint.child] in common:
            rows[row].append(joint)
    for row_joints in rows.values():
        joints = [each for each in row_joints if faulty.isdisjoint((f"link {each.child}", f"joint {each.name}"))]
        if len(joints) >= _FEWEST:
            for number in _numbers(joints, [bodies[joint.child] for joint in joints]):
                if finding := _odd_one(number, joints):
                    yield finding


def _distances(vector: Vector) -> tuple[float, ...]:
    """Return the distances of a point from the coordinate planes: mirrored parts have the same."""
    return tuple(round(abs(value), _DIGITS) for value in vector)


def _stem(name: str) -> str:
    """Return a name without numbers and places."""
    return " ".join(word for word in WORD.findall(name) if word.lower() not in _PLACES)


def _numbers(row: Sequence[Joint], bodies: Sequence[LinkShape]) -> Iterator[_Number]:
    masses = [body.mass for body in bodies]
    if max(masses) > LIGHT:
        yield _Number("link", "inertial", "mass", "kg", masses)
        radii = [body.gyration for body in bodies]
        yield _Number("link", "inertial", "radius of gyration", "m", radii)
    for block, name in JOINT_NUMBERS:
        values = [getattr(getattr(joint, block), name, None) for joint in row]
        yield _Number("joint", block, name, "", [value for value in values if value is not None])
    ranges = [own_range(joint) for joint in row]
    yield _Number("joint", "limit", "range", "", [upper - lower for lower, upper in ranges])


def _odd_one(number: _Number, row: Sequence[Joint]) -> Finding | None:
    """Return the finding about the one value that is out of its row; a value of 0 is another finding."""
    values = number.values
    if len(values) < len(row) or not all(0 < value < math.inf for value in values):
        return None
    usual = sorted(values)[len(values) // 2]
    odd = [k for k, value in enumerate(values) if abs(value - usual) > _ALIKE * usual]
    if len(odd) != 1 or usual / _OUT < values[odd[0]] < usual * _OUT:
        return None
    name, *others = (joint.child if number.element == "link" else joint.name for joint in (row[odd[0]], *row))
    listed = ", ".join(repr(other) for other in sorted(others) if other != name)
    message = f"{number.element} {name!r} differs from {listed}: "
    message += f"its {number.name} is {values[odd[0]]:.4g}, not {usual:.4g} {number.unit}".rstrip()
    return Finding("odd-one-out", f"{number.element} {name} / {number.block}", message)
