"""Generated robots against Pinocchio: poses of all links, efforts of all axes, mass and its centre.

The robots move as prescribed for 0.01 s; the first and the last instant must agree to 1e-10. Mimic
joints, damping and dry friction are part of it. A robot in whose file some moving joint carries no
mass gets made-up inertials, for both sides, and `synthetic` in its name.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from support import corpus, inertias, physics
from support.packages import generate

from urdfsync.domain import Target

MANY_JOINTS = 10
"""Robots with more moving joints take much longer: their number of equations grows, and the cost with it."""

FAULTY = {"robots/random/spot_ros/spot_description/urdf/spot_arm.urdf"}
"""Without a package: see the tests of the reader."""


def _cases() -> list[object]:
    cases = []
    for file, joints in corpus.moving_joints().items():
        if file in FAULTY or (joints == 0 and file != corpus.ABSENT):
            continue
        synthetic = file != corpus.ABSENT and inertias.lacks_inertia((corpus.FOLDER / file).read_bytes())
        name = corpus.label(file) + ("-synthetic" if synthetic else "")
        mark = pytest.mark.large if joints > MANY_JOINTS else pytest.mark.slow
        cases.append(pytest.param(file, synthetic, id=name, marks=mark))
    return cases


@pytest.mark.parametrize(("file", "synthetic"), _cases())
def test_corpus_robots_move_as_pinocchio_says(
    file: str, synthetic: bool, corpus: Path, modelica_library: Path, tmp_path: Path
) -> None:
    urdf = (corpus / file).read_bytes()
    if synthetic:
        urdf = inertias.with_inertias(urdf)
    package = generate(urdf, Target("Bot", "Bot"))
    reference = physics.Reference(urdf.decode(), package)
    motion = physics.random_motion(len(reference.axes))
    errors, _ = physics.measure(modelica_library, package.write(tmp_path), reference, motion)
    assert errors.worst() <= physics.TOLERANCE, errors


def test_enough_robots_are_compared(corpus: Path) -> None:
    assert sum(not case.marks[0].name == "large" for case in _cases()) >= 20  # type: ignore[attr-defined]
