"""`urdfsync init`: writes a configuration for some sources."""

from __future__ import annotations

import argparse
from pathlib import Path

from urdfsync.commands import common
from urdfsync.outcome import Exit
from urdfsync.report import Report


def add(commands: common.Commands) -> None:
    """Add the command's parser."""
    parser = commands.add_parser(
        "init",
        help="write a commented urdfsync.toml",
        description="Write a commented urdfsync.toml for some sources, with guesses and their reasons.",
        epilog="example: urdfsync init cad/arm.urdf cad/gripper.urdf",
    )
    parser.add_argument("sources", nargs="*", type=Path, metavar="SOURCE", help="default: all below this folder")
    parser.add_argument("--domain", default="urdf", metavar="NAME", help="what the sources are (default: %(default)s)")
    parser.set_defaults(run=_run)
    common.add_common(parser)


def _run(options: argparse.Namespace, report: Report) -> int:
    from urdfsync import init

    draft = init.draft(common.default_file(options), options.sources, options.domain)
    init.write(draft)
    report.draft(draft)
    return Exit.IN_STEP
