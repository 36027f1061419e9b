"""A robot in Pinocchio, and the motion that it is put through."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from xml.etree.ElementTree import Element

import numpy as np

from urdfsync.domain import Import, Target
from urdfsync.urdf.kinematics.poses import start_positions
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.parse import xml
from urdfsync.urdf.physics import contacts, motion
from urdfsync.urdf.physics.motion import LOADS, Course, Instant
from urdfsync.urdf.physics.reference import Array, Configuration, Reference, read


class Subject:
    """A robot at all instants of the comparison."""

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
        self.base = motion.base_courses()
        self.stand: contacts.Stand | None = None
        self.unchecked = dict[str, None]()
        """What is not compared of this robot, in order."""
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
        return self.reference.state([course[instant] for course in courses], [c[instant] for c in self.base])

    def _put_down(self, imports: Mapping[str, Import]) -> None:
        """Put the robot on the ground, if it can be."""
        mass, _ = self.reference.solve(self._state(Instant.STANDING, self.courses)).mass_and_centre()
        self.stand = contacts.stand(self.tree, imports, mass * motion.GRAVITY)
        if self.stand is None:
            self.unchecked["contacts, and the height at the beginning: no shape of the robot touches the ground"] = None
        else:
            self.base = motion.base_courses(self.stand.depth)
