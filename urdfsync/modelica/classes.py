"""Classes from files, or of the language, with their modifiers."""

from __future__ import annotations

import functools
from collections.abc import Iterable
from typing import NamedTuple, TypeAlias

import msgspec

from urdfsync.modelica.syntax import Class, Component, Modifier, Name


class ClassNode(msgspec.Struct, eq=False, dict=True):
    """A class at its place. Each node equals only itself."""

    definition: Class
    name: tuple[str, ...]
    """Its full name."""
    file: str = ""
    """The path of the class's file, as in `StoredClasses`; empty without a file."""
    parent: ClassNode | None = None
    classes: dict[str, ClassNode | None] = msgspec.field(default_factory=dict)
    """Classes inside of this class that were read so far."""
    bases: tuple[Type, ...] | None = None
    """The resolved base classes; None before they are resolved."""

    @functools.cached_property
    def components(self) -> dict[str, Component]:
        """Components of this class by name, without inherited components."""
        return {component.name.parts[0]: component for component in self.definition.components}

    def __str__(self) -> str:
        return ".".join(self.name)


class Scoped(NamedTuple):
    """Modifiers, and the class in which they are written."""

    arguments: tuple[Modifier, ...]
    scope: ClassNode | None


class Type(NamedTuple):
    """The class of a component, or a base class, with all its modifiers."""

    node: ClassNode
    modifiers: tuple[Scoped, ...] = ()

    def __str__(self) -> str:
        return str(self.node)


Types: TypeAlias = tuple[Type, ...]


def predefined(name: str, components: Iterable[str] = ()) -> ClassNode:
    """Return a type of the language with these attributes or literals."""
    parts = [Component(Name((name,), 0), Name(("",), 0)) for name in components]
    return ClassNode(Class(Name((name,), 0), "type", components=parts), (name,))


OPAQUE = predefined("")
"""Stands for an unknown or unreadable class."""
