"""The experiment of the URDF domain: a probe for a compiler, and the comparison of what it gives with Pinocchio."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias

import msgspec
import numpy as np

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import Deviation, Quantity, Target
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.tables import obstacles
from urdfsync.urdf.options import Options
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.physics import completion, motion
from urdfsync.urdf.physics.probe import FORCE, MASS, MOMENT, TORQUE, probe, robot_variables
from urdfsync.urdf.physics.reading import Array, pinocchio, read
from urdfsync.urdf.physics.reference import Configuration, FrameMotion, Reference
from urdfsync.urdf.robot import MOTION_KINDS, Robot

Series: TypeAlias = Mapping[str, Sequence[float]]
Values: TypeAlias = Mapping[str, float]
"""By the names of the probe's variables, at one instant."""

_FIRST, _LAST = 0, -1
_CENTRE = ("centre[1]", "centre[2]", "centre[3]")  # of mass in the world; no variable of the probe, but made from two
_SOLVER_ERROR = 1e-6  # relative difference between two simulations of free joints that a solver's steps may cause


def experiment(
    content: bytes, file: str, target: Target, options: Options, complete: bool
) -> PinocchioExperiment | None:
    """The experiment for a package; None if it holds no model of the robot. Raises as `PinocchioExperiment` does."""
    if "package" not in options.approach and obstacles(_robot(content, file).joints):
        return None
    return PinocchioExperiment(content, file, target, options, complete)


class PinocchioExperiment:
    """A package that moves as `motion` says, against the same robot in Pinocchio. See `urdfsync.domain.Experiment`.

    Raises SourceError if the source has errors, or if Pinocchio is not installed or can't read it; with `complete`
    also if free joints carry so little inertia that there is no reference.
    """

    unchecked: tuple[str, ...] = (
        "limits, shapes and contacts (they change no motion) and models around the robot (they are only compiled) "
        "are not compared",
    )

    def __init__(self, content: bytes, file: str, target: Target, options: Options, complete: bool) -> None:
        self.reference = f"Pinocchio {pinocchio().__version__}"
        robot = _robot(content, file)
        self.content, self.notes = completion.completed_for_pinocchio(content)
        if complete:
            self.content, made_up = completion.with_inertias(self.content, KinematicTree.of(robot))
            self.notes += made_up
        self._tree = KinematicTree.of(_robot(self.content, file), (target.name,))
        self._variables = robot_variables(self._tree, target, options)
        self._axes, self._free = motion.driven_axes(self._tree), motion.free_joints(self._tree)
        self._courses = [motion.axis_course(joint) for joint in self._axes]
        parts = [[joint.name for joint in joints] for joints in (self._axes, self._free)]
        self._reference = Reference(read(self.content, file), *parts)
        if complete and self._reference.is_singular(self._start(0.0)):
            names = ", ".join(f"'{joint.name}'" for joint in self._free)
            message = f"no simulation can tell how {names} move: what they carry has no inertia"
            hint = "give each link that moves freely a mass and an inertia"
            raise SourceError(Diagnostic(Severity.ERROR, "free-without-inertia", message, file, hint=hint))
        self.probe = probe(self._tree, target, options)

    @np.errstate(all="ignore")  # where the simulation gave no number, the reference may have none
    def compare(self, series: Series, baseline: Series | None = None) -> Sequence[Deviation]:
        """See `urdfsync.domain.Experiment`; the first and the last instant count."""
        pairs = []  # per instant: what was found, what was expected, and by how much they may differ
        for instant in (_FIRST, _LAST):
            found = _at(series, instant)
            expected = self._expected(found, instant) if baseline is None else _at(baseline, instant)
            free_later = baseline is not None and self._free and instant == _LAST
            pairs.append((found, expected, _SOLVER_ERROR if free_later else 0.0))
        deviations = []
        for quantity, element, unit, names in self._compared():
            greatest, value = 0.0, 0.0
            for found, expected, tolerated in pairs:
                reference = _vector(expected, names)
                difference = float(np.max(np.abs(_vector(found, names) - reference)))
                size = float(np.max(np.abs(reference)))
                size = size if math.isfinite(size) else 0.0
                if not difference <= tolerated * max(1.0, size):
                    greatest = math.inf if math.isnan(difference) else max(greatest, difference)
                value = max(value, size)
            deviations.append(Deviation(quantity, element, greatest, value, 0.0, unit))
        sizes: dict[tuple[Quantity, str], float] = {}
        for deviation in deviations:
            kind = deviation.quantity, deviation.unit
            sizes[kind] = max(sizes.get(kind, 0.0), deviation.value)
        return [msgspec.structs.replace(one, size=sizes[one.quantity, one.unit]) for one in deviations]

    def _compared(self) -> Iterator[tuple[Quantity, str, str, Sequence[str]]]:
        """Yield all that is compared, from the root outwards: of which element, its unit, and its variables."""
        names, tree = self._variables, self._tree
        for link in tree.links:
            yield Quantity.POSITION, f"link {link.name}", "m", names.places[link.name]
            yield Quantity.ORIENTATION, f"link {link.name}", "", names.axes[link.name]
        efforts = names.efforts(tree)
        for joint in tree.joints:
            if joint.name in efforts:
                unit = "N·m" if MOTION_KINDS[joint.type] == "rotational" else "N"
                yield Quantity.EFFORT, f"joint {joint.name}", unit, (efforts[joint.name],)
        yield Quantity.REACTION, f"link {tree.links[0].name}", "N", FORCE
        yield Quantity.REACTION, f"link {tree.links[0].name}", "N·m", TORQUE
        for joint in self._free:
            for part, unit in (("a_0", "m/s²"), ("z_a", "rad/s²")):
                yield Quantity.ACCELERATION, f"link {joint.child}", unit, names.of_body(joint.child, part)
        yield Quantity.MASS, "robot", "kg", MASS
        yield Quantity.CENTRE, "robot", "m", _CENTRE

    def _expected(self, found: Values, instant: int) -> Values:
        """Return what the reference says, by the names of the variables.

        Where free joints are later on follows from the simulation, whose way there is not tested.
        """
        names, values = self._variables, dict[str, float]()
        if instant == _FIRST:
            state = self._start(found["time"])
        else:
            free = {}
            for joint in self._free:
                place = _vector(found, names.places[joint.child])
                axes = _vector(found, names.axes[joint.child]).reshape(3, 3).T
                velocity, turning = (_vector(found, names.of_body(joint.child, part)) for part in ("v_0", "w_a"))
                free[joint.name] = FrameMotion(place, axes, velocity, axes @ turning)
            state = self._reference.state(found["time"], self._courses, free, in_world=True)
        solved = self._reference.solve(state)

        def tell(variables: Iterable[str], numbers: Iterable[float]) -> None:
            values.update(zip(variables, map(float, numbers), strict=True))

        for link in self._tree.links:
            frame = solved.frame(link.name)
            tell(names.places[link.name], frame.place)
            tell(names.axes[link.name], frame.axes.T.ravel())
        for joint in self._free:
            linear, angular = solved.acceleration(joint.child)
            tell(names.of_body(joint.child, "a_0"), linear)
            tell(names.of_body(joint.child, "z_a"), angular)
        mass, centre = solved.mass_and_centre()
        tell(names.efforts(self._tree).values(), solved.efforts)
        tell((*FORCE, *TORQUE), (*-solved.force, *-solved.torque))
        tell((*MASS, *_CENTRE), (mass, *centre))
        return values

    def _start(self, time: float) -> Configuration:
        """Return how the robot begins."""
        free = {joint.name: self._reference.start(joint.name, motion.free_start(joint)) for joint in self._free}
        return self._reference.state(time, self._courses, free)


def _at(series: Series, instant: int) -> Values:
    """The values of a simulation at one instant, with the centre of mass; one that is missing is NaN."""
    values = {name: numbers[instant] for name, numbers in series.items() if len(numbers)}
    (mass,), moment = _vector(values, MASS), _vector(values, MOMENT)
    centre = moment / mass if mass else moment
    return {"time": math.nan, **values, **dict(zip(_CENTRE, map(float, centre), strict=True))}


def _vector(values: Values, names: Sequence[str]) -> Array:
    return np.array([values.get(name, math.nan) for name in names])


def _robot(content: bytes, file: str) -> Robot:
    reading = read_robot(content, file)
    if reading.robot is None:
        raise SourceError(*reading.diagnostics)
    return reading.robot
