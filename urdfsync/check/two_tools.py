"""One compiler's word on a package, or that of two, which are held against each other."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import TypeAlias

import msgspec

from urdfsync.check import compilers
from urdfsync.check.compilation import Compilation, compare
from urdfsync.check.compilers.compiler import Tool
from urdfsync.check.process import Limits
from urdfsync.check.results import CheckResult, SecondResult
from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import Deviation, Experiment

_MakeCompilation: TypeAlias = Callable[[Tool, CheckResult], Compilation]
"""Of a compiler, with the result that it fills."""


def compile_with_tools(
    tools: Sequence[Tool],
    make: _MakeCompilation,
    experiment: Experiment | None,
    result: CheckResult,
    limits: Limits,
) -> None:
    """Compile a package with one compiler or two, one after the other; all that is found goes into the result."""
    done: list[Compilation] = []
    parts: list[CheckResult] = []
    for tool in tools:
        begin, part = time.monotonic(), CheckResult(result.robot, result.package)
        peak, limits.peak = limits.peak, 0.0
        compilation = make(tool, part)
        compilation.run(experiment)
        part.seconds, part.megabytes = time.monotonic() - begin, limits.peak / 1e6
        limits.peak = max(peak, limits.peak)
        if note := compilers.find_untried(tool, compilation.version):
            result.add([note])
        done.append(compilation)
        parts.append(part)
    first, *others = parts
    result.tool, result.compiled, result.failing = first.tool, first.compiled, first.failing
    result.deviations, result.effects = first.deviations, first.effects
    result.gaps += first.gaps
    if not others:
        result.add(first.diagnostics)
        return
    (second,) = others
    result.effects = first.effects or second.effects
    result.gaps += tuple(f"{second.tool}: {gap}" for gap in second.gaps if gap not in first.gaps)
    result.failing = tuple(dict.fromkeys((*first.failing, *second.failing)))
    result.add(_findings(first, second))
    between, edited = None, tuple[Deviation, ...]()
    if experiment and done[0].generated and done[1].generated:
        between = compare(experiment.compared, done[1].generated, done[0].generated)
    if experiment and done[0].edited and done[1].edited:
        edited = compare(experiment.compared, done[1].edited, done[0].edited)
    seconds, megabytes = (first.seconds, second.seconds), (first.megabytes, second.megabytes)
    result.second = SecondResult(second.tool, second.compiled, second.deviations, between, edited, seconds, megabytes)


def _findings(first: CheckResult, second: CheckResult) -> list[Diagnostic]:
    """The findings of two compilers: what both have at the same place once, what one has alone under its name."""

    def place(one: Diagnostic) -> tuple[object, ...]:
        return one.severity, one.file, one.line, one.code, "" if one.line else one.message

    shared = set(map(place, first.diagnostics)) & set(map(place, second.diagnostics))
    found = []
    for part in (first, second):
        for one in part.diagnostics:
            if place(one) not in shared:
                found.append(msgspec.structs.replace(one, message=f"{part.tool} alone: {one.message}"))
            elif part is first:
                found.append(one)
    return found
