"""The canonical order of a robot's elements, and what follows from it."""

from __future__ import annotations

from collections.abc import Iterator

from hypothesis import given
from hypothesis import strategies as st
from support.robots import robots

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.names import natural_key
from urdfsync.urdf.robot import MOTION_KINDS, Joint, Link, Mimic, Robot


def walk(robot: Robot, link: str) -> Iterator[Joint]:
    """Joints below a link, as one would follow them with a finger."""
    for joint in sorted((j for j in robot.joints if j.parent == link), key=lambda j: natural_key(j.name)):
        yield joint
        yield from walk(robot, joint.child)


@given(robots())
def test_links_and_joints_stand_depth_first(robot: Robot) -> None:
    skeleton = KinematicTree.of(robot)
    (root,) = {link.name for link in robot.links} - {joint.child for joint in robot.joints}
    assert list(skeleton.joints) == list(walk(robot, root))
    assert [link.name for link in skeleton.links] == [root, *(joint.child for joint in skeleton.joints)]


@given(robots(), st.randoms(use_true_random=False))
def test_the_order_of_elements_makes_no_difference(robot: Robot, random: st.DataObject) -> None:
    links, joints = list(robot.links), list(robot.joints)
    random.shuffle(links)  # type: ignore[attr-defined]
    random.shuffle(joints)  # type: ignore[attr-defined]
    assert KinematicTree.of(Robot("shuffled", tuple(links), tuple(joints))) == KinematicTree.of(robot)


@given(robots())
def test_every_joint_with_an_axis_is_driven_or_follows(robot: Robot) -> None:
    skeleton = KinematicTree.of(robot)
    driven = [joint.name for motion in ("rotational", "translational") for joint in skeleton.axes(motion)]
    following = [joint.name for joint, _ in skeleton.followers()]
    assert sorted(driven + following) == sorted(joint.name for joint in robot.joints if joint.type in MOTION_KINDS)
    grouped = skeleton.followers_by_leader()
    assert sorted(joint.name for group in grouped.values() for joint, _ in group) == sorted(following)
    assert all(mimic.joint == leader for leader, group in grouped.items() for _, mimic in group)


@given(robots())
def test_leaders_come_before_those_that_follow_them(robot: Robot) -> None:
    order = KinematicTree.of(robot).leaders_first()
    place = {joint.name: number for number, joint in enumerate(order)}
    assert sorted(place) == sorted(joint.name for joint in robot.joints)
    assert all(place[joint.mimic.joint] < place[joint.name] for joint in order if joint.mimic)


def test_a_chain_may_be_longer_than_python_recurses() -> None:
    joints = tuple(Joint(f"j{n}", "revolute", f"l{n}", f"l{n + 1}") for n in range(3000))
    followers = tuple(
        Joint(f"f{n}", "revolute", "l0", f"m{n}", mimic=Mimic(f"f{n - 1}" if n else "j0")) for n in range(3000)
    )
    links = tuple(Link(name) for name in ["l0", *(joint.child for joint in (*joints, *followers))])
    skeleton = KinematicTree.of(Robot("chain", links, (*joints, *followers)))
    assert [link.name for link in skeleton.links][-1] == "l3000"
    assert skeleton.leaders_first()[-1].name == "f2999"
