"""What names of a package are called now, since this build or an earlier one."""

from __future__ import annotations

from pathlib import Path

import support.urdfs as urdfs
from support.commands import Execute

CELL = "model Cell\n  Arm.Arm robot;\n  Real angle = robot.elbow.phi;\nend Cell;\n"


def write_source(joint: str, other: str = "swing") -> None:
    joints = (urdfs.joint(joint, "continuous", "base", "limb"), urdfs.joint(other, "revolute", "limb", "hand"))
    Path("arm.urdf").write_text(urdfs.robot(*(urdfs.link(name, 1.0) for name in ("base", "limb", "hand")), *joints))


def test_new_names_are_told_in_all_later_builds(folder: Path, execute: Execute) -> None:
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    write_source("elbow")
    execute("build")
    Path("Cell.mo").write_text(CELL)
    write_source("wrist")
    for command in ("status --format=json", "build --format=json", "status --format=json"):
        found = execute(*command.split(), code=None).json["results"][0]["diagnostics"]
        (told,) = [one for one in found if one["code"] == "unresolved"]
        assert (told["file"], told["line"]) == ("Cell.mo", 3)
        assert (told["message"], told["hint"]) == ("Arm has no `elbow`", "use `wrist` instead")
    write_source("wrist", "push")
    execute("build")
    assert "use `wrist`" in execute("status").words


def test_a_package_that_moves_into_another_one_is_told_with_its_whole_name(folder: Path, execute: Execute) -> None:
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    write_source("elbow")
    execute("build")
    Path("Cell.mo").write_text(CELL)
    moved = '[robots.arm]\nsource = "arm.urdf"\npackage = "Plant.Robot"\ncreate_parents = true\n'
    Path("urdfsync.toml").write_text(moved)
    assert "use `Plant.Robot.Robot` instead" in execute("build").words
