"""Links and joints of an MJCF: where they are, how they move, and what they weigh."""

from __future__ import annotations

import math

import pytest
from support.mjcfs import ARM, body, joint, link, read, reading, urdf, world

from urdfsync.formats.urdf.robot import Dynamics, Inertia, Inertial, Limit, Link, Origin


def test_bodies_and_joints_are_links_and_joints() -> None:
    robot = read(ARM)
    assert [each.name for each in robot.links] == ["world", "upper", "fore"]
    assert [(each.name, each.type, each.parent, each.child) for each in robot.joints] == [
        ("shoulder", "revolute", "world", "upper"),
        ("elbow", "continuous", "upper", "fore"),
    ]
    shoulder, elbow = robot.joints
    assert shoulder.origin == Origin((0, 0, 0.5))
    assert shoulder.axis == (0, 1, 0)
    assert shoulder.limit == Limit(-math.pi / 2, math.pi / 2)
    assert shoulder.dynamics == Dynamics(2.0)
    assert elbow.dynamics == Dynamics(armature=0.1, spring_stiffness=4.0)
    assert elbow.origin.rpy == pytest.approx((0, 0, math.pi / 6), abs=1e-15)


def test_a_number_stays_as_written() -> None:
    robot = read(ARM)
    assert link(robot, "upper").inertial == Inertial(1.5, Origin((0, 0, 0.2)), Inertia(0.02, iyy=0.02, izz=0.01))


def test_a_full_inertia_stays_as_written() -> None:
    """MuJoCo itself turns the tensor to its principal axes."""
    inertial = '<inertial pos="0.1 0 0" mass="2" fullinertia="0.3 0.2 0.4 0.01 0.02 0.03"/><joint/>'
    found = link(read(world(f'<body name="a">{inertial}</body>')), "a").inertial
    assert found == Inertial(2.0, Origin((0.1, 0, 0)), Inertia(0.3, 0.01, 0.02, 0.2, 0.03, 0.4))


def test_a_balanced_inertia_is_mujocos() -> None:
    compiler = '<compiler balanceinertia="true"/>'
    inertial = '<inertial pos="0 0 0" mass="2" fullinertia="1 1 5 0 0 0"/><joint/>'
    found = link(read(world(f'<body name="a">{inertial}</body>', compiler)), "a").inertial
    assert found is not None
    assert found.inertia == Inertia(7 / 3, iyy=7 / 3, izz=7 / 3)


def test_geoms_give_a_body_without_inertial_its_mass() -> None:
    found = link(read(ARM), "fore").inertial
    assert found is not None
    assert found.mass == pytest.approx(3)
    assert found.inertia.izz == pytest.approx(3 / 3 * (0.1**2 + 0.2**2))


def test_a_joint_beside_the_origin_moves_the_frame_of_its_link() -> None:
    """URDF turns a link about its own origin; the body of an MJCF may turn about any point."""
    inner = '<body name="tip" pos="0 0 1"/><site name="end" pos="1 0 0"/>'
    robot = read(body(f'<joint name="j" pos="0.1 0 0" axis="0 0 1"/>{inner}'))
    assert joint(robot, "j").origin.xyz == (0.1, 0, 0)
    assert link(robot, "part").inertial == Inertial(2.0, Origin((-0.1, 0, 0)), Inertia(0.1, iyy=0.1, izz=0.1))
    assert joint(robot, "tip_fixed").origin.xyz == (-0.1, 0, 1)
    assert joint(robot, "end_fixed").origin.xyz == (0.9, 0, 0)


def test_several_joints_of_a_body_have_links_without_mass_between_them() -> None:
    robot = read(body('<joint name="x" type="slide" axis="1 0 0"/><joint name="turn" pos="0 1 0" axis="0 0 1"/>'))
    assert [(each.name, each.type, each.parent, each.child) for each in robot.joints] == [
        ("x", "prismatic", "world", "x"),
        ("turn", "continuous", "x", "part"),
    ]
    assert link(robot, "x") == Link("x")
    assert joint(robot, "turn").origin.xyz == (0, 1, 0)


def test_limits_count_from_the_pose_as_written() -> None:
    """In MuJoCo they count from `ref`."""
    robot = read(body('<joint name="j" type="slide" ref="0.5" range="-1 2"/>'))
    assert joint(robot, "j").limit == Limit(-1.5, 1.5)


def test_a_range_without_autolimits_is_no_limit() -> None:
    compiler = '<compiler autolimits="false"/>'
    assert joint(read(body('<joint name="j" range="-1 2" limited="false"/>', compiler)), "j").limit is None


def test_a_free_body_is_a_floating_robot() -> None:
    found = reading(body('<freejoint/><body name="leg"><joint name="hip"/><geom size="0.1"/></body>'))
    assert found.robot is not None
    assert [each.name for each in found.robot.links] == ["part", "leg"]
    assert [each.name for each in found.robot.joints] == ["hip"]


def test_a_ball_is_a_ball() -> None:
    found = joint(read(body('<joint name="b" type="ball" damping="3"/>')), "b")
    assert (found.type, found.dynamics) == ("ball", Dynamics(3.0))


def test_a_body_without_joint_is_fixed() -> None:
    robot = read(body('<body name="hand" pos="1 2 3"/><joint/>'))
    assert (joint(robot, "hand_fixed").type, joint(robot, "hand_fixed").origin.xyz) == ("fixed", (1, 2, 3))


def test_equal_names_of_different_kinds_are_kept_apart() -> None:
    robot = read(world('<body name="x"><joint name="x"/><geom name="x" size="0.1"/><site name="x"/></body>'))
    assert [each.name for each in robot.links] == ["world", "x", "x_2"]
    assert [each.name for each in robot.joints] == ["x", "x_2_fixed"]


def test_names_are_made_of_kind_and_place() -> None:
    inner = '<body><joint/><geom size="0.1"/></body><body><geom size="0.1"/></body>'
    robot = read(world(f'<body><joint axis="1 0 0"/><joint axis="0 1 0"/><geom size="0.1"/>{inner}</body>'))
    assert [each.name for each in robot.links] == [
        *("world", "world_body1_joint1", "world_body1", "world_body1_body1", "world_body1_body2")
    ]
    assert [each.name for each in robot.joints] == [
        *("world_body1_joint1", "world_body1_joint2", "world_body1_body1_joint", "world_body1_body2_fixed")
    ]


def test_no_name_can_leave_its_quotes() -> None:
    name = "a&quot;/>&lt;link name=&quot;b"
    robot = read(world(f'<body name="{name}"><joint/><geom size="0.1"/></body>'))
    assert [each.name for each in robot.links] == ["world", 'a"/><link name="b']


def test_the_robot_has_the_name_of_the_model_or_of_the_file() -> None:
    assert '<robot name="arm" version="1.2">' in urdf(ARM)
    assert '<robot name="arm" version="1.2">' in urdf(ARM.replace(' model="arm"', ""))
    assert '<robot name="leg" version="1.2">' in urdf(ARM.replace('model="arm"', 'model="leg"'))
