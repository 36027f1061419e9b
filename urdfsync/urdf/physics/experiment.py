"""The experiment of the URDF domain: probes for a compiler, and the values that Pinocchio expects of them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias
from xml.etree.ElementTree import Element

import msgspec
import numpy as np

from urdfsync.diagnostics import SourceError
from urdfsync.domain import Compared, Experiment, Import, Part, Quantity, Target, Trial
from urdfsync.urdf.drives import can_be_driven, driven_joints, friction_law, is_chosen
from urdfsync.urdf.kinematics.poses import own_range, start_positions
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.tables import obstacles
from urdfsync.urdf.options import Options
from urdfsync.urdf.parse import xml
from urdfsync.urdf.parse.source import RobotReading, read_robot
from urdfsync.urdf.physics import completion, contacts, motion, probe
from urdfsync.urdf.physics.motion import COMPARED, LOADS, Course, Instant
from urdfsync.urdf.physics.probe import CENTRE, FORCE, MASS, TORQUE, RobotVariables
from urdfsync.urdf.physics.reference import Array, Configuration, Gear, Reference, Solution, pinocchio, read, read_gears
from urdfsync.urdf.robot import JOINT_KINDS, MOTION_KINDS, Robot

_Pair: TypeAlias = tuple[Compared, Sequence[Iterable[float]]]
"""A quantity, and its expected values at each of its instants."""

_CLEAR = 1e-5
"""Relative distance from a limit from which on it is clear whether it is passed: warnings have some slack."""

_MOST_AXES = 20
"""The most axes that a robot of a package moves freely with: rumoca takes 6 GB for 30."""


def experiment(
    content: bytes, file: str, target: Target, options: Options, imports: Mapping[str, Import]
) -> Experiment | str:
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
    tree = KinematicTree.of(_robot(read_robot(completed, file, options)), (target.name,))
    trials, chosen = list[Trial](), options
    # the reference has the smooth law and rigid drives, and the embedded compiler starts no two joints that slide
    options = msgspec.structs.replace(options, friction="smooth", elastic="none", saturated="none")
    with np.errstate(all="ignore"):  # numbers without end in the source
        subject = _Subject(completed, file, tree, target, options, imports)
        for approach in options.approach:
            trials += subject.trials(approach)
    return Experiment(
        reference=f"Pinocchio {pinocchio().__version__}",
        content=completed,
        options=options,
        trials=tuple(trials),
        notes=(*notes, *made_up),
        unchecked=(*_simplified(tree, chosen), *_not_compared(options, len(subject.axes)), *set(subject.unchecked)),
    )


class _Subject:
    """A robot in Pinocchio, and the motion that it is put through."""

    def __init__(
        self,
        content: bytes,
        file: str,
        tree: KinematicTree,
        target: Target,
        options: Options,
        imports: Mapping[str, Import],
    ) -> None:
        self.tree, self.target, self.options = tree, target, options
        self.root: Element = xml.parse(content).root
        self.axes = motion.driven_axes(tree)
        sensed = {sensor.at for sensor in tree.sensors if sensor.kind == "force_torque"}
        self.reference = Reference(read(content, file, sensed), [joint.name for joint in self.axes])
        self._base = motion.base_courses()
        self.stand: contacts.Stand | None = None
        self.unchecked = list[str]()
        """What is not compared of this robot."""
        self.starts = start_positions(tree)
        limits = [joint.limit.effort if joint.limit and joint.limit.effort else math.inf for joint in self.axes]
        courses = [motion.axis_courses(joint, self.starts[joint.name]) for joint in self.axes]
        strains = dict[Instant, Array]()
        for instant, share in LOADS.items():
            state = self._state(instant, courses)
            holding = self.reference.solve(state).efforts
            pairs = zip(limits, holding, strict=True)
            efforts = np.array([share * limit if math.isfinite(limit) else hold for limit, hold in pairs])
            strains[instant] = self.reference.effort_gains(state, efforts)
        self.courses = [
            motion.axis_courses(joint, self.starts[joint.name], {k: float(gains[n]) for k, gains in strains.items()})
            for n, joint in enumerate(self.axes)
        ]
        if options.base == "floating" and "package" in options.approach:
            self._put_down(imports)
        self.states = {float(instant): self._state(instant, self.courses) for instant in Instant}
        self.solved = {time: self.reference.solve(state) for time, state in self.states.items()}

    def _state(self, instant: Instant, courses: Sequence[Sequence[Course]]) -> Configuration:
        return self.reference.state([course[instant] for course in courses], [c[instant] for c in self._base])

    def _put_down(self, imports: Mapping[str, Import]) -> None:
        """Put the robot on the ground, if it can be."""
        mass, _ = self.reference.solve(self._state(Instant.STANDING, self.courses)).mass_and_centre()
        self.stand = contacts.stand(self.tree, imports, mass * motion.GRAVITY)
        if self.stand is None:
            self.unchecked.append("contacts, and the height at the beginning: no shape of the robot touches the ground")
        else:
            self._base = motion.base_courses(self.stand.depth)

    def trials(self, approach: str) -> Iterator[Trial]:
        """Yield the simulations for one approach, that of all instants first."""
        names = probe.robot_variables(self.tree, self.target, self.options, approach)
        label = " of the record" if len(self.options.approach) > 1 and approach == "record" else ""
        gears = read_gears(self.root)
        geared = [joint.name for joint in self.axes if joint.transmission or joint.name in gears]
        pairs = [*self._bodies(names), *self._gears(geared, gears)]
        optional = ""
        if approach == "package":
            pairs += self._sensors(names)
            limits = list(self._limits())
            optional = "|".join(compared.values[0] for compared, _ in limits)
            pairs += limits
            pairs += self._ground()
        needed = [v for compared, _ in pairs for v in compared.values if compared.quantity is not Quantity.WARNING]
        moving = probe.moving_probe(
            self.tree, self.target, self.options, names, dict(zip(self.reference.axes, self.courses, strict=True)),
            self._base, self.stand is not None and approach == "package", geared, needed, optional,
        )  # fmt: skip
        trial = Trial(f"motion{label}", moving, *_table(pairs, [float(instant) for instant in Instant]))
        every = [trial]
        if approach == "record" or len(self.axes) <= _MOST_AXES:
            every += self._free(names, f"free motion{label}")
        for each in every:
            compared = tuple(msgspec.structs.replace(c, detail=c.detail or label) for c in each.compared)
            yield msgspec.structs.replace(each, compared=compared)

    def _poses(
        self, names: RobotVariables, solved: Sequence[Solution], times: tuple[float, ...], part: Part
    ) -> Iterator[_Pair]:
        """Yield where each link is at some times."""
        for link in self.tree.links:
            frames, element = [instant.frame(link.name) for instant in solved], f"link {link.name}"
            at = Compared(Quantity.POSITION, element, "m", names.places[link.name], times, part)
            turned = Compared(Quantity.ORIENTATION, element, "", names.axes[link.name], times, part)
            yield from ((at, [place for place, _ in frames]), (turned, [axes.T.ravel() for _, axes in frames]))

    def _bodies(self, names: RobotVariables) -> Iterator[_Pair]:
        """Yield poses, efforts of the axes, what holds the root, and the mass."""
        root, solved = f"link {self.tree.links[0].name}", [self.solved[time] for time in COMPARED]
        yield from self._poses(names, solved, COMPARED, Part.BODIES)
        for joint in filter(can_be_driven, self.tree.joints):
            unit, effort = ("N·m", "tau") if MOTION_KINDS[joint.type] == "rotational" else ("N", "f")
            number = self.reference.axes.index(joint.name)
            value, efforts = (f"{names.flanges[joint.name]}.{effort}",), [[i.efforts[number]] for i in solved]
            losses = Part.LOSSES if joint.dynamics or joint.transmission else Part.BODIES
            # at rest no joint has losses
            for times, part in ((slice(0, 1), Part.BODIES), (slice(1, None), losses)):
                compared = Compared(Quantity.EFFORT, f"joint {joint.name}", unit, value, COMPARED[times], part)
                yield compared, efforts[times]
        yield Compared(Quantity.REACTION, root, "N", FORCE, COMPARED), [-instant.force for instant in solved]
        yield Compared(Quantity.REACTION, root, "N·m", TORQUE, COMPARED), [-instant.torque for instant in solved]
        masses = [instant.mass_and_centre() for instant in solved]
        yield Compared(Quantity.MASS, "robot", "kg", MASS, COMPARED), [[mass] for mass, _ in masses]
        yield Compared(Quantity.CENTRE, "robot", "m", CENTRE, COMPARED), [centre for _, centre in masses]

    def _gears(self, geared: Sequence[str], gears: Mapping[str, Gear]) -> Iterator[_Pair]:
        """Yield the numbers of the gears."""
        for k, joint in enumerate(geared, 1):
            values = tuple(f"gear{k}[{i}]" for i in (1, 2, 3))
            gear = gears.get(joint, Gear())
            yield Compared(Quantity.GEAR, f"joint {joint}", "", values, (0.0,), Part.LOSSES), [gear]

    def _sensors(self, names: RobotVariables) -> Iterator[_Pair]:
        """Yield the readings of the sensors that measure motion or forces."""
        parents = {joint.name: joint.parent for joint in self.tree.joints}
        for sensor in self.tree.sensors:
            if sensor.kind == "imu":
                outputs = {"a": "m/s²", "w": "rad/s"}
                rows = [self.reference.acceleration(self.states[t], sensor, self.root) for t in COMPARED]
            elif sensor.kind == "force_torque":
                outputs = {"f": "N", "t": "N·m"}
                at = parents[sensor.at]
                rows = [self.reference.wrench(self.states[t], sensor, at, self.root) for t in COMPARED]
            else:
                continue
            for k, (output, unit) in enumerate(outputs.items()):
                values = tuple(f"{names.sensors[sensor.name]}.{output}[{i}]" for i in (1, 2, 3))
                compared = Compared(
                    Quantity.READING, f"sensor {sensor.name}", unit, values, COMPARED, Part.SENSORS, output
                )
                yield compared, [row[k] for row in rows]

    def _limits(self) -> Iterator[_Pair]:
        """Yield the warnings of each joint: 1 where it comes, at the instants where that is clear."""
        coordinates = self.reference.coordinates()
        for joint in self.tree.joints:
            if joint.type not in MOTION_KINDS:
                continue
            row, passed = coordinates[joint.name], dict[str, dict[float, bool]]()
            lower, upper = own_range(joint)
            speed = joint.limit.velocity if joint.limit else None
            effort = joint.limit.effort if joint.limit else None
            for time, state in self.states.items():
                q, v = float(state.positions[row]), abs(float(state.v[row]))
                tests = {
                    "is_below_its_lower_position_limit": (lower, q, -1.0),
                    "is_above_its_upper_position_limit": (upper, q, 1.0),
                    "is_faster_than_its_velocity_limit": (math.inf if speed is None else speed, v, 1.0),
                }
                if joint.name in self.reference.axes:
                    load = abs(float(self.solved[time].efforts[self.reference.axes.index(joint.name)]))
                    tests["is_driven_above_its_effort_limit"] = (math.inf if effort is None else effort, load, 1.0)
                for ending, (limit, value, sign) in tests.items():
                    if "position" in ending and not JOINT_KINDS[joint.type].has_limits:
                        continue
                    excess = sign * (value - limit)
                    if not abs(excess) < _CLEAR * max(1.0, abs(limit) if math.isfinite(limit) else 1.0):
                        passed.setdefault(ending, {})[time] = excess > 0
            for ending, flags in passed.items():
                variable = probe.limit_pattern(self.tree, joint, ending)
                detail = ending.replace("_", " ")
                compared = Compared(
                    Quantity.WARNING, f"joint {joint.name}", "", (variable,), tuple(flags), Part.LIMITS, detail
                )
                yield compared, [[float(flag)] for flag in flags.values()]

    def _ground(self) -> Iterator[_Pair]:
        """Yield the force on a base that holds a standing robot level: what the ground does not carry."""
        if self.stand is not None:
            forces = [self.stand.force(rise, slide) for *slide, rise in motion.ON_GROUND.values()]
            weight = np.array([0, 0, self.solved[float(Instant.STANDING)].force[2]])
            times = tuple(map(float, motion.ON_GROUND))
            compared = Compared(Quantity.GROUND, "robot", "N", FORCE, times, Part.CONTACTS)
            yield compared, [force - weight for force in forces]

    def _free(self, names: RobotVariables, name: str) -> Iterator[Trial]:
        """Yield the trial in which efforts are given, and accelerations follow, if they do."""
        is_free, reference, time = self.options.base == "floating", self.reference, (0.0,)
        courses = [probe.free_course(joint, self.starts[joint.name], k) for k, joint in enumerate(self.axes)]
        state = reference.free_state(courses, motion.FREE_START if is_free else {})
        reference.model.gravity.linear = np.array([0, 0, -motion.BENCH_GRAVITY])
        efforts = reference.solve(state).efforts
        gains = reference.free_gains(state, efforts, is_free)
        reference.model.gravity.linear = np.array([0, 0, -motion.GRAVITY])
        if gains is None:
            self.unchecked.append("free motion: some axis moves no mass, so that any acceleration goes with its effort")
            return
        pairs = list(self._poses(names, [reference.solve(state)], time, Part.FREE_MOTION))
        rows = reference.coordinates()
        for k, joint in enumerate(self.axes, 1):
            unit = "rad/s²" if MOTION_KINDS[joint.type] == "rotational" else "m/s²"
            compared = Compared(
                Quantity.ACCELERATION, f"joint {joint.name}", unit, (f"push{k}.a",), time, Part.FREE_MOTION
            )
            pairs.append((compared, [[float(gains[rows[joint.name]])]]))
        if is_free:
            gained = tuple(f"base.freeMotion.a_rel_a[{i}]" for i in (1, 2, 3))
            root = f"link {self.tree.links[0].name}"
            compared = Compared(Quantity.ACCELERATION, root, "m/s²", gained, time, Part.FREE_MOTION)
            pairs.append((compared, [reference.base_gain(state, gains)]))
        table = _table(pairs, [0.0])
        values = [value for compared, _ in pairs for value in compared.values]
        pushed = [float(effort) for effort in efforts]
        free = probe.free_probe(self.tree, self.target, self.options, names, courses, pushed, values)
        yield Trial(name, free, *table)


def _table(pairs: Iterable[_Pair], times: Sequence[float]) -> tuple[tuple[Compared, ...], dict[str, tuple[float, ...]]]:
    """Return what is compared, and the expected numbers at all times, NaN where there is none."""
    every, numbers = list[Compared](), dict[str, dict[float, float]]()
    for compared, rows in pairs:
        every.append(compared)
        for time, row in zip(compared.instants, rows, strict=True):
            for value, number in zip(compared.values, row, strict=True):
                numbers.setdefault(value, {})[time] = float(number)
    series = {value: tuple(own.get(time, math.nan) for time in times) for value, own in numbers.items()}
    return tuple(every), {"time": tuple(times), **series}


def _simplified(tree: KinematicTree, options: Options) -> Iterator[str]:
    """Yield the laws of joints that the package which is compared does not have."""
    driven = driven_joints(tree.joints, options)
    drives = [joint for joint in tree.joints if joint.name in driven]
    joints = {
        **{law: [j.name for j in tree.joints if friction_law(j, options) == law] for law in ("stiction", "lugre")},
        "elastic": [joint.name for joint in drives if is_chosen(joint, options.elastic)],
        "saturated": [joint.name for joint in drives if is_chosen(joint, options.saturated)],
    }
    for law, names in joints.items():
        if names:
            part, plain = ("drive", "rigid") if law in ("elastic", "saturated") else ("friction", "smooth")
            who = ", ".join(names) if len(names) <= 3 else f"{len(names)} joints"
            yield f"{part} of {who} ({law}): the package that is compared has a {plain} one"


def _not_compared(options: Options, axes: int) -> Iterator[str]:
    """Yield what is not compared."""
    yield "shapes (they change no motion), the motion of benches, and models around the robot (they are only compiled)"
    if axes > _MOST_AXES:
        yield f"free motion of more than {_MOST_AXES} axes, which takes a compiler too much memory"
    if "record" in options.approach:
        yield "limits, sensors and contacts of the generic robot"


def _robot(reading: RobotReading) -> Robot:
    if reading.robot is None:
        raise SourceError(*reading.diagnostics)
    return reading.robot
