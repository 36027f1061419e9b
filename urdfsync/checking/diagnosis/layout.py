"""Whether the files of a package are Modelica, and stand where the language wants them. No compiler is asked.

The rules are those of the language specification 3.6, section 13.4. All faults are found, not only the first one:
one file that does not parse makes a compiler give up the whole package, often without telling which one it is.
The syntax is read as it is after a merge; so people meet the same words.
"""

from __future__ import annotations

import codecs
import re
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath

import msgspec

from urdfsync.checking.diagnosis.package import Package, holds_class
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.files import normalised
from urdfsync.modelica.lexer import Fault, find_markers
from urdfsync.modelica.names import is_identifier, within
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import Class, StoredText, declared
from urdfsync.spelling import nearest

ORDER = "package.order"
PACKAGE = "package.mo"
_SUFFIX = ".mo"
_QUOTED = re.compile("'[^'.]+'")

_TWICE = " twice"
_ALLOWED_TWICE = ("has the equation", "connects", "extends")
"""What may well stand twice in a class as far as the language goes."""

_BYTE_ORDER_MARK = "\ufeff"
_UNREADABLE = ("not-utf8", "syntax")
_REPEATED = "repeated"
_WITHIN = "wrong-within"
_NOTHING = StoredText()


class _Folder(msgspec.Struct, frozen=True):
    """A folder that should be a package."""

    path: str
    """Below the package's folder; empty for that folder itself."""
    name: str
    """Full name of the package that it should be."""
    files: tuple[str, ...]
    """Names of its `.mo` files."""
    folders: tuple[str, ...]
    """Names of the folders in it that have `.mo` files somewhere."""
    odd: tuple[str, ...]
    """Files and folders in it whose names no class can have; they are not among the others."""

    def below(self, name: str) -> str:
        """The path of something in it."""
        return f"{self.path}/{name}" if self.path else name

    @property
    def stems(self) -> tuple[str, ...]:
        """The classes that are files of their own, by their files' names."""
        return tuple(file.removesuffix(_SUFFIX) for file in self.files if file != PACKAGE)


class _Contents(msgspec.Struct):
    """What the files of a folder turned out to declare."""

    stored: set[str] = msgspec.field(default_factory=set)
    """Classes that are whole files."""
    inside: dict[str, int] = msgspec.field(default_factory=dict)
    """Classes and constants in `package.mo`, with their lines."""
    certain: bool = True
    """Whether `package.mo` could be read."""


def check(package: Package) -> tuple[Diagnostic, ...]:
    """All that is wrong with the files of a package: errors where a tool can't load it, warnings where it may.

    What is generated never gets one.
    """
    return tuple(found for folder in _folders(package) for found in _folder(package, folder))


def check_around(files: Mapping[Path, bytes], shown: Callable[[Path], str]) -> tuple[Diagnostic, ...]:
    """What keeps a compiler from reading files beside a package, and those of libraries: syntax, and `within`.

    `files` are by absolute path, and hold each `package.mo` around a file; `shown` is how people see a path. Other
    faults of theirs are left to those who make them.
    """
    return tuple(found for path in sorted(files) for found in _around(path, files, shown))


def _around(file: Path, files: Mapping[Path, bytes], shown: Callable[[Path], str]) -> list[Diagnostic]:
    top = next((folder for folder in reversed(file.parents) if folder / PACKAGE in files), None)
    folder = top or file.parent
    path = PurePosixPath(file.relative_to(folder).as_posix())
    if not holds_class(path):
        return []
    parts = [*([top.name] if top else []), *path.with_suffix("").parts]
    first, *others = parts[:-1] if top and path.name == PACKAGE else parts
    name = ".".join((first.partition(" ")[0], *others))  # a version may follow the name of a library
    _, said = _read(Package(name, folder, {str(path): files[file]}, shown), str(path), name)
    ignored = (_REPEATED, _WITHIN) if _odd(path) else (_REPEATED,)
    return [one for one in said if one.code not in ignored]


def _folders(package: Package) -> list[_Folder]:
    """The folders that have files of Modelica, outer ones first."""
    files: defaultdict[PurePosixPath, set[str]] = defaultdict(set)
    inner: defaultdict[PurePosixPath, set[str]] = defaultdict(set)
    odd: defaultdict[PurePosixPath, set[str]] = defaultdict(set)
    files[PurePosixPath()] = set()
    for path in filter(holds_class, map(PurePosixPath, package.texts)):
        culprit = _odd(path)
        (odd if culprit else files)[(culprit or path).parent].add((culprit or path).name)
        for folder in (culprit or path).parents[:-1]:
            inner[folder.parent].add(folder.name)
    return [
        _Folder(
            "/".join(folder.parts),
            ".".join((package.name, *folder.parts)),
            tuple(sorted(files[folder])),
            tuple(sorted(inner[folder])),
            tuple(sorted(odd[folder])),
        )
        for folder in sorted({*files, *inner, *odd})
    ]


def _odd(path: PurePosixPath) -> PurePosixPath | None:
    """The outermost folder around a file, or the file itself, whose name no class can have."""
    folder = next((folder for folder in reversed(path.parents[:-1]) if not _is_name(folder.name)), None)
    return folder if folder or path.name == PACKAGE or _is_name(path.stem) else path


def _is_name(name: str) -> bool:
    return is_identifier(name) or _QUOTED.fullmatch(name) is not None


def _folder(package: Package, folder: _Folder) -> Iterator[Diagnostic]:
    contents = _Contents(certain=PACKAGE in folder.files)
    if PACKAGE not in folder.files:
        other = next((name for name in folder.files if name.lower() == PACKAGE), "")
        hint = f"rename `{other}`" if other else "add one, or move the files elsewhere"
        message = f"the folder holds classes, but no {PACKAGE}"
        yield package.finding(Severity.ERROR, "no-package-file", message, folder.path, hint=hint)
    for file in folder.files:
        yield from _file(package, folder, file, contents)
    yield from _named_oddly(package, folder)
    yield from _twice(package, folder, contents)
    yield from _cases(package, folder)
    if folder.below(ORDER) in package.texts:
        yield from _order(package, folder, contents)


# --- files ------------------------------------------------------------------------------------------------------------


def _file(package: Package, folder: _Folder, file: str, contents: _Contents) -> Iterator[Diagnostic]:
    path = folder.below(file)
    whole = file == PACKAGE
    name = folder.name if whole else f"{folder.name}.{file.removesuffix(_SUFFIX)}"
    found, said = _read(package, path, name)
    yield from said
    sound = not any(one.code in _UNREADABLE and one.severity is Severity.ERROR for one in said)
    yield from _names(package, path, name, found.classes, sound)
    if whole:
        contents.certain &= sound
        contents.inside |= {one.path[1]: one.line for one in reversed([*declared(found.classes)]) if len(one.path) == 2}
    else:
        contents.stored |= {one.name.parts[0] for one in found.classes}


def _read(package: Package, path: str, name: str) -> tuple[StoredText, list[Diagnostic]]:
    """What a file declares, and what is wrong with its text; `name` is the full name that its class should have."""
    fault = undecoded(package.texts[path])
    if fault:
        message, hint = "the file is not in UTF-8", "save it as UTF-8"
        return _NOTHING, [package.finding(Severity.ERROR, "not-utf8", message, path, fault, hint=hint)]
    text = normalised(package.texts[path]).decode()
    said = []
    if text.startswith(_BYTE_ORDER_MARK):
        message, hint = "the file begins with a byte order mark", "save it without: some compilers refuse it"
        said.append(package.finding(Severity.WARNING, "byte-order-mark", message, path, 1, hint=hint))
    found = parse(text)
    said += _syntax(package, path, text, found.faults)
    if found.classes:
        return found, [*said, *_within(package, path, name, found)]
    if found.faults:
        return found, said
    hint = f"write the class `{name.rpartition('.')[2]}`, or delete the file"
    return found, [*said, package.finding(Severity.ERROR, "no-class", "the file holds no class", path, hint=hint)]


def undecoded(content: bytes) -> int:
    """The first line that is not UTF-8, from 1; 0 if there is none."""
    try:
        codecs.decode(content, "utf-8")
    except UnicodeDecodeError as error:
        return content.count(b"\n", 0, error.start) + 1
    return 0


def _syntax(package: Package, path: str, text: str, found: Sequence[Fault]) -> list[Diagnostic]:
    """The first place where the text is no Modelica, or all that stands in it twice."""
    faults = [fault for fault in found if not fault.reason.endswith(_TWICE)]
    if not faults:
        return [_repeated(package, path, fault) for fault in found]
    reason, line = next(iter(find_markers(text)), None) or min(faults, key=lambda fault: fault.line)
    more = len(found) - 1
    places = f"{more} more place{'s' if more > 1 else ''}"
    hint = f"correct it first: {places} in the file may look wrong because of it" if more else ""
    return [package.finding(Severity.ERROR, "syntax", f"the file {reason}", path, line, hint=hint)]


def _repeated(package: Package, path: str, fault: Fault) -> Diagnostic:
    if fault.reason.startswith(_ALLOWED_TWICE):
        return package.finding(Severity.WARNING, _REPEATED, f"the file {fault.reason}", path, fault.line)
    return package.finding(Severity.ERROR, "syntax", f"the file {fault.reason}", path, fault.line)


def _within(package: Package, path: str, name: str, found: StoredText) -> Iterator[Diagnostic]:
    """Whether a file says in which package it stands; `name` is the full name of its class."""
    parent = name.rpartition(".")[0]
    if (found.within or "") == parent:
        return
    line = found.within_line or 1
    if found.within is None:
        message, hint = f"the file lacks `{within(name)}`", "put it into the first line"
    else:
        stated = f"within {found.within};" if found.within else "within;"
        message, hint = f"the file says `{stated}`, but stands in `{parent or 'no package'}`", f"write `{within(name)}`"
    yield package.finding(Severity.ERROR, _WITHIN, message, path, line, hint=hint)


def _names(package: Package, path: str, name: str, stored: Sequence[Class], sound: bool) -> Iterator[Diagnostic]:
    """Whether a file holds the class that its name says, and no other one."""
    expected = name.rpartition(".")[2]
    if not stored:
        return
    main = next((one for one in stored if str(one.name) == expected), stored[0])
    if str(main.name) != expected:
        place = "folder" if path.endswith(PACKAGE) else "file"
        message = f"the class is called `{main.name}`, but its {place} `{expected}`"
        hint = f"give class and {place} the same name"
        yield package.finding(Severity.ERROR, "wrong-name", message, path, main.name.line, hint=hint)
    for other in stored if sound else ():
        if other is not main:
            message = f"the file holds `{other.name}` besides `{main.name}`"
            hint = "a file in a package holds one class: give it one of its own"
            yield package.finding(Severity.ERROR, "second-class", message, path, other.name.line, hint=hint)


# --- folders ----------------------------------------------------------------------------------------------------------


def _named_oddly(package: Package, folder: _Folder) -> Iterator[Diagnostic]:
    """Files and folders that can't hold the class that their name says; nothing else is said of them."""
    for name in folder.odd:
        path = folder.below(name)
        is_file = path in package.texts
        stem, kind, noun = (name.removesuffix(_SUFFIX), "class", "file") if is_file else (name, "package", "folder")
        message, hint = f"`{stem}` can't be the name of a {kind}", f"rename the {noun}, or move it elsewhere"
        yield package.finding(Severity.ERROR, "wrong-name", message, path, hint=hint)


def _twice(package: Package, folder: _Folder, contents: _Contents) -> Iterator[Diagnostic]:
    """Classes that are there in two ways."""
    hint = "keep one of them"
    for name in sorted(set(folder.stems) & set(folder.folders)):
        message = f"`{name}` is both a file and a folder"
        yield package.finding(Severity.ERROR, "class-twice", message, folder.below(f"{name}{_SUFFIX}"), hint=hint)
    for name in sorted(contents.inside.keys() & {*folder.stems, *folder.folders}):
        kind = "file" if name in folder.stems else "folder"
        message = f"`{name}` is declared here, and is a {kind} as well"
        yield package.finding(
            Severity.ERROR, "class-twice", message, folder.below(PACKAGE), contents.inside[name], hint=hint
        )


def _cases(package: Package, folder: _Folder) -> Iterator[Diagnostic]:
    """Files and folders that are the same one where the file system does not tell capital letters from small ones."""
    spellings: defaultdict[str, list[str]] = defaultdict(list)
    for name in sorted({*folder.stems, *folder.folders}):
        spellings[name.casefold()].append(name)
    for first, *others in spellings.values():
        for other in others:
            message = f"`{other}` and `{first}` differ only by case"
            hint = "rename one: file systems that ignore case do not hold both"
            path = folder.below(f"{other}{_SUFFIX}" if other in folder.stems else other)
            yield package.finding(Severity.WARNING, "same-but-for-case", message, path, hint=hint)


def _order(package: Package, folder: _Folder, contents: _Contents) -> Iterator[Diagnostic]:
    """Whether `package.order` names what is in the folder, each once."""
    path = folder.below(ORDER)
    fault = undecoded(package.texts[path])
    if fault:
        message, hint = "the file is not in UTF-8", "save it as UTF-8"
        yield package.finding(Severity.ERROR, "not-utf8", message, path, fault, hint=hint)
        return
    yield from sorted(_order_findings(package, folder, contents, path), key=lambda one: one.line)


def _order_findings(package: Package, folder: _Folder, contents: _Contents, path: str) -> Iterator[Diagnostic]:
    lines = _listed(normalised(package.texts[path]).decode())
    present = {*folder.stems, *folder.folders, *contents.inside}
    known = {*present, *contents.stored, *(name.removesuffix(_SUFFIX) for name in folder.odd), *folder.odd}
    for name, numbers in lines.items():
        if name not in known and contents.certain:
            yield _unknown(package, path, name, numbers[0], present - lines.keys())
        for number in numbers[1:]:
            message, hint = f"`{name}` is named twice, first in line {numbers[0]}", "take one of the lines out"
            yield package.finding(Severity.WARNING, "order-twice", message, path, number, hint=hint)
    for name in sorted(present - lines.keys()):
        hint = "add it where it belongs: tools put it last, or warn"
        if _is_generated(package, folder, name):
            hint = "`urdfsync build` adds it"
        yield package.finding(Severity.WARNING, "order-lacks", f"`{name}` is not named", path, hint=hint)


def _is_generated(package: Package, folder: _Folder, name: str) -> bool:
    """Whether a class is one that urdfsync makes, in a folder of which it keeps the order."""
    files = {folder.below(f"{name}{_SUFFIX}"), folder.below(f"{name}/{PACKAGE}")}
    return folder.below(PACKAGE) in package.owners and not files.isdisjoint(package.owners)


def _listed(text: str) -> Mapping[str, Sequence[int]]:
    """The names in a `package.order`, with the lines in which they stand."""
    names: defaultdict[str, list[int]] = defaultdict(list)
    for number, line in enumerate(text.removeprefix(_BYTE_ORDER_MARK).split("\n"), start=1):
        if line.strip():
            names[line.strip()].append(number)
    return names


def _unknown(package: Package, path: str, name: str, line: int, unnamed: set[str]) -> Diagnostic:
    message = f"`{name}` is named, but is no class and no constant of the package"
    near = nearest(name, sorted(unnamed))
    hint = f"did you mean `{near}`?" if near else "take the line out, or bring the class back"
    return package.finding(Severity.ERROR, "order-unknown", message, path, line, hint=hint)
