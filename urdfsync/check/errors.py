"""Complaints of a compiler as diagnostics with file, line and element.

The compiler sees a copy of the package. Names that are not there are looked for in the package's own files.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.check.compilers.compiler import Complaint
from urdfsync.check.package import PackageFiles
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, Severity

_MOST_DIAGNOSTICS = 5
_LONGEST_MESSAGE = 300
_NAMED_FILES = 3
_BY_HAND = "the file was edited by hand"
_BALANCE = re.compile(r"([\d,]+) equations?(?:\(s\))?(?:,| and| for) ([\d,]+) (?:unknown|variable)")
_NOISE = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


def explain(
    problem: str,
    complaints: Sequence[Complaint],
    package: PackageFiles,
    folders: Mapping[Path, Path],
    said: Sequence[Diagnostic] = (),
    model: str = "",
) -> list[Diagnostic]:
    """Diagnostics for a compiler's text about `model`, a name below the package; at least one, unless it was `said`.

    `complaints` are what the text says; `folders` are those that the compiler reads, with those that people know.
    """
    if (balance := _BALANCE.search(problem)) and balance[1] != balance[2]:
        equations, unknowns = (int(number.replace(",", "")) for number in balance.groups())
        return _unbalanced(equations, unknowns, package, said, model)
    missing = {one.missing: one.kind for one in complaints if one.kind == "component"}
    classes = {one.missing: one.kind for one in complaints if one.kind == "class"}
    classes |= {one.missing: one.kind for one in complaints if one.kind == "function"}
    if missing or classes:  # if a class is missing, all components of that class are, too
        found = [_missing_name(name, kind, package) for name, kind in (classes or missing).items()]
    else:
        placed = [(one, _known_file(one.file, folders)) for one in complaints]
        own = [(one, file) for one, file in placed if file and file.is_relative_to(package.folder)]
        found = [_placed(one, file, package, folders) for one, file in own or placed]
    found = list(dict.fromkeys(found))
    if (more := len(found) - _MOST_DIAGNOSTICS) > 0:
        last = found[_MOST_DIAGNOSTICS - 1]
        hint = "; ".join(filter(None, [last.hint, f"there {'is' if more == 1 else 'are'} {more} more"]))
        found[_MOST_DIAGNOSTICS - 1 :] = [msgspec.structs.replace(last, hint=hint)]
    return found


def _known_file(file: str, folders: Mapping[Path, Path]) -> Path | None:
    """Where people find what a compiler read as `file`; None if the compiler names no file."""
    path = Path(file)
    for folder in sorted(folders, key=lambda folder: -len(folder.parts)):
        if path.is_relative_to(folder):
            return folders[folder] / path.relative_to(folder)
    return path if path.is_absolute() else None


def _placed(complaint: Complaint, file: Path | None, package: PackageFiles, folders: Mapping[Path, Path]) -> Diagnostic:
    message = complaint.message
    for folder in sorted(folders, key=lambda folder: -len(folder.parts)):
        message = message.replace(str(folder), shown(folders[folder]))
    message = message if len(message) <= _LONGEST_MESSAGE else f"{message[: _LONGEST_MESSAGE - 1]}…"
    message, line, column = message.removesuffix("."), complaint.line, complaint.column
    if file is None:
        return _somewhere(complaint.code, message, package)
    if file.is_relative_to(package.folder):
        path = file.relative_to(package.folder).as_posix()
        hint = _BY_HAND if path in package.edited else ""
        path = "" if path == "." else path
        return package.diagnostic(Severity.ERROR, complaint.code, message, path, line, column, hint)
    return Diagnostic(Severity.ERROR, complaint.code, message, shown(file), line, column, _look_at_edits(package))


def _unbalanced(
    equations: int, unknowns: int, package: PackageFiles, said: Sequence[Diagnostic], model: str
) -> list[Diagnostic]:
    """Whether equations lack or abound, unless as many do in a model of which that is said already."""
    for one in said:
        known = _BALANCE.search(one.message) if (one.code, one.severity) == ("unbalanced", Severity.ERROR) else None
        if known and int(known[1].replace(",", "")) - int(known[2].replace(",", "")) == equations - unknowns:
            return []
    balance = f"{equations:,} equation{'' if equations == 1 else 's'} for {unknowns:,} unknown"
    balance += "" if unknowns == 1 else "s"
    message = f"`{model}` has {balance}" if model else f"there are {balance}"
    own = f"{model.replace('.', '/')}.mo"
    if own in package.texts and own not in package.owners:
        return [package.diagnostic(Severity.ERROR, "unbalanced", message, own, hint=_look_at_edits(package))]
    return [_somewhere("unbalanced", message, package)]


def _missing_name(name: str, kind: str, package: PackageFiles) -> Diagnostic:
    """A name that the compiler can't find, at the first place that mentions it; edited files come first."""
    if name == package.name.partition(".")[0] != package.name:  # a package around: the robot's own is generated
        file = (package.folder, *package.folder.parents)[package.name.count(".")] / "package.mo"
        message, hint = f"there is no package `{name}`", "the class in this file has to be called so, like its folder"
        return Diagnostic(Severity.ERROR, "unresolved", message, shown(file), hint=hint)
    message = f"`{name}` is not declared" if kind == "component" else f"there is no {kind} `{name}`"
    dot = r"\s*(?:\[[^\]]*\]\s*)?\.\s*"
    mention = re.compile(rf"(?<![\w.]){dot.join(map(re.escape, name.split('.')))}(?!\w)")
    paths = (path for path in package.texts if path.endswith(".mo"))
    for path in sorted(paths, key=lambda path: (path not in package.edited, path)):
        code = _NOISE.sub(lambda noise: "\n" * noise[0].count("\n"), package.text(path))
        if found := mention.search(code):
            line, hint = code.count("\n", 0, found.start()) + 1, _BY_HAND if path in package.edited else ""
            return package.diagnostic(Severity.ERROR, "unresolved", message, path, line, hint=hint)
    if name.startswith(f"{package.name}."):
        path = name.removeprefix(f"{package.name}.").replace(".", "/") + ".mo"
        return package.diagnostic(Severity.ERROR, "unresolved", message, path, hint="it has to be declared there")
    hint = "nothing in the package mentions it: a library does, or a file around the package"
    return Diagnostic(Severity.ERROR, "unresolved", message, shown(package.folder), hint=hint)


def _somewhere(code: str, message: str, package: PackageFiles) -> Diagnostic:
    """Something of which the compiler does not say where it is: perhaps in the edited file, if there is one."""
    if len(package.edited) == 1:
        file = shown(package.folder / next(iter(package.edited)))
        return Diagnostic(Severity.ERROR, code, message, file, hint=f"look here first: {_BY_HAND}")
    return Diagnostic(Severity.ERROR, code, message, shown(package.folder), hint=_look_at_edits(package))


def _look_at_edits(package: PackageFiles) -> str:
    files = [shown(package.folder / path) for path in sorted(package.edited)]
    if len(files) == 1:
        return f"look at {files[0]}, which was edited"
    more = f" and {len(files) - _NAMED_FILES} more" if len(files) > _NAMED_FILES else ""
    return f"look at what was edited: {', '.join(files[:_NAMED_FILES])}{more}" if files else ""
