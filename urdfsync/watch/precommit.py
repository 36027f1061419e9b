"""Whether pre-commit has stashed unstaged changes away: then files are not what their users think they are.

While its hooks run, pre-commit keeps these changes in a file of its store named `patch<time>-<process>`, and leaves the
file there for good; so only a patch of a running process counts.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

_PATCH = re.compile(r"patch(\d+)-(\d+)")
_SLACK = 2.0
"""Seconds by which the system's word for the start of a process and the time in a file name may differ."""


def store_folder(environment: Mapping[str, str], home: Path) -> Path:
    """Return the folder in which pre-commit keeps its files."""
    cache = environment.get("XDG_CACHE_HOME") or home / ".cache"
    return Path(environment.get("PRE_COMMIT_HOME") or Path(cache) / "pre-commit")


class PrecommitStash:
    """The patches in pre-commit's store; the daemon asks before every build, while ever more of them lie there."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._over: set[str] = set()
        """Patches of processes that have ended."""

    def holder(self, root: Path) -> int | None:
        """Return the process that has stashed changes of the repository around `root`; None if there is none.

        A process whose folder the system does not tell counts for every repository.
        """
        place = Path(os.path.realpath(root))
        for pid, folder in self._running():
            if folder is None or place.is_relative_to(folder):  # pre-commit works at the top of the repository
                return pid
        return None

    def _running(self) -> Iterator[tuple[int, str | None]]:
        """Yield the running processes that made patches, and the folders that they work in."""
        try:
            names = {name for name in os.listdir(self._folder) if _PATCH.fullmatch(name)} - self._over  # noqa: PTH208
        except OSError:
            return
        if not names:
            return
        import psutil  # 15 ms, and hardly ever needed: git's hooks ask, too

        for name in names:
            folder: str | None = None
            moment, pid = map(int, name.removeprefix("patch").split("-"))
            try:
                process = psutil.Process(pid)
                is_over = process.create_time() > moment + _SLACK  # another process has got the number since
                folder = process.cwd()
            except psutil.AccessDenied:
                is_over, folder = False, None
            except (psutil.NoSuchProcess, OverflowError):
                is_over = True
            if is_over:
                self._over.add(name)
            else:
                yield pid, folder
