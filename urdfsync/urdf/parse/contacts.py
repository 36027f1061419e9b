"""What a URDF says of the contact of links, in the words of gazebo, SDFormat, Bullet, and ROS before these."""

from __future__ import annotations

from collections.abc import Mapping
from xml.etree.ElementTree import Element

from urdfsync.urdf.parse.fields import Reader, parse_numbers, quoted
from urdfsync.urdf.robot import Contact
from urdfsync.urdf.validate import perhaps

_ODE = {
    "friction/ode/mu": "mu",
    "friction/ode/mu2": "mu2",
    "contact/ode/kp": "kp",
    "contact/ode/kd": "kd",
    "contact/ode/min_depth": "min_depth",
    "contact/ode/max_vel": "max_vel",
}
_IN_GAZEBO: Mapping[str, str] = {
    "mu1": "mu",
    "mu2": "mu2",
    "kp": "kp",
    "kd": "kd",
    "minDepth": "min_depth",
    "maxVel": "max_vel",
    **{f"{place}surface/{path}": field for place in ("", "collision/") for path, field in _ODE.items()},
}
_IN_LINK: Mapping[str, str] = {
    "contact/lateral_friction": "mu",
    "contact/stiffness": "kp",
    "contact/damping": "kd",
    "collision/contact_coefficients": "",
}
"""Paths of elements with one number, and the fields of `Contact`; one without a field has attributes of their names."""
_COEFFICIENTS = ("mu", "kp", "kd")


def take_contacts(reader: Reader, root: Element) -> Mapping[str, Contact]:
    """Take what the robot says of contacts out of its elements; return it by link. The first number of each counts.

    One that is faulty or negative is left out, with a warning, as is a stiffness of zero.
    """
    links = {link.get("name", ""): link for link in root.iterfind("link")}
    joints = {joint.get("name", "") for joint in root.iterfind("joint")}
    found: dict[str, dict[str, float]] = {}
    for gazebo in root.findall("gazebo"):
        name = gazebo.get("reference", "")
        if name and name not in links and name not in joints and gazebo.find("sensor") is None:
            message = f"<gazebo> is about {name!r}, and there is no such link or joint"
            reader.add(gazebo, "unknown-reference", message, perhaps(name, links.keys() | joints))
        numbers = found.setdefault(name, {})
        if name in links and _take(reader, gazebo, _IN_GAZEBO, f"link {name}", "", numbers) and not len(gazebo):
            root.remove(gazebo)
    for name, link in links.items():
        if link.find("contact") is None and link.find("collision/contact_coefficients") is None:
            continue  # as nearly all; saves 5 of 580 ms with 1,000 links in the daemon
        _take(reader, link, _IN_LINK, f"link {name}", "", found.setdefault(name, {}))
        for rest in link.findall("contact"):
            reader.extension(rest, f"link {name}", (), f"link {name}")
            link.remove(rest)
    return {name: Contact(**numbers) for name, numbers in found.items() if numbers}


def _take(
    reader: Reader, element: Element, fields: Mapping[str, str], owner: str, path: str, numbers: dict[str, float]
) -> bool:
    """Move numbers from the elements below one to `numbers`; return whether there were any. What is empty then goes.

    `owner` is the link as messages name it, `path` leads from its element, or from that of gazebo, to this one.
    """
    taken = False
    for child in list(element):
        place = f"{path}{child.tag}"
        if place in fields:
            said = child.get("value") or child.text or ""
            given = {fields[place]: said} if fields[place] else {key: child.get(key, "") for key in _COEFFICIENTS}
            if not fields[place]:
                reader.expect(child, place, _COEFFICIENTS)
            for field, text in given.items():
                _add(reader, child, owner, field, text.strip(), numbers)
            element.remove(child)
            taken = True
        elif any(known.startswith(f"{place}/") for known in fields) and _take(
            reader, child, fields, owner, f"{place}/", numbers
        ):
            taken = True
            if not len(child) and (fields is _IN_GAZEBO or place != "collision"):
                element.remove(child)
    return taken


def _add(reader: Reader, element: Element, owner: str, field: str, text: str, numbers: dict[str, float]) -> None:
    if not text and element.tag == "contact_coefficients":
        return
    problem = ""
    try:
        (number,) = parse_numbers(text, 1)
    except ValueError as error:
        problem, number = str(error), 0.0
    if not problem and (number < 0 or (number == 0 and field == "kp")):
        problem = "is no magnitude that a contact can have"
    if problem:
        message = f"{owner}: {field}={quoted(text)} of <{element.tag}> {problem}, and is left out"
        reader.add(element, "bad-contact", message)
    elif numbers.setdefault(field, number) != number:
        message = f"{owner}: <{element.tag}> says {number:g}, which contradicts {numbers[field]:g}, and that counts"
        reader.add(element, "duplicate-element", message)
