"""Options and results of simulations: plain data."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Literal

import msgspec

from urdfsync.analysis.checks.compilers.compiler import Series as Series
from urdfsync.analysis.checks.compilers.compiler import Tool
from urdfsync.analysis.checks.results import RunOptions
from urdfsync.common.diagnostics import Diagnostic

STOP = 1.0
"""End of a simulation in s, unless the model's annotation `experiment` or the user gives an end."""
STEPS = 500
"""Number of intervals of results, unless the annotation or the user gives their length."""
TOLERANCE = 1e-6
"""Tolerance of the integration, unless the annotation or the user gives a tolerance."""


class SimulateOptions(RunOptions, frozen=True):
    """How to simulate; None leaves a number to the model."""

    model: str = ""
    """Name of the model, in full or below the robot's package; empty for the robot's own."""
    stop: float | None = None
    step: float | None = None
    tolerance: float | None = None
    method: str = ""
    """One of the compiler's methods of integration; empty leaves the choice to the compiler."""
    values: tuple[str, ...] = ()
    """Changed parameters, `NAME=VALUE`."""
    motion: Path | None = None
    """A CSV file with the inputs of the model."""
    variables: tuple[str, ...] = ()
    """Patterns of further variables for the series."""
    tool: Tool = Tool()
    against: str | None = None
    """A git revision to compare the motion with; None for none."""
    as_exported: bool = False
    """Simulate as the FMU does: drives keep their filters, and inputs change at each step or stay at 0."""


class VaryOptions(SimulateOptions, frozen=True):
    """How to simulate many cases."""

    vary: tuple[str, ...] = ()
    """`NAME=SPEC` for each varied parameter, or the name of a CSV file."""
    cases: int | None = None
    """Number of samples of distributions; None leaves the number to the program."""
    seed: int = 0
    sampling: Literal["latin", "random"] = "latin"
    """See `cases.Sampling.kind`."""
    jobs: int | None = None
    """Number of cases at the same time; None for one per core."""


class Range(msgspec.Struct, frozen=True):
    """The range of a joint's quantity over a simulation."""

    variable: str
    """The variable's full name."""
    unit: str
    least: float
    greatest: float
    lower: float | None
    upper: float | None
    """None for no limit."""


class PassedLimit(msgspec.Struct, frozen=True):
    """A limit that a joint passes."""

    quantity: str
    """`position`, `speed`, `effort` or `acceleration`."""
    limit: float
    time: float
    """The time of the first pass, in s."""
    excess: float
    """The greatest excess, in the unit of the quantity."""
    seconds: float
    """The total time beyond the limit, in s."""


class JointResult(msgspec.Struct, frozen=True):
    """One joint of one robot over a simulation; None for a quantity that the model lacks."""

    element: str
    """The element in the domain's words: `joint elbow`."""
    robot: str
    """The component that is the robot: `robot`, `cell.left`; empty if the model itself is the robot."""
    position: Range | None = None
    speed: Range | None = None
    effort: Range | None = None
    acceleration: Range | None = None
    """The magnitude of the acceleration, negative where the joint slows down; None also without a limit."""
    passed: tuple[PassedLimit, ...] = ()
    is_dependent: bool = False
    """Whether the joint follows other joints through loops."""


class LoopResult(msgspec.Struct, frozen=True):
    """One loop of one robot over a simulation: greatest numbers of the joint that closes it."""

    element: str
    """The element in the domain's words: `loop rocker_pin`."""
    robot: str
    """See `JointResult.robot`."""
    gap: float
    """Greatest gap, in m."""
    force: float
    """Greatest force, in N."""
    torque: float
    """Greatest torque, in N·m."""


class QuantityDifference(msgspec.Struct, frozen=True):
    """The difference of a joint's quantity between two versions of a model, over a simulation."""

    quantity: str
    """`position`, `speed` or `effort`."""
    unit: str
    difference: float
    """The greatest absolute difference at the same time."""
    time: float
    """The time of the greatest difference, in s."""
    least: float
    """The least value in the older version."""
    greatest: float
    """The greatest value in the older version."""


class JointDifference(msgspec.Struct, frozen=True):
    """One joint of one robot in two versions of a model."""

    element: str
    """See `JointResult.element`."""
    robot: str
    """See `JointResult.robot`."""
    former: str
    """The element's name in the older version."""
    differences: tuple[QuantityDifference, ...]
    """The quantities that both versions have."""


class Against(msgspec.Struct, frozen=True):
    """The motion of a model, compared with that of an older version."""

    revision: str
    """The user's name of the older version."""
    joints: tuple[JointDifference, ...]
    only: tuple[str, ...]
    """The joints that only one version has."""


class SimulateResult(msgspec.Struct, frozen=True):
    """A simulation, which may have stopped before its end: then an error is among the diagnostics."""

    KEYS = (
        *("robot", "model", "stop", "step", "tolerance", "points", "seconds", "is_known"),
        *("joints", "loops", "against", "files", "diagnostics"),
    )

    robot: str
    model: str
    """Full name."""
    stop: float
    step: float
    tolerance: float
    joints: tuple[JointResult, ...]
    series: Series
    """Series of `time`, the joints, the model's own inputs and outputs, and requested variables."""
    diagnostics: tuple[Diagnostic, ...]
    seconds: float
    """The duration from beginning to end, in s."""
    is_known: bool
    """Whether the result is a remembered one."""
    loops: tuple[LoopResult, ...] = ()
    files: Mapping[str, Path] = {}
    """The written files, by their options."""
    against: Against | None = None
    former: Series = {}
    """With `against`, the series of the older version by the names of `series`; it may end at another time."""

    @property
    def points(self) -> int:
        """Number of instants."""
        return len(self.series["time"])
