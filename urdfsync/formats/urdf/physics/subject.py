"""A robot in the reference, and its motion."""

from __future__ import annotations

import contextlib
import itertools
import math
from collections.abc import Sequence
from functools import cached_property

from numpy.polynomial import Polynomial

from urdfsync.domain.experiment import Sample
from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.kinematics.poses import start_positions
from urdfsync.formats.urdf.physics import motion
from urdfsync.formats.urdf.physics.closing import OpenLoopError
from urdfsync.formats.urdf.physics.motion import COMPARED, Course, Instant
from urdfsync.formats.urdf.physics.reference import Configuration, Reference, Solution, read
from urdfsync.formats.urdf.robot import Joint, Robot
from urdfsync.formats.urdf.second.companions import read_companions
from urdfsync.formats.urdf.second.reading import SecondReading, read_again

_SHARES = tuple(0.25**k for k in range(8))


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
        self.unchecked = dict[str, None]()
        """The parts of this robot that are not compared."""
        self.starts = start_positions(tree)
        self.share = self._closable_share()
        """Amplitude of joints in loops, as a fraction of the usual amplitude."""
        self.courses = self._courses(self.share)
        self.states = {float(instant): self._state(instant) for instant in Instant}
        self.solved = {time: self.reference.solve(state) for time, state in self.states.items()}

    @cached_property
    def second(self) -> SecondReading:
        """The second reading of the source."""
        return read_again(self.sample.content, self.options, *self.sample.companions)

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

    def _courses(self, share: float) -> list[tuple[Course, ...]]:
        """Return the courses of all axes; those of joints in loops have a `share` of the usual amplitude."""
        return [
            motion.axis_courses(joint, self.starts[joint.name], share if self.is_in_loop(joint) else 1.0)
            for joint in self.axes
        ]

    def _state(self, instant: Instant) -> Configuration:
        return self.reference.state([course[instant] for course in self.courses], [c[instant] for c in self.base])

    def solve_at(self, time: float) -> Solution:
        """Return the expected values at any time of the motion in `parts.mo`. Raises OpenLoopError."""
        second = math.floor(time)

        def at(courses: Sequence[Course]) -> Course:
            way = Polynomial(motion.ways(courses)[second])
            return Course(*(way.deriv(order)(time - second) for order in range(3)))

        return self.reference.solve(self.reference.state([*map(at, self.courses)], [*map(at, self.base)]))
