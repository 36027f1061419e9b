"""The picture of a robot's diagram: every element, with its mass or its ratio."""

from __future__ import annotations

from lxml import etree

from urdfsync.domain import Target
from urdfsync.urdf.diagram.picture import draw
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Inertial, Joint, Link, Mimic, Robot

ROBOT = Robot(
    "arm",
    (
        Link("base", Inertial(12.3456)),
        Link("Arm"),
        Link("tip<&>"),
        Link("left"),
        Link("right"),
        Link("last", Inertial(1234)),
    ),
    (
        Joint("turn", "revolute", "base", "Arm"),
        Joint("mount", "fixed", "Arm", "tip<&>"),
        Joint("slide", "prismatic", "Arm", "left"),
        Joint("follow", "prismatic", "Arm", "right", mimic=Mimic("slide", -2.5)),
        Joint("stay", "revolute", "right", "last", mimic=Mimic("mount", 7)),
    ),
)


def texts(target: Target) -> list[str]:
    root = etree.fromstring(draw(ROBOT, target, Options()).encode())
    return [element.text or "" for element in root.iter("{http://www.w3.org/2000/svg}text")]


def test_every_element_is_named_as_in_modelica() -> None:
    found = texts(Target("Plant.Arm", "Arm"))
    names = {"base", "arm_link", "tip___", "left", "right", "turn", "mount", "slide", "follow", "followMimic"}
    assert names <= set(found)
    assert "Plant.Arm" in found
    assert {"12.3 kg", "1230 kg"} <= set(found)


def test_couplings_show_their_ratio_or_that_they_hold_a_joint_whose_leader_cannot_move() -> None:
    found = texts(Target("Plant.Arm", "Arm"))
    assert "× -2.5" in found
    assert "held" in found
    assert "× 7" not in found


def test_the_robots_class_decides_about_names_as_in_the_model() -> None:
    assert "arm" in texts(Target("Plant.Machine", "Machine"))
