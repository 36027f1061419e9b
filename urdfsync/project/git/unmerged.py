"""Finds the files that git could not merge: the unmerged entries of the index, with two or three versions each."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from urdfsync.common.dependencies import reads
from urdfsync.common.dependencies.places import is_clone, place
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.files import placed
from urdfsync.project import git

NO_DRIVER = Diagnostic(
    Severity.NOTE,
    "no-merge-driver",
    "git merges models line by line in this clone",
    hint="for elements, `urdfsync merge-driver --install`",
)


def find_unmerged(folders: Iterable[Path]) -> set[str]:
    """Return the real paths of the unmerged files and submodules in the repositories around these folders."""
    if is_clone():  # a commit has no unmerged files
        return set()
    tops = {top for folder in folders if (top := git.find_top(os.path.realpath(folder)))}
    found = {
        placed(os.path.join(top, ""), path)  # noqa: PTH118 - a text
        for top in tops
        for path in reads.find_unmerged(find_git_folder(top) / "index")
    }
    if found:
        reads.cannot_record()  # their versions are in git's objects
    return found


def has_driver(folder: Path) -> bool:
    """Return whether git's settings of the clone around a folder name urdfsync's merge driver."""
    try:
        return bool(git.run("-C", str(folder), "config", "--get", "merge.urdfsync.driver"))
    except git.GitError:  # git has no such setting
        return False


def find_git_folder(top: str) -> Path:
    """Return the folder of the index and of references such as HEAD; of a `git worktree`, it is elsewhere."""
    folder = Path(place(f"{top}/.git"))
    if folder.is_file():
        return Path(top, folder.read_text(errors="replace").removeprefix("gitdir: ").strip())
    return folder
