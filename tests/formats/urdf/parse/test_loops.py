"""Loops are read from wherever they stand; one fault each, with its line."""

from __future__ import annotations

import pytest
from support.numbers import differences
from support.urdfs import joint, link, robot

from urdfsync.common.diagnostics import Severity
from urdfsync.formats.urdf.options import LoopFrame, LoopOption, Options
from urdfsync.formats.urdf.parse.source import RobotReading, read_robot
from urdfsync.formats.urdf.robot import Loop, Origin

BARS = [
    *(link("base"), link("crank", 1.0), link("rod", 1.0), link("rocker", 1.0)),
    joint("drive", "continuous", "base", "crank", xyz="0 0 0", rpy="0 0 0", axis="0 0 1"),
    joint("elbow", "continuous", "crank", "rod", xyz="0.3 0.1 0", rpy="0 0 0", axis="0 0 1"),
    joint("pivot", "continuous", "base", "rocker", xyz="0.5 0 0", rpy="0 0 0.5", axis="0 0 1"),
]
LOOP_JOINT = """<loop_joint name="closing" type="revolute"><link1 link="rod" xyz="0.4 0.2 0" rpy="0 0 1"/>
<link2 link="rocker" xyz="0.2 0.3 0"/><axis xyz="0 0 2"/></loop_joint>"""
DRAKE = """<drake:ball_constraint xmlns:drake="http://drake.mit.edu"><drake:ball_constraint_body_A name="rod"/>
<drake:ball_constraint_p_AP value="0.4 0.2 0"/><drake:ball_constraint_body_B name="rocker"/></drake:ball_constraint>"""
GAZEBO = """<gazebo><joint name="closing" type="revolute"><parent>rod</parent><child>rocker</child>
<pose>0.2 0.3 0 0 0 0</pose><axis><xyz>0 0 1</xyz></axis></joint></gazebo>"""
FRAMES = [
    link("closing_bar_1"),
    link("closing_bar_2"),
    joint("f1", "fixed", "rod", "closing_bar_1"),
    joint("f2", "fixed", "rocker", "closing_bar_2"),
]


def read(*elements: str, options: Options | None = None) -> RobotReading:
    return read_robot(robot(*BARS, *elements).encode(), "a.urdf", options or Options())


def loops(*elements: str, options: Options | None = None) -> tuple[Loop, ...]:
    reading = read(*elements, options=options)
    assert reading.robot is not None
    return reading.robot.loops


def test_a_loop_joint_has_a_frame_on_each_link() -> None:
    (loop,) = loops(LOOP_JOINT)
    assert (loop.name, loop.kind, loop.parent, loop.child) == ("closing", "revolute", "rod", "rocker")
    assert loop.origin == Origin((0.4, 0.2, 0.0), (0.0, 0.0, 1.0))
    assert (loop.child_origin, loop.axis) == (Origin((0.2, 0.3, 0.0)), (0.0, 0.0, 1.0))
    assert read(LOOP_JOINT).lines["loop closing"] == 10


ENDS = """<loop_joint name="closing" type="revolute"><parent link="rod"/><child link="rocker"/>
<parent_origin xyz="0.4 0.2 0"/><child_origin xyz="0.2 0.3 0"/><world_origin xyz="1 2 3" frame="root"/>
<axis xyz="0 0 1" frame="parent"/></loop_joint>"""
"""As an exporter of Fusion 360 writes it."""


@pytest.mark.parametrize(("source", "origin", "child_origin"), [
    (LOOP_JOINT.replace("link2", "link1"), Origin((0.4, 0.2, 0.0), (0.0, 0.0, 1.0)), Origin((0.2, 0.3, 0.0))),
    # the rocker is turned by 0.5 rad where all joints are at zero
    (ENDS, Origin((0.4, 0.2, 0.0)), Origin((0.2, 0.3, 0.0), (0.0, 0.0, -0.5))),
    (ENDS.replace("0.3 0", '0.3 0" rpy="0 0 2'), Origin((0.4, 0.2, 0.0)), Origin((0.2, 0.3, 0.0), (0.0, 0.0, 2.0))),
    (ENDS.replace("parent_origin", "origin").replace("child_origin", "world_origin"),
     Origin((0.4, 0.2, 0.0)), Origin()),
    (ENDS.replace("parent_origin", "world_origin").replace("child_origin", "world_origin")
     .replace('"rod"', '"rod" xyz="0.4 0.2 0"'), Origin((0.4, 0.2, 0.0)), Origin()),
])  # fmt: skip
def test_exporters_write_the_ends_of_a_loop_joint_in_several_ways(
    source: str, origin: Origin, child_origin: Origin
) -> None:
    reading = read(source)
    assert reading.robot is not None
    assert reading.diagnostics == ()
    assert reading.robot.loops == (Loop("closing", "revolute", "rod", "rocker", origin, child_origin, (0.0, 0.0, 1.0)),)
    assert differences(robot(*BARS, source).encode()) == []


@pytest.mark.parametrize("elements", [[DRAKE], [GAZEBO], FRAMES], ids=["Drake", "Gazebo", "onshape-to-robot"])
def test_the_second_reader_reads_the_same_loops(elements: list[str]) -> None:
    assert differences(robot(*BARS, *elements).encode()) == []


def test_a_ball_of_drake_is_a_point_on_each_body() -> None:
    (loop,) = loops(DRAKE)
    assert (loop.kind, loop.origin, loop.child_origin) == ("ball", Origin((0.4, 0.2, 0.0)), Origin())


def test_limits_of_a_loop_are_told() -> None:
    (finding,) = read(ENDS.replace("</loop", '<limit lower="-1" upper="1"/></loop')).diagnostics
    assert (finding.code, finding.hint) == ("unknown-element", "correct the name, or remove the element")


def test_a_joint_of_sdf_is_closed_where_all_joints_are_at_zero() -> None:
    """The rocker is turned by 0.5 rad there, and so is the frame on it."""
    (loop,) = loops(GAZEBO)
    assert loop.child_origin == Origin((0.2, 0.3, 0.0))
    assert loop.origin.rpy == pytest.approx((0, 0, 0.5), abs=1e-11)
    assert loop.origin.xyz == pytest.approx((0.23169, 0.25916, 0), abs=1e-5)
    assert loop.axis == (0.0, 0.0, 1.0)


def test_a_joint_on_a_link_that_only_gazebo_has_may_be_left_out() -> None:
    source = GAZEBO.replace("<child>rocker</child>", "<child>pad</child>"), '<gazebo><link name="pad"/></gazebo>'
    (error,) = read(*source).diagnostics
    assert (error.code, error.severity) == ("loop-joint", Severity.ERROR)
    assert "link 'pad', which only Gazebo has" in error.message
    assert loops(*source, options=Options(allow=("loop-joint",))) == ()


def test_frames_of_onshape_to_robot_are_a_ball_that_is_told() -> None:
    reading = read(*FRAMES)
    assert reading.robot is not None
    assert reading.robot.loops == (Loop("closing_bar", "ball", "closing_bar_1", "closing_bar_2"),)
    assert [(found.code, found.line) for found in reading.diagnostics] == [("loop-by-name", 10)]


def test_the_configuration_states_loops_by_links_or_frames() -> None:
    option = LoopOption("bar", "revolute", ("rod", LoopFrame("rocker", (0.1, 0.0, 0.0))), (0.0, 3.0, 0.0))
    (loop,) = loops(options=Options(loops=(option,)))
    assert loop == Loop("bar", "revolute", "rod", "rocker", Origin(), Origin((0.1, 0.0, 0.0)), (0.0, 1.0, 0.0))


def test_the_configuration_wins_over_the_source() -> None:
    ends = LoopFrame("rocker", (0.2, 0.3, 0.0)), LoopFrame("rod", (0.4, 0.2, 0.0), (0.0, 0.0, 1.0))
    reading = read(LOOP_JOINT, options=Options(loops=(LoopOption("mine", "ball", ends),)))
    assert reading.robot is not None
    assert [(loop.name, loop.kind) for loop in reading.robot.loops] == [("mine", "ball")]
    assert [found.code for found in reading.diagnostics] == ["loop-contradiction"]


def test_the_configuration_wins_over_a_loop_of_the_source_that_is_wrong() -> None:
    other = LoopOption("closing", "revolute", ("rod", "rocker"))
    reading = read(LOOP_JOINT.replace("rocker", "rockr"), options=Options(loops=(other,)))
    assert [found.code for found in reading.diagnostics] == ["loop-contradiction"]


def test_the_same_loop_in_the_configuration_is_no_contradiction() -> None:
    """Each place fills in the axes that a kind does not have in its own way."""
    rod = LoopFrame("rod", (0.4, 0.2, 0.0), (0.0, 0.0, 1.0))
    same = LoopOption("closing", "revolute", (rod, LoopFrame("rocker", (0.2, 0.3, 0.0))))
    reading = read(LOOP_JOINT, options=Options(loops=(same,)))
    assert reading.diagnostics == ()
    assert reading.robot is not None
    assert reading.robot.loops == loops(LOOP_JOINT)


def test_the_configuration_says_more_of_a_pair_of_frames() -> None:
    """That is how a pair is said to be no ball: so it contradicts nothing."""
    other = LoopOption("mine", "revolute", ("closing_bar_2", "closing_bar_1"))
    reading = read(*FRAMES, options=Options(loops=(other,)))
    assert reading.diagnostics == ()
    assert reading.robot is not None
    assert [(loop.name, loop.kind) for loop in reading.robot.loops] == [("mine", "revolute")]


def test_one_frame_of_a_pair_is_told() -> None:
    """An export that renames the other one would open the robot in silence."""
    (finding,) = read(FRAMES[0], FRAMES[2]).diagnostics
    assert (finding.code, finding.severity, finding.line) == ("loop-one-end", Severity.WARNING, 10)
    assert "there is no link 'closing_bar_2'" in finding.message


def test_a_misspelt_loop_joint_is_told() -> None:
    finding, error = read(LOOP_JOINT.replace("loop_joint", "loopjoint")).diagnostics
    assert (finding.code, finding.hint) == ("unknown-element", "perhaps 'loop_joint' is meant")
    assert error.code == "loop-joint", "the robot would be built open"


def test_two_configured_loops_of_one_name_are_one_error() -> None:
    option = LoopOption("bar", "ball", ("rod", "rocker"))
    assert loops(options=Options(loops=(option, LoopOption("bar", "ball", ("rod", "base"))))) == loops(
        options=Options(loops=(option,))
    )


@pytest.mark.parametrize(("element", "code", "words"), [
    (LOOP_JOINT.replace("rocker", "rockr"), "loop-of-no-link", "perhaps 'rocker' is meant"),
    (LOOP_JOINT.replace("rocker", "rod"), "loop-one-link", "name two links"),
    (LOOP_JOINT.replace('link="rocker"', ""), "missing-attribute", "add it"),
    (LOOP_JOINT.replace("0 0 2", "0 0 0"), "loop-axis", "give each axis a direction"),
    (LOOP_JOINT.replace("revolute", "prismatic"), "loop-joint", "ball, revolute, universal or fixed"),
    (LOOP_JOINT.replace("0.4 0.2 0", "0.4 0.2"), "bad-number", "decimal numbers"),
    (LOOP_JOINT.replace("<link2", "<child"), "missing-element", "add it"),
    (ENDS.replace('"parent"', '"root"'), "loop-joint", 'write the axis in the frame of the parent: frame="parent"'),
    (ENDS.replace('"rocker"', '"rockr"'), "loop-of-no-link", "perhaps 'rocker' is meant"),
    (ENDS.replace("0.2 0.3 0", "0.2 x 0"), "bad-number", "decimal numbers"),
    (DRAKE.replace("body_B", "body_C"), "missing-element", "add it"),
    (GAZEBO.replace("<parent>rod</parent>", ""), "missing-element", "add it"),
    (GAZEBO.replace("<child>rocker</child>", "<child>rockr</child>"), "loop-of-no-link", "perhaps 'rocker' is meant"),
    (GAZEBO.replace("<pose>", "<pose relative_to='rod'>"), "loop-joint", "use the frame of link 'rocker'"),
    (GAZEBO.replace("<xyz>", "<xyz expressed_in='__model__'>"), "loop-joint", "use the frame of link 'rocker'"),
    (LOOP_JOINT + LOOP_JOINT, "duplicate-loop", "rename or remove one loop"),
    (LOOP_JOINT + LOOP_JOINT.replace("closing", "again"), "loop-twice", "remove one of the two loops"),
])  # fmt: skip
def test_each_fault_is_one_error_with_its_line(element: str, code: str, words: str) -> None:
    (error,) = (found for found in read(element).diagnostics if found.severity is Severity.ERROR)
    assert (error.code, words in error.hint) == (code, True)
    assert error.line >= 10
