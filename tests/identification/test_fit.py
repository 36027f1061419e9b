"""The fit: real bodies, numbers that stay, and standard errors that hold against MuJoCo."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from scipy.optimize import least_squares
from support import measured
from support.measured import GRIPPER, LEG, arm

import urdfsync
from urdfsync import cli
from urdfsync.engine.options import no_progress
from urdfsync.identification import run, signals
from urdfsync.identification.fit import Fit, Problem, inertial_parameters, is_body, pseudo_inertia
from urdfsync.identification.records import Records, read_records
from urdfsync.identification.results import Array, Body, IdentifyOptions, Regressor

BOX = Body("box", np.array([2.0, 0.1, -0.2, 0.3, 0.02, 0.03, 0.04, 0.001, -0.002, 0.003]), np.eye(3), is_first=True)
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


def test_the_distance_of_bodies_does_not_depend_on_units() -> None:
    grams = np.array([1e3, *[1e2] * 3, *[1e7] * 6])  # of g and cm
    other = BOX.numbers * [1.1, 1, 1.2, 1, 1.05, 1, 1, 1, 1, 1]
    one, two = (Problem([BOX._replace(numbers=BOX.numbers * unit)], (), 0) for unit in (np.ones(10), grams))
    assert np.allclose(np.linalg.norm(one.distance(0, other)), np.linalg.norm(two.distance(0, other * grams)))
    assert not one.distance(0, BOX.numbers).round(12).any()


class Subject(NamedTuple):
    """A robot whose log is fitted."""

    records: Records
    regressor: Regressor
    truth: Regressor


def subject(source: str, truth: str) -> Subject:
    """Build a robot, and the robot of the log."""
    both = []
    for name, text in (("robot", source), ("measured", truth)):
        Path(f"{name}.urdf").write_text(text)
        Path("urdfsync.toml").write_text(f'[robots.{name}]\nsource = "{name}.urdf"\npackage = "{name.title()}"\n')
        assert cli.main(["build", "--quiet", "--full"]) == 0
        loaded = urdfsync.load()
        both.append(read_records(loaded, loaded.robots[0], 10))
    return Subject(both[0], both[0].regressor(), both[1].regressor())


def fitted(one: Subject, log: Path) -> tuple[run.Measured, Problem, Fit]:
    found = run.Measured(one.regressor, log, OPTIONS, no_progress)
    problem, places, _ = run._problem(one.regressor, found, one.records, OPTIONS)
    return found, problem, run._fitted(problem, found, places)


def true_delta(one: Subject, problem: Problem) -> Array:
    """How far the real robot's parameters are from those of the source."""
    numbers = [body.numbers for body in one.truth.bodies], [loss.value for loss in one.truth.losses]
    x = np.concatenate([*numbers[0], numbers[1], np.zeros(len(problem.start) - problem.count)])
    return problem.delta(x)[:-1]


def errors(found: run.Measured, problem: Problem, fit: Fit, delta: Array) -> Array:
    """The errors of the fitted numbers in standard errors.

    The numbers that stay are wrong, so the others can't be right: they are right if they explain what the real robot's
    numbers explain (base parameters).
    """
    target = signals.target_at(float(fit.after[-1]))
    roots = found.evidence.roots(np.concatenate([fit.delta, -target]))
    rows = found.evidence.stacked(roots)[:, : len(delta)]
    chosen = [place for place in np.flatnonzero(fit.is_fitted) if place < problem.count]

    def unexplained(z: Array) -> Array:
        x = problem.start.copy()
        x[chosen] = fit.after[chosen] + z * fit.errors[chosen]
        return rows @ (problem.delta(x)[:-1] - delta)

    return np.asarray(least_squares(unexplained, np.zeros(len(chosen)), max_nfev=40).x)


@pytest.mark.slow
@pytest.mark.parametrize(("source", "truths", "noises"), [(LEG, 2, 3), (arm(), 1, 2)], ids=["leg", "arm"])
def test_standard_errors_hold_against_another_simulator(folder: Path, source: str, truths: int, noises: int) -> None:
    """Also: each link is a real body, and a second motion is predicted as well as by the real robot's own numbers."""
    found_errors = list[float]()
    for seed in range(truths):
        truth = measured.changed(source, seed)
        one = subject(source, truth)
        clean = measured.record(truth, noise=None, motion=seed)
        second = measured.record(truth, seconds=8, motion=500 + seed).write(Path("second.csv"))
        other = run.Measured(one.regressor, second, OPTIONS, no_progress)
        for number in range(noises):
            found, problem, fit = fitted(one, clean.spoiled(measured.NOISE, 10 * seed + number).write(Path("log.csv")))
            delta = true_delta(one, problem)
            for k, body in enumerate(problem.bodies):
                numbers = fit.after[10 * k : 10 * k + 10]
                assert np.linalg.eigvalsh(pseudo_inertia(numbers, body.rotation))[0] > 0
            if not fit.freed:
                found_errors += [*errors(found, problem, fit, delta)]
            for place, loss in enumerate(one.truth.losses, 10 * len(problem.bodies)):
                if loss.path != "dynamics.armature":  # friction is determined whatever the inertias are
                    found_errors.append(float(fit.after[place] - loss.value) / fit.errors[place])
            by_record = np.where(np.arange(len(fit.delta)) < problem.count, fit.delta, 0.0)
            target = signals.target_at(0.004)
            ours, best = (other.joint_fits(other.evidence, target, each) for each in (by_record, delta))
            noise = measured.NOISE.effort
            for joint, true in zip(ours, best, strict=True):
                # the filter leaves a tenth of the noise, and a user sees all of it
                floor = noise * joint.measured
                assert np.hypot(joint.after, floor) < 1.1 * np.hypot(true.after, floor), joint.element
    assert np.mean(np.abs(found_errors) < 3) > 0.95, found_errors


def test_a_coupled_gripper_is_fitted(gripper: Path) -> None:
    """A follower has no effort of its own: its link stays, and the leader's numbers take over its part."""
    loaded = urdfsync.load()
    result = run.identify(loaded, loaded.robots[0], Path("log.csv"), OPTIONS, no_progress, write=False)
    assert {number.element for number in result.numbers} == {"link left", "joint drive"}
    assert {each.element for each in result.unexcited} == {"link left", "link right", "joint other"}
    (joint,) = result.joints
    assert joint.after < 0.05 * joint.before
    assert GRIPPER.count("<mimic") == 1
