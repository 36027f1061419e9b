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
from urdfsync.check.results import listed
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.output.phrases import counted

_MOST_DIAGNOSTICS = 5
_LONGEST_MESSAGE = 300
_BALANCE = re.compile(r"([\d,]+) equations?(?:\(s\))?(?:,| and| for) ([\d,]+) (?:unknown|variable)")
_NOISE = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


def explain(
    problem: str,
    complaints: Sequence[Complaint],
    package: PackageFiles,
    folders: Mapping[Path, Path],
    model: str = "",
) -> list[Diagnostic]:
    """Diagnostics for a compiler's text about `model`, a name below the package; at least one.

    `complaints` are what the text says; `folders` are those that the compiler reads, with those that people know.
    """
    if (balance := _BALANCE.search(problem)) and balance[1] != balance[2]:
        equations, unknowns = (int(number.replace(",", "")) for number in balance.groups())
        lacking = abs(equations - unknowns)
        # without the name of the model, since the models around it lack as many, which need not be said again
        message = f"there {'is' if lacking == 1 else 'are'} {counted(lacking, 'equation')} too "
        message += "many" if equations > unknowns else "few"
        path = f"{model.replace('.', '/')}.mo"
        if path in package.texts and path not in package.owners:  # a model of the user's
            return [package.diagnostic(Severity.ERROR, "unbalanced", message, path, hint=_look_at_edits(package))]
        return [_somewhere("unbalanced", message, package)]
    missing = {one.missing: one.kind for one in complaints if one.missing}
    classes = {name: kind for name, kind in missing.items() if kind != "component"}
    if missing:  # if a class is missing, all components of that class are, too
        found = [_missing_name(name, kind, package) for name, kind in (classes or missing).items()]
    else:
        known = [_with_known_folders(one, folders) for one in complaints]
        own = [one for one in known if Path(one.file).is_relative_to(package.folder)]
        found = [_placed(one, package) for one in own or known]
    found = list(dict.fromkeys(found))
    if (more := len(found) - _MOST_DIAGNOSTICS) > 0:
        *found, last = found[:_MOST_DIAGNOSTICS]
        hint = "; ".join(filter(None, [last.hint, f"there {'is' if more == 1 else 'are'} {more} more"]))
        found.append(msgspec.structs.replace(last, hint=hint))
    return found


def _with_known_folders(complaint: Complaint, folders: Mapping[Path, Path]) -> Complaint:
    """A complaint with the folders that people know instead of those that the compiler read."""
    message, file = complaint.message, complaint.file
    for folder in sorted(folders, key=lambda folder: -len(folder.parts)):
        message = message.replace(str(folder), shown(folders[folder]))
        if Path(file).is_relative_to(folder):
            file = str(folders[folder] / Path(file).relative_to(folder))
    message = message if len(message) <= _LONGEST_MESSAGE else f"{message[: _LONGEST_MESSAGE - 1]}…"
    return msgspec.structs.replace(complaint, message=message.removesuffix("."), file=file)


def _placed(complaint: Complaint, package: PackageFiles) -> Diagnostic:
    file, facts = Path(complaint.file), (Severity.ERROR, complaint.code, complaint.message)
    if not file.is_absolute():
        return _somewhere(complaint.code, complaint.message, package)
    place = complaint.line, complaint.column
    if file.is_relative_to(package.folder):
        path = file.relative_to(package.folder).as_posix().removeprefix(".")
        return package.diagnostic(*facts, path, *place, package.by_hand(path))
    return Diagnostic(*facts, shown(file), *place, _look_at_edits(package))


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
            line = code.count("\n", 0, found.start()) + 1
            return package.diagnostic(Severity.ERROR, "unresolved", message, path, line, hint=package.by_hand(path))
    if name.startswith(f"{package.name}."):
        path = name.removeprefix(f"{package.name}.").replace(".", "/") + ".mo"
        return package.diagnostic(Severity.ERROR, "unresolved", message, path, hint="it has to be declared there")
    hint = "nothing in the package mentions it: a library does, or a file around the package"
    return Diagnostic(Severity.ERROR, "unresolved", message, shown(package.folder), hint=hint)


def _somewhere(code: str, message: str, package: PackageFiles) -> Diagnostic:
    """Something of which the compiler does not say where it is: perhaps in the edited file, if there is one."""
    if len(package.edited) == 1:
        (path,) = package.edited
        hint = f"look here first: {package.by_hand(path)}"
        return Diagnostic(Severity.ERROR, code, message, shown(package.folder / path), hint=hint)
    return Diagnostic(Severity.ERROR, code, message, shown(package.folder), hint=_look_at_edits(package))


def _look_at_edits(package: PackageFiles) -> str:
    files = [shown(package.folder / path) for path in sorted(package.edited)]
    return f"look at {listed(files)}, which {'was' if len(files) == 1 else 'were'} edited" if files else ""
