"""What changes the motion of a robot and is in no model: each has a warning that says so."""

from __future__ import annotations

import pytest
from support.urdfs import joint, link, robot

from urdfsync.urdf.parse.source import read_robot

TREE = (link("base"), link("arm", 1.0), joint("elbow", "continuous", "base", "arm"))


def read(element: str) -> tuple[list[str], list[str]]:
    reading = read_robot(robot(*TREE, element).encode(), "a.urdf")
    return [str(entry) for entry in reading.diagnostics], [entry.message for entry in reading.unmodelled]


@pytest.mark.parametrize(("element", "words"), [
    ("<gazebo reference='arm'><turnGravityOff>true</turnGravityOff></gazebo>",
     "link 'arm' has no weight in Gazebo, but has it in the model"),
    ("<gazebo reference='arm'><gravity value='0'/></gazebo>",
     "link 'arm' has no weight in Gazebo, but has it in the model"),
    ("<gazebo reference='elbow'><springStiffness>5</springStiffness></gazebo>",
     "springStiffness 5 of 'elbow' acts in Gazebo, but not in the model"),
    ("<force_element name='s'><torsional_spring/></force_element>",
     "<force_element> s acts between links, but not in the model"),
])  # fmt: skip
def test_what_changes_the_motion_is_a_warning(element: str, words: str) -> None:
    (warning,), notes = read(element)
    assert warning.startswith(f"a.urdf:6: warning: {words}; ")
    assert len(notes) == 1, "with its line, as all that is in no model"


@pytest.mark.parametrize("part", [
    "<turnGravityOff>false</turnGravityOff>", "<gravity>1</gravity>",
])  # fmt: skip
def test_gravity_that_is_not_switched_off_is_modelled(part: str) -> None:
    assert read(f"<gazebo reference='arm'>{part}</gazebo>") == ([], [])


@pytest.mark.parametrize("element", [
    "<gazebo reference='base'><turnGravityOff>true</turnGravityOff></gazebo>",
    "<gazebo reference='elbow'><springStiffness>0</springStiffness></gazebo>",
    "<gazebo reference='arm'><dampingFactor>none</dampingFactor></gazebo>",
    "<gazebo reference='arm'><material>Gazebo/Red</material></gazebo>",
])  # fmt: skip
def test_what_changes_nothing_is_counted(element: str) -> None:
    warnings, notes = read(element)
    assert warnings == []
    assert len(notes) == 1
