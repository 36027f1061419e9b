"""A table of elements and their connections, as values, with their identifiers; `docs/tables.md` states these."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Literal, NamedTuple, TypeAlias

import msgspec

from urdfsync.domain import Target
from urdfsync.modelica.identifiers import hashed, is_free, stem, tell_apart
from urdfsync.modelica.names import KEYWORDS

CellValue: TypeAlias = float | int | bool | str
"""A filled cell: a number in SI units, a truth value or a text."""
TYPES = "text", "integer", "boolean"
"""The types of columns without a unit."""
TableFile: TypeAlias = Literal["record", "model", "system"]

FROM, TO = "from", "to"
"""The columns of a connection with the keys of its two elements."""


class Sheet(NamedTuple):
    """A table as written: the header, and each row with its line."""

    header: Sequence[str]
    rows: Sequence[tuple[int, Sequence[object]]]
    notes: Sequence[str] = ()
    """Names of parts of the source that the sheet lacks."""
    may_have_commas: bool = False
    """Whether numbers may have decimal commas, since no comma separates cells; see `numerals`."""
    file: str = ""
    """The sheet's file in diagnostics."""


SHEETS = {"column": ("columns", "elements"), "connection_column": ("connection_columns", "connections")}
"""The fields of a table with the types and the rows of its columns, by kind."""
NOTHING = Sheet((), ())


def shown_unit(kind: str) -> str:
    """Return the unit to show for a column; empty for numbers without a unit, texts and booleans."""
    return "" if kind in ("1", *TYPES) else kind


class TableOptions(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The options of one table."""

    key: str = ""
    """The column that names the elements; empty for the first column."""
    kind: str = ""
    """The column that chooses the template of an element's model, `model/KIND.mo.jinja`; empty for `model.mo.jinja`."""
    connections: str = ""
    """The CSV with the connections; empty if the source has the connections, or no connections exist."""
    files: tuple[TableFile, ...] = ("record", "model")
    """The files to generate: a record and a model for each element, and one model of the whole system."""
    classes: tuple[str, ...] = ()
    """More classes of the package, such as a connector, from `CLASS.mo.jinja`."""
    columns: Mapping[str, str] = {}
    """Units of columns, or `text`, `integer` or `boolean`. The header of the table may state the units instead."""
    uses: Mapping[str, str] = msgspec.field(default_factory=lambda: {"Modelica": "4.0.0"})
    """The libraries that the templates need, with their versions."""


class Table(msgspec.Struct, frozen=True):
    """All rows of a source, in its order. The order is not recorded, and no difference (see `Domain.arranged`)."""

    columns: dict[str, str]
    """The columns of elements: the SI unit of numbers in Modelica's spelling, or `text`, `integer`, `boolean`."""
    elements: dict[str, dict[str, CellValue]]
    """The filled cells of each element, by key and column."""
    connection_columns: dict[str, str] = {}
    """The columns of connections, with units or types."""
    connections: dict[str, dict[str, CellValue]] = {}
    """The filled cells of each connection, by `FROM TO`; equal pairs get a number."""


def component_names(keys: Iterable[str], target: Target) -> Mapping[str, str]:
    """Return the components of elements by their keys; no class of an element hides a package or the whole's model."""
    spelled = {("element", key): stem(key, "element") for key in keys}
    spelled = {key: name if is_free(name) else hashed(key[1], "element") for key, name in spelled.items()}
    taken = target.package.partition(".")[0], target.name, "Models", "Records"
    return {key: name for (_, key), name in tell_apart(spelled, taken).items()}


def column_name(column: str) -> str:
    """Return the parameter of a column in records; a word that a parameter can't have gets a final `_`."""
    name = stem(column, "column")
    return f"{name}_" if name in KEYWORDS or name == "time" else name
