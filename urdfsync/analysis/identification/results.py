"""Options and results of identifications: plain data."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import msgspec

from urdfsync.analysis.checks.results import JointFit
from urdfsync.common.diagnostics import Diagnostic
from urdfsync.domain.regressor import Array


class IdentifyOptions(msgspec.Struct, frozen=True):
    """How to identify."""

    links: tuple[str, ...] = ()
    """The links and joints to fit; empty for all."""
    joints: tuple[str, ...] = ()
    columns: tuple[str, ...] = ()
    """Columns of the log, as `elbow.effort=current3*21.5`."""
    topic: str = ""
    """The topic of a recording of ROS 2; empty for the only one with joint states."""
    motor_side: bool = False
    """Whether the log has positions and efforts of motors, before the gears."""
    cutoff: float | None = None
    """The filter's cut-off frequency in Hz; None chooses it by the motion."""
    until: float | None = None
    """The time in the log, in s from its beginning, up to which it is fitted; the rest is only predicted."""
    unsure: bool = False
    """Whether to write numbers whose change is not sure, too."""
    wait: float = 60.0


class FittedNumber(msgspec.Struct, frozen=True):
    """One number of a record."""

    element: str
    """`link hand`, `joint elbow`."""
    path: str
    before: float
    after: float
    error: float
    """Standard error, if the numbers that stay are as wrong as those of a source may be."""
    conditional: float = 0.0
    """Standard error if the numbers that stay are right."""
    is_sure: bool = True
    """Whether the log shows a change, if the other numbers stay."""
    is_written: bool = False
    """Whether the number is in a record, now or with `--write`."""


class Unexcited(msgspec.Struct, frozen=True):
    """Numbers of an element that a motion does not determine."""

    element: str
    paths: tuple[str, ...]


class EffortSeries(NamedTuple):
    """Samples for a plot: times in s, and for each joint its measured effort, that of the model, and after the fit."""

    times: Array
    measured: Array
    before: Array
    after: Array
    is_used: Array
    """Whether the fit uses a joint's sample."""


class Identification(msgspec.Struct, frozen=True):
    """What a log says of a robot."""

    KEYS = (
        *("robot", "log", "seconds", "rate", "cutoff", "delay", "joints", "held_out", "numbers", "unexcited"),
        *("freed", "dropped", "is_doubtful", "written", "files", "diagnostics"),
    )

    robot: str
    log: str
    seconds: float
    """Duration of the used parts of the log."""
    rate: float
    """Samples per second in the log."""
    cutoff: float
    """The cut-off frequency of the filter, in Hz."""
    delay: float
    """By how many seconds the log has efforts later than positions."""
    joints: tuple[JointFit, ...]
    numbers: tuple[FittedNumber, ...]
    unexcited: tuple[Unexcited, ...]
    """The numbers that the motion does not determine: they stay."""
    freed: tuple[str, ...] = ()
    """The links whose unexcited numbers changed too, since no real body has the others with them."""
    dropped: tuple[str, ...] = ()
    """What was left out of the log."""
    held_out: tuple[JointFit, ...] = ()
    """The joints in the part of the log that was not fitted."""
    written: tuple[str, ...] = ()
    """The changed records, from the configuration's folder."""
    is_doubtful: bool = False
    """Whether the log is hardly that of the robot: then nothing is fitted."""
    files: Mapping[str, Path] = {}
    """The written files, by their options."""
    diagnostics: tuple[Diagnostic, ...] = ()
    series: Any = None
    """`EffortSeries` for a plot."""


class Excitation(msgspec.Struct, frozen=True):
    """A motion that excites a robot's numbers."""

    KEYS = ("robot", "seconds", "first_condition", "condition", "numbers", "resting", "files")

    robot: str
    seconds: float
    first_condition: float
    """The condition number of the first motion that was tried: of the derivatives by the determined numbers."""
    condition: float
    numbers: int
    """Number of determined numbers."""
    resting: tuple[str, ...]
    """The joints that Run does not drive."""
    files: Mapping[str, Path]
