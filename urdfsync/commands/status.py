"""`urdfsync status`: says of each file whether it is in step, from the plan of a build that writes nothing."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterator
from typing import Any

from urdfsync.commands import arguments
from urdfsync.engine.actions import Action, FileStatus, Kind, Reason
from urdfsync.engine.build import build
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.output.conflicts import describe, find_conflicts, settle_hint, shown_path
from urdfsync.output.console import Console, StyledLine, first_lines, line
from urdfsync.output.phrases import (
    BROKEN,
    NOT_EXPANDED,
    action_counts,
    change_counts,
    counted,
    error_count,
    generator_change,
)
from urdfsync.output.phrases import reason as reason_of
from urdfsync.output.repeated import show_findings
from urdfsync.output.results import action_values, file_line, headline, result_values

_INPUTS = 5
"""So many inputs that changed are named at most, without --verbose."""
_STALE = 20
"""So many stale files of a robot are listed at most, without --verbose."""


_QUIET = (Reason.UNCHANGED, Reason.KEEP)
"""Actions of which the status says all."""
_STYLES = {
    FileStatus.CONFLICT: "bold red",
    FileStatus.MISSING: "red",
    FileStatus.STALE: "yellow",
    FileStatus.EDITED: "cyan",
    FileStatus.ORPHAN: "magenta",
    FileStatus.IN_STEP: "green",
}


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    arguments.add_command(
        commands,
        "status",
        run,
        "robots --robot --wait",
        help="say which files are stale, edited, missing or in conflict",
        description="Say of each file whether it is in step, stale, edited, missing, an orphan or in conflict. "
        "Nothing is written.",
        epilog="example: urdfsync status arm --verbose\n\n"
        "exit codes: 0 in step, 1 out of step or broken, 2 error, 3 conflict, 4 another build is running, "
        "130 interrupted",
    )


def run(args: argparse.Namespace, console: Console) -> Exit:
    """Show how each robot's package stands."""
    configuration = arguments.configuration(args)
    robots = arguments.select_robots(args, configuration, console)
    results = []
    for result in build(configuration, robots, arguments.request(args, console, dry=True, expands=False)):
        results.append(result)
        if console.json:
            console.add_robot(_values(result))
            continue
        show_findings(console, result)
        console.stop_progress()
        if not console.quiet or result.conflicts or result.is_broken:
            console.print(lines(result, console.verbose), error=result.failed)
    code = exit_code(results, check=True)
    console.end("status", code)
    return code


def is_built(result: Result) -> bool:
    """Whether a build has written any file of the package, its record lost or not."""
    return any(action.base is not None or action.reason is Reason.ADOPT for action in result.actions)


def _path(action: Action) -> str:
    """Where the user's file is: that of a conflict may wait for its new name."""
    return action.origin or action.path if action.kind is Kind.CONFLICT else action.path


def _reason(action: Action, result: Result) -> str:
    return "" if action.reason in _QUIET and not action.held else reason_of(action, result.effective_changes)


def _values(result: Result) -> dict[str, Any]:
    """The robot in the JSON document."""
    values = result_values(result)
    actions = sorted((one for one in result.actions if one.reason.status), key=_path)
    extra = {
        "built": is_built(result),
        "in_step": result.in_step,
        "summary": summary(result),
        "not_expanded": list(result.stale),
        "files": [
            {
                **action_values(action),
                "path": _path(action),
                "status": action.reason.status,
                "text": _reason(action, result),
            }
            for action in actions
        ],
    }
    keys = ("name", "package", "folder", "failed", "locked", "class", "changes", "diagnostics")
    return {**{key: values[key] for key in keys}, **extra}


def lines(result: Result, verbose: bool) -> Iterator[StyledLine]:
    """Everything that there is to say about one robot: with `verbose` all files, else those that are not in step.

    Stale files come last. New files of a robot that was never built are not named.
    """
    yield headline(result, summary(result), is_fine=result.in_step)
    if result.stale:
        yield from first_lines([line((f"  {name}", "")) for name in result.stale], _INPUTS, "input", verbose=verbose)
    changes = result.effective_changes
    if changes and changes.generator:
        yield line((f"  {generator_change(changes)}", ""))
    elif changes:
        yield line((f"  {change_counts(changes)} in the source", ""))
    if (actions := action_counts(result, {Reason.KEEP})) and not (result.in_step or result.failed):
        yield line((f"  next build: {', '.join(actions)}", ""))
    found: dict[bool, list[StyledLine]] = {False: [], True: []}
    disputed = {one.action.path: describe(one) for one in find_conflicts([result])}
    has_package = is_built(result)
    for action in sorted(result.actions, key=lambda action: _path(action).rpartition("/")):
        status = action.reason.status
        is_stale = status is FileStatus.STALE
        is_listed = verbose or (status is not FileStatus.IN_STEP and (has_package or not is_stale))
        if status and is_listed:
            path = shown_path(result, _path(action))
            found[is_stale].append(
                file_line(path, status, _STYLES[status], disputed.get(action.path) or _reason(action, result))
            )
    yield from (*found[False], *first_lines(found[True], _STALE, "stale file", verbose=verbose))
    if result.conflicts:
        adopts = f"  `urdfsync adopt {result.robot}` takes these files for your edits"
        yield line((settle_hint(result) if is_built(result) else adopts, "dim"))


def summary(result: Result) -> str:
    """How a package stands, as the rest of a line that names the robot."""
    if result.failed:
        return f"{error_count(result.diagnostics)}, so its files were not compared"
    if result.stale and not result.actions:
        return "not expanded, so its files were not compared"
    counts = Counter(filter(None, (action.reason.status for action in result.actions)))
    told = {status: counts[status] for status in FileStatus if counts[status] and status is not FileStatus.IN_STEP}
    stand = "in step" if result.in_step else NOT_EXPANDED if result.stale else "out of step"
    stand = BROKEN if result.is_broken else stand
    head = f"{stand}, {counted(counts.total(), 'file')}"
    if not (is_built(result) or result.in_step):
        head = "not built yet"
        told.pop(FileStatus.STALE, None)
    nouns = (FileStatus.CONFLICT, FileStatus.ORPHAN)
    tally = [counted(number, one) if one in nouns else f"{number} {one}" for one, number in told.items()]
    return f"{head}{': ' if tally else ''}{', '.join(tally)}"
