"""Finds left and right parts of a robot that are no mirror images of each other.

Names propose the pairs: `left_arm` and `right_arm`, `LHip` and `RHip`, `FL_foot` and `FR_foot`. A pair counts if all
joints are at 0 and its links lie as in a mirror. The same part on both sides, such as one wheel or one bought arm, is
no mirror image: then both links have the same mesh files.
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import NamedTuple

from urdfsync.formats.urdf.kinematics.poses import Matrix, Pose, compose, dot, own_range, pose, turned_inertia
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.plausibility.shapes import LIGHT, LinkShape
from urdfsync.formats.urdf.robot import LOSSES, MOTION_KINDS, Collision, Inertial, Joint, Link, Mesh, Vector, Visual
from urdfsync.formats.urdf.validate import Finding

_SIDES = ("left right", "l r", "fl fr", "rl rr", "bl br", "hl hr", "lf rf", "lh rh", "lb rb", "izquierda derecha")
SIDES = {name for pair in (*_SIDES, "gauche droite") for name in pair.split()}
_OTHER = {name: other for pair in map(str.split, (*_SIDES, "gauche droite")) for name, other in (pair, reversed(pair))}
WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+", re.ASCII)
_ALIKE = 0.1
"""The greatest difference of two numbers of one size, relative to the larger one: models of sides are rounded."""
JOINT_NUMBERS = (("limit", "effort"), ("limit", "velocity"), *(("dynamics", name) for name in LOSSES))
"""Numbers of a joint that its counterpart has, too: each with the field of the joint."""
_NEAR, _PLACE = 0.004, 0.01
"""Mirrored points differ by 4 mm, by a tenth of a link's size, or by a hundredth of the distance of two sides."""
_ANGLE = 0.1
"""In rad or m: the greatest difference of mirrored limits."""
_SIZE = 1.5
"""Sizes of mirrored shapes differ by this factor at most: their meshes may show other details."""
_LEAST = 0.01
"""In m: sides that are closer lie in the plane of symmetry."""


class _Plane(NamedTuple):
    normal: Vector
    at: float
    """The distance of the plane from the origin along its normal, in m."""

    def point(self, place: Vector) -> Vector:
        return _moved(place, self.normal, 2 * (self.at - dot(self.normal, place)))

    def vector(self, vector: Vector) -> Vector:
        return _moved(vector, self.normal, -2 * dot(self.normal, vector))


class _Side(NamedTuple):
    """A link with the joint that leads to it; its pose is in the robot's frame, with all joints at 0."""

    link: Link
    joint: Joint
    pose: Pose


def find_asymmetries(
    tree: KinematicTree, bodies: Mapping[str, LinkShape], poses: Mapping[str, Pose], suspects: Sequence[Collection[str]]
) -> Iterator[Finding]:
    """Yield a finding for each difference of a link or joint from the mirror image of its other side.

    `poses` are those of the links with all joints at 0. `suspects` are two collections of
    elements such as `link left_hip`: those with another fault, and the changed ones. A finding names the side in the
    first collection as the wrong one. If both sides or none are in it, the second collection decides.
    """
    joints = {joint.child: joint for joint in tree.joints}
    names = [(name, across) for name in joints if (across := _other_side(name)) in joints and across < name]
    if not names:
        return
    links = {link.name: link for link in tree.links}
    sides = {name: _Side(links[name], joints[name], poses[name]) for pair in names for name in pair}
    pairs = [(sides[name], sides[across]) for name, across in names]
    plane = _plane_of(pairs)
    for one, other in pairs:
        if plane is not None and _lie_in(plane, one, other):
            link_findings = list(_compare_bodies(plane, *_suspect_first("link", one, other, suspects)))
            yield from link_findings or _compare_shapes(bodies[one.link.name], bodies[other.link.name])
            yield from _compare_joints(plane, *_suspect_first("joint", one, other, suspects))


def _suspect_first(kind: str, one: _Side, other: _Side, suspects: Sequence[Collection[str]]) -> tuple[_Side, _Side]:
    names = [f"{kind} {side.link.name if kind == 'link' else side.joint.name}" for side in (one, other)]
    for group in suspects:
        if (names[0] in group) != (names[1] in group):
            return (one, other) if names[0] in group else (other, one)
    return one, other


def _plane_of(pairs: Sequence[tuple[_Side, _Side]]) -> _Plane | None:
    """Return the plane in which the origins of most pairs are mirrored; the first one for more than half of them."""
    most, best = 0, None
    for one, other in pairs:
        if (plane := _plane_between(one.pose[1], other.pose[1])) is not None:
            count = sum(_are_opposite(plane, a.pose[1], b.pose[1]) for a, b in pairs)
            if count > most:
                most, best = count, plane
            if 2 * count > len(pairs):
                break
    return best


def _other_side(name: str) -> str:
    """Return the name with left and right exchanged; the same name if it has no side."""

    def exchanged(match: re.Match[str]) -> str:
        word = match[0]
        other = _OTHER.get(word.lower(), word)
        return other.upper() if word.isupper() else other.capitalize() if word[0].isupper() else other

    return WORD.sub(exchanged, name)


def _plane_between(one: Vector, other: Vector) -> _Plane | None:
    distance = math.dist(one, other)
    if distance < _LEAST:
        return None
    x, y, z = ((a - b) / distance for a, b in zip(one, other, strict=True))
    middle = tuple((a + b) / 2 for a, b in zip(one, other, strict=True))
    return _Plane((x, y, z), dot((x, y, z), middle))


def _are_opposite(plane: _Plane, one: Vector, other: Vector) -> bool:
    return math.dist(plane.point(one), other) <= max(_NEAR, _PLACE * math.dist(one, other))


def _lie_in(plane: _Plane, one: _Side, other: _Side) -> bool:
    """Whether frames lie as in a mirror: their origins, and their axes, which may be exchanged or reversed.

    Where joints at 0 leave one side in another pose, other axes show it.
    """
    if not _are_opposite(plane, one.pose[1], other.pose[1]):
        return False
    axes, others_axes = (list(zip(*side.pose[0], strict=True)) for side in (one, other))
    cosines = (abs(dot(plane.vector(axis), other_axis)) for axis in axes for other_axis in others_axes)
    return all(min(cosine, abs(1 - cosine)) < _ANGLE for cosine in cosines)


def _compare_bodies(plane: _Plane, one: _Side, other: _Side) -> Iterator[Finding]:
    """Compare masses, centres of mass and inertias."""
    mine, others = one.link.inertial, other.link.inertial
    masses = [inertial.mass if inertial else 0.0 for inertial in (mine, others)]
    if max(masses) < LIGHT:
        return
    sizes = [inertial.inertia.trace if inertial else 0.0 for inertial in (mine, others)]
    for what, unit, (a, b) in (("mass", "kg", masses), ("sum of principal inertias", "kg·m²", sizes)):
        if not _are_alike(a, b):
            (a, wrong), (b, right) = ((a, one), (b, other)) if b else ((b, other), (a, one))
            message = f"link {wrong.link.name!r} is no mirror image of {right.link.name!r}: "
            message += f"its {what} is {a:.4g} {unit}, that of the other {b:.4g}"
            yield Finding("not-mirrored", f"link {wrong.link.name} / inertial", message)
            break
    if mine is None or others is None or not mine.mass or _are_same_part(one.link, other.link):
        return
    (center, tensor), (others_center, others_tensor) = _body(one, mine), _body(other, others)
    sides = f"link {one.link.name!r} is no mirror image of {other.link.name!r}"
    size = max(math.dist(center, one.pose[1]), math.dist(others_center, other.pose[1]))
    is_copy = "; the numbers are a copy" if mine == others else ""
    away = math.dist(plane.point(center), others_center)
    if away > max(_NEAR, _ALIKE * size):
        message = f"{sides}: the centre of mass is {away:.3g} m beside its mirror image{is_copy}"
        yield Finding("not-mirrored", f"link {one.link.name} / inertial / origin", message)
    if away > max(_NEAR, _ALIKE * size) or not _are_alike(*masses) or not _are_alike(*sizes):
        return
    mirrored = _mirrored(plane, tensor)
    rows = zip(mirrored, others_tensor, strict=True)
    error = max(abs(a - b) for row, others_row in rows for a, b in zip(row, others_row, strict=True))
    if error > max(_ALIKE * max(abs(tensor[k][k]) for k in range(3)), mine.mass * _NEAR * _NEAR):
        message = f"{sides}: an element of the inertia is {error:.3g} kg·m² beside its mirror image{is_copy}"
        yield Finding("not-mirrored", f"link {one.link.name} / inertial / inertia", message)


def _compare_joints(plane: _Plane, one: _Side, other: _Side) -> Iterator[Finding]:
    """Compare axes, limits and losses of joints."""
    for place, words in _joint_differences(plane, one, other):
        message = f"joint {one.joint.name!r} is no mirror image of {other.joint.name!r}: {words}"
        yield Finding("not-mirrored", f"joint {one.joint.name}{place}", message)


def _joint_differences(plane: _Plane, one: _Side, other: _Side) -> Iterator[tuple[str, str]]:
    """Yield each difference of two joints: the place of the number, and words."""
    mine, others = one.joint, other.joint
    if mine.type != others.type:
        yield "", f"it is {mine.type}, the other {others.type}"
    if mine.type != others.type or mine.type not in MOTION_KINDS:
        return
    for block, what in JOINT_NUMBERS:
        a, b = (getattr(getattr(joint, block), what, None) for joint in (mine, others))
        is_told = block == "limit" and not (a and b)  # an effort or velocity of 0 is a fault without the other side
        if a is not None and b is not None and not _are_alike(a, b) and not is_told:
            yield f" / {block} / {what}", f"its {what} is {a:g}, that of the other {b:g}"
    axis, others_axis = (_turned(side.pose[0], side.joint.axis) for side in (one, other))
    along = dot(plane.vector(axis), others_axis)
    if abs(along) < math.cos(_ANGLE):
        yield " / axis", "its axis has another direction"
        return
    (lower, upper), (others_lower, others_upper) = own_range(mine), own_range(others)
    # a mirror reverses turns, not slides
    if (along > 0) == (MOTION_KINDS[mine.type] == "rotational"):
        others_lower, others_upper = -others_upper, -others_lower
    if mine.mimic or others.mimic or not math.isfinite(lower + upper + others_lower + others_upper):
        return
    apart = max(abs(lower - others_lower), abs(upper - others_upper))
    if apart > max(_ANGLE, _ALIKE * (upper - lower)):
        words = f"it moves from {lower + 0.0:.4g} to {upper + 0.0:.4g}, the mirror image of the other"
        yield " / limit", f"{words} from {others_lower + 0.0:.4g} to {others_upper + 0.0:.4g}"


def _compare_shapes(one: LinkShape, other: LinkShape) -> Iterator[Finding]:
    """Compare the sizes of visual shapes; a mesh that is not in the package has none."""
    sizes = [max((shape.reach for shape in body.visuals), default=0.0) for body in (one, other)]
    if one.visuals and other.visuals and bool(one.collisions) != bool(other.collisions):
        name, across = (one.link.name, other.link.name) if other.collisions else (other.link.name, one.link.name)
        message = f"link {name!r} is no mirror image of {across!r}: it has no collision shape"
        yield Finding("not-mirrored", f"link {name} / collision", message)
    if min(sizes) > _LEAST and max(sizes) < math.inf and max(sizes) > _SIZE * min(sizes):
        message = f"link {one.link.name!r} is no mirror image of {other.link.name!r}: "
        message += f"its shapes reach {sizes[0]:.3g} m, those of the other {sizes[1]:.3g}"
        yield Finding("not-mirrored", f"link {one.link.name} / visual 1", message)


def _are_alike(a: float, b: float) -> bool:
    return abs(a - b) <= _ALIKE * max(abs(a), abs(b))


def _are_same_part(one: Link, other: Link) -> bool:
    """Whether both links have the same mesh files: a part that is not mirrored."""
    files, others_files = _meshes(one), _meshes(other)
    return bool(files) and files == others_files


def _meshes(link: Link) -> set[Mesh]:
    shapes: Sequence[Visual | Collision] = (*link.visuals, *link.collisions)
    return {shape.geometry for shape in shapes if isinstance(shape.geometry, Mesh)}


def _body(side: _Side, inertial: Inertial) -> tuple[Vector, Matrix]:
    """Return the centre of mass, and the inertia about it, in the robot's frame."""
    rotation, center = compose(side.pose, pose(inertial.origin))
    return center, turned_inertia(rotation, inertial.inertia)


def _mirrored(plane: _Plane, tensor: Matrix) -> Matrix:
    """Return the mirror image of a symmetric tensor: M·I·M for the reflection M."""
    columns = [plane.vector(row) for row in tensor]  # M·row, since the tensor is symmetric
    return tuple(plane.vector(row) for row in zip(*columns, strict=True))  # type: ignore[return-value]


def _moved(point: Vector, direction: Vector, distance: float) -> Vector:
    x, y, z = (a + distance * b for a, b in zip(point, direction, strict=True))
    return x, y, z


def _turned(rotation: Sequence[Sequence[float]], vector: Vector) -> Vector:
    x, y, z = (dot(row, vector) for row in rotation)
    return x, y, z
