"""What the last build of a robot said of its source: said again in full only with --verbose, else counted.

`.urdfsync/said/` has the hashes of these findings, a file for each robot. It is not committed, and safe to lose: then
all is said again. Builds write it, and nothing else does.
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
from urdfsync.output.phrases import counted

_MODELICA = ".mo"


def show_findings(console: Console, result: Result, found: Sequence[Diagnostic] | None = None) -> None:
    """Show a robot's findings, or only those `found`: what its last build has said already is counted.

    Errors, and what is wrong with Modelica files, are said as long as they are true.
    """
    file = _file(result)
    before, told = _load(file, result.root), result.diagnostics if found is None else found
    repeated = [] if console.verbose else [one for one in told if _is_said_once(one) and _key(one) in before]
    console.findings([one for one in told if one not in repeated])
    if repeated and not console.quiet:
        notes = sum(one.severity is Severity.NOTE for one in repeated)
        counts = [
            counted(number, noun) for number, noun in ((notes, "note"), (len(repeated) - notes, "warning")) if number
        ]
        console.print(
            [line((f"{result.robot}: {' and '.join(counts)} as before; --verbose shows them", "dim"))], error=True
        )
    if not (result.dry or result.failed or console.quiet):
        _save(file, before, {_changes_key(result), *(_key(one) for one in told if _is_said_once(one))})


def has_same_changes(result: Result) -> bool:
    """Return whether the last build listed the changes of the model already: they wait for a conflict."""
    return bool(result.conflicts) and _changes_key(result) in _load(_file(result), result.root)


def _file(result: Result) -> Path:
    return result.root / STATE_FOLDER / "said" / result.robot


def _changes_key(result: Result) -> str:
    return digest(repr(result.effective_changes).encode(errors="surrogatepass")) if result.conflicts else ""


def _is_said_once(found: Diagnostic) -> bool:
    return found.severity is not Severity.ERROR and not found.file.endswith(_MODELICA)


def _key(found: Diagnostic) -> str:
    return digest(f"{found.code}\0{found.message}\0{found.file}".encode(errors="surrogatepass"))


def _load(file: Path, root: Path) -> set[str]:
    """Return the hashes of what was said; none if that is lost, or if something else is in its place."""
    with contextlib.suppress(OutputError):
        return {*(Tree(root).read(file) or b"").decode(errors="replace").split()}
    return set()


def _save(file: Path, before: set[str], now: set[str]) -> None:
    """Write the hashes of what was said, if they are others; what can't be written is said again."""
    if before == now - {""}:
        return
    with contextlib.suppress(OutputError, OSError):
        if not Tree(file.parents[2]).check_folder(file.parent):
            file.parent.mkdir()
        put(file, "".join(f"{key}\n" for key in sorted(filter(None, now))).encode())
