"""The reference: poses, efforts and accelerations of a robot by Pinocchio, at prescribed and free motion.

Notation as in Featherstone, Rigid Body Dynamics Algorithms (2008): efforts of prescribed motion by the recursive
Newton-Euler algorithm (RNEA, section 5.3), the inertia matrix H by the composite-rigid-body algorithm (CRBA,
section 6.2), and both together as hybrid dynamics (section 9.2), in which base and axes move as prescribed, and free
joints without any effort but their losses. Joints that mimic others enter through q = B·p + c with the positions p
of the driven axes, so that the efforts of these are Bᵀ·tau.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import msgspec
import numpy as np

from urdfsync.urdf.physics import free_joints, motion
from urdfsync.urdf.physics.free_joints import Array, FreeJointState, Start
from urdfsync.urdf.physics.motion import Course
from urdfsync.urdf.physics.reading import PinocchioRobot, pinocchio

TURNING_STEEPNESS, SLIDING_STEEPNESS = 100, 1000
"""In s/rad and s/m: the dry friction of generated joints is f·tanh(s·v/2)."""

_SLIDING_JOINTS = ("JointModelPX", "JointModelPY", "JointModelPZ", "JointModelPrismatic")  # Pinocchio's names

_SINGULAR = 1e-12  # ratio of the least to the greatest eigenvalue of an inertia


class FrameMotion(msgspec.Struct, frozen=True):
    """A link's frame as it moves in the world."""

    place: Array
    axes: Array
    """The axes of the frame as columns."""
    velocity: Array
    """Resolved in the world."""
    turning: Array
    """Angular velocity, resolved in the link's frame."""


class Configuration(msgspec.Struct, frozen=True):
    """Pinocchio's configuration, velocity and acceleration; those of free joints may be unknown yet."""

    q: Array
    v: Array
    a: Array


class Reference:
    """A robot in Pinocchio; `axes` are the names of its driven joints, `free` those of joints that nothing drives.

    Free joints are named from the root to the leaves.
    """

    def __init__(self, robot: PinocchioRobot, axes: Sequence[str], free: Sequence[str]) -> None:
        self.pin = pinocchio()
        self.model, self._split_joints = robot.model, robot.split_joints
        self.model.gravity.linear = np.array([0, 0, -motion.GRAVITY])
        self.axes, self.free = tuple(axes), tuple(free)
        self.projection, self._offset = self._mimic(robot)
        loose = [np.arange(part.idx_v, part.idx_v + part.nv) for name in free for part in self._parts(name)]
        self.loose = np.concatenate([np.zeros(0, dtype=int), *loose])
        """Where free joints are in Pinocchio's velocity."""
        self.steepness = np.full(self.model.nv, float(TURNING_STEEPNESS))
        """Of the dry friction, for each coordinate of Pinocchio's velocity; in s/rad or s/m, as in the records."""
        for joint in self.model.joints:
            if joint.shortname().startswith(_SLIDING_JOINTS):
                self.steepness[joint.idx_v] = SLIDING_STEEPNESS

    def start(self, name: str, start: Start) -> FreeJointState:
        """The state of a free joint from its start values."""
        return free_joints.start_state(self.pin, start, self._split_axes(name))

    def state(
        self, time: float, courses: Sequence[Course], free: Mapping[str, FreeJointState | FrameMotion]
    ) -> Configuration:
        """Where the robot is, `courses` being those of the axes from time 0; accelerations of free joints are 0."""
        p, v, a = np.array([course.at(time) for course in courses]).reshape(-1, 3).T
        positions = self.projection @ p + self._offset
        state = Configuration(self.pin.neutral(self.model), self.projection @ v, self.projection @ a)
        for joint in self.model.joints[2:]:
            if joint.nv == 1:
                position = positions[joint.idx_v]
                turns = joint.nq == 2  # continuous: cosine and sine
                state.q[_slice(joint)] = (np.cos(position), np.sin(position)) if turns else position
        _place_base(self.pin, state, time)
        for name in self.free:
            known = free[name]
            self._place(state, name, known if isinstance(known, FreeJointState) else self._relative(state, name, known))
        return state

    def solve(self, state: Configuration) -> Instant:
        """Efforts of base and axes, and accelerations of free joints."""
        data, a = self.model.createData(), state.a.copy()
        load = self._load(data, state.q, state.v, a)
        if self.loose.size:
            a[self.loose] = np.linalg.solve(self.free_inertia(state), -load[self.loose])
            load = self._load(data, state.q, state.v, a)
        self.pin.forwardKinematics(self.model, data, state.q, state.v, a)
        self.pin.updateFramePlacements(self.model, data)
        return Instant(self, data, load[:3], load[3:6], self.projection.T @ load)

    def losses(self, v: Array) -> Array:
        """Efforts of damping and dry friction at velocity v."""
        return np.asarray(self.model.damping * v + self.model.friction * np.tanh(self.steepness * v / 2))

    def is_singular(self, state: Configuration) -> bool:
        """Whether free joints carry so little inertia that their accelerations have no solution."""
        values = np.linalg.eigvalsh(self.free_inertia(state))
        return bool(values.size and values[0] <= _SINGULAR * values[-1])

    def free_inertia(self, state: Configuration) -> Array:
        """The part of the inertia matrix H that belongs to the free joints."""
        upper = np.triu(self.pin.crba(self.model, self.model.createData(), state.q))
        inertia = upper + np.triu(upper, 1).T
        return np.asarray(inertia[np.ix_(self.loose, self.loose)])

    def _load(self, data: Any, q: Array, v: Array, a: Array) -> Array:
        """Efforts in all joints, losses included."""
        return np.asarray(self.pin.rnea(self.model, data, q, v, a) + self.losses(v))

    def _mimic(self, robot: PinocchioRobot) -> tuple[Array, Array]:
        """B and c of q = B·p + c: a row per coordinate of Pinocchio's velocity, a column per driven axis."""
        columns = {name: k for k, name in enumerate(self.axes)}
        scalar = set(self.model.names) - set(self.free)
        projection, offset = np.zeros((self.model.nv, len(columns))), np.zeros(self.model.nv)
        for name, joint in zip(self.model.names, self.model.joints, strict=True):
            factor, leader = 1.0, name
            while leader in scalar and leader in robot.followers:
                follower = robot.followers[leader]
                offset[joint.idx_v] += factor * follower.offset
                factor, leader = factor * follower.multiplier, follower.leader
            if leader in columns:
                projection[joint.idx_v, columns[leader]] = factor
        return projection, offset

    def _parts(self, name: str) -> list[Any]:
        """Those of Pinocchio's joints that stand for a joint of the robot."""
        names = self._split_joints[name].parts if name in self._split_joints else (name,)
        return [self.model.joints[self.model.getJointId(part)] for part in names]

    def _split_axes(self, name: str) -> Array:
        return self._split_joints[name].axes if name in self._split_joints else free_joints.NOT_SPLIT

    def _relative(self, state: Configuration, name: str, frame: FrameMotion) -> FreeJointState:
        """State of a free joint from the frame of its child; all joints before it are in place."""
        first = self._parts(name)[0].id
        data, parent, placement = self.model.createData(), self.model.parents[first], self.model.jointPlacements[first]
        self.pin.forwardKinematics(self.model, data, state.q, state.v)
        joint, moves = data.oMi[parent] * placement, placement.actInv(data.v[parent])
        inward = joint.rotation.T
        place, axes = inward @ (frame.place - joint.translation), inward @ frame.axes
        velocity = inward @ frame.velocity - moves.linear - np.cross(moves.angular, place)
        return FreeJointState(place, axes, velocity, axes @ frame.turning - moves.angular)

    def _place(self, state: Configuration, name: str, at: FreeJointState) -> None:
        """Put a free joint into the configuration and velocity."""
        found = free_joints.coordinates(self.pin, at, self._split_axes(name))
        for part, (q, v) in zip(self._parts(name), found, strict=True):
            state.q[_slice(part)], state.v[part.idx_v : part.idx_v + part.nv] = q, v


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
        """How the frame of a link moves."""
        pin, number = self.reference.pin, self._number(link)
        place = self.data.oMf[number]
        velocity = self._velocity(number, pin.LOCAL_WORLD_ALIGNED).linear
        turning = self._velocity(number, pin.LOCAL).angular
        return FrameMotion(np.array(place.translation), np.array(place.rotation), velocity, turning)

    def acceleration(self, link: str) -> tuple[Array, Array]:
        """Of a link's frame: the linear one resolved in the world, the angular one in the frame."""
        pin, number = self.reference.pin, self._number(link)
        values = [
            pin.getFrameClassicalAcceleration(self.reference.model, self.data, number, resolved)
            for resolved in (pin.LOCAL_WORLD_ALIGNED, pin.LOCAL)
        ]
        return values[0].linear, values[1].angular

    def mass_and_centre(self) -> tuple[float, Array]:
        """Mass of the whole robot and its centre in the world; zero without any mass."""
        bodies = list(zip(self.reference.model.inertias, self.data.oMi, strict=True))
        mass = sum(inertia.mass for inertia, _ in bodies)
        moment = sum((inertia.mass * place.act(inertia.lever) for inertia, place in bodies), np.zeros(3))
        return mass, moment / mass if mass else moment

    def _number(self, link: str) -> int:
        return int(self.reference.model.getFrameId(link, self.reference.pin.BODY))

    def _velocity(self, number: int, resolved: Any) -> Any:
        return self.reference.pin.getFrameVelocity(self.reference.model, self.data, number, resolved)


def _place_base(pin: Any, state: Configuration, time: float) -> None:
    """Put the root link where `motion` says; Pinocchio resolves its velocity and acceleration in its own frame."""
    place, velocity, acceleration = np.array([course.at(time) for course in motion.PATH]).T
    angle, speed, gain = motion.TURN.at(time)
    axis = np.array(motion.TURN_AXIS)
    inward = pin.exp3(angle * axis).T
    state.q[:7] = np.concatenate([place, pin.Quaternion(inward.T).coeffs()])
    state.v[:6] = np.concatenate([inward @ velocity, speed * axis])
    state.a[:6] = np.concatenate([inward @ acceleration - np.cross(speed * axis, inward @ velocity), gain * axis])


def _slice(joint: Any) -> slice:
    """Where a joint is in Pinocchio's configuration."""
    return slice(joint.idx_q, joint.idx_q + joint.nq)
