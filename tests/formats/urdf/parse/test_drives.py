"""What a source says of the drives of joints, in all forms that are in use; the second reader reads gears alike."""

from __future__ import annotations

import pytest
from support import urdfs
from support.numbers import differences

from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.parse.source import RobotReading, read_robot
from urdfsync.formats.urdf.robot import Command, Dynamics, Joint, Mimic, Servo, Transmission

BASE = (
    *map(urdfs.link, ("base", "arm", "wheel", "caster")),
    urdfs.joint("elbow", "continuous", "base", "arm"),
    urdfs.joint("drive wheel", "continuous", "base", "wheel"),
    urdfs.joint("roll", "continuous", "base", "caster"),
)
COMMAND, STATE = '<command_interface name="velocity"/>', '<state_interface name="velocity"/>'


def read(*elements: str) -> RobotReading:
    return read_robot(urdfs.robot(*BASE, *elements).encode(), "own.urdf")


def actuated(reading: RobotReading) -> list[str]:
    assert reading.robot is not None
    return sorted(joint.name for joint in reading.robot.joints if joint.actuated)


def coupled(kind: str, *parts: str, within: str = "type") -> str:
    return f'<transmission name="t"><{within}>transmission_interface/{kind}</{within}>{"".join(parts)}</transmission>'


FORMS = {
    "with an interface": ("""<transmission name="t"><type>transmission_interface/SimpleTransmission</type>
            <joint name="elbow"><hardwareInterface>EffortJointInterface</hardwareInterface></joint>
            <actuator name="m"><mechanicalReduction>1</mechanicalReduction></actuator></transmission>""",
        ["elbow"]),
    "as for the PR2": ("""<transmission name="t" type="pr2_mechanism_model/SimpleTransmission"><actuator name="m"/>
            <joint name="elbow"/><mechanicalReduction>1</mechanicalReduction></transmission>""",
        ["elbow"]),
    "a coupling of no joint": (coupled("DifferentialTransmission", "<actuator name='m'/>"), []),
    "no joint": ("<transmission><joint/><actuator name='elbow'/></transmission>", []),
    "not its own joint": ("<transmission><group><joint name='elbow'/></group></transmission>", []),
    "ros2_control, with a joint that is measured only": (
        f"""<ros2_control name="c" type="system"><hardware><plugin>p</plugin></hardware>
            <joint name="elbow">{COMMAND}{STATE}</joint><joint name="roll">{STATE}</joint></ros2_control>""",
        ["elbow"],
    ),
    "a transmission of ros2_control": (f"""<ros2_control name="c" type="system"><joint name="roll">{STATE}</joint>
            <transmission name="t"><plugin>p</plugin><actuator name="m" role="a"/><joint name="elbow" role="j"/>
            </transmission></ros2_control>""",
        ["elbow"]),
    "ros2_control of a sensor": (
        f'<ros2_control name="c" type="sensor"><joint name="roll">{STATE}</joint></ros2_control>',
        [],
    ),
    "an interface that only measures": (
        f"""<transmission name="t"><joint name="roll"><hardwareInterface>JointStateInterface</hardwareInterface></joint>
            </transmission><ros2_control name="c"><joint name="elbow">{STATE}{COMMAND}</joint></ros2_control>""",
        ["elbow"],
    ),
    "wheels of a plugin": (
        "<gazebo><plugin name='d'><leftJoint>drive wheel</leftJoint><right_joint>roll</right_joint></plugin></gazebo>",
        ["drive wheel", "roll"],
    ),
    "of a simulator": ('<gazebo><transmission><joint name="elbow"/></transmission></gazebo>', []),
}  # fmt: skip


@pytest.mark.parametrize(("element", "names"), FORMS.values(), ids=FORMS)
def test_forms(element: str, names: list[str]) -> None:
    reading = read(element)
    assert actuated(reading) == names
    assert not reading.diagnostics


def elbow(reading: RobotReading) -> Joint:
    assert reading.robot is not None
    return next(joint for joint in reading.robot.joints if joint.name == "elbow")


def transmission(inside_joint: str = "", inside_actuator: str = "", own: str = "") -> str:
    joint, actuator = f'<joint name="elbow">{inside_joint}</joint>', f'<actuator name="m">{inside_actuator}</actuator>'
    return f'<transmission name="t">{joint}{actuator}{own}</transmission>'


def control(inside: str) -> str:
    return f'<ros2_control name="c" type="system">{inside}</ros2_control>'


ROTOR = '<drake:rotor_inertia value="1e-4"/>'
GEARS = {
    "of ROS 1": (
        transmission("<offset>0.1</offset>", "<mechanicalReduction> -50 </mechanicalReduction>"),
        Transmission(-50.0, 0.1),
    ),
    "at the joint": (transmission("<mechanicalReduction>7</mechanicalReduction>"), Transmission(7.0)),
    "in neither": (transmission(own="<mechanicalReduction>3e1</mechanicalReduction>"), Transmission(30.0)),
    "of ros2_control": (
        control(transmission("<mechanical_reduction>325.9</mechanical_reduction><offset>-2</offset>")),
        Transmission(325.9, -2.0),
    ),
    "of Drake, which does not read the other one": (
        transmission(
            "", f'<mechanicalReduction>2</mechanicalReduction><drake:gear_ratio value="100"/>{ROTOR}'
        ),
        Transmission(100.0, 0.0, 1e-4),
    ),
    "a rotor without a gear": (transmission("", ROTOR), Transmission(rotor_inertia=1e-4)),
    "none": (transmission("<offset>0</offset>", "<mechanicalReduction>1.0</mechanicalReduction>"), None),
}  # fmt: skip


@pytest.mark.parametrize(("element", "gear"), GEARS.values(), ids=GEARS)
def test_gears_and_rotors(element: str, gear: Transmission | None) -> None:
    reading = read(element)
    assert elbow(reading).transmission == gear
    assert not reading.diagnostics
    assert differences(urdfs.robot(*BASE, element).encode()) == []


FAULTS = {
    "no number": (transmission("", "<mechanicalReduction>1:100</mechanicalReduction>"), "bad-transmission"),
    "nothing": (transmission("<offset/>"), "bad-transmission"),
    "zero": (transmission("", "<mechanicalReduction>0</mechanicalReduction>"), "bad-transmission"),
    "an underscore": (transmission(own="<mechanicalReduction>1_000</mechanicalReduction>"), "bad-transmission"),
}


@pytest.mark.parametrize(("element", "code"), FAULTS.values(), ids=FAULTS)
def test_a_faulty_number_of_a_gear_is_a_warning_and_left_out(element: str, code: str) -> None:
    reading = read(element)
    assert [(found.code, str(found.severity)) for found in reading.diagnostics] == [(code, "warning")]
    assert elbow(reading).transmission is None
    assert differences(urdfs.robot(*BASE, element).encode()) == []


def test_a_rotor_of_negative_inertia_is_an_error() -> None:
    reading = read(transmission("", '<drake:rotor_inertia value="-1"/>'))
    assert {found.code: str(found.severity) for found in reading.diagnostics}["negative-inertia"] == "error"
    assert reading.robot is None


def test_a_drive_counts_on_a_joint_with_an_axis_only() -> None:
    content = urdfs.robot(
        *map(urdfs.link, "ab"),
        urdfs.joint("elbow", "fixed", "a", "b"),
        transmission("", '<mechanicalReduction>5</mechanicalReduction><drake:rotor_inertia value="-1"/>'),
    )
    reading = read_robot(content.encode(), "own.urdf")
    assert not reading.diagnostics
    assert [note.message for note in reading.unmodelled] == ["not modelled: 1 <transmission>"]


def test_of_two_gears_the_first_counts() -> None:
    first, other = (transmission("", f"<mechanicalReduction>{n}</mechanicalReduction>") for n in (5, 6))
    reading = read(first, other, control(first))
    assert [found.code for found in reading.diagnostics] == ["drive-contradiction"]
    assert elbow(reading).transmission == Transmission(5.0)


def part(tag: str, role: str, reduction: float, inside: str = "") -> str:
    """A joint or an actuator of ROS 1."""
    name = {"joint1": "elbow", "joint2": "roll"}.get(role, role)
    number = f"<mechanicalReduction>{reduction}</mechanicalReduction>"
    return f'<{tag} name="{name}"><role>{role}</role>{number}{inside}</{tag}>'


JOINTS = part("joint", "joint1", 2, "<offset>0.5</offset>"), part("joint", "joint2", -3, "<offset>0.25</offset>")
ACTUATORS = part("actuator", "actuator1", 10), part("actuator", "actuator2", 20, ROTOR)
WRIST = """<transmission type="pr2_mechanism_model/WristTransmission" name="wrist">
  <rightActuator name="r" mechanicalReduction="60"/><leftActuator name="l" mechanicalReduction="50"/>
  <flexJoint name="elbow" mechanicalReduction="-1"/><rollJoint name="roll" mechanicalReduction="2" offset="0.5"/>
  </transmission>"""
CONTROLLED = """<plugin>transmission_interface/DifferentialTransmission</plugin><actuator name="m"/><actuator name="n"/>
  <joint name="elbow"><mechanical_reduction>4</mechanical_reduction></joint><joint name="roll"/>"""
COUPLED = {
    "a differential": (coupled("DifferentialTransmission", *JOINTS, *ACTUATORS),
        Transmission(20.0, 0.125, None, "roll", -30.0), Transmission(60.0, 0.25 + 0.5 * 2 / 3, 1e-4, "elbow", 40.0)),
    "in another order": (coupled("DifferentialTransmission", *ACTUATORS[::-1], *JOINTS[::-1]),
        Transmission(20.0, 0.125, None, "roll", -30.0), Transmission(60.0, 0.25 + 0.5 * 2 / 3, 1e-4, "elbow", 40.0)),
    "a four-bar linkage": (coupled("FourBarLinkageTransmission", *JOINTS, *ACTUATORS),
        Transmission(20.0, 0.5), Transmission(-60.0, 0.25 - 0.5 / 3, 1e-4, "elbow", 20.0)),
    "the PR2's wrist": (WRIST,
        Transmission(-60.0, 1.0, None, "roll", -120.0), Transmission(-100.0, 0.5, None, "elbow", 50.0)),
    "of ros2_control, without roles": (control(f'<transmission name="t">{CONTROLLED}</transmission>'),
        Transmission(4.0, 0.0, None, "roll", 1.0), Transmission(-1.0, 0.0, None, "elbow", 4.0)),
}  # fmt: skip


@pytest.mark.parametrize(("element", "first", "second"), COUPLED.values(), ids=COUPLED)
def test_motors_of_two_joints(element: str, first: Transmission, second: Transmission) -> None:
    """By hand: the position of each motor as a function of both joints' positions."""
    reading = read(element)
    assert reading.robot is not None
    gears = {joint.name: joint.transmission for joint in reading.robot.joints}
    assert (gears["elbow"], gears["roll"]) == (first, second)
    assert (actuated(reading), reading.diagnostics, reading.unmodelled) == (["elbow", "roll"], (), ())
    assert differences(urdfs.robot(*BASE, element).encode()) == []


GRIPPER = """<transmission name="grip" type="pr2_mechanism_model/PR2GripperTransmission"><actuator name="m"/>
  <gap_joint name="elbow" mechanical_reduction="1" gear_ratio="40.1" L0="0.03"/><passive_joint name="roll"/>
  </transmission>"""
MOVES_BY_ITSELF = "in a way that is not modelled: each moves by itself, without gears"
BY_HAND = "model the coupling by hand, or write a transmission for each joint"
ROLES = "needs two joints and two actuators, with the roles joint1, joint2, actuator1, actuator2"


@pytest.mark.parametrize(("element", "names", "words"), [
    (GRIPPER, ["elbow"],
     "transmission grip (pr2_mechanism_model/PR2GripperTransmission) moves elbow, roll "
     f"{MOVES_BY_ITSELF}; {BY_HAND}"),
    ('<transmission><joint1 name="elbow"/><joint2 name="roll"/></transmission>', ["elbow", "roll"],
     f"transmission number 1 (without a type) moves elbow, roll {MOVES_BY_ITSELF}; {BY_HAND}"),
    (coupled("DifferentialTransmission", *JOINTS, ACTUATORS[0]), ["elbow", "roll"],
     f"transmission t (transmission_interface/DifferentialTransmission) moves elbow, roll {MOVES_BY_ITSELF}; "
     f"a transmission_interface/DifferentialTransmission {ROLES}"),
    (coupled("DifferentialTransmission", *JOINTS, *(text.replace("tor1", "tor3") for text in ACTUATORS)),
     ["elbow", "roll"], f"a transmission_interface/DifferentialTransmission {ROLES}"),
    (coupled("DifferentialTransmission", *JOINTS, JOINTS[1].replace("roll", "drive wheel"), *ACTUATORS),
     ["drive wheel", "elbow", "roll"], f"a transmission_interface/DifferentialTransmission {ROLES}"),
    (coupled("DifferentialTransmission", *JOINTS, *ACTUATORS).replace(">10<", ">1e-300<").replace(">2<", ">1e-300<"),
     ["elbow", "roll"], MOVES_BY_ITSELF),
])  # fmt: skip
def test_joints_that_are_coupled_in_another_way_are_driven_and_told(element: str, names: list[str], words: str) -> None:
    reading = read(element)
    assert reading.robot is not None
    assert actuated(reading) == names
    assert [(found.code, found.line) for found in reading.diagnostics] == [("coupled-transmission", 10)]
    assert words in str(reading.diagnostics[0])
    assert not any(joint.transmission for joint in reading.robot.joints)
    assert differences(urdfs.robot(*BASE, element).encode()) == []


@pytest.mark.parametrize("other", [
    urdfs.joint("roll", "fixed", "base", "caster"), urdfs.joint("roll", "prismatic", "base", "caster"),
    urdfs.joint("roll", "continuous", "base", "caster", inside=[urdfs.mimic("drive wheel")]),
])  # fmt: skip
def test_a_motor_moves_two_joints_that_turn_by_themselves(other: str) -> None:
    content = urdfs.robot(*BASE[:-1], other, WRIST).encode()
    reading = read_robot(content, "own.urdf")
    assert differences(content) == []
    assert [str(found) for found in reading.diagnostics] == [
        "own.urdf:12: warning: transmission wrist couples elbow and roll, but not both joints turn by themselves: "
        f"neither has a gear; {BY_HAND} [coupled-transmission]"
    ]
    assert elbow(reading).transmission is None


def test_a_handle_of_several_joints_couples_none() -> None:
    joints = '<joint name="elbow"/><joint name="drive wheel"/>'
    reading = read(f"<transmission><type>arm_hw/ArmStateInterface</type>{joints}</transmission>")
    assert not reading.diagnostics


def interfaces(*names: str, place: str = "joint") -> str:
    inside = "".join(f"<hardwareInterface>{name}</hardwareInterface>" for name in names)
    return transmission(**{f"inside_{place}": inside})


@pytest.mark.parametrize(("element", "command"), [
    (interfaces("hardware_interface/EffortJointInterface"), "effort"),
    (interfaces(" VelocityJointInterface "), "velocity"),
    (interfaces("VelocityJointInterface", place="actuator"), "velocity"),
    (interfaces("PosVelJointInterface"), "position"),
    (interfaces("EffortJointInterface", "JointStateInterface", "VelocityJointInterface"), "velocity"),
    ("<gazebo><plugin name='d'><leftJoint>elbow</leftJoint></plugin></gazebo>", "velocity"),
])  # fmt: skip
def test_commands_of_ros_1_and_of_gazebo(element: str, command: str) -> None:
    reading = read(element)
    assert (elbow(reading).command or "position") == command
    assert not reading.diagnostics


def test_state_interfaces_alone_measure_a_joint_that_nothing_drives() -> None:
    for measured in (interfaces("JointStateInterface"), control(f'<joint name="elbow">{STATE}</joint>')):
        assert elbow(read(measured)).measured
        assert not elbow(read(measured, interfaces("EffortJointInterface"))).measured


WAYS = {
    "ros2_control": control('<joint name="elbow"><command_interface name="position"/></joint>'),
    "transmission": interfaces("EffortJointInterface"),
    "gazebo": "<gazebo><plugin name='d'><leftJoint>elbow</leftJoint></plugin></gazebo>",
}


@pytest.mark.parametrize(("first", "second", "command"), [
    ("ros2_control", "transmission", "position"), ("ros2_control", "gazebo", "position"),
    ("transmission", "gazebo", "effort"),
])  # fmt: skip
def test_of_two_commands_one_counts_whatever_their_order(first: str, second: str, command: str) -> None:
    for elements in ((WAYS[first], WAYS[second]), (WAYS[second], WAYS[first])):
        reading = read(*elements)
        assert (elbow(reading).command or "position") == command
        (warning,) = reading.diagnostics
        assert (warning.code, warning.line) == ("drive-contradiction", 10 + elements.index(WAYS[second]))


def test_the_configuration_counts_before_all() -> None:
    content = urdfs.robot(*BASE, WAYS["ros2_control"], WAYS["transmission"]).encode()
    reading = read_robot(content, "own.urdf", Options(commands={"elbow": "velocity"}))
    assert (elbow(reading).command, reading.diagnostics) == ("velocity", ())


def test_joint_and_actuator_that_differ_are_told() -> None:
    both = interfaces("EffortJointInterface").replace(
        '<actuator name="m">', '<actuator name="m"><hardwareInterface>PositionJointInterface</hardwareInterface>'
    )
    reading = read(both)
    assert [found.code for found in reading.diagnostics] == ["drive-contradiction"]
    assert elbow(reading).command == "effort"


@pytest.mark.parametrize(("element", "words"), [
    (interfaces("EfortJointInterface"), "transmission t / joint elbow has the unknown interface "
     "'EfortJointInterface', which has no effect; perhaps 'EffortJointInterface' is meant"),
    (control('<joint name="elbow"><command_interface name="velocty"/></joint>'), "ros2_control c / joint elbow has "
     "the unknown interface 'velocty', which has no effect; perhaps 'velocity' is meant"),
])  # fmt: skip
def test_an_unknown_interface_is_told_with_its_line(element: str, words: str) -> None:
    reading = read(element)
    assert [str(found) for found in reading.diagnostics] == [f"own.urdf:10: warning: {words} [unknown-interface]"]
    assert (elbow(reading).actuated, elbow(reading).command) == (True, None)


@pytest.mark.parametrize(("names", "command"), [
    (("velocity",), "velocity"),
    (("effort", "velocity"), "velocity"),
    (("effort", "velocity", "position"), "position"),
    (("effort",), "effort"),
    (("velocity_pid",), "velocity"),
    (("stiffness",), "position"),
])  # fmt: skip
def test_commands(names: tuple[str, ...], command: str) -> None:
    interfaces = "".join(f'<command_interface name="{name}"/>' for name in names)
    assert (elbow(read(control(f'<joint name="elbow">{interfaces}</joint>'))).command or "position") == command


def servo(command: str, **numbers: object) -> str:
    """The elbow, commanded by a law; each param has a line of its own."""
    params = "".join(f'\n<param name="{name}">{number}</param>' for name, number in numbers.items())
    return control(f'<joint name="elbow"><command_interface name="{command}">{params}</command_interface></joint>')


@pytest.mark.parametrize(("element", "law", "unread"), [
    (servo("position", position_gain=50, velocity_gain=4, min_position=-1, max_position=2, min_effort=-3, max_effort=4),
     Servo(50.0, 4.0, -1.0, 2.0, None, None, -3.0, 4.0), 0),
    (servo("velocity", velocity_gain=4, min_velocity=-1, max_velocity=2, max_effort=4),
     Servo(None, 4.0, None, None, -1.0, 2.0, None, 4.0), 0),
    (servo("velocity", position_gain=50, min_velocity=-1, min_position=-2),
     Servo(50.0, None, -2.0, None, -1.0), 0),
    (servo("velocity", velocity_gain=4, min_position=-1), Servo(velocity_gain=4.0), 1),
    (servo("velocity_pid", velocity_gain=4), Servo(velocity_gain=4.0), 0),
    (servo("effort", min_effort=0), Servo(min_effort=0.0), 0),
    (servo("effort", max_effort=3, position_gain=1), Servo(max_effort=3.0), 1),
    (servo("position", velocity_gain=4, max_effort=3), None, 2),
    (servo("position", min=-1, max=1), None, 2),
    (servo("position", position_gain=50).replace("</command", '<param name="position_gain">60</param></command'),
     Servo(50.0), 1),
])  # fmt: skip
def test_a_command_interface_may_state_a_law(element: str, law: Servo | None, unread: int) -> None:
    """Params that the law of the command lacks are noted, as any other."""
    reading = read(element)
    assert elbow(reading).servo == law
    assert [str(each.message) for each in reading.unmodelled] == [f"not modelled: {unread} <param>"] * bool(unread)


@pytest.mark.parametrize(("element", "words"), [
    (servo("position", position_gain="stiff"), "11: error: ros2_control c / joint elbow / position_gain: <param> "
     "'stiff' is not a decimal number; write a decimal number"),
    (servo("position", position_gain=5, velocity_gain=-4), "12: error: ros2_control c / joint elbow: velocity_gain is "
     "-4, but a gain is never negative; correct its sign"),
    (servo("effort", min_effort=3, max_effort=-3), "11: error: ros2_control c / joint elbow: min_effort is 3, and "
     "max_effort is -3; exchange or correct the limits"),
])  # fmt: skip
def test_a_faulty_law_is_an_error_with_its_line(element: str, words: str) -> None:
    reading = read(element)
    assert [str(found) for found in reading.diagnostics] == [f"own.urdf:{words} [bad-servo]"]
    assert reading.robot is None


@pytest.mark.parametrize("command", ["position", "velocity", "effort"])
def test_a_command_in_the_configuration_switches_a_law_off(command: Command) -> None:
    content = urdfs.robot(*BASE, servo("position", position_gain=50)).encode()
    reading = read_robot(content, "own.urdf", Options(commands={"elbow": command}))
    assert (elbow(reading).command or "position", elbow(reading).servo) == (command, None)


def plugin(leader: str = "roll", numbers: str = "") -> str:
    return f"<gazebo><plugin name='p'><joint>{leader}</joint><mimicJoint>elbow</mimicJoint>{numbers}</plugin></gazebo>"


def followed(leader: str = "roll", numbers: str = "") -> str:
    return control(f'<joint name="elbow"><param name="mimic">{leader}</param>{numbers}{STATE}</joint>')


@pytest.mark.parametrize(("element", "mimic"), [
    (plugin(), Mimic("roll")),
    (plugin(numbers="<multiplier>-2</multiplier><offset>0.1</offset>"), Mimic("roll", -2.0, 0.1)),
    (followed(), Mimic("roll")),
    (followed(numbers='<param name="multiplier">3</param><param name="offset">1</param>'), Mimic("roll", 3.0, 1.0)),
    (plugin().replace("joint>roll", "jointName>roll").replace("roll</joint", "roll</jointName"), Mimic("roll")),
])  # fmt: skip
def test_couplings_of_ros2_control_and_of_plugins(element: str, mimic: Mimic) -> None:
    reading = read(element, interfaces("EffortJointInterface"))
    assert (elbow(reading).mimic, elbow(reading).command) == (mimic, None)
    assert not reading.diagnostics
    assert not reading.unmodelled
    assert differences(urdfs.robot(*BASE, element).encode()) == []


@pytest.mark.parametrize(("element", "words"), [
    (plugin("drive wheel"), "warning: joint 'elbow' has two couplings that differ: that of joint elbow / mimic "
     "counts, that of gazebo number 1 / joint elbow does not; correct one of the two elements"),
    (followed(numbers='<param name="multiplier">2</param>'), "warning: joint 'elbow' has two couplings that "
     "differ: that of joint elbow / mimic counts, that of ros2_control c / joint elbow does not; correct one of the "
     "two elements"),
    (control('<joint name="elbow" mimic="false"/>'), "warning: ros2_control c / joint elbow has mimic='false', but "
     "joint 'elbow' follows another joint all the same; correct one of the two elements"),
])  # fmt: skip
def test_a_coupling_that_contradicts_the_mimic_of_the_joint_is_told(element: str, words: str) -> None:
    mimicking = urdfs.joint("elbow", "continuous", "base", "arm", inside=[urdfs.mimic("roll")])
    content = urdfs.robot(*BASE[:4], mimicking, *BASE[5:], element)
    reading = read_robot(content.encode(), "own.urdf")
    assert [str(found) for found in reading.diagnostics] == [f"own.urdf:10: {words} [drive-contradiction]"]
    assert elbow(reading).mimic == Mimic("roll")
    assert differences(content.encode()) == []


@pytest.mark.parametrize(("element", "code"), [
    (plugin("elbow"), "mimic-cycle"), (followed("elbow"), "mimic-cycle"), (followed("rol"), "unknown-mimic"),
    (control('<joint name="elbow" mimic="true"/>'), "drive-contradiction"),
    (plugin(numbers="<offset>none</offset>"), "bad-mimic"),
])  # fmt: skip
def test_a_faulty_coupling_has_one_finding_with_its_line(element: str, code: str) -> None:
    assert [(found.code, found.line) for found in read(element).diagnostics] == [(code, 10)]


def begins(position: str, kind: str = "position", joint: str = "elbow") -> str:
    param = f'<param name="initial_value">{position}</param>'
    return control(f'<joint name="{joint}">{COMMAND}<state_interface name="{kind}">{param}</state_interface></joint>')


@pytest.mark.parametrize(("element", "start"), [
    (begins("0.5"), 0.5), (begins("0"), 0.0), (begins("0", "velocity"), None), (begins("7", "effort"), None),
])  # fmt: skip
def test_a_start_position_is_read(element: str, start: float | None) -> None:
    reading = read(element)
    assert elbow(reading).start == start
    assert not reading.diagnostics


LIMITED = urdfs.joint("elbow", "revolute", "base", "arm", inside=[urdfs.limit(-1, 2, 1, 1)])
FOLLOWING = urdfs.joint("elbow", "continuous", "base", "arm", inside=[urdfs.mimic("roll", 2, 0.1)])


@pytest.mark.parametrize(("joint", "elements", "words"), [
    (LIMITED, [begins("2.5")], "10: warning: joint 'elbow' begins at 2.5, outside of its limits -1 to 2: the start "
     "is ignored"),
    (LIMITED, [begins("-1.5")], "10: warning: joint 'elbow' begins at -1.5, outside of its limits -1 to 2: the start "
     "is ignored"),
    (LIMITED, [begins("half")], "10: warning: ros2_control c / joint elbow: <param> 'half' is not a decimal number"),
    (LIMITED, [begins("2", "velocity")], "10: warning: ros2_control c / joint elbow begins with velocity 2; in Run and "
     "Test the joint begins at rest"),
    (LIMITED, [begins("1"), begins("2")], "11: warning: joint 'elbow' has two start positions that differ: that of "
     "ros2_control c / joint elbow counts, that of ros2_control c #2 / joint elbow does not"),
    (FOLLOWING, [begins("1", joint="roll"), begins("2")], "11: warning: joint 'elbow' can't begin at 2: the joint that "
     "it follows holds it at 2.1"),
])  # fmt: skip
def test_a_start_position_that_can_not_be_is_told_with_its_line(joint: str, elements: list[str], words: str) -> None:
    content = urdfs.robot(*BASE[:4], joint, *BASE[5:], *elements)
    (warning,) = read_robot(content.encode(), "own.urdf").diagnostics
    assert str(warning).startswith(f"own.urdf:{words};")


def test_a_start_position_in_the_configuration_counts() -> None:
    content = urdfs.robot(*BASE, begins("0.5")).encode()
    reading = read_robot(content, "own.urdf", Options(start={"elbow": -0.5, "roll": 1.0}))
    assert (elbow(reading).start, reading.diagnostics) == (-0.5, ())
    assert actuated(reading) == ["elbow"]


def test_an_armature_is_read() -> None:
    inside = ['<dynamics damping="0.5" armature="0.02"/>']
    content = urdfs.robot(*map(urdfs.link, "ab"), urdfs.joint("elbow", "continuous", "a", "b", inside=inside))
    assert elbow(read_robot(content.encode(), "own.urdf")).dynamics == Dynamics(0.5, 0.0, 0.02)


def test_a_drive_of_a_joint_that_does_not_exist_is_told_with_its_line() -> None:
    reading = read(
        '<transmission name="left">\n<joint name="drive weel"/></transmission>',
        f'<ros2_control name="all">\n<joint name="zzz">{COMMAND}</joint></ros2_control>',
    )
    assert [str(found) for found in reading.diagnostics] == [
        "own.urdf:11: warning: transmission left drives joint 'drive weel', which does not exist; "
        "perhaps 'drive wheel' is meant [unknown-actuated-joint]",
        "own.urdf:13: warning: ros2_control all drives joint 'zzz', which does not exist; "
        "correct the name of the joint, or remove the element [unknown-actuated-joint]",
    ]
    assert actuated(reading) == []


def test_what_a_joint_with_an_error_leaves_out_is_no_second_finding() -> None:
    reading = read('<transmission name="t"><joint name="bad"/></transmission>', '<joint name="bad" type="fixed"/>')
    assert {found.code for found in reading.diagnostics} == {"missing-element"}


def test_a_drive_of_a_ball_is_told() -> None:
    content = urdfs.robot(*BASE, '<transmission name="t"><joint name="elbow"/></transmission>')
    (warning,) = read_robot(content.replace("continuous", "ball", 1).encode(), "own.urdf").diagnostics
    assert str(warning).startswith("own.urdf:7: warning: joint 'elbow' is a ball: its drive has no effect; drive the")
