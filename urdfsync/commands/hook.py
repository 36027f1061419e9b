"""`urdfsync hook`: judges what is being committed, for pre-commit and other runners of git hooks.

People get a line for each robot that is not in step or not staged, and commands to copy.
"""

from __future__ import annotations

import argparse
import os
import shlex
from collections.abc import Iterator, Sequence
from pathlib import Path

from urdfsync.commands import arguments
from urdfsync.config import FILE_NAME, working_folder
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.result import Exit, exit_code
from urdfsync.hooks.check import CommitFault, check_index
from urdfsync.hooks.index import Index
from urdfsync.output.console import Console, line
from urdfsync.output.phrases import summary
from urdfsync.output.results import show_result

_FEW = 5
"""So many files are named one by one."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "hook",
        run,
        "--wait --jobs",
        help="judge what is being committed; for hooks of git",
        description="Judge staged sources against staged outputs, for all configurations that git tracks. The index is "
        "never touched.",
        epilog=f"example: urdfsync hook check\n\n{arguments.CODES}",
    )
    modes, configs = "build brings packages in step, check writes nothing", f"only these, instead of all {FILE_NAME}"
    parser.add_argument("mode", choices=("build", "check"), help=modes)
    parser.add_argument("configs", nargs="*", type=Path, metavar="CONFIG", help=configs)


def run(args: argparse.Namespace, console: Console) -> Exit:
    """Judge the configurations that the arguments name, or all that git tracks."""
    folder = working_folder()
    index = Index(folder)
    named = [*args.configs, *filter(None, [args.config])]
    faults, diagnostics = check_index(index, arguments.request(args, console), args.mode == "build", named)
    code = exit_code([fault.result for fault in faults if fault.result])
    code = Exit.ERROR if diagnostics else code or (Exit.OUT_OF_STEP if faults else Exit.IN_STEP)
    for fault in faults:
        if fault.result and (console.json or fault.needs_user):
            show_result(console, fault.result)
    if faults:
        index = Index(folder)  # a build may have written
        # the folder in which the user called git or pre-commit, as far as these tell
        shell = Path(os.path.realpath(os.environ.get("PWD") or folder))
        if "GIT_PREFIX" in os.environ:
            folder = index.top / os.environ["GIT_PREFIX"]
        elif "PRE_COMMIT" in os.environ and shell.is_relative_to(index.top):
            folder = shell
        advice = _Advice(index, folder)
        if console.json:
            for fault in faults:
                hint = "; ".join(f"`{command}`" for command in advice.steps([fault]).values())
                kind, place = "out-of-step" if fault.result else "not-staged", advice.shown(fault.files.config.file)
                message = f"robot `{fault.files.robot.name}`: {advice.message(fault)}"
                diagnostics.append(Diagnostic(Severity.ERROR, kind, message, place, hint=hint))
        else:
            console.print(line((text, "")) for text in _lines(faults, advice))
    console.end("hook", code, diagnostics)
    return code


def _lines(faults: Sequence[CommitFault], advice: _Advice) -> Iterator[str]:
    """Return a line for each robot, then commands to copy."""
    several = len({fault.files.config.file for fault in faults}) > 1
    for fault in faults:
        place = f" ({advice.shown(fault.files.config.file)})" if several else ""
        if several or not fault.needs_user:  # else its result has been shown
            yield f"{fault.files.robot.name}{place}: {advice.message(fault)}"
    for step, command in advice.steps(faults).items():
        yield from (step, f"  {command}")


class _Advice:
    """What is wrong, and commands that put it right, with paths as the user would type them."""

    def __init__(self, index: Index, folder: Path) -> None:
        """`folder` is where the user types."""
        self._index, self._folder = index, folder

    def shown(self, path: Path | str) -> str:
        """Return a path as the user would type it; a text is a path from the top of the repository."""
        text = os.path.relpath(self._index.top / path, self._folder)
        return f"./{text}" if text.startswith("-") else text

    def message(self, fault: CommitFault) -> str:
        """Return what is wrong, as the rest of a line that names the robot."""
        result, number = fault.result, len(fault.to_add)
        if result is None:
            return f"in step on disk, but {'1 file is' if number == 1 else f'{number} files are'} not staged"
        if fault.needs_user:
            return summary(result)
        what = "what urdfsync recorded of it is out of date" if result.in_step else summary(result)
        files = ", ".join(map(self.shown, fault.unstaged))
        have = "has" if len(fault.unstaged) == 1 else "have"
        return f"out of step: {what}{f'; {files} {have} changes that are not staged' if files else ''}"

    def steps(self, faults: Sequence[CommitFault]) -> dict[str, str]:
        """Return what to do, and the command for it."""
        steps = {}
        if ready := [fault for fault in faults if fault.to_add and not fault.needs_build]:
            steps["add to the commit:"] = self._add_command(ready)
        if waiting := [fault for fault in faults if fault.needs_build and not fault.needs_user]:
            files = shlex.join(map(self.shown, sorted({path for fault in waiting for path in fault.unstaged})))
            step = f"stage the changes (git add {files}) or put them aside (git stash push --keep-index), then build:"
            step = step if files else "build, then add to the commit:"
            commands = []  # one for each configuration
            near = next((f for f in (self._folder, *self._folder.parents) if (f / FILE_NAME).is_file()), None)
            for file in dict.fromkeys(fault.files.config.file for fault in waiting):
                robots = [fault.files.robot.name for fault in waiting if fault.files.config.file == file]
                option = [] if near is not None and near / FILE_NAME == file else ["--config", self.shown(file)]
                commands.append(shlex.join(["urdfsync", "build", *robots, *option]))
            steps[step] = " && ".join([*commands, self._add_command(waiting)])
        return steps

    def _add_command(self, faults: Sequence[CommitFault]) -> str:
        """Return the command that stages files; of many, folders instead of those in which nothing else is to add."""
        paths, force = sorted({path for fault in faults for path in fault.to_add}), []
        if self._index.ignored(path for path in paths if not self._index.tracks(path)):
            force = ["-f"]
        elif len(paths) > _FEW:
            for folder in sorted({folder for fault in faults for folder in fault.files.folders}):
                inside = {path for path in paths if path.startswith(f"{folder}/")}
                if len(inside) > 1 and inside.issuperset(self._index.pending(folder)):
                    paths = sorted({folder, *paths} - inside)
        return shlex.join(["git", "add", *force, *map(self.shown, paths)])
