"""`urdfsync-hook`: `urdfsync hook` for runners of git hooks. Says nothing, and soon, if nothing is to be done."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path

from urdfsync import config
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.planning.situation import Request
from urdfsync.staging.staged import Index
from urdfsync.staging.worktree import Worktree

_MODES = (["build"], ["check"])


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the hook; returns the exit code."""
    given = sys.argv[1:] if arguments is None else list(arguments)
    if given in _MODES and _nothing_to_do():
        return 0
    from urdfsync import cli  # not at the top: this takes as long as all the rest

    return cli.main(["hook", *given])


def _nothing_to_do() -> bool:
    """Whether the working tree has what is staged, and all robots are in step; whatever is wrong is said elsewhere."""
    try:
        index = Index(Path.cwd())
        files = index.named(config.FILE_NAME)
        if index.changed or not files:
            return False
        return all(_is_committed(index, path) for path in files)
    except (UrdfsyncError, OSError):
        return False


def _is_committed(index: Index, path: str) -> bool:
    paths = config.ros_package_path(os.environ)
    tree = Worktree(index, config.load(index.top / path), Request(dry=True, package_paths=paths))
    return all(map(tree.is_committed, tree.config.robots))
