"""`urdfsync simulate`: simulates a model with a robot's package, and compares the joints with their limits."""

from __future__ import annotations

import argparse
from pathlib import Path

import msgspec

from urdfsync.api import simulate
from urdfsync.checks.compilers import COMPILERS
from urdfsync.commands import arguments
from urdfsync.commands.report import prepare_page
from urdfsync.diagnostics import Severity
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console
from urdfsync.simulation.report import result_lines
from urdfsync.simulation.results import STEPS, STOP, TOLERANCE, SimulateOptions


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "simulate",
        "--wait --trust --set --timeout --memory",
        help="simulate a robot, and compare its joints with their limits",
        description="Simulate the Test model of a robot, or a model of yours, with the package as it is on disk. Show "
        "for each joint its range, speed and effort beside its limits, and warn of exceeded limits. Only the files "
        "that you name are written.",
        epilog="examples: urdfsync simulate arm --plot arm.png\n"
        "          urdfsync simulate --model Plant.Cell --stop 5 --csv cell.csv\n"
        "          urdfsync simulate arm --set robot.elbow.parameters.dynamics.damping=4\n"
        "          urdfsync simulate arm --input motion.csv",
    )
    option = parser.add_argument
    option("robots", nargs="*", metavar="ROBOT", help="the robot, if the project has several")
    option("--model", metavar="NAME", default="", help="the model (default: Test of the robot; with --input, Run)")
    stop = f"end of the simulation (default: as the model says, else {STOP:g})"
    option("--stop", type=arguments.amount, metavar="S", help=stop)
    steps = f"interval of results (default: as the model says, else {STEPS} of them)"
    option("--step", type=arguments.amount, metavar="S", help=steps)
    tolerance = f"tolerance of the integration (default: as the model says, else {TOLERANCE:g})"
    option("--tolerance", type=arguments.amount, metavar="T", help=tolerance)
    methods = "; ".join(f"{', '.join(compiler.METHODS)} ({compiler.TITLE})" for compiler in COMPILERS.values())
    option("--method", metavar="M", default="", help=f"method of the integration: {methods}")
    option("--input", dest="motion", type=Path, metavar="FILE.csv", help="drive the inputs of the model")
    option("--csv", type=Path, metavar="FILE", help="write the series of joints, inputs and outputs")
    more = "another variable for the CSV file, such as 'robot.hand.*'; may be repeated"
    option("--variable", dest="variables", action="append", metavar="PATTERN", default=[], help=more)
    option("--plot", type=Path, metavar="FILE.png|svg", help="draw positions, speeds and efforts against their limits")
    option("--report", type=Path, metavar="FILE.html", help="write a page in which the robot moves, as `report` does")
    arguments.add_tool(parser, {name: compiler.TITLE for name, compiler in COMPILERS.items()})


def run(args: argparse.Namespace, console: Console) -> int:
    """Simulate one robot, write the named files, and show the result."""
    files = {kind: file for kind in ("csv", "plot") if (file := getattr(args, kind)) is not None}
    write_report = prepare_page(args, console, args.report, motion=args.motion) if args.report else None
    extra = {"files": files, "tool": args.tool, "trusted": args.trusted}
    result = arguments.call(simulate, SimulateOptions, args, console, **extra)
    if write_report:
        write_report(simulation=result)
        result = msgspec.structs.replace(result, files=files | {"report": args.report})
    console.add(result)
    console.tell(result_lines(result))
    console.findings(result.diagnostics)
    stopped = any(finding.severity is Severity.ERROR for finding in result.diagnostics)
    return console.end(Exit.ERROR if stopped else Exit.IN_STEP)
