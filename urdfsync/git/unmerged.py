"""Finds the files that git could not merge: the unmerged entries of the index, with two or three versions each."""

from __future__ import annotations

import os
from pathlib import Path

from urdfsync import git
from urdfsync.dependencies import reads
from urdfsync.dependencies.places import is_clone, place


def find_unmerged(folder: Path) -> set[str]:
    """Return the real paths of the unmerged files and submodules of the repository around a folder, if there is one."""
    if (top := git.find_top(os.path.realpath(folder))) is None or is_clone():  # a commit has no unmerged files
        return set()
    paths = reads.find_unmerged(find_git_folder(top) / "index")
    if paths:
        reads.cannot_record()  # their versions are in git's objects
    return {f"{top}/{path}" for path in paths}


def find_git_folder(top: str) -> Path:
    """Return the folder of the index and of references such as HEAD; of a `git worktree`, it is elsewhere."""
    folder = Path(place(f"{top}/.git"))
    if folder.is_file():
        return Path(top, folder.read_text(errors="replace").removeprefix("gitdir: ").strip())
    return folder
