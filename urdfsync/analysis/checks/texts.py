"""Finds faults in the texts of a package, without a compiler: syntax, layout, missing files.

The rules of the layout come from the language specification 3.6, section 13.4. All faults are found, not only the
first. One unparsable file makes a compiler refuse the whole package, often without naming the file.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path, PurePosixPath

from urdfsync.analysis.checks.package import PackageTexts, RobotPackage
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.files import normalised
from urdfsync.modelica.files import PACKAGE_FILE, class_path
from urdfsync.modelica.layout import check_class_file, check_order, check_places
from urdfsync.modelica.names import is_identifier
from urdfsync.modelica.syntax import StoredText, declared

_ORDER = "package.order"
_QUOTED_NAME = re.compile("'[^'.]+'")
_ERROR, _WARNING = Severity.ERROR, Severity.WARNING
_URI = re.compile(r'"modelica://([^/"\\]+)/([^"\\]+)"')


def check_layout(package: PackageTexts) -> list[Diagnostic]:
    """Return the faults of a package's files: errors keep tools from loading the package, warnings may.

    A generated package has none.
    """
    findings: list[Diagnostic] = []
    stored: dict[PurePosixPath, set[str]] = {PurePosixPath(): set()}  # classes that are files or folders, by folder
    misnamed: dict[PurePosixPath, set[str]] = {}  # names that no class can have, by folder
    declarations: dict[PurePosixPath, dict[str, int]] = {}  # lines of the declarations in `package.mo`, by folder
    for path in sorted(PurePosixPath(name) for name in package.texts if name.endswith(".mo")):
        if culprit := _misnamed_part(path):
            is_file = culprit == path
            name = culprit.stem if is_file else culprit.name
            message = f"`{name}` can't be the name of a {'class' if is_file else 'package'}"
            hint = f"rename the {'file' if is_file else 'folder'}, or move it elsewhere"
            findings.append(package.diagnostic(_ERROR, "wrong-name", message, str(culprit), hint=hint))
            misnamed.setdefault(culprit.parent, set()).update((name, culprit.name))
            continue
        place = class_path(path)
        stored.setdefault(path.parent, set())
        for part in (place, *place.parents):
            if part.parts:
                stored.setdefault(part.parent, set()).add(part.name)
        text, faults = _check_file(package, str(path), ".".join((package.name, *place.parts)))
        findings += faults
        if path.name == PACKAGE_FILE and text:
            inside = [declaration for declaration in declared(text.classes) if len(declaration.path) == 2]
            declarations[place] = {declaration.path[1]: declaration.line for declaration in reversed(inside)}
    for folder in sorted(stored):
        findings += _check_folder(package, folder, stored[folder])
        if str(folder / _ORDER) in package.texts:
            present = stored[folder] | declarations.get(folder, {}).keys()
            others = misnamed.get(folder, set()) if folder in declarations else None
            findings += _check_order(package, folder, present, others)
    twice = check_places(package.texts, {str(folder / PACKAGE_FILE): lines for folder, lines in declarations.items()})
    findings += [_placed(package, path, finding) for path, finding in twice]
    return sorted(dict.fromkeys(findings), key=lambda finding: (finding.file, finding.line))


def _check_folder(package: PackageTexts, folder: PurePosixPath, stored: Collection[str]) -> Iterator[Diagnostic]:
    """Check that a folder is a package, and that its classes `stored` differ by more than case."""
    if str(folder / PACKAGE_FILE) not in package.texts:
        message, where = f"the folder holds classes, but no {PACKAGE_FILE}", str(folder) if folder.parts else ""
        advice = "add this file, or move the classes elsewhere"
        yield package.diagnostic(_ERROR, "no-package-file", message, where, hint=advice)
    spellings: dict[str, str] = {}
    for name in sorted(stored):
        if (first := spellings.setdefault(name.casefold(), name)) != name:
            message = f"`{name}` and `{first}` differ only by case"
            advice = "rename one class: file systems that ignore case do not hold both"
            yield package.diagnostic(_WARNING, "same-but-for-case", message, f"{folder / name}.mo", hint=advice)


def check_around(output: Path, files: Mapping[str, bytes]) -> list[Diagnostic]:
    """Return the faults that keep compilers from reading the files around a package: syntax, `within`, package names.

    `files` has contents by the path below the output folder. Other faults in these files are not reported.
    """
    findings, package = list[Diagnostic](), PackageTexts("", output, files)
    for path in sorted(PurePosixPath(name) for name in files if name.endswith(".mo")):
        ignored = {"repeated", "second-class", *([] if path.name == PACKAGE_FILE else ["wrong-name"])}
        ignored |= {"wrong-name", "wrong-within"} if _misnamed_part(path) else set()
        faults = _check_file(package, str(path), ".".join(class_path(path).parts))[1]
        findings += [fault for fault in faults if fault.code not in ignored]
    return findings


def _check_file(package: PackageTexts, path: str, name: str) -> tuple[StoredText | None, list[Diagnostic]]:
    """Check one file; return its declarations, or None if it can't be read. `name` is its class's full name."""
    text = _decoded(package, path)
    if isinstance(text, Diagnostic):
        return None, [text]
    stored, faults = check_class_file(text, PurePosixPath(path), name)
    return stored, [_placed(package, path, fault) for fault in faults]


def _check_order(
    package: PackageTexts, folder: PurePosixPath, present: set[str], others: set[str] | None
) -> Iterator[Diagnostic]:
    """Check the `package.order` of a folder, as `check_order` does."""
    path = str(folder / _ORDER)
    text = _decoded(package, path)
    if isinstance(text, Diagnostic):
        yield text
        return
    yield from (_placed(package, path, finding) for finding in check_order(text, present, others))


def _placed(package: PackageTexts, path: str, finding: Diagnostic) -> Diagnostic:
    return package.diagnostic(finding.severity, finding.code, finding.message, path, finding.line, hint=finding.hint)


def _misnamed_part(path: PurePosixPath) -> PurePosixPath | None:
    """Return the outermost folder around a file, or the file itself, with a name that no class can have."""
    for part in [*reversed(path.parents[:-1]), *([] if path.name == PACKAGE_FILE else [path])]:
        name = part.stem if part is path else part.name
        if not (is_identifier(name) or _QUOTED_NAME.fullmatch(name)):
            return part
    return None


def _decoded(package: PackageTexts, path: str) -> str | Diagnostic:
    """Return the text of a file, or a finding if the file is not UTF-8."""
    try:
        return normalised(package.texts[path]).decode()
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        return package.diagnostic(_ERROR, "not-utf8", "the file is not in UTF-8", path, line, hint="save it as UTF-8")


def missing_resources(package: RobotPackage) -> Iterator[Diagnostic]:
    """Yield a finding for each missing file below the package's own folders to which a text refers."""
    own, output = package.robot.target.package, package.robot.output
    hint = "build to restore an imported file, or put the file there"
    for path in sorted(package.on_disk):
        text, addresses = package.files.text(path), set[str]()
        for match in _URI.finditer(text):
            top, folder = match[1], output.joinpath(*match[1].split("."))
            is_ours = f"{own}.".startswith(f"{top}.") or top.startswith(f"{own}.")
            if is_ours and folder.is_dir() and match[0] not in addresses and not (folder / match[2]).exists():
                addresses.add(match[0])
                line = text.count("\n", 0, match.start()) + 1
                message = f"the file refers to `{match[0][1:-1]}`, which does not exist"
                yield package.files.diagnostic(Severity.ERROR, "missing-resource", message, path, line, hint=hint)
