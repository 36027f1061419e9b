"""Makes masses, shapes and sensors of the links of an SDF."""

from __future__ import annotations

import os
from typing import Any
from xml.etree.ElementTree import Element, SubElement

from urdfsync.common.files import relative
from urdfsync.formats.sdf.document import SdfDocument
from urdfsync.formats.sdf.frames import Frame
from urdfsync.formats.sdf.inertia import automatic_inertia, shape_sizes
from urdfsync.formats.sdf.urdf import Urdf
from urdfsync.formats.translation.writer import UrdfElement
from urdfsync.formats.urdf.kinematics.poses import IDENTITY
from urdfsync.formats.urdf.robot import SENSOR_KINDS

_SENSORS = {word for kind, model in SENSOR_KINDS.items() for word in (kind, *model.types)}
_MOMENTS = {"ixx": 1.0, "ixy": 0.0, "ixz": 0.0, "iyy": 1.0, "iyz": 0.0, "izz": 1.0}
"""The inertia of a link that states none."""
_CONTACT = {
    "friction/ode/mu": "mu1",
    "contact/ode/kp": "kp",
    "contact/ode/kd": "kd",
    "contact/ode/min_depth": "minDepth",
}
"""Numbers of a `<surface>`, and their tags in the `<gazebo>` of a URDF."""

_SCAN = {"scan/horizontal/samples": "640", "scan/vertical/samples": "1"}
_IMAGE = {"horizontal_fov": "1.047", "image/width": "320", "image/height": "240", "clip/near": "0.1", "clip/far": "100"}
_DEFAULTS = {"camera": _IMAGE, "ray": _SCAN, "lidar": _SCAN}
"""Numbers of sensors that state none; all others are 0."""


def add_link(urdf: Urdf, frame: Frame) -> None:
    """Add a link with its mass, shapes and sensors."""
    document, element = urdf.document, frame.element
    link = urdf.root.add("link", document.places[element], name=urdf.links[frame])
    _add_inertial(urdf, link, frame)
    for tag in ("visual", "collision"):
        for shape in element.iterfind(tag):
            _add_shape(urdf, link, frame, shape)
    for sensor in element.iterfind("sensor"):
        add_sensor(urdf, sensor, frame, {"link": urdf.links[frame]}, frame)
    if not document.flag(element, "gravity", default=True):
        urdf.leave_out("gravity off", frame.name, element)
    if document.flag(element, "kinematic"):
        urdf.leave_out("kinematic link", frame.name, element)
    if any(document.number(element, f"velocity_decay/{name}", 0.0) for name in ("linear", "angular")):
        urdf.leave_out("velocity_decay", frame.name, element)


def _add_inertial(urdf: Urdf, link: UrdfElement, frame: Frame) -> None:
    """Add mass and inertia: without numbers, 1 kg and 1 kg·m² about each axis."""
    document, element = urdf.document, frame.element.find("inertial")
    inertial = link.add("inertial", document.places[frame.element if element is None else element])
    if element is not None and element.get("auto", "").strip().lower() in ("true", "1"):
        mass, pose, moments = automatic_inertia(urdf.frames, frame, element)
    else:
        mass, pose = document.number(element, "mass", 1.0), IDENTITY if element is None else document.pose(element)
        inertia = None if element is None else element.find("inertia")
        moments = {name: document.number(inertia, name, usual) for name, usual in _MOMENTS.items()}
    inertial.add("mass", value=mass)
    urdf.add_origin(inertial, urdf.place(frame, frame, pose))
    inertial.add("inertia").attributes |= moments
    added = None if element is None else element.find("fluid_added_mass")
    if added is not None and any(document.number(added, part.tag, 0.0) for part in added):
        urdf.leave_out("fluid_added_mass", frame.name, added)


def _add_shape(urdf: Urdf, link: UrdfElement, frame: Frame, element: Element) -> None:
    """Add a visual or a collision."""
    document, geometry = urdf.document, element.find("geometry")
    shape = link.add(element.tag, document.places[element], name=element.get("name") or None)
    given_in = urdf.frames.given_in(frame.scope, element, frame)
    urdf.add_origin(shape, urdf.place(given_in, frame, document.pose(element)))
    holder = shape.add("geometry")
    for kind in geometry if geometry is not None else ():
        tag, attributes = _geometry(document, kind)
        holder.add(tag, document.places[kind]).attributes |= attributes
    if element.tag == "visual" and (color := _color(document, element)):
        shape.add("material", name="").add("color", rgba=color)
    for path, tag in _CONTACT.items() if element.tag == "collision" else ():
        if (number := element.find(f"surface/{path}")) is not None:
            line = document.places[number]
            urdf.root.add("gazebo", line, reference=urdf.links[frame]).add(tag, line, (number.text or "").strip())


def _geometry(document: SdfDocument, element: Element) -> tuple[str, dict[str, Any]]:
    """Return tag and attributes of a shape in URDF. The reader of URDF tells of a shape that it lacks."""
    if element.tag == "mesh" and element.find("submesh") is None:
        scale = document.numbers(element, "scale", (1.0, 1.0, 1.0))
        way = element.get("optimization")
        return "mesh", {"filename": _filename(document, element), "scale": scale, "optimization": way}
    return "submesh" if element.tag == "mesh" else element.tag, shape_sizes(document, element)


def _filename(document: SdfDocument, mesh: Element) -> str:
    """Return the name of a mesh; a relative one counts from the folder of the source."""
    uri = mesh.findtext("uri", "").strip()
    folder, source = (os.path.dirname(file) for file in (document.places[mesh][0], document.source))  # noqa: PTH120
    if not uri or "://" in uri or folder == source:
        return uri
    return relative(os.path.join(folder, uri), source).replace(os.sep, "/")  # noqa: PTH118


def _color(document: SdfDocument, visual: Element) -> tuple[float, ...]:
    """Return the colour of a visual; empty for none."""
    material = visual.find("material")
    for tag in ("diffuse", "ambient"):
        child = None if material is None else material.find(tag)
        if child is not None:
            count = len((child.text or "").split())
            red, green, blue, *rest = document.numbers(material, tag, (0.0, 0.0, 0.0, 1.0)[: max(3, count)])
            return red, green, blue, (rest or [1.0])[0] * (1.0 - document.number(visual, "transparency", 0.0))
    return ()


def add_sensor(urdf: Urdf, element: Element, link: Frame, parent: dict[str, str], default: Frame) -> None:
    """Add a sensor of a kind that the package models; a note counts the others."""
    kind, line = element.get("type", ""), urdf.document.places[element]
    if kind not in _SENSORS:
        urdf.root.add(f"sensor-{kind}", line, name=element.get("name") or None)
        return
    sensor = urdf.root.add("sensor", line, name=element.get("name", ""), type=kind)
    sensor.add("parent").attributes |= parent
    given_in = urdf.frames.given_in(link.scope, element, default)
    urdf.add_origin(sensor, urdf.place(given_in, link, urdf.document.pose(element)))
    for part in element:
        if part.tag == "imu":  # its elements concern noise and orientation
            for inner in part:
                urdf.note(inner, sensor.attributes["name"])
        elif part.tag != "pose":
            _add_defaults(urdf.document, part)
            urdf.copy(sensor, part)


def _add_defaults(document: SdfDocument, element: Element) -> None:
    """Add the numbers to a part of a sensor that it has if it does not state them."""
    for path, value in _DEFAULTS.get(element.tag, {}).items():
        part = element
        for tag in path.split("/"):
            inner = part.find(tag)
            if inner is None:
                document.places[inner := SubElement(part, tag)] = document.places[part]
            part = inner
        part.text = (part.text or "").strip() or value
