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

import numpy as np

from urdfsync.urdf.physics import motion
from urdfsync.urdf.physics.motion import Course, Planar, Start
from urdfsync.urdf.physics.reading import Array, PinocchioRobot, pinocchio

TURNING_STEEPNESS, SLIDING_STEEPNESS = 100, 1000
"""In s/rad and s/m: the dry friction of generated joints is f·tanh(s·v/2)."""

_SLIDING_JOINTS = ("JointModelPX", "JointModelPY", "JointModelPZ", "JointModelPrismatic")  # Pinocchio's names

_SINGULAR = 1e-12  # ratio of the least to the greatest eigenvalue of an inertia


class Configuration(NamedTuple):
    """Pinocchio's configuration, velocity and acceleration; the accelerations of free joints are 0."""

    q: Array
    v: Array
    a: Array


class Reference:
    """A robot in Pinocchio; `axes` are the names of its driven joints, `free` those of joints that nothing drives.

    Free joints are named from the root to the leaves.
    """

    def __init__(self, robot: PinocchioRobot, axes: Sequence[str], free: Sequence[str]) -> None:
        self.pin = pinocchio()
        self.model, self._planar_parts = robot.model, robot.planar_parts
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

    def state(self, time: float, courses: Sequence[Course], starts: Mapping[str, Start]) -> Configuration:
        """Return where the robot is, `courses` being those of the axes from time 0; free joints are as they begin."""
        p, v, a = np.array([course.at(time) for course in courses]).reshape(-1, 3).T
        positions = self.projection @ p + self._offset
        state = Configuration(self.pin.neutral(self.model), self.projection @ v, self.projection @ a)
        for joint in self.model.joints[2:]:
            if joint.nv == 1:
                state.q[_slice(joint)] = _angle(joint, positions[joint.idx_v])
        _place_base(self.pin, state, time)
        for name, start in starts.items():
            self._place_free(state, name, start)
        return state

    def solve(self, state: Configuration) -> Instant:
        """Return efforts of base and axes, and accelerations of free joints."""
        data, a = self.model.createData(), state.a.copy()
        load = self._load(data, state, a)
        if self.loose.size:
            a[self.loose] = np.linalg.solve(self._free_inertia(state), -load[self.loose])
            load = self._load(data, state, a)
        self.pin.forwardKinematics(self.model, data, state.q, state.v, a)
        self.pin.updateFramePlacements(self.model, data)
        return Instant(self, data, load[:3], load[3:6], self.projection.T @ load)

    def losses(self, v: Array) -> Array:
        """Return the efforts of damping and dry friction at velocity v."""
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

    def _load(self, data: Any, state: Configuration, a: Array) -> Array:
        """Return the efforts in all joints, losses included."""
        return np.asarray(self.pin.rnea(self.model, data, state.q, state.v, a) + self.losses(state.v))

    def _mimic(self, robot: PinocchioRobot) -> tuple[Array, Array]:
        """Return B and c of q = B·p + c: a row per coordinate of Pinocchio's velocity, a column per driven axis."""
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
        """Return those of Pinocchio's joints that stand for a joint of the robot."""
        return [self.model.joints[self.model.getJointId(part)] for part in self._planar_parts.get(name, (name,))]

    def _place_free(self, state: Configuration, name: str, start: Start) -> None:
        """Put a free joint where it begins; Pinocchio resolves the velocity of a floating one in the child's frame."""
        parts = self._parts(name)
        if isinstance(start, Planar):
            for part, q, v in zip(parts, (*start.s, start.phi), (*start.v, start.w), strict=True):
                state.q[_slice(part)], state.v[part.idx_v] = _angle(part, q), v
        else:
            axes = self.pin.rpy.rpyToMatrix(*start.rpy)
            state.q[_slice(parts[0])] = np.concatenate([start.r, self.pin.Quaternion(axes).coeffs()])
            state.v[parts[0].idx_v :][:6] = np.concatenate([axes.T @ start.v, axes.T @ start.w])


class Instant(NamedTuple):
    """What the reference says of a robot at one instant."""

    reference: Reference
    data: Any
    """Pinocchio's, with positions, velocities and accelerations of all frames."""
    force: Array
    """On the root link, in its frame."""
    torque: Array
    efforts: Array
    """Of the driven axes."""

    def frame(self, link: str) -> tuple[Array, Array]:
        """Return place and axes of a link's frame in the world, the axes as columns."""
        place = self.data.oMf[self._number(link)]
        return np.array(place.translation), np.array(place.rotation)

    def acceleration(self, link: str) -> tuple[Array, Array]:
        """Return that of a link's frame: the linear one resolved in the world, the angular one in the frame."""
        pin, number = self.reference.pin, self._number(link)
        world, local = (
            pin.getFrameClassicalAcceleration(self.reference.model, self.data, number, resolved)
            for resolved in (pin.LOCAL_WORLD_ALIGNED, pin.LOCAL)
        )
        return world.linear, local.angular

    def mass_and_moment(self) -> tuple[float, Array]:
        """Return mass of the whole robot, and the sum of mass times place in the world."""
        bodies = list(zip(self.reference.model.inertias, self.data.oMi, strict=True))
        moment = sum((inertia.mass * place.act(inertia.lever) for inertia, place in bodies), np.zeros(3))
        return sum(inertia.mass for inertia, _ in bodies), moment

    def _number(self, link: str) -> int:
        return int(self.reference.model.getFrameId(link, self.reference.pin.BODY))


def _place_base(pin: Any, state: Configuration, time: float) -> None:
    """Put the root link where `motion` says; Pinocchio resolves its velocity and acceleration in its own frame."""
    place, velocity, acceleration = np.array([course.at(time) for course in motion.PATH]).T
    angle, speed, gain = motion.TURN.at(time)
    axis = np.array(motion.TURN_AXIS)
    inward = pin.exp3(angle * axis).T
    state.q[:7] = np.concatenate([place, pin.Quaternion(inward.T).coeffs()])
    state.v[:6] = np.concatenate([inward @ velocity, speed * axis])
    state.a[:6] = np.concatenate([inward @ acceleration - np.cross(speed * axis, inward @ velocity), gain * axis])


def _angle(joint: Any, position: float) -> float | tuple[float, float]:
    """Return the position of an axis as Pinocchio has it: cosine and sine for a continuous joint."""
    return (np.cos(position), np.sin(position)) if joint.nq == 2 else position


def _slice(joint: Any) -> slice:
    """Return where a joint is in Pinocchio's configuration."""
    return slice(joint.idx_q, joint.idx_q + joint.nq)
