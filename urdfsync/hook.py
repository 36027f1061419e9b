"""`urdfsync-hook`: `urdfsync hook` for runners of git hooks. Says nothing, and soon, if nothing is to be done."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from urdfsync import uptodate
from urdfsync.staging import listing

TYPE_CHECKING = False  # the one of `typing` takes 2 of the 11 ms that a hook without work has
if TYPE_CHECKING:
    from urdfsync.staging.staged import Index

_MODES = (["build"], ["check"])


def main() -> int:
    """Run the hook with the arguments of the program; returns the exit code."""
    try:
        return run(sys.argv[1:])
    except KeyboardInterrupt:
        return 130


def run(arguments: Sequence[str]) -> int:
    """Run the hook; returns the exit code."""
    given = list(arguments)
    try:
        if given in _MODES and (_is_answered() or _nothing_to_do()):
            return 0
    except Exception:  # noqa: BLE001, S110 - whatever it is: the command meets it again, and says it
        pass
    from urdfsync import cli  # not at the top: this takes longer than all the rest

    return cli.main(["hook", *given])


def _is_answered() -> bool:
    """Whether the working tree has what is staged, and saved answers say that this is all that a commit needs."""
    try:
        found = listing.unchanged()
        if found is None:
            return False
        top, files = found
        configurations = [path for path in files if path.rpartition("/")[2] == uptodate.CONFIGURATION]
        return bool(configurations) and all(_is_answered_for(top, path, files) for path in configurations)
    except OSError:
        return False


def _is_answered_for(top: str, path: str, files: set[str]) -> bool:
    file = f"{top}/{path}"
    needed = uptodate.find_answer(file, _answer_key(top, file))
    return needed is not None and files.issuperset(needed)


def _answer_key(top: str, file: str) -> str:
    variables = map(os.environ.get, ("ROS_PACKAGE_PATH", "MODELICAPATH", "PYTHONPATH"))
    return repr(("hook", top, file, os.getcwd(), *variables))  # noqa: PTH109 - no pathlib here


def _nothing_to_do() -> bool:
    """Whether the working tree has what is staged, and all robots are in step; what is wrong is reported later."""
    from pathlib import Path

    from urdfsync.diagnostics import UrdfsyncError
    from urdfsync.staging.staged import Index

    try:
        index = Index(Path.cwd())
        files = index.named(uptodate.CONFIGURATION)
        if index.changed or not files:
            return False
        return all(_is_committed(index, path) for path in files)
    except (UrdfsyncError, OSError):
        return False


def _is_committed(index: Index, path: str) -> bool:
    """Whether that holds for the robots of one configuration; if so, the answer is saved."""
    from urdfsync import config
    from urdfsync.dependencies import record_dependencies
    from urdfsync.engine.options import BuildOptions
    from urdfsync.staging.worktree import Worktree

    started = uptodate.read_clocks()
    with record_dependencies() as dependencies:
        request = BuildOptions(dry=True, package_paths=config.ros_package_path(os.environ))
        tree = Worktree(index, config.load(index.top / path), request)
        found = [tree.committed(robot) for robot in tree.config.robots]
        needed = [paths for paths in found if paths is not None]
    if len(needed) < len(found):
        return False
    file = str(index.top / path)
    answer = sorted(set().union(*needed))
    uptodate.save_answer(file, _answer_key(str(index.top), file), answer, dependencies, started)
    return True
