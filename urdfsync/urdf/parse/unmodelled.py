"""What a URDF says that no model shows: one note names it all, so that nothing is left out in silence."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Container, Iterator
from typing import NamedTuple
from xml.etree.ElementTree import Element

import msgspec

from urdfsync.diagnostics import Diagnostic, cut
from urdfsync.urdf.parse.fields import Reader
from urdfsync.urdf.parse.xml import is_of_xml
from urdfsync.urdf.robot import JOINT_KINDS, MOTION_KINDS, Calibration, Joint, Limit, Robot
from urdfsync.urdf.validate import diagnostic

_LONGEST = 60
"""Characters of a name in the note; its details have the whole."""
_KINDS, _NAMES = 12, 3
"""So many kinds of things, and names of each, are in the note."""
_TEXTURES = ("material/texture", "link/visual/material/texture")
_STATES = ("position", "velocity", "acceleration", "effort")
"""State interfaces of a joint that a model has."""
_IDENTITY = frozenset({"name", "type", "role", "reference"})
"""Attributes of elements that say no more than which one, or of which kind, they are."""


class _Part(NamedTuple):
    kind: str
    """In the singular."""
    name: str
    element: Element


def is_loop(element: Element) -> bool:
    """Return whether an element of the robot joins two links of the tree: in Drake's words, or in gazebo's."""
    return element.tag in ("loop_joint", "drake:ball_constraint") or (
        element.tag == "gazebo" and element.find("joint") is not None
    )


def note_unmodelled(reader: Reader, root: Element, robot: Robot) -> Iterator[Diagnostic]:
    """Yield one note on all that is in no model, each with its line as detail; none if there is nothing.

    What is modelled was taken out of what the reader keeps.
    """
    joints = {joint.name for joint in robot.joints if joint.type in MOTION_KINDS}
    found = defaultdict[str, list[_Part]](list)
    for owner, element in reader.kept:
        for part in _parts(owner, element, reader.modelled, joints):
            found[part.kind].append(part)
    for texture in (one for path in _TEXTURES for one in root.iterfind(path)):
        found["<texture>"].append(_Part("<texture>", texture.get("filename", ""), texture))
    without_effect = {joint.name for joint in robot.joints if _has_other_limits(joint)}
    for joint in root.iterfind("joint") if without_effect else ():
        if joint.get("name") in without_effect:
            found["ineffective limit"].append(_Part("ineffective limit", f"joint {joint.get('name')}", joint))
    for name, element in reader.unknown:
        found["attribute"].append(_Part("attribute", f"{element.tag} {name}", element))
    if not found:
        return
    said, places = [], []
    for kind, parts in found.items():
        names = list(dict.fromkeys(cut(part.name, _LONGEST) for part in parts if part.name))
        shown = ", ".join([*names[:_NAMES], *(["…"] if len(names) > _NAMES else [])])
        plural = "" if len(parts) == 1 or kind.endswith(">") else "s"
        said.append(f"{len(parts)} {cut(kind, _LONGEST)}{plural}{f' ({shown})' if shown else ''}")
        places += [(reader.line(part.element), f"{kind} {part.name}".rstrip()) for part in parts]
    if len(said) > _KINDS:
        said[_KINDS:] = [f"{len(said) - _KINDS} other kinds of things"]
    places.sort()
    details = tuple(f"line {line}: {what}" for line, what in places)
    yield diagnostic("not-modelled", f"not modelled: {', '.join(said)}", places[0][0], details=details)


def _has_other_limits(joint: Joint) -> bool:
    """Return whether a joint says limits, a calibration or gains that one of its type does not have."""
    kind = JOINT_KINDS[joint.type]
    said = msgspec.structs.astuple(joint.limit or Limit())
    if kind.motion:
        return not kind.has_limits and any(said[:2])
    return any(said) or joint.calibration not in (None, Calibration()) or joint.safety_controller is not None


def _parts(owner: str, element: Element, modelled: Container[Element], joints: Container[str]) -> Iterator[_Part]:
    match element.tag:
        case "gazebo":
            yield from _attributes("gazebo setting", element)
            for one in element:
                if one.tag == "sensor":
                    yield from _parts_of_sensor(one.get("name", ""), one, modelled)
                yield from _plugins(one)
                if one.tag not in ("sensor", "plugin", "joint"):
                    yield _Part("gazebo setting", one.tag, one)
        case "ros2_control":
            yield from _attributes("ros2_control setting", element)
            for one in element:
                if one.tag == "sensor":
                    yield from _parts_of_sensor(one.get("name", ""), one, modelled)
                elif one.tag == "transmission":
                    yield from _parts_of_transmission(one, modelled)
                elif one.tag == "joint" and one.get("name", "") in joints:
                    yield from _attributes("ros2_control setting", one)
                    for rest in _parts_of_joint(one):
                        yield _Part("ros2_control setting", f"{rest.tag} {rest.get('name', '')}".rstrip(), rest)
                else:
                    yield _Part("ros2_control setting", f"{one.tag} {one.get('name', '')}".rstrip(), one)
        case "sensor":
            yield from _parts_of_sensor(element.get("name") or owner, element, modelled)
            yield from _plugins(element)
        case "transmission":
            yield from _parts_of_transmission(element, modelled)
        case "contact" if len(element):  # its friction may be modelled
            yield from _attributes("contact setting", element)
            yield from (_Part("contact setting", one.tag, one) for one in element)
        case tag if not is_loop(element) and (owner or tag != "inertial"):
            yield _Part(f"<{tag}>", element.get("name") or owner, element)


def _plugins(element: Element) -> Iterator[_Part]:
    """Yield an element that is a plugin, or the plugins in it."""
    for plugin in element.iter("plugin"):
        yield _Part("gazebo plugin", plugin.get("name", plugin.get("filename", "")), plugin)


def _attributes(kind: str, element: Element) -> Iterator[_Part]:
    """Yield the attributes of an element that are left of it."""
    for name in element.keys():  # noqa: SIM118 - else its children
        if name not in _IDENTITY and not is_of_xml(name):
            yield _Part(kind, f"{element.tag} {name}", element)


def _parts_of_sensor(name: str, sensor: Element, modelled: Container[Element]) -> Iterator[_Part]:
    """Yield a sensor, or what its model leaves out."""
    if sensor not in modelled:
        yield _Part("sensor", name, sensor)
        return
    yield from _attributes("sensor setting", sensor)
    for one in sensor:
        if one in modelled:
            yield from _parts_of_sensor(name, one, modelled)
        elif one.tag != "plugin":
            yield _Part("sensor setting", one.tag, one)


def _parts_of_transmission(transmission: Element, modelled: Container[Element]) -> Iterator[_Part]:
    """Yield a transmission, or what is in it beside the gear, if that is modelled."""
    if transmission not in modelled:
        yield _Part("transmission", transmission.get("name", ""), transmission)
        return
    for one in transmission:
        if one.tag in ("joint", "actuator"):
            yield from _attributes("transmission setting", one)
            yield from (_Part("transmission setting", setting.tag, setting) for setting in one)
        elif one.tag not in ("type", "plugin") or "SimpleTransmission" not in (one.text or ""):
            yield _Part("transmission setting", one.tag, one)


def _parts_of_joint(joint: Element) -> Iterator[Element]:
    """Yield what a joint of ros2_control has beside its command and the states of a joint, and what is in these."""
    for one in joint:
        name = one.get("name", "")
        is_command = one.tag == "command_interface" and not name  # it was taken
        if is_command or (one.tag == "state_interface" and name in _STATES):
            yield from one
        else:
            yield one
