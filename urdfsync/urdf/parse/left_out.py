"""Warn of elements by which a robot moves otherwise in a simulator than in its model: no gravity, springs, forces."""

from __future__ import annotations

import contextlib
from xml.etree.ElementTree import Element

from urdfsync.urdf.parse.fields import Reader

_FORCES = ("force_element", "cable", "drake:linear_spring_damper", "drake:linear_bushing_rpy")
"""Elements of a robot that act between its links."""


def warn_of_left_out(reader: Reader, root: Element) -> None:
    """Add a warning for each element that changes the motion and is in no model."""
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
            elif part.tag in ("springStiffness", "dampingFactor"):
                with contextlib.suppress(ValueError):  # Gazebo ignores it, too
                    if float(text):
                        what = f"{part.tag} {text} of {name!r} acts in Gazebo, but not in the model"
                        reader.add(part, "force-left-out", what)
    for part in root:
        if part.tag in _FORCES:
            words = f"<{part.tag}> {part.get('name', '')}".rstrip()
            reader.add(part, "force-left-out", f"{words} acts between links, but not in the model")
