"""`urdfsync diff --edits`: what the user edited in generated files, by the elements of their classes."""

from __future__ import annotations

import argparse

from urdfsync.api import edits
from urdfsync.engine.edits import RobotEdits
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console
from urdfsync.output.edits import robot_lines, to_document, to_section


def run(args: argparse.Namespace, console: Console) -> int:
    """Show the edits in the files that the paths mean, or in all."""

    def show(edited: RobotEdits) -> None:
        console.add(edited, to_document, to_section)
        console.findings(edited.diagnostics)
        console.tell(robot_lines(edited, verbose=console.verbose))

    options = {"config": args.config, "wait": args.wait, "progress": console.progress, "on_result": show}
    edited = edits(*args.sources, robots=args.robot or (), **options)
    return console.end(Exit.ERROR if any(each.failed for each in edited) else Exit.IN_STEP)
