"""What the answers of the hook depend on beside files; imported by each commit, so it needs next to nothing itself."""

from __future__ import annotations

import os
from collections.abc import Iterable

from urdfsync import uptodate

STATES = ".urdfsync/robots/"
"""Where a configuration has the recorded states of its robots."""


def find_configurations(files: Iterable[str]) -> tuple[list[str], list[str]]:
    """Return the configurations among tracked files, and the recorded states that belong to none of them."""
    found, states = [], []
    for path in files:
        if path.rpartition("/")[2] == uptodate.CONFIGURATION:
            found.append(path)
        elif path.endswith(".toml") and f"/{path}".count(f"/{STATES}") == 1:
            states.append(path)
    folders = {path.removesuffix(uptodate.CONFIGURATION) for path in found}
    return sorted(found), sorted(path for path in states if path.rpartition(STATES)[0] not in folders)


def answer_key(top: str, file: str) -> str:
    """Return the key of the answer for a configuration: all that it depends on beside files."""
    variables = map(os.environ.get, ("ROS_PACKAGE_PATH", "MODELICAPATH", "PYTHONPATH"))
    return repr(("hook", top, file, os.getcwd(), *variables))  # noqa: PTH109 - no pathlib here
