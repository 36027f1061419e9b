"""Close the loops of a robot: its start pose, its freedoms, and the equations and states of its model.

Generic poses are closed ones that small motions of all joints lead to: only there is the rank of the constraints that
of the mechanism. Numbers are compared without units: lengths of a loop are divided by its size. What is chosen by them
is chosen in a fixed order by one tolerance, and the start is refined in decimals: it is the same on every machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from typing import Any, NamedTuple

import msgspec
import numpy as np
from numpy.typing import NDArray

from urdfsync.urdf.kinematics.poses import own_range, position_ranges, start_positions
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import MOTION_KINDS, Joint, Loop, Origin, Vector

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


class _Rows(NamedTuple):
    """Equations of a loop: translations as rows, then rotations as pairs of rows and their products."""

    along: Array
    u: Array
    v: Array
    products: Array

    @classmethod
    def of(cls, closure: Closure, dtype: type = float) -> _Rows:
        u, v = [u for u, _ in closure.rotations], [v for _, v in closure.rotations]
        along, u_rows, v_rows = (_array(vectors, dtype).reshape(-1, 3) for vectors in (closure.translations, u, v))
        return cls(along, u_rows, v_rows, np.zeros(len(u), int))

    @classmethod
    def of_kind(cls, loop: Loop) -> _Rows:
        """Return more equations than are independent: they leave most where a loop is closed the wrong way round."""
        if loop.kind == "fixed":
            u, v = np.repeat(np.eye(3), 3, axis=0), np.tile(np.eye(3), (3, 1))
        elif loop.kind == "revolute":
            u, v = np.eye(3), np.tile(loop.axis, (3, 1))
        else:
            pairs = [(loop.axis, loop.child_axis)] if loop.kind == "universal" else []
            u, v = (np.array(vectors).reshape(-1, 3) for vectors in ([u for u, _ in pairs], [v for _, v in pairs]))
        return cls(np.eye(3), u, v, np.zeros(len(u)) if loop.kind == "universal" else (u * v).sum(axis=1))


class _Chain(NamedTuple):
    """A loop in the arrays of a mechanism."""

    loop: Loop
    joints: list[int]
    """Joints on the way from one frame to the other, that have one axis."""
    signs: Array
    """1 for those that move the child, -1 for those that move the parent."""
    links: tuple[int, int]
    frames: Array
    """Poses of both frames in their links."""


class Mechanism:
    """The joints between the root and the frames of all loops, in numpy. `dtype` may be object, for decimals."""

    def __init__(self, tree: KinematicTree, dtype: type = float) -> None:
        by_child = {joint.child: joint for joint in tree.joints}
        paths = {link: list(_path(by_child, link)) for loop in tree.loops for link in (loop.parent, loop.child)}
        on_paths = {joint.name for path in paths.values() for joint in path}
        self.joints = [joint for joint in tree.joints if joint.name in on_paths]
        self._dtype = dtype
        index = {joint.child: k for k, joint in enumerate(self.joints, 1)}
        self._parents = [index.get(joint.parent, 0) for joint in self.joints]
        self._origins = _poses([joint.origin for joint in self.joints], dtype)
        self._axes = _array([joint.axis for joint in self.joints], dtype).reshape(-1, 3)
        self.turns = np.array([MOTION_KINDS.get(joint.type) == "rotational" for joint in self.joints])
        slides = np.array([MOTION_KINDS.get(joint.type) == "translational" for joint in self.joints])
        self._turning, self._sliding = self.turns.astype(int), slides.astype(int)
        self.chains = [self._chain(loop, paths, index) for loop in tree.loops]
        roots = _roots(tree)
        moving = {roots[self.joints[k].name][0] for chain in self.chains for k in chain.joints}
        self.independent = [joint for joint in tree.joints if joint.name in moving and joint.type in MOTION_KINDS]
        column = {joint.name: k for k, joint in enumerate(self.independent)}
        self._gears = _array(np.zeros((len(self.joints), len(column))), dtype)
        offsets = start_positions(tree)  # those of joints that no loop moves stay
        self._offsets = _array([offsets[joint.name] for joint in self.joints], dtype)
        for k, joint in enumerate(self.joints):
            leader, multiplier, offset = roots[joint.name]
            if leader in column:
                self._gears[k, column[leader]] = _array(multiplier, dtype)
                self._offsets[k] = _array(offset, dtype)

    def _chain(self, loop: Loop, paths: Mapping[str, list[Joint]], index: Mapping[str, int]) -> _Chain:
        sides = paths[loop.parent], paths[loop.child]
        names = [{joint.name for joint in side} for side in sides]
        only = names[0] ^ names[1]
        joints = [k for k, joint in enumerate(self.joints) if joint.name in only and joint.type in MOTION_KINDS]
        signs = np.array([1.0 if self.joints[k].name in names[1] else -1.0 for k in joints])
        frames = _poses([loop.origin, loop.child_origin], self._dtype)
        return _Chain(loop, joints, signs, (index.get(loop.parent, 0), index.get(loop.child, 0)), frames)

    def poses(self, q: Array) -> Array:
        """Return the poses of the root and of each joint's child, as matrices, at positions of independent joints."""
        positions = self._gears @ q + self._offsets
        moved: Array = np.zeros((len(self.joints), 4, 4), self._dtype)
        moved[:, :3, :3] = _turns(self._axes, positions * self._turning)
        moved[:, :3, 3] = self._axes * (positions * self._sliding)[:, None]
        moved[:, 3, 3] = 1
        local = self._origins @ moved
        poses: list[Array] = [np.eye(4, dtype=self._dtype)]
        for parent, pose in zip(self._parents, local, strict=True):
            poses.append(poses[parent] @ pose)
        return np.array(poses)

    def frames(self, poses: Array, chain: _Chain) -> tuple[Array, Array]:
        """Return the poses of both frames of a loop."""
        return poses[chain.links[0]] @ chain.frames[0], poses[chain.links[1]] @ chain.frames[1]

    def axes(self, poses: Array, chain: _Chain) -> tuple[Array, Array]:
        """Return the directions of the axes of a loop's joints, and the origins of these joints."""
        ends = poses[[k + 1 for k in chain.joints]]
        return np.einsum("kij,kj->ki", ends[:, :3, :3], self._axes[chain.joints]), ends[:, :3, 3]

    def gaps(self, q: Array, rows: Sequence[_Rows]) -> Array:
        """Return what the equations of all loops leave: lengths in m, and cosines."""
        poses, gaps = self.poses(q), []
        for chain, (along, u, v, products) in zip(self.chains, rows, strict=True):
            a, b = self.frames(poses, chain)
            cosines = ((u @ a[:3, :3].T) * (v @ b[:3, :3].T)).sum(axis=1)
            gaps += [along @ (a[:3, :3].T @ (b[:3, 3] - a[:3, 3])), cosines - products]
        return np.concatenate(gaps)

    def jacobian(self, q: Array, rows: Sequence[_Rows]) -> Array:
        """Return the derivative of `gaps` by the positions of the independent joints."""
        poses, blocks = self.poses(q), []
        for chain, (along, u, v, _) in zip(self.chains, rows, strict=True):
            a, b = self.frames(poses, chain)
            axes, points = self.axes(poses, chain)
            turning, signed = self.turns[chain.joints][:, None], axes * chain.signs[:, None]
            moves = np.where(turning, np.cross(signed, b[:3, 3] - points), signed)
            turns = np.where(turning, signed, 0.0)
            translations = along @ a[:3, :3].T @ moves.T
            rotations = np.cross(v @ b[:3, :3].T, u @ a[:3, :3].T) @ turns.T
            blocks.append(np.concatenate([translations, rotations]) @ self._gears[chain.joints])
        return np.concatenate(blocks)

    def gap(self, q: Array, chain: _Chain) -> Gap:
        """Return how far a pose is from closing a loop as its kind demands."""
        a, b = self.frames(self.poses(q), chain)
        rotation, loop, angle = a[:3, :3].T @ b[:3, :3], chain.loop, 0.0
        axis, child_axis = np.array(loop.axis), np.array(loop.child_axis)
        if loop.kind == "revolute":
            turned = rotation @ axis
            angle = math.atan2(float(np.linalg.norm(np.cross(axis, turned))), float(axis @ turned))
        elif loop.kind == "universal":
            angle = abs(math.asin(min(max(float(axis @ rotation @ child_axis), -1.0), 1.0)))
        elif loop.kind == "fixed":
            sines = rotation - rotation.T
            angle = math.atan2(float(np.linalg.norm(sines)) / math.sqrt(2), float(np.trace(rotation)) - 1)
        return Gap(float(np.linalg.norm(b[:3, 3] - a[:3, 3])), angle)


class _Problem:
    """A mechanism with equations, without units."""

    def __init__(self, mechanism: Mechanism, q: Array, lower: Array, upper: Array) -> None:
        self.mechanism, self.lower, self.upper = mechanism, lower, upper
        poses = mechanism.poses(q)
        sizes = [_size(mechanism, poses, chain) for chain in mechanism.chains]
        self.sizes, self.units = sizes, np.ones(len(q))
        for chain, size in reversed(list(zip(mechanism.chains, sizes, strict=True))):
            for k, joint in enumerate(mechanism.independent):
                if joint.type == "prismatic" and mechanism._gears[chain.joints, k].any():
                    self.units[k] = size  # of the first loop that it moves

    def scales(self, rows: Sequence[_Rows]) -> Array:
        """Return the units of all equations."""
        pairs = zip(self.sizes, rows, strict=True)
        return np.concatenate([[size] * len(row.along) + [1.0] * len(row.u) for size, row in pairs])

    def jacobian(self, q: Array, rows: Sequence[_Rows]) -> Array:
        """Return the Jacobian without units."""
        return self.mechanism.jacobian(q, rows) * self.units / self.scales(rows)[:, None]

    def close(self, start: Array, rows: Sequence[_Rows], free: Array | None = None, *, bounded: bool = True) -> Array:
        """Return where the equations leave least near a start, by Levenberg's method with the free joints.

        Directions in which the equations are dependent count for nothing: what inexact numbers leave there stays.
        """
        q, scales, damping = start, self.scales(rows), 1e-3
        lower, upper = (self.lower, self.upper) if bounded else (-np.inf, np.inf)
        gaps = self.mechanism.gaps(q, rows) / scales
        for _ in range(200):
            movable = np.ones(len(q), bool) if free is None else free.copy()
            jacobian = self.jacobian(q, rows)
            while True:  # without the joints that would leave their limits from where they end
                step = np.zeros(len(q))
                step[movable] = -_damped_inverse(jacobian[:, movable], damping) @ gaps
                blocked = movable & (((q <= lower) & (step < 0)) | ((q >= upper) & (step > 0)))
                if not blocked.any():
                    break
                movable &= ~blocked
            largest = float(np.abs(step).max(initial=0.0))
            moved = np.clip(q + step * self.units * min(1.0, 0.3 / max(largest, 1e-9)), lower, upper)
            new_gaps = self.mechanism.gaps(moved, rows) / scales
            if new_gaps @ new_gaps < gaps @ gaps:
                q, gaps, damping = moved, new_gaps, damping * 0.1 if damping > 1e-12 else 0.0
            else:
                damping = max(damping * 10, 1e-9)
            if largest < 1e-14 or damping > 1e4:
                break
        return q

    def is_closed(self, q: Array, rows: Sequence[_Rows], tolerance: float) -> bool:
        """Return whether what the equations leave is small, without units."""
        return bool(np.abs(self.mechanism.gaps(q, rows) / self.scales(rows)).max() < tolerance)


def assemble(tree: KinematicTree, wanted: frozenset[str], named: frozenset[str]) -> Assembly | tuple[LoopFault, ...]:
    """Close all loops of a robot that has any, near its start, or say why that is impossible.

    `wanted` joints are to be driven; of these the source or the options name `named` as drives. If none of these is in
    a loop, the first wanted ones that are independent are driven.
    """
    mechanism = Mechanism(tree)
    if faults := tuple(_structural_faults(tree, mechanism)):
        return faults
    starts, ranges = start_positions(tree), position_ranges(tree)
    start = np.array([starts[joint.name] for joint in mechanism.independent])
    lower, upper = np.array([ranges[joint.name] for joint in mechanism.independent]).T
    is_free = lower == upper  # exporters leave limits out, which then are both zero
    lower, upper = (
        np.where(is_free, -np.inf, np.minimum(lower, start)),
        np.where(is_free, np.inf, np.maximum(upper, start)),
    )
    problem = _Problem(mechanism, start, lower, upper)
    full = [_Rows.of_kind(chain.loop) for chain in mechanism.chains]
    gaps = {chain.loop.name: mechanism.gap(start, chain) for chain in mechanism.chains}
    closed = _closed_near(problem, start, full)
    if faults := tuple(_open_faults(mechanism, start, closed)):
        return faults
    generic = _generic_poses(problem, closed, full)
    candidates = [_Rows.of(_full_closure(mechanism, start, chain)) for chain in mechanism.chains]
    chosen = _independent([problem.jacobian(q, candidates) for q in generic])
    closures = _chosen_closures(mechanism, start, chosen)
    if faults := tuple(_redundant_faults(closures)):
        return faults
    rows = [_Rows.of(closure) for closure in closures.values()]
    at_closed = problem.jacobian(closed, rows)
    if len(kept := _independent([at_closed])) < len(chosen):
        owners = [name for name, closure in closures.items() for _ in range(_count(closure))]
        loop = owners[next(k for k, row in enumerate([*kept, -1]) if k != row)]
        return (_singular(loop, "its equations depend on each other at the start, though not elsewhere"),)
    names = [joint.name for joint in mechanism.independent]
    drives = [k for k, name in enumerate(names) if name in named] or [k for k, n in enumerate(names) if n in wanted]
    spaces = [_null_space(problem.jacobian(q, rows)) for q in generic]
    here = _null_space(at_closed)
    if named.intersection(names):
        driven = [drives[k] for k in _independent([space[drives] for space in spaces])]
        stuck = sorted(set(driven) - {driven[k] for k in _independent([here[driven]])})
        if stuck:
            name = names[stuck[0]]
            loop = next(c.loop.name for c in mechanism.chains if mechanism._gears[c.joints, stuck[0]].any())
            return (_singular(loop, f"joint {name!r} cannot move it there: it is at a dead point"),)
    else:
        both = _independent([np.concatenate([space[drives], here[drives]], axis=1) for space in spaces])
        driven = [drives[k] for k in both if k in _independent([here[drives]])]
    states = _with_others(here, driven)
    free = np.array([k not in states for k in range(len(names))])
    q = _start(problem, start, closed, rows, full, free)
    if faults := tuple(_open_faults(mechanism, start, q)):
        return faults
    q = _refine(tree, mechanism, q, closures, free, lower, upper)
    positions = {joint.name: starts[joint.name] for joint in tree.joints if joint.type in MOTION_KINDS}
    positions.update(zip(names, map(float, q), strict=True))
    for joint in tree.leaders_first():
        if joint.mimic is not None and joint.name in positions:
            leader = positions.get(joint.mimic.joint, starts[joint.mimic.joint])
            positions[joint.name] = joint.mimic.multiplier * leader + joint.mimic.offset
    in_loops = {mechanism.joints[k].name for chain in mechanism.chains for k in chain.joints} | set(names)
    moved = {names[k] for k in driven}
    return Assembly(
        joints=tuple(joint.name for joint in tree.joints if joint.name in in_loops),
        freedoms=len(names) - len(chosen),
        positions=positions,
        states=tuple(names[k] for k in states),
        driven=tuple(j.name for j in tree.joints if j.name in moved or j.name in wanted - in_loops),
        excess=tuple(name for name in names if name in named - moved),
        reach=_reach(problem, q, rows, driven, free),
        closures=closures,
        gaps=gaps,
    )


def _array(values: Any, dtype: type) -> Array:
    array = np.array(values, float)
    return array if dtype is float else np.vectorize(Decimal, otypes=[object])(array)


def _turns(axes: Array, angles: Array) -> Array:
    """Return turns about axes as matrices, by Rodrigues' formula."""
    x, y, z = axes.T
    zero = x * 0
    skew = np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]).transpose(2, 0, 1)
    sines, cosines = _sines_cosines(angles)
    turned: Array = np.eye(3, dtype=int) + sines[:, None, None] * skew + (1 - cosines)[:, None, None] * (skew @ skew)
    return turned


def _sines_cosines(angles: Array) -> tuple[Array, Array]:
    if angles.dtype != object:
        return np.sin(angles), np.cos(angles)
    pairs = [_series(angle % _TAU) for angle in angles]
    return np.array([sine for sine, _ in pairs], object), np.array([cosine for _, cosine in pairs], object)


def _series(angle: Decimal) -> tuple[Decimal, Decimal]:
    """Return sine and cosine to about 25 digits, by their power series."""
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
        axes = _array(np.tile(np.eye(3)[k], (len(origins), 1)), dtype)
        poses[:, :3, :3] = poses[:, :3, :3] @ _turns(axes, angles[:, k])
    return poses


def _path(by_child: Mapping[str, Joint], link: str) -> Iterator[Joint]:
    while link in by_child:
        yield by_child[link]
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


def _size(mechanism: Mechanism, poses: Array, chain: _Chain) -> float:
    """Return the largest distance from the closing frame to a joint of the loop; 1 if there is none."""
    _, points = mechanism.axes(poses, chain)
    _, frame = mechanism.frames(poses, chain)
    distances = np.linalg.norm(points - frame[:3, 3], axis=1)[mechanism.turns[chain.joints]]
    return float(distances.max(initial=0.0)) or 1.0


def _damped_inverse(matrix: Array, damping: float) -> Array:
    u, values, v = np.linalg.svd(matrix, full_matrices=False)
    factors = np.where(values > _INDEPENDENT, values / np.maximum(values**2 + damping, _INDEPENDENT**2), 0.0)
    inverse: Array = v.T @ (factors[:, None] * u.T)
    return inverse


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
    space: Array = np.linalg.svd(matrix)[2][len(matrix) :].T
    return space


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


def _normal(mechanism: Mechanism, q: Array, chain: _Chain) -> Vector | None:
    """Return the normal of the plane in which a loop moves, in the frame of its parent; None if it is spatial."""
    poses = mechanism.poses(q)
    axes, _ = mechanism.axes(poses, chain)
    turning = mechanism.turns[chain.joints]
    if not turning.any():
        return None
    normal = axes[turning][0]
    if (np.linalg.norm(np.cross(axes[turning], normal), axis=1) > _PARALLEL).any():
        return None
    if (np.abs(axes[~turning] @ normal) > _PARALLEL).any():
        return None
    frame, _ = mechanism.frames(poses, chain)
    x, y, z = (round(float(value), 9) + 0.0 for value in frame[:3, :3].T @ normal)
    sign = next((math.copysign(1.0, value) for value in (x, y, z) if value), 1.0)
    return sign * x + 0.0, sign * y + 0.0, sign * z + 0.0


def _full_closure(mechanism: Mechanism, q: Array, chain: _Chain) -> Closure:
    """Return all equations of the kind of a loop; those of its plane come first."""
    loop, normal = chain.loop, _normal(mechanism, q, chain)
    x, y, z = frame = (*_across(normal), normal) if normal else ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    rotations: tuple[tuple[Vector, Vector], ...] = ()
    if loop.kind == "revolute":
        rotations = tuple((across, loop.axis) for across in _across(loop.axis))
    elif loop.kind == "universal":
        rotations = ((loop.axis, loop.child_axis),)
    elif loop.kind == "fixed":
        rotations = (x, y), (y, z), (z, x)
    return Closure(frame, rotations, normal)


def _chosen_closures(mechanism: Mechanism, q: Array, chosen: Sequence[int]) -> Mapping[str, Closure]:
    closures, first, rows = {}, 0, set(chosen)
    for chain in mechanism.chains:
        full = _full_closure(mechanism, q, chain)
        kept = [first + k in rows for k in range(_count(full))]
        translations = tuple(v for v, keep in zip(full.translations, kept, strict=False) if keep)
        rotations = tuple(pair for pair, keep in zip(full.rotations, kept[3:], strict=True) if keep)
        normal = full.planar if translations == full.translations[:2] else None
        weaker = None
        if sum(kept) < len(kept) and not (normal and (not rotations or chain.loop.kind == "fixed")):
            weaker = f"closed by {sum(kept)} of {len(kept)} equations: the others follow from the rest of the robot"
        closures[chain.loop.name] = Closure(translations, rotations, None if rotations else normal, weaker)
        first += len(kept)
    return closures


def _count(closure: Closure) -> int:
    return len(closure.translations) + len(closure.rotations)


def _motions(count: int) -> Iterator[Array]:
    """Yield motions of all joints between -1 and 1, without pattern and the same on every machine."""
    for pose in range(1, 1 + 4 * _POSES):
        yield np.array(
            [2 * ((k * 0.6180339887498949 + pose * k * 0.4142135623730951) % 1) - 1 for k in range(1, count + 1)]
        )


def _closed_near(problem: _Problem, start: Array, rows: Sequence[_Rows]) -> Array:
    """Return a closed pose near the start; if that leads to none, near poses around it; else the least open one."""
    best = problem.close(start, rows)
    for motion in _motions(len(start)):
        if problem.is_closed(best, rows, _CLOSED_ANGLE):
            break
        near = np.clip(start + _AMPLITUDES[0] * motion * problem.units, problem.lower, problem.upper)
        other = problem.close(near, rows)
        gaps = [np.abs(problem.mechanism.gaps(q, rows) / problem.scales(rows)).max() for q in (best, other)]
        best = other if gaps[1] < gaps[0] else best
    return best


def _generic_poses(problem: _Problem, closed: Array, rows: Sequence[_Rows]) -> list[Array]:
    """Return closed poses around one, limits aside; that one if there are no others."""
    poses = []
    for motion in _motions(len(closed)):
        for amplitude in _AMPLITUDES:
            q = problem.close(closed + amplitude * motion * problem.units, rows, bounded=False)
            if problem.is_closed(q, rows, 3 * _CLOSED_ANGLE):
                poses.append(q)
                break
        if len(poses) == _POSES:
            break
    return poses or [closed]


def _start(
    problem: _Problem, start: Array, closed: Array, rows: Sequence[_Rows], full: Sequence[_Rows], free: Array
) -> Array:
    """Return a closed start at which the states are where the source has them, or else near a closed pose."""
    held = problem.close(start, rows, free)
    is_regular = len(_independent([problem.jacobian(held, rows)[:, free]])) == int(free.sum())
    if is_regular and problem.is_closed(held, rows, 1e-10) and problem.is_closed(held, full, _CLOSED_ANGLE):
        return held
    near = np.where(free, closed, np.round(closed, 9))
    return problem.close(np.clip(near, problem.lower, problem.upper), rows, free)


def _refine(
    tree: KinematicTree,
    mechanism: Mechanism,
    q: Array,
    closures: Mapping[str, Closure],
    free: Array,
    lower: Array,
    upper: Array,
) -> Array:
    """Return the positions with twelve digits that do not depend on how a machine rounds."""
    exact, at = Mechanism(tree, object), _array(q, object)
    rows = [_Rows.of(closure, object) for closure in closures.values()]
    inverse = np.linalg.inv(mechanism.jacobian(q, [_Rows.of(closure) for closure in closures.values()])[:, free])
    for _ in range(4):  # each step gains at least the digits that a float has
        step = inverse @ exact.gaps(at, rows).astype(float)
        at[free] = at[free] - _array(step, object)
    rounded = np.array([float(round(value, 12)) + 0.0 for value in at])
    return np.where(free, np.clip(rounded, lower, upper), q)


def _reach(
    problem: _Problem, q: Array, rows: Sequence[_Rows], driven: Sequence[int], free: Array
) -> Mapping[str, float]:
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
    lower, upper = own_range(joint)
    velocity = math.inf if joint.limit is None or joint.limit.velocity is None else joint.limit.velocity
    room = min(_SWEEP_MARGIN * velocity * _SWEEP_PERIOD / math.pi, reach)
    above, below = min(room, _SWEEP_MARGIN * (upper - start)), min(room, _SWEEP_MARGIN * (start - lower))
    return above if above >= below else -below


def _follow(problem: _Problem, q: Array, rows: Sequence[_Rows], ways: Mapping[int, float], free: Array) -> int:
    """Return the number of steps along the ways up to which the loops are closed, regular and within limits."""
    way, start, at = np.zeros(len(q)), q, q
    for k, value in ways.items():
        way[k] = value
    limit = _least(problem.jacobian(q, rows)[:, free]) / 4
    for step in range(1, _STEPS + 1):
        at = problem.close(np.where(free, at, start + way * step / _STEPS), rows, free, bounded=False)
        is_within = ((at >= problem.lower - 1e-9) & (at <= problem.upper + 1e-9)).all()
        is_regular = _least(problem.jacobian(at, rows)[:, free]) > limit
        if not (is_within and is_regular and problem.is_closed(at, rows, 1e-9)):
            return step - 1
    return _STEPS


def _least(matrix: Array) -> float:
    """Return the smallest singular value; infinite without any."""
    return float(np.linalg.svd(matrix, compute_uv=False).min(initial=math.inf))


def _structural_faults(tree: KinematicTree, mechanism: Mechanism) -> Iterator[LoopFault]:
    """Yield loops that nothing moves, and those with joints that have more than one freedom."""
    by_child = {joint.child: joint for joint in tree.joints}
    for chain in mechanism.chains:
        loop = chain.loop
        sides = [{joint.name: joint for joint in _path(by_child, link)} for link in (loop.parent, loop.child)]
        joints = [{**sides[0], **sides[1]}[name] for name in sorted(sides[0].keys() ^ sides[1].keys())]
        free = [joint for joint in joints if joint.type in ("planar", "floating")]
        if free:
            message = f"loop {loop.name!r} has the {free[0].type} joint {free[0].name!r}, which no loop can hold"
            yield LoopFault("loop-free-joint", loop.name, message, "use joints with one axis in a loop")
        elif not mechanism._gears[chain.joints].any():
            message = f"loop {loop.name!r}: no joint moves link {loop.child!r} against link {loop.parent!r}"
            yield LoopFault("loop-rigid", loop.name, message, "remove the loop, or give it joints that move")


def _open_faults(mechanism: Mechanism, start: Array, q: Array) -> Iterator[LoopFault]:
    """Yield the loops that are not closed, with their gaps there."""
    for chain in mechanism.chains:
        loop, gap, before = chain.loop, mechanism.gap(q, chain), mechanism.gap(start, chain)
        if gap.distance > _CLOSED or gap.angle > _CLOSED_ANGLE:
            message = (
                f"loop {loop.name!r} cannot be closed: its frames on links {loop.parent!r} and {loop.child!r} stay "
                f"{_apart(gap)} apart ({_apart(before)} at the start)"
            )
            yield LoopFault(
                "loop-open", loop.name, message, "correct its frames, or the start and limits of its joints"
            )


def _apart(gap: Gap) -> str:
    return f"{1000 * gap.distance:.3g} mm and {math.degrees(gap.angle):.3g}°"


def _redundant_faults(closures: Mapping[str, Closure]) -> Iterator[LoopFault]:
    for name, closure in closures.items():
        if not _count(closure):
            message = f"loop {name!r} holds nothing that the other loops and joints do not hold already"
            yield LoopFault("loop-redundant", name, message, "remove one of them")


def _singular(loop: str, reason: str) -> LoopFault:
    message = f"loop {loop!r} is singular: {reason}"
    return LoopFault("loop-singular", loop, message, "let its joints start elsewhere, by `start` in the configuration")
