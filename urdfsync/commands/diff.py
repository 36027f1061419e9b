"""`urdfsync diff`: shows what changed since the last build, or between two versions of a source."""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from urdfsync import config
from urdfsync.commands import arguments
from urdfsync.config import Config
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.domain import ChangeKind
from urdfsync.engine.actions import CONFLICTS, Kind
from urdfsync.outcome import Exit
from urdfsync.output.conflicts import shown_path
from urdfsync.output.console import Console, StyledLine, headline, more, rich_console, text
from urdfsync.output.json_values import action_values, change_values, finding_values
from urdfsync.output.outline import OutlineRow, effect_rows, outline
from urdfsync.output.phrases import RESOLVE_HINT, change_classes, counted, error_count, generator_change
from urdfsync.output.phrases import summary as build_summary
from urdfsync.output.results import action_word

if TYPE_CHECKING:
    from rich.console import Console as RichConsole
    from rich.table import Table
    from rich.text import Text
    from rich.tree import Tree

    from urdfsync.diff.changes import Changes
    from urdfsync.diff.comparison import Comparison

_CHANGES = {ChangeKind.ADDED: "green", ChangeKind.REMOVED: "red", ChangeKind.RENAMED: "cyan"}
_WIDEST = 44
"""Columns for labels at most; longer ones are broken."""
_VALUES = 40
"""Columns for values that something is said of, at most; longer ones are broken."""
_FILES = 12
"""So many files are listed at most, unless somebody asks."""
_EFFECTS = 8
"""So many effects are shown at most, unless somebody asks."""
_SILENT = frozenset({Kind.UNCHANGED, Kind.KEEP, Kind.FORGET})


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = commands.add_parser(
        "diff",
        help="show what changed in the sources since the last build",
        description="Show what changed in a source since the last build, or since another version of it: by element, "
        "with what follows for the whole model and for the files of the package. Nothing is written.",
        epilog="examples: urdfsync diff cad/arm.urdf\n"
        "          urdfsync diff arm --against HEAD~1\n"
        "          urdfsync diff cad/arm.urdf --against old/arm.urdf\n\n"
        "exit codes: 0 both give the same package, 1 they do not, 2 error, 4 locked, 130 interrupted",
    )
    parser.add_argument("source", nargs="?", default="", metavar="SOURCE", help="a source or a robot (default: all)")
    parser.add_argument("--against", metavar="VERSION", help="the older version: a file or a git revision")
    arguments.add_robot_option(parser)
    arguments.add_wait(parser)
    arguments.add_profile(parser)
    parser.set_defaults(run=run)
    arguments.add_common(parser)


def run(args: argparse.Namespace, console: Console) -> Exit:
    """Show what changed in each source."""
    from urdfsync.diff import comparison  # imports all that a build needs: for other commands' parsers it is not loaded

    folder = config.working_folder()
    configuration = _configuration(args, folder)
    robots = comparison.find_sources(args.source, configuration, args.robot or [], args.against, folder)
    found = []
    request = arguments.request(args, console)
    for one in comparison.compare_sources(robots, args.against, configuration, request, folder):
        if console.json:
            console.add_robot(_to_json(one))
        else:
            _show(one, console)
        found.append(one)
    code = comparison.exit_code(found)
    console.end("diff", code)
    return code


def _configuration(options: argparse.Namespace, folder: Path) -> Config | None:
    """Return the configuration; None if there is none and none is needed. Raises ConfigError."""
    named = options.config or options.robot or not options.source
    if named or any((place / config.FILE_NAME).is_file() for place in (folder, *folder.parents)):
        return arguments.configuration(options)
    if options.against is not None:
        return None
    message = f"no {config.FILE_NAME} in {folder} or a folder above it, so there is no last build to compare with"
    hint = "name the version to compare with: --against FILE or REVISION, or begin with `urdfsync init`"
    raise ConfigError(Diagnostic(Severity.ERROR, "no-config", message, hint=hint))


def _to_json(found: Comparison) -> dict[str, Any]:
    """Return a comparison as docs/json.md describes it."""
    result = found.result
    return {
        "name": result.robot,
        "source": found.source,
        "against": found.against,
        "built": not found.missing,
        "failed": result.failed,
        "locked": result.locked,
        "in_step": found.in_step,
        "summary": _summary(found),
        "class": found.change_class,
        "changes": [change_values(one) for one in found.result.changes.changes] if found.result.changes else [],
        "effects": [
            {"effect": " / ".join(one.path), "old": one.old, "new": one.new, "unit": one.unit, "hint": one.hint}
            for one in found.effects
        ],
        "actions": [
            {**action_values(one, result.changes), "edited": one.path in found.edited} for one in result.actions
        ],
        "diagnostics": [finding_values(diagnostic) for diagnostic in result.diagnostics],
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
        return f"nothing changed {since}{'' if found.in_step else ', but files are not as they should be'}"
    what = change_classes(changes) if changes.changes else generator_change(changes)
    return f"{what} {since}{', only by rounding' if changes.noise else ''}"


# --- text ---------------------------------------------------------------------------------------------------------


def _show(found: Comparison, console: Console) -> None:
    """Print what there is to say about one source: a tree of changes by element, effects on the model, files."""
    result = found.result
    console.findings(result.diagnostics)
    if console.quiet and not result.conflicts:
        return
    stream = sys.stderr if result.failed else sys.stdout
    head = headline(stream, result.robot, _summary(found), *(("✓", "green") if found.in_step else ("~", "yellow")))
    if found.in_step and result.changes is None:
        console.print([head])
        return
    console.stop_progress()
    screen = rich_console(stream)
    if not screen.is_terminal:
        screen.width = 10_000  # lines of a pipe are never broken
    screen.print(_tree(head, result.changes, screen, console.verbose))
    effects = effect_rows(found.effects)
    few = len(effects) if console.verbose or len(effects) <= _EFFECTS else _EFFECTS - 1
    if effects:
        screen.print("\nEffects", style="bold")
        for row in _grids([msgspec.structs.replace(row, label=f"  {row.label}") for row in effects[:few]], screen):
            screen.print(row)
    if few < len(effects):
        screen.print(more(len(effects) - few, "effect"))
    for file in _files(found, screen.width, console.verbose):
        screen.print(file)


def _tree(head: StyledLine, changes: Changes | None, console: RichConsole, verbose: bool) -> Tree:
    """Return the robot with its changes by element."""
    from rich.tree import Tree

    tree = Tree(head, guide_style="dim")
    if changes is None:
        return tree
    if changes.generator:
        tree.add(text(("urdfsync", "bold"), (f"  {generator_change(changes)}", "")))
    shown = outline(changes, everything=verbose)
    # a first row without a label stands beside the names of its elements
    heads = [entry for entry in shown.entries if not entry.rows[0].label]
    beside = _grids([msgspec.structs.replace(entry.rows[0], label=entry.title) for entry in heads], console)
    below = _grids([row for entry in shown.entries for row in entry.rows if row.label], console)
    for entry in shown.entries:
        if entry.rows[0].label:
            style = "dim" if all(row.is_quiet for row in entry.rows) else "bold"
            branch = tree.add(text((entry.title, style)))
        else:
            branch = tree.add(next(beside))
        for row in entry.rows:
            if row.label:
                branch.add(next(below))
    if shown.condensed:
        tree.add(text(("numbers are counted; --verbose shows each", "dim")))
    return tree


def _grids(rows: Sequence[OutlineRow], console: RichConsole) -> Iterator[Table]:
    """Rows below each other, each a table of one line: label, values, and how new values stand to old ones."""
    from rich.table import Table

    label = min(max((text((row.label, "")).cell_len for row in rows), default=0), _WIDEST, console.width // 2)
    values = [_value(row) for row in rows]
    related = [value.cell_len for value, row in zip(values, rows, strict=True) if row.relation]
    room = max(console.width - label - 30, 12)
    width = min(max(related, default=0), _VALUES, room)
    for row, value in zip(rows, values, strict=True):
        grid = Table.grid(padding=(0, 2, 0, 0))
        grid.add_column(width=label, overflow="fold")
        grid.add_column(width=max(width, min(value.cell_len, room)) if row.relation else None, overflow="fold")
        is_element = row.kind is not ChangeKind.CHANGED and " / " not in row.label
        cells = [text((row.label, "dim" if row.is_quiet else "bold" if is_element else "")), value]
        if row.relation:
            grid.add_column(overflow="fold")
            cells.append(text((row.relation, "dim")))
        grid.add_row(*cells)
        yield grid


def _value(row: OutlineRow) -> Text:
    style = "dim" if row.is_quiet else _CHANGES.get(row.kind, "")
    if not row.old:
        return text((row.new, style))
    return text((row.old, style or "dim"), (" → ", "dim"), (row.new, style))


def _files(found: Comparison, width: int, verbose: bool) -> Iterator[Text]:
    """Yield the files that are concerned, edited ones first, and why if it is one that the user edited."""
    result = found.result
    actions = [action for action in result.actions if action.kind not in _SILENT]
    if found.in_step or not actions:
        return
    heading = f"A build: {build_summary(result)}"
    if found.against is not None:
        kinds = Counter(action.kind for action in result.actions)
        parts = [f"{kinds[kind]} to {kind}" for kind in (Kind.UPDATE, Kind.CREATE, Kind.DELETE) if kinds[kind]]
        heading = f"{counted(len(result.actions), 'file')} of the package differ{'s' * (len(result.actions) == 1)}"
        heading += f": {', '.join(parts)}" if len(parts) > 1 else ""
    yield from (text(("", "")), text((heading, "bold")))
    actions.sort(key=lambda action: (action.path not in found.edited, action.path.rpartition("/")))
    urgent = sum(action.path in found.edited for action in actions)
    few = actions if verbose or len(actions) <= _FILES else actions[: max(_FILES - 1, urgent)]
    for action in few:
        word, style = action_word(action)
        why = ""
        if action.path in found.edited:
            # the word says already that it waits
            why = "  you edited it" if found.against else f"  {msgspec.structs.replace(action, held=False).reason}"
        file = text((f"  {word:<9} ", style), (shown_path(result, action.path), ""))
        fits = file.cell_len + len(why) <= width
        yield from [file.append(why, "yellow")] if fits else [file, text((f"{'':<10}{why}", "yellow"))]
    if len(few) < len(actions):
        yield more(len(actions) - len(few), "file").__rich__()
    if any(action.kind in CONFLICTS for action in actions):
        yield text((RESOLVE_HINT, "dim"))
