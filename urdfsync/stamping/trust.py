"""Which files can be told from changed ones by what the system says of them, without reading them again.

What a file was when it was looked at says something of what it is later only if it was not just being written: a
change within the same tick of the clock gives the same time again. So nothing is believed that changed after, or
shortly before, the looking began, by the clock of the file system itself.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Self

from urdfsync.dependencies import Stat
from urdfsync.files import TEMPORARY

HAS_CHANGE_TIMES = os.name != "nt"
"""Whether files have a time of change that nobody can set: on Windows it is that of their creation."""

_TICK = 50_000_000
"""No clock of a file system with fractions of seconds is coarser (ns)."""
_COARSE_TICK = 2_000_000_000
"""Nor any other; that of FAT is this coarse."""
_SKEW = 60_000_000_000
"""Clocks of different file systems, one perhaps of another machine, are at most so far apart (ns)."""
_SECOND = 1_000_000_000


class Clock:
    """The clock of a file system, read from a file that was made just now: our own may be another one's."""

    def __init__(self, made: os.stat_result, is_sound: bool) -> None:
        """`is_sound` says that nobody can set the time at which a file's status changed."""
        self.made, self._is_sound = made, is_sound

    @classmethod
    def of(cls, descriptor: int) -> Self:
        """The file system's clock, read from an open file that was made just now. Raises OSError.

        Sets the file's times of access and change to 0, to find out whether that of its status can be set as well.
        """
        made = os.fstat(descriptor)
        os.utime(descriptor, ns=(0, 0))
        return cls(made, os.fstat(descriptor).st_ctime_ns >= made.st_ctime_ns)

    def trusts(self, facts: Stat, passed: int) -> bool:
        """Whether a file has been as it was seen since before the looking began, `passed` ns ago, for certain."""
        _, _, device, _, changed, altered = facts
        now = self.made.st_mtime_ns
        coarse = changed % _SECOND == 0 or altered % _SECOND == 0 or now % _SECOND == 0
        margin = _SKEW if device != self.made.st_dev else _COARSE_TICK if coarse else _TICK
        newest = altered if device == self.made.st_dev else max(changed, altered)  # somebody may have set `changed`
        return self._is_sound and altered > 0 and newest < now - passed - margin


def is_young(facts: Stat, now: int) -> bool:
    """Whether a file may change again without a trace, since it changed just before this moment (ns), or after it.

    By our own clock: sources are on whatever file systems, and nobody makes files there to read theirs.
    """
    return max(facts[-2:]) > now - _COARSE_TICK


def clock(folder: Path) -> Clock | None:
    """The clock of the file system that a folder is on, by a file that is made there; None if none can be made."""
    if not HAS_CHANGE_TIMES:
        return None
    temporary = folder / f".clock{TEMPORARY}"
    try:
        temporary.unlink(missing_ok=True)  # of a process that was killed
        with temporary.open("xb") as file:
            found = Clock.of(file.fileno())
        temporary.unlink()
    except OSError:
        return None
    return found
