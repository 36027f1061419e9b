"""`urdfsync simulate`: simulates a model with a robot's package, and compares the joints with their limits."""

from __future__ import annotations

import argparse
from pathlib import Path

import msgspec

from urdfsync.analysis.checks.compilers import COMPILERS
from urdfsync.analysis.simulation.cases import SAMPLES
from urdfsync.analysis.simulation.files import check_distinct
from urdfsync.analysis.simulation.report import result_lines, study_lines
from urdfsync.analysis.simulation.results import STEPS, STOP, TOLERANCE, SimulateOptions, VaryOptions
from urdfsync.api import simulate, vary
from urdfsync.commands import arguments
from urdfsync.commands.report import prepare_page
from urdfsync.common.diagnostics import Severity
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "simulate",
        "--wait --trust --set --jobs --timeout --memory",
        help="simulate a robot, and compare its joints with their limits",
        description="Simulate the Test model of a robot, or a model of yours, with the package as it is on disk. Show "
        "for each joint its range, speed and effort beside its limits, and warn of exceeded limits. Only the files "
        "that you name are written.",
        epilog="examples: urdfsync simulate arm --plot arm.png\n"
        "          urdfsync simulate --model Plant.Cell --stop 5 --csv cell.csv\n"
        "          urdfsync simulate arm --set robot.elbow.parameters.dynamics.damping=4\n"
        "          urdfsync simulate arm --input motion.csv\n"
        "          urdfsync simulate arm --against HEAD~1 --plot before_and_now.png\n"
        "          urdfsync simulate arm --vary robot.hand.parameters.inertial.mass=0..5 --cases 200 --csv cases.csv",
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
    older = "simulate the model of a git revision, too, and compare the joints"
    option("--against", type=arguments.revision, metavar="REVISION", help=older)
    option("--csv", type=Path, metavar="FILE", help="write the series of joints, inputs and outputs, or all cases")
    more = "another variable for the CSV file, such as 'robot.hand.*'; may be repeated"
    option("--variable", dest="variables", action="append", metavar="PATTERN", default=[], help=more)
    option("--plot", type=Path, metavar="FILE.png|svg", help="draw positions, speeds and efforts against their limits")
    option("--report", type=Path, metavar="FILE.html", help="write a page in which the robot moves, as `report` does")
    spec = "simulate many cases: a parameter and 0..1 or normal(1,0.1) to sample, [1,2] or 0..1/5 for each value; may "
    spec += "be repeated; or a CSV file, whose header names parameters"
    option("--vary", action="append", metavar="NAME=SPEC|FILE.csv", default=[], help=spec)
    option("--cases", type=arguments.count, metavar="N", help=f"number of samples for --vary (default: {SAMPLES})")
    option("--seed", type=arguments.seed, metavar="N", help="seed of the samples (default: 0)")
    kinds = "Latin hypercube, or independent random samples (default: latin)"
    option("--sampling", choices=("latin", "random"), help=kinds)
    arguments.add_tool(parser, {name: compiler.TITLE for name, compiler in COMPILERS.items()})


def run(args: argparse.Namespace, console: Console) -> int:
    """Simulate one robot, write the named files, and show the result."""
    files = {kind: file for kind in ("csv", "plot") if (file := getattr(args, kind)) is not None}
    if args.vary:
        return _run_cases(args, console, files)
    for name in ("cases", "seed", "sampling", "jobs"):
        if getattr(args, name) is not None:
            raise arguments.UsageError(args.parser, f"`--{name}` needs `--vary`")
    if args.variables and not (args.csv or args.plot):
        message = "`--variable` adds a variable to a file, and no file is named"
        raise arguments.UsageError(args.parser, message, "give `--csv FILE`, too")
    write_report = None
    if args.report:
        check_distinct(files | {"report": args.report})
        write_report = prepare_page(args, console, args.report, against=args.against, motion=args.motion)
    extra = {"files": files, "tool": args.tool, "trusted": args.trusted, "progress": console.telling()}
    result = arguments.call(simulate, SimulateOptions, args, console, **extra)
    if write_report:
        write_report(simulation=result)
        result = msgspec.structs.replace(result, files=files | {"report": args.report})
    console.add(result)
    console.tell(result_lines(result))
    console.findings(result.diagnostics)
    stopped = any(finding.severity is Severity.ERROR for finding in result.diagnostics)
    return console.end(Exit.ERROR if stopped else Exit.IN_STEP)


def _run_cases(args: argparse.Namespace, console: Console, files: dict[str, Path]) -> int:
    """Simulate many cases of one robot. A failed case is a difference, since the others have results."""
    if args.report or args.variables or args.against:
        message = "`--vary` has no page, no `--variable` and no `--against`: simulate one case with them"
        raise arguments.UsageError(args.parser, message, "the worst case is shown with its command")
    sampling = {"seed": args.seed or VaryOptions().seed, "sampling": args.sampling or VaryOptions().sampling}
    extra = {"files": files, "tool": args.tool, "trusted": args.trusted, "progress": console.telling(), **sampling}
    study = arguments.call(vary, VaryOptions, args, console, **extra)
    console.add(study)
    console.tell(study_lines(study))
    console.findings(study.diagnostics)
    return console.end(Exit.OUT_OF_STEP if study.failed else Exit.IN_STEP)
