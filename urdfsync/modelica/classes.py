"""Classes from files, or of the language, with the modifiers that are applied to them."""

from __future__ import annotations

import functools
from collections.abc import Iterable
from typing import NamedTuple, TypeAlias

import msgspec

from urdfsync.modelica.syntax import Class, Component, Modifier, Name


class Node(msgspec.Struct, eq=False, dict=True):
    """A class at its place. Equal only to itself."""

    definition: Class
    name: tuple[str, ...]
    """Its full name."""
    file: str = ""
    """The path of its file, as `StoredClasses` has it; empty for none."""
    parent: Node | None = None
    """The class around it."""
    classes: dict[str, Node | None] = msgspec.field(default_factory=dict)
    """Its own classes that were read so far."""
    bases: tuple[Type, ...] | None = None
    """The classes that it extends, once they are resolved."""

    @functools.cached_property
    def components(self) -> dict[str, Component]:
        """Its own components by their names."""
        return {component.name.parts[0]: component for component in self.definition.components}

    def __str__(self) -> str:
        return ".".join(self.name)


class Scoped(NamedTuple):
    """Modifiers, and the class in whose scope they are written."""

    arguments: tuple[Modifier, ...]
    scope: Node | None


class Type(NamedTuple):
    """The class of a component or a derived class, with all modifiers that are applied to it."""

    node: Node
    modifiers: tuple[Scoped, ...] = ()

    def __str__(self) -> str:
        return str(self.node)


Types: TypeAlias = tuple[Type, ...]


def predefined(name: str, components: Iterable[str] = ()) -> Node:
    """Return a type of the language with these attributes or literals."""
    parts = [Component(Name((name,), 0), Name(("",), 0)) for name in components]
    return Node(Class(Name((name,), 0), "type", components=parts), (name,))


OPAQUE = predefined("")
"""A class that is unknown or unreadable."""
