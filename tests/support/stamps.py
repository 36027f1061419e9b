"""Projects in step, and the stamps of commands in them."""

from __future__ import annotations

import shutil
import time
from pathlib import Path

import pytest

from urdfsync import cli, dependencies
from urdfsync.stamping import making, stamp

LIMIT = 60.0
"""Seconds after which a stamp does not come any more."""
TETRAHEDRON = (
    "solid t\n"
    + "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    + ("endloop\nendfacet\nendsolid t\n")
)
_URDF = """\
<robot name="{name}">
  <link name="base"><visual><geometry><mesh filename="package://{name}_meshes/base.stl"/></geometry></visual></link>
  <link name="tip"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="hinge" type="revolute"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
"""
_CONFIG = """\
[defaults]
cross_check = false
create_parents = true

[robots.arm]
source = "robots/arm.urdf"
package = "Lab.Arm"
package_paths = ["ros"]
templates = "own"

[robots.leg]
source = "robots/leg.urdf"
package = "Leg"
"""


def built(folder: Path) -> Path:
    """A folder, in step, with all that a decision may look at: two robots, a parent package, templates, a mesh in a
    package that is searched for, one beside the source, a stray state, an edited file, a class that is a folder."""
    for name in ("arm", "leg"):
        _write(folder / f"robots/{name}.urdf", _URDF.format(name=name))
    _write(folder / "ros/group/arm_meshes/package.xml", "<package><name>arm_meshes</name></package>")
    _write(folder / "ros/group/arm_meshes/base.stl", TETRAHEDRON)
    _write(folder / "robots/leg_meshes/base.stl", TETRAHEDRON)
    _write(folder / "own/notes/readme.txt", "nothing but a text\n")
    _write(folder / "urdfsync.toml", _CONFIG)
    command = ["build", "--quiet", "--config", str(folder / "urdfsync.toml")]
    assert cli.main(command) == 0
    record = folder / "modelica/Leg/Links/TipParameters.mo"
    record.write_text(record.read_text().replace("end ", "  // mine\nend ", 1))
    base = folder / "modelica/Lab/Arm/Links/Base.mo"
    whole = base.with_suffix("") / "package.mo"
    whole.parent.mkdir()
    base.rename(whole)
    for suffix in ("toml", "json"):
        shutil.copy(folder / f".urdfsync/robots/leg.{suffix}", folder / f".urdfsync/robots/gone.{suffix}")
    assert cli.main(command) == 0
    return folder


def stamped(*arguments: str, code: int = 0) -> None:
    """Run a command until it has left a stamp: not as long as what it looks at is as new as the command."""
    end = time.monotonic() + LIMIT
    while repeated(*arguments) is None:
        time.sleep(0.06)
        assert cli.main(arguments) == code
        assert time.monotonic() < end, "no stamp"


def repeated(*arguments: str) -> list[str] | None:
    """What the stamp answers to a command; None if it does not."""
    file = stamp.configuration(list(arguments))
    return stamp.answer(stamp.question(list(arguments), file), stamp.place(file)) if file else None


def program(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Let stamps rest on this file instead of the modules of the program, which somebody may be working on."""
    file = folder / "program.py"
    file.write_text("VERSION = 1\n")
    monkeypatch.setattr(stamp, "since_begin", lambda: 0)
    monkeypatch.setattr(making, "_modules", lambda: iter([(str(file), dependencies.stat_of(file.stat()))]))
    return file


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
