"""Whether the files of a package are Modelica, and stand where the language wants them. No compiler is asked.

The rules are those of the language specification 3.6, section 13.4. All faults are found, not only the first one:
one file that does not parse makes a compiler give up the whole package, often without telling which one it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath

from urdfsync.check.package import PackageFiles, holds_class
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.files import normalised
from urdfsync.modelica.lexer import find_markers
from urdfsync.modelica.names import is_identifier, within
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import StoredText, declared
from urdfsync.spelling import nearest

_ORDER, _PACKAGE = "package.order", "package.mo"
_QUOTED_NAME = re.compile("'[^'.]+'")
_ALLOWED_TWICE = ("has the equation", "connects", "extends")  # the language has nothing against these
_BYTE_ORDER_MARK = "\ufeff"
_ERROR, _WARNING = Severity.ERROR, Severity.WARNING


def check_layout(package: PackageFiles) -> list[Diagnostic]:
    """All that is wrong with the files of a package: errors where a tool can't load it, warnings where it may.

    What is generated never gets one.
    """
    found: dict[Diagnostic, None] = {}
    files: dict[PurePosixPath, list[str]] = {PurePosixPath(): []}  # of each class, by its name below the package
    declarations: dict[PurePosixPath, dict[str, int]] = {}  # lines of what a `package.mo` declares
    misnamed: dict[PurePosixPath, str] = {}
    for path in sorted(filter(holds_class, map(PurePosixPath, package.texts))):
        if culprit := _misnamed_part(path):
            misnamed[culprit] = culprit.stem if culprit == path else culprit.name
            kind, noun = ("class", "file") if culprit == path else ("package", "folder")
            message = f"`{misnamed[culprit]}` can't be the name of a {kind}"
            hint = f"rename the {noun}, or move it elsewhere"
            found[package.diagnostic(_ERROR, "wrong-name", message, str(culprit), hint=hint)] = None
            continue
        name = path.parent if path.name == _PACKAGE else path.with_suffix("")
        files.setdefault(name, []).append(str(path))
        for folder in path.parents:
            files.setdefault(folder, [])
        text, faults = check_file(package, str(path), ".".join((package.name, *name.parts)))
        found |= dict.fromkeys(faults)
        if path.name == _PACKAGE and text:
            inside = [one for one in declared(text.classes) if len(one.path) == 2]
            declarations[name] = {one.path[1]: one.line for one in reversed(inside)}

    folders = {folder for name in files if name.parts for folder in [name.parent]} | {PurePosixPath()}
    folders |= {PurePosixPath(path).parent for paths in files.values() for path in paths}
    for folder in sorted(folders):
        place = str(folder / _PACKAGE)
        if place not in package.texts:
            message, hint = f"the folder holds classes, but no {_PACKAGE}", "add one, or move the files elsewhere"
            shown = "" if not folder.parts else str(folder)
            found[package.diagnostic(_ERROR, "no-package-file", message, shown, hint=hint)] = None
        stored = sorted(name for name in files if name.parts and name.parent == folder)
        lines, spellings = declarations.get(folder, {}), dict[str, str]()
        for name in stored:
            file, both = f"{name}.mo", f"{name}.mo" in package.texts and name in folders
            if both:
                message = f"`{name.name}` is both a file and a folder"
                found[package.diagnostic(_ERROR, "class-twice", message, file, hint="keep one of them")] = None
            if line := lines.get(name.name):
                message = f"`{name.name}` is declared here, and is a {'folder' if name in folders else 'file'} as well"
                found[package.diagnostic(_ERROR, "class-twice", message, place, line, hint="keep one of them")] = None
            first = spellings.setdefault(name.name.casefold(), name.name)
            if first != name.name:
                message = f"`{name.name}` and `{first}` differ only by case"
                hint = "rename one: file systems that ignore case do not hold both"
                found[package.diagnostic(_WARNING, "same-but-for-case", message, file, hint=hint)] = None
        if str(folder / _ORDER) in package.texts:
            present = {name.name for name in stored} | lines.keys()
            others = {word for path, name in misnamed.items() if path.parent == folder for word in (name, path.name)}
            is_known = folder in declarations
            found |= dict.fromkeys(_check_order(package, folder, present, others if is_known else None))
    return sorted(found, key=lambda one: (one.file, one.line))


def check_around(files: Mapping[Path, bytes]) -> list[Diagnostic]:
    """What keeps a compiler from reading files beside a package: syntax, `within`, and the names of packages.

    `files` are by absolute path, and hold each `package.mo` around a file. Other faults of theirs are left to those
    who make them.
    """
    found: list[Diagnostic] = []
    for file in sorted(files):
        top = next((folder for folder in reversed(file.parents) if folder / _PACKAGE in files), None)
        folder = top or file.parent
        path = PurePosixPath(file.relative_to(folder).as_posix())
        if holds_class(path):
            parts = [*([top.name] if top else []), *path.with_suffix("").parts]
            first, *others = parts[:-1] if top and path.name == _PACKAGE else parts
            name = ".".join((first.partition(" ")[0], *others))  # a version may follow the name of a library
            package = PackageFiles(name, folder, {str(path): files[file]})
            ignored = {"repeated", "second-class", *(["wrong-within"] if _misnamed_part(path) else [])}
            ignored |= set() if path.name == _PACKAGE and not _misnamed_part(path) else {"wrong-name"}
            found += [one for one in check_file(package, str(path), name)[1] if one.code not in ignored]
    return found


def check_file(package: PackageFiles, path: str, name: str) -> tuple[StoredText | None, list[Diagnostic]]:
    """Check one file; returns what it declares, None if it can't be read. `name` is the full name of its class."""
    said: list[Diagnostic] = []

    def say(severity: Severity, code: str, message: str, line: int = 0, hint: str = "") -> None:
        said.append(package.diagnostic(severity, code, message, path, line, hint=hint))

    text = _decoded(package, path)
    if isinstance(text, Diagnostic):
        return None, [text]
    if text.startswith(_BYTE_ORDER_MARK):
        hint = "save it without: some compilers refuse it"
        say(_WARNING, "byte-order-mark", "the file begins with a byte order mark", 1, hint)
    found = parse(text)
    if found.is_broken:  # only the first place is told, since others may follow from it
        breaking = [fault for fault in found.faults if not fault.is_repetition]
        first = next(iter(find_markers(text)), min(breaking, key=lambda fault: fault.line))
        hint = "correct it first: more places in the file may look wrong because of it" if found.faults[1:] else ""
        say(_ERROR, "syntax", f"the file {first.reason}", first.line, hint)
        return None, said
    for fault in found.faults:
        severity, code = (_WARNING, "repeated") if fault.reason.startswith(_ALLOWED_TWICE) else (_ERROR, "syntax")
        say(severity, code, f"the file {fault.reason}", fault.line)
    parent, _, expected = name.rpartition(".")
    if not found.classes:
        say(_ERROR, "no-class", "the file holds no class", 0, f"write the class `{expected}`, or delete the file")
        return found, said
    if (found.within or "") != parent:
        message, hint = f"the file lacks `{within(name)}`", "put it into the first line"
        if found.within is not None:
            message = f"the file says `within {found.within};`, but stands in `{parent or 'no package'}`"
            hint = f"write `{within(name)}`"
        say(_ERROR, "wrong-within", message, found.within_line or 1, hint)
    main = next((one for one in found.classes if str(one.name) == expected), found.classes[0])
    if str(main.name) != expected:
        place = "folder" if PurePosixPath(path).name == _PACKAGE else "file"
        message = f"the class is called `{main.name}`, but its {place} `{expected}`"
        say(_ERROR, "wrong-name", message, main.name.line, f"give class and {place} the same name")
    for other in found.classes:
        if other is not main:
            message = f"the file holds `{other.name}` besides `{main.name}`"
            hint = "a file in a package holds one class: give it one of its own"
            say(_ERROR, "second-class", message, other.name.line, hint)
    return found, said


def _check_order(
    package: PackageFiles, folder: PurePosixPath, present: set[str], others: set[str] | None
) -> Iterator[Diagnostic]:
    """Check whether a `package.order` names what is `present` in the folder, each once.

    It may name `others`, too; anything if that is None, since `package.mo` can't be read.
    """
    path = str(folder / _ORDER)
    text = _decoded(package, path)
    if isinstance(text, Diagnostic):
        yield text
        return
    names = [line.strip() for line in text.removeprefix(_BYTE_ORDER_MARK).split("\n")]
    lacking = sorted(present.difference(names))
    for name in lacking:
        generated = {str(folder / f"{name}.mo"), str(folder / name / _PACKAGE)} & package.owners.keys()
        is_ours = generated and str(folder / _PACKAGE) in package.owners
        hint = "`urdfsync build` adds it" if is_ours else "add it where it belongs: tools put it last, or warn"
        yield package.diagnostic(_WARNING, "order-lacks", f"`{name}` is not named", path, hint=hint)
    lines: dict[str, int] = {}
    for number, name in enumerate(names, start=1):
        first = lines.setdefault(name, number)
        if name and first != number:
            message, hint = f"`{name}` is named twice, first in line {first}", "take one of the lines out"
            yield package.diagnostic(_WARNING, "order-twice", message, path, number, hint=hint)
        elif name and others is not None and name not in present | others:
            near = nearest(name, lacking)
            message = f"`{name}` is named, but is no class and no constant of the package"
            hint = f"did you mean `{near}`?" if near else "take the line out, or bring the class back"
            yield package.diagnostic(_ERROR, "order-unknown", message, path, number, hint=hint)


def _misnamed_part(path: PurePosixPath) -> PurePosixPath | None:
    """The outermost folder around a file, or the file itself, whose name no class can have."""
    parts = [*reversed(path.parents[:-1]), *([] if path.name == _PACKAGE else [path])]
    names = [(part, part.stem if part is path else part.name) for part in parts]
    return next((part for part, name in names if not (is_identifier(name) or _QUOTED_NAME.fullmatch(name))), None)


def _decoded(package: PackageFiles, path: str) -> str | Diagnostic:
    """The text of a file, or the finding that it is not UTF-8."""
    try:
        return normalised(package.texts[path]).decode()
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        return package.diagnostic(_ERROR, "not-utf8", "the file is not in UTF-8", path, line, hint="save it as UTF-8")
