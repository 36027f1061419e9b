"""`urdfsync init`: writes a configuration for some sources."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from urdfsync import config
from urdfsync.commands import arguments
from urdfsync.config import shown
from urdfsync.outcome import Exit
from urdfsync.output.console import Console, StyledLine, line

if TYPE_CHECKING:
    from urdfsync.config.init import Draft


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "init",
        run,
        help="write a commented urdfsync.toml",
        description="Write a commented urdfsync.toml for some sources, with guesses and their reasons.",
        epilog="example: urdfsync init cad/arm.urdf cad/gripper.urdf",
    )
    parser.add_argument("sources", nargs="*", type=Path, metavar="SOURCE", help="default: all below this folder")
    parser.add_argument("--domain", default="urdf", metavar="NAME", help="what the sources are (default: %(default)s)")


def run(args: argparse.Namespace, console: Console) -> Exit:
    """Write the configuration, and show what was guessed."""
    from urdfsync.config import init  # no other command writes TOML

    draft = init.make_draft(config.working_folder() / (args.config or config.FILE_NAME), args.sources, args.domain)
    init.write(draft)
    console.warnings(draft.diagnostics)
    if console.json:
        console.write_json("init", Exit.IN_STEP, _values(draft))
    elif not console.quiet:
        console.print(_lines(draft))
    return Exit.IN_STEP


def _values(draft: Draft) -> dict[str, Any]:
    robots = [
        {
            "name": guess.robot,
            "source": guess.source,
            "package": guess.package,
            "options": [{"option": o.option, "value": o.value, "reason": o.reason} for o in guess.options],
        }
        for guess in draft.guesses
    ]
    return {"config": str(draft.file), "robots": robots}


def _lines(draft: Draft) -> Iterator[StyledLine]:
    yield line((shown(draft.file), "bold"), (" written", ""))
    for guess in draft.guesses:
        name, package = (guess.robot, "bold"), (guess.package, "bold")
        yield line(("  ", ""), name, (f": {guess.source} becomes package ", ""), package)
        for option in guess.options:
            value = json.dumps(option.value)
            yield line((f"    {option.option} = {value}", ""), (f"  guessed: {option.reason}", "dim"))
    yield line(("Look it over, then run `urdfsync build`.", ""))
