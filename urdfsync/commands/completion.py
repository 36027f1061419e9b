"""`urdfsync completion`: prints the script that completes the command line in a shell."""

from __future__ import annotations

import argparse

from urdfsync.commands import arguments
from urdfsync.commands.shells import completion
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "completion",
        help="print the script that completes commands in a shell",
        description="Print the script that completes commands, options, robots and joints in a shell.",
        epilog='examples: eval "$(urdfsync completion bash)"   # in ~/.bashrc; zsh in ~/.zshrc, below compinit\n'
        "          urdfsync completion fish | source   # in ~/.config/fish/config.fish\n"
        "          urdfsync completion powershell | Out-String | Invoke-Expression   # in $PROFILE",
    )
    parser.add_argument("shell", choices=completion.SHELLS, help="the shell")


def run(args: argparse.Namespace, _console: Console) -> int:
    """Print the script."""
    completion.answer([args.shell])
    return Exit.IN_STEP
