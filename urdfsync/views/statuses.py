"""How the state of a robot's files looks, line by line."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import IO

from urdfsync import wording
from urdfsync.config import shown
from urdfsync.status import FileState, FileStatus, RobotState
from urdfsync.views.terminal import Words, has_marks, is_terminal, words

_STYLES = {
    FileStatus.CONFLICT: "bold red",
    FileStatus.MISSING: "red",
    FileStatus.STALE: "yellow",
    FileStatus.EDITED: "cyan",
    FileStatus.ORPHAN: "magenta",
    FileStatus.IN_STEP: "green",
}
_STALE = 20
"""So many stale files of a robot are listed at most, unless somebody asks."""
_WORDS = max(map(len, FileStatus))
_NAMES = 40
"""Longer names are not waited for: the reason moves to the right."""
_ADVICE = "  settle a conflict with `urdfsync resolve FILE --keep` (or --take, --merge)"


def has_more(found: RobotState, verbose: bool) -> bool:
    """Whether there is more to show than a headline that all is in step."""
    return verbose or not found.in_step or bool(found.result.changes or _listed(found, verbose=verbose))


def lines(found: RobotState, stream: IO[str], verbose: bool) -> Iterator[Words]:
    """Everything that there is to say about one robot: with `verbose` all files, else those that are not in step."""
    yield _headline(found, stream)
    yield from (words((f"  {line}", "")) for line in wording.outlook(found))
    files = _listed(found, verbose)
    yield from _by_folder(found, files) if is_terminal(stream) else _one_by_one(found, files)
    hidden = found.counts.get(FileStatus.STALE, 0) - sum(file.status is FileStatus.STALE for file in files)
    if hidden and found.built:
        yield words((f"  … and {hidden} more stale files; --verbose shows them", "dim"))
    if found.result.conflicts:
        yield words((_ADVICE, "dim"))


def _headline(found: RobotState, stream: IO[str]) -> Words:
    if found.result.failed:
        mark, style = "✗", "bold red"
    else:
        mark, style = ("✓", "green") if found.in_step else ("!", "bold red" if found.result.conflicts else "yellow")
    marks = [(f"{mark} ", style)] if has_marks(stream) else []
    return words(*marks, (found.result.robot, "bold"), (f": {wording.state(found)}", ""))


def _listed(found: RobotState, verbose: bool) -> Sequence[FileState]:
    """The files to name, those of a folder in succession; of a robot that was never built, no new ones."""
    files = sorted(found.files, key=lambda file: file.path.rpartition("/"))
    if verbose:
        return files
    stale = [file for file in files if file.status is FileStatus.STALE]
    few = 0 if not found.built else len(stale) if len(stale) <= _STALE else _STALE - 1
    left_out = {file.path for file in stale[few:]}
    return [file for file in files if file.status is not FileStatus.IN_STEP and file.path not in left_out]


def _by_folder(found: RobotState, files: Sequence[FileState]) -> Iterator[Words]:
    folder = None
    width = min(_NAMES, max((len(file.path.rpartition("/")[2]) for file in files), default=0))
    for file in files:
        place = _place(found, file)
        if place.parent != folder:
            folder = place.parent
            yield words((f"  {folder}/", "bold blue"))
        yield _line("    ", file, f"{place.name:<{width}}")


def _one_by_one(found: RobotState, files: Sequence[FileState]) -> Iterator[Words]:
    return (_line("  ", file, str(_place(found, file))) for file in files)


def _line(indent: str, file: FileState, name: str) -> Words:
    word = (f"{indent}{file.status:<{_WORDS}}  ", _STYLES[file.status])
    return words(word, (name, ""), (f"  {file.reason}", "dim")) if file.reason else words(word, (name.rstrip(), ""))


def _place(found: RobotState, file: FileState) -> Path:
    return Path(shown(Path(os.path.normpath(found.result.root / file.path))))
