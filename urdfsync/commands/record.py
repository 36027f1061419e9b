"""`urdfsync record`: writes the whole robot as one record, without a configuration, a package or a state."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

import msgspec

from urdfsync import config, registry
from urdfsync.commands import arguments
from urdfsync.dependencies import read_unrecorded
from urdfsync.diagnostics import ConfigError, OutputError
from urdfsync.domain import Target
from urdfsync.engine import source as sources
from urdfsync.engine.generate import Package
from urdfsync.engine.result import Exit
from urdfsync.files import normalised, put, shown
from urdfsync.modelica.names import class_name, is_class_name, is_identifier, is_package_name
from urdfsync.output.console import Console, line

_SUFFIX = "Parameters"


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
    domain = registry.domain(args.domain)
    named, given = arguments.split_sources(args.source, args.parser)
    if len(named) != 1:
        raise arguments.UsageError(args.parser, f"name one source, not {len(named)}")
    source, target = named[0], _target(args, named[0], file)
    text = sources.read_file_source(source, given, config.ros_package_path(os.environ))
    with text.locating():
        snapshot, reading = sources.read(domain, domain.permissive_options(), text.content, text.name)
    reading = msgspec.structs.replace(reading, snapshot=snapshot)
    recorded = domain.record(reading, shown(source), target, domain.options())
    if recorded is None:
        message = f"the domain `{domain.name}` has no record of a whole model"
        raise ConfigError.of("no-record", message, hint="use `urdfsync build`")
    artifact, findings = recorded
    generated = Package([artifact], sources.domain_templates(domain), target.package)
    told = [*text.diagnostics, *map(text.locate, (*reading.diagnostics, *findings))]
    console.warnings(sorted(told, key=lambda diagnostic: diagnostic.line))
    record = generated.content(artifact.path).decode()
    values = {"class": target.name, "within": target.package}
    if file is not None:
        is_written = _write(record, source, file, force=args.force)
        console.tell([line((f"{file} {'written' if is_written else 'unchanged'}: record {target.name}", ""))])
        return console.end(Exit.IN_STEP, values=values | {"file": str(file), "written": is_written})
    if not console.json:
        if hasattr(sys.stdout, "reconfigure") and not sys.stdout.isatty():
            sys.stdout.reconfigure(encoding="utf-8", newline="\n")  # a file is what Modelica tools read
        sys.stdout.write(record)
    return console.end(Exit.IN_STEP, values=values | {"text": record})


def _write(record: str, source: Path, file: Path, *, force: bool) -> bool:
    """Write the record, as a whole or not at all; return whether that was necessary.

    A file that holds something else is replaced with `force` only, the source never. Raises OutputError for that, and
    for what can't be written.
    """
    content = record.encode()
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


def _target(args: argparse.Namespace, source: Path, file: Path | None) -> Target:
    """Return the class: the chosen one, else that of the file if its name can be a class, else one after the source."""
    name, within = args.class_, args.within
    if name and not is_class_name(name):
        hint = "choose one that begins with a capital and is not reserved by Modelica or urdfsync"
        raise ConfigError.of("modelica-name", f"{name!r} can't be a class", hint=hint)
    if within and not all(is_identifier(part) and is_package_name(part) for part in within.split(".")):
        raise ConfigError.of("modelica-name", f"{within!r} can't be a package", hint="name one like Plant.Robots")
    stem = file.stem if file is not None and is_class_name(file.stem) else ""
    return Target(within, name or stem or class_name(source.name.partition(".")[0]) + _SUFFIX)
