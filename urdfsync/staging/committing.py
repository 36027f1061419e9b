"""A commit as a whole: which configurations it concerns, and how they are judged."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from urdfsync.config import FILE_NAME, STATE_FOLDER, shown
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.options import BuildOptions
from urdfsync.staging.judging import Judge
from urdfsync.staging.staged import Index
from urdfsync.staging.verdict import Verdict
from urdfsync.watch import precommit

_ROBOTS = f"{STATE_FOLDER}/robots/"


def judge(
    index: Index, folder: Path, request: BuildOptions, writing: bool, named: Sequence[Path]
) -> tuple[list[Verdict], list[Diagnostic]]:
    """Judge the configurations that are `named`, or all that git tracks; `writing` brings packages in step.

    Returns the faults of robots, and those of configurations. Raises UrdfsyncError if git can't be asked.
    """
    paths, diagnostics = _configurations(index, named)
    judge = Judge(index, folder, request, writing, _aside(index))
    verdicts: list[Verdict] = []
    for path in paths:
        try:
            verdicts += judge.verdicts(path)
        except UrdfsyncError as error:
            diagnostics += error.diagnostics
    return verdicts, diagnostics


def _configurations(index: Index, named: Sequence[Path]) -> tuple[list[str], list[Diagnostic]]:
    """The configurations to judge, by their paths in the repository, and what is wrong with the choice."""
    if named:
        paths = {file: index.path(file.absolute()) for file in named}
        lost = [file for file, path in paths.items() if path is None or not index.tracks(path)]
        return [path for file, path in paths.items() if path and file not in lost], [_untracked(file) for file in lost]
    found = index.named(FILE_NAME)
    folders = {path.removesuffix(FILE_NAME) for path in found}
    states = (path for path in index.below("") if path.endswith(".toml") and f"/{path}".count(f"/{_ROBOTS}") == 1)
    lost_states = [path for path in states if path.rpartition(_ROBOTS)[0] not in folders]
    return found, [_abandoned(path) for path in lost_states[:1]]


def _untracked(file: Path) -> Diagnostic:
    message, hint = "git does not track this configuration", f"add it with `git add {file}`"
    return Diagnostic(Severity.ERROR, "untracked-config", message, shown(file), hint=hint)


def _abandoned(path: str) -> Diagnostic:
    file = f"{path.rpartition(_ROBOTS)[0]}{FILE_NAME}"
    message = f"its configuration {file} is not part of the commit"
    hint = f"add it with `git add {file}`; if it has another name, give that to the hook as an argument"
    return Diagnostic(Severity.ERROR, "untracked-config", message, path, hint=hint)


def _aside(index: Index) -> frozenset[str]:
    """The files of which pre-commit has stashed changes, to bring them back after us."""
    store = precommit.store_folder(os.environ, Path.home())
    holder = precommit.PrecommitStash(store).holder(index.top)
    patches = sorted(store.glob(f"patch*-{holder}")) if holder is not None else []
    return frozenset(index.patched(patches[-1])) if patches else frozenset()
