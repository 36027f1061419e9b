"""`urdfsync diff`: shows what changed since the last build, or between two versions of a source."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from urdfsync import config
from urdfsync.commands import arguments
from urdfsync.comparing.comparison import Comparison, exit_code
from urdfsync.config import Config
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.outcome import Exit
from urdfsync.output.console import Console, rich_console
from urdfsync.output.json_values import action_values, change_values, finding_values

if TYPE_CHECKING:
    from urdfsync.comparing.subjects import Subject


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
    from urdfsync.comparing import differ, subjects

    folder = config.working_folder()
    configuration = _configuration(args, folder)
    found = subjects.find(args.source, configuration, args.robot or [], folder)
    _check(found, args.against, configuration, folder)
    comparisons = []
    request = arguments.request(args, console)
    for comparison in differ.compare(found, args.against, configuration, request, folder):
        _show(console, comparison)
        comparisons.append(comparison)
    code = exit_code(comparisons)
    console.end("diff", code)
    return code


def _show(console: Console, found: Comparison) -> None:
    from urdfsync.views import comparisons

    if console.json:
        console.add_robot(_values(found))
        return
    console.findings(found.result.diagnostics)
    console.stop_progress()
    if console.quiet and not found.result.conflicts:
        return
    screen = rich_console(sys.stderr if found.result.failed else sys.stdout)
    for part in comparisons.parts(found, screen, console.verbose):
        screen.print(part)


def _values(found: Comparison) -> dict[str, Any]:
    """What changed in a source as plain data."""
    from urdfsync.views.comparisons import summary

    result = found.result
    effects = [
        {"effect": " / ".join(one.path), "old": one.old, "new": one.new, "unit": one.unit, "hint": one.hint}
        for one in found.effects
    ]
    actions = [{**action_values(one, result.changes), "edited": one.path in found.edited} for one in result.actions]
    return {
        "name": result.robot,
        "source": found.source,
        "against": found.against,
        "built": not found.missing,
        "failed": result.failed,
        "locked": result.locked,
        "in_step": found.in_step,
        "summary": summary(found),
        "class": found.change_class,
        "changes": [change_values(one) for one in found.changes.changes] if found.changes else [],
        "effects": effects,
        "actions": actions,
        "diagnostics": [finding_values(diagnostic) for diagnostic in result.diagnostics],
    }


def _configuration(options: argparse.Namespace, folder: Path) -> Config | None:
    """The configuration; None if there is none and none is needed. Raises ConfigError."""
    named = options.config or options.robot or not options.source
    if named or any((place / config.FILE_NAME).is_file() for place in (folder, *folder.parents)):
        return arguments.configuration(options)
    if options.against is not None:
        return None
    message = f"no {config.FILE_NAME} in {folder} or a folder above it, so there is no last build to compare with"
    hint = "name the version to compare with: --against FILE or REVISION, or begin with `urdfsync init`"
    raise ConfigError(Diagnostic(Severity.ERROR, "no-config", message, hint=hint))


def _check(found: list[Subject], against: str | None, configuration: Config | None, folder: Path) -> None:
    """Raise ConfigError for what can't be compared."""
    alone = [subject for subject in found if subject.robot is None]
    if alone and against is None and configuration is not None:
        message = f"{alone[0].name} was never built: it is no robot's source"
        hint = "add a robot for it, or name the version to compare it with: --against FILE or REVISION"
        place = config.shown(configuration.file)
        raise ConfigError(Diagnostic(Severity.ERROR, "no-robot", message, place, hint=hint))
    if against is not None and (folder / against).is_file() and len({subject.source for subject in found}) > 1:
        message = f"one file can't be the older version of {len(found)} sources"
        raise ConfigError(Diagnostic(Severity.ERROR, "one-file", message, hint="name the source to compare it with"))
