"""`urdfsync hook`: judges the next commit as `build --check` would in a fresh clone of it.

Git exports the index to a clone (see `git.clone`), and the ordinary dry run looks there. The working tree matters only
for the hint, and for what `hook build` writes.
"""

from __future__ import annotations

import argparse
import contextlib
import os
from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath

import msgspec

from urdfsync.commands import arguments
from urdfsync.common import noop, system
from urdfsync.common.dependencies.facts import LISTINGS, UNMERGED, VARIABLE, Entry, counting
from urdfsync.common.dependencies.places import Clone
from urdfsync.common.dependencies.reads import Reads
from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity, SourceError, UrdfsyncError, findings_of
from urdfsync.common.files import placed, shown
from urdfsync.common.spelling import counted
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.remembered import remember_configuration
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.output.build_section import out_of_step, show_result
from urdfsync.output.console import Console
from urdfsync.project import config as configuration
from urdfsync.project import git
from urdfsync.project.config import STATE_FOLDER, Config, RobotConfig
from urdfsync.project.git.clone import Commit, PathChange, export

_FEW = 4
"""If a hint has more files to add, it names whole folders."""
_COMMITTED = (f"robots{os.sep}", f"bases{os.sep}", ".git")
"""The parts of the recorded state that belong into a commit."""
_MOST_LINKS = 40
"""The greatest number of links in a path, as on Linux. A longer chain has no end."""
_OF_ALL = (".gitattributes", ".gitmodules")
"""Files by which git changes the content of other files."""


class Rejection(msgspec.Struct, frozen=True):
    """A reason why the hook rejects a commit: one robot is out of step."""

    diagnostic: Diagnostic
    result: Result
    """The result in the clone, or of a build in the working tree."""
    is_enough: bool = False
    """Whether the diagnostic alone tells the user what to do."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "hook",
        "--wait --jobs",
        help="build or check what is being committed; for hooks of git",
        description="Check the robots that a commit touches, as `build --check` does in a fresh clone of the commit; "
        "`build` also builds those that are out of step. All configurations that git tracks are checked, or that of "
        "--config. The index is never written.",
        epilog="example: urdfsync hook check",
    )
    modes = "build brings packages in step, check writes nothing"
    parser.add_argument("mode", choices=("build", "check"), help=modes)


def run(args: argparse.Namespace, console: Console) -> int:
    """Check the configuration of --config, or all configurations that git tracks."""
    rejections, errors = list[Rejection](), list[Diagnostic]()
    try:
        with export(git.Repository(), args.wait) as commit:
            for file in _find_configurations(commit, args.config):
                try:
                    rejections += _find_rejections(commit, file, arguments.request(args, console), args.mode == "build")
                except git.GitError:
                    raise
                except Exception as error:  # noqa: BLE001 - one configuration's error does not stop the others
                    errors += findings_of(error)
    except git.GitError as error:
        raise SourceError.of("git", str(error), hint="without a repository, use `urdfsync build --check`") from None
    for rejection in rejections:
        result = rejection.result
        is_telling = (result.failed or result.conflicts or result.is_broken) and not rejection.is_enough
        if console.is_document or is_telling:
            show_result(console, result)
    code = exit_code([rejection.result for rejection in rejections], check=True) or (
        Exit.OUT_OF_STEP if rejections else Exit.IN_STEP
    )
    return console.end(Exit.ERROR if errors else code, [*(rejection.diagnostic for rejection in rejections), *errors])


def _find_configurations(commit: Commit, given: Path | None) -> list[Path]:
    """Return the configurations to check. Raises ConfigError if one is on disk, and the commit lacks it."""
    top, lost = Path(commit.repository.top), commit.lost
    if given is not None:
        name = commit.clone.inside(os.path.join(os.path.realpath(given.parent), given.name))  # noqa: PTH118
        if name is None or not (name in commit.files or given.is_file()):
            configuration.load(given)  # outside of the repository, or it does not exist
        lost = [name] if name and name not in commit.files else []
    if lost:
        message, hint = "the commit lacks this configuration", _adding(lost, git.Index())
        raise ConfigError.of("not-staged", message, shown(top / lost[0]), hint=hint)
    return [top / file for file in commit.configurations] if given is None else [top / (name or given.absolute())]


def _find_rejections(commit: Commit, file: Path, options: BuildOptions, is_writing: bool) -> Iterator[Rejection]:
    """Yield the rejections of the robots of one configuration; with `is_writing`, build them. Raises UrdfsyncError."""
    dry = msgspec.structs.replace(options, dry=True)
    with commit.clone:
        if noop.is_in_step(str(file)):
            return
        with Reads() as everything:
            with Reads() as settings:
                config = configuration.load(file)
            selected = config.select(())  # which files a broken configuration means is unknown
            try:
                results = list(build(config, selected, dry))
            except UrdfsyncError:
                if _is_touched(commit, everything.entries):
                    raise
                return
        if all(result.in_step for result in results):
            remember_configuration(config, settings)
            return
    judged = [
        _OutOfStepRobot(commit, config, robot, result)
        for robot, result in zip(config.robots, results, strict=True)
        if not result.in_step
    ]
    judged = [
        robot
        for robot in judged
        if _is_touched(commit, settings.entries, *robot.folders) or _is_touched(commit, robot.result.reads)
    ]
    names, here, built = {one.robot.name for one in judged}, dict[str, Result](), dict[str, Result]()
    with contextlib.suppress(UrdfsyncError):  # the working tree may have another fault than the commit
        ours = configuration.load(file) if judged else config
        robots = [robot for robot in ours.robots if robot.name in names]
        here = {result.robot: result for result in build(ours, robots, dry)}
        stale = [robot for robot in robots if not (here[robot.name].in_step or here[robot.name].failed)]
        if is_writing and stale:
            alone = msgspec.structs.replace(options, renews=False)
            built = {result.robot: result for result in build(ours, stale, alone)}
    for one in judged:
        yield one.reject(here.get(one.robot.name), built.get(one.robot.name), is_writing)


def _is_touched(commit: Commit, entries: Iterable[Entry], *folders: str) -> bool:
    """Return whether the commit changes a file that a build read or looked for, or that is in one of the folders.

    Without staged changes, by hand, or without a former commit, all robots count as touched.
    """
    if commit.changed is None or not (commit.changed or "GIT_INDEX_FILE" in os.environ):
        return True
    if any(PurePosixPath(path).name in _OF_ALL for path in commit.changed):
        return True
    return bool(_Places(commit.clone, entries).select(commit.changed, folders))


class _Places:
    """All that a build has read or looked for in a repository, as paths from the top."""

    def __init__(self, clone: Clone, entries: Iterable[Entry]) -> None:
        self.files, self._listings = set[str](), defaultdict[str, set[str]](set)  # kinds of listings by folder
        for kind, path in entries:
            inside = list(_trail(clone, path)) if kind not in (VARIABLE, UNMERGED) else ()
            self.files.update(inside)
            for folder in inside if kind.startswith(LISTINGS) else ():
                self._listings[folder].add(kind)
        # a link or a submodule may take the place of a folder
        self._around = {
            "/".join(path.split("/")[:depth]) for path in self.files for depth in range(path.count("/") + 1)
        }

    def select(self, changed: Mapping[str, PathChange], folders: tuple[str, ...] = ()) -> set[str]:
        """Return the changed paths that a build depends on."""
        return {
            path
            for path, change in changed.items()
            if path in self.files or path in self._around or path.startswith(folders) or self._is_listed(path, change)
        }

    def _is_listed(self, path: str, change: PathChange) -> bool:
        """Return whether a change adds a name to a listing of a folder, or takes one away."""
        folder, _, name = path.rpartition("/")
        kinds = self._listings.get(folder, ()) if change is not PathChange.CONTENT else ()
        return any(counting(kind, (name,), lambda _: change is PathChange.FOLDER) for kind in kinds)


def _trail(clone: Clone, path: str) -> Iterator[str]:
    """Yield the links on the way of a path, and at last the path without links, as in git, inside of the repository."""
    for _ in range(_MOST_LINKS):
        if (inside := clone.inside(path)) is None:
            return
        place = Path(clone.folder, inside)
        link = next((way for way in (*reversed(place.parents), place) if way.is_symlink()), None)
        if link is None:
            yield inside
            return
        yield link.relative_to(clone.folder).as_posix()
        target = Path(os.path.normpath(link.parent / link.readlink()))
        if target.is_relative_to(clone.folder):
            target = clone.top / target.relative_to(clone.folder)
        path = str(target / place.relative_to(link))


class _OutOfStepRobot:
    """A robot that is out of step in the clone."""

    def __init__(self, commit: Commit, config: Config, robot: RobotConfig, result: Result) -> None:
        self._commit, self._config, self.robot, self.result = commit, config, robot, result
        self._state = str(config.root / STATE_FOLDER)
        bases = Path(self._state, "bases", robot.name)
        folders = [str(folder) for folder in (robot.folder, bases, robot.templates) if folder]
        self.folders = tuple(f"{path}/" for folder in folders if (path := commit.clone.inside(folder)) is not None)

    def reject(self, here: Result | None, built: Result | None, is_writing: bool) -> Rejection:
        """Return the rejection; `here` is the result of a dry run in the working tree, `built` that of a build."""
        if built is None and here and here.in_step:
            return self._not_staged(here, is_writing)
        result = built or (here if is_writing and here and here.failed else self.result)
        if result.failed:
            message, hint = "the package can't be built", "correct the error, then commit again"
        elif result.conflicts or result.is_broken:
            verdict = out_of_step(result)
            message, hint = "the package is not in step", verdict.hint if verdict else ""
        elif built:
            index = git.Index()
            hint = _adding(self._find_missing(self._own_places(built), index), index, self.folders)
            message = "the package was out of step, and has been built"
        else:
            message, hint = "the package is out of step", "run `urdfsync hook build`, which says what to add"
        return self._reject("out-of-step", f"{message}: {result.summary}", hint, result)

    def _not_staged(self, here: Result, is_writing: bool) -> Rejection:
        """Return the rejection if only the working tree is in step."""
        index, result = git.Index(), here if is_writing else self.result
        own = self._own_places(here)
        hidden = own.select(dict.fromkeys(index.hidden, PathChange.FILE), self.folders)
        missing = self._find_missing(own, index)
        if hidden:
            message, hint = (
                f"git ignores changes of {', '.join(sorted(hidden))}",
                "`git help update-index` says how to undo this",
            )
            return self._reject("hidden", message, hint, result, is_enough=True)
        if missing:
            are = "is" if len(missing) == 1 else "are"
            message = f"the package is in step, but {counted(len(missing), 'file')} {are} not staged"
            hint = _adding(missing, index, self.folders)
            return self._reject("not-staged", message, hint, result, is_enough=True)
        message = "the package is in step here, but not in a clone"
        hint = "clone the repository, and run `urdfsync build --check` there"
        if nested := sorted(self._nested(own)):
            hint = f"commit the changes in {nested[0]}, make it a submodule, and `git add` it"
        return self._reject("out-of-step", f"{message}: {self.result.summary}", hint, result)

    def _own_places(self, here: Result) -> _Places:
        """Return all that a build in the working tree has read."""
        top = self._commit.repository.top
        return _Places(Clone(top, top), here.reads)

    def _find_missing(self, own: _Places, index: git.Index) -> set[str]:
        """Return the files to add to the commit: those that differ in the index, and that a build depends on."""
        top = Path(self._commit.repository.top)
        cloned = _Places(self._commit.clone, self.result.reads)
        unstaged = dict.fromkeys(index.unstaged, PathChange.FILE)
        untracked = dict.fromkeys(index.untracked, PathChange.CONTENT)  # only those that the build reads
        found = {path for places in (own, cloned) for path in places.select(unstaged, self.folders)} | own.select(
            untracked
        )
        # of ignored files, only those that the build reads
        nested = tuple(f"{path}/" for path in self._nested(own))
        unknown = {path for path in own.files - index.tracked - index.untracked if not path.startswith(nested)}
        found |= {path for path in unknown if (top / path).is_file()}
        return {
            path
            for path in found
            if (self._is_for_git(path) and not (top / path / ".git").exists()) or path in index.tracked
        }

    def _nested(self, own: _Places) -> set[str]:
        """Return the submodules and other repositories that a build in the working tree reads."""
        folders = {str(folder) for path in own.files for folder in PurePosixPath(path).parents[:-1]}
        return {folder for folder in folders if Path(self._commit.repository.top, folder, ".git").exists()}

    def _is_for_git(self, path: str) -> bool:
        """Return whether a file belongs into a commit: parts of the recorded state and the user's models do not."""
        place = placed(f"{self._commit.repository.top}{os.sep}", path)
        if place.startswith(f"{self._state}{os.sep}"):
            return place.removeprefix(f"{self._state}{os.sep}").startswith(_COMMITTED)
        return not path.endswith(".mo") or path.startswith(self.folders) or path in self._commit.files

    def _reject(self, code: str, message: str, hint: str, result: Result, *, is_enough: bool = False) -> Rejection:
        message, place = f"robot `{self.robot.name}`: {message}", shown(self._config.file)
        return Rejection(Diagnostic(Severity.ERROR, code, message, place, hint=hint), result, is_enough)


def _adding(paths: Collection[str], index: git.Index, folders: Sequence[str] = ()) -> str:
    """Return a hint with the command that adds files to the commit, from any folder of the repository."""
    names = set(paths)
    ignored = names - index.tracked - index.untracked
    for folder in folders if len(names) > _FEW and not ignored else ():
        inside = {path for path in index.unstaged | index.untracked if path.startswith(folder)}
        if len(inside) > 1 and inside <= names:  # then name the whole folder
            names = names - inside | {folder.removesuffix("/")}
    # to git `:/` means the top, from any folder; after a second colon, a name may begin with a special sign
    from_top = [f":/{'' if name[0].isalnum() or name[0] == '.' else ':'}{name}" for name in sorted(names)]
    command = system.join_words(["git", "add", *(["-f"] if ignored else []), *from_top])
    return f"run `{command}`, then commit again"
