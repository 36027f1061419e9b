"""What URDF does not have is told: by name where it would move the robot, in the counted note elsewhere."""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.etree.ElementTree import Element, SubElement, fromstring, tostring

import pytest
from support.urdfs import joint, link, robot

from urdfsync.common.diagnostics import Severity
from urdfsync.formats.urdf.options import LoopOption, Options
from urdfsync.formats.urdf.parse import xml
from urdfsync.formats.urdf.parse.source import RobotReading, read_robot
from urdfsync.formats.urdf.robot import Inertia, Inertial, Joint, Limit, Origin

ROBOT = """<robot name="r" version="1.2"><link name="base"/><link name="arm">
<inertial><origin xyz="0 0 1"/><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<visual><origin xyz="0 0 1"/><geometry><mesh filename="a.stl"/></geometry>
<material name="m"><color rgba="1 0 0 1"/></material></visual>
<collision><geometry><sphere radius="1"/></geometry></collision><contact><stiffness value="9"/></contact></link>
<joint name="j" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1"/><dynamics damping="1"/><calibration rising="1"/><safety_controller k_velocity="1"/></joint>
<link name="tip"/><joint name="k" type="continuous"><parent link="arm"/><child link="tip"/><mimic joint="j"/></joint>
<transmission name="t"><joint name="j"/><actuator name="m"/></transmission>
<gazebo reference="j"><provideFeedback>1</provideFeedback></gazebo>
<sensor name="s" type="imu"><parent link="arm"/><origin xyz="0 0 1"/></sensor>
<link name="far"/><joint name="l" type="continuous"><parent link="base"/><child link="far"/></joint>
<loop_joint name="loop" type="revolute"><link1 link="arm"/><link2 link="far" xyz="0 0 1"/>
<axis xyz="0 0 1"/></loop_joint>
</robot>"""
MOVES = """
    joint parent child origin axis limit dynamics mimic inertial mass inertia transmission actuator
    loop_joint link1 link2
""".split()
STILL = "robot link visual collision geometry sphere mesh material color calibration safety_controller sensor".split()
PLACES = sorted({part.tag for part in fromstring(ROBOT).iter()})


def read(root: Element | str, options: Options | None = None) -> RobotReading:
    text = root if isinstance(root, str) else tostring(root, "unicode")
    return read_robot(text.encode(), "a.urdf", options or Options())


def told(reading: RobotReading, name: str) -> str:
    """What becomes of a name: warned, counted, or read without a word."""
    if any(re.search(rf"(^|\W){re.escape(name)}\W", found.message) for found in reading.diagnostics):
        return "warned"
    return "counted" if any(name in found.message for found in reading.unmodelled) else "read"


def test_the_robot_of_this_test_has_all_elements_and_no_warning() -> None:
    reading = read(ROBOT)
    assert reading.robot is not None
    assert (reading.diagnostics, [found.message for found in reading.unmodelled]) == (
        (),
        ["not modelled: 1 <provideFeedback>"],
    )
    assert set(MOVES) | set(STILL) <= set(PLACES)


@pytest.mark.parametrize("place", [*MOVES, *STILL])
def test_an_invented_attribute_is_told_in_each_place(place: str) -> None:
    root = fromstring(ROBOT)
    part = next(root.iter(place))
    part.set("invented", "7")
    reading = read(root)
    assert told(reading, "invented") == ("warned" if place in MOVES else "counted")
    assert reading.robot is not None
    if place in MOVES:
        assert (reading.diagnostics[0].code, reading.diagnostics[0].line > 1) == ("unknown-attribute", True)


@pytest.mark.parametrize("place", [place for place in PLACES if place != "provideFeedback"])
def test_an_invented_element_is_told_in_each_place(place: str) -> None:
    root = fromstring(ROBOT)
    SubElement(next(root.iter(place)), "invented", v="7")
    found = told(read(root), "invented")
    # of transmissions the note tells what is not read: others document more than is read
    assert found == ("warned" if place in MOVES and place not in ("transmission", "actuator") else "counted")


OTHERS = """
joint/limit                      read     @drake:acceleration
joint                            counted  @dont_collapse
joint/calibration                counted  @reference_position
robot                            warned   drake:linear_spring_damper drake:linear_bushing_rpy drake:tendon_constraint
robot                            warned   drake:distance_constraint force_element cable
robot                            counted  frame drake:collision_filter_group collision_filter_group mujoco @model
link                             counted  @type self_collision_checking verbose audio_source
link/visual                      counted  @group drake:accepting_renderer drake:perception_properties
link/visual                      counted  drake:illustration_properties
link/collision                   counted  @group drake:proximity_properties @concave verbose
link/visual/geometry             counted  drake:ellipsoid drake:capsule
link/visual/geometry/mesh        counted  drake:declare_convex
link/contact                     counted  rolling_friction spinning_friction restitution contact_cfm contact_erp
link/contact                     counted  friction_anchor
link/contact                     warned   inertia_scaling
transmission                     read     @type
transmission                     counted  robotNamespace
transmission/joint               read     @role
transmission/actuator            read     @role
transmission/actuator            counted  drake:controller_gains
gazebo                           counted  mu2 fdir1 maxVel maxContacts selfCollide self_collide laserRetro stopCfm
gazebo                           counted  stopErp fudgeFactor provideFeedback implicitSpringDamper preserveFixedJoint
gazebo                           counted  disableFixedJointLumping plugin
gazebo                           warned   dampingFactor
sensor                           counted  @isaac_sim_config
"""
"""Elements and attributes of ROS and other programs that docs/urdf.md does not name, and what becomes of them."""


def documented() -> Iterator[tuple[str, str, str]]:
    """Each place, name and fate of the table."""
    for place, fate, *names in map(str.split, OTHERS.strip().splitlines()):
        yield from ((place, name, fate) for name in names)


@pytest.mark.parametrize(("place", "name", "fate"), [*documented()])
def test_what_others_document_is_told(place: str, name: str, fate: str) -> None:
    root = xml.parse(ROBOT.encode()).root
    part = root if place == "robot" else root.findall(place)[0]
    if name.startswith("@"):
        part.set(name[1:], "7")
    else:
        SubElement(part, name, value="7").text = "7"
    reading = read(root)
    assert told(reading, name.lstrip("@")) == fate
    assert not any(found.severity is Severity.ERROR for found in reading.diagnostics)


TREE = [link("base"), link("arm", 1.0), link("rod", 1.0), joint("r", "continuous", "base", "rod")]


def with_joint(inside: str, kind: str = "continuous") -> str:
    text = f'<joint name="j" type="{kind}"><parent link="base"/><child link="arm"/>{inside}</joint>'
    return robot(*TREE, text)


LINES = {
    "a vector by another name": ('<axis direction="0 1 0"/>', "perhaps 'xyz' is meant"),
    "a quaternion": ('<origin orientation="1 0 0 0"/>', 'write quat_xyzw="x y z w"'),
    "angles in degrees": ('<origin xyz="0 0 1" euler_deg="0 90 0"/>', "perhaps 'rpy' is meant, in rad"),
    "a number that may be several": ('<mimic joint="r" gain="-2"/>', "URDF has joint, multiplier, offset there"),
    "components": ('<axis y="1"/>', "perhaps 'xyz' is meant"),
    "limits by other names": ('<limit lo="-1" effort="1" velocity="1"/>', "URDF has lower, upper, effort, velocity"),
    "a unit": ('<origin xyz="0 0 1" unit="mm"/>', "URDF has xyz, rpy there"),
    "a spring": ('<dynamics damping="1" stiffness="3"/>', "perhaps 'spring_stiffness' is meant"),
    "an element by another name": ('<losses damping="3"/>', "perhaps <dynamics> is meant"),
}


@pytest.mark.parametrize(("inside", "hint"), LINES.values(), ids=LINES)
def test_what_is_meant_is_offered(inside: str, hint: str) -> None:
    first = read(with_joint(inside)).diagnostics[0]
    assert (first.severity, first.line) == (Severity.WARNING, 7)
    assert first.code in ("unknown-attribute", "unknown-element")
    assert hint in first.hint


@pytest.mark.parametrize("inside", ["<axis/>", "<dynamics/>"])
def test_an_element_that_has_nothing_is_told(inside: str) -> None:
    (warning,) = read(with_joint(inside)).diagnostics
    assert (warning.code, warning.severity) == ("missing-value", Severity.WARNING)
    assert "<axis" not in inside or not read(with_joint(inside, "fixed")).diagnostics


@pytest.mark.slow
def test_ten_thousand_unknown_attributes_are_one_line_for_each_name() -> None:
    joints = "".join(
        f'<link name="l{n}"/><joint name="j{n}" type="fixed" a="1" b="2"><parent link="base"/><child link="l{n}"/>'
        "</joint>"
        for n in range(5000)
    )
    first, second = read(robot(*TREE, joint("j", "fixed", "base", "arm"), joints)).diagnostics
    assert "'a'" in first.message
    assert "'b'" in second.message
    assert "and 4999 more like it" in first.statement


TEXTS = {
    "axis": ("<axis><xyz>0 1 0</xyz></axis>", {"axis": (0.0, 1.0, 0.0)}),
    "axis without its element": ("<axis>0 1 0</axis>", {"axis": (0.0, 1.0, 0.0)}),
    "origin": ("<origin>1 2 3 0.1 0.2 0.3</origin>", {"origin": Origin((1.0, 2.0, 3.0), (0.1, 0.2, 0.3))}),
    "pose": ("<pose>1 2 3 0 0 0.5</pose>", {"origin": Origin((1.0, 2.0, 3.0), (0.0, 0.0, 0.5))}),
    "limits": ("<limit><effort>5</effort><velocity>2</velocity></limit>", {"limit": Limit(0.0, 0.0, 5.0, 2.0)}),
    "limits in the axis": (
        "<axis><xyz>1 0 0</xyz><limit><effort>5</effort><velocity>2</velocity></limit></axis>",
        {"limit": Limit(0.0, 0.0, 5.0, 2.0)},
    ),
}


@pytest.mark.parametrize(("inside", "fields"), TEXTS.values(), ids=TEXTS)
def test_the_spelling_of_sdf_is_read_with_a_warning(inside: str, fields: dict[str, object]) -> None:
    reading = read(with_joint(inside))
    assert reading.robot is not None
    found: Joint = reading.robot.joints[-1]
    assert {name: getattr(found, name) for name in fields} == fields
    assert {entry.code for entry in reading.diagnostics} == {"sdf-spelling"}


def test_a_body_in_the_spelling_of_sdf_is_read() -> None:
    tensor = "".join(
        f"<{name}>{value}</{name}>" for name, value in zip(Inertia.__struct_fields__, "100203", strict=True)
    )
    reading = read(
        f"<robot name='r'><link name='a'><inertial><pose>0 0 1 0 0 0</pose><mass>2</mass><inertia>{tensor}</inertia>"
        "</inertial></link></robot>"
    )
    assert reading.robot is not None
    assert reading.robot.links[0].inertial == Inertial(2.0, Origin((0.0, 0.0, 1.0)), Inertia(1, 0, 0, 2, 0, 3))


@pytest.mark.parametrize("inside", [
    '<pose relative_to="base">0 0 1 0 0 0</pose>', '<axis><xyz expressed_in="base">0 1 0</xyz></axis>',
])  # fmt: skip
def test_a_frame_that_urdf_does_not_have_is_not_read(inside: str) -> None:
    assert "unknown-element" in {found.code for found in read(with_joint(inside)).diagnostics}


@pytest.mark.parametrize("body", [
    "<mass value='3'/>", "<inertia ixx='1'/>",
    "<collision><geometry><box size='1 1 1'/></geometry><mass>2</mass></collision>",
    "<visual><inertial><mass value='1'/></inertial></visual>", "<dynamics><inertial/></dynamics>",
])  # fmt: skip
def test_a_mass_that_is_not_where_urdf_has_it_is_an_error(body: str) -> None:
    reading = read(robot(f"<link name='a'>{body}</link>"))
    assert [found.code for found in reading.diagnostics if found.severity is Severity.ERROR] == ["stray-inertial"]


def test_zeros_and_the_other_half_of_a_tensor_are_no_warning() -> None:
    tensor = 'ixx="1" ixy="0.1" ixz="0" iyx="0.1" iyy="1" iyz="0" izx="0" izy="0" izz="1"'
    inertial = f'<inertial><mass value="1"/><inertia {tensor}/></inertial>'
    reading = read(robot(f'<link name="a"><origin xyz="0 0 0" rpy="0 -0 0"/>{inertial}</link>'))
    assert not reading.diagnostics
    assert told(read(robot(f'<link name="a"><origin xyz="0 0 1"/>{inertial}</link>')), "origin") == "warned"


LOOPS = {
    "a pin of raisim": '<constraint><pin body_a="arm" body_b="rod" anchor="0 0 1"/></constraint>',
    "a weld of MuJoCo": '<mujoco><equality><weld body1="arm" body2="rod"/></equality></mujoco>',
    "a joint between links": '<closing><hinge name="h"><a link="arm"/><b link="rod"/></hinge></closing>',
    "a plugin of Gazebo": "<gazebo><plugin><parent_link>arm</parent_link><child_link>rod</child_link></plugin>"
    "</gazebo>",
}


@pytest.mark.parametrize("element", LOOPS.values(), ids=LOOPS)
def test_a_loop_in_other_words_is_told_with_its_links(element: str) -> None:
    content = robot(*TREE, joint("j", "continuous", "base", "arm"), element)
    (error,) = read(content).diagnostics
    assert (error.code, error.severity, error.line) == ("loop-joint", Severity.ERROR, 8)
    assert "'arm' and 'rod'" in error.message
    option = LoopOption("pin", "ball", ("rod", "arm"))
    assert not read(content, Options(loops=(option,))).diagnostics, "the configuration states it"


@pytest.mark.parametrize("element", [
    '<disable_collisions link1="arm" link2="rod"/>', '<group name="g"><chain base_link="arm" tip_link="rod"/></group>',
    '<mujoco><contact><exclude body1="arm" body2="rod"/></contact></mujoco>', '<frame name="arm" link="rod"/>',
    '<cf name="g"><member link="arm"/><member link="rod"/><member link="base"/></cf>',
])  # fmt: skip
def test_what_names_links_and_joins_none_is_counted(element: str) -> None:
    assert not read(robot(*TREE, joint("j", "continuous", "base", "arm"), element)).diagnostics


def test_a_coupling_of_joints_in_other_words_is_told() -> None:
    element = '<mujoco><equality><joint joint1="j" joint2="r" polycoef="0 2"/></equality></mujoco>'
    (warning,) = read(robot(*TREE, joint("j", "continuous", "base", "arm"), element)).diagnostics
    assert (warning.code, warning.severity) == ("force-left-out", Severity.WARNING)


def test_of_two_parents_the_second_joint_is_shown_as_a_loop() -> None:
    """The element of the advice closes the robot."""
    second = '<joint name="pin" type="revolute"><parent link="rod"/><child link="arm"/><origin xyz="1 0 0"/>{}</joint>'
    rest = '<axis xyz="0 1 0"/><limit lower="0" upper="1" effort="1" velocity="1"/>'
    (error,) = read(robot(*TREE, joint("j", "continuous", "base", "arm"), second.format(rest))).diagnostics
    assert error.code == "two-parents"
    (element,) = re.findall("<loop_joint.*</loop_joint>", error.hint)
    reading = read(robot(*TREE, joint("j", "continuous", "base", "arm"), element))
    assert reading.robot is not None
    (loop,) = reading.robot.loops
    assert (loop.parent, loop.child, loop.origin.xyz, loop.axis) == ("rod", "arm", (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


@pytest.mark.parametrize("element", [
    '<include filename="part.xacro"/>', '<property name="m" value="3"/>',
    '<macro name="wheel"><link name="w"/></macro>',
    '<unless value="0"><link name="w"/></unless>',
])  # fmt: skip
def test_xacro_without_its_prefix_is_told(element: str) -> None:
    (warning,) = read(robot(link("base"), element)).diagnostics
    assert (warning.code, warning.severity, warning.line) == ("xacro-leftover", Severity.WARNING, 4)


def test_links_that_stand_in_another_element_are_told() -> None:
    (warning,) = read(robot(link("base"), '<half side="left"><link name="w"><visual/></link></half>')).diagnostics
    assert (warning.code, warning.line) == ("xacro-leftover", 4)


@pytest.mark.parametrize("text", ['<link name="a" mass="2"/>', '<link name="a"><com xyz="0 0 1"/></link>'])
def test_a_name_that_says_something_of_a_mass_is_told_in_a_link(text: str) -> None:
    (warning,) = read(robot(text)).diagnostics
    assert warning.severity is Severity.WARNING
