"""The experiment of the URDF domain: a probe for a compiler, and the comparison of what it gives with Pinocchio."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

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
from urdfsync.urdf.physics.reference import Reference
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


class _Compared(NamedTuple):
    """What a deviation is of, and the variables that tell it."""

    quantity: Quantity
    element: str
    unit: str
    variables: Sequence[str]


def experiment(
    content: bytes, file: str, target: Target, options: Options, complete: bool
) -> PinocchioExperiment | None:
    """Return the experiment for a package; None if it holds no model of the robot. Raises as the class does."""
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
        tree = KinematicTree.of(_robot(self.content, file), (target.name,))
        self._variables = robot_variables(tree, target, options)
        self._compared = _compared(tree, self._variables)
        axes = motion.driven_axes(tree)
        self._courses = [motion.axis_course(joint) for joint in axes]
        self._starts = {joint.name: motion.free_start(joint) for joint in motion.free_joints(tree)}
        self._reference = Reference(read(self.content, file), [joint.name for joint in axes], list(self._starts))
        if complete and self._reference.is_singular(self._reference.state(0.0, self._courses, self._starts)):
            message = f"no simulation can tell how {', '.join(map(repr, self._starts))} move: "
            message += "what they carry has no inertia"
            hint = "give each link that moves freely a mass and an inertia"
            raise SourceError(Diagnostic(Severity.ERROR, "free-without-inertia", message, file, hint=hint))
        self.probe = probe(tree, target, options)
        benches = _BENCHES[tuple(sorted(set(options.approach)))]
        self.unchecked: tuple[str, ...] = (
            f"limits, shapes and contacts (they change no motion) and {benches} are not compared",
        )

    def compare(self, series: Series, baseline: Series | None = None) -> Sequence[Deviation]:
        """See `urdfsync.domain.Experiment`; the first and the last instant count.

        Where free joints are at the last one is up to a solver: the reference knows them at the first one only.
        """
        instants = (_FIRST,) if baseline is None and self._starts else (_FIRST, _LAST)
        greatest = dict.fromkeys(self._compared, (0.0, 0.0))  # difference, and value that it is held against
        sizes: dict[tuple[Quantity, str], float] = {}
        with np.errstate(all="ignore"):  # where the simulation gave no time, the reference has no numbers
            for instant in instants:
                found = _at(series, instant)
                expected = self.values(found["time"]) if baseline is None else _at(baseline, instant)
                tolerated = _SOLVER_ERROR if self._starts and instant == _LAST else 0.0
                for one, (difference, value) in greatest.items():
                    wanted = _vector(expected, one.variables)
                    new, size = np.max(np.abs(_vector(found, one.variables) - wanted)), np.max(np.abs(wanted))
                    new, size = math.inf if math.isnan(new) else float(new), float(size) if math.isfinite(size) else 0.0
                    greatest[one] = max(difference, 0.0 if new <= tolerated * max(1.0, size) else new), max(value, size)
                    sizes[one.quantity, one.unit] = max(sizes.get((one.quantity, one.unit), 0.0), size)
        return [
            Deviation(one.quantity, one.element, difference, value, sizes[one.quantity, one.unit], one.unit)
            for one, (difference, value) in greatest.items()
        ]

    def values(self, time: float) -> Values:
        """Return what a simulation would give if it were Pinocchio's."""
        names = self._variables
        instant = self._reference.solve(self._reference.state(time, self._courses, self._starts))
        mass, moment = instant.mass_and_moment()
        told: list[tuple[Sequence[str], Any]] = [
            (tuple(names.efforts.values()), instant.efforts),
            (FORCE, -instant.force),
            (TORQUE, -instant.torque),
            (MASS, [mass]),
            (MOMENT, moment),
            (_CENTRE, moment / mass if mass else moment),
        ]
        for link in names.places:
            place, axes = instant.frame(link)
            told += [(names.places[link], place), (names.axes[link], axes.T.ravel())]
        for link, parts in names.accelerations.items():
            told += zip(parts, instant.acceleration(link), strict=True)
        return {name: float(value) for row, values in told for name, value in zip(row, values, strict=True)}


def _compared(tree: KinematicTree, names: RobotVariables) -> list[_Compared]:
    """Return all that is compared, from the root outwards."""
    found = []
    for link, places in names.places.items():
        found.append(_Compared(Quantity.POSITION, f"link {link}", "m", places))
        found.append(_Compared(Quantity.ORIENTATION, f"link {link}", "", names.axes[link]))
    for joint in tree.joints:
        if joint.name in names.efforts:
            unit = "N·m" if MOTION_KINDS[joint.type] == "rotational" else "N"
            found.append(_Compared(Quantity.EFFORT, f"joint {joint.name}", unit, (names.efforts[joint.name],)))
    root = f"link {tree.links[0].name}"
    found += [_Compared(Quantity.REACTION, root, "N", FORCE), _Compared(Quantity.REACTION, root, "N·m", TORQUE)]
    for link, (linear, angular) in names.accelerations.items():
        found.append(_Compared(Quantity.ACCELERATION, f"link {link}", "m/s²", linear))
        found.append(_Compared(Quantity.ACCELERATION, f"link {link}", "rad/s²", angular))
    return [*found, _Compared(Quantity.MASS, "robot", "kg", MASS), _Compared(Quantity.CENTRE, "robot", "m", _CENTRE)]


def _at(series: Series, instant: int) -> Values:
    """Return the values of a simulation at one instant, with the centre of mass; one that is missing is NaN."""
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
