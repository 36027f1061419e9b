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


class Stash:
    """What pre-commit has stashed away, by its store; asked again and again, while ever more patches lie there."""

    def __init__(self, folder: Path, processes: Path = Path("/proc")) -> None:
        self._folder, self._processes = folder, processes
        self._over: set[str] = set()
        """Patches of processes that have ended."""

    def holder(self, root: Path) -> int | None:
        """The process that has stashed changes of the repository around `root` away; None if there is none.

        Where the system does not say what a process works on, any living one counts.
        """
        return next((pid for pid, place in self._living() if place is None or _is_in(root, place)), None)

    def _living(self) -> Iterator[tuple[int, str | None]]:
        """The living processes that made patches, and the folders that they work in; None for what nobody says."""
        try:
            names = os.listdir(self._folder)  # noqa: PTH208 - before every build
        except OSError:
            return
        for name in names:
            if name not in self._over and (match := _PATCH.fullmatch(name)):
                pid, age = int(match[2]), time.time() - int(match[1])
                try:
                    yield pid, self._place(pid, age)
                except ProcessLookupError:
                    self._over.add(name)

    def _place(self, pid: int, age: float) -> str | None:
        """Where the process works that made a patch of this age (s). Raises ProcessLookupError if it has ended."""
        if os.path.isdir(self._processes):  # noqa: PTH112 - patches become more and more
            try:
                place, started = os.readlink(f"{self._processes}/{pid}/cwd"), _age(pid, self._processes)  # noqa: PTH115
            except PermissionError:
                pass
            except (OSError, ValueError, IndexError):
                raise ProcessLookupError(pid) from None
            else:
                if started + _SLACK < age:
                    raise ProcessLookupError(pid)  # another process has got the number since
                return place
        if not _lives(pid):
            raise ProcessLookupError(pid)
        return None


def _is_in(root: Path, place: str) -> bool:
    """Whether a folder is in that of a process: pre-commit works at the top of the repository."""
    return Path(os.path.realpath(root)).is_relative_to(place)


def _age(pid: int, processes: Path) -> float:
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
