"""The joints and the equations of all loops of a robot, as arrays of numpy."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from urdfsync.formats.urdf.kinematics.loops import Gap
from urdfsync.formats.urdf.kinematics.poses import AXES, dot, start_positions
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import MOTION_KINDS, MOTIONS, Joint, Loop, Origin, Vector

Array = NDArray[Any]
Equation = tuple[Vector, tuple[float, float, float, float], float]
"""u, v and product of a row: see `Rows`."""

ORIGIN = (0.0, 0.0, 0.0, 1.0)
_TAU = Decimal("6.283185307179586476925286766559005768394")


class Rows(NamedTuple):
    """Equations u·(T·v) = product: u is in the parent's frame, v in the child's frame, and T is the pose of the child.

    The vector v has four numbers: a direction and 0 for a rotation, or the origin and 1 for a translation along u.
    """

    loops: Array
    """The number of the loop of each equation."""
    u: Array
    v: Array
    products: Array

    @classmethod
    def of(cls, equations: Iterable[Sequence[Equation]]) -> Rows:
        """Return the equations of all loops, loop by loop."""
        rows = [(k, *equation) for k, loop in enumerate(equations) for equation in loop]
        return cls(*map(np.array, zip(*rows, strict=True)))

    def take(self, chosen: Sequence[int], dtype: type = float) -> Rows:
        """Return the chosen equations."""
        loops, *numbers = (array[list(chosen)] for array in self)
        return Rows(loops, *(array_of(array, dtype) for array in numbers))


class Mechanism:
    """The joints between the root and the frames of all loops; `dtype` is float, or object for decimals.

    The `independent` joints move a loop and follow no other joint. The positions of the independent joints determine
    all poses.
    """

    def __init__(self, tree: KinematicTree, dtype: type = float) -> None:
        by_child, on_paths = {joint.child: joint for joint in tree.joints}, joints_of_loops(tree)
        paths = [[{*_path(by_child, link)} for link in (loop.parent, loop.child)] for loop in tree.loops]
        self.paths = [parent ^ child for parent, child in paths]
        """The joints between the two frames of each loop."""
        self.loops = tree.loops
        self.joints = [joint for joint in tree.joints if joint.name in on_paths]
        index = {joint.child: k for k, joint in enumerate(self.joints, 1)}
        self._parents = [index.get(joint.parent, 0) for joint in self.joints]
        self._origins = _poses([joint.origin for joint in self.joints], dtype)
        self._still = _poses([Origin()] * (len(self.joints) + 1), dtype)
        self._axes = array_of([joint.axis for joint in self.joints], dtype).reshape(-1, 3)
        motions = [MOTION_KINDS.get(joint.type) for joint in self.joints]
        self.turns, self.slides = (np.array([motion == kind for motion in motions], int)[:, None] for kind in MOTIONS)
        signs = [[(j.name in child) - (j.name in parent) for j in self.joints] for parent, child in paths]
        self.signs = np.array(signs, int).reshape(len(paths), -1) * (self.turns + self.slides).T
        """For each loop and joint: 1 if the joint moves the child's frame, -1 for the parent's frame, else 0."""
        self._links = np.array([[index.get(loop.parent, 0), index.get(loop.child, 0)] for loop in tree.loops]).T
        self._frames = [_poses([loop.origin for loop in tree.loops], dtype)]
        self._frames += [_poses([loop.child_origin for loop in tree.loops], dtype)]
        roots, starts = _roots(tree), start_positions(tree)
        moving = {roots[joint.name][0] for joint, used in zip(self.joints, self.signs.any(axis=0), strict=True) if used}
        self.independent = [joint for joint in tree.joints if joint.name in moving and joint.type in MOTION_KINDS]
        self.start = np.array([starts[joint.name] for joint in self.independent])
        column = {joint.name: k for k, joint in enumerate(self.independent)}
        gears, offsets = np.zeros((len(self.joints), len(column))), [starts[joint.name] for joint in self.joints]
        for k, joint in enumerate(self.joints):
            leader, multiplier, offset = roots[joint.name]
            if leader in column:
                gears[k, column[leader]], offsets[k] = multiplier, offset
        self._gears, self._offsets = array_of(gears, dtype), array_of(offsets, dtype)
        self.moves = self.signs @ gears != 0
        """For each loop and independent joint, whether the joint moves the loop."""
        self.whole = Rows.of(map(_whole, tree.loops))

    def poses(self, q: Array) -> Array:
        """Return the poses of the root and of each joint's child, as matrices."""
        positions = (self._gears @ q + self._offsets)[:, None]
        moved = self._still[1:].copy()
        moved[:, :3, :3] = turns(self._axes, positions * self.turns)
        moved[:, :3, 3] = self._axes * (positions * self.slides)
        poses: list[Array] = [self._still[0]]
        for parent, pose in zip(self._parents, self._origins @ moved, strict=True):
            poses.append(poses[parent] @ pose)
        return np.array(poses)

    def frames(self, poses: Array) -> tuple[Array, Array]:
        """Return the poses of the parents' frames and of the children's frames of all loops."""
        a, b = (poses[links] @ frames for links, frames in zip(self._links, self._frames, strict=True))
        return a, b

    def twists(self, poses: Array) -> tuple[Array, Array]:
        """Return for each joint the angular velocity, and the velocity of the point at the root's origin."""
        axes = (poses[1:, :3, :3] @ self._axes[:, :, None])[:, :, 0]
        turns = axes * self.turns
        return turns, axes * self.slides + _cross(poses[1:, :3, 3], turns)

    def left(self, q: Array, rows: Rows) -> Array:
        """Return the residuals of the equations: in m for translations, without unit for rotations."""
        return self._left(self.poses(q), rows)[0]

    def evaluate(self, q: Array, rows: Rows) -> tuple[Array, Array]:
        """Return the residuals of the equations, and the derivatives by the joints' positions."""
        poses = self.poses(q)
        left, u, w = self._left(poses, rows)
        turns, moves = self.twists(poses)
        derivatives = ((u * rows.v[:, 3:]) @ moves.T + _cross(w, u) @ turns.T) * self.signs[rows.loops]
        return left, derivatives @ self._gears

    def _left(self, poses: Array, rows: Rows) -> tuple[Array, Array, Array]:
        """Return the residuals of the equations, and the vectors u and T·v in the frame of the root."""
        a, b = self.frames(poses)
        u = (a[rows.loops, :3, :3] @ rows.u[:, :, None])[:, :, 0]
        w = (b[rows.loops, :3] @ rows.v[:, :, None])[:, :, 0]
        return (u * (w - rows.v[:, 3:] * a[rows.loops, :3, 3])).sum(axis=1) - rows.products, u, w

    def gaps(self, q: Array) -> list[Gap]:
        """Return the gap of each loop in a pose, by its kind."""
        gaps, left = [], self.left(q, self.whole)
        for k, loop in enumerate(self.loops):
            x, y, z, *chords = left[self.whole.loops == k]
            chord = math.hypot(*chords) / {"fixed": math.sqrt(8), "revolute": 2}.get(loop.kind, 1)
            angle = math.asin(min(1.0, chord)) * (1 if loop.kind == "universal" else 2)
            gaps.append(Gap(math.hypot(x, y, z), angle))
        return gaps


def _whole(loop: Loop) -> list[Equation]:
    """Return all equations of a loop's kind, including dependent ones.

    The residuals are largest if a loop is closed the wrong way round.
    """
    equations: list[Equation] = [(u, ORIGIN, 0.0) for u in AXES]
    if loop.kind == "universal":
        equations.append((loop.axis, (*loop.child_axis, 0.0), 0.0))
    held = {"revolute": (loop.axis,), "fixed": AXES}.get(loop.kind, ())
    return equations + [(u, (*v, 0.0), dot(u, v)) for v in held for u in AXES]


def array_of(values: Any, dtype: type) -> Array:
    """Return numbers as floats, or as decimals."""
    array = np.array(values, float)
    return array if dtype is float else np.vectorize(Decimal, otypes=[object])(array)


def _cross(a: Array, b: Array) -> Array:
    """Return the vector products of rows; `numpy.cross` took most of an assembly's time."""
    crossed: Array = a[:, [1, 2, 0]] * b[:, [2, 0, 1]] - a[:, [2, 0, 1]] * b[:, [1, 2, 0]]
    return crossed


def turns(axes: Array, angles: Array) -> Array:
    """Return turns about axes as matrices, by Rodrigues' formula: one axis for each angle, or for all."""
    x, y, z = axes.T
    zero, angles = x * 0, angles.reshape(-1, 1, 1)
    skew = np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]).transpose(2, 0, 1)
    if angles.dtype == object:
        sines, cosines = np.vectorize(_series, otypes=[object, object])(angles)
    else:
        sines, cosines = np.sin(angles), np.cos(angles)
    turned: Array = np.eye(3, dtype=int) + sines * skew + (1 - cosines) * (skew @ skew)
    return turned


def _series(angle: Decimal) -> tuple[Decimal, Decimal]:
    """Return sine and cosine to about 25 digits, by their power series."""
    angle %= _TAU
    sums, term, k = [Decimal(0), Decimal(0)], Decimal(1), 0
    while k < 8 or abs(term) > Decimal("1e-30"):
        sums[k % 2] += -term if k % 4 > 1 else term
        k += 1
        term *= angle / k
    return sums[1], sums[0]


def _poses(origins: Sequence[Origin], dtype: type) -> Array:
    poses: Array = np.zeros((len(origins), 4, 4), dtype)
    poses[:] = np.eye(4, dtype=int)
    poses[:, :3, 3] = array_of([origin.xyz for origin in origins], dtype).reshape(-1, 3)
    angles = array_of([origin.rpy for origin in origins], dtype).reshape(-1, 3)
    for k in (2, 1, 0):
        poses[:, :3, :3] = poses[:, :3, :3] @ turns(array_of([AXES[k]] * len(origins), dtype), angles[:, k])
    return poses


def joints_of_loops(tree: KinematicTree) -> set[str]:
    """Return the names of the joints between the root and the frames of all loops."""
    by_child, names = {joint.child: joint for joint in tree.joints}, set[str]()
    for link in {link for loop in tree.loops for link in (loop.parent, loop.child)}:
        names.update(itertools.takewhile(lambda name: name not in names, _path(by_child, link)))
    return names


def _path(by_child: Mapping[str, Joint], link: str) -> Iterator[str]:
    while link in by_child:
        yield by_child[link].name
        link = by_child[link].parent


def _roots(tree: KinematicTree) -> Mapping[str, tuple[str, float, float]]:
    """Return the final leader of each joint, with multiplier and offset; a joint without a leader leads itself."""
    roots: dict[str, tuple[str, float, float]] = {}
    for joint in tree.leaders_first():
        roots[joint.name] = joint.name, 1.0, 0.0
        if joint.mimic is not None:
            leader, multiplier, offset = roots[joint.mimic.joint]
            factor = joint.mimic.multiplier
            roots[joint.name] = leader, factor * multiplier, factor * offset + joint.mimic.offset
    return roots
