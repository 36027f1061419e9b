"""The robot's model and its benches: a new leaf changes few lines, and connectors of icons keep their rows."""

from __future__ import annotations

import re
from collections import Counter
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace
from support import corpus
from support.packages import RENDERER, read
from support.robots import random_robot

from urdfsync.domain import Artifact, Target
from urdfsync.formats.urdf.artifacts import artifacts
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import Joint, Limit, Link, Robot

TARGET = Target("Bot", "Bot")


def with_leaf(robot: Robot, parent: str) -> Robot:
    joint = Joint("zz_joint", "revolute", parent, "zz", limit=Limit(-1.0, 1.0, 2.0, 1.0))
    return replace(robot, links=(*robot.links, Link("zz")), joints=(*robot.joints, joint))


def texts(robot: Robot) -> dict[str, str]:
    """The model and its benches."""
    return {
        each.path: RENDERER.render(each.template, each.data)
        for each in artifacts(robot, {}, TARGET, Options())
        if isinstance(each, Artifact) and each.path in ("Bot.mo", "BotRun.mo", "BotTest.mo")
    }


def rows(text: str) -> dict[str, str]:
    """The places of connectors on the icon."""
    return dict(re.findall(r"(\w+)\n[^\n]*\n[^\n]*iconTransformation\(extent=(\{\{.*?\}\})", text))


@pytest.mark.slow
@settings(max_examples=30)
@given(st.randoms(use_true_random=False), st.integers(2, 20))
def test_a_new_joint_leaves_most_connectors_of_the_icon_in_their_rows(random_: Random, links: int) -> None:
    robot = random_robot(random_, ("revolute",), names=[f"l{k}" for k in range(links)], mimics=0)
    before, after = (
        rows(texts(each)["Bot.mo"]) for each in (robot, with_leaf(robot, random_.choice(robot.links).name))
    )
    assert len({*after.values()}) == len(after), "no two have one place"
    moved = [name for name in before.keys() & after.keys() if before[name] != after[name]]
    assert len(moved) <= 24, "eight drives with three flanges each"


@pytest.mark.slow
@pytest.mark.usefixtures("corpus")
def test_a_new_leaf_changes_few_lines() -> None:
    """At most 20 of the model in nine of ten cases, at most 60 in 99 of 100; of its benches, too.

    The diagram of a hand with nine loops moves more: 200 lines.
    """
    changed: dict[str, list[int]] = {"Bot.mo": [], "BotRun.mo": [], "BotTest.mo": []}
    for file in corpus.robots():
        robot = read((corpus.FOLDER / file).read_bytes()).snapshot
        if robot is None or robot.loops:
            continue
        before = texts(robot)
        for link in Random(file).sample(robot.links, min(6, len(robot.links))):
            after = texts(with_leaf(robot, link.name))
            for path, counts in changed.items():
                counts.append((Counter(before[path].splitlines()) - Counter(after[path].splitlines())).total())
    for counts in changed.values():
        counts.sort()
        assert len(counts) > 200
        assert (
            counts[len(counts) // 2] <= 12,
            counts[len(counts) * 9 // 10] <= 22,
            counts[len(counts) * 99 // 100] <= 60,
        ) == (True, True, True)
