"""`urdfsync-hook`: `urdfsync hook` for runners of git hooks. Says nothing, and soon, if nothing is to be done."""

import os
import sys

from urdfsync import program
from urdfsync.staging import listing
from urdfsync.stamping import stamp

TYPE_CHECKING = False  # that of `typing`, whose import takes longer than all that a hook without work does
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import NoReturn

    from urdfsync.staging.staged import Index

_MODES = (["build"], ["check"])


def start() -> "NoReturn":
    """Run the hook as the only thing in this process: what the console script does."""
    program.end(program.carry_out(lambda: run(sys.argv[1:])))


def run(arguments: "Sequence[str]") -> int:
    """Run the hook; returns the exit code."""
    given = list(arguments)
    try:
        if given in _MODES and (_is_stamped() or _nothing_to_do()):
            return 0
    except Exception:  # noqa: BLE001, S110 - whatever it is: the command meets it again, and says it
        pass
    from urdfsync import cli  # not at the top: this takes longer than all the rest

    return cli.main(["hook", *given])


def _is_stamped() -> bool:
    """Whether the working tree has what is staged, and the stamps say that this is all that a commit needs."""
    try:
        found = listing.unchanged()
        if found is None:
            return False
        top, files = found
        configurations = [path for path in files if path.rpartition("/")[2] == stamp.CONFIGURATION]
        return bool(configurations) and all(_is_stamped_as(top, path, files) for path in configurations)
    except OSError:
        return False


def _is_stamped_as(top: str, path: str, files: set[str]) -> bool:
    file = f"{top}/{path}"
    needed = stamp.answer(_question(top, file), stamp.place(file))
    return needed is not None and files.issuperset(needed)


def _question(top: str, file: str) -> str:
    variables = map(os.environ.get, ("ROS_PACKAGE_PATH", "MODELICAPATH", "PYTHONPATH"))
    return repr(("hook", top, file, os.getcwd(), *variables))  # noqa: PTH109 - no pathlib here


def _nothing_to_do() -> bool:
    """Whether the working tree has what is staged, and all robots are in step; whatever is wrong is said elsewhere."""
    from pathlib import Path

    from urdfsync.diagnostics import UrdfsyncError
    from urdfsync.staging.staged import Index

    try:
        index = Index(Path.cwd())
        files = index.named(stamp.CONFIGURATION)
        if index.changed or not files:
            return False
        return all(_is_committed(index, path) for path in files)
    except (UrdfsyncError, OSError):
        return False


def _is_committed(index: "Index", path: str) -> bool:
    """Whether that holds for the robots of one configuration; if so it is stamped."""
    from urdfsync import config, dependencies
    from urdfsync.engine.options import BuildOptions
    from urdfsync.staging.worktree import Worktree
    from urdfsync.stamping import making

    begin = stamp.now()
    with dependencies.record_dependencies() as looks:
        request = BuildOptions(dry=True, package_paths=config.ros_package_path(os.environ))
        tree = Worktree(index, config.load(index.top / path), request)
        found = [tree.committed(robot) for robot in tree.config.robots]
        needed = [paths for paths in found if paths is not None]
    if len(needed) < len(found):
        return False
    file = str(index.top / path)
    making.keep(file, {_question(str(index.top), file): sorted(set().union(*needed))}, looks, begin)
    return True
