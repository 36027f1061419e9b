"""Counts the findings that the last build of a robot has shown already; --verbose shows them in full.

This machine notes the shown findings. If the notes are lost, all are shown again.
"""

from __future__ import annotations

import os
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
    """Show findings of a robot; findings that its last build has shown already are only counted.

    Errors and findings about Modelica files are shown by each build.
    """
    folder = result.root / STATE_FOLDER
    depend_on(notes.place(folder, result.robot))  # if the notes change, no saved answer is used
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
        codes = ", ".join(dict.fromkeys(one.code for one in diagnostics if one not in new))
        them = "it" if rest == 1 else "them"
        words = f"{result.robot}: still {counted(rest, 'finding')} ({codes}); --verbose shows {them}"
        console.print([line((words, "dim"))], error=True)
    if before == frozenset(keys) or result.dry or result.failed or console.quiet:
        return
    notes.save(folder, result.robot, msgspec.structs.replace(known, said=frozenset(keys)))


def _key(diagnostic: Diagnostic) -> str:
    file = os.path.abspath(diagnostic.file)  # noqa: PTH100 - the same finding from each working folder
    return digest(f"{diagnostic.code}\0{diagnostic.message}\0{file}".encode(errors="surrogatepass"))
