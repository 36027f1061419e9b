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
    layout = _Layout(package)
    for folder in sorted(folders):
        layout.check_folder(folder, folders[folder])
    return layout.found


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
        if holds_class(path):
            parts = [*([top.name] if top else []), *path.with_suffix("").parts]
            first, *others = parts[:-1] if top and path.name == _PACKAGE else parts
            name = ".".join((first.partition(" ")[0], *others))  # a version may follow the name of a library
            layout = _Layout(PackageFiles(name, folder, {str(path): files[file]}))
            layout.check_file(str(path), name)
            ignored = {"repeated", "wrong-name", "second-class", *(["wrong-within"] if _misnamed_part(path) else [])}
            found += [one for one in layout.found if one.code not in ignored]
    return found


def _misnamed_part(path: PurePosixPath) -> PurePosixPath | None:
    """The outermost folder around a file, or the file itself, whose name no class can have."""
    parts = [*reversed(path.parents[:-1]), *([] if path.name == _PACKAGE else [path])]
    names = [(part, part.stem if part is path else part.name) for part in parts]
    return next((part for part, name in names if not (is_identifier(name) or _QUOTED_NAME.fullmatch(name))), None)


class _Layout:
    """Collects what is wrong with the files of a package; paths are below it."""

    def __init__(self, package: PackageFiles) -> None:
        self._package = package
        self.found: list[Diagnostic] = []

    def _say(
        self, severity: Severity, code: str, message: str, path: str | PurePosixPath, hint: str, line: int = 0
    ) -> None:
        place = str(path).removeprefix(".")
        self.found.append(self._package.diagnostic(severity, code, message, place, line, hint=hint))

    def check_folder(self, folder: PurePosixPath, there: _Folder) -> None:
        """Check the files in one folder, and what is in it against each other and its `package.order`."""
        if _PACKAGE not in there.files:
            other = next((name for name in there.files if name.lower() == _PACKAGE), "")
            hint = f"rename `{other}`" if other else "add one, or move the files elsewhere"
            self._say(_ERROR, "no-package-file", f"the folder holds classes, but no {_PACKAGE}", folder, hint)
        name = ".".join((self._package.name, *folder.parts))
        texts = {
            file: self.check_file(str(folder / file), name if file == _PACKAGE else f"{name}.{_stem(file)}")
            for file in sorted(there.files)
        }
        package = texts.pop(_PACKAGE, None)
        inside = [*declared(package.classes)] if package else []
        lines = {one.path[1]: one.line for one in reversed(inside) if len(one.path) == 2}
        for file in sorted(there.misnamed):
            is_file = str(folder / file) in self._package.texts
            stem, kind, noun = (_stem(file), "class", "file") if is_file else (file, "package", "folder")
            message, hint = f"`{stem}` can't be the name of a {kind}", f"rename the {noun}, or move it elsewhere"
            self._say(_ERROR, "wrong-name", message, folder / file, hint)
        stems = set(map(_stem, texts))
        for stem in sorted(stems & there.folders):
            message = f"`{stem}` is both a file and a folder"
            self._say(_ERROR, "class-twice", message, folder / f"{stem}{_SUFFIX}", "keep one of them")
        stored = stems | there.folders
        for stem in sorted(lines.keys() & stored):
            message = f"`{stem}` is declared here, and is a {'file' if stem in stems else 'folder'} as well"
            self._say(_ERROR, "class-twice", message, folder / _PACKAGE, "keep one of them", lines[stem])
        spellings: dict[str, str] = {}
        for stem in sorted(stored):
            first = spellings.setdefault(stem.casefold(), stem)
            if first != stem:
                message = f"`{stem}` and `{first}` differ only by case"
                hint = "rename one: file systems that ignore case do not hold both"
                file = f"{stem}{_SUFFIX}" if stem in stems else stem
                self._say(_WARNING, "same-but-for-case", message, folder / file, hint)
        if str(folder / _ORDER) in self._package.texts:
            classes = {str(one.name) for text in texts.values() if text for one in text.classes}
            tolerated = classes | there.misnamed | set(map(_stem, there.misnamed))
            self._check_order(folder, stored | lines.keys(), tolerated if package else None)

    def check_file(self, path: str, name: str) -> StoredText | None:
        """Check one file; returns what it declares, None if it can't be read. `name` is the full name of its class."""
        text = self._decode(path)
        if text is None:
            return None
        if text.startswith(_BYTE_ORDER_MARK):
            hint = "save it without: some compilers refuse it"
            self._say(_WARNING, "byte-order-mark", "the file begins with a byte order mark", path, hint, 1)
        found = parse(text)
        if found.is_broken:  # only the first place is told, since others may follow from it
            breaking = [fault for fault in found.faults if not fault.is_repetition]
            reason, line, _ = next(iter(find_markers(text)), min(breaking, key=lambda fault: fault.line))
            more = len(found.faults) - 1
            places = f"{more} more place{'s' if more > 1 else ''}"
            hint = f"correct it first: {places} in the file may look wrong because of it" if more else ""
            self._say(_ERROR, "syntax", f"the file {reason}", path, hint, line)
            return None
        for reason, line, _ in found.faults:
            severity, code = (_WARNING, "repeated") if reason.startswith(_ALLOWED_TWICE) else (_ERROR, "syntax")
            self._say(severity, code, f"the file {reason}", path, "", line)
        parent, _, expected = name.rpartition(".")
        if not found.classes:
            self._say(
                _ERROR, "no-class", "the file holds no class", path, f"write the class `{expected}`, or delete the file"
            )
            return found
        if (found.within or "") != parent:
            message, hint = f"the file lacks `{within(name)}`", "put it into the first line"
            if found.within is not None:
                stated = f"within {found.within};" if found.within else "within;"
                message = f"the file says `{stated}`, but stands in `{parent or 'no package'}`"
                hint = f"write `{within(name)}`"
            self._say(_ERROR, "wrong-within", message, path, hint, found.within_line or 1)
        main = next((one for one in found.classes if str(one.name) == expected), found.classes[0])
        if str(main.name) != expected:
            place = "folder" if PurePosixPath(path).name == _PACKAGE else "file"
            message = f"the class is called `{main.name}`, but its {place} `{expected}`"
            self._say(_ERROR, "wrong-name", message, path, f"give class and {place} the same name", main.name.line)
        for other in found.classes:
            if other is not main:
                message = f"the file holds `{other.name}` besides `{main.name}`"
                hint = "a file in a package holds one class: give it one of its own"
                self._say(_ERROR, "second-class", message, path, hint, other.name.line)
        return found

    def _check_order(self, folder: PurePosixPath, present: set[str], tolerated: set[str] | None) -> None:
        """Check whether a `package.order` names what is `present` in the folder, each once.

        It may name what is `tolerated`, too; anything if that is None, since `package.mo` can't be read.
        """
        path = str(folder / _ORDER)
        text = self._decode(path)
        if text is None:
            return
        names = [line.strip() for line in text.removeprefix(_BYTE_ORDER_MARK).split("\n")]
        for name in sorted(present.difference(names)):
            generated = {str(folder / f"{name}{_SUFFIX}"), str(folder / name / _PACKAGE)} & self._package.owners.keys()
            is_ours = generated and str(folder / _PACKAGE) in self._package.owners
            hint = "`urdfsync build` adds it" if is_ours else "add it where it belongs: tools put it last, or warn"
            self._say(_WARNING, "order-lacks", f"`{name}` is not named", path, hint)
        lines: dict[str, int] = {}
        for number, name in enumerate(names, start=1):
            first = lines.setdefault(name, number)
            if name and first != number:
                message, hint = f"`{name}` is named twice, first in line {first}", "take one of the lines out"
                self._say(_WARNING, "order-twice", message, path, hint, number)
            elif name and tolerated is not None and name not in present | tolerated:
                near = nearest(name, sorted(present.difference(names)))
                message = f"`{name}` is named, but is no class and no constant of the package"
                hint = f"did you mean `{near}`?" if near else "take the line out, or bring the class back"
                self._say(_ERROR, "order-unknown", message, path, hint, number)

    def _decode(self, path: str) -> str | None:
        """The text of a file; None, with a finding, if it is not UTF-8."""
        try:
            return normalised(self._package.texts[path]).decode()
        except UnicodeDecodeError as error:
            line = error.object.count(b"\n", 0, error.start) + 1
            self._say(_ERROR, "not-utf8", "the file is not in UTF-8", path, "save it as UTF-8", line)
            return None


def _stem(file: str) -> str:
    return file.removesuffix(_SUFFIX)
