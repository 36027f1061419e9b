"""Generated robots against Pinocchio: poses of all links, efforts of all axes, mass and its centre.

Base and axes move as prescribed; the first and the last instant must agree to 1e-10. Mimic joints, damping and
dry friction are part of it. A robot in whose file some moving joint carries no mass gets made-up inertias, for both
sides, and `made-up` in its name; `amended` are files that Pinocchio would not read (see `urdf.physics.completion`).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from support import corpus, physics
from support.corpus import REPOSITORY

from urdfsync.modelica.names import class_name
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.physics import completion

MANY_JOINTS = 4
"""Robots with more moving joints take much longer: their number of equations grows, and the cost with it."""

FAULTY = {"robots/random/spot_ros/spot_description/urdf/spot_arm.urdf"}
"""Without a package: see the tests of the reader."""

EXAMPLES = {"six_axis_arm": "fixed", "wheeled_robot": "floating", "planar_platform": "fixed", "floating_buoy": "fixed"}


def _cases() -> list[object]:
    cases: list[object] = []
    for file, joints in corpus.moving_joints().items():
        if file == corpus.ABSENT:
            return [file]
        if file in FAULTY or joints == 0:
            continue
        cases.append(
            pytest.param(
                file,
                id="-".join([corpus.label(file), *_notes(file)]),
                marks=pytest.mark.large if joints > MANY_JOINTS else pytest.mark.slow,
            )
        )
    return cases


def _notes(file: str) -> list[str]:
    """What has to be done to a file of the corpus."""
    content = (corpus.FOLDER / file).read_bytes()
    robot = read_robot(content, file, cross_check=False).robot
    assert robot is not None
    made_up = completion.with_inertias(content, KinematicTree.of(robot)).notes
    return ["amended"] * len(completion.completed_for_pinocchio(content).notes) + ["made-up"] * len(made_up)


@pytest.mark.parametrize("file", _cases())
def test_corpus_robots_move_as_pinocchio_says(file: str, corpus: Path, modelica_library: Path, tmp_path: Path) -> None:
    case = physics.prepare((corpus / file).read_bytes())
    (comparison,) = physics.compare(modelica_library, tmp_path, [case])
    assert comparison.agrees, comparison.worst()


def test_enough_robots_are_compared(corpus: Path) -> None:
    assert sum(case.marks[0].name == "slow" for case in _cases()) >= 10  # type: ignore[attr-defined]


@pytest.mark.slow
@pytest.mark.parametrize("names", [["six_axis_arm"], ["wheeled_robot"], ["planar_platform", "floating_buoy"]])
def test_examples_move_as_pinocchio_says(names: Sequence[str], modelica_library: Path, tmp_path: Path) -> None:
    """A mobile robot, a planar and a floating joint among them."""
    cases = []
    for name in names:
        source = REPOSITORY / "modelica" / "UrdfSync" / "Resources" / "robots" / name / f"{name}.urdf"
        cases.append(physics.prepare(source.read_bytes(), class_name(name), base=EXAMPLES[name]))
    for case, comparison in zip(cases, physics.compare(modelica_library, tmp_path, cases), strict=True):
        assert comparison.agrees, (case.package.target.name, comparison.worst())
        assert case.experiment.notes == ()
