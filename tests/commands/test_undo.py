"""`urdfsync resolve --undo` in a clone: the texts that its build replaced came from another machine."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.urdfs import robot_of

RECORD = Path("modelica/Arm/Links/Link_2Parameters.mo")


@NEEDS_GIT
def test_a_text_that_comes_back_has_one_verdict(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute
) -> None:
    repository = Repository(tmp_path / "project", monkeypatch)
    monkeypatch.chdir(repository.folder)
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    Path("arm.urdf").write_text(robot_of("1 1.1, 2 2.2, 3 3.3"))
    execute("build")
    repository.commit()
    repository.git("clone", "-q", ".", "../clone")
    monkeypatch.chdir(tmp_path / "clone")
    Path("arm.urdf").write_text(robot_of("1 1.1, 3 2.2, 2 3.3"))
    execute("build")
    assert "mass = 3.3" in RECORD.read_text()
    execute("resolve", RECORD, "--undo")
    assert "mass = 2.2" in RECORD.read_text()
    for command in ("status", "build"):
        assert "1 kept because you edited it" in execute(command).out
