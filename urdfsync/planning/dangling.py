"""Names that a package loses with a build, and where the user's texts use them. Pure."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from urdfsync.modelica.lexer import lex
from urdfsync.modelica.parser import parse
from urdfsync.modelica.scopes import Node, Scopes
from urdfsync.modelica.syntax import Class
from urdfsync.modelica.unresolved import Kind, Unresolved, unresolved

Path = tuple[str, ...]


def lost_names(before: Mapping[str, str], now: Mapping[str, str], renamed: Mapping[str, str]) -> dict[str, str]:
    """The names of classes and components that texts declared before and do not declare now, with their new names.

    Texts are given by the paths of their files below the package; those that are the same in both may be left out.
    `renamed` are old and new identifiers of elements: names that begin with the old one may begin with the new one now.
    A new name is empty if there is none.
    """
    old, new = _declared(before), _declared(now)
    gone = old - new
    names = {path[-1] for path in gone if not any(path[:count] in gone for count in range(1, len(path)))}
    known = {path[-1] for path in new}
    return {name: _new_name(name, known, renamed) for name in sorted(names)}


def find_uses(name: Path, scopes: Scopes, lost: Collection[str]) -> Iterator[Unresolved]:
    """The places in a stored class, given by its full name, that use lost names and mean nothing, in their order.

    Where a class on the way can't be read, a lost name counts as meaning nothing.
    """
    node = scopes.node(name)
    found = unresolved(node, scopes, lost) if isinstance(node, Node) else ()
    missing = [one for one in found if one.part in lost and one.kind is not Kind.NESTED_REDECLARE]
    yield from sorted(missing, key=lambda one: one.line)


def words(text: str) -> set[str]:
    """All names and keywords in a text, without those in strings and comments."""
    return {token.text for token in lex(text)[0]}


def _declared(texts: Mapping[str, str]) -> set[Path]:
    """The full names, below the package, of all that texts declare."""
    found: set[Path] = set()
    for path, text in texts.items():
        folder = tuple(path.split("/")[:-1])
        found.update(_names(parse(text).classes, folder[:-1] if path.endswith("/package.mo") else folder))
    return found


def _names(classes: tuple[Class, ...], around: Path) -> Iterator[Path]:
    for one in classes:
        path = (*around, one.name.parts[0])
        yield path
        yield from ((*path, component.name.parts[0]) for component in one.components)
        yield from _names(one.classes, path)


def _new_name(name: str, known: Collection[str], renamed: Mapping[str, str]) -> str:
    """What is called like a name but for the identifier of its element; the longest such identifier counts."""
    for old, new in sorted(renamed.items(), key=lambda pair: -len(pair[0])):
        if name.lower().startswith(old.lower()):
            first = new[:1].upper() if name[:1].isupper() else new[:1].lower()
            candidates = (f"{new}{name[len(old) :]}", f"{first}{new[1:]}{name[len(old) :]}")
            return next((candidate for candidate in candidates if candidate in known), "")
    return ""
