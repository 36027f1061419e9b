"""Finds unresolved names in the robot's package and in the user's files that use it, without a compiler."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from pathlib import Path, PurePosixPath
from typing import NamedTuple

import msgspec

from urdfsync.analysis.checks import libraries
from urdfsync.analysis.checks.package import RobotPackage
from urdfsync.analysis.checks.results import listed
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.files import shown
from urdfsync.modelica.classes import ClassNode
from urdfsync.modelica.files import ClassName, class_of_file, files_that_use, place_of, text_of
from urdfsync.modelica.layout import check_class_file
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.stored import StoredClasses, parse_file
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, unresolved


class NameCheck(NamedTuple):
    """The findings about names, each once in a file, at its first line."""

    package: list[Diagnostic]
    users: list[Diagnostic]
    """Findings in the user's files outside of the package."""
    users_files: Mapping[Path, bytes]
    """The user's files that name a class of the package, or of another file that uses the package."""
    uses: Mapping[Path, Set[Path]]
    """For each file that the user wrote or edited, the files whose classes it names."""


def check_names(package: RobotPackage, standard: Mapping[str, Path]) -> NameCheck:
    """Resolve all names; `standard` are the libraries of the Modelica Standard Library."""
    robot = package.robot
    find = libraries.class_finder(robot.target.package, standard, libraries.search_path(robot))
    around = {robot.output / path: text for path, text in package.around.items() if path.endswith(".mo")}
    others = {**around, **package.users_files}
    read = functools.cache(parse_file)  # parse each file once
    sources = StoredClasses(robot.target.package, robot.folder, package.files.texts, others, find, read)
    shared, uses = Scopes(sources), dict[Path, set[Path]]()

    def look(name: ClassName) -> list[tuple[Path, Unresolved]] | None:
        """Return the unresolved names in a class, None without this class; note in `uses` which files it needs."""
        sources.seen.clear()
        scopes = Scopes(sources)  # new scopes: used scopes remember resolved names
        if (node := scopes.node(name)) is None:
            return None
        faults, path = _unresolved([node], scopes), Path(node.file)
        # packages around a file do not count as used by the file
        around_it = {folder / "package.mo" for folder in path.parents}
        uses.setdefault(path, set()).update({Path(file) for file in sources.seen.values() if file} - around_it)
        return faults

    written = {robot.folder / path for path in package.changed} | package.own_files.keys()
    generated = [name for name, file in sorted(sources.own.items()) if Path(file) not in written]
    own = _unresolved(filter(None, map(shared.node, generated)), shared)
    for name in sorted(sources.own.keys() - {*generated}):
        own += look(name) or ()
    places: list[tuple[Path, Unresolved]] = []
    using, top = set[Path](), tuple(robot.target.package.split("."))
    unplaced = set(sources.unread)
    for name, definition in sources.users.items():
        if (path := Path(definition.file)) in package.users_files:
            if (faults := look(name)) is None:  # no package has that name
                unplaced.add(path)
                continue
            places += faults
            if any(other[: len(top)] == top and len(other) > len(top) for other in sources.seen):
                using.add(path)
    while more := {path for path, seen in uses.items() if path not in using and seen & using}:
        using |= more
    contents = {path: text for path, text in package.users_files.items() if path in unplaced}
    unplaced = files_that_use(contents, [robot.folder.name]).keys() - around.keys()
    users_files = {path: text for path, text in package.users_files.items() if path in using | unplaced}
    users = [finding for path in sorted(unplaced) for finding in _check_place(path, others)]
    users += _findings(package, [place for place in places if place[0] in using])
    return NameCheck(_findings(package, own), users, users_files, uses)


def _check_place(path: Path, files: Mapping[Path, bytes]) -> Iterator[Diagnostic]:
    """Yield warnings that tell why the names in a user's file can't be checked."""
    name = ".".join((*place_of(path, files)[1], class_of_file(path)))
    for finding in check_class_file(text_of(files[path]), PurePosixPath(path.name), name)[1]:
        if finding.severity is Severity.ERROR:
            yield msgspec.structs.replace(finding, severity=Severity.WARNING, file=shown(path))


def _unresolved(nodes: Iterable[ClassNode], scopes: Scopes) -> list[tuple[Path, Unresolved]]:
    return [(Path(node.file), fault) for node in nodes for fault in unresolved(node, scopes)]


def _findings(package: RobotPackage, places: Iterable[tuple[Path, Unresolved]]) -> list[Diagnostic]:
    """Return one finding for all places of a fault in a file."""
    alike: dict[tuple[Path, UnresolvedKind, str, str], list[Unresolved]] = {}
    for file, fault in places:
        alike.setdefault((file, fault.kind, fault.owner, fault.part), []).append(fault)
    findings = [_diagnostic(package, file, uses) for (file, *_), uses in alike.items()]
    return sorted(findings, key=lambda finding: (finding.file, finding.line))


def _diagnostic(package: RobotPackage, file: Path, places: Sequence[Unresolved]) -> Diagnostic:
    earliest, files = min(places, key=lambda place: place.line), package.files
    severity, code, hint = Severity.WARNING, earliest.kind.value, ""
    if earliest.kind is UnresolvedKind.NESTED_REDECLARE:
        message = f"the redeclaration of `{earliest.part}` inside of another modifier is not checked: rumoca ignores it"
        hint = f"write a model that says `extends {earliest.owner}(redeclare … {earliest.part})`, and use that instead"
    elif earliest.kind is UnresolvedKind.DOTTED_MODIFIER:
        message = f"the modifier of `{earliest.name}` is not checked: rumoca ignores names with dots in modifiers"
        first, *rest = earliest.name.split(".")
        hint = f"write `{first}({'('.join(rest)} = …{')' * len(rest)}`, which every tool follows"
    else:
        severity, code, message = Severity.ERROR, "unresolved", earliest.message
        hint = f"did you mean `{earliest.meant}`?" if earliest.meant else ""
        told = package.hints.get((shown(file), message), "").partition("; also in line")[0]
        hint = told or hint
    lines = sorted({place.line for place in places} - {earliest.line})
    also = f"also in line{'s' if len(lines) > 1 else ''} {listed([*map(str, lines)])}" if lines else ""
    path = file.relative_to(files.folder).as_posix() if file.is_relative_to(files.folder) else ""
    hint = "; ".join(filter(None, (hint, also, files.by_hand(path))))
    if path:
        return files.diagnostic(severity, code, message, path, earliest.line, hint=hint)
    return Diagnostic(severity, code, message, shown(file), earliest.line, hint=hint)
