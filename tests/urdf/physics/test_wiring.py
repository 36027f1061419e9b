"""The connections of Run and Test, as their texts say them."""

from __future__ import annotations

from typing import Any

import pytest
from support.loops import FOUR_BAR
from support.packages import Package, generate, generate_robot
from support.urdfs import joint, links, robot

from urdfsync.domain import Target
from urdfsync.urdf.physics.wiring import wiring

ARM = robot(
    *links(base=4.0, arm=2.5, hand=0.7),
    joint("elbow", "revolute", "base", "arm"),
    joint("slide", "prismatic", "arm", "hand"),
    '<ros2_control name="r" type="system"><joint name="elbow"><command_interface name="effort"/></joint>'
    "</ros2_control>",
)


def faults(old: str = "", new: str = "", **options: Any) -> list[tuple[str, str]]:
    """Elements and details that are wrong when a text of the package is another one."""
    return faults_of(generate(ARM.encode(), Target("Arm", "Arm"), **options), old, new)


def faults_of(package: Package, old: str, new: str) -> list[tuple[str, str]]:
    assert any(old in text for text in package.texts.values()), old
    texts = {path: (text.replace(old, new) if old else text).encode() for path, text in package.texts.items()}
    found = wiring(texts, package.skeleton, package.target, package.options)
    return [(each.element, each.detail) for each in found if not each.agrees]


@pytest.mark.parametrize("options", [{}, {"inputs": "vector"}, {"base": "floating"}, {"driven": ("slide",)}])
def test_what_is_generated_is_connected_as_it_should_be(options: dict[str, Any]) -> None:
    assert faults(**options) == []


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("connect(elbow_tau, ", "connect(slide_s, ", [("joint elbow", "source in Run")]),
        ("connect(slide_s, slideDrive.s_ref)", "connect(slide_s, elbowDrive.tau)", ["elbow", "slide"]),
        ("slideDrive.support, robot.slideSupport", "slideDrive.support, robot.elbowSupport", ["elbow", "slide"]),
        ("PartialBench;", "PartialBench(world(g = 1));", [("robot", "gravity of Run"), ("robot", "gravity of Test")]),
        ("phi_max = robot.elbow.", "phi_max = robot.slide.", [("joint elbow", "source in Test")]),
        ('name = "elbow"', 'name = "slide"', [("joint elbow", "names the joint")]),
    ],
)
def test_what_is_connected_otherwise_is_told(old: str, new: str, expected: list[Any]) -> None:
    found = faults(old, new)
    assert found == expected or sorted({element.removeprefix("joint ") for element, _ in found}) == expected


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("", "", []),
        (".crank_pivotReach)", ".crank_pinReach)", [("joint crank_pivot", "source in Test")]),
        (
            "crank_pivotDrive.flange, robot.crank_pivotAxis",
            "crank_pivotDrive.flange, robot.crank_pinAxis",
            [
                (f"joint {name}", f"{what} in {bench}")
                for name, what in (("crank_pin", "axis of a dependent joint"), ("crank_pivot", "source"))
                for bench in ("Run", "Test")
            ],
        ),
    ],
)
def test_one_joint_of_a_four_bar_has_a_source(old: str, new: str, expected: list[Any]) -> None:
    assert sorted(faults_of(generate_robot(FOUR_BAR, Target("Four", "Four")), old, new)) == expected
