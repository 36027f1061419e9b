"""Every real robot and every version of the histories: read without exception, judged, and read right.

The corpus stands beside the repository, or where URDFSYNC_CORPUS says; without it these tests are skipped.
"""

from __future__ import annotations

from typing import get_args

import pytest
from lxml import etree
from support.corpus import FOLDER as CORPUS

from urdfsync.common.diagnostics import Severity
from urdfsync.formats.urdf.options import LeftOut, Options
from urdfsync.formats.urdf.parse.source import RobotReading, read_robot

FILES = sorted(path.relative_to(CORPUS).as_posix() for path in CORPUS.rglob("*.urdf") if path.is_file())
ROBOTS = [file for file in FILES if file.startswith("robots/")]

pytestmark = pytest.mark.skipif(not FILES, reason=f"no corpus at {CORPUS}; set URDFSYNC_CORPUS")

TURTLEBOT = "histories/ROBOTIS-GIT+turtlebot3__turtlebot3_description_urdf_turtlebot3"
SO101 = "histories/TheRobotStudio+SO-ARM100__Simulation_SO101_so101"
SO101_FAULTS = ["duplicate-link", "cycle", "duplicate-link", "cycle", "two-parents"]
FAULTY = {
    # A typo: the link is called mu_link, the joint's child imu_link.
    f"{TURTLEBOT}_waffle_pi.urdf/003.urdf": ["unknown-child"],
    # The links base and gripper exist twice, as bodies and as frames fixed to themselves.
    f"{SO101}_new_calib.urdf/000.urdf": SO101_FAULTS,
    f"{SO101}_new_calib.urdf/001.urdf": SO101_FAULTS,
    f"{SO101}_old_calib.urdf/000.urdf": SO101_FAULTS,
    # MuJoCo models that were committed under a name that ends in .urdf.
    "histories/kscalelabs+sim__sim_stompy_legs_robot.urdf/000.urdf": ["not-urdf"],
    "histories/kscalelabs+sim__sim_stompy_legs_robot_fixed.urdf/001.urdf": ["not-urdf"],
    # An arm to be mounted on the link body of another file.
    "robots/random/spot_ros/spot_description/urdf/spot_arm.urdf": ["unknown-parent"],
}  # fmt: skip
"""The errors of the corpus, judged by hand: each is a real fault of its file."""

ODD = {
    # A box of size 0 0 0.
    "matlab/sawyer_description/urdf/rethinkSawyer.urdf": ["shape-size"],
    # Continuous joints from 1.1 to 1.9 rad.
    "drake/atlas/urdf/robotiq.urdf": ["limit-without-effect", "gravity-off", "stray-inertial"],
    "drake/atlas/urdf/robotiq_simple.urdf": ["stray-inertial"],
    "drake/atlas/urdf/robotiq_tendons.urdf":
        ["force-left-out", "stray-inertial", "unknown-material", "missing-limit-value"],
    "ros-industrial/robotiq/robotiq_3f_gripper_visualization/cfg/robotiq-3f-gripper_articulated.urdf":
        ["stray-inertial"],
    # <xacro:grey/> inside visuals, and materials that a file not included defines.
    "matlab/robotis_op_description/robots/robotisOP2.urdf":
        ["unknown-material", "xacro-leftover", "unknown-material", "unknown-material"],
    # <robot> without a name.
    "oems/xacro_generated/open-manipulator_robotis/open_manipulator_description/urdf/open_manipulator.urdf":
        ["missing-name", "unknown-material"],
    # A camera on camera_link, which the file does not have.
    "oems/xacro_generated/open-manipulator_robotis/open_manipulator_description/urdf/open_manipulator_robot.urdf":
        ["unknown-sensor-place"],
    "random/spot_ros/spot_description/urdf/spot_arm.urdf": [],
    # Velocity limits of 0 in all joints, and in one that does not move.
    "matlab/qarm_description/urdf/quanserQArm.urdf": ["zero-limits"],
    "oems/qarm_quanser/qarm_description/urdf/QARM.urdf": ["zero-limits"],
    "matlab/quanser_description/urdf/quanserQBot2e.urdf": ["zero-limits"],
    "robotics-toolbox/al5d_description/urdf/al5d_robot.urdf": ["zero-limits"],
    "robotics-toolbox/puma560_description/urdf/puma560_robot.urdf": ["zero-limits"],
}  # fmt: skip
"""The warnings and notes about the robots, in the order of lines, judged by hand; all others have none."""


def read(file: str) -> RobotReading:
    return read_robot((CORPUS / file).read_bytes(), file, Options(allow=get_args(LeftOut)))


@pytest.mark.parametrize("file", FILES)
def test_a_file_is_read_or_has_a_real_fault(file: str) -> None:
    reading = read(file)
    found = reading.diagnostics
    errors = [d.code for d in found if d.severity is Severity.ERROR]
    assert errors == FAULTY.get(file, [])
    assert (reading.robot is None) == bool(errors)
    assert all(d.file == file and d.line > 0 and d.hint for d in found)
    if file in ROBOTS:
        others = [d.code for d in found if d.severity is not Severity.ERROR]
        assert others == ODD.get(file.removeprefix("robots/"), [])


@pytest.mark.parametrize("file", [file for file in ROBOTS if file not in FAULTY])
def test_nothing_is_dropped_and_every_line_is_right(file: str) -> None:
    reading = read(file)
    assert reading.robot is not None
    root = etree.parse(CORPUS / file).getroot()
    assert len(reading.robot.links) == len(root.findall("link"))
    assert sum(len(link.visuals) for link in reading.robot.links) == len(root.findall("link/visual"))
    assert sum(len(link.collisions) for link in reading.robot.links) == len(root.findall("link/collision"))
    names = root.xpath("/robot/transmission/joint/@name | //plugin/leftJoint/text() | //plugin/rightJoint/text()")
    named = {str(name) for name in names}
    actuated = {joint.name for joint in reading.robot.joints if joint.actuated}
    assert actuated == named & {joint.name for joint in reading.robot.joints}
    lines = (CORPUS / file).read_text(encoding="utf-8").split("\n")
    for kind in ("link", "joint"):
        for element in root.findall(kind):
            assert f"<{kind}" in lines[reading.lines[f"{kind} {element.get('name')}"] - 1]
