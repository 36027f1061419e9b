"""What a compiler says of a model that does not compile, as diagnostics with file, line and element.

rumoca says everything in one text: complaints in lines or after semicolons, some with a place in brackets, some drawn
with a frame around the source. OpenModelica puts the place first. Both see a copy of the package; of names that are
not there rumoca does not say where they stand, so they are looked for in the package's own files.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.check.files import PackageFiles
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, Severity

_MOST_DIAGNOSTICS = 5
_LONGEST_MESSAGE = 300
_NAMED_FILES = 3

_SHADOW = "variability violation: "
"""What rumoca 0.10.2 says of sound models of the Modelica Standard Library as soon as something else is wrong."""

_COLOURS = re.compile(r"\x1b\[[0-9;]*m")
_BALANCE = re.compile(r"([\d,]+) equations?(?:\(s\))?(?:,| and| for) ([\d,]+) (?:unknown|variable)")
_UNPARSED = re.compile(r"Failed to load source root '([^']*)': parse source-root files")
_LAYOUT = re.compile(r"invalid Modelica package layout under '[^']*': (.*)", re.DOTALL)
_LAYOUT_FILE = re.compile(r"\b(file|directory) '([^']*)'")
_FRAMED = re.compile(r"×(?P<words>[^╭]*?)\n\s*╭─+\[(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+)\]")
_OPENMODELICA = re.compile(
    r"^(?:\[(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+)-\d+:\d+:\w+\] )?(?P<level>Error|Warning|Notification): ",
    re.MULTILINE,
)
_PIECES = re.compile(r"\n|; (?=\S)")
_PREFIXES = re.compile(
    r"^(?:- <[^>]*> \[\w+\]: |\w+ failed: |[\w.]+ failed in \w+: |[\w.]+ could not be compiled: |Failed to [^:]*: )+"
)
_PLACE = re.compile(r" \[(?P<file>[^\[\]]*):(?P<line>\d+):(?P<column>\d+)\]$")
_REFERENCE = re.compile(
    r"unresolved (?P<kind>component reference|function call|type reference|import|extends base class): '(?P<name>.+)'$"
)
_NO_BASE = re.compile(r"base class not found: `(?P<name>[^`]+)` does not exist$")
_NOISE = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


class Complaint(msgspec.Struct, frozen=True):
    """One thing that a compiler does not like."""

    message: str
    code: str = "does-not-compile"
    file: str = ""
    """As the compiler names it; empty if it does not."""
    line: int = 0
    column: int = 0
    missing: str = ""
    """A name that it can't find."""
    kind: str = ""
    """Of that name: component, function or class."""


def explain(
    text: str, package: PackageFiles, folders: Mapping[Path, Path], said: Sequence[Diagnostic] = (), model: str = ""
) -> list[Diagnostic]:
    """Diagnostics for a compiler's text about `model`, a name below the package; at least one, unless it was `said`.

    `folders` are those that the compiler reads, and those that people know instead.
    """
    text = _COLOURS.sub("", text).strip()
    if (balance := _BALANCE.search(text)) and balance[1] != balance[2]:
        equations, unknowns = (int(number) for number in balance.groups())
        return _unbalanced(equations, unknowns, package, said, model)
    complaints = list(dict.fromkeys(_complaints(text)))
    missing = {one.missing: one.kind for one in complaints if one.kind == "component"}
    classes = {one.missing: one.kind for one in complaints if one.kind == "class"}
    classes |= {one.missing: one.kind for one in complaints if one.kind == "function"}
    if missing or classes:  # if a class is missing, all components of that class are, too
        found = [_missing_name(name, kind, package) for name, kind in (classes or missing).items()]
    else:
        found = [_placed(one, package, folders) for one in _weighty(complaints, package, folders)]
    return _limited(list(dict.fromkeys(found)))


def _complaints(text: str) -> Iterator[Complaint]:
    """What a compiler complains about, in its order; never nothing, unless the text is empty."""
    if unparsed := _UNPARSED.search(text):
        message = "the compiler can't read one of the files, and does not say which"
        yield Complaint(message, "syntax", unparsed[1])
        return
    if layout := _LAYOUT.search(text):
        for rule in re.split(r";\s+(?=PKG-\d+)", layout[1]):
            file = _LAYOUT_FILE.search(rule)
            rule = _LAYOUT_FILE.sub(r"the \1", re.sub(r"PKG-\d+ ", "", rule, count=1), count=1)
            yield Complaint(_one_line(rule), "layout", file[2] if file else "")
        return
    placed = [*_framed(text), *_of_openmodelica(text)] or list(_pieces(text))
    yield from placed or ([Complaint(_one_line(text))] if text else [])


def _framed(text: str) -> Iterator[Complaint]:
    for found in _FRAMED.finditer(text):
        message = _one_line(found["words"].replace("│", " "))
        yield Complaint(message, file=found["file"], line=int(found["line"]), column=int(found["column"]))


def _of_openmodelica(text: str) -> Iterator[Complaint]:
    """Errors of OpenModelica; each goes on to the beginning of the next message."""
    found = list(_OPENMODELICA.finditer(text))
    ends = [*(following.start() for following in found[1:]), len(text)]
    for message, end in zip(found, ends, strict=bool(found)):
        if message["level"] == "Error":
            line, column = int(message["line"] or 0), int(message["column"] or 0)
            words = _one_line(text[message.end() : end])
            yield Complaint(words, file=message["file"] or "", line=line, column=column)


def _pieces(text: str) -> Iterator[Complaint]:
    for piece in _PIECES.split(text):
        words = _PREFIXES.sub("", piece.strip())
        if not words or words[-1] == ":":  # a heading
            continue
        place = _PLACE.search(words)
        words = words[: place.start()] if place else words
        if named := _REFERENCE.match(words) or _NO_BASE.match(words):
            kind = {"component reference": "component", "function call": "function"}.get(
                named.groupdict().get("kind") or "", "class"
            )
            yield Complaint(_one_line(words), missing=named["name"], kind=kind)
        elif place:
            yield Complaint(_one_line(words), file=place["file"], line=int(place["line"]), column=int(place["column"]))
        else:
            yield Complaint(_one_line(words))


def _one_line(text: str) -> str:
    return " ".join(text.split())


def _limited(found: list[Diagnostic]) -> list[Diagnostic]:
    """The first few; the last of them says how many there are beyond."""
    more = len(found) - _MOST_DIAGNOSTICS
    if more <= 0:
        return found
    *few, last = found[:_MOST_DIAGNOSTICS]
    hint = "; ".join(filter(None, [last.hint, f"there {'is' if more == 1 else 'are'} {more} more"]))
    return [*few, msgspec.structs.replace(last, hint=hint)]


def _weighty(
    complaints: Sequence[Complaint], package: PackageFiles, folders: Mapping[Path, Path]
) -> Sequence[Complaint]:
    """Those about the package itself, if there are any; else all that are more than the shadow of another one."""
    real = [one for one in complaints if not one.message.startswith(_SHADOW)]
    own = [one for one in real if _path_in_package(one.file, package, folders) is not None]
    return own or real or complaints[:1]


def _placed(complaint: Complaint, package: PackageFiles, folders: Mapping[Path, Path]) -> Diagnostic:
    path = _path_in_package(complaint.file, package, folders)
    message = complaint.message
    for folder in sorted(folders, key=lambda folder: -len(folder.parts)):
        message = message.replace(str(folder), shown(folders[folder]))
    message = message if len(message) <= _LONGEST_MESSAGE else f"{message[: _LONGEST_MESSAGE - 1]}…"
    message, line, column = message.removesuffix("."), complaint.line, complaint.column
    if path is not None:
        hint = "the file was edited by hand" if path in package.edited else ""
        return package.diagnostic(Severity.ERROR, complaint.code, message, path, line, column, hint)
    if not Path(complaint.file).is_absolute():
        return _somewhere(complaint.code, message, package)
    file = shown(_known_file(Path(complaint.file), folders))
    return Diagnostic(Severity.ERROR, complaint.code, message, file, line, column, _look_at_edits(package))


def _known_file(file: Path, folders: Mapping[Path, Path]) -> Path:
    """Where people find what a compiler read as `file`."""
    for folder in sorted(folders, key=lambda folder: -len(folder.parts)):
        if file.is_relative_to(folder):
            return folders[folder] / file.relative_to(folder)
    return file


def _path_in_package(file: str, package: PackageFiles, folders: Mapping[Path, Path]) -> str | None:
    """The path below the package's folder of what a compiler read as `file`; None if it is not of the package."""
    known = _known_file(Path(file), folders)
    if not file or not known.is_relative_to(package.folder):
        return None
    path = known.relative_to(package.folder).as_posix()
    return "" if path == "." else path


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
    top = package.name.partition(".")[0]
    if name == top != package.name:  # only the package around can be at fault: the robot's own is generated
        file = (package.folder, *package.folder.parents)[package.name.count(".")] / "package.mo"
        message, hint = f"there is no package `{name}`", "the class in this file has to be called so, like its folder"
        return Diagnostic(Severity.ERROR, "unresolved", message, shown(file), hint=hint)
    message = f"`{name}` is not declared" if kind == "component" else f"there is no {kind} `{name}`"
    dot = r"\s*(?:\[[^\]]*\]\s*)?\.\s*"
    mention = re.compile(rf"(?<![\w.]){dot.join(map(re.escape, name.split('.')))}(?!\w)")
    paths = sorted(path for path in package.texts if path.endswith(".mo"))
    for path in sorted(paths, key=lambda path: path not in package.edited):
        code = _NOISE.sub(lambda noise: "\n" * noise[0].count("\n"), package.text(path))
        if found := mention.search(code):
            hint = "the file was edited by hand" if path in package.edited else ""
            line = code.count("\n", 0, found.start()) + 1
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
        return Diagnostic(Severity.ERROR, code, message, file, hint="look here first: the file was edited by hand")
    return Diagnostic(Severity.ERROR, code, message, shown(package.folder), hint=_look_at_edits(package))


def _look_at_edits(package: PackageFiles) -> str:
    files = [shown(package.folder / path) for path in sorted(package.edited)]
    if len(files) == 1:
        return f"look at {files[0]}, which was edited"
    more = f" and {len(files) - _NAMED_FILES} more" if len(files) > _NAMED_FILES else ""
    return f"look at what was edited: {', '.join(files[:_NAMED_FILES])}{more}" if files else ""
