"""Leaders of mimic joints begin and sweep where their followers keep their limits, too."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from support.modelica import DRIVES, Run, Series, bench, simulate
from support.packages import generate
from support.urdfs import joint, limit, link, mimic, robot

from urdfsync.domain import Target

pytestmark = pytest.mark.slow

INF = float("inf")

JOINTS = {
    "lead": ("revolute", None, limit(-1, 2, velocity=1.5)),
    "back": ("revolute", ("lead", -0.5, 0.1), limit(-0.3, 0.4, velocity=10)),
    "tip": ("prismatic", ("back", 0.02, 0.004), limit(0.002, 0.008, velocity=0.01)),
    "still": ("revolute", ("lead", 0.0, 0.2), limit(0.1, 0.3, velocity=1)),
    "rail": ("prismatic", None, limit(-0.5, 0.5, velocity=2)),
    "rack": ("prismatic", ("rail", -2.0, 0.3), limit(0.5, 0.9, velocity=1)),
    "pinion": ("continuous", ("rail", 10.0, 0.0), limit(-0.1, 0.1, velocity=0.1)),
    "rolled": ("revolute", ("rail", -4.0, 0.0), limit(0.6, 3, velocity=100)),
    "wheel": ("continuous", None, ""),
    "spun": ("continuous", ("wheel", 3.0, 0.0), ""),
    "crank": ("continuous", None, ""),
    "rocker": ("revolute", ("crank", -1.0, 0.0), limit(0.5, 1.5, velocity=10)),
    "rod": ("prismatic", ("crank", 0.1, 0.2), limit(0.1, 0.2, velocity=10)),
}
"""Type; leader, multiplier and offset; limits. Turning follows turning, sliding turning (once by way of another
follower), sliding sliding, and turning sliding."""

ROBOT = robot(
    link("base"),
    *(link(f"{name}_link", 0.1) for name in JOINTS),
    *(
        joint(
            name,
            kind,
            "base",
            f"{name}_link",
            axis="0 0 1",
            rpy="0 0 0",
            inside=[mimic(*follows) if follows else "", limits],
        )
        for name, (kind, follows, limits) in JOINTS.items()
    ),
)

RANGES = {
    "tip": (0.002, 0.008, 0.01),
    "back": (-0.1, 0.2, 0.5),
    "still": (0.1, 0.3, 1),
    "lead": (-0.2, 0.4, 1),
    "rack": (0.5, 0.9, 1),
    "pinion": (-INF, INF, 0.1),
    "rolled": (0.6, 3, 100),
    "rail": (-0.3, -0.15, 0.01),
    "spun": (-INF, INF, INF),
    "wheel": (-INF, INF, INF),
    "rocker": (0.5, 1.5, 10),
    "rod": (0.1, 0.2, 10),
    "crank": (-1, -0.5, 10),
}
"""Smallest and largest position, and speed, that a joint and all that follow it allow, followers first."""

WAYS = {"lead": (0, 0.36), "rail": (-0.15, -0.15 - 0.9 * 0.01 * 10 / np.pi), "wheel": (0, 1), "crank": (-0.5, -0.95)}
"""Beginning and turning point of each leader: 90 % of the roomier side, as far as speed and reach allow."""

FAR = 1e50
"""What is farther is no limit: Modelica has no infinite numbers."""
STOP = 0.01


def names(name: str) -> tuple[str, str, str]:
    """Kind of motion, position and speed of a joint, as Modelica has them."""
    return ("Translational", "s", "v") if JOINTS[name][0] == "prismatic" else ("Rotational", "phi", "w")


def position(name: str) -> str:
    """The variable of a joint's position."""
    return f"robot.{name}.{'prismatic.s' if JOINTS[name][0] == 'prismatic' else 'revolute.phi'}"


def ways() -> str:
    """Each leader goes from its start to the turning point of a sweep; what is known of each joint is a variable."""
    parts, connections = ["Bot.Bot robot(fixedStart = false, checkLimits = false);"], []
    for name in JOINTS:
        kind, q, v = names(name)
        known = [f"robot.{name}.{part}" for part in (f"{q}_min", f"{q}_max", f"{v}_max", f"{q}_start")]
        parts.append(f"Real {name}_range[4] = {{{', '.join(known)}}};")
        if name in WAYS:
            lower, upper, speed, start = known
            reach = 1 if kind == "Rotational" else 0.1
            end = f"UrdfSync.Functions.sweepEnd({start}, {lower}, {upper}, {speed}, 10, {reach})"
            parts.append(f"{kind}Drive {name}Drive(a0 = {start}, a1 = ({end} - {start})/{STOP});")
            connections.append(f"connect({name}Drive.flange, robot.{name}Axis);")
    return "\n    ".join([*parts, "equation", "connect(world.frame_b, robot.frame_a);", *connections])


@pytest.fixture(scope="module")
def series(modelica_library: Path, tmp_path_factory: pytest.TempPathFactory) -> Series:
    """The way from the start to the turning point."""
    folder = generate(ROBOT.encode(), Target("Bot", "Bot")).write(tmp_path_factory.mktemp("mimic"))
    values = [f"{name}_range[{k}]" for name in JOINTS for k in (1, 2, 3, 4)]
    values += [position(name) for name in JOINTS]
    (run,) = simulate(modelica_library, [folder], [bench(ways(), [Run(STOP, STOP / 4)], values, classes=DRIVES)])
    return run


def limits_of(name: str, series: Series) -> tuple[float, ...]:
    """Smallest and largest position and speed in use, as the robot has them."""
    found = (float(series.values[f"{name}_range[{k}]"][0]) for k in (1, 2, 3))
    return tuple(np.copysign(INF, value) if abs(value) > FAR else value for value in found)


def test_ranges_are_those_that_all_followers_allow(series: Series) -> None:
    """Chains of followers, multipliers below zero and zero, and joints without end stops."""
    found = {name: limits_of(name, series) for name in RANGES}
    assert found == {name: pytest.approx(expected, rel=1e-12) for name, expected in RANGES.items()}


def test_joints_begin_in_their_ranges(series: Series) -> None:
    """Leaders closest to zero, followers where that takes them."""
    expected = {name: start for name, (start, _) in WAYS.items()}
    for name, (_, follows, _) in JOINTS.items():
        if follows:
            expected[name] = follows[1] * expected[follows[0]] + follows[2]
    assert {name: series.values[f"{name}_range[4]"][0] for name in expected} == pytest.approx(expected, abs=1e-12)
    assert {name: series.values[position(name)][0] for name in expected} == pytest.approx(expected, abs=1e-12)


def test_leaders_sweep_as_far_as_their_followers_can(series: Series) -> None:
    found = {name: series.values[position(name)][-1] for name in WAYS}
    assert found == pytest.approx({name: end for name, (_, end) in WAYS.items()}, abs=1e-9)


def test_nobody_leaves_its_range_on_the_way(series: Series) -> None:
    for name, (lower, upper, _) in RANGES.items():
        q = series.values[position(name)]
        assert lower - 1e-9 <= q.min(), name
        assert q.max() <= upper + 1e-9, name
