"""Findings that the last build of a robot told already: told again in full only with --verbose, else counted.

This machine notes what was told. If the notes are lost, all is told again.
"""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from urdfsync.answers.dependencies import depend_on
from urdfsync.config import STATE_FOLDER
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.result import Result
from urdfsync.files import digest
from urdfsync.output.console import Console, line
from urdfsync.spelling import counted
from urdfsync.state import notes


def show_findings(console: Console, result: Result, diagnostics: Sequence[Diagnostic]) -> None:
    """Show findings of a robot; those that its last build said already are counted.

    Errors, and what is wrong with Modelica files, are said as long as they are true.
    """
    folder = result.root / STATE_FOLDER
    depend_on(notes.place(folder, result.robot))  # a saved answer repeats no finding that was told since
    known = notes.load(folder, result.robot)
    before, keys = known.said, list(map(_key, diagnostics))
    new = [
        diagnostic
        for diagnostic, key in zip(diagnostics, keys, strict=True)
        if console.verbose
        or diagnostic.severity is Severity.ERROR
        or diagnostic.file.endswith(".mo")
        or key not in before
    ]
    console.findings(new)
    if (rest := len(diagnostics) - len(new)) and not console.quiet:
        words = f"{result.robot}: {counted(rest, 'finding')} as before; --verbose shows {'it' if rest == 1 else 'them'}"
        console.print([line((words, "dim"))], error=True)
    if before == frozenset(keys) or result.dry or result.failed or console.quiet:
        return
    notes.save(folder, result.robot, msgspec.structs.replace(known, said=frozenset(keys)))


def _key(diagnostic: Diagnostic) -> str:
    return digest(f"{diagnostic.code}\0{diagnostic.message}\0{diagnostic.file}".encode(errors="surrogatepass"))
