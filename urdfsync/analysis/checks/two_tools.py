"""The check of a package with two compilers: their answers together, and the comparison with each other."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from urdfsync.analysis.checks.compilation import Compilation, compare_all
from urdfsync.analysis.checks.results import CheckResult, ToolResult
from urdfsync.common.diagnostics import Diagnostic
from urdfsync.domain.experiment import Experiment


def run_both(first: Compilation, second: Compilation, experiment: Experiment | None, result: CheckResult) -> None:
    """Compile a package with one compiler after the other; add the answers, and how they differ, to the result."""
    first.run(experiment)
    second.run(experiment)
    one, other = result.tools = first.result, second.result
    result.tool = f"{one.tool} and {other.tool}"
    by_other = {model.model for model in other.compiled}
    result.compiled = tuple(model for model in one.compiled if model.model in by_other)
    result.failing = tuple(dict.fromkeys((*one.failing, *other.failing)))
    if one.deviations is not None or other.deviations is not None:
        result.deviations = *(one.deviations or ()), *(other.deviations or ())
    result.effects, result.curves = one.effects or other.effects, one.curves or other.curves
    result.add(_findings(result.tools))
    shared = {*one.gaps} & {*other.gaps}
    gaps = [gap if gap in shared else f"{tool.tool}: {gap}" for tool in result.tools for gap in tool.gaps]
    result.gaps = tuple(dict.fromkeys((*result.gaps, *gaps)))
    if experiment and first.generated and second.generated:
        result.between = compare_all(experiment.trials, second.generated, first.generated)
    if experiment and first.edited and second.edited:
        result.between_edited = compare_all(experiment.trials, second.edited, first.edited)


def _findings(tools: Sequence[ToolResult]) -> list[Diagnostic]:
    """Return the findings: those of both compilers once, in the words of the first; others with the compiler's name."""

    def place(finding: Diagnostic) -> tuple[object, ...]:
        return finding.severity, finding.file, finding.line, finding.code, "" if finding.line else finding.message

    shared = set.intersection(*({place(finding) for finding in tool.diagnostics} for tool in tools))
    findings = [finding for finding in tools[0].diagnostics if place(finding) in shared]
    for tool in tools:
        for finding in tool.diagnostics:
            if place(finding) not in shared:
                message = f"only {tool.tool} reports: {finding.message}"
                findings.append(msgspec.structs.replace(finding, message=message))
    return findings
