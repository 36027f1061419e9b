"""Reads links, joints and materials. A faulty value gives a diagnostic, and a default replaces it."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from xml.etree.ElementTree import Element

import msgspec

from urdfsync.formats.urdf.parse.fields import Reader, parse_numbers, quoted
from urdfsync.formats.urdf.robot import (
    JOINT_KINDS,
    MOTION_KINDS,
    SHAPES,
    Collision,
    Contact,
    Dynamics,
    Inertia,
    Inertial,
    Joint,
    Link,
    Material,
    Visual,
)
from urdfsync.formats.urdf.validate import perhaps

_TWINS = {"iyx": "ixy", "izx": "ixz", "izy": "iyz"}
"""Attributes of the lower half of an inertia, with their equals in the upper half: some exporters write both."""


def read_link(reader: Reader, element: Element, path: str, contact: Contact | None) -> Link:
    """Read a link; its materials are not looked up yet. An absent mass or inertia is 0, with a warning."""
    owner, place = f"link {element.get('name', '')}", f"{path} / inertial"
    part, inertial = element.find("inertial"), None
    if part is not None:
        mass, inertia = part.find("mass"), part.find("inertia")
        for twin, name in _TWINS.items():
            if inertia is not None and inertia.get(twin) == inertia.get(name):
                inertia.attrib.pop(twin, None)
        inertial = reader.read(part, place, Inertial, owner)
        if mass is None or "value" not in mass.attrib:
            reader.add(part if mass is None else mass, "missing-mass", f"{place} has no mass: 0 is taken")
        absent = [name for name in Inertia.__struct_fields__ if inertia is None or name not in inertia.attrib]
        if absent:
            message = f"{place} has no {', '.join(absent)}: taken as 0"
            reader.add(part if inertia is None else inertia, "missing-inertia", message)
    visuals = tuple(_read_shapes(reader, element, path, "visual", owner))
    collisions = tuple(_read_shapes(reader, element, path, "collision", owner))
    parts = {"inertial": inertial, "visuals": visuals, "collisions": collisions, "contact": contact}
    return reader.read(element, path, Link, owner, **parts)


def _read_shapes(reader: Reader, link: Element, path: str, tag: str, owner: str) -> Iterator[Visual | Collision]:
    """Yield each visual or collision that can be drawn.

    A shape that can't be drawn gets a warning and no number in paths.
    """
    number = 0
    for element in link.findall(tag):
        holder = element.find("geometry")
        shapes = [] if holder is None else [child for child in holder if child.tag in SHAPES]
        if holder is None or not shapes:
            message = f"a {tag} of {path} has no geometry that URDF knows, and is left out"
            reader.add(element, "unknown-geometry", message)
            reader.children(element, path, ("origin", "geometry", "material"), owner)
            continue
        number += 1
        place, kind = reader.place(element, f"{path} / {tag} {number}"), shapes[0].tag
        if len(shapes) > 1:
            message = f"{place} has {len(shapes)} geometries; the first counts"
            reader.add(element, "duplicate-element", message, f"write one {tag} for each")
        reader.expect(holder, f"{place} / geometry", (), moves=False)
        for child in holder:
            if child.tag not in SHAPES:
                reader.keep(child, place, (), owner)
        geometry = reader.read(shapes[0], reader.place(shapes[0], f"{place} / {kind}"), SHAPES[kind], owner)
        if tag == "collision":
            yield reader.read(element, place, Collision, owner, geometry=geometry)
        else:
            inner = element.find("material")
            material = None if inner is None else read_material(reader, inner, f"{place} / material", owner)
            yield reader.read(element, place, Visual, owner, geometry=geometry, material=material)


def read_material(reader: Reader, element: Element, path: str, owner: str = "") -> Material:
    """Read a material as written. A missing colour is None; so is a faulty colour, with a warning."""
    reader.expect(element, path, ("name",), moves=False)
    color = reader.children(element, path, ("color",), owner).get("color")
    rgba = None
    if color is not None:
        reader.expect(color, f"{path} / color", ("rgba",), moves=False)
        reader.children(color, path, (), owner)
        shown = f"{path} / color: rgba={quoted(color.get('rgba', ''))}"
        try:
            numbers = parse_numbers(color.get("rgba", ""), 4)
        except ValueError as error:
            reader.add(color, "bad-color", f"{shown} {error}")
        else:
            red, green, blue, opacity = (min(max(value, 0.0), 1.0) for value in numbers)
            rgba = red, green, blue, opacity
            if rgba != numbers:
                reader.add(color, "color-range", f"{shown} is not between 0 and 1, and is clamped")
    return Material(element.get("name", ""), rgba)


def resolve_materials(
    reader: Reader, root: Element, links: Mapping[str, Link], materials: Mapping[str, Material]
) -> list[Link]:
    """Return the links after looking up their materials by name in the whole robot.

    As in urdfdom, the first definition of a name counts: the robot's own `materials` come before those in visuals. The
    keys of `links` and `materials` are paths.
    """
    inline = {
        f"{path} / visual {number} / material": visual.material
        for path, link in links.items()
        for number, visual in enumerate(link.visuals, start=1)
        if visual.material
    }
    table: dict[str, Material] = {}
    for path, material in {**materials, **inline}.items() if inline else ():
        if material.name and material.rgba and table.setdefault(material.name, material) != material:
            message = f"material {material.name!r} is defined again, with other values; the first definition counts"
            reader.tell("material-redefined", path, message)
    defined = {material.get("name") for material in root.iter("material") if len(material)}  # a colour or a texture
    for path, material in inline.items():
        if material.name and material.name not in defined:
            reader.tell("unknown-material", path, f"material {material.name!r} is not defined")

    def resolved(visual: Visual) -> Visual:
        material = visual.material and table.get(visual.material.name, visual.material)
        return msgspec.structs.replace(visual, material=None if material == Material() else material)

    return [
        msgspec.structs.replace(link, visuals=tuple(map(resolved, link.visuals))) if link.visuals else link
        for link in links.values()
    ]


def read_joint(reader: Reader, element: Element, path: str, given: Collection[str] = ()) -> Joint | None:
    """Read a joint, with its axis as written. Numbers that the catalogue has `given` are left out.

    Return None, after an error, for a joint without parent or child. A joint of unknown type becomes a plain fixed
    joint.
    """
    _write_as_urdf(reader, element, path)
    given = given if element.get("type") in MOTION_KINDS else ()
    for part in (part for tag in ("limit", "dynamics") for part in element.findall(tag)[:1]):
        for number in given:
            part.attrib.pop(number, None)
    joint = reader.read(element, path, Joint, f"joint {element.get('name', '')}")
    if joint.type not in JOINT_KINDS:
        if joint.type:
            hint = perhaps(joint.type.lower(), JOINT_KINDS)
            reader.add(element, "unknown-joint-type", f"{path} has the unknown type {joint.type!r}", hint)
        joint = Joint(joint.name, "fixed", joint.parent, joint.child)
    if not joint.parent or not joint.child:
        return None
    _tell_missing_values(reader, element, path, joint, given)
    limit = element.find("limit")
    if limit is not None:
        _check_limit(reader, limit, f"{path} / limit", joint, given)
    elif JOINT_KINDS[joint.type].has_limits:
        message = f"{path} is {joint.type} but has no <limit>: it moves without limits"
        reader.add(element, "missing-limit", message)
    return joint


def _write_as_urdf(reader: Reader, element: Element, path: str) -> None:
    """Write other spellings of a joint as URDF has them.

    Isaac Sim writes `spherical` for a ball. SDFormat has limits and losses inside of the axis. Drake's page on parsing
    models documents `drake:acceleration` among the limits.
    """
    if (axis := element.find("axis")) is not None:
        for part in [part for part in axis if part.tag in ("limit", "dynamics") and element.find(part.tag) is None]:
            axis.remove(part)
            element.append(part)
            message = f"{path}: <{part.tag}> stands in <axis> as in SDFormat, and is read"
            reader.add(part, "sdf-spelling", message)
    if (limit := element.find("limit")) is not None:
        reader.drop_newer(limit, f"{path} / limit", ("acceleration", "deceleration", "jerk"), (1, 2))
        if acceleration := limit.attrib.pop("drake:acceleration", ""):
            limit.attrib.setdefault("acceleration", acceleration)
    if element.get("type") == "spherical":
        element.set("type", "ball")


def _tell_missing_values(reader: Reader, element: Element, path: str, joint: Joint, given: Collection[str]) -> None:
    """Add a warning for an axis, losses or a safety controller without the numbers that they are for."""
    axis, dynamics, safety = map(element.find, ("axis", "dynamics", "safety_controller"))
    if axis is not None and "xyz" not in axis.attrib and JOINT_KINDS[joint.type].has_axis:
        reader.add(axis, "missing-value", f"{path} / axis has no 'xyz', and is taken as 1 0 0", 'write xyz="…"')
    if dynamics is not None and not {*Dynamics.__struct_fields__} & {*dynamics.attrib, *given}:
        reader.add(dynamics, "missing-value", f"{path} / dynamics has none of {', '.join(Dynamics.__struct_fields__)}")
    if safety is not None and "k_velocity" not in safety.attrib:
        reader.add(safety, "missing-gain", f"{path} / safety_controller has no 'k_velocity', taken as 0")


def _check_limit(reader: Reader, limit: Element, path: str, joint: Joint, given: Collection[str]) -> None:
    """Add a warning for limits that are missing, or so small that the joint may not move.

    As in urdfdom, an absent limit of position is 0, and an absent effort or velocity means no limit. Since URDF 1.2 the
    limits of position are required, and effort and velocity may be left out without a warning.
    """
    kind, is_new = JOINT_KINDS[joint.type], reader.version >= (1, 2)
    zero = [name for name in ("lower", "upper") if name not in limit.attrib and kind.has_limits]
    if zero and is_new:
        reader.add(limit, "missing-attribute", f"{path} has no {' and '.join(zero)}, which URDF 1.2 requires")
        return
    stated = {*limit.attrib, *given}
    unlimited = [name for name in ("effort", "velocity") if name not in stated and kind.motion and not is_new]
    if joint.limit and kind.motion:
        names = ["velocity"] if joint.limit.velocity == 0 else []
        if kind.has_limits and not zero and joint.limit.lower == joint.limit.upper == 0:
            names = ["lower", "upper", *names]
        if names:
            reader.add(limit, "zero-limits", f"{path} has {', '.join(names)} = 0: the joint may not move")
    absent = [f"{' and '.join(zero)}, taken as 0"] if zero else []
    absent += [f"{' and '.join(unlimited)}, taken as unlimited"] if unlimited else []
    if absent:
        reader.add(limit, "missing-limit-value", f"{path} has no {'; no '.join(absent)}")
