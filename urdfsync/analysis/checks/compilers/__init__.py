"""Modelica compilers. Each job runs in its own process: a compiler may crash, and never frees its gigabytes."""

from __future__ import annotations

import importlib.util
import tempfile
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from typing import cast, get_args

import msgspec

from urdfsync.analysis.checks import process
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.compilers.compiler import CompileJob, Compiler, CompilerError, CompileResult, Tool
from urdfsync.analysis.checks.process import BrokenProcessError, Limits
from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.project.config import Config, settings
from urdfsync.project.config.trust import find_untrusted_compiler

COMPILERS: Mapping[str, Compiler] = {
    name: cast(Compiler, import_module(f"{__name__}.{name}")) for name in get_args(settings.CompilerName)
}
"""The compilers by the value of `--tool`, the default first."""
BOTH = "both"
"""The value of `--tool` that compares two compilers."""
_BOTH = ("rumoca", "omc")


def choose(config: Config, name: str | None = None, *, trusted: bool = False) -> tuple[Tool, ...]:
    """Return the one or two compilers that `--tool` chooses; if `name` is None, the configuration chooses them.

    `trusted` says whether the user trusts the configuration: it may choose a program, or a compiler that lets models
    start programs. `--tool omc` needs no trust: the user chose it.
    """
    chosen = name or config.check.tool
    if chosen not in {*COMPILERS, BOTH}:
        hint = f"use one of {', '.join([*COMPILERS, BOTH])}"
        raise ConfigError.of("unknown-compiler", f"there is no compiler {chosen!r} to check with", hint=hint)
    return tuple(
        _tool(config, each, is_trusted=trusted or (bool(name) and not config.check.program(each)))
        for each in (_BOTH if chosen == BOTH else [chosen])
    )


def _tool(config: Config, name: str, *, is_trusted: bool) -> Tool:
    compiler, problem = COMPILERS[name], None
    if compiler.STARTS_PROGRAMS and not is_trusted:
        try:
            problem = find_untrusted_compiler(config, name, compiler.TITLE)
        except ConfigError as error:  # the user's file of trusted folders is unreadable
            problem = error.diagnostics[0]
    return Tool(name, config.check.program(name), problem)


def find_missing(tool: Tool) -> Diagnostic | None:
    """Return why a compiler can't be started, with a hint; None if the compiler can be started."""
    compiler = COMPILERS[tool.name]
    for module in compiler.MODULES:
        if importlib.util.find_spec(module) is None:
            return _missing(compiler, f"{module} is not installed")
    if tool.problem is None and compiler.program(tool.program) is None:
        named = f"`{tool.program}` is no program; `{tool.name}` in the table `[check]` names it"
        return _missing(compiler, named if tool.program else f"`{tool.name}` is not on the PATH")
    return tool.problem


def state(tool: Tool, hashed: Callable[[Path], str]) -> list[str]:
    """Return a compiler's state: hashes of its files by `hashed`, and its stated version; or a problem.

    Raises OSError for unreadable files.
    """
    if missing := find_missing(tool):
        return [tool.name, str(missing)]
    version, places = COMPILERS[tool.name].state(tool.program)
    return [tool.name, version, *(f"{place} {hashed(place)}" for place in places)]


def run_job(
    tool: Tool,
    job: CompileJob,
    cache: UserCache,
    limits: Limits,
    progress: Callable[[], None] | None = None,
    on_result: Callable[[CompileResult], None] | None = None,
) -> list[CompileResult]:
    """Do the tasks of a job in a process; returns a result for each, in order.

    `progress` and `on_result` are as in `process.run`.

    A model that does not compile raises no error: its result has the problem. Raises CompilerError if the compiler is
    missing or breaks down, and LimitError.
    """
    compiler = COMPILERS[tool.name]
    if missing := find_missing(tool):
        raise CompilerError(missing)
    job = msgspec.structs.replace(job, program=tool.program)
    with tempfile.TemporaryDirectory(prefix="urdfsync-", ignore_cleanup_errors=True) as folder:
        environment = compiler.environment(str(cache.compiler), folder)
        try:
            return process.run(
                compiler.work, job, limits=limits, environment=environment, progress=progress, on_result=on_result
            )
        except ImportError as error:
            raise CompilerError(_missing(compiler, f"{compiler.TITLE} does not start: {error}")) from None
        except BrokenProcessError as error:
            task = job.tasks[min(len(error.results), len(job.tasks) - 1)].title
            message = f"{compiler.TITLE} crashed at {task}: {error}"
            killed = "probably the system was out of memory: check fewer robots at a time (--jobs)"
            hint = killed if error.was_killed else f"report the crash to the authors of {compiler.TITLE}"
            raise CompilerError.of("compiler-crashed", message, hint=hint) from error


def _missing(compiler: Compiler, reason: str) -> Diagnostic:
    message = f"there is no compiler: {reason}"
    return Diagnostic(Severity.ERROR, "no-compiler", message, hint=compiler.INSTALL)
