"""`urdfsync identify --excite`: a motion that determines numbers, within all limits, for robot and simulation."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from support.commands import Execute
from support.files import unchanged

from urdfsync.analysis.simulation.models import Input
from urdfsync.analysis.simulation.motion import read_motion

LIMITS = {"hip": (-1.05, 1.05, 30), "thigh": (-1.57, 3.49, 30), "calf": (-2.72, -0.83, 15)}


@pytest.mark.slow
def test_a_motion_begins_and_ends_at_rest_within_the_limits(leg: Path, execute: Execute) -> None:
    printed = execute("identify", "leg", "--excite", "motion.csv", "--seconds", "10")
    motion = read_motion(Path("motion.csv"), [Input(f"{name}_phi", "rad") for name in LIMITS])
    times = np.array(motion.times)
    assert times[-1] >= 10
    for signal, values in motion.values:
        lower, upper, speed = LIMITS[signal.name.removesuffix("_phi")]
        assert lower < min(values) < max(values) < upper
        speeds = np.gradient(values, times)
        assert np.abs(speeds).max() < speed
        assert np.abs(speeds[[0, -1]]).max() < 0.02 * np.abs(speeds).max()
        assert np.ptp(values) > 0.2, "the joint moves"
    assert "condition" in printed.lines[0]


@pytest.mark.slow
def test_the_condition_number_falls(leg: Path, execute: Execute) -> None:
    (result,) = execute("identify", "leg", "--excite", "motion.csv", "--format=json").json["results"]
    assert result["condition"] < 0.7 * result["first_condition"]
    first = Path("motion.csv").read_bytes()
    execute("identify", "leg", "--excite", "motion.csv")
    assert Path("motion.csv").read_bytes() == first, "the same seed gives the same motion"
    with unchanged(leg):
        words = execute("identify", "leg", "--excite", "leg.urdf", code=2).words
    assert "the source of the robot has this name" in words


def test_options_of_a_log_are_refused_for_a_motion(leg: Path, execute: Execute) -> None:
    for given in (["--write"], ["--cutoff", "5"], ["--until", "3"], ["--column", "hip.effort=a"], ["--motor-side"]):
        words = execute("identify", "leg", "--excite", "motion.csv", *given, code=2).words
        assert f"`{given[0]}` is for a log, not for `--excite`" in words
    words = execute("identify", "leg", "--excite", "motion.csv", "--joint", "hipp", code=2).words
    assert "`hipp` is no joint that moves and has numbers; did you mean `hip`?" in words
    assert not Path("motion.csv").exists()
