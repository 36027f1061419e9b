"""Simulates a model in many cases, which differ in the values of parameters.

Cases go in chunks to processes. A chunk is compiled once, if the compiler can change the parameters of a compiled
model. Each outcome is saved under a hash of all that it follows from. So a command that was ended goes on where it
stopped, and no outcome depends on the chunks.
"""

from __future__ import annotations

import contextlib
import itertools
import math
import tempfile
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.analysis.checks import compilers
from urdfsync.analysis.checks.cache import UserCache, digest
from urdfsync.analysis.checks.compilers.compiler import CompilerError, CompileResult, CompileTask, Tool
from urdfsync.analysis.checks.fingerprint import result_key
from urdfsync.analysis.checks.jobs import Jobs
from urdfsync.analysis.checks.libraries import Libraries
from urdfsync.analysis.checks.process import LimitError, Limits, limits_of
from urdfsync.analysis.simulation.cases import Cases, Sampling, read_cases
from urdfsync.analysis.simulation.joints import Layouts
from urdfsync.analysis.simulation.outcomes import JointName, Outcome, Study, outcome_of
from urdfsync.analysis.simulation.package import Prepared, check_compiled, prepare, run_task
from urdfsync.analysis.simulation.results import TOLERANCE, VaryOptions
from urdfsync.analysis.simulation.run import simulation_task
from urdfsync.analysis.simulation.values import read_values
from urdfsync.common import system
from urdfsync.common.diagnostics import ConfigError
from urdfsync.common.files import shown
from urdfsync.common.processes import machine
from urdfsync.engine.options import Progress
from urdfsync.project.config import Config, RobotConfig, find, working_folder

_CHUNK = 25
"""The greatest number of cases of a chunk. Compiling takes less than two cases, so this costs a tenth of the time."""
_WINDOW = 3
"""Chunks for each process that wait or run; more would fill the memory."""
_PAUSE = 0.2
"""Seconds between two reports of progress."""
_CRASHES = 3
"""After so many processes in a row that end without an outcome, the other cases of a chunk fail, too."""

_Names: TypeAlias = dict[tuple[JointName, ...], tuple[JointName, ...]]
Keep: TypeAlias = Callable[[int, Outcome], None]
"""Takes the outcome of a case by its number."""


class Setting(msgspec.Struct, frozen=True):
    """All that the cases of a study share."""

    robot: RobotConfig
    tool: Tool
    needed: Libraries
    texts: Mapping[str, bytes]
    around: Mapping[str, bytes]
    changed: Mapping[Path, bytes]
    """Texts of the package, of the files around it, and changed contents, as in `Jobs`."""
    layouts: Layouts
    seconds: float
    """Processor time for each case, and as much for compiling."""
    memory: float | None


class _RefusedError(Exception):
    """No case can be simulated: the model does not compile, or a parameter can't be changed."""

    def __init__(self, result: CompileResult) -> None:
        super().__init__(result)
        self.result = result


class _StoppedError(Exception):
    """The command ends."""


class _Progress:
    """Counts finished cases, for several threads."""

    def __init__(self, title: str, total: int, known: int, progress: Progress) -> None:
        self._title, self._total, self._known, self._progress = title, total, known, progress
        self.finished, self._begin = 0, time.monotonic()

    def show(self) -> None:
        """Show the number of finished cases, and their rate."""
        rate = self.finished / max(time.monotonic() - self._begin, 1e-3)
        speed = f"{rate:.2g} cases/s" if self.finished else "compiling"
        done = self._known + self.finished
        self._progress(f"{self._title}: {done} of {self._total} cases, {speed}", done, self._total)


def vary(config: Config, robot: RobotConfig, options: VaryOptions, progress: Progress) -> Study:
    """Simulate a model in many cases. Writes nothing but the cache.

    A case that fails is an outcome. Raises UrdfsyncError for faults of the model, its parameters or the compiler, and
    OSError for unreadable files.
    """
    begin = time.monotonic()
    varied = read_cases(options.vary, Sampling(options.cases, options.seed, options.sampling))
    if double := sorted(read_values(options.values).keys() & set(varied.names)):
        raise ConfigError.of("vary", f"`{double[0]}` has a value, and is varied, too", hint="leave one of them out")
    prepared = prepare(config, robot, options)
    base, plain, changed = simulation_task(options, prepared)
    package, cache = prepared.package, UserCache.default()
    program = result_key(robot, [options.tool], prepared.needed)
    texts = [sorted(files.items()) for files in (package.files.texts, package.around, changed)]
    key = program and digest(program, base, *texts)
    setting = Setting(
        robot=robot,
        tool=options.tool,
        needed=prepared.needed,
        texts=package.files.texts,
        around=package.around,
        changed=changed,
        layouts=prepared.bench.layouts,
        seconds=options.timeout,
        memory=options.memory,
    )
    cache.prepare()
    cache.trim()
    keys = [key and digest(key, varied.names, row) for row in varied.rows]
    shared: _Names = {}
    outcomes = [_load(cache, each, shared) for each in keys]
    waiting = [number for number, outcome in enumerate(outcomes) if outcome is None]
    counter = _Progress(robot.name, len(outcomes), len(outcomes) - len(waiting), progress)

    def keep(number: int, outcome: Outcome) -> None:
        if (place := keys[number]) and not outcome.problem:  # a failed case is tried again
            cache.save(place, outcome)
        names = shared.setdefault(outcome.names, outcome.names)
        outcomes[number] = msgspec.structs.replace(outcome, names=names)
        counter.finished += 1

    def task(number: int) -> CompileTask:
        return _case_task(options, prepared, base, varied, number)

    try:
        _run_all(options, setting, waiting, task, keep, counter)
    except _RefusedError as refused:
        if refused.result.problem and base.parameters:  # asks the compiler which parameter is wrong
            run_task(prepared, options, "simulation", base, plain, lambda: None, changed)
        check_compiled(prepared, options, msgspec.structs.replace(base, varied=varied.names), refused.result)
    except KeyboardInterrupt:
        simulated = sum(outcome is not None and not outcome.problem for outcome in outcomes)
        raise KeyboardInterrupt(f"{simulated} of {len(outcomes)} cases are kept") from None
    return Study(
        robot=robot.name,
        model=prepared.model.name,
        stop=base.runs[0].stop,
        step=base.runs[0].step,
        tolerance=base.runs[0].tolerance or TOLERANCE,
        varied=varied,
        outcomes=[outcome or Outcome(problem="the case was not simulated") for outcome in outcomes],
        seconds=time.monotonic() - begin,
        known=len(outcomes) - len(waiting),
        command=_command(config, robot, options),
        diagnostics=robot.without_ignored(prepared.warnings),
    )


def _load(cache: UserCache, key: str | None, shared: _Names) -> Outcome | None:
    """Return a remembered outcome, whose names share the memory of other outcomes' names."""
    outcome = cache.load(key, Outcome) if key else None
    return outcome and msgspec.structs.replace(outcome, names=shared.setdefault(outcome.names, outcome.names))


def _case_task(options: VaryOptions, prepared: Prepared, base: CompileTask, varied: Cases, number: int) -> CompileTask:
    """Return the compiler's task for a case: the same text with other values, or a text with the values."""
    if compilers.COMPILERS[options.tool.name].REUSES_MODELS:
        (run,) = base.runs
        parameters = dict(zip(varied.names, varied.rows[number], strict=True))
        runs = (msgspec.structs.replace(run, parameters=parameters),)
        return msgspec.structs.replace(base, varied=varied.names, runs=runs)
    values = read_values([*options.values, *varied.settings(number)])
    return simulation_task(options, msgspec.structs.replace(prepared, values=values))[0]


def _command(config: Config, robot: RobotConfig, options: VaryOptions) -> str:
    """Return the command line that simulates one case, without its values."""
    words = ["urdfsync", "simulate", robot.name]
    try:
        is_nearest = find(working_folder()).samefile(config.file)
    except ConfigError:
        is_nearest = False
    words += [] if is_nearest else ["--config", shown(config.file)]
    for name in ("model", "stop", "step", "tolerance", "method"):
        if value := getattr(options, name):
            words += [f"--{name}", str(value)]
    words += ["--tool", options.tool.name] if options.tool.name != Tool().name else []
    words += ["--input", str(options.motion)] if options.motion else []
    words += [word for value in options.values for word in ("--set", value)]
    return system.join_words(words)


def _run_all(
    options: VaryOptions,
    setting: Setting,
    waiting: Sequence[int],
    task: Callable[[int], CompileTask],
    keep: Keep,
    counter: _Progress,
) -> None:
    """Simulate the waiting cases. Raises _RefusedError, and the errors of `_simulate_chunk`."""
    with contextlib.ExitStack() as stack:
        # a thread for each process of the compiler: a process that is killed takes no other one with it
        count = max(1, min(options.jobs or machine.cores(), len(waiting)))
        threads = ThreadPoolExecutor(count)
        stack.callback(threads.shutdown, cancel_futures=True)
        ended = threading.Event()
        stack.callback(ended.set)  # comes first: the threads end their processes

        def submit(numbers: Sequence[int]) -> Future[None]:
            tasks = [task(number) for number in numbers]
            return threads.submit(
                _simulate_chunk, setting, tasks, lambda place, outcome: keep(numbers[place], outcome), ended
            )

        size = max(1, min(_CHUNK, math.ceil(len(waiting) / count)))
        chunks = (waiting[start : start + size] for start in range(0, len(waiting), size))
        running = set[Future[None]]()
        while True:
            running |= {submit(numbers) for numbers in itertools.islice(chunks, _WINDOW * count - len(running))}
            if not running:
                return
            done, running = wait(running, _PAUSE, FIRST_COMPLETED)
            for future in done:
                future.result()
            counter.show()


def _simulate_chunk(setting: Setting, tasks: Sequence[CompileTask], keep: Keep, ended: threading.Event) -> None:
    """Simulate cases in a process, until `ended` is set; `keep` takes each outcome by the number of its task.

    Raises _RefusedError for a model that can't be simulated, and CompilerError without a compiler.
    """
    count, crashes = 0, 0

    def add(outcome: Outcome) -> None:
        nonlocal count
        keep(count, outcome)
        count += 1

    def look() -> None:
        if ended.is_set():
            raise _StoppedError

    with tempfile.TemporaryDirectory(prefix="urdfsync-", ignore_cleanup_errors=True) as folder:
        while count < len(tasks):
            limits = limits_of("a case", setting.seconds, setting.memory)

            def take(result: CompileResult, limits: Limits = limits) -> None:
                limits.seconds = limits.used + setting.seconds
                if result.runs:
                    add(outcome_of(setting.layouts, result.runs[0]))

            jobs = Jobs(setting.robot, setting.tool, setting.needed, setting.around, limits, Path(folder), look, take)
            before = count
            try:
                results = jobs.run("cases", setting.texts, tasks[before:], setting.changed)
            except (CompilerError, LimitError) as error:
                (fault,) = error.diagnostics
                if fault.code == "no-compiler":
                    raise
                crashes = crashes + 1 if count == before else 1
                for _ in range(1 if crashes < _CRASHES else len(tasks) - count):
                    add(Outcome(problem=fault.message))
                continue
            if refused := [result for result in results if not result.runs]:
                raise _RefusedError(refused[0])
            for result in results[count - before :]:  # none, but on a system that can't look at a file's part
                take(result)
