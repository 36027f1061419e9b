"""How often `urdfsync identify` is right: logs by MuJoCo, with noise, quantised encoders and a delay.

    python tests/benchmarks/identification.py [--truths N] [--noises N] [arm leg gripper]

Each truth is another robot than its source, and moves otherwise. MuJoCo simulates it once; each run adds noise anew.
docs/identify.md quotes the table.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # the matrices are small: threads cost more than they save
sys.path[:1] = [str(folder) for folder in Path(__file__).resolve().parents[1:3]]

import numpy as np  # noqa: E402
from support import measured  # noqa: E402

import urdfsync  # noqa: E402
from urdfsync.analysis.identification import run, signals  # noqa: E402
from urdfsync.analysis.identification.fit import Fit, LeastSquares, pseudo_inertia  # noqa: E402
from urdfsync.analysis.identification.records import Records, read_records  # noqa: E402
from urdfsync.analysis.identification.results import IdentifyOptions  # noqa: E402
from urdfsync.commands import cli  # noqa: E402
from urdfsync.domain.regressor import Array  # noqa: E402
from urdfsync.engine.options import no_progress  # noqa: E402

SOURCES = {"arm": measured.arm(), "leg": measured.LEG, "gripper": measured.GRIPPER}
_OPTIONS = IdentifyOptions()
_IDENTIFIABLE = 6.0
"""Standard errors in the natural size of a number, at least, of a base parameter that is judged."""
_DELAY = measured.NOISE.delay / measured.RATE - measured.STEP / 2
"""Of the efforts in s: MuJoCo holds an effort for a step, so that it acts half a step later than it is logged."""


class Trial(NamedTuple):
    """One run: a log with its own noise, and what the fit makes of it."""

    errors: dict[str, float]
    """Of each base parameter, in its standard errors."""
    is_consistent: bool
    """Whether each link is a real body."""
    ratios: list[float]
    """Prediction error of each joint on a second trajectory, in that of the real robot's own numbers."""
    ratio: float
    """Likewise, of all joints."""
    ratio_of_records: float
    """Likewise with the numbers of the records alone: without the fitted offset, and with the true delay."""
    seconds: float


def trials(name: str, truths: int, noises: int, seconds: float) -> Iterator[Trial]:
    """Yield the runs of a robot: `noises` logs of each of `truths` real robots. Works in the current folder."""
    source = SOURCES[name]
    records = _built("source", source)
    for seed in range(truths):
        real = measured.changed(source, seed)
        truth = _Truth(records, _built("measured", real))
        clean = measured.record(real, seconds=seconds, noise=None, motion=seed)
        second = measured.record(real, seconds=10, noise=None, motion=500 + seed).spoiled(measured.NOISE, 10**6 + seed)
        other = run.Measured(truth.regressor, second.write(Path("second.csv")), _OPTIONS, no_progress)
        for number in range(noises):
            log = clean.spoiled(measured.NOISE, 1000 * seed + number).write(Path("log.csv"))
            yield truth.judge(log, other)


def _built(name: str, text: str) -> Records:
    Path(f"{name}.urdf").write_text(text)
    Path("urdfsync.toml").write_text(f'[robots.{name}]\nsource = "{name}.urdf"\npackage = "{name.title()}"\n')
    assert cli.main(["build", "--quiet", "--full"]) == 0
    config = urdfsync.load()
    return read_records(config, config.robots[0], 10)


class _Truth:
    """A real robot beside the records that are fitted to its logs."""

    def __init__(self, records: Records, real: Records) -> None:
        self.records, self.regressor = records, records.regressor()
        regressor = real.regressor()
        self.numbers = np.array([*(body.numbers for body in regressor.bodies)]).ravel()
        self.numbers = np.concatenate([self.numbers, [loss.value for loss in regressor.losses]])
        self.base: dict[str, Array] = {}
        """Base parameters as combinations of the linear parameters; the same ones for all logs of one motion."""

    def judge(self, log: Path, other: run.Measured) -> Trial:
        found = run.Measured(self.regressor, log, _OPTIONS, no_progress)
        start = time.perf_counter()
        problem, places, _ = run._problem(self.regressor, found, self.records, _OPTIONS)
        fit = run._fitted(problem, found, places)
        duration, count = time.perf_counter() - start, problem.count
        truth = problem.delta(np.concatenate([self.numbers, np.zeros(len(problem.start) - count)]))[:-1]
        self.base = self.base or _base_parameters(problem, found, fit)
        slopes = problem.slopes(fit.after)[:count, :count]
        covariance = slopes @ fit.covariance[:count, :count] @ slopes.T
        errors = {
            name: float(ways @ (fit.delta - truth)[:count] / np.sqrt(ways @ covariance @ ways))
            for name, ways in self.base.items()
        }
        bodies = zip(fit.after[: 10 * len(problem.bodies)].reshape(-1, 10), problem.bodies, strict=True)
        least = [np.linalg.eigvalsh(pseudo_inertia(numbers, body.rotation))[0] for numbers, body in bodies]
        of_records = np.where(np.arange(len(fit.delta)) < count, fit.delta, 0.0)
        best = _prediction_errors(other, _DELAY, truth)
        ours = _prediction_errors(other, float(fit.after[-1]), fit.delta) / best
        recorded = _prediction_errors(other, _DELAY, of_records) / best
        ratio, ratio_of_records = (float(np.sqrt(np.mean(each**2))) for each in (ours, recorded))
        return Trial(errors, min(least) > 0, [*ours], ratio, ratio_of_records, duration)


def _prediction_errors(other: run.Measured, delay: float, delta: Array) -> Array:
    fits = other.joint_fits(other.evidence, signals.target_at(delay), delta)
    return np.array([joint.after for joint in fits])


def _base_parameters(problem: LeastSquares, found: run.Measured, fit: Fit) -> dict[str, Array]:
    """Return the combinations of parameters that a log determines, by the name of their first number.

    A column of the derivatives that is a combination of others joins theirs (Gautier 1991). Losses come first.
    """
    sizes = run.natural_sizes(problem, found)
    slopes, count = problem.slopes(problem.start), problem.count
    columns = fit.matrix @ slopes * sizes
    of_log = np.linalg.qr(columns[:, count:])[0]
    columns = columns[:, :count] - of_log @ (of_log.T @ columns[:, :count])
    left, chosen = columns.copy(), list[int]()
    for group in (range(10 * len(problem.bodies), count), range(10 * len(problem.bodies))):
        while True:
            lengths = np.linalg.norm(left, axis=0)
            place = max(
                (each for each in group if each not in chosen), key=lambda each: float(lengths[each]), default=0
            )
            if lengths[place] < _IDENTIFIABLE or place in chosen:
                break
            way = left[:, place] / lengths[place]
            left, chosen = left - np.outer(way, way @ left), [*chosen, place]
    others = [place for place in range(count) if place not in chosen]
    ways = np.zeros((len(chosen), count))
    ways[range(len(chosen)), chosen] = 1
    ways[:, others] = np.linalg.lstsq(columns[:, chosen], columns[:, others], rcond=None)[0]
    ways = ways / sizes[:count] @ np.linalg.inv(slopes[:count, :count])
    names = (" ".join(run._name(problem, place)) for place in chosen)
    return dict(zip(names, ways, strict=True))


def main() -> None:
    """Print one row of the table for each robot."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("names", nargs="*", metavar="ROBOT", default=[*SOURCES], help=f"of {', '.join(SOURCES)}")
    parser.add_argument("--truths", type=int, default=5, help="real robots, each with its own motion")
    parser.add_argument("--noises", type=int, default=20, help="logs of each")
    parser.add_argument("--seconds", type=float, default=40, help="duration of a log")
    options = parser.parse_args()
    for name in options.names:
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            results = list(trials(name, options.truths, options.noises, options.seconds))
            os.chdir("/")
        sys.stdout.write(f"{name}: {summary(results)}\n")
        sys.stdout.flush()


def summary(results: list[Trial]) -> str:
    """Return how many runs were right, in words."""
    by_name = defaultdict[str, list[bool]](list)
    for result in results:
        for parameter, error in result.errors.items():
            by_name[parameter].append(abs(error) < 3)
    shares = {parameter: float(np.mean(each)) for parameter, each in by_name.items()}
    worst = min(shares, key=lambda each: shares[each])
    ratios, of_records = (np.array([getattr(each, k) for each in results]) for k in ("ratio", "ratio_of_records"))
    joints = np.array([result.ratios for result in results])
    return (
        f"{len(results)} runs; {len(shares)} base parameters, "
        f"{100 * np.mean(np.concatenate([*by_name.values()])):.2f} % within three errors; "
        f"worst: {worst}, {100 * shares[worst]:.1f} % of {len(by_name[worst])}; "
        f"all in {sum(max(map(abs, each.errors.values())) < 3 for each in results)}; "
        f"consistent {sum(each.is_consistent for each in results)}; "
        f"ratio median {np.median(ratios):.3f}, most {ratios.max():.3f}, at most 1.1 in {np.sum(ratios <= 1.1)}; "
        f"each joint at most 1.1 in {np.sum((joints <= 1.1).all(axis=1))}, most {joints.max():.3f}; "
        f"records alone median {np.median(of_records):.3f}, most {of_records.max():.3f}; "
        f"{np.median([each.seconds for each in results]):.1f} s a fit"
    )


if __name__ == "__main__":
    main()
