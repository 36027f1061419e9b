"""Projects in step, and what is remembered of them."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable
from pathlib import Path
from unittest import mock

from support.meshes import stl
from urdfsync.commands import cli
from urdfsync.common import noop
from urdfsync.common.dependencies import facts

LIMIT = 60.0
"""Seconds after which a test fails because nothing was remembered."""
SHORT = 100_000_000
"""Nanoseconds in which a file counts as young; the file systems of tests have finer time stamps."""
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
    """Make a folder in step with all inputs of a decision, from two robots and templates to a stray state."""
    for name in ("arm", "leg"):
        _write(folder / f"robots/{name}.urdf", _URDF.format(name=name))
    _write(folder / "ros/group/arm_meshes/package.xml", "<package><name>arm_meshes</name></package>")
    _write(folder / "ros/group/arm_meshes/base.stl", stl())
    _write(folder / "robots/leg_meshes/base.stl", stl())
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
    shutil.copy(folder / ".urdfsync/robots/leg.state", folder / ".urdfsync/robots/gone.state")
    assert cli.main(command) == 0
    return folder


def until(is_done: Callable[[], bool], step: Callable[[], object]) -> None:
    """Repeat a step until its result is remembered: some results are not while their dependencies are young."""
    end = time.monotonic() + LIMIT
    with mock.patch.object(facts, "YOUNG", SHORT):
        while not is_done():
            step()
            assert time.monotonic() < end, "nothing was remembered"
            time.sleep(0.06)


def save(*arguments: str) -> None:
    """Run a command until nothing of it has to be done again."""
    until(lambda: saved(*arguments) is not None, lambda: cli.main(arguments))


def saved(*arguments: str) -> list[tuple[str, str, str, int]] | None:
    """What a command would write without being run; None if it has to run."""
    return noop.find_lines(arguments)


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
