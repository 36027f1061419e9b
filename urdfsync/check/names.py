"""Names that mean nothing, in a package and in the user's files around it, as findings with file, line and element."""

from __future__ import annotations

import functools
import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from urdfsync.check import libraries
from urdfsync.check.files import PackageFiles
from urdfsync.check.package import CheckedPackage
from urdfsync.config import library_folder, shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.modelica.files import StoredClasses
from urdfsync.modelica.names import LIBRARY
from urdfsync.modelica.scopes import Element, Node, Scopes, Sources
from urdfsync.modelica.syntax import Component
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, first_type, unresolved

_NAMED_LINES = 5


def check_names(package: CheckedPackage) -> tuple[list[Diagnostic], list[Diagnostic]]:
    """What is wrong with names in the package, and in the user's files outside of it."""
    robot = package.robot
    around = {robot.output / path: text for path, text in package.around.items() if path.endswith(".mo")}
    others = {**around, **package.users_files}
    find = functools.partial(_find_library, package)
    sources = StoredClasses(robot.target.package, robot.folder, package.texts, others, find)
    users = [name for name, one in sources.users.items() if Path(one.file) in package.users_files]
    message, hint = "this file can't be read as Modelica, so its names were not checked", "open it in a Modelica tool"
    unread = [
        Diagnostic(Severity.WARNING, "names-unread", message, shown(path), hint=hint)
        for path in sources.unread
        if path in package.users_files and path not in around
    ]
    own = _unresolved_names(package.files, sources.own, sources)
    return own, [*unread, *_unresolved_names(package.files, users, sources)]


def _find_library(package: CheckedPackage, name: str) -> Path | None:
    """The folder or file of a library; None if it is not at hand."""
    robot = package.robot
    if name == LIBRARY != robot.target.package.partition(".")[0]:
        return library_folder() / LIBRARY
    if name not in libraries.STANDARD:
        return libraries.find_library(name, libraries.search_path(robot))
    try:
        return libraries.find_standard_library(os.environ, package.config.check.library).parts[name]
    except libraries.LibraryError:
        return None


def _unresolved_names(package: PackageFiles, classes: Iterable[tuple[str, ...]], sources: Sources) -> list[Diagnostic]:
    """All that is wrong with names in stored classes, which are given by their full names.

    Each fault is told once in each file, at its first line.
    """
    scopes = Scopes(sources)
    found: dict[tuple[str, UnresolvedKind, str, str], list[Unresolved]] = {}
    for node in [node for name in sorted(classes) if isinstance(node := scopes.node(name), Node)]:
        for one in unresolved(node, scopes):
            found.setdefault((node.file, one.kind, one.owner, one.part), []).append(one)
    told = [_diagnostic(package, Path(file), places) for (file, *_), places in found.items()]
    return sorted(told, key=lambda one: (one.file, one.line))


def _diagnostic(package: PackageFiles, file: Path, places: Sequence[Unresolved]) -> Diagnostic:
    """One finding for all places in a file that have the same fault."""
    owners = {package.folder / path: owner for path, owner in package.owners.items()}
    edited = {package.folder / path for path in package.edited}
    one = min(places, key=lambda place: place.line)
    if one.kind is UnresolvedKind.NESTED_REDECLARE:
        severity, code = Severity.WARNING, "nested-redeclare"
        message = f"the redeclaration of `{one.part}` inside of another modifier is not checked: rumoca ignores it"
        hint = f"write a model that says `extends {one.owner}(redeclare … {one.part})`, and use that instead"
    elif one.kind is UnresolvedKind.DOTTED_MODIFIER:
        severity, code = Severity.WARNING, "dotted-modifier"
        message = f"the modifier of `{one.name}` is not checked: rumoca ignores names with dots in modifiers"
        first, *rest = one.name.split(".")
        hint = f"write `{first}({'('.join(rest)} = …{')' * len(rest)}`, which every tool follows"
    else:
        severity, code, hint = Severity.ERROR, "unresolved", f"did you mean `{one.meant}`?" if one.meant else ""
        if one.kind in (UnresolvedKind.CLASS, UnresolvedKind.FUNCTION):
            message = f"there is no {one.kind.value} `{one.name}`"
        else:
            noun = _noun(one.element, owners) if one.element else "part" if one.is_part else "element"
            noun = "field" if one.is_field and noun != "attribute" else noun
            message = f"{one.owner.rpartition('.')[2]} has no {noun} `{one.part}`"
    owner = owners.get(file, "")
    hints = [hint, _also_in(one.line, places), "the file was edited by hand" if file in edited else ""]
    message = f"{owner}: {message}" if owner else message
    return Diagnostic(severity, code, message, shown(file), one.line, hint="; ".join(filter(None, hints)))


def _noun(near: Element, owners: dict[Path, str]) -> str:
    """What people call an element of this kind."""
    declaration, type_ = near.declaration, first_type(near)
    if declaration is None:
        return "attribute" if type_ is None else "literal"
    if not isinstance(declaration, Component):
        return "class"
    for prefix in ("parameter", "constant"):
        if prefix in declaration.prefixes:
            return prefix
    node = type_.node if type_ else None
    if not isinstance(node, Node):
        return "element" if node is None else "variable"
    if node.definition.kind == "connector":
        return "connector"
    owner = owners.get(Path(node.file), "")
    return owner.partition(" ")[0] if " " in owner else "part"


def _also_in(line: int, places: Iterable[Unresolved]) -> str:
    lines = sorted({place.line for place in places} - {line})
    if not lines:
        return ""
    more = f" and {len(lines) - _NAMED_LINES} more" if len(lines) > _NAMED_LINES else ""
    return f"also in line{'s' if len(lines) > 1 else ''} {', '.join(map(str, lines[:_NAMED_LINES]))}{more}"
