"""Computes the tables of a whole robot's record again, from its elements in the order of the record."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

from urdfsync.urdf.second.reading import MOVES, TURNS, Element

_REFERENCES = (
    "moving jointAxes axis, joints jointPositions origin.xyz, joints jointAngles origin.rpy, links linkMasses "
    "inertial.mass, links linkCenters inertial.origin.xyz, links inertialAngles inertial.origin.rpy, moving "
    "jointNames.name name, followers followerMultipliers mimic.multiplier"
)
_INERTIA = "{0}.dynamics.armature+{0}.transmission.rotorInertia*{0}.transmission.reduction^2"
_BALL = ["2*{0}.radius"] * 3
_FORMS: dict[str, list[tuple[str, int, str, list[str]]]] = {
    "Box": [('"box"', 1, "-0.5*{0}.size[1]", ["{0}.size[1]", "{0}.size[2]", "{0}.size[3]"])],
    "Cylinder": [('"cylinder"', 3, "-0.5*{0}.length", ["{0}.length", "2*{0}.radius", "2*{0}.radius"])],
    "Sphere": [('"sphere"', 3, "-{0}.radius", _BALL)],
    "Mesh": [("{0}.uri", 1, "0", ["1", "1", "1"])],
}
"""The parts of each drawn shape: kind, axis of the length, start, sizes."""
_FORMS["Capsule"] = [
    *_FORMS["Cylinder"],
    *(('"sphere"', 3, f"{sign}0.5*{{0}}.length-{{0}}.radius", _BALL) for sign in ("-", "")),
]


def expected_tables(
    elements: Sequence[tuple[Element, str]], shapes: Mapping[str, tuple[str, int]]
) -> Mapping[str, list[str]]:
    """Return the items of each table as texts without blanks; `elements` have their components.

    `shapes` has the type and the link's number of each drawn shape, by component.
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
    kinds: dict[str, list[tuple[Element, str]]] = {
        "links": links,
        "joints": joints,
        "moving": moving,
        "turning": [pair for pair in moving if pair[0].type in TURNS],
        "sliding": [pair for pair in moving if pair[0].type not in TURNS],
        "followers": [pair for pair in leaders if pair[0].leader],
    }
    rows = [(c, link, form) for c, (type_, link) in shapes.items() for form in _FORMS.get(type_, ())]
    tables: dict[str, Any] = {
        "connectionMatrix": [
            number for j, _ in joints for number in (counted.get(j.parent, 0), counted.get(j.child, 0))
        ],
        "moveableJoints": [n for k, (j, _) in enumerate(joints, 1) if j.type != "fixed" for n in (k, 1)],
        "movingJoints": [len(moving)],
        "jointTree": [n for j, _ in moving for n in (bodies.get(j.parent), 1 if j.type in TURNS else 2)],
        "firstJoints": [on[0] if on else none for on in carried],
        "nextJoints": [following.get(number, none) for number in numbers.values()],
        "linkBodies": [bodies.get(link.name) for link, _ in links],
        "followers": [n for j, _ in kinds["followers"] for n in (numbers[j.name], numbers.get(j.leader, 0))],
        "linkInertias": [f"{c}.inertial.inertia.i{part}" for _, c in links for part in "xx yy zz xy xz yz".split()],
        "drawnShapes": [len(rows)],
        "visuals.links": [link for _, link, _ in rows],
        "visuals.kinds": [form[0].format(c) for c, _, form in rows],
        "visuals.starts": [form[2].format(c) for c, _, form in rows],
        "visuals.lengthAxes": [form[1] for *_, form in rows],
        "visuals.sizes": [size.format(c) for c, _, form in rows for size in form[3]],
        "visuals.positions": [f"{c}.origin.xyz" for c, *_ in rows],
        "visuals.angles": [f"{c}.origin.rpy" for c, *_ in rows],
        "visuals.colors": [f"{c}.color" for c, *_ in rows],
    }
    for kind, table, path in (words.split() for words in _REFERENCES.split(", ")):
        tables[table] = [f"{c}.{path}" for _, c in kinds[kind]]
    for table, kind in (("followerAngles", "turning"), ("followerLengths", "sliding")):
        tables[table] = [f"{c}.mimic.offset" if (j, c) in kinds[kind] else 0 for j, c in kinds["followers"]]
    for kind, axes, inertias in (
        ("turning", "rotational", "turningInertias"),
        ("sliding", "translational", "slidingMasses"),
    ):
        own, free = kinds[kind], [(j, c) for j, c in kinds[kind] if not j.leader]
        tables |= {f"{kind}Joints": [len(own)], kind: [numbers[j.name] for j, _ in own]}
        tables |= {f"{axes}Axes": [len(free)], f"{axes}Joints": [numbers[j.name] for j, _ in free]}
        tables |= {f"{c}Axis": [k] for k, (_, c) in enumerate(free, 1)}
        tables[inertias] = [_INERTIA.format(c) for _, c in own]
        for group, fields in (
            ("Limits", "lower upper velocity effort acceleration deceleration"),
            ("Losses", "damping friction steepness"),
        ):
            part = {"Limits": "limits", "Losses": "dynamics"}[group]
            tables |= {f"{kind}{group}.{field}": [f"{c}.{part}.{field}" for _, c in own] for field in fields.split()}
        for field, infinite in (("lower", "-Modelica.Constants.inf"), ("upper", "Modelica.Constants.inf")):
            tables[f"{kind}Limits.{field}"] = [
                infinite if j.type == "continuous" else f"{c}.limits.{field}" for j, c in own
            ]
    return {path: list(map(str, items)) for path, items in tables.items()}
