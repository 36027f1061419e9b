"""`urdfsync diff`: shows what changed since the last build, or between two versions of a source."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from urdfsync import config
from urdfsync.commands import common
from urdfsync.comparing.comparison import exit_code
from urdfsync.config import Config
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.report import Report

if TYPE_CHECKING:
    from urdfsync.comparing.subjects import Subject


def add(commands: common.Commands) -> None:
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
    common.add_robot_option(parser)
    common.add_wait(parser)
    common.add_profile(parser)
    parser.set_defaults(run=_run)
    common.add_common(parser)


def _run(options: argparse.Namespace, report: Report) -> int:
    from urdfsync.comparing import differ, subjects

    folder = config.working_folder()
    configuration = _configuration(options, folder)
    found = subjects.find(options.source, configuration, options.robot or [], folder)
    _check(found, options.against, configuration, folder)
    comparisons = []
    for comparison in differ.compare(found, options.against, configuration, common.request(options, report), folder):
        report.comparison(comparison)
        comparisons.append(comparison)
    code = exit_code(comparisons)
    report.finish("diff", code)
    return code


def _configuration(options: argparse.Namespace, folder: Path) -> Config | None:
    """The configuration; None if there is none and none is needed. Raises ConfigError."""
    named = options.config or options.robot or not options.source
    if named or any((place / config.FILE_NAME).is_file() for place in (folder, *folder.parents)):
        return common.configuration(options)
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
