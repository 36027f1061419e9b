"""What is in no model: one note names it, joints that close loops and masses in no link are errors."""

from __future__ import annotations

import pytest
from support import corpus as corpora
from support.urdfs import joint, limit, link, robot

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


GEAR = "<mechanicalReduction>50</mechanicalReduction>"
SIMPLE = "<type>transmission_interface/SimpleTransmission</type>"
LEFT_OUT = {
    "of a transmission": (
        f"""<transmission name="t">{SIMPLE}<joint name="j"><hardwareInterface>E</hardwareInterface></joint>
        <actuator name="m">{GEAR}<hardwareInterface>E</hardwareInterface></actuator></transmission>""",
        "2 transmission settings (hardwareInterface)",
    ),
    "a gear of a joint that does not move": (
        f'<transmission name="t">{SIMPLE}<joint name="k"/><actuator name="m">{GEAR}</actuator></transmission>',
        "1 transmission (t)",
    ),
    "a gear of no joint": (f'<transmission name="t"><actuator name="m">{GEAR}</actuator></transmission>',
        "1 transmission (t)"),
    "of ros2_control": (
        """<ros2_control name="c" type="system"><hardware><plugin>p</plugin></hardware><gpio name="io"/>
        <joint name="j" mimic="false"><command_interface name="effort"><param name="min">-1</param></command_interface>
        <command_interface name="stiffness"/><state_interface name="position"><param name="initial_value">1</param>
        </state_interface><state_interface name="heat"/></joint><joint name="k"/></ros2_control>""",
        "8 ros2_control settings (hardware, gpio io, joint mimic, …)",
    ),
    "a gear of ros2_control": (
        f"""<ros2_control name="c" type="system"><transmission name="t"><joint name="k"/>
        <actuator name="m">{GEAR}</actuator></transmission></ros2_control>""",
        "1 transmission (t)",
    ),
    "of a sensor": (
        """<gazebo reference="arm"><sensor name="eye" type="camera"><always_on>1</always_on><camera><image>
        <width>9</width><format>RGB8</format></image><noise><mean>0</mean></noise></camera></sensor></gazebo>""",
        "3 sensor settings (always_on, format, noise)",
    ),
    "of a sensor of URDF": (
        """<sensor name="eye" update_rate="3" id="4"><parent link="arm"/><origin xyz="0 0 1"/><camera><image
        width="9" height="8" hfov="1" near="0" far="1" format="RGB8"/></camera><plugin name="p"/></sensor>""",
        "2 sensor settings (sensor id, image format), 1 gazebo plugin (p)",
    ),
    "in a shape": (
        """<link name="l"><visual><geometry><box size="1 1 1"><convex/></box></geometry><material name="m">
        <color rgba="1 0 0 1"/><map/></material></visual></link><joint name="jl" type="fixed"><parent link="arm"/>
        <child link="l"><more/></child><origin drake:x="1" rpy="0 0 0"><deep/></origin></joint>""",
        "1 <convex> (link l), 1 <map> (link l), 1 <more> (joint jl), 1 <deep> (joint jl), 1 attribute (origin drake:x)",
    ),
    "of gazebo": ('<gazebo reference="arm" filter="x"><n/></gazebo>', "2 gazebo settings (gazebo filter, n)"),
    "an attribute of a geometry": ('<link name="l"><visual><geometry name="g"><box size="1 1 1"/></geometry></visual>'
        "</link>" + joint("jl", "fixed", "arm", "l"), "1 attribute (geometry name)"),
    "limits of joints without": (
        link("l") + link("m", 1.0) + joint("jl", "fixed", "arm", "l", inside=[limit()])
        + joint("jm", "continuous", "arm", "m", inside=[limit()]),
        "2 ineffective limits (joint jl, joint jm)",
    ),
    "many kinds of things": ("".join(f"<e{number}/>" for number in range(14)),
        ", ".join(f"1 <e{number}>" for number in range(12)) + ", 2 other kinds of things"),
    "of a contact": ('<link name="l"><collision><geometry><sphere radius="1"/></geometry><contact_coefficients mu="1"'
        ' restitution="1"/></collision></link>' + joint("jl", "fixed", "arm", "l"),
        "1 attribute (contact_coefficients restitution)"),
    "beside the friction of a link": ('<link name="l"><contact id="1"><lateral_friction value="1"/><rolling_friction '
        'value="0"/></contact></link>' + joint("jl", "fixed", "arm", "l"),
        "2 contact settings (contact id, rolling_friction)"),
    "a texture": (
        '<material name="m"><color rgba="1 1 1 1"/><texture filename="a.png"/></material>', "1 <texture> (a.png)"
    ),
}  # fmt: skip


@pytest.mark.parametrize(("elements", "message"), LEFT_OUT.values(), ids=LEFT_OUT)
def test_what_a_model_leaves_out_is_named(elements: str, message: str) -> None:
    still = [link("tip"), joint("k", "fixed", "arm", "tip")]
    reading = read_robot(robot(*TREE, *still, elements).encode(), "a.urdf")
    assert [found.code for found in reading.diagnostics if found.code != "xml-prefix"] == []
    assert [note.message for note in reading.unmodelled] == [f"not modelled: {message}"]


def extensions(element: str) -> list[str]:
    reading = read_robot(robot(*TREE, element).encode(), "a.urdf")
    assert reading.robot is not None
    return [extension.text for extension in reading.robot.extensions]


IN_ARM = '<gazebo reference="arm">{}</gazebo>'
MODELLED = {
    "a gear": (f'<transmission name="t"><joint name="j"/>{GEAR}</transmission>', "50", "60"),
    "a command": ('<ros2_control name="c"><joint name="j"><command_interface name="velocity"/></joint></ros2_control>',
        "velocity", "effort"),
    "a number": (IN_ARM.format('<sensor name="i" type="imu"><update_rate>100</update_rate><n/></sensor>'), "100", "99"),
    "a pose": (IN_ARM.format('<sensor name="i" type="imu"><pose>0 0 1 0 0 0</pose><n/></sensor>'), "0 0 1", "0 0 2"),
    "an image": (IN_ARM.format('<sensor name="i" type="camera"><camera><image><width>9</width></image></camera><n/>'
        "</sensor>"), "9", "8"),
    "an attribute": ('<sensor name="i" update_rate="1" n="0"><parent link="arm"/><ray><horizontal samples="9"/></ray>'
        "</sensor>", 'samples="9"', 'samples="8"'),
    "a place": ('<sensor name="i" type="imu" n="0"><parent link="arm"/></sensor>', "arm", "base"),
    "a wrench": (IN_ARM.format('<sensor name="i" type="force_torque"><force_torque><frame>child</frame></force_torque>'
        "<n/></sensor>"), "child", "parent"),
}  # fmt: skip


@pytest.mark.parametrize(("element", "old", "new"), MODELLED.values(), ids=MODELLED)
def test_what_is_modelled_is_not_in_the_text_that_is_kept(element: str, old: str, new: str) -> None:
    assert element.count(old) >= 1
    found = extensions(element)
    assert len(found) == 1
    assert found == extensions(element.replace(old, new, 1))


def test_an_element_that_is_modelled_as_a_whole_is_not_kept() -> None:
    assert extensions(IN_ARM.format('<sensor name="i" type="imu"><pose>0 0 1 0 0 0</pose></sensor>')) == []


def test_more_than_three_names_are_cut_off() -> None:
    (note,) = notes(*(f'<gazebo><plugin name="p{number}"/></gazebo>' for number in range(5)))
    assert note.message == "not modelled: 5 gazebo plugins (p0, p1, p2, …)"
    assert len(note.details) == 5


def test_a_robot_of_links_and_joints_has_no_note() -> None:
    assert notes('<transmission name="t"><joint name="j"/></transmission>', "<gazebo/>") == []
    namespace = robot(*TREE).replace("<robot", '<robot xmlns="http://www.ros.org" xmlns:x="urn:x"')
    assert read_robot(namespace.encode(), "a.urdf").unmodelled == ()


def test_an_orientation_as_quaternion_is_modelled() -> None:
    turned = link("tip") + joint("k", "fixed", "arm", "tip", inside=['<origin quat_xyzw="0 0 1 1"/>'])
    content = robot(*TREE, turned).replace("<robot", '<robot version="1.1"')
    assert read_robot(content.encode(), "a.urdf").unmodelled == ()


def test_a_prefix_that_is_declared_where_it_is_used_says_nothing_of_the_robot() -> None:
    rotor = '<drake:rotor_inertia xmlns:drake="urn:drake" value="1e-4"/>'
    element = (
        f'<transmission name="t" xmlns:x="urn:x"><joint name="j"/><actuator name="m">{rotor}</actuator></transmission>'
    )
    assert notes(element, '<gazebo xmlns:y="urn:y"/>') == []


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
