"""Compilers by the names that users give them."""

from __future__ import annotations

from urdfsync.checking.cache import Cache
from urdfsync.checking.compilers import omc, rumoca
from urdfsync.checking.compilers.compiler import Compiler
from urdfsync.checking.wishes import Tool


def require(tool: Tool) -> None:
    """Raise CompilerError, with what to install, if anything is missing that a check with `tool` needs."""
    (omc if tool == "omc" else rumoca).require()


def compiler(tool: Tool, cache: Cache) -> Compiler:
    """The compiler; what it remembers between its runs is part of `cache`."""
    return omc.OpenModelica() if tool == "omc" else rumoca.Rumoca(cache)
