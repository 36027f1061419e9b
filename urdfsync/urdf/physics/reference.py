"""The reference: poses and efforts of a robot by Pinocchio, at prescribed motion.

Pinocchio reads the file by itself. Only the parts that its reader leaves out are added here: `mimic` elements, and the
inertia that drives add to joints.

Notation as in Featherstone, Rigid Body Dynamics Algorithms (2008): efforts by the recursive Newton-Euler algorithm
(RNEA, section 5.3). Joints that mimic others enter through q = B·p + c with the positions p of the driven axes. The
efforts of these are Bᵀ·tau.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import msgspec
import numpy as np
from numpy.typing import NDArray

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.extras import install_command
from urdfsync.urdf.parse import xml
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.physics import motion
from urdfsync.urdf.physics.motion import Course
from urdfsync.urdf.robot import Mimic, effective, reflected_inertia

Array = NDArray[np.float64]

TURNING_STEEPNESS, SLIDING_STEEPNESS = 100, 1000
"""Steepness s of the dry friction f·tanh(s·v/2) of generated joints, in s/rad and s/m."""

_SLIDING_JOINTS = ("JointModelPX", "JointModelPY", "JointModelPZ", "JointModelPrismatic")  # Pinocchio's names


class PinocchioRobot(NamedTuple):
    """A robot as Pinocchio reads it, with the mimic relations that its reader leaves out."""

    model: Any
    """Pinocchio's model; its first joint is the free motion of the root link."""
    followers: Mapping[str, Mimic]
    """Mimic relation of each follower, by the names of joints."""


def read(content: bytes, file: str) -> PinocchioRobot:
    """Read a URDF with Pinocchio. Raises SourceError if Pinocchio is not installed or refuses the file."""
    pin = pinocchio()
    root = xml.parse(content).root
    followers = {
        joint.get("name", ""): Mimic(
            mimic.get("joint", ""), float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))
        )
        for joint in root.findall("joint")
        for mimic in joint.findall("mimic")
    }
    # the name of the root's joint in Pinocchio, which no element has
    unused = "_" * (1 + max(len(element.get("name", "")) for element in root.iter()))
    try:
        model = pin.buildModelFromXML(content.decode("utf-8-sig"), pin.JointModelFreeFlyer(), unused)
    except (ValueError, RuntimeError) as error:
        message = f"Pinocchio can't read this file: {str(error).rstrip('.')}"
        hint = "correct the file, or check without --physics"
        raise SourceError(Diagnostic(Severity.ERROR, "pinocchio-refuses", message, file, hint=hint)) from error
    robot = read_robot(content, file).robot
    for joint in map(effective, robot.joints if robot else ()):
        if inertia := reflected_inertia(joint):
            model.armature[model.joints[model.getJointId(joint.name)].idx_v] = inertia
    return PinocchioRobot(model, followers)


def pinocchio() -> Any:
    """Return the library. Raises SourceError if it is not installed."""
    try:
        import pinocchio  # an optional extra
    except ImportError:
        message = "Pinocchio, the reference for physics, is not installed"
        hint = install_command("physics")
        raise SourceError(Diagnostic(Severity.ERROR, "no-pinocchio", message, hint=hint)) from None
    return pinocchio


class Configuration(msgspec.Struct, frozen=True):
    """Pinocchio's configuration, velocity and acceleration."""

    q: Array
    v: Array
    a: Array


class Reference:
    """A robot in Pinocchio; `axes` are the names of its driven joints."""

    def __init__(self, robot: PinocchioRobot, axes: Sequence[str]) -> None:
        self.pin, self.model = pinocchio(), robot.model
        self.model.gravity.linear = np.array([0, 0, -motion.GRAVITY])
        self.axes = tuple(axes)
        self.projection, self._offset = self._mimic(robot)
        self.steepness = np.full(self.model.nv, float(TURNING_STEEPNESS))
        """Steepness of dry friction for each coordinate of Pinocchio's velocity, in s/rad or s/m as in the records."""
        for joint in self.model.joints:
            if joint.shortname().startswith(_SLIDING_JOINTS):
                self.steepness[joint.idx_v] = SLIDING_STEEPNESS

    def state(self, time: float, courses: Sequence[Course]) -> Configuration:
        """Return the configuration at a time; `courses` are those of the axes from time 0."""
        pin, model = self.pin, self.model
        p, speeds, gains = np.array([course.at(time) for course in courses]).reshape(-1, 3).T
        q = pin.integrate(model, pin.neutral(model), self.projection @ p + self._offset)
        state = Configuration(q, self.projection @ speeds, self.projection @ gains)
        # Pinocchio resolves velocity and acceleration of the root link in its own frame.
        place, velocity, acceleration = np.array([course.at(time) for course in motion.PATH]).T
        angle, speed, gain = motion.TURN.at(time)
        axis = np.array(motion.TURN_AXIS)
        inward = pin.exp3(angle * axis).T
        state.q[:7] = *place, *pin.Quaternion(inward.T).coeffs()
        state.v[:6] = *inward @ velocity, *speed * axis
        state.a[:6] = *inward @ acceleration - np.cross(speed * axis, inward @ velocity), *gain * axis
        return state

    def solve(self, state: Configuration) -> Instant:
        """Return poses, and the efforts of base and axes."""
        pin, data = self.pin, self.model.createData()
        load = pin.rnea(self.model, data, state.q, state.v, state.a) + self.losses(state.v)
        pin.framesForwardKinematics(self.model, data, state.q)
        return Instant(self, data, state.q, load[:3], load[3:6], self.projection.T @ load)

    def losses(self, v: Array) -> Array:
        """Return efforts of damping and dry friction at velocity v."""
        return np.asarray(self.model.damping * v + self.model.friction * np.tanh(self.steepness * v / 2))

    def _mimic(self, robot: PinocchioRobot) -> tuple[Array, Array]:
        """Return B and c of q = B·p + c: a row per coordinate of Pinocchio's velocity, a column per driven axis."""
        projection, offset = np.zeros((self.model.nv, len(self.axes))), np.zeros(self.model.nv)
        names = set(self.model.names)
        for name, joint in zip(self.model.names, self.model.joints, strict=True):
            factor, leader = 1.0, name
            while leader in names and leader in robot.followers:
                follower = robot.followers[leader]
                offset[joint.idx_v] += factor * follower.offset
                factor, leader = factor * follower.multiplier, follower.joint
            if leader in self.axes:
                projection[joint.idx_v, self.axes.index(leader)] = factor
        return projection, offset


class Instant(msgspec.Struct, frozen=True):
    """Poses and efforts of a robot at one instant, by the reference."""

    reference: Reference
    data: Any
    """Pinocchio's data, with the poses of all frames."""
    q: Array
    force: Array
    """Force on the root link, in its frame."""
    torque: Array
    efforts: Array
    """Efforts of the driven axes."""

    def frame(self, link: str) -> tuple[Array, Array]:
        """Return place and axes (as columns) of a link's frame in the world."""
        pin, model = self.reference.pin, self.reference.model
        place = self.data.oMf[model.getFrameId(link, pin.BODY)]
        return np.array(place.translation), np.array(place.rotation)

    def mass_and_centre(self) -> tuple[float, Array]:
        """Return mass of the whole robot and its centre in the world; zero without any mass."""
        pin, model = self.reference.pin, self.reference.model
        mass = pin.computeTotalMass(model)
        return mass, np.array(pin.centerOfMass(model, self.data, self.q)) if mass else np.zeros(3)
