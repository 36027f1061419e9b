"""Stand-ins for parts of a check: a check that obeys the robot's name, functions for processes, a compiler."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from multiprocessing import SimpleQueue
from pathlib import Path
from typing import Any

import msgspec
import psutil

from urdfsync.analysis.checks import process
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.compilers.compiler import CompileJob, CompileResult, Complaint, Tool
from urdfsync.analysis.checks.process import LimitError, Limits
from urdfsync.analysis.checks.results import CheckOptions, CheckResult, CheckStatus, CompiledModel
from urdfsync.common.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.common.processes.workers import tell
from urdfsync.project.config import Config, RobotConfig

FAULT = Diagnostic(Severity.ERROR, "fault", "as it was asked for")


def status(result: CheckResult, *, strict: bool) -> CheckStatus:
    """Return this verdict for each check."""
    return msgspec.structs.replace(result, strict=strict).status


def check_robot(config: Config, robot: RobotConfig, options: CheckOptions, folder: Path | None) -> CheckResult:
    """Replace `check_robot`: the robot's name chooses the result of the check."""
    name, result = robot.name, CheckResult(robot.name, robot.target.package)
    Path(f"{name}.begun").touch()
    tell(f"{name}: at work")
    limits = Limits(f"the check of robot `{name}`", options.timeout, (options.memory or 0) * 1e9)
    try:
        if name.startswith("slow"):
            process.run(act, "work", limits=limits)
        elif name.startswith("big"):
            process.run(act, "fill", limits=limits)
        elif name == "crash":
            os.abort()
        elif name == "late":
            while not Path("early.done").exists():
                time.sleep(0.01)
        result.compiled = (CompiledModel(f"{name.title()}Run", 10),)
    except LimitError as error:
        result.add(error.diagnostics)
    Path(f"{name}.done").touch()
    return result


def act(*deeds: str) -> Iterator[str]:
    """Do each deed in a process, and yield it."""
    for deed in deeds:
        match deed:
            case "sleep":
                time.sleep(600)
            case "work":
                while True:
                    pass
            case "session":
                yield f"{os.getsid(0)} {os.getpgrp() == os.getpid()}"
            case "fill":
                memory = bytearray(400_000_000)
                time.sleep(1)
                del memory
            case "start":
                subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
                Path("started").touch()
                while not Path("seen").exists():
                    time.sleep(0.01)
            case "stdin":
                yield os.read(0, 1).decode() or "empty"
            case "print":
                os.write(1, b"noise")
            case "abort":
                sys.stderr.write("first words\nlast words\n")
                sys.stderr.flush()
                os.abort()
            case "profile":
                os.kill(os.getpid(), signal.SIGPROF)
            case "kill":
                psutil.Process().kill()
            case "leave":
                os._exit(0)
            case "refuse":
                raise OutputError(FAULT)
            case "import":
                raise ImportError("no such wheel")
        yield deed


class Compiler:
    """A compiler that does what the text of a model says: see `act`."""

    TITLE = "the compiler"
    MODULES: tuple[str, ...] = ()
    INSTALL = "install it"
    METHODS: tuple[str, ...] = ()
    HAS_STANDARD_LIBRARY = False
    STARTS_PROGRAMS = False
    is_missing = False

    def program(self, named: str) -> str | None:
        """The program is found, unless the compiler is missing."""
        return None if self.is_missing else ""

    def environment(self, cache: str, folder: str) -> dict[str, str]:
        """Nothing."""
        return {}

    def work(self, job: CompileJob) -> Iterator[CompileResult]:
        """Return a result without faults for each task."""
        for task in job.tasks:
            list(act(task.source))
            yield CompileResult(unknowns=7)

    def complaints(self, problem: str) -> list[Complaint]:
        """One for all."""
        return [Complaint(problem)]


class Compiling:
    """Replace `compilers.run_job`: return the same result for every model, and keep the given models."""

    def __init__(self) -> None:
        self.problem, self.models, self.roots = "", list[str](), list[str]()
        self.roots_of: dict[str, Sequence[str]] = {}
        self.problems: dict[str, str] = {}
        """Of single models."""

    def __call__(
        self,
        tool: Tool,
        job: CompileJob,
        cache: UserCache,
        limits: Limits,
        progress: object = None,
        on_result: object = None,
    ) -> list[CompileResult]:
        """Return a result for each task."""
        self.roots += job.roots
        self.roots_of |= dict.fromkeys([task.title for task in job.tasks], job.roots)
        self.models += [task.title for task in job.tasks]
        return [CompileResult(self.problems.get(task.title, self.problem), 7) for task in job.tasks]


@contextlib.contextmanager
def thread_workers(count: int) -> Iterator[tuple[Executor, Any]]:
    """Replace `workers` by threads of this process, which see the stand-ins of a test."""
    with ThreadPoolExecutor(count) as executor:
        yield executor, SimpleQueue()
