"""The experiment of the URDF domain: a probe for a compiler, and what Pinocchio expects of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from urdfsync.diagnostics import SourceError
from urdfsync.domain import Compared, Experiment, Quantity, Target
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.tables import obstacles
from urdfsync.urdf.options import Options
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.physics import completion, motion
from urdfsync.urdf.physics.probe import CENTRE, FORCE, MASS, TORQUE, RobotVariables, probe, robot_variables
from urdfsync.urdf.physics.reading import pinocchio, read
from urdfsync.urdf.physics.reference import Instant, Reference
from urdfsync.urdf.robot import MOTION_KINDS, Robot

_UNCHECKED = (
    "limits, shapes and contacts (they change no motion) and models around the robot (they are only compiled) "
    "are not compared"
)


def experiment(content: bytes, file: str, target: Target, options: Options) -> Experiment | str:
    """See `urdfsync.domain.Domain.experiment`. Links that move without any mass get inertias.

    Raises SourceError if the source has errors, or if Pinocchio is not installed or can't read it.
    """
    robot = _robot(content, file)
    if loose := obstacles(robot.joints):
        return f"joint {loose[0].name} is {loose[0].type}, and nothing prescribes how it moves"
    completed, notes = completion.completed_for_pinocchio(content)
    completed, made_up = completion.with_inertias(completed, KinematicTree.of(robot))
    tree = KinematicTree.of(_robot(completed, file), (target.name,))
    axes, names = motion.driven_axes(tree), robot_variables(tree, target, options)
    reference = Reference(read(completed, file), [joint.name for joint in axes])
    courses = [motion.axis_course(joint) for joint in axes]
    with np.errstate(all="ignore"):  # numbers without end in the source
        instants = [reference.solve(reference.state(time, courses)) for time in (0.0, motion.DURATION)]
        first, last = (dict(_expected(instant, tree, names)) for instant in instants)
    return Experiment(
        reference=f"Pinocchio {pinocchio().__version__}",
        content=completed,
        probe=probe(tree, target, options),
        compared=tuple(_compared(tree, names)),
        expected={name: (first[name], last[name]) for name in first},
        notes=(*notes, *made_up),
        unchecked=(_UNCHECKED,),
    )


def _compared(tree: KinematicTree, names: RobotVariables) -> Iterator[Compared]:
    """Yield all that is compared, from the root outwards."""
    for link in tree.links:
        yield Compared(Quantity.POSITION, f"link {link.name}", "m", tuple(names.places[link.name]))
        yield Compared(Quantity.ORIENTATION, f"link {link.name}", "", tuple(names.axes[link.name]))
    efforts = names.efforts(tree)
    for joint in tree.joints:
        if joint.name in efforts:
            unit = "N·m" if MOTION_KINDS[joint.type] == "rotational" else "N"
            yield Compared(Quantity.EFFORT, f"joint {joint.name}", unit, (efforts[joint.name],))
    yield Compared(Quantity.REACTION, f"link {tree.links[0].name}", "N", FORCE)
    yield Compared(Quantity.REACTION, f"link {tree.links[0].name}", "N·m", TORQUE)
    yield Compared(Quantity.MASS, "robot", "kg", MASS)
    yield Compared(Quantity.CENTRE, "robot", "m", CENTRE)


def _expected(instant: Instant, tree: KinematicTree, names: RobotVariables) -> Iterator[tuple[str, float]]:
    """Yield what the reference says, by the names of the variables."""
    mass, centre = instant.mass_and_centre()
    pairs: list[tuple[Sequence[str], Any]] = [
        (list(names.efforts(tree).values()), instant.efforts),
        ((*FORCE, *TORQUE), (*-instant.force, *-instant.torque)),
        ((*MASS, *CENTRE), (mass, *centre)),
    ]
    for link in tree.links:
        place, axes = instant.frame(link.name)
        pairs += [(names.places[link.name], place), (names.axes[link.name], axes.T.ravel())]
    for variables, numbers in pairs:
        yield from zip(variables, map(float, numbers), strict=True)


def _robot(content: bytes, file: str) -> Robot:
    reading = read_robot(content, file)
    if reading.robot is None:
        raise SourceError(*reading.diagnostics)
    return reading.robot
