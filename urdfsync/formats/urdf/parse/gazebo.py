"""Reads what Gazebo, SDFormat and Bullet state about links and joints, and warns of what only acts in these.

Each of them has its own form of contact properties. The springs of Gazebo become attributes of `<dynamics>`.
"""

from __future__ import annotations

import contextlib
import re
from collections import defaultdict
from collections.abc import Mapping
from xml.etree.ElementTree import Element, SubElement

from urdfsync.formats.urdf.parse.fields import Reader
from urdfsync.formats.urdf.robot import Contact
from urdfsync.formats.urdf.validate import perhaps

_IN_GAZEBO = {
    "mu": ("mu1", "surface/friction/ode/mu", "collision/surface/friction/ode/mu"),
    "kp": ("kp", "surface/contact/ode/kp", "collision/surface/contact/ode/kp"),
    "kd": ("kd", "surface/contact/ode/kd", "collision/surface/contact/ode/kd"),
    "min_depth": ("minDepth", "surface/contact/ode/min_depth", "collision/surface/contact/ode/min_depth"),
}
_IN_LINK = {"mu": ("contact/lateral_friction",), "kp": ("contact/stiffness",), "kd": ("contact/damping",)}
"""Fields of `Contact`, with the paths of their elements in `<gazebo>` and in links."""
_SPRINGS = {"spring_stiffness": "springStiffness", "spring_reference": "springReference"}
"""Attributes of `<dynamics>`, with their elements in `<gazebo>`."""

FORCES = re.compile("force|cable|spring|damper|bushing|tendon")
"""Elements of Drake and MuJoCo with forces between the links of a robot."""


def read_contacts(reader: Reader, root: Element) -> Mapping[str, Contact]:
    """Return the contact properties of links by name.

    The first number of each field counts. Faulty and negative numbers and a stiffness of zero are left out, with a
    warning.
    """
    links = {link.get("name", ""): link for link in root.iterfind("link")}
    joints = {joint.get("name", "") for joint in root.iterfind("joint")}
    places = list[tuple[Element, str, Mapping[str, tuple[str, ...]]]]()
    for name, link in links.items():
        for contact in link.iterfind("contact"):
            reader.extensions.append((f"link {name}", contact))
            reader.expect(contact, f"link {name} / contact", (), moves=False)
            places.append((link, name, _IN_LINK))
    for gazebo in root.iterfind("gazebo"):
        name = gazebo.get("reference", "")
        if name in links:
            places.append((gazebo, name, _IN_GAZEBO))
        elif name and name not in joints and gazebo.find("sensor") is None:  # sensors have their own warning
            message = f"<gazebo> refers to {name!r}, which is no link or joint"
            reader.add(gazebo, "unknown-reference", message, perhaps(name, links.keys() | joints))
    contacts = defaultdict[str, dict[str, float]](dict)
    for element, name, ways in places:
        for field, way in ways.items():
            number = reader.number(element, way, f"link {name}", "bad-contact")
            if number is None:
                continue
            if number < 0 or (number == 0 and field == "kp"):
                message = f"link {name}: {field} {number:g} is {'negative' if number else 'zero'}, and is left out"
                reader.add(element, "bad-contact", message)
            else:
                reader.keep_first(element, contacts[name], field, number, f"link {name}: {field}")
    return {name: Contact(**numbers) for name, numbers in contacts.items()}


def write_springs(reader: Reader, root: Element) -> None:
    """Write the springs of Gazebo's elements into the `<dynamics>` of their joints.

    The first number of each field counts. A faulty number is left out, with a warning.
    """
    joints = {joint.get("name", ""): joint for joint in root.iterfind("joint")}
    # SDFormat has <dynamics> in <axis>
    stated = {name: [*joint.findall("dynamics"), *joint.findall("axis/dynamics")] for name, joint in joints.items()}
    springs = defaultdict[str, dict[str, float]](dict)
    for gazebo in root.iterfind("gazebo"):
        name = gazebo.get("reference", "")
        for field, tag in _SPRINGS.items() if name in joints else ():
            number = reader.number(gazebo, (tag,), f"joint {name}", "bad-spring")
            if number is None:
                continue
            if any(field in part.attrib or part.find(field) is not None for part in stated[name][:1]):
                message = f"joint {name}: the {field} of its <dynamics> counts, not the <{tag}> of <gazebo>"
                reader.add(gazebo, "duplicate-element", message)
            else:
                reader.keep_first(gazebo, springs[name], field, number, f"joint {name}: {tag}")
    for name, numbers in springs.items():
        if not stated[name]:
            stated[name] = [SubElement(joints[name], "dynamics")]
            reader.element_lines[stated[name][0]] = reader.element_lines[joints[name]]
        stated[name][0].attrib.update({field: repr(number) for field, number in numbers.items()})


def warn_of_left_out(reader: Reader, root: Element) -> None:
    """Add a warning for each element that changes the motion but is not modelled."""
    links = {link.get("name", ""): link for link in root.iterfind("link")}
    for gazebo in root.iterfind("gazebo"):
        name = gazebo.get("reference", "")
        for part in gazebo:
            text = (part.get("value") or part.text or "").strip().lower()
            if part.tag in ("gravity", "turnGravityOff") and text in ("0", "1", "false", "true"):
                is_heavy = (text in ("1", "true")) == (part.tag == "gravity")
                if is_heavy:
                    reader.used.add(part)
                elif name in links and links[name].find("inertial") is not None:
                    reader.add(part, "gravity-off", f"link {name!r} has no weight in Gazebo, but has it in the model")
            elif part.tag == "dampingFactor":
                with contextlib.suppress(ValueError):  # Gazebo also ignores a text that is no number
                    if float(text):
                        what = f"{part.tag} {text} of {name!r} acts in Gazebo, but not in the model"
                        reader.add(part, "force-left-out", what)
    for part in root.iterfind("link/contact/inertia_scaling"):
        reader.add(part, "force-left-out", "<inertia_scaling> changes the inertia in Bullet, but not in the model")
    for part in root:
        if FORCES.search(part.tag):
            words = f"<{part.tag}> {part.get('name', '')}".rstrip()
            reader.add(part, "force-left-out", f"{words} acts between links in Gazebo, and is left out of the model")
