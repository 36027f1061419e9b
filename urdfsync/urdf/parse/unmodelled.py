"""What a URDF says that no model shows: one note names it all, so that nothing is left out in silence."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Container, Iterable, Iterator
from typing import NamedTuple
from xml.etree.ElementTree import Element

from urdfsync.diagnostics import Diagnostic
from urdfsync.urdf.parse.fields import Reader
from urdfsync.urdf.validate import diagnostic

_NAMES = 3
_STATES = ("position", "velocity", "acceleration", "effort")
"""State interfaces of a joint that a model has."""
_IDENTITY = frozenset({"name", "type", "role"})
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


def note_unmodelled(reader: Reader, joints: Container[str], textures: Iterable[Element]) -> Iterator[Diagnostic]:
    """Yield one note on all that is in no model, each with its line as detail; none if there is nothing.

    What is modelled was taken out of what the reader keeps. `joints` are the names of those that have an axis.
    """
    found = defaultdict[str, list[_Part]](list)
    for owner, element in reader.kept:
        for part in _parts(owner, element, reader.modelled, joints):
            found[part.kind].append(part)
    for texture in textures:
        found["<texture>"].append(_Part("<texture>", texture.get("filename", ""), texture))
    for name, element in reader.unknown:
        found["attribute"].append(_Part("attribute", f"{element.tag} {name}", element))
    if not found:
        return
    said, places = [], []
    for kind, parts in found.items():
        names = list(dict.fromkeys(part.name for part in parts if part.name))
        shown = ", ".join([*names[:_NAMES], *(["…"] if len(names) > _NAMES else [])])
        plural = "" if len(parts) == 1 or kind.startswith("<") else "s"
        said.append(f"{len(parts)} {kind}{plural}{f' ({shown})' if shown else ''}")
        places += [(reader.line(part.element), f"{kind} {part.name}".rstrip()) for part in parts]
    places.sort()
    details = tuple(f"line {line}: {what}" for line, what in places)
    yield diagnostic("not-modelled", f"not modelled: {', '.join(said)}", places[0][0], details=details)


def _parts(owner: str, element: Element, modelled: Container[Element], joints: Container[str]) -> Iterator[_Part]:
    match element.tag:
        case "gazebo":
            for one in element:
                if one.tag == "sensor":
                    yield from _parts_of_sensor(one.get("name", ""), one, modelled)
                for plugin in one.iter("plugin"):
                    yield _Part("gazebo plugin", plugin.get("name", plugin.get("filename", "")), plugin)
                if one.tag not in ("sensor", "plugin", "joint"):
                    yield _Part("gazebo setting", one.tag, one)
        case "ros2_control":
            for one in element:
                if one.tag == "sensor":
                    yield from _parts_of_sensor(one.get("name", ""), one, modelled)
                elif one.tag == "transmission":
                    yield from _parts_of_transmission(one, modelled)
                elif one.tag == "joint" and one.get("name", "") in joints:
                    for rest in _parts_of_joint(one):
                        yield _Part("ros2_control setting", f"{rest.tag} {rest.get('name', '')}".rstrip(), rest)
                else:
                    yield _Part("ros2_control setting", f"{one.tag} {one.get('name', '')}".rstrip(), one)
        case "sensor":
            yield from _parts_of_sensor(element.get("name") or owner, element, modelled)
        case "transmission":
            yield from _parts_of_transmission(element, modelled)
        case tag if not is_loop(element) and (owner or tag != "inertial"):
            yield _Part(f"<{tag}>", element.get("name") or owner, element)


def _parts_of_sensor(name: str, sensor: Element, modelled: Container[Element]) -> Iterator[_Part]:
    """Yield a sensor, or what its model leaves out."""
    if sensor not in modelled:
        yield _Part("sensor", name, sensor)
        return
    for attribute in sensor.attrib.keys() - _IDENTITY:
        yield _Part("sensor setting", f"{sensor.tag} {attribute}", sensor)
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
