"""Modelica compilers. Each works in a process of its own: it may crash, and keeps gigabytes for large robots."""

from __future__ import annotations

import contextlib
import importlib.metadata
import importlib.util
import os
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

import msgspec

from urdfsync import processes
from urdfsync.check.cache import UserCache
from urdfsync.check.compilers import omc, rumoca
from urdfsync.check.compilers.compiler import CompileJob, Compiler, CompilerError, CompileResult
from urdfsync.diagnostics import Diagnostic, Severity

COMPILERS: Mapping[str, Compiler] = {"rumoca": rumoca, "omc": omc}
"""By the value of `--tool`, the default first."""
MISSING = 3
"""Exit code of a process without its compiler; the last line that it writes to stderr says why there is none."""


def require(name: str) -> None:
    """Raise CompilerError, with what to install, if anything is missing that a check with this compiler needs."""
    compiler = COMPILERS[name]
    for module in compiler.MODULES:
        if importlib.util.find_spec(module) is None:
            raise _missing(compiler, f"{module} is not installed")
    if compiler.program() is None:
        raise _missing(compiler, f"`{name}` is not on the PATH")


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


def run_job(name: str, job: CompileJob, cache: UserCache) -> list[CompileResult]:
    """Do the tasks of a job in a process; returns a result for each, in order.

    A model that does not compile is a result. Raises CompilerError if the compiler is missing or breaks down.
    """
    require(name)
    compiler = COMPILERS[name]
    with tempfile.TemporaryDirectory(prefix="urdfsync-", ignore_cleanup_errors=True) as folder:
        process = subprocess.run(  # noqa: S603 - a command of ours
            processes.python_module("urdfsync.check.compilers", name),
            input=msgspec.json.encode(job),
            capture_output=True,
            env={**os.environ, **processes.importable(), **compiler.environment(str(cache.compiler), folder)},
            check=False,
        )
    results = [msgspec.json.decode(line, type=CompileResult) for line in process.stdout.splitlines()]
    if len(results) == len(job.tasks):
        return results
    words = process.stderr.decode(errors="replace").strip().split("\n")[-1].strip()
    said = f": {words}" if words else ""
    if process.returncode == MISSING:
        raise _missing(compiler, f"{compiler.TITLE} does not start{said}")
    task, cause = job.tasks[len(results)].title, processes.exit_cause(process.returncode)
    message = f"{compiler.TITLE} broke down at {task}: {cause}{said}"
    killed = "most likely the system for want of memory: check fewer robots at a time"
    hint = killed if process.returncode == -9 else compiler.REPORT
    raise CompilerError(Diagnostic(Severity.ERROR, "compiler-crashed", message, hint=hint))


def _missing(compiler: Compiler, reason: str) -> CompilerError:
    message = f"there is no compiler: {reason}"
    return CompilerError(Diagnostic(Severity.ERROR, "no-compiler", message, hint=compiler.INSTALL))
