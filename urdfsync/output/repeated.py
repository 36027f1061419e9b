"""Counts the findings that the last build of a robot has shown already; --verbose shows them in full.

This machine notes the shown findings. If the notes are lost, all are shown again.
"""

from __future__ import annotations

from collections.abc import Sequence, Set

from urdfsync.common.dependencies.memory import Memory
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.engine.remembered import finding_key, still
from urdfsync.engine.result import Result
from urdfsync.output.console import Console, line
from urdfsync.project.config import STATE_FOLDER


def show_findings(console: Console, result: Result, diagnostics: Sequence[Diagnostic]) -> None:
    """Show findings of a robot; findings that its last build has shown already are only counted."""
    before = findings_told(result)
    new = untold(before, diagnostics, verbose=console.verbose)
    console.findings(new)
    repeated = [finding for finding in diagnostics if finding not in new]
    if repeated and console.counts_robots:
        console.repeated_findings.append(len(repeated))
    elif repeated and not console.quiet:
        console.print([line((f"{result.robot}: {still(repeated)}", "dim"))], error=True)
    known = [finding for finding in diagnostics if finding_key(finding) in before]
    note(result, before, known if console.quiet else diagnostics)


def findings_told(result: Result) -> set[str]:
    """Return the keys of the findings that the last build of a robot has shown on this machine."""
    return Memory(result.root / STATE_FOLDER).told(result.robot)


def untold(before: Set[str], diagnostics: Sequence[Diagnostic], *, verbose: bool) -> list[Diagnostic]:
    """Return the findings that are not among those shown `before`; all if `verbose`.

    Errors and findings about Modelica files are shown by each build.
    """
    return [
        diagnostic
        for diagnostic in diagnostics
        if verbose
        or diagnostic.severity is Severity.ERROR
        or diagnostic.file.endswith(".mo")
        or finding_key(diagnostic) not in before
    ]


def note(result: Result, before: Set[str], diagnostics: Sequence[Diagnostic]) -> None:
    """Note the findings that a build has shown or counted; `before` are the noted ones."""
    keys = {*map(finding_key, diagnostics)}
    if before != keys and not (result.dry or result.failed):
        Memory(result.root / STATE_FOLDER).tell(result.robot, keys)
