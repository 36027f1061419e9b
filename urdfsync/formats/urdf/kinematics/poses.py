"""Poses of links, in plain Python: rotation matrices as rows, vectors in metres."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import msgspec

from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import MOTION_KINDS, Inertia, Joint, Origin, Vector

Matrix = tuple[Vector, Vector, Vector]
Pose = tuple[Matrix, Vector]
"""Rotation R and translation p: v_world = R·v + p."""

GRAVITY = 9.80665
"""In m/s²: that of the Modelica Standard Library's World."""

# Positions are cut off here, since larger numbers overflow. The library's leaderPosition has the same bound.
_FAR = 1e60

SWEEP = {"rotational": 1.0, "translational": 0.1}
"""In rad and m: the longest motion of a sweep in the library."""
_MARGIN, _PERIOD = 0.9, 10.0

AXES: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
IDENTITY: Pose = (AXES, (0.0, 0.0, 0.0))
_EXACT = 1e-12


def pose(origin: Origin) -> Pose:
    """Return the pose of an origin: Rz(yaw)·Ry(pitch)·Rx(roll), as URDF defines it."""
    (sr, sp, sy), (cr, cp, cy) = map(math.sin, origin.rpy), map(math.cos, origin.rpy)
    rotation = (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )
    return rotation, origin.xyz


def roll_pitch_yaw(quaternion: Sequence[float]) -> Vector:
    """Return the angles of a quaternion x, y, z, w of any length but zero, precise even at a pitch of ±π/2."""
    largest = max(map(abs, quaternion))  # without this, the squares of large numbers overflow
    length = math.hypot(*(value / largest for value in quaternion))
    x, y, z, w = (value / largest / length for value in quaternion)
    up, ahead = 2 * (x * y + w * z), 1 - 2 * (y * y + z * z)
    yaw = math.atan2(up, ahead)
    pitch = math.atan2(2 * (w * y - x * z), math.hypot(up, ahead))
    # roll comes from the orientation turned back by yaw: at a pitch of ±π/2 both turn about one axis, and their errors
    # cancel
    s, c = math.sin(yaw), math.cos(yaw)
    sine = 2 * s * (x * z + w * y) - 2 * c * (y * z - w * x)
    cosine = c * (1 - 2 * (x * x + z * z)) - 2 * s * (x * y - w * z)
    return math.atan2(sine, cosine), pitch, yaw


def compose(outer: Pose, inner: Pose) -> Pose:
    """Return the product of two poses: `inner` is given in the frame of `outer`."""
    # written out, this takes a quarter of the time: builds judge each changed robot (docs/speed.md)
    row_x, row_y, row_z = outer[0]
    ((ax, bx, cx), (ay, by, cy), (az, bz, cz)), place = inner

    def turned(row: Vector) -> Vector:
        r, s, t = row
        return r * ax + s * ay + t * az, r * bx + s * by + t * bz, r * cx + s * cy + t * cz

    return (turned(row_x), turned(row_y), turned(row_z)), moved(outer, place)


def inverse(of: Pose) -> Pose:
    """Return the pose of the outer frame in the inner one."""
    rotation, place = of
    turned: Matrix = tuple(zip(*rotation, strict=True))  # type: ignore[assignment]
    return turned, tuple(-dot(row, place) for row in turned)  # type: ignore[return-value]


def angles(rotation: Matrix) -> Vector:
    """Return the roll, pitch and yaw of a rotation, precise even at a pitch of ±π/2, as `roll_pitch_yaw` is."""
    (xx, xy, xz), (yx, yy, yz), (zx, _, _) = rotation
    yaw = math.atan2(yx, xx)
    s, c = math.sin(yaw), math.cos(yaw)
    return math.atan2(s * xz - c * yz, c * yy - s * xy), math.atan2(-zx, c * xx + s * yx), yaw


def moved(place: Pose, point: Vector) -> Vector:
    """Return a point, given in the frame of a pose, in the frame of the pose's origin."""
    (row_x, row_y, row_z), (x, y, z) = place
    return x + dot(row_x, point), y + dot(row_y, point), z + dot(row_z, point)


def motion(joint: Joint, position: float) -> Pose:
    """Return the pose of the child link in the joint frame: a turn (by Rodrigues' formula) or a shift."""
    if MOTION_KINDS.get(joint.type) == "translational":
        return IDENTITY[0], tuple(position * a for a in joint.axis)  # type: ignore[return-value]
    if MOTION_KINDS.get(joint.type) != "rotational":
        return IDENTITY
    (x, y, z), s, c = joint.axis, math.sin(position), math.cos(position)
    v = 1 - c
    rotation = (
        (c + x * x * v, x * y * v - z * s, x * z * v + y * s),
        (y * x * v + z * s, c + y * y * v, y * z * v - x * s),
        (z * x * v - y * s, z * y * v + x * s, c + z * z * v),
    )
    return rotation, (0.0, 0.0, 0.0)


def link_poses(tree: KinematicTree, positions: Mapping[str, float]) -> Mapping[str, Pose]:
    """Return the poses of all links in the root frame; a joint without a given position is at 0."""
    poses = {tree.links[0].name: IDENTITY}
    for joint in tree.joints:
        step = compose(pose(joint.origin), motion(joint, positions.get(joint.name, 0.0)))
        poses[joint.child] = compose(poses[joint.parent], step)
    return poses


def position_ranges(tree: KinematicTree) -> Mapping[str, tuple[float, float]]:
    """Return the smallest and largest position of each joint, by its own limits and those of its followers."""
    ranges = {joint.name: own_range(joint) for joint in tree.joints}
    followers = tree.followers_by_leader()
    for joint in reversed(tree.leaders_first()):
        for follower, mimic in followers.get(joint.name, ()) if joint.type in MOTION_KINDS else ():
            if abs(mimic.multiplier) > math.ulp(1):  # a smaller multiplier moves no follower to a limit
                ends = sorted((_near(end) - mimic.offset) / mimic.multiplier for end in ranges[follower.name])
                lower, upper = ranges[joint.name]
                ranges[joint.name] = max(lower, ends[0]), min(upper, ends[1])
    return ranges


def start_positions(tree: KinematicTree) -> Mapping[str, float]:
    """Return the start position of each joint: its `start`, else the position closest to zero within all limits."""
    ranges = position_ranges(tree)
    positions: dict[str, float] = {}
    for joint in tree.leaders_first():
        if joint.mimic is not None:
            position = joint.mimic.multiplier * positions[joint.mimic.joint] + joint.mimic.offset
        elif joint.start is not None:
            position = joint.start
        else:
            lower, upper = ranges[joint.name]
            position = min(max(0.0, lower), upper)
        positions[joint.name] = _near(position)
    return positions


def own_range(joint: Joint) -> tuple[float, float]:
    """Return the smallest and largest position of one joint by its own limits."""
    if joint.type not in MOTION_KINDS:
        return 0.0, 0.0
    if joint.type == "continuous" or joint.limit is None:
        return -math.inf, math.inf
    return joint.limit.lower, joint.limit.upper


def sweep_way(joint: Joint, start: float, reach: float, limits: tuple[float, float]) -> float:
    """Return the signed distance of a library's sweep from the start: see Functions.sweepEnd."""
    velocity = math.inf if joint.limit is None or joint.limit.velocity is None else joint.limit.velocity
    room = min(_MARGIN * velocity * _PERIOD / math.pi, reach)
    above, below = min(room, _MARGIN * (limits[1] - start)), min(room, _MARGIN * (start - limits[0]))
    return above if above >= below else -below


def _near(position: float) -> float:
    return min(max(position, -_FAR), _FAR)


def across(axis: Vector) -> tuple[Vector, Vector]:
    """Return two unit vectors that complete a unit vector to a frame; for a coordinate axis, the other two axes."""
    sizes = [abs(value) for value in axis]
    k = sizes.index(min(sizes))
    x, y, z = ((1.0 if i == k else 0.0) - axis[k] * value for i, value in enumerate(axis))
    length = math.sqrt(x * x + y * y + z * z)
    x, y, z = x / length, y / length, z / length
    a, b, c = axis
    return (x, y, z), (b * z - c * y, c * x - a * z, a * y - b * x)


def turned_inertia(rotation: Matrix, inertia: Inertia) -> Matrix:
    """Return an inertia as a tensor in the frame to which `rotation` turns: R·I·Rᵀ."""
    i, (x, y, z) = inertia, rotation
    a, b, c = (i.ixx, i.ixy, i.ixz), (i.ixy, i.iyy, i.iyz), (i.ixz, i.iyz, i.izz)
    along_x = dot(x, a), dot(x, b), dot(x, c)  # a row of R·I, since I is symmetric
    along_y = dot(y, a), dot(y, b), dot(y, c)
    along_z = dot(z, a), dot(z, b), dot(z, c)
    xy, xz, yz = dot(along_x, y), dot(along_x, z), dot(along_y, z)
    return (dot(along_x, x), xy, xz), (xy, dot(along_y, y), yz), (xz, yz, dot(along_z, z))


def principal_moments(inertia: Inertia) -> Vector:
    """Return the eigenvalues of the inertia tensor in ascending order, in kg·m².

    The trigonometric solution of the characteristic equation gives eight digits or more. The import of numpy would take
    longer than a build of a small robot.
    """
    values = msgspec.structs.astuple(inertia)
    if not (values[1] or values[2] or values[4]):
        low, middle, high = sorted((values[0], values[3], values[5]))
        return low, middle, high
    scale = max(map(abs, values)) or 1.0  # without this, squares of large numbers overflow
    xx, xy, xz, yy, yz, zz = (value / scale for value in values)
    mean = (xx + yy + zz) / 3
    xx, yy, zz = xx - mean, yy - mean, zz - mean
    spread = math.sqrt((xx * xx + yy * yy + zz * zz + 2 * (xy * xy + xz * xz + yz * yz)) / 6)
    if spread < _EXACT:
        return mean * scale, mean * scale, mean * scale
    determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)
    angle = math.acos(min(max(determinant / 2 / spread**3, -1.0), 1.0)) / 3
    low, middle, high = sorted(mean + 2 * spread * math.cos(angle + turn * math.tau / 3) for turn in range(3))
    return low * scale, middle * scale, high * scale


def dot(a: Sequence[float], b: Sequence[float]) -> float:
    """Return the scalar product of two vectors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
