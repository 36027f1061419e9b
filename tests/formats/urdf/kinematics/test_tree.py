"""The canonical order of a robot's elements, and what follows from it."""

from __future__ import annotations

from collections.abc import Iterator

from hypothesis import given
from support.robots import robots

from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.names import natural_key
from urdfsync.formats.urdf.robot import Joint, Link, Mimic, Robot, effective


def walk(robot: Robot, link: str) -> Iterator[Joint]:
    """Joints below a link, as one would follow them with a finger."""
    for joint in sorted((j for j in robot.joints if j.parent == link), key=lambda j: natural_key(j.name)):
        yield effective(joint)
        yield from walk(robot, joint.child)


@given(robots())
def test_links_and_joints_stand_depth_first(robot: Robot) -> None:
    """However they stand in the file."""
    skeleton = KinematicTree.of(robot)
    (root,) = {link.name for link in robot.links} - {joint.child for joint in robot.joints}
    assert list(skeleton.joints) == list(walk(robot, root))
    assert [link.name for link in skeleton.links] == [root, *(joint.child for joint in skeleton.joints)]


def test_a_chain_may_be_longer_than_python_recurses() -> None:
    joints = tuple(Joint(f"j{n}", "revolute", f"l{n}", f"l{n + 1}") for n in range(3000))
    followers = tuple(
        Joint(f"f{n}", "revolute", "l0", f"m{n}", mimic=Mimic(f"f{n - 1}" if n else "j0")) for n in range(3000)
    )
    links = tuple(Link(name) for name in ["l0", *(joint.child for joint in (*joints, *followers))])
    skeleton = KinematicTree.of(Robot("chain", links, (*joints, *followers)))
    assert [link.name for link in skeleton.links][-1] == "l3000"
    assert skeleton.leaders_first()[-1].name == "f2999"
