"""Read links and materials. A fault becomes a diagnostic, and a default takes the place of the value."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from xml.etree.ElementTree import Element

import msgspec

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
    owner = f"link {element.get('name', '')}"
    inertial = element.find("inertial")
    return reader.read(
        element,
        path,
        Link,
        owner,
        inertial=None if inertial is None else _read_inertial(reader, inertial, f"{path} / inertial", owner),
        visuals=tuple(_read_shapes(reader, element, path, "visual", owner)),
        collisions=tuple(_read_shapes(reader, element, path, "collision", owner)),
    )


def check_origin(reader: Reader, element: Element, path: str) -> None:
    """Refuse a quaternion in the `<origin>` of an element."""
    origin = element.find("origin")
    if origin is not None and "quat_xyzw" in origin.attrib:
        reader.add(origin, "unsupported-attribute", f"{path} / origin: quaternions can't be read")


def _read_inertial(reader: Reader, element: Element, path: str, owner: str) -> Inertial:
    """Read mass, centre of mass and inertia; what is absent is 0, with a warning."""
    mass, inertia = element.find("mass"), element.find("inertia")
    if mass is None or "value" not in mass.attrib:
        reader.add(element if mass is None else mass, "missing-mass", f"{path} has no mass: it is taken as 0")
    absent = [name for name in Inertia.__struct_fields__ if inertia is None or name not in inertia.attrib]
    if absent:
        message = f"{path} has no {', '.join(absent)}: taken as 0"
        reader.add(element if inertia is None else inertia, "missing-inertia", message)
    check_origin(reader, element, path)
    return reader.read(element, path, Inertial, owner)


def _read_shapes(reader: Reader, link: Element, path: str, tag: str, owner: str) -> Iterator[Visual | Collision]:
    """Yield each visual or collision that can be drawn.

    The others are left out with a warning, and do not count in the numbers of paths.
    """
    number = 0
    for element in link.findall(tag):
        around = element.find("geometry")
        shapes = [child for child in around if child.tag in _SHAPES] if around is not None else []
        if not shapes:
            message = f"a {tag} of {path} has no geometry that URDF knows, and is left out"
            reader.add(element, "unknown-geometry", message)
            continue
        number += 1
        place, kind = reader.place(element, f"{path} / {tag} {number}"), shapes[0].tag
        if len(shapes) > 1:
            message = f"{place} has {len(shapes)} geometries, of which the first counts"
            reader.add(element, "duplicate-element", message, f"write one {tag} for each")
        geometry = reader.read(shapes[0], reader.place(shapes[0], f"{place} / {kind}"), _SHAPES[kind])
        check_origin(reader, element, place)
        if tag == "collision":
            yield reader.read(element, place, Collision, owner, geometry=geometry)
        else:
            found = element.find("material")
            material = None if found is None else read_material(reader, found, f"{place} / material")
            yield reader.read(element, place, Visual, owner, geometry=geometry, material=material)


def read_material(reader: Reader, element: Element, path: str) -> Material:
    """Read a material as it is written; its colour is None if it is absent or, after a warning, faulty."""
    reader.expect(element, path, ("name",))
    children = reader.children(element, path, ("color", "texture"))
    color, texture = children.get("color"), children.get("texture")
    filename = None if texture is None else texture.get("filename") or None
    rgba = None if color is None else _read_color(reader, color, f"{path} / color")
    return Material(element.get("name", ""), rgba, filename)


def _read_color(reader: Reader, element: Element, path: str) -> tuple[float, float, float, float] | None:
    """Read red, green, blue and opacity from 0 to 1. A faulty colour is a warning: the robot can be built without."""
    text = element.get("rgba", "")
    try:
        rgba = parse_numbers(text, 4)
    except ValueError as error:
        reader.add(element, "bad-color", f"{path}: rgba={quoted(text)} {error}")
        return None
    red, green, blue, opacity = (min(max(value, 0.0), 1.0) for value in rgba)
    if (red, green, blue, opacity) != rgba:
        message = f"{path}: rgba={quoted(text)} is not between 0 and 1, and is cut off there"
        reader.add(element, "color-range", message)
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
            reader.extend([Finding("material-redefined", path, message)])
    for path, material in inline.items():
        if material.name and material.name not in table:
            reader.extend([Finding("unknown-material", path, f"material {material.name!r} is not defined")])

    def resolved(visual: Visual) -> Visual:
        material = visual.material and table.get(visual.material.name, visual.material)
        return msgspec.structs.replace(visual, material=None if material == Material() else material)

    return tuple(
        msgspec.structs.replace(link, visuals=tuple(map(resolved, link.visuals))) if link.visuals else link
        for link in links.values()
    )
