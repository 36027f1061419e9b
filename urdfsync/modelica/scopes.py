"""Resolve names in Modelica classes: scopes, inheritance, imports, modifiers and redeclarations.

It follows chapters 5 and 7 of the language specification 3.6. There are three answers: a name means something, it is
missing, or that can't be told, since a class on the way is not at hand. Where a component is redeclared, the elements
of its old type, of its constraining type and of its new one are all accepted, which is more than the language allows:
so what is called missing is missing.
"""

from __future__ import annotations

import enum
import functools
from collections.abc import Iterable, Sequence
from typing import Final, Literal, NamedTuple, Protocol, TypeAlias

import msgspec

from urdfsync.modelica.names import FUNCTIONS
from urdfsync.modelica.syntax import Class, Component, Extends, Import, Modifier, Name


class _Unknown(enum.Enum):
    UNKNOWN = "unknown"


UNKNOWN: Final = _Unknown.UNKNOWN
"""The meaning of a name that can't be found out."""
Unknown: TypeAlias = Literal[_Unknown.UNKNOWN]

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
_OPAQUE = frozenset({"Clock", "Connections", "ExternalObject"})
"""Predefined types of whose elements nothing is said."""
_FUNCTIONS = FUNCTIONS | {"integer"}
_ICONS = ("Modelica", "Icons")
"""The package of the Modelica Standard Library whose classes are pictures: there is nothing to inherit."""
_DEEPEST = 40
"""So many lookups may lead to each other: more of them go in circles."""


class Stored(NamedTuple):
    """A class that is stored in a file."""

    definition: Class
    file: str
    """How the caller knows the file."""


class Sources(Protocol):
    """The classes that are stored in files."""

    def stored(self, name: tuple[str, ...]) -> Stored | Unknown | None:
        """Return the class with this full name; None if there is no file of it, UNKNOWN if it can't be read."""
        ...

    def names_in(self, name: tuple[str, ...]) -> Iterable[str]:
        """Return the names of classes that are stored below this package; of the empty name, top-level ones."""
        ...


class Node(msgspec.Struct, eq=False, dict=True):
    """A class at its place. Equal to itself only."""

    definition: Class
    name: tuple[str, ...]
    """Its full name."""
    file: str
    """As in `Stored`."""
    parent: Node | None = None
    """The class around it."""
    classes: dict[str, Node | Unknown | None] = msgspec.field(default_factory=dict)
    """Its own classes, as far as anybody has asked for them."""
    bases: tuple[Type | Unknown, ...] | None = None
    """What it extends, once that has been resolved."""

    @functools.cached_property
    def components(self) -> dict[str, Component]:
        """Its own components by their names."""
        return {one.name.parts[0]: one for one in self.definition.components}

    def __str__(self) -> str:
        return ".".join(self.name)


class Scoped(NamedTuple):
    """Modifiers, and the class in whose scope they are written."""

    arguments: tuple[Modifier, ...]
    scope: Node | None


class Type(NamedTuple):
    """A class as a component or a derived class has it: with all modifiers that are applied to it."""

    node: Node | str
    """A predefined type by its name."""
    modifiers: tuple[Scoped, ...] = ()

    def __str__(self) -> str:
        return str(self.node)


Types: TypeAlias = tuple[Type | Unknown, ...]


class Element(NamedTuple):
    """Something that has a name: a component, a class, a literal, an attribute, or a part of the language itself."""

    name: str
    declaration: Component | Class | None
    types: Types
    """The classes that a component may have, the one that it has first; of a class, what it may stand for."""


class Missing(NamedTuple):
    """A name of which a part means nothing."""

    part: str
    types: Types = ()
    """The classes that lack it; empty if it is the first part, which was looked for in all scopes."""


class Scopes:
    """Resolves names, and keeps the classes that it has read."""

    def __init__(self, sources: Sources) -> None:
        self._sources = sources
        self._tops: dict[str, Node | Unknown | None] = {}
        self._resolving: set[Node] = set()
        """Classes whose base classes are being looked for: these are not looked for in what they inherit."""
        self._depth = 0

    # --- classes at their places ----------------------------------------------------------------------------------

    def node(self, name: Sequence[str]) -> Node | Unknown | None:
        """Return the class with this full name, not an inherited one."""
        if name and name[0] not in self._tops:
            self._tops[name[0]] = self._read((name[0],), None)
        found = self._tops[name[0]] if name else None
        for part in name[1:]:
            if not isinstance(found, Node):
                break
            found = self._child(found, part)
        return found

    def _child(self, node: Node, name: str) -> Node | Unknown | None:
        if name not in node.classes:
            own = next((one for one in node.definition.classes if one.name.parts[0] == name), None)
            if own is not None:
                node.classes[name] = Node(own, (*node.name, name), node.file, node)
            elif node.definition.kind == "package":
                node.classes[name] = self._read((*node.name, name), node)
            else:
                node.classes[name] = None
        return node.classes[name]

    def _read(self, name: tuple[str, ...], parent: Node | None) -> Node | Unknown | None:
        found = self._sources.stored(name)
        return Node(found.definition, name, found.file, parent) if isinstance(found, Stored) else found

    # --- lookup ---------------------------------------------------------------------------------------------------

    def lookup(self, name: Name, scope: Node | None) -> Element | Missing | Unknown:
        """Return the meaning of a name that is used in a class; of None, in a file outside of all classes."""
        found = self._first(name.parts[0], None if name.is_global else scope)
        for part in name.parts[1:]:
            if not isinstance(found, Element):
                break
            found = self.part(found.types, part)
        return found

    def lookup_base(self, name: Name, node: Node) -> Element | Missing | Unknown:
        """Return the meaning of a name after `extends` in a class: nothing that the class inherits."""
        outer = node in self._resolving
        self._resolving.add(node)
        try:
            return self.lookup(name, node)
        finally:
            if not outer:
                self._resolving.discard(node)

    def part(self, types: Types, name: str) -> Element | Missing | Unknown:
        """Return the meaning of a name in something that may have any of these types."""
        every = [UNKNOWN if one is UNKNOWN else self._member(one, name) for one in types]
        found = [one for one in every if isinstance(one, Element)]
        unknown: Types = (UNKNOWN,) if UNKNOWN in every else ()
        if found:
            united = dict.fromkeys((*(one for element in found for one in element.types), *unknown))
            return found[0]._replace(types=tuple(united))
        return UNKNOWN if unknown else Missing(name, types)

    def types_of(self, used: Extends, scope: Node | None) -> Types:
        """Return the classes that a name stands for, with the modifiers beside it."""
        found = self.lookup(used.type, scope)
        if not isinstance(found, Element) or isinstance(found.declaration, Component):
            return (UNKNOWN,)
        return _modified(found.types, [Scoped(used.arguments, scope)] if used.arguments else [])

    def types_in(self, component: Component, scope: Node) -> Types:
        """Return the types that a component may have by its own declaration, in a class."""
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
        self._resolving.add(node)
        try:
            found = self._bases(node)
        finally:
            self._resolving.discard(node)
        if not self._resolving:  # else a name may be missing only because a class around it is being resolved
            node.bases = found
        return found

    def names_in(self, types: Types) -> dict[str, bool]:
        """The names of all that is known to be in classes, inherited elements included; whether each is a class."""
        found: dict[str, bool] = {}
        waiting, seen = list(types), set[Node | str]()
        while waiting:
            one = waiting.pop(0)
            if one is UNKNOWN or one.node in seen:
                continue
            node = one.node
            seen.add(node)
            if isinstance(node, str):
                found |= dict.fromkeys(_PREDEFINED.get(node, "").split(), False)
                continue
            below = self._sources.names_in(node.name) if node.definition.kind == "package" else ()
            classes = (inner.name.parts[0] for inner in node.definition.classes)
            found |= dict.fromkeys((*node.components, *(node.definition.literals or ())), False)
            found |= dict.fromkeys((*classes, *below), True)
            waiting += self.bases(node)
        return found

    def names_around(self, scope: Node | None) -> dict[str, bool]:
        """The simple names that can be used in a class, as far as they are known; whether each is that of a class."""
        found = dict.fromkeys(self._sources.names_in(()), True)
        while scope is not None:
            imported = (name for one in scope.definition.imports for name in _imported(one))
            found = {**dict.fromkeys(imported, True), **self.names_in((Type(scope),)), **found}
            scope = scope.parent
        return found

    def _first(self, name: str, scope: Node | None) -> Element | Missing | Unknown:
        unknown = False
        while scope is not None:
            found = self._in_scope(scope, name)
            if found is not None and (unknown or found is not UNKNOWN or not name[:1].isupper()):
                return UNKNOWN if unknown else found
            unknown |= found is UNKNOWN  # nobody inherits what is called like the library in which it stands
            scope = None if "encapsulated" in scope.definition.prefixes else scope.parent
        if name in _PREDEFINED or name in _OPAQUE:
            return Element(name, None, (Type(name),))
        if name in _FUNCTIONS:
            return Element(name, None, (UNKNOWN,))
        top = self.node((name,))
        if isinstance(top, Node):
            return Element(name, top.definition, (Type(top),))
        return UNKNOWN if unknown or top is UNKNOWN else Missing(name)

    def _in_scope(self, scope: Node, name: str) -> Element | Unknown | None:
        found = self._member(Type(scope), name)
        if found is not None:
            return found
        for one in scope.definition.imports:
            if name in _imported(one):
                return self._import(one, name)
        for one in scope.definition.imports:
            if one.is_everything and (found := self._import(one, name)) is not None:
                return found
        return None

    def _import(self, used: Import, name: str) -> Element | Unknown | None:
        """What an import clause makes of a name; None if that is not in a package of which everything is imported."""
        whole = used.name._replace(is_global=True)
        if used.members:
            whole = whole._replace(parts=(*whole.parts, dict(used.members)[name]))
        elif used.is_everything:
            whole = whole._replace(parts=(*whole.parts, name))
        found = self.lookup(whole, None)
        if isinstance(found, Missing):
            is_inside = used.is_everything and found.types and found.part == name
            return None if is_inside else UNKNOWN
        return found

    # --- elements of a class --------------------------------------------------------------------------------------

    def _member(self, type_: Type, name: str) -> Element | Unknown | None:
        """Return an element of a class, its own or an inherited one, with the modifiers that concern it."""
        if isinstance(type_.node, str):
            return _predefined(type_.node, name)
        if self._depth > _DEEPEST:
            return UNKNOWN
        self._depth += 1
        try:
            return self._member_of(type_.node, type_.modifiers, name)
        finally:
            self._depth -= 1

    def _member_of(self, node: Node, modifiers: tuple[Scoped, ...], name: str) -> Element | Unknown | None:
        if node.definition.is_derivative:
            return UNKNOWN
        if node.definition.literals is not None:
            is_literal = name in node.definition.literals or not node.definition.literals
            return Element(name, None, (Type(node),)) if is_literal else _predefined("enumeration", name)
        component = node.components.get(name)
        if component is not None:
            return self._component(node, modifiers, component)
        child = self._child(node, name)
        if isinstance(child, Node):
            is_open = "replaceable" in child.definition.prefixes
            types: Types = (Type(child, _nested(modifiers, name)), *([UNKNOWN] if is_open else []))
            return Element(name, child.definition, types)
        inherited = self._inherited(node, modifiers, name)
        is_open = child is UNKNOWN or "expandable" in node.definition.prefixes
        return UNKNOWN if inherited is None and is_open else inherited

    def _inherited(self, node: Node, modifiers: tuple[Scoped, ...], name: str) -> Element | Unknown | None:
        unknown = False
        for base in self.bases(node):
            found = UNKNOWN if base is UNKNOWN else self._member(Type(base.node, base.modifiers + modifiers), name)
            if isinstance(found, Element):
                return found
            unknown |= found is UNKNOWN
        return UNKNOWN if unknown else None

    def _component(self, node: Node, modifiers: tuple[Scoped, ...], component: Component) -> Element:
        name = component.name.parts[0]
        nested = _nested(modifiers, name)
        types: Types = ()
        for arguments, scope in modifiers:
            for one in arguments:
                if one.name.parts == (name,) and one.type is not None:
                    types += _modified(self.types_of(Extends(one.type), scope), nested)
                    types += self.types_of(one.constraint, scope) if one.constraint else ()
        types += _modified(self.types_in(component, node), nested)
        if "redeclare" in component.prefixes:
            before = self._inherited(node, modifiers, name)
            types += before.types if isinstance(before, Element) else ()
        return Element(name, component, tuple(dict.fromkeys(types)))

    def _bases(self, node: Node) -> Types:
        definition = node.definition
        if definition.alias is not None:
            return self.types_of(definition.alias, node.parent)
        found: Types = ()
        if definition.is_extension and node.parent is not None:
            before = self._inherited(node.parent, (), node.name[-1])
            types = before.types if isinstance(before, Element) else (UNKNOWN,)
            found += _modified(types, [Scoped(definition.arguments, node)])
        for one in definition.extends:
            types = self.types_of(one, node)
            found += () if types == (UNKNOWN,) and one.type.parts[:2] == _ICONS else types
        return found


def _modified(types: Types, modifiers: Sequence[Scoped]) -> Types:
    """Types with more modifiers, which come before those that they have."""
    return tuple(one if one is UNKNOWN else Type(one.node, (*modifiers, *one.modifiers)) for one in types)


def _nested(modifiers: Iterable[Scoped], name: str) -> tuple[Scoped, ...]:
    """Return those parts of a class's modifiers that concern one of its elements."""
    return tuple(
        Scoped(one.arguments, scope)
        for arguments, scope in modifiers
        for one in arguments
        if one.name.parts == (name,) and one.arguments
    )


def _predefined(type_: str, name: str) -> Element | Unknown | None:
    if type_ in _OPAQUE:
        return UNKNOWN
    return Element(name, None, (UNKNOWN,)) if name in _PREDEFINED[type_].split() else None


def _imported(used: Import) -> list[str]:
    """Return the names that an import clause makes known, but for one that imports everything."""
    if used.members:
        return [alias for alias, _ in used.members]
    return [] if used.is_everything else [used.alias or used.name.parts[-1]]
