"""Which links have a frame of their own in the robot model."""

from __future__ import annotations

from typing import Literal

import pytest
from hypothesis import given
from support.trees import robots

from urdfsync.urdf.frames import frame_links
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Joint, Link, Robot

HAND = Robot(
    "hand",
    tuple(map(Link, ("palm", "index tip", "index", "thumb"))),
    (
        Joint("j2", "fixed", "palm", "thumb"),
        Joint("j1", "fixed", "palm", "index"),
        Joint("j3", "fixed", "index", "index tip"),
    ),
)


@pytest.mark.parametrize(
    ("frames", "names"),
    [
        ("leaves", ["index tip", "thumb"]),
        ("all", ["palm", "index", "index tip", "thumb"]),
        ((), ["index tip", "thumb"]),
        (("palm",), ["palm", "index tip", "thumb"]),
        (("thumb", "index", "index"), ["index", "index tip", "thumb"]),
        (("gone", "j1"), ["index tip", "thumb"]),
    ],
)
def test_leaves_and_those_that_are_asked_for_in_canonical_order(
    frames: Literal["leaves", "all"] | tuple[str, ...], names: list[str]
) -> None:
    assert [link.name for link in frame_links(KinematicTree.of(HAND), Options(frames=frames))] == names


@given(robots())
def test_leaves_and_all_of_any_robot(robot: Robot) -> None:
    skeleton = KinematicTree.of(robot)
    assert frame_links(skeleton, Options()) == skeleton.leaves()
    assert frame_links(skeleton, Options(frames="all")) == skeleton.links
    assert frame_links(skeleton, Options(frames=tuple(link.name for link in skeleton.links))) == skeleton.links
