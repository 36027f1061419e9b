"""The experiment as the core sees it: content, notes, what is compared, and what Pinocchio says of it."""

from __future__ import annotations

import re
import sys
from typing import Any

import pytest
from msgspec.structs import replace
from support.loops import FOUR_BAR, to_options, to_urdf
from support.urdfs import dynamics, joint, limit, link, links, robot

from urdfsync.analysis.checks.compilation import compare_all
from urdfsync.common.diagnostics import SourceError
from urdfsync.domain import Target
from urdfsync.domain.experiment import TOLERANCE, Aspect, Experiment, MissingReferenceError, Quantity, Sample
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.physics.reference import read

BOT = Target("Bot", "Bot")
POSE = (("position", "m"), ("orientation", ""))
ARM = robot(
    *links(base=4.0, arm=2.5, drone=0.7),
    joint("elbow", "revolute", "base", "arm", inside=[dynamics(1, 1)]),
    joint("a slide", "prismatic", "base", "drone"),
)
ELBOW = robot(link("base", 4.0), link("arm", 2.5), joint("elbow", "revolute", "base", "arm"))
BARE = robot(link("base"), link("arm"), joint("elbow", "continuous", "base", "arm"))


def experiment(urdf: str, step: Any = None, **options: Any) -> Experiment:
    found = DOMAIN.checks.experiment(Sample(urdf.encode(), "robot.urdf", BOT, Options(**options), {}), step)
    assert isinstance(found, Experiment)
    return found


def test_everything_is_compared_from_the_root_outwards_and_has_an_expected_value() -> None:
    """Axes that slide and axes that turn are told in the order of the tree, not in that of flange vectors."""
    one = experiment(ARM)
    motion = one.trials[0]
    quantities = dict.fromkeys((each.quantity.value, each.element, each.unit) for each in motion.compared)
    assert [*quantities] == [
        *((quantity, f"link {name}", unit) for name in ("base", "drone", "arm") for quantity, unit in POSE),
        *(("effort", "joint a slide", "N"), ("effort", "joint elbow", "N·m")),
        *(("reaction", "link base", "N"), ("reaction", "link base", "N·m")),
        *(("mass", "robot", "kg"), ("centre of mass", "robot", "m")),
    ]
    for trial in one.trials:
        needed = {name for each in trial.compared for name in each.values}
        assert needed == {*trial.probe.values}
        assert needed < trial.expected.keys()
    assert motion.expected["mass"][:5] == pytest.approx((7.2,) * 5)
    assert re.fullmatch(r"Pinocchio \d+\.\d+\.\d+", one.reference)


def test_a_heavy_base_hides_no_lost_damping() -> None:
    """The base is held by 50 kN: against that, or against its torque, the loss would be nothing."""
    heavy = ARM.replace(link("base", 4.0), link("base", 5000.0)).replace(dynamics(1, 1), dynamics(1e-7, 0))
    one, undamped = experiment(heavy), experiment(heavy.replace(dynamics(1e-7, 0), ""))
    found = compare_all(one.trials[:1], {"motion": undamped.trials[0].expected})
    (elbow,) = [each for each in found if each.relative > TOLERANCE]
    assert (elbow.quantity, elbow.element) == (Quantity.EFFORT, "joint elbow")
    assert elbow.difference < TOLERANCE * max(each.size for each in found if each.quantity is Quantity.REACTION)


def test_what_is_made_up_is_said_and_read_by_both_sides() -> None:
    one = experiment(BARE)
    assert one.notes == (
        "inertias were made up for 2 links of the generated package only, since moving links need a mass",
    )
    reading = DOMAIN.read(one.content, "robot.urdf", Options())
    assert reading.snapshot is not None
    assert next(link.inertial.mass for link in reading.snapshot.links if link.name == "arm") > 0


def test_a_source_that_can_not_be_read_says_what_is_wrong() -> None:
    with pytest.raises(SourceError, match="duplicate-link"):
        experiment("<robot name='a'><link name='b'/><link name='b'/></robot>")
    lacking = joint("elbow", "revolute", "base", "arm", inside=['<limit lower="-1" upper="1" velocity="1"/>'])
    with pytest.raises(SourceError, match=r"Pinocchio [\d.]+ can't read this file"):
        read(robot(link("base"), link("arm"), lacking).encode(), "robot.urdf")


def test_mujoco_is_the_reference_without_pinocchio_and_without_both_there_is_no_experiment(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "urdfsync.formats.urdf.physics.pinocchio_robot", None)
    one = experiment(ARM)
    assert re.fullmatch(r"MuJoCo \d+\.\d+\.\d+", one.reference)
    assert one.trials[0].expected["mass"][:5] == pytest.approx((7.2,) * 5)
    monkeypatch.setitem(sys.modules, "urdfsync.formats.urdf.physics.mujoco_robot", None)
    with pytest.raises(MissingReferenceError, match=r"neither Pinocchio nor MuJoCo can be loaded.*no-reference"):
        experiment(ARM)


@pytest.mark.parametrize("kind", ["planar", "floating"])
@pytest.mark.parametrize("approach", [("package",), ("record",)])
def test_a_robot_with_a_joint_that_nothing_drives_is_not_compared(kind: str, approach: tuple[str, ...]) -> None:
    loose = ELBOW.replace('type="revolute"', f'type="{kind}"').encode()
    options = Options(approach=approach)  # type: ignore[arg-type]
    assert DOMAIN.checks.experiment(Sample(loose, "robot.urdf", BOT, options, {})) == (
        f"joint elbow is {kind}, and nothing prescribes its motion"
    )


def test_a_ball_turns_as_prescribed_and_freely_and_its_whole_torque_is_compared() -> None:
    ball = ARM.replace('type="revolute"', 'type="ball"')
    one = experiment(ball, approach=("package", "record"))
    motion, free = one.trials
    torques = [each for each in motion.compared if each.element == "joint elbow" and each.quantity is Quantity.EFFORT]
    assert [len(each.values) for each in torques] == [3, 3]
    spins = [each for each in free.compared if each.element == "joint elbow"]
    assert [(each.quantity, each.values) for each in spins] == [
        (Quantity.ACCELERATION, ("gain2[1]", "gain2[2]", "gain2[3]"))
    ]
    assert "the record, which has no tables for robots with ball joints" in one.unchecked
    load = '<gazebo reference="elbow"><sensor name="load" type="force_torque"/></gazebo></robot>'
    sensed = experiment(ball.replace("</robot>", load))
    assert "sensor load, in a ball: the drive of the ball bypasses the sensor" in sensed.unchecked
    assert Aspect.SENSORS not in {each.part for each in sensed.trials[0].compared}
    options = Options(approach=("record",))
    assert DOMAIN.checks.experiment(Sample(ball.encode(), "robot.urdf", BOT, options, {})) == (
        "joint elbow is ball, and nothing prescribes its motion"
    )


def test_the_acceleration_of_an_edited_joint_with_other_parts_is_that_of_its_flange() -> None:
    sample = Sample(ELBOW.encode(), "robot.urdf", BOT, Options(), {}, {"Joints/Elbow.mo": b"  Revolute hinge(\n"})
    values = [DOMAIN.checks.experiment(each).trials[1].probe.values for each in (sample, replace(sample, texts={}))]
    assert ["gain1" in each for each in values] == [True, False]
    assert ["robot.elbow.revolute.a" in each for each in values] == [False, True]


def test_no_acceleration_follows_from_an_effort_on_no_mass() -> None:
    """The arm weighs something, but all of it is on the axis: a compiler may give any acceleration."""
    point = ELBOW.replace('value="2.5"', 'value="1"')
    for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"):
        point = re.sub(rf'{name}="[^"]*"', f'{name}="0"', point)
    point = point.replace('xyz="0.02 -0.05 0.1"', 'xyz="0 0 0"')
    one = experiment(point)
    assert [trial.name for trial in one.trials] == ["motion"]
    assert any("moves no mass" in sentence for sentence in one.unchecked)


def test_laws_that_the_reference_does_not_have_are_named_and_made_simple() -> None:
    laws = {"friction": {"elbow": "lugre"}, "elastic": "all"}
    one = experiment(ARM, **laws)
    assert one.options == Options()
    assert one.trials == experiment(ARM).trials
    assert one.unchecked[:2] == (
        "friction of elbow (lugre) inside of the robot: the compared package has a smooth one",
        "drive of a slide, elbow (elastic) inside of the robot: the compared package has a rigid one",
    )


@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_a_robot_with_loops_is_moved_by_its_states_and_its_loops_are_compared(base: str) -> None:
    one = experiment(to_urdf(FOUR_BAR), **to_options(FOUR_BAR), base=base, approach=("package", "record"))
    assert [trial.name for trial in one.trials] == ["motion", "free motion"]
    motion, free = one.trials
    assert {each.element for each in motion.compared if each.quantity is Quantity.EFFORT} == {"joint crank_pivot"}
    gap, force, torque = (each for each in motion.compared if each.part is Aspect.LOOPS)
    assert [gap.quantity, force.unit, torque.unit] == [Quantity.CLOSURE, "N", "N·m"]
    assert [motion.expected[name] for name in gap.values] == [pytest.approx((0,) * 5, abs=1e-12)] * 3
    assert [max(map(abs, motion.expected[name][:5])) > 1 for name in force.values] == [True, True, False]
    assert {each.element for each in free.compared if each.quantity is Quantity.ACCELERATION} >= {"joint crank_pivot"}
    assert "crank_pivot(w_start" in free.probe.source, "it begins where the loop is closed"
    assert "the record, which has no loops" in one.unchecked


@pytest.mark.parametrize(("urdf", "options"), [(ARM, {}), (to_urdf(FOUR_BAR), to_options(FOUR_BAR))])
def test_with_a_step_poses_and_efforts_are_expected_over_time_and_the_verdict_stays(
    urdf: str, options: dict[str, Any]
) -> None:
    motion, plain = (experiment(urdf, step, **options).trials[0] for step in (0.2, None))
    assert (motion.compared, motion.probe.source) == (plain.compared, plain.probe.source)
    assert repr(motion.expected) == repr(plain.expected)  # NaN is among them
    assert (motion.probe.step, plain.probe.step, plain.over_time) == (0.2, 1.0, ())
    assert {each.quantity for each in motion.over_time} == {Quantity.POSITION, Quantity.ORIENTATION, Quantity.EFFORT}
    for each in motion.over_time:
        assert each.instants == pytest.approx([0.2 * k for k in range(21)])
        for name in each.values:
            drawn = motion.expected_over_time[name]
            assert drawn[::5] == pytest.approx(motion.expected[name][:5], abs=1e-12)
            assert len(drawn) == 21


def test_limits_that_are_the_greatest_numbers_are_none() -> None:
    endless = limit(-1.7e308, 1.7e308, 1.7e308, 1.7e308)
    one = experiment(robot(*links(base=1, arm=1), joint("elbow", "revolute", "base", "arm", inside=[endless])))
    assert not re.search(r"inf|nan", one.trials[0].probe.source)


def test_a_package_without_joints_is_moved_without_the_record_that_it_does_not_have() -> None:
    alone = robot(link("base", 1.0))
    assert not any("BotParameters" in trial.probe.source for trial in experiment(alone).trials)
    assert any("BotParameters" in trial.probe.source for trial in experiment(alone, approach=("record",)).trials)


def test_the_record_alone_is_compared_through_the_generic_robot() -> None:
    one, package = experiment(ELBOW, approach=("record",)), experiment(ELBOW)
    assert (
        "UrdfSync.Robots.GenericRobot robot(redeclare parameter Bot.BotParameters data, " in one.trials[0].probe.source
    )
    axes = [value for value in package.trials[0].probe.values if "base.frame_a.R.T" in value]
    transposed = [re.sub(r".*\[(.),(.)\]", r"robot.R_0[1,\2,\1]", value) for value in axes]
    assert [value for value in one.trials[0].probe.values if "R_0[1," in value] == transposed
    elements = {each.element for each in one.trials[0].compared}
    assert elements == {each.element for each in package.trials[0].compared}
    both = experiment(ELBOW, approach=("package", "record"))
    assert [trial.name for trial in both.trials] == [
        *("motion", "free motion"),
        *("motion of the record", "free motion of the record"),
    ]
