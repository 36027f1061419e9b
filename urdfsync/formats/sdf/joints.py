"""Reads the joints of an SDF with their axes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element

from urdfsync.common.spelling import nearest
from urdfsync.formats.sdf.frames import Frame, Frames
from urdfsync.formats.urdf.robot import Vector

TAGS = ("axis", "axis2")
_AXES = {"revolute": 1, "continuous": 1, "prismatic": 1, "fixed": 0, "ball": 0, "universal": 2, "revolute2": 2}
"""Types that become joints of URDF, with the number of their axes."""
_OTHERS = ("screw", "gearbox")
"""Types that no model has. A screw counts as fixed, and a gearbox joins nothing."""
FIXED = frozenset({"fixed", "gearbox"})
"""Types that move nothing."""
_ENDLESS = 1e16
"""A limit of this size or more is none."""
MODEL_AXES = "use_parent_model_frame"
"""The element by which SDF 1.5 and 1.6 give an axis in the frame of the model; older versions always do."""


class JointAxis(NamedTuple):
    """An axis of a joint, with its numbers by the names that URDF has for them."""

    vector: Vector
    given_in: Frame
    """The frame of the vector."""
    range: tuple[float, float] | None = None
    most: Mapping[str, float | None] = {}
    """Greatest effort, velocity and acceleration."""
    dynamics: Mapping[str, float | None] = {}
    mimic: Mapping[str, Any] = {}


class SdfJoint(NamedTuple):
    """A joint between two links."""

    frame: Frame
    kind: str
    parent: Frame
    child: Frame
    axes: tuple[JointAxis, ...]
    damping: float = 0.0
    """That of a ball."""
    is_turned: bool = False
    """Whether `parent` is the child in the source: the root of the tree is on that side."""

    @property
    def has_numbers(self) -> bool:
        """Whether an axis has limits or losses, or follows another one."""
        limited = any(axis.range or {*axis.most.values()} - {None} for axis in self.axes)
        return limited or bool(self.damping) or any(any(axis.dynamics.values()) or axis.mimic for axis in self.axes)


def read_joints(frames: Frames, parts: Iterable[Frame]) -> list[SdfJoint]:
    """Return the joints of a model. Raises TranslationError."""
    joints, document = list[SdfJoint](), frames.document
    for frame in parts:
        kind, types = frame.element.get("type", ""), (*_AXES, *_OTHERS)
        if kind not in types:
            near = nearest(kind, types)
            hint = f"perhaps {near!r} is meant" if near else f"use one of {', '.join(types)}"
            raise document.fault(frame.element, f"joint {frame.name!r} has the unknown type {kind!r}", hint)
        parent, child = (frames.link_of(frames.named(frame, tag)) for tag in ("parent", "child"))
        if parent is child:
            raise document.fault(frame.element, f"joint {frame.name!r} joins {parent.name!r} with itself")
        axes = tuple(_axis(frames, frame, tag) for tag in TAGS[: _AXES.get(kind, 0)])
        damping = document.number(frame.element, "axis/dynamics/damping", 0.0) if kind == "ball" else 0.0
        joints.append(SdfJoint(frame, kind, parent, child, axes, damping))
    return joints


def _axis(frames: Frames, joint: Frame, tag: str) -> JointAxis:
    document, element = frames.document, joint.element.find(tag)
    xyz = None if element is None else element.find("xyz")
    given_in = joint
    if xyz is not None and (word := xyz.get("expressed_in", "")):
        given_in = frames.look_up(joint.scope, word, xyz)
    elif element is not None and (
        joint.scope.version < (1, 5) or (joint.scope.version < (1, 7) and document.flag(element, MODEL_AXES))
    ):
        given_in = joint.scope
    if element is None:
        return JointAxis((0.0, 0.0, 1.0), given_in)
    limit, dynamics = element.find("limit"), element.find("dynamics")
    lower, upper = (document.number(limit, name, end) for name, end in (("lower", -_ENDLESS), ("upper", _ENDLESS)))
    most = {name: document.number(limit, name, -1) for name in ("effort", "velocity")}
    most |= {"acceleration": document.number(limit, "drake:acceleration", 0.0) or -1}
    rotor = document.number(joint.element, "drake:rotor_inertia", 0.0) if tag == TAGS[0] else 0.0
    gear = document.number(joint.element, "drake:gear_ratio", 1.0)
    losses: dict[str, float | None] = {name: document.number(dynamics, name, 0.0) for name in ("damping", "friction")}
    losses["armature"] = gear * gear * rotor or None
    if stiffness := document.number(dynamics, "spring_stiffness", 0.0):
        losses["spring_stiffness"] = stiffness
        losses["spring_reference"] = document.number(dynamics, "spring_reference", 0.0) or None
    return JointAxis(
        document.numbers(element, "xyz", (0.0, 0.0, 1.0)),  # type: ignore[arg-type] # three numbers
        given_in,
        (max(lower, -_ENDLESS), min(upper, _ENDLESS)) if lower > -_ENDLESS or upper < _ENDLESS else None,
        {name: value if 0 <= value < _ENDLESS else None for name, value in most.items()},
        losses,
        _mimic(frames, joint, element),
    )


def _mimic(frames: Frames, joint: Frame, axis: Element) -> Mapping[str, Any]:
    """Return the coupling of an axis as URDF has it: position = multiplier · (leader - reference) + offset."""
    element, document = axis.find("mimic"), frames.document
    if element is None:
        return {}
    leader = frames.look_up(joint.scope, element.get("joint", ""), element)
    if leader.kind != "joint":
        raise document.fault(element, f"<mimic> names the {leader.kind} {leader.name!r}, which is no joint")
    has_two = _AXES.get(leader.element.get("type", ""), 0) == len(TAGS)
    name = f"{leader.name}_{element.get('axis', 'axis')}" if has_two else leader.name
    multiplier = document.number(element, "multiplier", 1.0)
    offset = document.number(element, "offset", 0.0) - multiplier * document.number(element, "reference", 0.0)
    return {"joint": name, "multiplier": multiplier, "offset": offset}
