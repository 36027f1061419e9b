"""The parts of Modelica text that give names a meaning: classes, components, modifiers, and uses of names.

The parser makes these values. Lines count from 1. Annotations, descriptions and the arithmetic of expressions are left
out; expressions keep only their names.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import msgspec

from urdfsync.modelica.lexer import Fault


class Name(NamedTuple):
    """One use of a name with dots; subscripts are left out."""

    parts: tuple[str, ...]
    line: int
    is_global: bool = False
    """Whether it begins with a dot: then only top-level classes count."""
    is_called: bool = False
    """Whether it is called as a function or record constructor."""
    starts: tuple[int, ...] = ()
    """The beginnings of its parts in the text, from 0."""
    arguments: tuple[Name, ...] = ()
    """The names of the arguments that it is called with."""

    def __str__(self) -> str:
        return ".".join(self.parts)


class Modifier(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """One argument of a modification: `mass = 3`, `inertial(mass = 3)`, `redeclare Elastic elbow(c = 1)`."""

    name: Name
    """The name of the modified element; only annotations have names with several parts."""
    arguments: tuple[Modifier, ...] = ()
    uses: tuple[Name, ...] = ()
    """Names in its value."""
    is_redeclared: bool = False
    type: Extends | None = None
    """Type or class of a redeclared element (`redeclare`, `replaceable`)."""
    constraint: Extends | None = None
    """The class after `constrainedby`."""


class Extends(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """A base class with its modifiers: `extends`, `constrainedby`, `type A = B(…)`."""

    type: Name
    arguments: tuple[Modifier, ...] = ()


class Component(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """A declared component; those of one declaration (`Real x, y;`) are one value each."""

    name: Name
    type: Name
    prefixes: frozenset[str] = frozenset()
    """Such as `parameter`, `inner`, `replaceable`, `redeclare`."""
    arguments: tuple[Modifier, ...] = ()
    uses: tuple[Name, ...] = ()
    """Names in its value, sizes and condition."""
    constraint: Extends | None = None


class ImportClause(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """An import clause."""

    name: Name
    """The class or package behind `import`; imported names count from the top."""
    names: Mapping[str, Name] = {}
    """The imported names, by their short names; empty for everything in the package (`import A.*`)."""


class Class(msgspec.Struct, eq=False, array_like=True, omit_defaults=True):
    """A class definition. Only the parser changes it. Equal only to itself."""

    name: Name
    kind: str
    """Such as `model`, `record`, `operator function`."""
    prefixes: frozenset[str] = frozenset()
    """Such as `partial`, `encapsulated`, `replaceable`, `redeclare`."""
    alias: Extends | None = None
    """The class of a short definition: `type Angle = Real(unit = "rad")`."""
    literals: tuple[str, ...] | None = None
    """The literals of an enumeration; empty for `enumeration(:)`."""
    is_extension: bool = False
    """Whether it is `model extends A`, which continues the inherited class of this name."""
    is_derivative: bool = False
    """Whether it is a function that is defined as the derivative of another one."""
    arguments: tuple[Modifier, ...] = ()
    """Modifiers of the class that `is_extension` continues."""
    constraint: Extends | None = None
    imports: list[ImportClause] = msgspec.field(default_factory=list)
    extends: list[Extends] = msgspec.field(default_factory=list)
    classes: list[Class] = msgspec.field(default_factory=list)
    components: list[Component] = msgspec.field(default_factory=list)
    uses: list[Name] = msgspec.field(default_factory=list)
    """Names in equations and statements, those in connections included, without the indices of loops."""


class StoredText(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """The readable parts of a file of Modelica."""

    faults: Sequence[Fault] = ()
    """All faults of its syntax, and all repetitions."""
    within: str | None = None
    """The package that its `within` clause names; None if it has none."""
    within_line: int = 0
    classes: Sequence[Class] = ()
    libraries: tuple[str, ...] = ()
    """Libraries that its `uses` annotations name."""

    @property
    def is_broken(self) -> bool:
        """Whether parts of the text could not be read."""
        return not all(fault.is_repetition for fault in self.faults)


class Declared(NamedTuple):
    """A class or component that a text declares."""

    path: tuple[str, ...]
    """Its name, after those of the classes around it."""
    line: int


def declared(classes: Sequence[Class], around: tuple[str, ...] = ()) -> Iterator[Declared]:
    """Yield all classes and components that are declared in classes, a class before its parts."""
    for definition in classes:
        path = (*around, definition.name.parts[0])
        yield Declared(path, definition.name.line)
        for component in definition.components:
            yield Declared((*path, component.name.parts[0]), component.name.line)
        yield from declared(definition.classes, path)
