"""What a check is to do: pure data, from the command to the processes that check."""

from __future__ import annotations

from pathlib import Path
from typing import Literal, TypeAlias

import msgspec

Tool: TypeAlias = Literal["rumoca", "omc"]


class Wishes(msgspec.Struct, frozen=True):
    """How to check."""

    physics: bool = False
    """Whether poses, efforts and masses are compared with the domain's reference."""
    strict: bool = False
    """Whether a difference that comes from an edit counts as one."""
    tool: Tool = "rumoca"
    """The compiler."""
    jobs: int | None = None
    """How many robots may be checked at the same time; None for what cores and memory allow."""
    timeout: float = 600.0
    """Seconds per robot."""
    memory: float | None = None
    """Gigabytes for all processes together; None for what is free."""
    wait: float = 60.0
    """Seconds to wait for a build that is writing."""
    package_paths: tuple[Path, ...] = ()
    """Where to look for packages after the configured folders."""
    workers: int = 1
    """How many compilers may run at the same time for one robot."""
