"""The experiment of the URDF domain: a probe for a compiler, and the values that Pinocchio expects of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from urdfsync.diagnostics import SourceError
from urdfsync.domain import Experiment, Target
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.tables import obstacles
from urdfsync.urdf.options import Options
from urdfsync.urdf.parse.source import RobotReading, read_robot
from urdfsync.urdf.physics import completion, motion
from urdfsync.urdf.physics.probe import probe, robot_variables
from urdfsync.urdf.physics.reference import Instant, Reference, pinocchio, read
from urdfsync.urdf.robot import Robot

_UNCHECKED = (
    "limits, shapes, contacts and sensors (they change no motion) and models around the robot (they are only compiled) "
    "are not compared"
)


def experiment(content: bytes, file: str, target: Target, options: Options) -> Experiment | str:
    """Return the comparison, see `urdfsync.domain.Domain.experiment`. Links that move without any mass get inertias.

    Raises SourceError if the source has errors, or if Pinocchio is not installed or can't read it.
    """
    reading = read_robot(content, file, options)
    # such a package lacks a part of the robot
    if left_out := [entry.message for entry in reading.diagnostics if entry.code in options.allow]:
        return left_out[0]
    robot = _robot(reading)
    if loose := obstacles(robot.joints):
        return f"joint {loose[0].name} is {loose[0].type}, and nothing prescribes how it moves"
    completed, notes = completion.completed_for_pinocchio(content)
    completed, made_up = completion.with_inertias(completed, KinematicTree.of(robot))
    tree = KinematicTree.of(_robot(read_robot(completed, file)), (target.name,))
    axes, trial = motion.driven_axes(tree), probe(tree, target, options)
    reference = Reference(read(completed, file), [joint.name for joint in axes])
    courses = [motion.axis_course(joint) for joint in axes]
    with np.errstate(all="ignore"):  # numbers without end in the source
        instants = [reference.solve(reference.state(time, courses)) for time in (0.0, motion.DURATION)]
        first, last = ([float(x) for values in _expected(instant, tree) for x in values] for instant in instants)
    return Experiment(
        reference=f"Pinocchio {pinocchio().__version__}",
        content=completed,
        probe=trial,
        compared=robot_variables(tree, target, options).compared,
        expected=dict(zip(trial.values, zip(first, last, strict=True), strict=True)),
        notes=(*notes, *made_up),
        unchecked=(_UNCHECKED,),
    )


def _expected(instant: Instant, tree: KinematicTree) -> Iterator[Iterable[float]]:
    """Yield the values of each quantity by the reference, in the order of `RobotVariables.compared`."""
    for link in tree.links:
        place, axes = instant.frame(link.name)
        yield place
        yield axes.T.ravel()
    efforts = dict(zip(instant.reference.axes, instant.efforts, strict=True))
    yield from ([efforts[joint.name]] for joint in tree.joints if joint.name in efforts)
    mass, centre = instant.mass_and_centre()
    yield from (-instant.force, -instant.torque, [mass], centre)


def _robot(reading: RobotReading) -> Robot:
    if reading.robot is None:
        raise SourceError(*reading.diagnostics)
    return reading.robot
