"""`urdfsync diff`: shows what changed since the last build, or between two versions of a source."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from urdfsync import config
from urdfsync.commands import arguments
from urdfsync.config import Config
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.diff import comparison
from urdfsync.diff.comparison import Comparison
from urdfsync.domain import ChangeKind
from urdfsync.engine.actions import Kind, Reason
from urdfsync.engine.findings import CONNECTORS
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Exit
from urdfsync.output.conflicts import settle_hint, shown_path
from urdfsync.output.console import Console, StyledLine, first_lines, line
from urdfsync.output.outline import OutlineRow, effect_rows, outline
from urdfsync.output.phrases import change_counts, counted, error_count, generator_change
from urdfsync.output.phrases import summary as build_summary
from urdfsync.output.repeated import show_findings
from urdfsync.output.results import action_word, file_line, headline, result_values

_STYLES = {ChangeKind.ADDED: "green", ChangeKind.REMOVED: "red", ChangeKind.RENAMED: "cyan"}
_WIDEST = 44
"""Longer labels push their values to the right."""
_CHANGES, _FILES, _EFFECTS = 60, 12, 8
"""So many lines of changes, files and effects are listed at most, without --verbose."""
_SILENT = frozenset({Reason.UNCHANGED, Reason.KEEP, Reason.FORGET})


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "diff",
        run,
        "--robot --wait",
        help="show what changed in the sources since the last build",
        description="Show what changed in a source since the last build, or since another version of it: by element, "
        "with what follows for the whole model and for the files of the package. Nothing is written.",
        epilog="examples: urdfsync diff cad/arm.urdf\n"
        "          urdfsync diff arm --against HEAD~1\n"
        "          urdfsync diff cad/arm.urdf --against old/arm.urdf\n"
        "          urdfsync diff --edits modelica/Arm/Links\n\n"
        "exit codes: 0 both give the same package, 1 they do not, 2 error, 4 another build is running, 130 interrupted",
    )
    parser.add_argument(
        "sources", nargs="*", metavar="SOURCE", help="sources or robots, with --edits also outputs (default: all)"
    )
    other = parser.add_mutually_exclusive_group()
    other.add_argument("--against", metavar="VERSION", help="the older version: a file or a git revision")
    other.add_argument("--edits", action="store_true", help="show what you edited in the packages instead")


def run(args: argparse.Namespace, console: Console) -> Exit:
    """Show what changed in each source."""
    if args.edits:
        from urdfsync.commands import edits  # the merge takes a while to load

        return edits.run(args, console)
    folder = config.working_folder()
    nearest = _configuration(args, folder)
    found = []
    request = arguments.request(args, console)
    for one in _comparisons(args, nearest, request, folder):
        found.append(one)
        if console.json:
            console.add_robot(_to_json(one))
            continue
        show_findings(console, one.result, [found for found in one.result.diagnostics if found.code != CONNECTORS])
        if not console.quiet or one.result.conflicts:
            head = headline(one.result, _summary(one), is_fine=one.in_step)
            console.print([head, *_lines(one, console.verbose)], error=one.result.failed)
    code = comparison.exit_code(found)
    console.end("diff", code)
    return code


def _comparisons(
    args: argparse.Namespace, nearest: Config | None, request: BuildOptions, folder: Path
) -> Iterator[Comparison]:
    """Compare each source that is named, once; or all. Raises ConfigError for what is none."""
    sources = [
        comparison.find_sources(source, nearest, args.robot or [], args.against, folder)
        for source in dict.fromkeys(args.sources or [""])
    ]
    seen = set[tuple[str, Path]]()
    for configuration, robots in sources:
        new = [robot for robot in robots if (robot.name, robot.source) not in seen]
        seen.update((robot.name, robot.source) for robot in new)
        yield from comparison.compare_sources(new, args.against, configuration, request, folder)


def _configuration(options: argparse.Namespace, folder: Path) -> Config | None:
    """Return the configuration; None if there is none and none is needed. Raises ConfigError."""
    named = options.config or options.robot or not options.sources
    if named or any((place / config.FILE_NAME).is_file() for place in (folder, *folder.parents)):
        return arguments.configuration(options)
    if options.against is not None:
        return None
    message = f"no {config.FILE_NAME} in {folder} or a folder above it, so there is no last build to compare with"
    hint = "name the version to compare with: --against FILE or REVISION, or begin with `urdfsync init`"
    raise ConfigError(Diagnostic(Severity.ERROR, "no-config", message, hint=hint))


def _to_json(found: Comparison) -> dict[str, Any]:
    """Return a comparison as docs/json.md describes it."""
    values = result_values(found.result)
    return {
        **{key: values[key] for key in ("name", "failed", "locked", "class", "changes", "diagnostics")},
        "source": found.source,
        "against": found.against,
        "built": not found.missing,
        "in_step": found.in_step,
        "summary": _summary(found),
        "effects": [
            {"effect": " / ".join(one.path), "old": one.old, "new": one.new, "unit": one.unit, "hint": one.hint}
            for one in found.effects
        ],
        "actions": [{**one, "edited": one["path"] in found.edited} for one in values["actions"]],
    }


def _summary(found: Comparison) -> str:
    """Return what changed since the older version, as the rest of a line that names the robot."""
    if found.result.failed:
        return f"{error_count(found.result.diagnostics)}, so nothing can be compared"
    if found.missing:
        return found.missing
    since = f"since {'the last build' if found.against is None else found.against}"
    changes = found.result.changes
    if changes is None:
        return f"nothing changed {since}{'' if found.in_step else ', but files are out of step'}"
    return f"{change_counts(changes) if changes.changes else generator_change(changes)} {since}"


# --- text ---------------------------------------------------------------------------------------------------------


def _lines(found: Comparison, verbose: bool) -> Iterator[StyledLine]:
    """Yield the lines below the first one: changes by element, effects on the model, files; of many the first."""
    changes, effects = found.result.changes, effect_rows(found.effects)
    elements = outline(changes, everything=verbose) if changes else {}
    widths = _widths([row for rows in elements.values() for row in rows])
    lines = [line((f"  {generator_change(changes)}", ""))] if changes and changes.generator else []
    for title, rows in elements.items():
        itself = [(f"  {row.value}", _STYLES.get(row.kind, "")) for row in rows if not row.label]
        lines.append(line((f"  {title}", "dim" if all(row.is_quiet for row in rows) else "bold"), *itself))
        lines += [_row_line(row, *widths) for row in rows if row.label]
    yield from first_lines(lines, _CHANGES, "line", verbose=verbose)
    if effects:
        lines = [_row_line(row, *_widths(effects[:_EFFECTS])) for row in effects]
        yield from (line(("", "")), line(("Effects", "bold")))
        yield from first_lines(lines, _EFFECTS, "effect", verbose=verbose)
    yield from _files(found, verbose)


def _widths(rows: Sequence[OutlineRow]) -> tuple[int, int]:
    """Return how wide the columns of labels and of values with a relation are."""
    labels, values = ([len(row.label) for row in rows], [len(row.value) for row in rows if row.relation])
    return min(max(labels, default=0), _WIDEST), min(max(values, default=0), _WIDEST)


def _row_line(row: OutlineRow, label: int, value: int) -> StyledLine:
    quiet = "dim" if row.is_quiet else ""
    style, text = quiet or _STYLES.get(row.kind, ""), f"{row.value:<{value}}  " if row.relation else row.value
    return line((f"    {row.label:<{label}}  ", quiet), (text, style), (row.relation, "dim"))


def _files(found: Comparison, verbose: bool) -> Iterator[StyledLine]:
    """Yield the files that are concerned, and why if it is one that the user edited; these are always named."""
    result = found.result
    actions = [action for action in result.actions if action.reason not in _SILENT]
    if found.in_step or not actions:
        return
    heading = f"Next build: {build_summary(result)}"
    if found.against is not None:
        reasons = Counter(action.reason for action in result.actions)
        parts = [
            f"{reasons[one]} to {one.word}" for one in (Reason.UPDATE, Reason.CREATE, Reason.DELETE) if reasons[one]
        ]
        heading = f"{counted(len(result.actions), 'file')} of the package differ{'s' * (len(result.actions) == 1)}"
        heading += f": {', '.join(parts)}" if len(parts) > 1 else ""
    yield from (line(("", "")), line((heading, "bold")))
    actions.sort(key=lambda action: (action.path not in found.edited, action.path.rpartition("/")))
    lines = []
    for action in actions:
        why = ""
        if action.path in found.edited:
            # the word says already that it waits
            why = "you edited it" if found.against else action.reason.text
        lines.append(file_line(shown_path(result, action.path), *action_word(action), why))
    yield from first_lines(lines, max(_FILES, len(found.edited) + 1), "file", verbose=verbose)
    if any(action.kind is Kind.CONFLICT for action in actions):
        yield line((settle_hint(result), "dim"))
