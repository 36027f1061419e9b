"""The fit: real bodies, numbers that stay, and standard errors that hold against MuJoCo."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from benchmarks.identification import SOURCES, trials
from support.measured import GRIPPER

import urdfsync
from urdfsync.analysis.identification import run
from urdfsync.analysis.identification.fit import (
    LeastSquares,
    inertial_parameters,
    is_body,
    pseudo_inertia,
    pseudo_inertia_slopes,
)
from urdfsync.analysis.identification.results import IdentifyOptions
from urdfsync.domain.regressor import MovingLink
from urdfsync.engine.options import no_progress

BOX = MovingLink(
    "box", np.array([2.0, 0.1, -0.2, 0.3, 0.02, 0.03, 0.04, 0.001, -0.002, 0.003]), np.eye(3), is_first=True
)
OPTIONS = IdentifyOptions()


def test_a_body_has_pinocchios_parameters() -> None:
    pin = pytest.importorskip("pinocchio")
    mass, centre, (xx, yy, zz, xy, xz, yz) = BOX.numbers[0], BOX.numbers[1:4], BOX.numbers[4:]
    turn = pin.rpy.rpyToMatrix(0.3, -0.4, 0.5)
    tensor = turn @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ turn.T
    expected = pin.Inertia(mass, centre, tensor).toDynamicParameters()
    assert np.allclose(inertial_parameters(BOX.numbers, turn), expected, atol=1e-14)


@pytest.mark.parametrize(
    ("place", "value", "real"),
    [(0, 0.0, False), (0, -1.0, False), (6, 0.06, False), (6, 0.045, True), (7, 0.03, False)],
)
def test_what_a_real_body_is(place: int, value: float, real: bool) -> None:
    numbers = BOX.numbers.copy()
    numbers[place] = value
    assert is_body(BOX._replace(numbers=numbers)) is real


def test_derivatives_are_those_of_small_changes() -> None:
    problem, turn = LeastSquares([BOX], (), 0), np.linalg.qr(np.arange(9.0).reshape(3, 3) ** 2 + np.eye(3))[0]
    x = problem.start * 1.05
    for k, moved in enumerate(np.eye(11) * 1e-6):
        change = (problem.distance(0, (x + moved)[:10]) - problem.distance(0, (x - moved)[:10])) / 2e-6
        assert np.allclose(problem.distance_slopes(x, range(11))[:, k], change, rtol=1e-4, atol=1e-5)
        linear = (problem.delta(x + moved) - problem.delta(x - moved)) / 2e-6
        assert np.allclose(problem.slopes(x)[:, k], linear, atol=1e-6)
        if k < 10:
            bodies = (pseudo_inertia(x[:10] + way * moved[:10], turn) for way in (1, -1))
            assert np.allclose(pseudo_inertia_slopes(x[:10], turn)[k], np.subtract(*bodies) / 2e-6, atol=1e-6)


def test_the_distance_of_bodies_does_not_depend_on_units() -> None:
    grams = np.array([1e3, *[1e2] * 3, *[1e7] * 6])  # of g and cm
    other = BOX.numbers * [1.1, 1, 1.2, 1, 1.05, 1, 1, 1, 1, 1]
    one, two = (LeastSquares([BOX._replace(numbers=BOX.numbers * unit)], (), 0) for unit in (np.ones(10), grams))
    assert np.allclose(np.linalg.norm(one.distance(0, other)), np.linalg.norm(two.distance(0, other * grams)))
    assert not one.distance(0, BOX.numbers).round(12).any()


@pytest.mark.slow
@pytest.mark.parametrize("name", SOURCES)
def test_fits_are_right_against_another_simulator(folder: Path, name: str) -> None:
    """Base parameters are within their errors, links are real bodies, and a second motion is predicted."""
    results = list(trials(name, truths=1, noises=3, seconds=20))
    errors = np.abs([error for each in results for error in each.errors.values()])
    assert len(errors) >= {"arm": 120, "leg": 50, "gripper": 15}[name]
    assert np.mean(errors < 3) > 0.95, errors
    assert np.mean(errors > 0.1) > 0.5, "the errors are no larger than they have to be"
    for each in results:
        assert each.is_consistent
        assert each.ratio < 1.1


@pytest.mark.slow
def test_a_coupled_gripper_is_fitted(gripper: Path) -> None:
    """A follower has no effort of its own: its link stays, and the leader's numbers take over its part."""
    loaded = urdfsync.load()
    result = run.identify(loaded, loaded.robots[0], Path("log.csv"), OPTIONS, no_progress, write=False)
    assert {number.element for number in result.numbers} == {"link left", "joint drive"}
    assert {each.element for each in result.unexcited} == {"link left", "link right", "joint other"}
    (joint,) = result.joints
    assert joint.after < 0.05 * joint.before
    assert GRIPPER.count("<mimic") == 1
