"""`urdfsync fmu`: exports a model with a robot's package as FMU, by OpenModelica."""

from __future__ import annotations

import argparse
from pathlib import Path

from urdfsync.api.simulations import EXPORTED, VERSIONS, export_fmu
from urdfsync.commands import arguments
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console
from urdfsync.simulation.export import TOLERANCE
from urdfsync.simulation.report import fmu_lines, fmu_to_json
from urdfsync.simulation.results import STOP


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "fmu",
        "--robot --wait --trust --set --timeout --memory",
        help="export a robot as FMU, by OpenModelica",
        description="Export the Run model of a robot, or a model of yours, as FMU, with the package as it is on disk. "
        "It has the inputs and outputs of the model by their names. OpenModelica has to be there. With --check FMPy "
        "validates the FMU, and its trajectory is compared with that of `urdfsync simulate`.",
        epilog="examples: urdfsync fmu arm\n"
        "          urdfsync fmu arm --fmi 3 --kind cs --output arm.fmu --check\n"
        "          urdfsync fmu arm --input motion.csv --check",
    )
    option = parser.add_argument
    option("robots", nargs="*", metavar="ROBOT", help="the robot, if there is more than one")
    option("--model", metavar="NAME", default="", help="the model (default: Run of the robot, else Test)")
    option("--output", type=Path, metavar="FILE.fmu", help="where to write it (default: the model's name, here)")
    option("--fmi", choices=tuple(VERSIONS), default="2", help="the version of FMI (default: 2)")
    option(
        "--kind", choices=tuple(EXPORTED), default="both", help="model exchange, co-simulation or both (default: both)"
    )
    tolerance = f"of the integration inside, for co-simulation (default: {TOLERANCE:g})"
    option("--tolerance", type=arguments.amount, metavar="T", help=tolerance)
    stop = f"end of the simulation that the FMU proposes (default: as the model says, else {STOP:g})"
    option("--stop", type=arguments.amount, metavar="S", help=stop)
    option("--step", type=arguments.amount, metavar="S", help="the step that it proposes (default: likewise)")
    option("--check", action="store_true", help="validate it with FMPy, and compare its trajectory with `simulate`")
    option("--input", dest="motion", type=Path, metavar="FILE.csv", help="the motion for the check (default: at rest)")


def run(args: argparse.Namespace, console: Console) -> int:
    """Export one model, check it if that is wanted, and write it."""
    if args.motion and (args.kind == "me" or not args.check):
        message = "`--input` is the motion for `--check` of co-simulation"
        raise arguments.UsageError(args.parser, message, "give both, with `--kind cs` or `both`")
    written = arguments.call(export_fmu, args, console)
    console.add_robot(fmu_to_json(written))
    console.tell(fmu_lines(written))
    console.findings(written.diagnostics)
    return console.end(Exit.OUT_OF_STEP if written.warnings else Exit.IN_STEP)
