"""Finds out by which factors the efforts of a log differ from those of a robot that is near its source.

Another sign, unit or joint of a column, and a wrong constant of a motor, are factors of efforts. A fit could take most
of them for other masses and frictions. But a number of a link moves all joints before the link, so numbers that are all
a little wrong tell the factors of two joints apart far better than they tell a factor of all joints.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from urdfsync.analysis.identification.fit import Evidence, LeastSquares
from urdfsync.analysis.identification.signals import target_at
from urdfsync.domain.regressor import Array

_SPREAD = 0.25
"""Numbers of links may be wrong by this share of their natural sizes."""
_LOSS_SPREAD = 0.2
"""Losses may be wrong by this share of those that make up the whole effort."""
_OFFSET = 0.05
"""Likewise for the offset of a sensor."""
_NOISE = 0.01
"""Of an effort: so much a robot with other numbers leaves unexplained, at least."""
_FIRST_NOISE = 0.3
_ROUNDS = 12
VISIBLE = 1.25
"""A log should show such a factor of a joint's effort."""
_APART = 1.12
"""By so much the factors of right logs differ, however small the errors are; a factor of 1.25 is found beyond that."""
_SURE = 3.0
_LIKELY = 2.0
"""An estimated factor is hardly further from the real one, in standard errors."""
_DAMPING = 0.1
"""Keeps a factor that no sample determines."""


class Gains(NamedTuple):
    """Factors of the efforts in a log, by axis; NaN for an axis without samples."""

    usual: float
    """Of all efforts: the median of those with which the source's own numbers explain most."""
    factors: Array
    """With which numbers near the source's explain most, up to a factor of all."""
    covariance: Array
    """Of their relative errors."""

    def odd_axes(self) -> list[int]:
        """Return the axes whose efforts contradict those of most others; of two axes both, or none."""
        apart, usual, _ = self._ratios()
        counts = np.count_nonzero(apart > usual, axis=1)
        return [int(axis) for axis in np.flatnonzero(counts == max(1, counts.max()))]

    def least_visible(self) -> Array:
        """Return from which factor on the efforts of others show that an axis has it; infinite without others."""
        visible = self._ratios()[2]
        np.fill_diagonal(visible, np.inf)
        return np.asarray(np.exp(np.where(np.isnan(visible), np.inf, visible).min(axis=1)))

    def _ratios(self) -> tuple[Array, Array, Array]:
        """Return the ratios of the factors of each two axes, as sizes of logarithms; another sign is infinitely far.

        These are the found ones, the greatest ones of right logs, and the least that are found to be greater.
        """
        ratios, variances = self.factors[:, None] / self.factors, np.diag(self.covariance)
        errors = np.sqrt(variances[:, None] + variances - 2 * self.covariance)
        usual = np.maximum(np.log(_APART), _SURE * errors)
        apart = np.where((ratios < 0) & (errors < 1 / _SURE), np.inf, np.abs(np.log(np.abs(ratios))))
        return apart, usual, usual + _LIKELY * errors


def find_gains(problem: LeastSquares, evidence: Evidence, sizes: Array, delay: float) -> Gains:
    """Return the factors with which a robot near the source explains most of the efforts, by Gauss and Newton.

    `sizes` are the natural ones of the numbers, losses by the efforts of the source.
    """
    count, first = problem.count, 10 * len(problem.bodies)
    spreads = np.concatenate([_SPREAD * sizes[:first], _LOSS_SPREAD * sizes[first:count]])
    slopes = problem.slopes(problem.start)[:count, :count] * spreads
    used = [int(axis) for axis in np.flatnonzero(evidence.counts)]
    rows = [evidence.factors[axis] for axis in used]
    efforts = [each[:, count + problem.axes : -1] @ target_at(delay)[:-1] for each in rows]
    models, ways = [each[:, -1] for each in rows], [each[:, :count] @ slopes for each in rows]
    roots = np.sqrt(evidence.counts[used])
    lengths = np.array([float(np.linalg.norm(each)) for each in efforts]) + 1e-300
    noise, changes = _FIRST_NOISE * lengths / roots, np.zeros(count)
    factors = np.array([(a @ b) / (b @ b + 1e-300) for a, b in zip(efforts, models, strict=True)])
    usual = float(np.median(factors))
    least = 1e-3 * lengths / [float(np.linalg.norm(each)) + 1e-300 for each in models]
    factors = np.where(np.abs(factors) < least, least, factors)
    prior = np.diag(np.concatenate([np.ones(count + len(used)), np.full(len(used), _DAMPING)]))
    # a robot without masses, and efforts of 0, would agree best: the factor of one axis stays
    anchor = count + len(used) + int(np.abs(factors - usual).argmin())
    prior[anchor, anchor] = 1 / _DAMPING**4
    for _ in range(_ROUNDS):
        blocks, goals = list[Array](), list[Array]()
        for k, (axis, effort, model, way) in enumerate(zip(used, efforts, models, ways, strict=True)):
            block, robot = np.zeros((len(way), len(prior))), factors[k] * (model + way @ changes)
            block[:, :count] = factors[k] * way
            block[:, count + k] = _OFFSET * lengths[k] / roots[k] * rows[k][:, count + axis]
            block[:, count + len(used) + k] = robot
            blocks.append(block / noise[k])
            goals.append((effort - robot + block[:, :count] @ changes) / noise[k])
        matrix = np.vstack([*blocks, prior])
        solution = np.linalg.lstsq(matrix, np.concatenate([*goals, np.zeros(len(prior))]), rcond=None)[0]
        unexplained = [np.linalg.norm(a @ solution - b) for a, b in zip(blocks, goals, strict=True)]
        changes, factors = solution[:count], factors * (1 + np.clip(solution[-len(used) :], -0.5, 0.5))
        noise = np.maximum(unexplained * noise, _NOISE * lengths) / roots
    result = Gains(usual, np.full(problem.axes, np.nan), np.full((problem.axes, problem.axes), np.nan))
    result.factors[used] = factors
    result.covariance[np.ix_(used, used)] = np.linalg.inv(matrix.T @ matrix)[-len(used) :, -len(used) :]
    return result
