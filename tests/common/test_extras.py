"""Extras: the packages to install exist."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from urdfsync.common import extras

REPOSITORY = Path(__file__).parents[2]


def test_what_is_to_be_installed_exists() -> None:
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    for name, package in extras.PACKAGES.items():
        assert [re.split(r"[<>=; ]", needed)[0] for needed in project["optional-dependencies"][name]] == package.split()
