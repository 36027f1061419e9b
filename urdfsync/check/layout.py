"""Whether the files of a package are Modelica, and stand where the language wants them. No compiler is asked.

The rules are those of the language specification 3.6, section 13.4. All faults are found, not only the first one:
one file that does not parse makes a compiler give up the whole package, often without telling which one it is.
The syntax is read as it is after a merge; so people meet the same words.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath

import msgspec

from urdfsync.check.files import PackageFiles, holds_class
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.files import normalised
from urdfsync.modelica.lexer import Fault, find_markers
from urdfsync.modelica.names import is_identifier, within
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import Class, StoredText, declared
from urdfsync.spelling import nearest

_ORDER, _PACKAGE, _SUFFIX = "package.order", "package.mo", ".mo"
_QUOTED_NAME = re.compile("'[^'.]+'")
_ALLOWED_TWICE = ("has the equation", "connects", "extends")  # the language has nothing against these
_BYTE_ORDER_MARK = "\ufeff"
_ERROR, _WARNING = Severity.ERROR, Severity.WARNING


class _Folder(msgspec.Struct, frozen=True):
    """A folder that should be a package."""

    path: str
    """Below the package's folder; empty for that folder itself."""
    name: str
    """Full name of the package that it should be."""
    files: Sequence[str]
    """Names of its `.mo` files."""
    folders: Sequence[str]
    """Names of the folders in it that have `.mo` files somewhere."""
    misnamed: Sequence[str]
    """Files and folders in it whose names no class can have; they are not among the others."""

    def below(self, name: str) -> str:
        """The path of something in it."""
        return f"{self.path}/{name}" if self.path else name

    @property
    def stems(self) -> list[str]:
        """The classes that are files of their own, by their files' names."""
        return [file.removesuffix(_SUFFIX) for file in self.files if file != _PACKAGE]


def check_layout(package: PackageFiles) -> list[Diagnostic]:
    """All that is wrong with the files of a package: errors where a tool can't load it, warnings where it may.

    What is generated never gets one.
    """
    return [found for folder in _folders(package) for found in _check_folder(package, folder)]


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


def _folders(package: PackageFiles) -> list[_Folder]:
    """The folders that have files of Modelica, outer ones first."""
    files: defaultdict[PurePosixPath, set[str]] = defaultdict(set, {PurePosixPath(): set()})
    inner: defaultdict[PurePosixPath, set[str]] = defaultdict(set)
    misnamed: defaultdict[PurePosixPath, set[str]] = defaultdict(set)
    for path in filter(holds_class, map(PurePosixPath, package.texts)):
        culprit = _misnamed_part(path)
        (misnamed if culprit else files)[(culprit or path).parent].add((culprit or path).name)
        for folder in (culprit or path).parents[:-1]:
            inner[folder.parent].add(folder.name)
    return [
        _Folder(
            "/".join(folder.parts),
            ".".join((package.name, *folder.parts)),
            *(sorted(names[folder]) for names in (files, inner, misnamed)),
        )
        for folder in sorted({*files, *inner, *misnamed})
    ]


def _misnamed_part(path: PurePosixPath) -> PurePosixPath | None:
    """The outermost folder around a file, or the file itself, whose name no class can have."""
    folder = next((folder for folder in reversed(path.parents[:-1]) if not _is_name(folder.name)), None)
    return folder if folder or path.name == _PACKAGE or _is_name(path.stem) else path


def _is_name(name: str) -> bool:
    return is_identifier(name) or _QUOTED_NAME.fullmatch(name) is not None


def _check_folder(package: PackageFiles, folder: _Folder) -> Iterator[Diagnostic]:
    if _PACKAGE not in folder.files:
        other = next((name for name in folder.files if name.lower() == _PACKAGE), "")
        hint = f"rename `{other}`" if other else "add one, or move the files elsewhere"
        message = f"the folder holds classes, but no {_PACKAGE}"
        yield package.diagnostic(_ERROR, "no-package-file", message, folder.path, hint=hint)
    stored: set[str] = set()  # classes that are whole files
    inside: dict[str, int] = {}  # classes and constants in package.mo, with their lines
    readable = _PACKAGE in folder.files
    for file in folder.files:
        path, whole = folder.below(file), file == _PACKAGE
        name = folder.name if whole else f"{folder.name}.{file.removesuffix(_SUFFIX)}"
        found, said = _read(package, path, name)
        yield from said
        broken = any(one.code in ("not-utf8", "syntax") and one.severity is _ERROR for one in said)
        yield from _check_names(package, path, name, found.classes, others=not broken)
        if whole:
            readable &= not broken
            inside = {one.path[1]: one.line for one in reversed([*declared(found.classes)]) if len(one.path) == 2}
        else:
            stored |= {one.name.parts[0] for one in found.classes}
    yield from _check_duplicates(package, folder, inside)
    if folder.below(_ORDER) in package.texts:
        present = {*folder.stems, *folder.folders, *inside}
        yield from _check_order(package, folder, present, stored, readable)


def _read(package: PackageFiles, path: str, name: str) -> tuple[StoredText, list[Diagnostic]]:
    """What a file declares, and what is wrong with its text; `name` is the full name that its class should have."""
    content = package.texts[path]
    if line := _first_undecodable_line(content):
        return StoredText(), [_not_utf8(package, path, line)]
    text, said = normalised(content).decode(), []
    if text.startswith(_BYTE_ORDER_MARK):
        message, hint = "the file begins with a byte order mark", "save it without: some compilers refuse it"
        said.append(package.diagnostic(_WARNING, "byte-order-mark", message, path, 1, hint=hint))
    found = parse(text)
    said += _syntax_diagnostics(package, path, text, found.faults)
    if found.classes:
        said += _check_within(package, path, name, found)
    elif not found.faults:
        hint = f"write the class `{name.rpartition('.')[2]}`, or delete the file"
        said.append(package.diagnostic(_ERROR, "no-class", "the file holds no class", path, hint=hint))
    return found, said


def _first_undecodable_line(content: bytes) -> int:
    """The first line that is not UTF-8, from 1; 0 if there is none."""
    try:
        content.decode()
    except UnicodeDecodeError as error:
        return content.count(b"\n", 0, error.start) + 1
    return 0


def _not_utf8(package: PackageFiles, path: str, line: int) -> Diagnostic:
    return package.diagnostic(_ERROR, "not-utf8", "the file is not in UTF-8", path, line, hint="save it as UTF-8")


def _syntax_diagnostics(package: PackageFiles, path: str, text: str, faults: Sequence[Fault]) -> list[Diagnostic]:
    """The first place where the text is no Modelica; if there is none, all that stands in it twice."""
    breaking = [fault for fault in faults if not fault.reason.endswith(" twice")]
    if breaking:
        reason, line = next(iter(find_markers(text)), None) or min(breaking, key=lambda fault: fault.line)
        more = len(faults) - 1
        places = f"{more} more place{'s' if more > 1 else ''}"
        hint = f"correct it first: {places} in the file may look wrong because of it" if more else ""
        return [package.diagnostic(_ERROR, "syntax", f"the file {reason}", path, line, hint=hint)]
    kinds = [(_WARNING, "repeated") if one.reason.startswith(_ALLOWED_TWICE) else (_ERROR, "syntax") for one in faults]
    return [
        package.diagnostic(*kind, f"the file {fault.reason}", path, fault.line)
        for kind, fault in zip(kinds, faults, strict=True)
    ]


def _check_within(package: PackageFiles, path: str, name: str, found: StoredText) -> Iterator[Diagnostic]:
    """Whether a file says in which package it stands; `name` is the full name of its class."""
    parent = name.rpartition(".")[0]
    if (found.within or "") == parent:
        return
    if found.within is None:
        message, hint = f"the file lacks `{within(name)}`", "put it into the first line"
    else:
        stated = f"within {found.within};" if found.within else "within;"
        message, hint = f"the file says `{stated}`, but stands in `{parent or 'no package'}`", f"write `{within(name)}`"
    yield package.diagnostic(_ERROR, "wrong-within", message, path, found.within_line or 1, hint=hint)


def _check_names(
    package: PackageFiles, path: str, name: str, classes: Sequence[Class], *, others: bool
) -> Iterator[Diagnostic]:
    """Whether a file holds the class that its name says and, if `others` count, no other one."""
    expected = name.rpartition(".")[2]
    if not classes:
        return
    main = next((one for one in classes if str(one.name) == expected), classes[0])
    if str(main.name) != expected:
        place = "folder" if path.endswith(_PACKAGE) else "file"
        message = f"the class is called `{main.name}`, but its {place} `{expected}`"
        hint = f"give class and {place} the same name"
        yield package.diagnostic(_ERROR, "wrong-name", message, path, main.name.line, hint=hint)
    for other in classes if others else ():
        if other is not main:
            message = f"the file holds `{other.name}` besides `{main.name}`"
            hint = "a file in a package holds one class: give it one of its own"
            yield package.diagnostic(_ERROR, "second-class", message, path, other.name.line, hint=hint)


def _check_duplicates(package: PackageFiles, folder: _Folder, inside: Mapping[str, int]) -> Iterator[Diagnostic]:
    """Names that no class can have, classes that are there in two ways, and names that differ only by case."""
    for name in folder.misnamed:
        path = folder.below(name)
        is_file = path in package.texts
        stem, kind, noun = (name.removesuffix(_SUFFIX), "class", "file") if is_file else (name, "package", "folder")
        message, hint = f"`{stem}` can't be the name of a {kind}", f"rename the {noun}, or move it elsewhere"
        yield package.diagnostic(_ERROR, "wrong-name", message, path, hint=hint)
    hint = "keep one of them"
    for name in sorted(set(folder.stems) & set(folder.folders)):
        message, path = f"`{name}` is both a file and a folder", folder.below(f"{name}{_SUFFIX}")
        yield package.diagnostic(_ERROR, "class-twice", message, path, hint=hint)
    for name in sorted(inside.keys() & {*folder.stems, *folder.folders}):
        message = f"`{name}` is declared here, and is a {'file' if name in folder.stems else 'folder'} as well"
        yield package.diagnostic(_ERROR, "class-twice", message, folder.below(_PACKAGE), inside[name], hint=hint)
    spellings: defaultdict[str, list[str]] = defaultdict(list)
    for name in sorted({*folder.stems, *folder.folders}):
        spellings[name.casefold()].append(name)
    for first, *others in spellings.values():
        for other in others:
            message = f"`{other}` and `{first}` differ only by case"
            hint = "rename one: file systems that ignore case do not hold both"
            path = folder.below(f"{other}{_SUFFIX}" if other in folder.stems else other)
            yield package.diagnostic(_WARNING, "same-but-for-case", message, path, hint=hint)


def _check_order(
    package: PackageFiles, folder: _Folder, present: set[str], stored: set[str], readable: bool
) -> list[Diagnostic]:
    """Whether `package.order` names what is `present` in the folder, each once.

    Names of `stored` classes with a wrong file name count as known; if `package.mo` is not `readable`, any name does.
    """
    path = folder.below(_ORDER)
    if line := _first_undecodable_line(package.texts[path]):
        return [_not_utf8(package, path, line)]
    found = []
    lines = _lines_by_name(normalised(package.texts[path]).decode())
    misnamed = {*folder.misnamed, *(name.removesuffix(_SUFFIX) for name in folder.misnamed)}
    for name, numbers in lines.items():
        if readable and name not in present | stored | misnamed:
            near = nearest(name, sorted(present - lines.keys()))
            message = f"`{name}` is named, but is no class and no constant of the package"
            hint = f"did you mean `{near}`?" if near else "take the line out, or bring the class back"
            found.append(package.diagnostic(_ERROR, "order-unknown", message, path, numbers[0], hint=hint))
        for number in numbers[1:]:
            message, hint = f"`{name}` is named twice, first in line {numbers[0]}", "take one of the lines out"
            found.append(package.diagnostic(_WARNING, "order-twice", message, path, number, hint=hint))
    for name in sorted(present - lines.keys()):
        generated = {folder.below(f"{name}{_SUFFIX}"), folder.below(f"{name}/{_PACKAGE}")} & package.owners.keys()
        hint = "add it where it belongs: tools put it last, or warn"
        if generated and folder.below(_PACKAGE) in package.owners:
            hint = "`urdfsync build` adds it"
        found.append(package.diagnostic(_WARNING, "order-lacks", f"`{name}` is not named", path, hint=hint))
    return sorted(found, key=lambda one: one.line)


def _lines_by_name(text: str) -> Mapping[str, Sequence[int]]:
    """The names in a `package.order`, with the lines in which they stand."""
    names: defaultdict[str, list[int]] = defaultdict(list)
    for number, line in enumerate(text.removeprefix(_BYTE_ORDER_MARK).split("\n"), start=1):
        if line.strip():
            names[line.strip()].append(number)
    return names
