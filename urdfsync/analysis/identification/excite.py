"""Finds a motion that excites a robot's numbers: Fourier series within the limits of position, speed and effort.

The condition number of the derivatives of efforts by the determined numbers, each in units of its size, is to be small
(Swevers and others 1997, Optimal robot excitation and identification). A random search lowers it: the function has many
minima, and a motion that is a little worse serves as well.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from urdfsync.analysis.identification.fit import LeastSquares, is_body
from urdfsync.domain.regressor import Array, Axis, Regressor
from urdfsync.engine.options import Progress

_HARMONICS, _RATE, _LOOKS = 5, 50.0, 80
_TRIES, _STEPS = 12, 60
_SHARE = 0.8
"""The share of each limit that the motion takes."""
_NO_LIMIT = {"rad": (np.pi, 2.0), "m": (0.5, 0.3)}
"""Greatest distance from the start, and speed, of a joint without such limits."""
_DEPENDENT = 1e-4


class Trajectory(NamedTuple):
    """A motion: times, and for each axis positions, velocities and accelerations."""

    times: Array
    q: Array
    v: Array
    a: Array


def excite(
    regressor: Regressor, seconds: float, seed: int, progress: Progress
) -> tuple[Trajectory, Array, float, float, int]:
    """Return a motion with its efforts, the condition of the first motion, that of this one, and the numbers."""
    rng, axes = np.random.default_rng(seed), regressor.axes
    chosen = list[int]()
    best, best_cost, first = np.zeros(0), np.inf, np.inf
    for number in range(_TRIES + _STEPS):
        progress("looking for a motion", number, _TRIES + _STEPS)
        fresh = rng.standard_normal((2, len(axes), _HARMONICS))
        tried = fresh if number < _TRIES else best + 0.3 * fresh * rng.random()
        trajectory = _trajectory(tried, axes, seconds, np.linspace(0, seconds, _LOOKS))
        scaled = _find_derivatives(regressor, trajectory)
        chosen = chosen or _independent(scaled)
        cost = float(np.linalg.cond(scaled[:, chosen] / np.linalg.norm(scaled[:, chosen], axis=0)))
        first = min(first, cost) if number == 0 else first
        if cost < best_cost:
            best, best_cost = tried, cost
    times = np.linspace(0, seconds, round(seconds * _RATE) + 1)
    trajectory = _trajectory(best, axes, seconds, times)
    _, efforts = regressor.rows(*trajectory[1:])
    limits = np.array([axis.effort for axis in axes])
    with np.errstate(invalid="ignore"):
        load = float(np.nanmax(np.abs(efforts) / limits)) if np.isfinite(limits).any() else 0.0
    if load > _SHARE:  # a slower motion needs less effort; gravity remains
        slow = float(np.sqrt(load / _SHARE))
        trajectory = _trajectory(
            best, axes, seconds * slow, np.linspace(0, seconds * slow, round(seconds * slow * _RATE) + 1)
        )
        _, efforts = regressor.rows(*trajectory[1:])
    return trajectory, efforts, first, best_cost, len(chosen)


def _find_derivatives(regressor: Regressor, trajectory: Trajectory) -> Array:
    """Return the derivatives of efforts by the numbers of records, in units of their sizes."""
    bodies, first = [body for body in regressor.bodies if is_body(body)], 10 * len(regressor.bodies)
    places = [10 * k + n for k, body in enumerate(regressor.bodies) if is_body(body) for n in range(10)]
    places += range(first, first + len(regressor.losses))
    problem = LeastSquares(bodies, regressor.losses, 0)
    slopes = problem.slopes(problem.start)[:-1, :-1] * problem.sizes(np.ones(len(regressor.losses) + 1))[:-1]
    derivatives, efforts = regressor.rows(*trajectory[1:])
    rows = derivatives[:, :, places] / (np.sqrt(np.mean(efforts**2, axis=0)) + 1e-9)[:, None]
    return np.asarray(rows.reshape(-1, len(places)) @ slopes)


def _independent(columns: Array) -> list[int]:
    from scipy.linalg import qr

    _, triangle, order = qr(columns, mode="economic", pivoting=True)
    sizes = np.abs(np.diag(triangle))
    return sorted(int(place) for place in order[: np.count_nonzero(sizes > _DEPENDENT * sizes[0])])


def _trajectory(numbers: Array, axes: Sequence[Axis], seconds: float, times: Array) -> Trajectory:
    """Return the motion of Fourier coefficients, which begins and ends at rest, moved and stretched into the limits."""
    steps = np.arange(1, _HARMONICS + 1)
    sines, cosines = numbers / steps
    sines = sines - (sines @ steps)[:, None] * steps / (steps @ steps)  # no speed at the ends
    cosines = cosines - (cosines @ steps**2)[:, None] * steps**2 / (steps**2 @ steps**2)  # no acceleration there
    w = 2 * np.pi * steps / seconds

    def at(moments: Array) -> list[Array]:
        s, c = np.sin(np.outer(moments, w)), np.cos(np.outer(moments, w))
        speeds = c @ (w * sines).T - s @ (w * cosines).T
        return [s @ sines.T + c @ cosines.T, speeds, -(s @ (w * w * sines).T) - c @ (w * w * cosines).T]

    fine, fine_speeds, _ = at(np.linspace(0, seconds, 400))
    results = at(times)
    for k, axis in enumerate(axes):
        reach, speed = _NO_LIMIT[axis.unit]
        lower, upper = np.clip(axis.range, axis.start - reach, axis.start + reach)
        speed = axis.speed if np.isfinite(axis.speed) else speed
        width = _SHARE * min((upper - lower) / np.ptp(fine[:, k]), speed / np.abs(fine_speeds[:, k]).max())
        width = width if axis.command else 0.0
        middle = (upper + lower) / 2 if axis.command else axis.start
        ends = fine[:, k].max() + fine[:, k].min()
        results[0][:, k] = middle + width * (results[0][:, k] - ends / 2)
        results[1][:, k] *= width
        results[2][:, k] *= width
    return Trajectory(times, *results)
