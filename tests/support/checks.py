"""Stand-ins for what a check is made of: a check of robots of all characters, functions for processes, a compiler."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import msgspec
import psutil

from urdfsync.checks import process
from urdfsync.checks.cache import UserCache
from urdfsync.checks.compilers.compiler import CompileJob, CompileResult, Complaint, Tool
from urdfsync.checks.process import LimitError, Limits
from urdfsync.checks.results import CheckOptions, CheckResult, CheckStatus, CompiledModel, ToolResult
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.processes.workers import Workers, tell

FAULT = Diagnostic(Severity.ERROR, "fault", "as it was asked for")


def status(result: CheckResult, *, strict: bool) -> CheckStatus:
    """The verdict, whichever was asked for."""
    return msgspec.structs.replace(result, strict=strict).status


def check_robot(config: Config, robot: RobotConfig, options: CheckOptions, folder: Path | None) -> CheckResult:
    """In the place of the real one: the robot's name says what becomes of its check."""
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
        result.tools = (ToolResult(compiled=(CompiledModel(f"{name.title()}Run", 10),)),)
    except LimitError as error:
        result.add(error.diagnostics)
    Path(f"{name}.done").touch()
    return result


def act(*deeds: str) -> Iterator[str]:
    """Do one deed after the other in a process, and yield each."""
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
            case "print":
                os.write(1, b"noise")
            case "abort":
                sys.stderr.write("first words\nlast words\n")
                sys.stderr.flush()
                os.abort()
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
    """A compiler that does with a model what its text says: see `act`."""

    TITLE = "the compiler"
    MODULES: tuple[str, ...] = ()
    INSTALL = "install it"
    METHODS: tuple[str, ...] = ()
    HAS_STANDARD_LIBRARY = False
    STARTS_PROGRAMS = False
    is_missing = False

    def program(self, named: str) -> str | None:
        """All of it is here, unless it is missing."""
        return None if self.is_missing else ""

    def environment(self, cache: str, folder: str) -> dict[str, str]:
        """Nothing."""
        return {}

    def work(self, job: CompileJob) -> Iterator[CompileResult]:
        """Find all models right."""
        for task in job.tasks:
            list(act(task.source))
            yield CompileResult(unknowns=7)

    def complaints(self, problem: str) -> list[Complaint]:
        """One for all."""
        return [Complaint(problem)]


class Compiling:
    """In the place of `compilers.run_job`: says the same of every model, and knows which ones it was given."""

    def __init__(self) -> None:
        self.problem, self.models, self.roots = "", list[str](), list[str]()
        self.roots_of: dict[str, Sequence[str]] = {}
        self.problems: dict[str, str] = {}
        """Of single models."""

    def __call__(
        self, tool: Tool, job: CompileJob, cache: UserCache, limits: Limits, progress: object = None
    ) -> list[CompileResult]:
        """Return a result for each task."""
        self.roots += job.roots
        self.roots_of |= dict.fromkeys([task.title for task in job.tasks], job.roots)
        self.models += [task.title for task in job.tasks]
        return [CompileResult(self.problems.get(task.title, self.problem), 7) for task in job.tasks]


@contextlib.contextmanager
def thread_workers(count: int, address: str = "") -> Iterator[Workers]:
    """In the place of `workers`: threads of this process, which see what a test has replaced."""
    with ThreadPoolExecutor(count) as executor:
        yield Workers(executor, None)
