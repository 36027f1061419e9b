"""The parts of Modelica text that matter for names: classes, components, modifiers, and uses of names.

The parser makes these values. Lines count from 1. They leave out annotations, descriptions and arithmetic; an
expression is a list of its names.
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
    """Whether the name begins with a dot: it is looked up only among top-level classes."""
    is_called: bool = False
    """Whether the name is called as a function or record constructor."""
    starts: tuple[int, ...] = ()
    """The places of the name's parts in the text, from 0."""
    arguments: tuple[Name, ...] = ()
    """The names of the named arguments of the call."""

    def __str__(self) -> str:
        return ".".join(self.parts)


class Modifier(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """One argument of a modification: `mass = 3`, `inertial(mass = 3)`, `redeclare Elastic elbow(c = 1)`."""

    name: Name
    """The name of the modified element; only annotations have names with several parts."""
    arguments: tuple[Modifier, ...] = ()
    uses: tuple[Name, ...] = ()
    """Names in the modifier's value."""
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
    """A declared component; a declaration of several (`Real x, y;`) gives one value for each."""

    name: Name
    type: Name
    prefixes: frozenset[str] = frozenset()
    """Such as `parameter`, `inner`, `replaceable`, `redeclare`."""
    arguments: tuple[Modifier, ...] = ()
    uses: tuple[Name, ...] = ()
    """Names in the component's value, sizes and condition."""
    constraint: Extends | None = None


class ImportClause(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """An import clause."""

    name: Name
    """The class or package after `import`; this name is looked up from the top level."""
    names: Mapping[str, Name] = {}
    """The imported names by short names; empty for the whole package (`import A.*`)."""


class Class(msgspec.Struct, eq=False, array_like=True, omit_defaults=True):
    """A class definition. Only the parser changes a class. Each class equals only itself."""

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
    """Whether this is `model extends A`, which continues the inherited class of this name."""
    is_derivative: bool = False
    """Whether this is a function that is defined as the derivative of another function."""
    arguments: tuple[Modifier, ...] = ()
    """Modifiers of the class that `is_extension` continues."""
    constraint: Extends | None = None
    imports: list[ImportClause] = msgspec.field(default_factory=list)
    extends: list[Extends] = msgspec.field(default_factory=list)
    classes: list[Class] = msgspec.field(default_factory=list)
    components: list[Component] = msgspec.field(default_factory=list)
    uses: list[Name] = msgspec.field(default_factory=list)
    """Names in equations, connections and statements, without the indices of loops."""


class StoredText(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """The readable parts of a Modelica file."""

    faults: Sequence[Fault] = ()
    """All faults of its syntax, and all repetitions."""
    within: str | None = None
    """The package in the `within` clause; None without a clause."""
    within_line: int = 0
    classes: Sequence[Class] = ()
    libraries: tuple[str, ...] = ()
    """Libraries in the `uses` annotations."""

    @property
    def is_broken(self) -> bool:
        """Whether parts of the text could not be read."""
        return not all(fault.is_repetition for fault in self.faults)


class Declared(NamedTuple):
    """A class or component that a text declares."""

    path: tuple[str, ...]
    """The names of the classes around it, then its own name."""
    line: int


def declared(classes: Sequence[Class], around: tuple[str, ...] = ()) -> Iterator[Declared]:
    """Yield all declared classes and components; a class comes before its parts."""
    for definition in classes:
        path = (*around, definition.name.parts[0])
        yield Declared(path, definition.name.line)
        for component in definition.components:
            yield Declared((*path, component.name.parts[0]), component.name.line)
        yield from declared(definition.classes, path)
