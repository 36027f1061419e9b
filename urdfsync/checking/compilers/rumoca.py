"""The embedded compiler, rumoca."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable

from urdfsync.checking.cache import Cache
from urdfsync.checking.compilers.compiler import Tool, ask, ignore, missing
from urdfsync.checking.compilers.tasks import Job, Outcome
from urdfsync.checking.process import Limits
from urdfsync.extras import install_command

RUMOCA = Tool(
    "the compiler",
    "urdfsync.checking.compilers.worker",
    install_command("check"),
    "report it to the authors of rumoca",
)
_NEEDED = ("rumoca", "psutil", "platformdirs")


class Rumoca:
    """The embedded compiler; what it remembers is part of `cache`."""

    def __init__(self, cache: Cache) -> None:
        self._environment = {
            "XDG_CACHE_HOME": str(cache.compiler.parent),  # it adds its own name
            "MODELICAPATH": "",  # it looks there too, for whatever the roots do not have
        }

    def compile(self, job: Job, limits: Limits, tell: Callable[[int, Outcome], None] = ignore) -> list[Outcome]:
        """See `Compiler.compile`."""
        require()
        return ask(RUMOCA, job, limits, self._environment, tell)


def require() -> None:
    """Raise CompilerError, with what to install, if anything is missing that a check needs."""
    for name in _NEEDED:
        if importlib.util.find_spec(name) is None:
            raise missing(RUMOCA, f"{name} is not installed")
