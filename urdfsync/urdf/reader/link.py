"""Reads links: mass properties, shapes, materials. A fault is a finding, and a default stands in for the value."""

from __future__ import annotations

import operator
from collections.abc import Iterable, Iterator

import msgspec

from urdfsync.urdf.reader.fields import Element, Findings, brief, parse_numbers
from urdfsync.urdf.reader.xml import Node
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

_SHAPES = ("box", "cylinder", "capsule", "sphere", "mesh")
_COMPONENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_UNIT = (1.0, 1.0, 1.0)
_ZERO = (0.0, 0.0, 0.0)


def read_link(element: Element, extensions: list[Extension]) -> Link:
    """The link without its materials looked up; adds what is not modelled to `extensions`."""
    element.expect(("name",))
    name = element.node.attributes.get("name", "")
    owner = f"link {name}"
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
    """The pose in the element's `<origin>`; the identity if there is none."""
    origin = element.child("origin", "xyz", "rpy")
    if origin is None:
        return Origin()
    if "quat_xyzw" in origin.node.attributes:
        message = f"{origin.path}: quaternions can't be read"
        origin.error("unsupported-attribute", message, "write the orientation as rpy")
    return Origin(origin.vector("xyz", _ZERO), origin.vector("rpy", _ZERO))


def _read_inertial(element: Element) -> Inertial:
    """Mass, centre of mass and inertia; 0, with a warning, for what is absent."""
    mass, inertia = element.child("mass", "value"), element.child("inertia", *_COMPONENTS)
    if mass is None or "value" not in mass.node.attributes:
        (mass or element).warn("missing-mass", f"{element.path} has no mass: it is taken as 0", "add the mass")
    absent = [name for name in _COMPONENTS if inertia is None or name not in inertia.node.attributes]
    if absent:
        message = f"{element.path} has no {', '.join(absent)}: taken as 0"
        (inertia or element).warn("missing-inertia", message, "add all six components of the inertia")
    return Inertial(
        mass.number("value", 0.0) if mass else 0.0,
        read_origin(element),
        Inertia(*(inertia.number(name, 0.0) for name in _COMPONENTS)) if inertia else Inertia(),
    )


def _shapes(link: Element, tag: str) -> Iterator[tuple[Element, Element]]:
    """The visuals or collisions that have a shape, each with the element of that shape.

    Shapes that can't be drawn are left out with a warning; the others count from 1 without them.
    """
    number = 0
    for node in link.node.children:
        if node.tag != tag:
            continue
        shapes = _shape_nodes(node)
        if not shapes:
            message = f"a {tag} of {link.path} has no geometry that URDF knows, and is left out"
            hint = f"use one of {', '.join(_SHAPES)}"
            link.findings.warn("unknown-geometry", node.line, message, hint)
            continue
        number += 1
        shape = Element(node, f"{link.path} / {tag} {number}", link.findings)
        shape.expect(("name",))
        shape.child("geometry")
        if len(shapes) > 1:
            message = f"{shape.path} has {len(shapes)} geometries, of which the first counts"
            shape.warn("duplicate-element", message, f"write one {tag} for each")
        yield shape, Element(shapes[0], f"{shape.path} / {shapes[0].tag}", link.findings)


def _shape_nodes(node: Node) -> list[Node]:
    """The shapes in the first `<geometry>` of a visual or collision."""
    geometry = next((child for child in node.children if child.tag == "geometry"), None)
    return [child for child in geometry.children if child.tag in _SHAPES] if geometry else []


def _read_geometry(element: Element) -> Geometry:
    """One of the shapes of URDF."""
    match element.node.tag:
        case "box":
            element.expect(("size",))
            return Box(element.required_vector("size"))
        case "sphere":
            element.expect(("radius",))
            return Sphere(element.required("radius"))
        case "mesh":
            element.expect(("filename", "scale"))
            return Mesh(element.text("filename"), element.vector("scale", _UNIT))
        case tag:
            element.expect(("radius", "length"))
            kind = Cylinder if tag == "cylinder" else Capsule
            return kind(element.required("radius"), element.required("length"))


def read_material(element: Element) -> Material:
    """A material as it stands there; its colour is None if it is absent, or, after a warning, faulty."""
    color, texture = element.child("color", "rgba"), element.child("texture", "filename")
    return Material(
        element.node.attributes.get("name", ""),
        _read_color(color) if color else None,
        (texture.node.attributes.get("filename") or None) if texture else None,
    )


def _read_color(element: Element) -> tuple[float, float, float, float] | None:
    """Red, green, blue and opacity from 0 to 1; a colour is never a reason to refuse a robot."""
    text = element.node.attributes.get("rgba")
    if text is None:
        element.warn("bad-color", f"{element.path} has no attribute 'rgba'", "add rgba=…")
        return None
    try:
        rgba = parse_numbers(text, 4)
    except ValueError as error:
        element.warn("bad-color", f"{element.path}: rgba={brief(text)} {error}", 'write for example rgba="1 0.5 0 1"')
        return None
    red, green, blue, opacity = (min(max(value, 0.0), 1.0) for value in rgba)
    if (red, green, blue, opacity) != rgba:
        message = f"{element.path}: rgba={brief(text)} is not between 0 and 1, and is cut off there"
        element.warn("color-range", message, "divide 0 to 255 by 255")
    return red, green, blue, opacity


def resolve_materials(
    paths: Iterable[tuple[str, Link]], known: Iterable[tuple[str, Material]], findings: Findings
) -> tuple[Link, ...]:
    """The links with their materials looked up by name through the whole robot.

    As in urdfdom, the first definition of a name counts: those of the robot come before those in visuals.
    `known` are the former; links and materials come with their paths.
    """
    links = list(paths)
    inline = (
        (f"{path} / visual {number} / material", visual.material)
        for path, link in links
        for number, visual in enumerate(link.visuals, start=1)
        if visual.material
    )
    table: dict[str, Material] = {}
    for path, material in (*known, *inline):
        if not material.name or (material.rgba is None and material.texture is None):
            continue
        if table.setdefault(material.name, material) != material:
            message = f"material {material.name!r} is defined again, with other values; the first definition counts"
            findings.warn("material-redefined", findings.line(path), message, "give each material a name of its own")
    return tuple(_with_materials(path, link, table, findings) for path, link in links)


def _with_materials(path: str, link: Link, table: dict[str, Material], findings: Findings) -> Link:
    """The link with its materials replaced by those of the table."""
    visuals = []
    for number, visual in enumerate(link.visuals, start=1):
        material = visual.material
        if material and material.name in table:
            material = table[material.name]
        elif material and material.name:
            message = f"material {material.name!r} is not defined"
            line = findings.line(f"{path} / visual {number} / material")
            findings.warn("unknown-material", line, message, "define it in the robot or in a visual")
        elif material == Material():
            material = None
        visuals.append(visual if material is visual.material else msgspec.structs.replace(visual, material=material))
    same = all(map(operator.is_, visuals, link.visuals))
    return link if same else msgspec.structs.replace(link, visuals=tuple(visuals))
