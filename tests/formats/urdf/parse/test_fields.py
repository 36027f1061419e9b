"""What no struct asks for: one note counts it; loops that no model has and masses in no link are errors."""

from __future__ import annotations

from typing import get_args
from xml.etree.ElementTree import fromstring

import msgspec
import pytest
from support.robots import robot_extensions
from support.urdfs import joint, link, robot

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.formats.urdf.options import LeftOut, Options
from urdfsync.formats.urdf.parse.fields import Reader
from urdfsync.formats.urdf.parse.source import read_robot

TREE = [link("base"), link("arm", 1.0), joint("j", "continuous", "base", "arm")]
LOOP = '<loop_joint name="bar" type="prismatic"><link1 link="base"/><link2 link="arm"/></loop_joint>'
GAZEBO_LOOP = '<gazebo><joint name="bar" type="screw"><parent>base</parent><child>arm</child></joint></gazebo>'
STRAY = '<inertial><mass value="2"/></inertial>'


def notes(*elements: str) -> list[Diagnostic]:
    reading = read_robot(robot(*TREE, *elements).encode(), "a.urdf")
    assert reading.robot is not None
    assert reading.diagnostics == ()
    return list(reading.unmodelled)


def test_all_that_is_not_modelled_is_one_note() -> None:
    (note,) = notes(
        '<gazebo><plugin name="control" filename="a.so"/></gazebo>',
        '<gazebo reference="arm"><material>Gazebo/Red</material>'
        '<sensor name="eye" type="contact"><plugin name="driver" filename="c.so"/></sensor></gazebo>',
        '<frame name="n"/>',
        '<link name="tip" group="left"><verbose value="1"/></link>',
        joint("k", "fixed", "arm", "tip"),
    )
    assert (note.code, note.line) == ("not-modelled", 6)
    assert note.message == 'not modelled: 1 <plugin>, 1 <material>, 1 <sensor>, 1 <frame>, 1 <verbose>, 1 group="…"'
    assert tuple(map(str, note.details)) == (
        "line 6: <plugin> control",
        "line 7: <material> gazebo arm",
        "line 7: <sensor> eye",
        "line 8: <frame> n",
        "line 9: <verbose> link tip",
        'line 9: group="…" of <link>',
    )


GEAR = "<mechanicalReduction>50</mechanicalReduction>"
SIMPLE = "<type>transmission_interface/SimpleTransmission</type>"
LEFT_OUT = {
    "a sensor without a place": ('<sensor name="free" type="imu"/>', "1 <sensor>"),
    "a sensor of another kind": (
        '<ros2_control name="c" type="sensor"><sensor name="pose"><state_interface name="x"/></sensor></ros2_control>',
        "1 <sensor>",
    ),
    "of a transmission": (
        f"""<transmission name="t">{SIMPLE}<joint name="j"><role>E</role></joint>
        <actuator name="m">{GEAR}<role>E</role></actuator></transmission>""",
        "2 <role>",
    ),
    "another transmission": ('<transmission name="t"><type>Wheel</type><joint name="j"/></transmission>', "1 <type>"),
    "a gear of a joint that does not move": (
        f'<transmission name="t">{SIMPLE}<joint name="k"/><actuator name="m">{GEAR}</actuator></transmission>',
        "1 <transmission>",
    ),
    "a gear of no joint": (f'<transmission name="t"><actuator name="m">{GEAR}</actuator></transmission>',
        "1 <transmission>"),
    "of ros2_control": (
        """<ros2_control name="c" type="system"><hardware><plugin>p</plugin></hardware><gpio name="io"/>
        <joint name="j" mimic="false"><command_interface name="effort"><param name="min">-1</param></command_interface>
        <command_interface name="stiffness"/><state_interface name="position"><param name="initial_value">1</param>
        </state_interface><state_interface name="heat"/></joint><joint name="k"/></ros2_control>""",
        "1 <hardware>, 1 <gpio>, 1 <joint>, 1 <command_interface>, 1 <param>, 1 <state_interface>",
    ),
    "of a sensor": (
        """<gazebo reference="arm"><sensor name="eye" type="camera"><always_on>1</always_on><camera><image>
        <width>9</width><format>RGB8</format></image><noise><mean>0</mean></noise></camera></sensor></gazebo>""",
        "1 <always_on>, 1 <format>, 1 <noise>",
    ),
    "in a shape": (
        """<link name="l"><visual><geometry><box size="1 1 1"><convex/></box></geometry><material name="m">
        <color rgba="1 0 0 1"/><map/></material></visual></link><joint name="jl" type="fixed"><parent link="arm"/>
        <child link="l"><more/></child><origin rpy="0 0 0"><deep/></origin></joint>""",
        "1 <convex>, 1 <map>, 1 <more>, 1 <deep>",
    ),
    "many kinds of things": ("".join(f"<e{number:02}/>" for number in range(14)),
        ", ".join(f"1 <e{number:02}>" for number in range(12)) + ", 2 other kinds"),
    "beside the friction of a link": ('<link name="l"><contact><lateral_friction value="1"/><rolling_friction '
        'value="0"/></contact></link>' + joint("jl", "fixed", "arm", "l"),
        "1 <rolling_friction>"),
    "a texture": ('<material name="m"><color rgba="1 1 1 1"/><texture filename="a.png"/></material>', "1 <texture>"),
}  # fmt: skip


@pytest.mark.parametrize(("elements", "message"), LEFT_OUT.values(), ids=LEFT_OUT)
def test_what_a_model_leaves_out_is_told(elements: str, message: str) -> None:
    still = [link("tip"), joint("k", "fixed", "arm", "tip")]
    reading = read_robot(robot(*TREE, *still, elements).encode(), "a.urdf")
    assert [found.code for found in reading.diagnostics] == []
    (note,) = reading.unmodelled
    assert sorted(note.message.removeprefix("not modelled: ").split(", ")) == sorted(message.split(", "))


def extensions(element: str) -> list[tuple[str, str]]:
    reading = read_robot(robot(*TREE, element).encode(), "a.urdf")
    assert reading.robot is not None
    return [(owner, text) for owner, _, text in robot_extensions(reading.robot)]


IN_ARM = '<gazebo reference="arm">{}</gazebo>'
READ = {
    "a gear": (f'<transmission name="t"><joint name="j"/><actuator name="m">{GEAR}{{}}</actuator></transmission>',
        "transmission t"),
    "a command": ('<ros2_control name="c"><joint name="j"><command_interface name="velocity"/>{}</joint>'
        "</ros2_control>", "ros2_control c"),
    "a sensor of gazebo": (IN_ARM.format('<sensor name="i" type="imu"><pose>0 0 1 0 0 0</pose><update_rate>100'
        "</update_rate>{}</sensor>"), "gazebo arm"),
    "an image": (IN_ARM.format('<sensor name="i" type="camera"><camera><image><width>9</width>{}</image></camera>'
        "</sensor>"), "gazebo arm"),
    "a sensor of URDF": ('<sensor name="i" update_rate="1"><parent link="arm"/><ray><horizontal samples="9"/></ray>{}'
        "</sensor>", "sensor i"),
    "a wrench": (IN_ARM.format('<sensor name="i" type="force_torque"><force_torque><frame>child</frame>{}'
        "</force_torque></sensor>"), "gazebo arm"),
}  # fmt: skip


@pytest.mark.parametrize(("element", "owner"), READ.values(), ids=READ)
def test_of_an_element_that_is_read_only_the_rest_is_kept(element: str, owner: str) -> None:
    assert extensions(element.format("")) == []
    assert extensions(element.format("<n> 1 </n>")) == [(owner, "<n>1</n>")]


def test_a_robot_of_links_and_joints_has_no_note() -> None:
    assert notes('<transmission name="t"><joint name="j"/></transmission>', "<gazebo/>") == []
    namespace = robot(*TREE).replace("<robot", '<robot xmlns="http://www.ros.org" xmlns:x="urn:x"')
    assert read_robot(namespace.encode(), "a.urdf").unmodelled == ()


@pytest.mark.parametrize(("element", "code"), [
    (LOOP, "loop-joint"), (GAZEBO_LOOP, "loop-joint"), (STRAY, "stray-inertial"),
])  # fmt: skip
def test_what_moves_and_is_in_no_tree_is_an_error_unless_it_is_allowed(element: str, code: LeftOut) -> None:
    content = robot(*TREE, element).encode()
    (error,) = read_robot(content, "a.urdf").diagnostics
    assert (error.severity, error.code, error.line) == (Severity.ERROR, code, 6)
    assert f'`allow = ["{code}"]`' in error.hint
    reading = read_robot(content, "a.urdf", Options(allow=(code,)))
    assert reading.robot is not None
    assert [(one.severity, one.code, one.line) for one in reading.diagnostics] == [(Severity.WARNING, code, 6)]
    others = tuple({*get_args(LeftOut)} - {code})
    assert read_robot(content, "a.urdf", Options(allow=others)).robot is None


class Label(msgspec.Struct):
    text: str | None = None


class Switch(msgspec.Struct):
    is_on: bool = False


def test_an_attribute_may_be_a_text_or_absent() -> None:
    assert Reader({}).read(fromstring('<label text="P-7"/>'), "label", Label, "") == Label("P-7")
    assert Reader({}).read(fromstring("<label/>"), "label", Label, "") == Label(None)


def test_a_field_that_no_attribute_can_give_is_refused() -> None:
    with pytest.raises(TypeError, match=r"Switch\.is_on is of type .*bool"):
        Reader({}).read(fromstring('<switch is_on="true"/>'), "switch", Switch, "")
