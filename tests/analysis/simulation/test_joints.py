"""Joints over a simulation: which robot of a model they are in, and the limits that they pass."""

from __future__ import annotations

import math
import re

import pytest

from urdfsync.analysis.simulation.joints import joint_results, loop_results, pattern, robots
from urdfsync.analysis.simulation.results import LoopResult, PassedLimit, Range
from urdfsync.domain.bench import Bench, JointSignals, LoopSignals, Signal

ELBOW = JointSignals(
    "joint elbow",
    Signal("elbow.phi", "rad", ("elbow.lower", "elbow.upper")),
    Signal("elbow.w", "rad/s", ("elbow.fastest",)),
    Signal("elbowAxis.tau", "N·m", ("elbow.strongest",), (("elbow.ratio", "elbowMotor.tau"),)),
)
WRIST = JointSignals("joint wrist", Signal("wrist.phi", "rad"), Signal("wrist.w", "rad/s"))
PIN = LoopSignals("loop pin", "pin.gap", *(tuple(f"pin.{name}[{i}]" for i in (1, 2, 3)) for name in ("f", "t")))
TIMES = (0.0, 1.0, 2.0, 3.0)


def test_quantities_are_held_against_the_limits_of_the_model() -> None:
    series = {"time": TIMES, "elbow.phi": (0.0, 1.0, 2.0, 1.5), "elbow.w": (0.0, -3.0, 0.0, 0.0)}
    parameters = {"elbow.lower": -1.0, "elbow.upper": 1.25, "elbow.fastest": 2.0}
    (found,) = joint_results([[ELBOW]], series, parameters)
    assert found.position == Range("elbow.phi", "rad", 0.0, 2.0, -1.0, 1.25)
    assert found.speed == Range("elbow.w", "rad/s", -3.0, 0.0, -2.0, 2.0)
    assert found.effort is None, "the model has no such variable"
    assert found.passed == (
        PassedLimit("position", 1.25, 2.0, 0.75, 1.0),
        PassedLimit("speed", -2.0, 1.0, 1.0, 1.0),
    )


def test_what_a_motor_gives_through_its_gear_is_a_part_of_the_effort() -> None:
    series = {"time": TIMES, "elbow.phi": [0.0] * 4, "elbowAxis.tau": [1.0] * 4, "elbowMotor.tau": (0.0, 0.1, 0.2, 0.3)}
    (found,) = joint_results([[ELBOW]], series, {"elbow.ratio": 50.0, "elbow.strongest": 12.0})
    assert found.effort == Range("elbowAxis.tau", "N·m", 1.0, 16.0, -12.0, 12.0)
    assert [(one.quantity, one.time) for one in found.passed] == [("effort", 3.0)]


@pytest.mark.parametrize(("first", "last", "passes"), [
    (1.0, 1.0, False), (1 + 9e-7, 1 + 9e-7, False), (1 + 2e-6, 1 + 2e-6, True), (0.0, -5.0, False),
    (0.0, 1 + 2e-5, False), (0.0, 1 + 2e-4, True), (0.999, 1 + 2e-5, True),
])  # fmt: skip
def test_rounding_and_integration_pass_no_limit(first: float, last: float, passes: bool) -> None:
    """The integration errs by a share of the way that a joint goes: one that hardly moves does not."""
    series = {"time": (0.0, 1.0), "elbow.phi": (first, last)}
    (found,) = joint_results([[ELBOW]], series, {"elbow.upper": 1.0, "elbow.lower": -math.inf})
    assert bool(found.passed) is passes
    assert found.position is not None
    assert found.position.lower is None


def test_infinite_limits_are_none() -> None:
    series = {"time": (0.0, 1.0), "elbow.phi": (0.0, 1e6)}
    (found,) = joint_results([[ELBOW]], series, {"elbow.upper": 1.7976931348623157e308, "elbow.lower": -1e301})
    assert found.position == Range("elbow.phi", "rad", 0.0, 1e6, None, None)


def test_a_body_with_angles_is_no_numbered_robot() -> None:
    """`Body` of the standard library has `phi[1]`, but not the other variables of the generic robot."""
    numbered = [JointSignals(ELBOW.element, Signal("phi[1]", "rad"), Signal("w_phi[1]", "rad/s"))]
    names = "time robot.elbow.phi robot.elbow.w robot.base.body.phi[1] robot.base.body.w_a[1]".split()
    assert robots([[ELBOW], numbered], dict.fromkeys(names, (0.0,))) == [("robot", [ELBOW])]


def test_robots_are_found_wherever_they_are() -> None:
    names = ["cell.left.elbow.phi", "cell.left.wrist.phi", "right.elbow.phi", "right.wrist.phi", "puppet.elbow.phi"]
    series = dict.fromkeys((*names, "time", "myelbow.phi"), (0.0,))
    arm = [ELBOW, WRIST]
    assert robots([arm], series) == [("cell.left", arm), ("right", arm)], "a puppet with an elbow alone is none"
    found = joint_results([[ELBOW, WRIST]], series, {})
    assert [(one.robot, one.element) for one in found] == [
        ("cell.left", "joint elbow"), ("cell.left", "joint wrist"), ("right", "joint elbow"), ("right", "joint wrist"),
    ]  # fmt: skip


def test_a_model_may_be_the_robot_itself_or_have_none() -> None:
    assert robots([[ELBOW, WRIST]], {"elbow.phi": (0.0,), "time": (0.0,)}) == [("", [ELBOW, WRIST])]
    assert joint_results([[ELBOW, WRIST]], {"time": (0.0,)}, {}) == []


def test_the_pattern_covers_all_that_is_read() -> None:
    wanted = re.compile(pattern(Bench("", "", ((ELBOW,), (WRIST,)), loops=(PIN,))))
    names = (
        "elbow.phi",
        "robot.elbow.upper",
        "a.b.elbowMotor.tau",
        "robot.elbow.ratio",
        "robot.wrist.w",
        "robot.pin.f[3]",
    )
    for name in names:
        assert wanted.fullmatch(name), name
    for name in ("robot.elbow_phi", "robot.myelbow.phi", "robot.elbow.phi.x", "time"):
        assert not wanted.fullmatch(name), name


def test_loops_tell_their_greatest_gap_and_the_sizes_of_force_and_torque() -> None:
    series = {"robot.elbow.phi": (0.0, 1.0), "robot.pin.gap": (1e-9, 2e-9)}
    series |= dict.fromkeys((f"robot.{name}" for name in (*PIN.force, *PIN.torque)), (0.0, 0.0))
    series |= {"robot.pin.f[1]": (-3.0, 0.0), "robot.pin.f[3]": (4.0, -4.5), "robot.pin.t[2]": (0.0, -0.5)}
    bench = Bench("", "", ((ELBOW,),), loops=(PIN,))
    assert [*loop_results(bench, series)] == [LoopResult("loop pin", "robot", 2e-9, 5.0, 0.5)]
    bushing = {name: values for name, values in series.items() if ".f" not in name}
    assert [*loop_results(bench, bushing)] == []


def test_a_robot_of_numbered_axes_is_found_as_well_and_no_vector_of_a_controller() -> None:
    numbered = [
        JointSignals(axis.element, Signal(f"phi[{i}]", "rad"), Signal(f"w[{i}]", "rad/s"))
        for i, axis in enumerate((ELBOW, WRIST), 1)
    ]
    one = dict.fromkeys(("time", "robot.phi[1]", "robot.phi[2]", "controller.phi[1]"), (0.0,))
    assert robots([[ELBOW, WRIST], numbered], one) == [("robot", numbered)]
    both = one | dict.fromkeys(("arm.elbow.phi", "arm.wrist.phi"), (0.0,))
    assert robots([[ELBOW, WRIST], numbered], both) == [("arm", [ELBOW, WRIST]), ("robot", numbered)]
