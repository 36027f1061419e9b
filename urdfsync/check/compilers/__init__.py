"""Modelica compilers. Each works in a process of its own: it may crash, and keeps gigabytes for large robots."""

from __future__ import annotations

import contextlib
import importlib.metadata
import importlib.util
import os
import subprocess
import tempfile
from collections.abc import Generator, Mapping
from pathlib import Path
from typing import IO, cast

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


def run_job(name: str, job: CompileJob, cache: UserCache) -> Generator[CompileResult, None, None]:
    """Do the tasks of a job in a process; gives a result for each, in order, as soon as it is known.

    A model that does not compile is a result. Raises CompilerError if the compiler is missing or breaks down. The
    process ends with the generator.
    """
    require(name)
    compiler, done = COMPILERS[name], 0
    with (
        tempfile.TemporaryDirectory(prefix="urdfsync-", ignore_cleanup_errors=True) as folder,
        tempfile.TemporaryFile() as errors,
    ):
        worker = subprocess.Popen(  # noqa: S603 - a command of ours
            processes.python_module("urdfsync.check.compilers", name),
            stdin=subprocess.PIPE,  # stays open: see `processes.end_with_parent`
            stdout=subprocess.PIPE,
            stderr=errors,
            env={**os.environ, **processes.importable(), **compiler.environment(str(cache.compiler), folder)},
        )
        with worker:
            try:
                with contextlib.suppress(BrokenPipeError):  # the process has ended, and its exit code says why
                    cast(IO[bytes], worker.stdin).write(msgspec.json.encode(job) + b"\n")
                    cast(IO[bytes], worker.stdin).flush()
                for line in cast(IO[bytes], worker.stdout):
                    yield msgspec.json.decode(line, type=CompileResult)
                    done += 1
                worker.wait()
            finally:
                worker.kill()
        errors.seek(0)
        lines = errors.read().decode(errors="replace").strip().split("\n")
    if done == len(job.tasks):
        return
    said = f": {lines[-1].strip()}" if lines[-1] else ""
    if worker.returncode == MISSING:
        raise _missing(compiler, f"{compiler.TITLE} does not start{said}")
    message = f"{compiler.TITLE} broke down at {job.tasks[done].title}: {processes.exit_cause(worker.returncode)}{said}"
    killed = "most likely the system for want of memory: check fewer robots at a time"
    hint = killed if worker.returncode == -9 else compiler.REPORT
    raise CompilerError(Diagnostic(Severity.ERROR, "compiler-crashed", message, hint=hint))


def _missing(compiler: Compiler, reason: str) -> CompilerError:
    message = f"there is no compiler: {reason}"
    return CompilerError(Diagnostic(Severity.ERROR, "no-compiler", message, hint=compiler.INSTALL))
