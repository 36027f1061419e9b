"""Closes the loops of a robot: finds its start pose, its freedoms, and the equations and states of its model.

Generic poses are closed poses near the start, reached by small motions of all joints: only there the rank of the
constraints is that of the mechanism. Numbers are compared without units: lengths of a loop are divided by its size.
Choices have a fixed order and one tolerance, and the start is refined in decimals: all machines give the same result.
"""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from msgspec.structs import replace

from urdfsync.spelling import counted
from urdfsync.urdf.kinematics.loops import Assembly, Closure, Gap
from urdfsync.urdf.kinematics.mechanism import (
    AXES,
    ORIGIN,
    Array,
    Equation,
    Mechanism,
    Rows,
    array_of,
    joints_of_loops,
)
from urdfsync.urdf.kinematics.poses import across, own_range, position_ranges
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import MOTION_KINDS, Joint, Loop, Vector
from urdfsync.urdf.validate import Finding

_PARALLEL = 1e-4
"""Angle between axes that are meant to be parallel, in rad: exporters write 1.5708."""
_INDEPENDENT = 1e-3
"""Least part of a row or column, without units, that others do not cancel.

It is above the part that `_PARALLEL` leaves.
"""
_CLOSED = 1e-4
"""Greatest gap of a closed loop, in m."""
_CLOSED_ANGLE = 1e-3
_AMPLITUDES = (0.4, 0.2, 0.1, 0.05)
"""Motions to generic poses, in rad; the first closable one counts."""
_POSES = 3
_STEPS = 16
"""Steps of the way along which Test moves the driven joints."""
_SWEEP = {"rotational": 1.0, "translational": 0.1}
"""Longest way of a sweep in the library, in rad and m."""
_SWEEP_MARGIN, _SWEEP_PERIOD = 0.9, 10.0
_MOST_LOOPS, _MOST_JOINTS = 200, 1000
_MOST_WORK = 6 * 10**10
"""The most multiplications to close all loops: ten seconds. 110 four-bars take 10¹⁰."""


class _Problem(Mechanism):
    """A mechanism with open loops, without units: lengths of a loop are divided by its size."""

    def __init__(self, tree: KinematicTree) -> None:
        super().__init__(tree)
        ranges = position_ranges(tree)
        limits = [_given_limits(ranges[joint.name]) for joint in self.independent]
        lower, upper = np.array(limits).reshape(-1, 2).T
        self.lower, self.upper = np.minimum(lower, self.start), np.maximum(upper, self.start)
        poses = self.poses(self.start)
        levers = np.linalg.norm(poses[None, 1:, :3, 3] - self.frames(poses)[1][:, None, :3, 3], axis=2)
        sizes = (levers * (self.signs != 0) * self.turns.T).max(axis=1)
        self.sizes = np.where(sizes > 0, sizes, 1.0)
        """Of each loop, the distance from its frames to the farthest axis; 1 without axes."""
        self.units = np.ones(len(limits))
        for k, joint in enumerate(self.independent):
            if joint.type == "prismatic":  # it may move by the size of its first loop
                self.units[k] = self.sizes[np.argmax(self.moves[:, k])]
        self.work = 0

    def scaled(self, q: Array, rows: Rows) -> tuple[Array, Array]:
        """Return the residuals of the equations and their derivatives, without units."""
        gaps, jacobian = self.evaluate(q, rows)
        scales = np.where(rows.v[:, 3] == 1, self.sizes[rows.loops], 1.0)
        return gaps / scales, jacobian * self.units / scales[:, None]

    def jacobian(self, q: Array, rows: Rows) -> Array:
        """Return the derivatives alone."""
        return self.scaled(q, rows)[1]

    def close(self, start: Array, rows: Rows, free: Array | None = None, *, bounded: bool = True) -> Array:
        """Return the pose with the least residuals near a start, by Levenberg's method with the free joints.

        Directions in which the equations of the kinds are dependent do not count: residuals of inexact numbers stay
        there.
        """
        least = _INDEPENDENT**2 if rows is self.whole else 1e-12  # chosen rows are independent
        q, caution, lower, upper = start, 1.0, self.lower, self.upper
        work = len(q) ** 2 * (len(q) + len(rows.loops))
        if not bounded:
            lower, upper = np.full(len(q), -math.inf), np.full(len(q), math.inf)
        gaps, jacobian = self.scaled(q, rows)
        for _ in range(60):
            movable = np.ones(len(q), bool) if free is None else free.copy()
            while True:  # repeat without the joints that would leave their limits
                self.work += work
                if self.work > _MOST_WORK:
                    raise _too_many(len(self.loops), len(self.joints), self.loops[0])
                step = np.zeros(len(q))
                squares, directions = _spectrum(jacobian[:, movable])
                factors = (squares > least) / np.maximum(squares + caution * (gaps @ gaps), least)
                step[movable] = -directions @ (factors * (directions.T @ (jacobian[:, movable].T @ gaps)))
                blocked = movable & (((q <= lower) & (step < 0)) | ((q >= upper) & (step > 0)))
                if not blocked.any():
                    break
                movable &= ~blocked
            largest = float(np.abs(step).max(initial=0.0))
            if largest < 1e-13 or caution > 1e9:
                break
            moved = np.clip(q + step * self.units * min(1.0, 0.5 / largest), lower, upper)
            new_gaps, new_jacobian = self.scaled(moved, rows)
            if new_gaps @ new_gaps < gaps @ gaps:
                q, gaps, jacobian, caution = moved, new_gaps, new_jacobian, caution / 4
            else:
                caution *= 8
        return q

    def openness(self, q: Array) -> float:
        """Return the largest residual of the equations of the kinds."""
        return float(np.abs(self.scaled(q, self.whole)[0]).max())


class _UnclosableError(Exception):
    """Stops an assembly."""

    def __init__(self, *faults: Finding) -> None:
        self.faults = faults


# A build asks ten times, for two versions, and one takes 40 ms.
@functools.lru_cache(maxsize=2)
def assemble(tree: KinematicTree, wanted: frozenset[str], named: frozenset[str]) -> Assembly:
    """Close all loops of a robot near its start, or report why that is impossible.

    `wanted` joints shall be driven; the source or the options name `named` of them as drives. If none of these is in a
    loop, the first independent wanted ones are driven.
    """
    try:
        with np.errstate(all="ignore"):  # huge numbers overflow, and NaN counts as not closed
            return _assemble(tree, wanted, named)
    except _UnclosableError as error:
        faults = error.faults
    except np.linalg.LinAlgError:
        name = tree.loops[0].name
        faults = (Finding("loop-open", f"loop {name}", f"loop {name!r} has numbers that are too large"),)
    return Assembly(tree=tree, driven=wanted, faults=faults)


def _assemble(tree: KinematicTree, wanted: frozenset[str], named: frozenset[str]) -> Assembly:
    count = len(joints_of_loops(tree))
    if len(tree.loops) > _MOST_LOOPS or count > _MOST_JOINTS:
        raise _too_many(len(tree.loops), count, tree.loops[0])
    problem = _Problem(tree)
    _check_joints(problem)
    names = [joint.name for joint in problem.independent]
    closed = _closed_near(problem, np.array([name in named for name in names]))
    generic = _generic_poses(problem, closed)
    normals = [_normal(problem, k) for k in range(len(tree.loops))]
    candidates = Rows.of(map(_equations, tree.loops, normals))
    rows = candidates.take(_independent([problem.jacobian(q, candidates) for q in generic]))
    closures = {loop.name: _closure(loop, candidates, rows, k, normals[k]) for k, loop in enumerate(tree.loops)}
    at_start = problem.jacobian(closed, rows)
    for k, row in enumerate([*_independent([at_start]), -1][: len(rows.loops)]):
        if row != k:
            raise _singular(tree.loops[rows.loops[k]], "its equations depend on each other, though not elsewhere")
    freedom = _null_space(at_start)
    drives = [k for k, name in enumerate(names) if name in named]
    if drives:
        spaces = [_null_space(problem.jacobian(q, rows)) for q in generic]
        drives = [drives[k] for k in _independent([space[drives] for space in spaces])]
    driven = drives or [k for k, name in enumerate(names) if name in wanted]
    driven = [driven[k] for k in _independent([freedom[driven]])]
    for k in drives:
        if k not in driven:
            raise _singular(tree.loops[np.argmax(problem.moves[:, k])], f"joint {names[k]!r} is at a dead point")
    states = _with_others(freedom, driven)
    free = np.array([k not in states for k in range(len(names))])
    q = np.where(np.abs(closed - problem.start) > 1e-9, np.round(closed, 9), problem.start)
    q = problem.close(np.where(free, closed, np.clip(q, problem.lower, problem.upper)), rows, free)
    q = np.clip(_refine(tree, problem, q, rows, free), problem.lower, problem.upper)
    _check_closed(problem, q)
    in_loops = {j.name for k, j in enumerate(problem.joints) if problem.signs[:, k].any()} | set(names)
    moved = {names[k] for k in driven}
    starts = dict(zip(names, map(float, q), strict=True))
    joints = tuple(replace(joint, start=starts.get(joint.name, joint.start)) for joint in tree.joints)
    return Assembly(
        tree=replace(tree, joints=joints),
        joints=tuple(joint.name for joint in joints if joint.name in in_loops),
        states=tuple(names[k] for k in states),
        driven=frozenset(joint.name for joint in joints if joint.name in moved | (wanted - in_loops)),
        excess=tuple(name for name in names if name in named - moved),
        reach=_reach(problem, q, rows, driven, free),
        closures=closures,
        gaps={loop.name: gap for loop, gap in zip(tree.loops, problem.gaps(problem.start), strict=True)},
    )


def _given_limits(limits: tuple[float, float]) -> tuple[float, float]:
    """Return limits, and none if they are equal: both are zero if an exporter leaves them out."""
    return (-math.inf, math.inf) if limits[0] == limits[1] else limits


def _spectrum(matrix: Array) -> tuple[Array, Array]:
    """Return the squares of the singular values, smallest first, and their directions of columns.

    For 40 joints on a busy machine, `numpy.linalg.svd` takes 50 ms, by its threads, and this half a millisecond.
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
    for _ in range(2):  # the second time removes rounding errors
        row = row - basis.T @ (basis @ row)
    return row


def _null_space(matrix: Array) -> Array:
    """Return the directions that independent equations leave free, as columns."""
    return _spectrum(matrix)[1][:, : matrix.shape[1] - len(matrix)]


def _with_others(space: Array, states: Sequence[int]) -> list[int]:
    """Return states and further ones, until nothing else can move; each moves nearly as freely as any other one."""
    states = list(states)
    while len(states) < space.shape[1]:
        held = space[states]
        lengths = np.linalg.norm(space - space @ held.T @ np.linalg.solve(held @ held.T, held), axis=1)
        states.append(int(np.argmax(lengths > 0.43 * lengths.max())))
    return states


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


def _equations(loop: Loop, normal: Vector | None) -> list[Equation]:
    """Return the equations of a loop's kind; those of its plane come first."""
    x, y, z = (*across(normal), normal) if normal else AXES
    pairs: Sequence[tuple[Vector, Vector]] = ()
    if loop.kind == "revolute":
        pairs = [(across, loop.axis) for across in across(loop.axis)]
    elif loop.kind == "universal":
        pairs = [(loop.axis, loop.child_axis)]
    elif loop.kind == "fixed":
        pairs = [(x, y), (y, z), (z, x)]
    return [*((u, ORIGIN, 0.0) for u in (x, y, z)), *((u, (*v, 0.0), 0.0) for u, v in pairs)]


def _closure(loop: Loop, candidates: Rows, rows: Rows, k: int, normal: Vector | None) -> Closure:
    """Return the chosen equations of one loop."""
    equations = [(tuple(u), tuple(v)) for u, v in zip(rows.u.tolist(), rows.v.tolist(), strict=True)]
    mine = [equation for equation, owner in zip(equations, rows.loops, strict=True) if owner == k]
    translations = tuple(u for u, v in mine if v == ORIGIN)
    rotations = tuple((u, v[:3]) for u, v in mine if v != ORIGIN)
    whole = int((candidates.loops == k).sum())
    is_planar = normal is not None and translations == across(normal)
    weaker = None
    if len(mine) < whole and not (is_planar and len(rotations) == (loop.kind == "fixed")):
        weaker = f"closed by {len(mine)} of {whole} equations: the others follow from these and the rest of the robot"
    if not mine:
        message = f"loop {loop.name!r} is redundant: other loops and joints hold the same"
        raise _UnclosableError(Finding("loop-redundant", f"loop {loop.name}", message))
    return Closure(translations, rotations, normal if is_planar and not rotations else None, weaker)


def _motions(count: int) -> list[Array]:
    """Return some motions of all joints, between -1 and 1, without pattern and the same on every machine."""
    index = np.arange(1, count + 1)
    return [2 * ((index * 0.6180339887498949 + k * index * 0.4142135623730951) % 1) - 1 for k in range(1, 5)]


def _closed_near(problem: _Problem, held: Array) -> Array:
    """Return a closed pose near the start. If possible, some joints stay there."""
    start, tried, whole = problem.start, list[Array](), problem.whole
    for motion in (np.zeros(len(start)), *_motions(len(start))):
        near = np.clip(start + 0.8 * motion * problem.units, problem.lower, problem.upper)
        for free in (~held, np.full(len(start), fill_value=True)):
            tried.append(problem.close(np.where(free, near, start), whole, free))
            if not list(_open_loops(problem, tried[-1])):
                return tried[-1]
    beyond, hint = problem.close(start, whole, bounded=False), ""
    if not list(_open_loops(problem, beyond)):
        is_outside = (beyond < problem.lower) | (beyond > problem.upper)
        names = [repr(j.name) for j, outside in zip(problem.independent, is_outside, strict=True) if outside]
        hint = f"it closes beyond the limits of {', '.join(names)}: correct these, or its frames"
    best = min(tried, key=problem.openness)
    _check_closed(problem, best, hint)
    return best


def _generic_poses(problem: _Problem, closed: Array) -> list[Array]:
    """Return closed poses around one, without regard to limits; this one if there are no others."""
    motions = [size * motion * problem.units for size in _AMPLITUDES for motion in _motions(len(closed))]
    poses = (problem.close(closed + motion, problem.whole, bounded=False) for motion in motions)
    near = (q for q in poses if problem.openness(q) < 3 * _CLOSED_ANGLE)
    return list(itertools.islice(near, _POSES)) or [closed]


def _refine(tree: KinematicTree, problem: _Problem, q: Array, rows: Rows, free: Array) -> Array:
    """Return the positions with twelve digits that do not depend on a machine's rounding."""
    exact, at = Mechanism(tree, object), array_of(q, object)
    exact_rows = rows.take(range(len(rows.loops)), object)
    inverse = np.linalg.inv(problem.evaluate(q, rows)[1][:, free])
    for _ in range(3):  # each step gains at least half of a float's digits
        at[free] = at[free] - array_of(inverse @ exact.left(at, exact_rows).astype(float), object)
    return np.where(free, [float(round(value, 12)) + 0.0 for value in at], q)


def _reach(problem: _Problem, q: Array, rows: Rows, driven: Sequence[int], free: Array) -> Mapping[str, float]:
    """Return the longest ways of the driven joints, along the way that Test takes."""
    joints = problem.independent
    reach = {k: _SWEEP[MOTION_KINDS[joints[k].type]] for k in driven}
    while True:  # ends: each joint changes its side once at most
        ways = {k: _way(joints[k], float(q[k]), reach[k]) for k in driven}
        done = _follow(problem, q, rows, ways, free)
        if done < _STEPS:
            reach = {k: abs(way) * done / _STEPS / 2 for k, way in ways.items()}
        if done in (0, _STEPS):
            return {joints[k].name: reach[k] for k in driven}


def _way(joint: Joint, start: float, reach: float) -> float:
    """Return the way that a sweep of the library takes: see Functions.sweepEnd."""
    lower, upper = _given_limits(own_range(joint))
    velocity = math.inf if joint.limit is None or joint.limit.velocity is None else joint.limit.velocity
    room = min(_SWEEP_MARGIN * velocity * _SWEEP_PERIOD / math.pi, reach)
    above, below = min(room, _SWEEP_MARGIN * (upper - start)), min(room, _SWEEP_MARGIN * (start - lower))
    return above if above >= below else -below


def _follow(problem: _Problem, q: Array, rows: Rows, ways: Mapping[int, float], free: Array) -> int:
    """Return the number of steps along the ways with closed, regular loops within limits."""
    way, start, at = np.zeros(len(q)), q, q
    for k, value in ways.items():
        way[k] = value
    limit = _least(problem.jacobian(q, rows)[:, free]) / 4
    for step in range(1, _STEPS + 1):
        at = problem.close(np.where(free, at, start + way * step / _STEPS), rows, free, bounded=False)
        is_within = ((at >= problem.lower - 1e-9) & (at <= problem.upper + 1e-9)).all()
        is_regular = _least(problem.jacobian(at, rows)[:, free]) > limit
        if not (is_within and is_regular and np.abs(problem.scaled(at, rows)[0]).max() < 1e-9):
            return step - 1
    return _STEPS


def _least(matrix: Array) -> float:
    """Return the smallest singular value; infinite without any."""
    return math.sqrt(max(0.0, float(_spectrum(matrix)[0].min(initial=math.inf))))


def _check_joints(mechanism: Mechanism) -> None:
    """Raise an error for loops that nothing moves, and for joints in loops with more than one freedom."""
    faults = []
    for loop, path, moves in zip(mechanism.loops, mechanism.paths, mechanism.moves, strict=True):
        free = [j for j in mechanism.joints if j.name in path and j.type in ("planar", "floating")]
        if free:
            message = f"loop {loop.name!r} has the {free[0].type} joint {free[0].name!r}, which no loop can hold"
            faults.append(Finding("loop-free-joint", f"loop {loop.name}", message))
        elif not moves.any():
            message = f"loop {loop.name!r}: no joint moves link {loop.child!r} against link {loop.parent!r}"
            faults.append(Finding("loop-rigid", f"loop {loop.name}", message))
    if faults:
        raise _UnclosableError(*faults)


def _open_loops(problem: _Problem, q: Array) -> Iterator[tuple[Loop, Gap]]:
    gaps = problem.gaps(q)
    for loop, gap in zip(problem.loops, gaps, strict=True):
        if not (gap.distance <= _CLOSED and gap.angle <= _CLOSED_ANGLE):
            yield loop, gap


def _check_closed(problem: _Problem, q: Array, hint: str = "") -> None:
    """Raise an error for open loops."""
    faults = []
    starts = dict(zip(problem.loops, problem.gaps(problem.start), strict=True))
    for loop, gap in _open_loops(problem, q):
        message = (
            f"loop {loop.name!r} cannot be closed: its frames on links {loop.parent!r} and {loop.child!r} stay "
            f"{gap} apart ({starts[loop]} at the start)"
        )
        faults.append(Finding("loop-open", f"loop {loop.name}", message, hint))
    if faults:
        raise _UnclosableError(*faults)


def _too_many(loops: int, joints: int, first: Loop) -> _UnclosableError:
    message = f"{counted(loops, 'loop')} with {counted(joints, 'joint')} take too long to close"
    return _UnclosableError(Finding("loop-limit", f"loop {first.name}", message))


def _singular(loop: Loop, reason: str) -> _UnclosableError:
    message = f"loop {loop.name!r} is singular at the start: {reason}"
    return _UnclosableError(Finding("loop-singular", f"loop {loop.name}", message))
