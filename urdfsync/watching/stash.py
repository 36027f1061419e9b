"""Whether pre-commit has stashed changes away: then files are not what their users think they are.

While its hooks run, pre-commit takes unstaged changes out of the working tree. It writes them to a file of its store
first, named `patch<time>-<process>`, and leaves it there for good; so only one of a living process counts.
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Iterator, Mapping
from pathlib import Path

_PATCH = re.compile(r"patch(\d+)-(\d+)")
_SLACK = 2.0
"""Seconds by which the two ways of telling a process's age from a file's may differ."""


def store(environment: Mapping[str, str], home: Path) -> Path:
    """The folder in which pre-commit keeps its files."""
    cache = environment.get("XDG_CACHE_HOME") or home / ".cache"
    return Path(environment.get("PRE_COMMIT_HOME") or Path(cache) / "pre-commit")


def holder(folder: Path, root: Path, processes: Path = Path("/proc")) -> int | None:
    """The process that has stashed changes of the repository around `root` away; None if there is none.

    `folder` is pre-commit's store. Where the system does not say what a process works on, any living one counts.
    """
    return next((pid for pid, age in _patches(folder) if _holds(pid, age, root, processes)), None)


def _patches(folder: Path) -> Iterator[tuple[int, float]]:
    """The process of each patch, and the patch's age in seconds."""
    try:
        names = os.listdir(folder)  # noqa: PTH208 - before every build
    except OSError:
        return
    for name in names:
        if match := _PATCH.fullmatch(name):
            yield int(match[2]), time.time() - int(match[1])


def _holds(pid: int, age: float, root: Path, processes: Path) -> bool:
    if not os.path.isdir(processes):  # noqa: PTH112 - patches become more and more
        return _lives(pid)
    try:
        place = os.readlink(f"{processes}/{pid}/cwd")  # noqa: PTH115 - pre-commit works at the top of the repository
        started = _age(pid, processes)
    except PermissionError:
        return _lives(pid)
    except (OSError, ValueError, IndexError):
        return False
    younger = started is not None and started + _SLACK < age  # another process has got the number since
    return not younger and Path(os.path.realpath(root)).is_relative_to(place)


def _age(pid: int, processes: Path) -> float | None:
    """Seconds since a process has started."""
    fields = (processes / str(pid) / "stat").read_text().rpartition(")")[2].split()
    uptime = float((processes / "uptime").read_text().split()[0])
    return uptime - int(fields[19]) / os.sysconf("SC_CLK_TCK")


def _lives(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except PermissionError:
        return True
    except (OSError, OverflowError):
        return False
    return True
