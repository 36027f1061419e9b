"""`urdfsync library`: says where the Modelica library is."""

from __future__ import annotations

import argparse

from urdfsync import config
from urdfsync.commands import common
from urdfsync.outcome import Exit
from urdfsync.report import Report


def add(commands: common.Commands) -> None:
    """Add the command's parser."""
    parser = commands.add_parser(
        "library",
        help="print where the Modelica library is",
        description="Print the folder of the Modelica library, and the line that puts it on MODELICAPATH. "
        "Into a pipe or a file goes the line alone.",
        epilog='example: eval "$(urdfsync library)"',
    )
    parser.set_defaults(run=_run)
    common.add_common(parser)


def _run(_options: argparse.Namespace, report: Report) -> int:
    report.library(config.library_folder())
    return Exit.IN_STEP
