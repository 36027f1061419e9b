"""Fixtures: a small arm that is built, also with a compiler that compiles nothing."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from support.modelica import CACHE
from support.simulation import ARM, Compiler

from urdfsync import cli
from urdfsync.checks.cache import UserCache


@pytest.fixture(scope="session")
def built_arm(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project with the package `Arm`; tests work on copies of it."""
    folder = tmp_path_factory.mktemp("arm") / "project"
    folder.mkdir()
    (folder / "arm.urdf").write_text(ARM)
    (folder / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    assert cli.main(["build", "-q", "--config", str(folder / "urdfsync.toml")]) == 0
    return folder


@pytest.fixture
def arm(built_arm: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the project, also the working folder; the compiler keeps what it remembers, and results are new."""
    folder = tmp_path / "project"
    shutil.copytree(built_arm, folder)
    monkeypatch.chdir(folder)
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: CACHE.folder)
    monkeypatch.setattr(UserCache, "load", lambda *_: None)
    monkeypatch.setattr(UserCache, "trim", lambda *_: 0)  # of its 10,000 files, a second each time
    return folder


@pytest.fixture
def compiler(arm: Path, modelica_library: Path, monkeypatch: pytest.MonkeyPatch) -> Compiler:
    """A compiler that compiles nothing, for the arm."""
    found = Compiler()
    monkeypatch.setattr("urdfsync.checks.compilers.run_job", found)
    return found
