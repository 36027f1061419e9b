"""Tells of the parts of a model that no model of urdfsync has; elements without an effect on the robot are counted."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from xml.etree.ElementTree import Element

from urdfsync.formats.sdf.frames import Frame
from urdfsync.formats.sdf.joints import MODEL_AXES, SdfJoint
from urdfsync.formats.sdf.urdf import Urdf

_AXIS = frozenset({"xyz", "limit", "dynamics", "mimic"})
_READ: Mapping[str, Collection[str]] = {
    "link": {"pose", "inertial", "visual", "collision", "sensor", "gravity", "kinematic", "velocity_decay"},
    "visual": {"pose", "geometry", "material", "transparency"},
    "collision": {"pose", "geometry", "surface", "density", "auto_inertia_params"},
    "geometry": {"box", "sphere", "ellipsoid", "cylinder", "capsule", "mesh"},
    "mesh": {"uri", "scale"},
    "surface": {"friction", "contact"},
    "friction": {"ode"},
    "contact": {"ode"},
    "ode": {"mu", "kp", "kd", "min_depth"},
    "joint": {"parent", "child", "pose", "axis", "axis2", "sensor", "drake:gear_ratio", "drake:rotor_inertia"},
    "axis": _AXIS,
    "axis2": _AXIS,
    "limit": {"lower", "upper", "effort", "velocity", "drake:acceleration"},
}
"""Elements that are read, by the tag around them: all others there are counted."""
_MODEL = frozenset({"link", "joint", "frame", "model", "include", "pose", "static", "uri", "name", "placement_frame"})
_ODE = {"max_force": 0.0, "suspension/cfm": 0.0, "suspension/erp": 0.2}
"""Numbers in the `<physics>` of a joint that are a motor or a spring, and without effect at these values."""
_DOWN, _FEW = (0.0, 0.0, -9.8), 0.02
"""The usual gravity, in m/s², and the greatest difference from it."""
_STILL = (0.0, 0.0, 0.0)


def add_leftovers(urdf: Urdf, model: Frame, joints: Iterable[SdfJoint]) -> None:
    """Add the leftovers of joints, models and world."""
    document, world = urdf.document, urdf.frames.world.element
    for frame, kind, *_ in joints:
        if kind in ("screw", "gearbox"):
            urdf.leave_out(f"{kind} joint", frame.name, frame.element)
        for path, usual in _ODE.items():
            if document.number(frame.element, f"physics/ode/{path}", usual) != usual:
                urdf.leave_out(f"{path} of <physics>", frame.name, frame.element)
    has_wind = any(document.numbers(world, "wind/linear_velocity", _STILL))
    for scope in model.each():
        if document.flag(scope.static_holder, "static"):
            urdf.leave_out("static model", scope.name, scope.static_holder)
        for element in (scope.content, *scope.content.iterfind("link")) if has_wind else ():
            if document.flag(element, "enable_wind"):
                urdf.leave_out("wind by enable_wind", element.get("name", ""), element)
        full = {name: frame.name for name, frame in scope.names.items()}
        for part in [*scope.content, *(scope.element if scope.element is not scope.content else ())]:
            if part.tag == "plugin":  # in Gazebo's words, which URDF has, too
                urdf.copy(urdf.root.add("gazebo", document.places[part]), part, full)
            elif part.tag == "experimental:params":
                urdf.leave_out("changes of an included model", scope.name, part)
            elif part.tag not in _MODEL:
                urdf.note(part, scope.name)
            else:
                _note_unread(urdf, scope, part, scope.name)
    # before SDF 1.6, the gravity stood in <physics>
    for holder in (world, *(world.iterfind("physics") if urdf.frames.world.version < (1, 6) else ())):
        gravity = document.numbers(holder, "gravity", _DOWN)
        if any(abs(value - usual) > _FEW for value, usual in zip(gravity, _DOWN, strict=True)):
            urdf.leave_out("gravity", " ".join(map("{:g}".format, gravity)), holder.find("gravity", holder))
    for part in world if world.tag == "world" else ():
        if part.tag == "joint":
            urdf.leave_out("joint of the world", part.get("name", ""), part)
        elif part is not model.element and part.tag != "gravity":
            urdf.note(part)


def _note_unread(urdf: Urdf, scope: Frame, element: Element, name: str) -> None:
    """Count the elements in an element of a model that are not read."""
    name = element.get("name") or name
    known = _READ.get(element.tag, frozenset())
    for part in element if known else ():
        if part.tag in known:
            _note_unread(urdf, scope, part, name)
        elif part.tag != MODEL_AXES or scope.version >= (1, 7):
            urdf.note(part, name)
