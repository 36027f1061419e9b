"""Filters: what they take away from a log, they take away from the model, too."""

from __future__ import annotations

import numpy as np
import pytest

from urdfsync.analysis.identification.log import LogPiece
from urdfsync.analysis.identification.signals import find_cutoff, prepare, target_at, thinned
from urdfsync.domain.regressor import Axis

AXIS = Axis("elbow", "elbow", "rad", 0.0, (-9, 9), 9.0, np.inf, 1.0, "position", "elbow_phi")
CUTOFF = 5.0


def turning(jump: float) -> LogPiece:
    """A joint of inertia 1 that swings at 0.4 Hz; at each turn, its effort jumps, and a controller evens that out."""
    times = np.arange(0, 20, 0.002)
    speed = np.cos(0.8 * np.pi * times)
    gain = -0.8 * np.pi * np.sin(0.8 * np.pi * times) + jump * np.exp(-((speed / 0.2) ** 2)) * np.sign(
        np.sin(7 * times)
    )
    speed = np.cumsum(gain) * 0.002
    position = np.cumsum(speed - speed.mean()) * 0.002
    velocity, acceleration = np.gradient(position, times), np.gradient(np.gradient(position, times), times)
    return LogPiece(times, position[:, None], velocity[:, None], acceleration[:, None])


@pytest.mark.parametrize("has_velocities", [True, False])
def test_sudden_accelerations_stay_in_step_with_efforts(has_velocities: bool) -> None:
    """A narrower filter for positions would leave a twentieth of the effort unexplained."""
    piece = turning(5.0)
    samples = prepare(piece if has_velocities else piece._replace(velocity=None), [AXIS], CUTOFF)
    assert samples is not None
    places, rows, _ = thinned(samples, CUTOFF, samples.a, samples.a)
    efforts = target_at(0.0)[:-1] @ samples.efforts[:, places, 0]
    assert np.std(rows[:, 0] - efforts) < 0.01 * np.std(efforts)


def test_an_effort_without_a_meaning_spreads_no_further_than_the_filter() -> None:
    piece = turning(0.0)
    samples = prepare(piece, [AXIS], CUTOFF)
    assert samples is not None
    still = np.abs(samples.v[:, 0]) < 0.05
    near = np.array([still[np.abs(samples.times - time) < 0.75 / CUTOFF].any() for time in samples.times])
    assert not samples.is_free[still].any()
    assert samples.is_free[~near].all()


def test_the_cutoff_follows_from_the_pieces_that_move() -> None:
    """Neither noise at rest nor the length of a short piece is taken for a fast motion."""
    moving = turning(0.0)
    noise = 1e-4 * np.random.default_rng(0).standard_normal(moving.position.shape)
    resting, short = (
        moving._replace(position=noise),
        LogPiece(*(values[:600] for values in moving if values is not None)),
    )
    alone = find_cutoff([moving], [AXIS], [0])
    assert alone < 10
    for pieces in ([resting, moving], [moving, resting], [short, moving]):
        assert find_cutoff(pieces, [AXIS], [0]) == alone
    assert find_cutoff([], [AXIS], [0]) == 1.0
