"""The experiment of the URDF domain: a probe for a compiler, and the comparison of what it gives with Pinocchio."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import Deviation, Quantity, Target
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.tables import has_tables
from urdfsync.urdf.options import Options
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.physics import completion, motion
from urdfsync.urdf.physics.free_joints import Array, free_joints, free_start
from urdfsync.urdf.physics.probe import FORCE, MASS, MOMENT, TORQUE, probe, robot_variables
from urdfsync.urdf.physics.reading import pinocchio, read
from urdfsync.urdf.physics.reference import Configuration, FrameMotion, Instant, Reference
from urdfsync.urdf.robot import MOTION_KINDS, Robot

Series: TypeAlias = Mapping[str, Sequence[float]]
Values: TypeAlias = Mapping[str, float]
"""By the names of the probe's variables, at one instant."""

_FIRST, _LAST = 0, -1
_CENTRE = ("centre[1]", "centre[2]", "centre[3]")  # of mass in the world; no variable of the probe, but made from two
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
    also if free joints carry so little inertia that there is no reference.
    """

    def __init__(self, content: bytes, file: str, target: Target, options: Options, complete: bool) -> None:
        self.reference = f"Pinocchio {pinocchio().__version__}"
        robot = _robot(content, file)
        self.content, self.notes = completion.completed_for_pinocchio(content)
        if complete:
            self.content, made_up = completion.with_inertias(self.content, KinematicTree.of(robot))
            self.notes += made_up
        self._tree = KinematicTree.of(_robot(self.content, file), (target.name,))
        self._variables = robot_variables(self._tree, target, options)
        self._axes, self._free = motion.driven_axes(self._tree), free_joints(self._tree)
        self._courses = [motion.axis_course(joint) for joint in self._axes]
        parts = [[joint.name for joint in joints] for joints in (self._axes, self._free)]
        self._reference = Reference(read(self.content, file), *parts)
        if complete and self._reference.is_singular(self._start(0.0)):
            names = ", ".join(f"'{joint.name}'" for joint in self._free)
            message = f"no simulation can tell how {names} move: what they carry has no inertia"
            hint = "give each link that moves freely a mass and an inertia"
            raise SourceError(Diagnostic(Severity.ERROR, "free-without-inertia", message, file, hint=hint))
        self.probe = probe(self._tree, target, options)
        benches = _BENCHES[tuple(sorted(set(options.approach)))]
        self.unchecked: tuple[str, ...] = (
            f"limits, shapes and contacts (they change no motion) and {benches} are not compared",
        )

    def compare(self, series: Series, baseline: Series | None = None) -> Sequence[Deviation]:
        """See `urdfsync.domain.Experiment`; the first and the last instant count."""
        greatest: dict[_Key, tuple[float, float]] = {}  # difference, and value of the reference
        sizes: dict[tuple[Quantity, str], float] = {}
        with np.errstate(all="ignore"):  # where the simulation gave no number, the reference may have none
            for instant in (_FIRST, _LAST):
                found = _at(series, instant)
                base = None if baseline is None else _at(baseline, instant)
                solved = self._solve(found, instant) if base is None else None
                tolerated = _SOLVER_ERROR if base is not None and self._free and instant == _LAST else 0.0
                for key, names, values in self._compared(solved):
                    expected = _vector(base, names) if base is not None else np.asarray(values)
                    new, size = float(np.max(np.abs(_vector(found, names) - expected))), float(np.max(np.abs(expected)))
                    new, size = math.inf if math.isnan(new) else new, size if math.isfinite(size) else 0.0
                    difference, value = greatest.get(key, (0.0, 0.0))
                    greatest[key] = max(difference, 0.0 if new <= tolerated * max(1.0, size) else new), max(value, size)
                    sizes[key.quantity, key.unit] = max(sizes.get((key.quantity, key.unit), 0.0), size)
        return [
            Deviation(key.quantity, key.element, difference, value, sizes[key.quantity, key.unit], key.unit)
            for key, (difference, value) in greatest.items()
        ]

    def _compared(self, solved: Instant | None) -> Iterator[tuple[_Key, Sequence[str], Any]]:
        """All that is compared, from the root outwards: the variables that tell it, and what the reference says."""
        names, tree = self._variables, self._tree
        for link in tree.links:
            frame = solved and solved.frame(link.name)
            yield _Key(Quantity.POSITION, f"link {link.name}", "m"), names.places[link.name], frame and frame.place
            axes = frame and frame.axes.T.ravel()
            yield _Key(Quantity.ORIENTATION, f"link {link.name}", ""), names.axes[link.name], axes
        efforts, columns = names.efforts(tree), {joint.name: k for k, joint in enumerate(self._axes)}
        for joint in tree.joints:
            if joint.name in efforts:
                unit = "N·m" if MOTION_KINDS[joint.type] == "rotational" else "N"
                effort = solved and [solved.efforts[columns[joint.name]]]
                yield _Key(Quantity.EFFORT, f"joint {joint.name}", unit), (efforts[joint.name],), effort
        root = f"link {tree.links[0].name}"
        yield _Key(Quantity.REACTION, root, "N"), FORCE, solved and -solved.force
        yield _Key(Quantity.REACTION, root, "N·m"), TORQUE, solved and -solved.torque
        for joint in self._free:
            accelerations = solved.acceleration(joint.child) if solved else (None, None)
            for part, unit, values in zip(("a_0", "z_a"), ("m/s²", "rad/s²"), accelerations, strict=True):
                yield _Key(Quantity.ACCELERATION, f"link {joint.child}", unit), names.of_body(joint.child, part), values
        mass, centre = solved.mass_and_centre() if solved else (0.0, None)
        yield _Key(Quantity.MASS, "robot", "kg"), MASS, [mass]
        yield _Key(Quantity.CENTRE, "robot", "m"), _CENTRE, centre

    def _solve(self, found: Values, instant: int) -> Instant:
        """What the reference says. Where free joints are later on follows from the simulation, which is not tested."""
        names, time = self._variables, found["time"]
        if instant == _FIRST:
            return self._reference.solve(self._start(time))
        free = {}
        for joint in self._free:
            link = joint.child
            axes = _vector(found, names.axes[link]).reshape(3, 3).T
            moves = (_vector(found, names.of_body(link, part)) for part in ("v_0", "w_a"))
            free[joint.name] = FrameMotion(_vector(found, names.places[link]), axes, *moves)
        return self._reference.solve(self._reference.state(time, self._courses, free))

    def _start(self, time: float) -> Configuration:
        """How the robot begins."""
        free = {joint.name: self._reference.start(joint.name, free_start(joint)) for joint in self._free}
        return self._reference.state(time, self._courses, free)


class _Key(NamedTuple):
    """What a deviation is of."""

    quantity: Quantity
    element: str
    unit: str


def _at(series: Series, instant: int) -> Values:
    """The values of a simulation at one instant, with the centre of mass; one that is missing is NaN."""
    values = {name: numbers[instant] for name, numbers in series.items() if len(numbers)}
    (mass,), moment = _vector(values, MASS), _vector(values, MOMENT)
    centre = moment / mass if mass else moment
    return {"time": math.nan, **values, **dict(zip(_CENTRE, map(float, centre), strict=True))}


def _vector(values: Values, names: Sequence[str]) -> Array:
    return np.array([values.get(name, math.nan) for name in names])


def _robot(content: bytes, file: str) -> Robot:
    reading = read_robot(content, file, cross_check=False)
    if reading.robot is None:
        raise SourceError(*reading.diagnostics)
    return reading.robot
