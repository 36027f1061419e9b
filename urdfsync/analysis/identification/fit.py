"""Fits the numbers of records to measured efforts: base parameters by least squares, and always a real body.

The unknowns are the numbers of the records themselves, so a number that the motion does not determine stays to its last
digit. Which ones are determined follows from the derivatives at the source's numbers, one after the other in the order
of `_order`: a number that adds nothing to the numbers before it stays. This is the choice of base parameters by a QR
decomposition, but with an order: losses first, masses last, since CAD has the masses right most of all.

The efforts are linear in the inertial parameters, and these are polynomials of mass, centre and tensor. So the fit is a
small nonlinear problem on the triangular factor of all samples: no sample is read twice. Its prior is the distance from
the source's body, the logarithm of one pseudo-inertia matrix in the metric of the other (Lee and Park 2018, A geometric
algorithm for robust multibody inertial parameter identification). It does not depend on units and frames, and grows
beyond all bounds at the edge of what a real body can be: a positive definite pseudo-inertia. A semidefinite program
would need another dependency, and its standard errors at the edge mean nothing; here they are those of the curvature.
If the fit pushes a link to that edge, the numbers of the link that stayed are wrong: they become unknowns too.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any, NamedTuple

import numpy as np

from urdfsync.analysis.identification.signals import shift_slopes, target_at
from urdfsync.domain.regressor import Array, Loss, MovingLink

_EXCITED = 3.0
"""So many standard errors has a number's natural size, at least, if the motion determines the number."""
_EDGE = 1.2
"""The distance, as a logarithm, at which a link is no more like its source: a part of its inertia fell to 30 %."""
_MODEL_ERROR = 0.0005
"""Of an effort: no model of rigid bodies and two numbers of friction is better, however little noise a log has."""
_MOST_STEPS = 60
"""Towards the edge, where a link becomes no real body, a fit takes endless small steps."""
_TENSOR = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
"""Rows and columns of the numbers of a tensor, in the order of `NUMBERS`."""
_ROUNDS = 3
"""Each round of the fit weighs the joints by the residuals of the round before."""
SURE = 3.0
"""A change of so many standard errors is sure."""
_SPREAD = 0.35
"""Of a number's natural size: so far may the source be wrong."""


def triangle(rows: Array) -> Array:
    """Return the triangular factor of a matrix: it has the same sums of squares."""
    return np.asarray(np.linalg.qr(rows, mode="r"), float)


class Evidence:
    """All samples of a log in one triangular matrix for each axis: the memory does not grow with the log."""

    def __init__(self, axes: int) -> None:
        self.factors: list[Any] = [None] * axes
        self.counts = np.zeros(axes, int)

    def add(self, axis: int, rows: Array) -> None:
        """Add samples of an axis: derivatives by all parameters, then what they have to explain."""
        before = self.factors[axis]
        stacked = rows if before is None else np.vstack([before, rows])
        self.factors[axis] = triangle(stacked)
        self.counts[axis] += len(rows)

    def stacked(self, scales: Array) -> Array:
        """Return all samples as one triangular matrix, with the residuals of each axis in units of its scale."""
        parts = [factor / scale for factor, scale in zip(self.factors, scales, strict=True) if factor is not None]
        return triangle(np.vstack(parts))

    def linear_fit(self, count: int) -> Array:
        """Return the combinations of the first `count` columns that leave least of each of the others."""
        others = self.stacked(self.roots(np.concatenate([np.zeros(count), target_at(0.0)])))
        units = np.linalg.norm(others[:, :count], axis=0) + 1e-300
        solution = np.linalg.lstsq(others[:, :count] / units, others[:, count:], rcond=1e-9)[0]
        return np.asarray(solution / units[:, None])

    def roots(self, combination: Array, used: float = 0.0) -> Array:
        """Return the root mean square of a combination of the columns for each axis, without `used` samples."""
        squares = [self.squares(j, combination) for j in range(len(self.counts))]
        return np.sqrt(np.array(squares) / np.maximum(self.counts - used, 1)) + 1e-12

    def deviations(self, first: int, combination: Array) -> Array:
        """Return the standard deviation of a combination for each axis; its constant is in a column from `first` on."""
        deviations = np.zeros(len(self.counts))
        for axis, factor in enumerate(self.factors):
            if factor is not None:
                values, constant = factor @ combination, factor[:, first + axis]
                rest = values - constant * (constant @ values) / (constant @ constant)
                deviations[axis] = np.linalg.norm(rest) / np.sqrt(self.counts[axis])
        return deviations

    def squares(self, axis: int, combination: Array) -> float:
        """Return the sum of squares of a combination of the columns, over all samples."""
        factor = self.factors[axis]
        return 0.0 if factor is None else float(np.sum((factor @ combination) ** 2))


class Fit(NamedTuple):
    """The fitted numbers: ten of each body, then losses, the offset of each axis, and the delay of the efforts."""

    after: Array
    covariance: Array
    """Of all numbers, on the condition that those that stay are right; 0 for a number that stays."""
    errors: Array
    """Standard errors of all numbers, with a spread of those that stay; 0 for a number that stays."""
    is_fitted: np.ndarray
    freed: Sequence[str]
    delta: Array
    """The change of the linear parameters, without the delay."""
    matrix: Array
    """The derivatives of the weighed efforts by the linear parameters and the delay."""

    @property
    def conditional_errors(self) -> Array:
        """Standard errors if the numbers that stay are right."""
        return np.asarray(np.sqrt(np.diag(self.covariance)))


def pseudo_inertia(numbers: Array, rotation: Array) -> Array:
    """Return the second moments of a body with its first moments and its mass: positive definite for a real body."""
    mass, centre = numbers[0], numbers[1:4]
    tensor = rotation @ numbers[[[4, 7, 8], [7, 5, 9], [8, 9, 6]]] @ rotation.T
    matrix = np.empty((4, 4))
    matrix[:3, :3] = 0.5 * np.trace(tensor) * np.eye(3) - tensor + mass * np.outer(centre, centre)
    matrix[3, :3] = matrix[:3, 3] = mass * centre
    matrix[3, 3] = mass
    return matrix


def pseudo_inertia_slopes(numbers: Array, rotation: Array) -> Array:
    """Return the derivatives of the pseudo-inertia by the ten numbers."""
    mass, centre = numbers[0], numbers[1:4]
    slopes = np.zeros((10, 4, 4))
    place = np.array([*centre, 1.0])
    slopes[0] = np.outer(place, place)
    for n in range(3):
        slopes[1 + n, n] += mass * place
        slopes[1 + n, :, n] += mass * place
    for n, (row, column) in enumerate(_TENSOR, 4):
        tensor = np.outer(rotation[:, row], rotation[:, column])
        tensor = tensor if row == column else tensor + tensor.T
        slopes[n, :3, :3] = 0.5 * np.trace(tensor) * np.eye(3) - tensor
    return slopes


def inertial_parameters(numbers: Array, rotation: Array) -> Array:
    """Return Pinocchio's ten parameters of a body: mass, first moments, and the inertia about the link's origin."""
    return _parameters_of(pseudo_inertia(numbers, rotation))


def _parameters_of(matrix: Array) -> Array:
    """Return the parameters of pseudo-inertias, of which they are linear combinations."""
    second = matrix[..., :3, :3]
    tensor = np.trace(second, axis1=-2, axis2=-1)[..., None, None] * np.eye(3) - second
    parts = [tensor[..., row, column] for row, column in ((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2))]
    return np.stack([matrix[..., 3, 3], *(matrix[..., 3, n] for n in range(3)), *parts], axis=-1)


def is_body(body: MovingLink) -> bool:
    """Return whether the numbers of a link are those of a real body."""
    matrix = pseudo_inertia(body.numbers, body.rotation)
    return bool(np.isfinite(matrix).all() and np.linalg.eigvalsh(matrix)[0] > 1e-12 * np.trace(matrix))


class LeastSquares:
    """The numbers of a robot, and how far others are from them."""

    def __init__(self, bodies: Sequence[MovingLink], losses: Sequence[Loss], axes: int) -> None:
        self.bodies, self.losses, self.axes = bodies, losses, axes
        numbers, values = [body.numbers for body in bodies], [loss.value for loss in losses]
        self.start = np.concatenate([*numbers, values, np.zeros(axes + 1)])
        self.count = len(self.start) - axes - 1
        """The number of numbers in records: the others are of the log."""
        self._roots = [np.linalg.inv(np.linalg.cholesky(pseudo_inertia(b.numbers, b.rotation))) for b in bodies]
        self._linear = self._linear_at(self.start)

    def _linear_at(self, x: Array) -> Array:
        pairs = zip(x[: 10 * len(self.bodies)].reshape(-1, 10), self.bodies, strict=True)
        inertial = [inertial_parameters(each, body.rotation) for each, body in pairs]
        return np.concatenate([*inertial, x[10 * len(self.bodies) :]])

    def delta(self, x: Array) -> Array:
        """Return the change of the parameters in which the efforts are linear."""
        return self._linear_at(x) - self._linear

    def slopes(self, x: Array) -> Array:
        """Return the derivatives of these parameters."""
        slopes = np.eye(len(x))
        for k, body in enumerate(self.bodies):
            part = slice(10 * k, 10 * k + 10)
            slopes[part, part] = _parameters_of(pseudo_inertia_slopes(x[part], body.rotation)).T
        return slopes

    def distance(self, k: int, numbers: Array) -> Array:
        """Return the logarithm of a body's pseudo-inertia in the source's metric; infinite if it is no real body."""
        relative = self._roots[k] @ pseudo_inertia(numbers, self.bodies[k].rotation) @ self._roots[k].T
        values, vectors = np.linalg.eigh(relative)
        if not values[0] > 0:
            return np.full(16, np.inf)
        return np.asarray(((vectors * np.log(values)) @ vectors.T).ravel())

    def distances(self, x: Array) -> Array:
        """Return the distances of all bodies."""
        numbers = x[: 10 * len(self.bodies)].reshape(-1, 10)
        return np.concatenate([np.zeros(0), *(self.distance(k, each) for k, each in enumerate(numbers))])

    def distance_slopes(self, x: Array, places: Collection[int]) -> Array:
        """Return their derivatives by the numbers at `places`; other columns of other bodies are 0."""
        slopes = np.zeros((16 * len(self.bodies), len(x)))
        for k in {place // 10 for place in places if place < 10 * len(self.bodies)}:
            part, root, body = slice(10 * k, 10 * k + 10), self._roots[k], self.bodies[k]
            values, vectors = np.linalg.eigh(root @ pseudo_inertia(x[part], body.rotation) @ root.T)
            turned = vectors.T @ root
            moved = turned @ pseudo_inertia_slopes(x[part], body.rotation) @ turned.T
            by_part = vectors @ (moved * _log_differences(values)) @ vectors.T
            slopes[16 * k : 16 * k + 16, part] = by_part.reshape(10, 16).T
        return slopes

    def sizes(self, others: Array) -> Array:
        """Return the natural size of each number: one unit of the prior; `others` are those after the bodies."""
        slopes = np.linalg.norm(self.distance_slopes(self.start, range(len(self.start))), axis=0)[
            : 10 * len(self.bodies)
        ]
        return np.concatenate([1 / np.maximum(slopes, 1e-12), others])

    def spread(self, sizes: Array) -> Array:
        """Return the covariance of the source's errors; `sizes` are the natural ones.

        A body is wrong in each direction of its logarithm alike: a longer link has two greater moments of inertia.
        """
        first, places = 10 * len(self.bodies), range(len(self.start))
        others = _SPREAD * self.start[first : self.count], sizes[self.count :]
        spread = np.diag(np.concatenate([np.zeros(first), *others]) ** 2)
        slopes = self.distance_slopes(self.start, places)
        for k in range(len(self.bodies)):
            part = slice(10 * k, 10 * k + 10)
            units = slopes[16 * k : 16 * k + 16, part] * sizes[part]
            spread[part, part] = np.linalg.inv(units.T @ units) * np.outer(sizes[part], sizes[part]) * _SPREAD**2
        return spread


def _log_differences(values: Array) -> Array:
    """Return the difference quotients of the logarithm between eigenvalues: its derivative, in their frame."""
    one, other = values[:, None], values[None, :]
    is_near = np.abs(one - other) < 1e-6 * (one + other)
    with np.errstate(invalid="ignore", divide="ignore"):
        quotients = np.log(one / other) / (one - other)
    return np.where(is_near, 2 / (one + other), quotients)


def fit(
    problem: LeastSquares, evidence: Evidence, fitted: Collection[int], sizes: Array, spread: Array, alike: Array
) -> Fit:
    """Fit the numbers at the places `fitted`; `spread` is the covariance of the errors of the others.

    `alike` is the number of neighbouring samples of each axis that tell one thing.
    """
    count, x = len(problem.start) - 1, problem.start
    measured = np.concatenate([np.zeros(count), target_at(0.0)[:-1], [0.0]])
    least, solution = _MODEL_ERROR * evidence.roots(measured), evidence.linear_fit(count) @ target_at(0.0)
    roots = evidence.roots(np.concatenate([solution, -target_at(0.0)]))
    freed, freed_places = list[str](), set[int]()
    for _ in range(_ROUNDS):
        rows, late = evidence.stacked(np.hypot(roots, least) * np.sqrt(alike)), float(x[-1])
        slope = rows[:, count:] @ [*shift_slopes(late), 0.0]
        matrix, goal = np.column_stack([rows[:, :count], -slope]), rows[:, count:] @ target_at(late) - late * slope
        determined = _determined(matrix @ problem.slopes(problem.start) * sizes, _order(problem, fitted))
        chosen = sorted({*determined, *freed_places})
        while True:
            x, jacobian = solve(problem, matrix, goal, sizes, chosen, x)
            logarithms = problem.distances(x).reshape(-1, 4, 4)
            far = np.abs(np.linalg.eigvalsh(logarithms)).max(axis=1) if len(logarithms) else []
            pushed = [k for k, each in enumerate(far) if each > _EDGE]
            freed_places |= {10 * k + n for k in pushed for n in range(10)} & {*fitted}
            if freed_places <= {*chosen}:
                break
            freed += [problem.bodies[k].name for k in pushed if problem.bodies[k].name not in freed]
            chosen = sorted({*chosen, *freed_places})
        covariance, errors = np.zeros((count + 1, count + 1)), np.zeros(count + 1)
        units, inverse = np.outer(sizes[chosen], sizes[chosen]), np.linalg.inv(jacobian.T @ jacobian)
        covariance[np.ix_(chosen, chosen)] = inverse * units
        unexplained = np.concatenate([problem.delta(x)[:-1], -target_at(x[-1])])
        roots = evidence.roots(unexplained, len(chosen) / max(1, int(np.count_nonzero(evidence.counts))))
    is_fitted = np.isin(np.arange(count + 1), chosen)
    # the numbers that stay are wrong by about their spread, and the fitted ones make up for that
    effects = inverse @ jacobian[: len(matrix)].T @ (matrix @ problem.slopes(x))[:, ~is_fitted] * sizes[chosen, None]
    made_up = effects @ spread[np.ix_(~is_fitted, ~is_fitted)] @ effects.T
    errors[chosen] = np.sqrt(np.diag(covariance)[chosen] + np.diag(made_up))
    return Fit(x, covariance, errors, is_fitted, tuple(freed), problem.delta(x)[:-1], matrix)


def sure_places(problem: LeastSquares, result: Fit) -> list[int]:
    """Return the places of the numbers whose change is sure, if the other numbers of records stay.

    One after the other, the number with the least sure change stays, and those that make up for it change a little.
    """
    changes, covariance = result.after - problem.start, result.covariance.copy()
    places = [int(place) for place in np.flatnonzero(result.is_fitted) if place < problem.count]
    while places:
        surenesses = np.abs(changes[places]) / np.sqrt(covariance[places, places])
        if surenesses.min() >= SURE:
            break
        place = places.pop(int(surenesses.argmin()))
        effect = covariance[:, place] / covariance[place, place]
        changes, covariance = changes - changes[place] * effect, covariance - np.outer(effect, covariance[place])
    return places


def _order(problem: LeastSquares, fitted: Collection[int]) -> list[int]:
    """Return places in the order in which numbers count as determined: masses last."""
    bodies, start = range(len(problem.bodies)), 10 * len(problem.bodies)
    of_log, losses = range(problem.count, len(problem.start)), range(start, problem.count)
    parts = [[10 * k + n for k in bodies for n in part] for part in ((1, 2, 3), range(4, 10), (0,))]
    return [place for part in (of_log, losses, *parts) for place in part if place in fitted]


def _determined(columns: Array, order: Sequence[int]) -> list[int]:
    """Return the places whose columns, in units of their sizes, are not combinations of those before them."""
    basis, chosen = np.zeros((len(columns), 0)), list[int]()
    for place in order:
        column = columns[:, place]
        for _ in range(2):  # once is not orthogonal enough
            column = column - basis @ (basis.T @ column)
        size = float(np.linalg.norm(column))
        if size > _EXCITED and basis.shape[1] < len(columns):
            basis, chosen = np.column_stack([basis, column / size]), [*chosen, place]
    return sorted(chosen)


def solve(
    problem: LeastSquares, matrix: Array, goal: Array, sizes: Array, chosen: Sequence[int], guess: Array
) -> tuple[Array, Array]:
    """Return the numbers of the best fit, and the derivatives of all residuals there, in units of `sizes`."""
    from scipy.optimize import least_squares  # takes 0.3 s

    start, first, unit = problem.start, 10 * len(problem.bodies), np.diag(sizes)[:, chosen]
    others = [place for place in chosen if place >= first]
    prior = (np.eye(len(start))[others] / sizes[others, None]) @ unit

    def residuals(z: Array) -> Array:
        x = start + unit @ z
        return np.concatenate([matrix @ problem.delta(x) - goal, problem.distances(x), prior @ z])

    def slopes(z: Array) -> Array:
        x = start + unit @ z
        return np.vstack([matrix @ problem.slopes(x) @ unit, problem.distance_slopes(x, chosen) @ unit, prior])

    # friction and the inertia of a drive are never negative
    lower = [-start[k] / sizes[k] - 1e-9 if first <= k < problem.count else -np.inf for k in chosen]
    first_guess = np.maximum((guess - start)[chosen] / sizes[chosen], lower)
    if not np.isfinite(residuals(first_guess)).all():  # rounded over the edge
        first_guess = np.zeros(len(chosen))
    best = first_guess
    if chosen:  # SciPy before 1.16 refuses a fit of no number
        best = least_squares(residuals, best, slopes, bounds=(lower, np.inf), max_nfev=_MOST_STEPS).x
    x, losses = start + unit @ best, slice(first, problem.count)
    x[losses] = np.maximum(x[losses], 0.0)
    return x, slopes(best)
