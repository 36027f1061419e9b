"""The generic robot draws its visuals where the package approach draws them."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
from support import urdfs
from support.modelica import Run, bench, execute
from support.packages import generate

from urdfsync.domain import Target

pytestmark = pytest.mark.slow

MESHES = Path(__file__).resolve().parents[1] / "golden" / "meshes"
POSE = '<origin xyz="0.1 0.2 -0.3" rpy="0.4 -0.5 0.6"/>'
RED = '<material name="red"><color rgba="1 0 0 0.5"/></material>'


def visual(geometry: str) -> str:
    return f"<visual>{POSE}<geometry>{geometry}</geometry>{RED}</visual>"


def link(name: str, *geometries: str) -> str:
    return urdfs.link(name, 1.0).replace("</link>", "".join(map(visual, geometries)) + "</link>")


SHAPES = urdfs.robot(
    link("base", '<box size="0.1 0.2 0.3"/>'),
    urdfs.link("bare", 1.0),
    link(
        "arm",
        '<mesh filename="meshes/lost.obj"/>',
        '<cylinder radius="0.1" length="0.5"/>',
        '<sphere radius="0.2"/>',
        '<capsule radius="0.05" length="0.4"/>',
        '<mesh filename="meshes/wedge.obj" scale="2 2 -1"/>',
        '<ellipsoid radii="0.1 0.2 0.3"/>',
    ),
    urdfs.joint("swing", "revolute", "base", "bare", axis="0 1 0"),
    urdfs.joint("slide", "prismatic", "bare", "arm", axis="1 0 0"),
)
PAIRS = {
    1: "base.visual1.shape",
    2: "arm.visual2.shape",
    3: "arm.visual3.shape",
    4: "arm.visual4.shape",
    5: "arm.visual4.lowerEnd",
    6: "arm.visual4.upperEnd",
    7: "arm.visual5.shape",
    8: "arm.visual6.shape",
}
"""Entry of the table, and what the package approach draws."""
BESIDE = """\
Bot.Bot robot(fixedStart = false);
    UrdfSync.Robots.GenericRobot generic(fixedStart = false, redeclare parameter Bot.BotParameters data);
    Modelica.Mechanics.Rotational.Sources.Position turn[2](each exact = true);
    Modelica.Mechanics.Translational.Sources.Position move[2](each exact = true);
  equation
    connect(world.frame_b, robot.frame_a);
    connect(world.frame_b, generic.frame_a);
    connect(turn[1].flange, robot.swingAxis);
    connect(turn[2].flange, generic.rotationalAxis[1]);
    connect(move[1].flange, robot.slideAxis);
    connect(move[2].flange, generic.translationalAxis[1]);
    for k in 1:2 loop
      turn[k].phi_ref = 0.3 + 100*time^2;
      move[k].s_ref = 0.1 + 100*time^2;
    end for;"""
UNSEEN = """\
UrdfSync.Robots.GenericRobot generic(animation = false, redeclare parameter Bot.BotParameters data);
  equation
    connect(world.frame_b, generic.frame_a);"""
VECTORS = ("r", "r_shape", "lengthDirection")
NUMBERS = ("length", "width", "height", "color[1]", "color[2]", "color[3]")


def values(shape: str) -> list[str]:
    """What is drawn of a shape, but for its type."""
    vectors = [f"{shape}.{name}[{i}]" for name in VECTORS for i in (1, 2, 3)]
    matrix = [f"{shape}.R.T[{i},{j}]" for i in (1, 2, 3) for j in (1, 2, 3)]
    return [*vectors, *matrix, *(f"{shape}.{name}" for name in NUMBERS)]


def test_all_shapes_are_where_the_package_approach_has_them(modelica_library: Path, tmp_path: Path) -> None:
    source = tmp_path / "robot.urdf"
    source.write_text(SHAPES)
    shutil.copytree(MESHES, tmp_path / "meshes")
    package = generate(source, Target("Bot", "Bot"), approach=("package", "record"))
    pairs = [(f"generic.shape[{k}]", f"robot.{name}") for k, name in PAIRS.items()]
    wanted = [value for pair in pairs for shape in pair for value in values(shape)]
    tasks = [
        bench(BESIDE, [Run()], wanted, is_animated=True),
        bench(UNSEEN, [Run()], ["generic.shape[1].r[1]"], is_animated=True),
    ]
    seen, unseen = execute(modelica_library, [package.write(tmp_path / "package")], tasks)
    assert (seen.error, unseen.error) == ("", "")
    (series,) = seen.runs
    assert series.error == ""
    assert "unknown variable" in unseen.runs[0].error, "nothing is drawn"
    for ours, theirs in pairs:
        for one, other in zip(values(ours), values(theirs), strict=True):
            assert np.abs(series.values[one] - series.values[other]).max() < 1e-12, (one, other)
    moved = series.values["generic.shape[2].r[1]"]
    assert abs(moved[-1] - moved[0]) > 1e-3
    parts = package.texts["BotParameters.mo"]
    assert parts.count("armVisual5.uri") == 1
    assert "armVisual1" not in parts
