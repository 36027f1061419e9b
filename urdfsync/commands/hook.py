"""`urdfsync hook`: judges what is being committed, for pre-commit and other runners of git hooks.

People get a line for each robot that is not in step or not staged, and commands to copy.
"""

from __future__ import annotations

import argparse
import os
import shlex
import sys
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from urdfsync import wording
from urdfsync.commands import common
from urdfsync.config import FILE_NAME, working_folder
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.outcome import Exit, exit_code
from urdfsync.report import Report

if TYPE_CHECKING:
    from urdfsync.hooks.check import CommitFault

_FEW = 5
"""So many files are named one by one."""


def add(commands: common.Commands) -> None:
    """Add the command's parser."""
    parser = commands.add_parser(
        "hook",
        help="judge what is being committed; for hooks of git",
        description="Judge staged sources against staged outputs, for all configurations that git tracks. The index is "
        "never touched.",
        epilog=f"example: urdfsync hook check\n\n{common.CODES}",
    )
    modes = "build brings packages in step, check writes nothing"
    parser.add_argument("mode", choices=("build", "check"), help=modes)
    parser.add_argument(
        "configs", nargs="*", type=Path, metavar="CONFIG", help=f"only these, instead of all {FILE_NAME}"
    )
    common.add_wait(parser)
    common.add_jobs(parser)
    parser.set_defaults(run=_run)
    common.add_common(parser)


def _run(args: argparse.Namespace, report: Report) -> int:
    """Judge the configurations that the arguments name, or all that git tracks."""
    from urdfsync.hooks.check import check_index  # not at the top: no other command needs git or temporary folders
    from urdfsync.hooks.index import Index

    folder = working_folder()
    index = Index(folder)
    named = [*args.configs, *filter(None, [args.config])]
    faults, diagnostics = check_index(index, common.request(args, report), args.mode == "build", named)
    code = exit_code([fault.result for fault in faults if fault.result])
    code = Exit.ERROR if diagnostics else code or (Exit.OUT_OF_STEP if faults else Exit.IN_STEP)
    for fault in faults:
        if fault.result and (args.json or fault.needs_user):
            report.result(fault.result)
    if faults:
        index = Index(folder)  # a build may have written
        ignored = index.ignored({path for fault in faults for path in fault.to_add if not index.tracks(path)})
        place = Place(index.top, _typing_folder(index.top, folder, os.environ), index.pending)
        if args.json:
            diagnostics += [_finding(fault, place, ignored) for fault in faults]
        else:
            sys.stdout.writelines(f"{wording.visible(line)}\n" for line in lines(faults, place, ignored))
    report.problems("hook", diagnostics, code)
    return code


def _typing_folder(top: Path, folder: Path, environment: Mapping[str, str]) -> Path:
    """The folder in which the user has called git or pre-commit, as far as these tell."""
    if "GIT_PREFIX" in environment:
        return top / environment["GIT_PREFIX"]
    shell = Path(os.path.realpath(environment.get("PWD") or folder))
    return shell if "PRE_COMMIT" in environment and shell.is_relative_to(top) else folder


class Place:
    """Where the user is, and what commands to copy have to know because of that."""

    def __init__(self, top: Path, folder: Path, pending: Callable[[str], Collection[str]]) -> None:
        """`top` is that of the repository, `folder` where the user types.

        `pending` gives all files below a folder that `git add` would take with it; all by their path from the top.
        """
        self._top, self._folder, self._pending = top, folder, pending

    def shown(self, path: Path | str) -> str:
        """A path as the user would type it; a text is one of the repository."""
        text = os.path.relpath(self._top / path, self._folder)
        return f"./{text}" if text.startswith("-") else text

    def add_command(self, faults: Sequence[CommitFault], ignored: Collection[str]) -> str:
        """The command that stages what faults name; `ignored` files have to be forced."""
        paths = sorted({path for fault in faults for path in fault.to_add})
        if not set(ignored).isdisjoint(paths):
            return shlex.join(["git", "add", "-f", *map(self.shown, paths)])
        folders = {folder for fault in faults for folder in fault.folders}
        return shlex.join(["git", "add", *map(self.shown, self._folded(paths, folders))])

    def build_commands(self, faults: Sequence[CommitFault]) -> str:
        """The commands that build what faults name, one for each configuration."""
        commands = []
        for file in dict.fromkeys(fault.config for fault in faults):
            robots = [fault.robot for fault in faults if fault.config == file]
            near = next((f for f in (self._folder, *self._folder.parents) if (f / FILE_NAME).is_file()), None)
            option = [] if near is not None and near / FILE_NAME == file else ["--config", self.shown(file)]
            commands.append(shlex.join(["urdfsync", "build", *robots, *option]))
        return " && ".join(commands)

    def _folded(self, paths: Sequence[str], folders: Collection[str]) -> list[str]:
        """The paths; if they are many, folders instead of those in which nothing else would be added."""
        found = list(paths)
        for folder in sorted(folders) if len(paths) > _FEW else ():
            inside = {path for path in found if path.startswith(f"{folder}/")}
            if len(inside) > 1 and inside.issuperset(self._pending(folder)):
                found = [folder, *(path for path in found if path not in inside)]
        return sorted(found)


def lines(faults: Sequence[CommitFault], place: Place, ignored: Collection[str]) -> Iterator[str]:
    """Everything that there is to say of robots that are not in step, or not staged."""
    several = len({fault.config for fault in faults}) > 1
    for fault in faults:
        if several:
            yield f"{fault.robot} ({place.shown(fault.config)}): {_fault(fault, place)}"
        elif not fault.needs_user:  # else its result has been shown
            yield f"{fault.robot}: {_fault(fault, place)}"
    for advice, command in _steps(faults, place, ignored):
        yield advice
        yield f"  {command}"


def _steps(faults: Sequence[CommitFault], place: Place, ignored: Collection[str]) -> Iterator[tuple[str, str]]:
    """What to do, and the command for it."""
    ready = [fault for fault in faults if fault.to_add and not fault.needs_build]
    if ready:
        yield "add to the commit:", place.add_command(ready, ignored)
    waiting = [fault for fault in faults if fault.needs_build and not fault.needs_user]
    if not waiting:
        return
    unstaged = sorted({path for fault in waiting for path in fault.unstaged})
    advice = "build, then add to the commit:"
    if unstaged:
        files = shlex.join(map(place.shown, unstaged))
        advice = f"stage the changes (git add {files}) or put them aside (git stash push --keep-index), then build:"
    yield advice, f"{place.build_commands(waiting)} && {place.add_command(waiting, ignored)}"


def _fault(fault: CommitFault, place: Place) -> str:
    """What is wrong, as the rest of a line that names the robot."""
    result = fault.result
    if result is None:
        number = len(fault.to_add)
        return f"in step on disk, but {'1 file is' if number == 1 else f'{number} files are'} not staged"
    if fault.needs_user:
        return wording.summary(result)
    what = "what urdfsync recorded of it is out of date" if result.in_step else wording.summary(result)
    if not fault.unstaged:
        return f"out of step: {what}"
    files = ", ".join(map(place.shown, fault.unstaged))
    return f"out of step: {what}; {files} {'has' if len(fault.unstaged) == 1 else 'have'} changes that are not staged"


def _finding(fault: CommitFault, place: Place, ignored: Collection[str]) -> Diagnostic:
    """The same for programs."""
    message = f"robot `{fault.robot}`: {_fault(fault, place)}"
    hint = "; ".join(f"`{command}`" for _, command in _steps([fault], place, ignored))
    code = "out-of-step" if fault.result else "not-staged"
    return Diagnostic(Severity.ERROR, code, message, place.shown(fault.config), hint=hint)
