"""Every robot of the corpus as `check --physics` sees it: all its models compile, and it moves as Pinocchio says."""

from __future__ import annotations

from pathlib import Path

import check_corpus
import pytest
from support import corpus as corpora

MANY_JOINTS = 4
"""Robots with more moving joints take much longer: their number of equations grows, and the cost with it."""
FAULTY = {"robots/random/spot_ros/spot_description/urdf/spot_arm.urdf"}
"""Without a package: see the tests of the reader."""
CASES = [
    pytest.param(file, id=corpora.label(file), marks=pytest.mark.large if joints > MANY_JOINTS else pytest.mark.slow)
    for file, joints in corpora.moving_joints().items()
    if file not in FAULTY
]


@pytest.mark.parametrize("file", CASES)
def test_robots_are_right(
    file: str,
    corpus: Path,
    modelica_library: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Stationary or mobile, as `init` proposes. Nothing is built, so nothing is remembered."""
    code = check_corpus.main([str(corpus / "robots"), "--only", file])
    printed = capsys.readouterr().out
    assert code == 0, printed
    assert "| agrees" in printed


def test_enough_robots_are_compared(corpus: Path) -> None:
    assert sum(joints <= MANY_JOINTS for joints in corpora.moving_joints().values()) >= 10
