"""Names that mean nothing, in a package and in the user's files around it, as findings with file, line and element."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from urdfsync.check import libraries
from urdfsync.check.package import CheckedPackage
from urdfsync.config import library_folder, shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.modelica.files import StoredClasses
from urdfsync.modelica.names import LIBRARY
from urdfsync.modelica.scopes import Element, Node, Scopes
from urdfsync.modelica.syntax import Component
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, first_type, unresolved

_NAMED_LINES = 5


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
    scopes, told = Scopes(sources), []
    for classes in (sources.own, users):
        places: dict[tuple[str, UnresolvedKind, str, str], list[Unresolved]] = {}
        for node in [node for name in sorted(classes) if isinstance(node := scopes.node(name), Node)]:
            for one in unresolved(node, scopes):
                places.setdefault((node.file, one.kind, one.owner, one.part), []).append(one)
        said = [_diagnostic(package, Path(file), alike) for (file, *_), alike in places.items()]
        told.append(sorted(said, key=lambda one: (one.file, one.line)))
    return told[0], [*found, *told[1]]


def _diagnostic(package: CheckedPackage, file: Path, places: Sequence[Unresolved]) -> Diagnostic:
    """One finding for all places in a file that have the same fault."""
    folder = package.files.folder
    owners = {folder / path: owner for path, owner in package.files.owners.items()}
    one = min(places, key=lambda place: place.line)
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
            noun = _noun(one.element, owners) if one.element else "part" if one.is_part else "element"
            noun = "field" if one.is_field and noun != "attribute" else noun
            robot, snapshot = package.robot, package.rendering.snapshot
            option = ""
            if one.owner == f"{robot.target.package}.{package.models[0]}":
                option = package.domain.option_for_connector(one.part, snapshot, robot.target, robot.options)
            if option:
                noun, hint = "connector", f"`{option}` in the configuration brings it back"
            message = f"{one.owner.rpartition('.')[2]} has no {noun} `{one.part}`"
    lines = sorted({place.line for place in places} - {one.line})
    more = f" and {len(lines) - _NAMED_LINES} more" if len(lines) > _NAMED_LINES else ""
    also = f"also in line{'s' if len(lines) > 1 else ''} {', '.join(map(str, lines[:_NAMED_LINES]))}{more}"
    edited = "the file was edited by hand" if file in {folder / path for path in package.files.edited} else ""
    owner = owners.get(file, "")
    message, hint = (
        f"{owner}: {message}" if owner else message,
        "; ".join(filter(None, [hint, also if lines else "", edited])),
    )
    return Diagnostic(severity, code, message, shown(file), one.line, hint=hint)


def _noun(near: Element, owners: Mapping[Path, str]) -> str:
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
