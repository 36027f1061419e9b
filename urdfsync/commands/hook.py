"""`urdfsync hook`: builds or checks before a commit, as `build` and `build --check` do, then asks git for the rest.

A commit passes if the working tree is in step, and all that a build reads and writes of the robots that the commit
touches is staged as it is there. Under pre-commit the working tree is what is staged, but for untracked files.
"""

from __future__ import annotations

import argparse
import os
import shlex
from collections.abc import Collection, Iterable, Iterator, Sequence
from pathlib import Path, PurePosixPath

import msgspec

from urdfsync import config as configuration
from urdfsync import git, hook, uptodate
from urdfsync.commands import arguments
from urdfsync.config import FILE_NAME, STATE_FOLDER, Config, RobotConfig
from urdfsync.dependencies import LSTAT, STAT, VARIABLE, Dependencies
from urdfsync.diagnostics import Diagnostic, Severity, SourceError, StateError, UrdfsyncError
from urdfsync.engine import parents
from urdfsync.engine.actions import Reason
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.files import shown
from urdfsync.output.console import Console, line
from urdfsync.output.phrases import counted, summary
from urdfsync.output.results import show_result
from urdfsync.state import planned
from urdfsync.state.lock import build_lock
from urdfsync.state.store import Store

_FEW = 4
"""So many files are named one by one."""
_UNNEEDED = (Reason.ORPHAN, Reason.NEEDED, Reason.FORGET)
"""Actions on files that a clone can do without."""
_ADD, _BUILD = "add to the commit:", "build, and see what to add:"
_ADD_REST = "add the rest, or put it aside with `git stash push --keep-index`:"


class CommitFault(msgspec.Struct, frozen=True):
    """A reason why a commit does not pass, in one robot."""

    files: RobotFiles
    code: str
    message: str
    step: str = ""
    """A step for the user; the command for it adds `paths`, or builds."""
    paths: Collection[str] = ()
    result: Result | None = None
    """The result of a build or a dry run; None if nothing is to be built."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "hook",
        run,
        "--wait --jobs",
        help="build or check what is being committed; for hooks of git",
        description="Build or check the robots that a commit touches, and make sure that all of it is staged. "
        "All configurations that git tracks are looked at. The index is never written.",
        epilog="example: urdfsync hook check",
    )
    modes, configs = "build brings packages in step, check writes nothing", f"only these, instead of all {FILE_NAME}"
    parser.add_argument("mode", choices=("build", "check"), help=modes)
    parser.add_argument("configs", nargs="*", type=Path, metavar="CONFIG", help=configs)


def run(args: argparse.Namespace, console: Console) -> Exit:
    """Check the configurations that the arguments name, or all that git tracks."""
    try:
        commit = Commit()
        named = [*args.configs, *filter(None, [args.config])]
        found = commit.paths(named) if named else hook.find_configurations(commit.index)
        faults, diagnostics = list[CommitFault](), list[Diagnostic]()
        for path in sorted(found) if commit.touched else ():
            try:
                if not hook.passes(commit.index, path):
                    faults += _check(commit, path, arguments.request(args, console), args.mode == "build")
            except UrdfsyncError as error:
                if error.is_locked:
                    raise
                if any(one.startswith(path.removesuffix(PurePosixPath(path).name)) for one in commit.touched):
                    diagnostics += error.diagnostics
        return _show(commit, faults, diagnostics, named, console)
    except git.GitError as error:
        hint = "without a repository, use `urdfsync build --check`"
        raise SourceError(Diagnostic(Severity.ERROR, "git", str(error), hint=hint)) from None


class Commit:
    """The files of a commit, named as git does: by their path from the top of the repository."""

    def __init__(self) -> None:
        """Raises GitError, and SourceError while files are unmerged."""
        self.index = git.Index()
        for path in sorted(self.index.unmerged):
            message, hint = "the file is not merged yet, so there is nothing to commit", "resolve it and `git add` it"
            raise SourceError(Diagnostic(Severity.ERROR, "unmerged", message, path, hint=hint))
        self.files = self.index.find_committed()
        is_commit = self.files or "GIT_INDEX_FILE" in os.environ
        self.touched = self.files if is_commit else self.index.tracked
        """The files whose robots are checked; all if nobody commits, such as for `pre-commit run --all-files`."""
        self._real_folders: dict[str, str] = {}

    def path(self, file: str | Path) -> str | None:
        """Return the path of a file from the top; None if it lies outside. For one in a submodule, this is the path.

        Links among the folders are followed, as git does not track what is behind them.
        """
        folder, name = os.path.split(os.path.abspath(file))  # noqa: PTH100 - strings: there are thousands of files
        if folder not in self._real_folders:
            self._real_folders[folder] = os.path.realpath(folder)
        real = f"{self._real_folders[folder]}/{name}".replace(os.sep, "/")
        path = real.removeprefix(f"{self.index.top}/")
        if path == real:
            return None
        return next((module for module in self.index.submodules if path.startswith(f"{module}/")), path)

    def paths(self, files: Iterable[str | Path]) -> set[str]:
        """Return the paths of files, and of what they are links to."""
        names = {os.fspath(file) for file in files}
        names |= {os.path.realpath(name) for name in names if os.path.islink(name)}  # noqa: PTH114
        return {path for name in names if (path := self.path(name)) is not None}

    def typed(self, path: str) -> str:
        """Return a path as one types it where git was called: hooks run at the top."""
        here = Path(self.index.top, os.environ["GIT_PREFIX"]) if "GIT_PREFIX" in os.environ else Path.cwd()
        text = os.path.relpath(Path(self.index.top, path), here)
        return f"./{text}" if text.startswith("-") else text


class RobotFiles:
    """The files of one robot as git names them: all that a build of it reads and writes."""

    def __init__(
        self, commit: Commit, config: Config, robot: RobotConfig, planned: Result, dependencies: Dependencies
    ) -> None:
        """`planned` is the result of a dry run, and `dependencies` are what that has read."""
        self._commit, self.config, self.robot, self.planned = commit, config, robot, planned
        state = config.root / STATE_FOLDER
        store = Store(config.root)
        recorded = [store.path(robot.name), store.expansion(robot.name), *store.base_files(robot.name)]
        kept = [*recorded, state / ".gitignore", state / ".gitattributes"]
        self.outputs = commit.paths([*kept, *parents.files(robot)])
        """Files that a commit has to have if they exist."""
        found = [path for check, path in dependencies.entries if check in (LSTAT, STAT)]
        read = [path for path in found if not path.endswith(".mo")]  # the user's models need not be in the commit
        self.inputs = commit.paths([config.file, *read])
        """Files that a commit has to have unless git is told to ignore them."""
        self.known = self.inputs | commit.paths(
            [robot.source, *(path for check, path in dependencies.entries if check != VARIABLE)]
        )
        """These, and files that could have been there."""
        self.note(planned)
        self.states = f"{commit.path(state / 'robots')}/", f"{commit.path(state / 'bases')}/"
        self._others = {one.name for one in config.robots} - {robot.name}
        folders = [robot.folder, *([robot.templates] if robot.templates else [])]
        self.folders = tuple(f"{path}/" for folder in folders if (path := commit.path(folder)) is not None)

    def note(self, result: Result) -> None:
        """Add the outputs of a plan or a build."""
        places = [f"{result.root}/{one.path}" for one in result.actions if one.reason not in _UNNEEDED]
        whole = [f"{place.removesuffix('.mo')}/package.mo" for place in places]  # of classes that are folders now
        self.outputs |= self._commit.paths([*places, *whole])
        self.known |= self.outputs

    def select(self, paths: Iterable[str]) -> set[str]:
        """Return those of the paths that are the robot's, or a state of a robot that is no more."""
        return {path for path in paths if path in self.known or path.startswith(self.folders) or self._is_state(path)}

    def _is_state(self, path: str) -> bool:
        """Return whether a path is a state, such as `robots/arm.state` or `bases/arm/0`, of no other robot."""
        place = next((place for place in self.states if path.startswith(place)), None)
        if place is None:
            return False
        robot, slash, _ = path.removeprefix(place).partition("/")
        return (robot if slash else PurePosixPath(robot).stem) not in self._others

    def find_unstaged(self) -> set[str]:
        """Return the files that have to be added to the commit."""
        index = self._commit.index
        untracked = {path for path in self.outputs - index.tracked if Path(index.top, path).is_file()}
        return self.select(index.unstaged) | untracked | (self.inputs & index.untracked)


def _check(commit: Commit, path: str, options: BuildOptions, writing: bool) -> list[CommitFault]:
    """Return the faults of the robots of one configuration; with `writing`, build. Raises UrdfsyncError."""
    index = commit.index
    file, key = hook.answer_place(index, path)
    with Dependencies() as everything:
        config = configuration.load(Path(file))
        if is_interrupted(config, options.wait):
            message, hint = "the last build was interrupted", "run `urdfsync build`, which finishes it"
            raise StateError(Diagnostic(Severity.ERROR, "interrupted", message, shown(config.file), hint=hint))
        robots = [_plan(commit, config, robot, options, everything) for robot in config.robots]
    if not any(not one.planned.in_step or one.find_unstaged() or one.select(index.hidden) for one in robots):
        needed = {path for one in robots for path in (*(one.known & index.tracked), *one.folders, *one.states)}
        uptodate.save_answer(file, "hook", key, sorted(needed), everything)
        return []
    faults, to_build = [], []
    for one in robots:
        if not one.select(commit.touched):
            continue
        if hidden := one.select(index.hidden):
            names = ", ".join(sorted(hidden))
            message = f"git is told not to look at {names} (`git help update-index` says how to undo it)"
            faults.append(CommitFault(one, "hidden", message))
        elif partly := one.select(commit.files & index.unstaged):
            message = f"staged in part only: {', '.join(sorted(partly))}"
            faults.append(CommitFault(one, "partly-staged", message, _ADD_REST, partly))
        elif not one.planned.in_step and writing:
            to_build.append(one)
        elif not one.planned.in_step:
            faults.append(_fault_of_build(one, one.planned, _BUILD))
        elif unstaged := one.find_unstaged():
            message = f"in step, but not staged: {counted(len(unstaged), 'file')}"
            faults.append(CommitFault(one, "not-staged", message, _ADD, unstaged))
    results = list(build(config, [one.robot for one in to_build], options)) if to_build else []
    commit.index = git.Index()  # of which builds have changed files
    for one, result in zip(to_build, results, strict=True):
        one.note(result)
        unstaged = one.find_unstaged()
        if unstaged or exit_code([result]) is not Exit.IN_STEP:  # else all that was written lies elsewhere
            faults.append(_fault_of_build(one, result, _ADD, unstaged))
    return faults


def is_interrupted(config: Config, wait: float) -> bool:
    """Return whether a build was killed while it wrote: a clone would not know what it was about to write.

    Waits so many seconds for a build that is still writing. Raises LockedError.
    """
    folder = config.root / STATE_FOLDER
    if planned.is_interrupted(folder):
        with build_lock(folder, wait) as lock:
            lock.acquire()
    return planned.is_interrupted(folder)


def _plan(
    commit: Commit, config: Config, robot: RobotConfig, options: BuildOptions, everything: Dependencies
) -> RobotFiles:
    """Plan a build of one robot in the working tree, and find its files; add what was read to `everything`."""
    dry = msgspec.structs.replace(options, dry=True, trusted=True)
    with Dependencies() as dependencies:
        (result,) = build(config, [robot], dry)
    for (check, path), found in dependencies.entries.items():
        everything.add(check, path, found)
    everything.complete = everything.complete and dependencies.complete
    return RobotFiles(commit, config, robot, result, dependencies)


def _fault_of_build(files: RobotFiles, result: Result, step: str, paths: Collection[str] = ()) -> CommitFault:
    if result.failed or result.conflicts or result.is_broken:
        return CommitFault(files, "out-of-step", summary(result), result=result)
    return CommitFault(files, "out-of-step", f"out of step: {summary(result)}", step, paths, result)


def _show(
    commit: Commit,
    faults: Sequence[CommitFault],
    diagnostics: list[Diagnostic],
    named: Sequence[Path],
    console: Console,
) -> Exit:
    """Show what is wrong with each robot, then commands to copy. Returns the exit code."""
    code = exit_code([fault.result for fault in faults if fault.result])
    code = Exit.ERROR if diagnostics else code or (Exit.OUT_OF_STEP if faults else Exit.IN_STEP)
    several, lines = len({fault.files.config.file for fault in faults}) > 1, []
    for fault in faults:
        name, place = fault.files.robot.name, commit.typed(str(fault.files.config.file))
        if fault.result and (console.json or not fault.step):
            show_result(console, fault.result)
        else:
            lines.append(f"{name}{f' ({place})' if several else ''}: {fault.message}")
        if console.json:
            hint = "; ".join(f"`{command}`" for _, command in _steps(commit, [fault], named))
            message = f"robot `{name}`: {fault.message}"
            diagnostics.append(Diagnostic(Severity.ERROR, fault.code, message, place, hint=hint))
    if not console.json:
        lines += [text for step, command in _steps(commit, faults, named) for text in (step, f"  {command}")]
        console.print(line((text, "")) for text in lines)
    console.end("hook", code, diagnostics)
    return code


def _steps(commit: Commit, faults: Sequence[CommitFault], named: Sequence[Path]) -> Iterator[tuple[str, str]]:
    """Return what to do about faults, and the commands for it."""
    index = commit.index
    for step in dict.fromkeys(fault.step for fault in faults if fault.step):
        if step == _BUILD:
            yield step, shlex.join(["urdfsync", "hook", "build", *map(str, named)])
            continue
        paths = {path for fault in faults if fault.step == step for path in fault.paths}
        force = ["-f"] if paths - index.tracked - index.untracked else []  # git is told to ignore some
        pending, folders = index.unstaged | index.untracked, {one for fault in faults for one in fault.files.folders}
        for folder in folders if len(paths) > _FEW and not force else ():
            inside = {path for path in pending if path.startswith(folder)}
            if len(inside) > 1 and inside <= paths:  # nothing else is to add in there
                paths = paths - inside | {folder.removesuffix("/")}
        yield step, shlex.join(["git", "add", *force, *sorted(map(commit.typed, paths))])
