"""Closes the loops of a robot: finds the start pose, the degrees of freedom, and the equations and states of the model.

Generic poses are closed poses near the start, reached by small motions of all joints. At generic poses, the constraints
have the full rank of the mechanism; at the start, the rank may be lower. Numbers are compared without units: lengths of
a loop are divided by the size of the loop. All machines give the same result: choices have a fixed order and one
tolerance, and the start is refined in decimals.
"""

from __future__ import annotations

import functools
import itertools
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace

from urdfsync.common.spelling import counted
from urdfsync.formats.urdf.kinematics.loops import NOTABLE, ClosedLoops, Closure, Gap
from urdfsync.formats.urdf.kinematics.mechanism import (
    ORIGIN,
    Array,
    Equation,
    Mechanism,
    Rows,
    array_of,
    joints_of_loops,
)
from urdfsync.formats.urdf.kinematics.poses import AXES, SWEEP, across, own_range, position_ranges, sweep_way
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import MOTION_KINDS, Joint, Loop, Vector
from urdfsync.formats.urdf.validate import Finding

_PARALLEL = 1e-4
"""In rad: the greatest angle between axes that count as parallel. Exporters write 1.5708 for π/2."""
_INDEPENDENT = 1e-3
"""A vector without units is independent of others if its part at right angles to the others is longer.

Axes that count as parallel leave a shorter part.
"""
_CLOSED = 1e-4
"""Greatest gap of a closed loop, in m."""
_CLOSED_ANGLE = 1e-3
_AMPLITUDES = (0.4, 0.2, 0.1, 0.05)
"""In rad: sizes of the motions to generic poses, in the order of trial."""
_POSES = 3
_STEPS = 16
"""Number of steps that check the motion of Test."""
_PASSIVE = re.compile("passive|unactuated|undriven", re.IGNORECASE)
_MOST_LOOPS, _MOST_JOINTS = 200, 1000
_MOST_WORK = 6 * 10**10
"""The limit of multiplications to close all loops: they take ten seconds. 110 four-bars take 10¹⁰."""


class _Problem(Mechanism):
    """A mechanism whose loops are to be closed. Numbers have no units: lengths of a loop are divided by its size."""

    def __init__(self, tree: KinematicTree) -> None:
        super().__init__(tree)
        self.tree = tree
        ranges = position_ranges(tree)
        limits = [_given_limits(ranges[joint.name]) for joint in self.independent]
        lower, upper = np.array(limits).reshape(-1, 2).T
        self.lower, self.upper = np.minimum(lower, self.start), np.maximum(upper, self.start)
        poses = self.poses(self.start)
        levers = np.linalg.norm(poses[None, 1:, :3, 3] - self.frames(poses)[1][:, None, :3, 3], axis=2)
        sizes = (levers * (self.signs != 0) * self.turns.T).max(axis=1)
        self.sizes = np.where(sizes > 0, sizes, 1.0)
        """Size of each loop: the distance from its frames to the farthest axis; 1 without axes."""
        self.units = np.ones(len(limits))
        for k, joint in enumerate(self.independent):
            if joint.type == "prismatic":  # the unit of a slide is the size of its first loop
                self.units[k] = self.sizes[np.argmax(self.moves[:, k])]
        self.work = 0

    def scaled(self, q: Array, rows: Rows) -> tuple[Array, Array]:
        """Return the residuals of the equations and their derivatives, without units."""
        gaps, jacobian = self.evaluate(q, rows)
        scales = np.where(rows.v[:, 3] == 1, self.sizes[rows.loops], 1.0)
        return gaps / scales, jacobian * self.units / scales[:, None]

    def jacobian(self, q: Array, rows: Rows) -> Array:
        """Return the derivatives of the equations, without units."""
        return self.scaled(q, rows)[1]

    def close(self, start: Array, rows: Rows, free: Array | None = None, *, bounded: bool = True) -> Array:
        """Return the pose near a start with the least residuals, by Levenberg's method; only the free joints move.

        The `whole` equations depend on each other, and inexact numbers leave residuals. So a step leaves out
        directions that hardly change the residuals of these equations.
        """
        least = _INDEPENDENT**2 if rows is self.whole else 1e-12  # chosen rows are independent
        q, caution, lower, upper = start, 1.0, self.lower, self.upper
        work = len(q) ** 2 * (len(q) + len(rows.loops))
        if not bounded:
            lower, upper = np.full(len(q), -math.inf), np.full(len(q), math.inf)
        gaps, jacobian = self.scaled(q, rows)
        for _ in range(60):
            movable = np.ones(len(q), bool) if free is None else free.copy()
            while True:  # repeated without the joints that would leave their limits
                self.work += work
                if self.work > _MOST_WORK:
                    raise _UnclosableError
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
        """Return the largest residual of the `whole` equations."""
        return float(np.abs(self.scaled(q, self.whole)[0]).max())

    def parts(self, held: Array) -> Iterator[tuple[_Problem, Array]]:
        """Yield each group of loops that share movable joints: a problem, with the columns of its joints."""
        labels, names = np.arange(len(self.loops)), [joint.name for joint in self.independent]
        for shared in self.moves[:, ~held].T:
            labels[np.isin(labels, labels[shared])] = labels[shared].min(initial=len(labels))
        if not labels.any():
            yield self, np.arange(len(names))
            return
        for label in sorted({*labels.tolist()}):
            part = _Problem(replace(self.tree, loops=tuple(itertools.compress(self.loops, labels == label))))
            part.work = self.work
            yield part, np.array([names.index(joint.name) for joint in part.independent], int)
            self.work = part.work

    def start_poses(self) -> Iterator[Array]:
        """Yield poses within limits: the start, poses around it, the middle of the limits, and poses anywhere."""
        motions = _motions(len(self.start), 12)
        lower = np.maximum(self.lower, self.start - math.pi * self.units)
        upper = np.minimum(self.upper, self.start + math.pi * self.units)
        yield self.start
        yield from (np.clip(self.start + 0.8 * motion * self.units, self.lower, self.upper) for motion in motions[:4])
        yield (lower + upper) / 2
        yield from ((lower + upper + (upper - lower) * motion) / 2 for motion in motions[4:])


class _UnclosableError(Exception):
    """Stops an assembly. Without `faults`, the assembly would take too long."""

    def __init__(self, *faults: Finding) -> None:
        self.faults = faults


# A build calls `assemble` five times, for two versions of the robot, and a call takes 40 ms.
@functools.lru_cache(maxsize=2)
def assemble(tree: KinematicTree, wanted: frozenset[str], named: frozenset[str]) -> ClosedLoops:
    """Close all loops of a robot near its start, or report the reason why they stay open.

    The options ask for drives of the `wanted` joints. Source or options name drives of the `named` joints. If no named
    joint is in a loop, independent wanted joints are driven, those with a limit of effort first.
    """
    try:
        with np.errstate(all="ignore"):  # huge numbers overflow, and a loop with NaN counts as open
            try:
                return _assemble(tree, wanted, named)
            except _UnclosableError as error:
                return ClosedLoops(tree=tree, driven=wanted, faults=error.faults or (_too_many(tree),))
    except np.linalg.LinAlgError:
        name = tree.loops[0].name
        fault = Finding("loop-open", f"loop {name}", f"loop {name!r} has numbers that are too large")
        return ClosedLoops(tree=tree, driven=wanted, faults=(fault,))


def _assemble(tree: KinematicTree, wanted: frozenset[str], named: frozenset[str]) -> ClosedLoops:
    if len(tree.loops) > _MOST_LOOPS or len(joints_of_loops(tree)) > _MOST_JOINTS:
        raise _UnclosableError
    problem = _Problem(tree)
    _check_joints(problem)
    names = [joint.name for joint in problem.independent]
    drives = [k for k, name in enumerate(names) if name in named]
    closed, kept = _closed_near(problem, drives)
    generic = _generic_poses(problem, closed)
    constraints = _constraints(problem, closed, generic)
    ranks = {k: _rank(joint) for k, joint in enumerate(problem.independent) if joint.name in wanted}
    driven = _driven(problem, constraints, generic, drives, ranks)
    states = _with_others(constraints.freedom, driven)
    # driven joints also keep their starts, which have few digits
    q = _refined_start(problem, constraints, closed, [*kept, *driven])
    starts = dict(zip(names, map(float, q), strict=True))
    joints = tuple(replace(joint, start=starts.get(joint.name, joint.start)) for joint in tree.joints)
    in_loops = {j.name for k, j in enumerate(problem.joints) if problem.signs[:, k].any()} | set(names)
    moved, free = {names[k] for k in driven}, np.array([k not in states for k in range(len(names))])
    return ClosedLoops(
        tree=replace(tree, joints=joints),
        joints=tuple(joint.name for joint in joints if joint.name in in_loops),
        states=tuple(names[k] for k in states),
        driven=frozenset(joint.name for joint in joints if joint.name in moved | (wanted - in_loops)),
        excess=tuple(name for name in names if name in named - moved),
        reach=_reach(problem, q, constraints.rows, driven, free),
        closures=constraints.closures,
        moved={
            joint.name: f"by {abs(starts[joint.name] - joint.start):.3g} {'m' if joint.type == 'prismatic' else 'rad'}"
            for joint in problem.independent
            if joint.start is not None and abs(starts[joint.name] - joint.start) > NOTABLE
        },
        choices={names[k]: _reason(ranks, k) for k in sorted(driven) if k not in drives},
        gaps={loop.name: gap for loop, gap in zip(tree.loops, problem.gaps(problem.start), strict=True)},
    )


class _Constraints(NamedTuple):
    """Equations that close all loops, and do not depend on each other."""

    rows: Rows
    closures: Mapping[str, Closure]
    """The same equations by name of loop."""
    freedom: Array
    """The free directions of the movable joints at the closed start, as columns."""


def _constraints(problem: _Problem, closed: Array, generic: Sequence[Array]) -> _Constraints:
    """Choose equations that are independent at generic poses; raise an error if they are not at the closed start."""
    loops, normals = problem.tree.loops, [_normal(problem, k) for k in range(len(problem.tree.loops))]
    candidates = Rows.of(map(_equations, loops, normals))
    rows = candidates.take(_independent([problem.jacobian(q, candidates) for q in generic]))
    if idle := [loop.name for k, loop in enumerate(loops) if k not in rows.loops]:
        reason = "is redundant: other loops and joints already hold its links"
        raise _UnclosableError(*(Finding("loop-redundant", f"loop {name}", f"loop {name!r} {reason}") for name in idle))
    at_start = problem.jacobian(closed, rows)
    for k, row in enumerate([*_independent([at_start]), -1][: len(rows.loops)]):
        if row != k:
            raise _singular(loops[rows.loops[k]], "its equations depend on each other only there")
    closures = {loop.name: _closure(loop, candidates, rows, k, normals[k]) for k, loop in enumerate(loops)}
    return _Constraints(rows, closures, _null_space(at_start))


def _driven(
    problem: _Problem,
    constraints: _Constraints,
    generic: Sequence[Array],
    drives: Sequence[int],
    ranks: Mapping[int, int],
) -> list[int]:
    """Return the joints to drive: those of `drives` that can be, else the best by `ranks`.

    Raises an error for a drive at a dead point.
    """
    if drives:
        spaces = [_null_space(problem.jacobian(q, constraints.rows)) for q in generic]
        drives = [drives[k] for k in _independent([space[drives] for space in spaces])]
    best = min(ranks.values(), default=0)
    tried = drives or sorted((k for k in ranks if ranks[k] < len(_REASONS) or ranks[k] == best), key=ranks.__getitem__)
    driven = [tried[k] for k in _independent([constraints.freedom[tried]])]
    for k in drives:
        if k not in driven:
            loop, name = problem.tree.loops[np.argmax(problem.moves[:, k])], problem.independent[k].name
            raise _singular(loop, f"joint {name!r} is at a dead point")
    return driven


def _refined_start(problem: _Problem, constraints: _Constraints, closed: Array, kept: Sequence[int]) -> Array:
    """Return the closed pose to all digits; joints in `kept` keep their few digits if the others can follow.

    Raises an error if a loop is open after all.
    """
    rows, freedom = constraints.rows, constraints.freedom
    exact = _with_others(freedom, [kept[k] for k in _independent([freedom[kept]])])
    free = np.array([k not in exact for k in range(len(closed))])
    q = np.where(np.abs(closed - problem.start) > 1e-9, np.round(closed, 9), problem.start)
    q = problem.close(np.where(free, closed, np.clip(q, problem.lower, problem.upper)), rows, free)
    q = np.clip(_refine(problem.tree, problem, q, rows, free), problem.lower, problem.upper)
    if list(_open_loops(problem, q)):
        raise _UnclosableError(*_find_open(problem, q))
    return q


def _given_limits(limits: tuple[float, float]) -> tuple[float, float]:
    """Return the limits; no limits if both are equal, since some exporters write zero twice."""
    return (-math.inf, math.inf) if limits[0] == limits[1] else limits


def _spectrum(matrix: Array) -> tuple[Array, Array]:
    """Return the squares of the singular values, smallest first, and the right singular vectors as columns.

    For 40 joints on a busy machine, `eigh` takes half a millisecond; `numpy.linalg.svd` takes 50 ms, due to its
    threads.
    """
    squares, directions = np.linalg.eigh(matrix.T @ matrix)
    return squares, directions


def _independent(matrices: Sequence[Array]) -> list[int]:
    """Return the numbers of the rows that, in most matrices, are independent of the rows before."""
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
    for _ in range(2):  # the second round removes rounding errors
        row = row - basis.T @ (basis @ row)
    return row


def _null_space(matrix: Array) -> Array:
    """Return the free directions of independent equations, as columns."""
    return _spectrum(matrix)[1][:, : matrix.shape[1] - len(matrix)]


def _with_others(space: Array, states: Sequence[int]) -> list[int]:
    """Extend `states` to all freedoms: each step adds the first joint with 43 % or more of the largest freedom."""
    states = list(states)
    while len(states) < space.shape[1]:
        held = space[states]
        lengths = np.linalg.norm(space - space @ held.T @ np.linalg.solve(held @ held.T, held), axis=1)
        states.append(int(np.argmax(lengths > 0.43 * lengths.max())))
    return states


def _normal(mechanism: Mechanism, loop: int) -> Vector | None:
    """Return the normal of a loop's plane of motion, in the frame of its parent; None for a spatial loop."""
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
    """Return the equations of a loop's kind; equations in its plane come first."""
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
    return Closure(translations, rotations, normal if is_planar and not rotations else None, weaker)


_REASONS = ("by its limit of effort", "the first free one")
"""Reasons to drive a joint, the best first."""


def _rank(joint: Joint) -> int:
    """Return the number of the reason to drive a joint; a greater number if its name says that it is passive."""
    if _PASSIVE.search(joint.name):
        return len(_REASONS)
    return 0 if joint.limit is not None and joint.limit.effort else 1


def _reason(ranks: Mapping[int, int], k: int) -> str:
    """Return the reason to drive a joint. If all joints have one reason, this reason does not count."""
    return _REASONS[ranks[k] if ranks[k] < max(ranks.values()) else -1]


def _motions(count: int, number: int = 4) -> list[Array]:
    """Return motions of all joints, between -1 and 1: irregular, but equal on all machines."""
    index = np.arange(1, count + 1)
    return [2 * ((index * 0.6180339887498949 + k * index * 0.4142135623730951) % 1) - 1 for k in range(1, number + 1)]


def _closed_near(problem: _Problem, drives: Sequence[int]) -> tuple[Array, list[int]]:
    """Return a closed pose near the start, and the joints that stay exactly at their starts.

    As many joints as possible keep their given starts. Other driven joints stay if the loops can be closed nearby.
    Raises an error for loops that cannot be closed.
    """
    q, kept, faults = problem.start.copy(), list[int](), list[Finding]()
    for part, columns in problem.parts(np.zeros(len(q), bool)):
        driven = tuple(at for at, k in enumerate(columns.tolist()) if k in drives)
        given = tuple(at for at, joint in enumerate(part.independent) if joint.start is not None)
        given = tuple(sorted(given, key=lambda at: at not in driven))
        both = tuple(dict.fromkeys((*given, *driven)))
        opened = dict[Sequence[int], list[tuple[_Problem, Array]]]()
        # moved drives are better than a far pose, a far pose is better than none
        for held, most in dict.fromkeys(((both, 1), (given, None), (driven, 1), ((), None), (driven, None))):
            closed, opened[held] = _search(part, held, most)
            if not opened[held]:
                stay, q[columns] = _keep(part, held, given, closed)
                kept += columns[stay].tolist()
                break
        else:
            faults += [fault for open_part, best in opened[()] for fault in _find_open(open_part, best)]
    if faults:
        raise _UnclosableError(*faults)
    return q, kept


def _keep(part: _Problem, held: Sequence[int], given: Sequence[int], closed: Array) -> tuple[list[int], Array]:
    """Hold more `given` joints, one by one, while the loops close; return the held joints and the closed pose."""
    kept = [*held]
    for k in given if not set(given).issubset(held) else []:
        squares, directions = _spectrum(part.jacobian(closed, part.whole))
        freedom = directions[:, squares < _INDEPENDENT**2]
        if len(kept) == freedom.shape[1]:
            break
        if len(_independent([freedom[[*kept, k]]])) == len(kept) + 1:
            moved, open_parts = _search(part, [*kept, k])
            if not open_parts:
                kept, closed = [*kept, k], moved
    return kept, closed


def _search(
    problem: _Problem, held: Sequence[int], most: int | None = None
) -> tuple[Array, list[tuple[_Problem, Array]]]:
    """Return a closed pose within limits, with the `held` joints at the start; also the open loops in their best poses.

    Loops that share no movable joint are closed separately, each from up to `most` poses.
    """
    q, open_parts = problem.start.copy(), list[tuple[_Problem, Array]]()
    is_held = np.zeros(len(q), bool)
    is_held[list(held)] = True
    for part, columns in problem.parts(is_held):
        free, tried = ~is_held[columns], list[Array]()
        for near in itertools.islice(part.start_poses(), most if free.any() else 1):
            tried.append(part.close(np.where(free, near, part.start), part.whole, free))
            if not list(_open_loops(part, tried[-1])):
                q[columns] = tried[-1]
                break
        else:
            open_parts.append((part, min(tried, key=part.openness)))
    return q, open_parts


def _generic_poses(problem: _Problem, closed: Array) -> list[Array]:
    """Return closed poses around `closed`, without regard to limits; `closed` itself if no other is found."""
    motions = [size * motion * problem.units for size in _AMPLITUDES for motion in _motions(len(closed))]
    poses = (problem.close(closed + motion, problem.whole, bounded=False) for motion in motions)
    near = (q for q in poses if problem.openness(q) < 3 * _CLOSED_ANGLE)
    return list(itertools.islice(near, _POSES)) or [closed]


def _refine(tree: KinematicTree, problem: _Problem, q: Array, rows: Rows, free: Array) -> Array:
    """Return the positions with twelve digits, independent of the machine's rounding."""
    exact, at = Mechanism(tree, object), array_of(q, object)
    exact_rows = rows.take(range(len(rows.loops)), object)
    inverse = np.linalg.inv(problem.evaluate(q, rows)[1][:, free])
    for _ in range(3):  # each step adds at least half of a float's digits
        at[free] = at[free] - array_of(inverse @ exact.left(at, exact_rows).astype(float), object)
    return np.where(free, [float(round(value, 12)) + 0.0 for value in at], q)


def _reach(problem: _Problem, q: Array, rows: Rows, driven: Sequence[int], free: Array) -> Mapping[str, float]:
    """Return the distance that Test can move each driven joint if all move at once."""
    joints = problem.independent
    reach = {k: SWEEP[MOTION_KINDS[joints[k].type]] for k in driven}
    while True:  # this loop ends: each joint changes its side at most once
        ways = {k: _way(joints[k], float(q[k]), reach[k]) for k in driven}
        done = _follow(problem, q, rows, ways, free)
        if done < _STEPS:
            reach = {k: abs(way) * done / _STEPS / 2 for k, way in ways.items()}
        if done in (0, _STEPS):
            return {joints[k].name: reach[k] for k in driven}


def _way(joint: Joint, start: float, reach: float) -> float:
    return sweep_way(joint, start, reach, _given_limits(own_range(joint)))


def _follow(problem: _Problem, q: Array, rows: Rows, ways: Mapping[int, float], free: Array) -> int:
    """Return the number of steps until a loop opens or is singular, or a joint leaves its limits."""
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
    """Return the smallest singular value; infinite for an empty matrix."""
    return math.sqrt(max(0.0, float(_spectrum(matrix)[0].min(initial=math.inf))))


def _check_joints(mechanism: Mechanism) -> None:
    """Raise an error for loops that no joint moves, and for planar and floating joints in loops."""
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


def _find_open(problem: _Problem, q: Array) -> Iterator[Finding]:
    """Yield a finding for each open loop. If some loops cannot be closed even alone, report only these loops."""
    singles = [_Problem(replace(problem.tree, loops=(loop,))) for loop in problem.loops if len(problem.loops) > 1]
    if alone := [found for single in singles for found in _search(single, [])[1]]:
        for part, best in alone:
            yield from _find_open(part, best)
        return
    beyond, starts = problem.close(problem.start, problem.whole, bounded=False), problem.gaps(problem.start)
    is_outside = ((beyond < problem.lower) | (beyond > problem.upper)) & (not list(_open_loops(problem, beyond)))
    for loop, gap in _open_loops(problem, q):
        k = problem.loops.index(loop)
        message = (
            f"loop {loop.name!r} cannot be closed: its frames on links {loop.parent!r} and {loop.child!r} stay "
            f"{gap} apart ({starts[k]} at the start)"
        )
        names = [repr(problem.independent[j].name) for j in np.flatnonzero(is_outside & problem.moves[k])]
        hint = "the loop closes alone, but not with other loops: correct the frames of one loop" if singles else ""
        if names:
            hint = f"the loop closes beyond the limits of {', '.join(names)}: correct the limits, or its frames"
        yield Finding("loop-open", f"loop {loop.name}", message, hint)


def _too_many(tree: KinematicTree) -> Finding:
    counts = f"{counted(len(tree.loops), 'loop')} with {counted(len(joints_of_loops(tree)), 'joint')}"
    return Finding("loop-limit", f"loop {tree.loops[0].name}", f"{counts} take too long to close")


def _singular(loop: Loop, reason: str) -> _UnclosableError:
    message = f"loop {loop.name!r} is singular at the start: {reason}"
    return _UnclosableError(Finding("loop-singular", f"loop {loop.name}", message))
