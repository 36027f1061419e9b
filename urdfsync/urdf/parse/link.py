"""Read links and materials. A fault becomes a diagnostic, and a default takes the place of the value."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from xml.etree.ElementTree import Element

import msgspec

from urdfsync.diagnostics import Severity
from urdfsync.urdf.parse.fields import Reader, parse_numbers, quoted
from urdfsync.urdf.robot import (
    Box,
    Capsule,
    Collision,
    Cylinder,
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
from urdfsync.urdf.validate import Finding

_SHAPES: Mapping[str, type[Geometry]] = {
    "box": Box,
    "cylinder": Cylinder,
    "capsule": Capsule,
    "sphere": Sphere,
    "mesh": Mesh,
}


def read_link(reader: Reader, element: Element, path: str) -> Link:
    """Read a link, without looking up its materials."""
    name = reader.text(element, path, "name")
    reader.expect(element, path, ("name",))
    owner = f"link {name}"
    children = reader.children(element, path, ("inertial", "visual", "collision"), owner)
    inertial = _read_inertial(reader, children["inertial"], path, owner) if "inertial" in children else None
    visuals, collisions = [], []
    for shape, place, geometry in _shapes(reader, element, path, "visual"):
        inside = reader.children(shape, place, ("origin", "geometry", "material"), owner)
        material = read_material(reader, inside["material"], f"{place} / material") if "material" in inside else None
        origin = read_origin(reader, inside, place)
        visuals.append(Visual(geometry, origin, shape.get("name", ""), material))
    for shape, place, geometry in _shapes(reader, element, path, "collision"):
        origin = read_origin(reader, reader.children(shape, place, ("origin", "geometry"), owner), place)
        collisions.append(Collision(geometry, origin, shape.get("name", "")))
    return Link(name, inertial, tuple(visuals), tuple(collisions))


def read_origin(reader: Reader, children: Mapping[str, Element], path: str) -> Origin:
    """Read the `<origin>` among the children of an element; the identity if there is none."""
    if "origin" not in children:
        return Origin()
    origin = children["origin"]
    if "quat_xyzw" in origin.attrib:
        message = f"{path} / origin: quaternions can't be read"
        reader.error(origin, "unsupported-attribute", message, "write the orientation as rpy")
    return reader.read(origin, f"{path} / origin", Origin)


def _read_inertial(reader: Reader, element: Element, link: str, owner: str) -> Inertial:
    """Read mass, centre of mass and inertia; what is absent is 0, with a warning."""
    path = f"{link} / inertial"
    children = reader.children(element, path, ("origin", "mass", "inertia"), owner)
    mass, inertia = children.get("mass", Element("")), children.get("inertia", Element(""))
    reader.expect(mass, f"{path} / mass", ("value",))
    if "value" not in mass.attrib:
        message = f"{path} has no mass: it is taken as 0"
        reader.warn(children.get("mass", element), "missing-mass", message, "add the mass")
    absent = [name for name in Inertia.__struct_fields__ if name not in inertia.attrib]
    if absent:
        message = f"{path} has no {', '.join(absent)}: taken as 0"
        hint = "add all six components of the inertia"
        reader.warn(children.get("inertia", element), "missing-inertia", message, hint)
    numbers = reader.numbers(mass, f"{path} / mass", "value", 1)
    return Inertial(
        numbers[0] if numbers else 0.0,
        read_origin(reader, children, path),
        reader.read(inertia, f"{path} / inertia", Inertia),
    )


def _shapes(reader: Reader, link: Element, path: str, tag: str) -> Iterator[tuple[Element, str, Geometry]]:
    """Yield each visual or collision that can be drawn, with its path and its geometry.

    The others are left out with a warning, and do not count in the numbers of paths.
    """
    number = 0
    for element in link.findall(tag):
        geometry = element.find("geometry")
        shapes = [child for child in geometry if child.tag in _SHAPES] if geometry is not None else []
        if not shapes:
            message = f"a {tag} of {path} has no geometry that URDF knows, and is left out"
            reader.warn(element, "unknown-geometry", message, f"use one of {', '.join(_SHAPES)}")
            continue
        number += 1
        place, kind = reader.place(element, f"{path} / {tag} {number}"), shapes[0].tag
        reader.expect(element, place, ("name",))
        if len(shapes) > 1:
            message = f"{place} has {len(shapes)} geometries, of which the first counts"
            reader.warn(element, "duplicate-element", message, f"write one {tag} for each")
        yield element, place, reader.read(shapes[0], reader.place(shapes[0], f"{place} / {kind}"), _SHAPES[kind])


def read_material(reader: Reader, element: Element, path: str) -> Material:
    """Read a material as it is written; its colour is None if it is absent or, after a warning, faulty."""
    reader.expect(element, path, ("name",))
    children = reader.children(element, path, ("color", "texture"))
    color, texture = children.get("color"), children.get("texture", Element(""))
    reader.expect(texture, f"{path} / texture", ("filename",))
    rgba = None if color is None else _read_color(reader, color, f"{path} / color")
    return Material(element.get("name", ""), rgba, texture.get("filename") or None)


def _read_color(reader: Reader, element: Element, path: str) -> tuple[float, float, float, float] | None:
    """Read red, green, blue and opacity from 0 to 1. A faulty colour is a warning: the robot can be built without."""
    reader.expect(element, path, ("rgba",))
    text = element.get("rgba", "")
    try:
        rgba = parse_numbers(text, 4)
    except ValueError as error:
        reader.warn(element, "bad-color", f"{path}: rgba={quoted(text)} {error}", 'write for example rgba="1 0.5 0 1"')
        return None
    red, green, blue, opacity = (min(max(value, 0.0), 1.0) for value in rgba)
    if (red, green, blue, opacity) != rgba:
        message = f"{path}: rgba={quoted(text)} is not between 0 and 1, and is cut off there"
        reader.warn(element, "color-range", message, "divide 0 to 255 by 255")
    return red, green, blue, opacity


def resolve_materials(reader: Reader, links: Mapping[str, Link], materials: dict[str, Material]) -> tuple[Link, ...]:
    """Return the links with their materials looked up by name through the whole robot; keys are paths.

    As in urdfdom, the first definition of a name counts: those of the robot, which are `materials`, come before those
    in visuals.
    """
    inline = {
        f"{path} / visual {number} / material": visual.material
        for path, link in links.items()
        for number, visual in enumerate(link.visuals, start=1)
        if visual.material
    }
    if not inline:
        return tuple(links.values())
    table: dict[str, Material] = {}
    for path, material in (materials | inline).items():
        if not material.name or (material.rgba is None and material.texture is None):
            continue
        if table.setdefault(material.name, material) != material:
            message = f"material {material.name!r} is defined again, with other values; the first definition counts"
            hint = "give each material a name of its own"
            reader.extend([Finding(Severity.WARNING, "material-redefined", path, message, hint)])
    for path, material in inline.items():
        if material.name and material.name not in table:
            message = f"material {material.name!r} is not defined"
            hint = "define it in the robot or in a visual"
            reader.extend([Finding(Severity.WARNING, "unknown-material", path, message, hint)])

    def resolved(visual: Visual) -> Visual:
        material = visual.material and table.get(visual.material.name, visual.material)
        return msgspec.structs.replace(visual, material=None if material == Material() else material)

    return tuple(
        msgspec.structs.replace(link, visuals=tuple(map(resolved, link.visuals))) if link.visuals else link
        for link in links.values()
    )
