"""Close the loops of a robot: its start pose, its freedoms, and the equations and states of its model.

Generic poses are closed ones that small motions of all joints lead to: only there is the rank of the constraints that
of the mechanism. Numbers are compared without units: lengths of a loop are divided by its size. What is chosen by them
is chosen in a fixed order by one tolerance, and the start is refined in decimals: it is the same on every machine.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from typing import Any, NamedTuple

import msgspec
import numpy as np
from numpy.typing import NDArray

from urdfsync.urdf.kinematics.poses import dot, own_range, position_ranges, start_positions
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import MOTION_KINDS, MOTIONS, Joint, Loop, Origin, Vector

Array = NDArray[Any]

_PARALLEL = 1e-4
"""Angle between axes that are meant to be parallel, in rad: exporters write 1.5708."""
_INDEPENDENT = 1e-3
"""Part of a row or column without units that others must not cancel. It is above what `_PARALLEL` leaves of one."""
_CLOSED = 1e-4
"""Gap of a closed loop, in m, that the equations of its model leave."""
_CLOSED_ANGLE = 1e-3
_AMPLITUDES = (0.4, 0.2, 0.1, 0.05)
"""Motions to generic poses, in rad; the first that can be closed counts."""
_POSES = 3
_STEPS = 16
"""Steps of the way along which Test moves the driven joints."""
_SWEEP = {"rotational": 1.0, "translational": 0.1}
"""Longest way of a sweep in the library, in rad and m."""
_SWEEP_MARGIN, _SWEEP_PERIOD = 0.9, 10.0
_TAU = Decimal("6.283185307179586476925286766559005768394")


class Gap(msgspec.Struct, frozen=True):
    """How far a pose is from closing a loop."""

    distance: float
    """Between the origins of both frames, in m."""
    angle: float
    """Between what the kind of the loop holds together, in rad."""


class Closure(msgspec.Struct, frozen=True):
    """The equations by which a model closes a loop: independent of each other, and of those of all other loops."""

    translations: tuple[Vector, ...]
    """Unit vectors in the frame of the parent, along which the origins of both frames coincide."""
    rotations: tuple[tuple[Vector, Vector], ...]
    """Pairs of unit vectors u in the frame of the parent and v in that of the child: u·R·v = 0."""
    planar: Vector | None = None
    """Normal of the plane in the frame of the parent, if there are two translations in a plane and no rotations."""
    weaker: str | None = None
    """The reason for fewer equations than those of the kind; None for a planar loop, too."""


class Assembly(msgspec.Struct, frozen=True):
    """A robot whose loops are closed."""

    joints: tuple[str, ...]
    """Joints whose motion the loops restrict, with the leaders of followers, in canonical order."""
    freedoms: int
    """Of these joints: their number without followers, less the rank of the constraints at generic poses."""
    positions: Mapping[str, float]
    """Start of all joints with one axis, within limits. The start of the source, if it can be closed."""
    states: tuple[str, ...]
    """Of `joints`, as many as freedoms: driven ones, then others. All else follows from them."""
    driven: tuple[str, ...]
    """All joints of the robot that are driven, in canonical order."""
    excess: tuple[str, ...]
    """Named drives that are not driven, since others move the loops already."""
    reach: Mapping[str, float]
    """Longest way in Test of each driven one of `joints`, so that the loops stay closed when all move at once."""
    closures: Mapping[str, Closure]
    gaps: Mapping[str, Gap]
    """Of the start of the source."""


class LoopFault(msgspec.Struct, frozen=True):
    """A reason why a loop has no model."""

    code: str
    loop: str
    message: str
    hint: str


class Rows(NamedTuple):
    """Equations of loops: u·w = product, for the vectors u and w in the frames of the parent and the child.

    A translation has for w the origin of the child's frame, seen from that of the parent's: the last of `v` is 1.
    """

    loops: Array
    u: Array
    v: Array
    products: Array

    def take(self, chosen: Sequence[int], dtype: type = float) -> Rows:
        """Return some of the equations."""
        loops, *numbers = (array[list(chosen)] for array in self)
        return Rows(loops, *(_array(array, dtype) for array in numbers))


class Mechanism:
    """The joints between the root and the frames of all loops, in numpy; `dtype` is float, or object for decimals.

    Positions are those of the `independent` joints: all that loops concern, without followers.
    """

    def __init__(self, tree: KinematicTree, dtype: type = float) -> None:
        by_child = {joint.child: joint for joint in tree.joints}
        self.loops, self._dtype = tree.loops, dtype
        paths = [[{*_path(by_child, link)} for link in (loop.parent, loop.child)] for loop in tree.loops]
        on_paths = {name for pair in paths for path in pair for name in path}
        self.joints = [joint for joint in tree.joints if joint.name in on_paths]
        index = {joint.child: k for k, joint in enumerate(self.joints, 1)}
        self._parents = [index.get(joint.parent, 0) for joint in self.joints]
        self._still = _poses([Origin()] * (len(self.joints) + 1), dtype)
        self._origins = _poses([joint.origin for joint in self.joints], dtype)
        self._axes = _array([joint.axis for joint in self.joints], dtype).reshape(-1, 3)
        motions = [MOTION_KINDS.get(joint.type) for joint in self.joints]
        self.turns, self.slides = (np.array([motion == kind for motion in motions], int)[:, None] for kind in MOTIONS)
        signs = [[(j.name in child) - (j.name in parent) for j in self.joints] for parent, child in paths]
        self.signs = np.array(signs, int).reshape(len(paths), -1) * (self.turns + self.slides).T
        """Of each loop, 1 for joints that move the child's frame against the parent's, -1 the other way round."""
        self._links = np.array([[index.get(loop.parent, 0), index.get(loop.child, 0)] for loop in tree.loops]).T
        ends = ([loop.origin for loop in tree.loops], [loop.child_origin for loop in tree.loops])
        self._frames = [_poses(origins, dtype) for origins in ends]
        roots, starts = _roots(tree), start_positions(tree)
        moving = {roots[joint.name][0] for joint, used in zip(self.joints, self.signs.any(axis=0), strict=True) if used}
        self.independent = [j for j in tree.joints if j.name in moving and j.type in MOTION_KINDS]
        column = {joint.name: k for k, joint in enumerate(self.independent)}
        gears, offsets = np.zeros((len(self.joints), len(column))), [starts[joint.name] for joint in self.joints]
        for k, joint in enumerate(self.joints):
            leader, multiplier, offset = roots[joint.name]
            if leader in column:
                gears[k, column[leader]], offsets[k] = multiplier, offset
        self.gears, self._offsets = _array(gears, dtype), _array(offsets, dtype)
        self.start = np.array([starts[joint.name] for joint in self.independent])

    def poses(self, q: Array) -> Array:
        """Return the poses of the root and of each joint's child, as matrices."""
        positions = (self.gears @ q + self._offsets)[:, None]
        moved = self._still[1:].copy()
        moved[:, :3, :3] = _turns(self._axes, positions * self.turns)
        moved[:, :3, 3] = self._axes * (positions * self.slides)
        poses: list[Array] = [self._still[0]]
        for parent, pose in zip(self._parents, self._origins @ moved, strict=True):
            poses.append(poses[parent] @ pose)
        return np.array(poses)

    def frames(self, poses: Array) -> tuple[Array, Array]:
        """Return the poses of the frames of all loops, in the parents and in the children."""
        a, b = (poses[links] @ frames for links, frames in zip(self._links, self._frames, strict=True))
        return a, b

    def twists(self, poses: Array) -> tuple[Array, Array]:
        """Return for each joint how fast it turns all that it moves, and moves what is at the origin of the root."""
        ends = poses[1:]
        axes = (ends[:, :3, :3] @ self._axes[:, :, None])[:, :, 0]
        turns = axes * self.turns
        return turns, axes * self.slides + _cross(ends[:, :3, 3], turns)

    def evaluate(self, q: Array, rows: Rows) -> tuple[Array, Array]:
        """Return what the equations leave, in m and without unit, and the derivatives of that by positions."""
        poses = self.poses(q)
        (a, b), (turns, moves) = self.frames(poses), self.twists(poses)
        u = (a[rows.loops, :3, :3] @ rows.u[:, :, None])[:, :, 0]
        w = (b[rows.loops, :3] @ rows.v[:, :, None])[:, :, 0]
        is_translation = rows.v[:, 3:]
        gaps = (u * (w - is_translation * a[rows.loops, :3, 3])).sum(axis=1) - rows.products
        derivatives = ((u * is_translation) @ moves.T + _cross(w, u) @ turns.T) * self.signs[rows.loops]
        return gaps, derivatives @ self.gears

    def gaps(self, q: Array) -> list[Gap]:
        """Return how far a pose is from closing each loop as its kind demands."""
        gaps, (a, b) = [], self.frames(self.poses(q))
        for loop, parent, child in zip(self.loops, a, b, strict=True):
            rotation, angle = parent[:3, :3].T @ child[:3, :3], 0.0
            if loop.kind == "fixed":  # the length of R - I has all digits, of small angles, too
                angle = 2 * math.asin(min(1.0, math.sqrt(((rotation - np.eye(3)) ** 2).sum() / 8)))
            elif loop.kind == "revolute":
                angle = 2 * math.asin(min(1.0, math.dist(rotation @ loop.axis, loop.axis) / 2))
            elif loop.kind == "universal":
                angle = math.asin(min(1.0, abs(float(np.array(loop.axis) @ rotation @ loop.child_axis))))
            gaps.append(Gap(math.dist(parent[:3, 3], child[:3, 3]), angle))
        return gaps


class _Problem:
    """Closing the loops of a mechanism, without units: lengths of a loop are divided by its size."""

    def __init__(self, tree: KinematicTree) -> None:
        self.mechanism = mechanism = Mechanism(tree)
        ranges = position_ranges(tree)
        limits = [_given_limits(ranges[joint.name]) for joint in mechanism.independent]
        lower, upper = np.array(limits).reshape(-1, 2).T
        self.lower, self.upper = np.minimum(lower, mechanism.start), np.maximum(upper, mechanism.start)
        poses = mechanism.poses(mechanism.start)
        levers = np.linalg.norm(poses[None, 1:, :3, 3] - mechanism.frames(poses)[1][:, None, :3, 3], axis=2)
        sizes = (levers * (mechanism.signs != 0) * mechanism.turns.T).max(axis=1)
        self.sizes = np.where(sizes > 0, sizes, 1.0)
        """Of each loop, the distance from its frames to the farthest axis; 1 without axes."""
        self.units = np.ones(len(limits))
        for k, joint in enumerate(mechanism.independent):
            if joint.type == "prismatic":  # it moves the first of its loops by the size of that
                self.units[k] = self.sizes[np.argmax(mechanism.signs @ mechanism.gears[:, k] != 0)]

    def evaluate(self, q: Array, rows: Rows) -> tuple[Array, Array]:
        """Return what the equations leave, and the derivatives of that, without units."""
        gaps, jacobian = self.mechanism.evaluate(q, rows)
        scales = np.where(rows.v[:, 3] == 1, self.sizes[rows.loops], 1.0)
        return gaps / scales, jacobian * self.units / scales[:, None]

    def jacobian(self, q: Array, rows: Rows) -> Array:
        """Return the derivatives alone."""
        return self.evaluate(q, rows)[1]

    def close(self, start: Array, rows: Rows, free: Array | None = None, *, bounded: bool = True) -> Array:
        """Return where the equations leave least near a start, by Levenberg's method with the free joints.

        Directions in which the equations are dependent count for nothing: what inexact numbers leave there stays.
        """
        q, caution, lower, upper = start, 1.0, self.lower, self.upper
        if not bounded:
            lower, upper = np.full(len(q), -math.inf), np.full(len(q), math.inf)
        gaps, jacobian = self.evaluate(q, rows)
        for _ in range(60):
            movable = np.ones(len(q), bool) if free is None else free.copy()
            while True:  # without the joints that would leave their limits from where they end
                step = np.zeros(len(q))
                squares, directions = _spectrum(jacobian[:, movable])
                factors = (squares > _INDEPENDENT**2) / np.maximum(squares + caution * (gaps @ gaps), _INDEPENDENT**2)
                step[movable] = -directions @ (factors * (directions.T @ (jacobian[:, movable].T @ gaps)))
                blocked = movable & (((q <= lower) & (step < 0)) | ((q >= upper) & (step > 0)))
                if not blocked.any():
                    break
                movable &= ~blocked
            largest = float(np.abs(step).max(initial=0.0))
            if largest < 1e-13 or caution > 1e9:
                break
            moved = np.clip(q + step * self.units * min(1.0, 0.5 / largest), lower, upper)
            new_gaps, new_jacobian = self.evaluate(moved, rows)
            if new_gaps @ new_gaps < gaps @ gaps:
                q, gaps, jacobian, caution = moved, new_gaps, new_jacobian, caution / 4
            else:
                caution *= 8
        return q

    def openness(self, q: Array, rows: Rows) -> float:
        """Return the largest of what the equations leave."""
        return float(np.abs(self.evaluate(q, rows)[0]).max(initial=0.0))


def assemble(tree: KinematicTree, wanted: frozenset[str], named: frozenset[str]) -> Assembly | tuple[LoopFault, ...]:
    """Close all loops of a robot that has any, near its start, or say why that is impossible.

    `wanted` joints are to be driven; of these the source or the options name `named` as drives. If none of these is in
    a loop, the first wanted ones that are independent are driven.
    """
    problem = _Problem(tree)
    mechanism = problem.mechanism
    if faults := tuple(_structural_faults(tree, mechanism)):
        return faults
    whole = _rows([_equations_of_kind(loop) for loop in tree.loops])
    names = [joint.name for joint in mechanism.independent]
    closed = _closed_near(problem, whole, np.array([name in named for name in names]))
    if faults := tuple(_open_faults(mechanism, closed)):
        return faults
    normals = [_normal(mechanism, k) for k in range(len(tree.loops))]
    candidates = _rows(map(_equations, tree.loops, normals))
    generic = _generic_poses(problem, closed, whole)
    chosen = _independent([problem.jacobian(q, candidates) for q in generic])
    rows = candidates.take(chosen)
    closures = {loop.name: _closure(loop, candidates, rows, k, normals[k]) for k, loop in enumerate(tree.loops)}
    if faults := tuple(_redundant_faults(closures)):
        return faults
    at_closed = problem.jacobian(closed, rows)
    if len(kept := _independent([at_closed])) < len(chosen):
        first = next(k for k, row in enumerate([*kept, -1]) if k != row)
        reason = "its equations depend on each other at the start, though not elsewhere"
        return (_singular(tree.loops[rows.loops[first]], reason),)
    here = _null_space(at_closed)
    spaces = [_null_space(problem.jacobian(q, rows)) for q in generic]
    drives = [k for k, name in enumerate(names) if name in named]
    if drives:
        driven = [drives[k] for k in _independent([space[drives] for space in spaces])]
        moving = [driven[k] for k in _independent([here[driven]])]
        for k in set(driven).difference(moving):
            loop = tree.loops[np.argmax(mechanism.signs @ mechanism.gears[:, k] != 0)]
            return (_singular(loop, f"joint {names[k]!r} is at a dead point at the start, and moves nothing"),)
    else:
        drives = [k for k, name in enumerate(names) if name in wanted]
        driven = [drives[k] for k in _independent([here[drives]])]
    states = _with_others(here, driven)
    free = np.array([k not in states for k in range(len(names))])
    has_moved = ~free & (np.abs(closed - mechanism.start) > 1e-9)
    q = np.where(
        has_moved, np.clip(np.round(closed, 9), problem.lower, problem.upper), np.where(free, closed, mechanism.start)
    )
    q = problem.close(q, rows, free)
    q = np.clip(_refine(tree, problem, q, rows, free), problem.lower, problem.upper)
    in_loops = {j.name for k, j in enumerate(mechanism.joints) if mechanism.signs[:, k].any()} | set(names)
    moved = {names[k] for k in driven}
    return Assembly(
        joints=tuple(joint.name for joint in tree.joints if joint.name in in_loops),
        freedoms=len(states),
        positions=_all_positions(tree, dict(zip(names, map(float, q), strict=True))),
        states=tuple(names[k] for k in states),
        driven=tuple(joint.name for joint in tree.joints if joint.name in moved | (wanted - in_loops)),
        excess=tuple(name for name in names if name in named - moved),
        reach=_reach(problem, q, rows, driven, free),
        closures=closures,
        gaps={loop.name: gap for loop, gap in zip(tree.loops, mechanism.gaps(mechanism.start), strict=True)},
    )


def _array(values: Any, dtype: type) -> Array:
    array = np.array(values, float)
    return array if dtype is float else np.vectorize(Decimal, otypes=[object])(array)


def _given_limits(limits: tuple[float, float]) -> tuple[float, float]:
    """Return limits, and none if they are equal: exporters leave them out, which then are both zero."""
    return (-math.inf, math.inf) if limits[0] == limits[1] else limits


def _cross(a: Array, b: Array) -> Array:
    """Return the vector products of rows; numpy's own takes five times as long, and has most of the time."""
    crossed: Array = a[:, [1, 2, 0]] * b[:, [2, 0, 1]] - a[:, [2, 0, 1]] * b[:, [1, 2, 0]]
    return crossed


def _turns(axes: Array, angles: Array) -> Array:
    """Return turns about axes as matrices, by Rodrigues' formula."""
    x, y, z = axes.T
    zero = x * 0
    skew = np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]).transpose(2, 0, 1)
    angles = angles.reshape(-1, 1, 1)
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
    poses[:, :3, 3] = _array([origin.xyz for origin in origins], dtype).reshape(-1, 3)
    angles = _array([origin.rpy for origin in origins], dtype).reshape(-1, 3)
    for k in (2, 1, 0):
        poses[:, :3, :3] = poses[:, :3, :3] @ _turns(_array(np.eye(3)[[k] * len(origins)], dtype), angles[:, k])
    return poses


def _path(by_child: Mapping[str, Joint], link: str) -> Iterator[str]:
    while link in by_child:
        yield by_child[link].name
        link = by_child[link].parent


def _roots(tree: KinematicTree) -> Mapping[str, tuple[str, float, float]]:
    """Return for each joint the joint that it follows in the end, with multiplier and offset; itself if it does not."""
    roots: dict[str, tuple[str, float, float]] = {}
    for joint in tree.leaders_first():
        roots[joint.name] = joint.name, 1.0, 0.0
        if joint.mimic is not None:
            leader, multiplier, offset = roots[joint.mimic.joint]
            factor = joint.mimic.multiplier
            roots[joint.name] = leader, factor * multiplier, factor * offset + joint.mimic.offset
    return roots


def _spectrum(matrix: Array) -> tuple[Array, Array]:
    """Return the squares of the singular values, smallest first, and the directions of columns that they belong to.

    `numpy.linalg.svd` takes 50 ms for 40 joints on a busy machine, by its threads, and this half of one.
    """
    squares, directions = np.linalg.eigh(matrix.T @ matrix)
    return squares, directions


def _independent(matrices: Sequence[Array]) -> list[int]:
    """Return the rows that are independent of those before them in most of the matrices."""
    bases = [np.zeros((0, matrix.shape[1])) for matrix in matrices]
    chosen = []
    for k in range(len(matrices[0])):
        rests = [_rest(matrix[k], basis) for matrix, basis in zip(matrices, bases, strict=True)]
        lengths = [float(np.linalg.norm(rest)) for rest in rests]
        if sorted(lengths)[len(lengths) // 2] > _INDEPENDENT:
            chosen.append(k)
            pairs = zip(bases, rests, lengths, strict=True)
            bases = [np.vstack([basis, rest / (length or 1.0)]) for basis, rest, length in pairs]
    return chosen


def _rest(row: Array, basis: Array) -> Array:
    for _ in range(2):  # the second time takes away what rounding left
        row = row - basis.T @ (basis @ row)
    return row


def _null_space(matrix: Array) -> Array:
    """Return the directions that independent equations leave, as columns."""
    return _spectrum(matrix)[1][:, : matrix.shape[1] - len(matrix)]


def _with_others(space: Array, states: Sequence[int]) -> list[int]:
    """Return states and further ones, until nothing else can move; each moves nearly as freely as any that is left."""
    states, basis = list(states), np.zeros((0, space.shape[1]))
    for k in states:
        rest = _rest(space[k], basis)
        basis = np.vstack([basis, rest / np.linalg.norm(rest)])
    while len(states) < space.shape[1]:
        rests = space - (space @ basis.T) @ basis
        lengths = np.linalg.norm(rests, axis=1)
        k = int(np.argmax(lengths > 0.43 * lengths.max()))
        states.append(k)
        basis = np.vstack([basis, _rest(space[k], basis) / np.linalg.norm(_rest(space[k], basis))])
    return states


def _across(normal: Vector) -> tuple[Vector, Vector]:
    """Return two unit vectors that complete a unit vector to a frame: the other two axes, if it is one."""
    sizes = [abs(value) for value in normal]
    k = sizes.index(min(sizes))
    x, y, z = ((1.0 if i == k else 0.0) - normal[k] * value for i, value in enumerate(normal))
    length = math.sqrt(x * x + y * y + z * z)
    x, y, z = x / length, y / length, z / length
    a, b, c = normal
    return (x, y, z), (b * z - c * y, c * x - a * z, a * y - b * x)


def _normal(mechanism: Mechanism, loop: int) -> Vector | None:
    """Return the normal of the plane in which a loop moves, in the frame of its parent; None if it is spatial."""
    poses = mechanism.poses(mechanism.start)
    turns, moves = mechanism.twists(poses)
    in_loop = mechanism.signs[loop] != 0
    axes, ways = turns[in_loop & (mechanism.turns[:, 0] == 1)], moves[in_loop & (mechanism.slides[:, 0] == 1)]
    if not len(axes) or np.linalg.norm(np.cross(axes, axes[0]), axis=1).max() > _PARALLEL:
        return None
    if np.abs(ways @ axes[0]).max(initial=0.0) > _PARALLEL:
        return None
    frame = mechanism.frames(poses)[0][loop]
    x, y, z = (round(float(value), 9) + 0.0 for value in frame[:3, :3].T @ axes[0])
    sign = next((math.copysign(1.0, value) for value in (x, y, z) if value), 1.0)
    return sign * x + 0.0, sign * y + 0.0, sign * z + 0.0


_Equation = tuple[Vector, tuple[float, float, float, float], float]
"""A row of `Rows`: u, v and the product."""
_AXES: tuple[Vector, Vector, Vector] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_ORIGIN = (0.0, 0.0, 0.0, 1.0)


def _equations_of_kind(loop: Loop) -> list[_Equation]:
    """Return more equations than are independent: they leave most where a loop is closed the wrong way round."""
    axes = {"revolute": [loop.axis], "fixed": _AXES}.get(loop.kind, ())
    pairs = [(u, v) for v in axes for u in _AXES] if axes else []
    equations: list[_Equation] = [(u, _ORIGIN, 0.0) for u in _AXES]
    equations += [(u, (*v, 0.0), dot(u, v)) for u, v in pairs]
    return equations + ([(loop.axis, (*loop.child_axis, 0.0), 0.0)] if loop.kind == "universal" else [])


def _equations(loop: Loop, normal: Vector | None) -> list[_Equation]:
    """Return the equations of the kind of a loop; those of its plane come first."""
    x, y, z = (*_across(normal), normal) if normal else _AXES
    pairs: Sequence[tuple[Vector, Vector]] = ()
    if loop.kind == "revolute":
        pairs = [(across, loop.axis) for across in _across(loop.axis)]
    elif loop.kind == "universal":
        pairs = [(loop.axis, loop.child_axis)]
    elif loop.kind == "fixed":
        pairs = [(x, y), (y, z), (z, x)]
    return [*((u, _ORIGIN, 0.0) for u in (x, y, z)), *((u, (*v, 0.0), 0.0) for u, v in pairs)]


def _rows(equations: Iterable[Sequence[_Equation]]) -> Rows:
    """Return the equations of all loops as arrays."""
    rows = [(k, *equation) for k, loop in enumerate(equations) for equation in loop]
    loops, u, v, products = zip(*rows, strict=True)
    return Rows(np.array(loops), np.array(u), np.array(v), np.array(products))


def _closure(loop: Loop, candidates: Rows, rows: Rows, k: int, normal: Vector | None) -> Closure:
    """Return the chosen equations of one loop."""
    equations = [(tuple(u), tuple(v)) for u, v in zip(rows.u.tolist(), rows.v.tolist(), strict=True)]
    mine = [equation for equation, owner in zip(equations, rows.loops, strict=True) if owner == k]
    translations = tuple(u for u, v in mine if v == _ORIGIN)
    rotations = tuple((u, v[:3]) for u, v in mine if v != _ORIGIN)
    whole = int((candidates.loops == k).sum())
    is_planar = normal is not None and translations == _across(normal)
    weaker = None
    if len(mine) < whole and not (is_planar and len(rotations) == (loop.kind == "fixed")):
        weaker = f"closed by {len(mine)} of {whole} equations: the others follow from these and the rest of the robot"
    return Closure(translations, rotations, normal if is_planar and not rotations else None, weaker)


def _motions(count: int) -> Iterator[Array]:
    """Yield motions of all joints between -1 and 1, without pattern and the same on every machine."""
    index = np.arange(1, count + 1)
    for pose in range(1, 1 + 4 * _POSES):
        yield 2 * ((index * 0.6180339887498949 + pose * index * 0.4142135623730951) % 1) - 1


def _closed_near(problem: _Problem, rows: Rows, held: Array) -> Array:
    """Return a closed pose near the start, or the least open one. Where that is possible, some joints stay there."""
    start, tried = problem.mechanism.start, list[Array]()
    for motion in (np.zeros(len(start)), *itertools.islice(_motions(len(start)), _POSES)):
        near = np.clip(start + 2 * _AMPLITUDES[0] * motion * problem.units, problem.lower, problem.upper)
        for free in (~held, np.full(len(start), True)):
            tried.append(problem.close(np.where(free, near, start), rows, free))
            if problem.openness(tried[-1], rows) < _CLOSED_ANGLE:
                return tried[-1]
    return min(tried, key=lambda q: problem.openness(q, rows))


def _generic_poses(problem: _Problem, closed: Array, rows: Rows) -> list[Array]:
    """Return closed poses around one, limits aside; that one if there are no others."""
    poses: list[Array] = []
    for motion in _motions(len(closed)):
        for amplitude in _AMPLITUDES:
            q = problem.close(closed + amplitude * motion * problem.units, rows, bounded=False)
            if problem.openness(q, rows) < 3 * _CLOSED_ANGLE:
                poses.append(q)
                break
        if len(poses) == _POSES:
            break
    return poses or [closed]


def _refine(tree: KinematicTree, problem: _Problem, q: Array, rows: Rows, free: Array) -> Array:
    """Return the positions with twelve digits that do not depend on how a machine rounds."""
    exact, at = Mechanism(tree, object), _array(q, object)
    exact_rows = rows.take(range(len(rows.loops)), object)
    inverse = np.linalg.inv(problem.mechanism.evaluate(q, rows)[1][:, free])
    for _ in range(3):  # each step gains at least half the digits that a float has
        at[free] = at[free] - _array(inverse @ exact.evaluate(at, exact_rows)[0].astype(float), object)
    return np.where(free, [float(round(value, 12)) + 0.0 for value in at], q)


def _all_positions(tree: KinematicTree, closed: Mapping[str, float]) -> Mapping[str, float]:
    """Return the positions of all joints with one axis; those that no loop concerns are at their start."""
    positions = {**start_positions(tree), **closed}
    for joint in tree.leaders_first():
        if joint.mimic is not None:
            positions[joint.name] = joint.mimic.multiplier * positions[joint.mimic.joint] + joint.mimic.offset
    return {joint.name: positions[joint.name] for joint in tree.joints if joint.type in MOTION_KINDS}


def _reach(problem: _Problem, q: Array, rows: Rows, driven: Sequence[int], free: Array) -> Mapping[str, float]:
    """Return the longest ways of the driven joints, by following the loops along the way that Test takes."""
    joints = problem.mechanism.independent
    reach = {k: _SWEEP[MOTION_KINDS[joints[k].type]] for k in driven}
    while True:  # ends when no joint turns to its other side, which each does once at most
        ways = {k: _way(joints[k], float(q[k]), reach[k]) for k in driven}
        done = _follow(problem, q, rows, ways, free)
        if done == _STEPS:
            return {joints[k].name: reach[k] for k in driven}
        reach = {k: abs(way) * done / _STEPS / 2 for k, way in ways.items()}


def _way(joint: Joint, start: float, reach: float) -> float:
    """Return the way that a sweep of the library takes: see Functions.sweepEnd."""
    lower, upper = _given_limits(own_range(joint))
    velocity = math.inf if joint.limit is None or joint.limit.velocity is None else joint.limit.velocity
    room = min(_SWEEP_MARGIN * velocity * _SWEEP_PERIOD / math.pi, reach)
    above, below = min(room, _SWEEP_MARGIN * (upper - start)), min(room, _SWEEP_MARGIN * (start - lower))
    return above if above >= below else -below


def _follow(problem: _Problem, q: Array, rows: Rows, ways: Mapping[int, float], free: Array) -> int:
    """Return the number of steps along the ways up to which the loops are closed, regular and within limits."""
    way, start, at = np.zeros(len(q)), q, q
    for k, value in ways.items():
        way[k] = value
    limit = _least(problem.jacobian(q, rows)[:, free]) / 4
    for step in range(1, _STEPS + 1):
        at = problem.close(np.where(free, at, start + way * step / _STEPS), rows, free, bounded=False)
        is_within = ((at >= problem.lower - 1e-9) & (at <= problem.upper + 1e-9)).all()
        is_regular = _least(problem.jacobian(at, rows)[:, free]) > limit
        if not (is_within and is_regular and problem.openness(at, rows) < 1e-9):
            return step - 1
    return _STEPS


def _least(matrix: Array) -> float:
    """Return the smallest singular value; infinite without any."""
    return math.sqrt(max(0.0, float(_spectrum(matrix)[0].min(initial=math.inf))))


def _structural_faults(tree: KinematicTree, mechanism: Mechanism) -> Iterator[LoopFault]:
    """Yield loops that nothing moves, and those with joints that have more than one freedom."""
    by_child = {joint.child: joint for joint in tree.joints}
    for loop, signs in zip(tree.loops, mechanism.signs, strict=True):
        in_loop = {*_path(by_child, loop.parent)} ^ {*_path(by_child, loop.child)}
        free = [j for j in mechanism.joints if j.name in in_loop and j.type in ("planar", "floating")]
        if free:
            message = f"loop {loop.name!r} has the {free[0].type} joint {free[0].name!r}, which no loop can hold"
            yield LoopFault("loop-free-joint", loop.name, message, "use joints with one axis in a loop")
        elif not (signs @ mechanism.gears).any():
            message = f"loop {loop.name!r}: no joint moves link {loop.child!r} against link {loop.parent!r}"
            yield LoopFault("loop-rigid", loop.name, message, "remove the loop, or give it joints that move")


def _open_faults(mechanism: Mechanism, q: Array) -> Iterator[LoopFault]:
    """Yield the loops that are not closed, with their gaps."""
    for loop, gap, start in zip(mechanism.loops, mechanism.gaps(q), mechanism.gaps(mechanism.start), strict=True):
        if gap.distance > _CLOSED or gap.angle > _CLOSED_ANGLE:
            message = (
                f"loop {loop.name!r} cannot be closed: its frames on links {loop.parent!r} and {loop.child!r} stay "
                f"{_apart(gap)} apart ({_apart(start)} at the start)"
            )
            yield LoopFault(
                "loop-open", loop.name, message, "correct its frames, or the start and limits of its joints"
            )


def _apart(gap: Gap) -> str:
    return f"{1000 * gap.distance:.3g} mm and {math.degrees(gap.angle):.3g}°"


def _redundant_faults(closures: Mapping[str, Closure]) -> Iterator[LoopFault]:
    for name, closure in closures.items():
        if not closure.translations and not closure.rotations:
            message = f"loop {name!r} holds nothing that the other loops and joints do not hold already"
            yield LoopFault("loop-redundant", name, message, "remove one of them")


def _singular(loop: Loop, reason: str) -> LoopFault:
    message = f"loop {loop.name!r} is singular: {reason}"
    hint = "let its joints start elsewhere, by `start` in the configuration"
    return LoopFault("loop-singular", loop.name, message, hint)
