"""`urdfsync status`: says of each file whether it is in step, from the plan of a build that writes nothing."""

from __future__ import annotations

import argparse
import enum
import sys
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any

import msgspec

from urdfsync.commands import arguments
from urdfsync.config import shown
from urdfsync.diagnostics import Severity
from urdfsync.engine.actions import DELETES, Action, Kind
from urdfsync.engine.build import build
from urdfsync.outcome import Exit, Result, exit_code
from urdfsync.output.conflicts import shown_path
from urdfsync.output.console import Console, StyledLine, first_lines, headline, line
from urdfsync.output.json_values import action_values, result_values
from urdfsync.output.phrases import RESOLVE_HINT, change_classes, counted, error_count, generator_change
from urdfsync.output.results import file_line

_STALE = 20
"""So many stale files of a robot are listed at most, without --verbose."""


class FileStatus(enum.StrEnum):
    """How a file stands, what asks for most attention first."""

    CONFLICT = "conflict"
    """The user and urdfsync want different things of it."""
    MISSING = "missing"
    """It was written and somebody deleted it."""
    STALE = "stale"
    """The next build writes or deletes it."""
    EDITED = "edited"
    """The user changed it, and there is nothing new for it."""
    ORPHAN = "orphan"
    """Nothing generates it any longer, and it stays because it is the user's or something of the user's needs it."""
    IN_STEP = "in step"


_STATUSES: Mapping[Kind, tuple[FileStatus, str]] = {
    Kind.UNCHANGED: (FileStatus.IN_STEP, ""),
    Kind.ADOPT: (FileStatus.IN_STEP, "as wanted; not recorded yet"),
    Kind.CREATE: (FileStatus.STALE, "to be created"),
    Kind.UPDATE: (FileStatus.STALE, "to be updated"),
    Kind.DELETE: (FileStatus.STALE, "to be deleted"),
    Kind.MERGE: (FileStatus.STALE, "to be updated, your edits stay"),
    Kind.MOVE: (FileStatus.STALE, "renamed, your edits move here"),
    Kind.LEAVE: (FileStatus.STALE, "renamed, your edits move away"),
    Kind.RESTORE: (FileStatus.MISSING, "deleted, to be written again"),
    Kind.KEEP: (FileStatus.EDITED, ""),
    Kind.INCLUDED: (FileStatus.EDITED, "already has what is new"),
    Kind.CONFLICT: (FileStatus.CONFLICT, "edited and stale"),
    Kind.UNOWNED: (FileStatus.CONFLICT, "not written by urdfsync"),
    Kind.ORPHAN: (FileStatus.ORPHAN, "edited, no longer generated"),
    Kind.NEEDED: (FileStatus.ORPHAN, "needed by yours, no longer generated"),
}
"""Status and reason by what a build would do; FORGET is left out, since its file is gone for good."""

_STYLES = {
    FileStatus.CONFLICT: "bold red",
    FileStatus.MISSING: "red",
    FileStatus.STALE: "yellow",
    FileStatus.EDITED: "cyan",
    FileStatus.ORPHAN: "magenta",
    FileStatus.IN_STEP: "green",
}


class StatusEntry(msgspec.Struct, frozen=True):
    """How one file stands, and why; the reason is empty if there is nothing to say."""

    path: str
    """Where it is or will be, as in the manifest: relative to the configuration's folder, with `/`."""
    status: FileStatus
    reason: str
    action: Action
    """What a build would do."""


class PackageStatus(msgspec.Struct, frozen=True):
    """How one robot's package stands, from the `result` of a dry build; its files are in the order of their paths."""

    result: Result
    files: tuple[StatusEntry, ...] = ()

    @property
    def is_built(self) -> bool:
        """Whether a build has written any of it."""
        return any(file.action.base is not None for file in self.files)

    @property
    def in_step(self) -> bool:
        """Whether a build would write nothing, and no file is in conflict; edits and orphans are in order."""
        off = {FileStatus.CONFLICT, FileStatus.MISSING, FileStatus.STALE}
        return not self.result.failed and all(file.status not in off for file in self.files)


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    arguments.add_command(
        commands,
        "status",
        run,
        "robots --robot --wait --profile",
        help="say which files are stale, edited, missing or in conflict",
        description="Say of each file whether it is in step, stale, edited, missing, an orphan or in conflict. "
        "Nothing is written.",
        epilog="example: urdfsync status arm --verbose\n\n"
        "exit codes: 0 it is told, in step or not; 2 error, 3 conflict, 4 locked, 130 interrupted",
    )


def run(args: argparse.Namespace, console: Console) -> Exit:
    """Show how each robot's package stands."""
    configuration = arguments.configuration(args)
    robots = arguments.select_robots(args, configuration, console)
    sources = {robot.name: shown(robot.source) for robot in robots}
    results = []
    for result in build(configuration, robots, arguments.request(args, console, dry=True)):
        _show(console, package_status(result), sources[result.robot])
        results.append(result)
    code = exit_code(results)
    console.end("status", code)
    return code


def package_status(result: Result) -> PackageStatus:
    """How a robot's package stands, from the result of a dry build."""
    mergeable = {found.path for found in result.conflict_texts if found.merge and found.merge.text is not None}
    files = []
    for action in result.actions:
        if action.kind not in _STATUSES:
            continue
        status, reason = _STATUSES[action.kind]
        is_conflict = status is FileStatus.CONFLICT
        reason += "; can be merged" if is_conflict and action.path in mergeable else ""
        reason += ", waits" if action.held else ""
        path = action.origin if is_conflict and action.origin is not None else action.path
        files.append(StatusEntry(path, status, reason, action))
    return PackageStatus(result, tuple(sorted(files, key=lambda file: file.path)))


def _show(console: Console, found: PackageStatus, source: str) -> None:
    result = found.result
    if console.json:
        console.add_robot(_values(found))
        return
    # Warnings about the source are for whoever builds it.
    told = [one for one in result.diagnostics if one.file != source or one.severity is Severity.ERROR]
    console.findings(result.diagnostics if console.verbose else told)
    console.stop_progress()
    if not console.quiet or result.conflicts:
        console.print(_lines(found, console.verbose), error=result.failed)


def _values(found: PackageStatus) -> dict[str, Any]:
    """The robot in the JSON document."""
    values = result_values(found.result)
    files = [
        {**action_values(file.action), "path": file.path, "status": file.status, "reason": file.reason}
        for file in found.files
    ]
    return {
        **{key: values[key] for key in ("name", "package", "folder", "failed", "locked")},
        "built": found.is_built,
        "in_step": found.in_step,
        "summary": summary(found),
        **{key: values[key] for key in ("class", "changes")},
        "files": files,
        "diagnostics": values["diagnostics"],
    }


def _lines(found: PackageStatus, verbose: bool) -> Iterator[StyledLine]:
    """Everything that there is to say about one robot: with `verbose` all files, else those that are not in step.

    Stale files come last. New files of a robot that was never built are not named.
    """
    result = found.result
    mark, style = ("✓", "green") if found.in_step else ("!", "bold red" if result.conflicts else "yellow")
    mark, style = ("✗", "bold red") if result.failed else (mark, style)
    yield headline(sys.stderr if result.failed else sys.stdout, result.robot, summary(found), mark, style)
    yield from (line((f"  {words}", "")) for words in next_build(found))
    lines: dict[bool, list[StyledLine]] = {False: [], True: []}
    for file in sorted(found.files, key=lambda file: file.path.rpartition("/")):
        is_stale = file.status is FileStatus.STALE
        if verbose or (file.status is not FileStatus.IN_STEP and (found.is_built or not is_stale)):
            path = shown_path(result, file.path)
            lines[is_stale].append(file_line(path, file.status, _STYLES[file.status], file.reason))
    yield from (*lines[False], *first_lines(lines[True], _STALE, "stale file", verbose=verbose))
    if result.conflicts:
        yield line((RESOLVE_HINT, "dim"))


def summary(found: PackageStatus) -> str:
    """How a package stands, as the rest of a line that names the robot."""
    if found.result.failed:
        return f"{error_count(found.result.diagnostics)}, so nothing can be said of its files"
    counts = Counter(file.status for file in found.files)
    told = {status: counts[status] for status in FileStatus if counts[status] and status is not FileStatus.IN_STEP}
    head = f"{'in' if found.in_step else 'out of'} step, {counted(len(found.files), 'file')}"
    if not (found.is_built or found.in_step):
        head = "not built yet"
        told.pop(FileStatus.STALE, None)
    nouns = (FileStatus.CONFLICT, FileStatus.ORPHAN)
    tally = [counted(number, one) if one in nouns else f"{number} {one}" for one, number in told.items()]
    return f"{head}{': ' if tally else ''}{', '.join(tally)}"


def next_build(found: PackageStatus) -> list[str]:
    """What a robot waits for and what the next build does about it, in a line or two; nothing if nothing is due."""
    changes, changed = found.result.changes, ""
    if changes and changes.generator:
        changed = generator_change(changes)
    elif changes:
        changed = f"{change_classes(changes)} in the source{' (rounding)' if changes.noise else ''}"
    actions = found.result.actions.decided
    moving = [action for action in actions if action.writes]
    deleted = sum(action.kind in DELETES for action in moving)
    does = [f"writes {counted(len(moving) - deleted, 'file')}"] if len(moving) > deleted else []
    does += [f"deletes {deleted if does else counted(deleted, 'file')}"] if deleted else []
    build = f"`urdfsync build` {' and '.join(does)}" if does else ""
    held = sum(action.held for action in actions)
    if not held:
        return ["; ".join(filter(None, [changed, build]))] if changed or build else []
    waits = f"{counted(held, 'file')} {'waits' if held == 1 else 'wait'} for the conflict"
    return [*([changed] if changed else []), "; ".join(filter(None, [build, waits]))]
