"""`urdfsync identify`: fits the numbers of a robot's records to a log, or finds a motion for one."""

from __future__ import annotations

import argparse
from pathlib import Path

from urdfsync.analysis.identification.report import excitation_lines, identification_lines
from urdfsync.analysis.identification.results import IdentifyOptions
from urdfsync.api import excite, identify
from urdfsync.commands import arguments
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "identify",
        "--wait --column --topic --motor-side",
        help="fit a robot's numbers to what was measured",
        description="Fit friction, drive inertia, mass, centre of mass and inertia in the records of a robot to "
        "recorded positions and efforts of its joints. Numbers that the motion does not determine stay. With --write, "
        "the fitted numbers are edits of the records, as if by hand; else nothing is written.",
        epilog="examples: urdfsync identify arm log.csv --plot arm.png\n"
        "          urdfsync identify arm log.csv --joint elbow --write\n"
        "          urdfsync identify arm log.csv --column elbow.effort=current3*21.5\n"
        "          urdfsync identify arm --excite motion.csv",
    )
    option = parser.add_argument
    option("robots", nargs=1, metavar="ROBOT", help="the robot")
    option("log", nargs="?", type=Path, metavar="FILE", help="the log: CSV, Parquet, or a recording of ROS 2")
    some = "; may be repeated (default: all links and joints)"
    option("--link", dest="links", action="append", metavar="NAME", default=[], help=f"fit the numbers of a link{some}")
    option("--joint", dest="joints", action="append", metavar="NAME", default=[], help=f"fit a joint's losses{some}")
    option(
        "--cutoff", type=arguments.amount, metavar="HZ", help="cut-off frequency of the filter (default: by the motion)"
    )
    option("--until", type=arguments.amount, metavar="S", help="fit the log up to this time, and predict the rest")
    option("--plot", type=Path, metavar="FILE.png|svg", help="draw measured efforts, and those before and after")
    option("--write", action="store_true", help="write the numbers whose change is sure into the records")
    option("--all", dest="unsure", action="store_true", help="with --write: those that are not sure, too")
    option(
        "--excite", type=Path, metavar="FILE.csv", help="write a motion for a log instead, which `simulate` can play"
    )
    option("--seconds", type=arguments.amount, metavar="S", default=20.0, help="duration of that motion (default: 20)")
    option("--seed", type=arguments.seed, default=0, metavar="N", help="seed of that motion (default: 0)")


def run(args: argparse.Namespace, console: Console) -> int:
    """Fit, or find a motion, and show the result."""
    if (args.log is None) == (args.excite is None):
        raise arguments.UsageError(args.parser, "name a log, or a file for a motion with `--excite`")
    if args.excite:
        of_logs = ("write", "cutoff", "until", "columns", "plot", "topic", "motor_side")
        if wrong := [name for name in of_logs if getattr(args, name)]:
            name = wrong[0].removesuffix("s").replace("_", "-")
            raise arguments.UsageError(args.parser, f"`--{name}` is for a log, not for `--excite`")
        motion = arguments.call(
            excite, IdentifyOptions, args, console, file=args.excite, seconds=args.seconds, seed=args.seed
        )
        console.add(motion)
        console.tell(excitation_lines(motion))
        return console.end(Exit.IN_STEP)
    if args.unsure and not args.write:
        raise arguments.UsageError(args.parser, "`--all` needs `--write`")
    files = {"plot": args.plot} if args.plot else {}
    given = {"log": args.log, "files": files, "write": args.write}
    result = arguments.call(identify, IdentifyOptions, args, console, **given)
    console.add(result)
    console.tell(identification_lines(result))
    console.findings(result.diagnostics)
    return console.end(Exit.DOUBTFUL if result.is_doubtful else Exit.IN_STEP)
