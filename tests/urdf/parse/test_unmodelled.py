"""What is in no model: one note names it, joints that close loops and masses in no link are errors."""

from __future__ import annotations

import pytest
from support import corpus as corpora
from support.urdfs import joint, link, robot

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf.parse.source import read_robot

TREE = [link("base"), link("arm", 1.0), joint("j", "continuous", "base", "arm")]
LOOP = '<loop_joint name="bar" type="continuous"><link1 link="base"/><link2 link="arm"/></loop_joint>'
GAZEBO_LOOP = '<gazebo><joint name="bar" type="revolute"><parent>base</parent><child>arm</child></joint></gazebo>'
STRAY = '<inertial><mass value="2"/></inertial>'


def notes(*elements: str) -> list[Diagnostic]:
    reading = read_robot(robot(*TREE, *elements).encode(), "a.urdf")
    assert reading.robot is not None
    assert reading.diagnostics == ()
    return list(reading.unmodelled)


def test_all_that_is_not_modelled_is_one_note() -> None:
    (note,) = notes(
        '<gazebo><plugin name="control" filename="a.so"/></gazebo>',
        '<gazebo><plugin filename="b.so"/></gazebo>',
        '<gazebo reference="arm"><material>Gazebo/Red</material><selfCollide>true</selfCollide>'
        '<sensor name="eye" type="contact"><plugin name="driver" filename="c.so"/></sensor></gazebo>',
        '<frame name="n"/>',
        '<link name="tip" group="left"><verbose value="1"/></link>',
        joint("k", "fixed", "arm", "tip"),
    )
    assert (note.code, note.line) == ("not-modelled", 6)
    assert note.message == (
        "not modelled: 3 gazebo plugins (control, b.so, driver), 2 gazebo settings (material, selfCollide), "
        "1 sensor (eye), 1 <frame> (n), 1 <verbose> (link tip), 1 attribute (link group)"
    )
    assert note.details == (
        "line 6: gazebo plugin control",
        "line 7: gazebo plugin b.so",
        "line 8: gazebo plugin driver",
        "line 8: gazebo setting material",
        "line 8: gazebo setting selfCollide",
        "line 8: sensor eye",
        "line 9: <frame> n",
        "line 10: <verbose> link tip",
        "line 10: attribute link group",
    )


def test_sensors_without_a_model_or_a_place_are_named() -> None:
    (note,) = notes(
        '<sensor name="free" type="imu"/>',
        '<ros2_control name="c" type="sensor"><sensor name="pose"><state_interface name="x"/></sensor></ros2_control>',
    )
    assert note.message == "not modelled: 2 sensors (free, pose)"


def test_more_than_three_names_are_cut_off() -> None:
    (note,) = notes(*(f'<gazebo><plugin name="p{number}"/></gazebo>' for number in range(5)))
    assert note.message == "not modelled: 5 gazebo plugins (p0, p1, p2, …)"
    assert len(note.details) == 5


def test_a_robot_of_links_and_joints_has_no_note() -> None:
    assert notes('<transmission name="t"><joint name="j"/></transmission>', "<gazebo/>") == []
    namespace = robot(*TREE).replace("<robot", '<robot xmlns="http://www.ros.org" xmlns:x="urn:x"')
    assert read_robot(namespace.encode(), "a.urdf").unmodelled == ()


@pytest.mark.parametrize(("element", "code"), [
    (LOOP, "loop-joint"), (GAZEBO_LOOP, "loop-joint"), (STRAY, "stray-inertial"),
])  # fmt: skip
def test_what_moves_and_is_in_no_tree_is_an_error_unless_it_is_allowed(element: str, code: str) -> None:
    content = robot(*TREE, element).encode()
    (error,) = read_robot(content, "a.urdf").diagnostics
    assert (error.severity, error.code, error.line) == (Severity.ERROR, code, 6)
    assert f'`allow = ["{code}"]`' in error.hint
    reading = read_robot(content, "a.urdf", [code])
    assert reading.robot is not None
    assert [(one.severity, one.code, one.line) for one in reading.diagnostics] == [(Severity.WARNING, code, 6)]
    (other,) = {"loop-joint", "stray-inertial"} - {code}
    assert read_robot(content, "a.urdf", [other]).robot is None


@pytest.mark.parametrize(("element", "name"), [(LOOP, "<loop_joint> bar"), (GAZEBO_LOOP, "<gazebo> bar")])
def test_a_loop_is_told_by_the_name_of_its_joint(element: str, name: str) -> None:
    (error,) = read_robot(robot(*TREE, element).encode(), "a.urdf").diagnostics
    assert error.message.startswith(f"{name} closes a loop of links")


ROBOTIQ = "robots/drake/atlas/urdf/robotiq.urdf"


@pytest.mark.usefixtures("corpus")
def test_a_gripper_with_loops() -> None:
    """Its nine loop joints, and its mass without a link."""
    found = read_robot((corpora.FOLDER / ROBOTIQ).read_bytes(), ROBOTIQ).diagnostics
    errors = [one.code for one in found if one.severity is Severity.ERROR]
    assert errors == ["loop-joint"] * 9 + ["stray-inertial"]
