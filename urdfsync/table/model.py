"""A table of elements and the connections between them, as values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, NamedTuple, TypeAlias

import msgspec

Value: TypeAlias = float | int | bool | str
"""A filled cell: a number in SI units, a truth value or a text."""
TYPES = "text", "integer", "boolean"
"""The types of columns without a unit."""
File: TypeAlias = Literal["record", "model", "system"]

FROM, TO = "from", "to"
"""The columns of a connection that name its elements."""


class Sheet(NamedTuple):
    """A table as it was written: the header, and each row with its line."""

    header: Sequence[str]
    rows: Sequence[tuple[int, Sequence[object]]]
    notes: Sequence[str] = ()
    """What the source has and the sheet lacks, in words."""


NOTHING = Sheet((), ())


def shown_unit(kind: str) -> str:
    """Return the unit of a column of this kind for people; empty for numbers without unit, texts and the like."""
    return "" if kind in ("1", *TYPES) else kind


class Options(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """How a table becomes a package."""

    key: str = ""
    """The column that names the elements; empty for the first column."""
    kind: str = ""
    """The column that chooses the template of an element's model, `model/KIND.mo.jinja`; empty for `model.mo.jinja`."""
    connections: str = ""
    """The CSV with the connections; empty if the source has them, or none."""
    files: tuple[File, ...] = ("record", "model")
    """The files to generate: a record and a model for each element, and one model of the whole system."""
    classes: tuple[str, ...] = ()
    """Further classes of the package, such as a connector, from `CLASS.mo.jinja`."""
    columns: Mapping[str, str] = {}
    """The unit of columns, or `text`, `integer` or `boolean`; the table's header may state it, too."""
    uses: Mapping[str, str] = msgspec.field(default_factory=lambda: {"Modelica": "4.0.0"})
    """The libraries that the templates need, with their versions."""


class Table(msgspec.Struct, frozen=True):
    """All rows of a source, sorted by their keys."""

    columns: dict[str, str]
    """The columns of elements: the SI unit of numbers as Modelica writes it, or `text`, `integer`, `boolean`."""
    elements: dict[str, dict[str, Value]]
    """The filled cells of each element, by key and column."""
    connection_columns: dict[str, str] = {}
    """The columns of connections, likewise."""
    connections: dict[str, dict[str, Value]] = {}
    """The filled cells of each connection, by `FROM TO`, with a number if there are several."""
