"""The numbers that remain of each simulated case, and the table of all cases."""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.analysis.checks.compilers.compiler import SimulationResult
from urdfsync.analysis.simulation import joints
from urdfsync.analysis.simulation.cases import Cases
from urdfsync.common.diagnostics import Diagnostic

QUANTITIES = ("position", "speed", "effort", "acceleration")
_WITHOUT_POSITION = QUANTITIES[1:3]
_COLUMNS = ("least", "greatest", "final", "speed", "effort", "energy", "passed")
"""The columns of the table for each joint; speed and effort are the greatest absolute values."""


class JointName(msgspec.Struct, frozen=True):
    """A joint, with the units of `QUANTITIES`; a unit is empty if the model lacks the quantity."""

    element: str
    robot: str
    units: tuple[str, ...]

    @property
    def short(self) -> str:
        """The joint's name in the table: `elbow`, or `cell.left.elbow` for one of several robots."""
        name = self.element.partition(" ")[2] or self.element
        return name if self.robot in ("", "robot") else f"{self.robot}.{name}"


class CaseRange(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """The range of a quantity in one case, and its limits."""

    least: float
    greatest: float
    lower: float | None
    upper: float | None

    @property
    def size(self) -> float:
        """The greatest absolute value."""
        return max(abs(self.least), abs(self.greatest))

    @property
    def load(self) -> float:
        """The greatest share of the way from the middle of both limits to a limit; 0 without both limits."""
        if self.lower is None or self.upper is None or self.lower >= self.upper:
            return 0.0
        middle, half = (self.lower + self.upper) / 2, (self.upper - self.lower) / 2
        return max(self.greatest - middle, middle - self.least) / half


class JointOutcome(msgspec.Struct, frozen=True, array_like=True):
    """One joint in one case."""

    extents: tuple[CaseRange | None, ...]
    """One for each of `QUANTITIES`; None if the model lacks the quantity."""
    final: float | None
    """The last position."""
    energy: float | None
    """The energy in J that the drive gives and takes; None without a drive."""
    passed: tuple[str, ...]
    """The quantities that pass a limit."""


class Outcome(msgspec.Struct, frozen=True):
    """One case; without joints if it failed."""

    names: tuple[JointName, ...] = ()
    joints: tuple[JointOutcome, ...] = ()
    problem: str = ""
    """Why there is no result; empty if the case was simulated."""
    termination: str = ""
    """The model's message, if the model itself ended the simulation."""

    @property
    def status(self) -> str:
        """Whether all joints stay `within` their limits, one goes `beyond`, or the case has `failed`."""
        if self.problem:
            return "failed"
        return "beyond" if any(joint.passed for joint in self.joints) else "within"

    @property
    def load(self) -> float:
        """The greatest share of its limit that a speed, an effort, or another quantity beyond its limit takes."""
        return max((load for load, _, _ in self._loads()), default=0.0)

    @property
    def heaviest(self) -> str:
        """The joint and quantity with the greatest load: `joint elbow: effort 24.1 of 20 N·m`; empty without limits."""
        load, joint, place = max(self._loads(), default=(0.0, 0, 0))
        extent = self.joints[joint].extents[place] if load else None
        if extent is None or extent.lower is None or extent.upper is None:
            return ""
        is_upper = extent.upper - extent.greatest <= extent.least - extent.lower
        value, limit = (extent.greatest, extent.upper) if is_upper else (extent.least, extent.lower)
        name, quantity = self.names[joint], QUANTITIES[place]
        return f"joint {name.short}: {quantity} {value:.3g} of {limit:.3g} {name.units[place]}"

    def _loads(self) -> Iterator[tuple[float, int, int]]:
        """Yield loads with the numbers of joint and quantity."""
        for number, joint in enumerate(self.joints):
            for place, (name, extent) in enumerate(zip(QUANTITIES, joint.extents, strict=True)):
                if extent is not None and (name in _WITHOUT_POSITION or name in joint.passed):
                    yield extent.load, number, place


class CaseOutcome(msgspec.Struct, frozen=True):
    """One case in a document."""

    number: int
    """Counted from 1."""
    values: Mapping[str, float]
    """The varied parameters."""
    status: str
    """`within` or `beyond` the limits, or `failed`."""
    load: float
    """The greatest share of a limit: above 1 beyond it."""
    problem: str
    """The reason why the case failed."""


class QuantitySummary(msgspec.Struct, frozen=True):
    """The greatest absolute value of a joint's quantity over all simulated cases."""

    element: str
    robot: str
    quantity: str
    unit: str
    least: float
    median: float
    greatest: float
    limit: float | None
    """The least upper limit of all cases; None without a limit."""
    beyond: int
    """Number of cases in which the quantity passes a limit."""


class Study(msgspec.Struct, frozen=True):
    """A model, simulated in many cases."""

    KEYS = (
        *("robot", "model", "stop", "step", "tolerance", "seconds", "known"),
        *("within", "beyond", "failed", "worst", "replay", "summaries", "cases", "files", "diagnostics"),
    )

    robot: str
    model: str
    """Full name."""
    stop: float
    step: float
    tolerance: float
    varied: Cases
    outcomes: Sequence[Outcome]
    """An outcome for each case, in order."""
    seconds: float
    known: int
    """Number of cases whose outcomes were remembered."""
    command: str
    """The command that simulates a case, without the case's values."""
    diagnostics: tuple[Diagnostic, ...] = ()
    files: Mapping[str, Path] = {}
    """The written files, by their options."""

    @property
    def within(self) -> int:
        """Number of cases within all limits."""
        return self._count("within")

    @property
    def beyond(self) -> int:
        """Number of cases that pass a limit."""
        return self._count("beyond")

    @property
    def failed(self) -> int:
        """Number of cases without a result."""
        return self._count("failed")

    @property
    def worst(self) -> int | None:
        """The number of the case with the greatest load, counted from 1; None if all failed."""
        loads = [(outcome.load, -number) for number, outcome in enumerate(self.outcomes, 1) if not outcome.problem]
        return -max(loads)[1] if loads else None

    @property
    def replay(self) -> str:
        """The command that simulates the worst case alone; empty without one."""
        values = self.varied.settings(self.worst - 1) if self.worst else []
        return " ".join([self.command, *(f"--set {value}" for value in values)]) if self.worst else ""

    @property
    def cases(self) -> list[CaseOutcome]:
        """All cases."""
        values = (dict(zip(self.varied.names, row, strict=True)) for row in self.varied.rows)
        return [
            CaseOutcome(number, row, outcome.status, outcome.load, outcome.problem)
            for number, (row, outcome) in enumerate(zip(values, self.outcomes, strict=True), 1)
        ]

    @property
    def names(self) -> tuple[JointName, ...]:
        """The joints; empty if all cases failed."""
        return next((outcome.names for outcome in self.outcomes if not outcome.problem), ())

    @property
    def summaries(self) -> list[QuantitySummary]:
        """Speed and effort of each joint, and other quantities that pass a limit in a case."""
        simulated = [outcome.joints for outcome in self.outcomes if not outcome.problem]
        summaries = []
        for name, column in zip(self.names, zip(*simulated, strict=True), strict=True):
            for place, (quantity, unit) in enumerate(zip(QUANTITIES, name.units, strict=True)):
                extents = [extent for joint in column if (extent := joint.extents[place]) is not None]
                beyond = sum(quantity in joint.passed for joint in column)
                if extents and (beyond or quantity in _WITHOUT_POSITION):
                    sizes = [extent.size for extent in extents]
                    limit = min((extent.upper for extent in extents if extent.upper is not None), default=None)
                    numbers = min(sizes), statistics.median(sizes), max(sizes), limit, beyond
                    summaries.append(QuantitySummary(name.element, name.robot, quantity, unit, *numbers))
        return summaries

    def _count(self, status: str) -> int:
        return sum(outcome.status == status for outcome in self.outcomes)


def outcome_of(layouts: joints.Layouts, run: SimulationResult) -> Outcome:
    """Return the numbers that remain of a simulation."""
    if run.problem or not run.values:
        return Outcome(problem=run.problem or "the compiler gave no result")
    if not all(math.isfinite(number) for values in run.values.values() for number in values):
        return Outcome(problem="a value is not finite")
    names, outcomes = [], []
    energies = joints.energies(layouts, run.values, run.parameters)
    results = joints.joint_results(layouts, run.values, run.parameters)
    for joint, energy in zip(results, energies, strict=True):
        ranges = [getattr(joint, quantity) for quantity in QUANTITIES]
        names.append(JointName(joint.element, joint.robot, tuple(each.unit if each else "" for each in ranges)))
        extents = (each and CaseRange(each.least, each.greatest, each.lower, each.upper) for each in ranges)
        final = run.values[joint.position.variable][-1] if joint.position else None
        passed = tuple(dict.fromkeys(limit.quantity for limit in joint.passed))
        outcomes.append(JointOutcome(tuple(extents), final, energy, passed))
    return Outcome(tuple(names), tuple(outcomes), termination=run.termination)


def table(study: Study) -> Iterator[str]:
    """Yield the lines of a CSV file: a row for each case, with all digits of each number."""
    heads = [f"{name.short}.{column}" for name in study.names for column in _COLUMNS]
    header = ["case", *study.varied.names, "status", "load", *heads]
    yield ",".join([*map(_quoted, header), "problem"]) + "\n"
    for number, (row, outcome) in enumerate(zip(study.varied.rows, study.outcomes, strict=True), 1):
        cells = [str(number), *map(repr, row), outcome.status, "" if outcome.problem else repr(outcome.load)]
        for joint in outcome.joints:
            position, speed, effort, _ = joint.extents
            bounds = (position.least, position.greatest) if position else (None, None)
            sizes = (extent and extent.size for extent in (speed, effort))
            cells += ["" if value is None else repr(value) for value in (*bounds, joint.final, *sizes, joint.energy)]
            cells.append(" ".join(joint.passed))
        cells += [""] * (len(header) - len(cells))
        yield ",".join([*cells, _quoted(" ".join(outcome.problem.split()))]) + "\n"


def _quoted(text: str) -> str:
    doubled = text.replace('"', '""')
    return f'"{doubled}"' if any(mark in text for mark in ',"') else text
