"""Modelica compilers: each works in a process of its own, which takes a job and gives a result per task.

A compiler is native code that takes gigabytes for large robots and keeps them, and may crash.
"""

from __future__ import annotations

import contextlib
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Generator, Iterator, Mapping
from typing import IO, cast

import msgspec

from urdfsync.check.cache import UserCache
from urdfsync.check.results import CompilerName
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.extras import install_command
from urdfsync.processes import exit_cause, importable, python_module, reserve_stdout

MISSING = 3
"""The exit code of a worker without a compiler; the last line that it writes to stderr says why there is none."""

_TITLES = {"rumoca": "the compiler", "omc": "OpenModelica"}
_NEEDED = {"rumoca": ("rumoca",), "omc": ("OMPython",)}
_SHARED = ("psutil", "filelock")  # what the check itself needs
_INSTALL = {
    "rumoca": install_command("check"),
    "omc": f"install OpenModelica and `{install_command('check', 'omc')}`, or check without `--tool omc`",
}
_REPORT = {
    "rumoca": "report it to the authors of rumoca",
    "omc": "check without `--tool omc`, and report it to the authors of OpenModelica",
}


class Simulation(msgspec.Struct, frozen=True):
    """One run from 0 to `stop` s with results every `step` s; `parameters` get other values than in the text."""

    stop: float
    step: float
    parameters: Mapping[str, float] = {}
    tolerance: float | None = None
    """Of the integration, relative and absolute; None leaves it to the compiler."""


class CompileTask(msgspec.Struct, frozen=True):
    """A model to compile, which is in the text `source`; then to simulate, if there are `runs`."""

    model: str
    source: str
    runs: tuple[Simulation, ...] = ()
    values: tuple[str, ...] = ()
    """Variables of which each run hands back a series."""
    title: str = ""
    """What messages call the model."""


class SimulationResult(msgspec.Struct, frozen=True):
    """What a run gave: what went wrong, or a number per instant for `time` and for each value."""

    values: Mapping[str, tuple[float, ...]] = {}
    problem: str = ""


class CompileResult(msgspec.Struct, frozen=True):
    """What became of a task. A model that is not balanced does not compile."""

    problem: str = ""
    """What the compiler says of a model that does not compile, in its words; empty if it does."""
    unknowns: int = 0
    """Scalar unknowns of the compiled model; so many equations as well."""
    states: int = 0
    """Scalar states, as the compiler counts them before it reduces the index."""
    runs: tuple[SimulationResult, ...] = ()
    seconds: float = 0.0
    """CPU time of the task."""
    compiling: float = 0.0
    """The part of it before the first run."""
    megabytes: float = 0.0
    """Peak memory of the process so far."""


class CompileJob(msgspec.Struct, frozen=True):
    """Tasks for one process, one after the other, with the libraries in the folders `roots`."""

    roots: tuple[str, ...]
    tasks: tuple[CompileTask, ...]


class CompilerError(UrdfsyncError):
    """A compiler is missing or broke down; the code of the one diagnostic says which."""


def compile_task(model: str, libraries: tuple[str, ...] = ("Modelica", "UrdfSync")) -> CompileTask:
    """Compile a model of one of the roots, by its full name; `libraries` are the top-level packages that it needs.

    The text has to name each root in an import, or rumoca does not load it.
    """
    names = dict.fromkeys((*libraries, model.partition(".")[0]))
    imports = "".join(f"  import {name};\n" for name in names)
    return CompileTask("Probe_", f"model Probe_\n{imports}  extends {model};\nend Probe_;\n", title=model)


def require(compiler: CompilerName) -> None:
    """Raise CompilerError, with what to install, if anything is missing that a check with this compiler needs."""
    for name in (*_NEEDED[compiler], *_SHARED):
        if importlib.util.find_spec(name) is None:
            raise _missing(compiler, f"{name} is not installed")
    if compiler == "omc" and shutil.which("omc") is None and not os.environ.get("OPENMODELICAHOME"):
        raise _missing(compiler, "`omc` is not on the PATH")


def run_job(compiler: CompilerName, job: CompileJob, cache: UserCache) -> Generator[CompileResult, None, None]:
    """Do the tasks of a job in a process; gives a result for each, in order, as soon as it is known.

    A model that does not compile is a result. Raises CompilerError if the compiler is missing or breaks down. The
    process ends with the generator.
    """
    require(compiler)
    done = 0
    with (
        tempfile.TemporaryDirectory(prefix="urdfsync-", ignore_cleanup_errors=True) as folder,
        tempfile.TemporaryFile() as errors,
    ):
        worker = subprocess.Popen(  # noqa: S603 - a command of ours
            python_module(f"urdfsync.check.compilers.{compiler}"),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=errors,
            env={**os.environ, **importable(), **_environment(compiler, cache, folder)},
        )
        with worker:
            try:
                for line in _answers(worker, job):
                    yield msgspec.json.decode(line, type=CompileResult)
                    done += 1
            finally:
                worker.kill()
        errors.seek(0)
        words = errors.read().decode(errors="replace").split("\n")
    if done < len(job.tasks):
        last_line = next((line for line in reversed(words) if line.strip()), "")
        raise _breakdown(compiler, worker.returncode, job.tasks[done].title, last_line.strip())


def _answers(worker: subprocess.Popen[bytes], job: CompileJob) -> Iterator[bytes]:
    """Hand over a job; the lines that the worker answers until it ends. Its stdin stays open: see `serve`."""
    stdin, stdout = cast(IO[bytes], worker.stdin), cast(IO[bytes], worker.stdout)
    with contextlib.suppress(BrokenPipeError):  # it has ended already, and its exit code says why
        stdin.write(msgspec.json.encode(job) + b"\n")
        stdin.flush()
    yield from stdout
    worker.wait()


def serve(work: Callable[[CompileJob], Iterator[CompileResult]]) -> int:
    """Be a worker: take a job from stdin, do the work, and write a line with each result; the exit code.

    The process ends when whoever started it does.
    """
    answers = reserve_stdout()
    job = msgspec.json.decode(sys.stdin.buffer.readline(), type=CompileJob)
    end_with_parent()
    try:
        for result in work(job):
            answers.write(msgspec.json.encode(result) + b"\n")
            answers.flush()
    except ImportError as error:
        sys.stderr.write(f"{error}\n")
        return MISSING
    return 0


def end_with_parent() -> None:
    """End this process and its children when its stdin is closed; call it after the last line was read from there."""

    def wait() -> None:
        while os.read(0, 4096):  # not through sys.stdin, whose lock would disturb the interpreter at its end
            pass
        import psutil  # an optional extra, which checks need

        for child in psutil.Process().children(recursive=True):
            child.kill()  # a compiler at work may not let its own thread look at stdin
        os._exit(1)  # the main thread may be in native code

    threading.Thread(target=wait, name="end-with-parent", daemon=True).start()


def _environment(compiler: CompilerName, cache: UserCache, folder: str) -> dict[str, str]:
    """What the environment of a compiler says of folders; `folder` is a temporary one."""
    if compiler == "omc":
        return dict.fromkeys(("TMPDIR", "TEMP", "TMP"), folder)  # for its log, its port and what it may write
    # rumoca adds its own name to the cache, and looks at MODELICAPATH for whatever the roots do not have
    return {"XDG_CACHE_HOME": str(cache.compiler.parent), "MODELICAPATH": ""}


def _missing(compiler: CompilerName, reason: str) -> CompilerError:
    message = f"there is no compiler: {reason}"
    return CompilerError(Diagnostic(Severity.ERROR, "no-compiler", message, hint=_INSTALL[compiler]))


def _breakdown(compiler: CompilerName, code: int, title: str, last_line: str) -> CompilerError:
    """Why a worker ended before it was through, at the model `title`."""
    said = f": {last_line}" if last_line else ""
    if code == MISSING:
        return _missing(compiler, f"{_TITLES[compiler]} does not start{said}")
    message = f"{_TITLES[compiler]} broke down at {title}: {exit_cause(code)}{said}"
    hint = _REPORT[compiler]
    if code == -9:
        hint = "most likely the system for want of memory: check fewer robots at a time"
    return CompilerError(Diagnostic(Severity.ERROR, "compiler-crashed", message, hint=hint))
