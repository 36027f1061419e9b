"""`urdfsync diff`: shows what changed since the last build, or between two versions of a source."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec

from urdfsync import config
from urdfsync.commands import arguments
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import ConfigError
from urdfsync.engine.actions import USERS, Kind, Reason
from urdfsync.engine.findings import CONNECTORS
from urdfsync.output.conflicts import settle_hint, shown_path
from urdfsync.output.console import Console, Format, StyledLine, first_lines, line
from urdfsync.output.markdown import Mark, Section, Table
from urdfsync.output.outline import effect_rows
from urdfsync.output.phrases import change_counts, change_lines, counted, error_count, generator_change
from urdfsync.output.phrases import summary as build_summary
from urdfsync.output.repeated import show_findings
from urdfsync.output.results import action_word, change_line, file_line, headline, result_values
from urdfsync.output.sections import build_section, change_parts
from urdfsync.versions import comparison
from urdfsync.versions.comparison import Comparison

_CHANGES, _FILES, _EFFECTS = 60, 12, 8
"""So many lines of changes, files and effects are listed at most, without --verbose."""
_SILENT = frozenset({Reason.UNCHANGED, Reason.KEEP, Reason.FORGET})
_EDITED = USERS | {Reason.UNOWNED, Reason.MOVED_AWAY}
"""Actions on files that the user edited: these are always named."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "diff",
        "--robot --wait",
        formats=True,
        help="show what changed in the sources since the last build",
        description="Show what changed in a source since the last build, or since another version of it: by element, "
        "with what follows for the whole model and for the files of the package. Nothing is written.",
        epilog="examples: urdfsync diff cad/arm.urdf\n"
        "          urdfsync diff arm --against HEAD~1\n"
        "          urdfsync diff cad/arm.urdf --against old/arm.urdf\n"
        "          urdfsync diff --edits modelica/Arm/Links",
    )
    parser.add_argument(
        "sources", nargs="*", metavar="SOURCE", help="sources or robots, with --edits also outputs (default: all)"
    )
    other = parser.add_mutually_exclusive_group()
    other.add_argument("--against", metavar="VERSION", help="the older version: a file or a git revision")
    other.add_argument("--edits", action="store_true", help="show what you edited in the packages instead")


def run(args: argparse.Namespace, console: Console) -> int:
    """Show what changed in each source."""
    if args.edits:
        from urdfsync.commands import edits  # the merge takes a while to load

        return edits.run(args, console)
    folder = config.working_folder()
    configuration = _configuration(args, folder)
    request = arguments.request(args, console)
    comparisons = []
    for loaded, robots in _select_sources(args, configuration, folder):
        for compared in comparison.compare_sources(robots, args.against, loaded, request, folder):
            comparisons.append(compared)
            _show(console, compared)
    return console.end(comparison.exit_code(comparisons))


def _configuration(args: argparse.Namespace, folder: Path) -> Config | None:
    """Return the configuration; None if there is none and none is needed. Raises ConfigError."""
    is_near = any((place / config.FILE_NAME).is_file() for place in (folder, *folder.parents))
    if is_near or args.config or args.robot or not args.sources:
        return arguments.configuration(args)
    if args.against is not None:
        return None
    message = f"no {config.FILE_NAME} in {folder} or a folder above it, so there is no last build to compare with"
    hint = "name the version to compare with: --against FILE or REVISION, or begin with `urdfsync init`"
    raise ConfigError.of("no-config", message, hint=hint)


def _select_sources(
    args: argparse.Namespace, configuration: Config | None, folder: Path
) -> Iterator[tuple[Config | None, Sequence[RobotConfig]]]:
    """Yield the robots that the arguments mean, and robots for sources that none of them has. Raises ConfigError."""
    known = {os.path.realpath(robot.source) for robot in configuration.robots} if configuration else set()
    places = {text: Path(os.path.normpath(folder / text)) for text in args.sources}
    alone = {text: place for text, place in places.items() if place.is_file() and os.path.realpath(place) not in known}
    if configuration is None and (missing := places.keys() - alone.keys()):
        raise ConfigError.of("no-source", f"there is no file {min(missing)!r}", hint="name a source that exists")
    if args.against is None and alone:
        message = f"{min(alone)} was never built: it is not the source of a robot"
        hint = "add a robot for it, or name the version to compare it with: --against FILE or REVISION"
        raise ConfigError.of("no-robot", message, hint=hint)
    named = [*(text for text in args.sources if text not in alone), *(args.robot or [])]
    robots = configuration.select(named) if configuration and (named or not alone) else ()
    if args.against and (folder / args.against).is_file() and len({robot.source for robot in robots}) + len(alone) > 1:
        message = "--against names one file, but several sources are compared"
        raise ConfigError.of("one-file", message, hint="name the source to compare it with")
    yield configuration, robots
    yield None, [comparison.robot_of_file(place) for place in alone.values()]


def _show(console: Console, compared: Comparison) -> None:
    if console.format is Format.JSON:
        values = result_values(compared.result)
        values |= {"source": compared.source, "against": compared.against, "summary": _summary(compared)}
        values |= {"in_step": compared.in_step, "effects": msgspec.to_builtins(compared.effects)}
        console.add_robot(values)
        return
    if console.json:
        console.add_section(_section(compared))
        return
    show_findings(
        console,
        compared.result,
        [diagnostic for diagnostic in compared.result.diagnostics if diagnostic.code != CONNECTORS],
    )
    if not console.quiet or compared.result.conflicts:
        head = headline(compared.result, _summary(compared), is_fine=compared.in_step)
        console.print([head, *_lines(compared, console.verbose)], error=compared.result.failed)


def _section(compared: Comparison) -> Section:
    """Return a comparison for a comment; only one with the last build judges the package."""
    result, section = compared.result, build_section(compared.result)
    points, tables = change_parts(result.changes)
    points = [point for point in points if point not in _summary(compared)]
    effects = Table("Effects", ("Property", "Change", "By"), effect_rows(compared.effects))
    tables += [effects, section.tables[-1]]
    findings = [finding for finding in section.findings if finding.code != CONNECTORS]  # effects tell them
    texts = {"summary": _summary(compared), "points": points, "tables": tables, "findings": findings}
    if compared.against is None or result.failed:
        return msgspec.structs.replace(section, **texts)
    return msgspec.structs.replace(section, **texts, mark=Mark.NONE, verdict=None)


def _summary(compared: Comparison) -> str:
    """Return what changed since the older version, as the rest of a line that names the robot."""
    if compared.result.failed:
        return f"{error_count(compared.result.diagnostics)}, so nothing can be compared"
    if compared.missing:
        return compared.missing
    since = f"since {'the last build' if compared.against is None else compared.against}"
    changes = compared.result.changes
    if changes is None:
        return f"nothing changed {since}{'' if compared.in_step else ', but files are out of step'}"
    return f"{change_counts(changes) if changes.changes else generator_change(changes)} {since}"


def _lines(compared: Comparison, verbose: bool) -> Iterator[StyledLine]:
    """Yield the lines below the first one: changes by element, effects on the model, files; of many the first."""
    head, changes = _summary(compared), compared.result.changes
    told = [text for text in change_lines(changes, everything=verbose) if text not in head] if changes else []
    yield from first_lines(list(map(change_line, told)), _CHANGES, "line", verbose=verbose)
    if effects := [line((f"  {text}", "")) for text in effect_rows(compared.effects)]:
        yield from (line(("", "")), line(("Effects", "bold")))
        yield from first_lines(effects, _EFFECTS, "effect", verbose=verbose)
    yield from _files(compared, verbose)


def _files(compared: Comparison, verbose: bool) -> Iterator[StyledLine]:
    """Yield the files that are concerned, and why if it is one that the user edited; these come first."""
    result = compared.result
    actions = [action for action in result.actions if action.reason not in _SILENT]
    if compared.in_step or not actions:
        return
    heading = f"Next build: {build_summary(result)}"
    if compared.against is not None:
        heading = f"{counted(len(actions), 'file')} of the package differ{'s' if len(actions) == 1 else ''}"
    yield from (line(("", "")), line((heading, "bold")))
    actions.sort(key=lambda action: (action.reason not in _EDITED, action.path.rpartition("/")))
    lines = [
        file_line(
            shown_path(result, action.path),
            *action_word(action),
            action.reason.text if action.reason in _EDITED else "",  # the word says already that it waits
        )
        for action in actions
    ]
    edited = sum(action.reason in _EDITED for action in actions)
    yield from first_lines(lines, max(_FILES, edited + 1), "file", verbose=verbose)
    if any(action.kind is Kind.CONFLICT for action in actions):
        yield line((settle_hint(result), "dim"))
