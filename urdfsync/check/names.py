"""Names that mean nothing, in a package and in the user's files around it, as findings with file, line and element."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from urdfsync.check import libraries
from urdfsync.check.package import CheckedPackage
from urdfsync.check.results import listed
from urdfsync.config import library_folder, shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.modelica.files import ClassName, StoredClasses
from urdfsync.modelica.names import LIBRARY
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, unresolved


def check_names(package: CheckedPackage) -> tuple[list[Diagnostic], list[Diagnostic]]:
    """What is wrong with names in the package, and in the user's files outside of it.

    Each fault is told once in each file, at its first line.
    """
    robot = package.robot

    def find(name: str) -> Path | None:
        if name == LIBRARY != robot.target.package.partition(".")[0]:
            return library_folder() / LIBRARY
        if name not in libraries.STANDARD:
            return libraries.find_library(name, libraries.search_path(robot))
        try:
            return libraries.find_standard_library(os.environ, package.config.check.library).parts[name]
        except libraries.LibraryError:
            return None

    around = {robot.output / path: text for path, text in package.around.items() if path.endswith(".mo")}
    others = {**around, **package.users_files}
    sources = StoredClasses(robot.target.package, robot.folder, package.files.texts, others, find)
    users = [name for name, one in sources.users.items() if Path(one.file) in package.users_files]
    message, hint = "this file can't be read as Modelica, so its names were not checked", "open it in a Modelica tool"
    unread = [path for path in sources.unread if path in package.users_files and path not in around]
    found = [Diagnostic(Severity.WARNING, "names-unread", message, shown(path), hint=hint) for path in unread]
    scopes = Scopes(sources)
    return _check_classes(package, scopes, sources.own), [*found, *_check_classes(package, scopes, users)]


def _check_classes(package: CheckedPackage, scopes: Scopes, names: Iterable[ClassName]) -> list[Diagnostic]:
    """One finding for all places in a file that have the same fault."""
    places: dict[tuple[str, UnresolvedKind, str, str], list[Unresolved]] = {}
    for node in filter(None, map(scopes.node, sorted(names))):
        for one in unresolved(node, scopes):
            places.setdefault((node.file, one.kind, one.owner, one.part), []).append(one)
    found = [_diagnostic(package, Path(file), alike) for (file, *_), alike in places.items()]
    return sorted(found, key=lambda one: (one.file, one.line))


def _diagnostic(package: CheckedPackage, file: Path, places: Sequence[Unresolved]) -> Diagnostic:
    one, files = min(places, key=lambda place: place.line), package.files
    severity, code, hint = Severity.WARNING, one.kind.value, ""
    if one.kind is UnresolvedKind.NESTED_REDECLARE:
        message = f"the redeclaration of `{one.part}` inside of another modifier is not checked: rumoca ignores it"
        hint = f"write a model that says `extends {one.owner}(redeclare … {one.part})`, and use that instead"
    elif one.kind is UnresolvedKind.DOTTED_MODIFIER:
        message = f"the modifier of `{one.name}` is not checked: rumoca ignores names with dots in modifiers"
        first, *rest = one.name.split(".")
        hint = f"write `{first}({'('.join(rest)} = …{')' * len(rest)}`, which every tool follows"
    else:
        severity, code, hint = Severity.ERROR, "unresolved", f"did you mean `{one.meant}`?" if one.meant else ""
        message = f"there is no {one.kind.value} `{one.name}`"
        if one.kind is UnresolvedKind.ELEMENT:
            message = f"{one.owner.rpartition('.')[2]} has no `{one.part}`"
            robot, snapshot = package.robot, package.rendering.snapshot
            if one.owner == f"{robot.target.package}.{package.models[0]}":
                option = package.domain.option_for_connector(one.part, snapshot, robot.target, robot.options)
                hint = f"`{option}` in the configuration brings it back" if option else hint
    lines = sorted({place.line for place in places} - {one.line})
    also = f"also in line{'s' if len(lines) > 1 else ''} {listed([*map(str, lines)])}" if lines else ""
    if not file.is_relative_to(files.folder):
        hint = "; ".join(filter(None, (hint, also)))
        return Diagnostic(severity, code, message, shown(file), one.line, hint=hint)
    path = file.relative_to(files.folder).as_posix()
    hint = "; ".join(filter(None, (hint, also, files.by_hand(path))))
    return files.diagnostic(severity, code, message, path, one.line, hint=hint)
