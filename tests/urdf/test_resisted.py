"""Bounds tell that all joints are resisted only where adding up tells the same."""

from __future__ import annotations

import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st
from support import urdfs
from support.trees import ORIGINS, SCALAR, robots

from urdfsync.urdf.resistance import resistances, yielding
from urdfsync.urdf.resisted import clearly_resisted
from urdfsync.urdf.robot import Inertia, Inertial, Link, Robot
from urdfsync.urdf.skeleton import Skeleton
from urdfsync.urdf.parse.source import read_robot


def skeleton(*elements: str) -> Skeleton:
    robot = read_robot(urdfs.robot(*elements).encode(), "own.urdf", cross_check=False).robot
    assert robot is not None
    return Skeleton.of(robot)


def resisted(of: Skeleton) -> bool:
    found = resistances(of)
    return not yielding(of) and all(found[joint.name] for joint in of.joints if joint.name in found)


SIZES = st.sampled_from([0.0, 1e-15, 1e-9, 1e-6, 0.5, 2.0])
INERTIAS = st.builds(lambda size, x, xy: Inertia(ixx=size * x, iyy=size, izz=size, ixy=xy * size), SIZES, SIZES, SIZES)
INERTIALS = st.none() | st.builds(Inertial, SIZES, ORIGINS, INERTIAS)


@settings(deadline=None)
@given(robots(types=(*SCALAR, "fixed")), st.lists(INERTIALS, min_size=7, max_size=7))
def test_what_is_clear_is_what_comes_of_adding_up(robot: Robot, inertials: list[Inertial | None]) -> None:
    links = tuple(Link(link.name, inertial) for link, inertial in zip(robot.links, inertials, strict=False))
    of = Skeleton.of(Robot(robot.name, links, robot.joints))
    clear = clearly_resisted(of)
    event(f"clear: {clear}")
    assert resisted(of) or not clear


CLEAR = [
    *(urdfs.link(name, mass) for name, mass in (("base", None), ("arm", 2), ("ring", None), ("tool", 1), ("rail", 1))),
    urdfs.joint("lift", "revolute", "base", "arm", axis="0 0 1", inside=[urdfs.limit(0.5, 1)]),
    urdfs.joint("turn", "continuous", "arm", "ring", axis="0.6 0 0.8"),
    urdfs.joint("hold", "fixed", "ring", "tool"),
    urdfs.joint("slide", "prismatic", "tool", "rail", axis="1 0 0", inside=[urdfs.limit(-1, 1)]),
]


def test_a_body_that_is_fixed_to_the_child_of_each_joint_is_enough() -> None:
    assert clearly_resisted(skeleton(*CLEAR))


def rod(izz: float) -> str:
    return f'<inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="{izz!r}" ixy="0" ixz="0" iyz="0"/></inertial>'


AT = {"xyz": "0 0 0", "rpy": "0 0 0"}
SPIN = urdfs.joint("spin", "continuous", "base", "rod", axis="0 0 1", xyz="7000 -3000 2000")
SPUN = urdfs.joint("spin", "continuous", "far", "rod", axis="0 0 1", **AT)
FAR = [urdfs.limit(1e6, 2e6)], [urdfs.limit(-2e6, 2e6), urdfs.mimic("lead", 1, 1e6)]
HIDDEN = {
    "far from the root": [f'<link name="rod">{rod(1e-6)}</link>', SPIN],
    "a negative one": [
        *(f'<link name="{name}">{rod(izz)}</link>' for name, izz in (("rod", 1.0), ("other", -1.0))),
        *(SPIN.replace("7000 -3000 2000", "0 0 0"), urdfs.joint("hold", "fixed", "rod", "other", **AT)),
    ],
    **{
        name: [
            *(urdfs.link("far", 1), urdfs.link("led", 1), f'<link name="rod">{rod(1e-3)}</link>'),
            *(urdfs.joint("lead", "continuous", "base", "led", axis="0 0 1"), SPUN),
            urdfs.joint("slide", "prismatic", "base", "far", axis="1 0 0", inside=inside, **AT),
        ]
        for name, inside in zip(("a start far away", "a start that follows from another"), FAR, strict=True)
    },
}


HIDDEN["joints on one axis"] = [
    *(urdfs.link("ring"), urdfs.link("tool", 1)),
    urdfs.joint("spin", "continuous", "base", "ring", axis="0 0 1", **AT),
    urdfs.joint("second", "continuous", "ring", "tool", axis="0 0 1", **AT),
]
HIDDEN["nothing on a slide"] = [urdfs.link("end"), urdfs.joint("spin", "prismatic", "base", "end", inside=FAR[1][:1])]


@pytest.mark.parametrize("elements", HIDDEN.values(), ids=HIDDEN)
def test_what_does_not_count_is_not_clear(elements: list[str]) -> None:
    of = skeleton(urdfs.link("base", 1), *elements)
    assert not resisted(of)
    assert not clearly_resisted(of)
