"""Tells of the parts of a model that no model of urdfsync has; elements without an effect on the robot are counted."""

from __future__ import annotations

from collections.abc import Iterable

from urdfsync.sdf.frames import Scope
from urdfsync.sdf.joints import MODEL_AXES, TAGS, SdfJoint
from urdfsync.sdf.urdf import Urdf

_MODEL = frozenset({"link", "joint", "frame", "model", "include", "pose", "static", "plugin"})
_INCLUDE = frozenset({"uri", "name", "placement_frame"})
_JOINT = frozenset({"parent", "child", "pose", *TAGS, "sensor", "drake:gear_ratio", "drake:rotor_inertia"})
_AXIS = frozenset({"xyz", "limit", "dynamics", "mimic"})
_LIMIT = frozenset({"lower", "upper", "effort", "velocity", "drake:acceleration"})
"""Elements that are read: all others are counted."""
_DOWN, _FEW = (0.0, 0.0, -9.8), 0.02
"""The usual gravity, in m/s², and the greatest difference from it."""


def add_leftovers(urdf: Urdf, model: Scope, joints: Iterable[SdfJoint]) -> None:
    """Add the leftovers of joints, models and world."""
    for joint in joints:
        _add_of_joint(urdf, joint)
    for scope in model.each():
        if urdf.document.flag(scope.static_holder, "static"):
            urdf.leave_out("static model", scope.own.name, scope.static_holder)
        full = {name: frame.name for name, frame in scope.names.items()}
        for part in [*scope.element, *(scope.holder if scope.holder is not scope.element else ())]:
            if part.tag == "plugin":  # in Gazebo's words, which URDF has, too
                urdf.copy(urdf.root.add("gazebo", urdf.document.places[part]), part, full)
            elif part.tag == "experimental:params":
                urdf.leave_out("changes of an included model", scope.own.name, part)
            elif part.tag not in _MODEL | _INCLUDE:
                urdf.note(part, scope.own.name)
    world = urdf.frames.top.element
    for part in world if world.tag == "world" else ():
        if part.tag == "gravity":
            gravity = urdf.document.vector(world, "gravity", _DOWN)
            if any(abs(value - usual) > _FEW for value, usual in zip(gravity, _DOWN, strict=True)):
                urdf.leave_out("gravity", " ".join(map("{:g}".format, gravity)), part)
        elif part.tag == "joint":
            urdf.leave_out("joint of the world", part.get("name", ""), part)
        elif part is not model.holder:
            urdf.note(part)


def _add_of_joint(urdf: Urdf, joint: SdfJoint) -> None:
    frame = joint.frame
    if joint.kind in ("screw", "gearbox"):
        urdf.leave_out(f"{joint.kind} joint", frame.name, frame.element)
    for part in frame.element:
        if part.tag not in _JOINT:
            urdf.note(part, frame.name)
        for inner in part if part.tag in TAGS else ():
            if inner.tag not in _AXIS and not (inner.tag == MODEL_AXES and frame.scope.version < (1, 7)):
                urdf.note(inner, frame.name)
            for number in inner if inner.tag == "limit" else ():
                if number.tag not in _LIMIT:
                    urdf.note(number, frame.name)
