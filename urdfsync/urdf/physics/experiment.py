"""The experiment of the URDF domain: a probe for a compiler, and the comparison of what it gives with Pinocchio."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple, TypeAlias

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
from urdfsync.urdf.physics.reference import Configuration, FrameMotion, Reference
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
    also if free joints carry so little inertia that there is no reference, else `compare` without a baseline does.
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
        names = [[joint.name for joint in joints] for joints in (self._axes, self._free)]
        self._reference = Reference(read(self.content, file), *names)
        self._insoluble: Diagnostic | None = None
        ballast = self._needs_ballast(file)
        if complete and self._insoluble:
            raise SourceError(self._insoluble)
        self.probe = probe(self._tree, target, options, ballast)
        self.unchecked = tuple(_unchecked(self._tree, options))

    def _needs_ballast(self, file: str) -> bool:
        """Whether free joints move no inertia: then bodies hang on the robot, and a note says so."""
        if not self._reference.is_singular(self._start(0.0)):
            return False
        self._reference.hang_ballast(link.name for link in self._tree.leaves())
        names = ", ".join(f"'{joint.name}'" for joint in self._free)
        if self._reference.is_singular(self._start(0.0)):
            message = f"no simulation can tell how {names} move: what they carry has no inertia"
            hint = "give each link that moves freely a mass and an inertia"
            self._insoluble = Diagnostic(Severity.ERROR, "free-without-inertia", message, file, hint=hint)
        weight = f"{motion.BALLAST_MASS} kg hang on each link without children"
        self.notes += (f"{weight}, because {names} would move without any inertia",)
        return True

    def compare(self, series: Series, baseline: Series | None = None) -> Sequence[Deviation]:
        """See `urdfsync.domain.Experiment`; the first and the last instant count."""
        if baseline is None and self._insoluble:
            raise SourceError(self._insoluble)
        greatest: dict[_Key, tuple[float, float]] = {}  # difference, and value of the reference
        with np.errstate(all="ignore"):  # where the simulation gave no number, the reference may have none
            for instant in (_FIRST, _LAST):
                found = _at(series, instant)
                expected = self._reference_values(found, instant) if baseline is None else _at(baseline, instant)
                tolerated = _SOLVER_ERROR if baseline is not None and self._free and instant == _LAST else 0.0
                for key, names in self._compared():
                    one, other = _vector(found, names), _vector(expected, names)
                    new, size = float(np.max(np.abs(one - other))), float(np.max(np.abs(other)))
                    size = size if math.isfinite(size) else 0.0
                    if math.isnan(new):  # what is no number is infinitely far off
                        new = math.inf
                    difference, value = greatest.get(key, (0.0, 0.0))
                    greatest[key] = max(difference, 0.0 if new <= tolerated * max(1.0, size) else new), max(value, size)
        sizes: dict[tuple[Quantity, str], float] = {}
        for key, (_, value) in greatest.items():
            sizes[key.quantity, key.unit] = max(sizes.get((key.quantity, key.unit), 0.0), value)
        return [
            Deviation(key.quantity, key.element, difference, value, sizes[key.quantity, key.unit], key.unit)
            for key, (difference, value) in greatest.items()
        ]

    def _compared(self) -> Iterator[tuple[_Key, Sequence[str]]]:
        """All that is compared, from the root outwards, with the variables that tell it."""
        names, tree = self._variables, self._tree
        for link in tree.links:
            yield _Key(Quantity.POSITION, f"link {link.name}", "m"), names.places[link.name]
            yield _Key(Quantity.ORIENTATION, f"link {link.name}", ""), names.axes[link.name]
        efforts = names.efforts(tree)
        for joint in tree.joints:
            if joint.name in efforts:
                unit = "N·m" if MOTION_KINDS[joint.type] == "rotational" else "N"
                yield _Key(Quantity.EFFORT, f"joint {joint.name}", unit), (efforts[joint.name],)
        root = f"link {tree.links[0].name}"
        yield _Key(Quantity.REACTION, root, "N"), FORCE
        yield _Key(Quantity.REACTION, root, "N·m"), TORQUE
        for joint in self._free:
            for part, unit in (("a_0", "m/s²"), ("z_a", "rad/s²")):
                yield _Key(Quantity.ACCELERATION, f"link {joint.child}", unit), names.of_body(joint.child, part)
        yield _Key(Quantity.MASS, "robot", "kg"), MASS
        yield _Key(Quantity.CENTRE, "robot", "m"), _CENTRE

    def _reference_values(self, found: Values, instant: int) -> Values:
        """The variables of the probe as the reference has them.

        Where free joints are later on follows from the simulation, whose solver is not tested.
        """
        names, time, reference = self._variables, found["time"], self._reference
        if instant == _FIRST:
            solved = reference.solve(self._start(time))
        else:
            free = {}
            for joint in self._free:
                link = joint.child
                axes = _vector(found, names.axes[link]).reshape(3, 3).T
                moves = (_vector(found, names.of_body(link, part)) for part in ("v_0", "w_a"))
                free[joint.name] = FrameMotion(_vector(found, names.places[link]), axes, *moves)
            solved = reference.solve(reference.state(time, self._courses, free))
        mass, centre = solved.mass_and_centre()
        pairs: list[tuple[Sequence[str], Iterable[float]]] = [
            (FORCE, -solved.force),
            (TORQUE, -solved.torque),
            (MASS, [mass]),
            (_CENTRE, centre),
        ]
        pairs.append((tuple(names.efforts(self._tree).values()), solved.efforts))
        for link in (link.name for link in self._tree.links):
            frame = solved.frame(link)
            pairs += [(names.places[link], frame.place), (names.axes[link], frame.axes.T.ravel())]
        for link in (joint.child for joint in self._free):
            linear, angular = solved.acceleration(link)
            pairs += [(names.of_body(link, "a_0"), linear), (names.of_body(link, "z_a"), angular)]
        return {name: float(value) for called, values in pairs for name, value in zip(called, values, strict=True)}

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


def _unchecked(tree: KinematicTree, options: Options) -> Iterator[str]:
    """What the comparison does not cover, as far as it matters for this robot: sentences without a full stop."""
    joints, links = tree.joints, tree.links
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
