"""`urdfsync hook`: judges what is being committed, for pre-commit and other runners of git hooks.

People get a line for each robot that is not in step or not staged, and commands to copy.
"""

from __future__ import annotations

import argparse
import os
import shlex
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from urdfsync.commands import arguments
from urdfsync.config import FILE_NAME, working_folder
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.outcome import Exit, exit_code
from urdfsync.output.console import Console, line
from urdfsync.output.phrases import counted, summary
from urdfsync.output.results import show_result

if TYPE_CHECKING:
    from urdfsync.staging.verdict import Verdict

_FEW = 5
"""So many files are named one by one."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = commands.add_parser(
        "hook",
        help="judge what is being committed; for hooks of git",
        description="Judge staged sources against staged outputs, for all configurations that git tracks. The index is "
        "never touched.",
        epilog=f"example: urdfsync hook check\n\n{arguments.CODES}",
    )
    modes = "build brings packages in step, check writes nothing"
    parser.add_argument("mode", choices=("build", "check"), help=modes)
    parser.add_argument(
        "configs", nargs="*", type=Path, metavar="CONFIG", help=f"only these, instead of all {FILE_NAME}"
    )
    arguments.add_wait(parser)
    arguments.add_jobs(parser)
    parser.set_defaults(run=run)
    arguments.add_common(parser)


def run(args: argparse.Namespace, console: Console) -> Exit:
    """Judge the configurations that the arguments name, or all that git tracks."""
    from urdfsync.staging import committing  # not at the top: no other command needs git or temporary folders
    from urdfsync.staging.staged import Index

    folder, request = working_folder(), arguments.request(args, console)
    index = Index(folder)
    named = [*args.configs, *filter(None, [args.config])]
    verdicts, diagnostics = committing.judge(index, folder, request, args.mode == "build", named)
    code = exit_code([verdict.result for verdict in verdicts if verdict.result])
    code = Exit.ERROR if diagnostics else code or (Exit.OUT_OF_STEP if verdicts else Exit.IN_STEP)
    for verdict in verdicts:
        if verdict.result and (console.json or verdict.troubled):
            show_result(console, verdict.result)
    if verdicts:
        index = Index(folder)  # a build may have written
        ignored = index.ignored({path for verdict in verdicts for path in verdict.add if not index.tracks(path)})
        place = Place(index.top, _typing_folder(index.top, folder, os.environ), index.pending)
        if console.json:
            diagnostics += [_finding(verdict, place, ignored) for verdict in verdicts]
        else:
            console.print(line((words, "")) for words in lines(verdicts, place, ignored))
    console.fail("hook", diagnostics, code)
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

    def add_command(self, verdicts: Sequence[Verdict], ignored: Collection[str]) -> str:
        """The command that stages what verdicts name; `ignored` files have to be forced."""
        paths = sorted({path for verdict in verdicts for path in verdict.add})
        if not set(ignored).isdisjoint(paths):
            return shlex.join(["git", "add", "-f", *map(self.shown, paths)])
        folders = {folder for verdict in verdicts for folder in verdict.folders}
        return shlex.join(["git", "add", *map(self.shown, self._folded(paths, folders))])

    def build_commands(self, verdicts: Sequence[Verdict]) -> str:
        """The commands that build what verdicts name, one for each configuration."""
        commands = []
        for file in dict.fromkeys(verdict.config for verdict in verdicts):
            robots = [verdict.robot for verdict in verdicts if verdict.config == file]
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


def lines(verdicts: Sequence[Verdict], place: Place, ignored: Collection[str]) -> Iterator[str]:
    """Everything that there is to say of robots that are not in step, or not staged."""
    several = len({verdict.config for verdict in verdicts}) > 1
    for verdict in verdicts:
        if several:
            yield f"{verdict.robot} ({place.shown(verdict.config)}): {_fault(verdict, place)}"
        elif not verdict.troubled:  # else its result has been shown
            yield f"{verdict.robot}: {_fault(verdict, place)}"
    for advice, command in _steps(verdicts, place, ignored):
        yield advice
        yield f"  {command}"


def _steps(verdicts: Sequence[Verdict], place: Place, ignored: Collection[str]) -> Iterator[tuple[str, str]]:
    """What to do, and the command for it."""
    ready = [verdict for verdict in verdicts if verdict.add and not verdict.waits]
    if ready:
        yield "add to the commit:", place.add_command(ready, ignored)
    waiting = [verdict for verdict in verdicts if verdict.waits and not verdict.troubled]
    if not waiting:
        return
    hindering = sorted({path for verdict in waiting for path in verdict.hindered})
    advice = "build, then add to the commit:"
    if hindering:
        files = shlex.join(map(place.shown, hindering))
        advice = f"stage the changes (git add {files}) or put them aside (git stash push --keep-index), then build:"
    yield advice, f"{place.build_commands(waiting)} && {place.add_command(waiting, ignored)}"


def _fault(verdict: Verdict, place: Place) -> str:
    """What is wrong, as the rest of a line that names the robot."""
    result = verdict.result
    if result is None:
        number = len(verdict.add)
        return f"in step on disk, but {counted(number, 'file')} {'is' if number == 1 else 'are'} not staged"
    if verdict.troubled:
        return summary(result)
    what = "what urdfsync recorded of it is out of date" if result.in_step else summary(result)
    if not verdict.hindered:
        return f"out of step: {what}"
    files = ", ".join(map(place.shown, verdict.hindered))
    return f"out of step: {what}; {files} {'has' if len(verdict.hindered) == 1 else 'have'} changes that are not staged"


def _finding(verdict: Verdict, place: Place, ignored: Collection[str]) -> Diagnostic:
    """The same for programs."""
    message = f"robot `{verdict.robot}`: {_fault(verdict, place)}"
    hint = "; ".join(f"`{command}`" for _, command in _steps([verdict], place, ignored))
    code = "out-of-step" if verdict.result else "not-staged"
    return Diagnostic(Severity.ERROR, code, message, place.shown(verdict.config), hint=hint)
