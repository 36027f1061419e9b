"""Measure whole processes: wall-clock time, processor time, peak memory; and compare them in pairs."""

from __future__ import annotations

import dataclasses
import os
import random
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

_CHILD = Path(__file__).with_name("child.py")


class UnexpectedError(Exception):
    """A measured process failed, or did not do what was to be measured."""


@dataclasses.dataclass(frozen=True)
class Cost:
    """The cost of a process, in seconds and bytes."""

    wall: float
    cpu: float = 0.0
    """Of the process and of all that it started."""
    peak: float = 0.0
    """Of the process itself. At least about 12 MB, the size of the small process that starts it."""


Measurement = Callable[[], Cost]


@dataclasses.dataclass(frozen=True)
class Reading:
    """One number that is read from a pair of costs."""

    of: Callable[[Cost, Cost], float]
    at_most: float | None = None
    """The bar; None if there is none."""
    what: str = ""
    """What the number is, if it is not the ratio of wall-clock times."""


@dataclasses.dataclass(frozen=True)
class Pair:
    """Two measurements that are taken in turn."""

    what: str
    mine: Measurement
    against: str
    other: Measurement
    readings: Sequence[Reading]
    is_slow: bool = False
    """It takes minutes: it is measured in fewer rounds, without one to warm up."""


@dataclasses.dataclass(frozen=True)
class Result:
    """The readings of all rounds of a pair, and the median costs."""

    pair: Pair
    mine: Cost
    other: Cost
    values: Sequence[Sequence[float]]
    """For each reading of the pair, its value in each round."""


def compare(pair: Pair, rounds: int) -> Result:
    """Take both measurements of a pair once a round, in random order, after a round that fills caches."""
    costs: list[tuple[Cost, Cost]] = []
    for number in range(rounds if pair.is_slow else rounds + 1):
        if random.random() < 0.5:
            mine, other = pair.mine(), pair.other()
        else:
            other, mine = pair.other(), pair.mine()
        if number or pair.is_slow:
            costs.append((mine, other))
    values = [[reading.of(*both) for both in costs] for reading in pair.readings]
    return Result(pair, _median([mine for mine, _ in costs]), _median([other for _, other in costs]), values)


def _median(costs: Sequence[Cost]) -> Cost:
    fields = [field.name for field in dataclasses.fields(Cost)]
    return Cost(*(statistics.median(getattr(cost, field) for cost in costs) for field in fields))


def measure(command: Sequence[str], folder: Path, expected: str = "") -> Cost:
    """Run a command in a folder and return its cost.

    Raises:
        UnexpectedError: it failed, or its output lacks the expected text.
    """
    with tempfile.NamedTemporaryFile() as output:
        watched = [sys.executable, "-I", "-S", str(_CHILD), output.name, *command]
        told = subprocess.run(watched, cwd=folder, env=variables(), check=True, stdout=subprocess.PIPE, text=True)
        code, *costs = map(float, told.stdout.split())
        text = Path(output.name).read_text(errors="replace")
    if code or expected not in text:
        raise UnexpectedError(f"{' '.join(command)} in {folder}: exit code {code:g}, no {expected!r} in\n{text}")
    return Cost(*costs)


def run(command: Sequence[str], folder: Path) -> None:
    """Run a command that is not measured. Raises UnexpectedError, with its output, if it fails."""
    done = subprocess.run(
        command, cwd=folder, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=variables(), text=True
    )
    if done.returncode:
        raise UnexpectedError(f"{' '.join(command)} in {folder}: exit code {done.returncode}\n{done.stdout}")


def variables() -> dict[str, str]:
    """The environment of all processes, without variables of a git hook or a test run."""
    return {name: value for name, value in os.environ.items() if not name.startswith(("GIT_", "PYTHON"))}
