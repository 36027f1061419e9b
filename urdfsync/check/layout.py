"""Whether the files of a package are Modelica, and stand where the language wants them. No compiler is asked.

The rules are those of the language specification 3.6, section 13.4. All faults are found, not only the first one:
one file that does not parse makes a compiler give up the whole package, often without telling which one it is.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path, PurePosixPath

import msgspec

from urdfsync.check.package import PackageFiles, holds_class
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.files import normalised
from urdfsync.modelica.lexer import find_markers
from urdfsync.modelica.names import is_identifier, within
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import StoredText, declared
from urdfsync.spelling import nearest

_ORDER, _PACKAGE, _SUFFIX = "package.order", "package.mo", ".mo"
_QUOTED_NAME = re.compile("'[^'.]+'")
_ALLOWED_TWICE = ("has the equation", "connects", "extends")  # the language has nothing against these
_BYTE_ORDER_MARK = "\ufeff"
_ERROR, _WARNING = Severity.ERROR, Severity.WARNING


class _Folder(msgspec.Struct):
    """A folder that should be a package; names of what is in it."""

    files: set[str] = msgspec.field(default_factory=set)
    """Its `.mo` files."""
    folders: set[str] = msgspec.field(default_factory=set)
    """Folders in it that have `.mo` files somewhere."""
    misnamed: set[str] = msgspec.field(default_factory=set)
    """Files and folders whose names no class can have; they are not among the others."""


def check_layout(package: PackageFiles) -> list[Diagnostic]:
    """All that is wrong with the files of a package: errors where a tool can't load it, warnings where it may.

    What is generated never gets one.
    """
    folders: defaultdict[PurePosixPath, _Folder] = defaultdict(_Folder, {PurePosixPath(): _Folder()})
    for path in filter(holds_class, map(PurePosixPath, package.texts)):
        culprit = _misnamed_part(path)
        place = culprit or path
        (folders[place.parent].misnamed if culprit else folders[place.parent].files).add(place.name)
        for folder in place.parents[:-1]:
            folders[folder.parent].folders.add(folder.name)
    return [found for path in sorted(folders) for found in _check_folder(package, path, folders[path])]


def check_around(files: Mapping[Path, bytes]) -> list[Diagnostic]:
    """What keeps a compiler from reading files beside a package: syntax, and `within`.

    `files` are by absolute path, and hold each `package.mo` around a file. Other faults of theirs are left to those
    who make them.
    """
    found: list[Diagnostic] = []
    for file in sorted(files):
        top = next((folder for folder in reversed(file.parents) if folder / _PACKAGE in files), None)
        folder = top or file.parent
        path = PurePosixPath(file.relative_to(folder).as_posix())
        if not holds_class(path):
            continue
        parts = [*([top.name] if top else []), *path.with_suffix("").parts]
        first, *others = parts[:-1] if top and path.name == _PACKAGE else parts
        name = ".".join((first.partition(" ")[0], *others))  # a version may follow the name of a library
        _, said = _read(PackageFiles(name, folder, {str(path): files[file]}), str(path), name)
        ignored = ("repeated", "wrong-within") if _misnamed_part(path) else ("repeated",)
        found += [one for one in said if one.code not in ignored]
    return found


def _misnamed_part(path: PurePosixPath) -> PurePosixPath | None:
    """The outermost folder around a file, or the file itself, whose name no class can have."""
    parts = [*reversed(path.parents[:-1]), *([] if path.name == _PACKAGE else [path])]
    names = [(part, part.stem if part is path else part.name) for part in parts]
    return next((part for part, name in names if not (is_identifier(name) or _QUOTED_NAME.fullmatch(name))), None)


def _check_folder(package: PackageFiles, folder: PurePosixPath, there: _Folder) -> list[Diagnostic]:
    found: list[Diagnostic] = []

    def say(severity: Severity, code: str, message: str, name: str = "", line: int = 0, hint: str = "") -> None:
        path = (folder / name).as_posix()
        found.append(package.diagnostic(severity, code, message, "" if path == "." else path, line, hint=hint))

    if _PACKAGE not in there.files:
        other = next((name for name in there.files if name.lower() == _PACKAGE), "")
        hint = f"rename `{other}`" if other else "add one, or move the files elsewhere"
        say(_ERROR, "no-package-file", f"the folder holds classes, but no {_PACKAGE}", hint=hint)
    full_name = ".".join((package.name, *folder.parts))
    stored: set[str] = set()  # classes that are whole files
    inside: dict[str, int] = {}  # classes and constants in package.mo, with their lines
    readable = _PACKAGE in there.files
    for file in sorted(there.files):
        whole = file == _PACKAGE
        name = full_name if whole else f"{full_name}.{file.removesuffix(_SUFFIX)}"
        text, said = _read(package, (folder / file).as_posix(), name)
        found += said
        broken = any(one.code in ("not-utf8", "syntax") and one.severity is _ERROR for one in said)
        expected, place = name.rpartition(".")[2], "folder" if whole else "file"
        main = next((one for one in text.classes if str(one.name) == expected), next(iter(text.classes), None))
        if main and str(main.name) != expected:
            message = f"the class is called `{main.name}`, but its {place} `{expected}`"
            say(_ERROR, "wrong-name", message, file, main.name.line, f"give class and {place} the same name")
        for other_class in () if broken else text.classes:
            if main and other_class is not main:
                message, hint = (
                    f"the file holds `{other_class.name}` besides `{main.name}`",
                    "a file in a package holds",
                )
                hint += " one class: give it one of its own"
                say(_ERROR, "second-class", message, file, other_class.name.line, hint)
        if whole:
            readable &= not broken
            inside = {one.path[1]: one.line for one in reversed([*declared(text.classes)]) if len(one.path) == 2}
        else:
            stored |= {one.name.parts[0] for one in text.classes}
    for name in sorted(there.misnamed):
        is_file = (folder / name).as_posix() in package.texts
        stem, kind, noun = (name.removesuffix(_SUFFIX), "class", "file") if is_file else (name, "package", "folder")
        hint = f"rename the {noun}, or move it elsewhere"
        say(_ERROR, "wrong-name", f"`{stem}` can't be the name of a {kind}", name, hint=hint)
    stems = {file.removesuffix(_SUFFIX) for file in there.files - {_PACKAGE}}
    for name in sorted(stems & there.folders):
        message = f"`{name}` is both a file and a folder"
        say(_ERROR, "class-twice", message, f"{name}{_SUFFIX}", hint="keep one of them")
    for name in sorted(inside.keys() & (stems | there.folders)):
        message = f"`{name}` is declared here, and is a {'file' if name in stems else 'folder'} as well"
        say(_ERROR, "class-twice", message, _PACKAGE, inside[name], "keep one of them")
    spellings: dict[str, str] = {}
    for name in sorted(stems | there.folders):
        first = spellings.setdefault(name.casefold(), name)
        if first != name:
            message = f"`{name}` and `{first}` differ only by case"
            hint = "rename one: file systems that ignore case do not hold both"
            say(_WARNING, "same-but-for-case", message, f"{name}{_SUFFIX}" if name in stems else name, hint=hint)
    order = (folder / _ORDER).as_posix()
    if order in package.texts:
        present = stems | there.folders | inside.keys()
        known = {*stored, *there.misnamed, *(name.removesuffix(_SUFFIX) for name in there.misnamed)}
        found += _check_order(package, order, present, known if readable else None)
    return found


def _read(package: PackageFiles, path: str, name: str) -> tuple[StoredText, list[Diagnostic]]:
    """What a file declares, and what is wrong with its text; `name` is the full name that its class should have."""
    content, said = package.texts[path], list[Diagnostic]()

    def say(severity: Severity, code: str, message: str, line: int = 0, hint: str = "") -> None:
        said.append(package.diagnostic(severity, code, message, path, line, hint=hint))

    if line := _first_undecodable_line(content):
        say(_ERROR, "not-utf8", "the file is not in UTF-8", line, "save it as UTF-8")
        return StoredText(), said
    text = normalised(content).decode()
    if text.startswith(_BYTE_ORDER_MARK):
        message, hint = "the file begins with a byte order mark", "save it without: some compilers refuse it"
        say(_WARNING, "byte-order-mark", message, 1, hint)
    found = parse(text)
    breaking = [fault for fault in found.faults if not fault.reason.endswith(" twice")]
    if breaking:  # only the first place, since others may follow from it
        reason, line = next(iter(find_markers(text)), None) or min(breaking, key=lambda fault: fault.line)
        more = len(found.faults) - 1
        places = f"{more} more place{'s' if more > 1 else ''}"
        hint = f"correct it first: {places} in the file may look wrong because of it" if more else ""
        say(_ERROR, "syntax", f"the file {reason}", line, hint)
    for fault in () if breaking else found.faults:
        kind = (_WARNING, "repeated") if fault.reason.startswith(_ALLOWED_TWICE) else (_ERROR, "syntax")
        say(*kind, f"the file {fault.reason}", fault.line)
    parent = name.rpartition(".")[0]
    if not found.classes and not found.faults:
        hint = f"write the class `{name.rpartition('.')[2]}`, or delete the file"
        say(_ERROR, "no-class", "the file holds no class", hint=hint)
    elif found.classes and (found.within or "") != parent:
        message, hint = f"the file lacks `{within(name)}`", "put it into the first line"
        if found.within is not None:
            stated = f"within {found.within};" if found.within else "within;"
            message = f"the file says `{stated}`, but stands in `{parent or 'no package'}`"
            hint = f"write `{within(name)}`"
        say(_ERROR, "wrong-within", message, found.within_line or 1, hint)
    return found, said


def _check_order(package: PackageFiles, path: str, present: set[str], known: set[str] | None) -> list[Diagnostic]:
    """Whether a `package.order` names what is `present` in the folder, each once.

    It may name what is `known`, too; anything if that is None, since `package.mo` can't be read.
    """
    found: list[Diagnostic] = []

    def say(severity: Severity, code: str, message: str, line: int, hint: str) -> None:
        found.append(package.diagnostic(severity, code, message, path, line, hint=hint))

    if line := _first_undecodable_line(package.texts[path]):
        say(_ERROR, "not-utf8", "the file is not in UTF-8", line, "save it as UTF-8")
        return found
    names: defaultdict[str, list[int]] = defaultdict(list)
    text = normalised(package.texts[path]).decode().removeprefix(_BYTE_ORDER_MARK)
    for number, words in enumerate(text.split("\n"), start=1):
        if words.strip():
            names[words.strip()].append(number)
    for name, numbers in names.items():
        if known is not None and name not in present | known:
            near = nearest(name, sorted(present - names.keys()))
            message = f"`{name}` is named, but is no class and no constant of the package"
            hint = f"did you mean `{near}`?" if near else "take the line out, or bring the class back"
            say(_ERROR, "order-unknown", message, numbers[0], hint)
        for number in numbers[1:]:
            message = f"`{name}` is named twice, first in line {numbers[0]}"
            say(_WARNING, "order-twice", message, number, "take one of the lines out")
    folder = path.removesuffix(_ORDER)
    for name in sorted(present - names.keys()):
        generated = {f"{folder}{name}{_SUFFIX}", f"{folder}{name}/{_PACKAGE}"} & package.owners.keys()
        is_ours = generated and f"{folder}{_PACKAGE}" in package.owners
        hint = "`urdfsync build` adds it" if is_ours else "add it where it belongs: tools put it last, or warn"
        say(_WARNING, "order-lacks", f"`{name}` is not named", 0, hint)
    return sorted(found, key=lambda one: one.line)


def _first_undecodable_line(content: bytes) -> int:
    """The first line that is not UTF-8, from 1; 0 if there is none."""
    try:
        content.decode()
    except UnicodeDecodeError as error:
        return content.count(b"\n", 0, error.start) + 1
    return 0
