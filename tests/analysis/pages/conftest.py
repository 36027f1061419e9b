"""Projects with a robot to look at, and a browser to look with."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from support.browser import Page, browser
from support.corpus import REPOSITORY

from urdfsync.commands import cli

ARM = REPOSITORY / "modelica/UrdfSync/Resources/robots/six_axis_arm"
Report = Callable[..., Path]


@pytest.fixture
def arm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder, also the working one, with the six-axis arm, its meshes and a configuration; returns the source."""
    shutil.copytree(ARM, tmp_path, dirs_exist_ok=True)
    (tmp_path / "urdfsync.toml").write_text('[robots.arm]\nsource = "six_axis_arm.urdf"\npackage = "Arm"\n')
    monkeypatch.chdir(tmp_path)
    return tmp_path / "six_axis_arm.urdf"


@pytest.fixture
def report(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Report:
    """Writes the page of a URDF, which is given as text; without one that of the configuration."""

    def write(urdf: str = "", *arguments: str) -> Path:
        if urdf:
            monkeypatch.chdir(tmp_path)
            Path("robot.urdf").write_text(urdf, "utf-8")
            Path("urdfsync.toml").write_text('[robots.bot]\nsource = "robot.urdf"\npackage = "Bot"\n')
        file = tmp_path / "page.html"
        assert cli.main(["report", "--output", str(file), "--quiet", *arguments]) == 0
        return file

    return write


@pytest.fixture(scope="module")
def chromium() -> Iterator[Page]:
    """One page of a browser for all tests of a module."""
    with browser() as page:
        yield page
