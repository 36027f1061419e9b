"""`urdfsync fmu`: exports a model with a robot's package as FMU, by OpenModelica."""

from __future__ import annotations

import argparse
import importlib.util
from pathlib import Path

from urdfsync.analysis.checks import compilers
from urdfsync.analysis.checks.compilers.compiler import Export
from urdfsync.analysis.simulation.export import TOLERANCE, export, is_exported
from urdfsync.analysis.simulation.files import check_file, default_file, input_files, not_writable, write_file
from urdfsync.analysis.simulation.fmu import KINDS, WrittenFmu, find_faults, try_out
from urdfsync.analysis.simulation.report import fmu_lines
from urdfsync.analysis.simulation.results import STOP, SimulateOptions
from urdfsync.commands import arguments
from urdfsync.common.diagnostics import ConfigError
from urdfsync.common.extras import install_command
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console

_VERSIONS = {"2": "2.0", "3": "3.0"}
_EXPORTED = {"me": "me", "cs": "cs", "both": "me_cs"}


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "fmu",
        "--wait --trust --set --timeout --memory",
        help="export a robot as FMU, by OpenModelica",
        description="Export the Run model of a robot, or a model of yours, as FMU, with the package as it is on disk. "
        "The FMU has the model's inputs and outputs under their names. The export needs OpenModelica. With --check, "
        "FMPy validates and runs the FMU, and urdfsync compares the result with `urdfsync simulate`.",
        epilog="examples: urdfsync fmu arm\n"
        "          urdfsync fmu arm --fmi 3 --kind cs -o arm.fmu --check\n"
        "          urdfsync fmu arm --input motion.csv --check",
    )
    option = parser.add_argument
    option("robots", nargs="*", metavar="ROBOT", help="the robot, if the project has several")
    option("--model", metavar="NAME", default="", help="the model (default: Run of the robot, else Test)")
    option("-o", "--output", type=Path, metavar="FILE.fmu", help="the FMU's file (default: the model's name, here)")
    option("--fmi", choices=tuple(_VERSIONS), default="2", help="the version of FMI (default: 2)")
    kind = "model exchange, co-simulation or both (default: both)"
    option("--kind", choices=tuple(_EXPORTED), default="both", help=kind)
    tolerance = f"tolerance of the FMU's own integration, for co-simulation (default: {TOLERANCE:g})"
    option("--tolerance", type=arguments.amount, metavar="T", help=tolerance)
    stop = f"end of the simulation that the FMU proposes (default: as the model says, else {STOP:g})"
    option("--stop", type=arguments.amount, metavar="S", help=stop)
    option("--step", type=arguments.amount, metavar="S", help="the step that the FMU proposes (default: the model's)")
    option("--check", action="store_true", help="validate the FMU with FMPy, and compare it with `simulate`")
    option("--input", dest="motion", type=Path, metavar="FILE.csv", help="the motion for the check (default: at rest)")


def run(args: argparse.Namespace, console: Console) -> int:
    """Export one model as an FMU, check the FMU on demand, and write it."""
    configuration, robot = arguments.select_robot(args, console)
    if args.check and importlib.util.find_spec("fmpy") is None:
        raise ConfigError.of("no-fmpy", "`--check` needs FMPy, which is not installed", hint=install_command("fmu"))
    if args.motion and (args.kind == "me" or not args.check):
        message = "`--input` is the motion for `--check` of co-simulation"
        raise arguments.UsageError(args.parser, message, "give `--check`, too, and `--kind cs` or `both`")
    if args.output and args.output.suffix.lower() != ".fmu":
        raise not_writable(args.output, "an FMU's name ends with .fmu", "name such a file")
    if args.output:
        check_file(args.output, input_files(configuration, robot, args.motion))
    (tool,) = compilers.choose(configuration, "omc", trusted=args.trusted)
    options = SimulateOptions(tool=tool, **arguments.chosen(SimulateOptions, args))
    kind = Export(_VERSIONS[args.fmi], _EXPORTED[args.kind])
    exported = export(configuration, robot, options, kind, console.telling(), for_trial=args.check)
    file = args.output or default_file(f"{exported.model.rpartition('.')[2]}.fmu", is_exported)
    kinds = [name for name in KINDS if name in kind.kind]
    trial = try_out(configuration, robot, options, exported, kinds, console.progress) if args.check else None
    write_file(file, exported.content)
    warnings = robot.without_ignored(find_faults(trial, file)) if trial else ()
    written = WrittenFmu(robot.name, exported, kind, file, trial, (*exported.diagnostics, *warnings))
    console.add(written)
    console.tell(fmu_lines(written))
    console.findings(written.diagnostics)
    return console.end(Exit.OUT_OF_STEP if warnings else Exit.IN_STEP)
