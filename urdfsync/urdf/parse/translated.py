"""Reads the elements that a translator of another format adds to its URDF.

`<left_out what="spring" name="knee"/>` is a part that acts on the robot, and that no model has. `<free_root
link="trunk"/>` is the root link of a robot that moves freely.
"""

from __future__ import annotations

from xml.etree.ElementTree import Element

from urdfsync.urdf.options import Options
from urdfsync.urdf.parse.fields import Reader

TRANSLATED = ("left_out", "free_root")


def read_translated(reader: Reader, root: Element, options: Options) -> None:
    """Add a finding for each part that is left out, and one if the configuration bolts a free robot down."""
    for part in root.iterfind("left_out"):
        words = f"{part.get('what', '')} {part.get('name', '')}".rstrip()
        reader.add(part, "part-left-out", f"{words}: this acts on the robot, but no model has it")
    for element in root.iterfind("free_root"):
        if options.base == "fixed":
            message = f"link {element.get('link', '')!r} moves freely in the source, but is bolted down"
            reader.add(element, "free-root", message)
