"""Robots and workspaces to measure with."""

from __future__ import annotations

import itertools
import math
import re
import struct
from collections.abc import Callable
from pathlib import Path

_MASS = re.compile(r'(<mass value="|<mass>|<inertial mass=")[^"<]*')
_INERTIAL = """\
<inertial><origin xyz="0 0 0.1"/><mass value="1"/>
    <inertia ixx="0.0042" ixy="0" ixz="0" iyy="0.0042" iyz="0" izz="0.0017"/></inertial>
"""
_SHAPE = """\
  <{kind}><origin xyz="0 0 0.1" rpy="0 0 0.1"/><geometry>{geometry}</geometry></{kind}>
"""
_JOINT = """\
<joint name="joint{child}" type="revolute"><origin xyz="0 0 0.2" rpy="0.1 0 0"/>
  <parent link="link{parent}"/><child link="link{child}"/><axis xyz="0 0 1"/>
  <dynamics damping="0.5" friction="0.1"/><limit lower="-1" upper="1" effort="10" velocity="2"/></joint>
"""
_BODY = """\
<body name="link{number}" pos="0 0 0.2" euler="0.1 0 0">
<inertial mass="1" pos="0 0 0.1" diaginertia="0.0042 0.0042 0.0017"/>
<joint name="joint{number}" axis="0 0 1" range="-1 1" actuatorfrcrange="-10 10" damping="0.5" frictionloss="0.1"/>
<geom type="box" size="0.05 0.05 0.1" pos="0 0 0.1" euler="0 0 0.1"/>
"""
_SDF_LINK = """\
<link name="link{number}">{pose}<inertial><pose>0 0 0.1 0 0 0</pose><mass>1</mass><inertia>
  <ixx>0.0042</ixx><iyy>0.0042</iyy><izz>0.0017</izz></inertia></inertial>{shapes}</link>
"""
_SDF_SHAPE = """\
<{kind} name="{kind}"><pose>0 0 0.1 0 0 0.1</pose><geometry><box><size>0.1 0.1 0.2</size></box></geometry></{kind}>
"""
_SDF_JOINT = """\
<joint name="joint{child}" type="revolute"><parent>link{parent}</parent><child>link{child}</child><axis><xyz>0 0 1</xyz>
  <dynamics><damping>0.5</damping><friction>0.1</friction></dynamics>
  <limit><lower>-1</lower><upper>1</upper><effort>10</effort><velocity>2</velocity></limit></axis></joint>
"""
_TRIANGLES = 1000


def box(_: int) -> str:
    """The geometry of a link that is a box."""
    return '<box size="0.1 0.1 0.2"/>'


def mesh(number: int) -> str:
    """The geometry of a link that has a mesh: STL for even numbers, OBJ for odd ones."""
    return f'<mesh filename="link{number}.{"obj" if number % 2 else "stl"}"/>'


def chain(name: str, links: int, geometry: Callable[[int], str] = box) -> str:
    """Return a URDF of links in a row, moved by revolute joints.

    Each link has a mass, a visual and a collision, each joint limits and friction. The published tool is fastest with a
    single chain, since it follows every way from the root to a leaf.
    """
    parts = [f'<robot name="{name}">\n']
    for number in range(links):
        shapes = "".join(_SHAPE.format(kind=kind, geometry=geometry(number)) for kind in ("visual", "collision"))
        parts.append(f'<link name="link{number}">{_INERTIAL}{shapes}</link>\n')
    parts += [_JOINT.format(child=number, parent=number - 1) for number in range(1, links)]
    return "".join([*parts, "</robot>\n"])


def write_workspace(folder: Path, robots: int, links: int, geometry: Callable[[int], str] = box) -> Path:
    """Write `robot0.urdf` and so on with their configuration, and return the folder."""
    folder.mkdir(parents=True)
    tables = []
    for number in range(robots):
        (folder / f"robot{number}.urdf").write_text(chain(f"robot{number}", links, geometry), encoding="utf-8")
        tables.append(f'[robots.robot{number}]\nsource = "robot{number}.urdf"\npackage = "Robot{number}"\n')
    (folder / "urdfsync.toml").write_text("".join(tables), encoding="utf-8")
    return folder


def mjcf_chain(name: str, links: int) -> str:
    """Return the robot of `chain` as MJCF."""
    bodies = "".join(_BODY.format(number=number) for number in range(1, links))
    first = _BODY.format(number=0).replace(' pos="0 0 0.2" euler="0.1 0 0"', "", 1)
    base = "".join(line for line in first.splitlines(keepends=True) if "<joint" not in line)
    settings = '<compiler angle="radian" eulerseq="xyz"/>'
    return f'<mujoco model="{name}">{settings}<worldbody>\n{base}{bodies}{"</body>" * links}</worldbody></mujoco>\n'


def sdf_chain(name: str, links: int) -> str:
    """Return the robot of `chain` as SDF."""
    shapes = "".join(_SDF_SHAPE.format(kind=kind) for kind in ("visual", "collision"))
    parts = [_SDF_LINK.format(number=0, pose="", shapes=shapes)]
    for number in range(1, links):
        pose = f'<pose relative_to="link{number - 1}">0 0 0.2 0.1 0 0</pose>'
        parts.append(_SDF_LINK.format(number=number, pose=pose, shapes=shapes))
        parts.append(_SDF_JOINT.format(child=number, parent=number - 1))
    return f'<sdf version="1.9"><model name="{name}">\n{"".join(parts)}</model></sdf>\n'


def write_format_workspace(folder: Path, suffix: str, text: str) -> Path:
    """Write `robot0` in a format, with a configuration, and return the folder."""
    folder.mkdir(parents=True)
    (folder / f"robot0.{suffix}").write_text(text, encoding="utf-8")
    table = f'[robots.robot0]\nsource = "robot0.{suffix}"\npackage = "Robot0"\n'
    (folder / "urdfsync.toml").write_text(table, encoding="utf-8")
    return folder


def write_xacro_workspace(folder: Path, files: int) -> Path:
    """Write a robot of xacro that includes so many files, with one link each, and return the folder."""
    write_workspace(folder, 1, files)
    urdf = folder / "robot0.urdf"
    text, opening = (
        urdf.read_text(encoding="utf-8"),
        '<robot name="robot0" xmlns:xacro="http://www.ros.org/wiki/xacro">\n',
    )
    links = re.findall(r"<link.*?</link>\n", text, re.DOTALL)
    for number, link in enumerate(links):
        (folder / f"link{number}.xacro").write_text(f"{opening}{link}</robot>\n", encoding="utf-8")
        text = text.replace(link, f'<xacro:include filename="link{number}.xacro"/>\n')
    text = text.replace('<robot name="robot0">\n', opening)
    urdf.rename(folder / "robot0.urdf.xacro").write_text(text, encoding="utf-8")
    configuration = folder / "urdfsync.toml"
    configuration.write_text(
        configuration.read_text(encoding="utf-8").replace(".urdf", ".urdf.xacro"), encoding="utf-8"
    )
    return folder


def write_meshes(folder: Path, count: int) -> None:
    """Write the files that `mesh` names for so many links: triangles wound round spheres of different sizes."""
    for number in range(count):
        points = [_on_sphere(step, 0.1 + number / 1000) for step in range(_TRIANGLES + 2)]
        if number % 2:
            lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in points]
            lines += [f"f {k} {k + 1} {k + 2}" for k in range(1, _TRIANGLES + 1)]
            (folder / f"link{number}.obj").write_text("\n".join(lines) + "\n", encoding="utf-8")
        else:
            corners = [(*points[k], *points[k + 1], *points[k + 2]) for k in range(_TRIANGLES)]
            triangles = b"".join(struct.pack("<12fH", 0, 0, 0, *corner, 0) for corner in corners)
            (folder / f"link{number}.stl").write_bytes(bytes(80) + struct.pack("<I", _TRIANGLES) + triangles)


def _on_sphere(step: int, radius: float) -> tuple[float, float, float]:
    height = 1 - 2 * step / (_TRIANGLES + 1)
    around = radius * math.sqrt(1 - height**2)
    return around * math.cos(step), around * math.sin(step), radius * height


class Source:
    """A source whose first mass is another one after each edit."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._masses = (f"{17 + number / 1000:g}" for number in itertools.count(1))

    def edit(self) -> str:
        """Change the mass of the first link; returns the new one in kg, as it will stand in a record.

        The file is replaced as a whole, by one that was written outside of its folder.
        """
        mass, text = next(self._masses), self.path.read_text(encoding="utf-8")
        changed, count = _MASS.subn(rf"\g<1>{mass}", text, count=1)
        if not count:
            raise ValueError(f"no link of {self.path} has a mass")
        edited = self.path.parent.with_suffix(".edited")
        edited.write_text(changed, encoding="utf-8")
        edited.replace(self.path)
        return mass
