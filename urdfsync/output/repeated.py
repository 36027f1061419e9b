"""Counts the findings that the last build of a robot has shown already; --verbose shows them in full.

This machine notes the shown findings. If the notes are lost, all are shown again.
"""

from __future__ import annotations

from collections.abc import Sequence

from urdfsync.config import STATE_FOLDER
from urdfsync.dependencies import record
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.remembered import finding_key, still
from urdfsync.engine.result import Result
from urdfsync.output.console import Console, line


def show_findings(console: Console, result: Result, diagnostics: Sequence[Diagnostic]) -> None:
    """Show findings of a robot; findings that its last build has shown already are only counted.

    Errors and findings about Modelica files are shown by each build.
    """
    folder = str(result.root / STATE_FOLDER)
    before, keys = record.findings_told(folder, result.robot), list(map(finding_key, diagnostics))
    new = [
        diagnostic
        for diagnostic, key in zip(diagnostics, keys, strict=True)
        if console.verbose
        or diagnostic.severity is Severity.ERROR
        or diagnostic.file.endswith(".mo")
        or key not in before
    ]
    console.findings(new)
    repeated = [finding for finding in diagnostics if finding not in new]
    if repeated and console.counts_robots:
        console.repeated_findings.append(len(repeated))
    elif repeated and not console.quiet:
        console.print([line((f"{result.robot}: {still(repeated)}", "dim"))], error=True)
    if before != set(keys) and not (result.dry or result.failed or console.quiet):
        record.note_findings(folder, result.robot, keys)
