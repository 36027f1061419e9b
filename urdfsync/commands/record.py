"""`urdfsync record`: writes the whole robot as one record, without a project."""

from __future__ import annotations

import argparse
from pathlib import Path

from urdfsync.commands import common
from urdfsync.outcome import Exit
from urdfsync.report import Report


def add(commands: common.Commands) -> None:
    """Add the command's parser."""
    parser = commands.add_parser(
        "record",
        help="write the whole robot as one record",
        description="Write the record of a source alone: all numbers of the robot, and the tables by which "
        "UrdfSync.Robots.GenericRobot reads them. It needs no urdfsync.toml and leaves nothing else behind; meshes "
        "are not imported. To keep a record in step with its source, build it in a project; do so, too, for a robot "
        "whose base floats: how high it stands is found there.",
        epilog="examples: urdfsync record robot.urdf\n"
        "          urdfsync record robot.urdf -o modelica/Plant/ArmParameters.mo --within Plant\n\n"
        "exit codes: 0 written, or there already; 2 error, 130 interrupted",
    )
    parser.add_argument("source", type=Path, metavar="SOURCE", help="the URDF file")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="where it goes (default: -, standard output)")
    parser.add_argument("--force", action="store_true", help="replace a FILE that holds something else")
    parser.add_argument(
        "--class", dest="class_", default="", metavar="NAME", help="default: as FILE, or after the source"
    )
    parser.add_argument("--within", default="", metavar="PACKAGE", help="the package that FILE is in (default: none)")
    parser.add_argument("--domain", default="urdf", metavar="NAME", help="what the source is (default: %(default)s)")
    parser.set_defaults(run=_run)
    common.add_common(parser)


def _run(options: argparse.Namespace, report: Report) -> int:
    from urdfsync import standalone  # no other command needs it

    file = None if options.output == Path("-") else options.output
    record = standalone.make(options.source, options.domain, options.class_, options.within, file)
    report.warnings(record.diagnostics)
    written = standalone.write(record, options.source, file, options.force) if file is not None else None
    report.record(record, file, written)
    return Exit.IN_STEP
