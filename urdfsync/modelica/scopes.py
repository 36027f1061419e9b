"""Resolves names in Modelica classes: scopes, inheritance, imports, modifiers and redeclarations.

The rules are in chapters 5 and 7 of the language specification 3.6. A name means an element, or is missing. An
unavailable class is `OPAQUE`: any name counts as an element of this class. A redeclared element has the elements of its
old, its constraining and its new type. The language allows fewer names, so each name that this reports as missing is
missing.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from urdfsync.modelica.classes import OPAQUE, ClassNode, Scoped, Type, Types, predefined
from urdfsync.modelica.names import FUNCTIONS
from urdfsync.modelica.stored import StoredClasses
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
"""Functions and predefined types whose elements are not checked."""
_ICONS = ("Modelica", "Icons")
"""The package of the Modelica Standard Library with pictures only: its classes have no elements."""
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
"""The components of the Modelica Standard Library's classes that UrdfSync extends: builds do not read this library."""
INTERFACES = {name: predefined(".".join(name), names.split()) for name, names in _INTERFACES.items()}
"""The classes of `_INTERFACES` as nodes, by their full names."""
_DEEPEST = 40
"""The longest chain of lookups: a longer chain is a circle."""


class NamedElement(NamedTuple):
    """A named thing: a component, a class, a literal, an attribute, or a part of the language."""

    types: Types
    """The possible classes of a component, the present class first; for a class, its possible meanings."""
    is_component: bool = False


class Missing(NamedTuple):
    """A name with an unresolved part."""

    part: str
    types: Types = ()
    """The classes without this part; empty for the first part of a name, which may be in any scope."""
    is_certain: bool = True
    """Whether the part is missing for sure: False if a class extends an unavailable class, which may have the name."""
    number: int = 0
    """Number of the part in the name, from 0."""


ANYTHING = NamedElement((Type(OPAQUE),))
"""Any element of an `OPAQUE` class."""
_TYPES = {name: predefined(name, attributes.split()) for name, attributes in _PREDEFINED.items()}


class Scopes:
    """Resolves names, and keeps the classes that were read."""

    def __init__(self, sources: StoredClasses) -> None:
        self._sources = sources
        self._tops: dict[str, ClassNode | None] = {}
        self._resolving: frozenset[ClassNode] = frozenset()
        """Classes whose base classes are being resolved; until then, inherited elements of these classes do not
        count."""
        self._depth = 0

    def node(self, name: Sequence[str]) -> ClassNode | None:
        """Return the class with this full name; None for an unavailable or inherited class."""
        node = self._top(name[0]) if name else None
        for part in name[1:]:
            node = node and self._child(node, part)
        return None if node is OPAQUE else node

    def users(self) -> Iterator[ClassNode]:
        """Yield the classes of the user's files, each with the class around it, in the order of the files."""
        for node in self._sources.all_users:
            yield ClassNode(node.definition, node.name, node.file, self.node(node.name[:-1]))

    def _top(self, name: str) -> ClassNode | None:
        if name not in self._tops:
            self._tops[name] = self._sources.stored((name,))
        return self._tops[name]

    def _child(self, node: ClassNode, name: str) -> ClassNode | None:
        if node is OPAQUE:
            return OPAQUE
        if name not in node.classes:
            definition = next((inner for inner in node.definition.classes if inner.name.parts[0] == name), None)
            child = ClassNode(definition, (*node.name, name), node.file) if definition else None
            if child is None and (node.definition.kind == "package" or node.file.endswith("package.mo")):
                child = self._sources.stored((*node.name, name))
            if child is not None and child is not OPAQUE:
                child.parent = node
            node.classes[name] = child
        return node.classes[name]

    # --- lookup ---------------------------------------------------------------------------------------------------

    def lookup(self, name: Name, scope: ClassNode | None) -> NamedElement | Missing:
        """Return the meaning of a name in a class; `scope` is None outside of all classes."""
        meaning = self._first(name.parts[0], None if name.is_global else scope)
        for number, part in enumerate(name.parts[1:], start=1):
            if isinstance(meaning, Missing):
                break
            meaning = self.part(meaning.types, part)
            if isinstance(meaning, Missing):
                meaning = meaning._replace(number=number)
        return meaning

    def is_top_level(self, name: Name) -> bool:
        """Return whether a name means a class from the top; this look is no request (see `StoredClasses.seen`)."""
        requested = {**self._sources.seen}
        meaning = self.lookup(name._replace(is_global=True), None)
        self._sources.seen = requested
        return isinstance(meaning, NamedElement) and meaning is not ANYTHING

    def lookup_base(self, name: Name, node: ClassNode) -> NamedElement | Missing:
        """Return the meaning of a name after `extends` in a class: inherited elements do not count."""
        with self._without_bases(node):
            return self.lookup(name, node)

    def part(self, types: Types, name: str) -> NamedElement | Missing:
        """Return the meaning of a name in an element with these possible types."""
        every = [self._member(type_, name) for type_ in types]
        elements = [member for member in every if isinstance(member, NamedElement)]
        is_certain = all(member.is_certain for member in every if isinstance(member, Missing))
        if not elements:
            return Missing(name, types, is_certain)
        specific = [element for element in elements if element is not ANYTHING]
        united = (type_ for element in elements for type_ in element.types)
        more = () if is_certain else ANYTHING.types
        return NamedElement(tuple(dict.fromkeys((*united, *more))), specific[0].is_component) if specific else ANYTHING

    def types_of(self, used: Extends, scope: ClassNode | None) -> Types:
        """Return the classes that a name stands for, with the modifiers after the name."""
        meaning = self.lookup(used.type, scope)
        if isinstance(meaning, Missing) or meaning.is_component:
            return ANYTHING.types
        return _modified(meaning.types, [Scoped(used.arguments, scope)] if used.arguments else [])

    def types_in(self, component: Component, scope: ClassNode) -> Types:
        """Return the possible types of a component by its declaration in a class."""
        if not component.type.parts[0]:  # without a type: an attribute of a predefined type
            return ANYTHING.types
        types = self.types_of(Extends(component.type, component.arguments), scope)
        if component.constraint:
            types += _modified(self.types_of(component.constraint, scope), [Scoped(component.arguments, scope)])
        return types

    def bases(self, node: ClassNode) -> Types:
        """Return the base classes of a class, or the class that a short definition stands for."""
        if node.bases is not None:
            return node.bases
        if node in self._resolving:
            return ()
        with self._without_bases(node):
            types = self._bases(node)
        if not self._resolving:  # during another resolution, a name may only seem to be missing
            node.bases = types
        return types

    @contextlib.contextmanager
    def _without_bases(self, node: ClassNode) -> Iterator[None]:
        """Inside of the `with` block, inherited elements of this class do not count."""
        before = self._resolving
        self._resolving = before | {node}
        try:
            yield
        finally:
            self._resolving = before

    def names_in(self, types: Types) -> dict[str, bool]:
        """Return the names of the known elements of classes, inherited or not, and whether each is a class."""
        names: dict[str, bool] = {}
        waiting, seen = [type_.node for type_ in types], {OPAQUE}
        while waiting:
            node = waiting.pop(0)
            if node not in seen:
                seen.add(node)
                below = self._sources.names_in(node.name) if node.definition.kind == "package" else ()
                classes = (inner.name.parts[0] for inner in node.definition.classes)
                names |= dict.fromkeys((*node.components, *(node.definition.literals or ())), False)
                names |= dict.fromkeys((*classes, *below), True)
                waiting += [base.node for base in self.bases(node)]
        return names

    def names_around(self, scope: ClassNode | None) -> dict[str, bool]:
        """Return the known simple names that can be used in a class, and whether each names a class."""
        names = dict.fromkeys(self._sources.names_in(()), True)
        while scope is not None:
            for clause in scope.definition.imports:
                package = None if clause.names else self.lookup(clause.name, None)
                names |= dict.fromkeys(clause.names, True)
                names |= self.names_in(package.types) if isinstance(package, NamedElement) else {}
            names = {**names, **self.names_in((Type(scope),))}
            scope = scope.parent
        return names

    def _first(self, name: str, scope: ClassNode | None) -> NamedElement | Missing:
        is_certain = True
        while scope is not None:
            meaning = self._in_scope(scope, name)
            if isinstance(meaning, NamedElement):
                return meaning
            is_certain &= meaning.is_certain
            if not is_certain and not name[:1].isupper():
                return meaning
            # models hardly ever inherit classes from missing libraries, only components
            scope = None if "encapsulated" in scope.definition.prefixes else scope.parent
        if name in _ANYTHING:
            return ANYTHING
        top = _TYPES.get(name) or self._top(name)
        if top is not None:
            return NamedElement((Type(top),)) if top is not OPAQUE else ANYTHING
        if self._sources.has_library(name):  # builds read no libraries
            return ANYTHING
        return Missing(name, (), is_certain)

    def _in_scope(self, scope: ClassNode, name: str) -> NamedElement | Missing:
        member = self._member(Type(scope), name)
        if isinstance(member, NamedElement):
            return member
        for clause in scope.definition.imports:
            if name in clause.names:
                imported = self.lookup(clause.names[name], None)
                return imported if isinstance(imported, NamedElement) else ANYTHING  # the import's own check reports it
        for clause in scope.definition.imports:
            if not clause.names:
                imported = self.lookup(clause.name._replace(parts=(*clause.name.parts, name)), None)
                if isinstance(imported, NamedElement):
                    return imported
                if imported.part != name or not imported.types:
                    return ANYTHING
        return member

    # --- elements of a class --------------------------------------------------------------------------------------

    def _member(self, type_: Type, name: str) -> NamedElement | Missing:
        """Return an element of a class, inherited or not, with its modifiers."""
        if self._depth > _DEEPEST:
            return ANYTHING
        self._depth += 1
        try:
            return self._member_of(type_.node, type_.modifiers, name)
        finally:
            self._depth -= 1

    def _member_of(self, node: ClassNode, modifiers: tuple[Scoped, ...], name: str) -> NamedElement | Missing:
        definition = node.definition
        if node is OPAQUE or definition.is_derivative:
            return ANYTHING
        if definition.literals is not None:
            if name in definition.literals or not definition.literals:
                return NamedElement((Type(node),))
            return self._member(Type(_TYPES["enumeration"]), name)
        if component := node.components.get(name):
            return self._component(node, modifiers, component)
        child = self._child(node, name)
        if child is None:
            inherited = self._inherited(node, modifiers, name)
            return ANYTHING if isinstance(inherited, Missing) and "expandable" in definition.prefixes else inherited
        if child is OPAQUE:
            return ANYTHING
        nested = _nested(modifiers, name)
        types = (*self._redeclared(modifiers, name), Type(child, nested))
        if "replaceable" in child.definition.prefixes and not child.definition.constraint:
            # packages of media use names that exist only in redeclared classes
            types += ANYTHING.types
        if child.definition.constraint:
            types += _modified(self.types_of(child.definition.constraint, node), nested)
        return NamedElement(self._with_inherited(types, node, modifiers, name, child.definition.prefixes))

    def _inherited(self, node: ClassNode, modifiers: tuple[Scoped, ...], name: str) -> NamedElement | Missing:
        is_certain = True
        for base in self.bases(node):
            if base.node is OPAQUE:
                is_certain = False
                continue
            member = self._member(Type(base.node, base.modifiers + modifiers), name)
            if isinstance(member, NamedElement):
                return member
            is_certain &= member.is_certain
        return Missing(name, (), is_certain)

    def _component(self, node: ClassNode, modifiers: tuple[Scoped, ...], component: Component) -> NamedElement:
        name = component.name.parts[0]
        types = self._redeclared(modifiers, name)
        types += _modified(self.types_in(component, node), _nested(modifiers, name))
        types = self._with_inherited(types, node, modifiers, name, component.prefixes)
        return NamedElement(types, is_component=True)

    def _redeclared(self, modifiers: tuple[Scoped, ...], name: str) -> Types:
        """Return the types to which the modifiers of its class redeclare an element."""
        nested = _nested(modifiers, name)
        types: Types = ()
        for arguments, scope in modifiers:
            for modifier in arguments:
                if modifier.name.parts == (name,) and modifier.type is not None:
                    types += _modified(self.types_of(modifier.type, scope), nested)
                    types += self.types_of(modifier.constraint, scope) if modifier.constraint else ()
        return types

    def _with_inherited(
        self, types: Types, node: ClassNode, modifiers: tuple[Scoped, ...], name: str, prefixes: frozenset[str]
    ) -> Types:
        """Return types; for an element that redeclares an inherited element, add the types of the inherited element."""
        before = self._inherited(node, modifiers, name) if "redeclare" in prefixes else None
        types += before.types if isinstance(before, NamedElement) else ()
        return tuple(dict.fromkeys(types))

    def _bases(self, node: ClassNode) -> Types:
        definition = node.definition
        if definition.alias is not None:
            return self.types_of(definition.alias, node.parent)
        bases: Types = ()
        if definition.is_extension and node.parent is not None:
            before = self._inherited(node.parent, (), node.name[-1])
            types = before.types if isinstance(before, NamedElement) else ANYTHING.types
            bases += _modified(types, [Scoped(definition.arguments, node)])
        for base in definition.extends:
            types = self.types_of(base, node)
            if types == ANYTHING.types and base.type.parts in INTERFACES:
                types = (Type(INTERFACES[base.type.parts]),)
            bases += () if types == ANYTHING.types and base.type.parts[:2] == _ICONS else types
        return bases


def _modified(types: Types, modifiers: Sequence[Scoped]) -> Types:
    """Return types with more modifiers before their present modifiers."""
    return tuple(type_ if type_.node is OPAQUE else Type(type_.node, (*modifiers, *type_.modifiers)) for type_ in types)


def _nested(modifiers: Iterable[Scoped], name: str) -> tuple[Scoped, ...]:
    """Return the modifiers of one element, from the modifiers of its class."""
    return tuple(
        Scoped(modifier.arguments, scope)
        for arguments, scope in modifiers
        for modifier in arguments
        if modifier.name.parts == (name,) and modifier.arguments
    )
