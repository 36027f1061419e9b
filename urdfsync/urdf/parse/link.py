"""Read links and materials. A fault becomes a diagnostic, and a default takes the place of the value."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import msgspec

from urdfsync.urdf.parse.fields import Element, Findings, parse_numbers, quoted
from urdfsync.urdf.robot import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Extension,
    Geometry,
    Inertia,
    Inertial,
    Link,
    Material,
    Mesh,
    Origin,
    Sphere,
    Visual,
)

_SHAPES: Mapping[str, type[Geometry]] = {
    "box": Box,
    "cylinder": Cylinder,
    "capsule": Capsule,
    "sphere": Sphere,
    "mesh": Mesh,
}
_UNIT = (1.0, 1.0, 1.0)
_ZERO = (0.0, 0.0, 0.0)


def read_link(element: Element, extensions: list[Extension]) -> Link:
    """Read a link, without looking up its materials; add what is not modelled to `extensions`."""
    name = element.text("name")
    owner = f"link {name}"
    element.expect(("name",))
    extensions += element.extensions(owner, ("inertial", "visual", "collision"))
    inertial = element.child("inertial")
    visuals = []
    for shape, geometry in _shapes(element, "visual"):
        extensions += shape.extensions(owner, ("origin", "geometry", "material"))
        title = shape.node.attributes.get("name", "")
        material = shape.child("material", "name")
        surface = read_material(material) if material else None
        visuals.append(Visual(_read_geometry(geometry), read_origin(shape), title, surface))
    collisions = []
    for shape, geometry in _shapes(element, "collision"):
        extensions += shape.extensions(owner, ("origin", "geometry"))
        title = shape.node.attributes.get("name", "")
        collisions.append(Collision(_read_geometry(geometry), read_origin(shape), title))
    if inertial:
        extensions += inertial.extensions(owner, ("origin", "mass", "inertia"))
    return Link(name, _read_inertial(inertial) if inertial else None, tuple(visuals), tuple(collisions))


def read_origin(element: Element) -> Origin:
    """Read the `<origin>` in an element; the identity if there is none."""
    origin = element.child("origin", "xyz", "rpy")
    if origin is None:
        return Origin()
    if "quat_xyzw" in origin.node.attributes:
        message = f"{origin.path}: quaternions can't be read"
        origin.error("unsupported-attribute", message, "write the orientation as rpy")
    return Origin(origin.vector("xyz", _ZERO), origin.vector("rpy", _ZERO))


def _read_inertial(element: Element) -> Inertial:
    """Read mass, centre of mass and inertia; what is absent is 0, with a warning."""
    components = Inertia.__struct_fields__
    mass, inertia = element.child("mass", "value"), element.child("inertia", *components)
    if mass is None or "value" not in mass.node.attributes:
        (mass or element).warn("missing-mass", f"{element.path} has no mass: it is taken as 0", "add the mass")
    absent = [name for name in components if inertia is None or name not in inertia.node.attributes]
    if absent:
        message = f"{element.path} has no {', '.join(absent)}: taken as 0"
        (inertia or element).warn("missing-inertia", message, "add all six components of the inertia")
    return Inertial(
        mass.number("value", 0.0) if mass else 0.0,
        read_origin(element),
        inertia.numbers(Inertia) if inertia else Inertia(),
    )


def _shapes(link: Element, tag: str) -> Iterator[tuple[Element, Element]]:
    """Yield each visual or collision that can be drawn, with the element of its shape.

    The others are left out with a warning, and do not count in the numbers of paths.
    """
    number = 0
    for node in link.node.children:
        if node.tag != tag:
            continue
        geometry = next((child for child in node.children if child.tag == "geometry"), None)
        shapes = [child for child in geometry.children if child.tag in _SHAPES] if geometry else []
        if not shapes:
            message = f"a {tag} of {link.path} has no geometry that URDF knows, and is left out"
            link.findings.warn("unknown-geometry", node.line, message, f"use one of {', '.join(_SHAPES)}")
            continue
        number += 1
        shape = Element(node, f"{link.path} / {tag} {number}", link.findings)
        shape.expect(("name",))
        shape.child("geometry")
        if len(shapes) > 1:
            message = f"{shape.path} has {len(shapes)} geometries, of which the first counts"
            shape.warn("duplicate-element", message, f"write one {tag} for each")
        yield shape, Element(shapes[0], f"{shape.path} / {shapes[0].tag}", link.findings)


def _read_geometry(element: Element) -> Geometry:
    kind = _SHAPES[element.node.tag]
    element.expect(kind.__struct_fields__)
    match element.node.tag:
        case "box":
            return Box(element.required_vector("size"))
        case "mesh":
            return Mesh(element.text("filename"), element.vector("scale", _UNIT))
        case "sphere":
            return Sphere(element.required("radius"))
        case tag:
            round_kind = Cylinder if tag == "cylinder" else Capsule
            return round_kind(element.required("radius"), element.required("length"))


def read_material(element: Element) -> Material:
    """Read a material as it is written; its colour is None if it is absent or, after a warning, faulty."""
    color, texture = element.child("color", "rgba"), element.child("texture", "filename")
    return Material(
        element.node.attributes.get("name", ""),
        _read_color(color) if color else None,
        (texture.node.attributes.get("filename") or None) if texture else None,
    )


def _read_color(element: Element) -> tuple[float, float, float, float] | None:
    """Read red, green, blue and opacity from 0 to 1. A faulty colour is a warning: the robot can be built without."""
    text = element.node.attributes.get("rgba")
    if text is None:
        element.warn("bad-color", f"{element.path} has no attribute 'rgba'", "add rgba=…")
        return None
    try:
        rgba = parse_numbers(text, 4)
    except ValueError as error:
        element.warn("bad-color", f"{element.path}: rgba={quoted(text)} {error}", 'write for example rgba="1 0.5 0 1"')
        return None
    red, green, blue, opacity = (min(max(value, 0.0), 1.0) for value in rgba)
    if (red, green, blue, opacity) != rgba:
        message = f"{element.path}: rgba={quoted(text)} is not between 0 and 1, and is cut off there"
        element.warn("color-range", message, "divide 0 to 255 by 255")
    return red, green, blue, opacity


def resolve_materials(
    links: Mapping[str, Link], materials: Iterable[tuple[str, Material]], findings: Findings
) -> tuple[Link, ...]:
    """Return the links, whose paths are the keys, with their materials looked up by name through the whole robot.

    As in urdfdom, the first definition of a name counts: those of the robot, which are `materials` with their paths,
    come before those in visuals.
    """
    inline = [
        (f"{path} / visual {number} / material", visual.material)
        for path, link in links.items()
        for number, visual in enumerate(link.visuals, start=1)
        if visual.material
    ]
    table: dict[str, Material] = {}
    for path, material in (*materials, *inline):
        if not material.name or (material.rgba is None and material.texture is None):
            continue
        if table.setdefault(material.name, material) != material:
            message = f"material {material.name!r} is defined again, with other values; the first definition counts"
            findings.warn("material-redefined", findings.line(path), message, "give each material a name of its own")
    for path, material in inline:
        if material.name and material.name not in table:
            message = f"material {material.name!r} is not defined"
            findings.warn("unknown-material", findings.line(path), message, "define it in the robot or in a visual")

    def resolved(visual: Visual) -> Visual:
        if visual.material is None:
            return visual
        found = None if visual.material == Material() else table.get(visual.material.name, visual.material)
        return msgspec.structs.replace(visual, material=found)

    return tuple(
        msgspec.structs.replace(link, visuals=tuple(map(resolved, link.visuals))) if link.visuals else link
        for link in links.values()
    )
