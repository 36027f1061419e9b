"""Joints, loops, and what no model has."""

from __future__ import annotations

import math

import pytest
from support.sdfs import ARM, arm, hinge, joint, left_out, link, model, noted, read, sdf, urdf

from urdfsync.formats.urdf.robot import Dynamics, Limit, Mimic


def numbers(inside: str) -> str:
    return f"<axis><xyz>0 0 1</xyz>{inside}</axis>"


def test_a_robot_of_two_hinges() -> None:
    robot = read(ARM)
    assert [each.name for each in robot.links] == ["world", "upper", "fore"]
    shoulder, elbow = robot.joints
    assert (shoulder.type, shoulder.limit, shoulder.dynamics) == ("revolute", Limit(-1.5, 1.5), Dynamics(2))
    assert (elbow.type, elbow.limit, elbow.dynamics) == ("continuous", None, None)
    assert elbow.origin.rpy == (0, 0, 0.5)


@pytest.mark.parametrize(
    ("limit", "kind", "expected"),
    [
        ("", "continuous", None),
        ("<lower>-1e16</lower><upper>1e+16</upper>", "continuous", None),
        ("<lower>-inf</lower><upper>INF</upper>", "continuous", None),
        ("<lower>-1</lower><upper>2</upper>", "revolute", Limit(-1, 2)),
        ("<lower>-1</lower>", "revolute", Limit(-1, 1e16)),
        ("<lower>-1</lower><upper>2</upper><effort>-1</effort><velocity>inf</velocity>", "revolute", Limit(-1, 2)),
        ("<effort>3</effort><velocity>4</velocity>", "continuous", Limit(effort=3, velocity=4)),
    ],
)
def test_an_endless_limit_is_none(limit: str, kind: str, expected: Limit | None) -> None:
    found = joint(read(arm(joint=numbers(f"<limit>{limit}</limit>"))))
    assert (found.type, found.limit) == (kind, expected)


@pytest.mark.parametrize(
    ("kind", "type_"), [("prismatic", "prismatic"), ("continuous", "continuous"), ("fixed", "fixed"), ("ball", "ball")]
)
def test_a_kind_of_joint(kind: str, type_: str) -> None:
    inside = numbers("<limit><lower>-1</lower><upper>1</upper></limit><dynamics><damping>3</damping></dynamics>")
    found = joint(read(arm(joint=inside, kind=kind), robot="arm"))
    assert found.type == type_
    assert (found.dynamics == Dynamics(3)) == (kind != "fixed")


@pytest.mark.parametrize("kind", ["universal", "revolute2"])
def test_two_axes_are_two_hinges(kind: str) -> None:
    first = "<axis><xyz>1 0 0</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis>"
    second = "<axis2><xyz>0 1 0</xyz><dynamics><friction>2</friction></dynamics></axis2>"
    robot = read(arm("<pose>0 0 2 0 0 0</pose>", f"<pose>0 0 1 0 0 0</pose>{first}{second}", kind=kind))
    one, two = joint(robot, "turn_axis"), joint(robot, "turn_axis2")
    assert (one.parent, one.child, one.axis, one.origin.xyz) == ("base", "turn_axis", (1, 0, 0), (0, 0, 3))
    assert (two.parent, two.child, two.axis, two.origin.xyz) == ("turn_axis", "part", (0, 1, 0), (0, 0, 0))
    assert (one.limit, two.dynamics) == (Limit(-1, 1), Dynamics(0, 2))
    assert link(robot, "turn_axis").inertial is None


def test_numbers_of_drake() -> None:
    own = "<drake:gear_ratio>10</drake:gear_ratio><drake:rotor_inertia>0.002</drake:rotor_inertia>"
    limit = "<limit><drake:acceleration>8</drake:acceleration></limit>"
    found = joint(read(arm(joint=f"<axis>{limit}</axis>{own}")))
    assert found.dynamics is not None
    assert found.dynamics.armature == 0.2
    assert found.limit == Limit(acceleration=8)


def test_a_joint_has_a_spring() -> None:
    """A joint that leads towards the root has the same one: its axis is turned, so its position is the same."""
    spring = "<dynamics><spring_stiffness>3</spring_stiffness><spring_reference>-0.2</spring_reference></dynamics>"
    links = '<link name="base"/><link name="part"/>' + hinge("weld", "world", "base", "", "fixed")
    for ends in (("base", "part"), ("part", "base")):
        found = joint(read(model(links + hinge("turn", *ends, numbers(spring)))))
        assert found.dynamics == Dynamics(0, 0, spring_stiffness=3, spring_reference=-0.2)


def test_a_sliding_joint_without_a_range_loses_its_other_limits() -> None:
    text = arm(joint=numbers("<limit><effort>3</effort></limit>"), kind="prismatic")
    assert joint(read(text)).limit is None
    assert "1 <effort>" in noted(text)


def test_names_of_two_axes_are_free() -> None:
    both = "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>"
    other = hinge("turn_axis", "part", "hand") + '<link name="hand"/>'
    robot = read(arm(joint=both, kind="universal", more=other))
    assert [each.name for each in robot.joints] == ["weld", "turn_axis_2", "turn_axis2", "turn_axis"]


def test_a_joint_follows_another_one() -> None:
    mimic = '<mimic joint="turn"><multiplier>2</multiplier><offset>0.5</offset><reference>0.1</reference></mimic>'
    more = '<link name="tip"/>' + hinge("bend", "part", "tip", numbers(mimic))
    assert joint(read(arm(more=more)), "bend").mimic == Mimic("turn", 2, 0.3)


def test_a_joint_may_lead_towards_the_root() -> None:
    """Its position is the same: parent and child change places, and the axis its direction."""
    links = '<link name="base"/><link name="part"><pose>0 0 1 0 0 0</pose></link>'
    limit = numbers("<limit><lower>-1</lower><upper>2</upper></limit>")
    turned = hinge("turn", "part", "base", f"<pose>0 0 0.5 0 0 0</pose>{limit}")
    found = joint(read(model(links + hinge("weld", "world", "base", "", "fixed") + turned)))
    assert (found.parent, found.child, found.axis, found.origin.xyz) == ("base", "part", (0, 0, -1), (0, 0, 0.5))
    assert found.limit == Limit(-1, 2)


WIND = "<wind><linear_velocity>0 3 0</linear_velocity></wind>"


def in_world(inside: str, link: str = "", more: str = "", version: str = "1.9") -> str:
    """The arm in a world with these elements."""
    robot = arm(link, more=more)
    return sdf(f"<world name='w'>{inside}{robot[robot.index('<model') : -6]}</world>", version)


FOUR_BAR = "".join(
    f'<link name="{name}"><pose>{place}</pose></link>'
    for name, place in (("a", "0 0 0 0 0 0"), ("b", "0 0 1 0 0 0"), ("c", "1 0 0 0 0 0"))
)


def four_bar(inside: str = "<axis><xyz>0 1 0</xyz></axis>", kind: str = "revolute", other: str = "") -> str:
    last = hinge("at_c", "world", "c", f"<axis><xyz>0 1 0</xyz>{other}</axis>")
    first = "".join(hinge(f"at_{b}", a, b, "<axis><xyz>0 1 0</xyz></axis>") for a, b in (("world", "a"), ("a", "b")))
    return model(FOUR_BAR + first + last + hinge("closing", "c", "b", f"<pose>1 0 0 0 0 0</pose>{inside}", kind))


def test_a_link_with_two_parents_closes_a_loop() -> None:
    robot = read(four_bar())
    assert [each.name for each in robot.joints] == ["at_a", "at_c", "at_b"]
    (loop,) = robot.loops
    assert (loop.name, loop.kind, loop.parent, loop.child) == ("closing", "revolute", "c", "b")
    assert (loop.axis, loop.origin.xyz, loop.child_origin.xyz) == ((0, 1, 0), (0, 0, 1), (1, 0, 0))


def test_a_loop_is_cut_at_a_plain_joint() -> None:
    """A loop of the models has no limits and no losses, and can't slide."""
    limited = "<axis><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis>"
    assert read(four_bar(limited)).loops[0].name == "at_c"
    assert read(four_bar(kind="prismatic")).loops[0].name == "at_c"
    assert read(four_bar("", "ball", "<dynamics><damping>1</damping></dynamics>")).loops[0].name == "closing"


def test_a_loop_loses_its_numbers() -> None:
    damped = "<axis><xyz>0 1 0</xyz><dynamics><damping>1</damping></dynamics></axis>"
    text = four_bar().replace("<axis><xyz>0 1 0</xyz></axis>", damped)
    assert left_out(text) == ["limits, losses or coupling of a joint that closes a loop closing"]
    assert len(left_out(text.replace('type="revolute"', 'type="ball"'))) == 1


@pytest.mark.parametrize(
    ("inside", "told"),
    [
        (arm(kind="screw"), ["screw joint turn"]),
        (arm(more=hinge("gears", "base", "part", "", "gearbox")), ["gearbox joint gears"]),
        (arm(more='<link name="far"/>'), ["loose link far"]),
        (arm("<gravity>0</gravity>"), ["gravity off part"]),
        (arm("<kinematic>true</kinematic>"), ["kinematic link part"]),
        (arm("<velocity_decay><linear>0</linear><angular>1</angular></velocity_decay>"), ["velocity_decay part"]),
        (arm("<inertial><fluid_added_mass><xx>1</xx></fluid_added_mass></inertial>"), ["fluid_added_mass part"]),
        (arm(more="<static>true</static>"), ["static model arm"]),
        (arm(joint="<axis/><physics><ode><max_force>3</max_force></ode></physics>"), ["max_force of <physics> turn"]),
        (
            arm(joint="<axis/><physics><ode><suspension><cfm>1</cfm></suspension></ode></physics>"),
            ["suspension/cfm of <physics> turn"],
        ),
        (
            sdf(f"<world name='w'><gravity>0 0 -1.6</gravity>{arm()[arm().index('<model') : -6]}</world>"),
            ["gravity 0 0 -1.6"],
        ),
        (in_world("<physics><gravity>0 0 -1.6</gravity></physics>", version="1.5"), ["gravity 0 0 -1.6"]),
        (in_world(WIND, "<enable_wind>1</enable_wind>"), ["wind by enable_wind part"]),
        (in_world(WIND, more="<enable_wind>true</enable_wind>"), ["wind by enable_wind arm"]),
        (
            sdf(f"<world name='w'>{arm()[arm().index('<model') : -6]}<joint name='j' type='fixed'/></world>"),
            ["joint of the world j"],
        ),
    ],
)
def test_what_acts_on_the_robot_is_left_out_by_name(inside: str, told: list[str]) -> None:
    assert left_out(inside) == told


@pytest.mark.parametrize(
    "inside",
    [
        arm("<gravity>true</gravity><kinematic>0</kinematic><velocity_decay/>"),
        arm(joint=numbers("<dynamics><spring_reference>3</spring_reference></dynamics>")),
        sdf(f"<world name='w'><gravity>0 0 -9.81</gravity>{arm()[arm().index('<model') : -6]}</world>"),
        in_world("<physics><gravity>0 0 -9.8</gravity></physics>", version="1.5"),
        in_world("<physics><gravity>0 0 -1.6</gravity></physics>"),  # libsdformat reads none there
        in_world("<wind><linear_velocity>0 0 0</linear_velocity></wind>", "<enable_wind>1</enable_wind>"),
        in_world(WIND),
    ],
)
def test_what_does_not_act_is_not(inside: str) -> None:
    assert left_out(inside) == []


@pytest.mark.parametrize(
    ("inside", "told"),
    [
        (arm('<light name="lamp"/><battery name="b"/>'), "not modelled: 1 <light>, 1 <battery>"),
        (arm("<self_collide>true</self_collide><enable_wind>false</enable_wind>"), "not modelled: 1 <self_collide>"),
        (arm(joint="<axis/><physics><ode/></physics>"), "not modelled: 1 <physics>"),
        (arm(joint=numbers("<limit><stiffness>1e8</stiffness></limit>")), "not modelled: 1 <stiffness>"),
        (model('<pose>0 0 1 0 0 0</pose><link name="a"/><link name="b"/>' + hinge("h", "a", "b")), "1 <start-pose>"),
        (
            model('<link name="a"><pose>0 0 1 0 0 0</pose></link><link name="b"/>' + hinge("h", "a", "b")),
            "<start-pose>",
        ),
        (arm(joint=numbers("<use_parent_model_frame>1</use_parent_model_frame>")), "1 <use_parent_model_frame>"),
        (arm(more='<gripper name="g"/>'), "not modelled: 1 <gripper>"),
        (arm(more='<x:own name="g"/>'), "not modelled: 1 <x:own>"),
        (sdf(f"<world name='w'>{arm()[arm().index('<model') : -6]}<light name='sun'/><scene/></world>"), "1 <light>"),
    ],
)
def test_what_has_no_effect_is_counted(inside: str, told: str) -> None:
    assert told in noted(inside)


def test_a_robot_without_a_joint_to_the_world_is_free() -> None:
    text = model('<link name="a"/><link name="b"/>' + hinge("h", "b", "a"))
    assert '<free_root link="b"/>' in urdf(text)[0]
    assert "free_root" not in urdf(arm())[0]


def test_plugins_mean_what_they_mean_in_a_urdf() -> None:
    plugin = '<plugin name="p" filename="libgazebo_ros_diff_drive.so"><left_joint>turn</left_joint></plugin>'
    found = joint(read(arm(more=plugin)))
    assert (found.actuated, found.command) == (True, "velocity")


def test_angles_are_those_that_a_user_writes() -> None:
    assert math.isclose(joint(read(arm("<pose>0 0 0 0 1.5708 0</pose>"))).origin.rpy[1], 1.5708)
