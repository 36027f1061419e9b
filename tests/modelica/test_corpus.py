"""Every robot of the corpus, as `init` and `check --physics` see it, compiles and moves as Pinocchio says."""

from __future__ import annotations

from pathlib import Path

import pytest
from support import corpus as corpora
from support.commands import Execute

FAULTY = {
    "robots/random/spot_ros/spot_description/urdf/spot_arm.urdf",
    # loops, or a mass in no link: with `allow` they are built, and not compared
    *(f"robots/drake/atlas/urdf/{name}.urdf" for name in ("robotiq", "robotiq_simple", "robotiq_tendons")),
    "robots/ros-industrial/robotiq/robotiq_3f_gripper_visualization/cfg/robotiq-3f-gripper_articulated.urdf",
}
"""Without a package: see the tests of the reader."""
LABELS = {corpora.label(file): file for file in corpora.moving_joints() if file not in FAULTY}


@pytest.mark.large
@pytest.mark.parametrize("approach", ["package", "record"])
@pytest.mark.parametrize("file", LABELS.values(), ids=LABELS)
def test_robots_are_right(
    file: str, approach: str, corpus: Path, modelica_library: Path, folder: Path, execute: Execute
) -> None:
    """Stationary or mobile, as `init` proposes. Nothing is built, so nothing is remembered."""
    execute("init", corpus / file)
    configuration = folder / "urdfsync.toml"
    text = configuration.read_text("utf-8").replace("[defaults]\n", f'[defaults]\napproach = ["{approach}"]\n')
    configuration.write_text(text, "utf-8")
    (found,) = execute("check", "--physics", "--format=json", code=1).json["results"]
    assert not found["built"]
    assert (found["failed"], found["gaps"], found["agrees"]) == (False, [], True), found
