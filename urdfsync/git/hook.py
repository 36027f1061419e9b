"""Decides by saved answers whether a commit passes: if there is no work, `urdfsync hook` imports no other module."""

from __future__ import annotations

import os

from urdfsync import git
from urdfsync.answers import uptodate


def is_answered(arguments: list[str]) -> bool:
    """Return whether a command is a hook, and saved answers let the commit pass."""
    if arguments not in (["hook", "build"], ["hook", "check"]):
        return False
    index = git.Index()
    return not index.unmerged and all(passes(index, path) for path in find_configurations(index))


def passes(index: git.Index, configuration: str) -> bool:
    """Return whether, by a saved answer, a configuration (a path from the top) is in step and completely staged.

    A saved answer lists the files that must be staged. The answer holds until a file changes that builds of the robots
    read.
    """
    file, key = answer_place(index, configuration)
    answer = uptodate.find_answer(file, "hook", key)
    return answer is not None and index.has_staged(answer)


def answer_place(index: git.Index, configuration: str) -> tuple[str, str]:
    """Return the file of a configuration, and the key of its answer: a text of all inputs other than files."""
    file = f"{index.top}/{configuration}"
    variables = map(os.environ.get, ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "MODELICAPATH", "PYTHONPATH"))
    return file, repr(("hook", file, os.getcwd(), *variables))


def find_configurations(index: git.Index) -> set[str]:
    """Return the tracked configurations, and untracked configurations on disk with tracked state."""
    name, states = uptodate.CONFIGURATION, ".urdfsync/robots/"
    configurations = {path for path in index.tracked if path.endswith(name) and path.rpartition("/")[2] == name}
    of_states = {path.rpartition(states)[0] + name for path in index.tracked if states in path}
    return configurations | {path for path in of_states if os.path.isfile(f"{index.top}/{path}")}
