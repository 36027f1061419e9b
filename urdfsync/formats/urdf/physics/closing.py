"""The loops of a robot in Pinocchio: closed poses, closed motions, and the forces of the loops.

Pinocchio's model is a tree. This module adds two frames for each loop, and Pinocchio computes their poses and
Jacobians. Only the start and the choice of equations come from `kinematics.loops`. Let x and R be the position and axes
of the child's frame in the parent's frame. Then the equations are t·x = 0 and u·R·v = 0, together g = 0. The motion of
the axes is given. The other joints follow from J·q̇ = 0 and J·q̈ = -J̇·q̇, where J is the derivative of g.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from urdfsync.formats.urdf.kinematics.loops import ClosedLoops

Array = NDArray[np.float64]

_STEPS = 8
"""Number of steps from the start to a pose: small steps lead to the nearest closed pose."""
_ITERATIONS = 30
CLOSED, _FARTHEST = 1e-12, 1.0
"""In rad or m: gaps and steps with which Newton's method has converged, and with which it diverges."""
_NEAR_DEAD_POINT = 0.25
"""Fraction of the Jacobian's least singular value at the start. Below, a compiler may find another closed pose."""


class OpenLoopError(Exception):
    """The loops can't be closed in a pose, or the pose is near a dead point."""


class Reaction(NamedTuple):
    """The gap and the force of a loop at an instant."""

    gap: Array
    """Vector from the parent's frame to the child's frame, resolved in the root's frame."""
    force: Array
    """Force of the parent on the child, resolved in the loop's frame on the parent."""
    torque: Array


class Closing:
    """The loops of a robot, and the joints that loops move."""

    def __init__(self, pin: Any, model: Any, closed: ClosedLoops, others: Array, start: Array, first: Array) -> None:
        """Add frames to the model.

        The positions of all coordinates are a sum of two terms. The first term follows from the axes and is `start` at
        the start. The second term is `others` times the positions of the other joints, which are `first` at the start.
        """
        self._pin, self._model, self._others, self._start, self._first = pin, model, others, start, first
        self._closures = [closed.closures[loop.name] for loop in closed.tree.loops]
        self._frames = list[tuple[int, int]]()
        for loop in closed.tree.loops:
            ends = (loop.parent, loop.origin), (loop.child, loop.child_origin)
            parent, child = (self._add_frame(link, origin.xyz, origin.rpy) for link, origin in ends)
            self._frames.append((parent, child))
        jacobian = self._equations(start + others @ first)[1] @ others
        self._least = _NEAR_DEAD_POINT * np.linalg.svd(jacobian, compute_uv=False).min(initial=np.inf)

    def _add_frame(self, link: str, xyz: Sequence[float], rpy: Sequence[float]) -> int:
        pin, model = self._pin, self._model
        body = model.frames[model.getFrameId(link, pin.BODY)]
        pose = body.placement * pin.SE3(pin.rpy.rpyToMatrix(*rpy), np.array(xyz))
        frame = pin.Frame(f"loop {model.nframes}", body.parentJoint, pose, pin.OP_FRAME)
        return int(model.addFrame(frame, append_inertia=False))

    def closed(self, positions: Array) -> Array:
        """Close the loops by Newton's method; the axes determine `positions`. Raises OpenLoopError."""
        others = self._first
        for share in np.linspace(0, 1, _STEPS + 1):
            known = self._start + share * (positions - self._start)
            for _ in range(_ITERATIONS):
                gaps, jacobian = self._equations(known + self._others @ others)
                step = np.linalg.lstsq(jacobian @ self._others, gaps)[0]
                others, largest = others - step, np.abs([*gaps, *step]).max()
                if not CLOSED < largest < _FARTHEST:
                    break
            least = np.linalg.svd(jacobian @ self._others, compute_uv=False).min(initial=np.inf)
            if not (largest <= CLOSED and least >= self._least):
                raise OpenLoopError
        return np.asarray(positions + self._others @ others)

    def motion(self, positions: Array, axes: Array, speeds: Array) -> tuple[Array, Array]:
        """Return the velocities of all coordinates while one axis moves with velocity 1, for each axis.

        Return also the accelerations of all coordinates at the axes' `speeds`, while no axis accelerates.
        """
        jacobian = self._equations(positions)[1]
        ways = axes - self._others @ np.linalg.lstsq(jacobian @ self._others, jacobian @ axes)[0]
        drift = self._drift(positions, ways @ speeds)
        return ways, -self._others @ np.linalg.lstsq(jacobian @ self._others, drift)[0]

    def reactions(self, positions: Array, load: Array) -> list[Reaction]:
        """Return gaps and forces of the loops.

        Without loops, all coordinates would need the efforts `load`. Joints without drives get their load Jᵀ·λ from the
        forces λ in the loops.
        """
        jacobian = self._equations(positions)[1]
        forces = iter(np.linalg.lstsq((jacobian @ self._others).T, self._others.T @ load)[0])
        data, found = self._data(positions), []
        for (parent, child), closure in zip(self._frames, self._closures, strict=True):
            axes = data.oMf[parent].rotation.T @ data.oMf[child].rotation
            gap = data.oMf[child].translation - data.oMf[parent].translation
            force = sum((next(forces) * np.array(t) for t in closure.translations), np.zeros(3))
            torque = sum((next(forces) * np.cross(axes @ v, u) for u, v in closure.rotations), np.zeros(3))
            found.append(Reaction(gap, force, torque))
        return found

    def forces(self, positions: Array, load: Array) -> Any:
        """Return the forces in all loops in Pinocchio's form: one force on each joint's body, in the joint's frame."""
        pin, model = self._pin, self._model
        data, forces = self._data(positions), [pin.Force.Zero() for _ in range(model.njoints)]
        for (parent, child), reaction in zip(self._frames, self.reactions(positions, load), strict=True):
            force = pin.Force(reaction.force, reaction.torque)
            # the force acts at the origin of the child's frame
            at_child = pin.SE3(data.oMf[parent].rotation, data.oMf[child].translation)
            for frame, sign in ((parent, -1), (child, 1)):
                joint = model.frames[frame].parentJoint
                forces[joint] += sign * data.oMi[joint].actInv(at_child.act(force))
        return pin.StdVec_Force(forces)

    def _data(self, positions: Array) -> Any:
        pin, model, data = self._pin, self._model, self._model.createData()
        pin.computeJointJacobians(model, data, self._q(positions))
        pin.updateFramePlacements(model, data)
        return data

    def _equations(self, positions: Array) -> tuple[Array, Array]:
        """Return the left sides of all equations at a pose, and their derivatives with respect to all coordinates."""
        pin, model, data = self._pin, self._model, self._data(positions)
        gaps, rows = list[float](), list[Array]()
        for frames, closure in zip(self._frames, self._closures, strict=True):
            pose = data.oMf[frames[0]].actInv(data.oMf[frames[1]])
            axes = pose.rotation
            parent, child = (pin.getFrameJacobian(model, data, frame, pin.LOCAL) for frame in frames)
            # motion of the child's frame relative to the parent's frame, resolved in the child's frame
            jacobian = child - pose.inverse().action @ parent
            for t in closure.translations:
                gaps.append(float(t @ pose.translation))
                rows.append(t @ axes @ jacobian[:3])
            for u, v_child in closure.rotations:
                row = axes.T @ u
                gaps.append(float(row @ v_child))
                rows.append(pin.skew(np.array(v_child)) @ row @ jacobian[3:])
        return np.array(gaps), np.array(rows)

    def _drift(self, positions: Array, velocity: Array) -> Array:
        """Return J̇·q̇, the second derivatives of the left sides while no coordinate accelerates."""
        pin, model, data = self._pin, self._model, self._model.createData()
        pin.forwardKinematics(model, data, self._q(positions), velocity, np.zeros(model.nv))
        pin.updateFramePlacements(model, data)
        found = list[float]()
        for (parent, child), closure in zip(self._frames, self._closures, strict=True):
            pose = data.oMf[parent].actInv(data.oMf[child])
            carried, speed = pose.actInv(self._speed(data, parent)), self._speed(data, child)
            relative = speed - carried
            gains = [pin.getFrameAcceleration(model, data, frame, pin.LOCAL) for frame in (parent, child)]
            # all vectors are resolved in the turning frame of the child
            gain = gains[1] - pose.actInv(gains[0]) + relative.cross(carried)
            turning = relative.angular
            for t in closure.translations:
                found.append(float(t @ pose.rotation @ (gain.linear + np.cross(turning, relative.linear))))
            for u, v_child in closure.rotations:
                row = pose.rotation.T @ u
                rate = np.cross(v_child, np.cross(row, turning)) @ turning
                found.append(float(rate + np.cross(v_child, row) @ gain.angular))
        return np.array(found)

    def _speed(self, data: Any, frame: int) -> Any:
        return self._pin.getFrameVelocity(self._model, data, frame, self._pin.LOCAL)

    def _q(self, positions: Array) -> Any:
        return self._pin.integrate(self._model, self._pin.neutral(self._model), positions)
