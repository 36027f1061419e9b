"""Decides by saved answers whether a commit passes: if there is no work, `urdfsync hook` imports no other module."""

from __future__ import annotations

import os

from urdfsync import git, noop


def find_configurations(index: git.Index) -> set[str]:
    """Return the tracked configurations, and untracked configurations on disk with tracked state."""
    name, states = noop.CONFIGURATION, ".urdfsync/robots/"
    configurations = {path for path in index.tracked if path.endswith(name) and path.rpartition("/")[2] == name}
    of_states = {path.rpartition(states)[0] + name for path in index.tracked if states in path}
    return configurations | {path for path in of_states if os.path.isfile(f"{index.top}/{path}")}
