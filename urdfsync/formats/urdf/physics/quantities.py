"""The compared quantities, each with its expected values from the reference."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias

import msgspec

from urdfsync.domain.experiment import Aspect, Compared, Quantity
from urdfsync.formats.urdf.physics.closing import OpenLoopError
from urdfsync.formats.urdf.physics.motion import COMPARED, Instant
from urdfsync.formats.urdf.physics.probe import CENTRE, FORCE, MASS, TORQUE, RobotVariables
from urdfsync.formats.urdf.physics.reference import Solution
from urdfsync.formats.urdf.physics.subject import Subject
from urdfsync.formats.urdf.robot import MOTION_KINDS, SENSOR_KINDS, Output
from urdfsync.formats.urdf.second.reading import origin, pose

Pair: TypeAlias = tuple[Compared, Sequence[Iterable[float]]]
"""A quantity, and its expected values at each of its instants."""


def poses(
    subject: Subject, names: RobotVariables, solved: Sequence[Solution], times: tuple[float, ...], part: Aspect
) -> Iterator[Pair]:
    """Yield the pose of each link at the given times."""
    for link in subject.tree.links:
        frames, element = [instant.poses[link.name] for instant in solved], f"link {link.name}"
        at = Compared(Quantity.POSITION, element, "m", names.places[link.name], times, part)
        turned = Compared(Quantity.ORIENTATION, element, "", names.axes[link.name], times, part)
        yield from ((at, [place for place, _ in frames]), (turned, [axes.T.ravel() for _, axes in frames]))


def bodies(subject: Subject, names: RobotVariables) -> Iterator[Pair]:
    """Yield poses, efforts of the axes, force and torque at the root, mass and centre of mass."""
    root, solved = f"link {subject.tree.links[0].name}", [subject.solved[time] for time in COMPARED]
    joints = {f"joint {joint.name}": joint for joint in subject.tree.joints}
    yield from poses(subject, names, solved, COMPARED, Aspect.BODIES)
    for compared, efforts in _efforts(subject, names, solved, COMPARED):
        joint = joints[compared.element]
        losses = Aspect.LOSSES if joint.dynamics or joint.transmission else Aspect.BODIES
        # at rest no joint has losses
        for times, part in ((slice(0, 1), Aspect.BODIES), (slice(1, None), losses)):
            yield msgspec.structs.replace(compared, instants=COMPARED[times], part=part), efforts[times]
    yield Compared(Quantity.REACTION, root, "N", FORCE, COMPARED), [-instant.force for instant in solved]
    yield Compared(Quantity.REACTION, root, "N·m", TORQUE, COMPARED), [-instant.torque for instant in solved]
    yield Compared(Quantity.MASS, "robot", "kg", MASS, COMPARED), [[instant.mass] for instant in solved]
    yield Compared(Quantity.CENTRE, "robot", "m", CENTRE, COMPARED), [instant.centre for instant in solved]


def _efforts(
    subject: Subject, names: RobotVariables, solved: Sequence[Solution], times: tuple[float, ...]
) -> Iterator[tuple[Compared, Sequence[Sequence[float]]]]:
    rows = subject.reference.multibody.coordinates
    for joint in subject.tree.joints:
        if joint.type == "ball":
            torques = tuple(f"robot.{subject.tree.joint(joint.name).component}Drive_.t[{i}]" for i in (1, 2, 3))
            row = rows[joint.name].rows
            compared = Compared(Quantity.EFFORT, f"joint {joint.name}", "N·m", torques, times)
            yield compared, [each.load[row].tolist() for each in solved]
        elif joint.name in subject.reference.axes:
            unit, effort = ("N·m", "tau") if MOTION_KINDS[joint.type] == "rotational" else ("N", "f")
            number, value = subject.reference.axes.index(joint.name), (f"{names.flanges[joint.name]}.{effort}",)
            compared = Compared(Quantity.EFFORT, f"joint {joint.name}", unit, value, times)
            yield compared, [[float(each.efforts[number])] for each in solved]


def over_time(subject: Subject, names: RobotVariables, step: float) -> Iterator[Pair]:
    """Yield poses and efforts every `step` seconds, except at times when a loop can't be closed."""
    solved = dict[float, Solution]()
    for k in range(round(Instant.TURNED / step) + 1):
        with contextlib.suppress(OpenLoopError):
            solved[k * step] = subject.solve_at(k * step)
    every, times = [*solved.values()], tuple(solved)
    yield from _efforts(subject, names, every, times)
    yield from poses(subject, names, every, times, Aspect.BODIES)


def loops(subject: Subject, names: RobotVariables) -> Iterator[Pair]:
    """Yield the gap of each loop, and the force in its joint, if the force is unique."""
    solved = [subject.solved[time] for time in COMPARED]
    for k, loop in enumerate(subject.tree.loops):
        element, values = f"loop {loop.name}", tuple(f"gap{k + 1}[{i}]" for i in (1, 2, 3))
        reactions = [instant.reactions[k] for instant in solved]
        yield Compared(Quantity.CLOSURE, element, "m", values, COMPARED, Aspect.LOOPS), [each.gap for each in reactions]
        if subject.closed.closures[loop.name].weaker:
            subject.unchecked[f"the force in loop {loop.name}, which depends on the omitted equations"] = None
            continue
        for unit, variable in (("N", "f"), ("N·m", "t")):
            values = tuple(f"{names.loops[loop.name]}.{variable}[{i}]" for i in (1, 2, 3))
            expected = [each.force if unit == "N" else each.torque for each in reactions]
            yield Compared(Quantity.REACTION, element, unit, values, COMPARED, Aspect.LOOPS), expected


def sensors(subject: Subject, names: RobotVariables) -> Iterator[Pair]:
    """Yield the outputs of sensors, and the frames of cameras and laser scanners."""
    balls = [ball.name for ball in subject.balls]
    for sensor in subject.tree.sensors:
        if sensor.is_in_joint and sensor.at in balls:
            subject.unchecked[f"sensor {sensor.name}, in a ball: the drive of the ball bypasses the sensor"] = None
            continue
        again, component = subject.second.sensors[sensor.name], names.sensors[sensor.name]
        held = subject.second.joints[again.parent] if sensor.is_in_joint else None
        ends = (held.parent, held.child) if held else ()
        rows = [subject.reference.measured(subject.states[time], again, ends) for time in COMPARED]
        what, when = f"sensor {sensor.name}", (COMPARED, Aspect.SENSORS)
        for output in _outputs(SENSOR_KINDS[sensor.kind].name):
            value = f"{component}.{output.name}"
            values = tuple(f"{value}[{i}]" for i in (1, 2, 3)) if output.is_vector else (value,)
            unit = output.unit.replace("2", "²").replace(".", "·")
            yield Compared(Quantity.READING, what, unit, values, *when, output.name), [row[output.name] for row in rows]
        if SENSOR_KINDS[sensor.kind].has_frame:
            place = tuple(f"{component}.frame_b.r_0[{i}]" for i in (1, 2, 3))
            axes = tuple(f"{component}.frame_b.R.T[{i},{j}]" for i in (1, 2, 3) for j in (1, 2, 3))
            at = [pose(*subject.solved[time].poses[again.parent]) @ origin(again) for time in COMPARED]
            yield Compared(Quantity.POSITION, what, "m", place, *when), [matrix[:3, 3] for matrix in at]
            yield Compared(Quantity.ORIENTATION, what, "", axes, *when), [matrix[:3, :3].T.ravel() for matrix in at]


def _outputs(name: str) -> Iterable[Output]:
    """Return all outputs of a class of the library's `Sensors`; Run may have only some of them."""
    return dict.fromkeys(output for kind in SENSOR_KINDS.values() if kind.name == name for output in kind.outputs)


def table(pairs: Iterable[Pair], times: Sequence[float]) -> tuple[tuple[Compared, ...], dict[str, tuple[float, ...]]]:
    """Return the compared quantities, and the expected numbers at all times; NaN stands for no number."""
    every, numbers = list[Compared](), dict[str, dict[float, float]]()
    for compared, rows in pairs:
        every.append(compared)
        for time, row in zip(compared.instants, rows, strict=True):
            for value, number in zip(compared.values, row, strict=True):
                numbers.setdefault(value, {})[time] = float(number)
    series = {value: tuple(own.get(time, math.nan) for time in times) for value, own in numbers.items()}
    return tuple(every), {"time": tuple(times), **series}
