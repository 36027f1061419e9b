"""`urdfsync hook`: judges what is being committed, for pre-commit and other runners of git hooks."""

from __future__ import annotations

import argparse
from pathlib import Path

from urdfsync.commands import common
from urdfsync.config import FILE_NAME
from urdfsync.report import Report


def add(commands: common.Commands) -> None:
    """Add the command's parser."""
    parser = commands.add_parser(
        "hook",
        help="judge what is being committed; for hooks of git",
        description="Judge staged sources against staged outputs, for all configurations that git tracks. The index is "
        "never touched.",
        epilog=f"example: urdfsync hook check\n\n{common.CODES}",
    )
    modes = "build brings packages in step, check writes nothing"
    parser.add_argument("mode", choices=("build", "check"), help=modes)
    parser.add_argument(
        "configs", nargs="*", type=Path, metavar="CONFIG", help=f"only these, instead of all {FILE_NAME}"
    )
    common.add_wait(parser)
    common.add_jobs(parser)
    parser.set_defaults(run=_run)
    common.add_common(parser)


def _run(options: argparse.Namespace, report: Report) -> int:
    from urdfsync.staging import committing  # not at the top: no other command needs git or temporary folders

    writing, named = options.mode == "build", [*options.configs, *filter(None, [options.config])]
    return committing.run(common.request(options, report), writing, named, report, options.json)
