"""Runs the command of `--exec` after builds: in the background, one at a time per robot."""

from __future__ import annotations

import os
import subprocess
import threading
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from urdfsync.config import RobotConfig

_LONGEST = 100_000
"""So many bytes of paths are handed over at most: systems limit a variable to 128 KiB."""
_STDERR = 2


class Runner:
    """The command, and where it runs."""

    def __init__(self, command: str, folder: Path, ended: Callable[[str, int], None]) -> None:
        """`ended` is told, from another thread, when the command of a robot has ended, and with which code."""
        self._command, self._folder, self._ended = command, folder, ended
        self._running: set[str] = set()
        self._waiting: dict[str, tuple[RobotConfig, tuple[Path, ...]]] = {}

    def run(self, robot: RobotConfig, files: Sequence[Path]) -> None:
        """Run the command for a robot of which these files changed, after the one that runs for it already.

        What changes meanwhile is one more run. Raises OSError if it can't be started.
        """
        if robot.name in self._running:
            _, before = self._waiting.get(robot.name, (robot, ()))
            self._waiting[robot.name] = robot, tuple(dict.fromkeys((*before, *files)))
            return
        # its output would break the lines of --json, so all of it goes to the error stream
        process = subprocess.Popen(  # noqa: S602 - a shell command is what the user gives
            self._command,
            shell=True,
            cwd=self._folder,
            env={**os.environ, **_variables(robot, files)},
            stdin=subprocess.DEVNULL,
            stdout=_STDERR,
        )
        self._running.add(robot.name)
        threading.Thread(target=lambda: self._ended(robot.name, process.wait()), daemon=True).start()

    def ended(self, robot: str) -> None:
        """Take note of an end that was told of, and run what waits for it. Raises OSError if it can't be started."""
        self._running.discard(robot)
        if waiting := self._waiting.pop(robot, None):
            self.run(*waiting)


def _variables(robot: RobotConfig, files: Sequence[Path]) -> Mapping[str, str]:
    """What the command is told: the folder of the package stands for files that are too many for a variable."""
    text = "\n".join(map(str, files))
    if len(os.fsencode(text)) > _LONGEST:
        text = str(robot.folder)
    return {"URDFSYNC_ROBOT": robot.name, "URDFSYNC_PACKAGE": robot.target.package, "URDFSYNC_FILES": text}
