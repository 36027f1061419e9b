"""Counts the numbers in a whole robot's record again, from its elements in the order of the record.

These numbers say how links and joints hang together. Other tables of the record refer to the numbers of elements.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence

from urdfsync.urdf.second.plain import SHAPES
from urdfsync.urdf.second.reading import MOVES, TURNS, SecondElement

DRAWN = {shape.capitalize(): 1 for shape in SHAPES} | {"Capsule": 3}
"""Records of shapes, and how many shapes of the Modelica Standard Library draw each."""


def expected_tables(
    elements: Sequence[tuple[SecondElement, str]], shapes: Iterable[tuple[str, int]]
) -> Mapping[str, Sequence[int]]:
    """Return the numbers of each table; `elements` have their components.

    `shapes` has the type and the link's number of each drawn shape.
    """
    links = [(element, c) for element, c in elements if not element.child]
    joints = [(element, c) for element, c in elements if element.child]
    moving = [(joint, c) for joint, c in joints if joint.type in MOVES]
    numbers = {joint.name: number for number, (joint, _) in enumerate(moving, 1)}
    counted = {link.name: number for number, (link, _) in enumerate(links, 1)}
    bodies, none = {link.name: 1 for link, _ in links[:1]}, len(moving) + 1
    for joint, _ in joints:
        bodies[joint.child] = numbers[joint.name] + 1 if joint.name in numbers else bodies.get(joint.parent, 0)
    carried = [[numbers[j.name] for j, _ in moving if bodies.get(j.parent) == body] for body in range(1, none + 1)]
    following = {number: after for on in carried for number, after in itertools.pairwise(on)}
    leaders = [pair for pair in joints if not pair[0].leader]
    for leader, _ in leaders:  # the list grows in this loop
        leaders += [pair for pair in joints if pair[0].leader == leader.name]
    drawn = [link for type_, link in shapes for _ in range(DRAWN[type_])]
    tables: dict[str, list[int]] = {
        "connectionMatrix": [n for j, _ in joints for n in (counted.get(j.parent, 0), counted.get(j.child, 0))],
        "moveableJoints": [n for k, (j, _) in enumerate(joints, 1) if j.type != "fixed" for n in (k, 1)],
        "movingJoints": [len(moving)],
        "jointTree": [n for j, _ in moving for n in (bodies.get(j.parent, 0), 1 if j.type in TURNS else 2)],
        "firstJoints": [on[0] if on else none for on in carried],
        "nextJoints": [following.get(number, none) for number in numbers.values()],
        "linkBodies": [bodies.get(link.name, 0) for link, _ in links],
        "followers": [n for j, _ in leaders if j.leader for n in (numbers[j.name], numbers.get(j.leader, 0))],
        "drawnShapes": [len(drawn)],
        "visuals.links": drawn,
    }
    for kind, axes, is_turning in (("turning", "rotational", True), ("sliding", "translational", False)):
        own = [(j, c) for j, c in moving if (j.type in TURNS) == is_turning]
        free = [(j, c) for j, c in own if not j.leader]
        tables |= {f"{kind}Joints": [len(own)], kind: [numbers[j.name] for j, _ in own]}
        tables |= {f"{axes}Axes": [len(free)], f"{axes}Joints": [numbers[j.name] for j, _ in free]}
        tables |= {f"{c}Axis": [k] for k, (_, c) in enumerate(free, 1)}
    return tables
