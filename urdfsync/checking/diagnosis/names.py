"""Names that mean nothing, in a package and in the user's files around it, as findings with file, line and element."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from urdfsync.checking.diagnosis.package import Package
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.modelica.scopes import Element, Node, Scopes, Sources
from urdfsync.modelica.syntax import Component
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, first_type, unresolved

_FEW = 5
"""So many more lines are named."""


def check(package: Package, classes: Iterable[tuple[str, ...]], sources: Sources) -> tuple[Diagnostic, ...]:
    """All that is wrong with names in stored classes, which are given by their full names.

    The files of `sources` are absolute paths. Each fault is told once in each file, at its first line.
    """
    scopes = Scopes(sources)
    nodes = [node for name in sorted(classes) if isinstance(node := scopes.node(name), Node)]
    found: dict[tuple[str, UnresolvedKind, str, str], list[Unresolved]] = {}
    for node in nodes:
        for one in unresolved(node, scopes):
            found.setdefault((node.file, one.kind, one.owner, one.part), []).append(one)
    words = _Words(package)
    told = (words.told(Path(file), places) for (file, *_), places in found.items())
    return tuple(sorted(told, key=lambda one: (one.file, one.line)))


class _Words:
    def __init__(self, package: Package) -> None:
        self._package = package
        self._owners: Mapping[Path, str] = {package.folder / path: owner for path, owner in package.owners.items()}

    def told(self, file: Path, places: Sequence[Unresolved]) -> Diagnostic:
        """One finding for all places in a file that have the same fault."""
        one = min(places, key=lambda place: place.line)
        if one.kind is UnresolvedKind.NESTED_REDECLARE:
            severity, code = Severity.WARNING, "nested-redeclare"
            message = f"the redeclaration of `{one.part}` inside of another modifier is not checked: rumoca ignores it"
            hint = f"write a model that says `extends {one.owner}(redeclare … {one.part})`, and use that instead"
        else:
            severity, code = Severity.ERROR, "unresolved"
            message, hint = self._message(one), f"did you mean `{one.meant}`?" if one.meant else ""
        hints = [hint, _also(one.line, places), *self._about_edit(file)]
        owner = self._owners.get(file, "")
        return Diagnostic(
            severity,
            code,
            f"{owner}: {message}" if owner else message,
            self._package.shown(file),
            one.line,
            hint="; ".join(filter(None, hints)),
        )

    def _message(self, one: Unresolved) -> str:
        if one.kind in (UnresolvedKind.CLASS, UnresolvedKind.FUNCTION):
            return f"there is no {one.kind.value} `{one.name}`"
        noun = self._noun(one.element) if one.element else "part" if one.is_part else "element"
        if one.is_field and noun != "attribute":
            noun = "field"
        return f"{one.owner.rpartition('.')[2]} has no {noun} `{one.part}`"

    def _noun(self, near: Element) -> str:
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
        owner = self._owners.get(Path(node.file), "")
        if node.definition.kind == "connector":
            return "connector"
        return owner.partition(" ")[0] if " " in owner else "part"

    def _about_edit(self, file: Path) -> Iterator[str]:
        if any(file == self._package.folder / path for path in self._package.edited):
            yield "the file was edited by hand"


def _also(line: int, places: Iterable[Unresolved]) -> str:
    lines = sorted({place.line for place in places} - {line})
    if not lines:
        return ""
    more = f" and {len(lines) - _FEW} more" if len(lines) > _FEW else ""
    return f"also in line{'s' if len(lines) > 1 else ''} {', '.join(map(str, lines[:_FEW]))}{more}"
