"""The compilers that a user chooses, on the command line or in the configuration."""

from __future__ import annotations

from urdfsync.check.compilers import COMPILERS
from urdfsync.check.compilers.compiler import Tool
from urdfsync.config import Config
from urdfsync.config.trust import find_untrusted_compiler
from urdfsync.diagnostics import ConfigError

BOTH = "both"
"""The value of `--tool` that means all compilers."""


def chosen_tools(config: Config, name: str | None = None, *, trusted: bool = False) -> tuple[Tool, ...]:
    """Return the compilers that are meant by `--tool` (None: by the configuration), one or both.

    `trusted` says whether the user trusts the program that the configuration names.
    """
    name = name or config.check.tool
    return tuple(_tool(config, one, trusted) for one in (COMPILERS if name == BOTH else [name]))


def _tool(config: Config, name: str, trusted: bool) -> Tool:
    program = config.check.omc if name == "omc" else ""
    try:
        problem = find_untrusted_compiler(config) if program and not trusted else None
    except ConfigError as error:  # the user's file of trusted folders can't be read
        problem = error.diagnostics[0]
    return Tool(name, program, problem)
