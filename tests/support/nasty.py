"""A robot whose names would break a careless generator: out of folders, out of strings, out of scopes."""

from __future__ import annotations

from pathlib import Path
from xml.sax.saxutils import quoteattr

from urdfsync.domain import Target

TARGET = Target("Plant.Nasty", "Nasty")

NAMES = (
    *("world", "../../evil", 'a"b', "end", "Links", "frame_a", "base link", "Gelenk_ä", "L_arm", "l_arm", "both"),
    *("_", "-", "7", "time", "parameters", "Nasty", "nastyRun", "x\\", "a</code></html>", "*/ //", "'q'", "phi_start"),
    *("modelica", "${prefix}link", "rotationalAxis[1]", "m", "con", "a" * 120),
)
"""Links in a chain; each joint has the name of its child link."""

MESH = 'it\'s "the" mesh.stl'

_FACET = "facet normal 0 0 1\nouter loop\nvertex 0 0 {z}\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"


def write(folder: Path) -> Path:
    """The URDF and its mesh in `folder`; gives the path of the URDF."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / MESH).write_text(f"solid s\n{_FACET.format(z=0)}{_FACET.format(z=1)}endsolid s\n")
    (folder / "nasty.urdf").write_text(urdf(), "utf-8")
    return folder / "nasty.urdf"


def urdf() -> str:
    """The robot: joints of four types, some with losses, one that mimics."""
    elements = [_link(name) for name in NAMES]
    elements += [_joint(number, name) for number, name in enumerate(NAMES) if number]
    return "\n".join([f"<robot name={quoteattr(NAMES[2])}>", *elements, "</robot>", ""])


def _link(name: str) -> str:
    shape = f"<geometry><mesh filename={quoteattr(MESH)}/></geometry>"
    box = '<geometry><box size="0.1 0.2 0.3"/></geometry>'
    material = f'<material name={quoteattr(name)}><color rgba="1 0.5 0 1"/></material>'
    visuals = f"<visual name={quoteattr(name)}>{shape}{material}</visual><visual>{box}</visual>"
    collision = f"<collision name={quoteattr(name)}>{box}</collision>"
    inertial = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    return f"<link name={quoteattr(name)}>{inertial}{visuals}{collision}</link>"


def _joint(number: int, name: str) -> str:
    kind = {1: "revolute", 2: "continuous", 3: "prismatic"}.get(number % 10, "fixed")
    ends = f"<parent link={quoteattr(NAMES[number - 1])}/><child link={quoteattr(name)}/>"
    limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>' if kind in ("revolute", "prismatic") else ""
    losses = '<dynamics damping="0.1" friction="0.2"/>' if number in (3, 12) else ""
    mimic = f"<mimic joint={quoteattr(NAMES[1])}/>" if number == 11 else ""
    return f'<joint name={quoteattr(name)} type="{kind}">{ends}{limit}{losses}{mimic}</joint>'
