"""Reading a URDF: values and defaults, tolerated oddities, and one diagnostic per fault with its line."""

from __future__ import annotations

import gzip
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.numbers import compare, differences
from support.robots import robot_extensions

from urdfsync.common.diagnostics import Severity
from urdfsync.formats.urdf.parse.fields import parse_numbers
from urdfsync.formats.urdf.parse.source import RobotReading, read_robot
from urdfsync.formats.urdf.robot import (
    Box,
    Calibration,
    Collision,
    Cylinder,
    Dynamics,
    Inertia,
    Inertial,
    Joint,
    Limit,
    Link,
    Material,
    Mesh,
    Mimic,
    Origin,
    Robot,
    SafetyController,
    Visual,
)

ARM = """<?xml version="1.0" encoding="utf-8"?>
<!-- äöü: three letters of two bytes each -->
<robot name="arm" xmlns:q="urn:q">
  <material name="blue"><color rgba="0 0 1 1"/></material>
  <link name="base"/>
  <link name="arm">
    <inertial>
      <origin xyz="0 0 .5" rpy="0 0 1e-1"/>
      <mass value="+2."/>
      <inertia ixx="3" ixy="0" ixz="-0" iyy="3" iyz="0" izz="1"/>
    </inertial>
    <visual name="tube">
      <origin xyz="0 0 0.5"/>
      <geometry><cylinder radius="0.1" length="1"/></geometry>
      <material name="blue"/>
    </visual>
    <visual><geometry><mesh filename="package://p/a.stl" scale="1 1 -1"/></geometry></visual>
    <collision><geometry><box size="1 2 3"/></geometry></collision>
  </link>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="arm"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/>
    <dynamics damping="0.5"/>
    <calibration rising="0.1"/>
    <safety_controller k_velocity="1" k_position="2" soft_lower_limit="-0.9" soft_upper_limit="0.9"/>
  </joint>
  <q:note><![CDATA[a < b]]></q:note>
</robot>
"""


def read(text: str) -> RobotReading:
    return read_robot(text.encode(), "a.urdf")


def robot_of(text: str) -> Robot:
    """The robot of a text that must be readable without a word."""
    reading = read(text)
    assert reading.diagnostics == ()
    assert reading.robot is not None
    return reading.robot


def findings(text: str) -> list[tuple[str, str, int]]:
    return [(str(d.severity), d.code, d.line) for d in read(text).diagnostics]


def in_link(inner: str) -> str:
    return f'<robot name="r">\n<link name="a">\n{inner}\n</link>\n</robot>'


def in_visual(inner: str) -> str:
    return in_link(f"<visual>{inner}</visual>")


def with_joint(inner: str, kind: str = "revolute") -> str:
    ends = '<parent link="a"/><child link="b"/>'
    joint = f'<joint name="j" type="{kind}">{ends}\n{inner}\n</joint>'
    return f'<robot name="r">\n<link name="a"/><link name="b"/>\n{joint}\n</robot>'


def of_version(version: str, text: str) -> str:
    return text.replace("<robot", f'<robot version="{version}"', 1)


def only_joint(inner: str, kind: str = "revolute") -> Joint:
    (joint,) = robot_of(with_joint(inner, kind)).joints
    return joint


def test_a_whole_robot() -> None:
    blue = Material("blue", (0.0, 0.0, 1.0, 1.0))
    tube = Visual(Cylinder(0.1, 1.0), Origin((0.0, 0.0, 0.5)), "tube", blue)
    arm = Link(
        "arm",
        Inertial(2.0, Origin((0.0, 0.0, 0.5), (0.0, 0.0, 0.1)), Inertia(ixx=3.0, iyy=3.0, izz=1.0)),
        (tube, Visual(Mesh("package://p/a.stl", (1.0, 1.0, -1.0)))),
        (Collision(Box((1.0, 2.0, 3.0))),),
    )
    turn = Joint(
        "turn",
        "revolute",
        "base",
        "arm",
        axis=(0.0, 0.0, 1.0),
        limit=Limit(-1.0, 1.0, 10.0, 2.0),
        dynamics=Dynamics(damping=0.5),
        calibration=Calibration(rising=0.1),
        safety_controller=SafetyController(1.0, 2.0, -0.9, 0.9),
    )
    note = {"": {"q:note": ("<q:note>a &lt; b</q:note>",)}}
    assert robot_of(ARM) == Robot("arm", (Link("base"), arm), (turn,), note)


def test_lines_of_elements() -> None:
    lines = read(ARM).lines
    expected = {
        "robot": 3,
        "link base": 5,
        "link arm": 6,
        "link arm / inertial": 7,
        "link arm / inertial / mass": 9,
        "link arm / visual 1": 12,
        "link arm / visual 1 / material": 15,
        "link arm / visual 2 / mesh": 17,
        "link arm / collision 1": 18,
        "joint turn": 20,
        "joint turn / limit": 23,
    }
    assert {path: lines[path] for path in expected} == expected


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32"])
@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
def test_encodings_and_line_ends(encoding: str, line_end: str) -> None:
    text = ARM.replace("utf-8", encoding.removesuffix("-sig")).replace("\n", line_end)
    reading = read_robot(text.encode(encoding), "a.urdf")
    assert reading.diagnostics == ()
    assert reading.robot == robot_of(ARM)
    assert reading.lines == read(ARM).lines


@pytest.mark.parametrize(("declaration", "code"), [
    ("<?xml version='0.0'?>", "xml-declaration"),
    (" <?xml version='1.0'?>", "xml-declaration"),
    ("<?xml version=1.0?>", "xml-declaration"),
    ("<?XML version='1.0'?>", "xml-declaration"),
    ("<?xml encoding='utf-8' version='1.0'?>", "xml-declaration"),
    ("<?xml version='1.0'encoding='utf-8'?>", "xml-declaration"),
    ("<?xml verison='1.0'\r\n?>", "xml-declaration"),
    ('<?xml version="1.0" encoding="utf-16"?>', "xml-declaration"),
])  # fmt: skip
def test_a_wrong_declaration_is_tolerated(declaration: str, code: str) -> None:
    reading = read(f"{declaration}<robot name='cart'>\r\n<link name='bödy'/></robot>")
    assert reading.robot == Robot("cart", (Link("bödy"),))
    assert [(d.severity, d.code, d.line) for d in reading.diagnostics] == [(Severity.WARNING, code, 1)]


def test_only_a_declaration_without_faults_names_the_encoding() -> None:
    text = "<?xml version='1.0' encoding='iso-8859-1'?><robot name='ä'><link name='ö'/></robot>"
    assert read_robot(text.encode("latin-1"), "a.urdf").robot == Robot("ä", (Link("ö"),))
    (found,) = (d for d in read_robot(f"\n{text}".encode("latin-1"), "a.urdf").diagnostics if d.severity == "error")
    assert (found.code, found.line) == ("file-encoding", 2)


def test_undeclared_prefixes_are_tolerated() -> None:
    text = ARM.replace(' xmlns:q="urn:q"', "").replace("</robot>", '<q:b p:z="1"/>\n<p:c/></robot>')
    reading = read(text)
    assert reading.diagnostics == ()
    assert reading.robot is not None
    assert [text for *_, text in robot_extensions(reading.robot)] == [
        "<p:c></p:c>",
        '<q:b p:z="1"></q:b>',
        "<q:note>a &lt; b</q:note>",
    ]
    assert reading.robot.links == robot_of(ARM).links


def test_a_default_namespace_does_not_hide_the_elements() -> None:
    assert robot_of('<robot name="r" xmlns="http://www.ros.org"><link name="a"/></robot>').links == (Link("a"),)


DEEP = b"<origin>" * 254, b"</origin>" * 254
LAUGHS = '<!DOCTYPE robot [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;">]>'


@pytest.mark.parametrize(
    ("content", "code", "line"),
    [
        (b"", "file-empty", 1),
        (b"\0" * 512, "file-empty", 1),
        (b" \r\n\t\n", "file-empty", 1),
        (b"\xef\xbb\xbf", "file-empty", 1),
        (b"<robot/>\n<robot/>", "xml-syntax", 2),
        (b"<robot>\n<link>\n</robot>", "xml-syntax", 3),
        (b"<robot>\n<x:y></robot>", "xml-syntax", 2),
        (b"<!DOCTYPE robot SYSTEM 'a.dtd'>\n<robot>\n&e;</robot>", "xml-entity", 1),
        (b"<robot name='r'>\n<link name='a'><visual>%b%b</visual></link></robot>" % DEEP, "xml-syntax", 2),
        (b"robot: yes", "xml-syntax", 1),
        (b"<robot>\n\n  <link name='\xe4'/></robot>", "file-encoding", 3),
        (gzip.compress(b"<robot name='r'/>", mtime=0), "compressed", 1),
        (b"/**:\n  ros__parameters:\n    robot_description: |\n      <robot name='r'/>\n", "robot-description", 3),
        (b'{"robot_description": "<robot/>"}', "robot-description", 1),
        (b"<!-- a -->\n<launch>\n<param name='robot_description'/></launch>", "launch-file", 2),
        (b"from launch import LaunchDescription\n\ndef generate(): ...\n", "launch-file", 1),
        (b"%YAML 1.2\n---\nlaunch:\n\n- node:\n    pkg: a\n", "launch-file", 3),
        (b"<?xml version='1.0' encoding='klingon'?><robot/>", "file-encoding", 1),
        (b"<?xml version='1.0' encoding='rot13'?><robot/>", "file-encoding", 1),
        (b"<?xml version='1.0' encoding='idna'?><robot>\xff</robot>", "file-encoding", 1),
        (b"<?xml version='1.0' encoding='punycode'?><robot/>", "file-encoding", 1),
        (b"<?xml version='1.0' encoding='undefined'?><robot/>", "file-encoding", 1),
        (b"<?xml version='1.0' encoding='utf-7'?><robot name='+2AA-'/>", "file-encoding", 1),
        (b"<!-- cart -->\n<?xml version='1.0'?>\n<robot/>", "xml-syntax", 2),
        (b"<?xml version='1.0'>\n<robot/>", "xml-syntax", 1),
        (f"{LAUGHS}<robot name='r'>&b;</robot>".encode(), "xml-entity", 1),
        (f"\n{LAUGHS}<robot name='&b;'/>".encode(), "xml-entity", 2),
        (b"<!DOCTYPE robot [<!ENTITY a SYSTEM 'file:///etc/passwd'>]><robot/>", "xml-entity", 1),
        (b"<robot>\n<<<<<<< HEAD\n<link name='a'/>\n=======\n>>>>>>> b\n</robot>", "merge-conflict", 2),
        (b"<robot name='r'>\r\n<link name='a'/>\r\n>>>>>>> b\r\n</robot>", "merge-conflict", 3),
        (b"<<<<<<< HEAD\n<robot name='r'>\n<link name='a'/></robot>", "merge-conflict", 1),
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "lfs-pointer", 1),
        (b"<robot name='r' xmlns:drake='d'>\n<link name='a'/>\n<drake:joint/></robot>", "unknown-joint-type", 3),
        (b"<sdf version='1.9'/>", "not-urdf", 1),
        (b"<!-- a -->\n<mujoco model='m'/>", "not-urdf", 2),
        (b"<robot name='r' xmlns:xacro='x'>\n<xacro:macro name='m'/>\n<link name='a'/></robot>", "xacro-source", 2),
        (b"<robot name='r'>\n<xacro:leg side='left'/></robot>", "xacro-source", 2),
        (b"<robot name='r'>\n<link name='a'><visual>\n<origin xyz='${h}'/></visual></link></robot>", "xacro-source", 3),
    ],
)  # fmt: skip
def test_a_file_that_is_no_urdf_is_one_error(content: bytes, code: str, line: int) -> None:
    reading = read_robot(content, "a.urdf")
    assert reading.robot is None
    assert [
        (d.severity, d.code, d.file, d.line) for d in reading.diagnostics if d.severity is not Severity.WARNING
    ] == [(Severity.ERROR, code, "a.urdf", line)]
    assert all(d.hint for d in reading.diagnostics)


@pytest.mark.parametrize(("text", "message"), [
    ("<link name='R&D'/>", "not well-formed (invalid token)"),
    ("<mass value='&kg;'/>", "undefined entity"),
    ("<visual><origin></visual>", "<origin> of line 2 is not closed"),
    ("<a>" * 300 + "</a>" * 300, "elements are nested 256 deep"),
])  # fmt: skip
def test_what_is_wrong_in_xml_is_said(text: str, message: str) -> None:
    (found,) = read(f"<robot name='r'>\n{text}</robot>").diagnostics
    assert (found.code, found.line, found.column > 0) == ("xml-syntax", 2, "deep" not in message)
    assert found.message == f"this is not well-formed XML: {message}"
    assert "`&` is written `&amp;`" in found.hint
    assert found.hint.endswith(", or wait until the export is complete")


def test_an_xml_declaration_below_a_comment_is_to_be_moved_up() -> None:
    (found,) = read("<!-- licence -->\n<?xml version='1.0'?>\n<robot name='r'/>").diagnostics
    assert (found.code, found.line) == ("xml-syntax", 2)
    assert found.hint == "put <?xml … ?> at the beginning of the file, above all comments"


def test_what_looks_like_a_fault_in_a_comment_is_none() -> None:
    comment = "<!--\n<<<<<<< HEAD\n<!ENTITY a 'b'> ${x} <link name='no'/>\n-->"
    robot = robot_of(f'<!DOCTYPE robot>\n<robot name="r">{comment}<link name="a"/></robot>')
    assert robot.links == (Link("a"),)


INERTIA = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'


FAULTS = [
    ('<robot name="r">\n</robot>', "no-link", 1),
    ('<robot name="r">\n<link/></robot>', "missing-attribute", 2),
    ('<robot name="r">\n<link name=" "/></robot>', "empty-attribute", 2),
    (with_joint("", "fixed").replace(' type="fixed"', ""), "missing-attribute", 3),
    (with_joint("", "fixed").replace('<parent link="a"/>', ""), "missing-element", 3),
    (with_joint("", "fixed").replace('<child link="b"/>', "\n<child/>"), "missing-attribute", 4),
    (with_joint("", "revolut"), "unknown-joint-type", 3),
    (with_joint('<axis xyz="0 0"/>', "continuous"), "bad-number", 4),
    (with_joint('<limit lower="" upper="1" effort="1" velocity="1"/>'), "empty-attribute", 4),
    (with_joint('<mimic/>', "continuous"), "missing-attribute", 4),
    (with_joint('<dynamics damping="1 2"/>', "continuous"), "bad-number", 4),
    (with_joint('<origin xyz="nan 0 0"/>', "fixed"), "bad-number", 4),
    (of_version("1", with_joint("", "fixed")), "bad-version", 1),
    (of_version("2.0", with_joint("", "fixed")), "bad-version", 1),
    (of_version("", with_joint("", "fixed")), "bad-version", 1),
    (of_version("1." + "9" * 5000, with_joint("", "fixed")), "bad-version", 1),
    (of_version("1.1", with_joint('<origin quat_xyzw="0 0 1"/>', "fixed")), "bad-number", 4),
    (of_version("1.1", with_joint('<origin quat_xyzw="0 0 0 -0"/>', "fixed")), "bad-number", 4),
    (of_version("1.1", with_joint('<origin rpy="0 0 0" quat_xyzw="0 0 0 1"/>', "fixed")), "two-orientations", 4),
    (of_version("1.2", with_joint('<limit upper="1"/>')), "missing-attribute", 4),
    (of_version("1.2", with_joint('<limit lower="0" upper="1" jerk="inf"/>')), "bad-number", 4),
    (in_visual('\n<geometry><cylinder length="1"/></geometry>'), "missing-attribute", 4),
    (in_visual('\n<geometry><mesh/></geometry>'), "missing-attribute", 4),
    (in_visual('\n<geometry><mesh filename="a.stl" scale="0.001"/></geometry>'), "bad-number", 4),
]  # fmt: skip
ODDITIES = [
    ('<robot>\n<link name="a"/></robot>', "missing-name", 1),
    (in_link("<visual nme='v'><geometry><sphere radius='1'/></geometry></visual>"), "unknown-attribute", 3),
    (with_joint(""), "missing-limit", 3),
    (of_version("1.3", with_joint("", "fixed")), "newer-version", 1),
    (with_joint('<origin quat_xyzw="0 0 1 0" rpy="1 0 0"/>', "fixed"), "newer-attribute", 4),
    (of_version("1.1", with_joint('<limit lower="0" upper="1" effort="1" velocity="1" acceleration="fast"/>')),
     "newer-attribute", 4),
    (of_version("1.2", with_joint('<limit lower="0" upper="1" deceleration="-1"/>')), "negative-limit", 4),
    (with_joint('<limit effort="1" velocity="1"/>'), "missing-limit-value", 4),
    (with_joint('<limit velocity="1"/>', "continuous"), "missing-limit-value", 4),
    (with_joint('<limit lower="0" upper="1" effort="1" velocity="1"/>\n<dynamics dampin="1" friction="1"/>'),
     "unknown-attribute", 5),
    (with_joint("<dynamic/>", "continuous"), "unknown-element", 4),
    (with_joint('<safety_controller k_position="1"/>', "continuous"), "missing-gain", 4),
    (with_joint('<origin/>\n<origin xyz="1 0 0"/>', "fixed"), "duplicate-element", 5),
    (in_link(f"<inertial>{INERTIA}</inertial>"), "missing-mass", 3),
    (in_link('<inertial><mass value="1"/></inertial>'), "missing-inertia", 3),
    (in_link('<inertial><mass value="1"/>\n<inertia ixx="1" iyy="1" izz="1"/></inertial>'), "missing-inertia", 4),
    (in_link("<visual/>"), "unknown-geometry", 3),
    (in_visual("<geometry/>"), "unknown-geometry", 3),
    (in_visual("<geometry><plane/></geometry>"), "unknown-geometry", 3),
    (in_visual('<geometry><sphere radius="1"/><sphere radius="2"/></geometry>'), "duplicate-element", 3),
    (in_visual('<geometry><sphere radius="1"/></geometry>\n<material name="m"/>'), "unknown-material", 4),
    (in_visual('<geometry><sphere radius="1"/></geometry>\n<material name=""><color/></material>'), "bad-color", 4),
    (in_visual('<geometry><sphere radius="1"/></geometry>\n<material name=""><color rgba="1 1 1"/></material>'),
     "bad-color", 4),
    (in_visual('<geometry><sphere radius="1"/></geometry>\n<material name=""><color rgba="255 0 0 1"/></material>'),
     "color-range", 4),
    ('<robot name="r">\n<xacro:arg name="b" xmlns:xacro="x"/>\n<link name="a"/></robot>', "xacro-leftover", 2),
    ('<robot name="r">\n<link name="${n}a"/></robot>', "xacro-leftover", 2),
]  # fmt: skip


@pytest.mark.parametrize(
    ("severity", "text", "code", "line"),
    [*(("error", *fault) for fault in FAULTS), *(("warning", *oddity) for oddity in ODDITIES)],
)
def test_a_fault_of_the_model_is_one_error_and_an_oddity_one_warning(
    severity: str, text: str, code: str, line: int
) -> None:
    reading = read(text)
    assert (reading.robot is None) == (severity == "error")
    assert [(str(d.severity), d.code, d.line) for d in reading.diagnostics] == [(severity, code, line)]
    assert all(d.hint for d in reading.diagnostics)


def test_all_faults_are_told_in_the_order_of_lines() -> None:
    text = """<robot name="r">
        <link name="a"><visual><geometry><box size="1 2"/></geometry></visual></link>
        <link name="a"/>
        <joint name="j" type="wobbly"><parent link="a"/><child link="c"/></joint>
        <joint name="k" type="fixed"><origin xyz="0 1,5 0"/><parent link="d"/><child link="a"/></joint>
        </robot>"""
    assert findings(text) == [
        ("error", "bad-number", 2),
        ("error", "duplicate-link", 3),
        ("error", "unknown-joint-type", 4),
        ("error", "unknown-child", 4),
        ("error", "bad-number", 5),
        ("error", "unknown-parent", 5),
    ]


def test_many_warnings_of_a_kind_are_told_once() -> None:
    visuals = '\n<visual><geometry><sphere radius="1"/></geometry><material name="m"/></visual>' * 12
    (diagnostic,) = read(in_link(visuals)).diagnostics
    assert (diagnostic.code, diagnostic.line) == ("unknown-material", 4)
    assert diagnostic.statement.endswith("(and 11 more like it: lines 5, 6, 7, 8, 9, 10, 11, 12, …)")


LEADER = '<link name="c"/><joint name="k" type="continuous"><parent link="b"/><child link="c"/></joint></robot>'


@pytest.mark.parametrize(("inner", "expected"), [
    ("<origin/><axis/>", Joint("j", "continuous", "a", "b")),
    ("<limit/>", Joint("j", "continuous", "a", "b", limit=Limit(0.0, 0.0, None, None))),
    ('<limit upper="2" effort="0"/>', Joint("j", "continuous", "a", "b", limit=Limit(0.0, 2.0, 0.0, None))),
    ("<dynamics/>", Joint("j", "continuous", "a", "b", dynamics=Dynamics(0.0, 0.0))),
    ('<mimic joint="k"/>', Joint("j", "continuous", "a", "b", mimic=Mimic("k", 1.0, 0.0))),
])  # fmt: skip
def test_defaults_of_a_joint(inner: str, expected: Joint) -> None:
    robot = read(with_joint(inner, "continuous").replace("</robot>", LEADER)).robot
    assert robot is not None
    assert robot.joints[0] == expected
    assert only_joint('<axis xyz="0 0 0"/>', "fixed").axis == (1.0, 0.0, 0.0)


SPHERE = '<geometry><sphere radius="1"/></geometry>'
RED = '<color rgba="1 0 0 1"/>'


def materials(text: str) -> list[Material | None]:
    robot = read(text).robot
    assert robot is not None
    return [visual.material for link in robot.links for visual in link.visuals]


def test_materials_are_looked_up_through_the_whole_robot() -> None:
    text = in_link(
        f'<visual>{SPHERE}<material name="inline"/></visual>'
        f'<visual>{SPHERE}<material name="inline">{RED}</material></visual>'
        f'<visual>{SPHERE}<material name="global"/></visual>'
        f'<visual>{SPHERE}<material name="">{RED}</material></visual>'
        f'<visual>{SPHERE}<material name=""/></visual>'
        f"<visual>{SPHERE}</visual>"
    ).replace("</robot>", '<material name="global"><texture filename="a.png"/></material></robot>')
    red = (1.0, 0.0, 0.0, 1.0)
    assert findings(text) == []
    assert materials(text) == [
        Material("inline", red),
        Material("inline", red),
        Material("global"),
        Material("", red),
        None,
        None,
    ]


def test_the_first_definition_of_a_material_counts_and_those_of_the_robot_come_first() -> None:
    again = f'<visual>{SPHERE}<material name="m"><color rgba="0 1 0 1"/></material></visual>'
    text = in_link(again).replace("</robot>", f'<material name="m">{RED}</material></robot>')
    assert materials(text) == [Material("m", (1.0, 0.0, 0.0, 1.0))]
    assert findings(text) == [("warning", "material-redefined", 3)]


def test_extensions_are_kept_with_their_place_in_canonical_form() -> None:
    text = """<robot name="r" xmlns:drake="urn:drake" xmlns:other="urn:other">
      <link name="a">
        <touch b="2" a="&lt;1>"> <!-- no --> <stiffness value="3"/> </touch>
        <collision><geometry><sphere radius="1"/></geometry><surface/></collision>
      </link>
      <transmission name="t"><type> simple </type></transmission>
      <drake:filter/><q xmlns:p="u" p:b="2" p:a="1"/>one text<a> b <c/> d </a>and another
    </robot>"""
    assert robot_extensions(robot_of(text)) == [
        ("", "a", "<a>b<c></c>d</a>"),
        ("", "drake:filter", "<drake:filter></drake:filter>"),
        ("", "q", '<q p:a="1" p:b="2" xmlns:p="u"></q>'),
        ("", "transmission", '<transmission name="t"><type>simple</type></transmission>'),
        ("link a", "surface", "<surface></surface>"),
        ("link a", "touch", '<touch a="&lt;1&gt;" b="2"><stiffness value="3"></stiffness></touch>'),
    ]


@pytest.mark.parametrize(
    "element", ['<q xmlns:p=""></q>', '<q xmlns:xml="a"></q>', "<xmlns:q></xmlns:q>", "<a:b:c></a:b:c>", "<:a></:a>"]
)
def test_an_element_with_faulty_namespaces_is_kept(element: str) -> None:
    robot = read(f'<robot name="r"><link name="a"/>{element}<z/></robot>').robot
    assert robot is not None
    assert [text for *_, text in robot_extensions(robot)] == [element, "<z></z>"]


NUMBERS = {
    " 0\n": (0,), "-1": (-1,), "+.5": (0.5,), "1.": (1,), "1e3": (1000,), "-1.5E+10": (-1.5e10,), "1e-400": (0,),
    "00012": (12,), "1\t2\n  3 ": (1, 2, 3),
}  # fmt: skip


def test_decimal_numbers() -> None:
    assert {text: parse_numbers(text, len(numbers)) for text, numbers in NUMBERS.items()} == NUMBERS
    assert math.copysign(1, parse_numbers("-0.0", 1)[0]) == 1


NO_NUMBERS = "nan inf -inf infinity 1_000 0x10 0x1p3 1,5 1e e5 . - --1 1.2.3 1d3 ½ １ 1\N{NO-BREAK SPACE}2 ${x} 1f True"


@pytest.mark.parametrize(("text", "count", "message"), [
    *((word, 1, "is not a decimal number") for word in NO_NUMBERS.split(" ")),
    *((text, 3, "numbers instead of 3") for text in ("1 2", "1 2 3 4", "")),
    ("1", 3, "has 1 number instead of 3"),
    ("1e999", 1, "too large"),
])  # fmt: skip
def test_what_is_no_decimal_number(text: str, count: int, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        parse_numbers(text, count)


def test_long_words_are_judged_at_once_and_shown_in_brief() -> None:
    (diagnostic,) = read(with_joint(f'<axis xyz="0 0 {"1" * 200_000}e"/>', "continuous")).diagnostics
    assert diagnostic.code == "bad-number"
    assert len(diagnostic.message) < 250


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_are_read_exactly(value: float) -> None:
    assert parse_numbers(repr(value), 1) == (value,)


def test_a_quaternion_is_an_orientation_since_urdf_1_1() -> None:
    """Of any length; an older file has none, as for ROS."""
    text = with_joint('<origin xyz="1 2 3" quat_xyzw="0 0 2 2"/>', "fixed")
    (joint,) = robot_of(of_version("1.1", text)).joints
    assert joint.origin.xyz == (1.0, 2.0, 3.0)
    assert joint.origin.rpy == pytest.approx((0.0, 0.0, math.pi / 2), abs=1e-15)
    older = read(text).robot
    assert older is not None
    assert older.joints[0].origin.rpy == (0.0, 0.0, 0.0)
    assert differences(text.encode()) == differences(of_version("1.1", text).encode()) == []


def test_limits_of_urdf_1_2() -> None:
    limit = '<limit lower="0" upper="1" acceleration="2" deceleration="3" jerk="4"/>'
    (joint,) = robot_of(of_version("1.2", with_joint(limit))).joints
    assert joint.limit == Limit(0.0, 1.0, acceleration=2.0, deceleration=3.0, jerk=4.0)
    older = read(with_joint(limit)).robot
    assert older is not None
    assert older.joints[0].limit == Limit(0.0, 1.0)
    drake = '<limit lower="0" upper="1" effort="1" velocity="1" drake:acceleration="2"/>'
    assert only_joint(drake).limit == Limit(0.0, 1.0, 1.0, 1.0, acceleration=2.0)
    for version, inner in (("1.0", drake), ("1.1", limit), ("1.2", limit)):
        numbers = compare(of_version(version, with_joint(inner)).encode(), approach=("package",))
        assert (numbers.differences, numbers.uncompared) == ((), ())
