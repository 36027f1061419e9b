"""The experiment of the URDF domain: a probe for a compiler, and the comparison of what it gives with Pinocchio."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple, Protocol

import numpy as np

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import Deviation, Quantity, Target
from urdfsync.urdf.kinematics.tree import MOTION_KINDS, KinematicTree
from urdfsync.urdf.model.tables import has_tables
from urdfsync.urdf.options import Options
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.physics import amended, motion, probe
from urdfsync.urdf.physics.coverage import unchecked
from urdfsync.urdf.physics.measured import Measured
from urdfsync.urdf.physics.reading import Array, pinocchio, read
from urdfsync.urdf.physics.reference import Frame, Reference, State
from urdfsync.urdf.physics.variables import variables
from urdfsync.urdf.robot import Robot

_FIRST, _LAST = 0, -1
_SOLVER = 1e-6
"""Relative difference between two simulations of free joints that the steps of a solver may account for."""


class _Key(NamedTuple):
    """What a deviation is of."""

    quantity: Quantity
    element: str
    unit: str


class _Value(NamedTuple):
    """What one side says at one instant."""

    key: _Key
    value: Array


class _Pair(NamedTuple):
    """One comparison at one instant."""

    found: _Value
    expected: _Value
    blur: float
    """Relative differences up to it say nothing."""

    @property
    def difference(self) -> float:
        """The greatest; what is no number is infinitely far off."""
        difference = float(np.max(np.abs(self.found.value - self.expected.value)))
        if math.isnan(difference):
            return math.inf
        return 0.0 if difference <= self.blur * max(1.0, self.size) else difference

    @property
    def size(self) -> float:
        """The greatest value that is expected; 0 if that is no number."""
        size = float(np.max(np.abs(self.expected.value)))
        return size if math.isfinite(size) else 0.0


class _Side(Protocol):
    """One of the two robots that are compared, at one instant."""

    @property
    def force(self) -> Array: ...
    @property
    def torque(self) -> Array: ...
    @property
    def efforts(self) -> Array: ...

    def frame(self, link: str) -> Frame: ...
    def acceleration(self, link: str) -> tuple[Array, Array]: ...
    def mass_and_centre(self) -> tuple[float, Array]: ...


def experiment(
    content: bytes, file: str, target: Target, options: Options, complete: bool
) -> PinocchioExperiment | None:
    """The experiment for a package; None if it holds no model of the robot. Raises as `PinocchioExperiment` does."""
    if "package" not in options.approach and not has_tables(_robot(content, file).joints):
        return None
    return PinocchioExperiment(content, file, target, options, complete)


class PinocchioExperiment:
    """A package that moves as `motion` says, against the same robot in Pinocchio. See `urdfsync.domain.Experiment`.

    Raises SourceError if the source has errors, or if Pinocchio is not installed or can't read it; with `complete`
    also if free joints carry so little inertia that there is no reference, else `compare` without a baseline does.
    """

    def __init__(self, content: bytes, file: str, target: Target, options: Options, complete: bool) -> None:
        self.reference = f"Pinocchio {pinocchio().__version__}"
        robot = _robot(content, file)
        self.content, self.notes = amended.readable(content)
        if complete:
            self.content, made_up = amended.with_inertias(self.content, KinematicTree.of(robot))
            self.notes += made_up
        robot = _robot(self.content, file)
        self._skeleton = KinematicTree.of(robot, (target.name,))
        self._names = variables(self._skeleton, target, options)
        self._axes, self._free = motion.driven_axes(self._skeleton), motion.free_joints(self._skeleton)
        self._courses = [motion.axis_course(joint) for joint in self._axes]
        names = [[joint.name for joint in joints] for joints in (self._axes, self._free)]
        self._reference = Reference(read(self.content, file), *names)
        self._insoluble: Diagnostic | None = None
        ballast = self._needs_ballast(file)
        if complete and self._insoluble:
            raise SourceError(self._insoluble)
        self.probe = probe.probe(self._skeleton, target, options, ballast)
        self.unchecked = tuple(unchecked(self._skeleton, options))

    def _needs_ballast(self, file: str) -> bool:
        """Whether free joints move no inertia: then bodies hang on the robot, and a note says so."""
        if not self._reference.is_singular(self._start()):
            return False
        self._reference.hang_ballast(link.name for link in self._skeleton.leaves())
        names = ", ".join(f"'{joint.name}'" for joint in self._free)
        if self._reference.is_singular(self._start()):
            message = f"no simulation can tell how {names} move: what they carry has no inertia"
            hint = "give each link that moves freely a mass and an inertia"
            self._insoluble = Diagnostic(Severity.ERROR, "free-without-inertia", message, file, hint=hint)
        weight = f"{motion.BALLAST_MASS} kg hang on each link without children"
        self.notes += (f"{weight}, because {names} would move without any inertia",)
        return True

    def compare(
        self, series: Mapping[str, Sequence[float]], baseline: Mapping[str, Sequence[float]] | None = None
    ) -> Sequence[Deviation]:
        """See `urdfsync.domain.Experiment`; the first and the last instant count."""
        pairs: list[_Pair] = []
        with np.errstate(all="ignore"):  # where the simulation gave no number, the reference may have none
            for instant in (_FIRST, _LAST):
                found = Measured(series, self._skeleton, self._names, instant)
                expected = self._expected(found, baseline, instant)
                blur = _SOLVER if baseline is not None and self._free and instant == _LAST else 0.0
                both = zip(self._quantities(found), self._quantities(expected), strict=True)
                pairs += (_Pair(*values, blur) for values in both)
            return list(_deviations(pairs))

    def _quantities(self, side: _Side) -> Iterator[_Value]:
        """All that is compared at one instant, from the root outwards."""
        for link in self._skeleton.links:
            frame = side.frame(link.name)
            yield _Value(_Key(Quantity.POSITION, f"link {link.name}", "m"), frame.place)
            yield _Value(_Key(Quantity.ORIENTATION, f"link {link.name}", ""), frame.axes)
        efforts = dict(zip((joint.name for joint in self._axes), side.efforts, strict=True))
        for joint in self._skeleton.joints:
            if joint.name in efforts:
                unit = "N·m" if MOTION_KINDS[joint.type] == "rotational" else "N"
                yield _Value(_Key(Quantity.EFFORT, f"joint {joint.name}", unit), efforts[joint.name])
        root = f"link {self._skeleton.links[0].name}"
        yield _Value(_Key(Quantity.REACTION, root, "N"), side.force)
        yield _Value(_Key(Quantity.REACTION, root, "N·m"), side.torque)
        for joint in self._free:
            linear, angular = side.acceleration(joint.child)
            yield _Value(_Key(Quantity.ACCELERATION, f"link {joint.child}", "m/s²"), linear)
            yield _Value(_Key(Quantity.ACCELERATION, f"link {joint.child}", "rad/s²"), angular)
        mass, centre = side.mass_and_centre()
        yield _Value(_Key(Quantity.MASS, "robot", "kg"), np.array(mass))
        yield _Value(_Key(Quantity.CENTRE, "robot", "m"), centre)

    def _expected(self, found: Measured, baseline: Mapping[str, Sequence[float]] | None, instant: int) -> _Side:
        """The baseline, or else the reference.

        For the reference, where free joints are later on follows from the simulation, whose solver is not tested.
        """
        if baseline is not None:
            return Measured(baseline, self._skeleton, self._names, instant)
        if self._insoluble:
            raise SourceError(self._insoluble)
        if instant == _FIRST:
            return self._reference.solve(self._start(found.time))
        free = {joint.name: found.frame(joint.child) for joint in self._free}
        return self._reference.solve(self._reference.state(found.time, self._courses, free))

    def _start(self, time: float = 0.0) -> State:
        """How the robot begins."""
        free = {joint.name: self._reference.start(joint.name, motion.free_start(joint)) for joint in self._free}
        return self._reference.state(time, self._courses, free)


def _robot(content: bytes, file: str) -> Robot:
    reading = read_robot(content, file, cross_check=False)
    if reading.robot is None:
        raise SourceError(*reading.diagnostics)
    return reading.robot


def _deviations(pairs: Sequence[_Pair]) -> Iterator[Deviation]:
    """The greatest difference per element, and the greatest values."""
    differences: defaultdict[_Key, float] = defaultdict(float)
    values: defaultdict[_Key, float] = defaultdict(float)
    sizes: defaultdict[tuple[Quantity, str], float] = defaultdict(float)
    for pair in pairs:
        key = pair.found.key
        differences[key] = max(differences[key], pair.difference)
        values[key] = max(values[key], pair.size)
        sizes[key.quantity, key.unit] = max(sizes[key.quantity, key.unit], values[key])
    for key, difference in differences.items():
        yield Deviation(key.quantity, key.element, difference, values[key], sizes[key.quantity, key.unit], key.unit)
