"""`urdfsync record`: writes the whole robot as one record, without a configuration, a package or a state."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import msgspec

from urdfsync.analysis.simulation.files import check_file, write_file
from urdfsync.api import record
from urdfsync.commands import arguments
from urdfsync.common.dependencies.facts import read_unrecorded
from urdfsync.common.diagnostics import OutputError
from urdfsync.common.files import normalised, shown
from urdfsync.engine.result import Exit
from urdfsync.modelica.names import is_class_name
from urdfsync.output.console import Console, line


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "record",
        help="write the whole robot as one record",
        description="Write the record of a source alone: all numbers of the robot, and the tables by which "
        "UrdfSync.Robots.GenericRobot reads them. The command needs no urdfsync.toml, writes no other file, and "
        'imports no meshes. For a record that follows its source, use `approach = ["record"]` in a project. Do the '
        "same for a floating base: only a project computes the height at which the robot stands.",
        epilog="examples: urdfsync record robot.urdf\n"
        "          urdfsync record robot.urdf -o modelica/Plant/ArmParameters.mo --within Plant",
    )
    option = parser.add_argument
    source = "the URDF or xacro file; for xacro also arguments, NAME:=VALUE"
    option("source", nargs="+", metavar="SOURCE", help=source)
    option("-o", "--output", type=Path, metavar="FILE", help="the record's file (default: -, standard output)")
    option("--force", action="store_true", help="replace a FILE that holds something else")
    name = "name of the record (default: that of FILE, or of SOURCE)"
    option("--class", dest="class_", default="", metavar="NAME", help=name)
    option("--within", default="", metavar="PACKAGE", help="the package that FILE is in (default: none)")
    option("--domain", default="urdf", metavar="NAME", help="format of the source (default: %(default)s)")


def run(args: argparse.Namespace, console: Console) -> int:
    """Write the record to its file or to the standard output."""
    file = None if args.output == Path("-") else args.output
    named = arguments.split_sources(args.source, args.parser)
    if len(named) != 1:
        raise arguments.UsageError(args.parser, f"name one source, not {len(named)}")
    ((source, given),) = named
    name = args.class_ or (file.stem if file is not None and is_class_name(file.stem) else "")
    written = record(source, class_=name, within=args.within, domain=args.domain, arguments=given)
    if file is not None:
        is_written = _write(written.text, source, file, force=args.force)
        console.tell([line((f"{file} {'written' if is_written else 'unchanged'}: record {written.name}", ""))])
        written = msgspec.structs.replace(written, file=file, is_written=is_written)
    elif not console.is_document:
        if hasattr(sys.stdout, "reconfigure") and not sys.stdout.isatty():
            sys.stdout.reconfigure(encoding="utf-8", newline="\n")  # as in a file: Modelica tools read UTF-8
        sys.stdout.write(written.text)
    console.add(written)
    return console.end(Exit.IN_STEP, written.diagnostics)


def _write(text: str, source: Path, file: Path, *, force: bool) -> bool:
    """Write the record, as a whole or not at all; return whether it changed.

    Raises OutputError if writing fails, if the file is the source, or without `force` if it holds something else.
    """
    check_file(file, {"the source": source})
    content = text.encode()
    if file.exists():
        if normalised(read_unrecorded(file)) == content:
            return False
        if not force:
            message = "the file exists, and holds something else"
            hint = "name another file, or replace this one with --force"
            raise OutputError.of("file-exists", message, shown(file), hint=hint)
    write_file(file, content)
    return True
