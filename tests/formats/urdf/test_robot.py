"""Robots: nothing of them is lost in states, and blanks in the source make no difference."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Annotated, Any, Literal, get_args, get_origin

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.urdfs import parsed

from urdfsync.formats.urdf import robot as robots
from urdfsync.formats.urdf.model.numbers import joint_numbers
from urdfsync.formats.urdf.robot import Joint, JointType, Link, Loop, Robot, Sensor, effective
from urdfsync.project.state.record import as_read, as_recorded

NUMBERS = st.floats(allow_nan=False, allow_infinity=False)


def values(kind: Any) -> st.SearchStrategy[Any]:
    """Any value of a type that fields of robots have."""
    inside = get_args(kind)
    if get_origin(kind) is Annotated:
        return values(inside[0])
    if kind in (float, int, str, bool, None, type(None)):
        plain = {float: NUMBERS, int: st.integers(1, 9), str: st.text(max_size=6), bool: st.booleans()}
        return plain.get(kind, st.none())
    if get_origin(kind) is Literal:
        return st.sampled_from(inside)
    if get_origin(kind) is tuple and inside[1:] == (...,):
        unique = (lambda one: one.name) if inside[0] in (Link, Joint, Loop, Sensor) else None
        return st.lists(values(inside[0]), max_size=3, unique_by=unique).map(tuple)
    if get_origin(kind) is Mapping:
        return st.dictionaries(values(inside[0]), values(inside[1]), max_size=2)
    if get_origin(kind) is tuple:
        return st.tuples(*map(values, inside))
    if inside:
        return st.one_of(*map(values, inside))
    return st.builds(kind, **{field.name: values(field.type) for field in msgspec.structs.fields(kind)})


ARM = """<robot name="arm">
  <material name="red"><color rgba="1 0 0 1"/></material>
  <link name="b">
    <visual><geometry><sphere radius="1"/></geometry><material name="red"/></visual>
    <collision><geometry><sphere radius="1"/></geometry></collision>
    <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
  </link>
  <link name="a"/>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin xyz="1 2 3"/></joint>
  <gazebo reference="b"/>
  <gazebo/>
</robot>"""


def test_no_annotation_is_a_text_that_msgspec_has_to_compile_in_each_build() -> None:
    structs = [one for one in vars(robots).values() if isinstance(one, type) and issubclass(one, msgspec.Struct)]
    assert Robot in structs
    assert not [one for one in structs if any(isinstance(kind, str) for kind in one.__annotations__.values())]


@pytest.mark.slow
@settings(deadline=None)
@given(values(Robot))
def test_nothing_is_lost_on_the_way_through_a_state(robot: Robot) -> None:
    recorded = as_recorded(robot)
    written = json.loads(json.dumps(recorded, allow_nan=False, sort_keys=True))
    assert written == recorded
    assert as_read(written, Robot) == robot.by_name()
    assert json.dumps(as_recorded(as_read(written, Robot)), sort_keys=True) == json.dumps(recorded, sort_keys=True)


@pytest.mark.parametrize("text", [
    ARM.replace("\n", "\n\n<!-- c -->"),
    ARM.replace('xyz="1 2 3"', "rpy = '0 0  -0'\n xyz=\" 1.0 2e0\t+3 \""),
    ARM.replace("<gazebo/>", "<gazebo >\n  </gazebo>"),
    ARM.replace("\n", "\r\n"),
])  # fmt: skip
def test_what_is_no_change_at_all(text: str) -> None:
    assert msgspec.json.encode(parsed(text)) == msgspec.json.encode(parsed(ARM))


class LabelledJoint(Joint, frozen=True):
    """A joint with an attribute that a change of the program may add."""

    part_number: str | None = None


@pytest.mark.parametrize("kind", get_args(JointType))
def test_an_attribute_of_a_joint_is_recorded_whatever_its_type(kind: JointType) -> None:
    joint = LabelledJoint("j", kind, "a", "b", part_number="P-7")
    assert joint_numbers(effective(joint))["partNumber"] == "P-7"
