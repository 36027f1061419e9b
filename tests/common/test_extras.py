"""Extras: the packages to install exist."""

from __future__ import annotations

import tomllib
from pathlib import Path

from packaging.requirements import Requirement

from urdfsync.common import extras

REPOSITORY = Path(__file__).parents[2]


def test_what_is_to_be_installed_exists() -> None:
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    for name, package in extras.PACKAGES.items():
        needed = map(Requirement, project["optional-dependencies"][name])
        assert [each.name for each in needed if each.marker is None or each.marker.evaluate()] == package.split()


def test_windows_gets_a_reference_without_pinocchio() -> None:
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    names = {}
    for system in ("Windows", "Linux", "Darwin"):
        needed = map(Requirement, project["optional-dependencies"]["physics"])
        names[system] = [
            each.name for each in needed if each.marker and each.marker.evaluate({"platform_system": system})
        ]
    assert names == {"Windows": ["mujoco"], "Linux": ["pin"], "Darwin": ["pin"]}
