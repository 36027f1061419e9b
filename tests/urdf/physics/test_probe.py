"""The text that moves a generated robot: what it needs of the package, and of libraries."""

from __future__ import annotations

import re

import pytest
from support.urdfs import joint, link, links, mimic, parsed, robot

from urdfsync.domain import Target
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.physics.probe import probe

URDF = robot(
    link("base", 4.0),
    link("upper arm", 2.5),
    *links(hand=0.7, cover=0.7),
    joint("shoulder", "revolute", "base", "upper arm"),
    joint("slide", "prismatic", "upper arm", "hand", inside=[mimic("shoulder")]),
    joint("weld", "fixed", "upper arm", "cover"),
)
ARM = Target("Plant.Robots.Arm", "Arm")


def skeleton() -> KinematicTree:
    return KinematicTree.of(parsed(URDF), ("Arm",))


def test_it_relies_on_little_of_a_package_so_that_it_may_be_edited() -> None:
    found = probe(skeleton(), ARM, Options())
    parts = {re.sub(r"\[.*", "", value) for value in found.values}
    assert parts == {
        *(f"robot.{name}.frame_a.{part}" for name in ("base", "upper_arm", "hand", "cover") for part in ("r_0", "R.T")),
        *("robot.shoulderAxis.tau", "base.frame_b.f", "base.frame_b.t", "mass", "centre"),
    }
    inner = set(re.findall(r"robot\.\w+(?:\.\w+)*", found.source)) - {value for value in parts if "frame_a" in value}
    bodies = {f"robot.{name}.body.{part}" for name in ("base", "upper_arm", "hand", "cover") for part in ("m", "r_CM")}
    frames = {f"robot.{name}.frame_a.R" for name in ("base", "upper_arm", "hand", "cover")}
    assert inner == {"robot.m", "robot.frame_a", "robot.shoulderAxis", *bodies, *frames}


@pytest.mark.parametrize(("target", "options", "imports"), [
    (ARM, Options(), ["Modelica", "UrdfSync", "Plant"]),
    (Target("UrdfSync.Examples.Arm", "Arm"), Options(), ["Modelica", "UrdfSync"]),
    (ARM, Options(visualizer="visualization2"), ["Modelica", "UrdfSync", "Visualization2", "Plant"]),
])  # fmt: skip
def test_every_library_is_named_once(target: Target, options: Options, imports: list[str]) -> None:
    assert re.findall(r"^  import (\w+);$", probe(skeleton(), target, options).source, re.MULTILINE) == imports
