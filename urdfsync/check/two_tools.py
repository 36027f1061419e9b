"""The answers of one compiler about a package, or of two, which are held against each other."""

from __future__ import annotations

import time
from collections.abc import Sequence

import msgspec

from urdfsync.check.compilation import Compilation, compare
from urdfsync.check.process import Limits
from urdfsync.check.results import CheckResult
from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import Experiment


def run_compilations(
    compilations: Sequence[Compilation], experiment: Experiment | None, result: CheckResult, limits: Limits
) -> None:
    """Compile a package with one compiler after the other; the answers go into the result."""
    for one in compilations:
        begin, peak, limits.peak = time.monotonic(), limits.peak, 0.0
        one.run(experiment)
        one.result.seconds, one.result.megabytes = time.monotonic() - begin, limits.peak / 1e6
        limits.peak = max(peak, limits.peak)
        result.gaps += tuple(
            f"{one.result.tool}: {gap}" if result.tools else gap for gap in one.gaps if gap not in result.gaps
        )
        result.tools += (one.result,)
    result.add(_findings(compilations))
    if experiment and len(compilations) > 1:
        first, second = compilations
        if first.generated and second.generated:
            result.between = compare(experiment.compared, second.generated, first.generated)
        if first.edited and second.edited:
            result.between_edited = compare(experiment.compared, second.edited, first.edited)


def _findings(compilations: Sequence[Compilation]) -> list[Diagnostic]:
    """Return the findings: what all compilers have at the same place once, what one has alone under its name."""

    def place(one: Diagnostic) -> tuple[object, ...]:
        return one.severity, one.file, one.line, one.code, "" if one.line else one.message

    places = [set(map(place, one.diagnostics)) for one in compilations]
    findings, shared = list[Diagnostic](), set.intersection(*places)
    for compilation in compilations:
        for one in compilation.diagnostics:
            if place(one) not in shared:
                findings.append(msgspec.structs.replace(one, message=f"{compilation.result.tool} alone: {one.message}"))
            elif compilation is compilations[0]:
                findings.append(one)
    return findings
