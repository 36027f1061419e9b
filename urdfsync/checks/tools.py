"""The compilers that a user chooses, on the command line or in the configuration."""

from __future__ import annotations

from urdfsync.checks.compilers.compiler import Tool
from urdfsync.config import Config
from urdfsync.config.trust import find_untrusted_compiler
from urdfsync.diagnostics import ConfigError

BOTH = "both"
"""The value of `--tool` that means two compilers, which are held against each other."""
_BOTH = ("rumoca", "omc")


def chosen_tools(config: Config, name: str | None = None, *, trusted: bool = False) -> tuple[Tool, ...]:
    """Return the compilers that are meant by `--tool` (None: by the configuration), one or both.

    `trusted` says whether the user trusts the configuration, which may choose OpenModelica, or name its program: both
    run what is not the user's. Who gives `--tool omc` has chosen it himself.
    """
    names = _BOTH if (name or config.check.tool) == BOTH else [name or config.check.tool]
    return tuple(_tool(config, tool, is_trusted=trusted or (bool(name) and not config.check.omc)) for tool in names)


def _tool(config: Config, name: str, *, is_trusted: bool) -> Tool:
    if name != "omc":
        return Tool(name)
    program = config.check.omc
    try:
        problem = None if is_trusted else find_untrusted_compiler(config)
    except ConfigError as error:  # the user's file of trusted folders can't be read
        problem = error.diagnostics[0]
    return Tool(name, program, problem)
