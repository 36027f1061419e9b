"""Copies that Pinocchio reads as urdfsync reads the original, and copies in which everything that moves has mass."""

from __future__ import annotations

import pytest
from support.urdfs import dynamics, joint, limit, link, links, mimic, parsed, robot

from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.parse.source import read_robot
from urdfsync.formats.urdf.physics.completion import completed_for_reference, with_inertias
from urdfsync.formats.urdf.physics.reference import read
from urdfsync.formats.urdf.robot import Mimic, Robot

ENDS = '<parent link="base"/><child link="arm"/>'


def two_links(
    *inside: str, kind: str = "revolute", base: str = '<link name="base"/>', name: str = ' name="own"'
) -> str:
    elbow = f'<joint name="elbow" type="{kind}">{ENDS}{"".join(inside)}</joint>'
    return f'<robot{name}>{base}<link name="arm"/>{elbow}</robot>'


def robot_of(content: bytes) -> Robot:
    return parsed(content.decode())


def masses(content: bytes) -> dict[str, float]:
    return {one.name: one.inertial.mass if one.inertial else 0.0 for one in robot_of(content).links}


LACKING = {
    "the robot's name": two_links(limit(), name=""),
    "<limit>": two_links('<limit lower="-1" upper="2"/>'),
    "<limit> of a joint without": two_links(),
    "<dynamics>": two_links("<dynamics/>", kind="continuous"),
    "<safety_controller>": two_links(limit(), '<safety_controller soft_lower_limit="0"/>'),
    "<inertia>": two_links(
        limit(), base='<link name="base"><inertial><mass value="2"/><inertia ixx="1"/></inertial></link>'
    ),
    "<inertia>, <mass>": two_links(limit(), base='<link name="base"><inertial/></link>'),
}


@pytest.mark.parametrize(("added", "urdf"), LACKING.items())
def test_what_pinocchio_asks_for_is_added(added: str, urdf: str) -> None:
    content, notes = completed_for_reference(urdf.encode())
    assert notes == (f"additions for the reference's reader: {added.partition(' of')[0]}",)
    model = read(content, "robot.urdf").multibody.model
    assert sum(inertia.mass for inertia in model.inertias) == sum(masses(urdf.encode()).values())
    assert completed_for_reference(content) == (content, ())


TREE = robot(
    *links(base=3.0, sensor=None, carrier=None, load=1.0, gripper=None, tip=0.0),
    joint("mount", "fixed", "base", "sensor"),
    joint("lift", "prismatic", "base", "carrier"),
    joint("bolt", "fixed", "carrier", "load"),
    joint("grip", "continuous", "load", "gripper", inside=[mimic("lift")]),
    joint("end", "fixed", "gripper", "tip"),
).encode()


def test_massless_links_that_weigh_on_no_joint_stay_massless() -> None:
    """The sensor does not move against the base, the carrier moves the load."""
    content, notes = with_inertias(TREE, KinematicTree.of(robot_of(TREE)))
    assert notes == ("inertias were made up for 2 links of the generated package only, since moving links need a mass",)
    before, after = masses(TREE), masses(content)
    assert {name for name in before if before[name] != after[name]} == {"gripper", "tip"}


def test_a_robot_with_mass_in_all_that_moves_stays_as_it_is() -> None:
    urdf = robot(link("base"), link("arm", 1.0), joint("elbow", "continuous", "base", "arm", inside=[dynamics(1, 1)]))
    assert with_inertias(urdf.encode(), KinematicTree.of(robot_of(urdf.encode()))) == (urdf.encode(), ())


def test_made_up_inertias_are_possible_skew_and_always_the_same() -> None:
    names = [f"link_{number}" for number in range(40)]
    joints = [joint(f"to_{name}", "continuous", "base", name) for name in names]
    urdf = robot(link("base"), *map(link, names), *joints).encode()
    content, _ = with_inertias(urdf, KinematicTree.of(robot_of(urdf)))
    reading = read_robot(content, "robot.urdf")
    assert reading.diagnostics == (), "the checks of the reader know what a tensor must be"
    assert reading.robot is not None
    inertials = {one.name: one.inertial for one in reading.robot.links}
    assert len(set(inertials.values())) == 41
    assert all(one and one.inertia.ixy and one.inertia.ixz and one.inertia.iyz for one in inertials.values())
    base = inertials["base"]
    assert base is not None
    assert (base.mass, base.origin.xyz, base.inertia.ixy) == (0.946, (0.04, -0.07, 0.06), 0.001891)


def test_a_coupling_that_stands_elsewhere_becomes_a_mimic_of_a_moving_joint_without_one() -> None:
    plugin = '<plugin><joint>a</joint><mimicJoint>{}</mimicJoint><multiplier value="-2"/></plugin>'
    urdf = robot(
        *links(base=1.0, arm=1.0, tip=1.0, cap=1.0, end=1.0),
        joint("a", "continuous", "base", "arm"),
        joint("b", "continuous", "base", "tip"),
        joint("c", "continuous", "base", "cap", inside=[mimic("a", 3)]),
        joint("d", "fixed", "base", "end"),
        f"<gazebo>{''.join(map(plugin.format, 'bcd'))}</gazebo>",
    ).encode()
    content, _ = completed_for_reference(urdf)
    assert read(content, "robot.urdf").followers == {"b": Mimic("a", -2.0), "c": Mimic("a", 3.0)}
