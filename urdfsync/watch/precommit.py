"""Finds out whether pre-commit has stashed unstaged changes: then the files on disk lack these changes.

While its hooks run, pre-commit keeps these changes in a file of its store named `patch<time>-<process>`. pre-commit
never deletes the file, so only a patch of a running process counts.
"""

from __future__ import annotations

import os
import re
from pathlib import Path

_PATCH = re.compile(r"patch(\d+)-(\d+)")
_SLACK = 2.0
"""Seconds by which the system's start time of a process may differ from the time in a file name."""


def find_stash(root: Path) -> tuple[Path, int] | None:
    """Return the patch with the stashed changes of the repository around `root`, and the process that wrote it.

    None if nothing is stashed. A process with an unknown folder counts for every repository.
    """
    home = Path(os.path.expanduser("~"))  # noqa: PTH111 - Path.home() raises without a home
    cache = Path(os.environ.get("XDG_CACHE_HOME") or home / ".cache")
    store = Path(os.environ.get("PRE_COMMIT_HOME") or cache / "pre-commit")
    patches = [path for path in store.glob("patch*") if _PATCH.fullmatch(path.name)]
    if not patches:
        return None
    import psutil  # takes 15 ms; git's hooks come here, too, and rarely need it

    place = Path(os.path.realpath(root))
    for path in sorted(patches, reverse=True):
        moment, pid = map(int, path.name.removeprefix("patch").split("-"))
        try:
            process = psutil.Process(pid)
            if process.create_time() > moment + _SLACK:
                continue  # the number now belongs to another process
            folder = process.cwd()
        except psutil.AccessDenied:
            return path, pid
        except (psutil.NoSuchProcess, OverflowError):
            continue
        if place.is_relative_to(folder):  # pre-commit works at the top of the repository
            return path, pid
    return None
