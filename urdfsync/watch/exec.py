"""Runs the command of `--exec` after builds: in the background, one at a time per robot."""

from __future__ import annotations

import os
import subprocess
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path
from queue import SimpleQueue

import msgspec

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.project.config import RobotConfig
from urdfsync.watch import events

_MAX_VARIABLE = 100_000
"""Bytes of an environment variable: systems limit a variable to 128 KiB."""
_STDERR = 2
_NOT_FOUND = 127
"""Exit code of a shell for a command that can't be started."""


class CommandEnded(msgspec.Struct, frozen=True):
    """A command of `--exec` has ended with this exit code, or with minus the number of a signal."""

    robot: str
    code: int
    problem: str
    """The failure, in words that follow `the command`; empty after a success."""


class CommandRunner:
    """The command, and the robots for which it runs or has to run again. Both methods yield events for display."""

    def __init__(self, queue: SimpleQueue[object], command: str, folder: Path) -> None:
        self._queue, self._command, self._folder = queue, command, folder
        self._running: set[str] = set()
        self._waiting: dict[str, tuple[RobotConfig, tuple[Path, ...]]] = {}

    def run(self, robot: RobotConfig, files: Sequence[Path]) -> Iterator[events.Event]:
        """Run the command for a robot with these changed files, after a running one has ended.

        Several changes in the meantime cause only one more run. `CommandEnded` is put into the queue at the end.
        """
        if not self._command:
            return
        if robot.name in self._running:
            _, before = self._waiting.get(robot.name, (robot, ()))
            self._waiting[robot.name] = robot, tuple(dict.fromkeys((*before, *files)))
            return
        self._running.add(robot.name)
        yield events.Running(robot.name)
        threading.Thread(target=self._run, args=(robot, files), daemon=True).start()

    def finish(self, ended: CommandEnded) -> Iterator[events.Event]:
        """Record the end of a command, and run it again if more files have changed."""
        self._running.discard(ended.robot)
        yield events.Ran(ended.robot, ended.code)
        if ended.problem:
            message = f"robot `{ended.robot}`: the command of --exec {ended.problem}"
            hint = "correct the command: it runs again after the next build that changes a file"
            yield events.Noted((Diagnostic(Severity.WARNING, "exec", message, hint=hint),))
        if waiting := self._waiting.pop(ended.robot, None):
            yield from self.run(*waiting)

    def _run(self, robot: RobotConfig, files: Sequence[Path]) -> None:
        text = "\n".join(map(str, files))
        if len(os.fsencode(text)) > _MAX_VARIABLE:
            text = str(robot.folder)
        # without the last one, `cmd` looks for programs in the working folder first
        names = {
            "URDFSYNC_ROBOT": robot.name,
            "URDFSYNC_PACKAGE": robot.target.package,
            "URDFSYNC_FILES": text,
            "NoDefaultCurrentDirectoryInExePath": "1",
        }
        try:
            code = subprocess.run(  # noqa: S602 - the user gives a shell command
                self._command,
                shell=True,
                cwd=self._folder,
                env={**os.environ, **names},
                stdin=subprocess.DEVNULL,
                stdout=_STDERR,  # the output of the command would break the lines of --format json
                check=False,
            ).returncode
            problem = f"ended with exit code {code}" if code > 0 else f"was ended by signal {-code}" if code else ""
        except OSError as error:
            code, problem = _NOT_FOUND, f"can't be started: {error.strerror or error}"
        self._queue.put(CommandEnded(robot.name, code, problem))
