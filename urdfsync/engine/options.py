"""How to build."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.engine.actions import UsersChoice
from urdfsync.project.config import ros_package_path

Progress: TypeAlias = Callable[[str, int, int], None]
"""Shows progress; called with a step of the work, the finished amount, and the total."""


def no_progress(what: str, done: int, total: int) -> None:
    """Report nothing."""


class BuildOptions(msgspec.Struct, frozen=True):
    """How to build."""

    full: bool = False
    """Render and compare everything, even if nothing changed."""
    dry: bool = False
    """Write nothing."""
    trusted: bool = False
    """Also write to outputs outside of the configuration's folder."""
    renews: bool = True
    """Renew the recorded state even if the package is in step; otherwise only builds that write a file renew it."""
    adopts: bool = False
    """Treat files that exist before the first build as edited generated files."""
    merges: bool = False
    """Merge changes into edited files, as with `on_conflict = "merge"`."""
    removes: bool = False
    """Remove the robots' packages and records, as if their sources were empty."""
    draw: bool = False
    """Also draw the main model's diagram into the state folder."""
    package_paths: tuple[Path, ...] = msgspec.field(default_factory=ros_package_path)
    """The folders where ROS looks for packages; the configured folders come first."""
    wait: float = 60.0
    """Seconds to wait for another build to finish."""
    choices: Mapping[str, UsersChoice] = msgspec.field(default_factory=dict)
    """The user's decisions about files, by their keys."""
    jobs: int | None = None
    """Processes that may work at once; None for one process per core."""
    progress: Progress = no_progress
