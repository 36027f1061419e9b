"""The answers of one compiler about a package, or of two, which are held against each other."""

from __future__ import annotations

import time
from collections.abc import Sequence

import msgspec

from urdfsync.checks.compilation import Compilation, compare_all
from urdfsync.checks.process import Limits
from urdfsync.checks.results import CheckResult
from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import Experiment


def run_compilations(
    compilations: Sequence[Compilation], experiment: Experiment | None, result: CheckResult, limits: Limits
) -> None:
    """Compile a package with one compiler after the other; the answers go into the result."""
    for compilation in compilations:
        begin, peak, limits.peak = time.monotonic(), limits.peak, 0.0
        compilation.run(experiment)
        compilation.result.seconds, compilation.result.megabytes = time.monotonic() - begin, limits.peak / 1e6
        limits.peak = max(peak, limits.peak)
        result.gaps += tuple(
            f"{compilation.result.tool}: {gap}" if result.tools else gap
            for gap in compilation.gaps
            if gap not in result.gaps
        )
        result.tools += (compilation.result,)
    result.add(_findings(compilations))
    if experiment and len(compilations) > 1:
        first, second = compilations
        if first.generated and second.generated:
            result.between = compare_all(experiment.trials, second.generated, first.generated)
        if first.edited and second.edited:
            result.between_edited = compare_all(experiment.trials, second.edited, first.edited)


def _findings(compilations: Sequence[Compilation]) -> list[Diagnostic]:
    """Return the findings: what all compilers have at the same place once, what one has alone under its name."""

    def place(finding: Diagnostic) -> tuple[object, ...]:
        return finding.severity, finding.file, finding.line, finding.code, "" if finding.line else finding.message

    places = [set(map(place, compilation.diagnostics)) for compilation in compilations]
    findings, shared = list[Diagnostic](), set.intersection(*places)
    for compilation in compilations:
        for finding in compilation.diagnostics:
            if place(finding) not in shared:
                findings.append(
                    msgspec.structs.replace(finding, message=f"{compilation.result.tool} alone: {finding.message}")
                )
            elif compilation is compilations[0]:
                findings.append(finding)
    return findings
