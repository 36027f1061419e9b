"""Resolve names in Modelica classes: scopes, inheritance, imports, modifiers and redeclarations.

It follows chapters 5 and 7 of the language specification 3.6. A name is an element or missing. A class that is not at
hand is `OPAQUE`: it has any element. Where a component is redeclared, the elements of its old type, of its constraining
type and of its new one are all accepted, which is more than the language allows: so what is called missing is missing.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from urdfsync.modelica.classes import OPAQUE, Node, Scoped, Type, Types, predefined
from urdfsync.modelica.files import StoredClasses
from urdfsync.modelica.names import FUNCTIONS
from urdfsync.modelica.syntax import Component, Extends, Name

_NUMBER = "value quantity min max start fixed"
_PREDEFINED = {
    "Real": f"{_NUMBER} unit displayUnit nominal unbounded stateSelect",
    "Integer": _NUMBER,
    "Boolean": "value quantity start fixed",
    "String": "value quantity start fixed",
    "enumeration": _NUMBER,
    "StateSelect": "never avoid default prefer always",
    "AssertionLevel": "warning error",
}
"""Attributes or literals of predefined types."""
_ANYTHING = FUNCTIONS | {"integer", "Clock", "Connections", "ExternalObject"}
"""Functions and predefined types of whose elements nothing is said."""
_ICONS = ("Modelica", "Icons")
"""The package of the Modelica Standard Library whose classes are pictures: there is nothing to inherit."""
_MULTIBODY, _ROTATIONAL = ("Modelica", "Mechanics", "MultiBody"), ("Modelica", "Mechanics", "Rotational")
_TRANSLATIONAL = ("Modelica", "Mechanics", "Translational")
_SUPPORT = "useSupport flange_a flange_b phi_support support"
_INTERFACES = {
    (*_MULTIBODY, "Interfaces", "PartialOneFrame_a"): "frame_a world",
    (*_MULTIBODY, "Interfaces", "PartialTwoFrames"): "frame_a frame_b world",
    (*_ROTATIONAL, "Interfaces", "PartialTwoFlanges"): "flange_a flange_b",
    (*_ROTATIONAL, "Interfaces", "PartialElementaryTwoFlangesAndSupport2"): _SUPPORT,
    (*_TRANSLATIONAL, "Interfaces", "PartialTwoFlanges"): "flange_a flange_b",
}
"""What is in the classes of the Modelica Standard Library that UrdfSync's own extend: builds do not read it."""
INTERFACES = {name: predefined(".".join(name), names.split()) for name, names in _INTERFACES.items()}
"""These as classes, by their full names."""
_DEEPEST = 40
"""So many lookups may lead to each other: more of them go in circles."""


class Element(NamedTuple):
    """Something that has a name: a component, a class, a literal, an attribute, or a part of the language itself."""

    types: Types
    """The classes that a component may have, the one that it has first; of a class, what it may stand for."""
    is_component: bool = False


class Missing(NamedTuple):
    """A name of which a part means nothing."""

    part: str
    types: Types = ()
    """The classes that lack it; empty if it is the first part, which was looked for in all scopes."""
    is_certain: bool = True
    """False if one of the classes on the way extends one that is not at hand."""
    number: int = 0
    """Of the part in the name, from 0."""


ANYTHING = Element((Type(OPAQUE),))
"""An element of such a class."""
_TYPES = {name: predefined(name, attributes.split()) for name, attributes in _PREDEFINED.items()}


class Scopes:
    """Resolves names, and keeps the classes that it has read."""

    def __init__(self, sources: StoredClasses) -> None:
        self._sources = sources
        self._tops: dict[str, Node | None] = {}
        self._resolving: frozenset[Node] = frozenset()
        """Classes whose base classes are being looked for: these are not looked for in what they inherit."""
        self._depth = 0

    def node(self, name: Sequence[str]) -> Node | None:
        """Return the class with this full name, not an inherited one; None if it is not at hand."""
        found = self._top(name[0]) if name else None
        for part in name[1:]:
            found = found and self._child(found, part)
        return None if found is OPAQUE else found

    def users(self) -> Iterator[Node]:
        """Yield the classes of the user's files at their places, in the order of the files."""
        for one in self._sources.all_users:
            yield Node(one.definition, one.name, one.file, self.node(one.name[:-1]))

    def _top(self, name: str) -> Node | None:
        if name not in self._tops:
            self._tops[name] = self._sources.stored((name,))
        return self._tops[name]

    def _child(self, node: Node, name: str) -> Node | None:
        if node is OPAQUE:
            return OPAQUE
        if name not in node.classes:
            found = next((one for one in node.definition.classes if one.name.parts[0] == name), None)
            child = Node(found, (*node.name, name), node.file) if found else None
            if child is None and node.definition.kind == "package":
                child = self._sources.stored((*node.name, name))
            if child is not None and child is not OPAQUE:
                child.parent = node
            node.classes[name] = child
        return node.classes[name]

    # --- lookup ---------------------------------------------------------------------------------------------------

    def lookup(self, name: Name, scope: Node | None) -> Element | Missing:
        """Return the meaning of a name that is used in a class; of None, in a file outside of all classes."""
        found = self._first(name.parts[0], None if name.is_global else scope)
        for number, part in enumerate(name.parts[1:], start=1):
            if isinstance(found, Missing):
                break
            found = self.part(found.types, part)
            if isinstance(found, Missing):
                found = found._replace(number=number)
        return found

    def lookup_base(self, name: Name, node: Node) -> Element | Missing:
        """Return the meaning of a name after `extends` in a class: nothing that the class inherits."""
        with self._without_bases(node):
            return self.lookup(name, node)

    def part(self, types: Types, name: str) -> Element | Missing:
        """Return the meaning of a name in something that may have any of these types."""
        every = [self._member(one, name) for one in types]
        found = [one for one in every if isinstance(one, Element)]
        is_certain = all(one.is_certain for one in every if isinstance(one, Missing))
        if not found:
            return Missing(name, types, is_certain)
        known = [one for one in found if one is not ANYTHING]
        united = (one for element in found for one in element.types)
        more = () if is_certain else ANYTHING.types
        return Element(tuple(dict.fromkeys((*united, *more))), known[0].is_component) if known else ANYTHING

    def types_of(self, used: Extends, scope: Node | None) -> Types:
        """Return the classes that a name stands for, with the modifiers beside it."""
        found = self.lookup(used.type, scope)
        if isinstance(found, Missing) or found.is_component:
            return ANYTHING.types
        return _modified(found.types, [Scoped(used.arguments, scope)] if used.arguments else [])

    def types_in(self, component: Component, scope: Node) -> Types:
        """Return the types that a component may have by its own declaration, in a class."""
        if not component.type.parts[0]:  # an attribute of a predefined type
            return ANYTHING.types
        types = self.types_of(Extends(component.type, component.arguments), scope)
        if component.constraint:
            types += _modified(self.types_of(component.constraint, scope), [Scoped(component.arguments, scope)])
        return types

    def bases(self, node: Node) -> Types:
        """Return the classes that a class extends or stands for."""
        if node.bases is not None:
            return node.bases
        if node in self._resolving:
            return ()
        with self._without_bases(node):
            found = self._bases(node)
        if not self._resolving:  # else a name may be missing only because a class around it is being resolved
            node.bases = found
        return found

    @contextlib.contextmanager
    def _without_bases(self, node: Node) -> Iterator[None]:
        """Inside, names are not looked for in what a class inherits."""
        before = self._resolving
        self._resolving = before | {node}
        try:
            yield
        finally:
            self._resolving = before

    def names_in(self, types: Types) -> dict[str, bool]:
        """The names of all that is known to be in classes, inherited elements included; whether each is a class."""
        found: dict[str, bool] = {}
        waiting, seen = [one.node for one in types], {OPAQUE}
        while waiting:
            node = waiting.pop(0)
            if node not in seen:
                seen.add(node)
                below = self._sources.names_in(node.name) if node.definition.kind == "package" else ()
                classes = (inner.name.parts[0] for inner in node.definition.classes)
                found |= dict.fromkeys((*node.components, *(node.definition.literals or ())), False)
                found |= dict.fromkeys((*classes, *below), True)
                waiting += [base.node for base in self.bases(node)]
        return found

    def names_around(self, scope: Node | None) -> dict[str, bool]:
        """The simple names that can be used in a class, as far as they are known; whether each is that of a class."""
        found = dict.fromkeys(self._sources.names_in(()), True)
        while scope is not None:
            for one in scope.definition.imports:
                package = None if one.names else self.lookup(one.name, None)
                found |= dict.fromkeys(one.names, True)
                found |= self.names_in(package.types) if isinstance(package, Element) else {}
            found = {**found, **self.names_in((Type(scope),))}
            scope = scope.parent
        return found

    def _first(self, name: str, scope: Node | None) -> Element | Missing:
        is_certain = True
        while scope is not None:
            found = self._in_scope(scope, name)
            if isinstance(found, Element):
                return found
            is_certain &= found.is_certain
            if not is_certain and not name[:1].isupper():
                return found
            # a model inherits components from a library that is not at hand, and hardly ever classes
            scope = None if "encapsulated" in scope.definition.prefixes else scope.parent
        if name in _ANYTHING:
            return ANYTHING
        top = _TYPES.get(name) or self._top(name)
        if top is not None:
            return Element((Type(top),)) if top is not OPAQUE else ANYTHING
        if self._sources.has_library(name):  # builds do not read it
            return ANYTHING
        return Missing(name, (), is_certain)

    def _in_scope(self, scope: Node, name: str) -> Element | Missing:
        found = self._member(Type(scope), name)
        if isinstance(found, Element):
            return found
        for one in scope.definition.imports:
            if name in one.names:
                imported = self.lookup(one.names[name], None)
                return imported if isinstance(imported, Element) else ANYTHING  # it is told where it is imported
        for one in scope.definition.imports:
            if not one.names:
                imported = self.lookup(one.name._replace(parts=(*one.name.parts, name)), None)
                if isinstance(imported, Element):
                    return imported
                if imported.part != name or not imported.types:
                    return ANYTHING
        return found

    # --- elements of a class --------------------------------------------------------------------------------------

    def _member(self, type_: Type, name: str) -> Element | Missing:
        """Return an element of a class, its own or an inherited one, with the modifiers that concern it."""
        if self._depth > _DEEPEST:
            return ANYTHING
        self._depth += 1
        try:
            return self._member_of(type_.node, type_.modifiers, name)
        finally:
            self._depth -= 1

    def _member_of(self, node: Node, modifiers: tuple[Scoped, ...], name: str) -> Element | Missing:
        definition = node.definition
        if node is OPAQUE or definition.is_derivative:
            return ANYTHING
        if definition.literals is not None:
            if name in definition.literals or not definition.literals:
                return Element((Type(node),))
            return self._member(Type(_TYPES["enumeration"]), name)
        if component := node.components.get(name):
            return self._component(node, modifiers, component)
        child = self._child(node, name)
        if child is None:
            found = self._inherited(node, modifiers, name)
            return ANYTHING if isinstance(found, Missing) and "expandable" in definition.prefixes else found
        is_open = "replaceable" in child.definition.prefixes
        types = (Type(child, _nested(modifiers, name)), *(ANYTHING.types if is_open else ()))
        return Element(types) if child is not OPAQUE else ANYTHING

    def _inherited(self, node: Node, modifiers: tuple[Scoped, ...], name: str) -> Element | Missing:
        is_certain = True
        for base in self.bases(node):
            if base.node is OPAQUE:
                is_certain = False
                continue
            found = self._member(Type(base.node, base.modifiers + modifiers), name)
            if isinstance(found, Element):
                return found
            is_certain &= found.is_certain
        return Missing(name, (), is_certain)

    def _component(self, node: Node, modifiers: tuple[Scoped, ...], component: Component) -> Element:
        name = component.name.parts[0]
        nested = _nested(modifiers, name)
        types: Types = ()
        for arguments, scope in modifiers:
            for one in arguments:
                if one.name.parts == (name,) and one.type is not None:
                    types += _modified(self.types_of(one.type, scope), nested)
                    types += self.types_of(one.constraint, scope) if one.constraint else ()
        types += _modified(self.types_in(component, node), nested)
        if "redeclare" in component.prefixes:
            before = self._inherited(node, modifiers, name)
            types += before.types if isinstance(before, Element) else ()
        return Element(tuple(dict.fromkeys(types)), is_component=True)

    def _bases(self, node: Node) -> Types:
        definition = node.definition
        if definition.alias is not None:
            return self.types_of(definition.alias, node.parent)
        found: Types = ()
        if definition.is_extension and node.parent is not None:
            before = self._inherited(node.parent, (), node.name[-1])
            types = before.types if isinstance(before, Element) else ANYTHING.types
            found += _modified(types, [Scoped(definition.arguments, node)])
        for one in definition.extends:
            types = self.types_of(one, node)
            if types == ANYTHING.types and one.type.parts in INTERFACES:
                types = (Type(INTERFACES[one.type.parts]),)
            found += () if types == ANYTHING.types and one.type.parts[:2] == _ICONS else types
        return found


def _modified(types: Types, modifiers: Sequence[Scoped]) -> Types:
    """Types with more modifiers, which come before those that they have."""
    return tuple(one if one.node is OPAQUE else Type(one.node, (*modifiers, *one.modifiers)) for one in types)


def _nested(modifiers: Iterable[Scoped], name: str) -> tuple[Scoped, ...]:
    """Return those parts of a class's modifiers that concern one of its elements."""
    return tuple(
        Scoped(one.arguments, scope)
        for arguments, scope in modifiers
        for one in arguments
        if one.name.parts == (name,) and one.arguments
    )
