"""Complaints of a compiler, and errors of a check, as diagnostics with file, line and element."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path

from urdfsync.check.compilers.compiler import Complaint
from urdfsync.check.package import PackageFiles
from urdfsync.check.results import listed
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.output.phrases import counted

_MOST_DIAGNOSTICS = 5
_LONGEST_MESSAGE = 300
_BALANCE = re.compile(r"([\d,]+) equations?(?:\(s\))?(?:,| and| for) ([\d,]+) (?:unknown|variable)")


def explain(problem: str, complaints: Sequence[Complaint], package: PackageFiles, model: str = "") -> list[Diagnostic]:
    """Diagnostics for a compiler's text about `model`, a name below the package; at least one.

    `complaints` are what the text says, with the files that people know.
    """
    if (balance := _BALANCE.search(problem)) and balance[1] != balance[2]:
        equations, unknowns = (int(number.replace(",", "")) for number in balance.groups())
        lacking = abs(equations - unknowns)
        # without the name of the model, since the models around it lack as many, which need not be said again
        message = f"there {'is' if lacking == 1 else 'are'} {counted(lacking, 'equation')} too "
        message += "many" if equations > unknowns else "few"
        path = f"{model.replace('.', '/')}.mo"
        is_users = path in package.texts and path not in package.owners
        return [_diagnostic(Complaint(message, str(package.folder / path) if is_users else ""), package, "unbalanced")]
    own = [one for one in complaints if Path(one.file).is_relative_to(package.folder)]
    found = dict.fromkeys(_diagnostic(one, package, "does-not-compile") for one in own or complaints)
    return list(found)[:_MOST_DIAGNOSTICS]


def _diagnostic(complaint: Complaint, package: PackageFiles, code: str) -> Diagnostic:
    """One complaint; where the compiler does not say where it is, perhaps in the edited file, if there is one."""
    file, message = Path(complaint.file), complaint.message.removesuffix(".")
    message = message if len(message) <= _LONGEST_MESSAGE else f"{message[: _LONGEST_MESSAGE - 1]}…"
    edited = [shown(package.folder / path) for path in sorted(package.edited)]
    look = f"look at {listed(edited)}, which {'was' if len(edited) == 1 else 'were'} edited" if edited else ""
    place = complaint.line, complaint.column
    if file.is_absolute() and file.is_relative_to(package.folder):
        path = file.relative_to(package.folder).as_posix().removeprefix(".")
        return package.diagnostic(Severity.ERROR, code, message, path, *place, hint=package.by_hand(path) or look)
    if file.is_absolute():
        return Diagnostic(Severity.ERROR, code, message, shown(file), *place, hint=look)
    where = edited[0] if len(edited) == 1 else shown(package.folder)
    return Diagnostic(Severity.ERROR, code, message, where, hint=look)


def findings_of(error: UrdfsyncError | OSError) -> tuple[Diagnostic, ...]:
    """What an error says, that of the system included, as findings."""
    if isinstance(error, UrdfsyncError):
        return error.diagnostics
    place = os.fsdecode(error.filename or "")
    return (Diagnostic(Severity.ERROR, "system", error.strerror or str(error), place),)
