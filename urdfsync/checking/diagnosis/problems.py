"""What a compiler says of a model that does not compile, as findings with file, line and element. Pure.

A compiler sees a copy of the package and complains about follow-ups before it comes to causes; of names that are not
there it does not even say where they stand. So the places are looked for in the package's own files.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath

import msgspec

from urdfsync.checking.diagnosis.complaints import UNRESOLVED, Complaint, Kind, complaints
from urdfsync.checking.diagnosis.mentions import Mention, Mentions
from urdfsync.checking.diagnosis.package import Package
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.spelling import nearest

_MOST = 5
"""So many complaints are passed on; more of them are counted."""
_LONGEST = 300
"""Characters of a compiler's words."""
_NAMED = 3
"""So many edited files are named."""

_SHADOW = "variability violation: "
"""What rumoca 0.10.2 says of sound models of the Modelica Standard Library as soon as something else is wrong."""

_UNBALANCED = "unbalanced"
_COMPILED = ("unresolved", "does-not-compile", _UNBALANCED)
"""Codes of what is wrong with classes in files that are in order."""
_BALANCE = re.compile(r"([\d,]+) equations? for ([\d,]+) unknowns?")

_WORDS = {
    Kind.CLASS: "there is no class `{}`",
    Kind.FUNCTION: "there is no function `{}`",
    Kind.COMPONENT: "`{}` is not declared",
}
_FIRST = (Kind.FUNCTION, Kind.CLASS, Kind.COMPONENT)
"""What is said of a name of which several things are said."""


class Case(msgspec.Struct, frozen=True):
    """A package as a compiler saw it."""

    package: Package
    folders: Mapping[Path, Path] = msgspec.field(default_factory=dict)
    """Folders that the compiler reads → the ones that people know instead; those inside of others count first."""
    said: Sequence[Diagnostic] = ()
    """What is known of the package already: a compiler's words for the same are left out."""
    model: str = ""
    """What was compiled: its name below the package."""


def explain(text: str, case: Case) -> tuple[Diagnostic, ...]:
    """Findings in the order of their weight for a compiler's text.

    There is at least one, unless all is said already.
    """
    found = complaints(text)
    kinds = {one.kind for one in found}
    if kinds & {Kind.UNPARSED, Kind.LAYOUT}:
        found = [] if _errors(case) else [one for one in found if not _is_known(one, case)]
    if kinds & UNRESOLVED:
        return _limited(list(_unresolved([one for one in found if one.kind in UNRESOLVED], case)))
    if Kind.BALANCE in kinds:
        return tuple(_unbalanced(found[0], case))
    return _limited([_placed(one, case) for one in _weighty(found, case)])


def _errors(case: Case) -> list[Diagnostic]:
    """What is known to be wrong with the package's own files."""
    return [one for one in _errors_below(case.package.folder, case) if one.code not in _COMPILED]


def _errors_below(place: Path, case: Case) -> list[Diagnostic]:
    """What is known to be wrong with a file, or with those in a folder."""
    shown = case.package.shown(place)
    return [
        one for one in case.said if one.severity is Severity.ERROR and one.file and Path(one.file).is_relative_to(shown)
    ]


def _is_known(complaint: Complaint, case: Case) -> bool:
    """Whether something is known to be wrong with a file that the compiler means, in the package or around it."""
    return bool(complaint.file) and bool(_errors_below(_known(Path(complaint.file), case), case))


def _limited(found: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    """The first few; the last of them says how many there are beyond."""
    found = list(dict.fromkeys(found))
    more = len(found) - _MOST
    if more <= 0:
        return tuple(found)
    hint = "; ".join(filter(None, [found[_MOST - 1].hint, f"there {'is' if more == 1 else 'are'} {more} more"]))
    return (*found[: _MOST - 1], msgspec.structs.replace(found[_MOST - 1], hint=hint))


# --- complaints in the compiler's words -------------------------------------------------------------------------------


def _weighty(found: Sequence[Complaint], case: Case) -> Sequence[Complaint]:
    """Those about the package itself, if there are any; else all that may be more than the shadow of another one."""
    own = [one for one in found if _below(one.file, case) is not None]
    real = [one for one in found if not one.words.startswith(_SHADOW)]
    return [one for one in own if one in real] or real or own or found[:1]


def _placed(complaint: Complaint, case: Case) -> Diagnostic:
    package = case.package
    code = {Kind.UNPARSED: "syntax", Kind.LAYOUT: "layout"}.get(complaint.kind, "does-not-compile")
    path = _below(complaint.file, case)
    words = _cut(_without_copies(complaint.words, case)).removesuffix(".")
    if complaint.kind is Kind.UNPARSED:
        words = "the compiler can't read one of the files, and does not say which"
    if path is not None:
        return package.finding(
            Severity.ERROR, code, words, path, complaint.line, complaint.column, _about_edit(path, package)
        )
    if not Path(complaint.file).is_absolute():
        return _somewhere(code, words, package)
    file = package.shown(_known(Path(complaint.file), case))
    return Diagnostic(Severity.ERROR, code, words, file, complaint.line, complaint.column, _look_at(package))


def _known(file: Path, case: Case) -> Path:
    """Where people find what a compiler read as `file`."""
    for folder in sorted(case.folders, key=lambda folder: -len(folder.parts)):
        if file.is_relative_to(folder):
            return case.folders[folder] / file.relative_to(folder)
    return file


def _below(file: str, case: Case) -> str | None:
    """The path below the package's folder of what a compiler read as `file`; None if it is not of the package."""
    known = _known(Path(file), case)
    if not file or not known.is_relative_to(case.package.folder):
        return None
    path = known.relative_to(case.package.folder).as_posix()
    return "" if path == "." else path


def _without_copies(words: str, case: Case) -> str:
    """A compiler's words with the folders that people know."""
    for folder in sorted(case.folders, key=lambda folder: -len(folder.parts)):
        words = words.replace(str(folder), case.package.shown(case.folders[folder]))
    return words


def _cut(words: str) -> str:
    return words if len(words) <= _LONGEST else f"{words[: _LONGEST - 1]}…"


def _about_edit(path: str, package: Package) -> str:
    return "the file was edited by hand" if path in package.edited else ""


def _look_at(package: Package) -> str:
    """Where to look first, if there are edits."""
    files = [package.shown(package.folder / path) for path in sorted(package.edited)]
    if len(files) == 1:
        return f"look at {files[0]}, which was edited"
    more = f" and {len(files) - _NAMED} more" if len(files) > _NAMED else ""
    return f"look at what was edited: {', '.join(files[:_NAMED])}{more}" if files else ""


def _unbalanced(complaint: Complaint, case: Case) -> Iterator[Diagnostic]:
    """Whether equations lack or abound, unless as many do in a model of which that is said already."""
    equations, unknowns = complaint.equations, complaint.unknowns
    if any(_surplus(one) == equations - unknowns for one in case.said):
        return
    balance = f"{_number(equations, 'equation')} for {_number(unknowns, 'unknown')}"
    message = f"`{case.model}` has {balance}" if case.model else f"there are {balance}"
    own = f"{case.model.replace('.', '/')}.mo"
    if own in case.package.texts and own not in case.package.owners:
        yield case.package.finding(Severity.ERROR, _UNBALANCED, message, own, hint=_look_at(case.package))
    else:
        yield _somewhere(_UNBALANCED, message, case.package)


def _surplus(said: Diagnostic) -> int | None:
    """How many equations there are too many as an error says, or, below 0, too few; None if it says nothing of it."""
    found = _BALANCE.search(said.message)
    if found is None or (said.severity, said.code) != (Severity.ERROR, _UNBALANCED):
        return None
    equations, unknowns = (int(number.replace(",", "")) for number in found.groups())
    return equations - unknowns


def _number(count: int, noun: str) -> str:
    return f"{count:,} {noun}{'' if count == 1 else 's'}"


def _somewhere(code: str, message: str, package: Package) -> Diagnostic:
    """Something of which the compiler does not say where it is: perhaps in the edited file, if there is one."""
    if len(package.edited) == 1:
        file = package.shown(package.folder / next(iter(package.edited)))
        return Diagnostic(Severity.ERROR, code, message, file, hint="look here first: the file was edited by hand")
    return Diagnostic(Severity.ERROR, code, message, package.shown(package.folder), hint=_look_at(package))


# --- names that are not there -----------------------------------------------------------------------------------------


def _unresolved(found: Sequence[Complaint], case: Case) -> Iterator[Diagnostic]:
    """What to say of names: classes first, and nothing of what follows from a class that is not there."""
    kinds: dict[str, Kind] = {}
    for one in found:
        kinds[one.reference] = min(kinds.get(one.reference, one.kind), one.kind, key=_FIRST.index)
    mentions = Mentions(case.package)
    classes = [name for name, kind in kinds.items() if kind is not Kind.COMPONENT]
    roots = {name for name in classes if kinds[name] is Kind.CLASS and _is_root(name, mentions)}
    for name in classes:
        if name in roots:
            if not _errors(case):
                yield _no_library(name, case.package)
        elif not _follows(name, roots, case):
            yield _no_class(name, kinds[name], mentions)
    if not roots:
        names = [name for name, kind in kinds.items() if kind is Kind.COMPONENT]
        yield from _components(names, classes, mentions)


def _is_root(name: str, mentions: Mentions) -> bool:
    """Whether a name is that of a top-level package; the one that the package is in is mentioned in `within`."""
    return "." not in name and (mentions.package.name.startswith(f"{name}.") or not mentions.exact(name))


def _follows(name: str, roots: Collection[str], case: Case) -> bool:
    """Whether a class is not there because its top-level package is not, or because there is a fault in its file."""
    head, _, rest = name.partition(".")
    if head in roots:
        return True
    faulty = {Path(one.file) for one in _errors(case)}
    last = rest.rpartition(".")[2] or head
    return any(
        last in (file.stem, file.name) or (file.name == "package.mo" and file.parent.name == last) for file in faulty
    )


def _no_library(name: str, package: Package) -> Diagnostic:
    if package.name.partition(".")[0] == name:
        message, hint = f"there is no package `{name}`", "the class in this file has to be called so, like its folder"
        return Diagnostic(Severity.ERROR, "unresolved", message, package.shown(package.top / "package.mo"), hint=hint)
    message, hint = f"there is no library `{name}`", "install it, or say where it is"
    return Diagnostic(Severity.ERROR, "unresolved", message, package.shown(package.folder), hint=hint)


def _no_class(name: str, kind: Kind, mentions: Mentions) -> Diagnostic:
    """A class or function that is not there, at the first place that mentions it."""
    package, message = mentions.package, _WORDS[kind].format(name)
    places = mentions.of(name)
    if places:
        hints = [_did_you_mean(name, mentions.alike(name)), _also_in(places), _about_edit(places[0].path, package)]
        return _at(places[0], message, hints, package)
    own = f"{package.name}."
    if name.startswith(own):
        path = name.removeprefix(own).replace(".", "/") + ".mo"
        return package.finding(Severity.ERROR, "unresolved", message, path, hint="it has to be declared there")
    return _elsewhere(message, package)


def _elsewhere(message: str, package: Package) -> Diagnostic:
    hint = "nothing in the package mentions it: a library does, or a file around the package"
    return Diagnostic(Severity.ERROR, "unresolved", message, package.shown(package.folder), hint=hint)


def _components(names: Sequence[str], classes: Collection[str], mentions: Mentions) -> Iterator[Diagnostic]:
    """Components that are not declared, one of each beginning in each file."""
    package = mentions.package
    explained = _explained(classes, mentions)
    first: dict[tuple[str, str], tuple[str, Mention]] = {}
    nowhere = []
    for name in names:
        head, places = name.partition(".")[0], mentions.of(name)
        if any(one.path in explained and explained[one.path].covers(head) for one in places):
            continue
        if places:
            first.setdefault((places[0].path, head), (name, places[0]))
        else:
            nowhere.append(name)
    for (path, head), (name, place) in first.items():
        near = "" if head in mentions.names_in(path) else _did_you_mean(head, mentions.names_in(path))
        yield _at(place, _WORDS[Kind.COMPONENT].format(name), [near, _about_edit(path, package)], package)
    if nowhere and not first and not classes:
        yield _elsewhere(_WORDS[Kind.COMPONENT].format(nowhere[0]), package)


class _Explained(msgspec.Struct):
    """Which names of a file can't be found because a class is not there."""

    components: set[str]
    """Those of that type."""
    declared: set[str] | None = None
    """All that the file declares, if it extends the class: then any other name may come from it."""

    def covers(self, head: str) -> bool:
        """Whether this is why a name with this beginning can't be found."""
        return head in self.components or (self.declared is not None and head not in self.declared)


def _explained(classes: Collection[str], mentions: Mentions) -> dict[str, _Explained]:
    """Per file, what follows from classes that are not there."""
    result: dict[str, _Explained] = {}
    for name in classes:
        for path in {one.path for one in mentions.of(name)}:
            here = result.setdefault(path, _Explained(set()))
            components = {one.path[-1] for one in mentions.declared[path] if one.type == name}
            here.components |= components
            if not components:
                here.declared = mentions.names_in(path)
    _spread(result, mentions)
    return result


def _spread(explained: dict[str, _Explained], mentions: Mentions) -> None:
    """Files of classes that lack something make components of these classes lack it, too."""
    waiting = list(explained)
    while waiting:
        name = PurePosixPath(waiting.pop()).stem
        for path, declared in mentions.declared.items():
            components = {one.path[-1] for one in declared if one.type.rpartition(".")[2] == name}
            if components and path not in explained:
                waiting.append(path)
            if components:
                explained.setdefault(path, _Explained(set())).components |= components


def _at(place: Mention, message: str, hints: Sequence[str], package: Package) -> Diagnostic:
    hint = "; ".join(filter(None, hints))
    return package.finding(Severity.ERROR, "unresolved", message, place.path, place.line, hint=hint)


def _did_you_mean(name: str, others: Collection[str]) -> str:
    near = nearest(name, sorted(others), 0.8)
    return f"did you mean `{near}`?" if near else ""


def _also_in(places: Sequence[Mention]) -> str:
    count = len({one.path for one in places}) - 1
    return f"it is also mentioned in {count} other file{'s' if count > 1 else ''}" if count else ""
