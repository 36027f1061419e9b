"""How to watch: what the command line asks for."""

from __future__ import annotations

from pathlib import Path

import msgspec

from urdfsync.check import afterbuild, run
from urdfsync.engine.options import BuildOptions
from urdfsync.watching.settling import Times


class Options(msgspec.Struct, frozen=True):
    """All that there is to choose; times in seconds."""

    file: Path
    """The configuration."""
    robots: tuple[str, ...] = ()
    """Names of the robots; empty for all."""
    times: Times = msgspec.field(default_factory=Times)
    rescan: float = 30.0
    """Between two looks at everything."""
    poll: bool = False
    """Do without events."""
    command: str = ""
    """What to run after a build that changed something; empty for nothing."""
    request: BuildOptions = msgspec.field(default_factory=BuildOptions)
    """How to build; the daemon adds how progress is told."""
    examine: afterbuild.CheckRobots = run.check_robots
    """How to check packages."""
