"""Finds unresolved names in classes, and modifiers of missing elements."""

from __future__ import annotations

import enum
from collections.abc import Callable, Collection, Container, Iterable, Iterator
from typing import NamedTuple

from urdfsync.common.spelling import nearest
from urdfsync.modelica.classes import OPAQUE, ClassNode, Types
from urdfsync.modelica.scopes import ANYTHING, Missing, NamedElement, Scopes
from urdfsync.modelica.syntax import Component, Extends, Modifier, Name

_RATHER_ALIKE, _ALIKE = 0.6, 0.75
"""The least likeness (see `difflib`) of a misspelled name; the second value is for names that a library may have."""

_CALLED = frozenset({"function", "operator function", "record"})
"""Kinds of classes that are called with their elements as named arguments."""


class UnresolvedKind(enum.Enum):
    """The kinds of faults of names."""

    CLASS = "class"
    """A name is used as a class, but there is no such class."""
    ELEMENT = "element"
    """A class has no component or function of this name."""
    CIRCLE = "circle"
    """A class extends itself, directly or through others: its elements are unknown."""
    NESTED_REDECLARE = "nested-redeclare"
    """A modifier redeclares an element inside of an element: legal, but some tools ignore it."""
    DOTTED_MODIFIER = "dotted-modifier"
    """A modifier has a name with dots: some tools do not support it."""


class Unresolved(NamedTuple):
    """One faulty use of a name."""

    kind: UnresolvedKind
    name: str
    """The name in the text, with dots."""
    part: str
    """The unresolved part of the name."""
    owner: str
    """The full name of the class without this part."""
    line: int
    near: str = ""
    """The valid name that is most similar to the part; empty if no name is similar."""
    candidates: Collection[str] = ()
    """The valid names at this place."""
    is_library: bool = False
    """Whether the part may be the name of a library."""
    is_hidden: bool = False
    """Whether the name is that of a class from the top, but its first part means a nearer class here."""

    @property
    def message(self) -> str:
        """The fault as a sentence."""
        if self.is_hidden:
            return f"here, `{self.name.partition('.')[0]}` is {self.owner}, which has no `{self.part}`"
        if self.kind is UnresolvedKind.ELEMENT and self.owner:
            return f"{self.owner.rpartition('.')[2]} has no `{self.part}`"
        if self.kind is UnresolvedKind.CIRCLE:
            return f"{self.owner.rpartition('.')[2]} extends itself"
        return f"there is no {self.kind.value} `{self.name}`"

    @property
    def meant(self) -> str:
        """The name from the top if it is hidden, or with `near` in place of the unresolved part; empty without both."""
        if self.is_hidden:
            return f".{self.name}"
        parts = self.name.split(".") if self.near else []
        return ".".join(self.near if part == self.part else part for part in parts)


def unresolved(
    node: ClassNode,
    scopes: Scopes,
    *,
    all_libraries: bool = False,
    lost: Callable[[str], bool] | None = None,
    passed: Container[int] = (),
) -> Iterator[Unresolved]:
    """Yield the faults of names in a class and in the classes inside of it.

    A name that may come from an unread library is no fault. An element that a class may inherit from an unread library
    is a fault only if its name is `lost`. With `all_libraries`, the names of all libraries are known, so any other
    library is missing. Components in the lines `passed` are not checked.
    """
    yield from _Walk(scopes, all_libraries, lost, passed).find(node)


def _is_in_open_package(scope: ClassNode | None, scopes: Scopes) -> bool:
    """Whether a class, or a class around it, is a package that may inherit classes from an unavailable library."""
    while scope is not None:
        if scope.definition.kind == "package" and any(base.node is OPAQUE for base in scopes.bases(scope)):
            return True
        scope = scope.parent
    return False


class _Walk(NamedTuple):
    """The search in a class; for the fields see `unresolved`."""

    scopes: Scopes
    all_libraries: bool
    lost: Callable[[str], bool] | None
    passed: Container[int]

    def find(self, node: ClassNode) -> Iterator[Unresolved]:
        scopes, definition = self.scopes, node.definition
        for used in filter(None, (definition.alias, definition.constraint)):
            yield from self._used(used, node.parent)
        if definition.is_extension:
            yield from self._arguments(definition.arguments, scopes.bases(node)[:1], node)
        for base in definition.extends:
            yield from self._missing(base.type, scopes.lookup_base(base.type, node), node, UnresolvedKind.CLASS)
            yield from self._arguments(base.arguments, scopes.types_of(base, node), node)
        if definition.extends and self._extends_itself(node):
            name = definition.extends[0].type
            text = ".".join(name.parts)
            yield Unresolved(UnresolvedKind.CIRCLE, text, text, ".".join(node.name), name.line)
        for name in (name for clause in definition.imports for name in clause.names.values() or (clause.name,)):
            yield from self._missing(name, scopes.lookup(name, None), None, UnresolvedKind.CLASS)
        for component in definition.components:
            if component.name.line not in self.passed:
                yield from self._component(component, node)
        yield from self._uses(definition.uses, node)
        for inner in definition.classes:
            child = scopes.node((*node.name, inner.name.parts[0]))
            if child is not None and child.definition is inner:
                yield from self.find(child)

    def _extends_itself(self, node: ClassNode) -> bool:
        waiting, seen = [type_.node for type_ in self.scopes.bases(node)], {OPAQUE}
        while waiting and node not in waiting:
            base = waiting.pop()
            if base not in seen:
                seen.add(base)
                waiting += [type_.node for type_ in self.scopes.bases(base)]
        return bool(waiting)

    def _used(self, used: Extends, scope: ClassNode | None) -> Iterator[Unresolved]:
        """Yield the faults of a used class, and of the modifiers after the class."""
        yield from self._missing(used.type, self.scopes.lookup(used.type, scope), scope, UnresolvedKind.CLASS)
        yield from self._arguments(used.arguments, self.scopes.types_of(used, scope), scope)

    def _uses(self, names: Iterable[Name], scope: ClassNode | None) -> Iterator[Unresolved]:
        for name in names:
            meaning = self.scopes.lookup(name, scope)
            yield from self._missing(name, meaning, scope, UnresolvedKind.ELEMENT)
            if name.arguments and isinstance(meaning, NamedElement) and not meaning.is_component:
                # operator records and external objects have constructors with other arguments
                is_plain = all(type_.node.definition.kind in _CALLED for type_ in meaning.types)
                for argument in name.arguments if is_plain else ():
                    part = self.scopes.part(meaning.types, argument.parts[0])
                    yield from self._missing(argument, part, scope, UnresolvedKind.ELEMENT)

    def _component(self, component: Component, node: ClassNode) -> Iterator[Unresolved]:
        yield from self._used(Extends(component.type), node)
        bases = self.scopes.bases(node)
        if "redeclare" in component.prefixes and bases:
            meaning = self.scopes.part(bases, component.name.parts[0])
            yield from self._missing(component.name, meaning, None, UnresolvedKind.ELEMENT)
        yield from self._arguments(component.arguments, self.scopes.types_in(component, node), node)
        if component.constraint:
            yield from self._used(component.constraint, node)
        yield from self._uses(component.uses, node)

    def _arguments(
        self, arguments: tuple[Modifier, ...], types: Types, scope: ClassNode | None, depth: int = 0
    ) -> Iterator[Unresolved]:
        """Yield the faults of modifiers of an element with these possible types."""
        for modifier in arguments:
            meaning: NamedElement | Missing = NamedElement(types)
            for part in modifier.name.parts:
                if isinstance(meaning, NamedElement):
                    meaning, name = self.scopes.part(meaning.types, part), Name((part,), modifier.name.line)
                    yield from self._missing(name, meaning, scope, UnresolvedKind.ELEMENT)
            for used in filter(None, (modifier.type, modifier.constraint)):
                yield from self._used(used, scope)
            if isinstance(meaning, NamedElement) and meaning is not ANYTHING:
                text, line = str(modifier.name), modifier.name.line
                if len(modifier.name.parts) > 1:
                    yield Unresolved(UnresolvedKind.DOTTED_MODIFIER, text, text, "", line)
                if depth and modifier.is_redeclared:
                    owner = next((str(type_) for type_ in types if type_.node is not OPAQUE), "")
                    yield Unresolved(UnresolvedKind.NESTED_REDECLARE, text, text, owner, line)
                yield from self._arguments(modifier.arguments, meaning.types, scope, depth + 1)
            yield from self._uses(modifier.uses, scope)

    def _missing(
        self, name: Name, meaning: NamedElement | Missing, scope: ClassNode | None, kind: UnresolvedKind
    ) -> Iterator[Unresolved]:
        if isinstance(meaning, NamedElement):
            return
        # models hardly ever inherit classes from unread libraries, only components
        is_class = kind is UnresolvedKind.CLASS and meaning.number == 0 and scope is not None
        is_missing = meaning.is_certain or (is_class and not _is_in_open_package(scope, self.scopes))
        if not (is_missing or (self.lost and self.lost(meaning.part))):
            return
        owner = str(meaning.types[0] if meaning.types else scope or "")
        names = self.scopes.names_in(meaning.types) if meaning.types else self.scopes.names_around(scope)
        candidates = {key for key, is_class in names.items() if is_class or kind is not UnresolvedKind.CLASS}
        is_dotted = len(name.parts) > 1 or name.is_global  # imported names have dots, too
        is_library = not meaning.types and is_dotted and meaning.part[:1].isupper()
        least = _ALIKE if is_library else _RATHER_ALIKE
        near = nearest(meaning.part, sorted(candidates - {meaning.part}), least)
        if near or not is_library or self.all_libraries:  # otherwise a compiler reports a missing library
            is_hidden = meaning.number == 1 and not name.is_global and self.scopes.is_top_level(name)
            found = Unresolved(kind, str(name), meaning.part, owner, name.line, near, candidates, is_library)
            yield found._replace(is_hidden=is_hidden)
