"""What is read of a source once more, since the reader is under test."""

from __future__ import annotations

import pinocchio as pin
import pytest
from support.urdfs import dynamics, joint, limit, links, robot

from urdfsync.urdf.parse import xml
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.physics.reference import read, read_place

SOURCE = """\
<robot name="bot">
  <link name="base"/><link name="arm"><inertial><mass value="1"/></inertial></link>
  <joint name="elbow" type="continuous"><parent link="base"/><child link="arm"/></joint>
  {}
</robot>
"""


def test_both_readers_find_the_same_place_of_a_sensor() -> None:
    poses = ("<pose>1 2 3 0.4 0.5 0.6</pose>", "<pose degrees='true'>1 2 3 30 40 50</pose>", "")
    sensors = "".join(f'<sensor name="s{k}" type="imu">{pose}</sensor>' for k, pose in enumerate(poses))
    own = '<sensor name="s3"><parent link="arm"/><origin xyz="1 2 3" rpy="0.4 0.5 0.6"/><imu/></sensor>'
    text = SOURCE.format(f'<gazebo reference="arm">{sensors}</gazebo>{own}').encode()
    robot = read_robot(text, "bot.urdf").robot
    assert robot
    assert len(robot.sensors) == 4
    for sensor in robot.sensors:
        place, angles = read_place(xml.parse(text).root, sensor)
        assert [*place, *angles] == pytest.approx([*sensor.origin.xyz, *sensor.origin.rpy], abs=1e-15)


def test_a_ball_of_pinocchio_has_the_freedoms_and_the_damping_of_the_joint_and_others_keep_theirs() -> None:
    joints = [joint("a", "spherical", "base", "b", inside=[dynamics(3, 1), limit()]), joint("b", "revolute", "b", "c")]
    text = robot(*links(base=1, b=2, c=3, d=4), *joints, joint("c", "prismatic", "b", "d", inside=[dynamics(5, 6)]))
    plain, ball = (read(each.encode(), "a.urdf").model for each in (text.replace("spherical", "continuous"), text))
    kinds = {name: joint.shortname() for name, joint in zip(ball.names, ball.joints, strict=True)}
    assert kinds["a"] == "JointModelSpherical"
    columns = {name: joint.idx_v for name, joint in zip(ball.names, ball.joints, strict=True)}
    start = columns["a"]
    assert ball.damping[start : start + 3].tolist() == [3, 3, 3]
    assert ball.friction[start : start + 3].tolist() == [0, 0, 0]
    assert (ball.damping[columns["c"]], ball.friction[columns["c"]]) == (5, 6)
    poses = []
    for model in (plain, ball):
        data = model.createData()
        pin.framesForwardKinematics(model, data, pin.neutral(model))
        poses.append({frame.name: at for frame, at in zip(model.frames, data.oMf, strict=True)})
    assert poses[0].keys() == poses[1].keys()
    assert all(poses[0][name].isApprox(poses[1][name], 1e-14) for name in poses[0])
    assert pin.computeTotalMass(ball) == pytest.approx(10)
