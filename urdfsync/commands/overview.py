"""The program's help, from the table of the shells: loading the parsers of all commands takes 200 ms."""

from __future__ import annotations

from urdfsync.commands.shells import completion
from urdfsync.common import streams
from urdfsync.common.version import __version__

CODES = (
    "exit codes: 0 in step or done, 1 out of step or different, 2 error, 3 conflict or broken, "
    "4 another build is running, 5 a log of another robot, 130 interrupted"
)
VERSION = f"urdfsync {__version__}"


def answer(option: str) -> str:
    """Print the version or the help. Returns why the output is incomplete; empty if it is complete."""
    with streams.SafeStreams() as output:
        output.write(f"{VERSION}\n" if option == "--version" else help_text())
        return output.trouble


def help_text() -> str:
    """Return the help."""
    commands = "\n".join(f"  {name:<14}{meaning}" for name, meaning in completion.complete([""]))
    return f"""\
usage: urdfsync [-h] [--version] COMMAND ...

Keeps Modelica models in step with URDF files, and leaves alone what you edited.

options:
  -h, --help    show this help message and exit
  --version     show program's version number and exit

commands:
{commands}

Begin with `urdfsync init robot.urdf`, then `urdfsync build`.

{CODES}
"""
