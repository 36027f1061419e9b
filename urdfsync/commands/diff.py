"""`urdfsync diff`: shows what changed since the last build, or between two versions of a source."""

from __future__ import annotations

import argparse
import os
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
from urdfsync.diff.outline import OutlineEntry, OutlineRow, Tone, effect_rows, outline
from urdfsync.engine.actions import CONFLICTS, Action, Kind
from urdfsync.outcome import Exit
from urdfsync.output.console import Console, has_marks, line, rich_console, text
from urdfsync.output.json_values import action_values, change_values, finding_values
from urdfsync.output.phrases import change_classes, counted, error_count, generator_change
from urdfsync.output.phrases import summary as build_summary

if TYPE_CHECKING:
    from rich.console import Console as RichConsole
    from rich.text import Text
    from rich.tree import Tree

    from urdfsync.diff.comparison import Comparison

_ADVICE = "  settle a conflict with `urdfsync resolve FILE --keep` (or --take, --merge)"
_TONES = {Tone.ADDED: "green", Tone.REMOVED: "red", Tone.RENAMED: "cyan", Tone.QUIET: "dim"}
_WIDEST = 44
"""Columns for labels at most; the values of longer ones go to the next line."""
_VALUES = 40
"""Columns for values at most; longer ones push what is said of them to the right."""
_FILES = 12
"""So many files are listed at most, unless somebody asks."""
_WORD = 9
"""Columns for the word that says what happens to a file."""
_EFFECTS = 8
"""So many effects are shown at most, unless somebody asks."""
_SILENT = frozenset({Kind.UNCHANGED, Kind.KEEP, Kind.FORGET})
_KINDS = {Kind.CREATE: "green", Kind.RESTORE: "green", Kind.UPDATE: "default", Kind.DELETE: "red", Kind.ADOPT: "green"}


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
    sources = comparison.find_sources(args.source, configuration, args.robot or [], folder)
    comparison.check_sources(sources, args.against, configuration, folder)
    found = []
    request = arguments.request(args, console)
    for one in comparison.compare_sources(sources, args.against, configuration, request, folder):
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
        "changes": [change_values(one) for one in found.changes.changes] if found.changes else [],
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
    if found.changes is None:
        return f"nothing changed {since}{'' if found.in_step else ', but files are not as they should be'}"
    what = change_classes(found.changes) if found.changes.changes else generator_change(found.changes)
    return f"{what} {since}{', only by rounding' if found.changes.noise else ''}"


# --- text ---------------------------------------------------------------------------------------------------------


def _show(found: Comparison, console: Console) -> None:
    """Print what there is to say about one source: a tree of changes by element, effects on the model, files."""
    console.findings(found.result.diagnostics)
    if console.quiet and not found.result.conflicts:
        return
    screen = rich_console(sys.stderr if found.result.failed else sys.stdout)
    if found.in_step and found.changes is None:
        mark = [("✓ ", "green")] if has_marks(screen.file) else []
        console.print([line(*mark, (found.result.robot, "bold"), (f": {_summary(found)}", ""))])
        return
    console.stop_progress()
    if not screen.is_terminal:
        screen.width = 10_000  # lines of a pipe are never broken
    screen.print(_tree(found, screen, console.verbose))
    for row in (*_effects(found, screen, console.verbose), *_files(found, screen, console.verbose)):
        screen.print(row)


def _tree(found: Comparison, console: RichConsole, verbose: bool) -> Tree:
    """Return the robot with its changes by element."""
    from rich.tree import Tree

    mark, style = ("✓", "green") if found.in_step else ("~", "yellow")
    marks = [(f"{mark} ", style)] if has_marks(console.file) else []
    headline = text(*marks, (found.result.robot, "bold"), (f": {_summary(found)}", ""))
    tree = Tree(headline, guide_style="dim")
    if found.changes is None:
        return tree
    if found.changes.generator:
        tree.add(text(("urdfsync", "bold"), (f"  {generator_change(found.changes)}", "")))
    shown = outline(found.changes, everything=verbose)
    columns = _Columns([row for entry in shown.entries for row in entry.rows], console, guides=8)
    # a first row without a label stands beside the names of its elements
    titles = _Columns([_titled(entry) for entry in shown.entries if not entry.rows[0].label], console, guides=4)
    for entry in shown.entries:
        is_quiet = all(row.tone is Tone.QUIET for row in entry.rows)
        style, rows = "dim" if is_quiet else "bold", entry.rows
        if rows[0].label:
            branch = tree.add(text((entry.title, style)))
        else:
            branch, rows = tree.add(titles.line(_titled(entry), style=style)), rows[1:]
        for row in rows:
            branch.add(columns.line(row))
    if shown.condensed:
        tree.add(text(("numbers are counted; --verbose shows each", "dim")))
    return tree


def _titled(entry: OutlineEntry) -> OutlineRow:
    """Return the first row of an entry with the names of its elements."""
    return msgspec.structs.replace(entry.rows[0], label=entry.title)


class _Columns:
    """Rows below each other: labels, values, and how new values stand to old ones."""

    def __init__(self, rows: Sequence[OutlineRow], console: RichConsole, guides: int) -> None:
        """Columns that suit these rows; `guides` is the width of what stands before them."""
        self._total = console.width - guides
        widest = min(_WIDEST, self._total // 3)
        fitting = [len(row.label) for row in rows if len(row.label) <= widest]
        self._label = max(fitting, default=widest if rows else 0)
        value = max((_value(row).cell_len for row in rows if row.relation), default=0)
        self._value = min(value, _VALUES, max(self._total - self._label - 18, 12))

    def line(self, row: OutlineRow, margin: str = "", style: str = "") -> Text:
        """Return the row; what does not fit goes to further lines, below the values; `margin` stands before them."""
        from rich.console import Console as RichConsole

        line = text((f"{row.label:<{self._label}}  ", style or ("dim" if row.tone is Tone.QUIET else "")))
        indent = "\n" + margin + " " * (self._label + 2)
        room = self._total - self._label - 2
        if len(row.label) > self._label:
            line.append(indent)
        pieces = [_value(row)]
        if pieces[0].cell_len > room:  # broken at the arrow first
            new = _value(msgspec.structs.replace(row, old=""))
            parts = [text((row.old, "dim")), text(("→ ", "dim")).append_text(new)] if row.old else [new]
            pieces = [piece for part in parts for piece in part.wrap(RichConsole(width=room), room)]
        for count, piece in enumerate(pieces):
            line.append(indent if count else "").append_text(piece)
        if row.relation:
            relation, last = text((row.relation, "dim")), pieces[-1].cell_len
            gap = max(self._value - last, 0) + 2
            line.append(" " * gap if last + gap + relation.cell_len <= room else indent).append_text(relation)
        return line


def _value(row: OutlineRow) -> Text:
    style = _TONES.get(row.tone, "")
    if not row.old:
        return text((row.new, style))
    return text((row.old, style or "dim"), (" → ", "dim"), (row.new, style))


def _effects(found: Comparison, console: RichConsole, verbose: bool) -> Iterator[Text]:
    """Yield the properties of the whole model that differ."""
    rows = effect_rows(found.effects)
    shown = rows if verbose or len(rows) <= _EFFECTS else rows[: _EFFECTS - 1]
    columns = _Columns(shown, console, guides=2)
    if shown:
        yield from (text(("", "")), text(("Effects", "bold")))
    yield from (text(("  ", "")).append_text(columns.line(row, "  ")) for row in shown)
    if len(shown) < len(rows):
        yield _more(len(rows) - len(shown), "effect")


def _files(found: Comparison, console: RichConsole, verbose: bool) -> Iterator[Text]:
    """Yield the files that are concerned, edited ones first."""
    result = found.result
    actions = [action for action in result.actions if action.kind not in _SILENT]
    if found.in_step or not actions:
        return
    heading = f"A build: {build_summary(result)}"
    if found.against is not None:
        kinds = Counter(action.kind for action in result.actions)
        heading = f"{counted(len(result.actions), 'file')} of the package"
        heading += " differs" if len(result.actions) == 1 else " differ"
        if len(kinds) > 1:
            parts = (f"{kinds[kind]} to {kind}" for kind in (Kind.UPDATE, Kind.CREATE, Kind.DELETE) if kinds[kind])
            heading += f": {', '.join(parts)}"
    yield from (text(("", "")), text((heading, "bold")))
    actions.sort(key=lambda action: (action.path not in found.edited, action.path.rpartition("/")))
    urgent = sum(action.path in found.edited for action in actions)
    few = actions if verbose or len(actions) <= _FILES else actions[: max(_FILES - 1, urgent)]
    yield from (_file(found, action, console) for action in few)
    if len(few) < len(actions):
        yield _more(len(actions) - len(few), "file")
    if any(action.kind in CONFLICTS for action in actions):
        yield text((_ADVICE, "dim"))


def _file(found: Comparison, action: Action, console: RichConsole) -> Text:
    """Return what happens to a file, and why if it is one that the user edited."""
    word = "waiting" if action.held else action.kind.value.removeprefix("unowned-")
    style = "bold red" if action.kind in CONFLICTS else "yellow" if action.held else _KINDS.get(action.kind, "yellow")
    path = config.shown(Path(os.path.normpath(found.result.root / action.path)))
    line = text((f"  {word:<{_WORD}} ", style), (path, ""))
    if action.path in found.edited:
        told = msgspec.structs.replace(action, held=False).reason  # the word says already that it waits
        reason = text(("you edited it" if found.against else told, "yellow"))
        fits = line.cell_len + 2 + reason.cell_len <= console.width
        line.append("  " if fits else "\n" + " " * (_WORD + 3)).append_text(reason)
    return line


def _more(count: int, noun: str) -> Text:
    return text((f"  … and {count} more {noun}{'s' if count > 1 else ''}; --verbose shows them", "dim"))
