"""`urdfsync record`: writes the whole robot as one record, without a configuration, a package or a state."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from urdfsync.api import record
from urdfsync.commands import arguments
from urdfsync.dependencies import read_unrecorded
from urdfsync.diagnostics import OutputError
from urdfsync.engine.result import Exit
from urdfsync.files import normalised, put, shown
from urdfsync.modelica.names import is_class_name
from urdfsync.output.console import Console, line


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "record",
        help="write the whole robot as one record",
        description="Write the record of a source alone: all numbers of the robot, and the tables by which "
        "UrdfSync.Robots.GenericRobot reads them. It needs no urdfsync.toml and leaves nothing else behind; meshes "
        "are not imported. For a record that follows its source, and for a robot whose base floats, use "
        '`approach = ["record"]` in a project: only there is the height computed that it stands at.',
        epilog="examples: urdfsync record robot.urdf\n"
        "          urdfsync record robot.urdf -o modelica/Plant/ArmParameters.mo --within Plant",
    )
    parser.add_argument(
        "source", nargs="+", metavar="SOURCE", help="the URDF or xacro file; for xacro also arguments, NAME:=VALUE"
    )
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="where it goes (default: -, standard output)")
    parser.add_argument("--force", action="store_true", help="replace a FILE that holds something else")
    parser.add_argument(
        "--class",
        dest="class_",
        default="",
        metavar="NAME",
        help="name of the record (default: that of FILE, or of SOURCE)",
    )
    parser.add_argument("--within", default="", metavar="PACKAGE", help="the package that FILE is in (default: none)")
    parser.add_argument("--domain", default="urdf", metavar="NAME", help="format of the source (default: %(default)s)")


def run(args: argparse.Namespace, console: Console) -> int:
    """Write the record to its file or to the standard output."""
    file = None if args.output == Path("-") else args.output
    named, given = arguments.split_sources(args.source, args.parser)
    if len(named) != 1:
        raise arguments.UsageError(args.parser, f"name one source, not {len(named)}")
    name = args.class_ or (file.stem if file is not None and is_class_name(file.stem) else "")
    written = record(named[0], class_=name, within=args.within, domain=args.domain, arguments=given)
    console.warnings(written.diagnostics)
    values = {"class": written.class_, "within": written.within}
    if file is not None:
        is_written = _write(written.text, named[0], file, force=args.force)
        console.tell([line((f"{file} {'written' if is_written else 'unchanged'}: record {written.class_}", ""))])
        return console.end(Exit.IN_STEP, values=values | {"file": str(file), "written": is_written})
    if not console.is_document:
        if hasattr(sys.stdout, "reconfigure") and not sys.stdout.isatty():
            sys.stdout.reconfigure(encoding="utf-8", newline="\n")  # a file is what Modelica tools read
        sys.stdout.write(written.text)
    return console.end(Exit.IN_STEP, values=values | {"text": written.text})


def _write(text: str, source: Path, file: Path, *, force: bool) -> bool:
    """Write the record, as a whole or not at all; return whether that was necessary.

    A file that holds something else is replaced with `force` only, the source never. Raises OutputError for that, and
    for what can't be written.
    """
    content = text.encode()
    try:
        if file.exists():
            if normalised(read_unrecorded(file)) == content:
                return False
            if file.samefile(source):
                message = "the record would replace its source"
                raise OutputError.of("output-is-source", message, shown(file), hint="name another file")
            if not force:
                message, hint = (
                    "the file exists, and holds something else",
                    "name another one, or replace it with --force",
                )
                raise OutputError.of("file-exists", message, shown(file), hint=hint)
        put(file.resolve(), content)
    except OSError as error:
        hint = "check that its folder exists and may be written to, and that there is space on the disk"
        message = f"it can't be written: {error.strerror}"
        raise OutputError.of("output-not-writable", message, shown(file), hint=hint) from None
    return True
