"""What a URDF says of contacts, in each of its forms: read once, and taken out of what is kept as text.

What else changes the motion of a robot in Gazebo has a warning that says so.
"""

from __future__ import annotations

import pytest
from support.robots import robot_extensions
from support.urdfs import joint, link, robot

from urdfsync.formats.urdf.parse.source import read_robot
from urdfsync.formats.urdf.robot import Contact, Robot

SURFACE = (
    "<surface><friction><ode><mu>0.5</mu></ode></friction>"
    "<contact><ode><kp>1e5</kp><kd>3</kd><min_depth>0.001</min_depth></ode></contact></surface>"
)
ALL = Contact(mu=0.5, kp=1e5, kd=3.0, min_depth=0.001)


def gazebo(inner: str, reference: str = "foot") -> str:
    return f'<gazebo reference="{reference}">{inner}</gazebo>'


def read(*elements: str, inside: str = "") -> Robot:
    reading = read_robot(robot(f'<link name="foot">{inside}</link>', *elements).encode(), "a.urdf")
    assert reading.robot is not None
    assert reading.diagnostics == ()
    return reading.robot


@pytest.mark.parametrize("inner", [
    "<mu1>0.5</mu1><kp>1e5</kp><kd>3</kd><minDepth>0.001</minDepth>",
    '<mu1 value="0.5"/><kp value="1e5"/><kd value="3"/><minDepth value="1e-3"/>',
    f"<collision>{SURFACE}</collision>",
    SURFACE,
])  # fmt: skip
def test_the_forms_of_gazebo(inner: str) -> None:
    found = read(gazebo(inner))
    assert found.links[0].contact == ALL
    assert found.extensions == {}


def test_the_forms_of_bullet() -> None:
    bullet = '<contact><lateral_friction value="0.9"/><stiffness value="2e4"/><damping value="7"/>{}</contact>'
    found = read(inside=bullet.format(""))
    assert (found.links[0].contact, found.extensions) == (Contact(mu=0.9, kp=2e4, kd=7.0), {})
    found = read(inside=bullet.format('<rolling_friction value="0"/>'))
    assert found.links[0].contact == Contact(mu=0.9, kp=2e4, kd=7.0)
    assert [(owner, text) for owner, _, text in robot_extensions(found)] == [
        ("link foot", '<rolling_friction value="0"></rolling_friction>')
    ]


def test_the_first_number_counts_and_all_else_is_kept() -> None:
    elements = (
        gazebo("<kp>1</kp><material>a</material>"),
        gazebo("<kp>2</kp><mu1>3</mu1><mu2>9</mu2>"),
        gazebo("<mu1>4</mu1>", "x"),
    )
    found, diagnostics, *_ = read_robot(robot('<link name="foot"/>', *elements).encode(), "a.urdf")
    assert [(one.code, one.message) for one in diagnostics] == [
        ("duplicate-element", "link foot: kp 2 contradicts 1, the first value, which counts"),
        ("unknown-reference", "<gazebo> refers to 'x', which is no link or joint"),
    ]
    assert found is not None
    assert found.links[0].contact == Contact(mu=3.0, kp=1.0)
    assert [(owner, text) for owner, _, text in robot_extensions(found)] == [
        ("gazebo foot", "<material>a</material>"),
        ("gazebo foot", "<mu2>9</mu2>"),
        ("gazebo x", "<mu1>4</mu1>"),
    ]


@pytest.mark.parametrize("inner", ["<kp>0</kp>", "<mu1>-1</mu1>", "<kd>soft</kd>", "<minDepth/>"])
def test_a_number_that_no_contact_has_is_left_out(inner: str) -> None:
    reading = read_robot(robot('<link name="foot"/>', gazebo(inner)).encode(), "a.urdf")
    assert reading.robot is not None
    assert reading.robot.links[0].contact is None
    assert [(str(one.severity), one.code, one.line) for one in reading.diagnostics] == [("warning", "bad-contact", 4)]


TREE = (link("base"), link("arm", 1.0), joint("elbow", "continuous", "base", "arm"))


def read_notes(element: str) -> tuple[list[str], list[str]]:
    reading = read_robot(robot(*TREE, element).encode(), "a.urdf")
    return [str(entry) for entry in reading.diagnostics], [entry.message for entry in reading.unmodelled]


@pytest.mark.parametrize(("element", "words"), [
    ("<gazebo reference='arm'><turnGravityOff>true</turnGravityOff></gazebo>",
     "link 'arm' has no weight in Gazebo, but has it in the model"),
    ("<gazebo reference='arm'><gravity value='0'/></gazebo>",
     "link 'arm' has no weight in Gazebo, but has it in the model"),
    ("<gazebo reference='elbow'><dampingFactor>5</dampingFactor></gazebo>",
     "dampingFactor 5 of 'elbow' acts in Gazebo, but not in the model"),
    ("<force_element name='s'><torsional_spring/></force_element>",
     "<force_element> s acts between links in Gazebo, and is left out of the model"),
])  # fmt: skip
def test_what_changes_the_motion_is_a_warning(element: str, words: str) -> None:
    (warning,), notes = read_notes(element)
    assert warning.startswith(f"a.urdf:6: warning: {words}; ")
    assert len(notes) == 1, "with its line, as all that is in no model"


SPRING = "<gazebo reference='elbow'><springStiffness>5</springStiffness>{}</gazebo>"


@pytest.mark.parametrize(("inside", "elements", "expected"), [
    ("", [SPRING.format("")], (5.0, None)),
    ("", [SPRING.format("<springReference value='0.5'/>")], (5.0, 0.5)),
    ("", [SPRING.format(""), "<gazebo reference='elbow'><springReference>-1</springReference></gazebo>"], (5.0, -1.0)),
    ("<dynamics spring_stiffness='3' spring_reference='0.2'/>", [], (3.0, 0.2)),
    ("<axis xyz='1 0 0'><dynamics damping='2'/></axis>", [SPRING.format("")], (5.0, None)),
    ("<axis xyz='1 0 0'><dynamics><spring_stiffness>3</spring_stiffness></dynamics></axis>", [], (3.0, None)),
])  # fmt: skip
def test_a_spring_is_read(inside: str, elements: list[str], expected: tuple[float, float | None]) -> None:
    elbow = joint("elbow", "continuous", "base", "arm", inside=[inside])
    found = read_robot(robot(link("base"), link("arm", 1.0), elbow, *elements).encode(), "a.urdf")
    assert found.robot is not None
    dynamics = found.robot.joints[0].dynamics
    assert dynamics is not None
    assert (dynamics.spring_stiffness, dynamics.spring_reference) == expected
    assert dynamics.damping == (2.0 if "damping" in inside else 0.0)
    assert {entry.code for entry in found.diagnostics} <= {"sdf-spelling"}


@pytest.mark.parametrize(("inside", "element", "code", "words"), [
    ("<dynamics spring_stiffness='3'/>", SPRING.format(""), "duplicate-element",
     "joint elbow: the spring_stiffness of its <dynamics> counts, not the <springStiffness> of <gazebo>"),
    ("<dynamics><spring_stiffness>3</spring_stiffness></dynamics>", SPRING.format(""), "duplicate-element",
     "joint elbow: the spring_stiffness of its <dynamics> counts, not the <springStiffness> of <gazebo>"),
    ("", SPRING.format("") + SPRING.replace("5", "6").format(""), "duplicate-element",
     "joint elbow: springStiffness 6 contradicts 5, the first value, which counts"),
    ("", SPRING.replace("5", "nan").format(""), "bad-spring",
     "joint elbow: <springStiffness> 'nan' is not a decimal number"),
    ("", SPRING.replace("5", "-5").format(""), "negative-dynamics",
     "joint elbow: the spring stiffness -5 is negative"),
    ("<dynamics spring_reference='0.5'/>", "", "dynamics-without-effect",
     "joint elbow: the spring reference 0.5 has no effect without a stiffness"),
])  # fmt: skip
def test_a_spring_that_can_hardly_be_meant_is_told(inside: str, element: str, code: str, words: str) -> None:
    elbow = joint("elbow", "continuous", "base", "arm", inside=[inside])
    found = read_robot(robot(link("base"), link("arm", 1.0), elbow, element).encode(), "a.urdf")
    told = [(entry.code, entry.message) for entry in found.diagnostics if entry.code != "sdf-spelling"]
    assert told == [(code, words)]


@pytest.mark.parametrize("kind", ["fixed", "floating", "ball", "planar"])
def test_a_spring_needs_a_joint_with_one_freedom(kind: str) -> None:
    elbow = joint("elbow", kind, "base", "arm")
    found = read_robot(robot(link("base"), link("arm", 1.0), elbow, SPRING.format("")).encode(), "a.urdf")
    words = f"joint elbow: spring stiffness of <dynamics> can't act on a {kind} joint"
    assert [entry.message for entry in found.diagnostics if entry.code == "dynamics-without-effect"] == [words]


@pytest.mark.parametrize("part", [
    "<turnGravityOff>false</turnGravityOff>", "<gravity>1</gravity>",
])  # fmt: skip
def test_gravity_that_is_not_switched_off_is_modelled(part: str) -> None:
    assert read_notes(f"<gazebo reference='arm'>{part}</gazebo>") == ([], [])


@pytest.mark.parametrize("element", [
    "<gazebo reference='base'><turnGravityOff>true</turnGravityOff></gazebo>",
    "<gazebo reference='elbow'><dampingFactor>0</dampingFactor></gazebo>",
    "<gazebo reference='arm'><dampingFactor>none</dampingFactor></gazebo>",
    "<gazebo reference='arm'><material>Gazebo/Red</material></gazebo>",
])  # fmt: skip
def test_what_changes_nothing_is_counted(element: str) -> None:
    warnings, notes = read_notes(element)
    assert warnings == []
    assert len(notes) == 1
