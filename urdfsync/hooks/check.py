"""Checks what is being committed: staged sources against staged outputs. Builds where that is wanted and safe.

A robot is planned in the working tree if that has what is staged of it, else in a checkout of the index. A build
writes only for robots whose sources are staged as they are, and whose files pre-commit has not stashed changes of.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync import config as configuration
from urdfsync import precommit, uptodate
from urdfsync.config import FILE_NAME, Config, RobotConfig
from urdfsync.dependencies import Dependencies
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.actions import IN_STEP, Action
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.files import shown
from urdfsync.hooks.answers import STATES, answer_key, find_configurations
from urdfsync.hooks.checkout import plan_index
from urdfsync.hooks.index import Index
from urdfsync.hooks.robot_files import RobotFiles


class CommitFault(msgspec.Struct, frozen=True):
    """What is wrong with one robot in what is being committed. Files are paths from the top of the repository."""

    files: RobotFiles
    to_add: tuple[str, ...] = ()
    """The files that have to be staged, after a build if one is needed."""
    result: Result | None = None
    """What a build did, or would do if it is a dry one; None if the working tree needs none."""
    unstaged: tuple[str, ...] = ()
    """Files with changes that are not staged, which keep a build from writing."""

    @property
    def needs_build(self) -> bool:
        """Whether the package has to be built before files are staged."""
        return self.result is not None and self.result.dry

    @property
    def needs_user(self) -> bool:
        """Whether a build is not enough: it fails, or ends in a conflict."""
        return self.result is not None and (self.result.failed or bool(self.result.conflicts))


def check_index(
    index: Index, options: BuildOptions, writing: bool, named: Sequence[Path]
) -> tuple[list[CommitFault], list[Diagnostic]]:
    """Check the configurations that are `named`, or all that git tracks; `writing` allows builds.

    Returns the faults of robots, and findings about whole configurations. Raises UrdfsyncError if git fails.
    """
    files, diagnostics = _find_configurations(index, named)
    stash = precommit.find_stash(index.top)
    stashed = index.patched(stash[0]) if stash else set()  # changes that pre-commit brings back after the hooks
    faults: list[CommitFault] = []
    for file in files:
        try:
            with Dependencies() as dependencies:
                found = _check_configuration(index, file, options, writing, stashed)
        except UrdfsyncError as error:
            diagnostics += error.diagnostics
            continue
        faults += found
        if not found and not index.changed:  # a commit passes while what was read, and is tracked, stays as it is
            here, top = Path.cwd(), f"{index.top.as_posix()}/"
            read = {(here / path).as_posix().removeprefix(top) for _, path in dependencies.entries}
            key = answer_key(str(index.top), str(file))
            uptodate.save_answer(str(file), key, sorted(filter(index.tracks, read)), dependencies)
    return faults, diagnostics


def _check_configuration(
    index: Index, file: Path, options: BuildOptions, writing: bool, stashed: Collection[str]
) -> list[CommitFault]:
    """Return the faults of the robots of one configuration. Raises UrdfsyncError if that can't be read.

    `stashed` are files of which pre-commit will bring back changes.
    """
    # not told of outputs elsewhere: a checkout of the index is in another folder than the configuration
    dry = msgspec.structs.replace(options, dry=True, compares_state=True, trusted=True)
    config, staged, unstaged = _plan_differing(index, file, dry)
    same = [robot for robot in config.robots if not unstaged[robot.name]]
    on_disk = {result.robot: result for result in build(config, same, dry)}
    faults: dict[str, CommitFault] = {}
    to_build: list[RobotConfig] = []
    for robot in config.robots:
        files, result, here = RobotFiles(index, config, robot), staged.get(robot.name), on_disk.get(robot.name)
        if result is not None and not _needs_build(result):  # what is staged is in step, the working tree differs
            fault = CommitFault(files, index.unstaged(files.untracked_sources()))
        elif result is not None and here is None:  # a build of the working tree would not fit the staged source
            fault = CommitFault(files, files.to_stage(result.actions), result, tuple(sorted(unstaged[robot.name])))
        elif here is not None and not _needs_build(here):  # built already, perhaps not staged
            add = index.unstaged(files.needed(_work(result) if result else here.actions))
            fault = CommitFault(files, add, None if add else result)
        else:
            blocking = _find_blocking(index, files, writing, stashed, dry)
            planned = result or on_disk[robot.name]
            fault = CommitFault(files, files.to_stage(planned.actions), planned, tuple(sorted(blocking)))
            if writing and not blocking:
                to_build.append(robot)
        faults[robot.name] = fault
    if to_build:
        faults |= _build(index, config, to_build, options, staged)
    return [fault for fault in faults.values() if fault.to_add or fault.result]


def _plan_differing(
    index: Index, file: Path, dry: BuildOptions
) -> tuple[Config, dict[str, Result], dict[str, set[str]]]:
    """Plan the robots of which the working tree does not have what is staged, in a checkout of the index.

    Returns the staged configuration, and by robot the results and the inputs with changes that are not staged.
    """
    path = file.relative_to(index.top).as_posix()
    if path in index.changed:
        config, staged = plan_index(index, file, dry)
        return config, staged, {robot.name: {path} for robot in config.robots}
    config = configuration.load(file)
    inputs: dict[str, set[str]] = {}
    differing = []
    for robot in config.robots:
        files = RobotFiles(index, config, robot)
        inputs[robot.name] = files.find_inputs(index.changed, dry)
        if inputs[robot.name] or files.find_outputs(index.changed):
            differing.append(robot.name)
    return config, plan_index(index, file, dry, differing)[1] if differing else {}, inputs


def _build(
    index: Index, config: Config, robots: Sequence[RobotConfig], options: BuildOptions, staged: Mapping[str, Result]
) -> dict[str, CommitFault]:
    """Build robots in the working tree; return what has to be staged then."""
    faults = {}
    results = list(build(config, robots, options))
    now = Index(index.folder)
    for robot, result in zip(robots, results, strict=True):
        files, before = RobotFiles(now, config, robot), staged.get(robot.name)
        add = now.unstaged(files.needed(_work(before) if before else result.actions))
        if not all(map(index.tracks, files.state)):  # the robot may have had another name: its old state is gone
            former = {path for path in now.changed - index.changed if path.rpartition("/")[0] in files.folders}
            add = tuple(dict.fromkeys([*add, *sorted(former)]))
        is_fine = exit_code([result]) is Exit.IN_STEP and not add
        faults[robot.name] = CommitFault(files, add, before if is_fine else result)
    return faults


def _needs_build(result: Result) -> bool:
    """Return whether a build would change files or what is recorded of them."""
    return not result.in_step or result.renews_state


def _work(result: Result) -> list[Action]:
    """Return the actions on files that are not as they should be."""
    return [action for action in result.actions if action.kind not in IN_STEP]


def _find_blocking(
    index: Index, files: RobotFiles, writing: bool, stashed: Collection[str], dry: BuildOptions
) -> set[str]:
    """Return the stashed files that keep a build from writing: pre-commit could not bring back their changes.

    If it can't, it takes all tracked files back to what is staged. A state that is not tracked would stay behind alone.
    """
    if not stashed:
        return set()
    found = files.find_inputs(stashed, dry)
    if writing:
        found |= files.find_outputs(stashed)
        if any(map(index.below, index.paths([files.robot.folder]))):
            found |= {path for path in files.state if not index.tracks(path)}
    return found


def _find_configurations(index: Index, named: Sequence[Path]) -> tuple[list[Path], list[Diagnostic]]:
    """Return the configurations to check, and what is wrong with the choice."""
    diagnostics = []
    if not named:
        found, lost_states = find_configurations(index.below(""))
        for path in lost_states[:1]:
            file = f"{path.rpartition(STATES)[0]}{FILE_NAME}"
            message = f"its configuration {file} is not part of the commit"
            hint = f"add it with `git add {file}`; if it has another name, give that to the hook as an argument"
            diagnostics.append(Diagnostic(Severity.ERROR, "untracked-config", message, path, hint=hint))
        return [index.top / path for path in found], diagnostics
    files = []
    for named_file in named:
        tracked = index.path(named_file.absolute())
        if tracked is not None and index.tracks(tracked):
            files.append(index.top / tracked)
        else:
            message, hint = "git does not track this configuration", f"add it with `git add {named_file}`"
            diagnostics.append(Diagnostic(Severity.ERROR, "untracked-config", message, shown(named_file), hint=hint))
    return files, diagnostics
