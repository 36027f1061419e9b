"""Fixtures: the robot with two joints, built; a compiler that compiles nothing; no Modelica Standard Library."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.checks import Compiling
from support.two_joints import ARM, rebuild

from urdfsync.analysis.checks import libraries


@pytest.fixture
def arm(folder: Path) -> Path:
    """A project with the robot, built; the package's folder."""
    Path("arm.urdf").write_text(ARM)
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    rebuild()
    return folder / "modelica" / "Arm"


@pytest.fixture
def compiler(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Compiling:
    """A stand-in for the compiler, and a cache in which nothing is yet."""
    found = Compiling()
    monkeypatch.setattr("urdfsync.analysis.checks.compilers.run_job", found)
    monkeypatch.setattr(libraries, "copy_named", lambda *_: tmp_path)
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: tmp_path / "cache")
    return found
