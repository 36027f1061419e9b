"""Modelica compilers. A job is done in a process of its own: it may crash, and keeps gigabytes for large robots."""

from __future__ import annotations

import contextlib
import importlib.metadata
import importlib.util
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path

from urdfsync.check import process
from urdfsync.check.cache import UserCache
from urdfsync.check.compilers import omc, rumoca
from urdfsync.check.compilers.compiler import CompileJob, Compiler, CompilerError, CompileResult
from urdfsync.check.process import BrokenProcessError, Limits
from urdfsync.diagnostics import Diagnostic, Severity

COMPILERS: Mapping[str, Compiler] = {"rumoca": rumoca, "omc": omc}
"""By the value of `--tool`, the default first."""


def find_missing(name: str) -> Diagnostic | None:
    """Return what a check with this compiler lacks, with what to install; None if all is there."""
    compiler = COMPILERS[name]
    for module in compiler.MODULES:
        if importlib.util.find_spec(module) is None:
            return _missing(compiler, f"{module} is not installed")
    return _missing(compiler, f"`{name}` is not on the PATH") if compiler.program() is None else None


def installed_version(name: str, *others: str) -> str:
    """The versions of a compiler and of other distributions, for the keys of results; empty for what is not there."""
    compiler, found = COMPILERS[name], []
    for distribution in (*compiler.MODULES, *others):
        with contextlib.suppress(importlib.metadata.PackageNotFoundError):
            found.append(f"{distribution} {importlib.metadata.version(distribution)}")
    if program := compiler.program():
        with contextlib.suppress(OSError):
            found.append(f"{Path(program).resolve()} {Path(program).stat().st_mtime_ns}")
    return "; ".join(found)


def run_job(
    name: str, job: CompileJob, cache: UserCache, limits: Limits, progress: Callable[[], None] | None = None
) -> list[CompileResult]:
    """Do the tasks of a job in a process; returns a result for each, in order. `progress` is as in `process.run`.

    A model that does not compile is a result. Raises CompilerError if the compiler is missing or breaks down, and
    LimitError.
    """
    compiler = COMPILERS[name]
    if missing := find_missing(name):
        raise CompilerError(missing)
    with tempfile.TemporaryDirectory(prefix="urdfsync-", ignore_cleanup_errors=True) as folder:
        environment = compiler.environment(str(cache.compiler), folder)
        try:
            return process.run(compiler.work, job, limits=limits, environment=environment, progress=progress)
        except ImportError as error:
            raise CompilerError(_missing(compiler, f"{compiler.TITLE} does not start: {error}")) from None
        except BrokenProcessError as error:
            task = job.tasks[min(len(error.results), len(job.tasks) - 1)].title
            message = f"{compiler.TITLE} crashed at {task}: {error}"
            killed = "probably the system was out of memory: check fewer robots at a time (--jobs)"
            hint = killed if error.was_killed else compiler.REPORT
            raise CompilerError(Diagnostic(Severity.ERROR, "compiler-crashed", message, hint=hint)) from error


def _missing(compiler: Compiler, reason: str) -> Diagnostic:
    message = f"there is no compiler: {reason}"
    return Diagnostic(Severity.ERROR, "no-compiler", message, hint=compiler.INSTALL)
