"""A gripper whose log is simulated once."""

from __future__ import annotations

from pathlib import Path

import pytest
from support import measured

from urdfsync.commands import cli

CONFIG = '[robots.{0}]\nsource = "{0}.urdf"\npackage = "{1}"\nignore = ["not-mirrored"]\n'


@pytest.fixture(scope="session")
def recording() -> measured.Recording:
    """What a gripper with other numbers than `measured.GRIPPER` does."""
    return measured.record(measured.changed(measured.GRIPPER, 1), seconds=8)


@pytest.fixture
def gripper(folder: Path, recording: measured.Recording) -> Path:
    """A built gripper, with its log beside it."""
    Path("gripper.urdf").write_text(measured.GRIPPER)
    Path("urdfsync.toml").write_text(CONFIG.format("gripper", "Gripper"))
    recording.write(Path("log.csv"))
    assert cli.main(["build", "--quiet"]) == 0
    return folder


@pytest.fixture
def leg(folder: Path) -> Path:
    Path("leg.urdf").write_text(measured.LEG)
    Path("urdfsync.toml").write_text('[robots.leg]\nsource = "leg.urdf"\npackage = "Leg"\n')
    assert cli.main(["build", "--quiet"]) == 0
    return folder
