"""The example robots: other readers accept them without a warning, and their masses agree with their comments."""

from __future__ import annotations

import runpy
from pathlib import Path

import pinocchio as pin
import pytest

from urdfsync.formats.urdf.parse.source import read_robot
from urdfsync.formats.urdf.robot import Robot
from urdfsync.project.state import statefile
from urdfsync.project.state.record import as_read, as_recorded

ROOT = Path(__file__).resolve().parents[1]
ROBOTS = ROOT / "modelica" / "UrdfSync" / "Resources" / "robots"
SOURCES = sorted(ROBOTS.glob("*/*.urdf"))
STATES = sorted((ROOT / "tests/golden/recorded").glob("*.state"))
"""Written once, by builds of the golden sources: nothing renews them."""
MESHES = sorted(ROBOTS.glob("*/meshes/*"))
TOTAL_MASS = {
    "floating_buoy": 63.3,
    "four_bar": 1.3,
    "planar_platform": 11.9,
    "six_axis_arm": 52.345,
    "wheeled_robot": 36.1,
}
every_robot = pytest.mark.parametrize("source", SOURCES, ids=lambda path: path.stem)


def test_there_are_examples_for_every_joint_type_and_mesh_format() -> None:
    read = [read_robot(source.read_bytes(), source.name).robot for source in SOURCES]
    types = {joint.type for robot in read if robot for joint in robot.joints}
    assert types == {"fixed", "continuous", "revolute", "prismatic", "planar", "floating"}
    assert {path.suffix for path in MESHES} == {".stl", ".obj", ".dae"}


@every_robot
def test_pinocchio_reads_it_without_a_word(source: Path, capfd: pytest.CaptureFixture[str]) -> None:
    model = pin.buildModelFromUrdf(str(source), pin.JointModelFreeFlyer())
    assert pin.computeTotalMass(model) == pytest.approx(TOTAL_MASS[source.stem], rel=1e-12)
    assert capfd.readouterr() == ("", "")


def test_meshes_are_what_their_script_writes() -> None:
    written = runpy.run_path(str(ROOT / "tools" / "make_example_meshes.py"))["meshes"]()
    assert written == {path.relative_to(ROBOTS): path.read_bytes() for path in MESHES}


@pytest.mark.parametrize("state", STATES, ids=lambda path: path.stem)
def test_a_robot_that_was_recorded_before_reads_as_the_same(state: Path) -> None:
    """A field that is new in `urdf/robot` has to default to None, which is not recorded."""
    (record,), damage = statefile.loads(state.read_text(encoding="utf-8"), state.name)
    assert damage is None
    assert record.snapshot is not None
    assert as_recorded(as_read(record.snapshot, Robot)) == record.snapshot
