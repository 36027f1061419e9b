"""`urdfsync hook`: builds or checks before a commit, as `build` and `build --check` do, then looks at git's index.

A commit passes if the working tree is in step. All files that a build of the touched robots reads or writes must be
staged as they are on disk. Under pre-commit, the working tree equals the index but for untracked files.
"""

from __future__ import annotations

import argparse
import os
import shlex
from collections.abc import Collection, Iterable, Iterator
from pathlib import Path, PurePosixPath

import msgspec

from urdfsync import config as configuration
from urdfsync import git
from urdfsync.commands import arguments
from urdfsync.config import STATE_FOLDER, Config, RobotConfig
from urdfsync.dependencies.facts import LISTINGS, VARIABLE
from urdfsync.diagnostics import Diagnostic, Severity, SourceError, findings_of
from urdfsync.engine import parents
from urdfsync.engine.actions import ORPHANS, Reason
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.files import shown
from urdfsync.git import hook
from urdfsync.output.build_section import show_result
from urdfsync.output.console import Console
from urdfsync.spelling import counted

_FEW = 4
"""If a hint has more files to add, it names whole folders."""
_COMMITTED = (f"robots{os.sep}", f"bases{os.sep}", ".git")
"""The parts of the recorded state that belong into a commit."""
_UNNEEDED = ORPHANS | {Reason.FORGET, Reason.UNKNOWN}
"""Actions on files that other clones do not need."""


class Fault(msgspec.Struct, frozen=True):
    """A reason why one robot keeps a commit from passing."""

    diagnostic: Diagnostic
    result: Result | None = None
    """The result of a build or a dry run; None if neither ran."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "hook",
        "--wait --jobs",
        help="build or check what is being committed; for hooks of git",
        description="Build or check the robots that a commit touches, and require that all their files are staged. "
        "All configurations that git tracks are checked, or that of --config. The index is never written.",
        epilog="example: urdfsync hook check",
    )
    modes = "build brings packages in step, check writes nothing"
    parser.add_argument("mode", choices=("build", "check"), help=modes)


def run(args: argparse.Namespace, console: Console) -> int:
    """Check the configuration of --config, or all configurations that git tracks."""
    faults, errors = list[Fault](), list[Diagnostic]()
    try:
        commit = Commit()
        paths = commit.paths([args.config]) if args.config else hook.find_configurations(commit.index)
        for path in sorted(paths) if commit.touched else ():
            try:
                faults += _find_faults(commit, path, arguments.request(args, console), args.mode == "build")
            except git.GitError:
                raise
            except Exception as error:  # noqa: BLE001 - one configuration's error does not stop the others
                if any(file.startswith(path.removesuffix(PurePosixPath(path).name)) for file in commit.touched):
                    errors += findings_of(error)
    except git.GitError as error:
        raise SourceError.of("git", str(error), hint="without a repository, use `urdfsync build --check`") from None
    results = [fault.result for fault in faults if fault.result]
    for result in results:
        if console.is_document or result.failed or result.conflicts or result.is_broken:
            show_result(console, result)
    code = Exit.ERROR if errors else exit_code(results) or (Exit.OUT_OF_STEP if faults else Exit.IN_STEP)
    return console.end(code, [*(fault.diagnostic for fault in faults), *errors])


class Commit:
    """The files of a commit, by their paths from the top of the repository, as in git."""

    def __init__(self) -> None:
        """Raises GitError, and SourceError while files are unmerged."""
        self.index = git.Index()
        for path in sorted(self.index.unmerged):
            message, hint = "the file is not merged yet, so there is nothing to commit", "resolve it and `git add` it"
            raise SourceError.of("unmerged", message, path, hint=hint)
        self.files = self.index.find_committed()
        is_commit = self.files or "GIT_INDEX_FILE" in os.environ
        self.touched = self.files if is_commit else self.index.tracked
        """The files whose robots are checked; all files if there is no commit, as in `pre-commit run --all-files`."""
        self._real_folders: dict[str, str] = {}

    def path(self, file: str | Path) -> str | None:
        """Return the path of a file, or of its submodule, from the top of the repository; None for a file outside.

        Links to folders are followed, since git tracks no files behind them.
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
        """Return the paths of files, and of the targets of links."""
        names = {os.fspath(file) for file in files}
        names |= {os.path.realpath(name) for name in names if os.path.islink(name)}  # noqa: PTH114
        return {path for name in names if (path := self.path(name)) is not None}


class RobotFiles:
    """The files that a build of one robot reads or writes, by their paths in git."""

    def __init__(self, commit: Commit, config: Config, robot: RobotConfig, planned: Result) -> None:
        """`planned` is the result of a dry run."""
        self._commit, self._config_file, self.robot, self.planned = commit, config.file, robot, planned
        self._state = f"{config.root / STATE_FOLDER}{os.sep}"
        self.outputs = commit.paths(parents.files(robot))
        """The files that the commit needs, if they exist."""
        self.known = commit.paths([config.file])
        """The files that the commit needs, and the files that a build read or looked for."""
        self.note(planned)
        folders = [robot.folder, Path(self._state, "bases", robot.name), *filter(None, [robot.templates])]
        self.folders = tuple(f"{path}/" for folder in folders if (path := commit.path(folder)) is not None)

    def note(self, result: Result) -> None:
        """Add the files that a plan or a build has read or written."""
        entries = [entry for entry in result.reads.entries if entry[0] not in (*LISTINGS, VARIABLE)]
        package = f"{self.robot.folder}{os.sep}"
        outputs = {path for _, path in entries if path.startswith((package, self._state))}
        unneeded = {action.path for action in result.actions if action.reason in _UNNEEDED}
        outputs -= {os.path.normpath(result.root / path) for path in unneeded}
        self.outputs |= self._commit.paths(path for path in outputs if self._is_for_git(path))
        self.known |= self.outputs | self._commit.paths(path for _, path in entries)

    def _is_for_git(self, path: str) -> bool:
        """Return whether a file belongs into a commit: parts of the recorded state do not."""
        return not path.startswith(self._state) or path.removeprefix(self._state).startswith(_COMMITTED)

    def select(self, paths: Iterable[str]) -> set[str]:
        """Return the paths that belong to the robot."""
        return {path for path in paths if path in self.known or path.startswith(self.folders)}

    def find_unstaged(self) -> set[str]:
        """Return the files that have to be added to the commit."""
        index = self._commit.index
        outputs = {path for path in self.outputs - index.tracked if Path(index.top, path).is_file()}
        # a build may read ignored files, and the user's models need not be in the commit
        inputs = {path for path in self.known & index.untracked if not path.endswith(".mo")}
        return self.select(index.unstaged) | outputs | inputs

    def find_fault(self) -> Fault | None:
        """Return why the commit fails before a build; None if it passes."""
        index = self._commit.index
        if hidden := self.select(index.hidden):
            message = f"git ignores changes of {', '.join(sorted(hidden))}"
            return self.fault("hidden", message, "`git help update-index` says how to undo this")
        if partly := self.select(self._commit.files & index.unstaged):
            hint = f"{self.adding(partly)}, or put the rest aside with `git stash push --keep-index`"
            return self.fault("partly-staged", f"partly staged: {', '.join(sorted(partly))}", hint)
        if not self.planned.in_step:
            return self.fault_of_build(self.planned, "`urdfsync hook build`")
        if unstaged := self.find_unstaged():
            message = f"in step, but not staged: {counted(len(unstaged), 'file')}"
            return self.fault("not-staged", message, self.adding(unstaged))
        return None

    def fault_of_build(self, result: Result, hint: str) -> Fault:
        """Return the fault of a robot that a build wrote, or that is out of step."""
        if result.failed or result.conflicts or result.is_broken:
            return self.fault("out-of-step", result.summary, "", result)
        return self.fault("out-of-step", f"out of step: {result.summary}", hint, result)

    def fault(self, code: str, message: str, hint: str, result: Result | None = None) -> Fault:
        """Return a fault of this robot."""
        message, place = f"robot `{self.robot.name}`: {message}", shown(self._config_file)
        return Fault(Diagnostic(Severity.ERROR, code, message, place, hint=hint), result)

    def adding(self, paths: Collection[str]) -> str:
        """Return the command that adds files to the commit, from any folder of the repository."""
        index, names = self._commit.index, set(paths)
        ignored = names - index.tracked - index.untracked
        for folder in self.folders if len(names) > _FEW and not ignored else ():
            inside = {path for path in index.unstaged | index.untracked if path.startswith(folder)}
            if len(inside) > 1 and inside <= names:  # then name the whole folder
                names = names - inside | {folder.removesuffix("/")}
        # to git `:/` means the top, from any folder; after a second colon, a name may begin with a special sign
        from_top = [f":/{'' if name[0].isalnum() or name[0] == '.' else ':'}{name}" for name in sorted(names)]
        return f"`{shlex.join(['git', 'add', *(['-f'] if ignored else []), *from_top])}`"


def _find_faults(commit: Commit, path: str, options: BuildOptions, writing: bool) -> Iterator[Fault]:
    """Yield the faults of the robots of one configuration; with `writing`, build the robots. Raises UrdfsyncError."""
    config = configuration.load(Path(commit.index.top, path))
    robots = [_plan(commit, config, robot, options) for robot in config.robots]
    commit.index = index = git.Index()  # the daemon may have written files since the first look, and before the plan
    if not any(not robot.planned.in_step or robot.find_unstaged() or robot.select(index.hidden) for robot in robots):
        return
    to_build = []
    for robot in robots:
        fault = robot.find_fault() if robot.select(commit.touched) else None
        if fault and writing and fault.result and not fault.result.failed:
            to_build.append(robot)
        elif fault:
            yield fault
    alone = msgspec.structs.replace(options, renews=False)
    results = list(build(config, [robot.robot for robot in to_build], alone)) if to_build else []
    commit.index = git.Index()  # builds have changed files
    for robot, result in zip(to_build, results, strict=True):
        robot.note(result)
        unstaged = robot.find_unstaged()
        if unstaged or exit_code([result]) is not Exit.IN_STEP:  # otherwise the commit lacks the written files
            yield robot.fault_of_build(result, robot.adding(unstaged))


def _plan(commit: Commit, config: Config, robot: RobotConfig, options: BuildOptions) -> RobotFiles:
    """Plan a build of one robot in the working tree, and find its files."""
    dry = msgspec.structs.replace(options, dry=True, trusted=True)
    (result,) = build(config, [robot], dry)
    return RobotFiles(commit, config, robot, result)
