"""Finds joints that no drive moves as stated: limits, efforts, followers, and loads of gravity."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator, Mapping

from urdfsync.formats.urdf.kinematics.poses import GRAVITY, Pose, dot, link_poses, moved, own_range, start_positions
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.plausibility.shapes import LIGHT, LinkShape
from urdfsync.formats.urdf.robot import (
    JOINT_KINDS,
    MECHANISMS,
    MOTION_KINDS,
    Cylinder,
    Joint,
    Origin,
    Servo,
    Sphere,
    Vector,
)
from urdfsync.formats.urdf.validate import Finding

_LONG_SLIDE, _LONGEST_SLIDE, _LONG_JOINT = 20, 5000, 50
"""Limits of a slide are implausible above 20 m and 20 lengths of the robot, up to 5,000 m.

A joint is implausible at more than 50 m from its parent.
"""
_FOUR_TURNS, _TWO_TURNS_IN_DEGREES = 8 * math.pi, 720
_SAME, _SWITCHED_OFF = 1e-3, 5
"""Soft limits may be outside by this part of the joint's range; far outside, in rad or m, they are switched off."""
_FOLLOWED = 0.02
"""A joint may follow another one outside of its limits by this part of its range."""
_SLOW, _FAST = 30, 720
"""In degrees per second: usual velocities of arms."""
_LONGEST_WAY = 300
"""In s: a drive that takes longer over its range, or a turn, does not move its joint."""
_WHEEL = re.compile("wheel|caster|tyre|tire|rotor|prop")
_UNBALANCED = 0.05
"""In radii: the greatest distance of a wheel's centre of mass from its axis."""


def find_impossible_joints(
    tree: KinematicTree, bodies: Mapping[str, LinkShape], length: float, poses: Mapping[str, Pose]
) -> Iterator[Finding]:
    """Yield a finding for each joint that cannot move as stated, in a robot of this length in m.

    `poses` are those of the links with all joints at 0.
    """
    yield from _check_efforts(tree)
    yield from _check_exchanged(tree)
    yield from _check_speeds(tree)
    yield from _check_losses(tree)
    yield from _check_wheels(tree, bodies)
    yield from _check_loads(tree, bodies, poses)
    yield from _check_followers(tree)
    for body in bodies.values():
        if body.mass and body.inertial:
            yield from _check_angles(f"link {body.link.name} / inertial", body.inertial.origin)
    for joint in tree.joints:
        yield from _check_angles(f"joint {joint.name}", joint.origin)
        yield from _check_limits(joint, length, bodies[joint.child].mass)


def _check_efforts(tree: KinematicTree) -> Iterator[Finding]:
    """Check that no joint has an effort of 0 beside others with more; a source may tell all joints that are driven."""
    efforts = {joint.name: joint.limit.effort for joint in tree.joints if joint.limit and not joint.mimic}
    greatest = max((effort for effort in efforts.values() if effort), default=0.0)
    are_told = all(joint.actuated for joint in tree.joints if efforts.get(joint.name))
    for joint in tree.joints if greatest else ():
        if efforts.get(joint.name) == 0 and (joint.actuated or not are_told):
            message = f"joint {joint.name} / limit has effort = 0: no drive moves it; another joint has {greatest:g}"
            yield Finding("zero-effort", f"joint {joint.name} / limit", message)


def _check_exchanged(tree: KinematicTree) -> Iterator[Finding]:
    """Check that no joint has the effort of the others as velocity, and their velocity as effort."""
    pairs = {joint.name: (joint.limit.effort, joint.limit.velocity) for joint in tree.joints if joint.limit}
    (common, count), *_ = Counter(pairs.values()).most_common(1) or [((0.0, 0.0), 0)]
    for name, (effort, velocity) in pairs.items() if count > 1 and common[0] != common[1] else ():
        if (velocity, effort) == common:
            message = f"joint {name} / limit has effort = {effort:g} and velocity = {velocity:g}, "
            message += f"but {count} other joints {velocity:g} and {effort:g}"
            yield Finding("limits-exchanged", f"joint {name} / limit", message)


def _check_speeds(tree: KinematicTree) -> Iterator[Finding]:
    """Check that velocities are not in degrees per second, as whole numbers would show; equal ones are placeholders."""
    limits = {joint.name: joint.limit for joint in tree.joints if joint.type == "revolute" and joint.limit}
    speeds = [limit.velocity or 0.0 for limit in limits.values()]
    are_whole = all(_SLOW <= speed <= _FAST and speed.is_integer() for speed in speeds)
    if are_whole and len(set(speeds)) > 1:
        place = f"joint {next(iter(limits))} / limit"
        message = f"{place}: velocities of {min(speeds):g} to {max(speeds):g} rad/s may be in degrees per second"
        yield Finding("angle-unit", place, message)


def _check_losses(tree: KinematicTree) -> Iterator[Finding]:
    """Check that no loss holds a joint against the whole effort of its drive."""
    for joint in tree.joints:
        effort, losses = joint.limit.effort if joint.limit else 0.0, joint.dynamics
        lower, upper = own_range(joint)
        seconds = losses.damping * min(upper - lower, math.tau) / effort if losses and effort else 0.0
        if losses and effort and losses.friction > effort:
            words = f"does not overcome its friction of {losses.friction:g}"
        elif losses and seconds > _LONGEST_WAY:
            words = f"takes {seconds:.3g} s for its way, against a damping of {losses.damping:g}"
        else:
            continue
        message = f"joint {joint.name} / dynamics: with its whole effort of {effort:g}, the joint {words}"
        yield Finding("stuck", f"joint {joint.name} / dynamics", message)


def _check_wheels(tree: KinematicTree, bodies: Mapping[str, LinkShape]) -> Iterator[Finding]:
    """Check that wheels are balanced: round links at the ends of continuous joints."""
    parents = {joint.parent for joint in tree.joints}
    for joint in tree.joints:
        body = bodies[joint.child]
        shapes = body.link.collisions or body.link.visuals
        is_wheel = joint.type == "continuous" and _WHEEL.search(joint.child.lower())  # a crank is eccentric
        if is_wheel and joint.child not in parents and len(shapes) == 1 and body.mass > LIGHT:
            geometry = shapes[0].geometry
            radius = geometry.radius if isinstance(geometry, Cylinder | Sphere) else 0.0
            center = body.inertial.origin.xyz if body.inertial else (0.0, 0.0, 0.0)
            on_axis, off_axis = (_from_axis(joint.axis, point) for point in (shapes[0].origin.xyz, center))
            if on_axis < _SAME * radius and off_axis > _UNBALANCED * radius:
                message = f"link {joint.child} / inertial: the centre of mass of a wheel of {radius:g} m is "
                message += f"{off_axis:.3g} m beside its axis"
                yield Finding("unbalanced", f"link {joint.child} / inertial / origin", message)


def _from_axis(axis: Vector, point: Vector) -> float:
    """Return the distance of a point from the line along a unit vector through the origin."""
    along = dot(axis, point)
    return math.sqrt(max(dot(point, point) - along * along, 0.0))  # `**` of a large number would raise an error


def _check_loads(tree: KinematicTree, bodies: Mapping[str, LinkShape], poses: Mapping[str, Pose]) -> Iterator[Finding]:
    """Check that no drive is too weak for the weight behind its joint, in every position of the joint.

    The other joints are at their starts. Gravity acts along -z of the root. A source may tell which joints are driven.
    """
    if tree.loops:  # loops carry weight past a joint
        return
    starts, are_told = start_positions(tree), any(joint.actuated for joint in tree.joints)
    if any(starts.values()):
        poses = link_poses(tree, starts)
    masses, moments = dict[str, float](), dict[str, Vector]()
    for name, body in bodies.items():
        masses[name], moments[name] = body.mass, (0.0, 0.0, 0.0)
        if body.inertial and body.mass:
            x, y, z = moved(poses[name], body.inertial.origin.xyz)
            moments[name] = body.mass * x, body.mass * y, body.mass * z
    for joint in reversed(tree.joints):
        mass, moment = masses[joint.child], moments[joint.child]
        masses[joint.parent] += mass
        x, y, z = moments[joint.parent]
        moments[joint.parent] = x + moment[0], y + moment[1], z + moment[2]
        effort = joint.limit.effort if joint.limit and not joint.mimic else None
        may_carry = any(getattr(joint.dynamics, number, None) for number in MECHANISMS.values())
        if not effort or may_carry or not (joint.actuated or not are_told):
            continue
        turns = MOTION_KINDS.get(joint.type) == "rotational"
        least = _least_load(joint, mass, moment, poses[joint.child], starts[joint.name])
        if least > effort:
            message = f"joint {joint.name} / limit has effort = {effort:g}: the weight behind the joint takes "
            message += f"{least:.4g} {'N·m' if turns else 'N'} or more in each of its positions"
            yield Finding("weak-effort", f"joint {joint.name} / limit", message)


def _least_load(joint: Joint, mass: float, moment: Vector, at: Pose, start: float) -> float:
    """Return the least weight that a joint carries in all its positions, in N or N·m.

    `mass` and `moment` (mass times centre of mass) are those behind the joint, `at` is the pose of its child link; all
    of them with the joint at `start`.
    """
    (row_x, row_y, row_z), (at_x, at_y, at_z) = at
    a, b, c = dot(row_x, joint.axis), dot(row_y, joint.axis), dot(row_z, joint.axis)
    if MOTION_KINDS.get(joint.type) == "translational":
        return GRAVITY * mass * abs(c)
    if joint.type != "revolute":
        return 0.0  # a joint without limits can hang down
    x, y, z = moment[0] - mass * at_x, moment[1] - mass * at_y, moment[2] - mass * at_z
    # the moment about the axis changes as a sine of the position; `slope` is its derivative
    value = GRAVITY * (b * x - a * y)
    slope = GRAVITY * ((a * a + b * b) * z - c * (a * x + b * y))
    return _least_sine(value, slope, start, own_range(joint))


def _least_sine(value: float, slope: float, start: float, limits: tuple[float, float]) -> float:
    """Return the least magnitude of a sine within limits; `value` and `slope` are those at `start`."""
    ends = [value * math.cos(end - start) + slope * math.sin(end - start) for end in limits if math.isfinite(end)]
    if len(ends) < 2 or limits[1] - limits[0] >= math.pi or ends[0] * ends[1] <= 0:
        return 0.0
    return min(map(abs, ends))


def _check_followers(tree: KinematicTree) -> Iterator[Finding]:
    """Check that no joint that follows another one leaves its own limits."""
    joints = {joint.name: joint for joint in tree.joints}
    for joint in tree.joints:
        if joint.mimic is not None:
            leader, (lower, upper) = own_range(joints[joint.mimic.joint]), own_range(joint)
            least, most = sorted(joint.mimic.multiplier * end + joint.mimic.offset for end in leader)
            past = max(lower - least, most - upper)
            if _FOLLOWED * (upper - lower) < past < math.inf:
                message = (
                    f"joint {joint.name} follows {joint.mimic.joint} from {least:.4g} to {most:.4g}, outside of its "
                )
                message += f"limits {lower:.4g} to {upper:.4g}"
                yield Finding("mimic-limits", f"joint {joint.name} / mimic", message)


def _check_angles(path: str, origin: Origin) -> Iterator[Finding]:
    """Check that an orientation is not in degrees, as whole numbers of more than a turn in rad would show."""
    widest = max(map(abs, origin.rpy))
    if math.tau < widest <= _TWO_TURNS_IN_DEGREES and all(angle.is_integer() for angle in origin.rpy):
        shown = " ".join(f"{angle:g}" for angle in origin.rpy)
        yield Finding("angle-unit", f"{path} / origin", f"{path}: the angles {shown} rad may be in degrees")


def _check_limits(joint: Joint, length: float, mass: float) -> Iterator[Finding]:
    """Check that place and limits of a joint are plausible in SI units.

    `mass` is the mass of the child link. Slides with massless links may let a whole robot move anywhere, so any limit
    will do.
    """
    path, away = f"joint {joint.name}", math.hypot(*joint.origin.xyz)
    if away > _LONG_JOINT:
        message = f"{path} is {away:.6g} m away from its parent: lengths may be in millimetres"
        yield Finding("length-unit", f"{path} / origin", message)
    limit, kind = joint.limit, JOINT_KINDS[joint.type]
    if limit is None or not kind.has_limits:
        return
    soft = joint.safety_controller
    if soft and soft.soft_lower_limit < soft.soft_upper_limit:
        past = max(limit.lower - soft.soft_lower_limit, soft.soft_upper_limit - limit.upper)
        encloses = soft.soft_lower_limit <= limit.lower and soft.soft_upper_limit >= limit.upper
        if past > _SAME * (limit.upper - limit.lower) and (past < _SWITCHED_OFF or not encloses):
            message = f"{path}: the soft limits {soft.soft_lower_limit:g} to {soft.soft_upper_limit:g} are outside of "
            message += f"the limits {limit.lower:g} to {limit.upper:g}"
            yield Finding("soft-limits", f"{path} / safety_controller", message)
    place, widest = f"{path} / limit", max(abs(limit.lower), abs(limit.upper))
    if kind.motion == "rotational":
        is_whole = limit.lower.is_integer() and limit.upper.is_integer()
        if is_whole and _FOUR_TURNS < widest <= _TWO_TURNS_IN_DEGREES:
            message = f"{path}: limits of {limit.lower:g} and {limit.upper:g} rad may be in degrees"
            yield Finding("angle-unit", place, message)
        servo = joint.servo or Servo()
        ends = (servo.min_position, limit.lower), (servo.max_position, limit.upper)
        if widest and all(
            end is not None and math.isclose(end, math.degrees(bound), rel_tol=_SAME) for end, bound in ends
        ):
            message = (
                f"{path}: {servo.min_position:g} and {servo.max_position:g} rad, the drive's limits, may be in degrees"
            )
            yield Finding("angle-unit", f"{path} / servo / max_position", message)
    elif max(_LONG_SLIDE, _LONG_SLIDE * length) < widest <= _LONGEST_SLIDE and mass > LIGHT:
        message = f"{path}: limits of {limit.lower:g} and {limit.upper:g} m may be in millimetres"
        yield Finding("length-unit", place, message)
