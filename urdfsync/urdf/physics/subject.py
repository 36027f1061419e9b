"""A robot in Pinocchio, and its motion."""

from __future__ import annotations

import contextlib
import itertools
import math
from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Polynomial

from urdfsync.domain import Import
from urdfsync.domain.experiment import Sample
from urdfsync.urdf.assembly import Assembly
from urdfsync.urdf.drives import sharing_joint
from urdfsync.urdf.kinematics.poses import position_ranges, start_positions
from urdfsync.urdf.physics import contacts, motion
from urdfsync.urdf.physics.closing import OpenLoopError
from urdfsync.urdf.physics.motion import COMPARED, LOADS, Course, Instant
from urdfsync.urdf.physics.reference import Configuration, Reference, Solution, read
from urdfsync.urdf.robot import MOTION_KINDS, Joint, Robot
from urdfsync.urdf.second.companions import read_companions
from urdfsync.urdf.second.reading import SecondReading, read_again

_MARGIN = 0.9
"""Fraction of ranges and speeds that Test uses."""
_REACH = {"rotational": 1.0, "translational": 0.1}
"""In rad or m: the longest motion of an axis in Test, unless loops allow less."""
_SHARES = tuple(0.25**k for k in range(8))


class Sweep(NamedTuple):
    """The motion of an axis in Test."""

    numbers: tuple[float, float, float, float, float]
    """Start, range, greatest speed and reach. All followers of the axis allow this range and speed."""
    end: float
    """The turning point."""


class Subject:
    """A robot at all instants of the comparison."""

    def __init__(self, sample: Sample, robot: Robot) -> None:
        assembly = Assembly(robot, sample.options, sample.target)
        self.tree, self.closed, self.connectors = assembly.tree, assembly.closed, assembly.connectors
        self.target, self.options = sample.target, assembly.options
        self.sample, self.texts, tree = sample, sample.texts, self.tree
        driven = (joint for joint in motion.driven_axes(tree) if joint.name not in self.closed.dependent)
        self.balls = tuple(joint for joint in tree.joints if joint.type == "ball")
        self.axes = (*driven, *self.balls)
        sensed = {sensor.at for sensor in tree.sensors if sensor.is_in_joint}
        names = [joint.name for joint in self.axes]
        rows = read_companions(sample.companions, sample.options).rows
        self.reference = Reference(read(sample.content, sample.file, sensed, rows), names, self.closed)
        self.base = motion.base_courses()
        self.stand: contacts.Stand | None = None
        self.unchecked = dict[str, None]()
        """The parts of this robot that are not compared."""
        self.starts = start_positions(tree)
        self.share = self._closable_share()
        """Amplitude of joints in loops, as a fraction of the usual amplitude."""
        limits = [joint.limit.effort if joint.limit and joint.limit.effort else math.inf for joint in self.axes]
        courses, strains = self._courses(self.share), dict[Instant, dict[str, float]]()
        # no load acts on joints in loops: a large acceleration may open the loop
        outside = [n for n, joint in enumerate(self.axes) if not self.is_in_loop(joint)]
        for instant, share in LOADS.items():
            state = self._state(instant, courses)
            holding = self.reference.solve(state).efforts
            more = [share * limits[n] - holding[n] if limits[n] < motion.ENDLESS else 0.0 for n in outside]
            gains = self.reference.effort_gains(state, np.array(more), outside)
            strains[instant] = {self.axes[n].name: float(gain) for n, gain in zip(outside, gains, strict=True)}
        self.courses = self._courses(self.share, strains)
        if self.options.base == "floating" and "package" in self.options.approach:
            self._put_down(sample.imports)
        self.states = {float(instant): self._state(instant, self.courses) for instant in Instant}
        self.solved = {time: self.reference.solve(state) for time, state in self.states.items()}

    @cached_property
    def second(self) -> SecondReading:
        """The second reading of the source."""
        return read_again(self.sample.content, self.options, *self.sample.companions)

    @cached_property
    def checked_by_robot(self) -> Collection[str]:
        """The joints whose effort the robot model checks: leaders, and joints that share a motor."""
        checked = {*self.tree.followers_by_leader()}
        for joint in self.tree.joints:
            if other := sharing_joint(joint, self.options.drives):
                checked |= {joint.name, other}
        return checked

    @cached_property
    def motor_torques(self) -> Mapping[str, float]:
        """The torque of each motor with a flange, by joint.

        The torque is half of the joint's limit of effort. The check of the limit has to add it to the effort of the
        drive.
        """
        torques, axes = dict[str, float](), {joint.name for joint in self.axes}
        for name, drive in self.connectors.drives.items():
            # a motor at a dependent joint of a loop would also push the axes
            if drive.motor and {name, drive.other or name} <= axes:
                joint = self.second.joints[name]
                effort = joint.number("limits.effort")
                part = 0.5 * (effort if effort < motion.ENDLESS else 1.0)
                torques[name] = -part / joint.number("transmission.reduction")
        return torques

    def pushed_by_motors(self, name: str) -> float:
        """Return the effort of all motors on a joint: see `motor_torques`."""
        joints, effort = self.second.joints, 0.0
        for motor, torque in self.motor_torques.items():
            effort += torque * joints[motor].number("transmission.reduction") * (motor == name)
            if joints[motor].shares == name:
                effort += torque * joints[motor].number("transmission.otherReduction")
        return effort

    @cached_property
    def sweeps(self) -> Sequence[tuple[Joint, Sweep]]:
        """Each axis with its motion in Test, towards the farther limit, as far as reach and speed allow."""
        ranges, followers = position_ranges(self.tree), self.tree.followers_by_leader()

        def speed(joint: Joint) -> float:
            own = joint.limit.velocity if joint.limit and joint.limit.velocity is not None else math.inf
            others = followers.get(joint.name, ())
            return min(own, *(speed(f) / abs(m.multiplier) for f, m in others if abs(m.multiplier) > math.ulp(1)), own)

        found = list[tuple[Joint, Sweep]]()
        for joint in self.axes:
            if joint.type in MOTION_KINDS:
                start, (lower, upper) = self.starts[joint.name], ranges[joint.name]
                reach = self.closed.reach.get(joint.name, _REACH[MOTION_KINDS[joint.type]])
                # the axis moves along a cosine: its greatest speed is pi/period times the distance
                most = min(reach, _MARGIN * speed(joint) * motion.PERIOD / math.pi)
                above, below = (min(most, _MARGIN * room) for room in (upper - start, start - lower))
                end = start + above if above >= below else start - below
                found.append((joint, Sweep((start, lower, upper, speed(joint), reach), end)))
        return found

    def is_in_loop(self, joint: Joint) -> bool:
        """Return whether loops restrict the motion of a joint."""
        return joint.name in self.closed.joints

    def _closable_share(self) -> float:
        """Return the greatest share of the amplitudes that keeps all loops closed around each instant.

        Raises OpenLoopError if no share does.
        """
        if not self.closed.joints:
            return 1.0
        for share in _SHARES:
            with contextlib.suppress(OpenLoopError):
                for instant, ahead in itertools.product(COMPARED, (-0.5, 0.0, 0.5)):
                    self.reference.state([course[int(instant)].ahead(ahead) for course in self._courses(share)])
                return share
        raise OpenLoopError

    def _courses(self, share: float, strains: Mapping[Instant, Mapping[str, float]] = {}) -> list[tuple[Course, ...]]:
        """Return the courses of all axes; `strains` are accelerations under load."""
        courses = list[tuple[Course, ...]]()
        for joint in self.axes:
            start = self.starts[joint.name]
            if self.is_in_loop(joint):
                courses.append(motion.loop_courses(joint, start, share))
            else:
                loads = {instant: gains[joint.name] for instant, gains in strains.items()}
                courses.append(motion.axis_courses(joint, start, loads))
        return courses

    def _state(self, instant: Instant, courses: Sequence[Sequence[Course]]) -> Configuration:
        return self.reference.state([course[instant] for course in courses], [c[instant] for c in self.base])

    def solve_at(self, time: float) -> Solution:
        """Return the expected values at any time of the motion in `parts.mo`. Raises OpenLoopError."""
        second = math.floor(time)

        def at(courses: Sequence[Course]) -> Course:
            way = Polynomial(courses[second].way_to(courses[second + 1]))
            return Course(*(way.deriv(order)(time - second) for order in range(3)))

        return self.reference.solve(self.reference.state([*map(at, self.courses)], [*map(at, self.base)]))

    def _put_down(self, imports: Mapping[str, Import]) -> None:
        """Put the robot on the ground, if one of its shapes can touch the ground."""
        mass, _ = self.reference.solve(self._state(Instant.STANDING, self.courses)).mass_and_centre()
        self.stand = contacts.stand(self.tree, imports, mass * motion.GRAVITY)
        if self.stand is None:
            self.unchecked["contacts and the first height, since no shape of the robot touches the ground"] = None
        else:
            self.base = motion.base_courses(self.stand.depth)
