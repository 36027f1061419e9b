"""Robots and workspaces to measure with."""

from __future__ import annotations

import itertools
import math
import re
import struct
from collections.abc import Callable
from pathlib import Path

MASS = '<mass value="'
PLAIN = "[defaults]\ncross_check = false\n"
"""The beginning of a configuration whose robots are read once only."""

_INERTIAL = """\
<inertial><origin xyz="0 0 0.1"/><mass value="{mass}"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
"""
_SHAPE = """\
  <{kind}><origin xyz="0 0 0.1" rpy="0 0 0.1"/><geometry>{geometry}</geometry></{kind}>
"""
_JOINT = """\
<joint name="joint{child}" type="revolute"><origin xyz="0 0 0.2" rpy="0.1 0 0"/>
  <parent link="link{parent}"/><child link="link{child}"/><axis xyz="0 0 1"/>
  <dynamics damping="0.5" friction="0.1"/><limit lower="-1" upper="1" effort="10" velocity="2"/></joint>
"""
_BOX = '<box size="0.1 0.1 0.2"/>'
_TRIANGLES = 1000


def chain(name: str, links: int, geometry: Callable[[int], str] = lambda number: _BOX) -> str:
    """A URDF of so many links in a row, moved by revolute joints.

    Each link has a mass, a visual and a collision, each joint limits and friction. A single chain is what the published
    tool is fastest with: it follows every way from the root to a leaf.
    """
    parts = [f'<robot name="{name}">\n']
    for number in range(links):
        shapes = "".join(_SHAPE.format(kind=kind, geometry=geometry(number)) for kind in ("visual", "collision"))
        parts.append(f'<link name="link{number}">{_INERTIAL.format(mass=1)}{shapes}</link>\n')
    parts += [_JOINT.format(child=number, parent=number - 1) for number in range(1, links)]
    return "".join([*parts, "</robot>\n"])


def mesh(number: int) -> str:
    """The geometry of a link that has a mesh, for `chain`."""
    return f'<mesh filename="link{number}.stl"/>'


def write_meshes(folder: Path, count: int) -> None:
    """The meshes of so many links: STL files of 50 kB each, a band of triangles wound round a sphere, all different."""
    for number in range(count):
        points = [_on_sphere(step, 0.1 + number / 1000) for step in range(_TRIANGLES + 2)]
        corners = ((*points[k], *points[k + 1], *points[k + 2]) for k in range(_TRIANGLES))
        triangles = (struct.pack("<12fH", 0, 0, 0, *corner, 0) for corner in corners)
        content = bytes(80) + _TRIANGLES.to_bytes(4, "little") + b"".join(triangles)
        (folder / f"link{number}.stl").write_bytes(content)


def _on_sphere(step: int, radius: float) -> tuple[float, float, float]:
    height = 1 - 2 * step / (_TRIANGLES + 1)
    around = radius * math.sqrt(1 - height**2)
    return around * math.cos(step), around * math.sin(step), radius * height


def write_workspace(folder: Path, robots: int, links: int, beginning: str = PLAIN) -> Path:
    """A folder with so many robots, `robot0.urdf` and so on, and their configuration; returns it."""
    folder.mkdir(parents=True)
    tables = [beginning]
    for number in range(robots):
        (folder / f"robot{number}.urdf").write_text(chain(f"robot{number}", links), encoding="utf-8")
        tables.append(f'[robots.robot{number}]\nsource = "robot{number}.urdf"\npackage = "Robot{number}"\n')
    (folder / "urdfsync.toml").write_text("".join(tables), encoding="utf-8")
    return folder


class Source:
    """A source whose first mass is another one after each edit."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._masses = (f"{17 + number / 1000:g}" for number in itertools.count(1))

    def edit(self) -> str:
        """Change the mass of the first link that has one; returns the new one, in kg, as it will stand in a record.

        The file is replaced as a whole, by one from outside of its folder.
        """
        mass, text = next(self._masses), self.path.read_text(encoding="utf-8")
        changed, count = re.subn(f'{MASS}[^"]*', f"{MASS}{mass}", text, count=1)
        if not count:
            raise ValueError(f"no link of {self.path} has a mass")
        edited = self.path.parent.with_suffix(".edited")
        edited.write_text(changed, encoding="utf-8")
        edited.replace(self.path)
        return mass
