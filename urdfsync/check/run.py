"""Checks many robots, each in a process of its own, as many at a time as cores and memory allow."""

from __future__ import annotations

import os
import threading
from collections.abc import Collection, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait

import msgspec

from urdfsync import machine
from urdfsync.check import process
from urdfsync.check.cache import UserCache
from urdfsync.check.collector import Step
from urdfsync.check.compilers import compiler
from urdfsync.check.process import Ending, RobotOrder
from urdfsync.check.results import CheckOptions, CheckResult
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.options import Progress
from urdfsync.processes import exit_cause

_EXPECTED_MEMORY = 1.5e9  # bytes that the check of a robot usually takes, at most
_SHARE_OF_FREE_MEMORY = 0.9
_PAUSE = 0.1  # s between two looks at what the processes do


def check_robots(
    config: Config,
    robots: Sequence[RobotConfig],
    options: CheckOptions,
    progress: Progress,
    command: Sequence[str] = process.COMMAND,
) -> Iterator[CheckResult]:
    """Check robots; the results come in their order, each as soon as it and those before it are known.

    `progress` is told what is being done, and how much, in percent of one robot; `command` starts the process for one.
    Raises CompilerError if what a check needs is not installed, CacheError if there is no place for its cache.
    """
    compiler.require(options.compiler)
    cache = UserCache.default()
    cache.prepare()
    cache.trim()
    budget = options.memory * 1e9 if options.memory else _SHARE_OF_FREE_MEMORY * _free_memory()
    jobs = min(options.jobs or machine.cores(), len(robots)) or 1
    count = max(1, min(jobs, int(budget // _EXPECTED_MEMORY)))
    options = msgspec.structs.replace(options, compilers=max(1, machine.cores() // jobs))
    checks = _Checks(config, options, command)

    def await_all(futures: Collection[Future[CheckResult | None]]) -> None:
        while wait(futures, _PAUSE).not_done:
            steps = list(checks.steps.values())
            what = ", ".join(step.what for step in steps if step.what) or "checking"
            progress(what, int(sum(100 * step.done for step in steps)), 100 * len(robots))

    with ThreadPoolExecutor(count) as pool:
        try:
            futures = {one.name: pool.submit(checks.check, one, budget / count, alone=count == 1) for one in robots}
            for robot in robots:
                await_all([futures[robot.name]])
                while (result := futures[robot.name].result()) is None:  # there was too little memory beside others
                    await_all(futures.values())
                    futures[robot.name] = pool.submit(checks.check, robot, budget, alone=True)
                    await_all([futures[robot.name]])
                cache.trim()
                yield result
        finally:
            checks.stopped.set()
            pool.shutdown(cancel_futures=True)


class _Checks:
    """The checks of one command, each made by a thread that waits for a process."""

    def __init__(self, config: Config, options: CheckOptions, command: Sequence[str]) -> None:
        self._config, self._options, self._command = config, options, command
        self.steps: dict[str, Step] = {}
        """The last step of each robot that was begun."""
        self.stopped = threading.Event()

    def check(self, robot: RobotConfig, memory: float, *, alone: bool) -> CheckResult | None:
        """Check a robot with so many bytes; None if they are too few, unless it is `alone` and has them all."""
        name, options = robot.name, self._options
        self.steps[name] = Step("", 0.0, CheckResult(name, robot.target.package))

        def tell(step: Step) -> None:
            self.steps[name] = step

        order = RobotOrder(str(self._config.file), name, os.getcwd(), options)  # noqa: PTH109 - as a text
        report = "report it, with the source"
        try:
            ending, code, words = process.run_process(order, tell, options.timeout, memory, self.stopped, self._command)
        except process.StoppedError:
            return self.steps[name].result
        except (ValueError, OSError) as error:
            return self._failed(name, "check-crashed", f"its process can't be used: {error!r}", report)
        if ending is Ending.OUT_OF_MEMORY and not alone:
            self.steps[name] = Step(f"{name}: waits for more memory", 0.0, self.steps[name].result)
            return None
        if ending is Ending.OUT_OF_MEMORY:
            message = f"it takes more than the {memory / 1e9:.2g} GB that it may"
            hint = "allow more with `urdfsync check --memory`, as far as this machine has it"
            return self._failed(name, "check-out-of-memory", message, hint)
        if ending is Ending.OUT_OF_TIME:
            message = f"it was not done after {options.timeout:g} s"
            return self._failed(name, "check-out-of-time", message, "allow more with `urdfsync check --timeout`")
        if code or not self.steps[name].is_last:
            message = ": ".join([f"its process ended with {exit_cause(code)}", *words.splitlines()[-1:]])
            return self._failed(name, "check-crashed", message, report)
        return self.steps[name].result

    def _failed(self, robot: str, code: str, message: str, hint: str) -> CheckResult:
        """What was found out of a robot until its check came to nothing."""
        latest = self.steps[robot].result
        found = Diagnostic(Severity.ERROR, code, f"the check of robot `{robot}`: {message}", hint=hint)
        return msgspec.structs.replace(latest, diagnostics=(*latest.diagnostics, found))


def _free_memory() -> float:
    import psutil  # an optional extra

    return float(psutil.virtual_memory().available)
