"""Every robot of the corpus as `check --physics` sees it: all its models compile, and it moves as Pinocchio says."""

from __future__ import annotations

from pathlib import Path

import check_corpus
import pytest
from support import corpus as corpora

IN_CI = {"matlab-robotisTurtleBot3Burger", "oems-QARM", "ros-industrial-robotiq-3f-gripper_mesh"}
"""A mobile robot on wheels, an arm, and a gripper with many links; one that slides is in test_joints."""
FAULTY = {"robots/random/spot_ros/spot_description/urdf/spot_arm.urdf"}
"""Without a package: see the tests of the reader."""
LABELS = {corpora.label(file): file for file in corpora.moving_joints() if file not in FAULTY}
CASES = [
    pytest.param(file, id=label, marks=pytest.mark.slow if label in IN_CI else pytest.mark.large)
    for label, file in LABELS.items()
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


def test_the_robots_of_each_run_are_in_the_corpus(corpus: Path) -> None:
    assert LABELS.keys() >= IN_CI
