"""The compared quantities, each with its expected values from Pinocchio or from the source."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias

import msgspec

from urdfsync.domain.experiment import Aspect, Compared, Quantity
from urdfsync.urdf.kinematics.poses import own_range
from urdfsync.urdf.physics import motion, probe
from urdfsync.urdf.physics.closing import OpenLoopError
from urdfsync.urdf.physics.motion import COMPARED, Instant
from urdfsync.urdf.physics.probe import CENTRE, FORCE, MASS, TORQUE, RobotVariables
from urdfsync.urdf.physics.reference import Array, Solution
from urdfsync.urdf.physics.subject import Subject
from urdfsync.urdf.robot import JOINT_KINDS, MOTION_KINDS, SENSOR_KINDS, Joint, Output
from urdfsync.urdf.second.reading import origin, pose

Pair: TypeAlias = tuple[Compared, Sequence[Iterable[float]]]
"""A quantity, and its expected values at each of its instants."""

SWEEP_TIMES = (0.0, motion.PERIOD / 2, motion.PERIOD)
"""Times at which motions of Test are compared."""
_CLEAR = 1e-5
"""At a greater relative distance, a value clearly passes or keeps a limit: warnings have some slack."""


def poses(
    subject: Subject, names: RobotVariables, solved: Sequence[Solution], times: tuple[float, ...], part: Aspect
) -> Iterator[Pair]:
    """Yield the pose of each link at the given times."""
    for link in subject.tree.links:
        frames, element = [instant.frame(link.name) for instant in solved], f"link {link.name}"
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
    masses = [instant.mass_and_centre() for instant in solved]
    yield Compared(Quantity.MASS, "robot", "kg", MASS, COMPARED), [[mass] for mass, _ in masses]
    yield Compared(Quantity.CENTRE, "robot", "m", CENTRE, COMPARED), [centre for _, centre in masses]


def _efforts(
    subject: Subject, names: RobotVariables, solved: Sequence[Solution], times: tuple[float, ...]
) -> Iterator[tuple[Compared, Sequence[Sequence[float]]]]:
    rows = subject.reference.coordinates()
    for joint in subject.tree.joints:
        if joint.type == "ball":
            torques = tuple(f"robot.{subject.tree.joint(joint.name).component}Drive_.t[{i}]" for i in (1, 2, 3))
            row = rows[joint.name]
            compared = Compared(Quantity.EFFORT, f"joint {joint.name}", "N·m", torques, times)
            yield compared, [each.load[row : row + 3].tolist() for each in solved]
        elif joint.name in subject.reference.axes:
            unit, effort = ("N·m", "tau") if MOTION_KINDS[joint.type] == "rotational" else ("N", "f")
            number, value = subject.reference.axes.index(joint.name), (f"{names.flanges[joint.name]}.{effort}",)
            compared = Compared(Quantity.EFFORT, f"joint {joint.name}", unit, value, times)
            by_motors = subject.pushed_by_motors(joint.name) if names.is_package else 0.0
            yield compared, [[float(each.efforts[number]) - by_motors] for each in solved]


def over_time(subject: Subject, names: RobotVariables, step: float) -> Iterator[Pair]:
    """Yield poses and efforts every `step` seconds, except at times when a loop can't be closed."""
    solved = dict[float, Solution]()
    for k in range(round(Instant.TURNED / step) + 1):
        with contextlib.suppress(OpenLoopError):
            solved[k * step] = subject.solve_at(k * step)
    every, times = [*solved.values()], tuple(solved)
    yield from _efforts(subject, names, every, times)
    yield from poses(subject, names, every, times, Aspect.BODIES)


def motors(subject: Subject) -> Iterator[Pair]:
    """Yield the positions of the motors behind gears."""
    rows, positions = subject.reference.coordinates(), [subject.states[time].positions for time in COMPARED]
    for name, drive in subject.connectors.drives.items():
        if drive.motor:
            gear = subject.second.joints[name]
            reduction, offset = (gear.number(f"transmission.{field}") for field in ("reduction", "offset"))
            other = gear.number("transmission.otherReduction") if gear.shares else 0.0
            turns = [[reduction * (q[rows[name]] - offset) + other * q[rows[gear.shares or name]]] for q in positions]
            value = (f"robot.{drive.motor}.phi",)
            yield Compared(Quantity.POSITION, f"motor of joint {name}", "rad", value, COMPARED, Aspect.LOSSES), turns


def loops(subject: Subject, names: RobotVariables) -> Iterator[Pair]:
    """Yield the gap of each loop, and the force in its joint, if the force is unique."""
    solved = [subject.solved[float(instant)] for instant in Instant]
    for k, loop in enumerate(subject.tree.loops):
        element, values = f"loop {loop.name}", tuple(f"gap{k + 1}[{i}]" for i in (1, 2, 3))
        reactions = [instant.reactions[k] for instant in solved]
        times = tuple(map(float, Instant))
        yield Compared(Quantity.CLOSURE, element, "m", values, times, Aspect.LOOPS), [each.gap for each in reactions]
        if subject.closed.closures[loop.name].weaker:
            subject.unchecked[f"the force in loop {loop.name}, which depends on the omitted equations"] = None
            continue
        for unit, variable in (("N", "f"), ("N·m", "t")):
            values = tuple(f"{names.loops[loop.name]}.{variable}[{i}]" for i in (1, 2, 3))
            expected = [each.force if unit == "N" else each.torque for each in reactions[: len(COMPARED)]]
            yield Compared(Quantity.REACTION, element, unit, values, COMPARED, Aspect.LOOPS), expected


def ranges(subject: Subject, names: RobotVariables) -> Iterator[Pair]:
    """Yield start, range and greatest speed of the axes, and the motion of axes in the generic robot's bench."""
    for k, (joint, way) in enumerate(subject.sweeps, 1):
        given = way.numbers if names.is_package and joint.name in subject.closed.reach else way.numbers[:4]
        numbers = {f"range{k}[{i}]": number for i, number in enumerate(given, 1) if abs(number) < motion.ENDLESS}
        what = f"joint {joint.name}{'' if names.is_package else ' of the generic robot'}"
        range_ = Compared(Quantity.SWEEP, what, _unit(joint), tuple(numbers), (0.0,), Aspect.BENCHES, "range")
        yield range_, [numbers.values()]
        if not names.is_package:
            swept = Compared(
                Quantity.SWEEP, what, _unit(joint), (probe.swept(subject, joint),), SWEEP_TIMES, Aspect.BENCHES
            )
            yield swept, [[way.numbers[0]], [way.end], [way.numbers[0]]]


def sweeps(subject: Subject) -> Iterator[Pair]:
    """Yield the motion of Test's drives, and the sums of their efforts at axis and housing."""
    for k, (joint, way) in enumerate(subject.sweeps, 1):
        what, unit = f"joint {joint.name}", _unit(joint)
        (q, effort), start = ("phi", "N·m") if unit == "rad" else ("s", "N"), way.numbers[0]
        swept = Compared(Quantity.SWEEP, what, unit, (f"sweep{k}.{q}",), SWEEP_TIMES, Aspect.BENCHES)
        yield swept, [[start], [way.end], [start]]
        yield (
            Compared(Quantity.EFFORT, what, effort, (f"balance{k}",), SWEEP_TIMES, Aspect.BENCHES, "Test"),
            [[0.0]] * 3,
        )


def _unit(joint: Joint) -> str:
    return "rad" if MOTION_KINDS[joint.type] == "rotational" else "m"


def sensors(subject: Subject, names: RobotVariables) -> Iterator[Pair]:
    """Yield the outputs of sensors, and the frames of cameras and laser scanners."""
    balls = [ball.name for ball in subject.balls]
    for sensor in subject.tree.sensors:
        if sensor.is_in_joint and sensor.at in balls:
            subject.unchecked[f"sensor {sensor.name}, in a ball: the drive of the ball bypasses the sensor"] = None
            continue
        again, component = subject.second.sensors[sensor.name], names.sensors[sensor.name]
        above = subject.second.joints[again.parent].parent if sensor.is_in_joint else ""
        rows = [subject.reference.measured(subject.states[time], again, above) for time in COMPARED]
        what, when = f"sensor {sensor.name}", (COMPARED, Aspect.SENSORS)
        for output in _outputs(SENSOR_KINDS[sensor.kind].name):
            value = f"{component}.{output.name}"
            values = tuple(f"{value}[{i}]" for i in (1, 2, 3)) if output.is_vector else (value,)
            unit = output.unit.replace("2", "²").replace(".", "·")
            yield Compared(Quantity.READING, what, unit, values, *when, output.name), [row[output.name] for row in rows]
        if SENSOR_KINDS[sensor.kind].has_frame:
            place = tuple(f"{component}.frame_b.r_0[{i}]" for i in (1, 2, 3))
            axes = tuple(f"{component}.frame_b.R.T[{i},{j}]" for i in (1, 2, 3) for j in (1, 2, 3))
            at = [pose(*subject.solved[time].frame(again.parent)) @ origin(again) for time in COMPARED]
            yield Compared(Quantity.POSITION, what, "m", place, *when), [matrix[:3, 3] for matrix in at]
            yield Compared(Quantity.ORIENTATION, what, "", axes, *when), [matrix[:3, :3].T.ravel() for matrix in at]


def _outputs(name: str) -> Iterable[Output]:
    """Return all outputs of a class of the library's `Sensors`; Run may have only some of them."""
    return dict.fromkeys(output for kind in SENSOR_KINDS.values() if kind.name == name for output in kind.outputs)


def limits(subject: Subject) -> Iterator[Pair]:
    """Yield the warnings of each joint at instants with a clear answer: 1 for an expected warning."""
    coordinates = subject.reference.coordinates()
    for joint in subject.tree.joints:
        if joint.type not in MOTION_KINDS:
            continue
        row, passed = coordinates[joint.name], dict[str, dict[float, bool]]()
        lower, upper = own_range(joint)
        speed = joint.limit.velocity if joint.limit else None
        effort = joint.limit.effort if joint.limit else None
        # later, the ground changes the efforts
        for time, state in list(subject.states.items())[: Instant.STANDING]:
            q, v = float(state.positions[row]), abs(float(state.v[row]))
            a, gain = abs(float(state.a[row])), float(state.a[row] * state.v[row])
            tests = {
                "is_below_its_lower_position_limit": (lower, q, -1.0),
                "is_above_its_upper_position_limit": (upper, q, 1.0),
                "is_faster_than_its_velocity_limit": (math.inf if speed is None else speed, v, 1.0),
            }
            up, down = motion.greatest_gains(joint)
            if min(up, down) < math.inf and abs(gain) > _CLEAR:
                tests["speeds_up_faster_than_its_acceleration_limit"] = up, a * (gain > 0), 1.0
                tests["slows_down_faster_than_its_deceleration_limit"] = down, a * (gain < 0), 1.0
            if joint.name in subject.reference.axes:
                load = abs(float(subject.solved[time].efforts[subject.reference.axes.index(joint.name)]))
                tests["is_driven_above_its_effort_limit"] = (math.inf if effort is None else effort, load, 1.0)
            for ending, (limit, value, sign) in tests.items():
                if "position" in ending and not JOINT_KINDS[joint.type].has_limits:
                    continue
                excess = sign * (value - limit)
                if not abs(excess) < _CLEAR * max(1.0, abs(limit) if math.isfinite(limit) else 1.0):
                    passed.setdefault(ending, {})[time] = excess > 0
        for ending, flags in passed.items():
            variable = probe.limit_variable(subject, joint, ending)
            detail = ending.replace("_", " ")
            compared = Compared(
                Quantity.WARNING, f"joint {joint.name}", "", (variable,), tuple(flags), Aspect.LIMITS, detail
            )
            yield compared, [[float(flag)] for flag in flags.values()]


def ground(subject: Subject) -> Iterator[Pair]:
    """Yield the part of the force and torque on a standing robot that the ground does not carry."""
    if subject.stand is None:
        return
    times, rows, root = tuple(map(float, motion.ON_GROUND)), list[Array](), subject.tree.links[0].name
    for time, (*slide, rise) in zip(times, motion.ON_GROUND.values(), strict=True):
        held = subject.solved[time]
        rows.append(subject.stand.wrench(rise, slide, held.frame(root)[1]) - [*held.force, *held.torque])
    for unit, values, part in (("N", FORCE, slice(0, 3)), ("N·m", TORQUE, slice(3, 6))):
        compared = Compared(Quantity.GROUND, "robot", unit, values, times, Aspect.CONTACTS)
        yield compared, [row[part] for row in rows]


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
