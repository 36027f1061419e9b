"""Which joints a source calls actuated, in all forms that are in use."""

from __future__ import annotations

import pytest
from support import urdfs

from urdfsync.urdf.parse.source import RobotReading, read_robot

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


FORMS = {
    "with an interface": ("""<transmission name="t"><type>transmission_interface/SimpleTransmission</type>
            <joint name="elbow"><hardwareInterface>EffortJointInterface</hardwareInterface></joint>
            <actuator name="m"><mechanicalReduction>1</mechanicalReduction></actuator></transmission>""",
        ["elbow"]),
    "as for the PR2": ("""<transmission name="t" type="pr2_mechanism_model/SimpleTransmission"><actuator name="m"/>
            <joint name="elbow"/><mechanicalReduction>1</mechanicalReduction></transmission>""",
        ["elbow"]),
    "a differential": ('<transmission><joint name="elbow"/><joint name="drive wheel"/></transmission>',
        ["drive wheel", "elbow"]),
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
    "of a simulator": ('<gazebo><transmission><joint name="elbow"/></transmission></gazebo>', []),
}  # fmt: skip


@pytest.mark.parametrize(("element", "names"), FORMS.values(), ids=FORMS)
def test_forms(element: str, names: list[str]) -> None:
    reading = read(element)
    assert actuated(reading) == names
    assert not reading.diagnostics
    assert reading.robot is not None
    assert len(reading.robot.extensions) == 1, "the element stays an extension"


def test_a_drive_of_a_joint_that_does_not_exist_is_told_with_its_line() -> None:
    reading = read(
        '<transmission name="left">\n<joint name="drive weel"/></transmission>',
        f'<ros2_control name="all">\n<joint name="zzz">{COMMAND}</joint></ros2_control>',
    )
    assert [str(found) for found in reading.diagnostics] == [
        "own.urdf:11: warning: transmission left drives joint 'drive weel', which does not exist; "
        "perhaps 'drive wheel' is meant [unknown-actuated-joint]",
        "own.urdf:13: warning: ros2_control all drives joint 'zzz', which does not exist; "
        "correct its name, or take it out [unknown-actuated-joint]",
    ]
    assert actuated(reading) == []


def test_what_a_joint_with_an_error_leaves_out_is_no_second_finding() -> None:
    reading = read('<transmission name="t"><joint name="bad"/></transmission>', '<joint name="bad" type="fixed"/>')
    assert {found.code for found in reading.diagnostics} == {"missing-element"}
