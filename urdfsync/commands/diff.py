"""`urdfsync diff`: shows what changed since the last build, or between two versions of a source."""

from __future__ import annotations

import argparse

import msgspec

from urdfsync.analysis.versions import report
from urdfsync.analysis.versions.comparison import Comparison, exit_code
from urdfsync.api import compare, load
from urdfsync.commands import arguments
from urdfsync.common.files import shown
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Exit
from urdfsync.output.build_section import show
from urdfsync.output.console import Console, line
from urdfsync.project.config import Config


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "diff",
        "--wait",
        formats=True,
        help="show what changed in the sources since the last build",
        description="Show the changes of a source since the last build, or since another version of the source: "
        "changed elements, effects on the whole model, and changed files. Two sources that are no robots of a "
        "configuration stand side by side: then only differences in motion are shown. Nothing is written.",
        epilog="examples: urdfsync diff cad/arm.urdf\n"
        "          urdfsync diff arm --against HEAD~1\n"
        "          urdfsync diff cad/arm.urdf --against old/arm.urdf\n"
        "          urdfsync diff arm.urdf arm.xml\n"
        "          urdfsync diff --edits modelica/Arm/Links\n"
        "          urdfsync diff --edits --patch | git apply",
    )
    parser.add_argument(
        "sources", nargs="*", metavar="SOURCE", help="sources or robots, with --edits also outputs (default: all)"
    )
    other = parser.add_mutually_exclusive_group()
    other.add_argument("--against", metavar="VERSION", help="the older version: git revision, else file")
    other.add_argument("--edits", action="store_true", help="show what you edited in the packages instead")
    words = "with --edits: write the edits that the sources can state as a patch of the sources; tell what stays"
    parser.add_argument("--patch", action="store_true", help=words)


def run(args: argparse.Namespace, console: Console) -> int:
    """Show what changed in each source, or what the user edited."""
    if args.patch:
        return _write_patch(args, console)
    options = BuildOptions(wait=args.wait, progress=console.progress)
    config = None if args.sources else load(args.config)
    if config:
        console.announce(len(config.robots))
    if args.edits:
        return _show_edits(args, console, config or load(args.config), options)
    comparisons = list[Comparison]()
    for comparison in compare(args.sources, args.against, config or args.config, options):
        show(console, comparison, report.to_section, comparison.result)
        comparisons.append(comparison)
    return console.end(exit_code(comparisons))


def _write_patch(args: argparse.Namespace, console: Console) -> int:
    """Write the patch of the sources on the output stream, and what stays on the error stream."""
    if not args.edits or console.is_document:
        message = "--patch writes a patch of what --edits shows" if not args.edits else "--patch writes no document"
        hint = "add --edits" if not args.edits else "leave out --format; --edits alone can write a document"
        raise arguments.UsageError(args.parser, message, hint)
    from urdfsync.analysis.patches.patch import RobotPatch, find_patches, patch_text  # the merge takes a while to load

    config, patches = load(args.config), list[RobotPatch]()
    for patch in find_patches(args.sources, config, BuildOptions(dry=True, wait=args.wait, progress=console.progress)):
        patches.append(patch)
        console.findings(patch.diagnostics)
        staying = [f"{shown(config.root / each.file)}: {each.told}" for each in patch.staying]
        console.print((line((text, "")) for text in staying if not console.quiet), error=True)
    console.write(patch_text(config, patches))
    return console.end(Exit.ERROR if any(patch.failed for patch in patches) else Exit.IN_STEP)


def _show_edits(args: argparse.Namespace, console: Console, config: Config, options: BuildOptions) -> int:
    """Show the user's edits of each robot."""
    from urdfsync.engine.edits import find_edits  # the merge takes a while to load
    from urdfsync.output.edits import to_section

    has_failed = False
    for edited in find_edits(args.sources, config, msgspec.structs.replace(options, dry=True)):
        show(console, edited, to_section)
        has_failed |= edited.failed
    return console.end(Exit.ERROR if has_failed else Exit.IN_STEP)
