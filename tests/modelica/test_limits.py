"""Limit warnings are alive: as errors they stop the same model where a limit is passed, and only there.

So they do in the package, and in the robot that reads its record. All begin beyond the limit, since the embedded
compiler looks at what is inside `noEvent` at the beginning only; what is passed later is told from the results.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest
from support import generic
from support.modelica import DRIVES, Run, Series, Task, bench, simulate, simulate_all
from support.packages import generate, strict
from support.urdfs import joint, limit, link, mimic, robot

from urdfsync.analysis.simulation.joints import joint_results
from urdfsync.domain import Target
from urdfsync.domain.bench import JointSignals, Signal
from urdfsync.formats.urdf.benches import bench as bench_of

pytestmark = pytest.mark.slow

LOWER, UPPER, VELOCITY, EFFORT = -0.5, 0.8, 2.0, 10.0
INERTIA = 0.25
"""Mass and moment of inertia of what each drive moves; all motion is level, so that gravity does nothing."""

LID_EFFORT = 99.0
FINGER = 5.0
RATIO = 0.1
"""Mass of the finger, and its way per angle of the lid."""

SPEED_UP, SLOW_DOWN = 3.0, 2.0
BRAKE = f'<limit lower="-9" upper="9" acceleration="4" deceleration="{SLOW_DOWN}"/>'

LIMITS = limit(LOWER, UPPER, VELOCITY, EFFORT)
LEVEL = {"xyz": "0 0 0", "rpy": "0 0 0"}


def balanced(name: str) -> str:
    tensor = f'<inertia ixx="{INERTIA}" iyy="{INERTIA}" izz="{INERTIA}" ixy="0" ixz="0" iyz="0"/>'
    return f'<link name="{name}"><inertial><mass value="{INERTIA}"/>{tensor}</inertial></link>'


ROBOT = robot(
    link("base"),
    *(balanced(name) for name in ("arm", "wheel", "sledge", "flap", "disc", "block")),
    f'<link name="finger"><inertial><mass value="{FINGER}"/></inertial></link>',
    joint("my_elbow", "revolute", "base", "arm", axis="0 0 1", inside=[LIMITS], **LEVEL),
    joint("roll", "continuous", "base", "wheel", axis="0 0 1", inside=[LIMITS], **LEVEL),
    joint("rail", "prismatic", "base", "sledge", axis="1 0 0", inside=[LIMITS], **LEVEL),
    joint("spin", "continuous", "base", "disc", axis="0 0 1", inside=[f'<limit acceleration="{SPEED_UP}"/>'], **LEVEL),
    joint("feed", "prismatic", "base", "block", axis="1 0 0", inside=[BRAKE], **LEVEL),
    joint("lid", "revolute", "base", "flap", axis="0 0 1", inside=[limit(-9, 9, 99, LID_EFFORT)], **LEVEL),
    joint("grip", "prismatic", "flap", "finger", axis="1 0 0", inside=[mimic("lid", RATIO), limit(-0.02, 1)], **LEVEL),
    version="1.2",
)
"""Six drives of which five have close limits; grip follows lid, and is at its end where lid is at -0.2 rad."""

AXES = {"elbow": "my_elbowAxis"} | {name: f"{name}Axis" for name in ("lid", "roll", "rail", "spin", "feed")}
"""Each drive, and the flange of the robot that it moves."""

PASSING: Mapping[str, tuple[Mapping[str, float], str]] = {
    "lower": ({"elbow.a0": LOWER - 1e-3}, "my_elbow (joint my_elbow) is below its lower position limit"),
    "upper": ({"elbow.a0": UPPER + 1e-3}, "my_elbow (joint my_elbow) is above its upper position limit"),
    "velocity": ({"roll.a1": 1.01 * VELOCITY}, "roll (joint roll) is faster than its velocity limit"),
    "backward": ({"roll.a1": -1.01 * VELOCITY}, "roll (joint roll) is faster than its velocity limit"),
    "effort": ({"rail.a2": 1.01 * EFFORT / INERTIA}, "rail (joint rail) is driven above its effort limit"),
    "slide": ({"rail.a0": UPPER + 1e-3}, "rail (joint rail) is above its upper position limit"),
    "speeding up": (
        {"spin.a2": 1.01 * SPEED_UP},
        "spin (joint spin) speeds up faster than its acceleration limit",
    ),
    "no deceleration of its own": (
        {"spin.a1": 5.0, "spin.a2": -1.01 * SPEED_UP},
        "spin (joint spin) slows down faster than its deceleration limit",
    ),
    "slowing down": (
        {"feed.a1": -1.0, "feed.a2": 1.01 * SLOW_DOWN},
        "feed (joint feed) slows down faster than its deceleration limit",
    ),
    "leader": (
        {"lid.a2": 1.01 * LID_EFFORT / (INERTIA + RATIO**2 * FINGER)},
        "lid (joint lid) is driven above its effort limit",
    ),
    "follower": ({"lid.a0": -0.21}, "grip (joint grip) is below its lower position limit"),
}
"""Per limit: a motion that begins beyond this one alone, and what is said then."""

INSIDE: Mapping[str, tuple[Mapping[str, float], float]] = {
    "at rest": ({}, 1.0),
    "at one end": ({"elbow.a0": LOWER, "rail.a0": UPPER}, 1.0),
    "at the other end": ({"elbow.a0": UPPER, "rail.a0": LOWER}, 1.0),
    "as fast as allowed": ({"roll.a1": VELOCITY}, 1.0),
    "as strong as allowed": ({"rail.a2": 0.99 * EFFORT / INERTIA, "roll.a2": -0.99 * EFFORT / INERTIA}, 0.04),
    "leading as strong as allowed": ({"lid.a2": 0.99 * LID_EFFORT / (INERTIA + RATIO**2 * FINGER)}, 0.01),
    "speeding up as allowed": ({"spin.a2": -0.99 * SPEED_UP, "feed.a1": 1.0, "feed.a2": 0.99 * 4}, 1.0),
    "slowing down as allowed": ({"feed.a1": 5.0, "feed.a2": -0.99 * SLOW_DOWN}, 1.0),
    "far where there is no end": ({"roll.a0": 100.0}, 1.0),
}
"""Motions that pass no limit, and how long they last."""

IN_RECORD = (
    *("lower", "backward", "slide", "effort", "leader", "follower", "at rest", "leading as strong as allowed"),
    *("speeding up", "slowing down", "no deceleration of its own", "speeding up as allowed"),
)
"""The motions that the robot is put to that reads its record, too."""
RECORD_AXES = {
    "elbow": "rotationalAxis[2]",
    "lid": "rotationalAxis[1]",
    "roll": "rotationalAxis[3]",
    "rail": "translationalAxis[2]",
    "spin": "rotationalAxis[4]",
    "feed": "translationalAxis[1]",
}
"""In the order of its record."""
MILD = robot(
    link("base"),
    balanced("wheel"),
    joint("roll", "continuous", "base", "wheel", axis="0 0 1", inside=[LIMITS], **LEVEL),
    version="1.2",
)
"""One axis, for limits that do not stop the simulation."""


def driven(robot: str, axes: Mapping[str, str], runs: Sequence[Run], package: str = "Bot", classes: str = "") -> Task:
    """A bench with a robot, of this type and with these modifiers, and with a drive at each of its axes."""
    drives = (f"{'Translational' if name in ('rail', 'feed') else 'Rotational'}Drive {name};" for name in axes)
    connections = (f"connect({name}.flange, robot.{axis});" for name, axis in axes.items())
    body = [robot, *drives, "equation", "connect(world.frame_b, robot.frame_a);", *connections]
    return bench("\n    ".join(body), runs, packages=[package], classes=DRIVES + classes)


def test_passing_a_limit_is_noticed_and_nothing_else(modelica_library: Path, tmp_path: Path) -> None:
    """If it is an error; warnings, and limits that are off, do not stop the simulation."""
    packages = [
        strict(generate(ROBOT.encode(), Target("Bot", "Bot"))).write(tmp_path),
        generate(ROBOT.encode(), Target("Listed", "Bot"), approach=("record",)).write(tmp_path),
        generate(MILD.encode(), Target("Mild", "Bot")).write(tmp_path),
        strict(generate(MILD.encode(), Target("Off", "Bot"))).write(tmp_path),
    ]
    motions = {name: Run(1.0, 0.1, motion) for name, (motion, _) in PASSING.items()}
    motions |= {name: Run(stop, stop / 10, motion) for name, (motion, stop) in INSIDE.items()}
    some = {name: motions[name] for name in IN_RECORD}
    generic_robot = "GenericRobot robot(redeclare parameter Listed.BotParameters data, fixedStart = false);"
    package_robot = "{}.Bot robot(fixedStart = false, checkLimits = {});"
    tasks = [
        driven(package_robot.format("Bot", "true"), AXES, list(motions.values())),
        driven(generic_robot, RECORD_AXES, list(some.values()), "Listed", generic.strict_generic()),
        driven(package_robot.format("Mild", "true"), {"roll": "rollAxis"}, [motions["velocity"]], "Mild"),
        driven(package_robot.format("Off", "false"), {"roll": "rollAxis"}, [motions["velocity"]], "Off"),
    ]
    *strict_runs, with_warnings, with_limits_off = simulate_all(modelica_library, packages, tasks)
    for series in (with_warnings, with_limits_off):
        assert (series.error, series.times[-1]) == ("", 1.0)
    names = [*((".", name) for name in motions), *((" ", name) for name in some)]
    for (between, name), series in zip(names, strict_runs, strict=True):
        if name in INSIDE:
            assert (series.error, series.times[-1:].tolist()) == ("", [INSIDE[name][1]]), name
            continue
        _, message = PASSING[name]
        found = re.search(r"assert failed at t=0.0+: (.*)", series.error)
        assert found, series.error or f"{name}: the simulation ran to its end"
        joint_message = message if between == "." else message[message.index("(joint") :]
        assert found[1].strip() == f"Bench.robot{between}{joint_message}"


def test_later_passings_are_told_from_the_results(modelica_library: Path, tmp_path: Path) -> None:
    """Speed, acceleration and deceleration of the wheel of a robot in either approach."""
    brake = f'<limit velocity="{VELOCITY}" effort="{EFFORT}" acceleration="4" deceleration="{SLOW_DOWN}"/>'
    urdf = MILD.replace(LIMITS, brake)
    packages = [
        generate(urdf.encode(), Target("Wheel", "Bot")),
        generate(urdf.encode(), Target("Listed", "Bot"), approach=("record",)),
    ]
    robots = {
        "Wheel": ("Wheel.Bot robot(fixedStart = false);", "rollAxis"),
        "Listed": (
            "GenericRobot robot(redeclare parameter Listed.BotParameters data, fixedStart = false);",
            "rotationalAxis[1]",
        ),
    }
    runs = [Run(1.0, 0.01, {"roll.a2": -5.0}), Run(1.0, 0.01, {"roll.a1": 5.0, "roll.a2": -3.0})]
    tasks, layouts = [], []
    for package in packages:
        found = bench_of(package.robot, package.target, package.options)
        assert found
        layouts.append(found.layouts)
        declaration, axis = robots[package.target.package]
        declaration = declaration.replace("GenericRobot", "UrdfSync.Robots.GenericRobot", 1)
        names = [f"robot.{signal.variable}" for signal in signals(found.layouts[0][0])]
        task = driven(declaration, {"roll": axis}, runs, package.target.package)
        tasks.append(dataclasses.replace(task, values=names))
    numbers = {"velocity": VELOCITY, "effort": EFFORT, "acceleration": 4.0, "deceleration": SLOW_DOWN}
    all_series = iter(simulate(modelica_library, [package.write(tmp_path) for package in packages], tasks))
    for layout, prefix in zip(layouts, ("roll.parameters", "data.roll"), strict=True):
        parameters = {f"robot.{prefix}.limits.{name}": number for name, number in numbers.items()}
        for expected in (
            [("speed", -VELOCITY, 0.4), ("acceleration", 4.0, 0.0)],
            [("speed", VELOCITY, 0.0), ("acceleration", -SLOW_DOWN, 0.0)],
        ):
            series = next(all_series)
            (result,) = joint_results(layout, {"time": series.times.tolist(), **as_lists(series)}, parameters)
            passed = [(passed.quantity, passed.limit) for passed in result.passed]
            assert passed == [(quantity, limit) for quantity, limit, _ in expected]
            assert [one.time for one in result.passed] == pytest.approx([time for *_, time in expected], abs=0.02)


def signals(axis: JointSignals) -> list[Signal]:
    return [signal for signal in (axis.position, axis.velocity, axis.effort, axis.acceleration) if signal]


def as_lists(series: Series) -> dict[str, list[float]]:
    return {name: values.tolist() for name, values in series.values.items()}
