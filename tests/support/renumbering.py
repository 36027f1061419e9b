"""Exports in which names mean other parts than before, as from exporters that number links and joints."""

from __future__ import annotations

import copy
from collections.abc import Iterator, Mapping
from random import Random
from typing import NamedTuple

from lxml import etree

NEW_LINK = (
    '<link name="{name}"><inertial><origin xyz="0.011 0.012 0.013"/><mass value="0.777"/>'
    '<inertia ixx="0.0071" ixy="0" ixz="0" iyy="0.0072" iyz="0" izz="0.0073"/></inertial></link>'
)
NEW_JOINT = (
    '<joint name="{name}" type="fixed"><parent link="{parent}"/><child link="{child}"/>'
    '<origin xyz="0.031 0 0"/></joint>'
)
BOTH, LINKS, JOINTS = "both", "links", "joints"


class Renumbering(NamedTuple):
    """A source after an export, and the new names of its parts."""

    kind: str
    source: bytes
    names: Mapping[tuple[str, str], str | None]
    """By kind and old name; None for a part that is removed."""


def renumberings(source: bytes, random: Random) -> Iterator[Renumbering]:
    """Yield exports of each kind: exchanged, rotated or shifted names, an added or a removed part."""
    root = etree.fromstring(source, etree.XMLParser(remove_comments=True))
    links, joints, top = _in_order(root)
    first, last = sorted(random.sample(range(len(joints)), 2))
    some = sorted(random.sample(range(len(joints)), min(4, len(joints))))
    for which in (BOTH, LINKS, JOINTS):
        for kind, places in (("exchange", [first, last]), ("rotation", some)):
            names = _names(which, _rotated(links, places), _rotated(joints, places))
            yield _renamed(f"{kind} of {which}", root, names)
        names = _names(which, _shifted(links[first:], "last_link"), _shifted(joints[first:], "last_joint"))
        yield _renamed(f"shift of {which}", root, names)
    names = _names(BOTH, _shifted(links[first:], "last_link"), _shifted(joints[first:], "last_joint"))
    yield _inserted("insertion", root, names, links[first], joints[first])
    names = _names(BOTH, _shifted([top, *links], "last_link"), _shifted(joints, "last_joint"))
    yield _inserted("insertion at the root", root, names, top, joints[0])
    if _can_go(root, links[first], joints[first]):
        yield _removed(root, links[first:], joints[first:])


def _in_order(root: etree._Element) -> tuple[list[str], list[str], str]:
    """Links and joints from the root down, and the root."""
    below: dict[str, list[tuple[str, str]]] = {}
    for joint in root.findall("joint"):
        below.setdefault(_end(joint, "parent"), []).append((_name(joint), _end(joint, "child")))
    children = {child for pairs in below.values() for _, child in pairs}
    (top,) = (_name(link) for link in root.findall("link") if _name(link) not in children)
    order, todo = list[tuple[str, str]](), [top]
    while todo:
        found = sorted(below.get(todo.pop(0), []))
        order += found
        todo += [child for _, child in found]
    return [child for _, child in order], [joint for joint, _ in order], top


def _name(element: etree._Element) -> str:
    return element.get("name", "")


def _end(joint: etree._Element, tag: str) -> str:
    return str(joint.xpath(f"string({tag}/@link)"))


def _hang(joint: etree._Element, parent: str) -> None:
    for end in joint.iter("parent"):
        end.set("link", parent)


def _rotated(names: list[str], places: list[int]) -> dict[str, str]:
    chosen = [names[place] for place in places]
    return dict(zip(chosen, [*chosen[1:], chosen[0]], strict=True))


def _shifted(names: list[str], last: str) -> dict[str, str]:
    return dict(zip(names, [*names[1:], last], strict=True))


def _names(which: str, links: Mapping[str, str], joints: Mapping[str, str]) -> dict[tuple[str, str], str | None]:
    names: dict[tuple[str, str], str | None] = {}
    if which != JOINTS:
        names |= {("link", old): new for old, new in links.items()}
    if which != LINKS:
        names |= {("joint", old): new for old, new in joints.items()}
    return names


def _rename(root: etree._Element, names: Mapping[tuple[str, str], str | None]) -> etree._Element:
    """A copy of the model with new names in all places."""
    tree = copy.deepcopy(root)
    for element in tree.iter("link", "joint", "parent", "child", "mimic", "gazebo", "sensor"):
        kinds: dict[str, tuple[str, ...]] = {
            "link": ("link",),
            "joint": ("joint",),
            "parent": ("link",),
            "child": ("link",),
            "mimic": ("joint",),
        }
        for attribute in ("name", "link", "joint", "reference"):
            if (value := element.get(attribute)) is None or (
                element.tag in ("gazebo", "sensor") and attribute == "name"
            ):
                continue
            for kind in kinds.get(str(element.tag), ("link", "joint")):
                if new := names.get((kind, value)):
                    element.set(attribute, new)
                    break
    return tree


def _renamed(kind: str, root: etree._Element, names: Mapping[tuple[str, str], str | None]) -> Renumbering:
    return Renumbering(kind, etree.tostring(_rename(root, names)), names)


def _inserted(
    kind: str, root: etree._Element, names: Mapping[tuple[str, str], str | None], link: str, joint: str
) -> Renumbering:
    """Insert a link before an old link, under the old link's name; the new joint gets the name `joint`."""
    tree = _rename(root, names)
    moved = names["link", link]
    parent = link
    for one in tree.findall("joint"):
        if _end(one, "child") == moved:
            parent = _end(one, "parent")
            _hang(one, link)
    # the new joint leads to the old root, or to the link whose name the new link takes
    ends = (link, moved) if parent == link else (parent, link)
    tree.append(etree.fromstring(NEW_LINK.format(name=link)))
    tree.append(etree.fromstring(NEW_JOINT.format(name=joint, parent=ends[0], child=ends[1])))
    return Renumbering(kind, etree.tostring(tree), names)


def _can_go(root: etree._Element, link: str, joint: str) -> bool:
    """Whether only joints mention a part."""
    others = [one for one in root.iter() if one.tag not in ("link", "joint", "parent", "child")]
    return not any(
        {link, joint} & set(one.attrib.values()) or (one.text or "").strip() in (link, joint) for one in others
    )


def _removed(root: etree._Element, links: list[str], joints: list[str]) -> Renumbering:
    """Remove the first link and its joint; the link's children move to its parent."""
    tree = copy.deepcopy(root)
    (gone,) = (one for one in tree.findall("joint") if one.get("name") == joints[0])
    parent = _end(gone, "parent")
    for one in tree.findall("joint"):
        if _end(one, "parent") == links[0]:
            _hang(one, parent)
    tree.remove(gone)
    tree.remove(next(one for one in tree.findall("link") if one.get("name") == links[0]))
    names = _names(BOTH, dict(zip(links[1:], links, strict=False)), dict(zip(joints[1:], joints, strict=False)))
    names |= {("link", links[0]): None, ("joint", joints[0]): None}
    return Renumbering("removal", etree.tostring(_rename(tree, names)), names)
