"""What a URDF says that no model shows: one note names it all, so that nothing is left out in silence."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Container, Iterable, Iterator, Mapping
from typing import NamedTuple
from xml.etree.ElementTree import Element

from urdfsync.diagnostics import Diagnostic
from urdfsync.urdf.validate import diagnostic

_READ = ("transmission", "ros2_control")
_NAMES = 3


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


def note_unmodelled(
    kept: Iterable[tuple[str, Element]],
    modelled: Container[Element],
    attributes: Iterable[tuple[str, Element]],
    lines: Mapping[Element, int],
) -> Iterator[Diagnostic]:
    """Yield one note on all that is in no model, each with its line as detail; none if there is nothing.

    `kept` are the elements that the reader did not ask for, each with its owner, and `attributes` are such attributes.
    Those that are `modelled` all the same are left out.
    """
    found = defaultdict[str, list[_Part]](list)
    for owner, element in kept:
        for part in _parts(owner, element):
            if part.element not in modelled:
                found[part.kind].append(part)
    for name, element in attributes:
        found["attribute"].append(_Part("attribute", f"{element.tag} {name}", element))
    if not found:
        return
    said, places = [], []
    for kind, parts in found.items():
        names = list(dict.fromkeys(part.name for part in parts if part.name))
        shown = ", ".join([*names[:_NAMES], *(["…"] if len(names) > _NAMES else [])])
        plural = "" if len(parts) == 1 or kind.startswith("<") else "s"
        said.append(f"{len(parts)} {kind}{plural}{f' ({shown})' if shown else ''}")
        places += [(lines[part.element], f"{kind} {part.name}".rstrip()) for part in parts]
    places.sort()
    details = tuple(f"line {line}: {what}" for line, what in places)
    yield diagnostic("not-modelled", f"not modelled: {', '.join(said)}", places[0][0], details=details)


def _parts(owner: str, element: Element) -> Iterator[_Part]:
    if element.tag == "gazebo":
        for one in element:
            if one.tag == "sensor":
                yield _Part("sensor", one.get("name", ""), one)
            for plugin in one.iter("plugin"):
                yield _Part("gazebo plugin", plugin.get("name", plugin.get("filename", "")), plugin)
            if one.tag not in ("sensor", "plugin", "joint"):
                yield _Part("gazebo setting", one.tag, one)
    elif element.tag == "ros2_control":
        yield from (_Part("sensor", one.get("name", ""), one) for one in element.findall("sensor"))
    elif element.tag == "sensor":
        yield _Part("sensor", element.get("name") or owner, element)
    elif element.tag not in _READ and not is_loop(element) and (owner or element.tag != "inertial"):
        yield _Part(f"<{element.tag}>", element.get("name") or owner, element)
