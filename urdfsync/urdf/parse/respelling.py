"""Writes SDFormat's spelling in a URDF as attributes, for the programs that check our reading.

It shares no code with `fields`, so that one fault can't be in both.
"""

from __future__ import annotations

from xml.etree.ElementTree import tostring

from urdfsync.urdf.parse import xml

_ALONE = {"parent": "link", "child": "link", "mass": "value", "axis": "xyz"}
"""Attributes that SDFormat writes as text of an element."""
_NAMES = "xyz lower upper effort velocity damping friction multiplier offset ixx ixy ixz iyy iyz izz".split()


def with_attributes(content: bytes) -> bytes:
    """Return a URDF with the texts of its links and joints as attributes; the same bytes if there are none."""
    root, changed = xml.parse(content).root, False
    for element in (part for tag in ("link", "joint") for top in root.findall(tag) for part in list(top.iter())):
        for axis in element.findall("axis"):
            for part in [part for part in axis if part.tag in ("limit", "dynamics") and element.find(part.tag) is None]:
                axis.remove(part)
                element.append(part)
                changed = True
        pose = element.find("pose") if element.find("origin") is None else element.find("origin")
        if pose is not None and not pose.attrib and len(numbers := (pose.text or "").split()) == 6:
            pose.tag, changed = "origin", True
            pose.attrib.update(xyz=" ".join(numbers[:3]), rpy=" ".join(numbers[3:]))
        texts = {part.tag: part.text for part in element if part.tag in _NAMES}
        texts |= {_ALONE[element.tag]: element.text} if element.tag in _ALONE and not texts else {}
        for name, text in texts.items():
            if name not in element.attrib and (text or "").strip():
                element.set(name, (text or "").strip())
                changed = True
    return tostring(root) if changed else content
