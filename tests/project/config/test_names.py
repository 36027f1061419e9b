"""Names of robots, packages and classes: those that would hide something, or that are none, are refused."""

from __future__ import annotations

import pytest
from support.configurations import failures, parse, robot

pytestmark = pytest.mark.usefixtures("rc_domain")


@pytest.mark.parametrize(
    "package", ["Modelica.Arm", "Plant.real.Arm", "Plant.sin.Arm", "Plant.Aux.Arm", "com1", "Plant.UrdfSync.Arm",
                "UrdfSync", "urdfsync.Arm", "Plant.time", "Plant.Resources.Arm", "Complex"]
)  # fmt: skip
def test_packages_that_would_hide_what_models_refer_to(package: str) -> None:
    (message,) = failures(robot('class = "Robot1"', package=package))
    assert message.startswith(f"urdfsync.toml:3: error: {package!r} can't be a package; use letters, digits and `_`")


@pytest.mark.parametrize("package", ["UrdfSync.Examples.Arm", "Plant.Sum.Arm", "Plant.Links.Arm", "Plant.World"])
def test_packages_that_hide_nothing(package: str) -> None:
    assert parse(robot(package=package)).robots[0].target.package == package


@pytest.mark.parametrize("name", ["Package", "Aux", "Complex", "Joints", "robot", "Links"])
def test_classes_that_clash_with_files_or_other_classes_are_told_at_their_line(name: str) -> None:
    (message,) = failures(robot(f'class = "{name}"'))
    assert message.startswith(f"urdfsync.toml:5: error: {name!r} can't be the class of a robot model; set `class`")


@pytest.mark.parametrize("package", ["", ".", "Arm.", ".Arm", "Arm.end", "A b", "Gelenk_ä", "../evil", 'a\\"b', "1A"])
def test_packages_that_are_no_names_of_classes(package: str) -> None:
    (message,) = failures(robot(package=package))
    assert message.startswith("urdfsync.toml:3: error: ")
    assert "can't be a package" in message


@pytest.mark.parametrize("name", ["a/b", "..", ".hidden", "con", "NUL.x", "a:b", "a b", "ä", "x" * 101, "a."])
def test_robots_whose_names_are_no_names_of_files(name: str) -> None:
    assert failures(robot(name=f'"{name}"')) == [
        f"urdfsync.toml:1: error: the robot's name {name!r} can't be a file's name; "
        "use letters, digits, `_`, `-` and `.`, a letter or digit first [robot-name]"
    ]
