"""Comparisons of a package with an independent reference, as values; the functions that `check` needs of a domain."""

from __future__ import annotations

import enum
import math
from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import msgspec

from urdfsync.common.diagnostics import UrdfsyncError
from urdfsync.domain.model import Companion, Import, Snapshot, Target


class Aspect(enum.StrEnum):
    """Part of a model that has a verdict of its own."""

    BODIES = "rigid bodies"
    LOSSES = "friction and gears"
    FREE_MOTION = "free motion"
    """Accelerations that follow from efforts."""
    LOOPS = "loops"
    """Gaps, and the forces that close them."""
    SENSORS = "sensors"


class Quantity(enum.StrEnum):
    """Quantity of a frame, an axis, the root or the whole model that is compared with a reference; in SI units."""

    POSITION = "position"
    ORIENTATION = "orientation"
    """Elements of the rotation matrix."""
    EFFORT = "effort"
    REACTION = "reaction"
    """Force and torque that hold the root."""
    MASS = "mass"
    CENTRE = "centre of mass"
    ACCELERATION = "acceleration"
    READING = "reading"
    """Output of a sensor."""
    CLOSURE = "gap"
    """Vector from one frame of a loop to the other."""


TOLERANCE = 1e-10
"""The greatest difference that counts as agreement, relative to the greatest value of its kind or 1."""
_TOLERANCES = {Quantity.ACCELERATION: 1e-7}  # solving equations for them loses digits


class Deviation(msgspec.Struct, frozen=True):
    """Greatest deviation of one quantity of one element from the reference, over all instants."""

    KEYS = ("quantity", "element", "difference", "value", "size", "unit", "part", "detail", "relative", "agrees")

    quantity: Quantity
    element: str
    """The element in the domain's words: `link hand`, `joint elbow`, `robot`."""
    difference: float
    """The greatest absolute difference, in `unit`; infinite or NaN if the simulation gave no number."""
    value: float
    """The greatest absolute value of the reference for this element, in `unit`."""
    size: float
    """The greatest absolute value of the reference for this quantity in this unit over all elements."""
    unit: str
    part: Aspect = Aspect.BODIES
    detail: str = ""
    """Distinguishes several deviations of one element: the output of a sensor."""
    least_tolerance: float = 0.0
    """See `Compared.least_tolerance`."""

    @property
    def key(self) -> tuple[str, ...]:
        """The fields that identify the quantity of the element."""
        return self.part, self.quantity, self.element, self.unit, self.detail

    @property
    def relative(self) -> float:
        """Difference relative to `size`, or to 1 if `size` is smaller; infinite instead of NaN."""
        relative = self.difference / max(1.0, self.size)
        return math.inf if math.isnan(relative) else relative

    @property
    def tolerance(self) -> float:
        """The greatest relative difference that counts as agreement."""
        return max(_TOLERANCES.get(self.quantity, TOLERANCE), self.least_tolerance)

    @property
    def agrees(self) -> bool:
        """Whether the difference is within the tolerance."""
        return self.relative <= self.tolerance


class Mismatch(msgspec.Struct, frozen=True):
    """A number or name of the package or the snapshot that differs from an independent reading of the source."""

    element: str
    quantity: str
    """The path of the number or name in the record, such as `limits.effort`, or an attribute, such as `parent`."""
    expected: str
    """The source's value."""
    given: str
    """The value of the package, or of the snapshot."""
    file: str
    """Path below the package's folder."""
    line: int
    source: str
    """The source's file."""
    source_line: int


class Numbers(msgspec.Struct, frozen=True):
    """The numbers and names of a package, compared with an independent reading of the source."""

    right: int = 0
    total: int = 0
    differences: tuple[Mismatch, ...] = ()
    edits: tuple[Mismatch, ...] = ()
    """Differences that come from the user's edits."""
    uncompared: tuple[str, ...] = ()
    """Parts that nothing compares: one sentence each, without a full stop."""

    @property
    def summary(self) -> str:
        """A few words for the verdict."""
        words = "differ" if self.differences else "right"
        edited = f", {len(self.edits)} edited" if self.edits else ""
        return f"numbers {words} ({self.right} of {self.total}{edited})"


class Probe(msgspec.Struct, frozen=True):
    """A model that puts a package to the test: Modelica text, what to simulate, and which values to hand back."""

    source: str
    """One package, whose imports name the libraries that it needs."""
    model: str
    """Full name of the model in `source`."""
    stop: float
    """End of the simulation that begins at 0, in s."""
    step: float
    """Interval of results, in s."""
    values: tuple[str, ...]
    tolerance: float | None = None
    """Tolerance of the integration; None for the compiler's own."""


class Compared(msgspec.Struct, frozen=True):
    """One compared quantity of one element: its variables in the probe, and the times of the comparison."""

    quantity: Quantity
    element: str
    unit: str
    values: tuple[str, ...]
    instants: tuple[float, ...]
    """Times, in s."""
    part: Aspect = Aspect.BODIES
    detail: str = ""
    """See `Deviation.detail`."""
    least_tolerance: float = 0.0
    """The least relative difference that counts as agreement, where a compiler loses more digits than usual."""


class Trial(msgspec.Struct, frozen=True):
    """One simulation of an experiment."""

    name: str
    """In words, for messages: `free motion`."""
    probe: Probe
    compared: tuple[Compared, ...]
    """The compared quantities, from the root outwards."""
    expected: Mapping[str, tuple[float, ...]]
    """Expected numbers of each value at the times in `time`; NaN is possible."""
    over_time: tuple[Compared, ...] = ()
    """Quantities to draw over time, which are no part of the verdict."""
    expected_over_time: Mapping[str, tuple[float, ...]] = {}
    """Expected numbers of `over_time`, as in `expected`."""


class Experiment(msgspec.Struct, frozen=True):
    """A comparison of a generated package with an independent reference that reads the same source."""

    reference: str
    """Name and version."""
    content: bytes
    """The source to generate the package from: the given source, or a copy with the data that the comparison needs."""
    options: Any
    """The options for the generated package: the given ones, or simpler ones."""
    trials: tuple[Trial, ...]
    """Simulations of a package that is generated from `content`; they also run on a package from the given source.

    Without the result of the first simulation there is no comparison.
    """
    notes: tuple[str, ...] = ()
    """Differences of `content` from the given source, with reasons: one sentence each, without a full stop."""
    unchecked: tuple[str, ...] = ()
    """Parts that are not compared, with reasons: one sentence each, without a full stop."""
    companions: tuple[Companion, ...] = ()
    """The files that `content` is read with."""


class MissingReferenceError(UrdfsyncError):
    """No reference is installed on this machine."""


class Sample(msgspec.Struct, frozen=True):
    """A source, and all other inputs from which its package is generated."""

    content: bytes
    file: str
    """The source's name in diagnostics."""
    target: Target
    options: Any
    imports: Mapping[str, Import]
    texts: Mapping[str, bytes] = {}
    """The package on disk, by paths. Its edits may have other variables."""
    companions: tuple[Companion, ...] = ()
    """The files that the source is read with."""


class Checks(Protocol):
    """The functions that `check` needs of a domain; a domain's attribute `checks`."""

    def numbers(self, sample: Sample, snapshot: Snapshot, *packages: Mapping[str, bytes]) -> Sequence[Numbers]:
        """Compare the numbers in the texts of each package, and the snapshot, with another reading of the source.

        This may take a second. Raises SourceError if the other reader fails.
        """
        ...

    def models(self, snapshot: Snapshot, target: Target, options: Any) -> Sequence[str]:
        """Return the classes that have to compile by themselves, by name below the package, the main one first."""
        ...

    def freedoms(self, snapshot: Snapshot, options: Any) -> int | None:
        """Return the degrees of freedom of the main model; None if nothing in the package can be simulated."""
        ...

    def experiment(self, sample: Sample, step: float | None = None) -> Experiment | str:
        """Return a comparison of the generated package with an independent reference, or why there is none.

        Data that the comparison needs and the source lacks, such as inertias, are made up. With a `step`, in s,
        `Trial.over_time` has curves to draw. This function runs in a process of its own. Raises MissingReferenceError,
        and SourceError if the reference can't read the source.
        """
        ...
