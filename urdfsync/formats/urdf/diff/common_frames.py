"""Two robots from different sources, as far as they differ in motion: both in the frames of the first.

A URDF and an MJCF of one robot have other frames, shapes and names, and move alike. So shapes, contacts, sensors,
starts, commands, and frames without mass are left out. The frames of the second robot are moved to those of the first,
with all joints at zero. A frame stays on the axis of its joint: if the axis is elsewhere, the origin of the joint
differs. A rotor behind a gear counts as armature. Files have numbers with six digits or more: what agrees up to that is
the same.

The root frame's z-axis points upwards. If the robots, brought together, disagree about this direction, both stand on a
joint `world_fixed`, whose origin tells it. Numbers of the robots themselves would then differ everywhere.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from urdfsync.domain import ElementKey, Features, displaced
from urdfsync.formats.urdf.kinematics.poses import Pose, link_poses, pose, principal_moments, turned_inertia
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import (
    Dynamics,
    Inertia,
    Inertial,
    Joint,
    Link,
    Loop,
    Origin,
    Robot,
    Vector,
    effective,
    reflected_inertia,
)

_Array: TypeAlias = NDArray[np.float64]
_SAME = 1e-6
"""The greatest difference of equal numbers: in m, as a sine, or as a fraction of an inertia's trace."""
_ALIKE = 1e-5
"""The greatest relative difference of other equal numbers, and the greatest tilt in rad."""
_NEAR = 0.01
"""In m: if the links of two robots are no farther apart, the robots have one root frame."""
_DIGITS = 9
_UP = np.array([0.0, 0.0, 1.0])


def in_common_frames(old: Robot, new: Robot, renames: Mapping[ElementKey, str]) -> tuple[Robot, Robot]:
    """Return the parts of two robots that matter for their motion, the second in the frames of the first."""
    gone = displaced(renames)
    links, joints = (
        {renames.get((kind, name), name): name for name in names if (kind, name) not in gone}
        for kind, names in (("link", [each.name for each in old.links]), ("joint", [each.name for each in old.joints]))
    )
    # a frame without mass counts if the other robot has a mass or a joint there
    olds, news = ({link.name for link in _moving(robot, set()).links} for robot in (old, new))
    pairs = [(new_name, name) for new_name, name in links.items() if name in olds or new_name in news]
    old_part = _in_link_axes(_moving(old, {name for _, name in pairs}))
    new_part = replace(_moving(new, {new_name for new_name, _ in pairs}), name=old.name)
    stands = _stand(old, old_part), _stand(new, new_part)
    frames = _Frames(old_part, new_part, links, joints, (stands[0][2], stands[1][2]))
    moved = frames.moved()
    up = stands[0] @ frames.placed[:3, :3] @ stands[1][2]
    if np.abs(up - _UP).max() < _ALIKE:  # files have angles such as 1.5708
        return old_part, moved
    return _mounted(old_part, stands[0]), _mounted(moved, _upright(up) @ stands[0])


def coarse_features(robot: Robot) -> Mapping[ElementKey, Features]:
    """Return masses with principal moments, and ranges, of the robot without frames that have neither mass nor freedom.

    They have four digits: formats write numbers with different precision. In a recorded model, which a stranger may
    have written, a joint may name a missing link.
    """
    moving, features = _moving(robot, set()), dict[ElementKey, Features]()
    above = {joint.child: joint.name for joint in moving.joints}
    for link in moving.links:
        body = [link.inertial.mass, *principal_moments(link.inertial.inertia)] if link.inertial else ()
        contents = {"mass": list(map(_coarse, body))} if body else {}
        neighbours = {"joint": ("joint", above[link.name])} if link.name in above else {}
        features["link", link.name] = Features(contents, neighbours)
    for joint in moving.joints:
        limit = joint.limit if joint.type != "continuous" else None
        contents = {"limits": [_coarse(limit.lower), _coarse(limit.upper)]} if limit else {}
        ends = {"child": ("link", joint.child), "parent": ("link", joint.parent)}
        existing = {relation: end for relation, end in ends.items() if end in features}
        features["joint", joint.name] = Features(contents, existing)
    return features


def _coarse(number: float) -> float:
    return float(f"{number:.4g}")


def _moving(robot: Robot, needed: set[str]) -> Robot:
    """Return the robot without its shapes, and without frames that have no mass and no freedom and are not `needed`."""
    links, joints = {link.name: link for link in robot.links}, {joint.child: effective(joint) for joint in robot.joints}
    held = {end for loop in robot.loops for end in (loop.parent, loop.child)} | needed
    loose = [link.name for link in robot.links if link.inertial is None and link.name not in held]
    for name in loose:
        above, below = joints.get(name), [joint for joint in joints.values() if joint.parent == name]
        if above is not None and above.type == "fixed":
            for joint in below:  # they hang on the link above now
                origin = _origin(_matrix(pose(above.origin)) @ _matrix(pose(joint.origin)), None)
                joints[joint.child] = replace(joint, parent=above.parent, origin=origin)
            del links[name], joints[name]
        elif above is None and [joint.type for joint in below] == ["fixed"]:
            del links[name], joints[below[0].child]
    kept = tuple(replace(link, visuals=(), collisions=(), contact=None) for link in links.values())
    moving = tuple(map(_motion_of, joints.values()))
    return replace(robot, links=kept, joints=moving, sensors=(), extensions={})


def _stand(robot: Robot, part: Robot) -> _Array:
    """Return the axes of the root link of `part` in the root frame of the robot, whose z-axis points upwards."""
    root = KinematicTree.of(part).links[0].name
    return _poses(robot)[root][:3, :3]


def _upright(up: _Array) -> _Array:
    """Return the smallest turn that brings a unit vector to the z-axis."""
    x, y, z = up
    if z < _SAME - 1:  # upside down: any horizontal axis will do
        return np.diag([1.0, -1.0, -1.0])
    cross = np.array([[0.0, 0.0, -x], [0.0, 0.0, -y], [x, y, 0.0]])
    return np.asarray(np.eye(3) + cross + cross @ cross / (1 + z))


def _mounted(robot: Robot, turn: _Array) -> Robot:
    """Return the robot on a link `world`, to which its root is fixed in this orientation."""
    root, names = KinematicTree.of(robot).links[0].name, {link.name for link in robot.links}
    world = "world" if "world" not in names else "upright_world"
    at = np.eye(4)
    at[:3, :3] = turn
    mount = Joint(f"{world}_fixed", "fixed", world, root, _origin(at, None))
    return replace(robot, links=(Link(world), *robot.links), joints=(mount, *robot.joints))


def _motion_of(joint: Joint) -> Joint:
    """Return a joint without numbers that do not move it; what its drive adds to the inertia is its armature."""
    gear, dynamics = joint.transmission, joint.dynamics
    if gear is None or gear.joint is None:  # the rotor moves with this joint alone
        inertia = reflected_inertia(joint)
        dynamics = replace(dynamics or Dynamics(), armature=inertia) if inertia else dynamics
        gear = None
    without = dict.fromkeys(("calibration", "safety_controller", "start", "motor", "servo", "command"))
    return replace(joint, dynamics=None if dynamics == Dynamics() else dynamics, transmission=gear, **without)


def _alike(part: Any, same: Any) -> Any:
    """Return a part of a joint with the numbers of `same` where they agree."""
    if part is None or same is None:
        return part
    numbers = {}
    for name in part.__struct_fields__:
        value, other = getattr(part, name), getattr(same, name)
        if isinstance(value, float) and isinstance(other, float) and abs(value - other) <= _ALIKE * abs(other):
            numbers[name] = other
    return replace(part, **numbers)


def _in_link_axes(robot: Robot) -> Robot:
    """Return the robot with its inertias in the axes of the links, and without rounding errors."""
    links = tuple(
        replace(link, inertial=link.inertial and _inertial(link.inertial, np.eye(4), None)) for link in robot.links
    )
    joints = tuple(
        replace(joint, origin=replace(joint.origin, xyz=_near(joint.origin.xyz, None)), axis=_near(joint.axis, None))
        for joint in robot.joints
    )
    return replace(robot, links=links, joints=joints)


class _Frames:
    """The frames of two robots in the root frame of the first, with all joints at zero."""

    def __init__(
        self,
        old: Robot,
        new: Robot,
        links: Mapping[str, str],
        joints: Mapping[str, str],
        upwards: tuple[_Array, _Array],
    ) -> None:
        """`links` and `joints` are the old names of matched elements, by their new names.

        `upwards` are the vertical directions in both root frames.
        """
        self.old, self.new = old, new
        poses, others = _poses(old), _poses(new)
        olds = {joint.name: joint for joint in old.joints}
        self.links = {name: poses[first] for name, first in links.items() if first in poses and name in others}
        self.joints = {each.name: olds[joints[each.name]] for each in new.joints if joints.get(each.name) in olds}
        self.inertials = {
            name: inertial
            for link in old.links
            for name, first in links.items()
            if first == link.name and (inertial := link.inertial)
        }
        self.placed = self._alignment(others, upwards)
        self.before = {name: self.placed @ at for name, at in others.items()}
        self.after = dict(self.before)
        above = {joint.child: joint for joint in new.joints}
        for name, at in self.links.items():
            self.after[name] = self._on_axis(at, self.before[name], above.get(name))

    def _alignment(self, others: Mapping[str, _Array], upwards: tuple[_Array, _Array]) -> _Array:
        """Return the pose of the second root frame in the first that brings masses and axes together best.

        If several are best, both robots stand upright in the pose, if they can.
        """
        centres = [
            (self.links[each.name] @ _point(self.inertials[each.name]), others[each.name] @ _point(each.inertial))
            for each in self.new.links
            if each.inertial and each.name in self.links and each.name in self.inertials
        ]
        axes = [
            (_turned(self.links[joint.child], self.joints[joint.name].axis), _turned(others[joint.child], joint.axis))
            for joint in self.new.joints
            if joint.type != "fixed" and joint.name in self.joints and joint.child in self.links
        ]

        def gap(placed: _Array) -> float:
            apart = sum(float(np.linalg.norm(first - placed @ second)) for first, second in centres)
            turned = sum(1 - abs(float(first @ (placed[:3, :3] @ second))) for first, second in axes)
            return round(apart + turned, 9)

        def rank(placed: _Array) -> tuple[float, bool]:
            return gap(placed), bool(np.abs(upwards[0] - placed[:3, :3] @ upwards[1]).max() > _ALIKE)

        candidates = [np.eye(4)]
        for name, at in self.links.items():
            turned = np.eye(4)
            turned[:3, :3] = at[:3, :3] @ others[name][:3, :3].T
            candidates.append(turned)
            if centres:
                turned = turned.copy()
                turned[:, 3] += np.median([first - turned @ second for first, second in centres], axis=0)
                candidates.append(turned)
        best = min(candidates, key=rank)
        # the roots stay together if the robots do so, too: then the height of a shoulder shows at the shoulder
        best_turn = np.eye(4)
        best_turn[:3, :3] = best[:3, :3]
        return best_turn if gap(best_turn) <= gap(best) + _NEAR * len(centres) else best

    @staticmethod
    def _on_axis(at: _Array, before: _Array, joint: Joint | None) -> _Array:
        """Return a frame with the axes of `at`, moved to the nearest point where the joint may have its origin."""
        result, place = at.copy(), before[:3, 3]
        if joint is not None and joint.type in ("revolute", "continuous"):
            axis = _turned(before, joint.axis)
            result[:3, 3] = place + axis * (axis @ (at[:3, 3] - place))
        elif joint is not None and joint.type == "ball":
            result[:3, 3] = place
        return at if np.abs(result - at).max() < _SAME else result

    def moved(self) -> Robot:
        """Return the second robot in the frames `after`; a number that agrees with the first robot's is the same."""
        links = [
            replace(
                link,
                inertial=link.inertial
                and _inertial(link.inertial, self._change(link.name), self.inertials.get(link.name)),
            )
            for link in self.new.links
        ]
        joints = tuple(map(self._joint, self.new.joints))
        return replace(self.new, links=tuple(links), joints=joints, loops=tuple(map(self._loop, self.new.loops)))

    def _change(self, link: str) -> _Array:
        """Return the pose of the frame `before` in the frame `after`."""
        return np.asarray(np.linalg.inv(self.after[link]) @ self.before[link])

    def _joint(self, joint: Joint) -> Joint:
        same = self.joints.get(joint.name)
        if same:
            joint = replace(joint, limit=_alike(joint.limit, same.limit), mimic=_alike(joint.mimic, same.mimic))
            joint = replace(joint, dynamics=_alike(joint.dynamics, same.dynamics))
        origin = _origin(
            np.linalg.inv(self.after[joint.parent]) @ self.after[joint.child], same.origin if same else None
        )
        if joint.type in ("fixed", "floating", "ball"):
            return replace(joint, origin=origin)
        axis = _turned(self._change(joint.child), joint.axis)
        return replace(joint, origin=origin, axis=_near(axis, same.axis if same else None, _ALIKE / _SAME))

    def _loop(self, loop: Loop) -> Loop:
        same = next((each for each in self.old.loops if each.name == loop.name), loop)
        ends = {"origin": (loop.parent, loop.origin), "child_origin": (loop.child, loop.child_origin)}
        origins = {
            name: _origin(self._change(link) @ _matrix(pose(at)), getattr(same, name))
            for name, (link, at) in ends.items()
        }
        return replace(loop, **origins)


def _poses(robot: Robot) -> dict[str, _Array]:
    return {name: _matrix(at) for name, at in link_poses(KinematicTree.of(robot), {}).items()}


def _matrix(at: Pose) -> _Array:
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = at
    return matrix


def _point(inertial: Inertial) -> _Array:
    return np.array([*inertial.origin.xyz, 1.0])


def _turned(at: _Array, axis: Vector) -> _Array:
    return np.asarray(at[:3, :3] @ axis)


def _near(numbers: Any, same: Vector | None, size: float = 1.0) -> Vector:
    """Return numbers without rounding errors; those that agree with `same` are the same."""
    rounded = (float(f"{round(float(value / size), _DIGITS) * size:.{_DIGITS}g}") + 0.0 for value in numbers)
    pairs = zip(rounded, same or (np.inf,) * 3, strict=True)
    x, y, z = (other if abs(value - other) <= _SAME * size else value for value, other in pairs)
    return x, y, z


def _origin(at: _Array, same: Origin | None) -> Origin:
    """Return an origin; turns and places that agree with `same` are the same."""
    xyz = _near(at[:3, 3], same.xyz if same else None)
    if same and np.abs(at[:3, :3] - np.array(pose(same)[0])).max() < _SAME:
        return Origin(xyz, same.rpy)
    level = float(np.hypot(at[0, 0], at[1, 0]))
    yaw = np.arctan2(at[1, 0], at[0, 0]) if level > _SAME else 0.0
    roll = np.arctan2(at[2, 1], at[2, 2]) if level > _SAME else np.arctan2(-at[1, 2], at[1, 1])
    return Origin(xyz, _near((roll, np.arctan2(-at[2, 0], level), yaw), same.rpy if same else None))


def _inertial(inertial: Inertial, change: _Array, same: Inertial | None) -> Inertial:
    """Return mass and inertia in the axes of a link; `change` is the pose of the frame in which they are given.

    `same` is in the axes of the link already. To round it again would change its last digit.
    """
    at = change @ _matrix(pose(inertial.origin))
    rows = tuple(tuple(map(float, row)) for row in at[:3, :3])
    tensor, size = turned_inertia(rows, inertial.inertia), inertial.inertia.trace or 1.0  # type: ignore[arg-type]
    mass = inertial.mass
    if same and abs(mass - same.mass) <= _ALIKE * same.mass:
        mass = same.mass
    places = {"ixx": (0, 0), "iyy": (1, 1), "izz": (2, 2), "ixy": (0, 1), "ixz": (0, 2), "iyz": (1, 2)}
    numbers = {name: tensor[row][column] for name, (row, column) in places.items()}
    known = same.inertia if same else None
    groups = [("ixx", "iyy", "izz"), ("ixy", "ixz", "iyz")]
    found = dict[str, float]()
    for names in groups:
        others: Any = known and tuple(getattr(known, name) for name in names)
        found |= dict(zip(names, _near([numbers[name] for name in names], others, size), strict=True))
    xyz = _near(at[:3, 3], same.origin.xyz if same else None)
    return Inertial(mass, Origin(xyz), Inertia(**found))
