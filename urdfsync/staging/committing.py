"""A commit as a whole: which configurations it concerns, how they are judged, and what is said of them."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from urdfsync.config import FILE_NAME, STATE_FOLDER, shown, working_folder
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.options import BuildOptions
from urdfsync.outcome import Exit, exit_code
from urdfsync.report import Report
from urdfsync.staging.judging import Judge
from urdfsync.staging.staged import Index
from urdfsync.staging.verdict import Verdict
from urdfsync.views import hooks
from urdfsync.watch import precommit

_ROBOTS = f"{STATE_FOLDER}/robots/"


def run(request: BuildOptions, writing: bool, named: Sequence[Path], report: Report, as_json: bool) -> Exit:
    """Judge the configurations that are `named`, or all that git tracks; `writing` brings packages in step.

    Raises UrdfsyncError if git can't be asked.
    """
    folder = working_folder()
    index = Index(folder)
    paths, diagnostics = _configurations(index, named)
    judge = Judge(index, folder, request, writing, _aside(index))
    verdicts: list[Verdict] = []
    for path in paths:
        try:
            verdicts += judge.verdicts(path)
        except UrdfsyncError as error:
            diagnostics += error.diagnostics
    code = exit_code([verdict.result for verdict in verdicts if verdict.result])
    code = Exit.ERROR if diagnostics else code or (Exit.OUT_OF_STEP if verdicts else Exit.IN_STEP)
    for verdict in verdicts:
        if verdict.result and (as_json or verdict.troubled):
            report.result(verdict.result)
    if verdicts:
        diagnostics += _show(verdicts, Index(folder), folder, as_json)
    report.problems("hook", diagnostics, code)
    return code


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


def _show(verdicts: Sequence[Verdict], index: Index, folder: Path, as_json: bool) -> list[Diagnostic]:
    """Show the verdicts to people; for programs, give them as findings."""
    ignored = index.ignored({path for verdict in verdicts for path in verdict.add if not index.tracks(path)})
    place = hooks.Place(index.top, _typing(index.top, folder, os.environ), index.pending)
    if not as_json:
        sys.stdout.writelines(f"{line}\n" for line in hooks.lines(verdicts, place, ignored))
        return []
    found = []
    for verdict in verdicts:
        message = f"robot `{verdict.robot}`: {hooks.words(verdict, place)}"
        hint = "; ".join(f"`{command}`" for _, command in hooks.steps([verdict], place, ignored))
        code = "out-of-step" if verdict.result else "not-staged"
        found.append(Diagnostic(Severity.ERROR, code, message, place.shown(verdict.config), hint=hint))
    return found


def _typing(top: Path, folder: Path, environment: Mapping[str, str]) -> Path:
    """The folder in which the user has called git or pre-commit, as far as these tell."""
    if "GIT_PREFIX" in environment:
        return top / environment["GIT_PREFIX"]
    shell = Path(os.path.realpath(environment.get("PWD") or folder))
    return shell if "PRE_COMMIT" in environment and shell.is_relative_to(top) else folder
