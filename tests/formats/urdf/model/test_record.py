"""The record of a whole robot: its structure, and its joints with every group that they have.

Its tables have bodies, joints and followers of every tree, and references that hold.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import pytest
from hypothesis import given, settings
from support.packages import record_components, record_tables, record_text
from support.robots import SCALAR, assembly, robots, tree

from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.model.record import obstacles, record_data, tables
from urdfsync.formats.urdf.names import spell
from urdfsync.formats.urdf.robot import (
    JOINT_KINDS,
    MOTION_KINDS,
    Calibration,
    Dynamics,
    Joint,
    JointType,
    Limit,
    Link,
    Mimic,
    Origin,
    Robot,
    SafetyController,
    Sphere,
    Visual,
)


@pytest.mark.slow
@given(robots())
def test_the_matrices_say_what_the_tree_is(robot: Robot) -> None:
    found = record_data(assembly(robot), {})
    links = [part.numbers["name"] for part, *_ in found["parts"] if part.base == "Link"]
    joints = [part.numbers["name"] for part, *_ in found["parts"] if part.base != "Link"]
    matrices = found["structure"]["tables"]

    def rows(matrix: str) -> list[tuple[int, ...]]:
        return [tuple(map(int, row)) for row in re.findall(r"(\d+), (\d+)[];]", matrices[matrix].code)]

    assert {(links[parent - 1], links[child - 1]) for parent, child in rows("connectionMatrix")} == {
        (joint.parent, joint.child) for joint in robot.joints
    }
    moving = {joints[number - 1] for number, _ in rows("moveableJoints")}
    assert moving == {joint.name for joint in robot.joints if joint.type != "fixed"}


EVERYTHING: dict[str, Any] = {
    "limit": Limit(-1, 2, 30, None),
    "dynamics": Dynamics(0.5, 0),
    "mimic": Mimic("leader", -2, 0.1),
    "calibration": Calibration(rising=0.25),
    "safety_controller": SafetyController(10, 20, -0.5, 1.5),
}
LOSSES = "damping = 0.5, friction = 0"
GROUPS = {
    "limits": "lower = -1, upper = 2, velocity = Modelica.Constants.inf, effort = 30",
    "dynamics": LOSSES,
    "mimic": "multiplier = -2, offset = 0.1",
    "calibration": "rising = 0.25, falling = Modelica.Constants.inf",
    "safetyController": "k_velocity = 10, k_position = 20, soft_lower_limit = -0.5, soft_upper_limit = 1.5",
}
UNLIMITED = ", ".join(
    f"{name} = {sign}Modelica.Constants.inf"
    for name, sign in (("lower", "-"), ("upper", ""), ("velocity", ""), ("effort", ""))
)


@pytest.mark.parametrize(("kind", "full", "bare"), [
    ("revolute", GROUPS, {"limits": UNLIMITED}),
    ("prismatic", GROUPS, {"limits": UNLIMITED}),
    ("continuous", GROUPS | {"limits": UNLIMITED.rpartition("= ")[0] + "= 30"}, {"limits": UNLIMITED}),
    ("planar", {"translation": LOSSES, "rotation": LOSSES}, {}),
    ("fixed", {}, {}),
    ("floating", {}, {}),
    ("ball", {}, {}),
])  # fmt: skip
def test_a_joint_has_the_groups_of_its_type(kind: JointType, full: dict[str, str], bare: dict[str, str]) -> None:
    leader = Joint("leader", "revolute", "a", "l")
    for parts, groups in ((EVERYTHING, full), ({}, bare)):
        joint = Joint('a "b"', kind, "a", "b", Origin((1, 2, 3)), axis=(0, 0, 1), **parts)
        record, text = record_components(tree(leader, joint))[spell('a "b"', "joint")]
        assert record == f"{kind.capitalize()}Joint"
        start = 'name = "a \\"b\\"", origin( xyz = {1, 2, 3}, rpy = {0, 0, 0})'
        assert text.startswith(f"{start}, axis = {{0, 0, 1}}" if JOINT_KINDS[kind].has_axis else start)
        found = re.findall(r"(\w+)\( ?([^()]*)\)", text)
        assert {name: numbers for name, numbers in found if name != "origin"} == groups


@pytest.mark.parametrize("other", ["aVisual1", "AVISUAL1"])
def test_a_visual_gives_way_to_an_element_of_its_name(other: str) -> None:
    text = record_text(
        Robot("r", (Link("a", visuals=(Visual(Sphere(1)),)), Link(other)), (Joint("j", "fixed", "a", other),))
    )
    assert "UrdfSync.Records.Sphere aVisual1_2(" in text
    assert "aVisual1_2.color" in text


TREES = robots(types=(*SCALAR, "fixed")).filter(lambda robot: not obstacles(robot.joints))
few = settings(max_examples=30)  # trees are small, and take their time to be drawn
FIELD = re.compile(r"(\w+) = (\{[^{}]*\})")
"""A field of an array of records."""
REFERENCE = re.compile(r"\b[a-z]\w*(?:\.[a-zA-Z_]\w*)+")


def texts_of(of: KinematicTree) -> Mapping[str, str]:
    """The modifiers by their names, on one line each; those of arrays of records by `name.field`."""
    found: dict[str, str] = {}
    for modifier in record_tables(of):
        text = " ".join(modifier.split())
        if record := re.fullmatch(r"(\w+)\((.*)\)", text):
            found |= {f"{record[1]}.{field}": value for field, value in FIELD.findall(record[2])}
        else:
            name, _, value = text.partition(" = ")
            found[name] = value
    return found


def entries(value: str) -> list[str]:
    """The entries of an array without arrays in it."""
    return [entry.strip() for entry in value.strip("{} ").split(",")] if value else []


def moving(of: KinematicTree) -> list[Joint]:
    return [joint for joint in of.joints if joint.type in MOTION_KINDS]


def test_a_robot_that_does_not_move_is_one_body() -> None:
    assert not obstacles([])
    found = tables(tree(Joint("j", "fixed", "a", "b")))
    assert (found.link_bodies, found.joint_tree, found.first_joints) == ([1, 1], [], [1])
    text = texts_of(tree(Joint("j", "fixed", "a", "b")))
    assert text["linkBodies"] == "{1, 1}"
    assert not {"movingJoints", "jointTree", "nextJoints", "jointAxes"} & text.keys()


def iterate(number: int, following: Sequence[int]) -> Iterator[int]:
    """A number, the one that follows it, and so on."""
    while True:
        yield number
        number = following[number - 1]


@few
@given(TREES)
def test_every_link_is_part_of_one_body_and_every_body_has_links(robot: Robot) -> None:
    of = KinematicTree.of(robot)
    found = tables(of)
    bodies = dict(zip((link.name for link in of.links), found.link_bodies, strict=True))
    numbers = {joint.name: number for number, joint in enumerate(moving(of), 1)}
    assert set(found.link_bodies) == set(range(1, len(numbers) + 2))
    for joint in of.joints:
        if joint.type == "fixed":
            assert bodies[joint.child] == bodies[joint.parent]
        else:
            number = numbers[joint.name]
            assert bodies[joint.child] == number + 1
            turns = 1 if MOTION_KINDS[joint.type] == "rotational" else 2
            assert found.joint_tree[number - 1] == (bodies[joint.parent], turns)
            assert bodies[joint.parent] <= number, "what carries a joint comes before what it moves"
    for body in set(found.link_bodies):
        chain = itertools.takewhile(
            lambda number: number <= len(numbers), iterate(found.first_joints[body - 1], found.next_joints)
        )
        assert list(chain) == [n for n, (carrier, _) in enumerate(found.joint_tree, 1) if carrier == body]


@pytest.mark.slow
@few
@given(TREES)
def test_references_are_to_what_the_record_has_and_no_number_is_written(robot: Robot) -> None:
    of = KinematicTree.of(robot)
    fields = {of.link(link.name).component: {"inertial"} for link in of.links}
    for joint in of.joints:
        groups = {"axis", "limits", "dynamics", "mimic"} if joint.type != "fixed" else set()
        fields[of.joint(joint.name).component] = {"name", "origin", *groups}
    assert fields.keys() == record_components(of).keys()
    text = " ".join(record_tables(of)).replace("Modelica.Constants.inf", "")
    for reference in REFERENCE.findall(text):
        component, field, *_ = reference.split(".")
        assert field in fields[component], reference
    assert not re.search(r"\d\.\d|\de-?\d", REFERENCE.sub("", text))
