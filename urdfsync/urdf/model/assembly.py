"""Template data of the models of a whole robot: `<Robot>.mo`, `<Robot>Run.mo` and `<Robot>Test.mo`."""

from __future__ import annotations

import math
from collections.abc import Container, Iterable, Mapping
from typing import Any

import msgspec

from urdfsync.domain import Import, Target
from urdfsync.urdf.diagram import layout
from urdfsync.urdf.kinematics import compose, link_poses, lowest_point, pose, start_positions
from urdfsync.urdf.model import notes
from urdfsync.urdf.model.shapes import hull
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Joint
from urdfsync.urdf.skeleton import MOTIONS, Motion, Skeleton

_WORDS: Mapping[Motion, Mapping[str, Any]] = {
    "rotational": {
        "domain": "Rotational",
        "axis": "rotationalAxis",
        "support": "rotationalSupport",
        "range": "rotationalRange",
        "drive": "rotationalDrive",
        "sweep": "rotationalSweep",
        "position": "Angle",
        "velocity": "AngularVelocity",
        "q": "phi",
        "v": "w",
        "effort": "tau",
        "unit": "rad",
        "effort_unit": "N.m",
        "reach": "1",
        "color": "0, 0, 0",
        "icon_x": -60,
        "drive_y": 30,
    },
    "translational": {
        "domain": "Translational",
        "axis": "translationalAxis",
        "support": "translationalSupport",
        "range": "translationalRange",
        "drive": "translationalDrive",
        "sweep": "translationalSweep",
        "position": "Position",
        "velocity": "Velocity",
        "q": "s",
        "v": "v",
        "effort": "f",
        "unit": "m",
        "effort_unit": "N",
        "reach": "0.1",
        "color": "0, 127, 0",
        "icon_x": 30,
        "drive_y": 70,
    },
}

_LINE_COLORS = {"frame": "95, 95, 95", "rotational": "0, 0, 0", "translational": "0, 127, 0"}


class Part(msgspec.Struct, frozen=True):
    """A link or a joint in the robot model."""

    component: str
    type: str
    title: str
    modifiers: list[str] = []


class Leaf(msgspec.Struct, frozen=True):
    """A link at which no joint starts."""

    component: str
    name: str


class Axis(msgspec.Struct, frozen=True):
    """An axis that can be driven, with the number that it has in the flange vectors of its kind."""

    component: str
    name: str
    number: int
    range: str
    """A Modelica expression."""
    leads: bool
    """Whether other joints follow it."""


class Coupling(msgspec.Struct, frozen=True):
    """A joint that follows another one, which is None if that has no axis."""

    component: str
    type: str
    leader: str | None
    follower: str
    title: str


class Line(msgspec.Struct, frozen=True):
    """A connection in the robot's diagram."""

    start: str
    end: str
    points: str
    color: str
    thick: bool


def bench_data(structure: Skeleton, target: Target, options: Options) -> dict[str, Any]:
    """Data of Run and Test. They depend on the structure of the robot alone, on no number of the URDF."""
    return _model_data(structure, target, options) | {
        "run_note": notes.run_note(target.name),
        "test_note": notes.test_note(target.name),
        "visualizer": options.visualizer,
    }


def robot_data(structure: Skeleton, target: Target, options: Options) -> dict[str, Any]:
    """Data of the robot model."""
    diagram = layout.layout(tree(structure))
    numbers = axis_numbers(structure)
    motions = {joint.name: MOTIONS.get(joint.type) for joint in structure.joints}
    leaders = structure.followers_by_leader()
    return bench_data(structure, target, options) | {
        "note": notes.robot_note(target.name),
        "assertion_level": "warning",
        "leaves": [Leaf(structure.link(leaf.name).component, leaf.name) for leaf in structure.leaves()],
        "links": [_link(structure, link.name) for link in structure.links],
        "joints": [_joint(structure, joint, numbers, motions, leaders) for joint in structure.joints],
        "couplings": couplings(structure),
        "extent": _extent(diagram.extent),
        "diagram": {name: _extent((box.x1, box.y1, box.x2, box.y2)) for name, box in diagram.placements.items()},
        "lines": _lines(diagram),
    }


def _model_data(structure: Skeleton, target: Target, options: Options) -> dict[str, Any]:
    """What all models of the whole robot need."""
    return {
        "within": target.package,
        "type": target.name,
        "record": f"{target.name}Parameters",
        "title": f"robot {target.name}",
        "base": options.base,
        "vectors": vectors(structure),
    }


def standing_height(skeleton: Skeleton, imports: Mapping[str, Import]) -> float | None:
    """Height of the root frame when the lowest collision shape just touches the ground; None without any shape."""
    poses = link_poses(skeleton, start_positions(skeleton))
    heights = [
        lowest_point(shape.geometry, compose(poses[link.name], pose(shape.origin)), hull(shape.geometry, imports))
        for link in skeleton.links
        for shape in link.collisions
    ]
    lowest = min((height for height in heights if height is not None and math.isfinite(height)), default=None)
    return None if lowest is None else round(-lowest, 12)


def vectors(skeleton: Skeleton) -> list[dict[str, Any]]:
    """One entry per kind of motion that the robot can be driven in: its words, and its axes in order."""
    ranges = _ranges(skeleton)
    leaders = skeleton.followers_by_leader()
    result = []
    for motion, words in _WORDS.items():
        axes = [
            Axis(skeleton.joint(joint.name).component, joint.name, number, ranges[joint.name], joint.name in leaders)
            for number, joint in enumerate(skeleton.axes(motion), 1)
        ]
        if axes:
            result.append({**words, "axes": axes, **_bench_lines(words["icon_x"], words["drive_y"])})
    return result


def couplings(skeleton: Skeleton) -> list[Coupling]:
    """One entry per joint that follows another one."""
    types = {joint.name: MOTIONS.get(joint.type) for joint in skeleton.joints}
    result = []
    for joint, mimic in skeleton.followers():
        leader, follower = types[mimic.joint], MOTIONS[joint.type]
        component = skeleton.joint(joint.name).component
        result.append(
            Coupling(
                f"{component}Mimic",
                f"{leader.capitalize()}To{follower.capitalize()}" if leader else f"Held{follower.capitalize()}",
                skeleton.joint(mimic.joint).component if leader else None,
                component,
                f'Joint "{joint.name}" follows joint "{mimic.joint}"',
            )
        )
    return result


def tree(skeleton: Skeleton) -> layout.Tree:
    """What the robot's diagram shows."""
    axis = axis_numbers(skeleton)
    children = {
        skeleton.link(link).component: [
            layout.TreeJoint(
                skeleton.joint(joint.name).component,
                skeleton.link(joint.child).component,
                MOTIONS.get(joint.type) or ("fixed" if joint.type == "fixed" else "free"),
                axis.get(joint.name),
            )
            for joint in joints
        ]
        for link, joints in skeleton.children().items()
    }
    return layout.Tree(
        root=skeleton.link(skeleton.links[0].name).component,
        children=children,
        leaves={skeleton.link(leaf.name).component: k for k, leaf in enumerate(skeleton.leaves(), 1)},
        couplings=[layout.TreeCoupling(c.component, c.leader, c.follower) for c in couplings(skeleton)],
    )


def _link(skeleton: Skeleton, name: str) -> Part:
    identifier = skeleton.link(name)
    return Part(identifier.component, identifier.type, f'link "{name}"')


def _joint(
    skeleton: Skeleton,
    joint: Joint,
    numbers: Mapping[str, int],
    motions: Mapping[str, Motion | None],
    leaders: Container[str],
) -> Part:
    identifier = skeleton.joint(joint.name)
    modifiers: list[str] = []
    if motion := motions[joint.name]:
        q, v = _WORDS[motion]["q"], _WORDS[motion]["v"]
        if joint.mimic is None:
            modifiers = _driven(q, v, numbers[joint.name], leads=joint.name in leaders)
        else:
            leader = skeleton.joint(joint.mimic.joint).component
            modifiers = _following(q, identifier.component, leader, motions[joint.mimic.joint])
    return Part(identifier.component, identifier.type, notes.joint_title(joint), modifiers)


def _driven(q: str, v: str, number: int, *, leads: bool) -> list[str]:
    return [
        f"axisNumber = {number}",
        "checkLimits = checkLimits",
        *(["checkEffort = false"] if leads else []),
        "fixedStart = fixedStart",
        f"{q}_start = {q}_start[{number}]",
        f"{v}_start = {v}_start[{number}]",
    ]


def _following(q: str, follower: str, leader: str, leader_motion: Motion | None) -> list[str]:
    start = f"{follower}.parameters.mimic.offset"
    if leader_motion:
        leader_q = _WORDS[leader_motion]["q"]
        start = f"{follower}.parameters.mimic.multiplier*{leader}.{leader_q}_start + {start}"
    return [
        "checkLimits = checkLimits",
        "checkEffort = false",
        "stateSelect = StateSelect.avoid",
        "fixedStart = false",
        f"{q}_start = {start}",
    ]


def axis_numbers(skeleton: Skeleton) -> Mapping[str, int]:
    """Number of each driven axis in the flange vectors of its kind of motion."""
    return {joint.name: number for motion in _WORDS for number, joint in enumerate(skeleton.axes(motion), 1)}


def _ranges(skeleton: Skeleton) -> Mapping[str, str]:
    """Per joint with an axis, a Modelica expression of its range, those of its followers respected."""
    ranges: dict[str, str] = {}
    followers = skeleton.followers_by_leader()
    for joint in reversed(skeleton.leaders_first()):
        if joint.type in MOTIONS:
            component = skeleton.joint(joint.name).component
            limits = f"{component}.parameters.limits"
            ends = f"{limits}.lower, {limits}.upper"
            if joint.type == "continuous":
                ends = "-Modelica.Constants.inf, Modelica.Constants.inf"
            expression = f"{{{ends}, {limits}.velocity}}"
            for follower, _ in followers.get(joint.name, ()):
                mimic = f"{skeleton.joint(follower.name).component}.parameters.mimic"
                numbers = f"{mimic}.multiplier, {mimic}.offset, {ranges[follower.name]}"
                expression = f"UrdfSync.Functions.leaderRange({expression}, {numbers})"
            ranges[joint.name] = expression
    return ranges


def _bench_lines(icon_x: int, y: int) -> dict[str, Any]:
    """Lines of the bench's diagram: the robot's icon is 40 wide around x = 40, its upper border at y = -20."""
    axis, support = 40 + icon_x // 5, 40 + (icon_x + 30) // 5
    return {
        "drive_x": -20,
        "flange_line": f"{{0, {y}}}, {{{axis}, {y}}}, {{{axis}, -20}}",
        "support_line": f"{{-10, {y - 10}}}, {{-10, {y - 20}}}, {{{support}, {y - 20}}}, {{{support}, -20}}",
        "input_line": f"{{-120, {y}}}, {{-22, {y}}}",
        "sweep_line": f"{{-39, {y}}}, {{-22, {y}}}",
    }


def _extent(box: Iterable[int]) -> str:
    x1, y1, x2, y2 = box
    return f"{{{{{x1}, {y1}}}, {{{x2}, {y2}}}}}"


def _lines(diagram: layout.Diagram) -> list[Line]:
    return [
        Line(
            start,
            end,
            ", ".join([f"{{{x}, {y}}}" for x, y in points]),
            _LINE_COLORS[diagram.kinds[start, end]],
            diagram.kinds[start, end] == "frame",
        )
        for (start, end), points in diagram.lines.items()
    ]
