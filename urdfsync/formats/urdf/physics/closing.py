"""The loops of a robot in the reference: closed poses, closed motions, and the forces of the loops.

The reference has a tree, and gives poses, Jacobians and accelerations of both links of each loop. Only the start and
the choice of equations come from `kinematics.loops`. Let x and R be the position and axes of the child's frame in the
parent's frame. Then the equations are t·x = 0 and u·R·v = 0, together g = 0. The motion of the axes is given. The other
joints follow from J·q̇ = 0 and J·q̈ = -J̇·q̇, where J is the derivative of g.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from urdfsync.formats.urdf.kinematics.loops import ClosedLoops, Closure
from urdfsync.formats.urdf.physics.multibody import Array, Load, Multibody, cross_matrix
from urdfsync.formats.urdf.robot import Origin, Vector
from urdfsync.formats.urdf.second.reading import rotation

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
    """Vector from the parent's frame to the child's frame, resolved in the world."""
    force: Array
    """Force of the parent on the child, resolved in the loop's frame on the parent."""
    torque: Array


class _End(NamedTuple):
    """A frame of a loop on a link, resolved in the world."""

    link: str
    xyz: Vector
    place: Array
    axes: Array
    jacobian: Array


class Closing:
    """The loops of a robot, and the joints that loops move."""

    def __init__(self, multibody: Multibody, closed: ClosedLoops, others: Array, start: Array, first: Array) -> None:
        """Store the loops.

        The positions of all coordinates are a sum of two terms. The first term follows from the axes and is `start` at
        the start. The second term is `others` times the positions of the other joints, which are `first` at the start.
        """
        self._multibody, self._others, self._start, self._first = multibody, others, start, first
        self._loops = [
            ((loop.parent, loop.origin), (loop.child, loop.child_origin), closed.closures[loop.name])
            for loop in closed.tree.loops
        ]
        jacobian = self._equations(self._q(start + others @ first))[1] @ others
        self._least = _NEAR_DEAD_POINT * np.linalg.svd(jacobian, compute_uv=False).min(initial=np.inf)

    def closed(self, positions: Array) -> Array:
        """Close the loops by Newton's method; the axes determine `positions`. Raises OpenLoopError."""
        others = self._first
        for share in np.linspace(0, 1, _STEPS + 1):
            known = self._start + share * (positions - self._start)
            for _ in range(_ITERATIONS):
                gaps, jacobian = self._equations(self._q(known + self._others @ others))
                step = np.linalg.lstsq(jacobian @ self._others, gaps, rcond=None)[0]
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
        q = self._q(positions)
        jacobian = self._equations(q)[1]
        ways = axes - self._others @ np.linalg.lstsq(jacobian @ self._others, jacobian @ axes, rcond=None)[0]
        drift = self._drift(q, ways @ speeds)
        return ways, -self._others @ np.linalg.lstsq(jacobian @ self._others, drift, rcond=None)[0]

    def reactions(self, q: Array, load: Array) -> list[Reaction]:
        """Return gaps and forces of the loops.

        Without loops, all coordinates would need the efforts `load`. Joints without drives get their load Jᵀ·λ from the
        forces λ in the loops.
        """
        jacobian, data = self._equations(q)[1], self._multibody.move(q)
        forces = iter(np.linalg.lstsq((jacobian @ self._others).T, self._others.T @ load, rcond=None)[0])
        reactions = []
        for parent, child, closure in self._ends(data):
            axes = parent.axes.T @ child.axes
            force = sum((next(forces) * np.array(t) for t in closure.translations), np.zeros(3))
            torque = sum((next(forces) * np.cross(axes @ v, u) for u, v in closure.rotations), np.zeros(3))
            reactions.append(Reaction(child.place - parent.place, force, torque))
        return reactions

    def loads(self, q: Array, load: Array) -> list[Load]:
        """Return the forces of all loops on their links."""
        loads = list[Load]()
        ends = self._ends(self._multibody.move(q))
        for (parent, child, _), reaction in zip(ends, self.reactions(q, load), strict=True):
            force, torque = parent.axes @ reaction.force, parent.axes @ reaction.torque
            # the force acts at the origin of the child's frame
            loads += Load(parent.link, child.place, -force, -torque), Load(child.link, child.place, force, torque)
        return loads

    def _ends(self, data: Any) -> Iterator[tuple[_End, _End, Closure]]:
        """Yield both frames of each loop, and its equations."""
        for *ends, closure in self._loops:
            parent, child = (self._end(data, link, origin) for link, origin in ends)
            yield parent, child, closure

    def _end(self, data: Any, link: str, origin: Origin) -> _End:
        place, axes = self._multibody.pose(data, link)
        jacobian = self._multibody.jacobian(data, link, origin.xyz)
        return _End(link, origin.xyz, place + axes @ origin.xyz, axes @ rotation(origin.rpy), jacobian)

    def _equations(self, q: Array) -> tuple[Array, Array]:
        """Return the left sides of all equations at a pose, and their derivatives with respect to all coordinates."""
        gaps, rows = list[float](), list[Array]()
        for parent, child, closure in self._ends(self._multibody.move(q)):
            gap, relative = child.place - parent.place, child.jacobian - parent.jacobian
            for t in closure.translations:
                direction = parent.axes @ t
                gaps.append(float(direction @ gap))
                # the parent's axes turn, too
                rows.append(direction @ (relative[:3] + cross_matrix(gap) @ parent.jacobian[3:]))
            for u, v in closure.rotations:
                of_parent, of_child = parent.axes @ u, child.axes @ v
                gaps.append(float(of_parent @ of_child))
                rows.append(np.cross(of_child, of_parent) @ relative[3:])
        return np.array(gaps), np.array(rows)

    def _drift(self, q: Array, velocity: Array) -> Array:
        """Return J̇·q̇, the second derivatives of the left sides while no coordinate accelerates."""
        data, drift = self._multibody.move(q, velocity, np.zeros(len(velocity))), list[float]()
        for parent, child, closure in self._ends(data):
            (v_parent, w_parent), (v_child, w_child) = (
                np.split(each.jacobian @ velocity, 2) for each in (parent, child)
            )
            (a_parent, z_parent), (a_child, z_child) = (
                np.split(self._multibody.acceleration(data, each.link, each.xyz), 2) for each in (parent, child)
            )
            gap, speed = child.place - parent.place, v_child - v_parent
            # seen from the parent's frame, which turns
            seen = a_child - a_parent - np.cross(z_parent, gap) - 2 * np.cross(w_parent, speed)
            seen += np.cross(w_parent, np.cross(w_parent, gap))
            drift += (float(parent.axes @ t @ seen) for t in closure.translations)
            for u, v in closure.rotations:
                of_parent, of_child = parent.axes @ u, child.axes @ v
                turned = np.cross(w_parent, of_parent), np.cross(w_child, of_child)
                curved = np.cross(w_parent, turned[0]) @ of_child + np.cross(w_child, turned[1]) @ of_parent
                curved += np.cross(z_parent, of_parent) @ of_child + np.cross(z_child, of_child) @ of_parent
                drift.append(float(curved + 2 * turned[0] @ turned[1]))
        return np.array(drift)

    def _q(self, positions: Array) -> Array:
        return self._multibody.configuration(positions)
