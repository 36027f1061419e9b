"""The experiment of the URDF domain: a probe for a compiler, and the comparison of what it gives with Pinocchio."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import Deviation, Quantity, Target
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.tables import has_tables
from urdfsync.urdf.options import Options
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.physics import completion, motion
from urdfsync.urdf.physics.probe import FORCE, MASS, MOMENT, TORQUE, RobotVariables, probe, robot_variables
from urdfsync.urdf.physics.reading import Array, pinocchio, read
from urdfsync.urdf.physics.reference import Configuration, FrameMotion, Instant, Reference
from urdfsync.urdf.robot import MOTION_KINDS, Robot

Series: TypeAlias = Mapping[str, Sequence[float]]

_FIRST, _LAST = 0, -1
_SOLVER_ERROR = 1e-6  # relative difference between two simulations of free joints that a solver's steps may cause

_BENCHES = {
    ("package",): "Run and Test (they are only compiled)",
    ("record",): "the bench around the generic robot (it is only compiled)",
    ("package", "record"): "Run, Test and the generic robot with the record (they are only compiled)",
}
"""Per approach, the models around what is compared."""


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
        self.content, self.notes = completion.completed_for_pinocchio(content)
        if complete:
            self.content, made_up = completion.with_inertias(self.content, KinematicTree.of(robot))
            self.notes += made_up
        self._skeleton = KinematicTree.of(_robot(self.content, file), (target.name,))
        self._variables = robot_variables(self._skeleton, target, options)
        self._axes, self._free = motion.driven_axes(self._skeleton), motion.free_joints(self._skeleton)
        self._courses = [motion.axis_course(joint) for joint in self._axes]
        names = [[joint.name for joint in joints] for joints in (self._axes, self._free)]
        self._reference = Reference(read(self.content, file), *names)
        self._insoluble: Diagnostic | None = None
        ballast = self._needs_ballast(file)
        if complete and self._insoluble:
            raise SourceError(self._insoluble)
        self.probe = probe(self._skeleton, target, options, ballast)
        self.unchecked = tuple(_unchecked(self._skeleton, options))

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

    def compare(self, series: Series, baseline: Series | None = None) -> Sequence[Deviation]:
        """See `urdfsync.domain.Experiment`; the first and the last instant count."""
        greatest: dict[_Key, tuple[float, float]] = {}  # difference, and value of the reference
        with np.errstate(all="ignore"):  # where the simulation gave no number, the reference may have none
            for instant in (_FIRST, _LAST):
                found = Measured(series, self._skeleton, self._variables, instant)
                expected = self._expected(found, baseline, instant)
                tolerated = _SOLVER_ERROR if baseline is not None and self._free and instant == _LAST else 0.0
                for (key, one), (_, other) in zip(self._values(found), self._values(expected), strict=True):
                    difference, value = greatest.get(key, (0.0, 0.0))
                    new, size = _difference(one, other), _size(other)
                    new = 0.0 if new <= tolerated * max(1.0, size) else new
                    greatest[key] = max(difference, new), max(value, size)
        sizes: dict[tuple[Quantity, str], float] = {}
        for key, (_, value) in greatest.items():
            sizes[key.quantity, key.unit] = max(sizes.get((key.quantity, key.unit), 0.0), value)
        return [
            Deviation(key.quantity, key.element, difference, value, sizes[key.quantity, key.unit], key.unit)
            for key, (difference, value) in greatest.items()
        ]

    def _values(self, side: Measured | Instant) -> Iterator[tuple[_Key, Array]]:
        """All that is compared at one instant, from the root outwards."""
        for link in self._skeleton.links:
            frame = side.frame(link.name)
            yield _Key(Quantity.POSITION, f"link {link.name}", "m"), frame.place
            yield _Key(Quantity.ORIENTATION, f"link {link.name}", ""), frame.axes
        efforts = dict(zip((joint.name for joint in self._axes), side.efforts, strict=True))
        for joint in self._skeleton.joints:
            if joint.name in efforts:
                unit = "N·m" if MOTION_KINDS[joint.type] == "rotational" else "N"
                yield _Key(Quantity.EFFORT, f"joint {joint.name}", unit), efforts[joint.name]
        root = f"link {self._skeleton.links[0].name}"
        yield _Key(Quantity.REACTION, root, "N"), side.force
        yield _Key(Quantity.REACTION, root, "N·m"), side.torque
        for joint in self._free:
            linear, angular = side.acceleration(joint.child)
            yield _Key(Quantity.ACCELERATION, f"link {joint.child}", "m/s²"), linear
            yield _Key(Quantity.ACCELERATION, f"link {joint.child}", "rad/s²"), angular
        mass, centre = side.mass_and_centre()
        yield _Key(Quantity.MASS, "robot", "kg"), np.array(mass)
        yield _Key(Quantity.CENTRE, "robot", "m"), centre

    def _expected(self, found: Measured, baseline: Series | None, instant: int) -> Measured | Instant:
        """The baseline, or else the reference.

        For the reference, where free joints are later on follows from the simulation, whose solver is not tested.
        """
        if baseline is not None:
            return Measured(baseline, self._skeleton, self._variables, instant)
        if self._insoluble:
            raise SourceError(self._insoluble)
        if instant == _FIRST:
            return self._reference.solve(self._start(found.time))
        free = {joint.name: found.frame(joint.child) for joint in self._free}
        return self._reference.solve(self._reference.state(found.time, self._courses, free))

    def _start(self, time: float = 0.0) -> Configuration:
        """How the robot begins."""
        free = {joint.name: self._reference.start(joint.name, motion.free_start(joint)) for joint in self._free}
        return self._reference.state(time, self._courses, free)


class Measured:
    """The values of the probe at one instant, with the questions that `reference.Instant` answers.

    A value that is missing is NaN.
    """

    def __init__(self, series: Series, skeleton: KinematicTree, variables: RobotVariables, instant: int) -> None:
        self._series, self._variables, self._instant = series, variables, instant
        self.time = self._number("time")
        self.force, self.torque = -self._array(FORCE), -self._array(TORQUE)
        self.efforts = self._array(tuple(variables.efforts(skeleton).values()))

    def frame(self, link: str) -> FrameMotion:
        """How the frame of a link moves; its velocities are known only if a free joint carries it."""
        axes = self._array(self._variables.axes[link]).reshape(3, 3).T
        return FrameMotion(
            self._array(self._variables.places[link]), axes, self._of_body(link, "v_0"), self._of_body(link, "w_a")
        )

    def acceleration(self, link: str) -> tuple[Array, Array]:
        """Of a link that a free joint carries: linear, resolved in the world, and angular, resolved in its frame."""
        return self._of_body(link, "a_0"), self._of_body(link, "z_a")

    def mass_and_centre(self) -> tuple[float, Array]:
        """Mass of the whole robot and its centre in the world; zero without any mass."""
        (mass,), moment = self._array(MASS), self._array(MOMENT)
        return float(mass), moment / mass if mass else moment

    def _of_body(self, link: str, part: str) -> Array:
        known = link in self._variables.bodies
        return self._array(self._variables.of_body(link, part)) if known else np.full(3, math.nan)

    def _array(self, names: Sequence[str]) -> Array:
        return np.array([self._number(name) for name in names])

    def _number(self, name: str) -> float:
        series = self._series.get(name, ())
        return series[self._instant] if len(series) else math.nan


class _Key(NamedTuple):
    """What a deviation is of."""

    quantity: Quantity
    element: str
    unit: str


def _difference(found: Array, expected: Array) -> float:
    """The greatest; what is no number is infinitely far off."""
    difference = float(np.max(np.abs(found - expected)))
    return math.inf if math.isnan(difference) else difference


def _size(expected: Array) -> float:
    """The greatest absolute value; 0 if that is no number."""
    size = float(np.max(np.abs(expected)))
    return size if math.isfinite(size) else 0.0


def _robot(content: bytes, file: str) -> Robot:
    reading = read_robot(content, file, cross_check=False)
    if reading.robot is None:
        raise SourceError(*reading.diagnostics)
    return reading.robot


def _unchecked(skeleton: KinematicTree, options: Options) -> Iterator[str]:
    """What the comparison does not cover, as far as it matters for this robot: sentences without a full stop."""
    joints, links = skeleton.joints, skeleton.links
    if all(joint.type == "fixed" for joint in joints):
        yield "no joint moves, so that only poses, masses and the forces on the root link are compared"
    if not any(link.inertial and link.inertial.mass > 0 for link in links):
        yield "no link has a mass, so that efforts show the losses of joints only"
    without_effect = {
        "limits": any(joint.limit for joint in joints if joint.type in MOTION_KINDS),
        "calibrations": any(joint.calibration for joint in joints),
        "safety controllers": any(joint.safety_controller for joint in joints),
        "shapes": any(link.visuals or link.collisions for link in links),
    }
    parts = []
    if there := [noun for noun, is_there in without_effect.items() if is_there]:
        parts.append(f"{_listed(there)} (they change no motion)")
    touches = options.base == "floating" and options.collisions and "package" in options.approach
    if touches and any(link.collisions for link in links):
        parts.append("contacts with the ground (the robot moves high above it)")
    yield f"{_listed([*parts, _BENCHES[tuple(sorted(set(options.approach)))]])} are not compared"


def _listed(parts: Sequence[str]) -> str:
    """`a`, `a and b`, `a, b and c`."""
    *most, last = parts
    return f"{', '.join(most)}{' and ' if most else ''}{last}"
