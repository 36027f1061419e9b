"""Names of classes: which there can be, and how they are made of other texts."""

from __future__ import annotations

import re

import pytest

from urdfsync.modelica.names import any_case, class_name, is_class_name, is_identifier, within


@pytest.mark.parametrize(("text", "name"), [
    ("my-robot v2", "MyRobotV2"), ("aBC_d", "ABCD"), ("", "Robot"), ("größe", "Grosse"), ("2nd arm", "Robot2ndArm"),
    ("Häuser", "Hauser"), ("Éléphant", "Elephant"), ("g1_29dof", "G1_29dof"), ("arm 1.2", "Arm1_2"), ("x_1 y", "X1Y"),
    ("con", "RobotCon"), ("modelica", "RobotModelica"), ("links", "RobotLinks"), ("LPT9", "RobotLPT9"),
])  # fmt: skip
def test_any_text_becomes_the_name_of_a_class(text: str, name: str) -> None:
    assert class_name(text) == name
    assert is_class_name(name)


@pytest.mark.parametrize(("name", "identifier", "class_"), [
    ("Arm_2", True, True), ("arm", True, False), ("_Arm", True, False), ("end", False, False), ("End", True, True),
    ("Ärm", False, False), ("A.B", False, False), ("Arm\n", False, False), ("Real", True, False), ("AUX", True, False),
    ("Joints", True, False), ("UrdfSync", True, False), ("", False, False),
])  # fmt: skip
def test_which_names_there_can_be(name: str, identifier: bool, class_: bool) -> None:
    assert (is_identifier(name), is_class_name(name)) == (identifier, class_)


def test_within() -> None:
    assert [within(name) for name in ("Arm", "Plant.Arm", "A.B.C")] == ["within;", "within Plant;", "within A.B;"]


def test_words_in_any_case() -> None:
    pattern = any_case(["com1", "a_b"])
    assert [bool(re.fullmatch(pattern, word)) for word in ("COM1", "Com1", "A_b", "com", "com1a")] == [
        True, True, True, False, False,
    ]  # fmt: skip
