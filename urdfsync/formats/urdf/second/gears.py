"""Reads the gears of a plain URDF, for the second reading and for Pinocchio."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element

import numpy as np

from urdfsync.formats.urdf.second.companions import CatalogueNumbers
from urdfsync.formats.urdf.second.plain import decimal


class Gear(NamedTuple):
    """The gear of a joint: its numbers, and another joint that its motor turns."""

    reduction: float = 1.0
    offset: float = 0.0
    rotor: float | None = None
    joint: str = ""
    joint_reduction: float = 0.0


def read_gears(root: Any, rows: Mapping[str, CatalogueNumbers]) -> dict[str, Gear]:
    """Return the gears of a URDF by joint, with the numbers of `rows` of the catalogue.

    Endings of names identify tags and attributes.
    """
    gears = dict[str, Gear]()
    turning = {
        joint.get("name")
        for joint in root.findall("joint")
        if joint.get("type") in ("revolute", "continuous") and joint.find("mimic") is None
    }
    for element in (*root.findall("transmission"), *root.findall("ros2_control/transmission")):
        kind = (element.findtext("type") or element.findtext("plugin") or element.get("type") or "").strip()
        joints = [part for part in element if part.tag.rstrip("12").lower().endswith("joint") and part.get("name")]
        found = _shared_gears(element, kind.rpartition("/")[2])
        if found is None and [joint.tag for joint in joints] == ["joint"]:
            numbers = _numbers(*joints, *element.findall("actuator"), element)
            gear = Gear(_reduction(numbers), numbers.get("offset", 0.0), numbers.get("rotorinertia"))
            found = {joints[0].get("name", ""): gear}
        for name, each in (found or {}).items():
            if each != Gear() and (not each.joint or {name, each.joint} <= turning):
                gears.setdefault(name, each)
    for name, (row, _) in rows.items():
        gear = gears.get(name, Gear())
        gear = gear._replace(reduction=row.get("reduction", gear.reduction), rotor=row.get("rotor_inertia", gear.rotor))
        if gear != Gear():
            gears[name] = gear
    return gears


def _shared_gears(element: Any, kind: str) -> dict[str, Gear] | None:
    """Return the gears of two coupled joints by the documented formulas of positions; None for other transmissions."""
    roles = {"flexJoint": "joint1", "rollJoint": "joint2", "rightActuator": "actuator1", "leftActuator": "actuator2"}
    parts, count = dict[str, Any](), 0
    for ending in ("joint", "actuator"):
        for k, part in enumerate((part for part in element if part.tag.rstrip("12").lower().endswith(ending)), 1):
            count += 1
            role = part.get("role") or part.findtext("role", "").strip() or roles.get(part.tag, f"{ending}{k}")
            parts[role if role.startswith(ending) else ""] = part
    holders = [parts.get(role, Element(role)) for role in roles.values()]
    numbers, names = [_numbers(part, with_attributes=True) for part in holders], [part.get("name") for part in holders]
    reductions, offsets = [_reduction(found) for found in numbers], [found.get("offset", 0.0) for found in numbers[:2]]
    ways = {
        "DifferentialTransmission": [[0.5, 0.5], [0.5, -0.5]],
        "WristTransmission": [[0.5, -0.5], [-0.5, -0.5]],
        "FourBarLinkageTransmission": [[1, 0], [-1 / reductions[0], 1]],
    }.get(kind)
    if ways is None:
        return None
    joints = np.array(ways) / np.outer(reductions[:2], reductions[2:])
    is_whole = count == len(roles) and parts.keys() == {*roles.values()} and len({*names[:2]} - {None, ""}) == 2
    if not is_whole or not np.isfinite(joints).all() or not np.linalg.det(joints):
        return {}
    motors, gears = np.linalg.inv(joints), dict[str, Gear]()
    for k, row in enumerate(motors):
        other, rotor = names[1 - k] if row[1 - k] else "", numbers[2 + k].get("rotorinertia")
        gears[names[k] or ""] = Gear(
            float(row[k]), float(row @ offsets / row[k]), rotor, other or "", float(row[1 - k])
        )
    return gears


def _numbers(*elements: Any, with_attributes: bool = False) -> dict[str, float]:
    """Return the numbers in elements by name, without prefix and underscores. The first number of each name counts."""
    numbers = dict[str, float]()
    for element in elements:
        texts = [(part.tag, part.get("value", part.text or "")) for part in element]
        for name, text in (*texts, *(element.attrib.items() if with_attributes else ())):
            with contextlib.suppress(ValueError):
                numbers.setdefault(name.rpartition(":")[2].replace("_", "").lower(), decimal(text))
    return numbers


def _reduction(numbers: Mapping[str, float]) -> float:
    return numbers.get("gearratio", numbers.get("mechanicalreduction", 1.0)) or 1.0
