"""The experiment of the URDF domain: a probe for a compiler, and the comparison of what it gives with Pinocchio."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import Deviation, Quantity, Target
from urdfsync.urdf.options import Options
from urdfsync.urdf.physics import amended, motion, probe
from urdfsync.urdf.physics.coverage import unchecked
from urdfsync.urdf.physics.reading import Array, pinocchio, read
from urdfsync.urdf.physics.reference import Frame, Instant, Reference, State
from urdfsync.urdf.robot import Robot
from urdfsync.urdf.skeleton import MOTIONS, Skeleton
from urdfsync.urdf.source import read_robot

_FIRST, _LAST = 0, -1


class _Key(NamedTuple):
    """What a deviation is of."""

    quantity: Quantity
    element: str
    unit: str


class _Pair(NamedTuple):
    """One comparison at one instant."""

    key: _Key
    found: Array
    expected: Array


class PinocchioExperiment:
    """A package that moves as `motion` says, against the same robot in Pinocchio. See `urdfsync.domain.Experiment`.

    Raises SourceError if the source has errors, or if Pinocchio is not installed or can't read it.
    """

    def __init__(self, content: bytes, file: str, target: Target, options: Options, complete: bool) -> None:
        self.reference = f"Pinocchio {pinocchio().__version__}"
        robot = _robot(content, file)
        self.content, self.notes = amended.readable(content)
        if complete:
            self.content, made_up = amended.with_inertias(self.content, Skeleton.of(robot))
            self.notes += made_up
        robot = _robot(self.content, file)
        self._skeleton = Skeleton.of(robot, (target.name,))
        self._axes, self._free = motion.driven_axes(self._skeleton), motion.free_joints(self._skeleton)
        self._courses = [motion.axis_course(joint) for joint in self._axes]
        names = [[joint.name for joint in joints] for joints in (self._axes, self._free)]
        self._reference = Reference(read(self.content, file), *names)
        self.probe = probe.probe(self._skeleton, target, options, ballast=self._needs_ballast(file))
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
            raise SourceError(Diagnostic(Severity.ERROR, "free-without-inertia", message, file, hint=hint))
        weight = f"{motion.BALLAST_MASS} kg hang on each link without children"
        self.notes += (f"{weight}, because {names} would move without any inertia",)
        return True

    def compare(self, series: Mapping[str, Sequence[float]]) -> Sequence[Deviation]:
        """See `urdfsync.domain.Experiment`; the first and the last instant count."""
        values = _Values(series, self._skeleton)
        with np.errstate(all="ignore"):  # where the simulation gave no number, the reference may have none
            pairs = [pair for instant in (_FIRST, _LAST) for pair in self._pairs(values, instant)]
            return list(_deviations(pairs))

    def _pairs(self, values: _Values, instant: int) -> Iterator[_Pair]:
        """All comparisons at one instant."""
        now = self._expected(values, instant)
        for link in self._skeleton.links:
            found, expected, element = values.pose(link.name, instant), now.frame(link.name), f"link {link.name}"
            yield _Pair(_Key(Quantity.POSITION, element, "m"), found[0], expected.place)
            yield _Pair(_Key(Quantity.ORIENTATION, element, ""), found[1], expected.axes)
        efforts = values.array(probe.effort_names(self._skeleton), instant)
        for joint, effort, expected_effort in zip(self._axes, efforts, now.efforts, strict=True):
            unit = "N·m" if MOTIONS[joint.type] == "rotational" else "N"
            yield _Pair(_Key(Quantity.EFFORT, f"joint {joint.name}", unit), effort, expected_effort)
        root = f"link {self._skeleton.links[0].name}"
        yield _Pair(_Key(Quantity.EFFORT, root, "N"), -values.array(probe.FORCE, instant), now.force)
        yield _Pair(_Key(Quantity.EFFORT, root, "N·m"), -values.array(probe.TORQUE, instant), now.torque)
        for joint in self._free:
            linear, angular = now.acceleration(joint.child)
            for unit, part, expected_part in (("m/s²", probe.ACCELERATION, linear), ("rad/s²", probe.ANGULAR, angular)):
                found_part = values.vector(joint.child, part, instant)
                yield _Pair(_Key(Quantity.ACCELERATION, f"link {joint.child}", unit), found_part, expected_part)
        (mass,), moment = values.array(probe.MASS, instant), values.array(probe.MOMENT, instant)
        expected_mass, centre = now.mass_and_centre()
        yield _Pair(_Key(Quantity.MASS, "robot", "kg"), mass, np.array(expected_mass))
        yield _Pair(_Key(Quantity.CENTRE, "robot", "m"), moment / mass if mass else moment, centre)

    def _expected(self, values: _Values, instant: int) -> Instant:
        """The reference; where free joints are later on follows from the simulation, whose solver is not tested."""
        time = values.number("time", instant)
        if instant == _FIRST:
            return self._reference.solve(self._start(time))
        free = {joint.name: values.frame(joint.child, instant) for joint in self._free}
        return self._reference.solve(self._reference.state(time, self._courses, free))

    def _start(self, time: float = 0.0) -> State:
        """How the robot begins."""
        free = {joint.name: self._reference.start(joint.name, motion.free_start(joint)) for joint in self._free}
        return self._reference.state(time, self._courses, free)


class _Values:
    """Series of a simulation; a value that is missing is NaN."""

    def __init__(self, series: Mapping[str, Sequence[float]], skeleton: Skeleton) -> None:
        self._series, self._skeleton = series, skeleton

    def number(self, name: str, instant: int) -> float:
        """One value."""
        series = self._series.get(name, ())
        return series[instant] if len(series) else math.nan

    def array(self, names: Sequence[str], instant: int) -> Array:
        """Several values."""
        return np.array([self.number(name, instant) for name in names])

    def vector(self, link: str, part: str, instant: int) -> Array:
        """A vector of a link."""
        return self.array(probe.names(self._skeleton, link, part), instant)

    def pose(self, link: str, instant: int) -> tuple[Array, Array]:
        """Place of a link's frame in the world, and its axes as columns."""
        axes = self.array(probe.axes_names(self._skeleton, link), instant)
        return self.vector(link, probe.PLACE, instant), axes.reshape(3, 3).T

    def frame(self, link: str, instant: int) -> Frame:
        """The frame of a link that a free joint carries."""
        moves = (self.vector(link, part, instant) for part in (probe.VELOCITY, probe.ROTATION))
        return Frame(*self.pose(link, instant), *moves)


def _robot(content: bytes, file: str) -> Robot:
    reading = read_robot(content, file, cross_check=False)
    if reading.robot is None:
        raise SourceError(*reading.diagnostics)
    return reading.robot


def _deviations(pairs: Sequence[_Pair]) -> Iterator[Deviation]:
    """The greatest difference per element, and the greatest values; what is no number is infinitely far off."""
    differences: defaultdict[_Key, float] = defaultdict(float)
    values: defaultdict[_Key, float] = defaultdict(float)
    sizes: defaultdict[Quantity, float] = defaultdict(float)
    for key, found, expected in pairs:
        difference, value = float(np.max(np.abs(found - expected))), float(np.max(np.abs(expected)))
        differences[key] = max(differences[key], math.inf if math.isnan(difference) else difference)
        values[key] = max(values[key], 0.0 if math.isnan(value) else value)
        sizes[key.quantity] = max(sizes[key.quantity], values[key])
    for key, difference in differences.items():
        yield Deviation(key.quantity, key.element, difference, values[key], sizes[key.quantity], key.unit)
