"""The experiment of the URDF domain: probes for a compiler, and the expected values from the reference."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
import numpy as np

from urdfsync.common.diagnostics import SourceError
from urdfsync.domain.experiment import Aspect, Compared, Experiment, Quantity, Sample, Trial
from urdfsync.formats.urdf.drives import by_effort, friction_law, is_chosen, sharing_joint
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.model.record import obstacles
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.parse.source import RobotReading, read_robot
from urdfsync.formats.urdf.physics import completion, motion, probe, quantities
from urdfsync.formats.urdf.physics.closing import OpenLoopError
from urdfsync.formats.urdf.physics.motion import COMPARED
from urdfsync.formats.urdf.physics.probe import RobotVariables
from urdfsync.formats.urdf.physics.reference import reference_class
from urdfsync.formats.urdf.physics.subject import Subject
from urdfsync.formats.urdf.robot import MOTION_KINDS, Robot
from urdfsync.formats.urdf.second.companions import read_companions

_ITERATED = 1e-7
"""The least tolerance for robots with loops: compilers close loops by iteration."""
_MOST_AXES = 20
"""The greatest number of axes in the free motion of a package's robot: for 30 axes, rumoca takes 6 GB."""


def experiment(sample: Sample, step: float | None = None) -> Experiment | str:
    """Return the comparison, see `urdfsync.domain.experiment.Checks`.

    Moving links without a mass get inertias. Raises MissingReferenceError, and SourceError if the source has an error
    or the reference can't read it.
    """
    file, options = sample.file, sample.options
    reading = read_robot(sample.content, file, options, *sample.companions)
    # the package lacks a part of the robot; a translated source lacks its part, too
    allowed = {*options.allow} - {"part-left-out"}
    if left_out := [entry.statement for entry in reading.diagnostics if entry.code in allowed]:
        return left_out[0]
    robot = _robot(reading)
    has_package = "package" in options.approach
    if loose := [joint for joint in obstacles(robot.joints) if joint.type != "ball" or not has_package]:
        return f"joint {loose[0].name} is {loose[0].type}, and nothing prescribes its motion"
    stated = read_companions(sample.companions, options)
    names = {joint.name for joint in robot.joints}
    completed, notes = completion.completed_for_reference(sample.content, names, stated)
    completed, made_up = completion.with_inertias(completed, KinematicTree.of(robot))
    catalogue = tuple(companion for companion in sample.companions if companion.option == "catalogue")
    robot = _robot(read_robot(completed, file, options, *catalogue))
    trials = list[Trial]()
    # the reference has smooth friction and rigid drives; rumoca can't start if two joints with stiction slide
    simplified = msgspec.structs.replace(options, friction="smooth", elastic="none", saturated="none")
    with np.errstate(all="ignore"):  # infinite numbers in the source
        try:
            copy = msgspec.structs.replace(sample, content=completed, companions=catalogue, options=simplified)
            subject = Subject(copy, robot)
        except OpenLoopError:
            return "the reference can't close the loops of the robot at or near the start"
        tree = subject.tree
        # the records of other robots have a warning
        has_record = not (
            tree.loops or obstacles(tree.joints) or any(sharing_joint(joint, "joint") for joint in tree.joints)
        )
        for approach in options.approach:
            if approach == "package" or has_record:
                trials += _trials(subject, approach, step)
    return Experiment(
        reference=reference_class().name,
        content=completed,
        options=simplified,
        trials=tuple(trials),
        notes=(*notes, *made_up),
        companions=catalogue,
        unchecked=(*_simplified(subject, options), *_not_compared(subject), *subject.unchecked),
    )


def _trials(subject: Subject, approach: str, step: float | None) -> Iterator[Trial]:
    """Yield the simulations for one approach. The first simulation goes through all instants."""
    names = probe.robot_variables(subject, approach)
    label = " of the record" if len(subject.options.approach) > 1 and approach == "record" else ""
    pairs = list(quantities.bodies(subject, names))
    if approach == "package":
        pairs += quantities.sensors(subject, names)
        pairs += quantities.loops(subject, names)
    needed = [value for compared, _ in pairs for value in compared.values]
    moving = probe.moving_probe(subject, names, needed, step or 1.0)
    table = quantities.table(pairs, COMPARED)
    over_time = list(quantities.over_time(subject, names, step)) if step else []
    times = over_time[0][0].instants if over_time else ()
    every = [Trial(f"motion{label}", moving, *table, *quantities.table(over_time, times))]
    if approach == "record" or len(subject.axes) <= _MOST_AXES:
        every += _free(subject, names, f"free motion{label}")
    for each in every:
        least = _ITERATED if subject.tree.loops else 0.0
        compared = tuple(
            msgspec.structs.replace(c, detail=c.detail or label, least_tolerance=max(c.least_tolerance, least))
            for c in each.compared
        )
        yield msgspec.structs.replace(each, compared=compared)


def _free(subject: Subject, names: RobotVariables, name: str) -> Iterator[Trial]:
    """Yield the trial in which given efforts move the axes, if efforts determine the accelerations."""
    is_free, reference, time = subject.options.base == "floating", subject.reference, (0.0,)
    courses = [probe.free_course(subject, number) for number in range(len(subject.axes))]
    state = reference.free_state(courses, motion.FREE_START if is_free else {})
    reference.set_gravity(motion.BENCH_GRAVITY)
    efforts = reference.solve(state).efforts
    response = reference.free_gains(state, efforts, is_free)
    reference.set_gravity(motion.GRAVITY)
    if response is None:
        subject.unchecked["free motion: an axis moves no mass, so its effort determines no acceleration"] = None
        return
    gains, doubt = response
    pairs = list(quantities.poses(subject, names, [reference.solve(state)], time, Aspect.FREE_MOTION))
    rows = reference.multibody.coordinates
    for k, joint in enumerate(subject.axes, 1):
        unit, row = "m/s²" if MOTION_KINDS.get(joint.type) == "translational" else "rad/s²", rows[joint.name].rows
        read = (
            tuple(f"gain{k}[{i}]" for i in (1, 2, 3))
            if joint.type == "ball"
            else (names.accelerations.get(joint.name, f"gain{k}"),)
        )
        what = Quantity.ACCELERATION, f"joint {joint.name}", unit, read, time, Aspect.FREE_MOTION
        pairs.append((Compared(*what, least_tolerance=doubt), [gains[row].tolist()]))
    if is_free:
        gained = tuple(f"base.freeMotion.a_rel_a[{i}]" for i in (1, 2, 3))
        root = f"link {subject.tree.links[0].name}"
        compared = Compared(Quantity.ACCELERATION, root, "m/s²", gained, time, Aspect.FREE_MOTION)
        pairs.append((compared, [reference.base_gain(state, gains)]))
    table = quantities.table(pairs, [0.0])
    values = [value for compared, _ in pairs for value in compared.values]
    pushed = [float(effort) for effort in efforts]
    free = probe.free_probe(subject, names, courses, pushed, values)
    yield Trial(name, free, *table)


def _simplified(subject: Subject, options: Options) -> Iterator[str]:
    """Yield, in words, the laws of joints that the compared package replaces by simpler laws."""
    every, driven = subject.tree.joints, subject.closed.driven
    drives = [joint for joint in every if joint.name in driven]
    joints = {
        **{law: [j.name for j in every if friction_law(j, options) == law] for law in ("stiction", "lugre")},
        "elastic": [joint.name for joint in drives if is_chosen(joint, options.elastic)],
        "saturated": [j.name for j in drives if is_chosen(j, options.saturated) and not by_effort(j)],
    }
    for law, names in joints.items():
        if names:
            part, plain = ("drive", "rigid") if law in ("elastic", "saturated") else ("friction", "smooth")
            who = ", ".join(names) if len(names) <= 3 else f"{len(names)} joints"
            yield f"{part} of {who} ({law}) inside of the robot: the compared package has a {plain} one"


def _not_compared(subject: Subject) -> Iterator[str]:
    """Yield the parts that are not compared."""
    options, axes = subject.options, len(subject.axes)
    yield "warnings at limits, contacts, motors, and the motion of Run and Test (they are only compiled)"
    if axes > _MOST_AXES:
        yield f"free motion of more than {_MOST_AXES} axes: a compiler would need too much memory"
    if "record" in options.approach and subject.tree.loops:
        yield "the record, which has no loops"
    elif "record" in options.approach and obstacles(subject.tree.joints):
        yield "the record, which has no tables for robots with ball joints"
    elif "record" in options.approach:
        yield "sensors, shapes and `frame_b` of the generic robot"


def _robot(reading: RobotReading) -> Robot:
    if reading.robot is None:
        raise SourceError(*reading.diagnostics)
    return reading.robot
