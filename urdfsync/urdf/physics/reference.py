"""The reference: poses, efforts and accelerations of a robot by Pinocchio, at prescribed and free motion.

Notation as in Featherstone, Rigid Body Dynamics Algorithms (2008): efforts of prescribed motion by the recursive
Newton-Euler algorithm (RNEA, section 5.3), the inertia matrix H by the composite-rigid-body algorithm (CRBA,
section 6.2), and both together as hybrid dynamics (section 9.2), in which base and axes move as prescribed, and free
joints without any effort but their losses. Joints that mimic others enter through q = B·p + c with the positions p
of the driven axes, so that the efforts of these are Bᵀ·tau.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import msgspec
import numpy as np

from urdfsync.urdf.physics import motion
from urdfsync.urdf.physics.motion import Course, Floating, Start
from urdfsync.urdf.physics.reading import Array, PinocchioRobot, SplitJoint, pinocchio

TURNING_STEEPNESS, SLIDING_STEEPNESS = 100, 1000
"""In s/rad and s/m: the dry friction of generated joints is f·tanh(s·v/2)."""

_SLIDING_JOINTS = ("JointModelPX", "JointModelPY", "JointModelPZ", "JointModelPrismatic")  # Pinocchio's names

_SINGULAR = 1e-12  # ratio of the least to the greatest eigenvalue of an inertia


class Configuration(msgspec.Struct, frozen=True):
    """Pinocchio's configuration, velocity and acceleration; those of free joints may be unknown yet."""

    q: Array
    v: Array
    a: Array


class FrameMotion(NamedTuple):
    """How a frame moves in another one, such as the world or the frame of a joint; all resolved in the other one."""

    place: Array
    axes: Array
    """The axes of the frame as columns."""
    velocity: Array
    turning: Array
    """Angular velocity."""


class Reference:
    """A robot in Pinocchio; `axes` are the names of its driven joints, `free` those of joints that nothing drives.

    Free joints are named from the root to the leaves.
    """

    def __init__(self, robot: PinocchioRobot, axes: Sequence[str], free: Sequence[str]) -> None:
        self.pin, self.model, self._split = pinocchio(), robot.model, robot.split_joints
        self.model.gravity.linear = np.array([0, 0, -motion.GRAVITY])
        self.axes = tuple(axes)
        self.projection, self._offset = self._mimic(robot, free)
        self._parts: dict[str, list[Any]] = {}  # by free joint: those of Pinocchio's joints that stand for it
        for name in free:
            names = self._split[name].parts if name in self._split else (name,)
            self._parts[name] = [self.model.joints[self.model.getJointId(part)] for part in names]
        parts = [part for parts in self._parts.values() for part in parts]
        self.loose = np.array([part.idx_v + k for part in parts for k in range(part.nv)], dtype=int)
        """Where free joints are in Pinocchio's velocity."""
        self.steepness = np.full(self.model.nv, float(TURNING_STEEPNESS))
        """Of the dry friction, for each coordinate of Pinocchio's velocity; in s/rad or s/m, as in the records."""
        for joint in self.model.joints:
            if joint.shortname().startswith(_SLIDING_JOINTS):
                self.steepness[joint.idx_v] = SLIDING_STEEPNESS

    def start(self, name: str, start: Start) -> FrameMotion:
        """Return how a free joint begins, in the joint frame."""
        split = self._split.get(name)
        if isinstance(start, Floating) or split is None:
            r, rpy, v, w = map(np.array, start)
            return FrameMotion(r, self.pin.rpy.rpyToMatrix(*rpy), v, w)
        x, y, normal = split.axes
        place, velocity = (part[0] * x + part[1] * y for part in (start.s, start.v))
        return FrameMotion(place, self.pin.exp3(start.phi * normal), velocity, start.w * normal)

    def state(
        self, time: float, courses: Sequence[Course], free: Mapping[str, FrameMotion], *, in_world: bool = False
    ) -> Configuration:
        """Return where the robot is, `courses` being those of the axes from time 0; accelerations of free joints are 0.

        `free` has the frames of their children in the joint frames, or in the world.
        """
        pin, model = self.pin, self.model
        p, speeds, gains = np.array([course.at(time) for course in courses]).reshape(-1, 3).T
        q = pin.integrate(model, pin.neutral(model), self.projection @ p + self._offset)
        state = Configuration(q, self.projection @ speeds, self.projection @ gains)
        # Pinocchio resolves velocity and acceleration of the root link in its own frame.
        place, velocity, acceleration = np.array([course.at(time) for course in motion.PATH]).T
        angle, speed, gain = motion.TURN.at(time)
        axis = np.array(motion.TURN_AXIS)
        inward = pin.exp3(angle * axis).T
        _put(state.q, 0, (*place, *pin.Quaternion(inward.T).coeffs()))
        _put(state.v, 0, (*inward @ velocity, *speed * axis))
        _put(state.a, 0, (*inward @ acceleration - np.cross(speed * axis, inward @ velocity), *gain * axis))
        for name, parts in self._parts.items():
            frame = self._in_joint(state, name, free[name]) if in_world else free[name]
            found = _coordinates(pin, frame, self._split.get(name))
            for part, (q, v) in zip(parts, found, strict=True):
                _put(state.q, part.idx_q, q)
                _put(state.v, part.idx_v, v)
        return state

    def solve(self, state: Configuration) -> Instant:
        """Return efforts of base and axes, and accelerations of free joints."""
        pin, data, a = self.pin, self.model.createData(), state.a.copy()
        losses = self.losses(state.v)
        load = pin.rnea(self.model, data, state.q, state.v, a) + losses
        if self.loose.size:
            a[self.loose] = np.linalg.solve(self._free_inertia(state), -load[self.loose])
            load = pin.rnea(self.model, data, state.q, state.v, a) + losses
        pin.forwardKinematics(self.model, data, state.q, state.v, a)
        pin.updateFramePlacements(self.model, data)
        return Instant(self, data, load[:3], load[3:6], self.projection.T @ load)

    def losses(self, v: Array) -> Array:
        """Return efforts of damping and dry friction at velocity v."""
        return np.asarray(self.model.damping * v + self.model.friction * np.tanh(self.steepness * v / 2))

    def is_singular(self, state: Configuration) -> bool:
        """Return whether free joints carry so little inertia that their accelerations have no solution."""
        values = np.linalg.eigvalsh(self._free_inertia(state))
        return bool(values.size and values[0] <= _SINGULAR * values[-1])

    def _free_inertia(self, state: Configuration) -> Array:
        """Return the part of the inertia matrix H that belongs to the free joints."""
        upper = np.triu(self.pin.crba(self.model, self.model.createData(), state.q))
        inertia = upper + np.triu(upper, 1).T
        return np.asarray(inertia[np.ix_(self.loose, self.loose)])

    def _mimic(self, robot: PinocchioRobot, free: Sequence[str]) -> tuple[Array, Array]:
        """Return B and c of q = B·p + c: a row per coordinate of Pinocchio's velocity, a column per driven axis."""
        scalar = set(self.model.names) - set(free)
        projection, offset = np.zeros((self.model.nv, len(self.axes))), np.zeros(self.model.nv)
        for name, joint in zip(self.model.names, self.model.joints, strict=True):
            factor, leader = 1.0, name
            while leader in scalar and leader in robot.followers:
                follower = robot.followers[leader]
                offset[joint.idx_v] += factor * follower.offset
                factor, leader = factor * follower.multiplier, follower.joint
            if leader in self.axes:
                projection[joint.idx_v, self.axes.index(leader)] = factor
        return projection, offset

    def _in_joint(self, state: Configuration, name: str, frame: FrameMotion) -> FrameMotion:
        """Return in the frame of a free joint how its child moves in the world; all joints before it are in place."""
        first = self._parts[name][0].id
        data, parent, placement = self.model.createData(), self.model.parents[first], self.model.jointPlacements[first]
        self.pin.forwardKinematics(self.model, data, state.q, state.v)
        joint, moves = data.oMi[parent] * placement, placement.actInv(data.v[parent])
        inward = joint.rotation.T
        place = inward @ (frame.place - joint.translation)
        velocity = inward @ frame.velocity - moves.linear - np.cross(moves.angular, place)
        return FrameMotion(place, inward @ frame.axes, velocity, inward @ frame.turning - moves.angular)


class Instant(msgspec.Struct, frozen=True):
    """What the reference says of a robot at one instant."""

    reference: Reference
    data: Any
    """Pinocchio's, with positions, velocities and accelerations of all frames."""
    force: Array
    """On the root link, in its frame."""
    torque: Array
    efforts: Array
    """Of the driven axes."""

    def frame(self, link: str) -> FrameMotion:
        """Return how the frame of a link moves in the world."""
        pin, model = self.reference.pin, self.reference.model
        number = model.getFrameId(link, pin.BODY)
        place, moves = self.data.oMf[number], pin.getFrameVelocity(model, self.data, number, pin.LOCAL_WORLD_ALIGNED)
        return FrameMotion(np.array(place.translation), np.array(place.rotation), moves.linear, moves.angular)

    def acceleration(self, link: str) -> tuple[Array, Array]:
        """Return that of a link's frame: the linear one resolved in the world, the angular one in the frame."""
        pin, model = self.reference.pin, self.reference.model
        number = model.getFrameId(link, pin.BODY)
        found = pin.getFrameClassicalAcceleration(model, self.data, number, pin.LOCAL_WORLD_ALIGNED)
        return found.linear, self.data.oMf[number].rotation.T @ found.angular

    def mass_and_centre(self) -> tuple[float, Array]:
        """Return mass of the whole robot and its centre in the world; zero without any mass."""
        pin, model = self.reference.pin, self.reference.model
        mass = pin.computeTotalMass(model)
        return mass, np.array(pin.centerOfMass(model, self.data, pin.POSITION)) if mass else np.zeros(3)


def _coordinates(pin: Any, frame: FrameMotion, split: SplitJoint | None) -> Sequence[tuple[Sequence[float], ...]]:
    """Return q and v of each joint of Pinocchio that stands for a free one; `frame` is its child in the joint frame."""
    place, axes, velocity, turning = frame
    if split is None:
        attitude = pin.Quaternion(axes).normalized().coeffs()
        return [((*place, *attitude), (*axes.T @ velocity, *axes.T @ turning))]
    x, y, normal = split.axes
    cosine, sine = x @ axes @ x, y @ axes @ x
    turn = np.array([cosine, sine]) / np.hypot(cosine, sine)
    slides = [((x @ place,), (x @ velocity,)), ((y @ place,), (y @ velocity,))]
    return [*slides, (tuple(turn), (normal @ turning,))]


def _put(vector: Array, first: int, values: Sequence[float] | Array) -> None:
    vector[first : first + len(values)] = values
