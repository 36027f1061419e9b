"""Checks many robots, each in a process of its own: as many at a time as cores and memory allow, or on a Dask cluster.

The reference is native code as the compilers are, and reading, rendering and comparing need memory: none of it is in
the process of whoever wants to know.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import tempfile
import threading
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future, ThreadPoolExecutor, wait
from typing import TypeAlias

import msgspec
import psutil

from urdfsync import machine, processes
from urdfsync.check import compilers
from urdfsync.check.cache import UserCache
from urdfsync.check.results import CheckOptions, CheckResult, CheckStep, from_text, to_text
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.options import Progress
from urdfsync.engine.pool import connect_cluster

COMMAND = tuple(processes.python_module("urdfsync.check.robot"))
"""Starts the process that checks one robot."""
_EXPECTED_MEMORY = 1.5e9  # bytes that the check of a robot usually takes, at most
_SHARE_OF_FREE_MEMORY = 0.9
_PAUSE = 0.1  # s between two reports of progress
_INTERVAL = 0.1  # s between two looks at memory and clock
_PATIENCE = 10.0  # s to read what a process has told


_Futures: TypeAlias = dict[str, Future[CheckResult | None]]
"""The checks of robots, by the robots' names."""


class RobotOrder(msgspec.Struct, frozen=True):
    """A robot to check."""

    config: str
    """The configuration file, absolute."""
    robot: str
    package: str
    folder: str
    """The working folder: messages name files as they are seen from there."""
    options: CheckOptions
    workspace: str = ""
    """An empty folder for copies of the package."""


def check_robots(
    config: Config, robots: Sequence[RobotConfig], options: CheckOptions, progress: Progress
) -> Iterator[CheckResult]:
    """Check robots; the results come in their order, each as soon as it and those before it are known.

    `progress` is told what is being done, and how much, in percent of one robot. Raises CompilerError if what a check
    needs is not installed, CacheError if there is no place for its cache, ConfigError if no cluster answers.
    """
    cluster: Executor | None = connect_cluster(options.executor) if options.executor else None
    if cluster is None:
        compilers.require(options.compiler)
    cache = UserCache.default()
    cache.prepare()
    cache.trim()
    budget = options.memory * 1e9 if options.memory else _SHARE_OF_FREE_MEMORY * psutil.virtual_memory().available
    jobs = min(options.jobs or machine.cores(), len(robots)) or 1
    count = max(1, min(jobs, int(budget // _EXPECTED_MEMORY)))
    compilers_each = 1 if cluster else max(1, machine.cores() // jobs)  # other workers may share the machine
    options = msgspec.structs.replace(options, compilers=compilers_each)
    folder = os.getcwd()  # noqa: PTH109 - as a text
    orders = [RobotOrder(str(config.file), one.name, one.target.package, folder, options) for one in robots]
    steps: dict[str, CheckStep] = {}
    stopped = threading.Event()
    futures: _Futures = {}
    with cluster or ThreadPoolExecutor(count) as pool:
        try:
            for order in orders:
                if cluster:
                    futures[order.robot] = pool.submit(check_on_worker, order)
                else:
                    limits = budget / count, steps, stopped
                    futures[order.robot] = pool.submit(_check, order, *limits, is_alone=count == 1)
            for order in orders:
                _wait_for([order.robot], futures, steps, progress)
                error = futures[order.robot].exception()
                if cluster and error:  # a worker is lost in one of many ways
                    found = _failure(order, "check-crashed", f"the worker is lost: {error!r}", "try again")
                    yield CheckResult(order.robot, order.package, diagnostics=(found,))
                    continue
                while (result := futures[order.robot].result()) is None:  # too little memory was left beside others
                    _wait_for(futures, futures, steps, progress)
                    futures[order.robot] = pool.submit(_check, order, budget, steps, stopped, is_alone=True)
                    _wait_for([order.robot], futures, steps, progress)
                cache.trim()
                yield result
        finally:
            stopped.set()
            for future in futures.values():
                future.cancel()


def _wait_for(names: Iterable[str], futures: _Futures, steps: Mapping[str, CheckStep], progress: Progress) -> None:
    """Wait for the checks of some robots, and tell how far all are."""
    while wait([futures[name] for name in names], _PAUSE).not_done:
        begun = [step for name, step in list(steps.items()) if not futures[name].done()]
        what = ", ".join(step.what for step in begun if step.what) or "checking"
        percent = sum(100.0 * future.done() for future in futures.values()) + sum(100 * step.done for step in begun)
        progress(what, int(percent), 100 * len(futures))


def check_on_worker(order: RobotOrder) -> CheckResult | None:
    """Check a robot on a worker of a cluster, which sees the project at the same path."""
    memory = order.options.memory or _SHARE_OF_FREE_MEMORY * psutil.virtual_memory().available / 1e9
    return _check(order, memory * 1e9, {}, threading.Event(), is_alone=True)


def _check(
    order: RobotOrder, memory: float, steps: dict[str, CheckStep], stopped: threading.Event, *, is_alone: bool
) -> CheckResult | None:
    """Check a robot in a process of at most so many bytes; None if they are too few, unless it `is_alone`.

    `steps` gets each step under the robot's name. Once `stopped` is set, nobody wants to know any more. At the end
    nothing that the process started is left.
    """
    name, deadline = order.robot, time.monotonic() + order.options.timeout
    steps[name] = CheckStep("", 0.0)
    fault, peak, family = None, 0, list[psutil.Process]()
    with tempfile.TemporaryFile() as errors, UserCache.default().workspace() as workspace:
        process = psutil.Popen(
            COMMAND,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=errors,
            env={**os.environ, **processes.importable()},
            start_new_session=True,  # an interruption from the keyboard is for whoever waits, who ends this process
        )

        def read_steps() -> None:
            with process.stdout, contextlib.suppress(ValueError):  # up to the last one, or to what is none
                for line in process.stdout:
                    steps[name] = from_text(line, CheckStep)

        reader = threading.Thread(target=read_steps, daemon=True)
        reader.start()
        try:
            with contextlib.suppress(OSError):  # it has ended, and its exit code says why
                text = to_text(msgspec.structs.replace(order, workspace=str(workspace)))
                process.stdin.write(text.encode() + b"\n")
                process.stdin.flush()
            while True:
                with contextlib.suppress(psutil.TimeoutExpired):
                    process.wait(_INTERVAL)
                    break
                family, used = _family(process), 0
                for one in family:
                    with contextlib.suppress(psutil.Error):  # it has just ended
                        used += one.memory_info().rss
                peak = max(peak, used)
                if time.monotonic() >= deadline:
                    message = f"it was not done after {order.options.timeout:g} s"
                    fault = _failure(order, "check-out-of-time", message, "allow more with `urdfsync check --timeout`")
                elif used > memory and not is_alone:
                    steps[name] = CheckStep(f"{name}: waits for more memory", 0.0)
                    return None
                elif used > memory:
                    message = f"it takes more than the {memory / 1e9:.2g} GB that it may"
                    hint = "allow more with `urdfsync check --memory`, as far as this machine has it"
                    fault = _failure(order, "check-out-of-memory", message, hint)
                if fault or stopped.is_set():
                    break
        finally:
            for one in {*family, *_family(process)}:  # of a process that is dead, the system knows no children
                with contextlib.suppress(psutil.Error):
                    one.kill()
            process.wait()
            with contextlib.suppress(OSError):  # what it did not read is lost
                process.stdin.close()
            reader.join(_PATIENCE)
        errors.seek(0)
        words = errors.read().decode(errors="replace").strip().splitlines()[-1:]
    result = steps[name].result or CheckResult(name, order.package)
    if fault is None and not stopped.is_set() and (process.returncode or steps[name].result is None):
        message = ": ".join([f"its process ended with {processes.exit_cause(process.returncode)}", *words])
        fault = _failure(order, "check-crashed", message, "report it, with the source")
    if fault:
        result.add([fault])
    result.megabytes = peak / 1e6
    return result


def _family(process: psutil.Popen) -> list[psutil.Process]:
    """A process and all that it started; itself alone if it has ended."""
    with contextlib.suppress(psutil.Error):
        return [process, *process.children(recursive=True)]
    return [process]


def _failure(order: RobotOrder, code: str, message: str, hint: str) -> Diagnostic:
    return Diagnostic(Severity.ERROR, code, f"the check of robot `{order.robot}`: {message}", hint=hint)
