"""Options and results of simulations: plain data."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import msgspec

from urdfsync.checks.compilers.compiler import Series as Series
from urdfsync.checks.compilers.compiler import Tool
from urdfsync.checks.results import RunOptions
from urdfsync.diagnostics import Diagnostic

STOP = 1.0
"""End of a simulation whose model has no `experiment` annotation with one, in s."""
STEPS = 500
"""Intervals of results where neither the annotation nor the user says how long they are."""
TOLERANCE = 1e-6
"""Of the integration, where neither the annotation nor the user names one."""


class SimulateOptions(RunOptions, frozen=True):
    """How to simulate; None leaves a number to the model."""

    model: str = ""
    """Name of the model, in full or below the robot's package; empty for the robot's own."""
    stop: float | None = None
    step: float | None = None
    tolerance: float | None = None
    method: str = ""
    """One of the compiler's methods of integration; empty leaves it to the compiler."""
    values: tuple[str, ...] = ()
    """Parameters that get another value, `NAME=VALUE`."""
    motion: Path | None = None
    """A CSV file with the inputs of the model."""
    variables: tuple[str, ...] = ()
    """Patterns of further variables whose series are wanted."""
    tool: Tool = Tool()
    as_exported: bool = False
    """Whether it is simulated as its FMU would be: filters of drives stay, inputs change at each step, or stay at 0."""


class Range(msgspec.Struct, frozen=True):
    """The range of a joint's quantity over a simulation."""

    variable: str
    """Its full name."""
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
    """The time when it is passed first, in s."""
    excess: float
    """By how much at most, in the unit of the quantity."""
    seconds: float
    """For how long in all."""


class JointResult(msgspec.Struct, frozen=True):
    """One joint of one robot over a simulation; None for what the model does not have."""

    element: str
    """In the domain's words: `joint elbow`."""
    robot: str
    """The component that is the robot: `robot`, `cell.left`; empty if it is the model itself."""
    position: Range | None = None
    speed: Range | None = None
    effort: Range | None = None
    acceleration: Range | None = None
    """Its size, below 0 where the joint slows down; None also for a joint without a limit of it."""
    passed: tuple[PassedLimit, ...] = ()
    is_dependent: bool = False
    """Whether it follows others through loops."""


class LoopResult(msgspec.Struct, frozen=True):
    """One loop of one robot over a simulation: greatest numbers of the joint that closes it."""

    element: str
    """In the domain's words: `loop rocker_pin`."""
    robot: str
    """See `JointResult.robot`."""
    gap: float
    """In m."""
    force: float
    """In N."""
    torque: float
    """In N·m."""


class SimulateResult(msgspec.Struct, frozen=True):
    """A simulation, which may have stopped before its end: then an error is among the diagnostics."""

    KEYS = (
        *("robot", "model", "stop", "step", "tolerance", "points", "seconds", "is_known"),
        *("joints", "loops", "files", "diagnostics"),
    )

    robot: str
    model: str
    """Full name."""
    stop: float
    step: float
    tolerance: float
    joints: tuple[JointResult, ...]
    series: Series
    """Of `time`, of the joints, of the model's own inputs and outputs, and of what was asked for."""
    diagnostics: tuple[Diagnostic, ...]
    seconds: float
    """From beginning to end."""
    is_known: bool
    """Whether it is that of an earlier simulation of the same."""
    loops: tuple[LoopResult, ...] = ()
    files: Mapping[str, Path] = {}
    """Those that were written, by the options that named them."""

    @property
    def points(self) -> int:
        """Number of instants."""
        return len(self.series["time"])
