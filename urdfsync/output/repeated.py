"""Findings that the last build of a robot said already: said again in full only with --verbose, else counted.

`.urdfsync/said/` has their hashes, a file for each robot. It is not committed, and safe to lose: then all is said
again. Builds write it, and nothing else does.
"""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from pathlib import Path

from urdfsync.config import STATE_FOLDER
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.engine.result import Result
from urdfsync.files import Tree, digest, put
from urdfsync.output.console import Console, line
from urdfsync.spelling import counted


def show_findings(console: Console, result: Result, diagnostics: Sequence[Diagnostic]) -> None:
    """Show findings of a robot; those that its last build said already are counted.

    Errors, and what is wrong with Modelica files, are said as long as they are true.
    """
    file = result.root / STATE_FOLDER / "said" / result.robot
    before, keys = _load(file, result.root), list(map(_key, diagnostics))
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
    if before == set(keys) or result.dry or result.failed or console.quiet:
        return
    with contextlib.suppress(OutputError, OSError):  # then it is said again
        if not Tree(result.root).check_folder(file.parent):
            file.parent.mkdir()
        put(file, "".join(f"{key}\n" for key in sorted(set(keys))).encode())


def _key(diagnostic: Diagnostic) -> str:
    return digest(f"{diagnostic.code}\0{diagnostic.message}\0{diagnostic.file}".encode(errors="surrogatepass"))


def _load(file: Path, root: Path) -> set[str]:
    """Return the hashes of what was said; none if that is lost, or if something else is in its place."""
    with contextlib.suppress(OutputError):
        return {*(Tree(root).read(file) or b"").decode(errors="replace").split()}
    return set()
