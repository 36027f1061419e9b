"""Generated robots against Pinocchio: poses of all links, efforts of all axes, mass and its centre.

The robots move as prescribed for 0.01 s; the first and the last instant must agree to 1e-10. Mimic
joints, damping and dry friction are part of it. A robot in whose file some moving joint carries no
mass gets made-up inertials, for both sides, and `synthetic` in its name; `amended` are files that
Pinocchio would not read (see `support.amended`).
"""

from __future__ import annotations

from pathlib import Path

import pytest
from support import amended, corpus, physics
from support.packages import generate

from urdfsync.domain import Target

MANY_JOINTS = 10
"""Robots with more moving joints take much longer: their number of equations grows, and the cost with it."""

FAULTY = {"robots/random/spot_ros/spot_description/urdf/spot_arm.urdf"}
"""Without a package: see the tests of the reader."""


def _cases() -> list[object]:
    cases: list[object] = []
    for file, joints in corpus.moving_joints().items():
        if file == corpus.ABSENT:
            return [file]
        if file in FAULTY or joints == 0:
            continue
        urdf = (corpus.FOLDER / file).read_bytes()
        notes = ["amended"] * (amended.acceptable(urdf) != urdf) + ["synthetic"] * amended.lacks_inertia(urdf)
        mark = pytest.mark.large if joints > MANY_JOINTS else pytest.mark.slow
        cases.append(pytest.param(file, id="-".join([corpus.label(file), *notes]), marks=mark))
    return cases


@pytest.mark.parametrize("file", _cases())
def test_corpus_robots_move_as_pinocchio_says(file: str, corpus: Path, modelica_library: Path, tmp_path: Path) -> None:
    urdf = amended.acceptable((corpus / file).read_bytes())
    if amended.lacks_inertia(urdf):
        urdf = amended.with_inertias(urdf)
    package = generate(urdf, Target("Bot", "Bot"))
    reference = physics.Reference(urdf.decode(), package)
    motion = physics.random_motion(len(reference.axes))
    errors, _ = physics.measure(modelica_library, package.write(tmp_path), reference, motion)
    assert errors.worst() <= physics.TOLERANCE, errors


def test_enough_robots_are_compared(corpus: Path) -> None:
    assert sum(case.marks[0].name == "slow" for case in _cases()) >= 20  # type: ignore[attr-defined]
