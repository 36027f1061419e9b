"""Options and results of identifications: plain data."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple, Protocol

import msgspec
import numpy as np
from numpy.typing import NDArray

from urdfsync.checks.experiment import Sample
from urdfsync.checks.results import JointFit
from urdfsync.diagnostics import Diagnostic

Array = NDArray[np.float64]

NUMBERS = (
    "inertial.mass",
    *(f"inertial.origin.xyz[{k}]" for k in (1, 2, 3)),
    *(f"inertial.inertia.{part}" for part in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")),
)
"""Paths of the ten numbers of a link in its record."""
JOINT_NUMBERS = {"dynamics.damping": "damping", "dynamics.friction": "friction", "dynamics.armature": "armature"}
"""Paths of the fitted numbers of a joint in its record, and their names in Pinocchio."""


QUANTITIES = ("position", "velocity", "effort")


class Axis(NamedTuple):
    """A joint that moves by itself, in rad or m."""

    name: str
    component: str
    """The joint's name in Modelica."""
    unit: str
    start: float
    range: tuple[float, float]
    speed: float
    """The limit, or infinity."""
    effort: float
    """Likewise."""
    reduction: float
    """The gear's reduction; 1 without a gear."""
    command: str
    """The quantity that Run takes for the joint, of `QUANTITIES`; empty if Run does not drive it."""
    input: str
    """The name of this input of Run."""


class MovingLink(NamedTuple):
    """A link that moves."""

    name: str
    numbers: Array
    """The numbers of the record, in the order of `NUMBERS`."""
    rotation: Array
    """The axes of the inertia tensor in the link's frame."""
    is_first: bool
    """Whether the link is the first of its body; the others are fixed to it."""


class Loss(NamedTuple):
    """A number of a joint: damping, dry friction, or the drive's inertia."""

    joint: str
    path: str
    value: float


class Regressor(Protocol):
    """A robot whose efforts are linear in its parameters."""

    axes: tuple[Axis, ...]
    bodies: tuple[MovingLink, ...]
    losses: tuple[Loss, ...]

    def rows(self, q: Array, v: Array, a: Array) -> tuple[Array, Array]:
        """Return the derivatives of efforts by parameters, and the efforts, for each sample and axis."""
        ...


class Physics(Protocol):
    """Reads the efforts of a robot; a domain's attribute `identification`."""

    def read_regressor(
        self, sample: Sample, edits: Mapping[tuple[str, str], Mapping[str, tuple[float, ...]]]
    ) -> Regressor:
        """Return the model of a source, with the user's edits of records by kind and name of the element."""
        ...


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
    wait: float = 60.0


class FittedNumber(msgspec.Struct, frozen=True):
    """One number of a record."""

    element: str
    """`link hand`, `joint elbow`."""
    path: str
    before: float
    after: float
    error: float
    """Standard error."""
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
        *("freed", "dropped", "written", "files", "diagnostics"),
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
    is_writing: bool = False
    """Whether the numbers were to be written."""
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
