"""Copies of URDF files for the comparison with Pinocchio, read by both sides.

Where a moving joint carries no mass, only the kinematics would be tested: the copy has made-up
inertials. Where Pinocchio's reader refuses what urdfsync warns of, the copy has what is missing.
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from lxml import etree


def acceptable(urdf: bytes) -> bytes:
    """The URDF with the name and the numbers of limits that it lacks; the same bytes if it lacks none."""
    root = _parse(urdf)
    missing = [] if root.get("name") else [(root, "name", "robot")]
    for limit in root.iterfind("joint/limit"):
        missing += [(limit, key, "1000") for key in ("effort", "velocity") if limit.get(key) is None]
    for element, key, value in missing:
        element.set(key, value)
    return etree.tostring(root) if missing else urdf


def lacks_inertia(urdf: bytes) -> bool:
    """Whether some moving joint carries no mass at all."""
    root = _parse(urdf)
    children: dict[str, list[str]] = {}
    for joint in root.findall("joint"):
        children.setdefault(_link(joint, "parent"), []).append(_link(joint, "child"))
    massive = {link.get("name") for link in root.findall("link") if _mass(link) > 0}

    def carries(link: str) -> bool:
        return link in massive or any(carries(child) for child in children.get(link, ()))

    return any(not carries(_link(joint, "child")) for joint in root.findall("joint") if joint.get("type") != "fixed")


def with_inertias(urdf: bytes, seed: int = 0) -> bytes:
    """The URDF with made-up inertials, turned and off-centre, in every link that has no mass.

    The tensors are those of solid boxes, and not diagonal.
    """
    root = _parse(urdf)
    random = np.random.default_rng(seed)
    for link in root.findall("link"):
        if _mass(link) > 0:
            continue
        for old in link.findall("inertial"):
            link.remove(old)
        link.append(_inertial(random))
    return etree.tostring(root)


def _inertial(random: np.random.Generator) -> etree._Element:
    mass, edges = random.uniform(0.5, 3), random.uniform(0.05, 0.3, 3)
    turn = pin.rpy.rpyToMatrix(*random.uniform(-1, 1, 3))
    tensor = turn @ np.diag((edges @ edges - edges**2) * mass / 12) @ turn.T
    element = etree.Element("inertial")
    xyz, rpy = random.uniform(-0.1, 0.1, 3), random.uniform(-1, 1, 3)
    etree.SubElement(element, "origin", xyz=_text(xyz), rpy=_text(rpy))
    etree.SubElement(element, "mass", value=repr(float(mass)))
    names = {f"i{'xyz'[i]}{'xyz'[j]}": repr(float(tensor[i, j])) for i in range(3) for j in range(i, 3)}
    etree.SubElement(element, "inertia", names)
    return element


def _parse(urdf: bytes) -> etree._Element:
    return etree.fromstring(urdf, etree.XMLParser(recover=True, remove_comments=True))


def _link(joint: etree._Element, end: str) -> str:
    element = joint.find(end)
    assert element is not None
    return element.get("link", "")


def _mass(link: etree._Element) -> float:
    element = link.find("inertial/mass")
    return 0.0 if element is None else float(element.get("value", "0"))


def _text(values: np.typing.NDArray[np.float64]) -> str:
    return " ".join(repr(float(value)) for value in values)
