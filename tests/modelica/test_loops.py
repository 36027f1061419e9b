"""Generated robots with loops stay closed, lose no energy, and are moved by the drives that loops leave."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace
from support import recorded_omc
from support.cases import sampled
from support.loops import FOUR_BAR, ROBOTS
from support.modelica import DRIVES, GRAVITY, Run, Series, Task, bench, compile_task, simulate
from support.packages import generate_robot

from urdfsync.analysis.checks.compilers import omc
from urdfsync.domain import Target
from urdfsync.formats.urdf.robot import Robot

OPENMODELICA = pytest.param("omc", marks=pytest.mark.skipif(omc.program("") is None, reason="no OpenModelica"))
RECORDED = ("FourBar", "FiveBar", "SliderCrank", "Spatial")
"""Robots of which conversations with OpenModelica were recorded."""
FRAMES = "Modelica.Mechanics.MultiBody.Frames"


def energies(robot: Robot) -> Iterator[str]:
    """The energy of each link; inertias are diagonal, in link axes."""
    for link in robot.links:
        if link.inertial:
            m, inertia, (x, y, z) = link.inertial.mass, link.inertial.inertia, link.inertial.origin.xyz
            body, centre = f"robot.{link.name}.body", f"{{{x}, {y}, {z}}}"
            velocity = f"({FRAMES}.resolve2({body}.frame_a.R, {body}.v_0) + cross({body}.w_a, {centre}))"
            momentum = f"diagonal({{{inertia.ixx}, {inertia.iyy}, {inertia.izz}}})*{body}.w_a"
            height = f"({body}.frame_a.r_0 + {FRAMES}.resolve1({body}.frame_a.R, {centre}))*{{0, 0, 1}}"
            yield f"{m}*{GRAVITY}*({height}) + {m}/2*({velocity}*{velocity}) + {body}.w_a*({momentum})/2"


def driven(name: str) -> str:
    """The variable of the first joint's angle."""
    return f"robot.{ROBOTS[name].joints[0].name}.revolute.phi"


def gap(name: str) -> str:
    """The variable of the loop's gap."""
    (loop,) = ROBOTS[name].loops
    return f"robot.{loop.name}.gap"


def fall(name: str) -> Task:
    """A robot in free fall, with its energy."""
    body = f"{name}.{name} robot;\n    Real energy = {' + '.join(energies(ROBOTS[name]))};\n"
    body += "  equation\n    connect(world.frame_b, robot.frame_a);"
    runs = [Run(stop=0.3, step=0.01, tolerance=1e-10)]
    return bench(body, runs, [driven(name), gap(name), "energy"], packages=[name])


def assert_right(name: str, fallen: Series, *others: Series) -> None:
    """The robot moves, its loop stays closed, and its fall keeps its energy."""
    for run in (fallen, *others):
        assert np.ptp(run.values[driven(name)]) > 0.3
        assert run.values[gap(name)].max() < 1e-8
    assert np.ptp(fallen.values["energy"]) < 1e-6


def swing(name: str, tool: str, folder: Path, library: Path) -> tuple[Series, Series]:
    """A robot in Test, and in free fall."""
    package = generate_robot(ROBOTS[name], Target(name, name)).write(folder)
    runs, values = [Run(stop=5, step=0.05, tolerance=1e-9)], [driven(name), gap(name)]
    tasks = [compile_task(f"{name}.{name}Test", name, runs=runs, values=values), fall(name)]
    swept, fallen = simulate(library, [package], tasks, tool=tool)
    assert_right(name, fallen, swept)
    return swept, fallen


@pytest.mark.slow
@pytest.mark.parametrize("tool", ["recorded", OPENMODELICA])
@pytest.mark.parametrize("name", sampled(RECORDED, 6))
def test_two_compilers_keep_a_loop_closed_and_move_it_alike(
    name: str, tool: str, tmp_path: Path, modelica_library: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    expected = swing(name, "rumoca", tmp_path, modelica_library)
    if tool == "recorded":
        recorded_omc.install(name, tmp_path / "bin")
        monkeypatch.setenv("PATH", str(tmp_path / "bin"), prepend=":")
    runs = swing(name, "omc", tmp_path, modelica_library)
    if recorded_omc.RECORDER:
        recorded_omc.keep(name, runs)
    for one, other in zip(runs, expected, strict=True):
        angle = driven(name)
        at_times = np.interp(other.times, one.times, one.values[angle])  # one of them repeats an instant
        np.testing.assert_allclose(at_times, other.values[angle], rtol=0, atol=1e-5)


@pytest.mark.slow
@pytest.mark.large  # loops of two compilers are in the test above
@pytest.mark.parametrize("tool", ["rumoca", OPENMODELICA])
@pytest.mark.parametrize("name", [name for name in ROBOTS if name not in RECORDED])
def test_a_loop_stays_closed_and_keeps_its_energy(name: str, tool: str, tmp_path: Path, modelica_library: Path) -> None:
    package = generate_robot(ROBOTS[name], Target(name, name)).write(tmp_path)
    assert_right(name, *simulate(modelica_library, [package], [fall(name)], tool=tool))


@pytest.mark.slow
@pytest.mark.parametrize("tool", ["rumoca", OPENMODELICA])
@pytest.mark.large  # loops of two compilers are in the test above
def test_joints_follow_the_pose_that_they_come_from(tool: str, tmp_path: Path, modelica_library: Path) -> None:
    """Through two turns of a crank, and where a crank that is too long to turn stops and the rocker goes on."""
    pivot, pin, rocker = FOUR_BAR.joints
    short = replace(rocker, origin=replace(rocker.origin, xyz=(0.3, 0.0, 0.0)))
    robots = {"Whole": FOUR_BAR, "Short": replace(FOUR_BAR, joints=(pivot, pin, short))}
    packages = [generate_robot(robot, Target(name, name)).write(tmp_path) for name, robot in robots.items()]
    positions = [f"robot.{joint.name}.revolute.phi" for joint in FOUR_BAR.joints]
    drive = f"RotationalDrive drive(a0 = {pivot.start}, a1 = {math.tau});"
    in_world = "connect(world.frame_b, robot.frame_a);"
    body = f"Whole.Whole robot(fixedStart = false);\n    {drive}\n  equation\n    {in_world}"
    body += " connect(drive.flange, robot.crank_pivotAxis);"
    runs, values = [Run(stop=2, step=0.02, tolerance=1e-9)], [*positions, "robot.rocker_pin.gap"]
    fall = f"Short.Short robot;\n    Real energy = {' + '.join(energies(FOUR_BAR))};\n  equation\n    {in_world}"
    tasks = [
        bench(body, runs, values, packages=["Whole"], classes=DRIVES),
        bench(fall, runs, [*values, "energy"], packages=["Short"]),
    ]
    turned, fallen = simulate(modelica_library, packages, tasks, tool=tool)
    ways = [turned.values[name][-1] - turned.values[name][0] for name in positions]
    assert ways == pytest.approx([2 * math.tau, -2 * math.tau, 0], abs=1e-7)
    assert np.ptp(fallen.values["energy"]) < 1e-6
    assert max(run.values["robot.rocker_pin.gap"].max() for run in (turned, fallen)) < 1e-8
